"""The function of each command.

A function that returns None has finished before the window's next command. A function that waits for a worker is
`async`: it runs beside other commands and returns the worker's answer. A function raises `CommandError` for a command
that cannot be carried out; the window receives this and any other error.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any

from niwaki.studio import messages as m
from niwaki.studio.problems import CommandError, problem
from niwaki.studio.session import (
    dragging,
    exporting,
    files,
    holding,
    loading,
    marking,
    reporting,
    reshaping,
    rewriting,
    searching,
    setting,
    showing,
)
from niwaki.studio.session.state import Session
from niwaki.studio.window import Window

Work = Callable[[Session, Window, Any], Awaitable[m.Answer | None] | None]

COMMANDS: dict[type[m.Command], Work] = {
    m.ChooseModel: loading.choose_model,
    m.SetAsk: setting.set_ask,
    m.Set: setting.set_values,
    m.Look: reporting.look,
    m.Read: files.read,
    m.Write: files.write,
    m.Check: reporting.check,
    m.Preview: reporting.preview,
    m.Explain: reporting.explain,
    m.Fit: reporting.fit,
    m.Run: searching.run,
    m.Stop: searching.stop,
    m.HoldParts: holding.hold,
    m.FreeParts: holding.free,
    m.Reroll: reshaping.reroll,
    m.Choose: reshaping.choose,
    m.Drag: dragging.drag,
    m.Propose: rewriting.propose,
    m.Rewrite: rewriting.rewrite,
    m.Describe: showing.describe,
    m.Show: showing.show,
    m.Judge: showing.judge,
    m.ShowDifference: showing.show_difference,
    m.Pick: marking.pick,
    m.Star: marking.star,
    m.Undo: marking.undo,
    m.Redo: marking.redo,
    m.Export: exporting.export,
}


async def obey(session: Session, window: Window, command: m.AnyCommand) -> None:
    """Carry out a command; the window receives an answer in every case."""
    await session.ready.wait()
    try:
        if isinstance(command, m.Hello):
            if command.protocol != m.PROTOCOL:
                raise CommandError("protocol", f"this studio uses protocol {m.PROTOCOL}")
            session.welcome(window, command.id)
            return
        if session.is_busy and not isinstance(command, m.Stop):
            raise CommandError("busy", "too many commands are waiting; wait until some of them are done")
        work = COMMANDS[type(command)](session, window, command)
    except Exception as error:
        window.tell(m.Failed(command.id, problem(error)))
        return
    if work is None:
        window.tell(m.Done(command.id))
        return

    def report(answer: m.Answer) -> None:
        if answer.problem is not None:
            window.tell(m.Failed(command.id, answer.problem))
        else:
            window.tell(m.Done(command.id, answer.interrupted))

    session.start(work, report)
