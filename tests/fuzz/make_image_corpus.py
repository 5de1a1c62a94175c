#!/usr/bin/env python3
"""Writes the seeds of image_fuzzer, one small valid file of each kind, into corpus/image beside this script."""
import itertools
import pathlib
import struct
import zlib

folder = pathlib.Path(__file__).parent / "corpus" / "image"
folder.mkdir(parents=True, exist_ok=True)


def radiance(resolution, pixels, lines="FORMAT=32-bit_rle_rgbe\n"):
    return f"#?RADIANCE\n{lines}\n{resolution}\n".encode() + pixels


def packed(raw, compression):
    if compression == 0:
        return raw
    halves = raw[0::2] + raw[1::2]
    differences = halves[:1] + bytes((b - a + 128) % 256 for a, b in zip(halves, halves[1:]))
    if compression >= 2:
        return zlib.compress(differences)
    runs = itertools.groupby(differences)
    counts = [(value, len(list(run))) for value, run in runs]
    return b"".join(bytes([min(128, n - i) - 1, value]) for value, n in counts for i in range(0, n, 128))


def exr(width, height, compression, channels=(b"B", b"G", b"R"), order=0, display=None, more=b"", tile=0):
    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value

    def step(name):  # chroma is stored for every second pixel of every second line
        return 2 if name in (b"RY", b"BY") else 1

    def channel(name):
        return name + b"\0" + struct.pack("<iIii", 2, 0, step(name), step(name))

    def rows(start, end):
        numbers = sum(width // step(name) for y in range(start, end) for name in channels if y % step(name) == 0)
        return b"\x3f\x3f\x3f\x3f" * numbers  # 0.747, whose bytes are one run

    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<II", 20000630, 0x202 if tile else 2)
    header += attribute("channels", "chlist", b"".join(map(channel, channels)) + b"\0")
    header += attribute("compression", "compression", bytes([compression]))
    header += attribute("dataWindow", "box2i", window)
    header += attribute("displayWindow", "box2i", struct.pack("<4i", *display) if display else window)
    header += attribute("lineOrder", "lineOrder", bytes([order]))
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + more
    if tile:
        header += attribute("tiles", "tiledesc", struct.pack("<IIB", tile, tile, 0))
    header += b"\0"
    lines = 16 if compression == 3 else 1
    starts = [0] if tile else range(0, height, lines)  # one tile holds all
    table, chunks = b"", b""
    for start in starts:
        data = packed(rows(start, height if tile else min(start + lines, height)), compression)
        table += struct.pack("<Q", len(header) + 8 * len(starts) + len(chunks))
        chunks += struct.pack("<4i", 0, 0, 0, 0) if tile else struct.pack("<i", start)
        chunks += struct.pack("<I", len(data)) + data
    return header + table + chunks


def png(width, height):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(bytes([y % 5]) + bytes(range(3 * width)) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


line = bytes([2, 2, 0, 8]) + b"".join(bytes([0x84, c, 4, c, c + 1, c + 2, c + 3]) for c in (90, 91, 92, 128))
flat = bytes([128, 64, 32, 129] * 6)
chromaticities = b"chromaticities\0chromaticities\0" + struct.pack("<I8f", 32, .708, .292, .17, .797, .131, .046, .3127, .329)
files = {
    "flat.hdr": radiance("-Y 2 +X 3", flat),
    "runs.hdr": radiance("-Y 2 +X 8", 2 * line),
    "old_runs.hdr": radiance("-Y 1 +X 6", flat[:4] + bytes([1, 1, 1, 5])),
    "turned.hdr": radiance("+X 3 -Y 2", flat, "EXPOSURE=2\nCOLORCORR=1 2 1\nPRIMARIES=.7 .3 .2 .8 .1 .1 .3 .3\nGAMMA=1\n"),
    "xyze.hdr": radiance("+Y 2 -X 3", flat, "FORMAT=32-bit_rle_xyze\n"),
    "none.exr": exr(3, 2, 0),
    "rle.exr": exr(64, 1, 1),
    "zips.exr": exr(8, 2, 2),
    "zip.exr": exr(8, 20, 3),
    "window.exr": exr(3, 2, 0, order=1, display=(-1, -1, 1, 4), more=chromaticities),
    "grey.exr": exr(3, 2, 0, channels=(b"A", b"Y")),
    "chroma.exr": exr(4, 2, 0, channels=(b"BY", b"RY", b"Y")),
    "layer.exr": exr(3, 2, 0, channels=(b"a.B", b"a.G", b"a.R")),
    "tiles.exr": exr(4, 4, 0, tile=4),
    "rgb.png": png(4, 5),
}
for name, content in files.items():
    (folder / name).write_bytes(content)
