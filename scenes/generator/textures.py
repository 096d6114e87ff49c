"""Base-colour images, all computed."""

from dataclasses import dataclass

from generator.noise import hashed, periodic_noise
from generator.png import indexed_png


@dataclass(frozen=True)
class Texture:
    name: str
    png: bytes
    tile: float  # metres of surface that the image covers along its width; 1 where coordinates are 0..1 already


def _ramp(dark, light, count):
    """count sRGB colours from dark to light."""
    return [tuple(round(a + (b - a) * i / (count - 1)) for a, b in zip(dark, light)) for i in range(count)]


def _level(value, count):
    return min(count - 1, max(0, int(value * count)))


def planks(name, dark, light, size=256, boards=8, tile=1.5):
    """Floor boards along u, two joints a row, each board of its own shade, with grain and dark seams."""
    board_height = size // boards
    levels = 64

    def index_at(x, y):
        row = y // board_height
        shift = int(hashed(row, 1) * size)
        along = (x + shift) % size
        board = 2 * row + along // (size // 2)
        if y % board_height == 0 or along % (size // 2) == 0:
            return 0
        grain = periodic_noise((x + 53 * board) / 32.0, y / 2.0, size // 32, size // 2, board)
        fibre = periodic_noise(x / 8.0, y, size // 8, size, 99)
        return _level(0.12 + 0.42 * hashed(board, 7) + 0.30 * grain + 0.16 * fibre, levels)

    return Texture(name, indexed_png(size, size, _ramp(dark, light, levels), index_at), tile)


def wood_grain(name, dark, light, size=128, tile=0.8):
    """Plain wood, grain along u."""
    levels = 64

    def index_at(x, y):
        broad = periodic_noise(x / 64.0, y / 8.0, size // 64, size // 8, 3)
        fine = periodic_noise(x / 16.0, y, size // 16, size, 4)
        return _level(0.1 + 0.5 * broad + 0.4 * fine, levels)

    return Texture(name, indexed_png(size, size, _ramp(dark, light, levels), index_at), tile)


def rug(name, size=128):
    """A woven rug with a border and a field of lozenges; coordinates 0..1 over the whole rug."""
    palette = [(92, 28, 26), (150, 52, 40), (206, 178, 132), (38, 46, 66), (176, 118, 66), (110, 36, 32)]

    def index_at(x, y):
        edge = min(x, y, size - 1 - x, size - 1 - y)
        if edge < 4:
            return 2
        if edge < 12:
            return 4 if (x // 4 + y // 4) % 2 else 3
        if edge < 14:
            return 2
        lozenge = (abs((x % 32) - 16) + abs((y % 32) - 16)) // 4
        return (0, 4, 1, 1, 3, 5, 0, 5, 0)[min(lozenge, 8)]

    return Texture(name, indexed_png(size, size, palette, index_at), 1.0)


def hills(name, width, height, sky, land, seed):
    """A painting: a graded sky over three ranges of hills. sky, land: (upper, lower) and (far, near) sRGB colours."""
    shades, ranges = 48, 3
    palette = _ramp(sky[0], sky[1], shades) + _ramp(land[0], land[1], ranges)

    def horizon(x, k):
        coarse = periodic_noise(x / 32.0, k, 64, 64, seed)
        fine = periodic_noise(x / 9.0, k, 64, 64, seed + 1)
        return height * (0.50 + 0.16 * k + 0.20 * (coarse - 0.5) + 0.05 * (fine - 0.5))

    def index_at(x, y):
        for k in reversed(range(ranges)):
            if y > horizon(x, k):
                return shades + k
        return _level(y / (0.7 * height), shades)

    return Texture(name, indexed_png(width, height, palette, index_at), 1.0)
