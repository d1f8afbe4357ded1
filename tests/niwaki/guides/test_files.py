"""Claim: a guide comes back from its file and from a search's JSON; what is none, or does not fit, gives a message."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import gallery, guides
from niwaki.errors import InputError
from niwaki.gallery.vines import WINDOW, vines
from niwaki.methods import Guide, importance, smc
from niwaki.search import Search, SearchWarning
from niwaki.search.shipped import FOLDER, names
from niwaki.targets import drawings
from specification import load

GOLDEN = Path(__file__).parents[2] / "golden"

MODEL = """
from niwaki import emit, flip, gaussian, look, model, stroke

@model
def m():
    side = flip(0.5)
    tall = gaussian(1.0, 0.1)
    emit(stroke((0, 0, 0), (1 if side else -1, tall, 0), 0.7, 0.4))
"""


def path(*changes: tuple[str, str]) -> nw.Model[..., Any]:
    """The model, with parts of its text replaced."""
    text = MODEL
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return load(text, f"path{len(changes)}.py")


def score() -> nw.Score:
    greys = np.full((12, 12), 255, dtype=np.uint8)
    greys[4:9, 2:8] = 0
    return nw.match_drawing(greys, ((-2.0, -1.0), (2.0, 3.0)), sigma=0.5)


@pytest.fixture(scope="module")
def guide() -> Guide:
    return guides.train_guide(
        path(),
        [0, 1],
        lambda _: score(),
        rounds=(10,),
        searches=(smc(10),),
        keep=lambda sample: True,
        training=guides.Training(steps=20, hidden=(8, 8)),
        seed=1,
    )


def test_a_guide_comes_back_from_its_file(guide: Guide, tmp_path: Path) -> None:
    guide.save(tmp_path / "path.guide")
    again = Guide.load(tmp_path / "path.guide")
    assert again == guide and again.hash == guide.hash and again.report == guide.report


def test_numbers_of_a_description_that_are_too_large_do_not_fit(guide: Guide) -> None:
    length = int.from_bytes(guide.data[:8], "little")
    header = json.loads(guide.data[8 : 8 + length])
    network = json.loads(header["__metadata__"]["niwaki"])
    about = json.loads(network["text"])
    about["sites"][0]["parameters"] = [2**32 - 1, 1]
    header["__metadata__"]["niwaki"] = json.dumps({**network, "text": json.dumps(about)})
    text = json.dumps(header).encode()
    with pytest.raises(InputError, match="does not fit its network"):
        Guide(len(text).to_bytes(8, "little") + text + guide.data[8 + length :])


def test_a_search_with_a_guide_as_json(guide: Guide) -> None:
    search = Search(path(), score=score(), method=smc(8, guide=guide), seed=5)
    again = Search.of_json(search.json())
    assert again.hash == search.hash
    assert [sample.choices for sample in again.run()] == [sample.choices for sample in search.run()]
    assert Search(path(), score=score(), method=smc(8), seed=5).hash != search.hash
    other = smc(8, guide=guide.with_report({"other": 1}))
    assert Search(path(), score=score(), method=other, seed=5).hash != search.hash


def test_the_guides_of_the_package_fit_and_are_small() -> None:
    assert {"lightning", "vines"} <= set(names())
    for name in names():
        entry = gallery.entry(name)
        assert entry is not None
        shipped = guides.shipped(entry.model)
        assert shipped is not None and (FOLDER / f"{name}.guide").stat().st_size < 300_000
        if entry.window is None:
            target = entry.target()
            assert target is not None
            search = Search(entry.model, score=nw.match_volume(target, entry.voxel))
        else:
            page = drawings.drawing("letters/E")
            search = Search(entry.model, page.place(entry.window), score=page.score(entry.window))
            assert shipped.report["rounds"][-1]["summary"]["stumps"] == 0.0
        assert shipped._engine.lost(search.task) == []
    assert guides.shipped(path()) is None and guides.shipped(gallery.entry("coral").model) is None  # type: ignore[union-attr]


def test_few_guided_particles_do_what_many_others_do_not() -> None:
    """Six drawings that are for training: ten particles with the guide, and fifty without."""

    def mean(**settings: Any) -> float:
        similarities = []
        for name in drawings.names("scribbles", "training")[:48:8]:
            page = drawings.drawing(name)
            result = nw.grow(vines, None, *page.place(WINDOW), score=page.score(WINDOW), seed=1, **settings)
            similarities.append(result.best.similarity)
        return float(np.mean(similarities))

    assert mean(guide=guides.shipped(vines), particles=10) > 0.75 > 0.65 > mean(particles=50)


def test_a_changed_model_keeps_what_matches_with_one_warning(guide: Guide) -> None:
    # The path has a choice less, one more, and a value of another name.
    changed = path(("side = flip(0.5)", "left = flip(0.5)"), ("1 if side", "1 if left"))
    with pytest.warns(SearchWarning) as record:
        nw.run(changed, score=score(), method=smc(30, guide=guide), seed=1)
    assert len(record) == 1
    text = str(record[0].message)
    for part in (
        "the guide of `m`",
        "does not know `left`",
        "has no `side`",
        "`tall` of `m` does not see `side`",
    ):
        assert part in text, text


def test_weights_that_collapse_are_told() -> None:
    page, shipped = drawings.drawing("scribbles/008"), guides.shipped(vines)
    search = Search(
        vines, page.place(WINDOW), score=page.score(WINDOW), method=importance(40, guide=shipped), seed=1
    )
    with pytest.warns(SearchWarning, match=r"1\.\d of 40 samples are effective"):
        search.run()


def test_the_errors_are_as_reviewed(guide: Guide, tmp_path: Path, reviewed: Any) -> None:
    half = tmp_path / "half.guide"
    half.write_bytes(guide.data[: len(guide.data) // 2])
    page = np.full((20, 20), 255, dtype=np.uint8)

    def loaded() -> None:
        try:
            Guide.load(half)
        except InputError as error:
            error.values["detail"] = error.values["detail"].replace(str(tmp_path), "FOLDER")
            raise

    other = load("from niwaki import flip, model\n\n@model\ndef m():\n    return flip(0.5)\n", "coin.py")
    reviewed(
        GOLDEN / "guides.txt",
        {
            "half of a file": loaded,
            "not a guide": lambda: Guide(b"a text"),
            "a later format": lambda: Guide(later(guide.data)),
            "another model": lambda: nw.run(other, smc(4, guide=guide), score=score(), seed=1),
            "another score": lambda: nw.run(path(), smc(4, guide=guide), seed=1),
            "no guide at all": lambda: smc(4, guide="vines.guide"),  # type: ignore[arg-type]
            "a target without ink": lambda: train(guide, page),
            "a target that is all ink": lambda: train(guide, np.zeros_like(page)),
            "one target": lambda: train(guide),
        },
    )


def test_the_usual_search_draws_by_the_guide_of_its_model() -> None:
    """Only the usual search, and only by a guide that is better in the same time and sees the target."""
    tree, ship = (gallery.entry(name).model for name in ("gnarly-tree", "spaceship"))  # type: ignore[union-attr]
    page, tube = drawings.drawing("scribbles/008"), "gallery:bent_tube"

    def draws(*args: Any, **settings: Any) -> Any:
        method = nw.search.grow_search(*args, seed=1, **settings).method
        return isinstance(method, nw.methods.Improve) and method.proposal is not None

    drawing = {"score": page.score(WINDOW)}
    assert (
        draws(tree, tube)
        and draws(tree, tube, diverse=3)
        and draws(vines, None, *page.place(WINDOW), **drawing)
    )
    assert not draws(ship, "gallery:ship") and draws(ship, "gallery:ship", guide=guides.shipped(ship))
    assert not draws(tree, tube, guide=None) and not draws(tree, tube, method=nw.improve())
    assert not draws(tree, tube, particles=10) and not draws(tree, score=nw.floor(0.0))


def later(data: bytes) -> bytes:
    """The guide's file as a later version would write it."""
    old = rb"\\\"format\\\":1"
    assert data.count(old) == 1
    return data.replace(old, old[:-1] + b"9")


def train(guide: Guide, *pages: np.ndarray[Any, Any]) -> None:
    """Train on these pages."""
    guides.train_guide(
        path(),
        [*pages, *pages],
        lambda page: nw.match_drawing(page, ((-2.0, -1.0), (2.0, 3.0))),
        start=guide,
        seed=1,
    )
