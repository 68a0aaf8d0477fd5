#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A study on a real Slurm: munged, slurmctld and slurmd of this machine's own, started here and ended here. The job
# array's table equals the local run's byte for byte; a task that is killed is tried again by Slurm; a study that
# is killed goes on where it was.
#
#   tb/slurm/slurm.sh HALFWAY CHECKOUT SCRATCH
#
# Exit codes: 0 all held, 1 something did not, 77 Slurm is not there or cannot run here.
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
  command -v $tool >/dev/null ||
    skip "no $tool; sudo apt-get install slurmctld slurmd slurm-client munge"
done

# ---- Slurm, all of it in the scratch folder

daemons=()
# What a pattern in a command line names, of this test alone: its folder is in it.
ours() { # pattern
  for process in /proc/[0-9]*; do
    { tr '\0' ' ' <"$process/cmdline"; } 2>/dev/null | grep -q -- "$1" && echo "${process#/proc/}"
  done
}
finish() {
  [ -n "${SLURM_CONF-}" ] && timeout 10 scancel --user "$(id -un)" --quiet 2>/dev/null
  # Job steps outlive slurmd; they name the worker and its folder.
  for id in $(ours "$scratch/.*--part"); do kill -KILL "$id" 2>/dev/null; done
  for ((i = ${#daemons[@]} - 1; i >= 0; i--)); do kill -TERM "${daemons[i]}" 2>/dev/null; done
  for ((i = ${#daemons[@]} - 1; i >= 0; i--)); do
    for ((tries = 0; tries < 50; tries++)); do
      kill -0 "${daemons[i]}" 2>/dev/null || break
      sleep 0.1
    done
    kill -KILL "${daemons[i]}" 2>/dev/null
  done
  # slurmstepd changes its name; its environment keeps the configuration.
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
# Credentials of 5 s: as long as a requeued job waits before it runs again.
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

# ---- The study: hardware, and frames that take a task a second or two each

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
on_slurm=("${study[@]}" --executor slurm --parts 3 --out)
"$halfway" "${study[@]}" --threads 2 --out "$scratch/local" >"$scratch/local.log" 2>&1 ||
  fail "the local run: $(cat "$scratch/local.log")"
note "local: $(cat "$scratch/local.log")"

equal() { # folder
  cmp "$scratch/local/study.csv" "$scratch/$1/study.csv" || fail "$1: another table than the local run's"
}

# A task is killed as soon as it works.
"$halfway" "${on_slurm[@]}" "$scratch/array" >"$scratch/array.log" 2>&1 &
run=$!
killed=
for ((tries = 0; tries < 300; tries++)); do
  killed=$(ours "^$halfway .*--out $scratch/array .*--part" | head -n 1)
  [ -n "$killed" ] && kill -KILL "$killed" 2>/dev/null && break
  sleep 0.05
done
[ -n "$killed" ] || fail 'no task to kill'
wait $run || fail "the job array: exit code $?: $(cat "$scratch/array.log")"
retried=$(grep -l 'exit status 137; tried again' "$scratch"/array/slurm/task-*.log | wc -l)
[ "$retried" = 1 ] || fail "$retried tasks were tried again after one was killed"
grep -q '6 points, 0 measured anew' "$scratch/array.log" || fail "what tasks measured was not gathered: $(cat "$scratch/array.log")"
equal array
note "job array, a task killed and tried again by Slurm: $(cat "$scratch/array.log")"

# The study itself is killed, its tasks with it, when it has some of its records.
"$halfway" "${on_slurm[@]}" "$scratch/resumed" >"$scratch/killed.log" 2>&1 &
run=$!
# Of software: those of hardware are written twice, the second time with the host's instructions.
records() { grep -ls 'gouraud' "$scratch"/resumed/points/*.json; }
for ((tries = 0; tries < 600; tries++)); do
  [ "$(records | wc -l)" -ge 2 ] && break
  sleep 0.05
done
kill -KILL $run 2>/dev/null
wait $run 2>/dev/null
scancel --user "$user" --quiet
for ((tries = 0; tries < 100; tries++)); do [ -z "$(squeue --noheader)" ] && break || sleep 0.2; done
before=$(records | wc -l)
[ "$before" -ge 2 ] && [ "$before" -lt 4 ] || fail "$before of 4 records when the study was killed"
touch "$scratch/moment"
"$halfway" "${on_slurm[@]}" "$scratch/resumed" >"$scratch/resumed.log" 2>&1 ||
  fail "the study that goes on: exit code $?: $(cat "$scratch/resumed.log")"
anew=$(find $(records) -newer "$scratch/moment" | wc -l)
[ "$anew" = $((4 - before)) ] || fail "$anew records were written anew, with $before there"
equal resumed
note "killed with $before records, $anew measured when it went on"

[ "$failed" = 0 ] || tail -n 20 "$scratch/slurmctld.log" >&2
exit "$failed"
