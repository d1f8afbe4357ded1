"""Generators of machine parts, cut by manifold3d: a gear with holes or arms, a bracket with two rows of holes."""

from __future__ import annotations

import math

import manifold3d
import numpy as np
from manifold3d import CrossSection, Manifold

from .parameters import Values, choice, real, switch, whole
from .solids import Part, block, of_manifold, prism

GEAR = [
    real("radius", 0.5, 1.2),
    real("thickness", 0.1, 0.5),
    whole("teeth", 5, 24),
    real("tooth_depth", 0.05, 0.25),
    real("tooth_width", 0.25, 0.75),
    real("bore", 0.05, 0.25),
    switch("hub"),
    real("hub_radius", 0.15, 0.5, lambda p: p["hub"]),
    real("hub_height", 0.05, 0.5, lambda p: p["hub"]),
    choice("web", "solid", "holes", "arms"),
    whole("n_holes", 3, 8, lambda p: p["web"] != "solid"),
    real("hole_size", 0.3, 0.9, lambda p: p["web"] != "solid"),
]


def gear(p: Values) -> list[Part]:
    radius, thickness, teeth = p["radius"], p["thickness"], p["teeth"]
    root = radius - p["tooth_depth"]
    outline = []
    for number in range(teeth):
        angle, half, gap = 2 * np.pi * number / teeth, np.pi / teeth * p["tooth_width"], np.pi / teeth
        corners = [(-half, root), (-0.7 * half, radius), (0.7 * half, radius), (half, root), (gap, root)]
        outline += [(far * np.cos(angle + turn), far * np.sin(angle + turn)) for turn, far in corners]
    disc = CrossSection([np.array(outline)])
    inner = max(p["bore"], p["hub_radius"] if p["hub"] else 0.0)
    if p["web"] != "solid" and root - inner > 0.05:
        disc = _web(disc, p, radius, root, inner)
    bore = CrossSection.circle(p["bore"], 16)
    parts = of_manifold(Manifold.extrude(disc - bore, thickness))
    if p["hub"] and p["hub_radius"] > p["bore"] + 0.01:
        ring = CrossSection.circle(p["hub_radius"], 24) - bore
        for vertices, faces in of_manifold(Manifold.extrude(ring, thickness / 2 + p["hub_height"])):
            parts.append((vertices + [0, 0, thickness / 2], faces))
    return parts


def _web(disc: CrossSection, p: Values, radius: float, root: float, inner: float) -> CrossSection:
    count, middle, gap = p["n_holes"], (inner + root) / 2, root - inner
    if p["web"] == "holes":
        size = min(gap / 2 * p["hole_size"], 0.95 * middle * math.sin(np.pi / count))
        for number in range(count):
            angle = 2 * np.pi * number / count
            disc -= CrossSection.circle(size, 16).translate((middle * np.cos(angle), middle * np.sin(angle)))
        return disc
    ring = CrossSection.circle(root - 0.08 * gap, 32) - CrossSection.circle(inner + 0.08 * gap, 32)
    arm = max((1 - p["hole_size"]) * 2 * np.pi * middle / count, 0.01)
    for number in range(count):
        bar = CrossSection.square((2 * radius, arm)).translate((0, -arm / 2))
        ring -= bar.rotate(360 * number / count)
    return disc - ring


BRACKET = [
    real("width", 0.5, 1.5),
    real("leg_a", 0.5, 2.0),
    real("leg_b", 0.5, 2.0),
    real("thick", 0.05, 0.2),
    whole("holes_a", 0, 4),
    whole("holes_b", 0, 4),
    real("hole_d", 0.08, 0.35, lambda p: p["holes_a"] + p["holes_b"] > 0),
    switch("slot", lambda p: p["holes_a"] + p["holes_b"] > 0),
    real("slot_len", 0.1, 0.5, lambda p: p["slot"]),
    switch("gusset"),
    real("gusset_size", 0.2, 0.9, lambda p: p["gusset"]),
    real("gusset_t", 0.05, 0.2, lambda p: p["gusset"]),
    real("lip", 0.0, 0.3),
]


def bracket(p: Values) -> list[Part]:
    width, first, second, thick = (p[row.name] for row in BRACKET[:4])
    flat = _plate(p, first, p["holes_a"])
    upright = _plate(p, second, p["holes_b"])
    parts: list[Part] = [(v[:, [0, 2, 1]], f[:, ::-1]) for v, f in flat]
    parts += [(v[:, [2, 0, 1]], f) for v, f in upright]
    if p["lip"] > 0.01:
        parts += block((first - thick, 0, 0), (first, p["lip"] + thick, width))
    if p["gusset"]:
        size, half = p["gusset_size"], p["gusset_t"] / 2
        corners = [(0, 0), (thick + size * (first - thick), 0), (0, thick + size * (second - thick))]
        parts += prism(corners, width / 2 - half, width / 2 + half)
    return parts


def _plate(p: Values, length: float, holes: int) -> list[Part]:
    """A plate (along the leg, across, thickness) with pairs of holes."""
    outline = CrossSection.square((length, p["width"]))
    for number in range(holes):
        x = p["thick"] + (number + 0.5) * (length - p["thick"]) / holes
        for z in (p["width"] / 4, 3 * p["width"] / 4):
            outline -= _hole(p).translate((x, z))
    return of_manifold(Manifold.extrude(outline, p["thick"]))


def _hole(p: Values) -> manifold3d.CrossSection:
    circle = CrossSection.circle(p["hole_d"] / 2, 12)
    if not p["slot"]:
        return circle
    half = p["slot_len"] / 2
    bar = CrossSection.square((p["hole_d"], 2 * half), True)
    return circle.translate((0, -half)) + circle.translate((0, half)) + bar
