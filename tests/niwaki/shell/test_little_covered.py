"""The warning of a result that covers little of its target."""

import niwaki as nw
import pytest
from niwaki.errors import InputError
from niwaki.shell.grow import _too_little


@nw.model
def twigs():
    for i in range(3):
        nw.emit(nw.box((0.0, 2.0 * i, 0.0), (nw.uniform(0.2, 0.3), 0.2, 0.2)))


TARGET = nw.Target.of_shapes(nw.box((0.0, 2.0, 0.0), (6.0, 6.0, 6.0)))


@pytest.mark.parametrize(("voxel", "is_coarse"), [(1.0, True), (0.15, False)])
def test_cells_that_are_larger_than_the_parts_are_named(voxel, is_coarse):
    result = nw.run(twigs, nw.forward(1), score=nw.match_volume(TARGET, voxel), seed=1)
    text = _too_little(result)
    assert text.startswith("warning: the best run covers only")
    assert ("thinner than a cell of 1: try `--voxel 0.1`" in text) == is_coarse
    assert is_coarse or "--voxel" not in text
    # The run is 4.2 long, and the target 6.
    assert "same unit" not in text


def test_a_target_of_another_scale_is_named():
    large = nw.Target.of_shapes(nw.box((0.0, 20.0, 0.0), (60.0, 60.0, 60.0)))
    result = nw.run(twigs, nw.forward(1), score=nw.match_volume(large, 5.0), seed=1)
    assert "the run is 4.2 long, and the target 60: are both in the same unit?" in _too_little(result)


def test_an_unknown_example_is_refused_with_the_names():
    with pytest.raises(InputError, match="write one of amphora, armchair"):
        nw.Target.find("gallery:castle")
