#!/usr/bin/env python3
"""Looks at figures in a real browser.

usage: CAROM_GALLERY=DIR cargo test --lib figure::tests && tests/browser/figures.py DIR OUT

Opens every SVG of DIR in Chromium (Debian's package) at 330 and 900 pixels, on light and dark paper, writes one
screenshot each way to OUT, and fails if two texts cover each other or a text leaves its picture by the browser's own
measure.
"""

import html
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

FLAGS = (
    "--headless --enable-logging=stderr --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
    "--disable-component-update --disable-sync --hide-scrollbars"
).split()
PAPERS = {"light": ("white", "black"), "dark": ("#0d1117", "#e6e8eb")}
MEASURE = """
const faults = [];
for (const svg of document.querySelectorAll('svg')) {
  const name = svg.parentElement.dataset.name, edge = svg.getBoundingClientRect();
  const scale = edge.width / svg.viewBox.baseVal.width;
  const texts = [...svg.querySelectorAll('text')].map(t => {
    // A line box is taller than its letters.
    const b = t.getBoundingClientRect(), trim = b.height * 0.18;
    return [t.textContent, b.left, b.top + trim, b.right, b.bottom - trim];
  });
  texts.forEach(([a, l, t, r, b], i) => {
    if (l < edge.left - 1 || r > edge.right + 1 || t < edge.top - 1 || b > edge.bottom + 1)
      faults.push(`${name}: "${a}" leaves the picture`);
    for (const [c, l2, t2, r2, b2] of texts.slice(0, i))
      if (Math.min(r, r2) - Math.max(l, l2) > 1.5 * scale && Math.min(b, b2) - Math.max(t, t2) > 1.5 * scale)
        faults.push(`${name}: "${a}" covers "${c}"`);
  });
}
document.body.dataset.faults = JSON.stringify(faults);
"""


def chromium(*arguments):
    with tempfile.TemporaryDirectory() as profile:
        command = ["chromium", *FLAGS, f"--user-data-dir={profile}", *arguments]
        done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=True)
        console = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
        if console:
            raise SystemExit("the console says: " + "; ".join(console))
        return done.stdout


def page(figures, width, paper, ink):
    cells = [f"<div data-name='{html.escape(f.stem)}'>{f.read_text()}</div>" for f in figures]
    return (
        "<!doctype html><meta charset=utf-8><style>"
        f"body{{margin:0;background:{paper};color:{ink};display:flex;flex-wrap:wrap;gap:8px;align-items:flex-start}}"
        f"div{{width:{width}px}} svg{{width:100%;height:auto;display:block}}</style>"
        f"<body>{''.join(cells)}<script>{MEASURE}</script>"
    )


def main():
    if not shutil.which("chromium"):
        print("skipped: chromium is not installed")
        return 0
    source, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    target.mkdir(parents=True, exist_ok=True)
    figures = sorted(source.glob("*.svg"))
    faults = [] if figures else [f"no figures in {source}"]
    for width in (330, 900):
        for name, (paper, ink) in PAPERS.items():
            for part in range(0, len(figures), 12):
                file = target / "page.html"
                file.write_text(page(figures[part : part + 12], width, paper, ink))
                size = "1020,1500" if width == 330 else "910,6000"
                shot = target / f"{width}-{name}-{part // 12:02}.png"
                chromium(f"--window-size={size}", f"--screenshot={shot}", file.resolve().as_uri())
                if name == "light":
                    dom = chromium(f"--window-size={size}", "--dump-dom", file.resolve().as_uri())
                    found = re.search(r'data-faults="([^"]*)"', dom)
                    told = json.loads(html.unescape(found.group(1))) if found else ["the page did not run"]
                    faults += [f"{width} px: {fault}" for fault in told]
    (target / "page.html").unlink(missing_ok=True)
    print("\n".join(faults) or f"{len(figures)} figures: no text covers another or leaves its picture")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
