"""Models to look at and start from: one model, one file, one picture."""
