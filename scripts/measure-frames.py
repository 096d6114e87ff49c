#!/usr/bin/env python3
"""CPU time of one frame of the built-in room in software OpenGL, by directions and renderer, as a Markdown table.

  scripts/measure-frames.py [--lucarne build/release/cli/lucarne] [--photons 1M] [--size 640x480] [--frames 20]
                            [--directions 14,32,64,128,256] [--renderers singlepass,multipass]

User and system time of all threads, of `render --replay` along a walk: a long run less a short one, so that loading and compiling
do not count; the smoothing of edges, exposure and reading back do. On two idle cores wall time tends to half of it. The runs of
one row follow each other, so that what else the machine does falls on all alike.
"""
import argparse
import json
import os
import resource
import subprocess
import tempfile

# Across the room and once around, 1 s a pose.
POSES = [[2.62, 1.6, 1.92, 46, -11], [1.2, 1.6, 0.9, 60, -10], [-0.6, 1.6, 1.6, 0, -8], [-1.5, 1.6, 0.2, -90, -12], [2.0, 1.6, -1.0, 120, -5]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lucarne", default="build/release/cli/lucarne")
    parser.add_argument("--photons", default="1M")
    parser.add_argument("--size", default="640x480")
    parser.add_argument("--frames", type=int, default=20)
    parser.add_argument("--directions", default="14,32,64,128,256")
    parser.add_argument("--renderers", default="singlepass,multipass")
    o = parser.parse_args()
    lucarne = os.path.abspath(o.lucarne)
    renderers = o.renderers.split(",")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        walk = {"format": "lucarne-walk", "version": 1, "rate": 1, "yfov": 54.4}
        json.dump({**walk, "poses": POSES}, open("long.json", "w"))
        json.dump({**walk, "poses": POSES[:1]}, open("short.json", "w"))

        def seconds(name, renderer):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run([lucarne, "render", "room.dlm", "--replay", name, "--fps", repr(o.frames / (len(POSES) - 1)), "--size", o.size,
                            "--renderer", renderer, "--benchmark", "times.json", "--quiet"], check=True)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

        print("| directions | " + " | ".join(f"{r}, ms" for r in renderers) + " |\n|---|" + "---|" * len(renderers))
        for count in o.directions.split(","):
            subprocess.run([lucarne, "bake", "-o", "room.dlm", "--photons", o.photons, "--directions", count, "--quiet"], check=True)
            row = [f"{1000 * (seconds('long.json', r) - seconds('short.json', r)) / o.frames:.0f}" for r in renderers]
            print(f"| {count} | " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
