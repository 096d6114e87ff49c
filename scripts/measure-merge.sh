#!/usr/bin/env bash
# measure-merge.sh [FOLDER [PARTS]]: makes PARTS (200) parts of about 24 MB in FOLDER (out/merge), then merges 2 and all of them
# and prints, as a Markdown table, the rates beside plain reading of the same files, and the peak of memory. As root it empties
# the file cache before each reading, so that the disk is measured; otherwise memory is. Needs 5 GB; removes the parts.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=$(realpath -m "${1:-$top/out/merge}")
count=${2:-200}
lucarne=${LUCARNE:-$top/build/release/cli/lucarne}
mkdir -p "$out"
trap 'rm -rf "$out"/p*.part "$out/sum.part" "$out/sum.dlm"' EXIT

for ((i = 0; i < count; ++i)); do
  "$lucarne" bake "$top/scenes/cornell_box.glb" -o "$out/p$i.part" --keep-all-directions --density 110 --directions 64 \
    --texels 4M --photon-range "${i}k:$((i + 1))k" --photons 1M --checkpoint 0 --quiet
done
sync
bytes=$(($(stat -c %s "$out/p0.part") * count))

empty_cache() { { echo 3 >/proc/sys/vm/drop_caches; } 2>/dev/null || cached=" (from memory)"; }

# timed COMMAND…: seconds it took.
timed() {
  local start end
  start=$(date +%s.%N)
  "$@" >/dev/null
  end=$(date +%s.%N)
  awk -v a="$start" -v b="$end" 'BEGIN { print b - a }'
}
rate() { awk -v bytes="$1" -v seconds="$2" 'BEGIN { printf "%.0f", bytes / seconds / 1e6 }'; }
peak() { python3 -c 'import json, sys; r = json.load(open(sys.argv[1])); print(round(r["peak_memory_bytes"] / 2**20))' "$1"; }

cached=""
declare -a reading=() verifying=() merging=()
for _ in 1 2 3; do
  empty_cache
  reading+=("$(rate "$bytes" "$(timed cat "$out"/p*.part)")")
  empty_cache
  verifying+=("$(rate "$bytes" "$(timed "$lucarne" merge "$out" --verify --quiet --report "$out/verify.json")")")
  empty_cache
  merging+=("$(rate "$bytes" "$(timed "$lucarne" merge "$out" -o "$out/sum.dlm" --quiet --report "$out/all.json")")")
done
"$lucarne" merge "$out/p0.part" "$out/p1.part" -o "$out/sum.dlm" --quiet --report "$out/two.json"

median() { printf '%s\n' "$@" | sort -n | sed -n 2p; }
echo "$count parts of $((bytes / count / 1000000)) MB, medians of 3$cached:"
echo
echo "| | MB/s | peak MiB |"
echo "|---|---|---|"
echo "| cat of all parts | $(median "${reading[@]}") | – |"
echo "| merge --verify | $(median "${verifying[@]}") | $(peak "$out/verify.json") |"
echo "| merge -o sum.dlm | $(median "${merging[@]}") | $(peak "$out/all.json") |"
echo "| merge of 2 parts | – | $(peak "$out/two.json") |"
