#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds sim/extras/library/examples against an installed tree outside the checkout, and runs it on the simulated board, which compares
# every picture. example.sh CMAKE HALFWAY BUILD ROOT OUT: BUILD is the build folder, OUT a folder for results.
set -eu
cmake=$1 halfway=$2 build=$3 root=$4 out=$5
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
rm -rf "$out"
cd "$place"
"$cmake" --install "$build" --prefix "$place/installed" >/dev/null
cp -r "$root/sim/extras/library/examples" examples
"$cmake" -S examples -B built -DCMAKE_PREFIX_PATH="$place/installed" >/dev/null
"$cmake" --build built >/dev/null
"$halfway" board-sim --serve "$place/socket" --out "$out" >"$place/report" &
board=$!
# The model of the board may have to be built first.
while [ ! -S "$place/socket" ]; do
  kill -0 $board 2>/dev/null || { wait $board || true; cat "$place/report"; echo 'the board has ended'; exit 1; }
  sleep 0.2
done
built/spin "$place/installed/share/halfway/scenes/matte.toml" "$place/socket" 3
wait $board
cat "$place/report"
# A black picture, and three frames.
for number in 0 1 2 3; do
  [ -s "$out/picture-$number.png" ] || { echo "no picture-$number.png"; exit 1; }
done
! cmp -s "$out/picture-1.png" "$out/picture-2.png" || { echo 'the mesh does not turn'; exit 1; }
echo 'example: passed'
