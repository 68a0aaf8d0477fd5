#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Runs studies on a real Slurm: starts and stops munged, slurmctld and slurmd on this machine. Checks that the table of
# a job array equals that of a local run byte for byte, that Slurm repeats a killed task, and that a killed study
# continues with the results that it has. Three kinds of studies: one point per task; placements, with replacements for
# Yosys and nextpnr; and frames in tiles, whose assembled pictures must equal those of the local run and of frames in one
# piece.
#
#   tb/slurm/slurm.sh HALFWAY CHECKOUT SCRATCH
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
finish() {
  [ -n "${SLURM_CONF-}" ] && timeout 10 scancel --user "$(id -un)" --quiet 2>/dev/null
  # Job steps continue after slurmd's end. Their command lines contain the worker and its folder.
  for id in $(ours "$scratch/.*--part"); do kill -KILL "$id" 2>/dev/null; done
  for ((i = ${#daemons[@]} - 1; i >= 0; i--)); do kill -TERM "${daemons[i]}" 2>/dev/null; done
  for ((i = ${#daemons[@]} - 1; i >= 0; i--)); do
    for ((tries = 0; tries < 50; tries++)); do
      kill -0 "${daemons[i]}" 2>/dev/null || break
      sleep 0.1
    done
    kill -KILL "${daemons[i]}" 2>/dev/null
  done
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

free_port() {
  local port
  for ((tries = 0; tries < 100; tries++)); do
    port=$((20000 + RANDOM % 20000))
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || { echo $port && return; }
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
for ((tries = 0; tries < 50; tries++)); do [ -S "$scratch/munge/socket" ] && break || sleep 0.1; done
[ -S "$scratch/munge/socket" ] || skip "munged does not run here: $(tail -n 1 "$scratch/munged.out")"
start slurmctld slurmctld -D -i
start slurmd slurmd -D -N "$node"
for ((tries = 0; tries < 150; tries++)); do
  [ "$(timeout 5 sinfo --noheader --format=%t 2>/dev/null)" = idle ] && break || sleep 0.2
done
[ "$(timeout 5 sinfo --noheader --format=%t 2>/dev/null)" = idle ] ||
  skip "Slurm does not run here: $(tail -qn 1 "$scratch/slurmctld.log" "$scratch/slurmd.log" 2>/dev/null)"
note "$(slurmctld -V): the node is idle"

# ---- Steps common to the studies

run_local() { # name, arguments of the study...
  local name=$1
  shift
  "$halfway" "$@" --threads 2 --out "$scratch/$name" >"$scratch/$name.log" 2>&1 ||
    fail "the local run: $(cat "$scratch/$name.log")"
  note "local: $(cat "$scratch/$name.log")"
}

same_table() { # name, name of the local run
  cmp "$scratch/$2/study.csv" "$scratch/$1/study.csv" || fail "$1: another table than the local run's"
}

# Wait until the process has stopped. False if it has ended before.
stopped() { # process
  local state
  while state=$(sed -n 's/^State:[[:space:]]*\(.\).*/\1/p' "/proc/$1/status" 2>/dev/null); do
    case $state in
      T) return 0 ;;
      '' | Z | X) return 1 ;;
    esac
    sleep 0.01
  done
  return 1
}

# Start the study and kill its first running task.
run_with_a_task_killed() { # name, arguments of the study...
  local name=$1 run killed='' task tries retried
  shift
  "$halfway" "$@" --out "$scratch/$name" >"$scratch/$name.log" 2>&1 &
  run=$!
  for ((tries = 0; tries < 300; tries++)); do
    task=$(ours "^$halfway .*--out $scratch/$name .*--part" | head -n 1)
    # A task that ends by itself can be killed, too, without effect. A stopped one cannot end.
    [ -n "$task" ] && kill -STOP "$task" 2>/dev/null && stopped "$task" && kill -KILL "$task" && killed=$task && break
    sleep 0.05
  done
  [ -n "$killed" ] || fail "$name: no task to kill"
  wait $run || fail "$name: exit code $?: $(cat "$scratch/$name.log")"
  retried=$(grep -l 'exit status 137; tried again' "$scratch/$name"/slurm/task-*.log | wc -l)
  [ "$retried" = 1 ] || fail "$name: $retried tasks were tried again after one was killed"
}

# Start the study. Kill it and its tasks when some, but not all, of these records are written.
run_until_killed() { # name, how many, ending of their names, arguments of the study...
  local name=$1 most=$2 ending=$3 run tries
  shift 3
  "$halfway" "$@" --out "$scratch/$name" >"$scratch/killed.log" 2>&1 &
  run=$!
  for ((tries = 0; tries < 1200; tries++)); do
    [ "$(kept "$name" "$ending" | wc -l)" -ge 2 ] && break
    sleep 0.05
  done
  kill -KILL $run 2>/dev/null
  wait $run 2>/dev/null
  scancel --user "$user" --quiet
  for ((tries = 0; tries < 100; tries++)); do [ -z "$(squeue --noheader)" ] && break || sleep 0.2; done
  before=$(kept "$name" "$ending" | wc -l)
  [ "$before" -ge 2 ] && [ "$before" -lt "$most" ] ||
    fail "$name: $before of $most records when the study was killed"
  touch "$scratch/moment"
}

# Records whose names have this regular expression after the hash.
kept() { # name, ending
  find "$scratch/$1/points" -regex ".*/[0-9a-f]*$2\.json" 2>/dev/null
}

# The number in the messages of the tasks that ran since the kill.
said() { # name, what
  find "$scratch/$1/slurm" -name 'task-*.log' -newer "$scratch/moment" -exec grep -ho "[0-9]* $2" {} + |
    awk '{ count += $1 } END { print count + 0 }'
}

go_on() { # name, how many, what, arguments of the study...
  local name=$1 most=$2 what=$3 added
  shift 3
  "$halfway" "$@" --out "$scratch/$name" >"$scratch/$name.log" 2>&1 ||
    fail "$name, which goes on: exit code $?: $(cat "$scratch/$name.log")"
  added=$(said "$name" "$what")
  [ "$added" = $((most - before)) ] || fail "$name: $added $what, with $before there"
  note "$name: killed with $before records, $added $what when it went on"
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
run_local local "${study[@]}"
run_with_a_task_killed array "${on_slurm[@]}"
grep -q '6 points, 0 measured in this run' "$scratch/array.log" || fail "what tasks measured was not gathered: $(cat "$scratch/array.log")"
same_table array local
note "job array, a task killed and tried again by Slurm: $(cat "$scratch/array.log")"
run_until_killed resumed 6 '' "${on_slurm[@]}"
go_on resumed 6 'measured in this run' "${on_slurm[@]}"
same_table resumed local

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
study=(study --space "$scratch/placed.toml" --place)
path=$PATH
export PATH=$scratch/bin:$PATH PLACED
for name in placed-local placed-array; do checkout_without_clocks $name; done
PLACED=$scratch/placed-local.seeds
run_local placed-local --source "$scratch/checkout-placed-local" "${study[@]}"
grep -q ',"placed",' "$scratch/placed-local/study.csv" || fail "no clock in $scratch/placed-local/study.csv"
PLACED=$scratch/placed-array.seeds
study=(--source "$scratch/checkout-placed-array" "${study[@]}" --out "$scratch/placed-array")
"$halfway" "${study[@]}" --part 1/3 >"$scratch/placed-array.log" 2>&1 &&
  "$halfway" "${study[@]}" --executor slurm --parts 3 >>"$scratch/placed-array.log" 2>&1 ||
  fail "placements as a job array: exit code $?: $(cat "$scratch/placed-array.log")"
[ "$(sort "$scratch/placed-array.seeds" | tr '\n' ',')" = '1 0,2 none,3 2,' ] ||
  fail "seeds and the tasks that placed them: $(cat "$scratch/placed-array.seeds")"
same_table placed-array placed-local
note "placements as a job array: $(tail -n 1 "$scratch/placed-array.log")"
PATH=$path

# ---- Tiles: 6 for each of three pictures, and 6 for the reference

cat >"$scratch/tiles.toml" <<END
[[sweep]]
method = ["phong", "gouraud", "quadratic", "adaptive"]
size = "1000x700"
END
whole=(--source "$checkout" study --space "$scratch/tiles.toml")
study=("${whole[@]}" --tile 400x360)
on_slurm=("${study[@]}" --executor slurm --parts 5)
run_local whole "${whole[@]}"
run_local tiles "${study[@]}"

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

run_with_a_task_killed tiles-array "${on_slurm[@]}"
grep -q '4 points, 0 measured in this run' "$scratch/tiles-array.log" ||
  fail "what tasks drew was not put together by tasks: $(cat "$scratch/tiles-array.log")"
same_table tiles-array tiles
same_frames tiles-array whole
note "tiles as a job array, a task killed and tried again by Slurm: $(cat "$scratch/tiles-array.log")"
run_until_killed tiles-resumed 24 '-tile-[0-9]*' "${on_slurm[@]}"
# The tiles of an assembled point are removed: add 6 for each, except for Phong's point, which is the reference.
for record in $(kept tiles-resumed ''); do
  grep -q '"point": "phong' "$record" || before=$((before + 6))
done
go_on tiles-resumed 24 'tiles drawn' "${on_slurm[@]}"
same_table tiles-resumed tiles
same_frames tiles-resumed whole

[ "$failed" = 0 ] || tail -n 20 "$scratch/slurmctld.log" >&2
exit "$failed"
