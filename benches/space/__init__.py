"""Guides in space: targets to learn from and to try, and how a guide is compared with searches that cost the same."""
