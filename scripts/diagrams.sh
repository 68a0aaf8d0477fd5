#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# scripts/diagrams.sh FOLDER: draws rtl/diagrams and the folders of C++ by Graphviz, by way of FOLDER.
#
# Graphviz draws arrows over the words of frames and of other arrows: these are drawn last here, with a rim.
set -eu

mkdir -p "$1"
# Without the arrows that follow from others.
tred build/folders.dot | dot -Tsvg >docs/folders.svg
for text in rtl/diagrams/*.dot; do
  dot -Tsvg "$text" >"$1/drawn.svg"
  awk '
    /class="(cluster|edge)"/ { lifts = 1 }
    /<\/g>/ { lifts = 0 }
    lifts && sub(/<text /, "<text stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\" ") { words = words $0 ORS; next }
    /^<\/svg>/ { printf "%s", words }
    NR > 1 { print held }
    { held = $0 }
    END { print held }' "$1/drawn.svg" >"$1/diagram.svg"
  mv "$1/diagram.svg" "${text%.dot}.svg"
done
