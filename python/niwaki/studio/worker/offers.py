"""The lists of models and targets: models of files, of the gallery, of structures, and drawings to colour."""

from __future__ import annotations

from niwaki import gallery, stacks, targets
from niwaki.lang.models import Model
from niwaki.shell.references import ModelReference
from niwaki.studio.messages import Answer, ListModels, Load
from niwaki.studio.worker import coloring, models


def listed(job: ListModels) -> Answer:
    """List the models, with the models of files first."""
    infos = []
    for file in job.files:
        infos += [models.info(models.reference(name), name, is_file=True) for name in models.names_in(file)]
    for entry in gallery.entries():
        # A model with neither a target nor a drawing makes no scene to show.
        if entry.target_name is not None or entry.draws is not None:
            infos.append(models.info(ModelReference(entry.name, entry.model, entry), entry.name))
    structures = [name for name in stacks.__all__ if isinstance(getattr(stacks, name), Model)]
    infos += [models.info(models.reference(models.STACK + name), models.STACK + name) for name in structures]
    infos += coloring.listed()
    return Answer(models=infos, targets=[f"gallery:{name}" for name in targets.examples.TARGETS])


def loaded(job: Load) -> Answer:
    """Load a model and compile it, so that errors appear; or load a drawing."""
    if coloring.is_drawing(job.reference):
        return coloring.loaded(job)
    model = models.reference(job.reference)
    model.model.program()
    is_file = model.entry is None and not job.reference.startswith(models.STACK)
    answer = models.info(model, job.reference, is_file)
    if models.is_structure(job.reference):
        answer.kind = "structure"
    return Answer(models=[answer])
