#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The Verilog of `halfway verilog`, without and with AXI4-Stream ports, and the whole core: Verilator's lint, Icarus and
# Yosys take it; in Icarus it draws the golden model's fragments, the core into memory; with AXI4-Stream ports, and of the
# core, no output depends on an input in the same clock.
#   verilog.sh HALFWAY ROOT FOLDER SHADER
set -eu
halfway=$1 root=$2 folder=$3 shader=$4
for tool in iverilog verilator yosys; do
  command -v $tool >/dev/null || { echo "$tool: is missing; install it with: apt-get install $tool"; exit 3; }
done
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
scene="$root/sim/report/timing.toml"
"$halfway" init "$scene" --size 16x12 --shader "$shader" --file init.txt >/dev/null
grep -v '[^0-9a-f]' init.txt >vectors.hex
"$halfway" init "$scene" --size 16x12 --shader "$shader" --packets --file packets.hex >/dev/null
bits=$(awk 'NR == 1 { print $4 }' init.txt)
"$halfway" sim "$scene" --size 16x12 --shader "$shader" --simulator ghdl --out out >/dev/null
awk 'NF == 7' out/timing/"$shader"/golden.trace >golden.txt
[ "$(wc -l <golden.txt)" -gt 40 ] || { echo "verilog: $shader: few golden fragments"; exit 1; }

check() { # top flag testbench defines...
  "$halfway" verilog "$scene" --shader "$shader" --out . $2 >/dev/null
  list=$(echo ./*/"$1".f)
  key=$(dirname "$list")
  sed "s#^#$key/#" "$list" >"$1.files"
  # Modules of the user's own, with the names of the VHDL's entities.
  sed -n 's/^module \(halfway_\)*\(.*\)/module \2 (output foreign); endmodule/p' "$(cat "$1.files")" >"$1.foreign.v"
  echo "$1.foreign.v" >>"$1.files"
  # GHDL's state machines cause the first two warnings, copies of a grey colour the third; in the core, comparisons with a
  # block's first and last pixel the last two.
  verilator --lint-only -Wno-COMBDLY -Wno-CASEINCOMPLETE -Wno-UNOPTFLAT -Wno-CMPCONST -Wno-UNSIGNED --top-module "$1" -f "$1.files"
  yosys -q -p "read_verilog $(tr '\n' ' ' <"$1.files"); hierarchy -check -top $1; proc; check -assert"
  top=$1 bench=$3
  shift 3
  iverilog -g2005 -Wall -Wno-timescale -s "$bench" -o "$top.vvp" "$@" "$root/tb/project/verilog/$bench.v" -c "$top.files"
  vvp -n "$top.vvp" | awk '$0 !~ /^[0-9 ]+$/ { if ($0 !~ /finish/) print > "/dev/stderr"; next } { print }' >"$top.txt"
}
words() { echo "-DFILE=\"$1\" -DCOUNT=$(wc -l <"$1")"; }
draws() { # top golden
  cmp "$2" "$1.txt" || { echo "verilog: $1: not the golden picture"; exit 1; }
}
top=halfway_${shader}_shader
check "$top" "" shader_tb -DTOP="$top" $(words vectors.hex) -DBITS="$bits"
draws "$top" golden.txt
# The nearest fragment of each pixel, its colour cut to RGB565, its depth to 16 bits.
awk '{ p = sprintf("%d %d", $2, $3); z = int($4 / 256)
       if (!(p in nearest) || z < nearest[p]) { nearest[p] = z; colour[p] = int($5 / 8) " " int($6 / 4) " " int($7 / 8) } }
     END { for (p in colour) if (colour[p] != "0 0 0") print p, colour[p] }' golden.txt | sort -n -k 1,1 -k 2,2 >pixels.txt
check halfway_core --core core_tb $(words packets.hex) -DWIDTH=16 -DHEIGHT=12
draws halfway_core pixels.txt
top=halfway_words_to_fragments
check $top --axi shader_tb -DTOP="$top" $(words packets.hex) -DBITS=32 -DAXI
draws $top golden.txt
# The page lists every port.
sed -n 's#^//   \(input\|output\) .* ##p' "$(head -n 1 $top.files)" >ports.txt
[ "$(wc -l <ports.txt)" -gt 10 ] || { echo "verilog: $top: no list of ports"; exit 1; }
while read -r port; do
  grep -q "^|.*\`$port\`.*|" "$root/docs/rtl/axi.md" || { echo "verilog: docs/rtl/axi.md lacks the port $port"; exit 1; }
done <ports.txt
for top in $top halfway_core; do
  yosys -q -p "read_verilog $(tr '\n' ' ' <$top.files); hierarchy -top $top; proc; flatten; opt_clean; memory -nomap; \
    delete t:\$dff t:\$sdff* t:\$dffe t:\$adff* t:\$mem*; select -assert-none o:* i:* %coe* %i" ||
    { echo "verilog: $top: an output depends on an input in the same clock"; exit 1; }
done
echo "verilog.sh: $shader passed with $(wc -l <golden.txt) fragments"
