"""Steps beside a platform: the last step is in the platform, and the post of the rail hangs above the first one."""

# keep: collisions = false
# keep: supported = true
from niwaki import box

rise, run, wide = 0.17, 0.28, 1.2
steps = 5
start = -1.35

parts = {"platform": box((0.75, 0.5, 0.0), (1.5, 1.0, 1.6))}
for k in range(steps):
    high = (k + 1) * rise
    parts[f"step {k + 1}"] = box((start + (k + 0.5) * run, high / 2, 0.0), (run, high, wide))
parts["post"] = box((start + 0.14, 0.3 + 0.45, 0.5), (0.08, 0.9, 0.08))
