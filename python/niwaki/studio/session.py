"""A session: commands in, steps in the journal, patches and shapes out.

It decides; workers do. A search runs in one worker and can be stopped; everything that has to be quick (a part that is
clicked, a slider, a file) is the other worker's, so a search never makes the page wait.
"""

from __future__ import annotations

import asyncio
import hashlib
import secrets
from collections import OrderedDict
from collections.abc import Coroutine
from pathlib import Path
from typing import Any

import msgspec

from niwaki.studio import messages as m
from niwaki.studio.frames import frame
from niwaki.studio.journal import Journal
from niwaki.studio.process import Worker
from niwaki.studio.window import Window, newest

#: Bytes of shapes that are kept ready.
SHAPES = 256 << 20


class Session:
    """One session and its open windows.

    Parameters
    ----------
    folder
        Where it is stored; a session that is there goes on.
    files
        References of models that may be chosen beside those of the gallery; each of a file that was named at the start.
    """

    def __init__(self, folder: Path, files: list[str]) -> None:
        self.journal = Journal(folder)
        self.document = self.journal.document()
        self.windows: set[Window] = set()
        self.files = files
        self.rev = 0
        self._searcher, self._desk = Worker(), Worker()
        self._models: list[m.ModelInfo] = []
        self._targets: list[str] = []
        self._model: m.ModelInfo | None = None
        self._problem: m.Problem | None = None
        self._searching: m.Searching | None = None
        self._interrupted = self.journal.running is not None
        self._shapes: OrderedDict[tuple[m.Key, str], bytes] = OrderedDict()
        self._ghost: bytes | None = None
        self._told: dict[str, Any] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._search: asyncio.Task[None] | None = None
        self._wanted: dict[str, m.Choose] = {}
        self._ready = asyncio.Event()

    # ---- begin and end

    async def begin(self) -> None:
        """Learn which models there are, and show the session's own."""
        answer = await self._desk.do(m.ListModels(files=self.files))
        self._models, self._targets, self._problem = answer.models, answer.targets, answer.problem
        if answer.problem is not None and self.files:
            # A file with an error does not hide the gallery.
            rest = await self._desk.do(m.ListModels(files=[]))
            broken = [m.ModelInfo(file, is_file=True) for file in self.files]
            self._models, self._targets = [*broken, *rest.models], rest.targets
        if self.document.model is None and self._models:
            self._step("model", {"model": self._models[0].reference})
        await self._load(keep=self._problem)
        self._ready.set()
        if self.document.model is not None:
            # The first search finds its process started.
            await self._searcher.do(m.Load(reference=self.document.model))

    async def end(self) -> None:
        """End the workers."""
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(self._searcher.kill(), self._desk.kill())
        self.journal.close()

    def _start(self, work: Coroutine[Any, Any, None]) -> asyncio.Task[None]:
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task

    # ---- what windows see

    def view(self) -> m.View:
        """All that every window shows."""
        document = self.document
        return m.View(
            model=self._model,
            arguments=document.arguments,
            ask=document.ask,
            settings=document.settings,
            results=[one for one in document.results if one.model == document.model],
            picked=document.picked,
            pins=document.pins,
            stars=document.stars,
            models=self._models,
            targets=self._targets,
            problem=self._problem,
            searching=self._searching,
            interrupted=self._interrupted,
            undo=self.journal.undoable,
            redo=self.journal.redoable,
        )

    def welcome(self, window: Window, command: int) -> None:
        """Give a window the whole state."""
        window.tell(m.State(command, session=self.journal.name, rev=self.rev, view=self.view()))
        if self._ghost is not None:
            window.put(self._ghost)

    def _tell_all(self) -> None:
        """Send what has changed since the last time."""
        now = msgspec.to_builtins(self.view())
        changes = {name: value for name, value in now.items() if self._told.get(name, ...) != value}
        if changes:
            self._told = now
            self.rev += 1
            for window in self.windows:
                window.tell(m.Patch(rev=self.rev, changes=changes))

    def _step(self, name: str, changes: dict[str, Any]) -> None:
        """Do a step, on the disk first."""
        self.journal.step(name, msgspec.to_builtins(changes))
        self.document = self.journal.document()
        self._tell_all()

    # ---- commands

    async def obey(self, window: Window, command: m.AnyCommand) -> None:
        """Carry a command out; what it cannot do it says to the window that asked."""
        await self._ready.wait()
        match command:
            case m.Hello():
                if command.protocol != m.PROTOCOL:
                    self._fail(window, command.id, "protocol", f"this studio speaks protocol {m.PROTOCOL}")
                    return
                self.windows.add(window)
                self.welcome(window, command.id)
                return
            case m.Run():
                await self._run(window, command)
                return
            case m.Stop():
                self._start(self._searcher.stop())
            case m.Undo() | m.Redo():
                self._turn(isinstance(command, m.Undo))
            case m.ChooseModel() | m.SetAsk() | m.Set():
                if not self._configured(window, command):
                    return
            case m.Pick() | m.Star() | m.FreeParts():
                if not self._marked(window, command):
                    return
            case m.Choose():
                self._wanted[command.phase] = command
                self._start(self._chosen(window, command))
                return
            case _:
                self._start(self._worked(window, command))
                return
        window.tell(m.Done(command.id))

    def _fail(self, window: Window, command: int, code: str, text: str) -> None:
        window.tell(m.Failed(command, m.Problem(code, text)))

    def _answered(self, window: Window, command: int, answer: m.Answer) -> bool:
        """Tell the window how a job has ended; whether it ended well."""
        if answer.problem is not None:
            window.tell(m.Failed(command, answer.problem))
            return False
        window.tell(m.Done(command, answer.interrupted))
        return True

    def _configured(self, window: Window, command: m.ChooseModel | m.SetAsk | m.Set) -> bool:
        """Another model, ask, argument or setting."""
        if isinstance(command, m.ChooseModel):
            if command.reference not in {one.reference for one in self._models}:
                text = f"`{command.reference}` is no model of the gallery, and was not named at the start"
                self._fail(window, command.id, "unknown-model", text)
                return False
            fresh = {"model": command.reference, "arguments": {}, "ask": m.Ask(), "pins": []}
            self._step("model", {**fresh, "results": self.document.starred(), "picked": None})
            self._start(self._load())
        elif isinstance(command, m.SetAsk):
            source = command.ask.target.source if command.ask.target is not None else None
            if source is not None and self._file_of(source) is None:
                self._fail(window, command.id, "no-target", f"there is no target `{source}`")
                return False
            self._step("ask", {"ask": command.ask})
            self._start(self._load_ghost(window))
        else:
            changes: dict[str, Any] = {}
            if command.settings is not None:
                changes["settings"] = command.settings
            if command.arguments is not None:
                changes["arguments"] = {**self.document.arguments, **command.arguments}
            if changes:
                self._step("set", changes)
            if command.arguments is not None and self.document.picked is not None:
                self._start(self._reshape(window))
        return True

    def _marked(self, window: Window, command: m.Pick | m.Star | m.FreeParts) -> bool:
        """Another result picked, a star, a part set free."""
        document = self.document
        if isinstance(command, m.FreeParts):
            left = [one for one in document.pins if command.parts and one.part not in command.parts]
            self._step("free", {"pins": left})
            return True
        if command.key not in {one.key for one in document.results}:
            self._fail(window, command.id, "no-result", "that result is not in the gallery")
            return False
        if isinstance(command, m.Pick):
            if command.key != document.picked:
                self._step("pick", {"picked": command.key})
        else:
            others = [one for one in document.stars if one != command.key]
            self._step("star", {"stars": [*others, command.key] if command.on else others})
        return True

    def _turn(self, back: bool) -> None:
        """Undo or redo."""
        before = self.document
        if self.journal.undo() if back else self.journal.redo():
            self.document = self.journal.document()
            self._tell_all()
            if (before.model, before.ask) != (self.document.model, self.document.ask):
                self._start(self._load())

    # ---- models and targets

    async def _load(self, keep: m.Problem | None = None) -> None:
        """Read the session's model, again where its file has changed."""
        reference = self.document.model
        if reference is None:
            return
        answer = await self._desk.do(m.Load(reference=reference))
        self._problem = answer.problem or keep
        if answer.models:
            self._model = answer.models[0]
            self._models = [self._model if one.reference == reference else one for one in self._models]
        elif self._model is None or self._model.reference != reference:
            self._model = next((one for one in self._models if one.reference == reference), None)
        self._tell_all()
        if answer.problem is None:
            await self._load_ghost(None)

    async def _load_ghost(self, window: Window | None) -> None:
        """Show the target, or that there is none."""

        def report(header: Any, payload: bytes) -> None:
            found.append(frame(msgspec.json.encode(header), payload))

        found: list[bytes] = []
        answer = await self._desk.do(m.Ghost(question=self._question()), report)
        if answer.problem is not None and window is not None:
            window.tell(m.Failed(0, answer.problem))
        self._ghost = found[0] if found else frame(msgspec.json.encode(m.Shape(what="ghost")))
        for one in self.windows:
            one.put(self._ghost, "ghost")

    async def reload(self, paths: set[Path]) -> None:
        """Models whose files have changed: read again, and the picked result run again with its choices."""
        reference = self.document.model
        if reference is None or Path(reference.rpartition(":")[0] or reference) not in paths:
            return
        await self._load()
        if self._problem is None and self.document.picked is not None:
            await self._reshape(None)

    def _file_of(self, source: str) -> str | None:
        """What a worker reads for a target's source; None where there is no such target."""
        if source.startswith("upload:"):
            place = self.journal.folder / "uploads" / f"{source.removeprefix('upload:')}.stl"
            is_hash = len(source) == 71 and all(c in "0123456789abcdef" for c in source[7:])
            return str(place.resolve()) if is_hash and place.is_file() else None
        return source if source in {*self._targets, "box", "ball", "column"} else None

    def _question(self) -> m.Question:
        document = self.document
        ask = document.ask
        if ask.target is not None:
            source = self._file_of(ask.target.source) or ask.target.source
            ask = msgspec.structs.replace(ask, target=msgspec.structs.replace(ask.target, source=source))
        lock: dict[str, Any] = {}
        for pin in document.pins:
            lock |= pin.choices
        return m.Question(document.model or "", document.arguments, ask, document.settings, lock)

    # ---- searching

    async def _run(self, window: Window, command: m.Run) -> None:
        if self.document.model is None:
            self._fail(window, command.id, "no-model", "choose a model first")
            return
        await self._end_search()
        self._interrupted = False
        number = self.journal.run()
        self._searching = m.Searching(number)
        self._tell_all()
        self._search = self._start(self._searched(window, command.id, number))

    async def _end_search(self) -> None:
        """Stop a search that runs, and leave out what it found."""
        if self._search is not None and not self._search.done():
            self._search.cancel()
            await self._searcher.kill()

    async def _searched(self, window: Window, command: int, number: int) -> None:
        seed = self.document.settings.seed
        file = str(self.journal.runs_file(number))
        job = m.Grow(
            question=self._question(),
            run=number,
            seed=secrets.randbits(53) if seed is None else seed,
            file=file,
        )
        answer = await self._searcher.do(job, self._reported)
        self._searching = None
        self.journal.ended()
        found = _of_model(answer.outcomes, job.question.model)
        if found:
            picked = found[0].key if found[0].model == self.document.model else self.document.picked
            self._step("run", {"results": [*self.document.starred(), *found], "picked": picked})
        self._tell_all()
        self._answered(window, command, answer)

    def _reported(self, report: Any, payload: bytes) -> None:
        """Pass on what a worker says while it works."""
        if isinstance(report, m.Progressed):
            if self._searching is not None:
                run = self._searching.run
                self._searching = m.Searching(run, report.done, report.best, report.seconds)
                event = m.Patch(rev=self.rev, changes={"searching": msgspec.to_builtins(self._searching)})
                for window in self.windows:
                    window.put(msgspec.json.encode(event).decode(), "searching")
        elif isinstance(report, m.Shape):
            report.id = 0
            data = frame(msgspec.json.encode(report), payload)
            if report.what == "result" and report.key is not None:
                self._keep(report.key, report.detail, data)
            for window in self.windows:
                window.put(data, newest(report))

    def _keep(self, key: m.Key, detail: str, data: bytes) -> None:
        self._shapes[key, detail] = data
        while sum(map(len, self._shapes.values())) > SHAPES:
            self._shapes.popitem(last=False)

    # ---- the desk: what has to be quick

    async def _worked(self, window: Window, command: m.AnyCommand) -> None:
        """Commands that a worker carries out."""
        match command:
            case m.PinParts():
                await self._pinned(window, command)
            case m.Reroll():
                await self._rerolled(window, command)
            case m.Describe():
                await self._described(window, command)
            case m.Show():
                await self._shown(window, command)
            case m.Export():
                await self._exported(window, command)

    def _source(self, key: m.Key | None) -> dict[str, Any]:
        """Where a worker finds a result."""
        assert key is not None
        return {"source": str(self.journal.runs_file(key.run)), "number": key.number}

    def _is_there(self, window: Window, command: int, key: m.Key | None) -> bool:
        there = key is not None and self.journal.runs_file(key.run).is_file()
        if not there:
            self._fail(window, command, "no-result", "there is no such result; run a search first")
        return there

    async def _pinned(self, window: Window, command: m.PinParts) -> None:
        picked = self.document.picked
        if not self._is_there(window, command.id, picked):
            return
        answer = await self._desk.do(m.Hold(**self._source(picked), parts=command.parts))
        if answer.problem is None:
            left = [one for one in self.document.pins if one.part not in command.parts]
            self._step("pin", {"pins": [*left, *answer.pins]})
        self._answered(window, command.id, answer)

    async def _rerolled(self, window: Window, command: m.Reroll) -> None:
        picked = self.document.picked
        if not self._is_there(window, command.id, picked):
            return
        number = self.journal.run()
        self.journal.ended()
        job = m.Regrow(
            **self._source(picked),
            question=self._question(),
            part=command.part,
            count=command.count,
            run=number,
            seed=secrets.randbits(53),
            file=str(self.journal.runs_file(number)),
        )
        answer = await self._desk.do(job, self._reported)
        if answer.outcomes:
            self._placed("reroll", picked, _of_model(answer.outcomes, job.question.model))
        self._answered(window, command.id, answer)

    def _placed(self, name: str, old: m.Key | None, found: list[m.Outcome]) -> None:
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
        self._step(name, {"results": results, "picked": found[0].key})

    async def _chosen(self, window: Window, command: m.Choose) -> None:
        """A slider: while it moves, the newest value is shown; at its end there is a result."""
        if self._wanted.get(command.phase) is not command:
            window.tell(m.Done(command.id))
            return
        await self._changed(
            window, command.id, {command.address: command.value}, command.phase == "end", "choose"
        )

    async def _reshape(self, window: Window | None) -> None:
        """The picked result with the present model and arguments."""
        await self._changed(window, 0, {}, True, "reload")

    async def _changed(
        self, window: Window | None, command: int, changes: dict[str, Any], is_end: bool, origin: str
    ) -> None:
        picked = self.document.picked
        if picked is None or not self.journal.runs_file(picked.run).is_file():
            return
        number = self.journal.run() if is_end else 0
        if is_end:
            self.journal.ended()
        job = m.Change(
            **self._source(picked),
            question=self._question(),
            changes=changes,
            run=number,
            file=str(self.journal.runs_file(number)) if is_end else "",
            origin=origin,
        )
        answer = await self._desk.do(job, self._reported)
        if answer.outcomes:
            self._placed(origin, picked, _of_model(answer.outcomes, job.question.model))
        if window is not None:
            self._answered(window, command, answer)
        elif answer.problem is not None:
            self._problem = answer.problem
            self._tell_all()

    async def _described(self, window: Window, command: m.Describe) -> None:
        if not self._is_there(window, command.id, command.key):
            return

        def report(found: Any, payload: bytes) -> None:
            if isinstance(found, m.Described):
                window.tell(msgspec.structs.replace(found, id=command.id))

        job = m.DescribeRun(**self._source(command.key), question=self._question(), key=command.key)
        self._answered(window, command.id, await self._desk.do(job, report))

    async def _shown(self, window: Window, command: m.Show) -> None:
        if not self._is_there(window, command.id, command.key):
            return

        def report(found: Any, payload: bytes) -> None:
            found.id = 0
            self._keep(command.key, command.detail, frame(msgspec.json.encode(found), payload))

        answer = m.Answer()
        if (command.key, command.detail) not in self._shapes:
            job = m.ShowRun(**self._source(command.key), key=command.key, detail=command.detail)
            answer = await self._desk.do(job, report)
        if self._answered(window, command.id, answer):
            window.put(self._shapes[command.key, command.detail])

    async def _exported(self, window: Window, command: m.Export) -> None:
        if not self._is_there(window, command.id, command.key):
            return
        folder = self.journal.folder / "files" / f"{command.key.run}-{command.key.number}"
        job = m.WriteFile(
            **self._source(command.key), format=command.format, folder=str(folder), scale=command.scale
        )
        answer = await self._desk.do(job)
        if answer.problem is None:
            data = await asyncio.to_thread(Path(answer.path).read_bytes)
            name = hashlib.sha256(data).hexdigest()
            place = self.journal.folder / "files" / name
            if not place.is_dir():
                place.mkdir()
                (place / Path(answer.path).name).write_bytes(data)
            window.tell(m.File(command.id, name, Path(answer.path).name))
        self._answered(window, command.id, answer)


def _of_model(outcomes: list[m.Outcome], model: str) -> list[m.Outcome]:
    """Results with the reference of their model."""
    return [msgspec.structs.replace(one, model=model) for one in outcomes]
