"""Turn arguments into float arrays, or say in one plain sentence what is wrong with them."""

from __future__ import annotations

import math
import operator
import reprlib
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

# What an array that does not hold real numbers holds, by the kind of its type.
_KINDS = {"b": "truth values", "c": "complex numbers", "S": "bytes", "U": "text"}


def floats(value: ArrayLike, name: str) -> Floats:
    """Return `value` as a float64 array of any shape whose numbers are all finite."""
    array = real(value, name)
    with np.errstate(over="ignore"):
        array = array.astype(np.float64, copy=False)
    if not _all_finite(array):
        place = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        where = f"{name}[{', '.join(map(str, place))}]" if place else name
        raise ValueError(f"{name} must hold finite numbers, but {where} is {array[place]}.")
    return array


def real(value: ArrayLike, name: str) -> NDArray[Any]:
    """Return `value` as an array of real numbers of any type and shape."""
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise ValueError(
            f"{name} must be a table of numbers, but its rows have different lengths."
        ) from error
    if array.dtype.kind not in "iuf":
        what = "None" if value is None else _KINDS.get(array.dtype.kind, "other objects")
        raise TypeError(f"{name} must hold real numbers, but holds {what}.")
    return array


def vector(value: ArrayLike, name: str, minimum: int = 1) -> Floats:
    """Return `value` as a one-dimensional float array of at least `minimum` numbers."""
    array = floats(value, name)
    if array.ndim != 1:
        raise ValueError(f"{name} must be a list of numbers, but has shape {array.shape}.")
    if len(array) < minimum:
        raise ValueError(f"{name} needs {minimum} or more numbers, but has {len(array)}.")
    return array


def increasing(value: ArrayLike, name: str, minimum: int = 1) -> Floats:
    """Return `value` as a vector whose numbers grow from each to the next."""
    array = vector(value, name, minimum)
    if not (array[1:] > array[:-1]).all():
        i = int((array[1:] <= array[:-1]).argmax())
        raise ValueError(
            f"{name} must increase, but {name}[{i}] is {array[i]} "
            f"and {name}[{i + 1}] is {array[i + 1]}."
        )
    return array


def points(value: ArrayLike, name: str, minimum: int = 1) -> Floats:
    """Return `value` as an (n, dim) float array of at least `minimum` points, one a row."""
    array = floats(value, name)
    if array.ndim != 2 or array.shape[1] == 0:
        raise ValueError(
            f"{name} must hold one point a row, shape (n, dim), but has shape {array.shape}."
        )
    if len(array) < minimum:
        raise ValueError(f"{name} needs {minimum} or more points, but has {len(array)}.")
    return array


def rows(value: ArrayLike, name: str, count: int) -> Floats:
    """Return `value` as a float array of `count` numbers, or of `count` points, one a row."""
    array = floats(value, name)
    if array.ndim not in (1, 2) or len(array) != count or array.size == 0:
        raise ValueError(
            f"{name} must hold {count} numbers, or {count} points one a row, "
            f"but has shape {array.shape}."
        )
    return array


def whole_number(value: Any, name: str, minimum: int) -> int:
    """Return `value` as an int that is not below `minimum`."""
    try:
        # numpy 2.0 takes its own True and False for indices, with a warning.
        number = None if isinstance(value, bool | np.bool_) else operator.index(value)
    except TypeError:
        number = None
    if number is None:
        raise TypeError(f"{name} must be a whole number, but is {reprlib.repr(value)}.")
    if number < minimum:
        raise ValueError(f"{name} must be a whole number from {minimum} up, but is {number}.")
    return number


def finite(result: Floats, names: str) -> Floats:
    """Return `result`, or raise where finite inputs made it too large for a float."""
    if not _all_finite(result):
        raise ValueError(f"{names}: too large, the result does not fit a float.")
    return result


def _all_finite(array: Floats) -> bool:
    # Much quicker than isfinite, without its array of truth values. The square of a
    # finite number can overflow, so only a finite sum of squares settles the question.
    return math.isfinite(np.vdot(array, array)) or bool(np.isfinite(array).all())
