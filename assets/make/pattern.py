"""Pictures of gratings, by Eq. 11. SPDX-License-Identifier: MIT"""
import numpy as np


def checker(cycles, ridge, groove, size=32):
    """A tile of u, v in [0, 1): `ridge` if cos(2 pi cx u) cos(2 pi cy v) >= 0, otherwise `groove` (RGB, 0-255)."""
    middle = (np.arange(size) + 0.5) / size
    u, v = np.meshgrid(middle, middle)
    high = np.cos(2 * np.pi * cycles[0] * u) * np.cos(2 * np.pi * cycles[1] * v) >= 0
    return np.where(high[..., None], ridge, groove).astype(np.uint8)
