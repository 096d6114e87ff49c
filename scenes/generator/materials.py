"""Materials as the scenes use them: exactly diffuse, softly glossy, metal, and lamps. Colours are linear Rec. 709."""

import math
from dataclasses import dataclass
from typing import Optional

from generator.textures import Texture

PHONG_EXPONENT = 10


@dataclass(frozen=True)
class Material:
    name: str
    base_color: tuple
    roughness: float = 1.0
    metallic: float = 0.0
    f0: float = 0.0  # reflectance of the dielectric interface at normal incidence; 0: exactly Lambert
    texture: Optional[Texture] = None
    emission_color: tuple = (0.0, 0.0, 0.0)  # largest channel 1
    luminance_scale: float = 0.0  # cd/m² of that channel

    def luminous_exitance(self):
        """lm/m², the luminance weights being Rec. 709's."""
        red, green, blue = self.emission_color
        return math.pi * self.luminance_scale * (0.2126 * red + 0.7152 * green + 0.0722 * blue)


def roughness_of_phong_exponent(exponent):
    """glTF roughness whose GGX lobe is about as wide as a Phong lobe around the mirror direction.

    A Phong lobe of exponent n is about a half-vector (Blinn) lobe of 4n, and that is α² = 2 / (4n + 2); α = roughness².
    """
    return (2.0 / (4.0 * exponent + 2.0)) ** 0.25


def lambert(name, color, texture=None):
    return Material(name, color, texture=texture)


def glossy(name, color, f0, texture=None):
    return Material(name, color, roughness_of_phong_exponent(PHONG_EXPONENT), f0=f0, texture=texture)


def metal(name, color):
    return Material(name, color, roughness_of_phong_exponent(PHONG_EXPONENT), metallic=1.0, f0=0.04)


def lamp(name, emission_color, luminance_scale, reflectance=0.78):
    return Material(name, (reflectance,) * 3, emission_color=emission_color, luminance_scale=luminance_scale)
