# SPDX-License-Identifier: Apache-2.0
# Systems of IBEX's benchmark collection where there are some: read, solved, their solutions counted.
set(HCSP_MINIBEX_DIR "${PROJECT_SOURCE_DIR}/../shared/benchmarks/minibex" CACHE PATH "Where IBEX's benchmark systems are")
file(GLOB systems CONFIGURE_DEPENDS ${HCSP_MINIBEX_DIR}/*.bch)
if(systems)
  add_executable(minibex_benchmarks minibex/benchmarks.cpp)
  target_link_libraries(minibex_benchmarks PRIVATE hcsp_lang hcsp_warnings)
  add_test(NAME minibex.benchmarks COMMAND minibex_benchmarks ${HCSP_MINIBEX_DIR})
  set_tests_properties(minibex.benchmarks PROPERTIES TIMEOUT 600)
endif()
