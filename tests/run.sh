#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what the tests need (as root or with sudo), builds everything (Release, into build/release) and runs
# all tests. Ends with the summary of ctest; the exit status is 0 when every test passed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

examples/install_packages.sh test
cmake --preset release -DHCSP_BUILD_TESTS=ON
cmake --build build/release
ctest --test-dir build/release --output-on-failure -j2
