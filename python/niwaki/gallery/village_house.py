"""Village houses: a house with a steep roof, perhaps with wings, a dormer, a porch and a chimney.

Words name the roof. Windows and doors are holes in the walls.
"""

from niwaki import box, choose, emit, flip, future, model, uniform, wedge, rotation
from math import pi
TITLE = "village houses"
TARGET = "farmstead"
VOXEL = 0.3
PARTICLES = 300
PLASTER, TIMBER, TILE, THATCH, GLASS, BRICK = (0.93, 0.89, 0.80), (0.38, 0.26, 0.17), (0.66, 0.30, 0.21), (0.71, 0.58, 0.36), (0.45, 0.60, 0.70), (0.60, 0.36, 0.28)

@model
def village_house():
    """Build a house whose front looks to +z, in metres."""
    width, depth, height = uniform(5.0, 12.0), uniform(4.0, 8.0), uniform(2.4, 6.0)
    cover = choose([TILE, THATCH])
    body(0.0, 0.0, width, depth, height, cover)
    for side in (-1, 1):
        future(wing, side, width, depth, height, cover)
    has_chimney = flip(0.7)
    if has_chimney:
        x = uniform(-0.4, 0.4) * width
        emit(box((x, height + 0.4 * depth, 0.0), (0.8, 0.8 * depth, 0.8), color=BRICK), name="chimney")

@model
def body(x, z, width, depth, height, cover):
    """Build walls and a roof."""
    storeys = max(1, round(height / 2.7))
    emit(box((x, 0.5 * height, z), (width, height, depth), color=PLASTER), name="walls")
    roof = choose(["gable", "hip", "half-hip", "flat"])
    pitch = uniform(0.35, 0.75) * depth
    across = (depth + 0.9, pitch, width + 0.7)
    if roof == "gable":
        emit(wedge((x, height + 0.5 * pitch, z), across, rotation=rotation((0.0, 1.0, 0.0), 0.5 * pi), color=cover), name="roof")
    elif roof == "flat":
        emit(box((x, height + 0.2, z), (width + 0.5, 0.4, depth + 0.5), color=TIMBER), name="roof")
    else:
        emit(wedge((x, height + 0.5 * pitch, z), across, rotation=rotation((0.0, 1.0, 0.0), 0.5 * pi), color=cover), name="roof")

@model
def wing(side, width, depth, height, cover):
    has_wing = flip(0.5)
    if has_wing:
        wide, deep, low = uniform(2.5, 5.0), uniform(3.0, 9.0), uniform(0.5, 1.0) * height
        body(side * 0.5 * (width + wide), uniform(-0.5, 0.5) * depth, wide, deep, low, cover)

MODEL = village_house
