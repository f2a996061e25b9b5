#!/usr/bin/python3
"""Checks that the binaries have the hardening that CMakeLists.txt requests.
usage: hardening.py PROGRAM_OR_LIBRARY... --readers OBJECT...
PROGRAM_OR_LIBRARY: linked; OBJECT: of the libraries; those that parse untrusted input are checked."""
import re
import subprocess
import sys

# Their functions have buffers on the stack, and write into them with functions that FORTIFY knows. The last is most of
# knurl_gltf, which is compiled as one file (sdk/CMakeLists.txt).
READERS = ["src/device/driver.c.o", "src/device/rawhid/geometry.c.o", "src/device/touch/hd_load.c.o",
           "Unity/unity_0_cxx.cxx.o"]


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True, env={"LC_ALL": "C", "PATH": "/usr/bin"}).stdout


def faults_of_linked(path):
    headers = output("readelf", "--wide", "--file-header", "--program-headers", "--dynamic", path)
    if not re.search(r"^  Type:\s+DYN", headers, re.M):
        yield "expected a load address that can be random (PIE)"
    if "GNU_RELRO" not in headers or not re.search(r"BIND_NOW|Flags:.*NOW", headers):
        yield "expected tables of functions that are read-only after the start (relro, now)"
    if not re.search(r"GNU_STACK.* RW ", headers):
        yield "expected a stack that is not executable"
    if re.search(r"LOAD.* RWE ", headers):
        yield "found memory that can be written and executed"
    if re.search(r"TEXTREL", headers):
        yield "found code that is changed when it is loaded"
    storage = re.search(r"^  TLS(?: +0x[0-9a-f]+){4} +0x([0-9a-f]+) ", headers, re.M)
    if "STATIC_TLS" in headers and int(storage.group(1), 16) > 64:
        yield f"expected 64 bytes of thread-local variables at most, found {int(storage.group(1), 16)}: too many do not load"
    if re.search(r"R(UN)?PATH\).*\[(?!\$ORIGIN\])", headers):
        yield "found folders to look for libraries in, other than where it lies itself ($ORIGIN)"


def faults_of_reader(path):
    wanted = output("nm", "--undefined-only", path)
    if "__stack_chk_fail" not in wanted:
        yield "expected guards in stack frames (-fstack-protector-strong)"
    if not re.search(r"__\w+_chk\b", wanted):
        yield "expected checked sizes of buffers (_FORTIFY_SOURCE)"
    if "endbr64" not in output("objdump", "--disassemble", path):
        yield "expected marked targets of jumps (-fcf-protection)"


def main():
    at = sys.argv.index("--readers")
    linked, objects = sys.argv[1:at], [path for argument in sys.argv[at + 1:] for path in argument.split(";")]
    readers = [path for path in objects if path.endswith(tuple(READERS))]
    faults = [f"{path}: {fault}" for path in linked for fault in faults_of_linked(path)]
    faults += [f"{path}: {fault}" for path in readers for fault in faults_of_reader(path)]
    if len(readers) != len(READERS):
        faults.append(f"expected the objects {READERS}, found {readers}")
    print("\n".join(faults) or f"{len(linked)} linked files and {len(readers)} objects are as hardened as asked for")
    return 1 if faults else 0


sys.exit(main())
