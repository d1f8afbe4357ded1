"""Errors about guides (files, training, searches) and about letters; part of inputs."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

GUIDES = (
    Message(
        "bad-guide",
        "this file is not a usable guide",
        why="a guide's file must be complete, and have the format of this version of Niwaki",
        help="train the guide again with `niwaki.train_guide`, or use a complete copy of the file",
        example='Guide.load("half-a-file.guide")',
        cure='Guide.load("vines.guide")',
    ),
    Message(
        "guide-model",
        "the guide is for another model",
        why="a guide identifies its model's choices by their functions and by the names of the variables they are assigned to",
        help="train a guide for this model with `niwaki.train_guide`, or search without one",
        example='run(coral, smc(20, guide=Guide.load("vines.guide")))',
        cure='run(vines, smc(20, guide=Guide.load("vines.guide")), score=drawing)',
    ),
    Message(
        "guide-score",
        "the guide needs a sketch that this score does not have",
        why="a guide looks at the sketches with which it was trained",
        help="search with a score like that of the training, or train a guide with `Training(looks=False)`",
        example='run(vines, smc(20, guide=Guide.load("vines.guide")))',
        cure='run(vines, smc(20, guide=Guide.load("vines.guide")), score=match_drawing("B.png", window))',
    ),
    Message(
        "guide-traces",
        "there are too few traces to learn from",
        why="a guide learns from the best run of each search, if the run scores better than an empty scene; by a bound it learns "
        "from runs that it draws itself, if some of them are possible",
        help="give targets that the model can reach, more searches in `rounds`, or more particles in `searches`",
        example="train_guide(vines, [a_page_of_dots, another], score)",
        cure="train_guide(vines, [a_letter, another], score)",
    ),
    Message(
        "guide-ahead",
        "the guide has no look-ahead for this search",
        why="look-ahead weighs a paused particle by the gain that the guide expects from the rest of the run; a guide learns it from "
        "short searches that resume paused particles",
        help="train the guide with `niwaki.guides.train_look_ahead` and enough targets, or leave out `look_ahead`",
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
        "the font has no letter `{name}`",
        why="`{font}` has no glyph for {point}",
        help="leave the letter out, or name a font that has it: `--font FILE`",
        example='niwaki letters "木" -o out',
        cure='niwaki letters "木" --font NotoSansCJK.otf -o out',
    ),
    Message(
        "letter-lost",
        "no search filled the letter `{name}`",
        why="every particle of {tries} searches became impossible",
        help="use more `--particles`, more `--searches`, or another font",
        example='niwaki letters "." --particles 1 --searches 1',
        cure='niwaki letters "."',
    ),
)
