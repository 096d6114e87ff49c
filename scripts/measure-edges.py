#!/usr/bin/env python3
"""What the filter over edges wins, and what more samples a pixel win, against a truth of 64 samples a pixel, as Markdown.

  scripts/measure-edges.py [--lucarne build/release/cli/lucarne] [--photons 4M] [--size 480x270]

The built-in room from its first camera, as PNG (exposed, tone mapped, 0 … 255). The filter is that of the walkthrough: its
picture is a frame of `render --replay`, whose exposure is found by trying. Edges are pixels whose 3 × 3 neighbours differ by more
than 24 in the picture without a filter. FLIP is the mean over the whole picture.
"""
import argparse
import json
import math
import os
import struct
import subprocess
import tempfile
import zlib


def read_png(path):
    """Rows of 8-bit RGB."""
    data, at, packed = open(path, "rb").read(), 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack_from(">IIBB", data, at + 8)
            assert (depth, colour) == (8, 2)
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw, step, rows = zlib.decompress(packed), 3 * width, []
    before = bytes(step)
    for y in range(height):
        kind, line = raw[y * (step + 1)], bytearray(raw[y * (step + 1) + 1:(y + 1) * (step + 1)])
        for i in range(step):
            a, b, c = line[i - 3] if i > 2 else 0, before[i], before[i - 3] if i > 2 else 0
            paeth = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            line[i] = (line[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
        rows.append(bytes(line))
        before = line
    return width, height, rows


def edges(picture):
    width, height, rows = picture
    found = []
    for y in range(1, height - 1):
        for x in range(1, width - 1):
            for c in range(3):
                near = [rows[y + j][3 * (x + i) + c] for j in (-1, 0, 1) for i in (-1, 0, 1)]
                if max(near) - min(near) > 24:
                    found.append((x, y))
                    break
    return found


def rmse(a, b, pixels):
    total = sum((a[2][y][3 * x + c] - b[2][y][3 * x + c])**2 for x, y in pixels for c in range(3))
    return math.sqrt(total / (3 * len(pixels)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lucarne", default="build/release/cli/lucarne")
    parser.add_argument("--photons", default="4M")
    parser.add_argument("--size", default="480x270")
    o = parser.parse_args()
    lucarne = os.path.abspath(o.lucarne)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)

        def run(*command):
            return subprocess.run([lucarne, *command], check=True, capture_output=True, text=True).stdout

        def still(name, exposure, supersample=1):
            run("render", "room.dlm", "-o", name, "--size", o.size, "--exposure", repr(exposure), "--supersample", str(supersample))
            return read_png(name)

        run("bake", "-o", "room.dlm", "--photons", o.photons, "--quiet")
        document = open("room.dlm/scene.glb", "rb").read()
        scene = json.loads(document[20:20 + struct.unpack_from("<I", document, 12)[0]])
        node = next(n for n in scene["nodes"] if n.get("camera") == 0)
        x, y, z, w = node["rotation"]
        back = (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))
        pose = [*node["translation"], math.degrees(math.atan2(back[0], back[2])), -math.degrees(math.asin(back[1]))]
        yfov = math.degrees(scene["cameras"][0]["perspective"]["yfov"])
        json.dump({"format": "lucarne-walk", "version": 1, "rate": 1, "yfov": yfov, "poses": [pose]}, open("walk.json", "w"))
        run("render", "room.dlm", "--replay", "walk.json", "-o", "frames", "--size", o.size, "--quiet")
        os.rename("frames/frame_00000.png", "filter.png")
        smooth = read_png("filter.png")

        everywhere = [(i, j) for j in range(smooth[1]) for i in range(smooth[0])]
        low, high = 2.0, 9.0
        while high - low > 0.004:
            a, b = low + (high - low) / 3, high - (high - low) / 3
            if rmse(still("a.png", a), smooth, everywhere) < rmse(still("b.png", b), smooth, everywhere):
                high = b
            else:
                low = a
        exposure = (low + high) / 2
        truth, plain = still("truth.png", exposure, 8), still("plain.png", exposure)
        at = edges(plain)
        print(f"{100 * len(at) / len(everywhere):.0f} % of the pixels are edges; exposure value {exposure:.2f}\n")
        print("| | shading | RMSE at edges | RMSE | FLIP |\n|---|---|---|---|---|")
        for title, cost, name, picture in (("one sample", 1, "plain.png", plain), ("one sample, filter", 1, "filter.png", smooth),
                                           ("2 × 2 samples", 4, "two.png", still("two.png", exposure, 2)),
                                           ("4 × 4 samples", 16, "four.png", still("four.png", exposure, 4))):
            flip = json.loads(run("compare", "truth.png", name, "--json"))["flip"]["mean"]
            print(f"| {title} | {cost} | {rmse(picture, truth, at):.1f} | {rmse(picture, truth, everywhere):.1f} | {flip:.4f} |")


if __name__ == "__main__":
    main()
