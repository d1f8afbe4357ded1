"""Arched bridges over a gap: spans of masonry on piers, a deck, parapets and towers at the ends."""

from niwaki import box, choose, cylinder, emit, model, uniform

TITLE = "arched bridges over a gap"
TARGET = "viaduct"
VOXEL = 0.4
PARTICLES = 300

STONE, PALE, DARK, SLATE = (0.74, 0.68, 0.58), (0.84, 0.79, 0.70), (0.60, 0.55, 0.47), (0.32, 0.37, 0.45)


@model
def bridge(gap=24.0):
    """Build a bridge along x over a gap whose banks are at y = 0, in metres."""
    wide, rise, depth = uniform(2.0, 5.0), uniform(2.0, 7.0), uniform(2.0, 8.0)
    count = choose([1, 2, 3, 4, 5])
    pier = uniform(0.08, 0.3) * gap / count
    span = (gap + pier) / count
    form = choose(["round", "flat", "pointed"])
    crown = uniform(0.05, 0.25)
    for i in range(count):
        middle = -0.5 * (gap + pier) + (i + 0.5) * span
        emit(masonry(form, middle, span, pier, rise, depth, wide, crown), name="span")
    deck(gap + 2.0 * pier, wide, rise)


def masonry(form, middle, span, pier, rise, depth, wide, crown):
    """Return a block of stone with an opening below its crown."""
    solid = box(
        (middle, 0.5 * (rise - depth), 0.0), (span - 0.02, rise + depth, wide), bevel=0.0, color=STONE
    )
    radius, top = 0.5 * (span - pier), (1.0 - crown) * rise
    spring = top - {"round": 1.0, "flat": 0.45, "pointed": 1.2247}[form] * radius
    # The opening of a flat arch is a part of a large circle, that of a pointed arch the common part of two circles.
    wider, apart = {"round": (1.0, 0.0), "flat": (1.34, 0.0), "pointed": (1.25, 0.25)}[form]
    low = top - wider * radius if form == "flat" else spring
    left, right = [
        cylinder((middle + side * apart * radius, low, 0.0), wider * radius, wide + 1.0, axis="z", color=DARK)
        for side in (-1.0, 1.0)
    ]
    bottom = -depth - 1.0
    clear = box((middle, 0.5 * (top + bottom), 0.0), (2.0 * radius, top - bottom, wide + 2.0), color=DARK)
    if spring <= -depth:
        return solid - (left & right & clear)
    shaft = box(
        (middle, 0.5 * (spring + bottom), 0.0), (2.0 * radius, spring - bottom, wide + 1.0), color=DARK
    )
    return solid - ((left & right & clear) | shaft)


@model
def deck(length, wide, rise):
    """Lay the road, with a parapet on both sides."""
    thick = uniform(0.3, 0.9)
    emit(box((0.0, rise + 0.5 * thick + 0.01, 0.0), (length, thick, wide + 0.5), color=PALE), name="deck")
    parapet = choose(["wall", "posts", "none"])
    floor = rise + thick
    for z in (-0.5 * wide, 0.5 * wide):
        if parapet == "wall":
            emit(box((0.0, floor + 0.45, z), (length, 0.9, 0.3), color=STONE), name="parapet")
        elif parapet == "posts":
            rail = box((0.0, floor + 0.9, z), (length, 0.15, 0.25), color=PALE)
            at = [length * ((i + 0.5) / 16 - 0.5) for i in range(16)]
            emit(rail, [box((x, floor + 0.4, z), (0.25, 0.8, 0.25), color=PALE) for x in at], name="parapet")


MODEL = bridge
