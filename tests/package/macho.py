"""Mach-O files: their slices, and whether a slice's ad-hoc signature fits its bytes, without which macOS on arm64 starts nothing.
SPDX-License-Identifier: MIT"""
import hashlib
import struct

FAT_MAGIC, MACH_MAGIC_64 = 0xCAFEBABE, 0xFEEDFACF
CPUS = {0x01000007: "x86_64", 0x0100000C: "arm64"}
LC_CODE_SIGNATURE = 0x1D
SUPER_BLOB, CODE_DIRECTORY = 0xFADE0CC0, 0xFADE0C02
AD_HOC, SHA256 = 2, 2


def slices(data):
    """The processors of a file and their bytes; empty if it is no Mach-O file."""
    if data[:4] == struct.pack("<I", MACH_MAGIC_64):
        return {CPUS[struct.unpack_from("<I", data, 4)[0]]: data}
    if data[:4] != struct.pack(">I", FAT_MAGIC):
        return {}
    found = {}
    for i in range(struct.unpack_from(">I", data, 4)[0]):
        cpu, _, offset, size, _ = struct.unpack_from(">IIIII", data, 8 + 20 * i)
        found[CPUS[cpu]] = data[offset:offset + size]
    return found


def fault_of_signature(data):
    """Why a slice's signature is not valid, or None."""
    at, where = 32, None
    for _ in range(struct.unpack_from("<I", data, 16)[0]):
        command, size = struct.unpack_from("<II", data, at)
        if command == LC_CODE_SIGNATURE:
            where = struct.unpack_from("<I", data, at + 8)[0]
        at += size
    if where is None:
        return "it is not signed"
    magic, _, count = struct.unpack_from(">III", data, where)
    if magic != SUPER_BLOB:
        return f"expected a signature at {where:#x}, found {magic:#x}"
    for i in range(count):
        begin = where + struct.unpack_from(">I", data, where + 16 + 8 * i)[0]
        (magic, _, _, flags, hashes, _, _, pages, limit, size, kind, _,
         shift) = struct.unpack_from(">9I4B", data, begin)
        if magic != CODE_DIRECTORY:
            continue
        if not flags & AD_HOC or kind != SHA256 or limit != where:
            return f"expected an ad-hoc signature of {where} bytes by SHA-256, found flags {flags:#x}, kind {kind}, {limit} bytes"
        for page in range(pages):
            code = data[page << shift:min((page + 1) << shift, limit)]
            told = data[begin + hashes + size * page:begin + hashes + size * (page + 1)]
            if hashlib.sha256(code).digest() != told:
                return f"page {page} does not have the hash that was signed"
        return None if pages << shift >= limit else "it does not cover the file"
    return "it has no list of hashes"
