#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Unpacks Debian packages into a folder of their own, without installing them.
#
#   scripts/unpack.sh FOLDER PACKAGE...
#
# For `make bench`: ghdl-mcode, once installed, would be what `ghdl` means on this machine, for everything.
# Exit codes: 0 all packages are unpacked, 2 bad usage, 3 a package is not available.
set -eu
[ $# -ge 2 ] || { echo 'usage: scripts/unpack.sh FOLDER PACKAGE...' >&2 && exit 2; }
folder=$1
shift
if [ -d "$folder" ]; then exit 0; fi
mkdir -p "$(dirname "$folder")"
scratch=$(mktemp -d "$folder.part-XXXXXX")
trap 'rm -rf "$scratch"' EXIT
trap 'exit 3' INT TERM
if ! (
  cd "$scratch" && apt-get -q download "$@" || exit
  for package in *.deb; do dpkg-deb -x "$package" files || exit; done
) >"$scratch/log" 2>&1; then
  printf 'unpack: cannot be had: %s: %s\n' "$*" "$(tail -n 1 "$scratch/log")" >&2
  exit 3
fi
mv "$scratch/files" "$folder"
