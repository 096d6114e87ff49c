#!/usr/bin/env bash
# measure-scenes.sh FOLDER [OUT]: bakes real scenes and prints, as a Markdown table, what each took. Pictures and reports go to
# OUT (default out/scenes). FOLDER holds cornell_nv/cornellBox.gltf, lights_punctual_lamp.glb, country_kitchen.glb,
# lux_kitchen.glb and hotel_room.glb; missing ones are skipped by name. Run it on an otherwise idle machine.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
scenes=$(realpath "$1")
out=$(realpath -m "${2:-$top/out/scenes}")
lucarne=${LUCARNE:-$top/build/release/cli/lucarne}
mkdir -p "$out"

# The hotel room has no light of its own, and is in millimetres: a lamp of 4·10^8 cd there is 400 cd.
if [ -f "$scenes/hotel_room.glb" ]; then
  python3 "$top/scenes/add_light.py" "$scenes/hotel_room.glb" "$out/hotel_room_lamp.glb" --at 10200 1950 -7600 --candela 4e8 \
    --camera 10800 1500 -6000 8800 700 -9500
fi

echo "| scene | triangles | charts | texels | photons | seconds | photons/s | rays/s | peak MiB | estimated error |"
echo "|---|---|---|---|---|---|---|---|---|---|"

# row NAME REPORT: one line of the table.
row() {
  python3 - "$@" <<'PY'
import json, sys
name, path, triangles = sys.argv[1:4]
r = json.load(open(path))
print(f"| {name} | {triangles} | {r['charts']} | {r['texels']} | {r['photons'] / 1e6:g} M | {r['seconds']:.1f} | {r['photons_per_second'] / 1e6:.2f} M "
      f"| {r['rays_per_second'] / 1e6:.2f} M | {r['peak_memory_bytes'] / 2**20:.0f} | {100 * r['estimated_relative_error']:.1f} % |")
PY
}

# measure NAME SCENE BAKE_OPTIONS…
measure() {
  local name=$1 scene=$2
  shift 2
  if [ -n "$scene" ] && [ ! -f "$scene" ]; then
    echo "measure-scenes: $name skipped, $scene is not there" >&2
    return
  fi
  "$lucarne" bake ${scene:+"$scene"} -o "$out/$name.dlm" --report "$out/$name.json" --quiet "$@"
  "$lucarne" render "$out/$name.dlm" -o "$out/$name.png" --size 800x600 --quiet
  local triangles
  triangles=$("$lucarne" info "$out/$name.dlm/scene.glb" --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["triangles"])')
  row "$name" "$out/$name.json" "$triangles"
}

measure glossy_room ""
measure cornell_box "$top/scenes/cornell_box.glb" --density 64
measure two_lamps "$top/scenes/two_lamps.glb"
measure cornell_nv "$scenes/cornell_nv/cornellBox.gltf" --photons 2M
measure lights_punctual_lamp "$scenes/lights_punctual_lamp.glb" --density 100
measure country_kitchen "$scenes/country_kitchen.glb"
measure lux_kitchen "$scenes/lux_kitchen.glb"
measure hotel_room_lamp "$out/hotel_room_lamp.glb"
