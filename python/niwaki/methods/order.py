"""An order of futures that was learned, as a value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from msgspec import Struct

from niwaki import _engine
from niwaki.errors.schema import fitted
from niwaki.methods.refusals import checked


class _OrderData(Struct, forbid_unknown_fields=True):
    """An order as data."""

    functions: dict[str, float] = {}
    depth: float = 0.0
    turns: float = 0.0
    waited: float = 0.0
    stay: float = 0.0


@dataclass(frozen=True)
class FutureOrder:
    """Which of the futures that can run goes next: a draw in proportion to `exp(l)` of each.

    `l` is the number of its function, plus `depth` times the log of one more than the number of futures around it, plus
    `turns` times the log of one more than how often it has run, plus `waited` times the log of one more than how often
    others have run since it did or was created, plus `stay` for the future that ran last. All zero, it is the order
    "stochastic". Any order gives the same final law and evidence without bias; a good one needs fewer particles.

    Parameters
    ----------
    functions
        Numbers for futures that call these functions, by qualified name; 0 for others. Nats, between -50 and 50, as are
        all numbers here.
    depth, turns, waited, stay
        As above: a large `stay` is nearly depth first within a future, a large `waited` takes turns.

    See Also
    --------
    niwaki.guides.train_order : learns one.
    """

    functions: Mapping[str, float] = field(default_factory=dict, hash=False)
    depth: float = 0.0
    turns: float = 0.0
    waited: float = 0.0
    stay: float = 0.0

    def __post_init__(self) -> None:
        """Check the numbers."""
        data = self.data()
        checked(_engine.check_order, data, data | data["functions"], {})

    def data(self) -> dict[str, Any]:
        """The order as plain data."""
        return asdict(self) | {"functions": dict(self.functions)}

    @classmethod
    def of_data(cls, data: Mapping[str, Any]) -> FutureOrder:
        """The order of its data.

        Raises
        ------
        Unfit
            It is not an order's data.
        InputError
            A number is too large.
        """
        fitted(data, _OrderData)
        return cls(**data)
