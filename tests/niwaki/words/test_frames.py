"""`look`: a frame at right angles, the same in a plain run and in the engine; a statement lasts; errors say where."""

import pytest
from niwaki import ModelError, ModelFault, forward, look, model, run, run_python, vec
from niwaki.lang.lower import lower
from niwaki.lang.marks import underlying
from niwaki.words import Frame


def test_up_is_chosen_and_made_perpendicular() -> None:
    assert look((1, 2), (0, 3)) == Frame(vec(1, 2, 0), vec(0, 1, 0), vec(0, 0, 1), 1.0)
    assert look((1, 2, 3), (2.0, 0.0, 0.0)).up == vec(0, 1, 0)
    assert look((1, 2, 3), (0.0, -2.0, 0.0)).up == vec(0, 0, 1)
    assert look((0, 0, 0), (0, 0, 1), up=(0, 0.5, 3)).up == vec(0, 1, 0)


@model
def no_direction():
    """Looks nowhere."""
    look((0.0, 0.0), (0.0, 0.0))


@model
def along():
    """Up lies along the direction."""
    return look((0.0, 0.0), (0.0, 1.0), (0.0, 2.0)).up


@model
def four_numbers():
    """Too many numbers."""
    look((0.0, 0.0, 0.0, 1.0), (0.0, 1.0))


@pytest.mark.parametrize(
    ("wrong", "code", "message"),
    [
        (no_direction, "bad-argument", "`look`: a direction has the length 0"),
        (along, "bad-argument", "`look`: `up` lies along `forward`"),
        (four_numbers, "type-mismatch", "`look` takes points and directions of 2 or 3 numbers, found"),
    ],
    ids=["no direction", "along", "four numbers"],
)
def test_wrong_values_are_reported_at_the_call(wrong, code, message) -> None:
    for go in (lambda: run_python(wrong, seed=1), lambda: run(wrong, forward(1), seed=1)):
        with pytest.raises(ModelFault) as fault:
            go()
        assert fault.value.code == code
        assert message in str(fault.value) and "^^^^" in str(fault.value)


@model
def one_argument():
    """No direction."""
    look((0.0, 0.0))  # type: ignore[call-arg]


def test_wrong_arguments_are_refused() -> None:
    with pytest.raises(ModelError, match="`look` takes 2 to 3 arguments, found 1"):
        run(one_argument, forward(1), seed=1)


@model
def twice():
    """A statement, and a value."""
    look((0.0, 0.0), (0.0, 1.0))
    ahead = look((1.0, 0.0), (0.0, 1.0))
    return ahead.center


def test_a_statement_assigns_a_variable_that_has_no_name() -> None:
    text = lower(underlying(twice)).text
    sets = [line.split("$")[1].split()[0] for line in text.splitlines() if "(record" in line]
    assert sets == ["%look", "ahead"]
