"""Furniture and lamps, made of boxes that touch and do not cut each other.

Each piece stands on y = 0. What stands against a wall has the wall at z = 0 and the room at positive z; the rest is
centred on the y axis and faces +z. Faces that lie against a floor, a wall or another box are left out.
"""

from generator.noise import hashed
from generator.shapes import Shape

DOOR_FRAME = 0.07  # width


def table(wood, width, depth, height):
    """Four legs, an apron and a top."""
    shape = Shape()
    top, leg, inset, rail_height, rail = 0.035, 0.07, 0.04, 0.09, 0.022
    x0, z0 = width / 2 - inset, depth / 2 - inset
    under = height - top
    shape.box(wood, (-width / 2, under, -depth / 2), (width / 2, height, depth / 2))
    _add_four_legs(shape, wood, x0, z0, leg, under)
    gap = (leg - rail) / 2
    for side in (-1, 1):
        low_z, high_z = sorted((side * (z0 - gap), side * (z0 - gap - rail)))
        shape.box(wood, (-x0 + leg, under - rail_height, low_z), (x0 - leg, under, high_z), "+y -x +x")
        low_x, high_x = sorted((side * (x0 - gap), side * (x0 - gap - rail)))
        shape.box(wood, (low_x, under - rail_height, -z0 + leg), (high_x, under, z0 - leg), "+y -z +z")
    return shape


def chair(wood, seat_material):
    """Faces +z; the back is at negative z."""
    shape = Shape()
    half, leg, under, seat = 0.21, 0.036, 0.43, 0.46
    shape.box(seat_material, (-half, under, -half), (half, seat, half))
    _add_four_legs(shape, wood, half - 0.01, half - 0.01, leg, under)
    post_z0, post_z1, top = -half, -half + 0.03, 0.93
    inner = half - leg
    for side in (-1, 1):
        low, high = sorted((side * inner, side * half))
        shape.box(wood, (low, seat, post_z0), (high, top, post_z1), "-y")
    for low, high in ((0.58, 0.63), (0.69, 0.74), (0.80, 0.92)):
        shape.box(wood, (-inner, low, post_z0 + 0.006), (inner, high, post_z1 - 0.006), "-x +x")
    return shape


def armchair(fabric, wood):
    """A low easy chair; faces +z."""
    shape = Shape()
    half_width, half_depth, arm, foot, seat = 0.40, 0.40, 0.12, 0.10, 0.40
    _add_four_legs(shape, wood, half_width - 0.04, half_depth - 0.04, 0.05, foot)
    inner, back = half_width - arm, -half_depth + 0.16
    shape.box(fabric, (-half_width, foot, -half_depth), (half_width, 0.30, half_depth))
    for side in (-1, 1):
        low, high = sorted((side * inner, side * half_width))
        shape.box(fabric, (low, 0.30, back), (high, 0.56, half_depth), "-y -z")
    shape.box(fabric, (-half_width, 0.30, -half_depth), (half_width, 0.88, back), "-y")
    shape.box(fabric, (-inner + 0.01, 0.30, back + 0.01), (inner - 0.01, seat, half_depth - 0.02), "-y")
    return shape


def sideboard(paint, top_wood, handle_metal, width, depth, height):
    """A cabinet of three doors on a recessed plinth; its back is at z = 0."""
    shape = Shape()
    plinth, top, doors = 0.07, 0.025, 3
    front = depth - 0.02
    shape.box(paint, (-width / 2 + 0.04, 0, 0.02), (width / 2 - 0.04, plinth, front - 0.05), "-y +y")
    shape.box(paint, (-width / 2, plinth, 0), (width / 2, height - top, front))
    shape.box(top_wood, (-width / 2 - 0.01, height - top, 0), (width / 2 + 0.01, height, depth + 0.005))
    panel = width / doors
    for k in range(doors):
        x0 = -width / 2 + k * panel
        low, high = (x0 + 0.008, plinth + 0.01, front), (x0 + panel - 0.008, height - top - 0.01, front + 0.014)
        shape.box(paint, low, high, "-z")
        handle = x0 + (0.07 if k == doors - 1 else panel - 0.07)
        shape.box(handle_metal, (handle - 0.007, 0.48, front + 0.014), (handle + 0.007, 0.62, front + 0.034), "-z")
    return shape


def bookcase_shelf_heights(height):
    """Upper sides of the boards on which books stand."""
    return [0.09 + k * (height - 0.09 - 0.02) / 4 for k in range(4)]


def bookcase(wood, width, depth, height):
    """An open case of four shelves; its back is at z = 0."""
    shape = Shape()
    side, board, panel = 0.025, 0.02, 0.01
    x0 = width / 2 - side
    for sign in (-1, 1):
        low, high = sorted((sign * x0, sign * width / 2))
        shape.box(wood, (low, 0, 0), (high, height, depth), "-y")
    shape.box(wood, (-x0, 0, 0), (x0, height, panel), "-x +x -y")
    shape.box(wood, (-x0, height - board, panel), (x0, height, depth), "-x +x -z")
    lowest, *shelves = bookcase_shelf_heights(height)
    shape.box(wood, (-x0, 0, panel), (x0, lowest, depth - 0.02), "-x +x -z -y")
    for y in shelves:
        shape.box(wood, (-x0, y - board, panel), (x0, y, depth - 0.01), "-x +x -z")
    return shape


def add_book_row(shape, cloths, x_start, x_end, z_back, depth, height, seed):
    """Upright books side by side from x_start, as many as fit before x_end, none higher than `height`."""
    x, k = x_start, 0
    while True:
        thickness = 0.022 + 0.034 * hashed(seed, k, 0)
        if x + thickness > x_end:
            return
        cloth = cloths[int(hashed(seed, k, 1) * len(cloths))]
        size = (height * (0.72 + 0.28 * hashed(seed, k, 2)), depth * (0.72 + 0.28 * hashed(seed, k, 3)))
        shape.box(cloth, (x, 0, z_back), (x + thickness, size[0], z_back + size[1]), "-y")
        x += thickness + 0.0015
        k += 1


def picture(frame, canvas, width, height):
    """A framed canvas; z = 0 is the wall, y = 0 its lower edge."""
    shape = Shape()
    border, thickness = 0.035, 0.028
    x = width / 2
    for side in (-1, 1):
        low, high = sorted((side * x, side * (x - border)))
        shape.box(frame, (low, 0, 0), (high, height, thickness), "-z")
    for low, high in ((0, border), (height - border, height)):
        shape.box(frame, (-x + border, low, 0), (x - border, high, thickness), "-z -x +x")
    inner = (width - 2 * border, height - 2 * border)
    shape.quad(canvas, (-x + border, border, 0.014), (inner[0], 0, 0), (0, inner[1], 0), (1.0, 1.0))
    return shape


def door(paint, handle_metal, width, height):
    """A closed door with two raised panels in its frame; z = 0 is the wall."""
    shape = Shape()
    leaf, jamb, x = 0.02, 0.035, width / 2
    shape.box(paint, (-x, 0, 0), (x, height, leaf), "-y -z -x +x +y")
    for side in (-1, 1):
        low, high = sorted((side * x, side * (x + DOOR_FRAME)))
        shape.box(paint, (low, 0, 0), (high, height + DOOR_FRAME, jamb), "-y -z")
    shape.box(paint, (-x, height, 0), (x, height + DOOR_FRAME, jamb), "-z -x +x")
    for low, high in ((0.20, 0.85), (1.10, height - 0.15)):
        shape.box(paint, (-x + 0.14, low, leaf), (x - 0.14, high, leaf + 0.012), "-z")
    handle_x = x - 0.06
    shape.box(handle_metal, (handle_x - 0.02, 0.96, leaf), (handle_x + 0.02, 1.10, leaf + 0.006), "-z")
    shape.box(handle_metal, (handle_x - 0.01, 1.03, leaf + 0.006), (handle_x + 0.01, 1.05, leaf + 0.05), "-z")
    shape.box(handle_metal, (handle_x - 0.12, 1.03, leaf + 0.05), (handle_x + 0.01, 1.05, leaf + 0.066))
    return shape


_BULB_RADIUS, _BULB_HEIGHT = 0.10, 1.46
_RIM_HEIGHT = 1.78
_LAMP_SEGMENTS = 20


def uplighter_stand(stem_metal, outside, inside):
    """A floor lamp whose deep opaque shade opens upwards. The lamp itself is uplighter_lamp, which closes its bottom.

    No light leaves lower than the line from the lamp's edge over the opposite rim, 45 degrees above the horizon.
    """
    shape = Shape()
    shape.lathe(stem_metal, [(0.15, 0.0), (0.15, 0.02), (0.014, 0.035), (0.014, 1.40)], _LAMP_SEGMENTS)
    shape.lathe(outside, [(0.014, 1.40), (0.11, 1.425), (0.225, _RIM_HEIGHT), (0.215, _RIM_HEIGHT)], _LAMP_SEGMENTS)
    shape.lathe(inside, [(0.215, _RIM_HEIGHT), (_BULB_RADIUS, _BULB_HEIGHT)], _LAMP_SEGMENTS)
    return shape


def uplighter_lamp(lamp):
    """The shining disc at the bottom of an uplighter's shade; faces up."""
    shape = Shape()
    shape.lathe(lamp, [(_BULB_RADIUS, _BULB_HEIGHT), (0.0, _BULB_HEIGHT)], _LAMP_SEGMENTS)
    return shape


def wall_washer(paint, lamp, width):
    """A board in front of a wall, and the lamp strip on its back, which shines at the wall and up to the ceiling.

    The board's lip hides the strip from below: the lowest line from the strip past the lip meets the wall at
    y = lip - (top of the strip - lip) · (lip to wall) / (strip to lip) = -2.15, which is above the floor where the board
    hangs higher than that.
    """
    board, strip = Shape(), Shape()
    front, back, lip_height, lip = 0.415, 0.40, 0.01, 0.371
    x = width / 2
    board.box(paint, (-x, 0, back), (x, 0.20, front))
    board.box(paint, (-x, 0, lip), (x, lip_height, back), "+z")
    for side in (-1, 1):
        low, high = sorted((side * (x - 0.012), side * x))
        board.box(paint, (low, lip_height, 0), (high, 0.20, back), "-z +z")
    face = back - 0.005
    low, high = (-x + 0.1, 0.05, face), (x - 0.1, 0.15, back)
    board.box(paint, low, high, "+z -z")
    strip.quad(lamp, (high[0], low[1], face), (low[0] - high[0], 0, 0), (0, high[1] - low[1], 0))
    return board, strip


def _add_four_legs(shape, material, x_outside, z_outside, thickness, height):
    for side_x in (-1, 1):
        for side_z in (-1, 1):
            x = sorted((side_x * x_outside, side_x * (x_outside - thickness)))
            z = sorted((side_z * z_outside, side_z * (z_outside - thickness)))
            shape.box(material, (x[0], 0, z[0]), (x[1], height, z[1]), "-y +y")
