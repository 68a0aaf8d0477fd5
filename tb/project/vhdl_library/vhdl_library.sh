#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A user's design takes the tops from the library halfway, next to units of its own that have the names of the RTL's
# units. Each top stops a simulation that breaks the contract of the stream that it takes. The core can be elaborated.
# vhdl_library.sh ROOT LIBRARY FOLDER: LIBRARY is the folder of the library halfway.
set -eu
root=$1 library=$2 folder=$3
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
sed -n -e 's#.*/\(.*_pkg\)\.vhd#package \1 is end package;#p;t' \
  -e 's#.*/\(.*\)\.vhd#entity \1 is port (foreign : in bit); end entity;#p' "$root/rtl/files.f" >foreign.vhd
grep -q 'entity multiplier ' foreign.vhd
ghdl -a --std=08 -P"$library" foreign.vhd "$root/tb/project/vhdl_library/vhdl_library_tb.vhd"
# Each top, and how the report names its stream.
while read -r top stream; do
  for fault in none valid data; do
    status=0
    ghdl --elab-run --std=08 -P"$library" vhdl_library_tb -gg_top="$top" -gg_fault=$fault --ieee-asserts=disable \
      >log.txt 2>&1 || status=1
    case $fault in
      none) [ $status = 0 ] && grep 'vhdl_library_tb: .* words' log.txt ;;
      *) [ $status = 1 ] && grep "$stream: valid or data changes while the word waits" log.txt ;;
    esac || { cat log.txt; echo "vhdl_library.sh: $top: $fault"; exit 1; }
  done
done <<END
words_to_fragments words_to_fragments: s_axis
quadratic_shader stream_register: in
spherical_shader stream_register: in
processors_shader stream_register: in
fragments_to_memory fragments_to_memory: s_axis
END
# The core alone, with its default generics.
ghdl --elab-run --std=08 --work=halfway --workdir="$library" halfway_core --no-run
echo "vhdl_library.sh: passed"
