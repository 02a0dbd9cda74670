# SPDX-License-Identifier: Apache-2.0
# Run by the build: cmake -DPAGE_DIR=... -DD3=... -DOUTPUT=... -P embed.cmake
# Puts the page's style, scripts and d3 into page.html and writes the whole as C++ strings.
cmake_minimum_required(VERSION 3.22)
file(READ ${PAGE_DIR}/page.html page)
file(READ ${PAGE_DIR}/page.css style)
file(READ ${D3} d3)
set(script "")
foreach(part data map plots page)
  file(READ ${PAGE_DIR}/${part}.js text)
  string(APPEND script "${text}")
endforeach()
foreach(text d3 script)
  if("${${text}}" MATCHES "</script")
    message(FATAL_ERROR "the ${text} of the page holds </script, which would end its script element")
  endif()
endforeach()
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@D3@" "${d3}" page "${page}")
string(REPLACE "@SCRIPT@" "${script}" page "${page}")
string(FIND "${page}" "@DATA@" cut)
if(cut EQUAL -1)
  message(FATAL_ERROR "page.html has no place for the data")
endif()
string(SUBSTRING "${page}" 0 ${cut} before)
math(EXPR cut "${cut} + 6")
string(SUBSTRING "${page}" ${cut} -1 after)

# A raw string of at most some 8000 bytes after another: compilers limit the length of one. None ends within a
# character of several bytes.
function(to_literals text result)
  set(literals "")
  string(LENGTH "${text}" length)
  set(from 0)
  while(from LESS length)
    set(size 8000)
    string(SUBSTRING "${text}" ${from} ${size} chunk)
    while(NOT chunk MATCHES "[ -~\n]$")
      math(EXPR size "${size} - 1")
      string(SUBSTRING "${text}" ${from} ${size} chunk)
    endwhile()
    string(APPEND literals "\n    R\"~page~(${chunk})~page~\"")
    string(LENGTH "${chunk}" size)
    math(EXPR from "${from} + ${size}")
  endwhile()
  set(${result} "${literals}" PARENT_SCOPE)
endfunction()
to_literals("${before}" before)
to_literals("${after}" after)
file(WRITE ${OUTPUT} "// Generated from solver/report/page by embed.cmake.
#include \"solver/report/page.h\"

namespace hcsp::report {

std::string_view page_before_data() {
  static constexpr char kText[] =${before};
  return {kText, sizeof kText - 1};
}
std::string_view page_after_data() {
  static constexpr char kText[] =${after};
  return {kText, sizeof kText - 1};
}

}  // namespace hcsp::report
")
