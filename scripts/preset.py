"""Prints the arguments of `cmake --preset NAME`, one per line: CMake before 3.21 cannot read CMakePresets.json.
usage: preset.py NAME"""
import json
import os
import sys

NAME = sys.argv[1]
with open("CMakePresets.json", encoding="utf-8") as file:
    PRESETS = {preset["name"]: preset for preset in json.load(file)["configurePresets"]}


def collect(name):
    """A preset with its inherited settings."""
    preset = PRESETS[name]
    parent = collect(preset["inherits"]) if "inherits" in preset else {}
    return {**parent, **preset, "cacheVariables": {**parent.get("cacheVariables", {}), **preset.get("cacheVariables", {})}}


preset = collect(NAME)
variables = dict(preset["cacheVariables"])
if "toolchainFile" in preset:
    variables["CMAKE_TOOLCHAIN_FILE"] = preset["toolchainFile"]
options = ["-S.", f"-B{preset['binaryDir']}", f"-G{preset['generator']}", *(f"-D{key}={variables[key]}" for key in variables)]
for option in options:
    print(option.replace("${sourceDir}", os.getcwd()).replace("${presetName}", NAME))
