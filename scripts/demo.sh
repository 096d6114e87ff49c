#!/usr/bin/env bash
# Installs, builds, bakes the built-in room into out/glossy_room.dlm and shows it: in a window where there is a display,
# else as pictures. LUCARNE_HEADLESS=1 makes pictures even where there is one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install-dependencies.sh
cmake --preset release
cmake --build --preset release --parallel "$(nproc)" --target lucarne
lucarne=build/release/cli/lucarne
maps=out/glossy_room.dlm
mkdir -p out
# Finer and cleaner than the defaults: about a minute on two cores.
"$lucarne" bake -o "$maps" --density 24 --photons 40M

if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && [ -z "${LUCARNE_HEADLESS:-}" ]; then
  exec "$lucarne" play "$maps"
fi
for camera in entrance table corner; do
  "$lucarne" render "$maps" --camera "$camera" -o "out/$camera.png"
done
echo "No display: the room as seen by its cameras is in"
for camera in entrance table corner; do
  echo "  $PWD/out/$camera.png"
done
