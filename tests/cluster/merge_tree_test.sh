#!/usr/bin/env bash
# merge_tree_test.sh LUCARNE: scripts/cluster/merge-tree.sh on this machine: the light maps of one bake from 22 parts in
# three levels of merges, and what it tells and writes where something is missing or altered. Under Slurm it is tested
# by slurm_test.sh.
set -euo pipefail

[ $# -eq 1 ] || {
  echo "usage: merge_tree_test.sh LUCARNE" >&2
  exit 2
}
top=$(cd "$(dirname "$0")/../.." && pwd)
lucarne=$(realpath -e "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export LUCARNE=$lucarne LUCARNE_LOCAL=1 LUCARNE_JOBS=2
count=22
parts=$folder/parts
tree=$folder/sum.tree
log=$folder/log
bake=("$lucarne" bake "$top/scenes/cornell_box.glb" --keep-all-directions --density 4 --photons 44k --quiet)

fail() {
  echo "merge_tree_test: $*" >&2
  exit 1
}

note() { echo "merge_tree_test: $*"; }

# expect STATUS [OPTION…] PARTS: merges them into sum.dlm, three at a time.
expect() {
  local expected=$1 status=0
  shift
  rm -rf "$folder/sum.dlm"
  "$top/scripts/cluster/merge-tree.sh" "$@" "$folder/sum.dlm" 3 >"$log" 2>&1 || status=$?
  [ "$status" -eq "$expected" ] || fail "exit code $status instead of $expected: $(cat "$log")"
  [ "$expected" -eq 0 ] || [ ! -e "$folder/sum.dlm" ] || fail "light maps were written: $(cat "$log")"
}

expect_text() { grep -Eq -- "$1" "${2:-$log}" || fail "no \"$1\" in ${2:-$log}: $(cat "${2:-$log}")"; }

# Also that nothing remains of the tree.
expect_single() {
  diff -r "$folder/sum.dlm" "$folder/single.dlm" || fail "not the light maps of one bake: $(cat "$log")"
  [ ! -e "$tree" ] || fail "left behind: $(ls "$tree")"
}

# alter FILE: one byte in the middle.
alter() {
  local middle=$(($(stat -c %s "$1") / 2)) byte
  byte=$(od -An -tu1 -j "$middle" -N 1 "$1")
  printf '%b' "\\x$(printf %x $((byte ^ 1)))" | dd of="$1" bs=1 seek="$middle" conv=notrunc status=none
}

ids() { (cd "$tree" && stat -c '%n %i %Y' -- *.part | sort); }

make_parts() {
  local k
  mkdir "$parts"
  for ((k = 1; k <= count; ++k)); do
    "${bake[@]}" -o "$parts/$k.part" --part "$k/$count" --checkpoint 0
  done
  "${bake[@]}" -o "$folder/single.dlm"
}

# 22 parts to 8, 8 to 3, and 3 to light maps; from a list, too, and with the fan-in that the script chooses.
levels() {
  expect 0 "$parts"
  expect_text 'level 1 of 3: 22 parts to 8'
  expect_text 'level 2 of 3: 8 parts to 3'
  expect_single
  (cd "$parts" && printf '%s\n' '# parts' *.part) >"$parts/list"
  expect 0 "@$parts/list"
  expect_single
  rm -rf "$folder/sum.dlm" "$parts/list"
  "$top/scripts/cluster/merge-tree.sh" "$parts" "$folder/sum.dlm" >"$log" 2>&1 || fail "$(cat "$log")"
  ! grep -q 'level' "$log" || fail "a tree for so few parts: $(cat "$log")"
  expect_single
}

# An altered part stops the tree and is named; when it is mended, only what was made of it is merged.
altered_part() {
  local before
  cp "$parts/11.part" "$folder/whole"
  alter "$parts/11.part"
  expect 1 "$parts"
  expect_text 'level 1, task 4 failed; its log is .*/sum.tree/1.4.log: .*parts/11.part'
  before=$(ids)
  [ "$(wc -l <<<"$before")" -eq 7 ] || fail "not the other seven: $before"
  cp "$folder/whole" "$parts/11.part"
  alter "$tree/1.2.part"
  keep_tree
  expect_text 'level 1, task 1: already there' "$folder/kept/1.1.log"
  expect_text 'level 1, task 2: 3 parts are one' "$folder/kept/1.2.log"
  expect_text 'level 1, task 4: 3 parts are one' "$folder/kept/1.4.log"
  [ "$(grep -Ev '^1\.[24]\.' <<<"$before")" = "$(cd "$folder/kept" && stat -c '%n %i %Y' 1.[135678].part)" ] ||
    fail "others were merged again, too: $before"
  expect_single
}

# keep_tree: merges, and has what lay in the tree in kept/, since it is removed in the end.
keep_tree() {
  rm -rf "$folder/kept"
  mkdir "$folder/kept"
  printf '%s\n' '#!/bin/sh' "case \"\$*\" in *last.list*) cp -al '$tree/'* '$folder/kept' ;; esac" \
    "exec '$lucarne' \"\$@\"" >"$folder/lucarne"
  chmod +x "$folder/lucarne"
  LUCARNE=$folder/lucarne expect 0 "$parts"
}

# What was merged is used as long as it is of the same parts; what is gone is merged again, with all above it.
go_on() {
  local before
  fail_last
  before=$(ids)
  rm "$tree/1.5.part"
  fail_last
  [ "$(grep -Ev '^(1\.5|2\.2)\.' <<<"$before")" = "$(ids | grep -Ev '^(1\.5|2\.2)\.')" ] ||
    fail "more than 1.5 and 2.2 was merged: $before $(ids)"
  [ "$(wc -l <<<"$before")" -eq "$(ids | wc -l)" ] || fail "1.5 or 2.2 is missing: $(ids)"
  touch "$parts/22.part"
  fail_last
  expect_text '1 parts are one' "$tree/1.8.log"
  expect 0 "$parts"
  expect_single
}

# The last merge is refused for an option.
fail_last() {
  if "$top/scripts/cluster/merge-tree.sh" "$parts" "$folder/sum.dlm" 3 --format none >"$log" 2>&1; then
    fail "merged with a wrong option"
  fi
  expect_text 'format'
}

# Two nodes of the last level that cannot be added up: it is told of which parts they are.
part_twice() {
  cp "$parts/1.part" "$parts/23.part"
  expect 4 "$parts"
  expect_text '2.1.part and .*2.3.part both hold photons 0..2k'
  expect_text '2.1.part is the sum of .*/parts/1.part to .*/parts/9.part'
  expect_text '2.3.part is the sum of .*/parts/19.part to .*/parts/23.part'
  rm "$parts/23.part"
}

# A part that should be there, and photons that are in none of the parts.
gaps() {
  local k
  mv "$parts/5.part" "$folder/5.part"
  for ((k = 1; k <= count; ++k)); do echo "$parts/$k.part"; done >"$folder/list"
  expect 4 "@$folder/list"
  expect_text 'parts/5.part is missing'
  expect_text '1 of 22 parts missing, photons 8k..10k, .*bake them with: .*-o [^ ]*/parts/.*--part 5/22'
  expect 4 "$parts"
  expect_text '1 of 22 parts missing, photons 8k..10k, .*bake them with: .*-o [^ ]*/parts/.*--part 5/22'
  mv "$parts/4.part" "$parts/6.part" "$folder"
  expect 0 --allow-gaps "@$folder/list"
  expect_text 'parts/4.part is missing'
  expect_text 'warning: 3 of 22 parts missing'
  "$lucarne" merge "$parts" -o "$folder/gaps.dlm" --quiet
  diff -r "$folder/sum.dlm" "$folder/gaps.dlm" || fail "not the light maps of one merge of these parts"
  mv "$folder"/[456].part "$parts"
  expect 0 "@$folder/list"
  expect_single
}

make_parts
note "$count parts are baked"
levels
note "three levels, and one, make the light maps of one bake"
altered_part
note "an altered part is named, and after its repair only what was made of it is merged"
go_on
note "what was merged is used again as long as it is of the same parts"
part_twice
note "a part that came twice is named by the merges that hold it"
gaps
note "gaps are named"
