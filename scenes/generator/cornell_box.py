"""The Cornell box, from the data published by the Cornell University Program of Computer Graphics.

The measured vertices are in millimetres, here in metres. Their frame is right-handed, y up, as glTF's is: the published
camera looks along +z, so that x runs to the left and the red wall, at x = 0.55, is on the left of the picture.
"""

import math

from generator.glb import GlbWriter
from generator.materials import lambert, lamp
from generator.shapes import Shape

# The published spectra in linear Rec. 709 RGB, as renderers have long rounded them.
WHITE = lambert("white", (0.725, 0.71, 0.68))
RED = lambert("red", (0.63, 0.065, 0.05))
GREEN = lambert("green", (0.14, 0.45, 0.091))
LIGHT = lamp("light", (1.0, 12 / 17, 4 / 17), 17000.0, reflectance=0.78)

HEIGHT = 548.8
FLOOR = ((552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2))
CEILING = ((556.0, HEIGHT, 0), (556.0, HEIGHT, 559.2), (0, HEIGHT, 559.2), (0, HEIGHT, 0))
LIGHT_CORNERS = ((343.0, HEIGHT, 227.0), (343.0, HEIGHT, 332.0), (213.0, HEIGHT, 332.0), (213.0, HEIGHT, 227.0))
SHORT_BLOCK = 165.0, ((130.0, 65.0), (82.0, 225.0), (240.0, 272.0), (290.0, 114.0))
TALL_BLOCK = 330.0, ((423.0, 247.0), (265.0, 296.0), (314.0, 456.0), (472.0, 406.0))


def cornell_box():
    """The bytes of cornell_box.glb."""
    writer = GlbWriter("Cornell box", "Geometry and reflectances: Cornell University Program of Computer Graphics. "
                                      "This file: copyright the Lucarne authors, licensed under Apache-2.0.")
    floor_left_front, floor_right_front, floor_right_back, floor_left_back = FLOOR
    ceiling_left_front, ceiling_left_back, ceiling_right_back, ceiling_right_front = CEILING
    _add(writer, "floor", WHITE, [FLOOR])
    _add(writer, "ceiling", WHITE, _ring(CEILING, LIGHT_CORNERS))
    _add(writer, "light", LIGHT, [LIGHT_CORNERS])
    _add(writer, "wall_back", WHITE, [(floor_left_back, floor_right_back, ceiling_right_back, ceiling_left_back)])
    _add(writer, "wall_right_green", GREEN,
         [(floor_right_back, floor_right_front, ceiling_right_front, ceiling_right_back)])
    _add(writer, "wall_left_red", RED, [(floor_left_front, floor_left_back, ceiling_left_back, ceiling_left_front)])
    _add(writer, "block_short", WHITE, _block(*SHORT_BLOCK))
    _add(writer, "block_tall", WHITE, _block(*TALL_BLOCK))
    yfov = 2 * math.atan(0.025 / 2 / 0.035)
    writer.add_camera("published", (0.278, 0.273, -0.8), (0.278, 0.273, 0.0), yfov, 1.0)
    return writer.to_bytes()


def _add(writer, name, material, quads):
    """Corners in millimetres, counter-clockwise from the front. The red wall is not quite flat: its triangles are."""
    shape = Shape()
    for corners in quads:
        a, b, c, d = (tuple(value / 1000 for value in corner) for corner in corners)
        shape.flat_triangle(material, a, b, c)
        shape.flat_triangle(material, a, c, d)
    writer.add_object(name, shape)


def _ring(outer, inner):
    """The part of a quad around a hole in it; corner i of one lies nearest to corner i of the other."""
    return [(outer[i], outer[(i + 1) % 4], inner[(i + 1) % 4], inner[i]) for i in range(4)]


def _block(height, footprint):
    """Top and sides; the bottom stands on the floor. The footprint (x, z) is counter-clockwise seen from above."""
    bottom = [(x, 0.0, z) for x, z in footprint]
    top = [(x, height, z) for x, z in footprint]
    sides = [(bottom[i], bottom[(i + 1) % 4], top[(i + 1) % 4], top[i]) for i in range(4)]
    return [tuple(top)] + sides
