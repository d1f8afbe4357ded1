"""Errors about batches: many searches, their folder and their workers."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

BATCHES = (
    Message(
        "bad-spec",
        "`{path}` is not a batch that can be searched",
        why="{reason}",
        help="write `model`, `seeds`, and the tables `[grow]`, `[arguments]`, `[vary.grow]` and `[vary.arguments]`, each "
        "where it is needed",
        example='model = "spaceship"\nseed = 1000',
        cure='model = "spaceship"\nseeds = 1000',
    ),
    Message(
        "no-batch",
        "the folder `{path}` holds no batch",
        why="a batch has a file `spec-....json`, which says what is searched",
        help="name the folder that `niwaki batch` wrote to",
        example="niwaki batch export out, of a folder of niwaki grow",
        cure="niwaki batch export ships --format csv",
    ),
    Message(
        "other-batch",
        "the folder `{path}` holds another batch",
        why="{differences}; results that were found otherwise must not stand side by side",
        help="name another folder with `-o`; the same cases with other seeds may share one",
        example="niwaki batch ships.toml -o ships, after an edit of the model",
        cure="niwaki batch ships.toml -o ships-2",
    ),
    Message(
        "bad-batch",
        "`{path}` is not a part of a batch that can be read",
        why="{reason}",
        help="restore the file; a batch can also be done again in another folder, with the same results",
        example="a spec that was edited by hand",
        cure="niwaki batch ships.toml -o ships-2",
    ),
    Message(
        "unequal-results",
        "two results of the same search differ",
        why="`{first}` and `{second}` have other bytes for the key {key}..., though the same search gives the same bits",
        help="find out which machine computed wrongly, by its log; remove its segment, and run the batch again",
        example="segments of a machine whose memory is faulty",
        cure="niwaki batch ships.toml -o ships, without that segment",
    ),
    Message(
        "worker-differs",
        "a worker may give other results than the rest of the batch",
        why="{reason}",
        help="install the same build of Niwaki on all machines, or give the machines that are alike a batch of their own",
        example="two machines with two versions of Niwaki",
        cure="two machines with the same wheel",
    ),
    Message(
        "executor-broken",
        "the executor of this batch broke: {reason}",
        why="it belongs to the program that made it, so the batch cannot make a new executor",
        help="run the batch again with another executor: it continues from the stored searches",
        example="niwaki.batch(..., executor=ProcessPoolExecutor()), one of whose processes was killed",
        cure="niwaki.batch(...), whose own processes are replaced",
    ),
    Message(
        "workers-not-started",
        "the workers of this batch ended before they could begin",
        why="each worker imports the program that calls `batch`, and what ended that import is written above",
        help='call `batch` under `if __name__ == "__main__":`, so that a worker which imports the program begins no batch of '
        "its own",
        example="for one in niwaki.batch(model, seeds=100):\n    print(one)",
        cure='if __name__ == "__main__":\n    for one in niwaki.batch(model, seeds=100):\n        print(one)',
    ),
    Message(
        "searches-lost",
        "{count} of {total} searches have no result",
        why="the first is case {case}, seed {seed}; three workers were lost with it, or could not do it: {reason}",
        help="all others are stored. Look into the log for the rest of the message, and run the batch again: it tries "
        "these again. If memory ran out, `--processes 1` leaves more to each search",
        example="a model whose host function ends the process",
        cure="a host function that returns",
    ),
    Message(
        "search-failed",
        "the search of `{name}` with the seed {seed} failed, and has no result",
        why="{reason}",
        help="ask for `fault` before `result`; the log has the whole message",
        example="[one.result for one in niwaki.batch(...)]",
        cure="[one.result for one in niwaki.batch(...) if one.fault is None]",
    ),
)
