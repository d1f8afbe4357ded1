"""A floor plan of a small flat: a tub in the wall, a bed in the wall, a sofa in front of the door."""

# keep: collisions = false
# keep: within = [[0.0, 0.0, 0.0], [8.0, 2.6, 6.0]]
from niwaki import box

inner_x = 4.9  # the wall between the rooms
bath_z = 3.8  # the wall of the bath

parts = {
    "wall": box((inner_x, 1.3, 2.0), (0.1, 2.6, 3.6)),
    "bath wall": box((6.5, 1.3, bath_z), (2.8, 2.6, 0.1)),
    "tub": box((7.2, 0.3, 3.4), (1.6, 0.6, 0.75)),
    "sink": box((5.4, 0.45, 5.6), (0.6, 0.9, 0.5)),
    "bed": box((inner_x + 0.9, 0.25, 1.2), (2.0, 0.5, 1.6)),
    "sofa": box((1.2, 0.4, 4.9), (2.2, 0.8, 0.9)),
    "door": box((0.5, 1.0, 5.5), (0.9, 2.0, 0.9)),  # the space that it swings through
    "table": box((2.6, 0.37, 2.2), (1.6, 0.74, 0.9)),
    "kitchen": box((2.0, 0.45, 0.3), (3.6, 0.9, 0.6)),
}
