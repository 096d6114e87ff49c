#!/usr/bin/env bash
# slurm-mpi.sh SCENE OUT.dlm RANKS [BAKE OPTION…]: bakes SCENE as one Slurm job of RANKS MPI ranks. Prints the job's id.
# SCENE - is the built-in room.
#
# The log is OUT.log. A job that is requeued goes on from its checkpoint, also on another number of ranks: after a
# failure, submit the same command again. Only the first node reads the scene and writes; give each node one rank and
# all its CPUs.
#
#   LUCARNE         the program, as the nodes see it (default: the one built here)
#   LUCARNE_SBATCH  options for sbatch, e.g. "--ntasks-per-node=1 --cpus-per-task=32 --time=8:00:00"
#   LUCARNE_LAUNCH  what starts the ranks: mpirun (the default) or "srun --mpi=pmix"
set -euo pipefail

usage() {
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0" >&2
  exit 2
}

die() {
  echo "slurm-mpi: $*" >&2
  exit 1
}

# default_option NAME VALUE: unless the user gave it.
default_option() {
  case " ${options[*]} " in
    *" $1 "* | *" $1="*) ;;
    *) options+=("$1" "$2") ;;
  esac
}

submit() {
  local job
  local sbatch=(sbatch --parsable --requeue --open-mode=append)
  # shellcheck disable=SC2206 # several options in one variable
  local more=(${LUCARNE_SBATCH:-})
  command -v sbatch >/dev/null || die "there is no sbatch here (Debian: slurm-client)"
  [ "$scene" = - ] || scene=$(realpath -e "$scene")
  [[ "$lucarne" != */* ]] || lucarne=$(realpath -e "$lucarne")
  # USR1 comes to the script two minutes before the time limit: it then ends the bake and queues the job again.
  job=$("${sbatch[@]}" --job-name="lucarne-${name##*/}" --ntasks="$ranks" --signal=B:USR1@120 --output="$name.log" \
    "${more[@]}" "$(realpath "$0")" --run "$lucarne" "$scene" "$out" "$ranks" "${options[@]}")
  echo "job ${job%%;*}"
  echo "slurm-mpi: the log is $name.log" >&2
}

# The launcher's words. Without --bind-to none Open MPI ties all threads of a rank to one core.
launcher() {
  local launch=${LUCARNE_LAUNCH:-mpirun}
  [ "$launch" != mpirun ] || launch+=" --bind-to none"
  echo "$launch"
}

states() { ls -l --full-time "$name.checkpoint"/*.part 2>/dev/null || true; }

# When Slurm cancels, preempts or requeues the job, every process gets TERM; the shell outlives the ranks.
run() {
  local status=0 limit_near=false before
  default_option --threads "${SLURM_CPUS_PER_TASK:-1}"
  before=$(states)
  trap : TERM
  trap 'limit_near=true; kill -TERM "$bake" || true' USR1
  # shellcheck disable=SC2046 # several words
  $(launcher) "$lucarne" bake "${scene_argument[@]}" -o "$out" --resume "${options[@]}" &
  bake=$!
  # A signal ends a wait early.
  wait "$bake" || status=$?
  while kill -0 "$bake" 2>/dev/null; do
    status=0
    wait "$bake" || status=$?
  done
  [ "$status" -ne 0 ] && $limit_near || return "$status"
  # Without this it could go on so for ever.
  [ "$before" != "$(states)" ] ||
    die "nothing was saved within the time limit; give more time, or a shorter --checkpoint"
  echo "slurm-mpi: the time limit is near; queued again, the job goes on from its checkpoint"
  scontrol requeue "$SLURM_JOB_ID"
}

top=$(realpath -m "$(dirname "$0")/../..")
role=submit
lucarne=${LUCARNE:-$top/build/release/cli/lucarne}
if [ "${1:-}" = --run ]; then
  role=run
  lucarne=$2
  shift 2
fi
[[ $# -ge 3 && "$2" == *?.dlm && "$3" =~ ^[1-9][0-9]*$ ]] || usage
scene=$1
out=$(realpath -m "$2")
ranks=$3
shift 3
options=("$@")
name=${out%.dlm}
scene_argument=()
[ "$scene" = - ] || scene_argument=("$scene")
"$role"
