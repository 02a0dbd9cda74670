# SPDX-License-Identifier: Apache-2.0
# Every C++ file is formatted as .clang-format says.
find_program(HCSP_CLANG_FORMAT NAMES clang-format-14 clang-format REQUIRED)
add_test(NAME style.format
  COMMAND sh -c "find domains solver lang tests examples -name '*.h' -o -name '*.cpp' | sort | xargs '${HCSP_CLANG_FORMAT}' --dry-run --Werror"
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
