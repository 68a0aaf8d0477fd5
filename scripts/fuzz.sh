#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs libFuzzer's targets of build/sanitize and prints a table of what they found.
#
#   scripts/fuzz.sh SECONDS JOBS [TARGET...]   none named: all, each for that many seconds, JOBS at a time
#
# Corpora grow in build/fuzz/corpus; what crashes, hangs or takes too much memory lies in build/fuzz/crashes.
# Exit codes: 0 nothing found, 1 something found, 2 bad usage, 3 a target did not run.
set -eu
export LC_ALL=C
cd "$(dirname "$0")/.."

build=build/fuzz
inputs=tb/inputs/random

# Run one target to its end; the details are in its log.
if [ "${1-}" = --one ]; then
  target=$2
  seconds=$3
  mkdir -p "$build/corpus/$target" "$build/tmp/$target"
  dictionary=$inputs/dictionaries/$target.dict
  # The report has a separate log, without the output of libFuzzer.
  log_path=$PWD/$build/logs/$target.report
  rm -f "$log_path".*
  status=0
  TMPDIR=$PWD/$build/tmp/$target ASAN_OPTIONS="log_path=$log_path:detect_leaks=1" \
    UBSAN_OPTIONS="print_stacktrace=1:log_path=$log_path" \
    "build/sanitize/tb/inputs/random/fuzz_$target" "-max_total_time=$seconds" -timeout=20 -report_slow_units=10 -rss_limit_mb=3000 \
    -max_len=8192 -len_control=20 -print_final_stats=1 "-artifact_prefix=$build/crashes/$target-" \
    $([ ! -f "$dictionary" ] || echo "-dict=$dictionary") \
    "$build/corpus/$target" "$inputs/seeds/$target" "$inputs/regressions/$target" \
    >"$build/logs/$target.log" 2>&1 </dev/null || status=$?
  rm -rf "$build/tmp/$target"
  echo "$status" >"$build/logs/$target.status"
  exit 0
fi

seconds=${1-}
jobs=${2-}
case $seconds$jobs in '' | *[!0-9]*) echo 'usage: scripts/fuzz.sh SECONDS JOBS [TARGET...]' >&2 && exit 2 ;; esac
shift 2
[ $# != 0 ] || set -- $(ls "$inputs/seeds")
for target in "$@"; do
  [ -d "$inputs/seeds/$target" ] || {
    echo "fuzz: no target $target; there are: $(ls "$inputs/seeds" | tr '\n' ' ')" >&2
    exit 2
  }
done
mkdir -p "$build/logs" "$build/crashes"
for target in "$@"; do rm -f "$build/logs/$target.log" "$build/logs/$target.status"; done
printf '%s\n' "$@" | xargs -P "$jobs" -I '{}' sh "$0" --one '{}' "$seconds"

worst=0
printf '%-9s %8s %11s %8s %8s %8s  %s\n' target seconds executions corpus edges crashes state
for target in "$@"; do
  log=$build/logs/$target.log
  status=$(cat "$build/logs/$target.status" 2>/dev/null || echo 3)
  last() { sed -n "s/.*$1 *\([0-9][0-9]*\).*/\1/p" "$log" | tail -n 1; }
  crashes=$(find "$build/crashes" -name "$target-*" ! -name "$target-slow-unit-*" | wc -l)
  reports=$(cat "$build/logs/$target.report."* 2>/dev/null | grep -cE 'runtime error:|^ *#0 .* in halfway::') || true
  state=clean
  if [ "$crashes" != 0 ] || [ "$reports" != 0 ]; then
    state="see $build/crashes/$target-* and $build/logs/$target.*"
    [ "$worst" != 0 ] || worst=1
  elif [ "$status" != 0 ]; then
    state="ended with $status, see $log"
    worst=3
  fi
  printf '%-9s %8s %11s %8s %8s %8s  %s\n' "$target" "$(last 'Done [0-9]* runs in')" "$(last number_of_executed_units:)" \
    "$(find "$build/corpus/$target" -type f | wc -l)" "$(last 'cov:')" "$crashes" "$state"
done
exit "$worst"
