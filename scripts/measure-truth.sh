#!/usr/bin/env bash
# Pictures of real scenes from their light maps, each beside its path-traced truth.
#
#   scripts/measure-truth.sh ASSETS OUT [LUCARNE]
#
# ASSETS has scenes/, models/ and env/. Writes OUT/NAME-baked.png and OUT/NAME-truth.png. A quarter of an hour on two cores.
set -euo pipefail
assets=$(realpath "$1")
out=$2
lucarne=$(realpath "${3:-build/release/cli/lucarne}")
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# picture NAME SCENE SAMPLES SKY|- BAKE-OPTIONS… [-- RENDER-OPTIONS…]
picture() {
  local name=$1 scene=$assets/$2 samples=$3 sky=() bake=()
  [ "$4" = - ] || sky=(--environment "$assets/env/$4")
  shift 4
  while [ $# -gt 0 ] && [ "$1" != -- ]; do bake+=("$1"); shift; done
  [ $# -eq 0 ] || shift
  "$lucarne" bake "$scene" -o "$work/$name.dlm" "${sky[@]}" --checkpoint 0 "${bake[@]}"
  "$lucarne" render "$work/$name.dlm" -o "$out/$name-baked.png" --size 480x270 "$@"
  "$lucarne" render "$scene" -o "$out/$name-truth.png" --size 480x270 --renderer pathtraced --samples "$samples" "${sky[@]}" "$@"
}

beach=beach_sun_spiaggia_di_mondello_1k.hdr
picture hotel_room scenes/hotel_room.glb 64 $beach --photons 20M --density 0.02
picture dream_apartment scenes/dream_apartment.glb 64 $beach --photons 20M --density 12
picture country_kitchen scenes/country_kitchen.glb 64 - --photons 20M
picture lux_kitchen scenes/lux_kitchen.glb 64 - --photons 20M
picture neon_sign models/neon_sign.glb 64 overcast_aristea_wreck_puresky_1k.hdr --photons 10M --density 64
picture bridge_garden scenes/japanese_bridge_garden.glb 32 $beach --photons 20M --density 8
