"""Drawings of the pages that explain: boxes, arrows and words as SVG, made when the manual is built."""

from __future__ import annotations

from html import escape
from pathlib import Path

INK, PALE, MARK, SOFT = "#4a4741", "#f3f1ec", "#d0652b", "#cfcabf"


class Drawing:
    """A page in pixels, x to the right and y downwards."""

    def __init__(self, width: int, height: int) -> None:
        self.size = width, height
        self.parts: list[str] = []

    def box(
        self, x: float, y: float, width: float, height: float, text: str = "", fill: str = "white"
    ) -> None:
        """A box with words in its middle; each line of the text is one."""
        self.parts.append(
            f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="5" fill="{fill}" stroke="{INK}"/>'
        )
        lines = text.split("\n")
        for k, line in enumerate(lines):
            down = y + height / 2 + 5 + 17 * (k - (len(lines) - 1) / 2)
            self.text(x + width / 2, down, line, "white" if fill in (INK, MARK) else INK)

    def text(self, x: float, y: float, words: str, color: str = INK, anchor: str = "middle") -> None:
        """A line of words."""
        self.parts.append(
            f'<text x="{x}" y="{y}" fill="{color}" text-anchor="{anchor}">{escape(words)}</text>'
        )

    def arrow(self, x: float, y: float, u: float, v: float, words: str = "", color: str = INK) -> None:
        """From (x, y) to (u, v), with words beside its middle."""
        self.parts.append(
            f'<line x1="{x}" y1="{y}" x2="{u}" y2="{v}" stroke="{color}" stroke-width="1.5" marker-end="url(#tip)"/>'
        )
        if words:
            self.text((x + u) / 2 + 6, (y + v) / 2 - 4, words, color, "start")

    def circle(self, x: float, y: float, radius: float, fill: str = PALE) -> None:
        """A disc; its area may stand for a weight."""
        self.parts.append(f'<circle cx="{x}" cy="{y}" r="{radius}" fill="{fill}" stroke="{INK}"/>')

    def cells(self, x: float, y: float, side: float, rows: list[str]) -> None:
        """A grid: a letter for each cell, `#` on, `x` marked, anything else off."""
        for j, row in enumerate(rows):
            for k, letter in enumerate(row):
                fill = {"#": SOFT, "x": MARK}.get(letter, "white")
                place = f'x="{x + k * side}" y="{y + j * side}" width="{side}" height="{side}"'
                self.parts.append(f'<rect {place} fill="{fill}" stroke="{SOFT}" stroke-width="0.5"/>')

    def save(self, path: str) -> None:
        """Write it as SVG."""
        width, height = self.size
        tip = (
            '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" '
            f'orient="auto"><path d="M0 0L8 4L0 8z" fill="{INK}"/></marker></defs>'
        )
        body = "\n".join(self.parts)
        Path(path).write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="14">'
            f'{tip}<rect width="{width}" height="{height}" fill="{PALE}"/>\n{body}\n</svg>\n',
            encoding="utf-8",
        )
