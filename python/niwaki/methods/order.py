"""Learned orders of futures, as values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from msgspec import Struct

from niwaki import _engine
from niwaki.errors.schema import fitted
from niwaki.methods.refusals import check_settings


class _OrderData(Struct, forbid_unknown_fields=True):
    """Order as data."""

    functions: dict[str, float] = {}
    depth: float = 0.0
    turns: float = 0.0
    waited: float = 0.0
    stay: float = 0.0


@dataclass(frozen=True)
class FutureOrder:
    """Order of futures: the next future is drawn from those that can run, in proportion to `exp(l)` of each.

    For a future with `d` futures around it that has run `r` times, while other futures have run `w` times since it ran
    or was created,

        l = functions[its function] + depth log(1 + d) + turns log(1 + r) + waited log(1 + w)

    plus `stay` for the future that ran last. With all numbers zero it is the order "stochastic". Every order has the
    same final distribution, and unbiased evidence; a good order needs fewer particles.

    Parameters
    ----------
    functions
        Numbers for futures that call these functions, by qualified name; 0 for others. All numbers are in nats, between
        -50 and 50.
    depth, turns, waited, stay
        Numbers in the formula. A large `stay` is nearly depth first within a future, a large `waited` takes turns.

    See Also
    --------
    niwaki.guides.train_order : learns an order.
    """

    functions: Mapping[str, float] = field(default_factory=dict, hash=False)
    depth: float = 0.0
    turns: float = 0.0
    waited: float = 0.0
    stay: float = 0.0

    def __post_init__(self) -> None:
        """Check the numbers."""
        data = self.data()
        check_settings(_engine.check_order, data, data | data["functions"], {})

    def data(self) -> dict[str, Any]:
        """The order as plain data."""
        return asdict(self) | {"functions": dict(self.functions)}

    @classmethod
    def of_data(cls, data: Mapping[str, Any]) -> FutureOrder:
        """Read an order from its data.

        Raises
        ------
        Unfit
            The data are not those of an order.
        InputError
            A number is out of range.
        """
        fitted(data, _OrderData)
        return cls(**data)
