"""A drag that a number of the source explains is a change of the file: shown, and written when accepted."""

from __future__ import annotations

from importlib.util import module_from_spec, spec_from_file_location
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki.errors import InputError
from niwaki.gallery.spaceship import spaceship
from niwaki.search.drag import Dragging

MODEL = '''"""A chair."""

from niwaki import box, emit, gaussian, model, uniform, vec


@model
def chair(width: float = 2.0, count: int = 2):
    """A seat, a lamp and a shelf."""
    emit(box((width, 1.0, 0.0), (1, 0.2, 1)), name="seat")
    x = gaussian(3.0, 0.5)
    emit(box((x, 4.0, -0.5), (1, 1, 1)), name="lamp")
    emit(box(vec(0.0, 7.0, uniform(0.0, 1.0)), (1, 1, 1)), name="shelf")
'''


@pytest.fixture
def chair(tmp_path):
    """A function that reads the model's file, and the file."""
    place = tmp_path / "chair.py"
    place.write_text(MODEL)

    def read(**arguments: Any) -> Any:
        spec = spec_from_file_location("chair_of_a_test", place)
        module = module_from_spec(spec)
        spec.loader.exec_module(module)
        return nw.run(module.chair, seed=1, **arguments).best

    return read, place


def middle(sample, part):
    (block,) = [candidate for candidate in sample.parts if candidate.address == part]
    low, high = block.shapes[0].aabb()
    return (np.array(low) + high) / 2


def changes(sample, part, by):
    return Dragging(sample.search, sample, part).source(middle(sample, part) + by)


def test_a_default_is_offered_and_written(chair):
    read, place = chair
    sample = read()
    first = changes(sample, "seat", [0.5, 0.0, 0.0])[0]
    assert first.description == "line 7: 2.0 becomes 2.5"
    assert first.arguments == {"width": 2.5}
    assert first.choices == {}
    assert (
        "-def chair(width: float = 2.0, count: int = 2):\n+def chair(width: float = 2.5, count"
        in first.difference()
    )
    assert place.read_text() == MODEL
    first.apply()
    assert place.read_text() == MODEL.replace("2.0, count", "2.5, count")
    np.testing.assert_allclose(middle(read(), "seat"), [2.5, 1.0, 0.0])


def test_a_default_that_is_not_used_is_not_offered(chair):
    assert changes(chair[0](width=1.0), "seat", [0.5, 0.0, 0.0]) == []


def test_the_mean_of_a_choice_explains_its_value(chair):
    sample = chair[0]()
    x = sample.choices["x"]
    first = changes(sample, "lamp", [0.42, 0.0, 0.0])[0]
    assert first.description == "line 10: 3.0 becomes 3.42"
    assert first.choices["x"] == pytest.approx(x + 0.42)


def test_the_numbers_of_a_tuple_change_together(chair):
    first = changes(chair[0](), "shelf", [0.25, -0.5, 0.0])[0]
    assert first.description == "line 12: 0.0 becomes 0.25; line 12: 7.0 becomes 6.5"
    assert first.share < 1e-3


def test_a_literal_position_moves_along_its_own_axis_only(chair):
    edits = changes(chair[0](), "lamp", [0.0, 0.5, 0.0])
    assert [change.description for change in edits] == ["line 11: 4.0 becomes 4.5"]


def test_a_file_that_was_edited_is_not_written(chair):
    read, place = chair
    first = changes(read(), "seat", [0.5, 0.0, 0.0])[0]
    place.write_text(MODEL + "# edited\n")
    with pytest.raises(InputError, match="edited-meanwhile"):
        first.apply()
    assert place.read_text() == MODEL + "# edited\n"


def test_models_of_the_package_are_not_changed():
    sample = nw.run(spaceship, seed=1).best
    assert Dragging(sample.search, sample, sample.parts[0].address).source((0.1, 0.0, 0.1)) == []
