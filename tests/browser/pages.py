#!/usr/bin/env python3
"""Looks at worked solutions in a real browser.

usage: tests/browser/pages.py CAROM OUT [SCENE...]

Writes the HTML solution of every scene (all of derivations/ without names) with the program CAROM, opens each in Chromium
(Debian's package) at 1280 and 390 pixels, on light and dark paper, writes screenshots to OUT, and fails if a page is
wider than its window, two texts of a figure cover each other, a character could not be read, or the console says anything.
"""

import html
import json
import pathlib
import re
import subprocess
import sys

import figures

MEASURE = figures.MEASURE.replace("svg.parentElement.dataset.name", "'figure'").replace(
    "document.body.dataset.faults",
    """
const wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
if (wide > 0) {
  const past = [...document.querySelectorAll('body *')].filter(
    e => e.getBoundingClientRect().right > document.documentElement.clientWidth + 1);
  faults.push(`the page is ${wide} px too wide: ${past.slice(0, 3).map(e => e.tagName + ' ' + e.textContent.slice(0, 40)).join('; ')}`);
}
if (document.body.textContent.includes('\\ufffd')) faults.push('a character has no glyph');
document.body.dataset.faults""",
)


def main():
    if not figures.shutil.which("chromium"):
        print("skipped: chromium is not installed")
        return 0
    carom, target = sys.argv[1], pathlib.Path(sys.argv[2])
    target.mkdir(parents=True, exist_ok=True)
    every = (p for part in ("book", "friction", "more", "problems") for p in pathlib.Path("derivations", part).glob("*.json"))
    scenes = [pathlib.Path(name) for name in sys.argv[3:]] or sorted(every)
    faults = []
    for scene in scenes:
        if scene.name.endswith(".answers.json"):
            continue
        name = f"{scene.parent.name}-{scene.stem}"
        text = subprocess.run(
            [carom, "solution", scene, "--format", "html"], capture_output=True, text=True, check=True
        ).stdout
        # The page allows no script, not even ours; the measuring copy does.
        text = re.sub(r"<meta http-equiv=.Content-Security-Policy.[^>]*>", "", text)
        for width in (1280, 390):
            # A headless window is at least 500 px wide: the narrow page stands in a frame, which must fit it exactly.
            for paper in ("light", "dark"):
                page = target / f"{name}.html"
                forced = text.replace("prefers-color-scheme:dark", "min-width:1px") if paper == "dark" else text
                page.write_text(forced + f"<script>{MEASURE}</script>")
                frame = target / "frame.html"
                frame.write_text(
                    f"<!doctype html><body style='margin:0'><iframe id=f src='{page.name}' width={width} height=6000 "
                    "style='border:0'></iframe><script>f.onload = () => {"
                    "document.body.dataset.faults = f.contentDocument.body.dataset.faults }</script>"
                )
                flags = ["--allow-file-access-from-files", f"--window-size={max(width, 500)},6000"]
                uri = frame.resolve().as_uri()
                figures.chromium(*flags, f"--screenshot={target / f'{name}-{width}-{paper}.png'}", uri)
                if paper == "dark":
                    continue
                dom = figures.chromium(*flags, "--virtual-time-budget=3000", "--dump-dom", uri)
                found = re.search(r'<body[^>]*data-faults="([^"]*)"', dom)
                told = json.loads(html.unescape(found.group(1))) if found else ["the page did not run"]
                faults += [f"{name} at {width} px: {fault}" for fault in told]
                page.unlink()
    (target / "frame.html").unlink(missing_ok=True)
    for rest in target.glob("*.html"):
        rest.unlink()
    print("\n".join(faults) or f"{len(scenes)} pages: nothing overflows or overlaps")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
