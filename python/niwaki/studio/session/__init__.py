"""A session: commands in, steps in the journal, patches and shapes out.

The session decides, and its two workers do the work. A search runs in one worker and can be stopped. Quick work (a part
that is clicked, a slider, a file) goes to the other worker, so a search never makes the page wait.

- `state`      the data of a session, its view for windows, and its steps
- `dispatch`   the function of each command
- `loading`    models and targets, loaded again after a change of a file
- `setting`    goals, arguments and settings
- `marking`    the active result, stars, undo and redo
- `searching`  a search, its progress and its end
- `holding`    held parts
- `reshaping`  new forms of a result: a part grown again, a choice with a new value
- `dragging`   dragged parts
- `rewriting`  changes of the model's file
- `root`       the folder below which commands may name files
- `files`      files that are read and written
- `reporting`  fields of the state; reports on models
- `showing`    choices and shapes of a result; the check of a structure
- `exporting`  files
"""

from niwaki.studio.session.dispatch import obey
from niwaki.studio.session.loading import begin, reload
from niwaki.studio.session.state import Session

__all__ = ["Session", "begin", "obey", "reload"]
