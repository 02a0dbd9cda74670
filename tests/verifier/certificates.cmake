# SPDX-License-Identifier: Apache-2.0
# Solves MODEL with SOLVE into RESULT, and has VERIFY confirm all of its COUNT certificates.
get_filename_component(folder ${RESULT} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
file(REMOVE ${RESULT})
execute_process(COMMAND ${SOLVE} ${MODEL} --quiet -o ${RESULT} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${MODEL} is not solved: ${status}")
endif()
execute_process(COMMAND ${VERIFY} ${MODEL} ${RESULT} RESULT_VARIABLE status OUTPUT_VARIABLE said)
message("${said}")
if(NOT status EQUAL 0 OR NOT said MATCHES ": ${COUNT} of ${COUNT} certificates confirmed")
  message(FATAL_ERROR "expected ${COUNT} certificates, all of them confirmed")
endif()
