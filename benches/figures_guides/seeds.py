"""Ours by five training seeds, the dissertation's network, and no guide, on all held-out drawings."""

from curves import dissertation
from judging import judged
from niwaki.gallery import vines
from places import Places
from school import ours

TRAINED = (1, 2, 3, 4, 5)
SEARCHED = (1, 2)
#: The largest populations without a guide.
MANY = 600


def draw(places: Places) -> None:
    """Measure."""
    guides = dissertation(places)
    quick = places.quick
    for trained in TRAINED[:1] if quick else TRAINED:
        guide = ours(places, vines, trained)
        name = "ours" if trained == 1 else f"ours-{trained}"
        for seed in SEARCHED[: 1 if quick else None]:
            for particles in (10,) if quick else (10, 20):
                judged(places, vines, name, guide, particles, resampling="tempered", seed=seed)
    for seed in SEARCHED[: 1 if quick else None]:
        for name in ("full", "averaged"):
            for resampling in ("residual", "tempered"):
                judged(places, vines, name, guides[name], 10, resampling=resampling, seed=seed)
        for resampling in ("residual", "systematic", "tempered"):
            judged(places, vines, "unguided", None, 60 if quick else MANY, resampling=resampling, seed=seed)
    for collection in ("scribbles", "silhouettes"):
        judged(places, vines, "ours", ours(places, vines), 10, resampling="tempered", collection=collection)
        judged(places, vines, "full", guides["full"], 10, collection=collection)
        judged(places, vines, "unguided", None, 10, collection=collection)
        judged(places, vines, "unguided", None, 60 if quick else MANY, collection=collection)
