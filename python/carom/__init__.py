"""Collisions of rigid bodies in the plane: closed forms that are proved, and a grader of formulas that never guesses.

A scene is given as a path, as JSON text that begins with ``{``, or as a dict. What cannot be used raises `CaromError`
(a ``ValueError``) with a message that says what would help; a wrong type raises ``TypeError``.
"""

from ._carom import CaromError
from ._grade import Grade, Grader, grade, grade_many
from ._scene import Answer, Derivation, Numbers, Printed, derive, solve, verify_printed
from ._train import Formula, parse, reward, verify

__all__ = [
    "Answer",
    "CaromError",
    "Derivation",
    "Formula",
    "Grade",
    "Grader",
    "Numbers",
    "Printed",
    "derive",
    "grade",
    "grade_many",
    "parse",
    "reward",
    "solve",
    "verify",
    "verify_printed",
]
