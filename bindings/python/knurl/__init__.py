"""Knurl: haptic gratings on force-feedback devices. Scenes of surfaces, ticks in batches as numpy arrays, devices.

SI units, right-handed axes. The library's own headers say more of every quantity: `knurl.lib` and `knurl.ffi` are all of
it, by cffi. SPDX-License-Identifier: MIT"""
from . import metrics
from ._library import KnurlError, arrays_of, check, ffi, lib, version
from .device import Device, Loop
from .scene import Material, Scene, Surface

__all__ = ["Device", "KnurlError", "Loop", "Material", "Scene", "Surface", "arrays_of", "check", "ffi", "lib", "metrics",
           "version"]
__version__ = version()
