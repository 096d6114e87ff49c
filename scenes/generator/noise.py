"""Pseudo-random numbers that depend on their arguments alone."""


def hashed(*keys):
    """A number in [0, 1) for a tuple of integers."""
    state = 0x9E3779B9
    for key in keys:
        state = ((state ^ (key & 0xFFFFFFFF)) * 0x85EBCA6B) & 0xFFFFFFFF
        state ^= state >> 13
        state = (state * 0xC2B2AE35) & 0xFFFFFFFF
        state ^= state >> 16
    return state / 2.0**32


def periodic_noise(x, y, period_x, period_y, seed):
    """Smooth value noise in [0, 1) on the unit lattice, repeating after whole periods."""
    x0, y0 = int(x // 1), int(y // 1)
    fx, fy = _fade(x - x0), _fade(y - y0)
    corner = [[hashed((x0 + i) % period_x, (y0 + j) % period_y, seed) for i in (0, 1)] for j in (0, 1)]
    low = corner[0][0] + (corner[0][1] - corner[0][0]) * fx
    high = corner[1][0] + (corner[1][1] - corner[1][0]) * fx
    return low + (high - low) * fy


def _fade(t):
    return t * t * (3 - 2 * t)
