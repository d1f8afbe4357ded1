"""Labels: what a person reads for a choice, a part, a call or an iteration."""

import pkgutil

import niwaki as nw
import pytest
from niwaki import gallery, search
from niwaki.errors import ModelError
from niwaki.lang import nouns
from niwaki.lang.labels import Labels
from niwaki.words import Uniform

#: Gallery models whose every run takes long.
SLOW = {"pipes", "gnarly-tree", "downtown", "furniture"}
MODELS = [m.name.replace("_", "-") for m in pkgutil.iter_modules(gallery.__path__)]


def labelled(model, seeds=range(6)):
    """Labels of all addresses of some runs."""
    labels = {}
    for seed in seeds:
        best = nw.run(model, seed=seed).best
        addresses = [*best.choices, *(part.address for part in best.parts)]
        labels |= {address: best.label(address) for address in addresses}
    return labels


@nw.model
def village():
    if nw.flip(0.5):
        tower(2.0)
    if not nw.flip(0.5):
        moat()
    for i in range(nw.poisson(3.0)):
        storey(nw.uniform(2.0, 3.0), i)
    size = (nw.uniform(1.0, 2.0), nw.uniform(1.0, 2.0), 1.0)
    wide, deep = nw.uniform(1.0, 2.0), nw.uniform(1.0, 2.0)
    nw.emit(nw.box((0.0, 0.0, 0.0), (nw.uniform(1.0, 2.0), nw.uniform(1.0, 2.0), wide)))
    nw.emit(nw.box((0.0, 0.0, deep), size), name="door_step")
    nw.emit(nw.cylinder((0.0, 0.0, 0.0), 1.0, height()))
    while nw.flip(0.4):
        tower(1.0)
    return nw.uniform(0.0, 1.0)


def tower(tall):
    nw.emit(nw.box((0.0, 0.0, 0.0), (1.0, 1.0, tall)))
    if nw.flip(0.5):
        return
    spread = nw.uniform(0.0, 1.0)
    nw.emit(nw.box((0.0, spread, 0.0), (1.0, 1.0, tall)))


def moat():
    nw.future(bridge, nw.uniform(3.0, 4.0))


def bridge(span):
    rail = [nw.uniform(0.0, span) for _ in range(2)]
    nw.emit([nw.box((at, 0.0, 0.0), (1.0, 1.0, 1.0)) for at in rail])


def storey(high, number):
    nw.emit(nw.box((0.0, number, 0.0), (1.0, high, 1.0)))


def height():
    return nw.uniform(1.0, 2.0)


def test_labels_say_what_a_choice_decides():
    labels = labelled(village)
    expected = {
        "bernoulli": "Tower?",
        "bernoulli#1": "No moat?",
        "poisson": "Number of storeys",
        "i[0]/uniform": "Storey 1 › high",
        "i[1]/storey/emit": "Storey 2 › box",
        "size": "Size 1",
        "size#1": "Size 2",
        "uniform": "Wide",
        "uniform#1": "Deep",
        "uniform#2": "Size x",
        "uniform#3": "Size y",
        "emit": "Box",
        "door_step": "Door step",
        "emit#1": "Cylinder",
        "height/uniform": "Height › height",
        "while[0]/bernoulli": "Tower 1 › another tower?",
        "while[0]/tower/bernoulli": "Tower 1 › stop?",
        "tower/emit": "Tower › box 1",
        "tower/emit#1": "Tower › box 2",
        "moat/uniform": "Moat › span",
        "moat/bridge/_[1]/rail": "Moat › bridge › rail 2",
        "uniform#4": "Village",
    }
    assert {address: labels.get(address) for address in expected} == expected


@nw.model
def signposts(label_of=1):
    x = nw.uniform(0.0, 1.0, label="east side")
    leg(0.1, label="left leg")
    nw.future(leg, 0.2, label="right leg")
    nw.emit(nw.box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), name="slab", label="The slab")
    y = nw.sample(Uniform(0.0, 1.0), label="y of it") + nw.choose([1, 2], label="roof")
    for i in range(2):
        leg(x * i, label="back leg")
    return named(y, label="an argument") + label_of


def leg(angle):
    nw.emit(nw.cylinder((0.0, 0.0, 0.0), 0.1, 1.0 + 0.1 * nw.uniform(0.0, 1.0)))
    return angle


def named(x, label):
    return x + nw.uniform(0.0, len(label))


def test_a_given_label_is_a_label_and_nothing_else():
    labels = labelled(signposts, [1])
    assert labels == {
        "x": "East side",
        "leg/uniform": "Left leg › length",
        "leg#1/uniform": "Right leg › length",
        "y": "Y of it",
        "y#1": "Roof",
        "i[0]/leg/uniform": "Back leg 1 › length",
        "i[1]/leg/uniform": "Back leg 2 › length",
        "named/uniform": "Named › named",
        "leg/emit": "Left leg › cylinder",
        "leg#1/emit": "Right leg › cylinder",
        "slab": "The slab",
        "i[0]/leg/emit": "Back leg 1 › cylinder",
        "i[1]/leg/emit": "Back leg 2 › cylinder",
    }
    # Plain Python makes the same run, and `choose` draws as without a label.
    best = nw.run(signposts, seed=1).best
    assert nw.run_python(signposts, choices=best.choices).choices == best.choices
    assert best.families["y#1"] == "discrete_uniform"


def test_a_computed_label_is_refused():
    @nw.model
    def model(side):
        return nw.uniform(0.0, 1.0, label=f"width of {side}")

    with pytest.raises(ModelError, match="label-text"):
        nw.run(model, "left", seed=1)


@nw.model
def rows():
    for i in range(2):
        pane(i)
    for k in range(2):
        pane(k)
    pane(0)
    if nw.flip(0.5):
        depth = nw.uniform(0.0, 1.0)
    else:
        depth = nw.uniform(1.0, 2.0)
    depth = depth + nw.uniform(0.0, 1.0)
    for row in range(2):
        pane(row)
        bar(row)
    return depth


def pane(at):
    nw.emit(nw.box((at, 0.0, 0.0), (1.0, 1.0, 1.0)))


def bar(at):
    nw.emit(nw.box((at, 0.0, 0.0), (1.0, 1.0, 1.0)))


def test_equal_labels_are_numbered_where_a_run_can_have_them_together():
    labels = labelled(rows)
    assert [labels[address] for address in ("i[0]/pane/emit", "k[1]/pane/emit", "pane/emit")] == [
        "First pane 1 › box",
        "Second pane 2 › box",
        "Pane › box",
    ]
    assert labels["row[1]/bar/emit"] == "Row 2 › bar › box"
    # A run has the first or the second, and the third.
    assert (labels["depth"], labels["depth#1"], labels["depth#2"]) == ("Depth 1", "Depth 1", "Depth 2")


@pytest.mark.parametrize("name", [name for name in MODELS if name not in {"data", "furnishings"} | SLOW])
def test_no_two_choices_of_a_run_have_the_same_label(name):
    best = nw.run(gallery.entry(name).model, seed=1).best
    labels = [best.label(address) for address in best.choices]
    assert len(set(labels)) == len(labels)
    assert not any("emit" in label or "while" in label or "bernoulli" in label for label in labels)


def test_the_ship_reads_as_in_the_manual():
    ship = gallery.entry("spaceship").model
    labels = ship.labels
    assert labels.label("while[0]/wings/while[1]/width") == "Wing 1 › section 2 › width"
    assert (labels.label("while[0]"), labels.label("while[0]/wings")) == ("Section 1", "Wing 1")
    assert labels.short("while[0]/wings/while[1]") == "section 2"
    # Either arm of an `if` has a length: a run has only one of the two.
    assert labels.label("while[0]/length") == labels.label("while[0]/length#1") == "Section 1 › length"
    assert labels.site("wings/while#0", "width") == "Wings › section › width"
    explained = search.explain(ship, "width", seed=1)
    assert explained["label"] == labels.label(explained["path"])
    assert explained["activations"][1][0] == "section 1"


def test_an_address_without_a_source_has_the_words_of_its_components():
    labels = Labels()
    assert labels.label("while[0]/wings/while[1]/width") == "Wing 1 › step 2 › width"
    assert labels.label("tower_top/bernoulli#1") == "Tower top › flip 2"
    assert labels.label("color(3)/hue") == "Color 3 › hue"
    # A stored search has the core form alone.
    stored = nw.Search.of_data(nw.Search(village, seed=1).data())
    assert stored.run().best.label("i[0]/storey/emit") == "Storey 1 › part"


@pytest.mark.parametrize(
    ("one_noun", "many"),
    [("storey", "storeys"), ("box", "boxes"), ("leaf", "leaves"), ("lobby", "lobbies"), ("glass", "glasses")],
)
def test_plurals(one_noun, many):
    assert (nouns.plural(one_noun), nouns.singular(many), nouns.plural(many)) == (many, one_noun, many)
    assert nouns.singular(one_noun) == one_noun


def test_words_of_names():
    assert nouns.words("box_section") == nouns.words("boxSection") == "box section"
    assert [nouns.ordinal(n) for n in (1, 10, 11, 22, 113)] == ["first", "tenth", "11th", "22nd", "113th"]
