#!/usr/bin/env bash
# Installs what building and running Lucarne needs on Debian 12 (and systems like it). Does nothing, and needs no network,
# when all of it is there.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config
  libembree-dev libtbb-dev libopenmesh-dev libopenexr-dev libstb-dev
  libcli11-dev libspdlog-dev nlohmann-json3-dev libxxhash-dev
  libglfw3-dev libglm-dev libepoxy-dev libimgui-dev libegl-dev libegl-mesa0 libgl1-mesa-dri
  libopenmpi-dev openmpi-bin
  libgtest-dev libgmock-dev libbenchmark-dev
  xvfb xdotool
)

is_installed() {
  [ "$(dpkg-query -W -f='${db:Status-Abbrev}' "$1" 2>/dev/null)" = "ii " ]
}

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

if ! command -v apt-get >/dev/null; then
  echo "install-dependencies: no apt-get here; install the equivalents of: ${missing[*]}" >&2
  exit 1
fi
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  as_root=(sudo)
fi
echo "install-dependencies: installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
