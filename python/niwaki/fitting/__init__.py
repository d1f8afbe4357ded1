"""Fitting models that somebody else wrote: functions, files and programs of which only parameters and a mesh are known.

| module | contents |
| --- | --- |
| `goals` | what a scene is scored by: sketches of the package, and numbers with a tolerance |
| `loop` | `FitLoop`: asks for points, and takes what came of them |
| `answers` | the answers of a search: the best, a table, variants, intervals, what moves what |
| `effects` | a picture of what moves what |
| `generator`, `loading` | the interface of a model that somebody else wrote; which generator a model is |
| `functions`, `draws` | Python functions: ranges from their signature, or draws while they run |
| `openscad`, `customizer` | OpenSCAD files, and the parameters of their Customizer |
| `blend`, `node_ranges` | Blender files: the sockets of a Geometry Nodes modifier, and their ranges |
| `in_blender` | what runs inside of Blender |
| `commands` | programs that write a mesh file |
| `discovery` | the parameters of a function that is defined by run, and when they are used |
| `meshes` | meshes of what a generator returns |
| `models` | the text of a model that calls a generator, for the studio |
| `protocol` | answers of worker processes |
| `worker`, `pool` | calls in worker processes: what a worker does, and how the parent process drives them |
| `archive` | all evaluations, in a folder: cache, checkpoint and table |
| `align` | place, turn and size of a mesh as further parameters |
| `fronts` | a camera for an image that comes without one |
| `result` | the result of `fit`: evaluations with their meshes |
| `entry` | `fit`: asks the loop, has points evaluated, and tells what came of them |

The engine's proposer (`crates/fit`) decides which point is asked next.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
