"""The forms of a bench model are equivalent: equal choices have equal densities, in plain Python and on the engine."""

import niwaki as nw
import pytest
from models import gmm_forms, hmm_forms

SIZE = 12


def values(run):
    """The values of a run's choices, in the order in which they were made."""
    return list(run.choices.values())


@pytest.mark.parametrize("forms", [hmm_forms.FORMS, gmm_forms.FORMS], ids=["hmm", "gmm"])
def test_forms_mean_the_same(forms):
    first = next(iter(forms.values()))
    known = nw.run(first, SIZE, seed=5).best
    assert len(values(known)) == len(set(known.choices)) > SIZE - 1
    for name, form in forms.items():
        addresses = list(nw.run(form, SIZE, seed=1).best.choices)
        choices = dict(zip(addresses, values(known), strict=True))
        there = nw.run(form, SIZE, choices=choices).best
        here = nw.run_python(form, SIZE, choices=choices)
        assert (there.log_prior, there.log_score) == (known.log_prior, known.log_score), name
        assert (here.log_prior, here.log_score) == (known.log_prior, known.log_score), name
        assert str(here.value) == str(there.value), name
        assert here.queries == there.queries, name
