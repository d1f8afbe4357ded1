"""A chain can run without end: its totals stay exact, and its memory stays constant.

At every stop the totals that millions of proposals added to and took from are those of a fresh evaluation of the same
choices, to the bit; the sketch of the volume, which the chain only ever changed, is that of the scene built again.
Densities are multiples of 2^-32 nats, and their sums are exact in any order and of any size.
"""

from pathlib import Path

import niwaki as nw
import pytest
from niwaki import kernels
from niwaki.gallery.gmm import gmm
from niwaki.gallery.gnarly_tree import gnarly_tree
from niwaki.targets.examples import bent_tube
from niwaki.words import Gaussian, gaussian, observe, uniform

MIXTURE = kernels.mixture(
    kernels.on("means", kernels.drift(0.02)),
    kernels.on(["weights", "deviations", "k"], kernels.prior()),
    weights=[4, 105],
)
MOVES = kernels.mixture(kernels.prior(), kernels.drift(), kernels.regenerate(), weights=[8, 8, 1])


def subjects():
    """Models with their arguments, kernel and score."""
    return {
        "mixture": (gmm, (100,), MIXTURE, None),
        "tree": (gnarly_tree, (0.2,), MOVES, nw.match_volume(bent_tube(), 0.4)),
    }


def resident():
    """Bytes of this process in memory."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


def goes_on(name, stops, proposals, watch):
    """Go on from stop to stop, and compare at each; `watch` is given the chain after each."""
    model, args, kernel, score = subjects()[name]
    chain = nw.run(
        model, *args, method=nw.mh(steps=1, keep=0, kernel=kernel), score=score, seed=11, threads=1
    )
    scores = set()
    for _ in range(stops):
        chain.more(proposals)
        now = chain.last[0]
        fresh = nw.run(model, *args, choices=now.choices, score=score).best
        assert (now.log_score, now.log_prior) == (fresh.log_score, fresh.log_prior)
        assert len(now.choices) == chain.counters["choices"]
        scores.add(now.log_score)
        watch(chain)
    assert len(scores) > stops // 2, "the chain hardly moved"


@pytest.mark.parametrize("name", ["mixture", "tree"])
def test_totals_are_exact(name):
    goes_on(name, 4, 2_000, lambda _: None)


@nw.model
def far_away():
    """A first state is 10^17 nats below the last, which a sum of `f64` does not forget."""
    x = uniform(-1, 1)
    y = gaussian(0, 1)
    observe(Gaussian(x, 1e-9), 0.0)
    observe(Gaussian(y, 1.0), 1.234)


@pytest.mark.parametrize("strategy", ["rerun", "resume", "cache", "c3"])
def test_totals_are_exact_of_terms_of_any_size(strategy):
    method = nw.mh(20_000, warmup=8_000, kernel=kernels.drift(0.5), chains=4, strategy=strategy)
    chains = nw.run(far_away, method=method, seed=3)
    for state in [*chains.last, chains.best]:
        fresh = nw.run(far_away, choices=state.choices).best
        assert (state.log_score, state.log_prior) == (fresh.log_score, fresh.log_prior)


@pytest.mark.soak
@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="memory is read from Linux's /proc")
@pytest.mark.parametrize("name", ["mixture", "tree"])
def test_ten_million_proposals(name):
    held, room = [], []

    def watch(chain):
        held.append(resident())
        room.append(chain.counters["bytes"])

    goes_on(name, 20, 500_000, watch)
    # A million proposals settle the allocator; the nine after them may not add a byte to each.
    assert max(held[2:]) - held[2] < 8 << 20, f"memory grew: {held}"
    # The mixture always has the same choices; a trace keeps the room of the largest tree that it was.
    assert name == "tree" or max(room[2:]) <= 1.05 * room[2], f"the trace grew: {room}"
