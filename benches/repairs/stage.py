"""A stage: the stand of a lamp is in the piano, and the screen hangs too high and above nothing."""

# keep: collisions = false
# keep: supported = true
# keep: height = [0.0, 3.2]
from niwaki import box

stage_top = 0.6


def on_stage(x, z, size):
    return box((x, stage_top + size[1] / 2, z), size)


parts = {
    "stage": box((0.0, stage_top / 2, 0.0), (6.0, stage_top, 4.0)),
    "piano": on_stage(-1.2, 0.2, (1.5, 1.0, 1.4)),
    "bench": on_stage(-1.2, 1.25, (0.8, 0.5, 0.4)),
    "stand": on_stage(-0.7, -0.3, (0.3, 1.5, 0.3)),
    "lamp": box((-0.7, stage_top + 1.5 + 0.15, -0.3), (0.25, 0.3, 0.25)),
    "screen foot": on_stage(1.5, -1.7, (2.0, 1.0, 0.2)),
    "screen": box((1.5, stage_top + 2.1, -1.7), (2.6, 1.4, 0.1)),
}
