#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The clocks in docs/rtl/processors.md, and in the header of light_term, must be those of terms_pkg and schedule_pkg,
# which tb/illumination/block_clocks.vhd prints.
# block_clocks.sh check|write ROOT FOLDER: `write` mends the page's table of blocks.
set -eu
mode=$1 root=$2 folder=$3
page=$root/docs/rtl/processors.md
mkdir -p "$folder"
cd "$folder"
wrong=0

# Print the clocks.
# shellcheck disable=SC2046 # one word per file
ghdl -a --std=08 $(sed -n "s,.*_pkg\.vhd$,$root/rtl/&,p" "$root/rtl/files.f") "$root/tb/illumination/block_clocks.vhd"
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

# Compare the table: its last four columns must be the printed ones.
awk -F ' \\| ' '
  NR == FNR { if (sub(/^block: /, "")) { name = $1; sub(/^[^|]* \| /, ""); clocks[name] = $0 } next }
  { name = substr($1, 3) }
  /^\| / && name in clocks && NF >= 7 { $0 = "| " name " | " $2 " | " $3 " | " clocks[name] " |"; ++rows; delete clocks[name] }
  { print }
  END { for (name in clocks) { print "no row " name >"/dev/stderr"; exit 1 } }' printed.txt "$page" >page.md || wrong=1
if ! cmp -s page.md "$page"; then
  if [ "$mode" = write ] && [ $wrong = 0 ]; then
    cat page.md >"$page"
    echo "$page: the clocks of the blocks are written"
  else
    echo "$page: has not the clocks of terms_pkg and schedule_pkg; make evidence writes them:"
    diff "$page" page.md || true
    wrong=1
  fi
fi

[ $wrong = 0 ] || exit 1
echo 'block_clocks: passed'
