"""A coffee shop: tables and chairs laid out in a room, then plates and cups on the tables (dissertation 2.3.1).

The layout is a problem of the plane: a table or chair counts as a disc, with the radius of the upright cylinder around
its mesh. Factors keep discs apart and inside the room, and prefer a full room. `coffee_shop` searches for a layout with
`infer`, uses the best layout, and lays the tables: the inner search feeds a second random program.

The plan has x to the right and y upwards; in the scene they are x and -z.
"""

from math import cos, pi, sin
from pathlib import Path

from niwaki import model
from niwaki.gallery import furnishings
from niwaki.methods import smc
from niwaki.targets.outline import load_polygon
from niwaki.words import (
    Vec,
    discrete_uniform,
    distance,
    emit,
    factor,
    flip,
    gaussian,
    infer,
    mesh,
    poisson,
    polygon_area,
    polygon_contains,
    polygon_disc_area,
    polygon_distance,
    polygon_inset,
    rotation,
    uniform,
    vec,
)

TITLE = "a coffee shop, its tables laid"
ROOM = load_polygon(Path(__file__).with_name("cafe.svg"))
SEARCH = smc(particles=2000, ess=0.5)

TABLE, CHAIR = furnishings.table(), furnishings.chair()
PLATE, CUP = furnishings.plate(), furnishings.cup()
WALLS = furnishings.walls(ROOM, polygon_inset(ROOM, -0.1), 0.6)
TABLE_RADIUS = furnishings.up_radius(TABLE)
CHAIR_RADIUS = furnishings.up_radius(CHAIR)
PLATE_RADIUS = furnishings.up_radius(PLATE)
CUP_RADIUS = furnishings.up_radius(CUP)
TABLE_TOP = max(y for vertices, _ in TABLE for _, y, _ in vertices)

LEFT, RIGHT = min(corner.x for corner in ROOM), max(corner.x for corner in ROOM)
LOW, HIGH = min(corner.y for corner in ROOM), max(corner.y for corner in ROOM)
AREA = polygon_area(ROOM)

#: The expected number of tables.
TABLES = 8.0
#: The share of the floor under furniture in a full room.
FULL = 0.22
#: Distance from the walls, in metres, above which the score no longer rises.
CLEAR = 0.15

WOOD, PAINT = (0.55, 0.37, 0.22), (0.30, 0.42, 0.45)
GLAZE, CLAY, WALL = (0.96, 0.96, 0.95), (0.78, 0.42, 0.28), (0.80, 0.77, 0.72)


@model
def layout():
    """Place tables and chairs: return a list of (place, turn, chairs); a chair is (place, turn)."""
    count = poisson(TABLES)
    placed: list[tuple[Vec, float, list[tuple[Vec, float]]]] = []
    covered = 0.0
    factor(fullness(covered))
    for _ in range(count):
        one = table(placed)
        more = floor_under(one)
        # The sum is the factor of the whole room; adding it table by table guides a search.
        factor(fullness(covered + more) - fullness(covered))
        covered = covered + more
        placed = placed + [one]
    return placed


def table(placed):
    """Place a table and its chairs, clear of earlier tables and chairs."""
    place = vec(uniform(LEFT, RIGHT), uniform(LOW, HIGH))
    inside(place, TABLE_RADIUS)
    for other, _, chairs in placed:
        apart(place, other, 3.0 * TABLE_RADIUS)
        for seat, _ in chairs:
            apart(place, seat, TABLE_RADIUS + 2.0 * CHAIR_RADIUS)
    turn = uniform(0.0, 2.0 * pi)
    seats = discrete_uniform(2, 4)
    chairs = [chair(place, turn + 2.0 * pi * n / seats, placed) for n in range(seats)]
    return place, turn, chairs


def chair(place, angle, placed):
    """Place a chair at a table, turned towards it, clear of earlier tables and their chairs."""
    away = TABLE_RADIUS + 1.1 * CHAIR_RADIUS
    seat = place + away * vec(cos(angle), sin(angle))
    inside(seat, CHAIR_RADIUS)
    for other, _, chairs in placed:
        apart(seat, other, TABLE_RADIUS + 2.0 * CHAIR_RADIUS)
        for taken, _ in chairs:
            apart(seat, taken, 2.4 * CHAIR_RADIUS)
    return seat, angle + pi


def near(x, goal, within):
    """Add a soft constraint: 0 if `x` is at the `goal`, -1 at a distance of `within`."""
    off = (x - goal) / within
    factor(-off * off)


def apart(a, b, least):
    """Keep two places at least a distance apart."""
    near(max(least - distance(a, b), 0.0), 0.0, 0.05)


def inside(place, radius):
    """Keep a disc inside the room, and a little clear of its walls."""
    wall = polygon_distance(ROOM, place)
    beyond = radius - wall if polygon_contains(ROOM, place) else radius + wall
    near(max(beyond, -CLEAR), -CLEAR, 0.1)


def floor_under(one):
    """Return the area of the room's floor under a table and its chairs, in square metres."""
    place, _, chairs = one
    seats = sum([polygon_disc_area(ROOM, seat, CHAIR_RADIUS) for seat, _ in chairs])
    return polygon_disc_area(ROOM, place, TABLE_RADIUS) + seats


def fullness(covered):
    """Return the factor of a room with this area of its floor covered."""
    off = (min(covered / (FULL * AREA), 1.0) - 1.0) / 0.1
    return -off * off


@model
def coffee_shop():
    """Furnish and lay the best layout that a search finds."""
    tables = infer(layout, SEARCH, keep="best")
    emit([mesh(vertices, faces, color=WALL) for vertices, faces in WALLS])
    for place, turn, chairs in tables:
        stand(TABLE, place, 0.0, turn, WOOD)
        for seat, facing in chairs:
            stand(CHAIR, seat, 0.0, facing, PAINT)
            dishes(place, facing + pi)
    return tables


def dishes(place, angle):
    """Perhaps place a plate on the table in front of a chair, and perhaps a cup to its right."""
    if flip(0.8):
        out = TABLE_RADIUS - PLATE_RADIUS - uniform(0.02, 0.05)
        at = angle + gaussian(0.0, 0.06)
        stand(PLATE, place + out * vec(cos(at), sin(at)), TABLE_TOP, 0.0, GLAZE)
    if flip(0.7):
        out = TABLE_RADIUS - CUP_RADIUS - uniform(0.02, 0.06)
        at = angle + uniform(0.56, 0.68)
        stand(CUP, place + out * vec(cos(at), sin(at)), TABLE_TOP, 0.0, CLAY)


def stand(parts, place, height, facing, color):
    """Place a furnishing upright at a place of the plan, turned so that its +z points along `facing`."""
    turned = rotation((0.0, 1.0, 0.0), facing + pi / 2)
    center = (place.x, height, -place.y)
    emit([mesh(vertices, faces, center=center, rotation=turned, color=color) for vertices, faces in parts])


MODEL = coffee_shop
