"""A bedroom: the chair stands in the desk, and the lamp hangs beside its table."""

# keep: collisions = false
# keep: supported = true
# keep: within = [[-2.0, 0.0, -1.75], [2.0, 2.6, 1.75]]
from niwaki import box

BED_X = -0.6  # the middle of the bed
WALL = 1.75

bed = box((BED_X, 0.25, -WALL + 1.0), (1.6, 0.5, 2.0))
table_x = BED_X + 0.8 + 0.25
table = box((table_x, 0.3, -WALL + 0.2), (0.45, 0.6, 0.4))
lamp = box((table_x + 0.4, 0.6 + 0.2, -WALL + 0.2), (0.2, 0.4, 0.2))
wardrobe = box((0.9, 1.05, -0.2), (1.2, 2.1, 0.6))
# The desk below the window.
desk = box((-1.3, 0.37, 1.45), (1.2, 0.74, 0.6))
chair = box((-1.3, 0.45, 0.95), (0.5, 0.9, 0.5))

parts = {"bed": bed, "table": table, "lamp": lamp, "wardrobe": wardrobe, "desk": desk, "chair": chair}
