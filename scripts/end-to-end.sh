#!/usr/bin/env bash
# end-to-end.sh LUCARNE: bakes the built-in scene with few photons through the program itself, then asks every subcommand
# about the result. Prints nothing but what failed.
set -euo pipefail

lucarne=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
  echo "end-to-end: $*" >&2
  exit 1
}

# expect_exit CODE COMMAND…: the command must end so, and say so in one line on stderr when it is an error.
expect_exit() {
  local expected=$1 code=0
  shift
  "$@" >stdout.txt 2>stderr.txt || code=$?
  [ "$code" -eq "$expected" ] || fail "exit code $code instead of $expected: $* : $(cat stderr.txt)"
  if [ "$expected" -ne 0 ] && [ "$(wc -l <stderr.txt)" -ne 1 ]; then
    fail "not one line of error: $* : $(cat stderr.txt)"
  fi
}

# expect_text PATTERN FILE
expect_text() { grep -Eq -- "$1" "$2" || fail "no \"$1\" in $2: $(head -c 1000 "$2")"; }

# A black or single-coloured picture packs into a few hundred bytes.
expect_picture() {
  [ "$(wc -c <"$1")" -gt 10000 ] || fail "$1 has only $(wc -c <"$1") bytes: it shows nothing"
}

expect_exit 0 "$lucarne" --help
expect_exit 0 "$lucarne" bake -o room.dlm --photons 200k --report report.json --quiet
[ ! -s stderr.txt ] || fail "--quiet is not quiet: $(cat stderr.txt)"
for file in manifest.json scene.glb irradiance.exr directional.exr; do
  [ -s "room.dlm/$file" ] || fail "room.dlm/$file is missing"
done
expect_text '"photons": 200000' report.json
expect_text '"content_hash": "[0-9a-f]{32}"' report.json

expect_exit 0 "$lucarne" info room.dlm --json
expect_text '"content_hash": ?"[0-9a-f]{32}"' stdout.txt

# The same bake in three parts, merged as a tree, and by three MPI ranks: the same files to the last bit.
for k in 1 2 3; do
  expect_exit 0 "$lucarne" bake -o "room-$k.part" --photons 200k --part "$k/3" --quiet --resume
done
expect_exit 0 "$lucarne" info room-2.part --json
expect_text '"photon_ranges"' stdout.txt
expect_exit 0 "$lucarne" merge room-3.part room-1.part -o two.part
expect_text 'so far 1 of 3 parts missing, photons' stderr.txt
expect_exit 0 "$lucarne" merge two.part -o gap.dlm
expect_text '1 of 3 parts missing, photons .*; the result is valid with more noise; bake them with: lucarne bake .*--part 2/3' stderr.txt
expect_exit 4 "$lucarne" merge two.part -o merged.dlm --complete
expect_exit 4 "$lucarne" merge two.part room-1.part -o merged.dlm
[ ! -e merged.dlm ] || fail "a refused merge left merged.dlm"
expect_exit 0 "$lucarne" merge two.part room-2.part -o merged.dlm --complete --quiet
diff -r room.dlm merged.dlm || fail "the merged light maps differ from those of one bake"
if command -v mpirun >/dev/null; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  expect_exit 0 mpirun --oversubscribe --bind-to none -n 3 "$lucarne" bake -o ranks.dlm --photons 200k --quiet
  diff -r room.dlm ranks.dlm || fail "the light maps of three MPI ranks differ from those of one process"
fi

# A point that floats far from everything has no light map: null, and no error.
echo "1000 1000 1000 0 1 0" >points.txt
"$lucarne" probe room.dlm --json <points.txt >probe.txt || fail "probe ended with $?"
expect_text '"irradiance": ?null' probe.txt
[ "$(wc -l <probe.txt)" -eq 1 ] || fail "probe printed $(wc -l <probe.txt) lines for one point"

for renderer in singlepass multipass; do
  expect_exit 0 "$lucarne" render room.dlm -o "$renderer.png" --size 320x180 --renderer "$renderer"
  expect_picture "$renderer.png"
done

expect_exit 2 "$lucarne" bake -o room.dlm --photons=-3
expect_exit 3 "$lucarne" bake missing.glb -o other.dlm
expect_exit 3 "$lucarne" info missing.dlm
echo '{' >room.dlm/manifest.json
expect_exit 3 "$lucarne" info room.dlm
[ ! -e other.dlm ] || fail "a failed bake left other.dlm"
