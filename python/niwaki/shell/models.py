"""`niwaki models`: the gallery, one line for each model, with the command that runs it."""

from __future__ import annotations

from niwaki.gallery import entries
from niwaki.shell.app import app


@app.command()
def models() -> None:
    """List the gallery: name, how to run it, target, title."""
    for entry in entries():
        grows = entry.target_name is not None or entry.draws is not None
        target = entry.target_name or entry.drawing_name or "-"
        print(f"{entry.name:<16} {'grow' if grows else 'sample':<7} {target:<16} {entry.title}")
    print(
        "\nniwaki grow NAME grows a model into its target; niwaki sample NAME samples a model without a target. "
        "niwaki grow NAME --target FILE grows a model with shapes into your own mesh."
    )
