"""Fixtures of a browser at a studio: Playwright drives the Chromium of `NIWAKI_BROWSER`; without it no test runs.

These tests run separately, because Playwright keeps an event loop running for the rest of a run.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from studio_fixtures import pile, served
from studio_page import LIMITS, OUT, as_table, times
from studio_process import Served

__all__ = ["browser", "open_page", "pile", "served"]

# `make test-studio` sets the variable, installs Playwright, and prints a message if there is no browser.
BROWSER = os.environ.get("NIWAKI_BROWSER")
collect_ignore_glob = [] if BROWSER else ["test_*.py"]


@pytest.fixture(scope="session")
def browser() -> Iterator[object]:
    driving = pytest.importorskip("playwright.sync_api")
    with driving.sync_playwright() as driver:
        # Software GL, because build machines have no graphics card.
        flags = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        # Smooth edges take a tenth of the suite's processor time; only pictures for the manual need them.
        if not os.environ.get("NIWAKI_PICTURES"):
            flags.append("--webgl-antialiasing-mode=none")
        chromium = driver.chromium.launch(executable_path=BROWSER, chromium_sandbox=False, args=flags)
        yield chromium
        chromium.close()


@pytest.fixture(autouse=True, scope="session")
def table():
    """Write the times of the journeys, if no other browser runs beside them."""
    yield
    if os.environ.get("PYTEST_XDIST_WORKER"):
        return
    OUT.mkdir(parents=True, exist_ok=True)
    lines = [f"{name:12} {seconds:6.2f} s   limit {LIMITS[name]:4.1f} s" for name, seconds in times.items()]
    (OUT / "times.txt").write_text("\n".join(lines) + "\n")
    pictures = os.environ.get("NIWAKI_PICTURES")
    (Path(pictures or OUT) / "studio-times.txt").write_text(as_table())
    print("\n" + "\n".join(lines))
    if os.environ.get("NIWAKI_TIMES"):
        assert not [name for name, seconds in times.items() if seconds > 2 * LIMITS[name]]


@pytest.fixture
def open_page(browser, request):
    """A function that opens a window of a studio. The test fails if a script of the page fails."""
    contexts = []

    def open_window(served: Served, token: str | None = None, script: str = "", **settings):
        # Playwright needs `eval` to wait; another test checks the policy's header.
        options = {"viewport": {"width": 1440, "height": 900}, **settings}
        context = browser.new_context(bypass_csp=True, **options)
        contexts.append(context)
        page = context.new_page()
        page.add_init_script(script)
        page.errors = []
        page.on("pageerror", lambda error: page.errors.append(str(error)))
        page.set_default_timeout(60_000)
        page.goto(f"{served.url}/open?token={token or served.link()}")
        page.wait_for_function("window.__studio?.view?.model")
        return page

    yield open_window
    for context in contexts:
        for page in context.pages:
            assert page.errors == []
        context.close()
