#!/usr/bin/env python3
"""Uses the workbench in a real browser.

usage: tests/browser/workbench.py CAROM OUT [SCENE...]

Starts `CAROM serve derivations`, opens every scene (or those named) in Chromium through its driver (both Debian's packages)
at 1280 px on light and at 390 px on dark paper, moves a slider, opens every panel, writes screenshots to OUT, and fails if a
page is wider than its window, says that something is wrong, lacks its figure, or if the console says anything. On the
falling stick it also judges a wrong answer, plays its motion beside the right one, measures the routes, breaks the scene and mends it.
"""

import base64
import json
import pathlib
import shutil
import subprocess
import sys
import time
import urllib.error
import urllib.parse
import urllib.request


class Browser:
    """A session of the driver."""

    def __init__(self, port):
        self.base = f"http://127.0.0.1:{port}"
        options = {"args": ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]}
        wanted = {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        self.base += "/session/" + self.ask("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})["sessionId"]

    def ask(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.base + path, data=data, method=method)
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as refused:
            raise RuntimeError(json.load(refused)["value"]["message"]) from None

    def open(self, address):
        # Another part of the same page would be no new page.
        self.ask("POST", "/url", {"url": "about:blank"})
        self.ask("POST", "/url", {"url": address})

    def run(self, script):
        return self.ask("POST", "/execute/sync", {"script": script, "args": []})

    def tell(self, command, **parameters):
        self.ask("POST", "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def wait(self, condition, what, seconds=60):
        end = time.monotonic() + seconds
        while not self.run(f"return Boolean({condition})"):
            if time.monotonic() > end:
                raise TimeoutError(what)
            time.sleep(0.05)

    def paper(self, width, scheme):
        self.tell("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
        self.tell("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def picture(self, path):
        high = self.run("return document.documentElement.scrollHeight")
        wide = self.run("return document.documentElement.clientWidth")
        clip = {"x": 0, "y": 0, "width": wide, "height": min(high, 8000), "scale": 1}
        shot = self.ask("POST", "/goog/cdp/execute", {"cmd": "Page.captureScreenshot", "params": {"clip": clip, "captureBeyondViewport": True}})
        path.write_bytes(base64.b64decode(shot["data"]))


LOADED = "document.querySelector('#figure svg') && document.querySelector('#answers details')"
FAULTS = """
const faults = [];
const wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
if (wide > 0) faults.push(`the page is ${wide} px too wide`);
for (const e of document.querySelectorAll('.wrong, #trouble')) {
  if (e.checkVisibility() && e.textContent.trim()) faults.push(`it says: ${e.textContent.slice(0, 120)}`);
}
if (document.body.textContent.includes('\\ufffd')) faults.push('a character has no glyph');
for (const e of document.querySelectorAll('input, select, textarea, button')) {
  if (e.checkVisibility() && !(e.labels?.length || e.getAttribute('aria-label') || e.textContent.trim())) {
    faults.push(`${e.id || e.outerHTML.slice(0, 60)} has no label`);
  }
}
return faults;
"""
MOVE = """
const slider = document.querySelector('#values input[type=range]');
if (!slider) return;
window.before = document.querySelector('#figure svg');
slider.stepUp(2);
slider.dispatchEvent(new Event('input', { bubbles: true }));
"""
PANELS = {"try": "#try form", "solution": "#solution button", "laws": "#laws table", "scene": "#scene textarea"}


def look(browser, base, scene, width, scheme, target):
    """Opens a scene and all its panels; gives what is wrong."""
    browser.paper(width, scheme)
    browser.open(f"{base}#scene={urllib.parse.quote(scene, safe='')}")
    browser.wait(LOADED, "figure and answers")
    faults = browser.run(FAULTS)
    browser.picture(target / f"{scene.removesuffix('.json').replace('/', '-')}-{width}.png")
    if browser.run(MOVE + "return Boolean(slider)"):
        moved = "document.querySelector('#figure svg') !== window.before || document.querySelector('#values-note').textContent"
        browser.wait(moved, "the figure follows the slider")
    for panel, inside in PANELS.items():
        if browser.run(f"return document.getElementById('tab-{panel}').hidden"):
            continue
        browser.run(f"document.getElementById('tab-{panel}').click()")
        browser.wait(f"document.querySelector('{inside}')", panel)
        faults += [f"{panel}: {fault}" for fault in browser.run(FAULTS) if "it says" not in fault]
    return faults


def grade_and_edit(browser, base):
    """A wrong answer with its counterexample, and a scene that is broken and mended."""
    browser.open(f"{base}#scene=book%2Ffalling-stick.json&panel=try")
    browser.wait("document.querySelector('#try-omega')", "an answer box")
    type_in = "const box = document.getElementById('{}'); box.value = {}; box.dispatchEvent(new Event('input', {{bubbles: true}}));"
    browser.run(type_in.format("try-omega", "'3v/(2l)'"))
    browser.wait("document.querySelector('#try-omega-echo math')", "how it reads")
    browser.run("document.getElementById('try-omega').form.requestSubmit()")
    browser.wait("document.querySelector('#try .verdict.failed button')", "the counterexample")
    browser.run("document.querySelector('#try .verdict.failed button').click()")
    browser.wait("location.hash.includes('v.theta=acos')", "its values")
    browser.wait("document.querySelector('#film-picture .claimed')", "both motions, played")
    browser.run("document.getElementById('tab-accuracy').click()")
    browser.wait("document.querySelector('#accuracy .scatter svg circle') && document.querySelector('#accuracy pre').textContent", "routes and code")
    browser.run("document.getElementById('tab-scene').click()")
    browser.wait("document.getElementById('text')", "the text of the scene")
    browser.run(type_in.format("text", "box.value.replace('\"sticking\"', '\"stickng\"')"))
    browser.wait("document.querySelector('#faults button') && document.querySelector('#scene mark')", "the message at its place")
    browser.run(type_in.format("text", "box.value.replace('\"stickng\"', '\"sticking\"')"))
    browser.wait("!document.querySelector('#faults button')", "no message")


def other_case(browser, base):
    """Values that lead to another case than those of the file: its formulas stand by the numbers."""
    browser.open(f"{base}#scene=friction%2Fball-bounces-with-backspin.json&v.mu=0.1")
    browser.wait("document.querySelector('#answers [aria-label^=\"v_x = \"][aria-label*=\"mu\"]')", "the formula of the ball that slides")


def main():
    if not shutil.which("chromedriver"):
        print("skipped: chromium-driver is not installed")
        return 0
    carom, target = sys.argv[1], pathlib.Path(sys.argv[2])
    target.mkdir(parents=True, exist_ok=True)
    server = subprocess.Popen([carom, "serve", "derivations", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    faults = []
    try:
        base = server.stdout.readline().strip()
        port = next(line for line in driver.stdout if "successfully on port" in line).rstrip(".\n").split()[-1]
        browser = Browser(port)
        with urllib.request.urlopen(f"{base}v1/scenes") as answer:
            every = [scene["name"] for scene in json.load(answer)["scenes"]]
        scenes = sys.argv[3:] or every
        for scene in scenes:
            for width, scheme in ((1280, "light"), (390, "dark")):
                try:
                    faults += [f"{scene} at {width} px: {fault}" for fault in look(browser, base, scene, width, scheme, target)]
                except TimeoutError as missing:
                    faults.append(f"{scene} at {width} px: missing: {missing}")
        try:
            grade_and_edit(browser, base)
            other_case(browser, base)
        except TimeoutError as missing:
            faults.append(f"missing: {missing}")
        # A refused value is told by the server with 422, which the console repeats.
        said = [line["message"] for line in browser.ask("POST", "/se/log", {"type": "browser"})]
        faults += [f"the console says: {line}" for line in said if "422" not in line]
        browser.ask("DELETE", "")
    finally:
        driver.terminate()
        server.terminate()
    print("\n".join(faults) or f"{len(scenes)} scenes: nothing is missing, nothing overflows")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
