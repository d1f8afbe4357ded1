"""Two rows of stalls along a lane: the shifted row leaves the market, and a stall stands in the well."""

# keep: collisions = false
# keep: within = [[-8.0, 0.0, -5.0], [8.0, 4.0, 5.0]]
from niwaki import box

lane = 1.6
count = 5


def stalls(z, shift):
    """One row; `shift` is half a stall."""
    places = [-6.4 + shift + k * 3.2 for k in range(count)]
    return [(f"stall {z:+.1f} {k}", box((x, 1.25, z), (2.6, 2.5, 2.0))) for k, x in enumerate(places)]


def market():
    well = [("well", box((0.4, 0.5, 0.5), (1.4, 1.0, 1.4)))]
    return stalls(-lane - 0.6, 0.0) + stalls(lane - 0.3, 1.6) + well
