"""`python -m niwaki.studio.worker`: a worker that speaks frames on its standard input and output."""

from niwaki.studio.worker.loop import main

if __name__ == "__main__":
    main()
