"""Writes scenes as binary glTF 2.0."""

import json
import math
import struct

from generator.shapes import cross, normalized, subtract

ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
FLOAT, UNSIGNED_SHORT = 5126, 5123
DEFAULT_F0 = 0.04  # of glTF's default index of refraction, 1.5


class GlbWriter:
    """Collects nodes and cameras, then gives the bytes of the file."""

    def __init__(self, title, copyright_notice):
        self.json = {
            "asset": {"version": "2.0", "generator": "Lucarne scenes/make_scenes.py", "copyright": copyright_notice},
            "extensionsUsed": [], "scene": 0, "scenes": [{"name": title, "nodes": []}],
            "nodes": [], "cameras": [], "meshes": [], "materials": [], "textures": [], "images": [],
            "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}],
            "accessors": [], "bufferViews": [], "buffers": [],
        }
        self.binary = bytearray()
        self.material_index = {}
        self.image_index = {}

    def add_mesh(self, name, shape):
        primitives = [self._primitive(material, surface) for material, surface in shape.surfaces.items()]
        self.json["meshes"].append({"name": name, "primitives": primitives})
        return len(self.json["meshes"]) - 1

    def add_node(self, name, mesh, at=(0, 0, 0), turned_degrees=0):
        """Places a mesh; turned_degrees is about y, counter-clockwise seen from above."""
        node = {"name": name, "mesh": mesh}
        if any(at):
            node["translation"] = _numbers(at)
        if turned_degrees:
            half = math.radians(turned_degrees) / 2
            node["rotation"] = _numbers((0, math.sin(half), 0, math.cos(half)))
        self._append_node(node)

    def add_object(self, name, shape, at=(0, 0, 0), turned_degrees=0):
        self.add_node(name, self.add_mesh(name, shape), at, turned_degrees)

    def add_camera(self, name, eye, target, yfov, aspect_ratio, znear=0.05, zfar=50.0):
        lens = {"yfov": round(yfov, 7), "aspectRatio": round(aspect_ratio, 7), "znear": znear, "zfar": zfar}
        self.json["cameras"].append({"name": name, "type": "perspective", "perspective": lens})
        self._append_node({"name": name, "camera": len(self.json["cameras"]) - 1,
                           "translation": _numbers(eye), "rotation": _numbers(_look_at(eye, target))})

    def to_bytes(self):
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        content = {key: value for key, value in self.json.items() if value not in ([], {})}
        if not self.image_index:
            content.pop("samplers")
        text = json.dumps(content, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        binary = bytes(self.binary) + b"\0" * (-len(self.binary) % 4)
        size = 12 + 8 + len(text) + 8 + len(binary)
        return (struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") + text +
                struct.pack("<I4s", len(binary), b"BIN\0") + binary)

    def _append_node(self, node):
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]))
        self.json["nodes"].append(node)

    def _primitive(self, material, surface):
        vertices, indices = _shared_vertices(surface, material.texture)
        positions = [vertex[0] for vertex in vertices]
        attributes = {"POSITION": self._float_accessor(positions, "VEC3", bounds=True),
                      "NORMAL": self._float_accessor([vertex[1] for vertex in vertices], "VEC3")}
        if material.texture:
            attributes["TEXCOORD_0"] = self._float_accessor([vertex[2] for vertex in vertices], "VEC2")
        return {"attributes": attributes, "indices": self._index_accessor(indices),
                "material": self._material(material)}

    def _float_accessor(self, rows, kind, bounds=False):
        rows = [[_float32(value) for value in row] for row in rows]
        view = self._view(b"".join(struct.pack("<%df" % len(row), *row) for row in rows), ARRAY_BUFFER)
        accessor = {"bufferView": view, "componentType": FLOAT, "count": len(rows), "type": kind}
        if bounds:
            accessor["min"] = [min(column) for column in zip(*rows)]
            accessor["max"] = [max(column) for column in zip(*rows)]
        return self._append("accessors", accessor)

    def _index_accessor(self, indices):
        assert max(indices) < 65535
        view = self._view(struct.pack("<%dH" % len(indices), *indices), ELEMENT_ARRAY_BUFFER)
        return self._append("accessors", {"bufferView": view, "componentType": UNSIGNED_SHORT, "count": len(indices),
                                          "type": "SCALAR"})

    def _view(self, data, target=None):
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.binary += data
        return self._append("bufferViews", view)

    def _material(self, material):
        if material not in self.material_index:
            self.material_index[material] = self._append("materials", self._material_json(material))
        return self.material_index[material]

    def _material_json(self, material):
        surface = {"baseColorFactor": _numbers(material.base_color) + [1.0], "metallicFactor": material.metallic,
                   "roughnessFactor": round(material.roughness, 4)}
        if material.texture:
            surface["baseColorTexture"] = {"index": self._texture(material.texture)}
        result = {"name": material.name, "pbrMetallicRoughness": surface}
        extensions = {}
        if material.f0 != DEFAULT_F0:
            extensions["KHR_materials_specular"] = _specular(material.f0)
        if material.luminance_scale:
            result["emissiveFactor"] = _numbers(material.emission_color)
            extensions["KHR_materials_emissive_strength"] = {"emissiveStrength": material.luminance_scale}
        if extensions:
            result["extensions"] = extensions
        used = self.json["extensionsUsed"]
        used += [name for name in extensions if name not in used]
        return result

    def _texture(self, texture):
        if texture not in self.image_index:
            image = self._append("images", {"name": texture.name, "mimeType": "image/png",
                                            "bufferView": self._view(texture.png)})
            self.image_index[texture] = self._append("textures", {"name": texture.name, "sampler": 0, "source": image})
        return self.image_index[texture]

    def _append(self, kind, value):
        self.json[kind].append(value)
        return len(self.json[kind]) - 1


def _specular(f0):
    if f0 == 0:
        return {"specularFactor": 0.0}
    return {"specularFactor": 1.0, "specularColorFactor": [round(f0 / DEFAULT_F0, 4)] * 3}


def _shared_vertices(surface, texture):
    """The distinct vertices of a surface, texture coordinates in tiles, and the indices of its triangles."""
    scale = 1.0 / texture.tile if texture else 0.0
    index_of, indices = {}, []
    for triangle in surface.triangles:
        for corner in triangle:
            position, normal, uv = surface.vertices[corner]
            key = (_rounded(position), _rounded(normal), _rounded(value * scale for value in uv))
            indices.append(index_of.setdefault(key, len(index_of)))
    return list(index_of), indices


def _look_at(eye, target):
    """Unit quaternion x, y, z, w of a camera, which looks along its own -z with +y up."""
    back = normalized(subtract(eye, target))
    right = normalized(cross((0, 1, 0), back))
    up = cross(back, right)
    x, y, z = (back[k] for k in range(3))
    # Turn about y, then tilt about the camera's own x: both half angles from the matrix's elements.
    yaw, pitch = math.atan2(x, z), -math.asin(max(-1.0, min(1.0, y)))
    assert abs(up[1] - math.cos(pitch)) < 1e-9
    sy, cy, sp, cp = math.sin(yaw / 2), math.cos(yaw / 2), math.sin(pitch / 2), math.cos(pitch / 2)
    return (cy * sp, sy * cp, -sy * sp, cy * cp)


def _rounded(row):
    """Micrometres: coarser than what the mathematics library may differ by."""
    return tuple(round(value, 6) + 0.0 for value in row)


def _float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def _numbers(row):
    return [round(float(value), 7) + 0.0 for value in row]
