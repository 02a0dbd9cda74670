# SPDX-License-Identifier: Apache-2.0
# Straight-line motion: an oracle of its own, the theory on which the models rely, and campaigns of random moves.
file(GLOB sources CONFIGURE_DEPENDS straight_line/*.cpp)
add_executable(straight_line_tests ${sources})
target_link_libraries(straight_line_tests PRIVATE hcsp_lang hcsp_verifier hcsp_test_support)
gtest_discover_tests(straight_line_tests TEST_PREFIX straight_line. DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
