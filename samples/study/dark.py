#!/usr/bin/python3
"""Makes a picture for pages in dark colours: lightness is inverted, hues stay, greys are a little lighter.
NAME_dark.png contains the checksum of its NAME.png, which tests/docs/check.py compares.

usage: dark.py NAME.png...

SPDX-License-Identifier: MIT
"""
import sys
import zlib

import numpy as np
from matplotlib.image import imread, imsave

from style import BadInput

BACKGROUND, INK = np.array([0x0d, 0x11, 0x17]) / 255.0, np.array([0xe6, 0xed, 0xf3]) / 255.0 # for white and black


def main(paths):
    for path in paths:
        if not path.endswith(".png"):
            raise BadInput(f"{path}: expected a PNG file")
        try:
            with open(path, "rb") as file:
                checksum = f"{zlib.crc32(file.read()):08x}"
            colours = imread(path)[:, :, :3]
        except (OSError, ValueError, SyntaxError) as error:
            raise BadInput(f"{path}: expected a PNG file, found: {error}") from None
        inverted = colours + 1.0 - colours.max(axis=2, keepdims=True) - colours.min(axis=2, keepdims=True)
        imsave(path[:-len(".png")] + "_dark.png", BACKGROUND + inverted**0.8 * (INK - BACKGROUND), dpi=160,
               metadata={"Software": None, "Light": checksum}, pil_kwargs={"optimize": True})


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    try:
        main(sys.argv[1:])
    except BadInput as problem:
        sys.exit(f"dark.py: {problem}")
