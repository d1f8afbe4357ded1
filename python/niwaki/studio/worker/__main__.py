"""The command `python -m niwaki.studio.worker`: a worker that reads and writes frames on standard input and output."""

from niwaki.studio.worker.loop import main

if __name__ == "__main__":
    main()
