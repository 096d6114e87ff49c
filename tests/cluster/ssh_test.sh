#!/usr/bin/env bash
# ssh_test.sh LUCARNE: scripts/cluster/ssh-machines.sh over four machines (see namespaces.sh), one of which dies in the
# middle. Ends with 77 where something it needs is missing.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=tests/cluster/namespaces.sh
. "$here/namespaces.sh"

[ $# -eq 1 ] || {
  echo "usage: ssh_test.sh LUCARNE" >&2
  exit 2
}
lucarne=$(realpath -e "$1")
need ssh openssh-client
need sshd openssh-server
need_namespaces
isolate 300 "$lucarne"

recipe=$here/../../scripts/cluster/ssh-machines.sh
scene=$here/../../scenes/two_lamps.glb
bake_options=(--photons "$(photons_for 16)" --density 4 --threads 1)
export LUCARNE=$lucarne LUCARNE_REMOTE=$lucarne
export LUCARNE_SSH_OPTIONS="-F $folder/ssh_config -o ConnectTimeout=3 -o ServerAliveInterval=1 -o ServerAliveCountMax=3"

# run_recipe LOG MACHINE…
run_recipe() {
  local log=$1
  shift
  "$recipe" "$scene" "$folder/shared.dlm" "$@" -- "${bake_options[@]}" --checkpoint 0.3s >"$log" 2>&1
}

work_of() { compgen -G "$folder/$1/home/lucarne-bakes/*/$2" >/dev/null; }

# One machine dies when it has something to lose.
die_in_the_middle() {
  local run log=$folder/first.log status=0
  run_recipe "$log" m1 m2 m3 m4 &
  run=$!
  within 60 work_of m2 '2.checkpoint/*.part' || fail "m2 saved nothing: $(cat "$log")"
  machine_dies m2
  note "m2 is dead"
  wait "$run" || status=$?
  [ "$status" -eq 1 ] || fail "exit code $status with a dead machine: $(cat "$log")"
  expect_text 'part 2 of 4 is missing \(m2\)' "$log"
  for k in 1 3 4; do
    [ -f "$folder/shared.parts/$k.part" ] || fail "part $k was lost with m2: $(cat "$log")"
  done
  [ ! -f "$folder/shared.parts/2.part" ] || fail "m2 was done before it died: the test needs more photons"
  [ -d "$folder/shared.dlm" ] || fail "the other parts were not merged: $(cat "$log")"
  ! [ "$(content_hash "$folder/shared.dlm")" = "$(content_hash "$folder/single.dlm")" ] ||
    fail "the gap makes no difference"
}

# The machine is back, with its disk: it alone works, and goes on from its checkpoint.
return_and_rerun() {
  local log=$folder/second.log before
  before=$(stat -c %Y.%i "$folder"/shared.parts/[134].part)
  machine_returns m2
  start_sshd m2
  run_recipe "$log" m1 m2 m3 m4 || fail "the second run ended with $?: $(cat "$log")"
  [ "$before" = "$(stat -c %Y.%i "$folder"/shared.parts/[134].part)" ] || fail "parts were baked twice"
  [ "$(grep -c 'begins on' "$log")" -eq 1 ] || fail "more than one part was baked: $(cat "$log")"
  expect_text 'part 2 of 4 begins on m2' "$log"
  expect_text 'going on from' "$folder/shared.parts/2.log"
  expect_same_hash "$folder/shared.dlm" "$folder/single.dlm"
  ! work_of m2 '*' || fail "files are left on m2"
}

# Nothing is baked when all is there; other options are another bake.
run_once_more() {
  local log=$folder/third.log
  run_recipe "$log" m1 m3 || fail "the third run ended with $?: $(cat "$log")"
  ! grep -q 'begins on' "$log" || fail "a complete bake was baked again: $(cat "$log")"
  expect_same_hash "$folder/shared.dlm" "$folder/single.dlm"
  bake_options+=(--seed 7)
  ! run_recipe "$log" m1 m3 || fail "other options were taken for the same bake"
  expect_text 'another bake' "$log"
}

# The part of a machine that stays away is baked by another one.
replace_a_machine() {
  local log=$folder/fourth.log
  rm "$folder/shared.parts/2.part"
  machine_dies m2
  run_recipe "$log" m1 m2 m3 m4 || fail "the run without m2 ended with $?: $(cat "$log")"
  expect_text 'm2 is left out' "$log"
  expect_text 'part 2 of 4 begins on m[134]' "$log"
  expect_same_hash "$folder/shared.dlm" "$folder/single.dlm"
}

bakes_on() { ip netns pids "$1" | xargs -r ps -o args= -p | grep -q "bake scene.glb"; }

# Stopped by hand, the recipe stops the bakes on the machines. Ended without a chance to do so, as when a laptop is
# closed, it leaves them to work. The next run collects.
stop_and_go_on() {
  local run status=0 log=$folder/stopped.log
  local command=("$recipe" "$scene" "$folder/stopped.dlm" m3 m4 -- "${bake_options[@]}" --checkpoint 0.3s)
  "${command[@]}" >"$log" 2>&1 &
  run=$!
  within 60 work_of m3 '1.checkpoint/*.part' || fail "m3 saved nothing: $(cat "$log")"
  kill -TERM "$run"
  wait "$run" || status=$?
  [ "$status" -eq 130 ] || fail "exit code $status when stopped: $(cat "$log")"
  ! bakes_on m3 || fail "a stopped bake goes on"
  work_of m3 '1.checkpoint/*.part' || fail "the state was not kept"

  "${command[@]}" >>"$log" 2>&1 &
  run=$!
  within 60 bakes_on m3 || fail "the stopped bake does not go on: $(cat "$log")"
  pkill -KILL -P "$run" || true
  kill -KILL "$run"
  wait "$run" 2>/dev/null || true
  bakes_on m3 || fail "a bake did not survive its connection"
  "${command[@]}" >>"$log" 2>&1 || fail "going on ended with $?: $(cat "$log")"
  expect_same_hash "$folder/stopped.dlm" "$folder/single.dlm"
}

make_machines 4
make_keys
for machine in m1 m2 m3 m4; do
  start_sshd "$machine"
done
note "four machines answer"
"$lucarne" bake "$scene" -o "$folder/single.dlm" "${bake_options[@]}" --quiet
die_in_the_middle
return_and_rerun
note "m2 is back, and its part with it"
stop_and_go_on
note "a stopped bake went on, one without connection was collected"
replace_a_machine
run_once_more
note "four machines make $(content_hash "$folder/shared.dlm"), as one does"
