#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Makes figure 17, sim/gallery/figure17.svg, from the trace of a run of interpolator_timing_tb.
#
#   tb/timing/figure17.sh [--check] FOLDER   FOLDER takes what is made on the way; --check writes nothing else, and
#                                            fails where the gallery has another picture
#
# Exit codes: 0 done, 1 a check failed, 2 bad usage, 3 a tool is missing; with --check a missing gnuplot, or one that is
# not the one that made the gallery's picture, is 77 instead, ctest's SKIP_RETURN_CODE.
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
    echo "usage: tb/timing/figure17.sh [--check] FOLDER" >&2
    exit 2
    ;;
esac
root=$(cd "$(dirname "$0")/../.." && pwd)
gallery=$root/sim/gallery/figure17.svg
mkdir -p "$1"
cd "$1"

lacks() { # package code
  echo "figure17: $1 is missing; install it with: apt-get install $1" >&2
  exit "$2"
}
command -v ghdl >/dev/null || lacks ghdl-llvm 3
command -v gnuplot >/dev/null || lacks gnuplot-nox "$(if $check; then echo 77; else echo 3; fi)"

ghdl -i --std=08 "$root"/rtl/tables/*_pkg.vhd "$root/tb/tb_pkg.vhd" "$root"/tb/timing/*.vhd
ghdl -m --std=08 interpolator_timing_tb >make.log || { cat make.log && exit 1; }
ghdl -r --std=08 interpolator_timing_tb -gg_lines=1 --vcd=trace.vcd --ieee-asserts=disable --assert-level=error \
  >run.log || { cat run.log && exit 1; }
awk -f "$root/tb/timing/figure17.awk" trace.vcd >rows.txt
LC_ALL=C.UTF-8 gnuplot -e "rows = 'rows.txt'; picture = 'plot.svg'" "$root/tb/timing/figure17.gnuplot"

# gnuplot 5.4 cannot be told what a picture's title and description are, and names each curve in a title.
words=$(awk '/^# /{ on = $2 == "words"; next } on && NF' rows.txt | tr '\n' ' ')
title='Timing of the line interpolator, ROM and multiplier: two stages that overlap'
sed -e 's|^<svg *$|<svg role="img"|' -e "s|<title>Gnuplot</title>|<title>$title</title>|" \
  -e "s|<desc>\(Produced by .*[^ ]\) *</desc>|<desc>$words</desc>\n<!-- \1 -->|" \
  -e 's|\(<g id="gnuplot_plot_[0-9]*" >\)<title>.*</title>|\1|' plot.svg >figure17.svg

if ! $check; then
  cp figure17.svg "$gallery"
  echo "sim/gallery/figure17.svg: written"
  exit 0
fi

fail() {
  echo "figure17: $1" >&2
  exit 1
}
# Each value that stands long enough to be written into the picture, as often as the trace has it.
awk '/^# /{ on = $2 == "values"; next } on && NF && $3 - $2 > 10 { print $6 }' rows.txt | sort >expected.txt
sed -n 's|.*<tspan[^>]*> *\([^< ]*\)</tspan>.*|\1|p' figure17.svg | sort >written.txt
if [ "$(wc -l <expected.txt)" -lt 20 ]; then fail "the trace has $(wc -l <expected.txt) values: see rows.txt in $1"; fi
comm -23 expected.txt written.txt >lost.txt
if [ -s lost.txt ]; then fail "the picture lacks values of the trace: $(tr '\n' ' ' <lost.txt)"; fi

if cmp -s figure17.svg "$gallery"; then exit 0; fi
grep '<desc>' figure17.svg >text.txt
grep '<desc>' "$gallery" >gallery_text.txt || fail "$gallery has no description: run make figure17"
diff gallery_text.txt text.txt >&2 || fail "$gallery shows other values than the trace: run make figure17"
drawn_by=$(sed -n 's/<!-- Produced by \(.*\) -->/\1/p' "$gallery")
here=$(sed -n 's/<!-- Produced by \(.*\) -->/\1/p' figure17.svg)
if [ "$drawn_by" != "$here" ]; then
  echo "figure17: the values agree; $drawn_by drew the gallery's picture, this is $here: not compared byte for byte" >&2
  exit 77
fi
fail "$gallery is not what is drawn from the trace: run make figure17"
