#!/usr/bin/env bash
# ssh-machines.sh SCENE.glb OUT.dlm HOST… [-- BAKE OPTION…]: bakes SCENE.glb on several machines over ssh, one part
# each, and merges the parts here. SCENE - is the built-in room. Each HOST is what ssh understands and must let you in
# without a question.
#
# When a machine dies, the parts of the others are merged and the missing one is named; the exit code is 1. The same
# command again bakes only what is missing: where it was begun, from its checkpoint, or, when that machine is gone or no
# longer listed, on another. Bakes survive a lost connection; Ctrl-C stops them, and they keep their state for the next
# run. Parts lie in OUT.parts/ here, and in LUCARNE_REMOTE_FOLDER on the machines until all are merged.
#
#   LUCARNE                the program here, for merging (default: the one built here)
#   LUCARNE_REMOTE         the program on the machines, its name or absolute path (default: lucarne)
#   LUCARNE_REMOTE_FOLDER  where to work there (default: lucarne-bakes, in the home folder)
#   LUCARNE_SSH_OPTIONS    options for ssh and scp, e.g. "-F my_ssh_config -o ServerAliveInterval=5"
#   LUCARNE_PARTS          number of parts of a new bake (default: one a machine)
# shellcheck disable=SC2016 # other shells expand what stands in single quotes
set -euo pipefail

usage() {
  sed -n '2,/^set/{/^set/d;/shellcheck/d;s/^# \{0,1\}//;p}' "$0" >&2
  exit 2
}

say() { echo "ssh-machines: $*" >&2; }

die() {
  say "$@"
  exit 1
}

# A machine that goes silent is given up after a minute. The first value given counts, so the user's options come first.
# shellcheck disable=SC2206 # several options in one variable
ssh_options=(${LUCARNE_SSH_OPTIONS:-} -o BatchMode=yes -o ConnectTimeout=10)
ssh_options+=(-o ServerAliveInterval=15 -o ServerAliveCountMax=4)

# remote HOST COMMAND WORD…: quotes the words for the shell over there.
remote() {
  local host=$1
  shift
  ssh -n "${ssh_options[@]}" "$host" "$(printf '%q ' "$@")"
}

# Old parts would merge into the old light maps without a word when the scene or an option has changed. The number of
# parts is that of the first run, so that another list of machines can finish what one began.
claim_folder() {
  local bake
  mkdir -p "$parts"
  [ -f "$parts/count.txt" ] || echo "${LUCARNE_PARTS:-${#hosts[@]}}" >"$parts/count.txt"
  count=$(cat "$parts/count.txt")
  bake=$(printf '%s\n' "scene $scene_sum" "parts $count" "options ${options[*]@Q}")
  [ -f "$parts/bake.txt" ] || echo "$bake" >"$parts/bake.txt"
  [ "$bake" = "$(cat "$parts/bake.txt")" ] ||
    die "$parts holds the parts of another bake (see bake.txt there); remove it, or take another name"
  folder=${LUCARNE_REMOTE_FOLDER:-lucarne-bakes}/$(basename "$name" | tr -c 'A-Za-z0-9._\n' _)
  folder+=-$(sha256sum <<<"$bake" | head -c 12)
}

is_there() { [ -f "$parts/$1.part" ] && "$lucarne" merge "$parts/$1.part" --verify >/dev/null 2>&1; }

# Looks whether the machine answers and has the program, and brings the scene. Its name in ready/ says that it did.
prepare() {
  local host=$1
  remote "$host" mkdir -p "$folder" || return
  remote "$host" sh -c 'command -v "$0" >/dev/null' "$remote_lucarne" || {
    say "$host has no program \"$remote_lucarne\": install it, or tell where it is in LUCARNE_REMOTE"
    return 1
  }
  [ "$scene" = - ] || bring_scene "$host" || return
  touch "$run/ready/$host"
}

bring_scene() {
  local host=$1
  remote "$host" sh -c 'cd "$0" && echo "$1  scene.glb" | sha256sum --check --status' "$folder" "$scene_sum" \
    2>/dev/null && return
  scp -q "${ssh_options[@]}" "$scene" "$host:$folder/scene.glb.new" &&
    remote "$host" mv "$folder/scene.glb.new" "$folder/scene.glb"
}

# deal K: the part goes to the machine that has begun it, else to the one with the least to do. Prints the machine.
deal() {
  local k=$1 host least=
  host=$(cat "$parts/$k.host" 2>/dev/null || true)
  [ -z "$host" ] || [ ! -f "$run/ready/$host" ] || least=$host
  if [ -z "$least" ]; then
    for host in "${hosts[@]}"; do
      [ -f "$run/ready/$host" ] || continue
      if [ -z "$least" ] || [ "$(wc -l <"$run/todo.$host")" -lt "$(wc -l <"$run/todo.$least")" ]; then
        least=$host
      fi
    done
  fi
  echo "$least"
}

# Runs on the machine, by its sh, in the bake's folder. A bake whose connection was lost may still be running: it holds
# the lock, and the wait for it ends with its part done. Output goes to a file, since a broken connection would end a
# bake that writes to it.
bake_there='
cd "$1" || exit 1
k=$2
shift 2
exec 9>"$k.lock"
flock 9
[ ! -f "$k.part" ] || exit 0
echo $$ >"$k.pid"
exec "$@" >>"$k.log" 2>&1
'
stop_there='cd "$0" && for k; do [ ! -f "$k.pid" ] || flock -n "$k.lock" true || kill -TERM "$(cat "$k.pid")"; done'

# One machine: its parts, one after the other.
work() {
  local host=$1 k why scene_argument=()
  [ "$scene" = - ] || scene_argument=(scene.glb)
  while read -r k; do
    echo "$host" >"$parts/$k.host"
    say "part $k of $count begins on $host"
    if ! remote "$host" sh -c "$bake_there" sh "$folder" "$k" \
      "$remote_lucarne" bake "${scene_argument[@]}" -o "$k.part" --part "$k/$count" --resume "${options[@]}"; then
      why=$(remote "$host" tail -n 1 "$folder/$k.log" 2>/dev/null || echo "$host is silent")
      say "part $k of $count failed on $host: $why"
      return 1
    fi
    fetch "$host" "$k" || {
      say "part $k of $count could not be fetched from $host"
      return 1
    }
    say "part $k of $count is done on $host"
  done <"$run/todo.$host"
}

# Under its name a part is always whole.
fetch() {
  scp -q "${ssh_options[@]}" "$1:$folder/$2.log" "$parts/$2.log"
  scp -q "${ssh_options[@]}" "$1:$folder/$2.part" "$parts/$2.fetching" &&
    mv "$parts/$2.fetching" "$parts/$2.part" &&
    is_there "$2"
}

stop_all() {
  local host
  trap '' INT TERM
  say "stopping the bakes on the machines; they keep their state, the same command goes on"
  for host in "${hosts[@]}"; do
    # shellcheck disable=SC2046 # one word a part
    remote "$host" sh -c "$stop_there" "$folder" $(cat "$run/todo.$host") 2>/dev/null &
  done
  wait
  exit 130
}

prepare_all() {
  local host
  for host in "${hosts[@]}"; do
    : >"$run/todo.$host"
    prepare "$host" &
  done
  wait
  for host in "${hosts[@]}"; do
    [ -f "$run/ready/$host" ] || say "$host is left out"
  done
  [ -n "$(ls "$run/ready")" ] || die "no machine can be used"
}

bake_missing() {
  local k host
  prepare_all
  for k in "$@"; do
    host=$(deal "$k")
    echo "$k" >>"$run/todo.$host"
  done
  trap stop_all INT TERM
  for host in "${hosts[@]}"; do
    work "$host" &
  done
  wait
  trap - INT TERM
}

# Sets missing.
look() {
  local k
  missing=()
  for ((k = 1; k <= count; ++k)); do
    is_there "$k" || missing+=("$k")
  done
}

merge() {
  local k files=() complete=()
  for ((k = 1; k <= count; ++k)); do
    ! is_there "$k" || files+=("$parts/$k.part")
  done
  [ ${#files[@]} -gt 0 ] || die "no part was baked; the same command again goes on"
  [ ${#missing[@]} -gt 0 ] || complete=(--complete)
  printf '%s\n' "${files[@]}" >"$parts/list.txt"
  "$lucarne" merge "@$parts/list.txt" -o "$out" "${complete[@]}"
}

# The machines are borrowed: nothing stays there.
clean_machines() {
  local host
  while read -r host; do
    remote "$host" rm -rf "$folder" 2>/dev/null &
  done < <(cat "$parts"/*.host "$run/hosts" | sort -u)
  wait
}

main() {
  claim_folder
  look
  local baked=${#missing[@]} k
  if [ "$baked" -gt 0 ]; then
    bake_missing "${missing[@]}"
    look
  fi
  merge
  if [ ${#missing[@]} -gt 0 ]; then
    for k in "${missing[@]}"; do
      say "part $k of $count is missing ($(cat "$parts/$k.host" 2>/dev/null || echo "on no machine yet"))"
    done
    die "$out lacks ${#missing[@]} of $count parts; the same command bakes only these"
  fi
  [ "$baked" -eq 0 ] || clean_machines
  say "$out is complete"
}

[[ $# -ge 3 && "$2" == *?.dlm ]] || usage
scene=$1
out=$2
shift 2
name=${out%.dlm}
parts=$name.parts
hosts=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do
  [[ "$1" != -* && "$1" != */* ]] || usage
  [[ " ${hosts[*]} " != *" $1 "* ]] || die "$1 is listed twice"
  hosts+=("$1")
  shift
done
[ ${#hosts[@]} -gt 0 ] || usage
options=("${@:2}")
lucarne=${LUCARNE:-$(realpath -m "$(dirname "$0")/../..")/build/release/cli/lucarne}
remote_lucarne=${LUCARNE_REMOTE:-lucarne}
# A .gltf has its data in other files, which would stay here.
[ "$scene" = - ] || [[ "$scene" == *.glb ]] || die "$scene: only a .glb can be brought to the machines; pack it as one"
scene_sum=-
[ "$scene" = - ] || scene_sum=$(sha256sum <"$scene" | cut -d' ' -f1)
run=$(mktemp -d)
trap 'rm -rf "$run"' EXIT
mkdir "$run/ready"
printf '%s\n' "${hosts[@]}" >"$run/hosts"
main
