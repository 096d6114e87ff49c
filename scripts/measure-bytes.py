#!/usr/bin/env python3
"""What modelling only what the scene requires saves: bytes of light maps, and the error of pictures made of them.

    scripts/measure-bytes.py [--lucarne build/release/cli/lucarne] [--scene SCENE.glb] [--photons 4M] [--many 64M] [--directions 14]

Plain: all directions on every surface (--keep-all-directions), half floats, the pyramid. Then, one after the other: one map where
no lobe needs directions; a compact format; maps of faint directions left out; the kernel that adapts. Bytes: of
directional.exr on disk, and map_bytes of the report. Error: pictures of the first camera against that of plain maps from many
other photons.
"""
import argparse
import json
import os
import subprocess
import tempfile


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lucarne", default="build/release/cli/lucarne")
    parser.add_argument("--scene")
    parser.add_argument("--photons", default="4M")
    parser.add_argument("--directions", default="14")
    parser.add_argument("--many", default="64M")
    parser.add_argument("--size", default="480x270")
    options = parser.parse_args()
    lucarne = os.path.abspath(options.lucarne)
    scene = [os.path.abspath(options.scene)] if options.scene else []
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)

        def run(*command):
            return subprocess.run([lucarne, *command], check=True, capture_output=True, text=True).stdout

        for name, more in ("plain", ["--keep-all-directions"]), ("lean", []):
            run("bake", *scene, "-o", name + ".dlm", "--keep-part", "--photons", options.photons, "--directions", options.directions,
                "--kernel", "pyramid", "--report", name + ".json", "--quiet", *more)
        run("bake", *scene, "-o", "truth.dlm", "--keep-all-directions", "--photons", options.many, "--directions",
            options.directions, "--kernel", "pyramid", "--seed", "7", "--quiet")
        run("render", "truth.dlm", "-o", "truth.exr", "--size", options.size)

        def row(title, dlm, report):
            run("render", dlm, "-o", "picture.exr", "--size", options.size)
            error = json.loads(run("compare", "truth.exr", "picture.exr", "--json"))
            disk = os.path.getsize(f"{dlm}/directional.exr") if os.path.exists(f"{dlm}/directional.exr") else 0
            numbers = json.load(open(report))
            row.first = getattr(row, "first", None) or disk
            print(f"| {title} | {disk / 1e6:.2f} | {disk / row.first:.2f} | {numbers['map_bytes'] / 1e6:.2f} "
                  f"| {100 * error['relative_error']:.2f} % | {error['flip']['mean']:.4f} |", flush=True)

        def merged(title, *more):
            run("merge", "lean.part", "-o", "m.dlm", "--report", "m.json", "--quiet", *more)
            row(title, "m.dlm", "m.json")

        print("| | on disk, MB | of plain | maps, MB | error of picture | FLIP |\n|---|---|---|---|---|---|")
        row("plain", "plain.dlm", "plain.json")
        row("what the scene requires", "lean.dlm", "lean.json")
        merged("--drop-error 1%", "--drop-error", "1%")
        merged("rgb9e5", "--format", "rgb9e5")
        for drop in "0.2%", "0.5%", "1%", "2%":
            merged(f"rgb9e5, --drop-error {drop}", "--format", "rgb9e5", "--drop-error", drop)
        merged("rgb9e5, 0.5%, adaptive", "--format", "rgb9e5", "--drop-error", "0.5%", "--kernel", "adaptive")


if __name__ == "__main__":
    main()
