"""The pictures of chapter 2's programs, made again by one command. The curves need matplotlib (extra `plots`).

    python benches/program_pictures.py docs/pictures

coin.png: the exact answer; hmm.png, lda.png, gmm.png, hlr.png: what the data say; cafe.png and cafe-plan.png: a
furnished room from the side and from above; palettes.png: three palettes at each of three stages; harmonies.png: three
chains through palettes whose scheme is a choice.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from niwaki import kernels
from niwaki.draw.picture import picture
from niwaki.draw.plan import plan
from niwaki.draw.swatches import ribbons, swatches
from niwaki.gallery import coin, furniture, gmm, harmonies, hlr, hmm, lda, palettes
from niwaki.methods import mh
from niwaki.result import Result
from niwaki.search import run
from numpy.typing import NDArray
from pictures import written
from PIL import Image

if TYPE_CHECKING:
    from matplotlib.axes import Axes

INK, PALE, WARM, COOL = "#54524e", "#c9c4ba", "#c8622d", "#4a6b6f"
HUES = ("#c8622d", "#4a6b6f", "#b59a3a", "#7a5a86")


def draw(folder: Path) -> list[Path]:
    """Draw every picture.

    Parameters
    ----------
    folder
        Made where it is missing.

    Returns
    -------
    list of Path
        The files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    room = run(furniture.coffee_shop, seed=2).scene
    made = {
        "coin": axes(coin_bars, run(coin.coin, method=coin.METHOD), (4.6, 2.9)),
        "hmm": axes(state_shares, run(hmm.hmm, method=hmm.METHOD, seed=1), (9.0, 3.4)),
        "lda": axes(topic_shares, run(lda.lda, method=lda.METHOD, seed=1), (9.0, 3.4)),
        "gmm": axes(cluster_curves, run(gmm.gmm, method=gmm.METHOD, seed=1), (9.0, 3.4)),
        "hlr": axes(fitted_lines, run(hlr.hlr, method=hlr.METHOD, seed=1), (9.0, 3.8)),
        "cafe": picture(room, elevation=46.0, azimuth=24.0, size=(960, 640), margin=0.03),
        "cafe-plan": plan(room, furniture.ROOM, width=880),
        "palettes": stages(),
        "harmonies": harmony_ribbons(),
    }
    return [written(folder / f"{name}.png", image) for name, image in made.items()]


def stages() -> Image.Image:
    """Figure 2.4: three palettes at each stage, each from a search of its own."""
    columns = {
        "any colours": [run(palettes.wild, seed=seed).value for seed in (1, 2, 3)],
        "pastel, told apart": best_of(palettes.pastel),
        "split-complementary, with shades": best_of(palettes.harmonious),
    }
    return swatches(columns)


def harmony_ribbons() -> Image.Image:
    """The same number of states of three chains, whose kernels can do more and more."""
    moves = {
        "Metropolis-Hastings": kernels.prior(),
        "discrete choices by Metropolis-Hastings, real ones along their gradient": harmonies.BOTH,
        "the same at six temperatures": harmonies.KERNEL,
    }
    rows = {}
    for title, kernel in moves.items():
        method = mh(steps=40_000, warmup=8_000, thin=100, kernel=kernel)
        rows[title] = [sample.value[1] for sample in run(harmonies.harmonies, method=method, seed=1)]
    return ribbons(rows)


def best_of(model: Any) -> list[Any]:
    """The best palette of each of three searches."""
    return [run(model, method=palettes.METHOD, seed=seed).value for seed in (1, 2, 3)]


def axes(paint: Callable[[Axes, Result], None], result: Result, inches: tuple[float, float]) -> Image.Image:
    """A picture by matplotlib, in the house's colours."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    settings: Any = {"font.size": 9.0, "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": PALE}
    settings |= {"xtick.color": INK, "ytick.color": INK, "axes.spines.top": False, "axes.spines.right": False}
    with matplotlib.rc_context(settings):
        figure, place = pyplot.subplots(figsize=inches, layout="constrained")
        paint(place, result)
        out = io.BytesIO()
        figure.savefig(out, dpi=120, facecolor="white", metadata={"Software": None})
        pyplot.close(figure)
    return Image.open(out)


def coin_bars(place: Axes, result: Result) -> None:
    """The exact distribution of the number of heads."""
    found = result.distribution()
    counts = sorted(found)
    place.bar([str(n) for n in counts], [found[n] for n in counts], color=COOL, width=0.6)
    for at, n in enumerate(counts):
        place.text(at, found[n] + 0.01, f"{found[n]:.3f}", ha="center")
    place.set(xlabel="heads, where one of the first two coins shows one", ylabel="probability")


def state_shares(place: Axes, result: Result) -> None:
    """How probable each state is at each step, and the states that made the data."""
    steps = len(result.best.value)
    shares = np.zeros((10, steps))
    for sample, weight in zip(result, result.weights, strict=True):
        shares[sample.value, np.arange(steps)] += weight
    place.imshow(shares, aspect="auto", cmap="Greys", vmin=0.0, vmax=0.7, origin="lower")
    place.plot(hmm.CHAIN.states[:steps], ".", color=WARM, markersize=4, label="the state that made the data")
    place.set(xlabel="step", ylabel="state")
    place.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), fontsize=8, frameon=False)


def topic_shares(place: Axes, result: Result) -> None:
    """The best sample's share of each topic in each document, as stacked bars; the largest topics first."""
    shares = np.array(result.value[1])
    order = np.argsort(-shares.sum(axis=0))
    bottom = np.zeros(len(shares))
    import matplotlib

    colors = matplotlib.colormaps["cividis"](np.linspace(0.05, 0.95, lda.TOPICS))
    for color, topic in zip(colors, order, strict=True):
        place.bar(range(len(shares)), shares[:, topic], bottom=bottom, color=color, width=0.7)
        bottom += shares[:, topic]
    place.set(xlabel="document", ylabel="share of each topic", xticks=range(len(shares)))


def cluster_curves(place: Axes, result: Result) -> None:
    """The points, the density of the best sample and its components."""
    weights, means, deviations = result.value
    x = np.linspace(-12.0, 13.0, 500)
    parts = [
        w * np.exp(-0.5 * ((x - m) / d) ** 2) / (d * np.sqrt(2.0 * np.pi))
        for w, m, d in zip(weights, means, deviations, strict=True)
    ]
    place.hist(gmm.POINTS[:100], bins=40, density=True, color=PALE, label="data")
    for color, part in zip(HUES, parts, strict=True):
        place.plot(x, part, color=color, linewidth=1.4)
    place.plot(x, np.sum(parts, axis=0), color=INK, linewidth=1.2, linestyle="--", label="best sample")
    place.set(xlabel="x", ylabel="density")
    place.legend(fontsize=8, frameon=False)


def fitted_lines(place: Axes, result: Result) -> None:
    """Each sequence with its fitted line, and the population's line."""
    lines = mean(result, lambda value: np.array(value[1]))
    intercept, slope = mean(result, lambda value: np.array(value[0]))[:2]
    x = np.array(hlr.TIMES)
    for n, (a, b) in enumerate(lines):
        color = HUES[n % len(HUES)]
        place.plot(x, hlr.SEQUENCES[n], ".", color=color, markersize=4, alpha=0.7)
        place.plot(x, a + b * x, color=color, linewidth=0.8, alpha=0.7)
    place.plot(x, intercept + slope * x, color=INK, linewidth=2.5, label="population")
    place.set(xlabel="time", ylabel="measured", xticks=x)
    place.legend(fontsize=8, frameon=False)


def mean(result: Result, read: Callable[[Any], NDArray[np.float64]]) -> NDArray[np.float64]:
    """The weighted mean of an array read off each sample's value."""
    pairs = zip(result, result.weights, strict=True)
    total: NDArray[np.float64] = np.sum([weight * read(sample.value) for sample, weight in pairs], axis=0)
    return total


if __name__ == "__main__":
    for place in draw(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/pictures")):
        print(f"{place}   {place.stat().st_size / 1000:.0f} kB")
