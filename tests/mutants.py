#!/usr/bin/env python3
"""Mutants: is every sign, factor and condition held by a test?

    tests/mutants.py FOLDER [--only FIRST-LAST]

Copies the sources to FOLDER, puts all mutants of tests/mutants.tsv into one build that switches between them by the variable
CAROM_MUTANT, builds it once, and runs for each mutant the tests named beside it until one fails. A mutant that no test notices
survives; rows whose last cell says why they are the same program may. Exit status 1 if another one survives.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# A mutant that runs in circles is noticed.
SECONDS = 300
SWITCH = """//! Which mutant is on.

/// Whether this one is.
pub fn on(k: usize) -> bool {
    static ON: std::sync::OnceLock<usize> = std::sync::OnceLock::new();
    *ON.get_or_init(|| std::env::var("CAROM_MUTANT").ok().and_then(|k| k.parse().ok()).unwrap_or(0)) == k
}
"""


def rows():
    lines = (ROOT / "tests/mutants.tsv").read_text().splitlines()
    cells = [line.split("\t") for line in lines if line and not line.startswith("#")]
    return [c + [""] * (6 - len(c)) for c in cells]


def place(text, expression, which):
    """Where an expression stands for the n-th time."""
    at = -1
    for _ in range(which):
        at = text.find(expression, at + 1)
        if at < 0:
            return None
    return at


def planted(all_rows, files):
    """Puts every mutant behind its switch."""
    by_file = {}
    for number, (file, which, expression, mutant, *_) in enumerate(all_rows, 1):
        by_file.setdefault(f"src/{file}", []).append((number, int(which), expression, mutant))
    for file, mutants in by_file.items():
        text = files[file].decode()
        spots = {}
        for number, which, expression, mutant in mutants:
            at = place(text, expression, which)
            if at is None:
                sys.exit(f"row {number}: {file} has no {expression!r}")
            spots.setdefault((at, at + len(expression)), []).append((number, mutant))
        end = len(text) + 1
        for (start, stop), here in sorted(spots.items(), reverse=True):
            if stop > end:
                sys.exit(f"{file}: mutants {[n for n, _ in here]} overlap with others")
            switch = "".join(f"if crate::mutant::on({n}) {{ {m} }} else " for n, m in here)
            text = text[:start] + f"({switch}{{ {text[start:stop]} }})" + text[stop:]
            end = start
        files[file] = text.encode()
    files["src/mutant.rs"] = SWITCH.encode()
    files["src/lib.rs"] += b"\npub mod mutant;\n"


def laid_out(folder, files):
    """Writes what differs, so that a second run builds nothing anew."""
    for name, content in files.items():
        path = folder / name
        if not path.is_file() or path.read_bytes() != content:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)


def built(folder):
    """The two test programs, of the library and of everything else."""
    command = ["cargo", "test", "--no-run", "--message-format=json", "--lib", "--test", "all"]
    # What the crate needs is built already where CARGO_TARGET_DIR says; elsewhere it is built anew.
    flags = {"CARGO_TARGET_DIR": os.environ.get("CARGO_TARGET_DIR", str(folder / "target"))}
    run = subprocess.run(command + ["-q"], cwd=folder, env=os.environ | flags, stdout=subprocess.PIPE, text=True)
    if run.returncode:
        sys.exit("the mutants do not build")
    programs = {}
    for line in run.stdout.splitlines():
        message = json.loads(line)
        if message.get("executable") and message["profile"]["test"]:
            kind = message["target"]["kind"]
            programs["lib" if "lib" in kind else message["target"]["name"]] = message["executable"]
    return programs


def notices(programs, folder, number, tests):
    """The first test program that fails with this mutant on."""
    environment = os.environ | {"CAROM_MUTANT": str(number), "RUST_BACKTRACE": "0", "CARGO_MANIFEST_DIR": str(folder)}
    for test in tests.split():
        name, _, only = test.partition(":")
        command = [programs["lib"], only] if name == "lib" else [programs["all"], f"{name}::{only}"]
        try:
            run = subprocess.run(command, cwd=folder, env=environment, timeout=SECONDS, capture_output=True)
        except subprocess.TimeoutExpired:
            return test
        if run.returncode:
            return test
        if b"running 0 tests" in run.stdout:
            sys.exit(f"no test is called {test}")
    return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only", default=None)
    args = parser.parse_args()
    folder = args.folder.resolve()
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True)
    files = {name: (ROOT / name).read_bytes() for name in listed.stdout.splitlines()}
    all_rows = rows()
    planted(all_rows, files)
    laid_out(folder, files)
    first, last = (int(x) for x in (args.only or f"1-{len(all_rows)}").split("-"))
    everything = {t for row in all_rows[first - 1 : last] for t in row[4].split()}
    programs = built(folder)
    for test in sorted(everything):
        if notices(programs, folder, 0, test):
            sys.exit(f"{test} fails without any mutant")
    survivors, killed = [], 0
    for number in range(first, last + 1):
        file, _, expression, mutant, tests, same = all_rows[number - 1]
        found = notices(programs, folder, number, tests)
        print(f"{number}\t{file}\t{expression} -> {mutant}\t{'killed by ' + found if found else 'SURVIVED'}", flush=True)
        killed += found is not None
        if not found:
            survivors.append((number, same))
    open_ones = [n for n, same in survivors if not same]
    print(f"{last - first + 1} mutants, {killed} killed, {len(survivors)} survive, {len(open_ones)} of them without a reason: {open_ones}")
    sys.exit(1 if open_ones else 0)


main()
