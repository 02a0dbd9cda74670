# SPDX-License-Identifier: Apache-2.0
# find_package(hcsp) works after cmake --install, in a project that knows nothing of this one.
add_test(NAME installed_consumer COMMAND ${CMAKE_COMMAND}
  -DBUILD_DIR=${PROJECT_BINARY_DIR} -DWORK_DIR=${PROJECT_BINARY_DIR}/installed_consumer
  -DGENERATOR=${CMAKE_GENERATOR} -DCXX=${CMAKE_CXX_COMPILER} -DBUILD_TYPE=${CMAKE_BUILD_TYPE}
  -P ${CMAKE_CURRENT_SOURCE_DIR}/installed_consumer/run.cmake)
set_tests_properties(installed_consumer PROPERTIES TIMEOUT 300)
