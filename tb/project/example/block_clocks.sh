#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes the table of blocks in docs/rtl/processors.md from the clocks of terms_pkg and schedule_pkg, which
# tb/rtl/illumination/block_clocks.vhd prints. Fails if the code blocks there and in the header of light_term have others.
# block_clocks.sh ROOT FOLDER
set -eu
root=$1 folder=$2
page=$root/docs/rtl/processors.md
mkdir -p "$folder"
cd "$folder"
wrong=0

# Print the clocks.
# shellcheck disable=SC2046 # one word per file
ghdl -a --std=08 $(sed -n "s,.*_pkg\.vhd$,$root/rtl/&,p" "$root/rtl/files.f") "$root/tb/rtl/illumination/block_clocks.vhd"
ghdl --elab-run --std=08 block_clocks >printed.txt

# Compare the code blocks: their lines must follow each other in the page and in the header.
sed -n 's/^times: //p' printed.txt | sed 's/ *$//' >times.txt
for file in "$page" "$root/rtl/illumination/light_term.vhd"; do
  sed 's/^-- *\(published\|exact\|L\|H\|(N\.A)\*\*x\|weight\|terms\)  /\1  /; s/^-- *\(diffuse specular  \)/            \1/; s/^--$//' \
    "$file" >quoted.txt
  awk 'NR == FNR { wanted[++count] = $0; next }
    { at = $0 == wanted[at + 1] ? at + 1 : $0 == wanted[1] }
    at == count { found = 1; exit }
    END { exit !found }' times.txt quoted.txt || { echo "$file: has not these lines:"; cat times.txt; wrong=1; }
done

# Write the table: its last four columns are the printed ones.
awk -F ' \\| ' '
  NR == FNR { if (sub(/^block: /, "")) { name = $1; sub(/^[^|]* \| /, ""); clocks[name] = $0 } next }
  { name = substr($1, 3) }
  /^\| / && name in clocks && NF >= 7 { $0 = "| " name " | " $2 " | " $3 " | " clocks[name] " |"; ++rows; delete clocks[name] }
  { print }
  END { for (name in clocks) { print "no row " name >"/dev/stderr"; exit 1 } }' printed.txt "$page" >page.md || wrong=1
[ $wrong = 0 ] || exit 1
cat page.md >"$page"
echo 'block_clocks: passed'
