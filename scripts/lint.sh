#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# clang-tidy on each C++ file of the build: lint.sh BUILD JOBS [PART_OF_PATH]
set -eu
build=$1 jobs=$2 part=${3:-}
files=$(sed -n 's/^ *"file": "\(.*\)",\{0,1\}$/\1/p' "$build/compile_commands.json" | sort -u | grep -F -- "$part" |
  grep -v "/$build/" || true)
[ -n "$files" ] || { echo "lint: no C++ file has '$part' in its path" >&2; exit 2; }
echo "$files" | xargs -P "$jobs" -n 4 clang-tidy -p "$build" --quiet --warnings-as-errors='*' || {
  echo 'lint: clang-tidy found faults' >&2
  exit 1
}
