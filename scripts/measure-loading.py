#!/usr/bin/env python3
"""How long large light maps take until the walkthrough shows them, and how long its window stands still, as a Markdown table.

  scripts/measure-loading.py [--lucarne build/release/cli/lucarne] [--dlm BIG.dlm] [--density 75] [--photons 12M] [--runs 3]

Without --dlm it bakes the built-in room with 256 directions on every surface, some 500 MB, which takes 8 GB of memory and some
minutes. Needs a display, or Xvfb, of which it then starts one. `shown` is from the start to the first picture; `longest` the
longest frame until then, that picture's included; `CPU` the user and system time of the whole run, of all threads: on a machine
that is busy otherwise it tells more than the clock.
"""
import argparse
import json
import os
import resource
import subprocess
import tempfile


def start_display():
    server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp"],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    os.environ["DISPLAY"] = ":" + server.stdout.readline().strip()
    return server


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lucarne", default="build/release/cli/lucarne")
    parser.add_argument("--dlm", type=os.path.abspath)
    parser.add_argument("--density", default="75")
    parser.add_argument("--photons", default="12M")
    parser.add_argument("--runs", type=int, default=3)
    o = parser.parse_args()
    lucarne = os.path.abspath(o.lucarne)
    server = None if os.environ.get("DISPLAY") else start_display()
    try:
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            dlm = o.dlm or os.path.join(folder, "big.dlm")
            if not o.dlm:
                subprocess.run([lucarne, "bake", "-o", dlm, "--directions", "256", "--keep-all-directions", "--density", o.density,
                                "--photons", o.photons, "--quiet"], check=True)
            json.dump({"format": "lucarne-walk", "version": 1, "rate": 1, "yfov": 50,
                       "poses": [[2.5, 1.6, 1.0, 0, 0], [2.5, 1.6, 0.5, 0, 0]]}, open("walk.json", "w"))
            size = sum(os.path.getsize(os.path.join(dlm, f)) for f in os.listdir(dlm))
            print("| .dlm, MB | shown after, s | longest frame, ms | CPU, s | memory, MB | of it GPU textures, MB |\n|---|---|---|---|---|---|")
            for _ in range(o.runs):
                before = resource.getrusage(resource.RUSAGE_CHILDREN)
                subprocess.run([lucarne, "play", dlm, "--size", "640x480", "--replay", "walk.json", "--fps", "1", "--benchmark", "t.json"],
                               check=True, stderr=subprocess.DEVNULL)
                after = resource.getrusage(resource.RUSAGE_CHILDREN)
                cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
                t = json.load(open("t.json"))
                print(f"| {size / 1e6:.0f} | {t['shown_seconds']:.1f} | {t['loading_frame_ms']['max']:.0f} | {cpu:.1f} "
                      f"| {t['peak_memory_bytes'] / 1e6:.0f} | {t['gl_bytes'] / 1e6:.0f} |", flush=True)
    finally:
        if server:
            server.terminate()


if __name__ == "__main__":
    main()
