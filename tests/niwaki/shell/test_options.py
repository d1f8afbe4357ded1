"""Claim: a flag has one name, one short form, one metavar and one meaning in every command, and nothing is replaced."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
import typer
from niwaki.errors import InputError
from niwaki.shell.app import COMMANDS, app
from PIL import Image
from typer.testing import CliRunner

#: Every flag of every command: its names, what stands for its value, and how its help begins. A new flag needs a row.
#: One that other commands have must have the same row, and one that means something else another name.
FLAGS = {
    # Where to, how many, by what.
    "--output": ("-o/--output", "PATH", "Output: a folder or, with a suffix, a file. Default: "),
    "--force": ("--force", None, "Replace existing files."),
    "--runs": ("-n/--runs", "N", "Number of results."),
    "--particles": (
        "--particles",
        "N|LIST",
        ("Number of particles of a population.", "The number of particles of a population."),
    ),
    "--seed": ("--seed", "N", "Seed of the random stream. Default: a new seed, which is printed."),
    "--verbose": ("--verbose", None, "Print log scores and the steps of the search, too."),
    "--threads": ("--threads", "N", "Number of threads; results do not depend on it."),
    "--max-steps": ("--max-steps", "N", "Limit of calls and loop steps of one run."),
    "--max-memory": ("--max-memory", "MB", "Memory limit of a run or a population"),
    "--resume": ("--resume", "PATH", "Resume the stopped or killed "),
    "--json": ("--json", None, "Print JSON"),
    # Which files.
    "--format": ("--format", "LIST", "Formats, with commas: "),
    "--scale": ("--scale", "MM", "stl, 3mf: millimetres"),
    "--fuse": ("--fuse", "GAP", "stl, 3mf: close gaps"),
    "--frames": ("--frames", "N", "gif, apng: maximum number of frames."),
    "--size": ("--size", "WxH", "gif, apng: size in pixels."),
    "--width": ("--width", "N", "Width of the picture in pixels"),
    "--side": ("--side", "N", "Longer side of each PNG, in pixels."),
    "--pixels": (
        "--pixels",
        "N",
        ("Longer side of a drawing when it is ", "Longer side of the drawing when it is "),
    ),
    "--export": ("--export", "LIST", "Also write these results"),
    "--picture": (
        "--picture/--no-picture",
        None,
        "Draw best.png, sheet.png and the views that were matched.",
    ),
    "--quick": ("--quick", None, "Draw small pictures with one ray for each pixel"),
    "--choices": ("--choices", None, "Add a column to the table with the choices"),
    # The model, and results to begin from.
    "--preset": ("--preset", "FILE", "A TOML file with arguments of the model"),
    "--model": ("--model", "FILE", "The Python file with the model's host functions. It is run."),
    "--trust": ("--trust", None, "Run Python files that results name, if they are unchanged."),
    "--anyway": ("--anyway", None, "Run the model's file as it is now"),
    "--try": ("--try", "MODEL", "Another version"),
    "--choice": ("--choice", "ADDRESS", "The choice to change"),
    "--core": ("--core", None, "Print the core form."),
    "--bytecode": ("--bytecode", None, "Print the bytecode."),
    "--from": ("--from", "RUN.JSON", "A result to start from"),
    "--result": ("--result", "RUN.JSON", "A result of the model"),
    "--run": ("--run", "N", "Number of the result"),
    "--hold": (
        "--hold",
        "PATTERN|NAME=VALUE",
        ("Hold the parts of the result of --from", "Hold the socket NAME of a Blender file"),
    ),
    "--reroll": ("--reroll", "PATTERN", "Grow the parts again that match PATTERN"),
    # What a scene should be like.
    "--target": ("--target", "FILE", "A mesh to fill"),
    "--targets": ("--targets", "FOLDER|NAME", "A folder of drawings or of meshes"),
    "--avoid": ("--avoid", "FILE", "A mesh to avoid"),
    "--floor": ("--floor", "Y", "A height to stay above."),
    "--within": ("--within", "X,Y,Z,X,Y,Z", "Low and high corner of a box"),
    "--window": ("--window", "X,Y,X,Y", "Low and high corner of what a drawing shows."),
    "--match-image": ("--match-image", "FILE", "A silhouette to match"),
    "--match-shadow": ("--match-shadow", "FILE", "A shadow to cast"),
    "--camera": ("--camera", "FILE", "The camera that sees"),
    "--weight-image": ("--weight-image", "FILE", "An image, white where"),
    "--weight": ("--weight", "NUMBER", "How much more a white pixel counts: 1 + NUMBER times."),
    "--light": ("--light", "X,Y,Z", "The direction in which the light travels."),
    "--receiver": ("--receiver", "FILE", "A mesh that the shadow falls on."),
    "--voxel": ("--voxel", "SIZE", "Cell size."),
    "--sigma": ("--sigma", "NUMBER", "Strictness of the match; smaller is stricter."),
    "--volume-weight": ("--volume-weight", "cells|balanced", "Which cells count around a target: all,"),
    "--rule": ("--rule", "solid|surface|none", "Which parts count as intersecting; none: parts may overlap."),
    "--rules": ("--rules", "FILE", "A TOML file with rules for the regions."),
    "--strictness": ("--strictness", "NUMBER", "Strictness of the rules; larger is stricter."),
    "--style": ("--style", "vines|lightning", "The model that draws the letters."),
    "--font": ("--font", "FILE", "A TrueType or OpenType file."),
    # How to search: a flag for each setting of the methods.
    "--method": ("--method", "NAME", "Search method: improve, smc, ais, particle-gibbs, pimh, emulate."),
    "--guide": ("--guide", "FILE|shipped|none", "A guide, which draws choices"),
    "--polish": ("--polish", "STEPS", "Continue from the best result"),
    "--polish-kernel": ("--polish-kernel", "KERNEL", "Kernel of the chain of --polish."),
    "--regrow": ("--regrow", "N", "The number of particles that grow a part again"),
    "--power": ("--power", "NUMBER", "The power of the score"),
    "--rounds": ("--rounds", "N", "The number of rounds"),
    "--effort": ("--effort", "NUMBER", "The factor of the floor of work"),
    "--seconds": (
        "--seconds",
        "SECONDS",
        ("The time of the search", "Begin no evaluation after so many seconds."),
    ),
    "--diverse": (
        "--diverse",
        "N",
        ("The number of results that differ", "improve, smc, emulate: The number of results that differ"),
    ),
    "--generations": ("--generations", "N", "The number of generations of eight short searches"),
    "--by": ("--by", "kind|look|CHOICES|QUERY", "What tells results apart."),
    "--margin": ("--margin", "NUMBER", "The nats below the best within which"),
    "--bins": ("--bins", "N", "The number of bins of a real choice or query"),
    "--order": ("--order", "NAME", '"stochastic"'),
    "--weights": ("--weights", "NAME", '"ratio"'),
    "--resampling": ("--resampling", "NAME", '"systematic"'),
    "--ess": ("--ess", "NUMBER", "The share of the particles below which"),
    "--anneal": ("--anneal", "LIST", "The schedule of powers"),
    "--populations": ("--populations", "N", "The number of independent populations"),
    "--look-ahead": ("--look-ahead", "NUMBER", "The strength of the look-ahead"),
    "--rejuvenate": ("--rejuvenate", "KERNEL", "A kernel of niwaki.kernels that moves each particle"),
    "--moves": ("--moves", "N", "The number of proposals for each particle"),
    "--at": ("--at", "NAME", "The moments of moves: "),
    "--draws": ("--draws", "N", "The numbers of states and of chains that replace the final set."),
    "--chains": (
        "--chains",
        "N",
        (
            "The number of chains, which run side by side",
            "The numbers of states and of chains that replace the final set.",
        ),
    ),
    "--powers": ("--powers", "LIST", "The number of rungs of the ladder"),
    "--kernel": ("--kernel", "KERNEL", "The kernel that "),
    "--tries": ("--tries", "N", "The most forward runs for "),
    "--sweeps": ("--sweeps", "N", "The number of sweeps; each gives one sample."),
    "--ancestors": ("--ancestors/--no-ancestors", None, "Whether the past of the held run"),
    "--steps": ("--steps", "N", "The number of proposals of each chain"),
    "--strategy": ("--strategy", "NAME", "The part of the model that runs again"),
    "--thin": ("--thin", "N", "The number of proposals between two samples"),
    "--keep": (
        "--keep",
        "N|FILE",
        ("The approximate number of samples of each chain", "Requirements to keep."),
    ),
    "--warmup": ("--warmup", "N", "The number of proposals before the first sample"),
    # Searches of which another thing is made; batches; the studio.
    "--searches": ("--searches", "N|LIST", "Number of searches for each "),
    "--searches-ahead": ("--searches-ahead", "N", "Then train the guide's look-ahead"),
    "--objective": ("--objective", "examples|bound|particles", "Examples: learn from the best runs"),
    "--start": ("--start", "FILE", "A guide from which the training starts."),
    "--mirror": ("--mirror/--no-mirror", None, "Also learn from mirrored drawings."),
    "--evaluations": (
        "--evaluations",
        "N",
        (
            "Evaluations in all, with those of the folder.",
            "emulate: The number of runs.",
            "The most runs of the script.",
        ),
    ),
    "--workers": ("--workers", "N", "Processes that evaluate."),
    "--limit": ("--limit", "S", "Seconds of one evaluation, until ten are known"),
    "--align": ("--align", None, "Search the place, turn and size of the mesh, too."),
    "--generator": ("--generator", "GENERATOR", "Write a model that calls a function, file.py:function"),
    "--free": ("--free", "NAME", "Sizes and counts that may change, too"),
    "--fix": ("--fix", "NAME", "Literals that stay"),
    "--words": ("--words", "A,B,...", "Names that may replace one another"),
    "--patches": ("--patches", "N", "Number of patches"),
    "--write": ("--write", "N", "Accept patch N"),
    "--up": ("--up", "y|z", "The axis that points up."),
    "--processes": ("--processes", "N", "Number of worker processes."),
    "--shard": ("--shard", "I/N", "Run only a part of the batch"),
    "--engine": ("--engine", "local|ray|dask", "Engine that runs the searches."),
    "--cluster": ("--cluster", "URL", "Address of a running cluster."),
    "--chunk": ("--chunk", "SECONDS", "Seconds of searches that a worker gets at once."),
    "--session": ("--session", "FOLDER", "Folder of the session."),
    "--port": ("--port", "N", "Port of the server"),
    "--http": ("--http", None, "Serve loopback HTTP"),
    "--browser": ("--browser/--no-browser", None, "Open the page in the browser."),
}

#: What stands for the words after a command, and how their help begins.
WORDS = {
    "MODEL": "A gallery name, or file.py:function. The Python file is run.",
    "[NAME=VALUE]...": "Arguments of the model. Default: the model's.",
    "RUN.JSON": "A run.json of `niwaki grow` or `sample`.",
    "DRAWING": "An SVG",
    "TEXT": "The text to write.",
    "SPEC": "A TOML file with the model, the seeds, and the settings that vary.",
    "NEW-FOLDER": "A new folder",
    "MODELS": "The folder of the models.",
    "FOLDER": "The folder of a batch.",
    "FILE": "The file of a guide.",
    "GENERATOR": "file.py:function, which is run, an OpenSCAD file",
    "SCRIPT": "A Python script, file.py:function, or an OpenSCAD file. It is run.",
    "[MODEL.PY]...": "Files of models",
}


def commands(group: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """All commands, by their full names."""
    for word, command in group.commands.items():
        yield from (
            commands(command, f"{name}{word} ")
            if hasattr(command, "commands")
            else [(f"{name}{word}", command)]
        )


@pytest.fixture(scope="module")
def all_commands() -> dict[str, Any]:
    for name in COMMANDS:
        import_module(f"niwaki.shell.{name}")
    return dict(commands(typer.main.get_group(app)))


def deviations(name: str, option: Any) -> Iterator[str]:
    """Yield the differences between an option of a command and the table."""
    flag = next(name_of_flag for name_of_flag in option.opts if name_of_flag.startswith("--"))
    if flag not in FLAGS:
        yield f"{name} {flag}: not in the table"
        return
    names, metavar, meaning = FLAGS[flag]
    if "/".join([*option.opts, *option.secondary_opts]) != names:
        yield f"{name} {flag}: {option.opts} {option.secondary_opts}, and not {names}"
    if option.metavar not in (metavar, *(metavar or "").split("|")):
        yield f"{name} {flag}: {option.metavar}, and not {metavar}"
    # A setting of some methods begins with their names.
    text = option.help
    owners, colon, rest = text.partition(": ")
    if colon and set(owners.split(", ")) <= {"improve", "smc", "ais", "particle-gibbs", "pimh"}:
        text = rest
    if not text.startswith(meaning):
        yield f"{name} {flag}: {text!r}, and not {meaning!r}"


def test_every_flag_is_that_of_the_table(all_commands: dict[str, Any]) -> None:
    lines = [
        line
        for name, command in all_commands.items()
        for option in command.params
        if option.param_type_name == "option" and option.name != "help"
        for line in deviations(name, option)
    ]
    assert not lines, "\n".join(lines)


def test_every_word_is_that_of_the_table(all_commands: dict[str, Any]) -> None:
    lines = [
        f"{name} {argument.metavar}: {argument.help}"
        for name, command in all_commands.items()
        for argument in command.params
        if argument.param_type_name == "argument"
        and not argument.help.startswith(WORDS.get(argument.metavar, "?"))
    ]
    assert not lines, "\n".join(lines)


def test_the_table_has_no_flag_twice_and_none_that_is_gone(all_commands: dict[str, Any]) -> None:
    used = {flag for command in all_commands.values() for first in command.params for flag in first.opts}
    assert not set(FLAGS) - used
    shorts = [short for names, _, _ in FLAGS.values() for short in names.split("/") if len(short) == 2]
    assert sorted(shorts) == ["-n", "-o"]
    # Of two flags that begin alike one is another name of the other; a default says nothing about the meaning.
    meanings = [meaning for _, _, meaning in FLAGS.values() if not str(meaning).startswith("Default")]
    alike = {
        first
        for first in meanings
        for second in meanings
        if first is not second and str(second).startswith(str(first))
    }
    assert not alike - {"How "}


def test_commands_that_write_have_the_same_three(all_commands: dict[str, Any]) -> None:
    writing = {
        name for name, command in all_commands.items() for option in command.params if "-o" in option.opts
    }
    assert writing == {
        *("show", "grow", "replay", "sample", "color", "letters", "explain"),
        *("batch run", "batch export", "guide train", "fit"),
    }
    for name in writing - {"batch run", "fit"}:
        # A batch and a fit are gone on with, and never replaced.
        assert "--force" in {flag for option in all_commands[name].params for flag in option.opts}, name


def run(*words: object) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


MODEL = """
from niwaki import box, emit, model, uniform

@model
def tower():
    emit(box((0, 1, 0), (1, uniform(1, 2), 1)))
"""
SPEC = "model = 'garden.py:tower'\nseeds = 2\n[grow]\ntarget = 'pillar.obj'\nparticles = 5\n"
TRAIN = ("guide", "train", "lightning", "--targets", "pages", "--searches", "4", "--seed", "1")


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    from niwaki import box
    from niwaki.draw.scene import Scene

    monkeypatch.chdir(tmp_path)
    Path("garden.py").write_text(MODEL)
    Path("ships.toml").write_text(SPEC)
    Scene([("pillar", [box((0, 1, 0), (1, 2, 1))])]).export("pillar.obj")
    Path("pages").mkdir()
    for number in range(4):
        page = Image.new("L", (60, 60), 255)
        page.paste(0, (20 + 3 * number, 5, 30 + 3 * number, 55))
        page.save(f"pages/{number}.png")
    return tmp_path


#: A call of each command that writes, its usual file in a folder, and files that it can write alone.
CALLS: dict[str, tuple[tuple[str, ...], str, tuple[str, ...]]] = {
    "show": (
        ("show", "garden.py:tower", "-n", "1", "--quick", "--seed", "1"),
        "show.png",
        ("a.png", "a.jpg"),
    ),
    "grow": (
        ("grow", "garden.py:tower", "--target", "pillar.obj", "--seed", "1", "--particles", "5", "--quick"),
        "run.json",
        ("a.png", "a.json", "a.stl", "a.gif"),
    ),
    "replay": (("replay", "first/run.json", "--quick"), "run.json", ("a.png", "a.json", "a.obj")),
    "sample": (
        ("sample", "garden.py:tower", "--steps", "20", "--seed", "1", "--quick"),
        "samples.csv",
        ("a.csv", "a.json", "a.glb", "a.png"),
    ),
    "color": (
        ("color", "bug", "-n", "1", "--side", "64", "--pixels", "64", "--seed", "1"),
        "colors.json",
        ("a.svg", "a.png", "a.json", "a.csv"),
    ),
    "letters": (
        ("letters", "I", "--seed", "1", "--particles", "4", "--searches", "1", "--width", "64"),
        "word.svg",
        ("a.svg", "a.png"),
    ),
    "explain": (("explain", "hmm", "--choice", "n[2]/state"), "explain.svg", ("a.svg", "a.png")),
    "batch export": (("batch", "export", "ships", "--format", "csv"), "results.csv", ()),
    "batch export alone": (("batch", "export", "ships"), "", ("a.csv", "a.png")),
    "guide train": (TRAIN, "lightning.guide", ("a.guide",)),
}


def done(*words: object) -> Any:
    finished = run(*words)
    assert finished.exit_code == 0, (finished.output, finished.exception)
    return finished


def refused(*words: object) -> InputError:
    finished = run(*words)
    assert isinstance(finished.exception, InputError), (words, finished.output, finished.exception)
    return finished.exception


def only_once(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that is called the first time, and then returns what it returned."""
    results: list[Any] = []

    def again(*arguments: Any, **settings: Any) -> Any:
        if not results:
            results.append(function(*arguments, **settings))
        return results[0]

    return again


@pytest.mark.parametrize("name", CALLS)
def test_o_is_a_folder_or_with_a_suffix_a_file_and_nothing_is_replaced(
    place: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    call, usual, files = CALLS[name]
    if name == "replay":
        done(*CALLS["grow"][0], "-o", "first")
    if name.startswith("batch"):
        done("batch", "ships.toml", "--processes", "1")
    # One training is enough: what is written does not depend on it.
    monkeypatch.setattr(nw, "train_guide", only_once(nw.train_guide))
    before = set(place.iterdir())
    for file in files:
        place_of_file = Path("alone", file)
        if file == files[0]:
            done(*call, "-o", f"alone/{file}")
            assert place_of_file.read_bytes()
        place_of_file.write_bytes(b"mine")
        error = refused(*call, "-o", f"alone/{file}")
        assert error.code == "already-there" and f"alone/{file}" in str(error) and "--force" in str(error)
        assert place_of_file.read_bytes() == b"mine"
        done(*call, "-o", f"alone/{file}", "--force")
        assert place_of_file.read_bytes() not in (b"", b"mine")
    assert len(list(place.glob("alone/*"))) == len(files)
    if usual:
        done(*call, "-o", "v1.2/")
        done(*call, "-o", "folder")
        assert (place / "v1.2" / usual).is_file() and (place / "folder" / usual).is_file()
        if name != "replay":
            error = refused(*call, "-o", "folder")
            assert error.code == "already-there" and "--force" in str(error) and "folder" in str(error)
        done(*call, "-o", "folder", "--force")
    # A format that the command does not write, and no folder of that name.
    assert refused(*call, "-o", "what.xyz").code == "bad-setting"
    assert {written.name for written in set(place.iterdir()) - before} <= {
        "alone",
        "folder",
        "v1.2",
        "__pycache__",
    }


def test_without_o_the_next_name_is_taken(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(nw, "train_guide", only_once(nw.train_guide))
    for name in ("show", "explain", "guide train"):
        call, usual, _ = CALLS[name]
        done(*call)
        first = Path(usual).read_bytes()
        Path(usual).write_bytes(b"mine")
        done(*call)
        assert Path(usual).read_bytes() == b"mine"
        assert Path(usual).with_stem(f"{Path(usual).stem}-2").is_file() and first
        if name == "show":
            done(*call, "--force")
            assert Path(usual).read_bytes() != b"mine"


def test_a_file_alone_is_what_the_folder_would_have(place: Path) -> None:
    call = CALLS["grow"][0]
    done(*call, "--format", "glb,stl", "-o", "out")
    for file in ("best.stl", "best.png"):
        done(*call, "-o", f"a{Path(file).suffix}")
        assert Path(f"a{Path(file).suffix}").read_bytes() == Path("out", file).read_bytes()
    done(*call, "-o", "a.json")
    assert (
        json.loads(Path("a.json").read_text())["hash"] == json.loads(Path("out/run.json").read_text())["hash"]
    )
    done("replay", "a.json", "-o", "again.stl")
    assert Path("again.stl").read_bytes() == Path("out/best.stl").read_bytes()
    assert refused(*call, "-o", "b.stl", "--format", "glb").code == "flags-exclude"


def test_a_replay_joins_its_own_run_alone(place: Path) -> None:
    call = CALLS["grow"][0]
    done(*call)
    done(*call, "--seed", "2")
    done("replay", "out/run.json", "--format", "obj", "--quick")
    assert Path("out/best.obj").is_file()
    # `out` has another run, and `out-2` this one.
    done("replay", "out-2/run.json", "--format", "obj", "--quick")
    assert Path("out-2/best.obj").is_file() and not Path("out-3").exists()
    assert refused("replay", "out-2/run.json", "-o", "out").code == "already-there"


def test_a_batch_is_a_folder(place: Path) -> None:
    assert refused("batch", "ships.toml", "-o", "ships.csv").code == "bad-setting"
    done(*CALLS["grow"][0], "-o", "used")
    error = refused("batch", "ships.toml", "-o", "used")
    assert error.code == "already-there" and "--force" not in str(error)
