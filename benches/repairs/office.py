"""Rows of desks: the cabinet stands in the last desk."""

# keep: collisions = false
# keep: within = [[0.0, 0.0, 0.0], [9.0, 3.0, 6.0]]
from niwaki import box

columns, rows = 4, 2
column_pitch, row_pitch = 2.3, 2.2
start_x, start_z = 1.0, 1.5

parts = {}
for i in range(columns):
    for j in range(rows):
        x, z = start_x + i * column_pitch, start_z + j * row_pitch
        parts[f"desk {i}{j}"] = box((x, 0.37, z), (1.6, 0.74, 0.8))
        parts[f"chair {i}{j}"] = box((x, 0.45, z + 0.75), (0.55, 0.9, 0.55))
parts["cabinet"] = box((8.5, 0.6, 3.9), (0.8, 1.2, 0.5))
parts["plant"] = box((0.4, 0.5, 5.6), (0.4, 1.0, 0.4))
