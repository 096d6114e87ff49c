#!/usr/bin/env bash
# merge-tree.sh [--allow-gaps] PARTS OUT.dlm [FAN_IN [MERGE OPTION…]]: merges many parts level by level: on each level,
# groups of FAN_IN parts become one part each, and a last merge makes the light maps of what is left. PARTS is a folder
# of .part files, or @LIST, a file with a path a line. The MERGE OPTIONs go to the last merge.
#
# Under Slurm, a level is a job array that waits for the level below, and the ids of all jobs are printed. Elsewhere the
# levels run here. FAN_IN auto, the default, is one merge up to 32 parts, and two levels of merges beyond.
#
# Parts of parts and their logs lie in OUT.tree/ until OUT.dlm is written; the log of the last merge is OUT.log under
# Slurm. After a failure, give the same command again: what was merged is not merged again.
#
#   --allow-gaps    make the light maps of the parts that are there; otherwise a missing part, or photons that are in
#                   none, are an error, and nothing is written
#   LUCARNE         the program, as the nodes see it (default: the one built here)
#   LUCARNE_SBATCH  options for sbatch, e.g. "--mem=16G --dependency=afterany:ID": parts that are still being baked
#   LUCARNE_LOCAL   1: run here, Slurm or not
#   LUCARNE_JOBS    merges at a time when run here (default: one a processor)
set -euo pipefail

usage() {
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0" >&2
  exit 2
}

say() { echo "merge-tree: $*" >&2; }

die() {
  say "$@"
  exit 1
}

# Sets parts, the absolute paths. Those in a list are from where it lies, as for lucarne.
read_parts() {
  local list
  if [[ "$1" == @* ]]; then
    [ -f "${1#@}" ] || die "there is no list ${1#@}"
    list=$(realpath "${1#@}")
    mapfile -t parts < <(cd "${list%/*}/" && sed 's/\r$//;/^#/d;/^$/d' "$list" | xargs -r -d '\n' realpath -ms --)
  else
    [ -d "$1" ] || die "$1 is no folder of parts (a list of them is @LIST)"
    mapfile -t parts < <(find "$(realpath "$1")" -mindepth 1 -maxdepth 1 -name '*.part' | sort -V)
  fi
  [ "${#parts[@]}" -gt 0 ] || die "there are no parts in ${1#@}"
}

# Two levels of about equal work: the fewest jobs to wait for that do not leave one merge with all the reading.
choose_fan_in() {
  local count=${#parts[@]}
  [ "$fan_in" = auto ] || return 0
  fan_in=2
  while ((count > 32 ? fan_in * fan_in < count : fan_in < count)); do fan_in=$((fan_in + 1)); done
}

# tasks[L]: how many parts level L makes; level 0 are those given.
plan() {
  tasks=("${#parts[@]}")
  while ((tasks[-1] > fan_in)); do tasks+=($(((tasks[-1] + fan_in - 1) / fan_in))); done
  last=${#tasks[@]}
}

# inputs_of LEVEL K: sets inputs, what task K of a level merges, there or not.
inputs_of() {
  local below=$(($1 - 1)) first=$((($2 - 1) * fan_in + 1)) end=$(($2 * fan_in)) i
  inputs=()
  ((end <= tasks[below])) || end=${tasks[below]}
  for ((i = first; i <= end; ++i)); do
    if ((below == 0)); then inputs+=("${parts[i - 1]}"); else inputs+=("$tree/$below.$i.part"); fi
  done
}

# A node's inputs as they are now; fails when one is missing.
state_of_inputs() { stat -c '%.9Y %s %n' "${inputs[@]}" 2>/dev/null; }

# is_current LEVEL K: the node is of these inputs, as they are now, and of all of them.
is_current() {
  local node=$tree/$1.$2 state
  inputs_of "$1" "$2"
  state=$(state_of_inputs) && [ -f "$node.part" ] && [ "$state" = "$(cat "$node.from" 2>/dev/null)" ]
}

# What must not be used again, nor what was made of it. A mark .done is of this run.
remove_old_nodes() {
  local level k
  rm -f "$tree"/*.done
  for ((level = 1; level < last; ++level)); do
    for ((k = 1; k <= tasks[level]; ++k)); do
      is_current "$level" "$k" || rm -f "$tree/$level.$k".{part,from,list,log}
    done
  done
}

# holds_nothing LEVEL K: none of the parts below is there, so that there is no sum of them either.
holds_nothing() {
  local size=$((fan_in ** $1)) i
  for ((i = ($2 - 1) * size; i < $2 * size && i < ${#parts[@]}; ++i)); do
    [ ! -f "${parts[i]}" ] || return 1
  done
}

# gather LEVEL K: sets inputs, those that are there. A missing one is an error, except for gaps that are allowed.
gather() {
  local level=$1 k=$2 first=$((($2 - 1) * fan_in + 1)) wanted i
  inputs_of "$level" "$k"
  wanted=("${inputs[@]}")
  inputs=()
  for i in "${!wanted[@]}"; do
    if [ -f "${wanted[i]}" ]; then
      inputs+=("${wanted[i]}")
    elif ! $allow_gaps || ! holds_nothing $((level - 1)) $((first + i)); then
      die "${wanted[i]} is missing"
    fi
  done
}

# One task of a level. A task that Slurm requeues starts anew; a part appears under its name only when it is whole.
run_node() {
  local level=$1 k=$2 node=$tree/$1.$2
  if is_current "$level" "$k" && "$lucarne" merge "$node.part" --verify --quiet; then
    touch "$node.done"
    say "level $level, task $k: already there"
    return
  fi
  rm -f "$node".{part,from}
  gather "$level" "$k"
  [ "${#inputs[@]}" -gt 0 ] || return 0
  printf '%s\n' "${inputs[@]}" >"$node.list"
  state_of_inputs >"$node.from.new"
  "$lucarne" merge "@$node.list" -o "$node.part" --quiet
  mv "$node.from.new" "$node.from"
  touch "$node.done"
  say "level $level, task $k: ${#inputs[@]} parts are one"
}

# Sets present, the parts that are there, and tells which are not.
look_for_parts() {
  local part log
  present=()
  for part in "${parts[@]}"; do
    log=${part%.part}.log
    if [ -f "$part" ]; then
      present+=("$part")
    elif [ -f "$log" ]; then
      say "$part is missing; its log is $log"
    else
      say "$part is missing"
    fi
  done
  [ "${#present[@]}" -gt 0 ] || die "none of the ${#parts[@]} parts is there"
}

# Names the tasks of the lowest level that failed; those above then had to.
look_for_nodes() {
  local level k log failed=false
  for ((level = 1; level < last; ++level)); do
    for ((k = 1; k <= tasks[level]; ++k)); do
      log=$tree/$level.$k.log
      if [ -f "$tree/$level.$k.done" ] || holds_nothing "$level" "$k"; then continue; fi
      failed=true
      [ -f "$log" ] || log=/dev/null
      say "level $level, task $k failed; its log is $tree/$level.$k.log: $(tail -n 1 "$log")"
    done
    ! $failed || die "$out is not written; the same command again merges only what is not merged yet"
  done
}

# What lucarne says of nodes, in words of the parts given: the command that it proposes for a gap shall bake into their
# folder, and with a node that is refused comes what it is made of. The command has a ' as '\''.
in_terms_of_parts() {
  local size=$((fan_in ** (last - 1))) quote="'\\''" line text hint folder i end
  folder=$(dirname "${parts[0]}")
  while IFS= read -r line; do
    text=${line%%bake them with:*}
    hint=${line#"$text"}
    printf '%s\n' "$text${hint//"${tree//\'/$quote}/"/"${folder//\'/$quote}/"}"
    for ((i = 1; size > 1 && i <= tasks[last - 1]; ++i)); do
      [[ "$text" == *"$tree/$((last - 1)).$i.part"* ]] || continue
      end=$((i * size < ${#parts[@]} ? i * size : ${#parts[@]}))
      say "$((last - 1)).$i.part is the sum of ${parts[(i - 1) * size]} to ${parts[end - 1]}"
    done
  done >&2
}

# Inputs to light maps.
merge_last() {
  local complete=(--complete)
  ! $allow_gaps || complete=()
  printf '%s\n' "${inputs[@]}" >"$tree/last.list"
  { "$lucarne" merge "@$tree/last.list" -o "$out" "${complete[@]}" "${options[@]}" 2>&1 >&3 | in_terms_of_parts; } 3>&1
}

# With a part missing, lucarne tells from the parts' headers which photons they are and how to bake them. It refuses
# them before it reads more.
run_last() {
  look_for_parts
  if ! $allow_gaps && [ "${#present[@]}" -lt "${#parts[@]}" ]; then
    inputs=("${present[@]}")
    last=1
  else
    look_for_nodes
    gather "$last" 1
  fi
  merge_last || exit
  rm -f "$tree"/[0-9]*.[0-9]*.{part,from,from.new,list,log,done} "$tree"/{last,parts}.list
  rmdir "$tree" 2>/dev/null || true
}

# afterany and not afterok, which would leave the jobs above a failed one in the queue for ever. They run, and the last
# tells what is missing. Of two dependencies sbatch takes the second, so that the user's is for the first level only.
submit() {
  local level job after=()
  local sbatch=(sbatch --parsable --requeue --open-mode=append --job-name="lucarne-${name##*/}-merge")
  # shellcheck disable=SC2206 # several options in one variable
  sbatch+=(${LUCARNE_SBATCH:-})
  for ((level = 1; level < last; ++level)); do
    job=$("${sbatch[@]}" "${after[@]}" --array="1-${tasks[level]}" --output="$tree/$level.%a.log" \
      "$self" --run-node "$lucarne" "$level" "" "${again[@]}")
    after=(--dependency="afterany:${job%%;*}")
    echo "level-$level ${job%%;*}"
  done
  job=$("${sbatch[@]}" "${after[@]}" --output="$name.log" "$self" --run-last "$lucarne" "${again[@]}")
  echo "merge ${job%%;*}"
  say "$name.log has the result"
}

run_here() {
  local level part
  for part in "${parts[@]}"; do
    if [ ! -f "$part" ] && ! $allow_gaps; then
      run_last
      return
    fi
  done
  for ((level = 1; level < last; ++level)); do
    say "level $level of $last: ${tasks[level - 1]} parts to ${tasks[level]}"
    seq "${tasks[level]}" | xargs -P "${LUCARNE_JOBS:-$(nproc)}" -I'{}' \
      "$self" --run-node "$lucarne" "$level" '{}' "${again[@]}" || break
  done
  run_last
}

start() {
  [[ "$lucarne" != */* ]] || lucarne=$(realpath -e "$lucarne")
  self=$(realpath "$0")
  mkdir -p "$tree"
  printf '%s\n' "${parts[@]}" >"$tree/parts.list.new"
  mv "$tree/parts.list.new" "$tree/parts.list"
  remove_old_nodes
  again=("@$tree/parts.list" "$out" "$fan_in" "${options[@]}")
  ! $allow_gaps || again=(--allow-gaps "${again[@]}")
  if [ "${LUCARNE_LOCAL:-}" != 1 ] && command -v sbatch >/dev/null; then submit; else run_here; fi
}

top=$(realpath -m "$(dirname "$0")/../..")
role=start
lucarne=${LUCARNE:-$top/build/release/cli/lucarne}
allow_gaps=false
case "${1:-}" in
  --run-node)
    role=run-node
    lucarne=$2
    level=$3
    k=$4
    shift 4
    ;;
  --run-last)
    role=run-last
    lucarne=$2
    shift 2
    ;;
esac
if [ "${1:-}" = --allow-gaps ]; then
  allow_gaps=true
  shift
fi
[[ $# -ge 2 && "$1" != -* && "$2" == *?.dlm && "${3:-auto}" =~ ^(auto|[2-9]|[1-9][0-9]+)$ ]] || usage
out=$(realpath -m "$2")
name=${out%.dlm}
tree=$name.tree
fan_in=${3:-auto}
options=("${@:4}")
read_parts "$1"
choose_fan_in
plan

case "$role" in
  start) start ;;
  run-node)
    if [ -n "$k" ]; then exec >"$tree/$level.$k.log" 2>&1; fi
    run_node "$level" "${k:-$SLURM_ARRAY_TASK_ID}"
    ;;
  run-last) run_last ;;
esac
