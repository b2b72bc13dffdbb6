#!/usr/bin/env python3
"""Runs STACK questions in Maxima: every test a question carries ends in the branch, and with the score, that it expects.

    tests/platforms/stack.py target/debug/carom [SCENE ...]

exports each scene (those of derivations/book without any) and walks the potential-response trees as STACK does, at every
variant. Maxima is from the system's packages. STACK's own AlgEquiv and NumRelative are stood in for by the definitions
below; what they cannot show equal counts as different, as in STACK.
"""

import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

PRELUDE = """
display2d: false$ ratprint: false$
alg(a, b) := block([d: ratsimp(a - b)],
  if d = 0 then true else block([d: ratsimp(trigexpand(radcan(d)))],
    if d = 0 then true else is(ratsimp(trigsimp(d)) = 0)))$
near(a, b, t) := block([a: float(a), b: float(b)],
  is(numberp(a) and numberp(b) and abs(a - b) <= t*abs(b)))$
"""


def text(node, path):
    found = node.findtext(path)
    return (found or "").strip()


def tree(question, name):
    """The nodes of a tree by name."""
    prt = next(p for p in question.iter("prt") if text(p, "name") == name)
    return {text(n, "name"): n for n in prt.iter("node")}


def condition(node):
    test, options = text(node, "answertest"), text(node, "testoptions")
    names = text(node, "sans"), text(node, "tans")
    if test == "AlgEquiv":
        return f"alg({names[0]}, {names[1]})"
    assert test == "NumRelative", test
    return f"near({names[0]}, {names[1]}, {options})"


def walk(nodes, name="0"):
    """The tree as one expression of Maxima: note and score of where it ends."""
    node = nodes[name]

    def end(side):
        following = text(node, f"{side}nextnode")
        here = f'["{text(node, side + "answernote")}", {text(node, side + "score")}]'
        return here if following == "-1" else walk(nodes, following)

    return f"if {condition(node)} then {end('true')} else {end('false')}"


def script(question, variant):
    """What Maxima is to do, and what each line of its answer is to be. Formulas are the same at every variant."""
    out, expected = [f"kill(allbut(alg, near))$ rand(l) := l[{variant}]$"], []
    if text(question, "assumepositive") == "1":
        out.append("assume_pos: true$")
    out.append(text(question, "questionvariables/text").replace(";\n", "$\n").rstrip().removesuffix(";") + "$")
    trees = {text(p, "name"): tree(question, text(p, "name")) for p in question.iter("prt")}
    for test in question.iter("qtest"):
        for given in test.iter("testinput"):
            out.append(f"{text(given, 'name')}: {text(given, 'value')}$")
        for hoped in test.iter("expected"):
            name = text(hoped, "name")
            if variant > 1 and text(trees[name]["0"], "answertest") == "AlgEquiv":
                continue
            out.append(f'print("@@", {walk(trees[name])})$')
            expected.append((text(test, "description"), text(hoped, "expectedanswernote"), float(text(hoped, "expectedscore"))))
    return "\n".join(out), expected


def check(quiz):
    """Branches that ended as expected, and the words about the others."""
    held, failed = 0, []
    for question in quiz.iter("question"):
        variants = max(1, len(question.findall("deployedseed")))
        runs = [script(question, v + 1) for v in range(variants)]
        # Each variant in a fresh Maxima: assumptions and values do not outlive it.
        for number, (commands, expected) in enumerate(runs, 1):
            with tempfile.NamedTemporaryFile("w", suffix=".mac") as file:
                file.write(PRELUDE + commands + "\n")
                file.flush()
                run = subprocess.run(
                    ["maxima", "--very-quiet", f"--batch={file.name}"], capture_output=True, text=True, timeout=600
                )
            got = [line.split("@@", 1)[1].strip() for line in run.stdout.splitlines() if line.startswith("@@")]
            where = f"{text(question, 'name/text')}, variant {number}"
            if len(got) != len(expected):
                failed.append(f"{where}: Maxima stopped\n{run.stdout[-600:]}")
                continue
            for line, (what, note, score) in zip(got, expected):
                end, points = line.strip("[] ").rsplit(",", 1)
                if end.strip('" ') == note and float(points) == score:
                    held += 1
                else:
                    failed.append(f"{where}: {what} ends in {line}, expected {note} with {score}")
    return held, failed


def main():
    program, scenes = sys.argv[1], sys.argv[2:]
    scenes = scenes or sorted(str(p) for p in Path("derivations/book").glob("*.json"))
    worst = 0
    for scene in scenes:
        run = subprocess.run([program, "export", scene, "--to", "stack"], capture_output=True, text=True)
        if run.returncode:
            print(f"{scene}: not exported: {run.stderr.strip().splitlines()[-2:]}")
            continue
        held, failed = check(ET.fromstring(run.stdout.encode()))
        print(f"{scene}: {held} branches as expected, {len(failed)} not")
        for words in failed:
            print("  " + words)
            worst = 1
    sys.exit(worst)


if __name__ == "__main__":
    main()
