"""A browser at a studio: the Chromium that `NIWAKI_BROWSER` names, driven by Playwright; without it no test is here.

These tests have a run of their own, because Playwright keeps an event loop running for the rest of a run.
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

# `make test-studio` sets it, installs Playwright, and says so where there is no browser.
BROWSER = os.environ.get("NIWAKI_BROWSER")
collect_ignore_glob = [] if BROWSER else ["test_*.py"]


@pytest.fixture(scope="session")
def browser() -> Iterator[object]:
    driving = pytest.importorskip("playwright.sync_api")
    with driving.sync_playwright() as driver:
        # Software GL: there is no graphics card in a build machine.
        flags = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        found = driver.chromium.launch(executable_path=BROWSER, chromium_sandbox=False, args=flags)
        yield found
        found.close()


@pytest.fixture(autouse=True, scope="session")
def table():
    """Write the times of the journeys."""
    yield
    OUT.mkdir(parents=True, exist_ok=True)
    lines = [f"{name:12} {seconds:6.2f} s   limit {LIMITS[name]:4.1f} s" for name, seconds in times.items()]
    (OUT / "times.txt").write_text("\n".join(lines) + "\n")
    kept = os.environ.get("NIWAKI_PICTURES")
    (Path(kept or OUT) / "studio-times.txt").write_text(as_table())
    print("\n" + "\n".join(lines))
    if os.environ.get("NIWAKI_TIMES"):
        assert not [name for name, seconds in times.items() if seconds > 2 * LIMITS[name]]


@pytest.fixture
def open_page(browser, request):
    """A function that opens a window of a studio; no script of the page may have failed at the end."""
    contexts = []

    def opened(served: Served, token: str | None = None, **settings):
        # Playwright's own waiting needs eval; the header is tested by itself.
        shown = {"viewport": {"width": 1440, "height": 900}, **settings}
        context = browser.new_context(bypass_csp=True, **shown)
        contexts.append(context)
        page = context.new_page()
        page.errors = []
        page.on("pageerror", lambda one: page.errors.append(str(one)))
        page.set_default_timeout(60_000)
        page.goto(f"{served.url}/open?token={token or served.link()}")
        page.wait_for_function("window.__studio?.view?.model")
        return page

    yield opened
    for context in contexts:
        for page in context.pages:
            assert page.errors == []
        context.close()
