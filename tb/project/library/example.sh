#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds sim/extras/library/examples against an installed tree outside the checkout, and runs it on the simulated board, which compares
# every picture, and on the simulated core, whose pictures it compares. example.sh CMAKE HALFWAY BUILD ROOT OUT: BUILD is the build folder, OUT a folder for results.
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
# serve NAME COMMAND...: starts a simulation that listens at $place/NAME. Its model may have to be built first.
serve() {
  name=$1
  shift
  "$halfway" "$@" --serve "$place/$name" >"$place/report" &
  server=$!
  while [ ! -S "$place/$name" ]; do
    kill -0 $server 2>/dev/null || { wait $server || true; cat "$place/report"; echo "the $name has ended"; exit 1; }
    sleep 0.2
  done
}
scene=$place/installed/share/halfway/scenes/matte.toml
serve board board-sim --out "$out"
built/spin "$scene" "$place/board" 3
wait $server
cat "$place/report"
# A black picture, and three frames.
for number in 0 1 2 3; do
  [ -s "$out/picture-$number.png" ] || { echo "no picture-$number.png"; exit 1; }
done
serve core core-sim --format xrgb8888 "$scene"
built/spin "$scene" "core:$place/core" 2
wait $server
cat "$place/report"
turns() { ! cmp -s "$1" "$2" || { echo 'the mesh does not turn'; exit 1; }; }
turns "$out/picture-1.png" "$out/picture-2.png"
turns spin-0.ppm spin-1.ppm
echo 'example: passed'
