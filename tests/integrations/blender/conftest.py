"""Collection rules: tests with `bpy` run only in a separate environment (`make test-blender`); their set-up."""

import os
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parent))

BPY = ("inside_blender", "meshes_in_blender", "fits_in_blender", "layouts", "node_trees", "rendering")
collect_ignore = [] if find_spec("bpy") else [f"{name}.py" for name in BPY]


@pytest.fixture(scope="session")
def installed() -> None:
    """Install the extension as a user does. Niwaki is only in its zip."""
    # `bpy` provides this module.
    import addon_utils
    import bpy

    addon_utils.enable("bl_pkg")
    with pytest.raises(ImportError):
        import niwaki
    done = bpy.ops.extensions.package_install_files(
        filepath=str(Path(os.environ["NIWAKI_ZIP"]).resolve()), repo="user_default", enable_on_install=True
    )
    assert done == {"FINISHED"}
    import niwaki

    assert Path(niwaki.__file__).is_relative_to(os.environ["BLENDER_USER_RESOURCES"])
