# SPDX-License-Identifier: Apache-2.0
# IEEE 1788 test cases: the project's own always, the ITF1788 suite where there is one (tests/conformance).
file(GLOB sources CONFIGURE_DEPENDS conformance/*.cpp)
add_executable(itl_runner ${sources})
target_link_libraries(itl_runner PRIVATE hcsp_domains hcsp_warnings)
file(GLOB own CONFIGURE_DEPENDS conformance/itl/*.itl)
add_test(NAME conformance.own COMMAND itl_runner ${own})
add_test(NAME conformance.malformed COMMAND itl_runner ${CMAKE_CURRENT_SOURCE_DIR}/conformance/malformed.itl)
set_tests_properties(conformance.malformed PROPERTIES PASS_REGULAR_EXPRESSION "malformed.itl:4:9: expected two bounds")
set(HCSP_ITF1788_DIR "${PROJECT_SOURCE_DIR}/../shared/conformance/itl" CACHE PATH "Where ITF1788's ITL files are")
file(GLOB suite CONFIGURE_DEPENDS ${HCSP_ITF1788_DIR}/*.itl)
if(suite)
  add_test(NAME conformance.itf1788 COMMAND itl_runner ${suite})
endif()
