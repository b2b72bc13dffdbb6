"""Grades of formulas, one at a time or many."""

from __future__ import annotations

import html
import itertools
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Union

from . import _carom, _given

#: Lines handed over at a time.
_CHUNK = 1024
#: Name by which lines of a grader with a scene speak of it.
_SCENE = "scene"


@dataclass(frozen=True)
class Grade:
    """The verdict on an answer, how it is known, and what is wrong with a wrong one."""

    id: Any
    #: ``equivalent``, ``different``, ``invalid`` (no readable answer) or ``undecided``.
    verdict: str
    #: 1, 0, or None where nothing is to be scored.
    reward: int | None
    #: Stable code of the reason.
    note: str
    #: How it is known: ``kind``, ``words``, and ``error_bound`` where it is probabilistic.
    proof: dict[str, Any]
    #: Codes, messages and hints, the likeliest first.
    diagnosis: list[dict[str, str]] = field(default_factory=list)
    #: The simplest exact point at which a wrong answer parts: ``at``, ``yours``, ``expected``.
    counterexample: dict[str, str] | None = None
    #: Where and why a text cannot be read.
    error: dict[str, Any] | None = None
    #: How the answer was read.
    read_as: str | None = None
    symbols: list[str] = field(default_factory=list)
    assumed: list[str] = field(default_factory=list)

    def __bool__(self) -> bool:
        """Proved right; an undecided answer is not."""
        return self.verdict == "equivalent"

    def _repr_html_(self) -> str:
        rows = [f"<b>{html.escape(self.verdict)}</b> · {html.escape(self.note)}"]
        if self.read_as is not None:
            rows.append(f"read as <code>{html.escape(self.read_as)}</code>")
        if self.error is not None:
            rows.append(html.escape(str(self.error.get("message", ""))))
        if self.counterexample is not None:
            at, yours, expected = (html.escape(self.counterexample[k]) for k in ("at", "yours", "expected"))
            rows.append(f"{at}: yours {yours}, expected {expected}")
        rows += [f"{html.escape(d['message'])}<br><i>{html.escape(d['hint'])}</i>" for d in self.diagnosis[:3]]
        return "<div>" + "<br>".join(rows) + "</div>"


def _grade(line: str) -> Grade:
    given = json.loads(line)
    del given["version"]
    return Grade(**given)


class Grader:
    """A grader that keeps what it has read: `scene` is derived and proved once, here."""

    def __init__(self, scene: _given.Scene | None = None, *, proof: str = "identity", slash: str = "usual") -> None:
        if proof not in ("identity", "fast"):
            raise _carom.CaromError(f"proof: {proof!r} is neither 'identity' nor 'fast'")
        if slash not in ("usual", "strict"):
            raise _carom.CaromError(f"slash: {slash!r} is neither 'usual' nor 'strict'")
        given = None if scene is None else _given.scene(scene)
        self._has_scene = given is not None
        self._rust = _carom.Grader(given, proof == "fast", slash == "strict")

    @property
    def quantities(self) -> list[str]:
        """What can be asked of the scene."""
        return self._rust.quantities

    def grade(
        self,
        expected: str | None = None,
        answer: str | None = None,
        *,
        quantity: str | None = None,
        symbols: Mapping[str, Any] | None = None,
        tolerance: str | float | Mapping[str, Any] | None = None,
        form: str | list[str] | None = None,
    ) -> Grade:
        """Judges an answer: against `expected`, or against the scene's own answer for `quantity`."""
        line: dict[str, Any] = {"answer": _given.text(answer, "answer")}
        if expected is not None:
            line["expected"] = _given.text(expected, "expected")
        if quantity is not None:
            line["quantity"] = _given.text(quantity, "quantity")
        for name, value in (("symbols", symbols), ("tolerance", tolerance), ("form", form)):
            if value is not None:
                line[name] = value
        if self._has_scene:
            line["scene"] = _SCENE
        found = _grade(self._rust.judge([_given.dumps(line, "grade")], 1)[0])
        if found.note in ("INVALID_LINE", "INVALID_EXPECTED"):
            what = "expected: " if found.note == "INVALID_EXPECTED" else ""
            raise _carom.CaromError(what + str((found.error or {}).get("message")))
        return found

    def grade_many(self, lines: Iterable[Union[str, Mapping[str, Any]]]) -> Iterator[Grade]:
        """A grade for each line, in order, on all cores. A line is a dict or its JSON text, with the fields of
        ``carom grade --batch``; one that cannot be judged becomes a grade with the note ``INVALID_LINE``."""
        if isinstance(lines, (str, bytes, Mapping)) or not isinstance(lines, Iterable):
            raise TypeError(f"grade_many: expected an iterable of dicts or JSON lines, got {type(lines).__name__}")
        return self._stream(iter(lines))

    def _stream(self, lines: Iterator[Union[str, Mapping[str, Any]]]) -> Iterator[Grade]:
        first = 1
        fault: TypeError | None = None
        while fault is None:
            chunk = []
            for line in itertools.islice(lines, _CHUNK):
                try:
                    chunk.append(self._line(line))
                except TypeError as found:
                    # What came before is graded first.
                    fault = found
                    break
            if not chunk:
                break
            yield from map(_grade, self._rust.judge(chunk, first))
            first += len(chunk)
        if fault is not None:
            raise fault

    def _line(self, line: Union[str, Mapping[str, Any]]) -> str:
        if isinstance(line, Mapping):
            return _given.dumps({"scene": _SCENE, **line} if self._has_scene else line, "line")
        line = _given.text(line, "line")
        if self._has_scene:
            try:
                return self._line(dict(json.loads(line)))
            except (TypeError, ValueError, RecursionError):
                pass  # The grader tells what is wrong with it.
        return line


def grade(
    expected: str | None = None,
    answer: str | None = None,
    *,
    scene: _given.Scene | None = None,
    quantity: str | None = None,
    symbols: Mapping[str, Any] | None = None,
    tolerance: str | float | Mapping[str, Any] | None = None,
    form: str | list[str] | None = None,
    proof: str = "identity",
    slash: str = "usual",
) -> Grade:
    """Judges one answer; for many answers about one scene keep a `Grader`."""
    return Grader(scene, proof=proof, slash=slash).grade(
        expected, answer, quantity=quantity, symbols=symbols, tolerance=tolerance, form=form
    )


def grade_many(
    lines: Iterable[Union[str, Mapping[str, Any]]], *, proof: str = "identity", slash: str = "usual"
) -> Iterator[Grade]:
    """A grade for each line, in order; see `Grader.grade_many`."""
    return Grader(proof=proof, slash=slash).grade_many(lines)
