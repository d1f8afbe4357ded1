"""Arched bridges over a gap: spans of equal arches on piers, with parapets and gatehouses.
"""
from niwaki import arch, box, choose, cylinder, cone, emit, flip, model, uniform

TITLE = "arched bridges over a gap"
TARGET = "viaduct"
VOXEL = 0.4
PARTICLES = 300
STONE, PALE, DARK, SLATE = (0.74, 0.68, 0.58), (0.83, 0.78, 0.69), (0.62, 0.57, 0.49), (0.30, 0.36, 0.45)

@model
def bridge(gap=24.0):
    """Build a bridge along x over a gap, whose banks are at y = 0."""
    rise, wide = uniform(2.0, 6.0), uniform(2.0, 4.5)
    spans = choose([1, 2, 3, 4, 5])
    pier = uniform(0.06, 0.2) * gap / spans
    depth = uniform(3.0, 8.0)
    span = (gap + pier) / spans
    for i in range(spans):
        arch_of(-0.5 * gap - 0.5 * pier + span * (i + 0.5), span, pier, rise, depth, wide)
    deck = uniform(0.4, 1.0)
    emit(box((0.0, rise + 0.5 * deck, 0.0), (gap + 4.0, deck, wide + 0.6), color=PALE), name="deck")
    parapet = choose(["solid", "posts", "none"])

@model
def arch_of(x, span, pier, rise, depth, wide):
    emit(arch((x, 0.5 * (rise - depth), 0.0), (span + pier, rise + depth, wide), pier, color=STONE), name="span")

MODEL = bridge
