"""Figures 6.2 and 6.3, as far as they show data: a chain of strokes before and after it has a guide.

The dissertation shows the text of its chain in a picture only; the chain here is our own.
"""

from judging import grown, held_out, judged
from niwaki.gallery import chain
from places import Places
from school import ours
from sheets import cell, saved, sheet

SHOWN = ("scribbles/161", "scribbles/168", "scribbles/176", "scribbles/187")


def draw(places: Places) -> None:
    """Draw: forward samples and ten particles, without a guide and with ours."""
    guide = ours(places, chain)
    every = held_out("scribbles")
    shown = [drawing for drawing in every if drawing.name in SHOWN]
    kinds = [
        (1, "systematic", None),
        (10, "residual", None),
        (1, "systematic", guide),
        (10, "tempered", guide),
    ]
    rows = [[cell(chain, drawing, None, 170) for drawing in shown]]
    rows += [
        [cell(chain, drawing, grown(chain, drawing, n, how, guide_of_kind, 1), 170) for drawing in shown]
        for n, how, guide_of_kind in kinds
    ]
    turned = [list(column) for column in zip(*rows, strict=True)]
    titles = ("drawing", "forward", "N = 10", "guided, forward", "guided, N = 10")
    saved(places, "figure-6-2.png", sheet(turned, titles=titles))
    for n, how, guide_of_kind in kinds:
        judged(
            places,
            chain,
            "unguided" if guide_of_kind is None else "ours",
            guide_of_kind,
            n,
            resampling=how,
            collection="scribbles",
        )
