#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The data of models/slam is what the simulator makes, byte for byte: shipped_data.sh SIMULATE_SLAM MODELS WORK_DIR
set -eu
simulate=$1 models=$2/slam made=$3
rm -rf "$made"
"$simulate" --out "$made" --world room
"$simulate" --out "$made" --world curves
"$simulate" --out "$made" --world room --sensor cone --name cone
for file in "$made"/*.csv; do
  cmp "$file" "$models/$(basename "$file")"
done
