# SPDX-License-Identifier: Apache-2.0
# The page of the HTML report in a headless browser: made by hcsp-solve from the shipped SLAM model, then used.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
find_program(HCSP_CHROMIUM NAMES chromium chromium-browser google-chrome DOC "Chromium, which the browser tests need")
if(NOT HCSP_CHROMIUM)
  message(FATAL_ERROR "Chromium was not found, which the browser tests need: install the package chromium, "
    "or set HCSP_BUILD_TESTS to OFF")
endif()
add_test(NAME browser.page
  COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/browser/page_test.py
    --chromium ${HCSP_CHROMIUM} --solver $<TARGET_FILE:hcsp-solve> --models ${PROJECT_SOURCE_DIR}/models/slam)
set_tests_properties(browser.page PROPERTIES TIMEOUT 180)
