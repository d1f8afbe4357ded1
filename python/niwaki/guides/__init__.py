"""Guides: networks that have learnt, from the traces of searches, what leads where (dissertation chapter 6).

training    traces from searches in rounds, and a guide from them
"""

from niwaki.guides.training import Training, train_guide

__all__ = ["Training", "train_guide"]
