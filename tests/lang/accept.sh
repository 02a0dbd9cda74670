#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Writes the .expected files of tests/lang/good and bad anew, from what the models give now. Look at the difference
# (git diff tests/lang) before you commit it.
#   tests/lang/accept.sh [BUILD_FOLDER]      (build/release when none is given)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=${1:-build/release}
cmake --build "$build" --target lang_tests
HCSP_ACCEPT=1 "$build/tests/lang_tests" --gtest_filter="Corpus.*" --gtest_brief=1
