# SPDX-License-Identifier: Apache-2.0
# The page of the HTML report, embedded at build time: its own files and d3.
find_file(HCSP_D3 d3.min.js PATHS /usr/share/nodejs/d3/dist /usr/share/javascript/d3
  DOC "d3.min.js, which the HTML report embeds")
if(NOT HCSP_D3)
  message(FATAL_ERROR "d3.min.js was not found, which the HTML report embeds: install node-d3, or set HCSP_D3 to its path")
endif()
set(page_dir ${CMAKE_CURRENT_SOURCE_DIR}/report/page)
file(GLOB page_files CONFIGURE_DEPENDS ${page_dir}/*)
set(page_source ${CMAKE_CURRENT_BINARY_DIR}/page.cpp)
add_custom_command(OUTPUT ${page_source}
  COMMAND ${CMAKE_COMMAND} -DPAGE_DIR=${page_dir} -DD3=${HCSP_D3} -DOUTPUT=${page_source} -P ${page_dir}/embed.cmake
  DEPENDS ${page_files} ${HCSP_D3}
  COMMENT "Embedding the page of the HTML report" VERBATIM)
target_sources(hcsp_solver PRIVATE ${page_source})
target_compile_definitions(hcsp_solver PRIVATE HCSP_VERSION="${PROJECT_VERSION}")
