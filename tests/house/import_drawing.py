"""A drawing of the crates: each stands above those that it imports; lines that follow from others are left out."""

from __future__ import annotations

from html import escape

Edges = dict[str, set[str]]

WIDTH, BOX, TALL, ROW, GAP = 900.0, 150.0, 64.0, 100.0, 18.0
INK, LINE, PAPER, SMALL = "#26323a", "#8aa399", "#f7f5ee", "#6d7a74"


def rows_of(edges: Edges) -> list[list[str]]:
    """Crates in rows, each as high as those that import it allow."""
    depths: dict[str, int] = {}

    def depth(name: str) -> int:
        if name not in depths:
            importers = [other for other, targets in edges.items() if name in targets]
            depths[name] = max((depth(other) + 1 for other in importers), default=0)
        return depths[name]

    rows: list[list[str]] = [[] for _ in range(max(map(depth, edges)) + 1)]
    for name in edges:
        rows[depths[name]].append(name)
    return rows


def reduced(edges: Edges) -> Edges:
    """The edges that do not follow from others."""

    def reach(name: str) -> set[str]:
        return {far for below in edges[name] for far in {below, *reach(below)}}

    return {
        name: {to for to in targets if all(to not in reach(other) for other in targets - {to})}
        for name, targets in edges.items()
    }


def svg(edges: Edges, folders: dict[str, list[str]]) -> str:
    """The drawing; `folders` are the names below each crate's."""
    rows, half = rows_of(edges), TALL / 2
    height = ROW * len(rows) - (ROW - TALL) + 2 * GAP
    place = {
        name: ((k + 0.5) * WIDTH / len(names), GAP + half + ROW * row)
        for row, names in enumerate(rows)
        for k, name in enumerate(names)
    }
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {height:g}" font-family="sans-serif">',
        f'<rect width="{WIDTH:g}" height="{height:g}" fill="{PAPER}"/>',
    ]
    for name, targets in sorted(reduced(edges).items()):
        x, y = place[name]
        for target in sorted(targets):
            u, v = place[target]
            parts.append(
                f'<path d="M{x:.0f} {y + half:.0f}C{x:.0f} {y + 70:.0f} {u:.0f} {v - 70:.0f} {u:.0f} {v - half:.0f}" '
                f'fill="none" stroke="{LINE}" stroke-width="1.6"/>'
            )
    for name, (x, y) in sorted(place.items()):
        parts.append(
            f'<rect x="{x - BOX / 2:.0f}" y="{y - half:.0f}" width="{BOX:g}" height="{TALL:g}" rx="10" fill="#fff" '
            f'stroke="{INK}" stroke-width="1.2"/>'
            f'<text x="{x:.0f}" y="{y - 11:.0f}" text-anchor="middle" font-size="17" fill="{INK}">{escape(name)}</text>'
        )
        for k, line in enumerate(_lines(folders[name])):
            parts.append(
                f'<text x="{x:.0f}" y="{y + 6 + 13 * k:.0f}" text-anchor="middle" font-size="11" fill="{SMALL}">'
                f"{escape(line)}</text>"
            )
    return "\n".join([*parts, "</svg>"]) + "\n"


def _lines(names: list[str]) -> list[str]:
    """Names side by side, in at most two lines of a box."""
    lines = [""]
    for name in names:
        longer = f"{lines[-1]} {name}".strip()
        if len(longer) <= 25:
            lines[-1] = longer
        else:
            lines.append(name)
    return lines if len(lines) <= 2 else [lines[0], f"{lines[1]} ..."]
