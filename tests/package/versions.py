#!/usr/bin/python3
"""Runs programs of one version with the library of another: today's, and one that is still to come, whose structs have
grown and which has one more function. Existing uses still work; features missing in an older library are refused with a
message.
usage: versions.py SOURCE BUILD FOLDER C_COMPILER C_FLAGS     BUILD: beside it today's library is built (see installed.py);
FOLDER is kept for the next time.
SPDX-License-Identifier: MIT"""
import os
import re
import shutil
import subprocess
import sys

SOURCE, BUILD, FOLDER, CC, C_FLAGS = sys.argv[1:]
CLIENT = os.path.join(SOURCE, "tests/package/versions/client.c")


def run(*command, env=None):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env={**os.environ, **(env or {})})
    return done.returncode, done.stdout.strip()


def need(*command):
    code, output = run(*command)
    if code != 0:
        sys.exit(f"versions: {' '.join(command)}: exit {code}\n{output[-4000:]}")


def check(what, good, found):
    print(f"versions: {'ok  ' if good else 'FAIL'} {what}: {found}")
    if not good:
        sys.exit(1)


def edit(path, *pairs):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for pattern, replacement in pairs:
        text, times = re.subn(pattern, replacement, text)
        if times == 0:
            sys.exit(f"versions: {path}: expected {pattern}")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def make_later(folder):
    """The sources of a version to come: every struct with struct_size is longer, reserved words are used."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    for name in ("CMakeLists.txt", "sdk"):
        path = os.path.join(SOURCE, name)
        (shutil.copytree if os.path.isdir(path) else shutil.copy)(path, os.path.join(folder, name))
    edit(os.path.join(folder, "CMakeLists.txt"), (r"add_subdirectory\((?!sdk\))[^)]*\)", ""))
    headers = os.path.join(folder, "sdk/include/knurl")
    growing = r"(typedef struct (knurl_\w+) \{\n    uint32_t struct_size;(?:(?!\n\}).)*)\n\} \2;"
    for name in ("scene.h", "hip.h", "query.h", "loop.h", "device.h", "device_functions.h", "fake.h", "stroke.h",
                 "contact.h", "gltf.h", "audio.h"):
        edit(os.path.join(headers, name), ("(?s)" + growing, r"\1\n    double later;\n} \2;"))
    edit(os.path.join(headers, "hip.h"),
         (r"uint32_t reserved\[9\];(?=[^}]*\} knurl_tick_input;)", "uint32_t later; uint32_t reserved[8];"),
         (r"uint64_t reserved\[6\];(?=[^}]*\} knurl_tick_output;)", "uint64_t later; uint64_t reserved[5];"))
    edit(os.path.join(headers, "base.h"), (r"(VERSION_PATCH) \d+", r"\1 99"),
         (r"(KNURL_API uint32_t knurl_version_number\(void\);)", r"\1 KNURL_API uint32_t knurl_later(void);"))
    edit(os.path.join(folder, "sdk/src/base/error.c"), (r"\Z", "uint32_t knurl_later(void) { return 1; }\n"))
    edit(os.path.join(folder, "sdk/src/scene/tick.c"), (r"memset\(out->reserved,", r"out->later = 0; \g<0>"),
         (r"(?s)static (?:inline )?int is_reserved_zero.*?\n\}\n", "static int is_reserved_zero(const knurl_tick_input *input) {"
                                                       " return input->reserved[0] == 0; }\n"))


def build(source, folder, flags, *options):
    """Builds a version's shared library; returns the folders of its headers and of its library."""
    need("cmake", "-G", "Ninja", "-S", source, "-B", folder, f"-DCMAKE_C_COMPILER={CC}", "-DCMAKE_BUILD_TYPE=Release",
         f"-DCMAKE_C_FLAGS_RELEASE={flags}", "-DBUILD_SHARED_LIBS=ON", "-DBUILD_TESTING=OFF", "-DKNURL_GLTF=OFF",
         "-DKNURL_GODOT=OFF", "-DKNURL_UNITY=OFF", "-DKNURL_INSTALL=OFF", *options)
    need("cmake", "--build", folder, "--target", "knurl")
    return os.path.join(source, "sdk/include"), os.path.join(folder, "sdk")


def compile_client(version, name, *options):
    program = os.path.join(FOLDER, name)
    need(CC, CLIENT, "-o", program, "-I", version[0], "-L", version[1], "-lknurl", *options)
    return program


def main():
    os.makedirs(FOLDER, exist_ok=True)
    make_later(os.path.join(FOLDER, "later.source"))
    today = build(SOURCE, f"{BUILD}-today", C_FLAGS,
                  f"-DKNURL_WARNINGS_AS_ERRORS={os.environ['KNURL_WARNINGS_AS_ERRORS']}")  # ccache has its objects then
    later = build(os.path.join(FOLDER, "later.source"), os.path.join(FOLDER, "later"), "-O1")
    client = compile_client(today, "client_of_today")
    newer = compile_client(later, "client_to_come", "-DLATER")
    newest = compile_client(later, "client_with_function", "-DLATER", "-DLATER_FUNCTION")

    def press(program, version, *arguments):
        return run(program, *arguments, env={"LD_LIBRARY_PATH": version[1]})

    for program in (client, newer):
        for version in (today, later):
            code, said = press(program, version)
            check(f"{os.path.basename(program)} with {os.path.basename(os.path.dirname(version[1]))}'s library",
                  code == 0 and said == "0.400000 N,", said)
    for what, sentence in (("material", " is set, but Knurl "), ("input", "input.reserved: ")):
        code, said = press(newer, later, what)
        check(f"a later {what} with the later library", code == 0, said)
        code, said = press(newer, today, what)
        check(f"a later {what} with today's library", code == 1 and sentence in said, said)
    code, said = press(newest, later)
    check("a later function with the later library", code == 0, said.replace("\n", " "))
    code, said = press(newest, today)
    check("a later function with today's library", code == 127 and "undefined symbol: knurl_later" in said, said)

    other = os.path.join(FOLDER, "other") # before 1.0, each minor version's library has a name of its own
    os.makedirs(other, exist_ok=True)
    need(CC, "-shared", "-Wl,-soname,libknurl.so.0.2", "-o", os.path.join(other, "libknurl.so"), "-x", "c", "/dev/null")
    program = compile_client((today[0], other), "client_of_0.2", "-Wl,--no-as-needed", "-lknurl",
                             "-Wl,--unresolved-symbols=ignore-all")
    code, said = press(program, today)
    check("a program of 0.2 with today's library", code == 127 and "libknurl.so.0.2" in said, said)


main()
