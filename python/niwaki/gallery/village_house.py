"""Village houses: a house under a steep roof, what stands beside it, chimneys, and windows that are holes."""

from math import pi

from niwaki import box, choose, emit, flip, future, model, rotation, uniform, wedge

TITLE = "village houses"
TARGET = "farmstead"
VOXEL = 0.3
PARTICLES = 300

PLASTER, BRICK, STONE = (0.93, 0.89, 0.80), (0.66, 0.42, 0.33), (0.74, 0.70, 0.63)
TILE, SLATE, THATCH, TIMBER = (0.64, 0.30, 0.22), (0.36, 0.40, 0.46), (0.72, 0.60, 0.38), (0.38, 0.27, 0.18)
GLASS = (0.16, 0.20, 0.24)
ALONG, ACROSS = rotation((0.0, 1.0, 0.0), 0.5 * pi), rotation((0.0, 1.0, 0.0), 0.0)


@model
def village_house():
    """Build a house whose front looks to +z, in metres."""
    walls, cover = choose([PLASTER, BRICK, STONE]), choose([TILE, SLATE, THATCH])
    width, depth, height = uniform(5.0, 12.0), uniform(4.0, 8.0), uniform(2.6, 6.0)
    future(house, (0.0, 0.0), (width, height, depth), walls, cover)
    for side in (-1, 1):
        beside = choose(["nothing", "wing", "lean-to"])
        if beside == "wing":
            size = (uniform(2.5, 5.0), uniform(0.6, 1.0) * height, uniform(3.0, 9.0))
            place = (side * (0.5 * (width + size[0]) + 0.4), uniform(-0.5, 0.5) * depth)
            future(house, place, size, walls, cover)
        elif beside == "lean-to":
            size = (uniform(1.5, 5.0), uniform(0.5, 0.9) * height, uniform(0.5, 1.0) * depth)
            center = (side * (0.5 * (width + size[0]) + 0.02), 0.5 * size[1], 0.0)
            emit(with_openings(center, size, walls), name="lean_to")


@model
def house(place, size, walls, cover):
    """Build walls with openings, a roof over them, and perhaps a chimney."""
    (x, z), (width, height, depth) = place, size
    body = with_openings((x, 0.5 * height, z), size, walls)
    roof, rise = choose({"gable": 3, "hip": 2, "flat": 1}), uniform(0.35, 0.8) * min(width, depth)
    if roof == "flat":
        top = box((x, height + 0.15, z), (width + 0.3, 0.3, depth + 0.3), color=TIMBER)
    else:
        top = slopes(roof, (x, height, z), (width, rise, depth), cover)
    has_chimney = flip(0.5)
    spot = (x + uniform(-0.4, 0.4) * width, height + 0.6 * rise, z)
    chimney = box(spot, (0.7, 1.2 * rise + 0.6, 0.7), color=BRICK)
    emit(body, top, chimney if has_chimney else [], name="house")


def slopes(roof, foot, size, cover):
    """Return a roof between two gables, or with slopes of equal pitch on all sides."""
    x, y, z = foot
    width, rise, depth = size
    turns = (ALONG, ACROSS) if width > depth else (ACROSS, ALONG)
    short, long = min(width, depth) + 0.7, max(width, depth) + 0.5
    gable = wedge((x, y + 0.5 * rise, z), (short, rise, long), rotation=turns[0], color=cover)
    if roof == "gable":
        return gable
    high = rise * long / short
    return gable & wedge((x, y + 0.5 * high, z), (long, high, short), rotation=turns[1], color=cover)


def with_openings(center, size, walls):
    """Return walls with a door and windows in front and rear, around a dark room."""
    width, height, depth = size
    storeys, columns = max(1, round(height / 2.8)), max(1, round(width / 2.4))
    high, wide = height / storeys, width / columns
    low, left = center[1] - 0.5 * height, center[0] - 0.5 * width
    solid = box(center, size, bevel=0.0, color=walls)
    for j, i in [(j, i) for j in range(storeys) for i in range(columns)]:
        is_door = j == 0 and i == columns // 2
        tall, middle = (0.76 * high, 0.38 * high) if is_door else (0.45 * high, 0.55 * high)
        place = (left + (i + 0.5) * wide, low + j * high + middle, center[2])
        solid = solid - box(place, (0.42 * wide, tall, depth + 1.0), bevel=0.0, color=TIMBER)
    return [solid, box(center, (width - 0.5, height - 0.4, depth - 0.5), color=GLASS)]


MODEL = village_house
