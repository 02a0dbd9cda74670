# SPDX-License-Identifier: Apache-2.0
# No include points up, and the test that says so catches planted violations.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(layering ${CMAKE_CURRENT_SOURCE_DIR}/layering/layering.py)
add_test(NAME layering.project COMMAND Python3::Interpreter -B ${layering} ${PROJECT_SOURCE_DIR})
add_test(NAME layering.self_test COMMAND Python3::Interpreter -B ${layering} --self-test)
