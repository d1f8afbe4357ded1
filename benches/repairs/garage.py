"""A garage: the tyres hang above their rack."""

# keep: collisions = false
# keep: supported = true
# keep: within = [[-2.25, 0.0, -3.25], [2.25, 2.5, 3.25]]
from niwaki import box, cylinder

car_x, car_z = -0.6, 0.3
parts = {
    "car": box((car_x, 0.7, car_z), (1.9, 1.4, 4.5)),
    "bench": box((-1.95, 0.4, -1.0), (0.6, 0.8, 2.2)),
    "vice": box((-1.95, 0.8 + 0.1, -1.8), (0.2, 0.2, 0.3)),
    "rack": box((1.9, 0.4, 1.6), (0.6, 0.8, 2.4)),
    "ladder": box((2.0, 1.0, -2.0), (0.4, 2.0, 0.5)),
}
for k in range(3):
    parts[f"tyre {k}"] = cylinder((1.9, 0.98, 0.9 + k * 0.7), 0.3, 0.25)
