#!/usr/bin/env python3
"""Writes the seeds of image_fuzzer, one small valid file of each kind, into corpus/image beside this script."""
import pathlib
import struct
import zlib

folder = pathlib.Path(__file__).parent / "corpus" / "image"
folder.mkdir(parents=True, exist_ok=True)


def radiance(width, height, pixels):
    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
    return header.encode() + pixels


def exr(width, height, compression):
    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value

    def channel(name):
        return name + b"\0" + struct.pack("<iIii", 2, 0, 1, 1)

    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<II", 20000630, 2)
    header += attribute("channels", "chlist", b"".join(map(channel, (b"B", b"G", b"R"))) + b"\0")
    header += attribute("compression", "compression", bytes([compression]))
    header += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
    header += attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    lines = 16 if compression == 3 else 1
    starts = range(0, height, lines)
    table, chunks = b"", b""
    for start in starts:
        raw = struct.pack("<f", 0.5) * (3 * width * min(lines, height - start))
        if compression == 1:  # runs of zeros stand for the predictor's differences
            raw = bytes([0, 63]) + bytes([127, 128] * ((len(raw) - 1) // 128) + [(len(raw) - 1) % 128 - 1, 128])
        elif compression >= 2:
            raw = zlib.compress(raw)
        table += struct.pack("<Q", len(header) + 8 * len(starts) + len(chunks))
        chunks += struct.pack("<iI", start, len(raw)) + raw
    return header + table + chunks


def png(width, height):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(bytes([y % 5]) + bytes(range(3 * width)) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


line = bytes([2, 2, 0, 8]) + b"".join(bytes([0x84, c, 4, c, c + 1, c + 2, c + 3]) for c in (90, 91, 92, 128))
files = {
    "flat.hdr": radiance(3, 2, bytes([128, 64, 32, 129] * 6)),
    "runs.hdr": radiance(8, 2, 2 * line),
    "none.exr": exr(3, 2, 0),
    "rle.exr": exr(64, 1, 1),
    "zips.exr": exr(8, 2, 2),
    "zip.exr": exr(8, 20, 3),
    "rgb.png": png(4, 5),
}
for name, content in files.items():
    (folder / name).write_bytes(content)
