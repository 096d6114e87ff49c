"""Shapes made of boxes, surfaces of revolution and single quads.

Metres, y up, triangles counter-clockwise from outside. Texture coordinates are in metres along the surface, the longer
side of a face along u; the writer divides them by the tile of the material's image.
"""

import math

CREASE_COSINE = math.cos(math.radians(50))


class Surface:
    """Triangles of one material."""

    def __init__(self):
        self.vertices = []  # (position, normal, texture coordinates)
        self.triangles = []

    def add_triangle(self, positions, normals, uvs):
        """Adds a triangle, turned so that its front is on the side of the normals."""
        face = cross(subtract(positions[1], positions[0]), subtract(positions[2], positions[0]))
        mean = [sum(normal[k] for normal in normals) for k in range(3)]
        order = (0, 1, 2) if dot(face, mean) > 0 else (0, 2, 1)
        first = len(self.vertices)
        self.vertices += [(tuple(positions[i]), tuple(normals[i]), tuple(uvs[i])) for i in order]
        self.triangles.append((first, first + 1, first + 2))


class Shape:
    """Surfaces by material; what one mesh of the file is made from."""

    def __init__(self):
        self.surfaces = {}

    def surface(self, material):
        return self.surfaces.setdefault(material, Surface())

    def flat_triangle(self, material, a, b, c):
        normal = normalized(cross(subtract(b, a), subtract(c, a)))
        self.surface(material).add_triangle((a, b, c), (normal,) * 3, ((0, 0),) * 3)

    def quad(self, material, origin, along_u, along_v, uv_size=None):
        """A parallelogram whose front is on the side of along_u × along_v; uv_size replaces its sides in metres."""
        normal = normalized(cross(along_u, along_v))
        corners = (origin, add(origin, along_u), add(add(origin, along_u), along_v), add(origin, along_v))
        u, v = uv_size or (length(along_u), length(along_v))
        uvs = ((0, v), (u, v), (u, 0), (0, 0))
        if uv_size is None and v > u:
            uvs = tuple((b, a) for a, b in uvs)
        surface = self.surface(material)
        for i, j, k in ((0, 1, 2), (0, 2, 3)):
            surface.add_triangle([corners[n] for n in (i, j, k)], (normal,) * 3, [uvs[n] for n in (i, j, k)])

    def box(self, material, low, high, omit=""):
        """An axis-aligned box without the faces named in omit ("-y +x"), which touch something and are never seen."""
        dx, dy, dz = subtract(high, low)
        (x0, y0, z0), (x1, y1, z1) = low, high
        faces = {
            "+x": ((x1, y0, z1), (0, 0, -dz), (0, dy, 0)), "-x": ((x0, y0, z0), (0, 0, dz), (0, dy, 0)),
            "+y": ((x0, y1, z1), (dx, 0, 0), (0, 0, -dz)), "-y": ((x0, y0, z0), (dx, 0, 0), (0, 0, dz)),
            "+z": ((x0, y0, z1), (dx, 0, 0), (0, dy, 0)), "-z": ((x1, y0, z0), (-dx, 0, 0), (0, dy, 0)),
        }
        for name, (origin, along_u, along_v) in faces.items():
            if name not in omit.split():
                self.quad(material, origin, along_u, along_v)

    def lathe(self, material, profile, segments):
        """Turns a profile of (radius, height) about the y axis.

        The profile runs from the axis below outwards, up the outside and back to the axis, so that the solid is on its
        left. Normals are smooth around, and along the profile where it bends by less than 50 degrees.
        """
        ends = _profile_normals(profile)
        surface = self.surface(material)
        for k in range(segments):
            angles = (2 * math.pi * k / segments, 2 * math.pi * (k + 1) / segments)
            for (low, high), normals in zip(zip(profile, profile[1:]), ends):
                _add_lathe_cell(surface, (low, high), normals, angles)

    def turned(self, quarters):
        """This shape turned about y by exact quarter turns; one takes +z to +x."""
        result = Shape()
        for material, surface in self.surfaces.items():
            target = result.surface(material)
            target.triangles = list(surface.triangles)
            target.vertices = [(_turn(p, quarters), _turn(n, quarters), uv) for p, n, uv in surface.vertices]
        return result


def sphere_profile(radius, center_height, rings):
    """A profile for Shape.lathe, exact at both poles."""
    inner = [(radius * math.sin(math.pi * i / rings), center_height - radius * math.cos(math.pi * i / rings))
             for i in range(1, rings)]
    return [(0.0, center_height - radius)] + inner + [(0.0, center_height + radius)]


def smooth_profile(points, steps):
    """A Catmull-Rom curve through the points, with `steps` segments between each two."""
    padded = [points[0]] + list(points) + [points[-1]]
    curve = []
    for p0, p1, p2, p3 in zip(padded, padded[1:], padded[2:], padded[3:]):
        curve += [tuple(_catmull_rom(p0[k], p1[k], p2[k], p3[k], s / steps) for k in (0, 1)) for s in range(steps)]
    return curve + [tuple(points[-1])]


def _catmull_rom(a, b, c, d, t):
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)))


def _profile_normals(profile):
    """For each segment of a profile, the (radial, vertical) normals at its two ends."""
    own = []
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        size = math.hypot(r1 - r0, y1 - y0)
        own.append(((y1 - y0) / size, (r0 - r1) / size))
    ends = []
    for i, normal in enumerate(own):
        start = _blend(normal, own[i - 1]) if i > 0 else _at_axis(normal, profile[0])
        end = _blend(normal, own[i + 1]) if i + 1 < len(own) else _at_axis(normal, profile[-1])
        ends.append((start, end))
    return ends


def _blend(normal, neighbour):
    if normal[0] * neighbour[0] + normal[1] * neighbour[1] < CREASE_COSINE:
        return normal
    total = (normal[0] + neighbour[0], normal[1] + neighbour[1])
    size = math.hypot(*total)
    return (total[0] / size, total[1] / size)


def _at_axis(normal, point):
    is_smooth_pole = point[0] == 0 and abs(normal[1]) > CREASE_COSINE
    return (0.0, math.copysign(1.0, normal[1])) if is_smooth_pole else normal


def _add_lathe_cell(surface, segment, normals, angles):
    corners = [(end, angle) for end, angle in ((0, angles[0]), (0, angles[1]), (1, angles[1]), (1, angles[0]))]
    positions = [_around(segment[end], angle) for end, angle in corners]
    directions = [_around(normals[end], angle) for end, angle in corners]
    for triple in ((0, 1, 2), (0, 2, 3)):
        low_pole = segment[0][0] == 0 and 0 in triple and 1 in triple
        high_pole = segment[1][0] == 0 and 2 in triple and 3 in triple
        if not (low_pole or high_pole):
            surface.add_triangle([positions[i] for i in triple], [directions[i] for i in triple], ((0, 0),) * 3)


def _around(point, angle):
    """(radius, height) turned by an angle; rounded so that the last segment closes exactly on the first."""
    radius, height = point
    return (round(radius * math.cos(angle), 9) + 0.0, height, round(radius * math.sin(angle), 9) + 0.0)


def _turn(vector, quarters):
    x, y, z = vector
    for _ in range(quarters % 4):
        x, z = z, -x
    return (x, y, z)


def add(a, b):
    return tuple(p + q for p, q in zip(a, b))


def subtract(a, b):
    return tuple(p - q for p, q in zip(a, b))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def normalized(a):
    size = length(a)
    return tuple(p / size for p in a)
