#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# kill -9 at random moments. No incomplete file may count as complete, and the next run must give the same results as an
# undisturbed run.
#
#   tb/inputs/files/kill.sh HALFWAY GENERATOR CHECKOUT SCRATCH [KILLS [SEED]]
#
# Exit codes: 0 passed, 1 failed.
set -u
halfway=$(realpath "$1")
generator=$(realpath "$2")
checkout=$(realpath "$3")
mkdir -p "$4"
scratch=$(realpath "$4")
kills=${5:-6}
RANDOM=${6:-$(date +%N | sed 's/^0*//')}
printf 'seed %s\n' "${6:-$RANDOM}"
RANDOM=${6:-$RANDOM}
ulimit -c 0

failed=0
fail() {
  echo "kill.sh: $*" >&2
  failed=1
}

# Runs a command in its own process group and kills the group after the given time.
kill_after() { # milliseconds command...
  local after=$1
  shift
  setsid "$@" >"$scratch/log" 2>&1 &
  local group=$!
  sleep "$(printf '%d.%03d' $((after / 1000)) $((after % 1000)))"
  kill -KILL -- "-$group" 2>/dev/null
  wait "$group" 2>/dev/null
}

# The same, but kills the group when the file exists under its final or its temporary name.
kill_at() { # file command...
  local file=$1
  shift
  setsid "$@" >"$scratch/log" 2>&1 &
  local group=$!
  while kill -0 "$group" 2>/dev/null && ! compgen -G "$file*" >/dev/null; do sleep 0.002; done
  kill -KILL -- "-$group" 2>/dev/null
  wait "$group" 2>/dev/null
}

# A complete text file has its last line, a complete PNG its last chunk.
check_files() { # folder
  local file
  for file in "$1"/*; do
    case $file in
      *.part*) ;;
      *.trace | */init.txt) tail -n 1 "$file" | grep -q '^end [0-9]*$' || fail "$file is cut off" ;;
      *.png) [ "$(tail -c 8 "$file" | od -An -tx1 | tr -d ' \n')" = 49454e44ae426082 ] || fail "$file is cut off" ;;
    esac
  done
}

# Print the results without measured seconds, which differ from run to run.
results() { # folder
  sed -e '/seconds"/d' -e 's/, *$//' "$1/summary.json"
  (cd "$1" && cksum init.txt ./*.trace ./*.png)
}

draw=(sim matte --size 320x240 --threads 1)

# ---- make sim and its caches
rm -rf "$scratch/source" "$scratch/out" "$scratch/calm"
mkdir -p "$scratch/source"
for part in rtl tb sim model; do ln -s "$checkout/$part" "$scratch/source/$part"; done
"$halfway" "${draw[@]}" --out "$scratch/calm" >/dev/null || fail "the undisturbed run"
folder=$scratch/out/matte/quadratic
run=("$halfway" --source "$scratch/source" "${draw[@]}" --out "$scratch/out")
check_run() {
  [ -d "$folder" ] || return
  check_files "$folder"
  "$halfway" compare matte --out "$scratch/out" >"$scratch/log" 2>&1
  local status=$?
  if [ -f "$folder/summary.json" ]; then
    [ "$status" = 0 ] || fail "a run that left its summary is not whole: $(cat "$scratch/log")"
  else
    [ "$status" = 2 ] || fail "compare takes a broken run for whole: exit code $status"
  fi
}
for ((i = 0; i < kills; ++i)); do
  # The first half of the kills interrupts the building of caches. With complete caches a run is much shorter.
  if ((2 * i < kills)); then moment=$((RANDOM % 6000 + 100)); else moment=$((RANDOM % 900 + 20)); fi
  printf 'sim: killed after %d ms\n' "$moment"
  kill_after "$moment" "${run[@]}"
  check_run
  if ((2 * i + 2 == kills)) || ((2 * i + 1 == kills)); then
    "${run[@]}" >"$scratch/log" 2>&1 || fail "the run between: $(cat "$scratch/log")"
    check_run
  fi
done
for file in init.txt golden.trace verilator.trace golden.png ghdl.trace reference.png; do
  rm -rf "$scratch/out"
  printf 'sim: killed at %s\n' "$file"
  kill_at "$folder/$file" "${run[@]}"
  check_run
done
"${run[@]}" >"$scratch/log" 2>&1 || fail "the last run: $(cat "$scratch/log")"
cmp <(results "$scratch/calm/matte/quadratic") <(results "$folder") || fail "results differ from the undisturbed run's"
left=$(find "$folder" -name '*part*' -o -name '.halfway-*')
[ -z "$left" ] || fail "files left over: $left"

# ---- make tables, alternately with two sizes
tree=$scratch/tree
sizes=(--preset published --cosine 5x6)
tables() { "$generator" --source "$1" tables "${@:2}"; }
for copy in tree usual other; do
  rm -rf "${scratch:?}/$copy"
  mkdir -p "$scratch/$copy/rtl/tables"
done
tables "$scratch/usual" >/dev/null && tables "$scratch/other" "${sizes[@]}" >/dev/null && tables "$tree" >/dev/null ||
  fail "the undisturbed tables"
for ((i = 0; i < 3 * kills; ++i)); do
  moment=$((RANDOM % 60 + 2))
  printf 'tables: killed after %d ms\n' "$moment"
  if ((i % 2 == 0)); then wanted=("${sizes[@]}"); else wanted=(); fi
  kill_after "$moment" "$generator" --source "$tree" tables "${wanted[@]}"
  for file in "$tree"/rtl/tables/*.vhd; do
    name=${file#"$tree"/}
    cmp -s "$file" "$scratch/usual/$name" || cmp -s "$file" "$scratch/other/$name" || fail "$name is of neither size"
  done
done
# Temporary files older than a minute count as abandoned.
find "$tree" -name '*.part-*' -exec touch -d '2 minutes ago' {} +
tables "$tree" "${sizes[@]}" >/dev/null && tables "$tree" >/dev/null || fail "the last tables"
diff -r "$scratch/usual" "$tree" >/dev/null || fail "the tables differ from the undisturbed run's, or a file is left over"
exit "$failed"
