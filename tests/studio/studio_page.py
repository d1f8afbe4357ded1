"""Actions of tests on the studio's page, and their times.

Times are those of a software renderer, and are printed. If `NIWAKI_TIMES` is set (two idle cores), no time may exceed
twice its limit.
"""

from __future__ import annotations

import json
import os
import time
from pathlib import Path

import numpy as np
from PIL import Image

#: The folder of pictures and times.
OUT = Path("out/studio")

#: Screenshots of the manual, written if `NIWAKI_PICTURES` names the folder of its pictures.
MANUAL = {
    "fill": "studio.png",
    "shape": "studio-part.png",
    "objects": "studio-objects.png",
    "difference": "studio-difference.png",
    "compare": "studio-compare.png",
    "shadow": "studio-shadow.png",
    "dark": "studio-dark.png",
    "rules": "studio-coloring.png",
    "falls": "studio-structure.png",
    "generator": "studio-generator.png",
}

#: Seconds, from studies of people: 0.1 feels immediate, 1 does not interrupt a thought.
LIMITS = {
    "model": 0.3,
    "first shape": 0.3,
    "gallery": 3.0,
    "part": 0.1,
    "part, large": 0.5,
    "hold": 0.1,
    "re-roll": 0.5,
    "undo": 0.1,
    "drag": 0.2,
    "refit": 2.0,
    "stroke": 0.1,
    "error": 0.5,
    "mended": 0.5,
    "difference": 0.1,
    "compare": 0.1,
    "export": 2.0,
    "frame": 0.1,
}
times: dict[str, float] = {}

#: The journeys with their timed steps: an action and its visible effect.
JOURNEYS = {
    "fill": {
        "model": "choose a model: its name and its target",
        "first shape": "Grow: the first shape",
        "gallery": "the gallery, from the first shape on",
        "difference": "X: the difference from the target",
        "frame": "a frame of the scene with a spaceship, while the view turns",
    },
    "draw": {"stroke": "release the pen: the silhouette is the goal"},
    "shape by hand": {
        "part": "click a part: its name, its choices",
        "part, large": "click a part beside a target of 1.3 million triangles",
        "hold": "hold it",
        "re-roll": "grow it again",
        "undo": "undo",
    },
    "write": {
        "error": "save a file with an error: the message with its line",
        "mended": "save the corrected file: the message disappears",
    },
    "finish": {"compare": "starred results side by side", "export": "export a GLB"},
}


def as_table() -> str:
    """Write the times of the steps as a table of Markdown, with the load of the machine."""
    load = os.getloadavg()[1]
    lines = ["| journey | step | seconds | limit |", "| --- | --- | --- | --- |"]
    for journey, steps in JOURNEYS.items():
        lines += [
            f"| {journey} | {step} | {times[name]:.2f} | {LIMITS[name]:.1f} |"
            for name, step in steps.items()
            if name in times
        ]
    lines.append(f"\nSoftware renderer, {os.cpu_count()} cores, load {load:.1f} (5 minutes).")
    return "\n".join(lines) + "\n"


class timed:
    """A context that measures the time of a step of a journey."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __enter__(self):
        """Begin."""
        self.start = time.perf_counter()

    def __exit__(self, kind, *_):
        """End."""
        if kind is None:
            times[self.name] = time.perf_counter() - self.start


def until(page, expression):
    """Wait until an expression of the page holds."""
    page.wait_for_function(expression, polling=10)


def picture(page, name):
    """Write a screenshot for people."""
    OUT.mkdir(parents=True, exist_ok=True)
    until(page, "window.__studio.isStill")
    page.screenshot(path=OUT / f"{name}.png")
    folder = os.environ.get("NIWAKI_PICTURES")
    if folder is not None and name in MANUAL:
        # 128 colours are enough for a page, and take a third of the bytes.
        place = Path(folder) / MANUAL[name]
        with Image.open(OUT / f"{name}.png") as full:
            full.convert("RGB").quantize(128, dither=Image.Dither.NONE).save(place, optimize=True)
        assert place.stat().st_size < 100_000


def choose(page, reference, count=3, seed=1):
    """Choose a model, the number of results and the seed."""
    page.select_option("select[aria-label=Model]", reference)
    until(page, f"window.__studio.view.model.reference == {json.dumps(reference)}")
    until(page, "window.__studio.isGhostShown")
    slider = page.get_by_role("slider", name="results")
    slider.fill(str(count))
    page.locator("input[placeholder='random']").fill(str(seed))
    page.locator("input[placeholder='random']").blur()
    until(
        page,
        f"window.__studio.view.settings.count == {count} && window.__studio.view.settings.seed == {seed}",
    )


def grow(page, name=None):
    """Press Grow, or another button that starts a search, and wait for its end."""
    runs = page.evaluate("window.__studio.view.picked?.run ?? -1")
    button = page.locator("button.primary") if name is None else page.get_by_role("button", name=name)
    button.click()
    until(page, f"!window.__studio.view.searching && (window.__studio.view.picked?.run ?? -1) != {runs}")


#: Whether the fine shape and the choices are those of the active result.
AT_REST = """(() => {
  const name = key => key && `${key.run}.${key.number ?? 0}`;
  const {view, shown, described} = window.__studio;
  const now = name(view.picked);
  return shown.detail == "fine" && described && name(shown.key) == now && name(described.key) == now;
})()"""


def resize(page, wide, high):
    """Give the window a size, and wait until the scene is drawn in it."""
    page.set_viewport_size({"width": wide, "height": high})
    until(page, f"innerWidth == {wide} && innerHeight == {high}")
    until(
        page,
        "(canvas => canvas.width == canvas.clientWidth)(document.querySelector('main.stage canvas'))",
    )


def at_rest(page):
    """Wait for the fine shape and its choices."""
    until(page, AT_REST)


def settled(page):
    """Wait for the first contents of a model: a result, or a run before any search. The camera stays then."""
    until(page, f"window.__studio.isGhostShown && (window.__studio.shown.role == 'prior' || {AT_REST})")
    until(page, "window.__studio.isStill")


def unstar(page):
    """Remove all stars."""
    for left in range(page.evaluate("window.__studio.view.stars.length"))[::-1]:
        page.locator(".card .star[aria-pressed=true]").first.click()
        until(page, f"window.__studio.view.stars.length == {left}")


def click_part(page, address):
    """Click a visible point of a part."""
    box = page.locator("main.stage").bounding_box()
    x, y = page.evaluate("address => window.__studio.pointOf(address)", address)
    page.mouse.click(box["x"] + x, box["y"] + y)


def visible(page, word):
    """Find the address of a visible part with a word in it."""
    script = "window.__studio.shown.parts.find(part => part.includes(%s) && window.__studio.pointOf(part))"
    return page.evaluate(script % json.dumps(word))


def camera(page):
    """Return the matrix of the camera."""
    return np.array(page.evaluate("window.__studio.camera"))


def nameless(page):
    """Count the buttons and fields without a name for a screen reader."""
    is_nameless = (
        "node => !(node.title || node.ariaLabel || node.textContent.trim() || node.closest('label'))"
    )
    return page.eval_on_selector_all("button, select, input", f"all => all.filter({is_nameless}).length")


#: Visible texts with too little contrast to their background: less than 4.5 to 1 (WCAG 2.2, 1.4.3).
CONTRASTS = """() => {
  const parsed = text => (text.match(/[\\d.]+/g) ?? []).map(Number);
  const light = ([r, g, b]) => [r, g, b].map(v => v / 255)
    .map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    .reduce((sum, v, k) => sum + v * [0.2126, 0.7152, 0.0722][k], 0);
  const faint = [];
  for (const element of document.querySelectorAll("body *")) {
    const hasText = [...element.childNodes].some(node => node.nodeType === 3 && node.textContent.trim());
    const box = element.getBoundingClientRect();
    if (!hasText || !box.width || !box.height || element.closest("option, [disabled]")) continue;
    let behind = element, back = [0, 0, 0, 0];
    while (behind && (back[3] ?? 1) === 0) {
      back = parsed(getComputedStyle(behind).backgroundColor);
      behind = behind.parentElement;
    }
    const [a, b] = [light(parsed(getComputedStyle(element).color)), light(back)].sort((x, y) => y - x);
    const ratio = (a + 0.05) / (b + 0.05);
    const name = `${element.tagName}.${element.className} ${element.textContent.trim().slice(0, 20)}`;
    if (ratio < 4.5) faint.push(`${name}: ${ratio.toFixed(2)}`);
  }
  return [...new Set(faint)];
}"""


def contrasts(page):
    """List texts with too little contrast, each with its ratio."""
    # A colour in transition is neither the old nor the new colour.
    until(page, "document.getAnimations().length == 0")
    return page.evaluate(CONTRASTS)
