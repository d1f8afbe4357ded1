"""Hulls to fill with ships: nose towards +z, mirror-symmetric in x."""

from __future__ import annotations

from niwaki.targets.examples.lofts import loft, rectangle, ring, section, solid
from niwaki.targets.target import Target


def ship() -> Target:
    """Make a ship's hull about 18 wide, 3 high and 15 long; nose towards +z.

    A fuselage that narrows to a blunt nose and to the tail, a low slab on its back, two-part wings that sweep
    back and droop a little, and long six-sided engine pods at their ends.
    """
    # Fuselage: rectangles across z as (z, half width, lowest y, highest y).
    hull = [(-5.2, 1.0, -0.65, 0.75), (-4.4, 1.5, -0.95, 1.05), (1.6, 1.5, -1.0, 1.1), (3.6, 1.1, -0.8, 0.75)]
    hull.append((5.4, 0.45, -0.45, 0.15))
    fuselage = loft([rectangle(w, low, high, z) for z, w, low, high in hull])
    slab = loft(
        [
            rectangle(w, 0.9, high, z)
            for z, w, high in [(-4.0, 0.75, 1.45), (-0.2, 0.75, 1.75), (0.9, 0.5, 1.3)]
        ]
    )
    parts = [fuselage, slab]
    for side in (1.0, -1.0):
        # Wings: sections across x as (x, front z, back z, middle y, half thickness).
        wing = [(1.2, 0.6, -3.4, 0.0, 0.45), (4.2, -1.0, -4.6, 0.05, 0.38), (8.0, -4.2, -7.0, -0.15, 0.30)]
        parts.append(loft([section(side * x, z0, z1, y, t) for x, z0, z1, y, t in wing]))
        pod = [(-9.6, 0.45), (-9.0, 0.8), (-3.4, 0.8), (-2.0, 0.35)]
        parts.append(loft([ring((side * 8.2, -0.15, z), (0, 0, 1), r, r, 6) for z, r in pod]))
    return solid("ship", parts)


def dart() -> Target:
    """Make an arrow about 11 wide and 13 long: a slender body, and swept wings at its tail."""
    body = [(-6.2, 0.9, -0.5, 0.5), (-5.0, 1.15, -0.6, 0.7), (2.5, 1.0, -0.55, 0.6), (6.6, 0.5, -0.35, 0.3)]
    parts = [loft([rectangle(half, low, high, z) for z, half, low, high in body])]
    for side in (1.0, -1.0):
        wing = [(0.9, 0.5, -4.6, 0.0, 0.22), (3.2, -1.6, -5.2, 0.0, 0.2), (5.6, -4.2, -6.2, 0.0, 0.16)]
        parts.append(loft([section(side * x, front, back, y, half) for x, front, back, y, half in wing]))
    return solid("dart", parts)
