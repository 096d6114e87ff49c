#!/usr/bin/env bash
# slurm-array.sh SCENE OUT.dlm N [BAKE OPTION…]: bakes SCENE as a Slurm job array of N parts, and merges them in a job
# that waits for it; beyond 32 parts, in two levels of such jobs (merge-tree.sh). Prints the ids of all. SCENE - is the
# built-in room.
#
# The parts and their logs lie in OUT.parts/; OUT.log is the log of the merge. A part that is there is not baked again,
# and one that was begun goes on from its checkpoint: after a failure, submit the same command again. What the nodes
# need is a common file system.
#
#   LUCARNE         the program, as the nodes see it (default: the one built here)
#   LUCARNE_SBATCH  options for sbatch, e.g. "--partition=long --time=8:00:00 --cpus-per-task=32"
#   LUCARNE_FAN_IN  how many parts a merge adds up (default: auto, see merge-tree.sh)
set -euo pipefail

usage() {
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0" >&2
  exit 2
}

die() {
  echo "slurm-array: $*" >&2
  exit 1
}

# default_option NAME VALUE: unless the user gave it.
default_option() {
  case " ${options[*]} " in
    *" $1 "* | *" $1="*) ;;
    *) options+=("$1" "$2") ;;
  esac
}

# Old parts would merge into the old light maps without a word when the scene or an option has changed.
claim_folder() {
  local bake
  mkdir -p "$parts"
  bake=$(printf '%s\n' "scene $([ "$scene" = - ] || sha256sum <"$scene")" "parts $count" "options ${options[*]@Q}")
  [ -f "$parts/bake.txt" ] || echo "$bake" >"$parts/bake.txt"
  [ "$bake" = "$(cat "$parts/bake.txt")" ] ||
    die "$parts holds the parts of another bake (see bake.txt there); remove it, or take another name"
}

# afterany and not afterok: when a task fails for good, a job that waits for afterok stays in the queue for ever and
# tells nothing, while the merge runs, names the parts that are missing, and ends with an error.
submit() {
  local array self k
  local sbatch=(sbatch --parsable --requeue --open-mode=append)
  # shellcheck disable=SC2206 # several options in one variable
  local more=(${LUCARNE_SBATCH:-})
  command -v sbatch >/dev/null || die "there is no sbatch here (Debian: slurm-client)"
  [ "$scene" = - ] || scene=$(realpath -e "$scene")
  [[ "$lucarne" != */* ]] || lucarne=$(realpath -e "$lucarne")
  self=$(realpath "$0")
  claim_folder
  # USR1 comes to the script two minutes before the time limit: it then ends the bake and queues the task again.
  array=$("${sbatch[@]}" --job-name="lucarne-${name##*/}" --array="1-$count" --signal=B:USR1@120 \
    --output="$parts/%a.log" "${more[@]}" "$self" --run-part "$lucarne" "$scene" "$out" "$count" "${options[@]}")
  echo "array ${array%%;*}"
  echo "slurm-array: logs of the parts are in $parts" >&2
  for ((k = 1; k <= count; ++k)); do echo "$k.part"; done >"$parts/parts.list"
  LUCARNE=$lucarne LUCARNE_LOCAL=0 LUCARNE_SBATCH="${LUCARNE_SBATCH:-} --dependency=afterany:${array%%;*}" \
    "${self%/*}/merge-tree.sh" "@$parts/parts.list" "$out" "${LUCARNE_FAN_IN:-auto}"
}

states() { ls -l --full-time "$1"/*.part 2>/dev/null || true; }

# One task of the array. When Slurm cancels, preempts or requeues it, every process gets TERM; the shell outlives the
# program.
run_part() {
  local k=$SLURM_ARRAY_TASK_ID status=0 limit_near=false before
  if [ -f "$parts/$k.part" ] && "$lucarne" merge "$parts/$k.part" --verify; then
    echo "slurm-array: part $k of $count is already there"
    return
  fi
  rm -f "$parts/$k.part"
  default_option --threads "$SLURM_CPUS_ON_NODE"
  before=$(states "$parts/$k.checkpoint")
  trap : TERM
  trap 'limit_near=true; kill -TERM "$bake" || true' USR1
  "$lucarne" bake "${scene_argument[@]}" -o "$parts/$k.part" --part "$k/$count" --resume "${options[@]}" &
  bake=$!
  # A signal ends a wait early.
  wait "$bake" || status=$?
  while kill -0 "$bake" 2>/dev/null; do
    status=0
    wait "$bake" || status=$?
  done
  [ "$status" -ne 0 ] && $limit_near || return "$status"
  # Without this it could go on so for ever.
  [ "$before" != "$(states "$parts/$k.checkpoint")" ] ||
    die "nothing was saved within the time limit; give more time, or a shorter --checkpoint"
  echo "slurm-array: part $k of $count meets the time limit; queued again, it goes on from its checkpoint"
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$k"
}

top=$(realpath -m "$(dirname "$0")/../..")
role=submit
lucarne=${LUCARNE:-$top/build/release/cli/lucarne}
if [ "${1:-}" = --run-part ]; then
  role=run-part
  lucarne=$2
  shift 2
fi
[[ $# -ge 3 && "$2" == *?.dlm && "$3" =~ ^[1-9][0-9]*$ ]] || usage
scene=$1
out=$(realpath -m "$2")
count=$3
shift 3
options=("$@")
name=${out%.dlm}
parts=$name.parts
scene_argument=()
[ "$scene" = - ] || scene_argument=("$scene")

case "$role" in
  submit) submit ;;
  run-part) run_part ;;
esac
