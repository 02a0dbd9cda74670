# SPDX-License-Identifier: Apache-2.0
# Installs the build to a fresh prefix, then configures, builds and runs the consumer against it.
#   cmake -DBUILD_DIR=... -DWORK_DIR=... -DGENERATOR=... -DCXX=... -DBUILD_TYPE=... -P run.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGV}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix
  -DEXAMPLES_DIR=${CMAKE_CURRENT_LIST_DIR}/../../examples)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/consumer)

# The SLAM problem built with the C++ API alone gives the sets of the .hcsp model, cell by cell. (The bounds of x may
# differ in the last bits: the language adds a decimal and its error exactly, the example as intervals.)
set(slam ${CMAKE_CURRENT_LIST_DIR}/../../models/slam)
run(${WORK_DIR}/build/slam_builder ${slam}/room.csv --json ${WORK_DIR}/built.json)
run(${WORK_DIR}/prefix/bin/hcsp-solve ${slam}/slam.hcsp --quiet -o ${WORK_DIR}/model.json)
file(READ ${WORK_DIR}/built.json built)
file(READ ${WORK_DIR}/model.json model)
foreach(set D M)
  string(JSON of_built GET ${built} variables ${set})
  string(JSON of_model GET ${model} variables ${set})
  string(JSON same EQUAL ${of_built} ${of_model})
  if(NOT same)
    message(FATAL_ERROR "slam_builder and slam.hcsp give different domains of ${set}")
  endif()
endforeach()

# Seven joints, replanned every cycle to the end of the move.
run(${WORK_DIR}/build/control_loop ${WORK_DIR}/prefix/share/hcsp/models/straight_line/type3.hcsp)
