"""Guides: networks that have learnt, from the traces of searches, what leads where (dissertation chapter 6).

settings    of a network and its training
training    traces from searches in rounds, and a guide from them; or one that learns from runs of its own
ahead       what a paused run will still gain, learned
orders      which future should run next, learned
traces      many searches side by side, each for its best run
report      what a round of training did
shipped     the guides that come with the package
"""

from niwaki.guides.ahead import train_look_ahead
from niwaki.guides.orders import OrderTraining, train_order
from niwaki.guides.report import Round
from niwaki.guides.settings import Training
from niwaki.guides.shipped import shipped
from niwaki.guides.training import EVERY, train_guide

__all__ = [
    "EVERY",
    "OrderTraining",
    "Round",
    "Training",
    "shipped",
    "train_guide",
    "train_look_ahead",
    "train_order",
]
