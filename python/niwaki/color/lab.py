"""CIELAB as the coloring model computes it: white D65 and a gamma of 2.2.

The dissertation uses this plain power where sRGB has a straight foot. The difference is below 1 unit of lightness
except near black.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

GAMMA = 2.2
TO_XYZ = (
    (0.4124564, 0.3575761, 0.1804375),
    (0.2126729, 0.7151522, 0.0721750),
    (0.0193339, 0.1191920, 0.9503041),
)
WHITE = (0.95047, 1.0, 1.08883)
KNEE, SLOPE = 216.0 / 24389.0, 24389.0 / 27.0


def of_rgb(colors: ArrayLike) -> NDArray[np.float64]:
    """Convert colours in [0, 1] to CIELAB; (..., 3) to (..., 3) float64."""
    xyz = np.asarray(colors, dtype=np.float64) ** GAMMA @ np.array(TO_XYZ).T / np.array(WHITE)
    f = np.where(xyz > KNEE, np.cbrt(xyz), (SLOPE * xyz + 16.0) / 116.0)
    x, y, z = f[..., 0], f[..., 1], f[..., 2]
    return np.stack([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)], axis=-1)


def of_hex(text: str) -> tuple[float, float, float]:
    """Convert `#rrggbb` to CIELAB."""
    light, a, b = of_rgb(parts(text))
    return float(light), float(a), float(b)


def parts(text: str) -> tuple[float, float, float]:
    """Split `#rrggbb` into red, green and blue, in [0, 1]."""
    code = int(text.removeprefix("#"), 16)
    return (code >> 16) / 255.0, (code >> 8 & 255) / 255.0, (code & 255) / 255.0


def hexed(color: ArrayLike) -> str:
    """Write a colour in [0, 1] as `#rrggbb`, to the nearest byte."""
    r, g, b = (int(part) for part in np.floor(255.0 * np.clip(color, 0.0, 1.0) + 0.5))
    return f"#{r:02x}{g:02x}{b:02x}"
