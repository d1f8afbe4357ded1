"""Makes the drawings of `niwaki.targets.drawings`: a page of small images for each collection, and one table.

    python -m drawings.make FONTS CLIPART          (in benches/; needs SciPy and resvg_py)

FONTS holds lobster.otf, leckerli.ttf, pacifico.woff2, oleo.woff2, kaushan.otf and dejavu.ttf; CLIPART is the folder
`svg` of Open Clip Art 0.18. The licences are in NOTICE. The table says of each drawing where a model starts, and
whether it is for training or held out: what is held out is frozen, and a test knows its hash.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterable
from itertools import chain, islice
from pathlib import Path

import numpy as np
from niwaki.targets import drawings
from niwaki.targets.drawing import lowest
from numpy.typing import NDArray
from PIL import Image

from drawings.outlines import LETTERS, OTHERS, glyphs, letters, silhouette
from drawings.scribbles import START, scribble

Page = dict[str, NDArray[np.uint8]]

#: How many scribbles are for training, and how many are held out.
TRAINING, HELD_OUT = 160, 60
#: As many glyphs as the dissertation had.
GLYPHS = 197
FONTS = ("lobster.otf", "leckerli.ttf", "pacifico.woff2", "oleo.woff2")
#: Letters and figures of this one fill the page up.
LAST_FONT = "kaushan.otf"

#: Chosen by eye, in one piece, easy to tell.
SILHOUETTES = {
    "swan": "animals/birds/cigno_di_spalle_architet_01.svg",
    "dove": "animals/birds/dove_symbol.svg",
    "rooster": "animals/birds/gallo_di_profilo_archite_01.svg",
    "gull": "animals/birds/gull_marcelo_staudt_01.svg",
    "duck": "animals/birds/jonathon_s_duck_01.svg",
    "owl": "animals/birds/owl_on_branch_ganson.svg",
    "finch": "animals/birds/uccello_profilo_01_archi_01.svg",
    "beetle": "animals/bugs/c_rollandin_francesco_ar_01.svg",
    "butterfly": "animals/bugs/farfalla_contorno_archit_01.svg",
    "ant": "animals/bugs/formichina_architetto_fr_01.svg",
    "dragonfly": "animals/bugs/libellula_architetto_fra_01.svg",
    "snail": "animals/bugs/lumaca_architetto_france_01.svg",
    "spider": "animals/bugs/ragnetto_incazzato_archi_01.svg",
    "dragon": "animals/dinosaurs/dino_architetto_francesc_02.svg",
    "longneck": "animals/dinosaurs/dino_architetto_francesc_04.svg",
    "triceratops": "animals/dinosaurs/dinosauri_architetto_fra_02.svg",
    "angelfish": "animals/fish/altum_angelfish_01.svg",
    "dolphin": "animals/fish/dolphin_enrique_meza_c_02.svg",
    "gecko": "animals/lucertolona_architetto_f_01.svg",
    "cheetah": "animals/mammals/big_cats/contour_cheetah.svg",
    "kangaroo": "animals/mammals/canguro_architetto_franc_01.svg",
    "rabbit": "animals/mammals/coniglio_architetto_fran_01.svg",
    "baboon": "animals/mammals/contour_baboon.svg",
    "camel": "animals/mammals/contour_camel.svg",
    "elephant": "animals/mammals/contour_elephant.svg",
    "giraffe": "animals/mammals/contour_giraffe.svg",
    "deer": "animals/mammals/deer_matt_todd_01.svg",
    "horse": "animals/mammals/horses/cavallo_architetto_franc_02.svg",
    "cat": "animals/mammals/housecats/gatto_cat_architetto_fra_04.svg",
    "cow": "animals/mammals/vacca_pezzata_rossa_val_01.svg",
    "penguin": "animals/pinguino_col_piccolo_arc_01.svg",
    "maple": "plants/fall_coloured_leaf_geral_01.svg",
    "tree": "plants/fall_coloured_tree_geral_01.svg",
    "sakura": "plants/flowers/sakura_01.svg",
    "fir": "plants/trees/christmas_tree_mo_01.svg",
}

#: Where the lowest point was not where one would begin, seen on a contact sheet: (x, y) from the lower left corner.
BY_EYE: dict[str, tuple[float, float]] = {}


def scribbles() -> Iterable[tuple[str, NDArray[np.uint8]]]:
    """The scribbles of one seed, the held-out ones last."""
    dice = np.random.default_rng(6)
    return ((f"{number:03}", scribble(dice)[0]) for number in range(TRAINING + HELD_OUT))


def font_glyphs(folder: Path) -> Page:
    """The glyphs of all fonts by names such as `lobster-B`; capitals and small letters differ."""
    page: Page = {}
    for font in FONTS:
        page |= _named(font, glyphs(folder / font, LETTERS + OTHERS))
    filling = _named(LAST_FONT, glyphs(folder / LAST_FONT, LETTERS)).items()
    return page | dict(islice(filling, GLYPHS - len(page)))


def _named(font: str, shapes: Page) -> Page:
    stem = font.partition(".")[0]
    return {
        f"{stem}-{character if character.isascii() and character.isalnum() else f'u{ord(character):04x}'}": ink
        for character, ink in shapes.items()
    }


def start_of(name: str, greys: NDArray[np.uint8]) -> tuple[float, float]:
    """Where a model starts, from the lower left corner."""
    collection = name.partition("/")[0]
    return START if collection == "scribbles" else BY_EYE.get(name, lowest(greys < 255))


def main(fonts: Path, clip_art: Path) -> None:
    """Write the pages and the table."""
    place = Path(drawings.__file__).parent
    shapes = {name: silhouette(clip_art / file) for name, file in SILHOUETTES.items()}
    pages = {
        "scribbles": dict(scribbles()),
        "glyphs": font_glyphs(fonts),
        "letters": letters(fonts / "dejavu.ttf", LETTERS[:26] + LETTERS[52:]),
        "silhouettes": {name: ink for name, ink in shapes.items() if ink is not None},
    }
    with (place / "table.csv").open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["name", "cell", "x", "y", "ahead_x", "ahead_y", "use"])
        for collection, page in pages.items():
            _write(place / f"{collection}.png", list(page.values()))
            for cell, (name, greys) in enumerate(page.items()):
                name = f"{collection}/{name}"
                x, y = start_of(name, greys)
                use = "training" if collection == "scribbles" and cell < TRAINING else "held-out"
                rows.writerow([name, cell, f"{x:.4f}", f"{y:.4f}", 0, 1, use])


def _write(path: Path, cells: list[NDArray[np.uint8]]) -> None:
    """All cells on one page, row by row."""
    side, across = cells[0].shape[0], drawings.ACROSS
    rows = -(-len(cells) // across)
    white = np.full((side, side), 255, dtype=np.uint8)
    filled = list(chain(cells, [white] * (rows * across - len(cells))))
    lines = [np.concatenate(filled[k * across : (k + 1) * across], axis=1) for k in range(rows)]
    Image.fromarray(np.concatenate(lines)).save(path, optimize=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
