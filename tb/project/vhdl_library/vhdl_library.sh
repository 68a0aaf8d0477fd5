#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A user's design takes the tops from the library halfway, next to units of its own that have the names of the RTL's
# units. Each top stops a simulation that breaks the contract of its ports.
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
check() { # top fault status message
  status=0
  ghdl --elab-run --std=08 -P"$library" vhdl_library_tb -gg_top="$1" -gg_fault="$2" --ieee-asserts=disable \
    >log.txt 2>&1 || status=1
  [ $status = "$3" ] && grep "$4" log.txt || { cat log.txt; echo "vhdl_library.sh: $1: $2"; exit 1; }
}
# Each top, and how the report names its stream.
while read -r top stream; do
  check "$top" none 0 'vhdl_library_tb: .* words'
  check "$top" valid 1 "$stream: valid or data changes while the word waits"
  check "$top" data 1 "$stream: valid or data changes while the word waits"
done <<END
words_to_fragments words_to_fragments: s_axis
quadratic_shader stream_register: in
spherical_shader stream_register: in
processors_shader stream_register: in
fragments_to_memory fragments_to_memory: s_axis
memory_port memory_port: s_axi_aw
halfway_core register_port: s_axi_w
END
check fragments_to_memory frame 1 "fragments_to_memory: frame changes while busy = '1'"
check fragments_to_memory wrong 1 'fragments_to_memory: m_axi_b: an answer without a request'
check halfway_core wrong 1 'halfway_core: m_axi_r: an answer without a request'
check memory_port wrong 1 'memory_port: s_axi: an address is not that of a word'
echo "vhdl_library.sh: passed"
