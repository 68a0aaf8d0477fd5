#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# With a full disk a command must end with exit code 3 and a message with a file or folder and "No space left on
# device", and leave no incomplete file. Uses a small tmpfs in its own mount name space.
#
#   tb/inputs/files/disk.sh HALFWAY GENERATOR CHECKOUT SCRATCH
#
# Exit codes: 0 passed, 1 failed, 77 skipped because no tmpfs can be mounted.
set -u
if [ "${HALFWAY_DISK_INSIDE-}" = '' ]; then
  as_root=-r
  [ "$(id -u)" != 0 ] || as_root=
  mkdir -p "$4/disk"
  if ! unshare $as_root -m mount -t tmpfs -o size=1m tmpfs "$4/disk" 2>/dev/null; then
    echo 'disk.sh: no tmpfs can be mounted here; needs root, or user name spaces' >&2
    exit 77
  fi
  HALFWAY_DISK_INSIDE=1 exec unshare $as_root -m bash "$0" "$@"
fi
halfway=$(realpath "$1")
generator=$(realpath "$2")
checkout=$(realpath "$3")
scratch=$(realpath "$4")
disk=$scratch/disk
ulimit -c 0

failed=0
fail() {
  echo "disk.sh: $*" >&2
  failed=1
}

# Mount a disk of this size in KiB, of which the given number of KiB is free.
new_disk() { # size free
  umount "$disk" 2>/dev/null
  mount -t tmpfs -o "size=$1k" tmpfs "$disk" || exit 1
  head -c "$((($1 - $2) * 1024))" /dev/zero >"$disk/ballast"
}

# The core's sources are those that rtl/files.f lists; a cache's folder holds these and no others.
sums_of_list() { # checkout
  (cd "$1/rtl" && grep '\.vhd$' files.f | sort | xargs cksum)
}
sums_of_folder() { # folder
  (cd "$1" && find . -name '*.vhd' -printf '%P\n' | sort | xargs cksum)
}

# The command must fail with a full disk and leave only files that match the pattern.
expect_full() { # what allowed-pattern command...
  local what=$1 allowed=$2 status left
  shift 2
  "$@" >"$scratch/log" 2>&1
  status=$?
  [ "$status" = 3 ] || fail "$what: exit code $status: $(tail -n 3 "$scratch/log")"
  grep -q '/.*No space left on device' "$scratch/log" || fail "$what: does not say what is full: $(tail -n 3 "$scratch/log")"
  left=$(find "$disk" ! -type d ! -name ballast ! -name .lock | grep -Ev "$allowed")
  [ -z "$left" ] || fail "$what: files left over: $left"
  echo "$what: $(grep 'No space left on device' "$scratch/log" | tail -n 1)"
}

# Results: finished files may stay and must be complete. There must be no summary, because results are missing.
sim=("$halfway" sim spheres --size 160x120 --threads 1)
for free in 0 8 100 400 1000; do
  for simulator in ghdl verilator; do
    new_disk 4096 "$free"
    expect_full "sim by $simulator, $free KiB for results" '/(init.txt|[a-z]*\.trace|[a-z]*\.png)$' \
      "${sim[@]}" --simulator "$simulator" --out "$disk/out"
    for file in "$disk"/out/spheres/quadratic/*; do
      case $file in
        *.trace | */init.txt) tail -n 1 "$file" | grep -q '^end [0-9]*$' || fail "$file is cut off" ;;
      esac
    done
  done
done
new_disk 1024 0
expect_full 'init' '^$' "$halfway" init spheres --file "$disk/init.txt"
expect_full 'render' '^$' "$halfway" render spheres --size 160x120 --file "$disk/picture.png"
new_disk 1024 8
expect_full 'init, 8 KiB' '^$' "$halfway" init spheres --file "$disk/init.txt"
expect_full 'render, 8 KiB' '^$' "$halfway" render spheres --size 160x120 --file "$disk/picture.png"

# Caches of this project, then GHDL's.
rm -rf "$scratch/source"
mkdir -p "$scratch/source"
for part in rtl tb sim model; do ln -s "$checkout/$part" "$scratch/source/$part"; done
ln -s "$disk" "$scratch/source/build"
for free in 0 300 1200 2400; do
  new_disk 8192 "$free"
  # Files with their final names must be complete: the sources, and a netlist of them in VHDL and Verilog. The files
  # made from these did not fit.
  expect_full "cache, $free KiB" '/cache/ghdl/[0-9a-f]*/(rtl/[a-z_/]*\.vhd|netlists/[a-z_]*-[0-9a-f]*\.(v|vhd))$' \
    "$halfway" --source "$scratch/source" "${sim[@]:1}" --out "$scratch/out"
  for entry in "$disk"/cache/ghdl/[0-9a-f]*/rtl; do
    [ ! -d "$entry" ] || [ "$(sums_of_folder "$entry")" = "$(sums_of_list "$checkout")" ] || fail "$entry is not whole"
  done
  for entry in "$disk"/cache/ghdl/[0-9a-f]*/netlists/*.v*; do
    [ ! -f "$entry" ] || grep . "$entry" | tail -n 1 | grep -qx 'endmodule\|end rtl;' || fail "$entry is not whole"
  done
done

# Tables: the old files must be unchanged.
new_disk 4096 4096
mkdir -p "$disk/rtl/tables" "$disk/docs/rtl"
"$generator" --source "$disk" tables >/dev/null || fail 'tables with room'
before=$(cd "$disk" && cksum rtl/tables/* docs/rtl/*)
head -c 4194304 /dev/zero >"$disk/ballast" 2>/dev/null
expect_full tables '/(rtl/tables|docs/rtl)/[a-z_-]*\.[a-z]*$' "$generator" --source "$disk" tables \
  --preset published --cosine 5x6
[ "$before" = "$(cd "$disk" && cksum rtl/tables/* docs/rtl/*)" ] || fail 'tables: a file has changed'
umount "$disk"

# A read-only folder is bad usage, not a full disk. Root can write to all folders except on a read-only mount.
mount -t tmpfs -o ro tmpfs "$disk" || exit 1
for command in "${sim[*]} --out $disk/out" "$halfway render matte --size 24x18 --file $disk/x.png" \
  "$halfway init matte --size 24x18 --file $disk/x.txt"; do
  $command >"$scratch/log" 2>&1
  status=$?
  [ "$status" = 2 ] || fail "read-only: exit code $status of $command: $(tail -n 1 "$scratch/log")"
  grep -q "$disk.*Read-only file system" "$scratch/log" || fail "read-only: $command says $(tail -n 1 "$scratch/log")"
done
umount "$disk"
exit "$failed"
