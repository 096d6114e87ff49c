#!/usr/bin/env python3
"""Writes Lucarne's example scenes beside this file. With --check writes nothing and fails where one would change.

Needs only Python 3's standard library. The bytes are the same on every machine.
"""

import argparse
import pathlib
import sys

sys.dont_write_bytecode = True

from generator.cornell_box import cornell_box  # noqa: E402
from generator.glossy_room import glossy_room  # noqa: E402
from generator.two_lamps import two_lamps  # noqa: E402

SCENES = {"glossy_room.glb": glossy_room, "cornell_box.glb": cornell_box, "two_lamps.glb": two_lamps}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare with the files that are there")
    check = parser.parse_args().check
    folder = pathlib.Path(__file__).resolve().parent
    stale = []
    for name, make in SCENES.items():
        path, content = folder / name, make()
        if not check:
            path.write_bytes(content)
            print(f"{name}: {len(content)} bytes")
        elif not path.is_file() or path.read_bytes() != content:
            stale.append(name)
    if stale:
        sys.exit("not as make_scenes.py makes them: " + ", ".join(stale))


if __name__ == "__main__":
    main()
