#!/usr/bin/env python3
"""Joins Mach-O files for different processors into one universal file, as Apple's lipo does.

usage: universal.py OUT FILE...
"""
import struct
import sys

FAT_MAGIC, MACH_MAGIC_64 = 0xCAFEBABE, 0xFEEDFACF
ALIGN = 14  # 2^14 = 16,384 bytes: a page on arm64


def universal(slices):
    """The bytes of a universal file; ValueError if a slice is not a 64-bit Mach-O file, or two are for the same
    processor."""
    entries, body, seen = [], b"", set()
    offset = 8 + 20 * len(slices)
    for data in slices:
        magic, cpu, subtype = struct.unpack_from("<III", data.ljust(12, b"\0"))
        if magic != MACH_MAGIC_64:
            raise ValueError("expected a 64-bit Mach-O file, found another kind of file")
        if cpu in seen:
            raise ValueError("expected a file for each processor, found two for the same")
        seen.add(cpu)
        padding = -offset % (1 << ALIGN)
        offset += padding
        entries.append(struct.pack(">IIIII", cpu, subtype, offset, len(data), ALIGN))
        body += bytes(padding) + data
        offset += len(data)
    return struct.pack(">II", FAT_MAGIC, len(slices)) + b"".join(entries) + body


def main(out, *files):
    slices = []
    for name in files:
        with open(name, "rb") as file:
            slices.append(file.read())
    try:
        joined = universal(slices)
    except ValueError as error:
        sys.exit(f"universal: {', '.join(files)}: {error}")
    with open(out, "wb") as file:
        file.write(joined)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__.strip().rsplit("\n", 1)[-1])
    main(*sys.argv[1:])
