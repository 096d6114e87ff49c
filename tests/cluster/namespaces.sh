# shellcheck shell=bash
# Several machines on one, for the tests here to source: network namespaces on a bridge, each with a host name, a home
# folder and an sshd of its own. All of it lives in namespaces of the test: it can reach nothing outside, and nothing
# there is seen or changed.
# shellcheck disable=SC2154 # the tests set lucarne and scene

test_name=$(basename "$0" .sh)
head_address=10.99.0.254 # this shell's end of the bridge
folder=                  # set by isolate: the test's files

skip() {
  echo "SKIP: $*"
  exit 77
}

fail() {
  echo "$test_name: $*" >&2
  exit 1
}

note() { echo "$test_name: $*"; }

# need COMMAND PACKAGE
need() {
  PATH=$PATH:/usr/sbin:/sbin command -v "$1" >/dev/null || skip "$2 is not installed ($1)"
}

namespaces=(setpriv --pdeathsig KILL unshare --net --pid --fork --kill-child --mount --mount-proc --uts)

need_namespaces() {
  need unshare util-linux
  need ip iproute2
  [ "$(id -u)" -eq 0 ] || skip "no right to make namespaces (not root)"
  "${namespaces[@]}" true 2>/dev/null || skip "no right to make namespaces"
  "${namespaces[@]}" ip link add bridge0 type bridge 2>/dev/null || skip "this kernel makes no bridges"
}

# isolate SECONDS ARGUMENT…: runs this script again, as the first process of its own namespaces, and there returns. When
# that process ends, the kernel ends all others in the namespaces and takes the networks away; and it ends with the
# test, even with one that was killed. So nothing outlives the test.
isolate() {
  local limit=$1 status=0
  shift
  export PATH=$PATH:/usr/sbin:/sbin
  if [ -n "${LUCARNE_TEST_FOLDER:-}" ]; then
    folder=$LUCARNE_TEST_FOLDER
    export TMPDIR=$folder
    unset LUCARNE_TEST_FOLDER
    return
  fi
  folder=$(mktemp -d)
  LUCARNE_TEST_FOLDER=$folder "${namespaces[@]}" "$0" "$@" </dev/null &
  inside=$!
  trap 'kill -KILL "$inside" 2>/dev/null || true; wait 2>/dev/null; rm -rf "$folder"' EXIT
  trap 'exit 130' INT TERM
  local end=$((SECONDS + limit))
  while kill -0 "$inside" 2>/dev/null; do
    [ "$SECONDS" -lt "$end" ] || fail "not done after $limit seconds"
    sleep 0.2
  done
  wait "$inside" || status=$?
  exit "$status"
}

# make_machines COUNT: m1, m2 … at 10.99.0.1, 10.99.0.2 …
make_machines() {
  local i
  # Names of network namespaces, sockets of daemons and names of hosts: all of them this test's alone.
  mount -t tmpfs tmpfs /run
  mkdir /run/sshd
  # An sshd lets nobody in whose account is locked, as root's may be.
  echo 'root:*:19000:0:99999:7:::' >"$folder/shadow"
  chmod 600 "$folder/shadow"
  mount --bind "$folder/shadow" /etc/shadow
  printf '%s\n' "127.0.0.1 localhost" "$head_address head" >"$folder/hosts"
  for ((i = 1; i <= $1; ++i)); do
    echo "10.99.0.$i m$i" >>"$folder/hosts"
  done
  mount --bind "$folder/hosts" /etc/hosts
  hostname head
  ip link set lo up
  ip link add bridge0 type bridge
  ip address add "$head_address/24" dev bridge0
  ip link set bridge0 up
  for ((i = 1; i <= $1; ++i)); do
    make_machine "m$i" "10.99.0.$i"
  done
}

make_machine() {
  local name=$1 address=$2
  mkdir -p "$folder/$name/home"
  ip netns add "$name"
  ip link add "to-$name" type veth peer name eth0 netns "$name"
  ip link set "to-$name" master bridge0 up
  ip -n "$name" link set lo up
  ip -n "$name" address add "$address/24" dev eth0
  ip -n "$name" link set eth0 up
}

# on_machine NAME COMMAND…: with that machine's network, name and home folder; other files are common to all.
on_machine() {
  local name=$1
  shift
  # shellcheck disable=SC2016 # for the inner shell
  exec ip netns exec "$name" unshare --uts --mount \
    sh -c 'hostname "$1" && mount --bind "$2" "$HOME" && shift 2 && exec "$@"' sh "$name" "$folder/$name/home" "$@"
}

# Keys of this test alone, and $folder/ssh_config to use them.
make_keys() {
  ssh-keygen -q -t ed25519 -N '' -f "$folder/host_key"
  ssh-keygen -q -t ed25519 -N '' -f "$folder/user_key"
  echo "* $(cut -d' ' -f1,2 "$folder/host_key.pub")" >"$folder/known_hosts"
  cat >"$folder/ssh_config" <<END
Host *
  User root
  IdentityFile $folder/user_key
  IdentitiesOnly yes
  UserKnownHostsFile $folder/known_hosts
  GlobalKnownHostsFile /dev/null
  StrictHostKeyChecking yes
END
  cat >"$folder/sshd_config" <<END
HostKey $folder/host_key
AuthorizedKeysFile $folder/user_key.pub
PermitRootLogin prohibit-password
PasswordAuthentication no
KbdInteractiveAuthentication no
StrictModes no
UsePAM no
PidFile none
Subsystem sftp internal-sftp
END
}

# start_sshd NAME, and waits until it answers.
start_sshd() {
  on_machine "$1" "$(command -v sshd)" -D -e -f "$folder/sshd_config" 2>>"$folder/$1/sshd.log" &
  disown # no message when it is killed
  within 15 ssh -n -F "$folder/ssh_config" "$1" true 2>"$folder/ssh.log" ||
    fail "no sshd on $1: $(cat "$folder/$1/sshd.log" "$folder/ssh.log")"
}

# As when the power goes: no process says good-bye, and packets are lost without an answer.
machine_dies() {
  ip link set "to-$1" down
  ip netns pids "$1" | xargs -r kill -KILL
}

machine_returns() {
  ip link set "to-$1" up
}

# within SECONDS COMMAND…: tries until it succeeds.
within() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ "$SECONDS" -lt "$end" ] || return 1
    sleep 0.1
  done
}

# photons_for SECONDS: as many as one thread traces in so long, so that with any build there is a middle to be killed
# in. The best of three tries counts, since others may be at work on this machine.
photons_for() {
  local rate best=0
  for _ in 1 2 3; do
    "$lucarne" bake "$scene" -o "$folder/rate.dlm" --photons 400k --density 4 --threads 1 --quiet \
      --report "$folder/rate.json"
    rate=$(sed -nE 's/.*"photons_per_second": ?([0-9]+).*/\1/p' "$folder/rate.json")
    [ "$rate" -le "$best" ] || best=$rate
  done
  echo $((best * $1 / 1000000 + 1))M
}

# has_state CHECKPOINT_FOLDER: something is saved there.
has_state() { compgen -G "$1/*.part" >/dev/null; }

# content_hash FILE, by the program $lucarne
content_hash() {
  local hash
  hash=$("$lucarne" info "$1" --json | sed -nE 's/.*"content_hash": ?"([0-9a-f]{32})".*/\1/p')
  [ -n "$hash" ] || fail "no content_hash of $1"
  echo "$hash"
}

expect_same_hash() {
  [ "$(content_hash "$1")" = "$(content_hash "$2")" ] ||
    fail "$1 differs from $2: $(content_hash "$1") $(content_hash "$2")"
}

# expect_text PATTERN FILE
expect_text() { grep -Eq -- "$1" "$2" || fail "no \"$1\" in $2: $(tail -c 2000 "$2")"; }
