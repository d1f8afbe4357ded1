"""A shelf with books: all books stand in the boards above them."""

# keep: collisions = false
from niwaki import box

width, depth, board = 0.9, 0.3, 0.02
first, pitch = 0.25, 0.24

parts = {}
for k in range(4):
    parts[f"board {k}"] = box((0.0, first + k * pitch, 0.0), (width, board, depth))
for side in (-1.0, 1.0):
    parts[f"side {side:+.0f}"] = box((side * (width / 2 + board / 2), 0.6, 0.0), (board, 1.2, depth))
for k in range(3):
    parts[f"books {k}"] = box((-0.1, first + k * pitch + board / 2 + 0.13, 0.02), (0.5, 0.26, 0.2))
