"""Partial runs that became impossible while others lived are counted once each, and their parts are named."""

from __future__ import annotations

import niwaki as nw
import pytest
from niwaki.lang.labels import Labels
from niwaki.result.info import Losses, restored_info, stored_info


@nw.model
def crossing(limit):
    """A road; a cable that runs into it with probability 1/2; a gate that its condition refuses with 1/4; a roof."""
    nw.emit(nw.box((0.0, 0.0, 0.0), (2.0, 1.0, 2.0)), name="road")
    nw.emit(nw.box((nw.uniform(-3.0, 3.0), 0.0, 0.0), (1.0, 1.0, 1.0)), name="cable")
    nw.condition(nw.uniform(0.0, 1.0) < limit)
    nw.emit(nw.box((0.0, 9.0 + nw.uniform(0.0, 1.0), 0.0), (1.0, 1.0, 1.0)))


def searched(limit=1.0, **settings):
    method = nw.smc(**settings)
    return nw.run(crossing, limit, method=method, score=nw.no_self_intersection(), seed=1)


def test_each_particle_that_died_is_counted_once_by_what_it_broke():
    result = searched(0.75, particles=300, ess=0.0)
    # Without resampling those that died are in the result.
    dead = sum(sample.log_score == -float("inf") for sample in result)
    losses = result.info.losses
    assert losses.total == dead > 0
    causes = dict(losses.causes)
    assert len(causes) == 2 and all(
        sample == "no_self_intersection" or "condition" in sample for sample in causes
    )
    # 150 of 300 and then 37.5, each within five standard deviations: false alarms once in a million.
    assert (
        abs(causes["no_self_intersection"] - 150) < 44
        and abs(dead - causes["no_self_intersection"] - 37) < 30
    )


def test_the_two_parts_are_named_with_their_lines():
    losses = searched(particles=60).info.losses
    (blame,) = losses.blame
    assert (blame.part.name(Labels()), blame.other.name(Labels())) == ("cable", "road")
    assert blame.runs == losses.looked_at == losses.total
    lines = [blame.part.span[0], blame.other.span[0]]
    count = losses.total
    assert str(losses) == (
        f"lost on the way: {count} partial runs, by no_self_intersection ({count}); "
        f'"cable" (line {lines[0]}) runs into "road" (line {lines[1]}) in {count} of {count}'
    )
    assert lines[0] == lines[1] + 1


def test_of_many_some_are_looked_at_evenly():
    losses = searched(particles=3000, populations=2).info.losses
    assert 25 <= losses.looked_at <= 50 < losses.total
    assert losses.blame[0].runs == losses.looked_at and "that were looked at" in str(losses)


def test_losses_of_several_populations_are_summed():
    first, second = (searched(0.5, particles=n).info.losses for n in (60, 40))
    both = Losses.of_several([first, second])
    assert both.total == first.total + second.total and both.looked_at == first.looked_at + second.looked_at
    assert both.blame[0].runs == first.blame[0].runs + second.blame[0].runs
    assert Losses.of_several([first, Losses()]) == first


def test_nothing_is_said_where_nothing_is_lost():
    result = nw.run(crossing, 1.0, method=nw.smc(20), seed=1)
    assert result.info.losses == Losses() and str(result.info.losses) == ""


def test_they_are_stored_with_the_statistics():
    info = searched(particles=100).info
    assert restored_info(stored_info(info)) == info


def test_a_search_for_the_best_has_them_too():
    settings = {"method": nw.improve(rounds=2), "score": nw.no_self_intersection(), "seed": 1}
    result = nw.run(crossing, 1.0, **settings)
    assert result.info.losses.blame[0].part.name(Labels()) == "cable"
    assert result.info == nw.run(crossing, 1.0, **settings, threads=1).info
    assert restored_info(stored_info(result.info)) == result.info


@pytest.mark.parametrize("threads", [1, 2])
def test_threads_do_not_matter(threads):
    method = nw.smc(400)
    score = nw.no_self_intersection()
    result = nw.run(crossing, 0.5, method=method, score=score, seed=2, threads=threads)
    assert result.info.losses == nw.run(crossing, 0.5, method=method, score=score, seed=2).info.losses
