"""What a session has: its journal, its windows, its two workers; what windows see of it, and how a step is done."""

from __future__ import annotations

import asyncio
import re
from collections import OrderedDict
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import msgspec

from niwaki.studio import messages as m
from niwaki.studio.frames import frame
from niwaki.studio.journal import Journal
from niwaki.studio.process import Stamp, Worker
from niwaki.studio.refused import Refused as Refused
from niwaki.studio.refused import problem
from niwaki.studio.window import Window, newest

#: The name of a drawing that was sent.
DRAWING = re.compile(r"[0-9a-f]{64}\.(svg|png|webp|bmp|gif|tif|tiff|jpg|jpeg)")
#: Bytes of shapes that are kept ready.
SHAPES = 256 << 20
#: Commands that wait for a worker at one time.
WORK = 4_000
#: Seconds that what has to be quick may take.
PATIENCE = 300.0


class Session:
    """One session and its open windows.

    Parameters
    ----------
    folder
        Where it is stored; a session that is there goes on.
    files
        References of models that may be chosen beside those of the gallery; each of a file that was named at the start.
    trust
        Whether files that stored runs name may be run for their host functions, where they have not changed.

    Attributes
    ----------
    searcher, desk : Worker
        The process that searches; the one that does what has to be quick.
    ready : asyncio.Event
        Set when commands can be carried out.
    models, targets
        What can be chosen.
    model
        The present one, as it was last read.
    problem, note, losses
        The error of its file; what is said of what is asked, and of the runs that the last search lost.
    searching
        How far the search is that runs.
    search
        Its task.
    ghosts
        Frames of the target and of obstacles, by kind.
    wanted
        The newest value of a choice, by the phase of its slider.
    dragged, dragging
        The newest point of a part that is dragged; held while one of them is gone to.
    """

    def __init__(self, folder: Path, files: list[str], trust: bool = False) -> None:
        self.journal = Journal(folder)
        self.document = self.journal.document()
        self.windows: set[Window] = set()
        self.files = files
        words = [*(["--trust"] if trust else []), *files]
        slow: dict[str, Stamp] = {}
        self.searcher = Worker(*words, slow=slow)
        self.desk = Worker(*words, patience=PATIENCE, slow=slow)
        self.ready = asyncio.Event()
        self.models: list[m.ModelInfo] = []
        self.targets: list[str] = []
        self.model: m.ModelInfo | None = None
        self.problem: m.Problem | None = None
        self.note = self.losses = ""
        self.searching: m.Searching | None = None
        self.search: asyncio.Task[m.Answer] | None = None
        self.is_interrupted = self.journal.running is not None
        self.wanted: dict[str, m.Choose] = {}
        self.dragged: m.Drag | None = None
        self.dragging = asyncio.Lock()
        self.ghosts: dict[str, bytes] = {}
        self._shapes: OrderedDict[tuple[m.Key, str], bytes] = OrderedDict()
        self._told: dict[str, Any] = {}
        self._rev = 0
        self._tasks: set[asyncio.Task[Any]] = set()

    async def end(self) -> None:
        """End the workers."""
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(self.searcher.kill(), self.desk.kill())
        self.journal.close()

    def start(
        self, work: Awaitable[m.Answer | None], told: Callable[[m.Answer], None] | None = None
    ) -> asyncio.Task[m.Answer]:
        """Do work beside what else is done; however it ends, somebody is told.

        Parameters
        ----------
        work
            What is done; an error of it is an answer with a problem, and one that is cancelled is interrupted.
        told
            Gets the answer; every window sees its problem, where it is left out.
        """

        async def done() -> m.Answer:
            try:
                answer = await work or m.Answer()
            except asyncio.CancelledError:
                # Another search has taken the place of this one.
                answer = m.Answer(interrupted=True)
            except Exception as error:
                answer = m.Answer(problem=problem(error))
            (told or self._complain)(answer)
            return answer

        def ended(task: asyncio.Task[m.Answer]) -> None:
            self._tasks.discard(task)
            if asyncio.iscoroutine(work):
                # It was never begun where its task was cancelled at once.
                work.close()

        task = asyncio.create_task(done())
        self._tasks.add(task)
        task.add_done_callback(ended)
        return task

    def _complain(self, answer: m.Answer) -> None:
        if answer.problem is not None:
            for window in self.windows:
                window.tell(m.Failed(0, answer.problem))

    @property
    def is_busy(self) -> bool:
        """Whether so much waits to be done that nothing more is begun."""
        return len(self._tasks) >= WORK

    # ---- what windows see

    def view(self) -> m.View:
        """All that every window shows."""
        document = self.document
        return m.View(
            model=self.model,
            arguments=document.arguments,
            ask=document.ask,
            settings=document.settings,
            results=[one for one in document.results if one.model == document.model],
            picked=document.picked,
            held=document.held,
            stars=document.stars,
            models=self.models,
            targets=self.targets,
            problem=self.problem,
            searching=self.searching,
            interrupted=self.is_interrupted,
            undo=self.journal.undoable,
            redo=self.journal.redoable,
            note=self.note,
            losses=self.losses,
        )

    def welcome(self, window: Window, command: int) -> None:
        """Give a window the whole state."""
        self.windows.add(window)
        window.tell(m.State(command, session=self.journal.name, rev=self._rev, view=self.view()))
        if self.journal.loss:
            window.tell(m.Failed(0, m.Problem("step-lost", self.journal.loss)))
        for kind, data in self.ghosts.items():
            window.put(data, kind)

    def tell_all(self) -> None:
        """Send what has changed since the last time."""
        now = msgspec.to_builtins(self.view())
        changes = {name: value for name, value in now.items() if self._told.get(name, ...) != value}
        if changes:
            self._told = now
            self._rev += 1
            for window in self.windows:
                window.tell(m.Patch(rev=self._rev, changes=changes))

    def reported(self, report: Any, payload: bytes) -> None:
        """Pass on what a worker says while it works."""
        if isinstance(report, m.Progressed) and self.searching is not None:
            run = self.searching.run
            self.searching = m.Searching(run, report.done, report.best, report.seconds)
            event = m.Patch(rev=self._rev, changes={"searching": msgspec.to_builtins(self.searching)})
            for window in self.windows:
                window.put(msgspec.json.encode(event).decode(), "searching")
        elif isinstance(report, m.Shape | m.Picture):
            report.id = 0
            data = frame(msgspec.json.encode(report), payload)
            if report.what == "result" and report.key is not None:
                self.keep(report.key, report.detail, data)
            for window in self.windows:
                window.put(data, newest(report))

    # ---- steps

    def step(self, name: str, changes: dict[str, Any]) -> None:
        """Do a step, on the disk first."""
        self.journal.step(name, msgspec.to_builtins(changes))
        self.turned()

    def turned(self) -> None:
        """Show the document at the journal's head."""
        self.document = self.journal.document()
        self.tell_all()

    def placed(self, name: str, old: m.Key | None, found: list[m.Outcome]) -> None:
        """Put one outcome in the place of the result that it came from, or several behind it."""
        results: list[m.Outcome] = []
        if old not in {one.key for one in self.document.results}:
            # It was taken back meanwhile.
            results += found
        for one in self.document.results:
            if one.key != old:
                results.append(one)
                continue
            if len(found) > 1 or one.key in self.document.stars:
                results.append(one)
            results += found
        self.step(name, {"results": results, "picked": found[0].key})

    # ---- results

    def source(self, key: m.Key | None) -> dict[str, Any]:
        """Where a worker finds a result; refused where there is none."""
        if key is None or not self.journal.runs_file(key.run).is_file():
            raise Refused("no-result", "there is no such result; run a search first")
        return {"source": str(self.journal.runs_file(key.run)), "number": key.number}

    def fresh_run(self) -> dict[str, Any]:
        """The number and the file of a run that a command makes at once."""
        number = self.journal.run()
        self.journal.ended()
        return {"run": number, "file": str(self.journal.runs_file(number))}

    def keep(self, key: m.Key, detail: str, data: bytes) -> None:
        """Keep the shape of a result ready."""
        self._shapes[key, detail] = data
        while sum(map(len, self._shapes.values())) > SHAPES:
            self._shapes.popitem(last=False)

    def shape(self, key: m.Key, detail: str) -> bytes | None:
        """The shape of a result, where it is ready."""
        return self._shapes.get((key, detail))

    # ---- what is asked

    def question(self) -> m.Question:
        """What a search is to find, as a worker reads it."""
        document = self.document
        ask = document.ask
        target = None if ask.target is None else self._read(ask.target)
        ask = msgspec.structs.replace(
            ask, target=target, obstacles=[self._read(one) for one in ask.obstacles]
        )
        hold: dict[str, Any] = {}
        for part in document.held:
            hold |= part.choices
        file = self.drawing_file(document.model)
        return m.Question(document.model or "", document.arguments, ask, document.settings, hold, file)

    def drawing_file(self, reference: str | None) -> str:
        """Where a drawing is that was sent, by its reference; empty for anything else."""
        name = (reference or "").removeprefix("drawing:upload:")
        place = self.journal.folder / "uploads" / name
        is_sent = reference != name and DRAWING.fullmatch(name) is not None and place.is_file()
        return str(place.resolve()) if is_sent else ""

    def _read(self, solid: m.TargetAsk) -> m.TargetAsk:
        """A solid with the file that a worker reads."""
        return msgspec.structs.replace(solid, source=self.file_of(solid.source) or solid.source)

    def file_of(self, source: str) -> str | None:
        """What a worker reads for a target's source; None where there is no such target."""
        if source.startswith("upload:"):
            place = self.journal.folder / "uploads" / f"{source.removeprefix('upload:')}.stl"
            is_hash = len(source) == 71 and all(c in "0123456789abcdef" for c in source[7:])
            return str(place.resolve()) if is_hash and place.is_file() else None
        return source if source in {*self.targets, "box", "ball", "column"} else None


def of_model(outcomes: list[m.Outcome], model: str) -> list[m.Outcome]:
    """Results with the reference of their model."""
    return [msgspec.structs.replace(one, model=model) for one in outcomes]
