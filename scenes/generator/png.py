"""Indexed-colour PNG images.

The pixel data are stored, not compressed: compressors differ from one zlib to the next, and the scenes are to be the
same bytes on every machine.
"""

import struct
import zlib


def indexed_png(width, height, palette, index_at):
    """A PNG of at most 256 colours.

    palette: (r, g, b) of 0..255, sRGB; index_at(x, y) is an index into it, row 0 on top.
    """
    rows = bytearray()
    for y in range(height):
        rows.append(0)  # filter: none
        rows.extend(index_at(x, y) for x in range(width))
    header = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)
    colours = b"".join(bytes(colour) for colour in palette)
    chunks = ((b"IHDR", header), (b"PLTE", colours), (b"IDAT", _stored_zlib(bytes(rows))), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(kind, data) for kind, data in chunks)


def _chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _stored_zlib(data):
    largest = 65535
    stream = bytearray(b"\x78\x01")
    for start in range(0, len(data), largest):
        block = data[start:start + largest]
        last = start + largest >= len(data)
        stream += struct.pack("<BHH", last, len(block), len(block) ^ 0xFFFF) + block
    return bytes(stream + struct.pack(">I", zlib.adler32(data)))
