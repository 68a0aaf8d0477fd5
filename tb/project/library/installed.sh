#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs the library outside the checkout, builds the programs of user/ there, and compares what they print with
# `halfway`. installed.sh CMAKE HALFWAY BUILD ROOT OUT: BUILD is the build folder, OUT a folder for results.
set -eu
cmake=$1 halfway=$2 build=$3 root=$4 out=$5
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
rm -rf "$out"
mkdir -p "$out"
cd "$place"
"$cmake" --install "$build" --prefix "$place/first" >/dev/null
# The installed files may be moved, and must not name the checkout.
mv first installed
if grep -rl "$root" installed --include='*.cmake' --include='*.h'; then
  echo 'these installed files name the checkout'
  exit 1
fi
cp -r "$root/tb/project/library/user" user
"$cmake" -S user -B built -DCMAKE_PREFIX_PATH="$place/installed" >/dev/null
"$cmake" --build built >/dev/null
built/errors
# Init vectors, fragments and the frame of each shader.
compare() {
  scene=$1 shader=$2 preset=$3 width=$4 height=$5
  draw="built/draw $scene $shader $preset $width $height"
  "$halfway" init "$scene" --shader "$shader" --preset "$preset" --size "${width}x$height" --file "$out/init.txt" >/dev/null
  grep -v '[^0-9a-f]' "$out/init.txt" >"$out/expected.hex"
  $draw init >"$out/got.hex"
  cmp "$out/got.hex" "$out/expected.hex"
  "$halfway" sim "$scene" --shader "$shader" --preset "$preset" --size "${width}x$height" --simulator verilator \
    --out "$out" >/dev/null
  awk 'NF == 7' "$out/$scene/$shader/golden.trace" >"$out/expected.trace"
  $draw trace >"$out/got.trace"
  cmp "$out/got.trace" "$out/expected.trace"
  [ "$(wc -l <"$out/got.trace")" -gt 100 ] || { echo "$scene: hardly any fragments"; exit 1; }
  echo "$scene $shader $preset: $(wc -l <"$out/got.hex") init vectors and $(wc -l <"$out/got.trace") fragments are equal"
}
compare spheres quadratic exact 128 96
compare matte spherical published 93 69
compare lights quadratic published 33 25
compare spheres processors exact 33 25
# The nearest fragment of each pixel, the first of equal ones, over the background.
built/draw spheres quadratic exact 128 96 trace | awk '
  { at = $2 * 128 + $3; if (!(at in z) || $4 < z[at]) { z[at] = $4; colour[at] = $5 " " $6 " " $7 } }
  END { for (i = 0; i < 128 * 96; ++i) print i in colour ? colour[i] : "background" }' >"$out/expected.frame"
built/draw spheres quadratic exact 128 96 ppm | tail -c $((3 * 128 * 96)) | od -An -v -tu1 -w3 | sed 's/^ *//; s/  */ /g' >"$out/got.frame"
background=$(head -n 1 "$out/got.frame")
sed "s/background/$background/" "$out/expected.frame" | cmp - "$out/got.frame"
echo 'installed: passed'
