"""Addresses by labels, and what a message says where a text is neither."""

import re

import niwaki as nw
import pytest
from niwaki import gallery
from niwaki.errors import InputError, ModelError, ModelFault
from niwaki.lang import lookup


def roof(kind, wide):
    high = nw.uniform(0.4, 1.0)
    nw.emit(nw.box((0.0, wide, 0.0), (wide, high, 2.0)), name="tiles")


@nw.model
def house():
    wall = nw.uniform(2.0, 4.0)
    roof(nw.choose(["gable", "hip"]), wall)
    roof(nw.choose(["gable", "hip"]), wall + 1.0)
    for i in range(3):
        roof("flat", nw.uniform(2.0, wall + i))


HELD = (
    ("Wall", "wall"),
    ("kind 2", "discrete_uniform#1"),
    ("  KIND   2 ", "discrete_uniform#1"),
    ("Roof 2 › high", "roof#1/high"),
    ("roof 2 > high", "roof#1/high"),
    ("Section 3 › roof > high", "i[2]/roof/high"),
    ("i[2]/roof/high", "i[2]/roof/high"),
)


def refused(text):
    with pytest.raises(InputError) as caught:
        nw.Search(house, hold={text: 1.0}).task  # noqa: B018
    return str(caught.value)


@pytest.mark.parametrize("name", ["castle", "village-house"])
def test_every_label_of_a_run_is_a_name_of_its_choice(name):
    model = gallery.entry(name).model
    single = 0
    for address in nw.run(model, seed=2).best.choices:
        assert model.labels.is_possible(address)
        label = model.labels.label(address)
        named = lookup.choices_named(model.labels, label)[0]
        # Only choices of which a run has one have a label in common.
        assert address in named and {model.labels.label(other) for other in named} == {label}
        if len(named) == 1:
            single += 1
            assert lookup.resolved({label: 1.0}, model.labels, name) == {address: 1.0}
    assert single > 2


def test_a_label_holds_its_choice():
    sample = nw.run(house, seed=1).best
    labels = {address: sample.label(address) for address in sample.choices}
    for text, address in HELD:
        text = labels[address] if text.startswith("Section") else text
        assert nw.Search(house, hold={text: 1.0}).held == {address: 1.0}, text
    held = nw.run(house, seed=1, hold={"Roof 2 › high": 0.5, "kind 1": "hip"})
    assert held.best.choices["roof#1/high"] == 0.5 and held.best.choices["discrete_uniform"] == "hip"
    text = held.best.search.json()
    assert '"roof#1/high"' in text and "Roof 2" not in text


def test_a_name_of_several_choices_is_refused_with_their_addresses():
    assert "`discrete_uniform` (Kind 1), `discrete_uniform#1` (Kind 2)" in refused("kind")
    text = refused("high")
    assert "`roof/high` (Roof 1 › high), `roof#1/high`" in text and "`i[1]/roof/high`" in text
    with pytest.raises(InputError, match="ambiguous-label"):
        nw.run(house, seed=1).distribution("kind")
    assert nw.run(house, seed=1).distribution("Kind 2") == nw.run(house, seed=1).distribution(
        "discrete_uniform#1"
    )


def test_two_names_of_a_choice_with_two_values_are_refused():
    with pytest.raises(InputError, match="`wall=2.0` and `Wall=3.0`"):
        nw.run(house, hold={"wall": 2.0, "Wall": 3.0})
    assert nw.Search(house, hold={"wall": 2.0, "Wall": 2.0}).held == {"wall": 2.0}


def test_a_message_names_the_nearest_addresses_with_their_labels():
    assert "the nearest are `wall`, " in refused("walll") and "(Kind 1)" in refused("kinds 1")
    assert "`roof#1/high` (Roof 2 › high)" in refused("Roof 2 › hight")
    sample = nw.run(house, seed=1).best
    with pytest.raises(InputError, match=r"the nearest are .*`roof/tiles` \(Roof 1 › tiles\)"):
        sample.held("roof/tyles")
    assert lookup.nearest(house.labels, "x", [], "part") == "there is no part"
    assert lookup.nearest(house.labels, "x", ["wall"], "part") == "the nearest is `wall`"


def test_labels_name_parts_that_are_held_or_grown_again():
    result = nw.run(house, seed=1)
    assert result.best.held("Roof 2") == result.best.held("roof#1")
    assert result.best.held("tiles") == result.best.held("roof", "roof#1", "i[*]/roof")
    again = result.best.regrow("Roof 2", 2, seed=3).best
    assert {path for path, value in again.choices.items() if value != result.best.choices[path]} == {
        "roof#1/high"
    }


def test_a_deep_call_is_found_by_its_whole_label_and_a_list_of_a_recursion_ends():
    @nw.model
    def bush(depth=20):
        length = nw.uniform(0.0, 1.0)
        if depth > 0:
            bush(depth - 1)
            bush(depth - 1)
        return length

    known = lookup.choices(bush.labels)
    assert len(set(known)) == len(known) == 1 + 2 + 4 and known[0] == "length"
    deep = ["bush 1", "bush 2"] * 6
    path = "/".join(["bush", "bush#1"] * 6) + "/length"
    assert bush.labels.label(path) == " › ".join(["Bush 1", *deep[1:], "length"])
    assert lookup.choices_named(bush.labels, " > ".join([*deep, "Length"])) == ([path], True)
    assert len(lookup.choices_named(bush.labels, "length")[0]) == 1
    assert len(lookup.choices_named(bush.labels, "bush > length")[0]) == 3


@pytest.mark.parametrize(
    ("dist", "value", "range_text"),
    [
        (nw.uniform, 7.0, "a number from 1 to 3"),
        (nw.discrete_uniform, 7, "a whole number from 1 to 3"),
        (nw.gamma, -1.0, "a number of at least 0"),
    ],
    ids=["uniform", "discrete", "gamma"],
)
def test_a_value_out_of_range_is_refused_with_the_range(dist, value, range_text):
    @nw.model
    def tower():
        wide = nw.uniform(1.0, 2.0)
        return dist(1, 3) * wide

    address = next(address for address in nw.run(tower, seed=1).best.choices if address != "wide")
    with pytest.raises(InputError) as caught:
        nw.run(tower, nw.smc(10), hold={address: value})
    text = str(caught.value)
    assert f"its value {value!r} is not {range_text}" in text and f"hold `{address}` at {range_text}" in text


def test_groups_take_labels_and_their_calls_are_numbered():
    @nw.model
    def table():
        nw.mirrored("x", roof, "flat", nw.uniform(1.0, 2.0), label="half")
        nw.arrayed([(0, 0, 0), (0, 1, 0)], roof, "flat", 1.0)
        nw.place((0, 5, 0), roof, "flat", 1.0, label="top")

    sample = nw.run(table, seed=1).best
    labels = [sample.label(address) for address in sample.choices]
    assert labels == [
        "Wide",
        "Half 1 › high",
        "Half 2 › high",
        "Roof 1 › high",
        "Roof 2 › high",
        "Top › high",
    ]
    assert nw.Search(table, hold={"Half 2 › high": 0.5}).held == {"mirrored[1]/roof/high": 0.5}
    assert nw.run_python(table, choices=sample.choices).choices == sample.choices


def test_words_in_place_of_a_function_or_a_list_are_refused_with_what_to_write():
    @nw.model
    def pair():
        nw.place((0, 1, 0), nw.mirrored, "x", roof, "flat", 1.0)

    @nw.model
    def kind():
        return nw.choose("gable", "hip")

    with pytest.raises(ModelError, match=re.escape('`lambda: nw.mirrored("x", roof, "flat", 1.0)`')):
        pair.program()
    with pytest.raises(ModelError, match=re.escape('`choose(["gable", "hip"])`')):
        kind.program()
    with pytest.raises(ModelFault, match=re.escape("`choose(['gable', 'hip'])`")):
        nw.run_python(kind, seed=1)


def test_a_word_that_a_file_does_not_import_is_refused_with_its_import():
    @nw.model
    def late():
        return nw.lerp(0.0, 1.0, 0.5)

    @nw.model
    def named():
        nw.emit(nw.box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), label="door"))

    with pytest.raises(ModelError, match="write `from niwaki.words import lerp`"):
        late.program()
    with pytest.raises(ModelError, match="give it to `emit`"):
        named.program()
