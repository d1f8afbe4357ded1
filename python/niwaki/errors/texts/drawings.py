"""Errors about drawings to color, and about rules of their regions; part of the files."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

DRAWINGS = (
    Message(
        "drawing-no-regions",
        "this drawing has no regions to color",
        why="at least two regions are needed; it has {found}",
        help="give each region a class, or an id, on its shapes or on a group around them; in an image, a colour of its own",
        example='<path d="M0 0H9V9z"/>',
        cure='<path class="roof" d="M0 0H9V9z"/> <path class="wall" d="M0 9H9V18z"/>',
    ),
    Message(
        "drawing-too-many",
        "this drawing has {count} regions, more than {most}",
        why="in an image each colour is a region, and soft edges are full of colours",
        help="export the image without anti-aliasing, or give shapes of an SVG that belong together one class",
        example="a photograph",
        cure="a drawing in twelve flat colours",
    ),
    Message(
        "drawing-unclear",
        "it is not clear which shapes of this drawing are painted",
        why="{reason}",
        help="export plain shapes from the program that wrote it: presentation attributes, no nested styles",
        example="<style> g > path { fill: none } </style>",
        cure="<style> .outline { fill: none } </style>",
    ),
    Message(
        "rules-unclear",
        "these rules cannot be read",
        why="{reason}",
        help="write `lightness`, `lighter`, `same-chroma` and `same-hue` as lists of chains of regions, `background` as one region, `[muted]` and `[held]` as tables",
        example='lightness = ["wall", "ink"]',
        cure='lightness = [["wall", "ink"]]',
    ),
    Message(
        "rules-no-region",
        "the rules name `{name}`, and the drawing has no such region",
        why="{reason}",
        help="write a class or id of the drawing; in an image `#rrggbb`",
        example='lightness = [["wal", "ink"]]',
        cure='lightness = [["wall", "ink"]]',
    ),
    Message(
        "rules-contradict",
        "some rules cannot hold together",
        why="{rules}",
        help="leave out one of these",
        example='lightness = [["wall", "roof"], ["roof", "wall"]]',
        cure='lightness = [["wall", "roof"]]',
    ),
    Message(
        "rules-hold-all",
        "nothing is left to color: all {count} regions are held",
        why="a held colour does not change, and each region of this drawing has one",
        help="leave out a region of `[held]`",
        example='[held]\nroof = "#702020"\nwall = "#e8d9b0"  # and no other regions',
        cure='[held]\nroof = "#702020"',
    ),
)
