#!/usr/bin/env bash
# slurm_test.sh LUCARNE: scripts/cluster/slurm-array.sh, merge-tree.sh and slurm-mpi.sh on a Slurm of two machines (see
# namespaces.sh), started here for the test, with a task of the array requeued in the middle. Ends with 77 where
# something it needs is missing.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=tests/cluster/namespaces.sh
. "$here/namespaces.sh"

[ $# -eq 1 ] || {
  echo "usage: slurm_test.sh LUCARNE" >&2
  exit 2
}
lucarne=$(realpath -e "$1")
need slurmctld slurm-wlm
need slurmd slurm-wlm
need sbatch slurm-wlm
need munged munge
need mpirun openmpi-bin
need_namespaces
isolate 300 "$lucarne"

recipes=$here/../../scripts/cluster
scene=$here/../../scenes/two_lamps.glb
bake_options=(--photons "$(photons_for 16)" --density 4)
export LUCARNE=$lucarne SLURM_CONF=$folder/slurm.conf

# One munged for all: its socket is a file, and files are common to the machines.
start_munge() {
  mkdir -m 700 "$folder/munge"
  mkdir -m 755 /run/munge
  head -c 128 /dev/urandom >"$folder/munge/key"
  chmod 600 "$folder/munge/key"
  chown -R munge: "$folder/munge" /run/munge
  chmod 711 "$folder"
  setpriv --reuid munge --regid munge --clear-groups munged --key-file="$folder/munge/key" \
    --socket=/run/munge/munge.socket.2 --pid-file=/run/munge/munged.pid \
    --log-file="$folder/munge/log" --seed-file="$folder/munge/seed"
  within 15 sh -c 'munge -n | unmunge >/dev/null 2>&1' || fail "no munged: $(cat "$folder/munge/log")"
}

# A requeued job waits until its old credential has expired, hence cred_expire.
write_slurm_conf() {
  cat >"$SLURM_CONF" <<END
ClusterName=test
SlurmctldHost=head($head_address)
SlurmUser=root
AuthType=auth/munge
AuthInfo=cred_expire=5
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
MpiDefault=none
ReturnToService=2
KillWait=10
SchedulerParameters=sched_interval=2
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool.%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.%n.log
SlurmdParameters=config_overrides
NodeName=m[1-2] CPUs=2 State=UNKNOWN
PartitionName=all Nodes=m[1-2] Default=YES MaxTime=60 State=UP
END
  # Nothing here uses control groups, but slurmd looks for some unless told.
  printf '%s\n' CgroupPlugin=cgroup/v1 "CgroupMountpoint=$folder/cgroup" >"$folder/cgroup.conf"
  # PMIx makes the same names on every node; of the machines' folders only the home folder is each one's own.
  echo "PMIxCliTmpDirBase=$HOME" >"$folder/mpi.conf"
}

start_slurm() {
  local machine
  mkdir "$folder/state"
  write_slurm_conf
  slurmctld
  for machine in m1 m2; do
    mkdir "$folder/spool.$machine"
    on_machine "$machine" "$(command -v slurmd)" -D -N "$machine" >"$folder/slurmd.$machine.out" 2>&1 &
    disown
  done
  within 30 two_are_idle ||
    fail "no Slurm: $(tail -n 20 "$folder"/slurmctld.log "$folder"/slurmd.*)"
}

two_are_idle() { [ "$(sinfo -h -N -t idle -o %N 2>/dev/null | wc -l)" -eq 2 ]; }
job_is() { scontrol show job "$1" | grep -Eq "JobState=($2)"; }
has_ended() { job_is "$1" 'COMPLETED|FAILED|CANCELLED|TIMEOUT|NODE_FAIL'; }

# expect_end JOB STATE LOG
expect_end() {
  within 120 has_ended "$1" || fail "job $1 does not end: $(squeue -l) $(cat "$3")"
  job_is "$1" "$2" || fail "job $1 has not $2: $(scontrol show job "$1") $(cat "$3")"
}

# submit_array OUT OPTION…: sets array and merge, the jobs' ids.
submit_array() {
  local ids
  ids=$("$recipes/slurm-array.sh" "$scene" "$@" 2>"$folder/submit.log") ||
    fail "not submitted: $(cat "$folder/submit.log")"
  array=$(awk '$1 == "array" { print $2 }' <<<"$ids")
  merge=$(awk '$1 == "merge" { print $2 }' <<<"$ids")
}

# Three parts on four CPUs; the second is requeued when it has saved something, and the merges, in two levels, wait for
# it all the same.
bake_array() {
  local parts=$folder/array.parts
  LUCARNE_FAN_IN=2 submit_array "$folder/array.dlm" 3 "${bake_options[@]}" --checkpoint 0.3s
  within 60 has_state "$parts/2.checkpoint" || fail "task 2 saved nothing: $(squeue -l) $(cat "$parts"/*.log)"
  scontrol requeue "${array}_2"
  note "task 2 is requeued"
  expect_end "$merge" COMPLETED "$folder/array.log"
  scontrol show job "${array}_2" | grep -q 'Restarts=1' ||
    fail "task 2 was not restarted: $(scontrol show job "${array}_2")"
  expect_text 'going on from' "$parts/2.log"
  expect_same_hash "$folder/array.dlm" "$folder/single.dlm"
  [ ! -e "$folder/array.tree" ] || fail "left behind: $(ls "$folder/array.tree")"
}

# A cancelled task is not baked. The merge job ends with an error that names the gap, and the same command bakes only
# that.
cancel_and_submit_again() {
  local parts=$folder/cancelled.parts before
  submit_array "$folder/cancelled.dlm" 2 "${bake_options[@]}" --checkpoint 0.3s
  within 60 has_state "$parts/2.checkpoint" || fail "task 2 saved nothing: $(squeue -l) $(cat "$parts"/*.log)"
  scancel "${array}_2"
  expect_end "$merge" FAILED "$folder/cancelled.log"
  expect_text '2.part is missing; its log is .*/cancelled.parts/2.log' "$folder/cancelled.log"
  [ ! -e "$folder/cancelled.dlm" ] || fail "light maps with a gap were written: $(cat "$folder/cancelled.log")"
  before=$(stat -c %Y.%i "$parts/1.part")
  submit_array "$folder/cancelled.dlm" 2 "${bake_options[@]}" --checkpoint 0.3s
  expect_end "$merge" COMPLETED "$folder/cancelled.log"
  [ "$before" = "$(stat -c %Y.%i "$parts/1.part")" ] || fail "part 1 was baked twice"
  expect_same_hash "$folder/cancelled.dlm" "$folder/single.dlm"
}

# Four parts of a list, the last of which is baked only when all jobs are queued: by a job that the first level waits
# for. A task that fails there is named by the last merge; the second submission goes on.
merge_tree() {
  local k bake job
  local tiny=(bake "$scene" --photons 8k --density 4 --checkpoint 0 --quiet)
  mkdir "$folder/tree"
  for k in 1 2 3; do
    "$lucarne" "${tiny[@]}" -o "$folder/tree/$k.part" --part "$k/4"
  done
  cp "$folder/tree/3.part" "$folder/whole"
  truncate -s -1 "$folder/tree/3.part"
  printf '%s.part\n' 1 2 3 4 >"$folder/tree/list"
  bake=$(sbatch --parsable --output="$folder/tree/4.log" \
    --wrap "'$lucarne' bake '$scene' --photons 8k --density 4 -o '$folder/tree/4.part' --part 4/4")
  job=$(LUCARNE_SBATCH="--dependency=afterany:$bake" \
    "$recipes/merge-tree.sh" "@$folder/tree/list" "$folder/tree.dlm" 2 2>"$folder/submit.log") ||
    fail "not submitted: $(cat "$folder/submit.log")"
  job=${job##*merge }
  expect_end "$job" FAILED "$folder/tree.log"
  expect_text 'level 1, task 2 failed; its log is .*/tree.tree/1.2.log: .*tree/3.part' "$folder/tree.log"
  [ ! -e "$folder/tree.dlm" ] || fail "light maps were written: $(cat "$folder/tree.log")"
  cp "$folder/whole" "$folder/tree/3.part"
  job=$("$recipes/merge-tree.sh" "@$folder/tree/list" "$folder/tree.dlm" 2 2>"$folder/submit.log") ||
    fail "not submitted: $(cat "$folder/submit.log")"
  expect_end "${job##*merge }" COMPLETED "$folder/tree.log"
  "$lucarne" "${tiny[@]}" -o "$folder/tiny.dlm"
  expect_same_hash "$folder/tree.dlm" "$folder/tiny.dlm"
}

# bake_mpi NAME: two ranks on each of two machines.
bake_mpi() {
  local out=$folder/$1.dlm job
  job=$(LUCARNE_SBATCH="--nodes=2 --ntasks-per-node=2" "$recipes/slurm-mpi.sh" "$scene" "$out" 4 "${bake_options[@]}" \
    2>"$folder/submit.log") || fail "not submitted: $(cat "$folder/submit.log")"
  expect_end "${job#job }" COMPLETED "$folder/$1.log"
  expect_same_hash "$out" "$folder/single.dlm"
}

make_machines 2
start_munge
start_slurm
note "two nodes are idle"
"$lucarne" bake "$scene" -o "$folder/single.dlm" "${bake_options[@]}" --quiet
bake_array
note "three parts, one of them requeued, make the light maps of one bake"
cancel_and_submit_again
note "a cancelled part was named, and baked by the second submission"
merge_tree
note "merges of a list waited for a part, named a part that is cut short, and went on"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
bake_mpi mpirun
LUCARNE_LAUNCH="srun --mpi=pmix" bake_mpi srun
note "so do four ranks on two machines"
