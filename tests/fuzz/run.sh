#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes the parser and the whole compile path, MINUTES each (30 when none are given), from the models of the tests and
# what tests/fuzz/corpus keeps. An input that crashes, leaks, takes more than a second on this machine or more than 1 GB
# ends the run and is left in the working folder. Needs clang; the build is that of `cmake --preset fuzz`.
#   tests/fuzz/run.sh [MINUTES] [BUILD_FOLDER]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../lang"
minutes=${1:-30}
build=${2:-../../build/fuzz}
cmake --build "$build" --target parse_fuzzer compile_fuzzer
seeds=$(mktemp -d)
trap 'rm -rf "$seeds"' EXIT
cp good/*.hcsp bad/*.hcsp "$seeds"
for fuzzer in parse compile; do
  found=$(mktemp -d)
  # A sanitized build is some fifty times slower than the tool: what hangs for a second shows as a minute.
  "$build/tests/fuzz/${fuzzer}_fuzzer" -dict=../fuzz/hcsp.dict -max_total_time=$((60 * minutes)) -timeout=60 \
    -rss_limit_mb=1024 -max_len=20000 -print_final_stats=1 "$found" ../fuzz/corpus "$seeds"
  rm -rf "$found"
done
