"""Strokes a plate with ridges 1 mm apart at 0.1 m/s and looks for them in the force: 100 Hz. No device is needed.
SPDX-License-Identifier: MIT"""
import numpy as np

import knurl

RATE = 1000.0 # Hz
SPEED = 0.1   # m/s

scene = knurl.Scene()
plate = scene.add_plane(half_extents=(0.3, 0.05), name="plate",
                        material=knurl.Material(stiffness=400.0, spatial_frequency=(1000.0, 0.0), amplitude=2e-4))
# A table of hand positions needs no place of its own in the scene: device and scene have the same axes.
scene.configure_hip(update_rate_hz=RATE, resolution=0.0, workspace=((0, 0, 0), np.eye(3), 1.0))
scene.commit()

# Down onto the plate within 0.1 s, then along x for two seconds, 1 mm deep.
t = np.arange(2100) / RATE
positions = np.column_stack([np.maximum(0.0, t - 0.1) * SPEED - 0.1, np.zeros_like(t), np.maximum(-0.001, 0.001 - 0.02 * t)])
ticks = scene.tick(positions)

force = ticks["force"][100:, 2] # N, along the plate's normal
spectrum = np.abs(np.fft.rfft(force - force.mean()))
peak = np.fft.rfftfreq(len(force), 1.0 / RATE)[spectrum.argmax()]
print(f"{len(ticks)} ticks, mean {force.mean():.3f} N (K times 1 mm: 0.4), loudest at {peak:.1f} Hz (f v: 100)")
if abs(force.mean() - 0.4) > 0.01 or abs(peak - 100.0) > 1.0:
    raise SystemExit("the plate does not feel as it should")
