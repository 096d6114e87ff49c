#!/usr/bin/env python3
"""What the two renderers of light maps differ by in real scenes, and each from the path-traced truth, as a Markdown table.

  scripts/measure-renderers.py ASSETS OUT [--lucarne build/release/cli/lucarne] [--photons 2M] [--size 320x180]
                               [--samples 16] [--only NAME,NAME…]

ASSETS has scenes/, models/ and env/. Writes OUT/NAME-player.png and OUT/NAME-truth.png, to be looked at. `largest` is the
largest difference of a pixel's component between singlepass and multipass, in 32-bit floats with --map-format float, over the
mean of the picture; `of the truth` the sum of absolute differences from the path-traced picture over its sum, which holds the
noise of both. A scene that is missing is skipped by name.
"""
import argparse
import json
import os
import subprocess
import sys

BEACH = "beach_sun_spiaggia_di_mondello_1k.hdr"
OVERCAST = "overcast_aristea_wreck_puresky_1k.hdr"
# Name, file, sky, options of the bake.
SCENES = [
    ("cornell_nv", "scenes/cornell_nv/cornellBox.gltf", None, []),
    ("lights_punctual_lamp", "scenes/lights_punctual_lamp.glb", None, ["--density", "100"]),
    ("country_kitchen", "scenes/country_kitchen.glb", None, []),
    ("lux_kitchen", "scenes/lux_kitchen.glb", None, []),
    ("hotel_room", "scenes/hotel_room.glb", BEACH, ["--density", "0.02"]),
    ("dream_apartment", "scenes/dream_apartment.glb", BEACH, ["--density", "8"]),
    ("living_room", "scenes/living_room.glb", BEACH, ["--density", "8"]),
    ("coffee_maker", "scenes/coffee_maker.glb", OVERCAST, ["--density", "100"]),
    ("zdm2_arena", "scenes/zdm2_arena.glb", BEACH, []),
    ("bridge_garden", "scenes/japanese_bridge_garden.glb", BEACH, ["--density", "8"]),
    ("sheen_chair", "models/sheen_chair.glb", OVERCAST, ["--density", "100"]),
    ("velvet_sofa", "models/velvet_sofa.glb", OVERCAST, ["--density", "60"]),
    ("water_bottle", "models/water_bottle.glb", OVERCAST, ["--density", "300"]),
    ("neon_sign", "models/neon_sign.glb", OVERCAST, ["--density", "64"]),
    ("avocado", "models/avocado.glb", OVERCAST, ["--density", "800"]),
]


class Failure(Exception):
    pass


def measure(o, name, scene, sky, bake):
    path = lambda ending: os.path.join(o.out, name + ending)

    def run(*arguments):
        done = subprocess.run([o.lucarne, *arguments], capture_output=True, text=True)
        if done.returncode != 0:
            raise Failure(f"{' '.join(arguments)}: {done.stderr.strip()}")
        return done.stdout

    light = ["--environment", os.path.join(o.assets, "env", sky)] if sky else []
    if not os.path.exists(path(".dlm")):
        run("bake", scene, "-o", path(".dlm"), "--photons", o.photons, "--checkpoint", "0", "--quiet", *light, *bake)
    for kind in "singlepass", "multipass":
        run("render", path(".dlm"), "-o", path(f"-{kind}.exr"), "--renderer", kind, "--map-format", "float", "--size", o.size, *light)
    if not os.path.exists(path("-truth.exr")):
        for ending in ".exr", ".png":
            run("render", path(".dlm"), "-o", path("-truth" + ending), "--renderer", "pathtraced", "--samples", o.samples, "--size",
                o.size, *light)
    run("render", path(".dlm"), "-o", path("-player.png"), "--size", o.size, *light)
    agree = json.loads(run("compare", path("-singlepass.exr"), path("-multipass.exr"), "--json"))
    true = json.loads(run("compare", path("-truth.exr"), path("-singlepass.exr"), "--json"))
    baked = json.loads(run("info", path(".dlm"), "--json"))
    sizes = sum(os.path.getsize(os.path.join(path(".dlm"), f)) for f in os.listdir(path(".dlm")))
    mean = sum(agree["mean_a"]) / 3
    off = "the truth is black" if true["relative_error"] is None else f"{100 * true['relative_error']:.0f} %"
    return (f"| {name} | {baked['charts']} | {baked['texels']} | {sizes / 1e6:.1f} "
            f"| {agree['largest_difference'] / mean if mean > 0 else 0:.1e} | {off} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("assets", type=os.path.abspath)
    parser.add_argument("out", type=os.path.abspath)
    parser.add_argument("--lucarne", default="build/release/cli/lucarne", type=os.path.abspath)
    parser.add_argument("--photons", default="2M")
    parser.add_argument("--size", default="320x180")
    parser.add_argument("--samples", default="16")
    parser.add_argument("--only", default="")
    o = parser.parse_args()
    os.makedirs(o.out, exist_ok=True)
    print("| scene | charts | texels | .dlm, MB | largest | of the truth |\n|---|---|---|---|---|---|")
    for name, file, sky, bake in SCENES:
        if o.only and name not in o.only.split(","):
            continue
        scene = os.path.join(o.assets, file)
        try:
            if not os.path.exists(scene):
                raise Failure(f"{scene} is not there")
            print(measure(o, name, scene, sky, bake), flush=True)
        except Failure as why:
            print(f"measure-renderers: {name} skipped: {why}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
