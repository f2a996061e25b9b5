"""Effects: forces of a HIP without a surface. SPDX-License-Identifier: MIT"""
from dataclasses import dataclass
from typing import Any, Sequence, Tuple

import numpy as np

from ._library import check, lib

KINDS = {name: getattr(lib, f"KNURL_EFFECT_{name.upper()}")
         for name in ("spring", "detent", "damper", "line", "plane", "force")}


def _vector(values: Sequence[float], what: str) -> Any:
    array = np.asarray(values, dtype=float)
    if array.shape != (3,):
        raise ValueError(f"{what}: expected 3 numbers, found an array of shape {array.shape}")
    return array.tolist()


@dataclass
class Effect:
    """A spring, notches or a guide: knurl_effect in knurl/effect.h, with the formulas. kind: "spring", "detent",
    "damper", "line", "plane" or "force". Scene axes, m, N/m, N s/m, N."""

    kind: str = "spring"
    anchor: Tuple[float, float, float] = (0.0, 0.0, 0.0)
    axis: Tuple[float, float, float] = (0.0, 1.0, 0.0)
    stiffness: float = 200.0
    damping: float = 1.0
    spacing: float = 0.01
    max_force: float = 2.0

    def _fill(self, effect: Any) -> None:
        if self.kind not in KINDS:
            raise ValueError(f"kind: expected one of {', '.join(KINDS)}, found {self.kind!r}")
        check(lib.knurl_effect_prepare(KINDS[self.kind], effect))
        effect.anchor, effect.axis = _vector(self.anchor, "anchor"), _vector(self.axis, "axis")
        for name in ("stiffness", "damping", "spacing", "max_force"):
            setattr(effect, name, getattr(self, name))
