#!/usr/bin/python3
"""A plain `cmake -S . -B build`: a release build, which lists omitted parts; and an option that is switched off later
counts.
usage: plain.py SOURCE FOLDER C_COMPILER CXX_COMPILER
SPDX-License-Identifier: MIT"""
import json
import os
import shutil
import subprocess
import sys

SOURCE, FOLDER, CC, CXX = sys.argv[1:]
OFF = {"falcon": ("KNURL_FALCON", "KNURL_HAVE_LIBUSB"), "rawhid": ("KNURL_RAWHID", "KNURL_HAVE_HIDAPI"),
       "inverse3": ("KNURL_INVERSE3", "KNURL_HAVE_INVERSE3")}


def configure(*options):
    done = subprocess.run(["cmake", "-S", SOURCE, "-B", FOLDER, "-G", "Ninja", f"-DCMAKE_C_COMPILER={CC}",
                           f"-DCMAKE_CXX_COMPILER={CXX}", "-DKNURL_GODOT=OFF", "-DKNURL_UNITY=OFF", *options],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        sys.exit(f"plain: exit {done.returncode}\n{done.stdout[-4000:]}")
    with open(os.path.join(FOLDER, "compile_commands.json"), encoding="utf-8") as file:
        commands = [entry["command"] for entry in json.load(file)]
    return done.stdout, next(command for command in commands if "/loop_tick.c" in command)


def expect(what, good):
    if not good:
        sys.exit(f"plain: expected {what}")
    print(f"plain: {what}")


shutil.rmtree(FOLDER, ignore_errors=True)
said, command = configure("-DCMAKE_DISABLE_FIND_PACKAGE_cmocka=ON")
expect("Release, said so, if no build type is given", "CMAKE_BUILD_TYPE: Release" in said and " -O3 " in command)
expect("the tests left out, said so, without cmocka", "The tests are left out: they need cmocka" in said)
built = [name for name in OFF if OFF[name][1] in command]
expect("a sentence for each driver", all(f"-- {name}" in said for name in OFF))
said, command = configure(*(f"-D{option}=OFF" for option, _ in OFF.values()))
expect(f"none of {', '.join(built) or 'the drivers'} after their options were switched off",
       not any(definition in command for _, definition in OFF.values()) and
       all(f"{name} is left out: {option} is off" in said for name, (option, _) in OFF.items()))
