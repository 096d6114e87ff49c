#!/usr/bin/env python3
"""Noise of the irradiance at equal time: photons alone, and gathered direct light with photons for the rest.

  scripts/measure-direct.py [--lucarne PROGRAM] [--seconds S] [--out FOLDER] SCENE[:OPTION ...] ...
  scripts/measure-direct.py scenes/two_lamps.glb 'hotel_room.glb:--environment:sky.hdr:--density:0.02'

Time is processor time of tracing: that of the bake less that of one that traces next to nothing. Noise is the root of
the mean square deviation over texels with light, over their mean. Two long bakes r, s of other seeds, which are as
noisy as they are but know nothing of each other, give it without their own: E[(a - r)(a - s)] is the variance of a.
`noise` is in units of the mean of the map, `relative` in units of each texel (at least a tenth of the mean). `gain`: how
many times the time photons alone would take for the same noise.
"""
import argparse
import itertools
import json
import math
import os
import resource
import struct
import subprocess
import tempfile
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))
BUILT_IN = "glossy_room"


def run_lengths(packed):
    out, at = bytearray(), 0
    while at < len(packed):
        count = struct.unpack_from("b", packed, at)[0]
        if count < 0:
            out += packed[at + 1:at + 1 - count]
            at += 1 - count
        else:
            out += packed[at + 1:at + 2] * (count + 1)
            at += 2
    return bytes(out)


def unpacked(packed, size, compression):
    """OpenEXR's RLE and ZIP: packed is a difference predictor over bytes dealt into two halves."""
    if len(packed) == size:
        return packed  # did not get smaller
    plain = run_lengths(packed) if compression == 1 else zlib.decompress(packed)
    data = bytes(itertools.accumulate(plain, lambda a, b: (a + b - 128) & 255))
    out, half = bytearray(size), (size + 1) // 2
    out[0::2], out[1::2] = data[:half], data[half:]
    return bytes(out)


def parse_header(data, at):
    attributes = {}
    while data[at]:
        name_end = data.index(b"\0", at)
        type_end = data.index(b"\0", name_end + 1)
        size = struct.unpack_from("<i", data, type_end + 1)[0]
        attributes[data[at:name_end].decode()] = data[type_end + 5:type_end + 5 + size]
        at = type_end + 5 + size
    return attributes, at + 1


def channel_names(value):
    names, at = [], 0
    while value[at]:
        end = value.index(b"\0", at)
        names.append(value[at:end].decode())
        at = end + 17
    return names


def read_layers(path):
    """{layer: {channel: [values]}} of a multi-part file of float32 scanlines, as our program writes them."""
    data = open(path, "rb").read()
    if struct.unpack_from("<ii", data) != (20000630, 2 | 0x1000):
        raise SystemExit(f"{path}: not a multi-part OpenEXR file")
    at, headers = 8, []
    while data[at]:
        header, at = parse_header(data, at)
        headers.append(header)
    at += 1 + sum(8 * struct.unpack("<i", h["chunkCount"])[0] for h in headers)
    layers = []
    for h in headers:
        x0, y0, x1, y1 = struct.unpack("<4i", h["dataWindow"])
        layers.append({"name": h["name"].decode(), "width": x1 - x0 + 1, "height": y1 - y0 + 1,
                       "channels": {c: [] for c in channel_names(h["channels"])},
                       "compression": h["compression"][0], "lines": 16 if h["compression"][0] == 3 else 1, "chunks": struct.unpack("<i", h["chunkCount"])[0]})
    for _ in range(sum(layer["chunks"] for layer in layers)):
        part, y, size = struct.unpack_from("<iii", data, at)
        layer = layers[part]
        lines, width = min(layer["lines"], layer["height"] - y), layer["width"]
        floats = struct.unpack(f"<{len(layer['channels']) * width * lines}f",
                               unpacked(data[at + 12:at + 12 + size], 4 * len(layer["channels"]) * width * lines,
                                        layer["compression"]))
        for line in range(lines):
            for i, values in enumerate(layer["channels"].values()):
                begin = (line * len(layer["channels"]) + i) * width
                values.extend(floats[begin:begin + width])
        at += 12 + size
    return {layer["name"]: layer["channels"] for layer in layers}


def luminances(folder):
    """Of fronts and backs, texel by texel, gutters included."""
    layers = read_layers(os.path.join(folder, "irradiance.exr"))
    values = []
    for side in ("front", "back"):
        if side in layers:
            c = layers[side]
            values.append([0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in zip(c["R"], c["G"], c["B"])])
    return values


class Scene:
    def __init__(self, program, text, out):
        self.program, self.out, self.number = program, out, 0
        path, *self.options = text.split(":")
        self.name = os.path.splitext(os.path.basename(path))[0]
        self.path = [] if path == BUILT_IN else [path]
        self.setup = 0
        self.setup = min(self.bake(["--photons", "1"])["cpu"] for _ in range(2))

    def bake(self, options):
        """The report, `cpu` seconds of tracing, and where the maps lie."""
        self.number += 1
        folder, report = (os.path.join(self.out, f"{self.name}-{self.number}.{e}") for e in ("dlm", "json"))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([self.program, "bake", *self.path, "-o", folder, "--report", report, "--quiet", "--checkpoint", "0",
                        "--threads", "1", *self.options, *options], check=True, stderr=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        told = json.load(open(report))
        told["cpu"] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime - self.setup
        told["folder"] = folder
        return told


def noise(folder, first, second):
    """(in units of the mean, in units of each texel), and the ratio of the means."""
    map_, r, s = luminances(folder), first, second
    square = relative = total = mine = count = 0
    pairs = [t for sides in zip(map_, r, s) for t in zip(*sides) if t[1] + t[2] > 0]
    mean = sum(b + c for _, b, c in pairs) / (2 * len(pairs))
    for a, b, c in pairs:
        level = max(0.5 * (b + c), 0.1 * mean)
        square += (a - b) * (a - c)
        relative += (a - b) * (a - c) / (level * level)
        total += 0.5 * (b + c)
        mine += a
        count += 1
    root = lambda x: math.sqrt(max(0, x / count))
    return root(square) / mean, root(relative), mine / total


def measure(scene, seconds, shares):
    photons = 20_000
    while (cpu := scene.bake(["--photons", str(photons)])["cpu"]) < seconds / 8:
        photons *= 4
    photons = int(photons / cpu * seconds)
    references = [luminances(scene.bake(["--photons", str(4 * photons), "--seed", str(seed)])["folder"])
                  for seed in (101, 102)]
    rows = []
    alone = scene.bake(["--photons", str(photons)])
    rows.append(("photons", 0, photons, alone["cpu"], *noise(alone["folder"], *references)))
    # Without photons, so that what their number costs more or less from run to run does not show.
    direct = ["--direct", "gathered", "--light", "direct", "--direct-samples"]
    many = 4
    while (cpu := scene.bake(direct + [str(many)])["cpu"]) < seconds / 8 and many < 16384:
        many *= 4
    sample = cpu / many
    some = max(1000, photons // 4)
    photon = scene.bake(["--light", "indirect", "--photons", str(some)])["cpu"] / some
    for share in shares:
        samples = max(1, round(share * seconds / sample))
        rest = max(1000, int((seconds - samples * sample) / photon))
        both = scene.bake(["--direct", "gathered", "--direct-samples", str(samples), "--photons", str(rest)])
        rows.append(("gathered", samples, rest, both["cpu"], *noise(both["folder"], *references)))
    for mode, samples, count, cpu, rms, relative, mean in rows:
        gain = [(rows[0][4 + k] ** 2 * rows[0][3]) / max(1e-12, (rms, relative)[k] ** 2 * cpu) for k in (0, 1)]
        print(f"| {scene.name} | {mode} | {samples or '–'} | {count / 1e6:.2f} M | {cpu:.1f} | {100 * rms:.2f} % | "
              f"{100 * relative:.2f} % | {gain[0]:.2f} | {gain[1]:.2f} | {mean:.4f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", default=[BUILT_IN])
    parser.add_argument("--lucarne", default=os.path.join(HERE, "..", "build", "release", "cli", "lucarne"))
    parser.add_argument("--seconds", type=float, default=8)
    parser.add_argument("--shares", default="0.25,0.5", help="of the time for gathering")
    parser.add_argument("--out", help="keep the maps here")
    arguments = parser.parse_args()
    print("| scene | direct light | samples | photons | seconds | noise | relative | gain | gain, relative | mean |\n"
          "|---|---|---|---|---|---|---|---|---|---|", flush=True)
    shares = [float(s) for s in arguments.shares.split(",")]
    with tempfile.TemporaryDirectory() as temporary:
        out = arguments.out or temporary
        os.makedirs(out, exist_ok=True)
        for scene in arguments.scenes:
            measure(Scene(os.path.abspath(arguments.lucarne), scene, out), arguments.seconds, shares)


main()
