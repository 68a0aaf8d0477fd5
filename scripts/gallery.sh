#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Makes the pictures of docs/results/gallery from GHDL's frames of `halfway sim`.
#
#   scripts/gallery.sh [--check] FOLDER   FOLDER takes what is made on the way; --check writes nothing else, draws by
#                                         the golden model alone, and fails where the gallery has another picture
#
# Exit codes: 0 done, 1 a check or a comparison failed, 2 bad usage, 3 a tool is missing.
set -eu
export LC_ALL=C

check=false
if [ "${1-}" = --check ]; then
  check=true
  shift
fi
case "$#:${1-}" in
  1:[!-]*) ;;
  *)
    echo "usage: scripts/gallery.sh [--check] FOLDER" >&2
    exit 2
    ;;
esac
root=$(cd "$(dirname "$0")/.." && pwd)
halfway=${HALFWAY:-$root/build/halfway}
gallery=$root/docs/results/gallery
mkdir -p "$1"
cd "$1"
command -v idiff >/dev/null || {
  echo "gallery: idiff is missing; install it with: apt-get install openimageio-tools" >&2
  exit 3
}

# Draws a scene into NAME.png.
draw() { # name scene option...
  name=$1
  scene=$2
  shift 2
  if $check; then
    "$halfway" render "$scene" --method golden --file "$name.png" "$@" >"$name.log"
  else
    "$halfway" sim "$scene" --out "$name" "$@"
    cp "$name/$scene"/*/ghdl.png "$name.png"
  fi
}

draw spheres spheres
draw teapot teapot
draw shadows shadows --shader processors

bad=0
for picture in spheres teapot shadows; do
  if ! $check; then
    cp $picture.png "$gallery"
    echo "docs/results/gallery/$picture.png: written"
  elif ! idiff $picture.png "$gallery/$picture.png" >$picture.log; then
    echo "gallery: docs/results/gallery/$picture.png differs from the drawn picture: run make gallery" >&2
    bad=1
  fi
done
exit $bad
