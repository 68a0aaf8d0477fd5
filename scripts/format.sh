#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Formats C++ with clang-format and VHDL with `ghdl fmt`.
#
#   scripts/format.sh [--check]   --check changes nothing and names what would change
#
# The style is that of Debian 13's versions; others break some lines and indent some blocks in another way.
#
# Exit codes: 0 all is formatted, 1 something is not or cannot be, 2 bad usage, 3 a formatter is missing or of another version.
set -eu
export LC_ALL=C
cd "$(dirname "$0")/.."

check=false
case "$#:${1-}" in
  0:) ;;
  1:--check) check=true ;;
  *)
    echo "usage: scripts/format.sh [--check]" >&2
    exit 2
    ;;
esac

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
bad=0
lacks_tool=0

# True if the tool is there, in this main version.
has() { # tool version
  if ! command -v "$1" >/dev/null; then
    echo "format: $1 is missing; scripts/setup.sh tools installs what formatting needs" >&2
  elif ! "$1" --version | head -n 1 | grep -q "[^0-9.]$2\."; then
    echo "format: $1 must be version $2, that of Debian 13; here is $("$1" --version | head -n 1)" >&2
  else
    return 0
  fi
  lacks_tool=1
  return 1
}

report() { # file what
  echo "$1: $2" >&2
  bad=1
}

# Files written by hand whose names match, one per line. What `make tables` writes is check-tables' business.
sources() { # pattern
  # grep -L's exit code means different things in different versions.
  find model sim rtl tb docs -type f | grep -E "$1" | tr '\n' '\0' |
    { xargs -0 grep -L '^\(//\|--\) Made by .make tables' || true; } | sort
}

format_cpp() {
  has clang-format 19 || return 0
  sources '\.(cpp|hpp|h)$' | tr '\n' '\0' >"$scratch/cpp"
  if [ ! -s "$scratch/cpp" ]; then return; fi
  if ! $check; then
    xargs -0 clang-format -i <"$scratch/cpp" || bad=1
  elif ! xargs -0 clang-format --dry-run -Werror <"$scratch/cpp" 2>"$scratch/errors"; then
    awk -F : '/: error: / && !seen[$1]++ { print $1 ":" $2 ": not formatted: run make format" }' "$scratch/errors" >&2
    bad=1
  fi
}

# Every VHDL file so that units come before their users.
compile_order() {
  for list in rtl/files.f rtl/board/files.f; do
    sed -e 's/[#].*//' -e 's/ *$//' -e '/^$/d' -e "s|^|$(dirname "$list")/|" "$list"
  done
  find rtl tb -type f -name '*_pkg.vhd' | sort
  find tb/rtl/stream tb/rtl/board -type f -name '*.vhd' ! -name '*_tb.vhd' ! -name '*_checker.vhd' | sort
  find rtl tb docs -type f -name '*.vhd' ! -name '*_tb.vhd' | sort
  find rtl tb -type f -name '*_tb.vhd' | sort
}

# `ghdl fmt` needs the units that a file uses, analysed since version 5. It drops comments after the last `end`, which compare-tokens does not see.
format_vhdl() {
  has ghdl 5 || return 0
  sources '\.vhd$' >"$scratch/vhdl"
  compile_order | awk '!seen[$0]++' >"$scratch/order"
  mkdir "$scratch/work" "$scratch/halfway"
  # The designs of users take the RTL from the library halfway.
  sed 's|^|rtl/|' rtl/files.f | xargs ghdl -a --std=08 --work=halfway --workdir="$scratch/halfway" >"$scratch/errors" 2>&1 || true
  # Its messages for a broken file are repeated below.
  while read -r file; do if [ -f "$file" ]; then printf '%s\0' "$file"; fi; done <"$scratch/order" |
    xargs -0 ghdl -a --std=08 --workdir="$scratch/work" -P"$scratch/halfway" >"$scratch/errors" 2>&1 || true
  while read -r file; do
    if [ ! -f "$file" ]; then
      report "$file" "rtl/files.f lists it, but the file does not exist: correct the list"
      continue
    fi
    if ! ghdl -s --std=08 --workdir="$scratch/work" -P"$scratch/halfway" "$file" 2>"$scratch/errors"; then
      cat "$scratch/errors" >&2
      report "$file" "GHDL cannot analyse it: mend that first"
      continue
    fi
    if ! grep -qxF -e "$file" "$scratch/vhdl"; then continue; fi
    if ! ghdl fmt --std=08 --workdir="$scratch/work" -P"$scratch/halfway" "$file" >"$scratch/new.vhd" 2>"$scratch/errors" ||
      ! ghdl compare-tokens "$file" "$scratch/new.vhd" >"$scratch/errors" 2>&1; then
      cat "$scratch/errors" >&2
      report "$file" "ghdl fmt failed"
    elif [ "$(grep -c -e -- "$file")" != "$(grep -c -e -- "$scratch/new.vhd")" ]; then
      report "$file" "ghdl fmt would drop a comment after the last 'end': move it up"
    elif cmp -s "$file" "$scratch/new.vhd"; then
      :
    elif $check; then
      line=$(cmp "$file" "$scratch/new.vhd" 2>&1 | sed 's/.*line \([0-9]*\).*/\1/')
      report "$file:$line" "not formatted: run make format"
    else
      mkdir -p "$scratch/formatted/$(dirname "$file")"
      cp "$scratch/new.vhd" "$scratch/formatted/$file"
    fi
  done <"$scratch/order"
  # Only now: GHDL refuses units whose file has changed since.
  if [ -d "$scratch/formatted" ]; then cp -R "$scratch/formatted/." .; fi
}

format_cpp
format_vhdl
if [ "$bad" != 0 ]; then exit 1; fi
if [ "$lacks_tool" != 0 ]; then exit 3; fi
