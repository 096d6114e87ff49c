"""A furnished room lit almost wholly indirectly, after figure 1 of Hey and Purgathofer (2002).

x to the right, y up, z towards the front wall; the origin is in the middle of the floor. The lamps, two uplighters and a
strip behind a board above the back wall, light the ceiling and the back wall only.
"""

from generator import furniture
from generator.glb import GlbWriter
from generator.materials import glossy, lamp, lambert, metal
from generator.shapes import Shape, smooth_profile, sphere_profile
from generator.textures import hills, planks, rug, wood_grain

WIDTH, HEIGHT, DEPTH = 6.0, 2.8, 4.5
LEFT, RIGHT, BACK, FRONT = -WIDTH / 2, WIDTH / 2, -DEPTH / 2, DEPTH / 2
SKIRTING = 0.015  # thickness
EYE = 1.6

FLOOR = glossy("floor_planks", (1.0, 1.0, 1.0), 0.25, planks("planks", (30, 19, 14), (88, 57, 38)))
TABLE_WOOD = glossy("table_wood", (1.0, 1.0, 1.0), 0.12, wood_grain("cherry", (92, 44, 24), (156, 88, 50)))
CHAIR_WOOD = glossy("chair_wood", (0.050, 0.026, 0.016), 0.12)
CHAIR_LEATHER = glossy("chair_leather", (0.30, 0.035, 0.030), 0.08)
CERAMIC = glossy("blue_ceramic", (0.05, 0.16, 0.42), 0.10)
PORCELAIN = glossy("porcelain", (0.70, 0.68, 0.62), 0.08)
BALL = glossy("red_lacquer", (0.50, 0.03, 0.02), 0.10)
FRUIT = glossy("orange_peel", (0.75, 0.27, 0.02), 0.05)
BRASS = metal("brass", (0.80, 0.58, 0.28))

WALL = lambert("wall_paint", (0.76, 0.72, 0.64))
TINTED_WALL = lambert("teal_paint", (0.16, 0.42, 0.44))
CEILING = lambert("ceiling_paint", (0.82, 0.81, 0.78))
WHITE_PAINT = lambert("white_paint", (0.78, 0.77, 0.73))
CABINET_PAINT = lambert("cabinet_paint", (0.30, 0.33, 0.30))
SHELF_WOOD = lambert("shelf_wood", (0.42, 0.27, 0.15))
FABRIC = lambert("armchair_fabric", (0.50, 0.36, 0.12))
SHADE_OUTSIDE = lambert("shade_outside", (0.30, 0.28, 0.25))
SHADE_INSIDE = lambert("shade_inside", (0.80, 0.78, 0.72))
DARK_FRAME = lambert("picture_frame", (0.045, 0.035, 0.03))
BOOK_CLOTHS = tuple(lambert("book_" + name, color) for name, color in (
    ("red", (0.38, 0.05, 0.04)), ("blue", (0.05, 0.10, 0.26)), ("green", (0.06, 0.17, 0.08)),
    ("ochre", (0.48, 0.30, 0.07)), ("cream", (0.62, 0.56, 0.42))))
RUG_TOP = lambert("rug_pattern", (1.0, 1.0, 1.0), rug("rug"))
RUG_SIDE = lambert("rug_side", (0.25, 0.12, 0.08))
SUNSET = lambert("painting_sunset", (1.0, 1.0, 1.0), hills(
    "sunset", 128, 64, ((58, 84, 140), (246, 178, 96)), ((120, 92, 120), (34, 30, 44)), 5))
MEADOW = lambert("painting_meadow", (1.0, 1.0, 1.0), hills(
    "meadow", 64, 64, ((110, 160, 206), (226, 232, 224)), ((120, 158, 130), (44, 84, 30)), 11))

WARM_LAMP = lamp("lamp_warm", (1.0, 0.62, 0.33), 24000.0)
NEUTRAL_LAMP = lamp("lamp_neutral", (1.0, 0.86, 0.72), 18500.0)
COOL_LAMP = lamp("lamp_cool", (0.84, 0.93, 1.0), 4200.0)


def glossy_room():
    """The bytes of glossy_room.glb."""
    writer = GlbWriter("glossy room", "Copyright the Lucarne authors. Licensed under Apache-2.0.")
    _add_shell(writer)
    _add_lamps(writer)
    _add_dining_table(writer)
    _add_sideboard(writer)
    _add_sitting_corner(writer)
    _add_bookcase(writer)
    _add_wall_things(writer)
    wide = 16 / 9
    writer.add_camera("entrance", (2.62, EYE, 1.92), (-0.55, 0.72, -1.1), 0.95, wide)
    writer.add_camera("table", (-0.95, 1.25, 1.95), (0.35, 0.62, -0.75), 0.95, wide)
    writer.add_camera("corner", (-2.5, EYE, -1.3), (1.1, 0.72, 0.38), 0.95, wide)
    return writer.to_bytes()


def _add_shell(writer):
    """Floor, ceiling and walls; their fronts face the room."""
    across, up, deep = (WIDTH, 0, 0), (0, HEIGHT, 0), (0, 0, DEPTH)
    minus_across, minus_deep = (-WIDTH, 0, 0), (0, 0, -DEPTH)
    for name, material, origin, along_u, along_v in (
            ("floor", FLOOR, (LEFT, 0, FRONT), across, minus_deep),
            ("ceiling", CEILING, (LEFT, HEIGHT, BACK), across, deep),
            ("wall_back", WALL, (LEFT, 0, BACK), across, up),
            ("wall_front", WALL, (RIGHT, 0, FRONT), minus_across, up),
            ("wall_left", TINTED_WALL, (LEFT, 0, FRONT), minus_deep, up),
            ("wall_right", WALL, (RIGHT, 0, BACK), deep, up)):
        shape = Shape()
        shape.quad(material, origin, along_u, along_v)
        writer.add_object(name, shape)
    _add_door_and_skirting(writer)


def _add_door_and_skirting(writer):
    """The door is in the right wall; the skirting stops at its frame."""
    door_center, door_width = 1.15, 0.9
    door = furniture.door(WHITE_PAINT, BRASS, door_width, 2.05).turned(-1)
    writer.add_object("door", door, (RIGHT, 0, door_center))
    opening = door_width / 2 + furniture.DOOR_FRAME
    t, top = SKIRTING, 0.09
    skirting = Shape()
    skirting.box(WHITE_PAINT, (LEFT, 0, BACK), (LEFT + t, top, FRONT), "-x -y -z +z")
    skirting.box(WHITE_PAINT, (LEFT + t, 0, BACK), (RIGHT - t, top, BACK + t), "-z -y -x +x")
    skirting.box(WHITE_PAINT, (LEFT + t, 0, FRONT - t), (RIGHT - t, top, FRONT), "+z -y -x +x")
    skirting.box(WHITE_PAINT, (RIGHT - t, 0, BACK), (RIGHT, top, door_center - opening), "+x -y -z +z")
    skirting.box(WHITE_PAINT, (RIGHT - t, 0, door_center + opening), (RIGHT, top, FRONT), "+x -y -z +z")
    writer.add_object("skirting", skirting)


def _add_lamps(writer):
    stand = writer.add_mesh("uplighter", furniture.uplighter_stand(BRASS, SHADE_OUTSIDE, SHADE_INSIDE))
    for side, material, x in (("left", WARM_LAMP, -1.75), ("right", NEUTRAL_LAMP, 1.75)):
        at = (x, 0, -1.72)
        writer.add_node("uplighter_" + side, stand, at)
        writer.add_object("uplighter_" + side + "_lamp", furniture.uplighter_lamp(material), at)
    board, strip = furniture.wall_washer(WHITE_PAINT, COOL_LAMP, 2.5)
    writer.add_object("wall_washer", board, (0, 2.36, BACK))
    writer.add_object("wall_washer_lamp", strip, (0, 2.36, BACK))


def _add_dining_table(writer):
    x, z, half_depth = 0.25, 0.20, 0.45
    writer.add_object("table", furniture.table(TABLE_WOOD, 1.6, 2 * half_depth, 0.75), (x, 0, z))
    chair = writer.add_mesh("chair", furniture.chair(CHAIR_WOOD, CHAIR_LEATHER))
    for name, dx, dz, turned in (("back_left", -0.38, -0.62, 0), ("back_right", 0.40, -0.60, 0),
                                 ("front_left", -0.40, 0.61, 180), ("front_right", 0.52, 0.83, 152)):
        writer.add_node("chair_" + name, chair, (x + dx, 0, z + dz), turned)
    bowl = Shape()
    outside = [(0.0, 0.0), (0.055, 0.0), (0.055, 0.012)] + smooth_profile(
        [(0.055, 0.012), (0.11, 0.035), (0.145, 0.075), (0.155, 0.115)], 3)[1:]
    inside = smooth_profile([(0.148, 0.115), (0.138, 0.079), (0.102, 0.042), (0.0, 0.022)], 3)
    bowl.lathe(PORCELAIN, outside + inside, 24)
    writer.add_object("bowl", bowl, (x - 0.15, 0.75, z + 0.02))
    orange = Shape()
    orange.lathe(FRUIT, sphere_profile(0.04, 0.0, 8), 12)
    mesh = writer.add_mesh("orange", orange)
    for k, (dx, dy, dz) in enumerate(((-0.045, 0.081, 0.03), (0.05, 0.082, 0.028), (0.0, 0.083, -0.055))):
        writer.add_node("orange_%d" % (k + 1), mesh, (x - 0.15 + dx, 0.75 + dy, z + 0.02 + dz))


def _add_sideboard(writer):
    at = (0.0, 0, BACK + SKIRTING + 0.005)
    writer.add_object("sideboard", furniture.sideboard(CABINET_PAINT, TABLE_WOOD, BRASS, 1.8, 0.42, 0.82), at)
    vase = Shape()
    outside = [(0.0, 0.0), (0.06, 0.0)] + smooth_profile(
        [(0.06, 0.0), (0.105, 0.09), (0.085, 0.20), (0.035, 0.27), (0.05, 0.33)], 5)[1:]
    inside = [(0.043, 0.33), (0.028, 0.27), (0.03, 0.24), (0.0, 0.235)]
    vase.lathe(CERAMIC, outside + inside, 24)
    writer.add_object("vase", vase, (-0.55, 0.82, at[2] + 0.2))
    books = Shape()
    furniture.add_book_row(books, BOOK_CLOTHS, 0.42, 0.80, 0.0, 0.16, 0.20, 21)
    writer.add_object("sideboard_books", books, (0, 0.82, at[2] + 0.1))


def _add_sitting_corner(writer):
    writer.add_object("armchair", furniture.armchair(FABRIC, CHAIR_WOOD), (-2.35, 0, 0.75), 72)
    carpet = Shape()
    carpet.box(RUG_SIDE, (-0.55, 0, -0.8), (0.55, 0.012, 0.8), "-y +y")
    carpet.quad(RUG_TOP, (-0.55, 0.012, 0.8), (1.1, 0, 0), (0, 0, -1.6), (1.0, 1.0))
    writer.add_object("rug", carpet, (-1.35, 0, 0.2), 4)
    ball = Shape()
    ball.lathe(BALL, sphere_profile(0.15, 0.15, 16), 24)
    writer.add_object("ball", ball, (1.45, 0, -0.80))


def _add_bookcase(writer):
    writer.add_object("bookcase", furniture.bookcase(SHELF_WOOD, 1.0, 0.3, 1.9).turned(-1),
                      (RIGHT - SKIRTING - 0.005, 0, -0.35))
    for k, height in enumerate(furniture.bookcase_shelf_heights(1.9)):
        books = Shape()
        start, end = ((-0.45, 0.30), (-0.20, 0.45), (-0.45, 0.10), (-0.45, 0.38))[k]
        furniture.add_book_row(books, BOOK_CLOTHS, start, end, 0.03, 0.24, 0.28, 40 + k)
        writer.add_object("bookcase_books_%d" % (k + 1), books.turned(-1), (RIGHT - SKIRTING - 0.005, height, -0.35))


def _add_wall_things(writer):
    """Pictures on the back and front walls, a shelf with books and a box on the left wall."""
    for name, canvas, width, height, x, y in (("left", MEADOW, 0.44, 0.55, -1.0, 1.22),
                                              ("middle", SUNSET, 0.9, 0.6, 0.0, 1.2),
                                              ("right", MEADOW, 0.44, 0.55, 1.0, 1.22)):
        writer.add_object("picture_" + name, furniture.picture(DARK_FRAME, canvas, width, height), (x, y, BACK))
    picture = furniture.picture(DARK_FRAME, SUNSET, 0.9, 0.6).turned(2)
    writer.add_object("picture_front", picture, (0.6, 1.25, FRONT))
    shelf = Shape()
    shelf.box(SHELF_WOOD, (-0.6, 0.0, 0.0), (0.6, 0.03, 0.24), "-z")
    writer.add_object("wall_shelf", shelf.turned(1), (LEFT, 1.4, -0.75))
    things = Shape()
    furniture.add_book_row(things, BOOK_CLOTHS, -0.5, 0.12, 0.02, 0.18, 0.24, 9)
    things.box(CABINET_PAINT, (0.24, 0.0, 0.04), (0.50, 0.14, 0.20), "-y")
    writer.add_object("wall_shelf_things", things.turned(1), (LEFT, 1.43, -0.75))
