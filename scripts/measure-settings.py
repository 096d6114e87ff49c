#!/usr/bin/env python3
"""Bakes the built-in room with one setting changed at a time and prints what each costs and gains, as Markdown tables.

  scripts/measure-settings.py [--lucarne PROGRAM] [--out FOLDER]

`error` is the program's own estimate (flux-weighted, irradiance). `difference` is the relative RMS difference of pictures to that
of the most careful bake (160 M photons, 64 directions, 32 texels per metre), floor and furniture included. Frame times are of software OpenGL.
"""
import argparse
import json
import math
import os
import re
import struct
import subprocess
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))


def unzip_row(packed, size):
    """One scanline of OpenEXR's ZIPS: deflate, then a difference predictor, then bytes dealt into two halves."""
    if len(packed) == size:
        return packed  # did not get smaller
    data = bytearray(zlib.decompress(packed))
    for i in range(1, size):
        data[i] = (data[i - 1] + data[i] - 128) & 255
    row, half = bytearray(size), (size + 1) // 2
    row[0::2], row[1::2] = data[:half], data[half:]
    return bytes(row)


def read_exr_rgb(path):
    """Float samples of an RGB scanline file (no compression or ZIPS), as our program writes them."""
    data = open(path, "rb").read()
    at, compression, window, channels = 8, None, None, []
    while data[at]:
        name_end = data.index(b"\0", at)
        type_end = data.index(b"\0", name_end + 1)
        name, size = data[at:name_end].decode(), struct.unpack_from("<i", data, type_end + 1)[0]
        value = data[type_end + 5:type_end + 5 + size]
        at = type_end + 5 + size
        if name == "compression":
            compression = value[0]
        elif name == "dataWindow":
            window = struct.unpack("<4i", value)
        elif name == "channels":
            channels = [c for c in re.findall(rb"([A-Za-z.]+)\0.{16}", value, re.S)]
    if compression not in (0, 2) or len(channels) != 3:
        raise SystemExit(f"{path}: neither uncompressed nor ZIPS, or not RGB")
    width, height = window[2] - window[0] + 1, window[3] - window[1] + 1
    at += 1 + 8 * height
    pixels = []
    for _ in range(height):
        size = struct.unpack_from("<i", data, at + 4)[0]
        pixels.extend(struct.unpack(f"<{3 * width}f", unzip_row(data[at + 8:at + 8 + size], 12 * width)))
        at += 8 + size
    return pixels


class Bench:
    def __init__(self, lucarne, out):
        self.lucarne, self.out = lucarne, out
        os.makedirs(out, exist_ok=True)

    def bake(self, name, options):
        """Report, picture and frame time of one bake."""
        base = os.path.join(self.out, name)
        kernel = [] if "--kernel" in options else ["--kernel", "pyramid"]
        subprocess.run([self.lucarne, "bake", "-o", base + ".dlm", "--report", base + ".json", "--quiet", *kernel, *options],
                       check=True)
        log = subprocess.run([self.lucarne, "render", base + ".dlm", "-o", base + ".exr", "--size", "640x480"], check=True,
                             capture_output=True, text=True).stderr
        frame = float(re.search(r"frame ([0-9.]+) ms", log).group(1))
        disk = sum(os.path.getsize(os.path.join(base + ".dlm", f)) for f in os.listdir(base + ".dlm"))
        return json.load(open(base + ".json")), read_exr_rgb(base + ".exr"), frame, disk


def difference(picture, truth):
    """RMS of the difference over the mean of the truth; the brightest hundredth is left out (the lamps)."""
    limit = sorted(truth)[int(0.99 * len(truth))]
    pairs = [(a, b) for a, b in zip(picture, truth) if b <= limit]
    mean = sum(b for _, b in pairs) / len(pairs)
    return math.sqrt(sum((a - b) ** 2 for a, b in pairs) / len(pairs)) / mean


def table(bench, truth, title, option, values, rest=()):
    print(f"\n### {title}\n")
    print(f"| `{option}` | seconds | error | difference | tallies, MB | on disk, MB | frame, ms |")
    print("|---|---|---|---|---|---|---|")
    for value in values:
        report, picture, frame, disk = bench.bake(f"{option[2:]}_{value}", [option, str(value), *rest])
        print(f"| {value} | {report['seconds']:.1f} | {100 * report['estimated_relative_error']:.2f} % | {100 * difference(picture, truth):.2f} % "
              f"| {report['tally_bytes'] / 1e6:.1f} | {disk / 1e6:.1f} | {frame:.0f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--lucarne", default=os.path.join(HERE, "../build/release/cli/lucarne"))
    parser.add_argument("--out", default=os.path.join(HERE, "../out/settings"))
    arguments = parser.parse_args()
    bench = Bench(arguments.lucarne, arguments.out)
    _, truth, _, _ = bench.bake("truth", ["--photons", "160M", "--directions", "64", "--density", "32"])
    table(bench, truth, "Photons", "--photons", ["5M", "20M", "80M"])
    table(bench, truth, "Directions", "--directions", [6, 14, 32, 64])
    table(bench, truth, "Density, texels per metre", "--density", [8, 16, 32])
    table(bench, truth, "Kernel", "--kernel", ["pyramid", "box", "epanechnikov", "linear", "adaptive"])
    table(bench, truth, "Kernel width, texels", "--kernel-width", [0.5, 1.5, 3])


if __name__ == "__main__":
    main()
