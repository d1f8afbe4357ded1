"""Errors about drawings to color, and about rules for their regions; part of the files."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

DRAWINGS = (
    Message(
        "drawing-no-regions",
        "this drawing has no regions to color",
        why="a drawing needs at least two regions; this drawing has {found}",
        help="give each region a class or an id, on its shapes or on their group; in an image, give each region another colour",
        example='<path d="M0 0H9V9z"/>',
        cure='<path class="roof" d="M0 0H9V9z"/> <path class="wall" d="M0 9H9V18z"/>',
    ),
    Message(
        "drawing-too-many",
        "this drawing has {count} regions, more than {most}",
        why="in an image each colour is a region, and smooth edges have many colours",
        help="export the image without anti-aliasing; in an SVG, give the shapes of a region the same class",
        example="a photograph",
        cure="a drawing in twelve flat colours",
    ),
    Message(
        "drawing-unclear",
        "it is not clear which shapes of this drawing are painted",
        why="{reason}",
        help="export plain shapes from the drawing program: presentation attributes, no nested styles",
        example="<style> g > path { fill: none } </style>",
        cure="<style> .outline { fill: none } </style>",
    ),
    Message(
        "rules-unclear",
        "these rules cannot be read",
        why="{reason}",
        help="write `lightness`, `lighter`, `same-chroma` and `same-hue` as lists of chains of regions, `background` as a region, and `[muted]` and `[held]` as tables",
        example='lightness = ["wall", "ink"]',
        cure='lightness = [["wall", "ink"]]',
    ),
    Message(
        "rules-no-region",
        "the drawing has no region `{name}`, which the rules name",
        why="{reason}",
        help="write a class or id of the drawing; in an image `#rrggbb`",
        example='lightness = [["wal", "ink"]]',
        cure='lightness = [["wall", "ink"]]',
    ),
    Message(
        "rules-contradict",
        "some rules contradict each other",
        why="{rules}",
        help="remove one of these rules",
        example='lightness = [["wall", "roof"], ["roof", "wall"]]',
        cure='lightness = [["wall", "roof"]]',
    ),
    Message(
        "rules-hold-all",
        "all {count} regions are held: there is nothing to color",
        why="a held colour does not change, and `[held]` names every region of this drawing",
        help="remove a region from `[held]`",
        example='[held]\nroof = "#702020"\nwall = "#e8d9b0"  # and no other regions',
        cure='[held]\nroof = "#702020"',
    ),
)
