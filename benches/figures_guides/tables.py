"""All numbers in one file, and the tables of docs/guide/chapter-six.md."""

import json
import statistics
from collections import defaultdict
from collections.abc import Iterable

from judging import summary
from places import ROOT, Places, Row
from seeds import TRAINED

KEYS = ("model", "guide", "particles", "resampling", "set")
PAGE = ROOT / "docs/guide/chapter-six.md"

#: Lines of the tables: title, guide, particles, resampling.
NETWORKS = (
    ("dissertation's, full", "full", 10, "residual"),
    ("dissertation's, full", "full", 10, "tempered"),
    ("dissertation's, averaged weights", "averaged", 10, "residual"),
    ("dissertation's, averaged weights", "averaged", 10, "tempered"),
    ("dissertation's, place and target", "target", 10, "residual"),
    ("dissertation's, place", "local", 10, "residual"),
    ("dissertation's, constants", "constants", 10, "residual"),
    ("ours", "ours", 10, "tempered"),
    ("ours", "ours", 20, "tempered"),
    ("none", "unguided", 51, "residual"),
    ("none", "unguided", 201, "residual"),
    ("none", "unguided", 600, "systematic"),
    ("none", "unguided", 600, "tempered"),
)
SETS = (
    ("ours", "ours", 10, "tempered"),
    ("dissertation's, full", "full", 10, "residual"),
    ("none", "unguided", 10, "residual"),
    ("none", "unguided", 600, "residual"),
)
HEAD = ("mean", "median", "p10", "stumps", "CPU, ms", "searches")


def draw(places: Places) -> None:
    """Write docs/pictures/guides/measured.json, and the tables where the manual has places for them."""
    groups: dict[tuple[object, ...], list[Row]] = defaultdict(list)
    for row in places.rows():
        if "similarities" in row:
            groups[tuple(row[key] for key in KEYS)].append(row)
    rows = [dict(zip(KEYS, key, strict=True)) | rounded(rows) for key, rows in groups.items()]
    rows.sort(key=lambda row: [str(row[key]) if key != "particles" else f"{row[key]:06}" for key in KEYS])
    lines = ",\n".join(json.dumps(row) for row in rows)
    (places.pictures / "measured.json").write_text(f"[\n{lines}\n]\n", encoding="utf-8")
    if not places.quick:
        put("networks", networks(rows))
        put("seeds", seeds(rows))
        put("sets", sets(rows))


def put(name: str, text: str) -> None:
    """Write a table where the manual has a place for it."""
    before, rest = PAGE.read_text(encoding="utf-8").split(f"% table {name}\n")
    after = rest.partition("% end\n")[2]
    PAGE.write_text(f"{before}% table {name}\n\n{text}\n\n% end\n{after}", encoding="utf-8")


def rounded(rows: list[Row]) -> Row:
    """A summary of rows, with few digits."""
    numbers = summary(rows) | {"seeds": sorted(row["seed"] for row in rows)}
    return {key: round(value, 3) if isinstance(value, float) else value for key, value in numbers.items()}


def networks(rows: list[Row]) -> str:
    """Guides on the held-out glyphs."""
    lines = [(title, row) for title, *key in NETWORKS for row in known(rows, *key)]
    cells = [(title, row["particles"], row["resampling"], *numbers(row)) for title, row in lines]
    return table(("guide", "N", "resampling", *HEAD), cells)


def seeds(measured: list[Row]) -> str:
    """Our guide by five training seeds."""
    cells = []
    names = ("ours", *(f"ours-{seed}" for seed in TRAINED[1:]))
    for particles in (10, 20):
        rows = [row for name in names for row in known(measured, name, particles, "tempered")]
        for key in ("mean", "median", "p10", "stumps") if rows else ():
            values = [row[key] for row in rows]
            ends = (f"{value:.3f}" for value in (min(values), statistics.fmean(values), max(values)))
            cells.append((f"N = {particles}, {key}", *ends, len(values)))
    return table(("", "least", "mean", "most", "training seeds"), cells)


def sets(rows: list[Row]) -> str:
    """Guides on the other held-out drawings."""
    cells = [
        (title, collection, row["particles"], row["resampling"], *numbers(row))
        for collection in ("scribbles", "silhouettes")
        for title, *key in SETS
        for row in known(rows, *key, collection)
    ]
    return table(("guide", "drawings", "N", "resampling", *HEAD), cells)


def known(
    rows: list[Row], guide: str, particles: int, resampling: str, collection: str = "glyphs"
) -> list[Row]:
    """Return the measurement of a guide of the vines, or None."""
    key = dict(zip(KEYS, ("vines", guide, particles, resampling, collection), strict=True))
    return [row for row in rows if all(row[name] == value for name, value in key.items())]


def numbers(row: Row) -> tuple[object, ...]:
    """Return the values of the columns of `HEAD`."""
    three = (f"{row[key]:.2f}" for key in ("mean", "median", "p10"))
    return (*three, f"{row['stumps']:.0%}", f"{row['ms']:.1f}", row["searches"])


def table(head: Iterable[object], rows: Iterable[Iterable[object]]) -> str:
    """Rows as Markdown."""
    first = list(head)
    lines = [first, ["---"] * len(first), *rows]
    return "\n".join("| " + " | ".join(str(value) for value in line) + " |" for line in lines)
