"""What callers give, brought into the texts that the part in Rust takes."""

from __future__ import annotations

import json
import numbers
import os
from collections.abc import Mapping
from fractions import Fraction
from typing import Any, Union

from . import _carom

Scene = Union[str, "os.PathLike[str]", Mapping[str, Any]]
Values = Mapping[str, Union[str, int, float, Fraction]]


def text(value: object, what: str) -> str:
    """A text that can be handed on: a str without lone surrogates."""
    if not isinstance(value, str):
        raise TypeError(f"{what}: expected a str, got {type(value).__name__}")
    try:
        value.encode()
    except UnicodeEncodeError as e:
        raise _carom.CaromError(f"{what}: character {e.start} is half of a surrogate pair, and no text") from None
    return value


def scene(given: Scene) -> tuple[str, str]:
    """Name and text of a scene."""
    if isinstance(given, Mapping):
        return "scene", dumps(given, "scene")
    if isinstance(given, str) and given.lstrip().startswith("{"):
        return "scene", text(given, "scene")
    if not isinstance(given, (str, os.PathLike)):
        raise TypeError(f"scene: expected a path, JSON text or a dict, got {type(given).__name__}")
    path = text(os.fspath(given), "scene")
    if len(path) > 4096 or "\0" in path:
        raise _carom.CaromError("scene: neither JSON text, which begins with {, nor a path")
    try:
        with open(path, "rb") as file:
            read = file.read(_carom.LONGEST_SCENE + 1)
    except OSError as e:
        raise _carom.CaromError(f"{path}: cannot be read: {e.strerror}") from None
    try:
        return path, read.decode()
    except UnicodeDecodeError as e:
        raise _carom.CaromError(f"{path}: cannot be read: no UTF-8 at byte {e.start}") from None


def values(given: Values | None) -> list[str]:
    """Values of parameters as the command line writes them."""
    if given is None:
        return []
    if not isinstance(given, Mapping):
        raise TypeError(f"set: expected a dict of names and values, got {type(given).__name__}")
    out = []
    for name, value in given.items():
        if isinstance(value, bool) or not isinstance(value, (str, numbers.Real)):
            raise TypeError(f"set: the value of {name!r} is to be a number or a formula, not {type(value).__name__}")
        out.append(f"{text(name, 'set')}={text(value if isinstance(value, str) else _written(value), 'set')}")
    return out


def _written(value: numbers.Real) -> str:
    """A number as Python writes its own: those of NumPy name their type in front. A fraction stays one."""
    return str(value) if isinstance(value, numbers.Rational) else repr(float(value))


def _own(value: object) -> int | float:
    """A number of NumPy as one of Python's, which JSON knows."""
    if isinstance(value, numbers.Integral):
        return int(value)
    if isinstance(value, numbers.Real):
        return float(value)
    raise TypeError(f"{type(value).__name__} is no text, number, list or dict")


def dumps(value: object, what: str) -> str:
    """JSON text of a value."""
    try:
        return text(json.dumps(value, ensure_ascii=False, default=_own), what)
    except (TypeError, ValueError, RecursionError) as e:
        raise _carom.CaromError(f"{what}: this is no JSON: {e}") from None
