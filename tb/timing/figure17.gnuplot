# SPDX-License-Identifier: Apache-2.0
# Draws figure 17 from what figure17.awk writes: gnuplot -e "rows = 'FILE'; picture = 'FILE'" figure17.gnuplot
set encoding utf8
set terminal svg size 1080,590 dynamic enhanced font "sans-serif,13" background "#ffffff"
set output picture

# Lanes from the top down, one unit high.
lane(name) = name eq "step" ? 9.7 : name eq "init" ? 8.8 : \
  name eq "sum" ? 7 : name eq "next_angle" ? 6 : name eq "angle" ? 5 : \
  name eq "ra" ? 3.2 : name eq "sample" ? 2.2 : 1.2
half = 0.31

# A pixel keeps its colour from lane to lane, pale at rest and full at work; what belongs to none is grey.
pales = "0xcfe4f7 0xd2eecb 0xfde1c2 0xe6d9f5 0xededed"
fulls = "0x7ab4e6 0x86cf76 0xf6ae5f 0xb897e0 0xc4c4c4"
number(pixel) = pixel < 0 || pixel > 3 ? 5 : int(pixel) + 1
pale(pixel) = int(word(pales, number(pixel)))
full(pixel) = int(word(fulls, number(pixel)))
ink = "#1f2328"
faint = "#8b949e"
bright = 0xfff1a3

constant(name) = system(sprintf("sed -n 's/^%s //p' '%s'", name, rows))

set margins 0, 0, 0, 0
set lmargin at screen 0.15
set rmargin at screen 0.985
set tmargin at screen 0.985
set bmargin at screen 0.165
set xrange [0:constant("end") + 0]
set yrange [0.6:11.7]
unset key
unset ytics
set border 1 linecolor rgb ink
set xtics 0, 30 out nomirror scale 0.7, 0.35 textcolor rgb ink offset 0, 0.3
set mxtics 6
set xlabel "time in ns" textcolor rgb ink offset 0, 0.7

array titles[8] = ["step", "init", "adder, + " . constant("slope"), "multiplexer", "register", "ra, its bits 11 to 6", \
  "ROM", "multiplier, × " . constant("factor")]
set for [i = 1:8] label i titles[i] at graph -0.012, \
  first lane(word("step init sum next_angle angle ra sample product", i)) right textcolor rgb ink
set label 9 "{/:Bold Stage 1}: line interpolator" at graph -0.138, first 7.85 left textcolor rgb ink
set label 10 "{/:Bold Stage 2}: ROM and multiplier" at graph -0.138, first 4.05 left textcolor rgb ink

# The legend, under the axis.
array swatches[4] = [pale(0), pale(-1), full(0), bright]
array meanings[4] = ["hexadecimal value, in its pixel's colour", "no pixel's", "new value forms, for 10 ns", \
  "both stages at work"]
array places[4] = [0.15, 0.472, 0.597, 0.829]
set for [i = 1:4] object i rectangle from screen places[i], 0.03 to screen places[i] + 0.026, 0.06 \
  fillcolor rgb swatches[i] fillstyle solid border linecolor rgb ink
set for [i = 1:4] label 10 + i meanings[i] at screen places[i] + 0.031, 0.045 left textcolor rgb ink
set label 15 "10" at screen places[3] + 0.013, 0.045 center font ",10" textcolor rgb ink front

set style fill solid noborder
plot \
  rows index "both" using 1:(4):1:2:(0.75):(7.5) with boxxyerror linecolor rgb bright, \
  rows index "pixels" using 2:(0.6):(0):(10.1) with vectors nohead linecolor rgb faint dashtype (3, 3), \
  rows index "pixels" using 2:(11.2):2:3:(10.95):(11.55):(pale($1)) with boxxyerror linecolor rgb variable, \
  rows index "pixels" using (($2 + $3) / 2):(11.25):(sprintf("pixel %d", $1)) with labels textcolor rgb ink, \
  rows index "steps" using 1:(10.5):($2 - $1):(0) with vectors heads filled size 3, 15 linecolor rgb ink, \
  rows index "steps" using (($1 + $2) / 2):(10.68):(sprintf("%g ns", $2 - $1)) with labels textcolor rgb ink, \
  rows index "values" using 2:(y = lane(strcol(1))):2:3:(y - half):(y + half):(pale($4)) \
    with boxxyerror linecolor rgb variable, \
  rows index "work" using 2:(y = lane(strcol(1))):2:3:(y - half):(y + half):(full($4)) \
    with boxxyerror linecolor rgb variable, \
  rows index "values" using 2:(y = lane(strcol(1))):2:3:(y - half):(y + half) \
    with boxxyerror fillstyle empty linecolor rgb ink, \
  rows index "wires" using 2:(lane(strcol(1)) + half * (2 * $4 - 1)):($3 - $2):(0) \
    with vectors nohead linecolor rgb ink linewidth 1.5, \
  rows index "wires" using ($2 > 0 ? $2 : NaN):(lane(strcol(1)) - half):(0):(2 * half) \
    with vectors nohead linecolor rgb ink linewidth 1.5, \
  rows index "values" using ($3 - $2 > 10 ? $5 : NaN):(lane(strcol(1))):6 with labels textcolor rgb ink, \
  rows index "work" using (($2 + $3) / 2):(lane(strcol(1))):(sprintf("%g", $3 - $2)) \
    with labels font ",10" textcolor rgb ink
