"""Pictures of the work of each strategy for a proposal: dissertation figure 3.1, for any model.

Each panel shows the calls of a run in the order of the program, with inner calls below their callers. The colour of a
call tells its fate: orange for run from the start, blue for resumed (from the choice, or from a call that returned),
grey for skipped, green for created, red for removed, white for not touched. A ring marks the call of the changed
choice.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any

from PIL import Image, ImageDraw, ImageFont

from niwaki.draw.picture import save_image
from niwaki.errors.files import write_whole

STRATEGIES = {
    "rerun": "rerun: all of it again",
    "resume": "resume: on from the choice",
    "cache": "cache: from the start, skipping calls with unchanged inputs",
    "c3": "C3: on from the choice, skipping, until nothing that changed is left",
}
COLORS = {
    "untouched": "#ffffff",
    "skipped": "#c9c9c9",
    "unwound": "#4f8fc6",
    "invoked": "#ee9238",
    "made": "#5aa469",
    "removed": "#cf4d4d",
}
WORDS = {
    "invoked": "run from the start",
    "unwound": "gone on with",
    "skipped": "skipped",
    "made": "made",
    "removed": "taken away",
    "untouched": "not touched",
}
WIDTH, MARGIN, PANEL, HEAD = 960, 24, 150, 24
#: The most levels that are drawn; a deeper picture shows the levels around the choice.
LEVELS = 48


@dataclass(frozen=True)
class _Mark:
    """A rectangle or a line of text, in points from the top left."""

    kind: str
    x: float
    y: float
    width: float = 0.0
    height: float = 0.0
    fill: str = "#333333"
    line: str | None = None
    text: str = ""
    size: int = 11


def value_text(value: Any) -> str:
    """Write a value in few characters."""
    if isinstance(value, tuple):
        return f"({', '.join(value_text(part) for part in value)})"
    return f"{value:.4g}" if isinstance(value, float) else repr(value)


def outcome(steps: Sequence[tuple[str, int]], count: int) -> list[str]:
    """Return the fate of each activation: the strongest word of its steps."""
    rank = {word: place for place, word in enumerate(COLORS)}
    fates = ["untouched"] * count
    for word, at in steps:
        if rank[word] > rank[fates[at]]:
            fates[at] = word
    return fates


def counts(steps: Sequence[tuple[str, int]], count: int) -> dict[str, int]:
    """Count the activations of each fate."""
    fates = outcome(steps, count)
    return {word: fates.count(word) for word in WORDS}


def draw(explained: dict[str, Any], path: str | PathLike[str]) -> Path:
    """Draw an explanation into a .svg or .png file."""
    marks, height = _marks(explained)
    place = Path(path)
    if place.suffix.lower() == ".svg":
        return write_whole(place, _svg(marks, height).encode())
    return save_image(lambda: _image(marks, height), place)


def _marks(explained: dict[str, Any]) -> tuple[list[_Mark], int]:
    calls = explained["activations"]
    depths = [call[2] for call in calls]
    home, deepest = depths[explained["home"]], max(depths)
    top = 0 if deepest < LEVELS else min(max(0, home - LEVELS // 2), deepest + 1 - LEVELS)
    bottom = min(deepest, top + LEVELS - 1)
    spans = _spans(calls)
    marks = [
        _Mark("text", MARGIN, 18, text=f"a proposal to {explained['label']}", size=15),
        _Mark(
            "text",
            MARGIN,
            38,
            text=f"{value_text(explained['old'])} becomes {value_text(explained['new'])}",
            fill="#777777",
        ),
    ]
    if top > 0 or bottom < deepest:
        shown = f"levels {top} to {bottom} of 0 to {deepest}"
        marks.append(_Mark("text", WIDTH - MARGIN - 7 * len(shown), 38, text=shown, fill="#777777"))
    y = 58.0
    for name, title in STRATEGIES.items():
        if name not in explained["runs"]:
            continue
        steps, complete = explained["runs"][name]
        marks += _panel(calls, spans, outcome(steps, len(calls)), explained["home"], y, top, bottom)
        totals = ", ".join(f"{n} {WORDS[word]}" for word, n in counts(steps, len(calls)).items() if n)
        ended = "" if complete else "; stopped: the score became minus infinity"
        marks.append(_Mark("text", MARGIN, y, text=title, size=13))
        marks.append(_Mark("text", MARGIN, y + 24 + PANEL, text=totals + ended, fill="#777777"))
        y += PANEL + HEAD + 26
    x = float(MARGIN)
    for word, meaning in WORDS.items():
        marks.append(_Mark("box", x, y, 11, 11, COLORS[word], "#888888"))
        marks.append(_Mark("text", x + 16, y - 1, text=meaning))
        x += 34 + 6.0 * len(meaning)
    return marks, round(y + 28)


def _spans(calls: Sequence[Any]) -> list[tuple[float, float]]:
    """Compute the horizontal span of each activation; a call without inner calls has width 1."""
    children: list[list[int]] = [[] for _ in calls]
    for number, call in enumerate(calls):
        if call[3] is not None and call[3] != number:
            children[call[3]].append(number)
    widths = [1.0] * len(calls)
    for number in range(len(calls) - 1, -1, -1):
        if children[number]:
            widths[number] = sum(widths[child] for child in children[number])
    starts = [0.0] * len(calls)
    for number in range(len(calls)):
        at = starts[number]
        for child in children[number]:
            starts[child] = at
            at += widths[child]
    return list(zip(starts, widths, strict=True))


def _panel(
    calls: Sequence[Any],
    spans: Sequence[tuple[float, float]],
    fates: Sequence[str],
    home: int,
    y: float,
    top: int,
    bottom: int,
) -> list[_Mark]:
    across = (WIDTH - 2 * MARGIN) / max(spans[0][1], 1.0)
    down = (PANEL - 4) / (bottom - top + 1)
    boxes: list[_Mark] = []
    rings: list[_Mark] = []
    for number, (call, (start, width), fate) in enumerate(zip(calls, spans, fates, strict=True)):
        if not top <= call[2] <= bottom:
            continue
        x, wide = MARGIN + start * across, width * across
        place = y + HEAD - 4 + (call[2] - top) * down
        if wide < 0.4 and fate == "untouched":
            continue
        line = "#999999" if min(wide, down) > 4 else None
        boxes.append(_Mark("box", x, place, max(wide, 0.8), max(down, 0.8), COLORS[fate], line))
        if down >= 11 and wide > 7 * min(len(call[0]), 6):
            most = int(wide / 6.2) - 1
            text = call[0] if len(call[0]) <= most else call[0][: max(most - 2, 1)] + ".."
            dark = fate in ("untouched", "skipped", "invoked")
            boxes.append(
                _Mark(
                    "text",
                    x + 4,
                    place + down / 2 - 6,
                    text=text,
                    fill="#333333" if dark else "#ffffff",
                    size=10,
                )
            )
        if number == home:
            rings.append(_Mark("ring", x - 1, place - 1, max(wide, 3) + 2, max(down, 3) + 2, line="#111111"))
    return boxes + rings


def _svg(marks: Sequence[_Mark], height: int) -> str:
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" '
        f'viewBox="0 0 {WIDTH} {height}" font-family="sans-serif">',
        f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>',
    ]
    for mark in marks:
        if mark.kind == "text":
            lines.append(
                f'<text x="{mark.x:.1f}" y="{mark.y + 0.85 * mark.size:.1f}" font-size="{mark.size}" '
                f'fill="{mark.fill}">{escape(mark.text, quote=False)}</text>'
            )
            continue
        fill = "none" if mark.kind == "ring" else mark.fill
        stroke = (
            f' stroke="{mark.line}" stroke-width="{2 if mark.kind == "ring" else 0.5}"' if mark.line else ""
        )
        lines.append(
            f'<rect x="{mark.x:.2f}" y="{mark.y:.2f}" width="{mark.width:.2f}" height="{mark.height:.2f}" '
            f'fill="{fill}"{stroke}/>'
        )
    return "\n".join([*lines, "</svg>\n"])


def _image(marks: Sequence[_Mark], height: int) -> Image.Image:
    scale = 2
    page = Image.new("RGB", (WIDTH * scale, height * scale), "#ffffff")
    pen = ImageDraw.Draw(page)
    for mark in marks:
        x, y = mark.x * scale, mark.y * scale
        if mark.kind == "text":
            pen.text((x, y), mark.text, fill=mark.fill, font=ImageFont.load_default(mark.size * scale))
            continue
        corners = (x, y, x + mark.width * scale, y + mark.height * scale)
        if mark.kind == "ring":
            pen.rectangle(corners, outline=mark.line, width=2 * scale)
        else:
            pen.rectangle(corners, fill=mark.fill, outline=mark.line)
    return page
