#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The Verilog of `halfway verilog`, without and with AXI4-Stream ports: Verilator's lint, Icarus and Yosys take it; in
# Icarus it draws the golden model's fragments; with AXI4-Stream ports no output depends on an input in the same clock.
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

check() { # top file-of-words bits flag
  "$halfway" verilog "$scene" --shader "$shader" --out . $4 >/dev/null
  list=$(echo ./*/"$1".f)
  key=$(dirname "$list")
  sed "s#^#$key/#" "$list" >"$1.files"
  # Modules of the user's own, with the names of the VHDL's entities.
  sed -n 's/^module \(halfway_\)*\(.*\)/module \2 (output foreign); endmodule/p' "$(cat "$1.files")" >"$1.foreign.v"
  echo "$1.foreign.v" >>"$1.files"
  # GHDL's state machines cause the first two warnings, copies of a grey colour the third.
  verilator --lint-only -Wno-COMBDLY -Wno-CASEINCOMPLETE -Wno-UNOPTFLAT --top-module "$1" -f "$1.files"
  yosys -q -p "read_verilog $(tr '\n' ' ' <"$1.files"); hierarchy -check -top $1; proc; check -assert"
  iverilog -g2005 -Wall -Wno-timescale -s shader_tb -o "$1.vvp" -DTOP="$1" -DFILE="\"$2\"" -DBITS="$3" \
    -DCOUNT="$(wc -l <"$2")" ${4:+-DAXI} "$root/tb/project/verilog/shader_tb.v" -c "$1.files"
  vvp -n "$1.vvp" | awk 'NF != 7 || $0 !~ /^[0-9 ]*$/ { if ($0 !~ /finish/) print > "/dev/stderr"; next } { print }' >"$1.txt"
  cmp golden.txt "$1.txt" || { echo "verilog: $1: not the golden fragments"; exit 1; }
}
check "halfway_${shader}_shader" vectors.hex "$bits" ""
top=halfway_words_to_fragments
check $top packets.hex 32 --axi
# The page lists every port.
sed -n 's#^//   \(input\|output\) .* ##p' "$(head -n 1 $top.files)" >ports.txt
[ "$(wc -l <ports.txt)" -gt 10 ] || { echo "verilog: $top: no list of ports"; exit 1; }
while read -r port; do
  grep -q "^|.*\`$port\`.*|" "$root/docs/rtl/axi.md" || { echo "verilog: docs/rtl/axi.md lacks the port $port"; exit 1; }
done <ports.txt
yosys -q -p "read_verilog $(tr '\n' ' ' <$top.files); hierarchy -top $top; proc; flatten; opt_clean; memory -nomap; \
  delete t:\$dff t:\$sdff* t:\$dffe t:\$adff* t:\$mem*; select -assert-none o:* i:* %coe* %i" ||
  { echo "verilog: $top: an output depends on an input in the same clock"; exit 1; }
echo "verilog.sh: $shader passed with $(wc -l <golden.txt) fragments"
