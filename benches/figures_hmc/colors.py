"""Figures 4.4, 4.5 and the table of figure 4.6: drawings of our own, colored by the original's samplers and by ours.

The dissertation's drawings are not ours to give away; ours have the same names and 15 to 20 regions, and more rules.
The table has the dissertation's seconds beside ours: a laptop of 2012 beside the machine that this runs on.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import coverage
import matplotlib.pyplot as plt
import niwaki as nw
import numpy as np
from chains_of_colors import DRAWINGS, DRAWS, STEPS, originals, ours, task, timed
from niwaki import diagnostics, kernels
from niwaki.color import Drawing, Rules, coloring, lab
from niwaki.color.search import rules_of
from PIL import Image

#: Seconds of sampling and shares accepted, MH and HMC (dissertation figure 4.6).
PUBLISHED = {
    "robot": ((12.66, 0.24), (10.61, 0.65)),
    "house": ((13.38, 0.24), (10.67, 0.65)),
    "bug": ((6.08, 0.24), (3.56, 0.63)),
    "rocket": ((14.53, 0.23), (10.61, 0.63)),
}
SHOWN, SIZE, LAGS = 4, 270, 200


def draw(folder: Path, tell: Callable[[dict], None], quick: bool) -> None:
    """All three."""
    names, draws = (("bug",), 40) if quick else (DRAWINGS, DRAWS)
    gallery(names).save(folder / "figure-4-4.png", optimize=True)
    comparison(names, draws).savefig(folder / "figure-4-5.png", dpi=90)
    plt.close("all")
    print("drawing  method    dims   their s  s     accepted   accepted/s  effective/s")
    for name in names:
        for line in timings(name, draws):
            tell(line)
            print(
                f"{name:8} {line['method']:9} {line['dims']:4} {line['published s'] or '-':>9}"
                f" {line['cpu']:6.2f} {line['accepted']:8.2f} {line['accepted/s']:11.0f} {line['effective/s']:10.1f}",
                flush=True,
            )


def gallery(names: tuple[str, ...]) -> Image.Image:
    """Figure 4.4: the regions, the rules, and draws as they come."""
    page = Image.new("RGB", ((2 + SHOWN) * SIZE, len(names) * SIZE), (255, 255, 255))
    for line, name in enumerate(names):
        drawing, _ = task(name)
        greys = np.linspace(40, 235, len(drawing.names)).astype(int)
        template = {
            entry: f"#{grey:02x}{grey:02x}{grey:02x}"
            for entry, grey in zip(drawing.names, greys, strict=True)
        }
        sets = [template, as_rules(drawing, rules_of(name))]
        colorings = ours(name, 1).values[:SHOWN, -1]
        sets += [dict(zip(drawing.names, map(lab.hexed, entry), strict=True)) for entry in colorings]
        for column, colors in enumerate(sets):
            image = drawing.picture(colors, SIZE - 12)
            page.paste(image, (column * SIZE + 6, line * SIZE + 6), image)
    return page


def as_rules(drawing: Drawing, rules: Rules) -> dict[str, str]:
    """The rules as colours: one hue for shades of one colour, darker by a chain of lightness."""
    group = {name: name for name in drawing.names}
    for rule in rules:
        if rule.kind == "same-chroma":
            old, new = group[rule.second], group[rule.first]
            group = {name: new if of == old else of for name, of in group.items()}
    sizes = {of: list(group.values()).count(of) for of in group.values()}
    tied = [of for of, size in sizes.items() if size > 1]
    depth = dict.fromkeys(drawing.names, 0)
    ranked = [(rule.first, rule.second) for rule in rules if rule.kind in ("lightness", "lighter")]
    for _ in drawing.names:
        for light, dark in ranked:
            depth[dark] = max(depth[dark], depth[light] + 1)
    shades = {}
    for name in drawing.names:
        angle = 2.0 * np.pi * tied.index(group[name]) / len(tied) if group[name] in tied else 0.0
        chroma = 38.0 if group[name] in tied else 0.0
        shades[name] = hexed_lab(94.0 - 13.0 * depth[name], chroma * np.cos(angle), chroma * np.sin(angle))
    return shades


def hexed_lab(light: float, a: float, b: float) -> str:
    """`#rrggbb` of a CIELAB colour, its parts cut to [0, 1]."""
    f = (light + 16.0) / 116.0 + np.array([a / 500.0, 0.0, -b / 200.0])
    xyz = np.where(f**3 > lab.KNEE, f**3, (116.0 * f - 16.0) / lab.SLOPE) * np.array(lab.WHITE)
    linear = np.clip(np.linalg.solve(np.array(lab.TO_XYZ), xyz), 0.0, 1.0)
    return lab.hexed(linear ** (1.0 / lab.GAMMA))


def comparison(names: tuple[str, ...], draws: int) -> plt.Figure:
    """Figure 4.5: coverage maps of three samplers, and autocorrelation."""
    figure, axes = plt.subplots(
        len(names), 4, figsize=(11.0, 2.6 * len(names)), squeeze=False, layout="constrained"
    )
    for line, name in zip(axes, names, strict=True):
        drawing, _ = task(name)
        chains = {**originals(name, 1, draws), "explore": ours(name, 1)}
        for axis, (sampler, chain) in zip(line, chains.items(), strict=False):
            bins = coverage.reached(chain.all_draws)
            axis.imshow(coverage.picture(drawing, bins))
            axis.set(xticks=[], yticks=[])
            axis.set_title(f"{sampler}: {bins.mean():.1f} of {coverage.REACHABLE} bins", fontsize=9)
            for side in axis.spines.values():
                side.set_color("0.8")
        line[3].axhline(0.0, color="0.6", linewidth=0.8)
        for sampler, color in (("HMC", "#3274a1"), ("MH", "#3a923a")):
            flat = chains[sampler].values[0].reshape(draws, -1)
            line[3].plot(diagnostics.autocorrelation(flat)[:LAGS], color=color, label=sampler)
        line[3].set(ylim=(-0.4, 1.05), xlabel="lag, draws")
        line[3].set_title("autocorrelation", fontsize=9)
    axes[0, 3].legend(frameon=False, fontsize=8)
    return figure


def timings(name: str, draws: int) -> list[dict[str, Any]]:
    """Rows of the table of figure 4.6: the engine's MH and HMC with the original's lengths, and `explore`."""
    drawing, arguments = task(name)
    theirs_mh, theirs_hmc = PUBLISHED[name]
    rows = []
    proposals = 2 * STEPS * draws
    result = nw.run(
        coloring,
        *arguments,
        method=nw.mh(proposals, kernel=kernels.drift(target=0.23), keep=draws),
        seed=1,
        threads=1,
    )
    colors = np.array([sample.value for sample in result]).reshape(len(result), -1)
    sites = result.acceptance.values()
    accepted = sum(site.accepted for site in sites) / sum(site.proposed for site in sites)
    rows.append(
        row("MH", drawing, theirs_mh[0], result.cpu_seconds, accepted, draws, diagnostics.ess_vector(colors))
    )
    samplers = {
        "HMC": (theirs_hmc[0], nw.hmc(draws, STEPS, chains=1, metric="unit", warmup=200, climb=100)),
        "explore": (None, nw.explore()),
    }
    for sampler, (published, method) in samplers.items():
        run = timed(name, method, 1)
        count = run.values.shape[0] * run.values.shape[1]
        rows.append(row(sampler, drawing, published, run.cpu, run.accepted, count, run.effective))
    return [{"drawing": name, **line} for line in rows]


def row(
    sampler: str,
    drawing: Drawing,
    published: float | None,
    cpu: float,
    accepted: float,
    draws: int,
    effective: float,
) -> dict[str, Any]:
    """One line of the table."""
    return {
        "method": sampler,
        "dims": 3 * len(drawing.names),
        "published s": published,
        "cpu": round(cpu, 3),
        "accepted": round(accepted, 3),
        "accepted/s": round(draws * accepted / cpu, 1),
        "effective/s": round(effective / cpu, 2),
    }
