"""A kitchen row: the island stands in the counters, and the hood hangs in the shelf."""

# keep: collisions = false
# keep: within = [[0.0, 0.0, 0.0], [3.6, 2.5, 2.4]]
from niwaki import box


def _row(count=5, start=0.3, pitch=0.72, deep=0.6):
    """Counters along the wall."""
    return {
        f"counter {k + 1}": box((start + k * pitch, 0.45, deep / 2), (0.6, 0.9, deep)) for k in range(count)
    }


def kitchen():
    parts = _row()
    parts["hood"] = box((1.8, 1.75, 0.25), (0.6, 0.3, 0.5))
    parts["shelf"] = box((2.2, 1.7, 0.15), (1.0, 0.3, 0.3))
    parts["island"] = box((1.8, 0.45, 1.0), (1.8, 0.9, 0.9))
    return parts
