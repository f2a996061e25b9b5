"""Ticks for other actuators than the device: a voice coil, rumble motors. SPDX-License-Identifier: MIT"""
from typing import Tuple

import numpy as np

from ._library import check, described, ffi, lib
from .ticks import Ticks


def coil(ticks: Ticks, sample_rate: float = 48000.0) -> Tuple[np.ndarray, np.ndarray]:
    """The forces of these ticks, for other actuators, as in knurl/audio.h. Returns a coil's samples, N, clipped at -1 and 1
    (KNURL_VOICE_COIL; each comes 4 ticks after its tick), and a row a tick for a gamepad's two rumble motors, 0 to 1
    (knurl_audio_get_rumble()). Needs the fields flags, normal and force."""
    rate = ticks._hz()
    flags, normal, force = (ticks._field(name) for name in ("flags", "normal", "force"))
    desc = described("knurl_audio_desc")
    desc.voice, desc.is_offline, desc.latency_s = lib.KNURL_VOICE_COIL, 1, 0.0
    desc.update_rate_hz, desc.sample_rate_hz = rate, sample_rate
    made = ffi.new("knurl_audio **")
    check(lib.knurl_audio_create(desc, made))
    audio = ffi.gc(made[0], lib.knurl_audio_destroy)
    edges = np.floor(np.arange(len(ticks) + 1) * sample_rate / rate).astype(int)
    samples, rumble = np.zeros(edges[-1], "f4"), np.zeros((len(ticks), 2))
    tick = ffi.new("knurl_tick_output *")
    for i in range(len(ticks)):
        tick.flags, tick.normal, tick.force = int(flags[i]), normal[i].tolist(), force[i].tolist()
        lib.knurl_audio_take(tick, audio)
        lib.knurl_audio_fill(audio, ffi.from_buffer("float[]", samples[edges[i]:edges[i + 1]]), int(edges[i + 1] - edges[i]))
        check(lib.knurl_audio_get_rumble(audio, ffi.from_buffer("double[]", rumble[i])))
    return samples, rumble
