"""A sofa that is longer than its niche: no place keeps both requirements, and sizes stay."""

# keep: collisions = false
# keep: within = [[-1.0, 0.0, -1.0], [1.0, 2.5, 1.0]]
from niwaki import box

sofa_x = 0.0
parts = {
    "sofa": box((sofa_x, 0.4, -0.6), (1.7, 0.8, 0.8)),
    "lamp": box((0.8, 0.7, -0.6), (0.4, 1.4, 1.9)),
}
