#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Runs at the same time in one checkout: each must succeed with the results of a single run.
#
#   tb/inputs/files/together.sh HALFWAY GENERATOR CHECKOUT SCRATCH
#
# Exit codes: 0 passed, 1 failed.
set -u
halfway=$(realpath "$1")
generator=$(realpath "$2")
checkout=$(realpath "$3")
rm -rf "${4:?}"
mkdir -p "$4"
scratch=$(realpath "$4")

failed=0
fail() {
  echo "together.sh: $*" >&2
  failed=1
}
results() { # out scene
  (cd "$1/$2/quadratic" && sed -e '/seconds"/d' -e 's/, *$//' summary.json && cksum init.txt ./*.trace ./*.png)
}

draw=(--size 128x96 --threads 2)
"$halfway" sim matte spheres "${draw[@]}" --out "$scratch/alone" >/dev/null || fail 'the run alone'

# Two runs of the same scenes, one of a single scene, and runs of make tables; the checkout's tables must not change.
pids=()
names=()
start() {
  "$@" >"$scratch/log-${#pids[@]}" 2>&1 &
  pids+=($!)
  names+=("$*")
}
start "$halfway" sim matte spheres "${draw[@]}" --out "$scratch/out"
start "$halfway" sim spheres matte "${draw[@]}" --out "$scratch/out"
start "$halfway" sim matte "${draw[@]}" --out "$scratch/out"
start "$generator" --source "$checkout" tables --check
mkdir -p "$scratch/tree/rtl/tables"
start "$generator" --source "$scratch/tree" tables
start "$generator" --source "$scratch/tree" tables
for i in "${!pids[@]}"; do
  wait "${pids[i]}" || fail "${names[i]}: exit code $?: $(cat "$scratch/log-$i")"
done
for scene in matte spheres; do
  cmp <(results "$scratch/alone" $scene) <(results "$scratch/out" $scene) || fail "$scene differs from the run alone"
done
"$halfway" compare matte spheres --out "$scratch/out" >/dev/null || fail 'compare'
(cd "$scratch/tree" && for file in rtl/tables/*; do cmp -s "$file" "$checkout/$file" || exit 1; done) ||
  fail 'tables written by two at once'

# When a run starts, old results of all its scenes become invalid, also of scenes that it has not drawn yet.
"$halfway" sim spheres matte --size 320x240 --threads 1 --simulator ghdl --out "$scratch/out" >"$scratch/log" 2>&1 &
run=$!
while [ -f "$scratch/out/matte/quadratic/summary.json" ] && kill -0 $run 2>/dev/null; do sleep 0.02; done
"$halfway" compare matte --out "$scratch/out" >"$scratch/log-compare" 2>&1
status=$?
kill -0 $run 2>/dev/null || fail 'the run was over before it could be looked at'
[ "$status" = 2 ] || fail "compare of a scene yet to be drawn: exit code $status"
grep -q 'has not reached this scene yet' "$scratch/log-compare" || fail "compare says $(cat "$scratch/log-compare")"
wait $run || fail "the run: $(cat "$scratch/log")"
"$halfway" compare spheres matte --out "$scratch/out" >/dev/null || fail 'compare after the run'
exit "$failed"
