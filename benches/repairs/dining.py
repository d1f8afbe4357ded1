"""A round of chairs at a table: the ring is too narrow, so that the chairs stand in the table."""

# keep: collisions = false
# keep: within = [[-2.0, 0.0, -2.0], [2.0, 2.5, 2.0]]
from math import cos, radians, sin

from niwaki import box

chairs = 6
ring = 0.85  # from the middle of the table to that of a chair
turn = 0.0


def scene():
    parts = [("table", box((0.0, 0.37, 0.0), (1.4, 0.74, 1.0)))]
    for k in range(chairs):
        angle = radians(turn + k * 360 / chairs)
        parts.append(("chair", box((ring * cos(angle), 0.45, ring * sin(angle)), (0.4, 0.9, 0.4))))
    return parts
