// The text of the scene, with what the reader says of it at its place, and "save as".

import { $, ask, latest, make, quietly, told } from "/ask.js";
import { bench, load, remember } from "/main.js";

const reading = latest();

export function showEditor() {
  const panel = $("scene");
  if (panel.dataset.name === bench.name && panel.firstChild) return;
  panel.dataset.name = bench.name;
  const text = make("textarea", { id: "text", spellcheck: "false", autocapitalize: "none", wrap: "off", "aria-describedby": "faults" });
  const behind = make("pre", { "aria-hidden": "true" });
  const faults = make("div", { id: "faults", class: "faults", role: "status" });
  text.value = bench.text ?? bench.original;
  const show = (found) => {
    mark(behind, text.value, found.faults ?? []);
    follow();
    faults.replaceChildren(...messages(found, text));
  };
  const follow = () => {
    behind.scrollTop = text.scrollTop;
    behind.scrollLeft = text.scrollLeft;
  };
  const read = quietly(async () => {
    try {
      const found = await reading(() => check(text.value));
      if (found) show(found);
    } catch (error) {
      faults.replaceChildren(make("p", { class: "wrong" }, told(error)));
    }
  }, 250);
  text.addEventListener("input", () => {
    mark(behind, text.value, []);
    read();
  });
  text.addEventListener("scroll", follow);
  // Tab leaves the box, as it does everywhere; so the keyboard is not caught.
  const save = make("button", { type: "button", onclick: () => saveAs(text.value) }, "Save as …");
  const back = make("button", { type: "button" }, "As in the folder");
  back.addEventListener("click", async () => {
    text.value = bench.original;
    show(await load(null).catch((error) => ({ faults: [{ line: 1, column: 1, start: 0, end: 0, message: told(error) }] })));
    remember();
  });
  panel.replaceChildren(
    make("p", { class: "note" }, make("label", { for: "text" }, "The scene as JSON; changes count here at once, and in the folder never.")),
    make("div", { class: "editor" }, behind, text), faults, make("div", { class: "bar" }, save, back));
  read();
}

// A scene that can be read goes on the bench; one that cannot leaves the last good one there.
async function check(text) {
  if (text === bench.original && bench.text === null && bench.about) return {};
  if (text === bench.text) return {};
  return load(text === bench.original ? null : text);
}

// The places of the faults behind the text.
function mark(behind, text, faults) {
  const parts = [];
  let at = 0;
  for (const fault of [...faults].sort((a, b) => a.start - b.start)) {
    if (fault.start < at) continue;
    const end = Math.max(fault.end, fault.start + 1);
    parts.push(text.slice(at, fault.start), make("mark", {}, text.slice(fault.start, end)));
    at = end;
  }
  behind.replaceChildren(...parts, text.slice(at), "\n\n");
}

function messages(found, text) {
  const { faults = [], untold = 0 } = found;
  if (!faults.length) return [make("p", { class: "note" }, "The scene can be read.")];
  const each = faults.map((fault) => {
    const go = () => {
      text.focus();
      text.setSelectionRange(fault.start, Math.max(fault.end, fault.start));
      const line = parseFloat(getComputedStyle(text).lineHeight);
      text.scrollTop = Math.max(0, (fault.line - 4) * line);
    };
    const words = make("span", { class: "wrong" }, ` ${fault.message}`);
    const hint = fault.hint ? make("div", { class: "note" }, fault.hint) : null;
    return make("button", { type: "button", onclick: go }, `line ${fault.line}, ${fault.pointer || `column ${fault.column}`}:`, words, hint);
  });
  if (untold) each.push(make("p", { class: "note" }, `and ${untold} more`));
  return each;
}

function saveAs(text) {
  const address = URL.createObjectURL(new Blob([text], { type: "application/json" }));
  const name = bench.name.split("/").at(-1);
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
