#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The examples of docs/rtl/using-the-core.md: the design draws the golden model's frame, the program computes the
# set-up's vectors. example.sh HALFWAY ROOT FOLDER LIBRARY OWN_VECTORS: LIBRARY is the folder of the library halfway.
set -eu
halfway=$1 root=$2 folder=$3 library=$4 own_vectors=$5
mkdir -p "$folder"
cd "$folder"
scene="$root/sim/report/timing.toml --size 16x12 --highlight-test none --preset published"
# The ROM must hold the vectors that set-up computes today.
"$halfway" init $scene --file init.txt >/dev/null
sed -n '/^[0-9a-f]*$/p' init.txt | while read -r vector; do
  grep -q "x\"$vector\"" "$root/docs/rtl/example.vhd" || { echo "example.vhd: lacks init vector $vector"; exit 1; }
done
# The program must print the set-up's vectors, from the scene and from the screen.
"$halfway" init "$root/sim/report/timing.toml" --size 16x12 --highlight-test none --file own.txt >/dev/null
grep -v '[^0-9a-f]' own.txt >expected.txt
for from in scene screen; do
  "$own_vectors" $from | cmp - expected.txt || { echo "own_vectors $from: not the vectors of halfway init"; exit 1; }
done
# Resolve the golden fragments to a frame: the first of the nearest ones at each pixel, black elsewhere.
"$halfway" sim $scene --simulator verilator --out out >/dev/null
awk 'NF == 7 { at = $2 * 16 + $3; if (!(at in z) || $4 < z[at]) { z[at] = $4; colour[at] = $5 } }
  END { for (i = 0; i < 192; ++i) print colour[i] + 0 }' out/timing/quadratic/golden.trace >frame.txt
[ "$(grep -vc '^0$' frame.txt)" -gt 40 ] || { echo 'example: the golden frame is empty'; exit 1; }
ghdl -a --std=08 -P"$library" "$root/docs/rtl/example.vhd" "$root/tb/project/example/example_tb.vhd"
ghdl --elab-run --std=08 -P"$library" example_tb -gg_frame="$folder/frame.txt" --ieee-asserts=disable-at-0 --assert-level=error
