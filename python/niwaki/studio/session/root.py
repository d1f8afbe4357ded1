"""The folder that was named at the start: commands may name files below it, and no others."""

from __future__ import annotations

from pathlib import Path

from niwaki.studio.problems import CommandError

#: Formats of meshes that a target may have.
MESHES = (".obj", ".stl", ".ply", ".glb", ".gltf")
#: Formats of programs.
PROGRAMS = (".py", ".scad")


def is_program(reference: str) -> bool:
    """Whether a reference is that of a file with models, with or without a function."""
    place = reference.rpartition(":")[0] if not reference.lower().endswith(PROGRAMS) else reference
    return place.lower().endswith(PROGRAMS)


class Root:
    """A folder below which commands may name files."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()

    def path(self, name: str) -> Path:
        """Return the path of a name below the folder, with all symbolic links resolved.

        Raises
        ------
        CommandError
            `outside-folder`: the path leads out of the folder.
        """
        try:
            place = (self.folder / name).resolve()
        except (OSError, RuntimeError, ValueError) as error:
            raise CommandError("outside-folder", f"`{name}` is not a path: {error}") from error
        if not place.is_relative_to(self.folder) or place == self.folder:
            text = (
                f"`{name}` is not below {self.folder}, the folder that was named at the start\n"
                f"  name a file by its path from this folder, such as `models/tower.py`"
            )
            raise CommandError("outside-folder", text)
        return place

    def reference(self, name: str) -> str:
        """Return the reference of a model with the resolved path of its file."""
        if name.lower().endswith(PROGRAMS):
            return str(self.path(name))
        place, _, function = name.rpartition(":")
        return f"{self.path(place)}:{function}"
