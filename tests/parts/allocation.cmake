# SPDX-License-Identifier: Apache-2.0
# What must not allocate, in an executable whose operator new counts.
add_executable(allocation_tests allocation/compiled_problem_allocation_test.cpp)
target_link_libraries(allocation_tests PRIVATE hcsp_solver hcsp_test_support)
gtest_discover_tests(allocation_tests TEST_PREFIX allocation. DISCOVERY_TIMEOUT 60)
