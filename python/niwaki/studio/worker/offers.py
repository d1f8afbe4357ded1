"""What can be chosen: models of files, of the gallery, of structures, and drawings to colour."""

from __future__ import annotations

from niwaki import gallery, stacks, targets
from niwaki.lang.models import Model
from niwaki.shell.references import ModelReference
from niwaki.studio.messages import Answer, ListModels, Load
from niwaki.studio.worker import coloring, models


def listed(job: ListModels) -> Answer:
    """The models that can be chosen: those of the files first."""
    infos = []
    for file in job.files:
        infos.append(models.info(models.reference(file), file, is_file=True))
    for entry in gallery.entries():
        # A model without a target, a drawing or a score of its own makes no scene to look at.
        if entry.target_name is not None or entry.draws is not None:
            infos.append(models.info(ModelReference(entry.name, entry.model, entry), entry.name))
    structures = [name for name in stacks.__all__ if isinstance(getattr(stacks, name), Model)]
    infos += [models.info(models.reference(models.STACK + name), models.STACK + name) for name in structures]
    infos += coloring.listed()
    return Answer(models=infos, targets=[f"gallery:{name}" for name in targets.examples.TARGETS])


def loaded(job: Load) -> Answer:
    """A model, compiled so that its errors are seen; or a drawing."""
    if coloring.is_drawing(job.reference):
        return coloring.loaded(job)
    found = models.reference(job.reference)
    found.model.program()
    is_file = found.entry is None and not job.reference.startswith(models.STACK)
    answer = models.info(found, job.reference, is_file)
    if models.is_structure(job.reference):
        answer.kind = "structure"
    return Answer(models=[answer])
