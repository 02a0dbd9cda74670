# SPDX-License-Identifier: Apache-2.0
# The simulator builds, and the shipped data are what it makes.
add_executable(simulate_slam ${PROJECT_SOURCE_DIR}/examples/simulate_slam.cpp)
target_compile_options(simulate_slam PRIVATE -ffp-contract=off)
target_link_libraries(simulate_slam PRIVATE hcsp_warnings)
add_test(NAME models.shipped_data COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/models/shipped_data.sh
  $<TARGET_FILE:simulate_slam> ${PROJECT_SOURCE_DIR}/models ${PROJECT_BINARY_DIR}/shipped_data)
