"""glTF and GLB for tests of the tools, and what stands in them."""

import json
import struct

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
FACES = [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4),
         (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6), (3, 0, 4), (3, 4, 7)]
TYPES = {"b": 5120, "B": 5121, "h": 5122, "H": 5123, "I": 5125, "f": 5126}


class Gltf:
    """A cube that nodes show; further accessors and attributes."""

    def __init__(self, nodes=({"mesh": 0},), corners="f", **members):
        self.data = b""
        self.root = {"asset": {"version": "2.0"}, "scene": 0,
                     "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": list(nodes),
                     "accessors": [], "bufferViews": [], **members}
        self.attributes = {"POSITION": self.add(CORNERS, corners)}
        indices = self.add([(i,) for face in FACES for i in face], "H")
        self.root["meshes"] = [{"primitives": [{"attributes": self.attributes,
                                                "indices": indices}]}]

    def add(self, rows, letter, **members):
        """An accessor; rows start at multiples of four bytes."""
        size = struct.calcsize(letter) * len(rows[0])
        stride = (size + 3) // 4 * 4 if len(rows[0]) > 1 else size
        bytes_ = b"".join(struct.pack(f"<{len(row)}{letter}", *row).ljust(stride, b"\0")
                          for row in rows)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(bytes_)}
        if stride != size:
            view["byteStride"] = stride
        self.data += bytes_ + b"\0" * (-len(bytes_) % 4)
        self.root["bufferViews"].append(view)
        self.root["accessors"].append({
            "bufferView": len(self.root["bufferViews"]) - 1, "componentType": TYPES[letter],
            "count": len(rows), "type": "SCALAR" if len(rows[0]) == 1 else f"VEC{len(rows[0])}",
            **members})
        if rows is CORNERS:
            self.root["accessors"][-1].update(min=[0, 0, 0], max=[1, 1, 1])
        return len(self.root["accessors"]) - 1

    def text(self, uri=None):
        self.root["buffers"] = [{"byteLength": len(self.data), **({"uri": uri} if uri else {})}]
        return json.dumps(self.root)

    def glb(self):
        text = self.text().encode()
        text += b" " * (-len(text) % 4)
        return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(self.data)) +
                struct.pack("<I4s", len(text), b"JSON") + text +
                struct.pack("<I4s", len(self.data), b"BIN\0") + self.data)


def json_of_glb(data):
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


def volume_of_stl(data):
    """Of a binary STL."""
    six = 0.0
    for i in range(struct.unpack_from("<I", data, 80)[0]):
        a, b, c, d, e, f, g, h, k = struct.unpack_from("<9f", data, 96 + 50 * i)
        six += a * (e * k - f * h) + b * (f * g - d * k) + c * (d * h - e * g)
    return six / 6
