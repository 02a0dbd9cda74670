# SPDX-License-Identifier: Apache-2.0
# The second verifier, and what it says of the certificates of the gallery and, where they are, of IBEX's benchmarks.
file(GLOB verifier_sources CONFIGURE_DEPENDS verifier/*.cpp)
list(FILTER verifier_sources EXCLUDE REGEX "main.cpp|_test.cpp")
add_library(hcsp_verifier STATIC ${verifier_sources})
target_include_directories(hcsp_verifier PUBLIC ${PROJECT_SOURCE_DIR})
target_link_libraries(hcsp_verifier PUBLIC MPFR::MPFR PRIVATE Eigen3::Eigen nlohmann_json::nlohmann_json hcsp_warnings)
add_executable(verify_certificates verifier/main.cpp)
target_link_libraries(verify_certificates PRIVATE hcsp_verifier hcsp_warnings)
add_executable(verifier_tests verifier/verifier_test.cpp)
target_link_libraries(verifier_tests PRIVATE hcsp_verifier hcsp_test_support)
gtest_discover_tests(verifier_tests TEST_PREFIX verifier. DISCOVERY_TIMEOUT 60)

add_test(NAME verifier.independence
  COMMAND sh -c "! grep -nE '#include \"(domains|solver|lang)/' ${CMAKE_CURRENT_SOURCE_DIR}/verifier/*")

# What a model has to show: so many certificates, each of them confirmed.
function(hcsp_add_certificates name model count)
  add_test(NAME certificates.${name} COMMAND ${CMAKE_COMMAND} -DSOLVE=$<TARGET_FILE:hcsp-solve>
    -DVERIFY=$<TARGET_FILE:verify_certificates> -DMODEL=${model} -DCOUNT=${count}
    -DRESULT=${PROJECT_BINARY_DIR}/certificates/${name}.json -P ${CMAKE_CURRENT_SOURCE_DIR}/verifier/certificates.cmake)
  set_tests_properties(certificates.${name} PROPERTIES TIMEOUT 300)
endfunction()
file(GLOB models CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/models/gallery/*.hcsp)
foreach(model ${models})
  file(STRINGS ${model} found REGEX "^// found: [0-9]+ unique$")
  if(found)
    string(REGEX MATCH "[0-9]+" count "${found}")
    get_filename_component(name ${model} NAME_WE)
    hcsp_add_certificates(${name} ${model} ${count})
  endif()
endforeach()
set(HCSP_MINIBEX_DIR "${PROJECT_SOURCE_DIR}/../shared/benchmarks/minibex" CACHE PATH "Where IBEX's benchmarks are")
foreach(system Brown-07=3 BroydenBanded-020=1 BroydenTri-0100=2 Caprasse=18 Design=1 Directkin=2 Discrete-Integralf2-16=3
        Eco9=16 I5=30 Kin1=16 Trigexp2-11=0 yamamura8a=7)
  string(REGEX MATCH "^(.*)=(.*)$" whole ${system})
  if(EXISTS ${HCSP_MINIBEX_DIR}/${CMAKE_MATCH_1}.bch)
    hcsp_add_certificates(minibex.${CMAKE_MATCH_1} ${HCSP_MINIBEX_DIR}/${CMAKE_MATCH_1}.bch ${CMAKE_MATCH_2})
  endif()
endforeach()
