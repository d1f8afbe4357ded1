"""A session: commands in, steps in the journal, patches and shapes out.

It decides; workers do. A search runs in one worker and can be stopped; everything that has to be quick (a part that is
clicked, a slider, a file) is the other worker's, so a search never makes the page wait.

- `state`      what a session has, what windows see of it, and how a step is done
- `dispatch`   which function carries out which command: a kind of command is a function and a line there
- `loading`    models and targets, read again where a file has changed
- `setting`    the ask, arguments and settings
- `marking`    picked results, stars; undo and redo
- `searching`  a search, what it shows meanwhile, its end
- `holding`    held parts
- `reshaping`  a part grown again, a choice with another value: results in the place of a result
- `dragging`   a part that is dragged
- `rewriting`  changes of the model's file
- `showing`    choices and shapes of a result; whether a structure stands
- `exporting`  files
"""

from niwaki.studio.session.dispatch import obey
from niwaki.studio.session.loading import begin, reload
from niwaki.studio.session.state import Session

__all__ = ["Session", "begin", "obey", "reload"]
