#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes the parser, the whole compile path and the reader of Minibex, MINUTES each (30 when none are given), from the models of the tests and
# what tests/fuzz/corpus keeps. An input that crashes, leaks, takes more than a second on this machine or more than 1 GB
# ends the run and is left in the working folder. Needs clang; the build is that of `cmake --preset fuzz`.
#   tests/fuzz/run.sh [MINUTES] [BUILD_FOLDER]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../lang"
minutes=${1:-30}
build=${2:-../../build/fuzz}
cmake --build "$build" --target parse_fuzzer compile_fuzzer minibex_fuzzer
seeds=$(mktemp -d)
trap 'rm -rf "$seeds"' EXIT
mkdir "$seeds/hcsp" "$seeds/minibex"
cp good/*.hcsp bad/*.hcsp "$seeds/hcsp"
cp minibex/good/*.{bch,mbx,txt} minibex/bad/*.mbx "$seeds/minibex"
for fuzzer in parse compile minibex; do
  found=$(mktemp -d)
  language=$([ "$fuzzer" = minibex ] && echo minibex || echo hcsp)
  corpora=("$seeds/$language")
  [ "$language" = hcsp ] && corpora+=(../fuzz/corpus)
  # A sanitized build is some fifty times slower than the tool: what hangs for a second shows as a minute.
  "$build/tests/fuzz/${fuzzer}_fuzzer" -dict=../fuzz/$language.dict -max_total_time=$((60 * minutes)) -timeout=60 \
    -rss_limit_mb=1024 -max_len=20000 -print_final_stats=1 "$found" "${corpora[@]}"
  rm -rf "$found"
done
