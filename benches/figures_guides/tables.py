"""All numbers in one file, and tables of them for the manual."""

import json
from collections import defaultdict
from collections.abc import Iterable

from judging import summary
from places import Places, Row

KEYS = ("model", "guide", "particles", "resampling", "set")


def draw(places: Places) -> None:
    """Write docs/pictures/guides/measured.json, and print it as a table."""
    groups: dict[tuple[object, ...], list[Row]] = defaultdict(list)
    for row in places.rows():
        if "similarities" in row:
            groups[tuple(row[key] for key in KEYS)].append(row)
    found = [dict(zip(KEYS, key, strict=True)) | rounded(rows) for key, rows in groups.items()]
    found.sort(key=lambda row: [str(row[key]) if key != "particles" else f"{row[key]:06}" for key in KEYS])
    lines = ",\n".join(json.dumps(row) for row in found)
    (places.pictures / "measured.json").write_text(f"[\n{lines}\n]\n", encoding="utf-8")
    print(table(found))


def rounded(rows: list[Row]) -> Row:
    """A summary of rows, with few digits."""
    own = summary(rows) | {"seeds": sorted(row["seed"] for row in rows)}
    return {key: round(value, 3) if isinstance(value, float) else value for key, value in own.items()}


def table(rows: Iterable[Row]) -> str:
    """Rows as Markdown."""
    lines = [
        "| model, guide | set | N | resampling | mean | median | p10 | stumps | ms |",
        "|" + " --- |" * 9,
    ]
    for row in rows:
        lines.append(
            f"| {row['model']}, {row['guide']} | {row['set']} | {row['particles']} | {row['resampling']} | {row['mean']:.3f} "
            f"| {row['median']:.3f} | {row['p10']:.3f} | {row['stumps']:.0%} | {row['ms']:.1f} |"
        )
    return "\n".join(lines)
