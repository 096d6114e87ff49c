#!/usr/bin/env python3
"""What each reconstruction kernel costs and gains: bias, noise and time, from two bakes that are made once.

    scripts/measure-kernels.py [--lucarne build/release/cli/lucarne] [--scene SCENE.glb] [--few 1M] [--many 32M]

The truth is the bare histogram of many photons. Bias: the same photons under the kernel against it. Error: few other
photons under the kernel against it. Both as RMSE over the texels, and as the mean of |difference| over the mean.
Time: CPU seconds of making maps from the few photons' tallies, over those of the pyramid.
"""
import argparse
import json
import os
import resource
import subprocess
import tempfile

KERNELS = [("box", 0.5), ("pyramid", 1.5), ("box", 1.5), ("epanechnikov", 1.5), ("linear", 1.5), ("pyramid", 2.5),
           ("linear", 2.5), ("pyramid", 4.5), ("linear", 4.5), ("adaptive", 4.5)]


def cpu_of(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lucarne", default="build/release/cli/lucarne")
    parser.add_argument("--scene")
    parser.add_argument("--few", default="1M")
    parser.add_argument("--many", default="32M")
    parser.add_argument("--density", default="16")
    options = parser.parse_args()
    lucarne = os.path.abspath(options.lucarne)
    scene = [os.path.abspath(options.scene)] if options.scene else []
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, photons, seed in ("many", options.many, "7"), ("few", options.few, "1"):
            subprocess.run([lucarne, "bake", *scene, "-o", f"{name}.part", "--part", "1/1", "--photons", photons, "--seed",
                            seed, "--density", options.density, "--seams", "keep", "--quiet"], check=True)

        def maps(part, kernel, width, name):
            return cpu_of([lucarne, "merge", part, "-o", name, "--kernel", kernel, "--kernel-width", str(width), "--quiet"])

        def difference(name):
            out = subprocess.run([lucarne, "compare", "truth.dlm", name, "--json"], check=True, capture_output=True)
            return json.loads(out.stdout)["irradiance"]

        maps("many.part", "box", 0.5, "truth.dlm")
        pyramid = min(maps("few.part", "pyramid", 1.5, "time.dlm") for _ in range(3))
        print("| kernel | width | bias: RMSE, lx | relative | error: RMSE, lx | relative | time |\n|---|---|---|---|---|---|---|")
        for kernel, width in KERNELS:
            maps("many.part", kernel, width, "bias.dlm")
            seconds = maps("few.part", kernel, width, "error.dlm")
            bias, error = difference("bias.dlm"), difference("error.dlm")
            print(f"| {kernel} | {width} | {bias['rmse_lx']:.2f} | {100 * bias['relative_error']:.2f} % "
                  f"| {error['rmse_lx']:.2f} | {100 * error['relative_error']:.2f} % | {seconds / pyramid:.1f} |", flush=True)


if __name__ == "__main__":
    main()
