#!/usr/bin/env python3
"""Adds a point light, and optionally a camera, to a .glb that has none of its own. Standard library only.

  scenes/add_light.py IN.glb OUT.glb --at X Y Z --candela I [--camera X Y Z TX TY TZ] [--colour R G B]

Positions are in the file's world space; the light goes into the default scene as a new node.
"""
import argparse
import json
import math
import struct


def read_glb(path):
    """The JSON and the bytes after its chunk."""
    data = open(path, "rb").read()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + length]), data[20 + length:]


def write_glb(path, document, rest):
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + len(rest)
    with open(path, "wb") as out:
        out.write(struct.pack("<4sIIII", b"glTF", 2, total, len(text), 0x4E4F534A) + text + rest)


def add_node(document, node):
    document.setdefault("nodes", []).append(node)
    scene = document["scenes"][document.get("scene", 0)]
    scene.setdefault("nodes", []).append(len(document["nodes"]) - 1)


def use_extension(document, name):
    used = document.setdefault("extensionsUsed", [])
    if name not in used:
        used.append(name)


def add_light(document, position, candela, colour):
    use_extension(document, "KHR_lights_punctual")
    lights = document.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {}).setdefault("lights", [])
    lights.append({"type": "point", "name": "added light", "intensity": candela, "color": colour})
    add_node(document, {"name": "added light", "translation": position,
                        "extensions": {"KHR_lights_punctual": {"light": len(lights) - 1}}})


def look_at(eye, target):
    """Quaternion of a camera at `eye` that looks at `target`, y up: yaw about y, then pitch about x."""
    dx, dy, dz = (t - e for t, e in zip(target, eye))
    yaw, pitch = math.atan2(-dx, -dz), math.atan2(dy, math.hypot(dx, dz))
    sy, cy, sp, cp = math.sin(yaw / 2), math.cos(yaw / 2), math.sin(pitch / 2), math.cos(pitch / 2)
    return [cy * sp, sy * cp, -sy * sp, cy * cp]


def add_camera(document, eye, target):
    distance = math.dist(eye, target)
    document.setdefault("cameras", []).append(
        {"type": "perspective", "name": "added camera", "perspective": {"yfov": 0.95, "znear": distance / 1000}})
    add_node(document, {"name": "added camera", "camera": len(document["cameras"]) - 1, "translation": eye,
                        "rotation": look_at(eye, target)})


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("input")
    parser.add_argument("output")
    parser.add_argument("--at", nargs=3, type=float, required=True)
    parser.add_argument("--candela", type=float, required=True)
    parser.add_argument("--colour", nargs=3, type=float, default=[1.0, 1.0, 1.0])
    parser.add_argument("--camera", nargs=6, type=float)
    arguments = parser.parse_args()
    document, rest = read_glb(arguments.input)
    add_light(document, arguments.at, arguments.candela, arguments.colour)
    if arguments.camera:
        add_camera(document, arguments.camera[:3], arguments.camera[3:])
    write_glb(arguments.output, document, rest)


if __name__ == "__main__":
    main()
