"""Niwaki grows procedural models into the shapes you ask for."""
