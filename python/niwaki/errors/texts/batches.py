"""Errors about batches: their searches, their folders and their workers."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

BATCHES = (
    Message(
        "bad-spec",
        "`{path}` does not describe a batch",
        why="{reason}",
        help="write `model` and `seeds`, and the tables `[grow]`, `[arguments]`, `[vary.grow]` and `[vary.arguments]` as needed",
        example='model = "spaceship"\nseed = 1000',
        cure='model = "spaceship"\nseeds = 1000',
    ),
    Message(
        "no-batch",
        "the folder `{path}` has no batch",
        why="a batch has a file `spec-....json`, which describes its searches",
        help="name the folder into which `niwaki batch` wrote",
        example="niwaki batch export out, of a folder of niwaki grow",
        cure="niwaki batch export ships --format csv",
    ),
    Message(
        "other-batch",
        "the folder `{path}` has another batch",
        why="{differences}; a folder has results of equal searches only",
        help="name another folder with `-o`; other seeds of the same cases can share a folder",
        example="niwaki batch ships.toml -o ships, after an edit of the model",
        cure="niwaki batch ships.toml -o ships-2",
    ),
    Message(
        "bad-batch",
        "`{path}` cannot be read as a part of a batch",
        why="{reason}",
        help="restore the file, or run the batch again in another folder: the results are the same",
        example="a spec that was edited by hand",
        cure="niwaki batch ships.toml -o ships-2",
    ),
    Message(
        "unequal-results",
        "two results of one search differ",
        why="`{first}` and `{second}` have different bytes for the key {key}..., and a search always gives the same bits",
        help="find the faulty machine in the logs, remove its segment, and run the batch again",
        example="segments of a machine with faulty memory",
        cure="niwaki batch ships.toml -o ships, without that segment",
    ),
    Message(
        "worker-differs",
        "a worker may give different results from the other workers",
        why="{reason}",
        help="install the same build of Niwaki on all machines, or run a separate batch on each kind of machine",
        example="two machines with two versions of Niwaki",
        cure="two machines with the same wheel",
    ),
    Message(
        "executor-broken",
        "the executor of this batch broke: {reason}",
        why="your program created the executor, so the batch cannot create another",
        help="run the batch again with another executor: it continues from the stored searches",
        example="niwaki.batch(..., executor=ProcessPoolExecutor()), one of whose processes was killed",
        cure="niwaki.batch(...), whose own processes are replaced",
    ),
    Message(
        "workers-not-started",
        "the workers of this batch ended before their first search",
        why="each worker imports the program that calls `batch`; the text above shows what ended the import",
        help='call `batch` under `if __name__ == "__main__":`, so that a worker that imports the program starts no other batch',
        example="for entry in niwaki.batch(model, seeds=100):\n    print(entry)",
        cure='if __name__ == "__main__":\n    for entry in niwaki.batch(model, seeds=100):\n        print(entry)',
    ),
    Message(
        "searches-lost",
        "{count} of {total} searches have no result",
        why="the first is case {case}, seed {seed}; three workers ended with it, or failed: {reason}",
        help="all other results are stored. The log has the rest of the message. Run the batch again: it searches only "
        "what is missing. If memory ran out, `--processes 1` leaves more for each search",
        example="a model with a host function that ends the process",
        cure="a host function that returns",
    ),
    Message(
        "search-failed",
        "the search of `{name}` with the seed {seed} failed, and has no result",
        why="{reason}",
        help="read `fault` before `result`; the log has the whole message",
        example="[entry.result for entry in niwaki.batch(...)]",
        cure="[entry.result for entry in niwaki.batch(...) if entry.fault is None]",
    ),
)
