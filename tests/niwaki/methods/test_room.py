"""Counts: each that a person gives is a whole number of 64 bits that fits into memory, or there is a message.

Nothing is allocated before: the searches here ask for 10^9 of everything, with a free memory of 8 GB.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from niwaki import draw, letters
from niwaki import kernels as k
from niwaki.color import Drawing
from niwaki.draw import limits
from niwaki.errors import InputError, NiwakiError, memory
from niwaki.shell.main import app
from niwaki.words import box
from typer.testing import CliRunner

B = 10**9
GB = 10**9


@nw.model
def stone() -> float:
    x = nw.gaussian(0, 1)
    nw.emit(box((0, 0, 0), (1, 1, 1)))
    nw.factor(-x * x)
    return x


@pytest.fixture(autouse=True)
def eight_gigabytes(monkeypatch: Any) -> None:
    monkeypatch.setattr(memory, "free_memory", lambda: 8 * GB)


MOVING = {"rejuvenate": k.prior()}

METHODS: dict[str, Callable[[], Any]] = {
    "n": lambda: nw.importance(B),
    "n ": lambda: nw.forward(B),
    "particles     ": lambda: nw.ais(B),
    "particles": lambda: nw.smc(B),
    "particles ": lambda: nw.smc((20, 20, B)),
    "particles  ": lambda: nw.particle_gibbs(B),
    "particles   ": lambda: nw.improve(B, rounds=1),
    "particles    ": lambda: nw.mh(10, kernel=k.cycle(k.prior(), k.regrow(B))),
    "populations": lambda: nw.smc(20, populations=B),
    "diverse": lambda: nw.smc(20, diverse=B),
    "moves": lambda: nw.smc(20, **MOVING, moves=2 * B),
    "draws": lambda: nw.smc(20, **MOVING, draws=B, chains=2),
    "chains": lambda: nw.smc(20, **MOVING, draws=2, chains=B),
    "chains ": lambda: nw.mh(10, chains=B),
    "chains  ": lambda: nw.hmc(10, chains=B),
    "draws ": lambda: nw.nuts(B),
    "sweeps": lambda: nw.pimh(4, B),
    "evaluations": lambda: nw.emulate(B),
    "regrow": lambda: nw.improve(10, regrow=B, rounds=1),
}


@pytest.mark.parametrize("name", METHODS)
def test_counts_are_held_against_free_memory(name: str) -> None:
    with pytest.raises(InputError) as caught:
        nw.run(stone, METHODS[name](), seed=1)
    text = str(caught.value)
    assert f"error[no-room]: `{name.strip()}` asks for " in text and "8.0 GB are free" in text


def test_what_fits_is_searched() -> None:
    assert len(nw.run(stone, nw.importance(100), seed=1)) == 100
    assert len(nw.run(stone, nw.mh(10, chains=3, keep=B, thin=1), seed=1).bests) == 3


NONSENSE = [1.5, True, float("nan"), 10**20, 10**30, 10**5000, -1, "5", None, [], object()]
COUNTS: dict[str, Callable[[Any], Any]] = {
    "importance": nw.importance,
    "forward": nw.forward,
    "rejection": nw.rejection,
    "tries of rejection": lambda n: nw.rejection(max_tries=n),
    "enumerate": nw.enumerate_all,
    "particles": nw.smc,
    "one of several": lambda n: nw.smc((20, n)),
    "barriers": lambda n: nw.smc(**MOVING, at=n),
    "moves": lambda n: nw.smc(**MOVING, moves=n),
    "chains of particles": lambda n: nw.smc(**MOVING, draws=2, chains=n),
    "sweeps": lambda n: nw.pimh(4, n),
    "rounds": lambda n: nw.improve(rounds=-1 if n is None else n),
    "improve": nw.improve,
    "emulate": nw.emulate,
    "regrow": lambda n: nw.improve(regrow=n),
    "steps": nw.mh,
    "chains": lambda n: nw.mh(chains=n),
    "warmup": lambda n: nw.mh(warmup=n),
    "tries": lambda n: nw.mh(tries=n),
    "hmc": nw.hmc,
    "leapfrog": lambda n: nw.hmc(steps=n),
    "climb": lambda n: nw.hmc(climb=n),
    "depth": lambda n: nw.nuts(max_depth=n),
    "reach": k.neighbour,
    "levels": k.regenerate,
    "repeat": lambda n: k.repeat(n, k.prior()),
    "every": lambda n: k.tempering(k.prior(), every=n),
    "runs": lambda n: nw.Search(stone, runs=n),
    "seed": lambda n: nw.Search(stone, seed=n),
    "threads": lambda n: nw.run(stone, threads=1025 if n is None else n),
    "max_steps": lambda n: nw.run(stone, max_steps=n),
    "max_memory": lambda n: nw.run(stone, max_memory=n),
    "width": lambda n: nw.run(stone, seed=1).best.picture(size=(n, 10)),
    "samples": lambda n: nw.run(stone, seed=1).best.picture(size=(10, 10), samples=n),
    "frames": lambda n: draw.animation.growth(nw.run(stone, seed=1).scene, "x.gif", frames=n),
    "size of a letter": lambda n: letters.Word("", "vines", 1, []).picture(n),
    "pixels of an SVG": lambda n: Drawing.load("robot", n),
}


@pytest.mark.parametrize("name", COUNTS)
def test_what_is_no_count_gives_a_message(name: str) -> None:
    for value in NONSENSE:
        with pytest.raises(NiwakiError) as caught:
            COUNTS[name](value)
        assert len(str(caught.value)) < 1000


def test_powers_that_no_real_number_holds() -> None:
    for ask in (lambda: nw.smc(power=10**400), lambda: nw.smc(ess=10**400), lambda: k.drift(10**400)):
        with pytest.raises(InputError):
            ask()


@pytest.mark.parametrize(
    "line",
    [
        "grow spaceship --particles 1000000000",
        "grow spaceship --particles 99999999999999999999",
        "grow spaceship --method smc --populations 1000000000",
        "grow spaceship --method smc --rejuvenate prior() --moves 2000000000",
        "sample coin --chains 1000000000",
        "color robot --side 1000000",
        "color robot --pixels 1000000",
        "color robot -n 1000000000",
        "letters A --width 1000000",
        "letters A --particles 1000000000",
        "letters A --searches 100000000",
        "grow spaceship --runs 1000000000",
        "show coin -n 1000000000",
        "guide train vines --targets scribbles --searches 1000000000",
    ],
)
def test_the_shell_refuses_the_same(line: str, tmp_path: Path) -> None:
    done = CliRunner().invoke(app, [*line.split(), "-o", str(tmp_path / "out")])
    assert isinstance(done.exception, NiwakiError), done.output
    assert done.exception.code in ("no-room", "bad-setting")
    assert done.exception.code in ("no-room", "bad-setting")


def test_free_memory_is_the_least_of_all_limits(monkeypatch: Any, tmp_path: Path) -> None:
    monkeypatch.undo()
    (tmp_path / "max").write_text("5000\n")
    (tmp_path / "current").write_text("3000\n")
    (tmp_path / "memory.stat").write_text("anon 2000\ninactive_file 500\n")
    monkeypatch.setattr(memory, "_GROUPS", ((str(tmp_path / "max"), str(tmp_path / "current")),))
    assert memory.free_memory() == 2500
    (tmp_path / "max").write_text("max\n")
    assert memory.free_memory() > 10**6


@nw.model
def large() -> list[float]:
    x = nw.gaussian(0, 1)
    return [x] * 20_000


LONG: dict[str, Callable[[], Any]] = {
    "importance": lambda: nw.run(large, nw.importance(10**7), seed=1),
    "forward": lambda: nw.run(large, nw.forward(10**7), seed=1),
    "smc": lambda: nw.run(stone, nw.smc(10**6), seed=1),
    "mh": lambda: nw.run(stone, nw.mh(10**12), seed=1),
    "hmc": lambda: nw.run(stone, nw.hmc(10**6), seed=1),
}


@pytest.mark.parametrize("name", LONG)
def test_a_search_stops_before_memory_ends(name: str, monkeypatch: Any) -> None:
    left = iter([8 * GB] * 2)
    monkeypatch.setattr(memory, "free_memory", lambda: next(left, 10**6))
    with pytest.raises(InputError) as caught:
        LONG[name]()
    assert "error[memory-full]" in str(caught.value) and "only 1.0 MB of memory are free" in str(caught.value)


def test_results_that_outgrow_a_limit_end_with_a_message() -> None:
    text = f"""
import resource, sys
sys.path.insert(0, {str(Path(__file__).parent)!r})
import niwaki as nw
from test_room import large
resource.setrlimit(resource.RLIMIT_AS, (2 * 2**30, 2 * 2**30))
try:
    nw.run(large, nw.importance(200_000), seed=1, threads=1)
except nw.NiwakiError as error:
    print(error.code)
"""
    done = subprocess.run(
        [sys.executable, "-c", text], capture_output=True, text=True, timeout=60, check=False
    )
    assert done.stdout == "memory-full\n", done.stderr


def test_a_picture_by_rays_is_held_against_free_memory(monkeypatch: Any) -> None:
    sample = nw.run(stone, seed=1).best
    monkeypatch.setattr(memory, "free_memory", lambda: 300_000_000)
    with pytest.raises(InputError, match="no-room.*`size` asks for 691,200"):
        sample.picture()
    assert sample.picture(size=(320, 240)).size == (320, 240)
    monkeypatch.setattr(limits, "TRIANGLE", 10**8)
    with pytest.raises(InputError, match="no-room.*`triangles`"):
        sample.picture(size=(32, 24))


@pytest.mark.skipif(sys.platform != "linux", reason="the memory of a process is looked up in /proc")
def test_what_a_picture_takes_is_no_more_than_was_counted() -> None:
    # A picture that is full, with rays for each pixel where it changes: none of its pixels is left out.
    grew = int(ran(PICTURE, "1000").stdout)
    assert 0.5 * limits.TRACED < grew / 1000**2 < limits.TRACED


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not keep this limit")
@pytest.mark.parametrize("limit", range(450_000, 800_000, 50_000))
@pytest.mark.parametrize("threads", [1, 8])
def test_a_picture_never_ends_the_process(limit: int, threads: int) -> None:
    done = ran(SAVED, str(limit), RAYON_NUM_THREADS=str(threads))
    assert done.returncode in (0, 1), done.stderr
    assert done.returncode == 0 or "error[" in done.stderr or "MemoryError" in done.stderr


#: The growth of a process by a picture that is full, bytes.
PICTURE = """
import sys
from pathlib import Path
import niwaki as nw
from niwaki.draw.scene import Scene

scene = Scene([("floor", [nw._engine.shape("box", (0.0, 0.0, 0.0), (9.0, 1.0, 9.0))])])
camera = ((0.0, 9.0, 0.1), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), 26.0)
peak = lambda: int(Path("/proc/self/status").read_text().split("VmHWM:")[1].split()[0]) * 1024
nw.draw.picture.picture(scene, size=(8, 8), camera=camera)
before = peak()
size = int(sys.argv[1])
nw.draw.picture.picture(scene, size=(size, size), camera=camera)
print(peak() - before)
"""

#: A picture of the usual size under a limit of the address space, kilobytes.
SAVED = """
import resource, sys
import niwaki as nw
from niwaki.draw.scene import Scene

scene = Scene([("block", [nw._engine.shape("box", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))])])
most = int(sys.argv[1]) * 1024
resource.setrlimit(resource.RLIMIT_AS, (most, most))
nw.draw.picture.picture(scene)
"""


def ran(text: str, *words: str, **variables: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", text, *words],
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join(folder for folder in sys.path if folder),
            **variables,
        },
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("value", ["1025", "1000000000", "-1", "two", "1.5", "9" * 5000])
def test_the_threads_of_the_environment_are_bounded(value: str, monkeypatch: Any) -> None:
    monkeypatch.setenv("RAYON_NUM_THREADS", value)
    for work in (lambda: nw.run(stone, nw.smc(5), seed=1), lambda: nw.run(stone, seed=1).best.picture()):
        with pytest.raises(InputError, match="`RAYON_NUM_THREADS` cannot be"):
            work()
    monkeypatch.setenv("RAYON_NUM_THREADS", "2")
    assert len(nw.run(stone, nw.smc(5), seed=1)) == 5


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not keep this limit")
def test_threads_that_the_system_does_not_give_have_a_message() -> None:
    text = SAVED.replace("nw.draw.picture.picture(scene)", "nw._engine.machine()")
    done = ran(f"import niwaki.errors.settings\n{text}", "800000", RAYON_NUM_THREADS="1000")
    assert "error[no-threads]" in done.stderr, done.stderr
