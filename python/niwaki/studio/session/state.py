"""The state of a session: journal, windows and workers; the view that windows show; the steps."""

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
from niwaki.studio.problems import CommandError as CommandError
from niwaki.studio.problems import problem
from niwaki.studio.process import Stamp, Worker
from niwaki.studio.session.root import MESHES, Root
from niwaki.studio.window import Window, newest

#: The file name of an uploaded drawing.
DRAWING = re.compile(r"[0-9a-f]{64}\.(svg|png|webp|bmp|gif|tif|tiff|jpg|jpeg)")
#: Bytes of shapes that are kept in memory.
SHAPES = 256 << 20
#: Commands that may wait for a worker at one time.
WORK = 4_000
#: Seconds that a job of the desk may take.
PATIENCE = 300.0


class Session:
    """A session and its open windows.

    Parameters
    ----------
    folder
        The folder of the session; a session that is there resumes.
    files
        References of models in files that were named at the start.
    trust
        Whether unchanged files that stored runs name may be run for their host functions.
    root
        The folder below which commands may name, read and write files; None for no folder.

    Attributes
    ----------
    searcher, desk : Worker
        The process that searches, and the process for quick work.
    ready : asyncio.Event
        Set when the session is ready for commands.
    models, targets
        The lists of models and targets.
    model
        The present model, as last loaded.
    save, settled
        The file of the last reload and its bytes; the time from which the same bytes are another save.
    problem, note, losses
        The error of the model's file; a note on the goals; a note on impossible runs of the last search.
    searching
        The progress of the running search.
    search
        The task of the running search.
    ghosts
        Frames of the target, of obstacles and of a run of the model, by kind.
    glimpses
        Frames with a run of each of the first models of the list, by kind.
    sizes
        The sizes of the model and of its target, and offered placements.
    slider
        The newest value of a choice, by the phase of its slider.
    dragged, dragging
        The newest point of a dragged part; a lock that a drag to a point holds.
    """

    def __init__(self, folder: Path, files: list[str], trust: bool = False, root: Path | None = None) -> None:
        self.journal = Journal(folder)
        self.document = self.journal.document()
        self.windows: set[Window] = set()
        self.files = files
        self.root = None if root is None else Root(root)
        # A program may write the models below a folder: they write there and into the session alone.
        below = (
            []
            if root is None
            else [f"--below={root.resolve()}", f"--written={root.resolve()}", f"--written={folder.resolve()}"]
        )
        words = [*(["--trust"] if trust else []), *below, *files]
        slow: dict[str, Stamp] = {}
        self.searcher = Worker(*words, slow=slow)
        self.desk = Worker(*words, patience=PATIENCE, slow=slow)
        self.ready = asyncio.Event()
        self.models: list[m.ModelInfo] = []
        self.targets: list[str] = []
        self.model: m.ModelInfo | None = None
        self.save: tuple[Path, bytes | None] | None = None
        self.settled = 0.0
        self.problem: m.Problem | None = None
        self.note = self.losses = ""
        self.searching: m.Searching | None = None
        self.search: asyncio.Task[m.Answer] | None = None
        self.is_interrupted = self.journal.running is not None
        self.slider: dict[str, m.Choose] = {}
        self.dragged: m.Drag | None = None
        self.dragging = asyncio.Lock()
        self.ghosts: dict[str, bytes] = {}
        self.glimpses: dict[str, bytes] = {}
        self.sizes = m.Sizes()
        self._shapes: OrderedDict[tuple[m.Key, str], bytes] = OrderedDict()
        self._last: dict[str, Any] = {}
        self._rev = 0
        self._tasks: set[asyncio.Task[Any]] = set()

    async def end(self) -> None:
        """End the workers, and close the journal."""
        tasks = [*self._tasks]
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        await asyncio.gather(self.searcher.kill(), self.desk.kill())
        self.journal.close()

    def start(
        self, work: Awaitable[m.Answer | None], report: Callable[[m.Answer], None] | None = None
    ) -> asyncio.Task[m.Answer]:
        """Do work in a task of its own, and report its end.

        Parameters
        ----------
        work
            The work. An error becomes an answer with a problem; cancelled work has an interrupted answer.
        report
            Receives the answer; when left out, every window shows its problem.
        """

        async def done() -> m.Answer:
            try:
                answer = await work or m.Answer()
            except asyncio.CancelledError:
                # Another search has taken the place of this one.
                answer = m.Answer(interrupted=True)
            except Exception as error:
                answer = m.Answer(problem=problem(error))
            (report or self.report_problem)(answer)
            return answer

        def close(task: asyncio.Task[m.Answer]) -> None:
            self._tasks.discard(task)
            if asyncio.iscoroutine(work):
                # A task that was cancelled at once has never started its coroutine.
                work.close()

        task = asyncio.create_task(done())
        self._tasks.add(task)
        task.add_done_callback(close)
        return task

    def report_problem(self, answer: m.Answer) -> None:
        """Tell all windows why a job failed, if it did."""
        if answer.problem is not None:
            for window in self.windows:
                window.tell(m.Failed(0, answer.problem))

    @property
    def is_busy(self) -> bool:
        """Whether so many tasks wait that no more may start."""
        return len(self._tasks) >= WORK

    # ---- the view of windows

    def view(self) -> m.View:
        """Return the state that every window shows."""
        document = self.document
        return m.View(
            model=self.model,
            arguments=document.arguments,
            ask=document.ask,
            settings=document.settings,
            results=[outcome for outcome in document.results if outcome.model == document.model],
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
            sizes=self.sizes,
        )

    def welcome(self, window: Window, command: int) -> None:
        """Send a window the whole state."""
        self.windows.add(window)
        window.tell(m.State(command, session=self.journal.name, rev=self._rev, view=self.view()))
        if self.journal.loss:
            window.tell(m.Failed(0, m.Problem("step-lost", self.journal.loss)))
        for kind, data in {**self.ghosts, **self.glimpses}.items():
            window.put(data, kind)

    def tell_all(self) -> None:
        """Send all windows the changes since the last time."""
        now = msgspec.to_builtins(self.view())
        changes = {name: value for name, value in now.items() if self._last.get(name, ...) != value}
        if changes:
            self._last = now
            self._rev += 1
            for window in self.windows:
                window.tell(m.Patch(rev=self._rev, changes=changes))

    def forward(self, report: Any, payload: bytes) -> None:
        """Send a worker's report to all windows."""
        if isinstance(report, m.Progressed) and self.searching is not None:
            run = self.searching.run
            self.searching = m.Searching(run, report.done, report.best, report.seconds, report.fit)
            event = m.Patch(rev=self._rev, changes={"searching": msgspec.to_builtins(self.searching)})
            for window in self.windows:
                window.put(msgspec.json.encode(event).decode(), "searching")
        elif isinstance(report, m.Shape | m.Picture):
            report.id = 0
            data = frame(msgspec.json.encode(report), payload)
            if report.role == "result" and report.key is not None:
                self.keep(report.key, report.detail, data)
            for window in self.windows:
                window.put(data, newest(report))

    # ---- steps

    def step(self, name: str, changes: dict[str, Any]) -> None:
        """Do a step: write it to the disk, then show it."""
        self.journal.step(name, msgspec.to_builtins(changes))
        self.show_head()

    def show_head(self) -> None:
        """Show the document at the journal's head."""
        self.document = self.journal.document()
        self.tell_all()

    def replace(self, name: str, old: m.Key | None, new: list[m.Outcome]) -> None:
        """Replace a result by one new outcome, or insert several outcomes behind it."""
        results: list[m.Outcome] = []
        if old not in {outcome.key for outcome in self.document.results}:
            # An undo has removed the result meanwhile.
            results += new
        for outcome in self.document.results:
            if outcome.key != old:
                results.append(outcome)
                continue
            if len(new) > 1 or outcome.key in self.document.stars:
                results.append(outcome)
            results += new
        self.step(name, {"results": results, "picked": new[0].key})

    # ---- results

    def source(self, key: m.Key | None) -> dict[str, Any]:
        """Return the file and the number of a result, for a worker.

        Raises
        ------
        CommandError
            `no-result`.
        """
        if key is None or not self.journal.runs_file(key.run).is_file():
            raise CommandError("no-result", "there is no such result; run a search first")
        return {"source": str(self.journal.runs_file(key.run)), "number": key.number}

    def fresh_run(self) -> dict[str, Any]:
        """Return the number and the file of a run that a command makes at once."""
        number = self.journal.run()
        self.journal.end_run()
        return {"run": number, "file": str(self.journal.runs_file(number))}

    def keep(self, key: m.Key, detail: str, data: bytes) -> None:
        """Keep the shape of a result in memory."""
        self._shapes[key, detail] = data
        while sum(map(len, self._shapes.values())) > SHAPES:
            self._shapes.popitem(last=False)

    def shape(self, key: m.Key, detail: str) -> bytes | None:
        """Return the shape of a result, if it is in memory."""
        return self._shapes.get((key, detail))

    # ---- the question

    def question(self) -> m.Question:
        """Return the question of a search, as a worker reads it."""
        document = self.document
        ask = document.ask
        target = None if ask.target is None else self._with_file(ask.target)
        ask = msgspec.structs.replace(
            ask, target=target, obstacles=[self._with_file(solid) for solid in ask.obstacles]
        )
        hold: dict[str, Any] = {}
        for part in document.held:
            hold |= part.choices
        file = self.drawing_file(document.model)
        return m.Question(document.model or "", document.arguments, ask, document.settings, hold, file)

    def drawing_file(self, reference: str | None) -> str:
        """Return the path of an uploaded drawing by its reference; empty for other references."""
        name = (reference or "").removeprefix("drawing:upload:")
        place = self.journal.folder / "uploads" / name
        is_upload = reference != name and DRAWING.fullmatch(name) is not None and place.is_file()
        return str(place.resolve()) if is_upload else ""

    def _with_file(self, solid: m.TargetAsk) -> m.TargetAsk:
        """Replace the source of a solid by the file that a worker reads."""
        return msgspec.structs.replace(solid, source=self.file_of(solid.source) or solid.source)

    def file_of(self, source: str) -> str | None:
        """Return the file that a worker reads for a target's source; None without such a target."""
        if source.startswith("upload:"):
            place = self.journal.folder / "uploads" / f"{source.removeprefix('upload:')}.stl"
            is_hash = len(source) == 71 and all(c in "0123456789abcdef" for c in source[7:])
            return str(place.resolve()) if is_hash and place.is_file() else None
        if source in {*self.targets, "box", "ball", "column"}:
            return source
        if self.root is None or Path(source).suffix.lower() not in MESHES:
            return None
        return str(self.root.path(source))


def of_model(outcomes: list[m.Outcome], model: str) -> list[m.Outcome]:
    """Add the reference of their model to outcomes."""
    return [msgspec.structs.replace(outcome, model=model) for outcome in outcomes]
