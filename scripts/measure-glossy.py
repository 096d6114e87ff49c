#!/usr/bin/env python3
"""Pictures of glossy reflections from light maps of more and more directions, against the path-traced truth, as Markdown.

  scripts/measure-glossy.py [--lucarne PROGRAM] [--out FOLDER] [--exponents 1,3,10,30,100] [--directions 14,32,64,128,256,512,1024]
                            [--lobes cell,barsi,sample] [--filters nearest,linear] [--moments off,on] [--photons 20M] [--samples 256] [--size 320x180]
                            [--scene two_lamps|glossy_room] [--camera NAME] [--turns 0]

The scene is scenes/two_lamps.glb (or glossy_room.glb) with the Phong exponent of all that is glossy in it changed: in two_lamps the
floor. `--filters` are those of `bake --direction-filter`; `--moments on` bakes with mean directions. For each exponent the truth is rendered twice, with
two seeds: what they differ by is the floor below which no picture can be told from the truth. `FLIP` is the mean HDR-FLIP,
`error` the sum of absolute differences over the sum of the truth, `on disk` the size of the .dlm, `bake` the processor seconds of the bake, `frame` the
time of one frame of that size in software OpenGL. What was baked or rendered before is kept and not made again. `--turns N`: then every
way is baked N times more, and N walks of 20 frames are drawn of each, the ways in turn; what is told is the least processor time of each
over that of the first way.
"""
import argparse
import json
import os
import re
import resource
import struct
import subprocess

HERE = os.path.dirname(os.path.abspath(__file__))
MATT = 0.84  # a roughness from which on nothing is glossy


def with_exponent(source, target, exponent):
    """Copies a .glb; what is glossy gets the roughness whose lobe is about a Phong lobe of that exponent."""
    data = open(source, "rb").read()
    length = struct.unpack_from("<I", data, 12)[0]
    document, rest = json.loads(data[20:20 + length]), data[20 + length:]
    for material in document["materials"]:
        if material["pbrMetallicRoughness"].get("roughnessFactor", 1) < MATT:
            material["pbrMetallicRoughness"]["roughnessFactor"] = (1 / (2 * exponent + 1)) ** 0.25
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    with open(target, "wb") as out:
        out.write(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest)


def folder_size(folder):
    return sum(os.path.getsize(os.path.join(folder, f)) for f in os.listdir(folder))


class Study:
    def __init__(self, options):
        self.o = options
        os.makedirs(options.out, exist_ok=True)

    def path(self, name):
        return os.path.join(self.o.out, name)

    def run(self, *arguments):
        return subprocess.run([self.o.lucarne, *arguments], check=True, capture_output=True, text=True)

    def truth(self, exponent):
        """The scene and its truth, and how much two truths differ."""
        scene = self.path(f"{self.o.scene}-n{exponent}.glb")
        if not os.path.exists(scene):
            with_exponent(os.path.join(HERE, f"../scenes/{self.o.scene}.glb"), scene, exponent)
        pictures = [self.path(f"{self.o.scene}-n{exponent}-truth{seed}.exr") for seed in (1, 2)]
        for seed, picture in enumerate(pictures, 1):
            if not os.path.exists(picture):
                self.run("render", scene, "-o", picture, "--renderer", "pathtraced", "--samples", str(self.o.samples), "--size",
                         self.o.size, "--seed", str(seed), "--quiet", *self.camera())
        return scene, pictures[0], self.compare(*pictures)

    def camera(self):
        return ["--camera", self.o.camera] if self.o.camera else []

    def compare(self, truth, picture):
        return json.loads(self.run("compare", truth, picture, "--json").stdout)

    def base(self, exponent, directions, way):
        """The light maps' name without its end; as it was before there were filters."""
        filter, moments = way
        kind = ("" if filter == "nearest" else "-" + filter) + ("-moments" if moments == "on" else "")
        return self.path(f"{self.o.scene}-n{exponent}-{directions}{kind}")

    def arguments(self, scene, base, directions, way):
        return ["bake", scene, "-o", base + ".dlm", "--directions", str(directions), "--photons", self.o.photons, "--kernel", "pyramid",
                "--quiet", "--direction-filter", way[0], *(["--moments"] if way[1] == "on" else [])]

    def seconds(self, *arguments):
        """Processor seconds, user and system."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.run(*arguments)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def bake(self, scene, exponent, directions, way):
        """The light maps' name, the exponent that is shown where it is another, and processor seconds."""
        base = self.base(exponent, directions, way)
        if not os.path.exists(base + ".dlm"):
            seconds = self.seconds(*self.arguments(scene, base, directions, way), "--report", base + ".json")
            with open(base + ".seconds", "w") as out:
                out.write(str(seconds))
        report = json.load(open(base + ".json"))
        shown = [w["shown_exponent"] for w in report["widened_highlights"] if not w["textured"]]
        return base, f"{max(shown):.0f}" if shown else "", float(open(base + ".seconds").read())

    def picture(self, base, lobe, truth):
        """FLIP and relative error of one picture, and the time of its frame, ms."""
        picture = f"{base}-{lobe}.exr"
        log = self.run("render", base + ".dlm", "-o", picture, "--size", self.o.size, "--lobe", lobe, *self.camera()).stderr
        difference = self.compare(truth, picture)
        return difference["flip"]["mean"], difference["relative_error"], float(re.search(r"frame ([0-9.]+) ms", log).group(1))


def ways_of(options):
    return [(f, m) for f in options.filters.split(",") for m in options.moments.split(",")]


def turns(study, exponent, options):
    """Processor time of bakes and frames, the ways in turn."""
    print(f"\n### Processor time over that of the first way, exponent {exponent}, least of {options.turns}\n")
    print("| directions | filter | moments | bake | frame |")
    print("|---|---|---|---|---|")
    scene = study.path(f"{options.scene}-n{exponent}.glb")
    walk = {"format": "lucarne-walk", "version": 1, "rate": 1, "yfov": 54.4}
    poses = [[0.3, 1.45, 2.4, 0, -22], [-0.3, 1.45, 2.2, 0, -22]]
    for name, part in (("long", poses), ("short", poses[:1])):
        json.dump({**walk, "poses": part}, open(study.path(name + ".json"), "w"))

    def frames(base, name):
        return study.seconds("render", base + ".dlm", "--replay", study.path(name + ".json"), "--size", options.size, "--fps", "20",
                             "--benchmark", study.path("times.json"), "--quiet")

    for directions in options.directions.split(","):
        ways = ways_of(options)
        bake, frame = {w: [] for w in ways}, {w: {"long": [], "short": []} for w in ways}
        for _ in range(options.turns):
            for way in ways:
                again = study.base(exponent, directions, way) + "-again"
                bake[way].append(study.seconds(*study.arguments(scene, again, directions, way)))
            for way in ways:
                for name, all in frame[way].items():
                    all.append(frames(study.base(exponent, directions, way), name))
        twenty = {w: min(frame[w]["long"]) - min(frame[w]["short"]) for w in ways}
        for way in ways:
            print(f"| {directions} | {way[0]} | {way[1]} | {min(bake[way]) / min(bake[ways[0]]):.2f} | "
                  f"{twenty[way] / twenty[ways[0]]:.2f} |", flush=True)


def table(study, exponent, options):
    scene, truth, floor = study.truth(exponent)
    print(f"\n### Exponent {exponent}\n\nTwo truths: FLIP {floor['flip']['mean']:.4f}, error {100 * floor['relative_error']:.1f} %.\n")
    lobes = options.lobes.split(",")
    print("| directions | filter | moments | shown exponent | on disk, MB | bake, s | "
          + " | ".join(f"{l}: FLIP | error | frame, ms" for l in lobes) + " |")
    print("|---" * (6 + 3 * len(lobes)) + "|")
    for directions in options.directions.split(","):
        for way in ways_of(options):
            base, shown, seconds = study.bake(scene, exponent, directions, way)
            row = [directions, *way, shown, f"{folder_size(base + '.dlm') / 1e6:.1f}", f"{seconds:.1f}"]
            for lobe in lobes:
                flip, error, frame = study.picture(base, lobe, truth)
                row += [f"{flip:.4f}", f"{100 * error:.1f} %", f"{frame:.0f}"]
            print("| " + " | ".join(row) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--lucarne", default=os.path.join(HERE, "../build/release/cli/lucarne"))
    parser.add_argument("--out", default=os.path.join(HERE, "../out/glossy"))
    parser.add_argument("--exponents", default="1,3,10,30,100")
    parser.add_argument("--directions", default="14,32,64,128,256,512,1024")
    parser.add_argument("--lobes", default="cell,barsi,sample")
    parser.add_argument("--filters", default="nearest,linear")
    parser.add_argument("--moments", default="off,on")
    parser.add_argument("--turns", type=int, default=0)
    parser.add_argument("--scene", default="two_lamps", choices=["two_lamps", "glossy_room"])
    parser.add_argument("--camera")
    parser.add_argument("--photons", default="20M")
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--size", default="320x180")
    options = parser.parse_args()
    study = Study(options)
    for exponent in options.exponents.split(","):
        table(study, int(exponent), options)
    if options.turns > 0:
        turns(study, int(options.exponents.split(",")[0]), options)


if __name__ == "__main__":
    main()
