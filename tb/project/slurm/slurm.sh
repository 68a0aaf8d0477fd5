#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Runs studies on a real Slurm: starts and stops munged, slurmctld and slurmd on this machine. The table of each job array
# must equal that of a local run byte for byte. Three kinds of studies:
# - points: a killed study continues with the results that it has;
# - placements, with replacements for Yosys and nextpnr: each seed is placed once;
# - frames in tiles: Slurm repeats a killed task, and the pictures equal those of frames in one piece.
#
#   tb/project/slurm/slurm.sh HALFWAY CHECKOUT SCRATCH
#
# Exit codes: 0 passed, 1 failed, 3 Slurm is not installed, 77 skipped because the daemons cannot run.
set -u
halfway=$(realpath "$1")
checkout=$(realpath "$2")
rm -rf "${3:?}"
mkdir -p "$3"
scratch=$(realpath "$3")
PATH=$PATH:/usr/sbin:/sbin
begun=$(date +%s)

skip() {
  echo "slurm.sh: skipped: $*"
  exit 77
}
failed=0
fail() {
  echo "slurm.sh: $*" >&2
  failed=1
}
note() { echo "$(($(date +%s) - begun)) s: $*"; }
until_true() { # tries, tenths of a second between them, command...
  local tries=$1 tenths=$2
  shift 2
  while ! "$@"; do
    ((tries-- > 0)) || return 1
    sleep "$((tenths / 10)).$((tenths % 10))"
  done
}

for tool in munged slurmctld slurmd sbatch squeue scontrol scancel; do
  command -v $tool >/dev/null || {
    echo "slurm.sh: no $tool; scripts/setup.sh test installs it" >&2
    exit 3
  }
done

# ---- Slurm, with all its files in the scratch folder

daemons=()
# Process ids of commands that match the pattern. The pattern contains the folder of this test.
ours() { # pattern
  for process in /proc/[0-9]*; do
    { tr '\0' ' ' <"$process/cmdline"; } 2>/dev/null | grep -q -- "$1" && echo "${process#/proc/}"
  done
}
daemons_ended() { for process in "${daemons[@]}"; do ! kill -0 "$process" 2>/dev/null || return 1; done; }
finish() {
  [ -n "${SLURM_CONF-}" ] && timeout 10 scancel --user "$(id -un)" --quiet 2>/dev/null
  # Job steps continue after slurmd's end. Their command lines contain the worker and its folder.
  for id in $(ours "$scratch/.*--part"); do kill -KILL "$id" 2>/dev/null; done
  [ ${#daemons[@]} = 0 ] || kill -TERM "${daemons[@]}" 2>/dev/null
  until_true 50 1 daemons_ended || kill -KILL "${daemons[@]}" 2>/dev/null
  # slurmstepd changes its command line, but its environment still names the configuration.
  for process in /proc/[0-9]*; do
    if grep -qs '^slurmstepd' "$process/comm" &&
      { tr '\0' '\n' <"$process/environ"; } 2>/dev/null | grep -qx "SLURM_CONF=$scratch/slurm.conf"; then
      kill -KILL "${process#/proc/}" 2>/dev/null
    fi
  done
}
trap finish EXIT
trap 'exit 1' INT TERM

is_free() { ! (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }
free_port() {
  local port
  for ((tries = 0; tries < 100; tries++)); do
    port=$((20000 + RANDOM % 20000))
    is_free $port && echo $port && return
  done
  return 1
}

node=$(hostname -s)
user=$(id -un)
mkdir -p "$scratch/munge" "$scratch/state" "$scratch/spool"
chmod 711 "$scratch/munge"
chmod 700 "$scratch/state"
head -c 1024 /dev/urandom >"$scratch/munge/key"
chmod 600 "$scratch/munge/key"
# Credentials expire after 5 s: a requeued job waits for this time before it runs again.
cat >"$scratch/slurm.conf" <<END
ClusterName=halfway
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
AuthType=auth/munge
AuthInfo=socket=$scratch/munge/socket,cred_expire=5
SlurmUser=$user
SlurmdUser=$user
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
SlurmctldLogFile=$scratch/slurmctld.log
SlurmdLogFile=$scratch/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
KillWait=2
MpiDefault=none
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=study Nodes=$node Default=YES State=UP MaxTime=INFINITE
END
export SLURM_CONF=$scratch/slurm.conf

start() { # name command...
  local name=$1
  shift
  "$@" >"$scratch/$name.out" 2>&1 &
  daemons+=($!)
}
start munged munged --foreground --key-file "$scratch/munge/key" --socket "$scratch/munge/socket" \
  --pid-file "$scratch/munge/pid" --log-file "$scratch/munge/log" --seed-file "$scratch/munge/seed"
until_true 50 1 [ -S "$scratch/munge/socket" ] || skip "munged does not run here: $(tail -n 1 "$scratch/munged.out")"
start slurmctld slurmctld -D -i
start slurmd slurmd -D -N "$node"
is_idle() { [ "$(timeout 5 sinfo --noheader --format=%t 2>/dev/null)" = idle ]; }
until_true 150 2 is_idle ||
  skip "Slurm does not run here: $(tail -qn 1 "$scratch/slurmctld.log" "$scratch/slurmd.log" 2>/dev/null)"
note "$(slurmctld -V): the node is idle"

# ---- Steps common to the studies

run() { # name, arguments of the study...
  local name=$1
  shift
  "$halfway" "$@" --out "$scratch/$name" >"$scratch/$name.log" 2>&1 ||
    fail "$name: exit code $?: $(cat "$scratch/$name.log")"
  note "$name: $(tail -n 1 "$scratch/$name.log")"
}
says() { # name, words of its output
  grep -qF -- "$2" "$scratch/$1.log" || fail "$1 does not say '$2': $(cat "$scratch/$1.log")"
}
same_table() { # name, name of the local run
  cmp "$scratch/$2/study.csv" "$scratch/$1/study.csv" || fail "$1: another table than the local run's"
}

# Stop the first running task, which then cannot end, and kill it. False if no task is there, or if it has ended.
kill_a_task() { # name
  local task state
  task=$(ours "^$halfway .*--out $scratch/$1 .*--part" | head -n 1)
  [ -n "$task" ] && kill -STOP "$task" 2>/dev/null || return 1
  while state=$(sed -n 's/^State:[[:space:]]*\(.\).*/\1/p' "/proc/$task/status" 2>/dev/null); do
    case $state in
      T) kill -KILL "$task" && return ;;
      '' | Z | X) return 1 ;;
    esac
    sleep 0.01
  done
  return 1
}
run_with_a_task_killed() { # name, arguments of the study...
  local name=$1 retried process
  (run "$@" && exit "$failed") &
  process=$!
  until_true 300 1 kill_a_task "$name" || fail "$name: no task to kill"
  wait $process || failed=1
  retried=$(grep -l 'exit status 137; tried again' "$scratch/$name"/slurm/task-*.log | wc -l)
  [ "$retried" = 1 ] || fail "$name: $retried tasks were tried again after one was killed"
}

records() { find "$scratch/$1/points" -regex '.*/[0-9a-f]*\.json' 2>/dev/null | wc -l; }
has_records() { [ "$(records "$1")" -ge 2 ]; }
queue_is_empty() { [ -z "$(squeue --noheader)" ]; }
# Kill the study and its tasks when some, but not all, points are measured, and continue it.
run_killed_and_continued() { # name, number of points, arguments of the study...
  local name=$1 most=$2 process before added
  shift 2
  "$halfway" "$@" --out "$scratch/$name" >"$scratch/killed.log" 2>&1 &
  process=$!
  until_true 600 1 has_records "$name"
  kill -KILL $process 2>/dev/null
  wait $process 2>/dev/null
  scancel --user "$user" --quiet
  until_true 100 2 queue_is_empty
  before=$(records "$name")
  [ "$before" -ge 2 ] && [ "$before" -lt "$most" ] ||
    fail "$name: $before of $most points when the study was killed"
  touch "$scratch/moment"
  run "$name" "$@"
  added=$(find "$scratch/$name/slurm" -name 'task-*.log' -newer "$scratch/moment" \
    -exec grep -ho '[0-9]* measured in this run' {} + | awk '{ count += $1 } END { print count + 0 }')
  [ "$added" = $((most - before)) ] || fail "$name: $added points measured, with $before there"
}

# ---- Points: hardware, and software frames that need a task one or two seconds each

cat >"$scratch/space.toml" <<END
[[sweep]]
method = "gouraud"
exponent = [5, 20, 50, 80]
size = "640x480"
[[sweep]]
method = ["quadratic", "adaptive"]
size = "160x120"
END
study=(--source "$checkout" study --space "$scratch/space.toml")
on_slurm=("${study[@]}" --executor slurm --parts 3)
run local "${study[@]}" --threads 2
run_killed_and_continued points 6 "${on_slurm[@]}"
says points '6 points, 0 measured in this run'
same_table points local

# ---- Placements: one seed per task, of which one was placed by an earlier part

mkdir "$scratch/bin"
cat >"$scratch/bin/yosys" <<'END'
#!/bin/sh
[ "$1" = -V ] && echo 'Yosys 0.0, stands in' && exit
echo >mapped.il
echo '{"modules": {"wrapped": {"ports": {"clk": {"direction": "input", "bits": [2]}}, "cells": {}, "netnames": {}}}}' >wrapped.json
case "$*" in
  *synth_ice40*) echo '{"design": {"num_cells_by_type": {"SB_LUT4": 30, "SB_DFF": 4}}}' >cells.json ;;
  *) echo '{"design": {"num_cells_by_type": {"$lut": 20, "$_DFF_P_": 4}}}' >cells.json ;;
esac
END
cat >"$scratch/bin/nextpnr-ice40" <<'END'
#!/bin/sh
[ "$1" = --version ] && echo 'nextpnr-ice40 (Version 0.0)' && exit
case "$*" in
  *--pack-only*) echo 'Info: 	 ICESTORM_LC:  40/ 7680    1%' ; exit ;;
esac
seed=${*##*--seed } ; seed=${seed%% *}
echo "$seed ${SLURM_ARRAY_TASK_ID:-none}" >>"$PLACED"
echo '{"utilization": {"ICESTORM_LC": {"used": 40, "available": 7680}}, "critical_paths": [],
  "fmax": {"clk": {"achieved": '$((100 + seed * 7 % 5))'}}}' >report.json
END
chmod +x "$scratch/bin/yosys" "$scratch/bin/nextpnr-ice40"

# A checkout without stored clocks. Its cache contains nothing from Yosys and nextpnr.
checkout_without_clocks() { # name
  local root=$scratch/checkout-$1 folder
  mkdir -p "$root/build/cache"
  ln -s "$checkout/rtl" "$checkout/sim" "$root"
  for folder in "$checkout"/build/cache/*; do
    case ${folder##*/} in yosys | synth | placed) ;; *) ln -s "$folder" "$root/build/cache" ;; esac
  done
}
cat >"$scratch/placed.toml" <<END
[[sweep]]
method = ["gouraud", "quadratic"]
size = "160x120"
END
study=(study --space "$scratch/placed.toml" --place --device hx8k)
path=$PATH
export PATH=$scratch/bin:$PATH PLACED
for name in placed-local placed-array; do checkout_without_clocks $name; done
PLACED=$scratch/placed-local.seeds
run placed-local --source "$scratch/checkout-placed-local" "${study[@]}" --threads 2
grep -q ',"placed",' "$scratch/placed-local/study.csv" || fail "no clock in $scratch/placed-local/study.csv"
PLACED=$scratch/placed-array.seeds
study=(--source "$scratch/checkout-placed-array" "${study[@]}")
run placed-array "${study[@]}" --part 1/3
run placed-array "${study[@]}" --executor slurm --parts 3
[ "$(sort "$scratch/placed-array.seeds" | tr '\n' ',')" = '1 0,2 none,3 2,' ] ||
  fail "seeds and the tasks that placed them: $(cat "$scratch/placed-array.seeds")"
same_table placed-array placed-local
PATH=$path

# ---- Tiles: 6 for each of three pictures, and 6 for the reference

cat >"$scratch/tiles.toml" <<END
[[sweep]]
method = ["phong", "gouraud", "quadratic", "adaptive"]
size = "1000x700"
END
whole=(--source "$checkout" study --space "$scratch/tiles.toml")
study=("${whole[@]}" --tile 400x360)
run whole "${whole[@]}" --threads 2
run tiles "${study[@]}" --threads 2

# The frames of points, in the table's order.
frames() { # name
  local record
  for record in $(sed -n 's/.*,\([0-9a-f]\{32\}\),.*/\1/p' "$scratch/$1/study.csv"); do
    md5sum <"$scratch/$1/points/$record.png"
  done
}
same_frames() { # name, name
  [ "$(frames "$1" | wc -l)" = 4 ] && [ "$(frames "$1")" = "$(frames "$2")" ] || fail "$1: other frames than in $2"
}
same_frames tiles whole

run_with_a_task_killed tiles-array "${study[@]}" --executor slurm --parts 5
says tiles-array '4 points, 0 measured in this run'
same_table tiles-array tiles
same_frames tiles-array whole

[ "$failed" = 0 ] || tail -n 20 "$scratch/slurmctld.log" >&2
exit "$failed"
