#!/usr/bin/env python3
"""Bakes scenes and compares the time left that the progress told with the time that it then took.

  scripts/measure-time-left.py [--lucarne PROGRAM] [--photons 20M] [--runs 1] [SCENE.glb …]

No scene: the built-in room. One line a bake: the median and the largest |told − true| ÷ (whole time) after the first
tenth, and largest |told − true| ÷ true between one tenth and nine tenths. The machine must have nothing else to do.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))


def bake(program, scene, options):
    """The progress lines of a bake, as JSON objects."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "bake", *([scene] if scene else []), "-o", os.path.join(folder, "a.dlm"), "--progress", "json", *options]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stderr)
        lines = (done.stdout + done.stderr).splitlines()
    return [json.loads(line) for line in lines if line.startswith("{")]


def errors(lines):
    """(share of the whole that was done, told − true, true) of each line that told a time left."""
    told = [x for x in lines if x.get("seconds_left") is not None]
    end = max(x["seconds"] for x in lines)
    return end, [(x["seconds"] / end, x["seconds_left"] - (end - x["seconds"]), end - x["seconds"]) for x in told]


def main():
    p = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    p.add_argument("scenes", nargs="*", default=[None])
    p.add_argument("--lucarne", default=os.path.join(HERE, "../build/release/cli/lucarne"))
    p.add_argument("--photons", default="20M")
    p.add_argument("--runs", type=int, default=1)
    p.add_argument("bake", nargs="*", help=argparse.SUPPRESS)
    options = sys.argv[1:]
    at = options.index("--") if "--" in options else len(options)
    a = p.parse_args(options[:at])
    more = options[at + 1:] or ["--photons", a.photons]
    for scene in a.scenes:
        for _ in range(a.runs):
            end, all_ = errors(bake(a.lucarne, scene, more))
            late = [e for e in all_ if e[0] >= 0.1]
            inner = [e for e in late if e[0] <= 0.9]
            if not late or not inner:
                raise SystemExit("measure-time-left: the bake was too short to tell a time; give more photons")
            print(f"{os.path.basename(scene) if scene else 'built-in room'}: {end:.1f} s, told {len(late)} times; of the whole: median "
                  f"{100 * statistics.median(abs(e[1]) / end for e in late):.1f} %, most {100 * max(abs(e[1]) / end for e in late):.1f} %; "
                  f"of what was left: most {100 * max(abs(e[1]) / e[2] for e in inner):.1f} %", flush=True)


if __name__ == "__main__":
    main()
