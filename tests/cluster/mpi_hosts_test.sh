#!/usr/bin/env bash
# mpi_hosts_test.sh LUCARNE: a bake over MPI ranks on two machines that mpirun reaches by ssh (see namespaces.sh), one
# rank of which is killed in the middle. Ends with 77 where something it needs is missing.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=tests/cluster/namespaces.sh
. "$here/namespaces.sh"

[ $# -eq 1 ] || {
  echo "usage: mpi_hosts_test.sh LUCARNE" >&2
  exit 2
}
lucarne=$(realpath -e "$1")
need mpirun openmpi-bin
need ssh openssh-client
need sshd openssh-server
need_namespaces
isolate 300 "$lucarne"

scene=$here/../../scenes/two_lamps.glb
bake_options=(--photons "$(photons_for 16)" --density 4)
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# bake_over HOSTS RANKS OPTION…: HOSTS is a list of machine:slots. Open MPI is told the network, since each machine has
# one more than it can use, the loopback.
bake_over() {
  mpirun --host "$1" -n "$2" --bind-to none --oversubscribe --mca plm_rsh_agent "ssh -F $folder/ssh_config" \
    --mca oob_tcp_if_include 10.99.0.0/24 --mca btl_tcp_if_include 10.99.0.0/24 \
    "$lucarne" bake "$scene" "${@:3}" "${bake_options[@]}" --threads 1
}

bakes_on() { ip netns pids "$1" | xargs -r ps -o pid=,args= -p | grep " $lucarne bake"; }
no_bake_runs() { ! pgrep -f "^$lucarne bake" >/dev/null; }

four_ranks_are_one() {
  bake_over m1:2,m2:2 4 -o "$folder/ranks.dlm" >"$folder/ranks.log" 2>&1 ||
    fail "mpirun ended with $?: $(cat "$folder/ranks.log")"
  expect_same_hash "$folder/ranks.dlm" "$folder/single.dlm"
}

# Rank 3 is one of the two on m2. What the ranks have saved together is enough for three ranks to go on.
kill_a_rank() {
  local run rank log=$folder/killed.log out=$folder/killed.dlm
  bake_over m1:2,m2:2 4 -o "$out" --checkpoint 0.3s >"$log" 2>&1 &
  run=$!
  within 60 has_state "$folder/killed.checkpoint" || fail "nothing was saved: $(cat "$log")"
  rank=$(bakes_on m2 | awk 'END { print $1 }')
  kill -KILL "$rank"
  ! wait "$run" || fail "the death of a rank was not noticed"
  [ ! -e "$out" ] || fail "light maps were written without the dead rank"
  within 20 no_bake_runs || fail "ranks are left: $(pgrep -fa lucarne)"
  bake_over m1:1,m2:2 3 -o "$out" --resume >>"$log" 2>&1 || fail "three ranks do not go on: $(cat "$log")"
  expect_text 'going on from' "$log"
  expect_same_hash "$out" "$folder/single.dlm"
}

make_machines 2
make_keys
start_sshd m1
start_sshd m2
"$lucarne" bake "$scene" -o "$folder/single.dlm" "${bake_options[@]}" --quiet
four_ranks_are_one
note "four ranks on two machines make $(content_hash "$folder/ranks.dlm"), as one process does"
kill_a_rank
note "a rank was killed; three ranks went on to the same"
