"""Where trainers and their checkers stand: `parse` and `verify` as Math-Verify has them, and a reward function."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Union

from . import _carom, _given
from ._grade import Grade, Grader


@dataclass(frozen=True)
class Formula:
    """A formula as it was read."""

    #: As it was given.
    text: str
    plain: str
    latex: str
    symbols: tuple[str, ...]
    #: How ambiguous places were read.
    notes: tuple[str, ...]

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex}$"


Read = Union[str, Formula, Sequence[Formula]]


_BRACES = re.compile(r"\\boxed\s*(\{)|\\.|[{}]", re.DOTALL)


def boxed(text: str) -> str | None:
    r"""What stands in the last ``\boxed{}`` whose braces close; None where there is none."""
    opened: list[tuple[bool, int]] = []
    last: tuple[int, int] | None = None
    for found in _BRACES.finditer(text):
        if found[0] == "{" or found[1]:
            opened.append((bool(found[1]), found.end()))
        elif found[0] == "}" and opened:
            is_box, start = opened.pop()
            if is_box and (last is None or start > last[0]):
                last = start, found.start()
    return None if last is None else text[last[0] : last[1]].strip()


_MATH = re.compile(r"\$\$(.+?)\$\$|\$(.+?)\$|\\\((.+?)\\\)|\\\[(.+?)\\\]", re.DOTALL)
#: What Math-Verify's functions take besides. A time limit, a fallback and digits are none of carom's: it counts steps, and
#: rounded numbers are a matter of `grade`'s tolerance.
_MATH_VERIFY = {
    "parse": {"extraction_config", "fallback_mode", "extraction_mode", "parsing_timeout", "raise_on_error"},
    "verify": {
        "float_rounding",
        "numeric_precision",
        "strict",
        "allow_set_relation_comp",
        "timeout_seconds",
        "raise_on_error",
    },
}


def _known(options: Mapping[str, Any], function: str) -> None:
    for name in options:
        if name not in _MATH_VERIFY[function]:
            raise TypeError(f"{function}() got an unexpected keyword argument {name!r}")


def _formula(text: str) -> str:
    """The formula of a text: what is boxed, the whole text where that can be read, or else the last one set as mathematics."""
    inner = boxed(text)
    if inner is not None:
        return inner
    math = [next(filter(None, found)) for found in _MATH.findall(text)]
    return text if not math or _carom.read(text)[1] == 0 else math[-1].strip()


def parse(text: str, **options: Any) -> list[Formula]:
    r"""Reads a formula: the one in the last ``\boxed{}`` where there is one, or else the whole text or the last ``$…$`` in it.
    Empty where nothing can be read as a whole. The keywords of Math-Verify's `parse` are taken and have no effect."""
    _known(options, "parse")
    formula = _formula(_given.text(text, "parse"))
    found, status = _carom.read(formula)
    if status != 0:
        return []
    data = json.loads(found)
    return [Formula(formula, data["plain"], data["latex"], tuple(data["symbols"]), tuple(data["notes"]))]


def _text(given: Read, what: str) -> str | None:
    if isinstance(given, str):
        return _formula(_given.text(given, what))
    if isinstance(given, Formula):
        return given.text
    if isinstance(given, Sequence) and not isinstance(given, (bytes, bytearray)):
        read = [f for f in given if isinstance(f, Formula)]
        if len(read) == len(given):
            return read[0].text if read else None
    raise TypeError(f"{what}: expected a str or what parse() gave, got {type(given).__name__}")


def verify(gold: Read, answer: Read, *, symbols: Mapping[str, Any] | None = None, **options: Any) -> bool:
    """Whether an answer is proved equal to the gold one, both as texts or as `parse` gave them. False where it is not, where
    one of them cannot be read, and where it stays undecided: `grade` tells these apart. The keywords of Math-Verify's `verify`
    are taken and have no effect."""
    _known(options, "verify")
    texts = _text(gold, "gold"), _text(answer, "answer")
    if texts[0] is None or texts[1] is None:
        return False
    line: dict[str, Any] = {"expected": texts[0], "answer": texts[1]}
    if symbols is not None:
        line["symbols"] = symbols
    return any(map(bool, _GRADER.grade_many([line])))


def reward(
    completions: Sequence[Any], answer: Union[str, Sequence[str]], *, unreadable: float | None = 0.0, **_: Any
) -> list[float | None]:
    r"""A reward for each completion: 1.0 where the last ``\boxed{}`` is proved equal to the answer, 0.0 where it is shown to
    differ, None where it stays undecided or the answer itself cannot be read. A completion without a box, or with one that
    cannot be read, gets `unreadable`. Completions are texts or lists of messages; columns of other names are ignored."""
    if isinstance(completions, (str, bytes)) or not isinstance(completions, Sequence):
        raise TypeError(f"completions: expected a list, got {type(completions).__name__}")
    if isinstance(answer, (bytes, Mapping)) or not isinstance(answer, (str, Sequence)):
        raise TypeError(f"answer: expected a str or a list of them, got {type(answer).__name__}")
    golds = [answer] * len(completions) if isinstance(answer, str) else list(answer)
    if len(golds) != len(completions):
        raise _carom.CaromError(f"{len(completions)} completions and {len(golds)} answers")
    rewards: list[float | None] = [unreadable] * len(completions)
    lines = []
    for i, (completion, gold) in enumerate(zip(completions, golds)):
        inner = boxed(_completion(completion))
        if inner is not None:
            lines.append({"id": i, "expected": _text(gold, "answer") or "", "answer": inner})
    for found in _GRADER.grade_many(lines):
        rewards[found.id] = _reward(found, unreadable)
    return rewards


def _reward(found: Grade, unreadable: float | None) -> float | None:
    if found.note == "INVALID_EXPECTED" or found.verdict == "undecided":
        return None
    return unreadable if found.reward is None else float(found.reward)


def _completion(given: Any) -> str:
    """The text of a completion; of a conversation the last message's."""
    if isinstance(given, Sequence) and not isinstance(given, (str, bytes)) and given and isinstance(given[-1], Mapping):
        given = given[-1].get("content")
    return _given.text(given, "completions")


#: Shared: it holds nothing but how strong a proof is wanted.
_GRADER = Grader()
