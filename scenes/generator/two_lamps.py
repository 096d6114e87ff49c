"""A red and a blue lamp over a dark glossy floor: two highlights, each of its own colour, that move with the viewer."""

from generator.glb import GlbWriter
from generator.materials import glossy, lambert, lamp
from generator.shapes import Shape, sphere_profile

FLOOR = glossy("glossy_floor", (0.04, 0.04, 0.04), 0.25)
WALL = lambert("dark_wall", (0.10, 0.10, 0.10))
STAND = lambert("stand", (0.03, 0.03, 0.03))
BLOCK = lambert("white_block", (0.75, 0.75, 0.75))
RED_LAMP = lamp("lamp_red", (1.0, 0.10, 0.04), 6000.0)
BLUE_LAMP = lamp("lamp_blue", (0.05, 0.16, 1.0), 9000.0)

LAMP_RADIUS, LAMP_HEIGHT = 0.14, 0.75


def two_lamps():
    """The bytes of two_lamps.glb."""
    writer = GlbWriter("two lamps", "Copyright the Lucarne authors. Licensed under Apache-2.0.")
    _add_quad(writer, "floor", FLOOR, (-3, 0, 2.5), (6, 0, 0), (0, 0, -5))
    _add_quad(writer, "wall_back", WALL, (-3, 0, -2.5), (6, 0, 0), (0, 2.5, 0))
    block = Shape()
    block.box(BLOCK, (-0.15, 0, -0.15), (0.15, 0.5, 0.15), "-y")
    writer.add_object("block", block, (0, 0, -1.5), 45)
    stand = writer.add_mesh("stand", _stand())
    for name, material, x in (("red", RED_LAMP, -1.1), ("blue", BLUE_LAMP, 1.1)):
        writer.add_node("stand_" + name, stand, (x, 0, -1.0))
        sphere = Shape()
        sphere.lathe(material, sphere_profile(LAMP_RADIUS, LAMP_HEIGHT, 12), 20)
        writer.add_object("lamp_" + name, sphere, (x, 0, -1.0))
    writer.add_camera("front", (0, 1.45, 2.4), (0, 0.25, -0.55), 0.95, 16 / 9)
    writer.add_camera("side", (2.2, 1.3, 1.7), (-0.35, 0.25, -0.75), 0.95, 16 / 9)
    return writer.to_bytes()


def _add_quad(writer, name, material, origin, along_u, along_v):
    shape = Shape()
    shape.quad(material, origin, along_u, along_v)
    writer.add_object(name, shape)


def _stand():
    """A thin rod on a foot, up to the lamp's lowest point."""
    shape = Shape()
    top = LAMP_HEIGHT - LAMP_RADIUS
    shape.lathe(STAND, [(0.08, 0.0), (0.08, 0.012), (0.008, 0.012), (0.008, top), (0.0, top)], 16)
    return shape
