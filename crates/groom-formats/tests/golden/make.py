#!/usr/bin/env python3
"""Makes the small binary files beside it from the layouts as their makers state them, without groomkit.

Run it here and compare: `python3 make.py && git diff --stat .`
"""
import struct
from pathlib import Path

HERE = Path(__file__).parent
# Three strands; the middle one is empty in the formats that can say so.
STRANDS = [[(0, 0, 0), (0, 1, 0), (0.5, 2, 0)], [], [(1, 0, 0.25), (1, -1, 0.25)]]


def floats(*values):
    return struct.pack(f"<{len(values)}f", *values)


def data():
    """USC .data: i32 strands; i32 points, f32 x y z."""
    out = struct.pack("<i", len(STRANDS))
    for strand in STRANDS:
        out += struct.pack("<i", len(strand)) + b"".join(floats(*p) for p in strand)
    return out


def ct2hair():
    """CT2Hair .bin: as .data with x y z nx ny nz label."""
    out = struct.pack("<i", len(STRANDS))
    for number, strand in enumerate(STRANDS):
        out += struct.pack("<i", len(strand)) + b"".join(floats(*p, 0, -1, 0, number) for p in strand)
    return out


def monohair():
    """MonoHair .hair: u32 strands, u32 points, u16 points a strand, f32 x y z."""
    strands = [s for s in STRANDS if s]
    points = [p for s in strands for p in s]
    counts = struct.pack(f"<{len(strands)}H", *map(len, strands))
    return struct.pack("<2I", len(strands), len(points)) + counts + b"".join(floats(*p) for p in points)


TFX_POINTS = [[(s, v, 0.5 * v) for v in range(4)] for s in range(2)]


def tfx3():
    """TressFX 3: TressFXFileObject, 296 bytes, then vertices, thickness, texture coordinates, colours, guides."""
    vertices = b"".join(floats(*p) for s in TFX_POINTS for p in s)
    thickness, uvs = floats(0.5, 0.25), floats(0.125, 0.25, 0.5, 0.75)
    colors = b"".join(floats(1, v / 4, 0, 0.75) for _ in range(2) for v in range(4))
    guides, vertex_uvs = struct.pack("<2I", 0, 0), b"".join(floats(v / 8, 1) for v in range(8))
    arrays = [vertices, thickness, uvs, colors, guides, vertex_uvs]
    offsets, at = [], 296
    for array in arrays:
        offsets.append(at)
        at += len(array)
    head = floats(3.0) + struct.pack("<4I", 2, 4, 5, 1) + bytes(31 * 4)
    return head + struct.pack("<6I", *offsets) + bytes(32 * 4) + b"".join(arrays)


def tfx4():
    """TressFX 4: TressFXTFXFileHeader, 160 bytes, float4 positions, texture coordinates of strands."""
    positions = b"".join(floats(*p, 0 if i < 2 else 1) for s in TFX_POINTS for i, p in enumerate(s))
    uvs = floats(0.125, 0.25, 0.5, 0.75)
    head = floats(4.0) + struct.pack("<7I", 2, 4, 160, 160 + len(positions), 0, 0, 0) + bytes(32 * 4)
    return head + positions + uvs


# Positions and colours of the points of two strands, of three points and of one.
PLY_POINTS = [
    ((0, 0, 0), (255, 0, 51)),
    ((0, 1, 0), (255, 0, 51)),
    ((0.5, 2, 0), (0, 0, 0)),
    ((1, 0, 0.25), (0, 255, 0)),
]


def ply(kind, order=""):
    """hairutil's PLY with edges, as happly writes it, and a face behind it."""
    head = f"ply\nformat {kind} 1.0\ncomment made by hand\nelement vertex 4\n"
    for of, name in [("float", n) for n in "xyz"] + [("uchar", n) for n in ("red", "green", "blue")]:
        head += f"property {of} {name}\n"
    head += "property float thickness\nelement strand 2\nproperty ushort nsegs\n"
    head += "element edge 2\nproperty int vertex1\nproperty int vertex2\n"
    head += "element face 1\nproperty list uchar int vertex_indices\nproperty double area\nend_header\n"
    vertices = [(*p, *c, 0.25 * i) for i, (p, c) in enumerate(PLY_POINTS)]
    edges, face = [(0, 1), (1, 2)], (3, 0, 1, 2, 0.5)
    if order:
        body = b"".join(struct.pack(order + "3f3Bf", *v) for v in vertices) + struct.pack(order + "2H", 2, 0)
        body += b"".join(struct.pack(order + "2i", *e) for e in edges) + struct.pack(order + "B3id", *face)
        return head.encode() + body
    rows = vertices + [(2,), (0,)] + edges + [face]
    return (head + "".join(" ".join(map(str, row)) + "\n" for row in rows)).encode()


def bare():
    """trimesh's PointCloud.export, as Neural Haircut and HAAR use it: positions and colours of 2 x 3 points."""
    head = "ply\nformat binary_little_endian 1.0\ncomment https://github.com/mikedh/trimesh\nelement vertex 6\n"
    head += "".join(f"property float {n}\n" for n in "xyz")
    head += "".join(f"property uchar {n}\n" for n in ("red", "green", "blue", "alpha")) + "end_header\n"
    return head.encode() + b"".join(struct.pack("<3f4B", i, 2 * i, 0, 255, 0, 0, 255) for i in range(6))


def edges():
    """Two strands told by their edges alone, the second before the first."""
    return b"""ply
format ascii 1.0
element vertex 5
property double x
property double y
property double z
property float quality
element edge 3
property int vertex1
property int vertex2
end_header
0 0 0 0.5
0 1 0 0.25
0 2 0 0.125
1 0 0 1
1 1 0 2
3 4
0 1
1 2
"""


FILES = {
    "ascii.ply": lambda: ply("ascii"),
    "little.ply": lambda: ply("binary_little_endian", "<"),
    "big.ply": lambda: ply("binary_big_endian", ">"),
    "bare.ply": bare,
    "edges.ply": edges,
    "lock.data": data,
    "lock.bin": ct2hair,
    "monohair.hair": monohair,
    "v3.tfx": tfx3,
    "v4.tfx": tfx4,
}

for name, make in FILES.items():
    (HERE / name).write_bytes(make())
