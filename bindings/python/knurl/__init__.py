"""Knurl: haptic gratings on force-feedback devices. Scenes of surfaces, ticks in batches as numpy arrays, devices.

SI units, right-handed axes. The library's own headers say more of every quantity: `knurl.lib` and `knurl.ffi` are all of
it, by cffi. SPDX-License-Identifier: MIT"""
from . import metrics
from ._library import KnurlError, arrays_of, check, ffi, lib, version
from .actuators import coil
from .callbacks import Sample, Torque
from .device import Device, Event, Listing, devices
from .effects import Effect
from .loop import Loop
from .methods import add_method
from .scene import Material, Scene, Surface
from .signals import Grating, Velocity
from .tagging import Tagged, tag, tags, untag
from .ticks import Ticks, Verdict, as_ticks

__all__ = ["Device", "Effect", "Event", "Grating", "KnurlError", "Listing", "Loop", "Material", "Sample", "Scene", "Surface",
           "Tagged", "Ticks", "Torque", "Velocity", "Verdict", "add_method", "arrays_of", "as_ticks", "check", "coil",
           "devices", "ffi", "lib", "metrics", "tag", "tags", "untag", "version"]
__version__ = version()
