"""What of an EXR file must be the same in two renders of one frame: its pixels and its digest, not its seconds.

Pixels are compared as the packed blocks of the file: the same program packs the same pixels into the same bytes.
Layout: https://openexr.com/en/latest/OpenEXRFileLayout.html
"""

import struct
from pathlib import Path


def bits(path: Path) -> tuple[str, list[bytes]]:
    """The frame's digest and its packed blocks, in the order of its table. Raises ValueError for part of a file."""
    data = path.read_bytes()
    if data[:4] != b"\x76\x2f\x31\x01":
        raise ValueError(f"{path}: not an EXR file")
    multi_part = bool(struct.unpack_from("<I", data, 4)[0] & 0x1000)
    at, digest = 8, ""
    while True:
        attributes, at = header(data, at)
        digest = attributes.get(b"digest", b"").decode() or digest
        # A file of several parts ends its headers with an empty one.
        if not multi_part or data[at] == 0:
            at += 1 if multi_part else 0
            break
    first = struct.unpack_from("<Q", data, at)[0]
    if first == 0 or (first - at) % 8 or first > len(data):
        raise ValueError(f"{path}: its table of blocks is not whole")
    offsets = struct.unpack_from(f"<{(first - at) // 8}Q", data, at)
    ends = dict(zip(sorted(offsets), [*sorted(offsets)[1:], len(data)]))
    if max(offsets) >= len(data):
        raise ValueError(f"{path}: it is cut short")
    return digest, [data[offset:ends[offset]] for offset in offsets]


def header(data: bytes, at: int) -> tuple[dict[bytes, bytes], int]:
    """The attributes from `at` on, and where they end."""
    attributes = {}
    while data[at] != 0:
        name_end = data.index(b"\0", at)
        type_end = data.index(b"\0", name_end + 1)
        size = struct.unpack_from("<i", data, type_end + 1)[0]
        start = type_end + 5
        attributes[data[at:name_end]] = data[start:start + size]
        at = start + size
    return attributes, at + 1


def differing(wanted: Path, found: Path) -> list[str]:
    """One line for every frame below `wanted` that is not there below `found` with the same bits."""
    frames = sorted(path.relative_to(wanted) for path in wanted.rglob("*.exr") if not path.name.startswith("."))
    lines = [] if frames else [f"no frames below {wanted}"]
    for frame in frames:
        if not (found / frame).is_file():
            lines.append(f"{frame}: not there")
        elif bits(wanted / frame) != bits(found / frame):
            lines.append(f"{frame}: other bits")
    return lines
