"""Guides: networks that learn from traces of searches and draw choices in place of the prior (dissertation chapter 6).

| module | contents |
| --- | --- |
| `settings` | settings of a network and its training |
| `training` | training on traces of searches in rounds, or on runs of the guide itself |
| `training_checkpoint` | the checkpoint of a training |
| `look_ahead` | training of the future gain of a paused run |
| `orders` | training of the order in which futures run |
| `traces` | many searches side by side, each for its best run |
| `report` | the results of a round of training |
"""

from niwaki.guides.look_ahead import train_look_ahead
from niwaki.guides.orders import OrderTraining, train_order
from niwaki.guides.report import Round
from niwaki.guides.settings import Training
from niwaki.guides.training import EVERY, train_guide
from niwaki.search.shipped import shipped, usual

__all__ = [
    "EVERY",
    "OrderTraining",
    "Round",
    "Training",
    "shipped",
    "train_guide",
    "train_look_ahead",
    "train_order",
    "usual",
]
