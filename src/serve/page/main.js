// The page: which scene, which values, which panel; all of it stands in the link.

import { $, ask, get, markup, quietly, say, told } from "/ask.js";
import { showList } from "/list.js";
import { showValues } from "/values.js";
import { MOMENTS, showFigure, redraw } from "/figure.js";
import { showFilm } from "/film.js";
import { showAnswers, renumber } from "/answers.js";
import { showTry } from "/try.js";
import { showSolution } from "/solution.js";
import { lawful, showLaws } from "/laws.js";
import { showAccuracy } from "/accuracy.js";
import { showEditor } from "/editor.js";

const PANELS = ["answers", "try", "solution", "laws", "accuracy", "scene"];
// Longest text of a changed scene that a link holds.
const IN_LINK = 8000;

// The scene on the bench. `text` is its text where it was changed here; `values` are those that differ from the first.
export const bench = { name: null, text: null, about: null, values: {}, stage: "", moment: "before", panel: "answers" };

// How a request names the scene.
export const scene = () => (bench.text === null ? { name: bench.name } : { scene: bench.text });

// The values that every parameter has now; what the file gives and nobody changed goes without saying.
export function set() {
  const all = {};
  for (const p of bench.about.parameters) {
    const changed = bench.values[p.name];
    if (changed !== undefined) all[p.name] = changed;
    else if (!p.is_given) all[p.name] = String(p.value);
  }
  return all;
}

// Writes the state into the link.
export function remember() {
  const state = new URLSearchParams({ scene: bench.name });
  if (bench.stage) state.set("stage", bench.stage);
  if (bench.moment !== "before") state.set("moment", bench.moment);
  if (bench.panel !== "answers") state.set("panel", bench.panel);
  for (const [name, value] of Object.entries(bench.values)) state.set(`v.${name}`, value);
  if (bench.text !== null && bench.text.length <= IN_LINK) state.set("text", bench.text);
  history.replaceState(null, "", `#${state}`);
}

// New values: the figure follows at once, as fast as the server draws, and the numbers come behind it.
let [drawing, moved] = [false, false];
export async function valuesChanged() {
  link();
  moved = true;
  if (drawing) return;
  drawing = true;
  while (moved) {
    moved = false;
    await redraw();
    renumber();
  }
  drawing = false;
  refilm();
}
// Browsers stop a page that writes its address too often. The list of scenes has an address of its own.
const link = quietly(() => $("bench").hidden || remember(), 200);
const refilm = quietly(() => {
  showFilm();
  refill("laws");
}, 300);

// Puts a scene on the bench, from its text where that was changed. A scene that cannot be read leaves the bench as it is.
export async function load(text) {
  const about = await ask("describe", text === null ? { name: bench.name } : { scene: text });
  if (about.faults) return about;
  Object.assign(bench, { text, about });
  const known = new Set(about.parameters.map((p) => p.name));
  bench.values = Object.fromEntries(Object.entries(bench.values).filter(([name]) => known.has(name)));
  if (!about.stages.some((s) => s.name === bench.stage)) bench.stage = about.stages[0]?.name ?? "";
  document.title = `${about.title || bench.name} – carom`;
  $("title").textContent = about.title || bench.name;
  $("source").textContent = about.source;
  $("statement").replaceChildren(markup(about.statement_html));
  showValues();
  showFigure();
  showFilm();
  showAnswers();
  stale = new Set(Object.keys(FILL));
  $("tab-laws").hidden = lawful() === undefined;
  openPanel(bench.panel);
  remember();
  return about;
}

// Panels that are filled when they are opened.
let stale = new Set();
const FILL = { try: showTry, solution: showSolution, laws: showLaws, accuracy: showAccuracy };

// Fills a panel anew, now or when it is opened.
function refill(panel) {
  stale.add(panel);
  if (bench.panel === panel) openPanel(panel);
}

// Panels of this scene: not every one has laws to compare.
const panels = () => PANELS.filter((panel) => !$(`tab-${panel}`).hidden);

function openPanel(name, focus) {
  bench.panel = panels().includes(name) ? name : "answers";
  for (const panel of PANELS) {
    const isOpen = panel === bench.panel;
    $(panel).hidden = !isOpen;
    const tab = $(`tab-${panel}`);
    tab.setAttribute("aria-selected", String(isOpen));
    tab.tabIndex = isOpen ? 0 : -1;
    if (isOpen && focus) tab.focus();
  }
  if (stale.delete(bench.panel)) FILL[bench.panel]();
  if (bench.panel === "scene") showEditor();
}

for (const panel of PANELS) {
  $(`tab-${panel}`).addEventListener("click", () => {
    openPanel(panel);
    remember();
  });
}
$("stage").addEventListener("change", () => {
  refill("accuracy");
  refill("laws");
});
$("tabs").addEventListener("keydown", (event) => {
  const all = panels();
  const at = all.indexOf(bench.panel);
  const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: -1 }[event.key];
  if (to === undefined) return;
  event.preventDefault();
  openPanel(all.at(to % all.length), true);
  remember();
});

// What the link says.
async function follow() {
  say(null);
  const state = new URLSearchParams(location.hash.slice(1));
  const name = state.get("scene");
  $("list").hidden = Boolean(name);
  $("bench").hidden = !name;
  try {
    if (!name) {
      document.title = "carom";
      $("source").textContent = "";
      await showList();
      return;
    }
    const values = [...state].filter(([key]) => key.startsWith("v."));
    Object.assign(bench, {
      name,
      values: Object.fromEntries(values.map(([key, value]) => [key.slice(2), value])),
      stage: state.get("stage") ?? "",
      moment: MOMENTS.some(([moment]) => moment === state.get("moment")) ? state.get("moment") : "before",
      panel: state.get("panel") ?? "answers",
    });
    try {
      bench.original = await get(`/v1/scenes/${name.split("/").map(encodeURIComponent).join("/")}`);
    } catch (error) {
      $("list").hidden = false;
      $("bench").hidden = true;
      await showList();
      $("source").textContent = error instanceof TypeError ? told(error) : `There is no scene ${name} here.`;
      return;
    }
    const found = await load(state.get("text"));
    if (found.faults) {
      $("title").textContent = `${name} cannot be read`;
      bench.about = null;
      for (const id of ["statement", "figure", "values", "answers"]) $(id).replaceChildren();
      openPanel("scene");
    }
  } catch (error) {
    say(error);
  }
}

addEventListener("hashchange", follow);
follow();
