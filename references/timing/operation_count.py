"""Operation counts: FCTD's compiled functions, run as plain Python on numbers that count their operations."""

from __future__ import annotations

import operator
from collections import Counter
from collections.abc import Callable
from types import FunctionType
from typing import Any, ClassVar

import numpy as np
from numba.core.dispatcher import Dispatcher
from numpy.typing import NDArray

ARITHMETIC = ("add", "subtract", "multiply", "divide", "root")


class Number:
    """A real number whose sums, products, roots and comparisons are added to ``tally``.

    A change of sign is not counted: it is part of the operation that uses the result.
    """

    __array_priority__ = 1000.0  # a numpy scalar on the left leaves the operation to this class
    tally: ClassVar[Counter[str]] = Counter()

    def __init__(self, value: float) -> None:
        self.value = value

    @property
    def real(self) -> Number:
        """The number itself; the compiled functions also accept complex numbers."""
        return self

    def sqrt(self) -> Number:
        """Square root; ``np.sqrt`` calls this method."""
        self.tally["root"] += 1
        return Number(float(np.sqrt(self.value)))

    def __neg__(self) -> Number:
        return Number(-self.value)

    def __float__(self) -> float:
        return self.value


def _binary(name: str, apply: Callable[[float, float], float], *, swapped: bool = False) -> Callable[..., Number]:
    def operation(self: Number, other: Any) -> Number:
        self.tally[name] += 1
        a, b = self.value, float(other)
        return Number(apply(b, a) if swapped else apply(a, b))

    return operation


def _comparison(apply: Callable[[float, float], bool]) -> Callable[..., bool]:
    def operation(self: Number, other: Any) -> bool:
        self.tally["compare"] += 1
        return apply(self.value, float(other))

    return operation


for _symbol, _name, _apply in (
    ("add", "add", operator.add),
    ("sub", "subtract", operator.sub),
    ("mul", "multiply", operator.mul),
    ("truediv", "divide", operator.truediv),
):
    setattr(Number, f"__{_symbol}__", _binary(_name, _apply))
    setattr(Number, f"__r{_symbol}__", _binary(_name, _apply, swapped=True))
for _symbol in ("lt", "le", "gt", "ge"):
    setattr(Number, f"__{_symbol}__", _comparison(getattr(operator, _symbol)))


class Counted:
    """A view of an array whose elements are read as ``Number``; nothing is copied."""

    def __init__(self, values: NDArray[np.float64]) -> None:
        self.values = values

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the array."""
        return self.values.shape

    def __getitem__(self, at: Any) -> Number:
        return Number(float(self.values[at]))

    def __setitem__(self, at: Any, number: Any) -> None:
        self.values[at] = float(number)


def interpreted(compiled: Any) -> Callable[..., Any]:
    """A compiled function as plain Python, together with all compiled functions that it calls."""
    return _Interpreter()(compiled)


class _Interpreter:
    def __init__(self) -> None:
        self._done: dict[Any, FunctionType] = {}

    def __call__(self, compiled: Any) -> FunctionType:
        if compiled not in self._done:
            original = compiled.py_func
            names = dict(original.__globals__)
            self._done[compiled] = FunctionType(
                original.__code__, names, original.__name__, original.__defaults__, original.__closure__
            )
            for name in original.__code__.co_names:
                if isinstance(names.get(name), Dispatcher):
                    names[name] = self(names[name])
        return self._done[compiled]


def operations_of(function: Callable[..., Any], *arguments: Any) -> Counter[str]:
    """Number of operations in a call: add, subtract, multiply, divide, root, compare."""
    return counted(function, *arguments)[1]


def counted(function: Callable[..., Any], *arguments: Any) -> tuple[Any, Counter[str]]:
    """The result of a call and its operations."""
    Number.tally.clear()
    result = function(*arguments)
    return result, Counter(Number.tally)


def arithmetic(tally: Counter[str]) -> int:
    """Number of sums, products, quotients and roots; comparisons are not included."""
    return sum(tally[name] for name in ARITHMETIC)
