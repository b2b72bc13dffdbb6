"""Scenes: their closed forms, their numbers, and what is printed about them."""

from __future__ import annotations

import html
import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from . import _carom, _given


class Answer:
    """A closed form. Called with arrays it gives their values, point by point."""

    def __init__(self, data: dict[str, Any], function: _carom.Function | None) -> None:
        self.data = data
        self._function = function

    @property
    def name(self) -> str:
        return str(self.data["name"])

    @property
    def formula(self) -> str | None:
        """In plain notation; None where it is no formula, or not determined."""
        return self.data.get("closed") or self.data.get("formula")

    @property
    def latex(self) -> str | None:
        return self.data.get("latex")

    @property
    def unit(self) -> str:
        return str(self.data["unit"])

    @property
    def value(self) -> float | None:
        """At the scene's values, in SI units."""
        return self.data.get("value")

    @property
    def symbols(self) -> list[str]:
        """What the function takes, in order."""
        return [] if self._function is None else [a[0] for a in self._function.arguments]

    def __call__(self, *args: Any, **named: Any) -> Any:
        """Values in doubles at arguments in SI units: numbers or arrays of shapes that go together, by position or by
        name. What the scene gives a value need not be named. NaN where the formula has no value."""
        if self._function is None:
            raise _carom.CaromError(f"{self.name} has no closed form in numbers")
        # NumPy is needed here only, and carom goes without it otherwise.
        import numpy as np

        arguments = self._function.arguments
        names = [a[0] for a in arguments]
        if len(args) > len(names):
            raise TypeError(f"{self.name} takes {len(names)} arguments ({', '.join(names)}), got {len(args)}")
        values = dict(zip(names, args))
        for name, value in named.items():
            if name not in names or name in values:
                why = "given twice" if name in values else f"no argument; there are {', '.join(names)}"
                raise TypeError(f"{self.name}: {name} is {why}")
            values[name] = value
        values = {a[0]: a[4] for a in arguments if a[4] is not None} | values
        missing = [f"{n} ({unit})" for n, unit, *_ in arguments if n not in values]
        if missing:
            raise TypeError(f"{self.name}: no value for {', '.join(missing)}")
        given = [np.asarray(values[n], dtype=np.float64) for n in names]
        # Those with a value of their own still have the shape of the others.
        columns = list(np.broadcast_arrays(*given)) if given else [np.zeros(())]
        shape = columns[0].shape
        taken = [np.ascontiguousarray(c).tobytes() for c in columns][: len(names)]
        out = np.frombuffer(self._function.evaluate(taken, columns[0].size), dtype=np.float64).reshape(shape)
        return float(out) if shape == () else out

    def _repr_latex_(self) -> str:
        symbol = self.data.get("symbol", self.name)
        right = self.latex if self.latex is not None else r"\text{not determined}"
        return f"$\\displaystyle {symbol} = {right}$"

    def __repr__(self) -> str:
        return f"{self.name} = {self.formula}"


class Derivation(Mapping[str, Answer]):
    """Answers by name, and all that was found out about them in `data`, as ``carom derive --format json`` prints it."""

    def __init__(self, data: dict[str, Any], verified: bool, answers: list[Answer], cases: list[Derivation]) -> None:
        self.data = data
        #: Whether every check holds.
        self.verified = verified
        #: The cases of a contact with friction that are possible; empty without one.
        self.cases = cases
        self._answers = {a.name: a for a in answers}

    def __getitem__(self, name: str) -> Answer:
        try:
            return self._answers[name]
        except KeyError:
            raise KeyError(f"{name}: the answers are {', '.join(self._answers) or 'in the cases'}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._answers)

    def __len__(self) -> int:
        return len(self._answers)

    def _repr_latex_(self) -> str:
        rows = " \\\\ ".join(
            f"{a.data.get('symbol', a.name)} &= {a.latex or chr(92) + 'text{not determined}'}" for a in self.values()
        )
        return f"$\\begin{{aligned}}{rows}\\end{{aligned}}$"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{html.escape(a.data.get('words', a.name))}</td><td>{html.escape(a._repr_latex_())}</td>"
            f"<td>{html.escape(a.unit)}</td></tr>"
            for a in self.values()
        )
        proved = "every check holds" if self.verified else "not every check holds"
        cases = "".join(
            f"<h4>{html.escape(str(c.data.get('mode', '')))}</h4>{c._repr_html_()}" for c in self.cases if c is not self
        )
        title = html.escape(self.data.get("title", ""))
        return f"<div><b>{title}</b> ({proved})<table>{rows}</table>{cases}</div>"

    def __repr__(self) -> str:
        return "\n".join(map(repr, self.values())) or f"{len(self.cases)} cases"


def derive(scene: _given.Scene, set: _given.Values | None = None) -> Derivation:
    """Derives the closed forms a scene asks for, and proves them."""
    name, text = _given.scene(scene)
    values = _given.values(set)
    found, status = _carom.derive(name, text, values)
    data = json.loads(found)
    cases = data.get("cases", [])
    # One case of friction is the derivation; several have conditions of their own, and no one function each.
    whole = cases[0] if len(cases) == 1 else data
    try:
        functions = {f.name: f for f in _carom.functions(name, text, values)}
    except _carom.CaromError:
        functions = {}
    answers = [Answer(a, functions.get(a["name"])) for a in whole.get("answers", [])]
    several = [Derivation(c, c["verified"], [Answer(a, None) for a in c["answers"]], []) for c in cases[1:] and cases]
    return Derivation(data, status == 0, answers, several)


class Numbers(Mapping[str, Any]):
    """Values by name in SI units; `data` holds what ``carom solve --format json`` prints."""

    def __init__(self, data: dict[str, Any], complete: bool) -> None:
        self.data = data
        #: Whether nothing stayed undecided and no stage was lost.
        self.complete = complete
        self._answers = {a["name"]: a for a in data.get("answers", [])}

    def __getitem__(self, name: str) -> Any:
        return self._answers[name].get("value")

    def __iter__(self) -> Iterator[str]:
        return iter(self._answers)

    def __len__(self) -> int:
        return len(self._answers)

    def unit(self, name: str) -> str:
        """The unit of a value."""
        return str(self._answers[name].get("unit", ""))

    def exact(self, name: str) -> str | None:
        """The value as a fraction, where it was asked for."""
        exact: str | None = self._answers[name].get("value_exact")
        return exact

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{html.escape(n)}</td><td>{html.escape(str(v))}</td><td>{html.escape(self.unit(n))}</td></tr>"
            for n, v in self.items()
        )
        return f"<table>{rows}</table>"

    def __repr__(self) -> str:
        return "\n".join(f"{n} = {v} {self.unit(n)}".rstrip() for n, v in self.items())


def solve(
    scene: _given.Scene, set: _given.Values | None = None, *, exact: bool = False, certify: bool = False
) -> Numbers:
    """Solves a scene in numbers, from its geometry alone."""
    if exact and certify:
        raise _carom.CaromError("exact and certify: choose one")
    name, text = _given.scene(scene)
    kind = "exact" if exact else "certified" if certify else "doubles"
    found, status = _carom.solve(name, text, _given.values(set), kind)
    return Numbers(json.loads(found), status == 0)


class Printed(Sequence[dict[str, Any]]):
    """What a book prints, one by one: whether it holds (None: undecided), and what explains what does not."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data = data
        self._list: list[dict[str, Any]] = data["printed"]

    def __getitem__(self, i: Any) -> Any:
        return self._list[i]

    def __len__(self) -> int:
        return len(self._list)

    @property
    def wrong(self) -> list[dict[str, Any]]:
        """What does not hold."""
        return [f for f in self._list if f["holds"] is False]

    def _repr_html_(self) -> str:
        words = {True: "holds", False: "<b>wrong</b>", None: "undecided"}
        rows = "".join(
            f"<tr><td>{words[f['holds']]}</td><td>{html.escape(f['printed'])}</td>"
            f"<td>{html.escape(f['because'] if f['holds'] is not True else '')}</td></tr>"
            for f in self._list
        )
        return f"<table>{rows}</table>"


def verify_printed(scene: _given.Scene, answers: Sequence[Mapping[str, Any]] | None = None) -> Printed:
    """Holds what a book prints about a scene against what is derived; `answers` takes the place of its own list."""
    name, text = _given.scene(scene)
    given = None if answers is None else _given.dumps(answers, "answers")
    return Printed(json.loads(_carom.printed(name, text, given)))
