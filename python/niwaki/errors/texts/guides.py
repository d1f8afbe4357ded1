"""Errors about guides: their files, their training, searches with one, and letters; part of inputs."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

GUIDES = (
    Message(
        "bad-guide",
        "this is no guide that can be used",
        why="a guide is read only if it is whole and of the format that this version writes",
        help="train it again with `niwaki.train_guide`, or take a whole copy of the file",
        example='Guide.load("half-a-file.guide")',
        cure='Guide.load("vines.guide")',
    ),
    Message(
        "guide-model",
        "the guide is for another model",
        why="a guide knows the choices of its model by their functions and by the names that their values get",
        help="train a guide for this model with `niwaki.train_guide`, or search without one",
        example='run(coral, smc(20, guide=Guide.load("vines.guide")))',
        cure='run(vines, smc(20, guide=Guide.load("vines.guide")), score=drawing)',
    ),
    Message(
        "guide-score",
        "the guide looks at what this score does not have",
        why="a guide sees the surroundings in the sketches that it was trained with",
        help="search by such a score, or train a guide with `Training(looks=False)`",
        example='run(vines, smc(20, guide=Guide.load("vines.guide")))',
        cure='run(vines, smc(20, guide=Guide.load("vines.guide")), score=match_drawing("B.png", window))',
    ),
    Message(
        "guide-traces",
        "there are too few traces to learn from",
        why="a trace is the best run of a search, if it scores better than an empty scene; by a bound a guide learns from "
        "runs of its own, if some of them are possible",
        help="give targets that the model can reach, more searches in `rounds`, or more particles in `searches`",
        example="train_guide(vines, [a_page_of_dots, another], score)",
        cure="train_guide(vines, [a_letter, another], score)",
    ),
    Message(
        "guide-ahead",
        "there is no look-ahead for this search",
        why="look-ahead weighs a paused particle by what its guide expects it to gain still, which a guide learns from short "
        "searches that go on from paused particles",
        help="teach the guide by `niwaki.guides.train_look_ahead`, with targets enough, or give no `look_ahead`",
        example='smc(20, guide=Guide.load("vines.guide"), look_ahead=0.2)',
        cure="smc(20, guide=train_look_ahead(guide, vines, drawings, score), look_ahead=0.2)",
    ),
    Message(
        "guide-targets",
        "`{name}` has no targets to train a guide on",
        why="{reason}",
        help="give {cure}",
        example="niwaki guide train vines --targets empty/ -o vines.guide",
        cure="niwaki guide train vines --targets scribbles -o vines.guide",
    ),
    Message(
        "letter-missing",
        "the font has no `{name}`",
        why="`{font}` has no shape for {point}",
        help="leave it out, or give a font that has it: `--font FILE`",
        example='niwaki letters "木" -o out',
        cure='niwaki letters "木" --font NotoSansCJK.otf -o out',
    ),
    Message(
        "letter-lost",
        "nothing grew into `{name}`",
        why="every particle of {tries} searches became impossible",
        help="give more `--particles` or more `--searches`, or another font",
        example='niwaki letters "." --particles 1 --searches 1',
        cure='niwaki letters "."',
    ),
)
