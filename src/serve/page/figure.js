// The figure at the values of the sliders: before, during, after; stage by stage where there are stages.

import { $, ask, latest, make, markup, told } from "/ask.js";
import { bench, remember, scene, set } from "/main.js";
import { refuse } from "/values.js";

export const MOMENTS = [["before", "before"], ["during", "during"], ["after", "after"], ["all", "all"]];

export function showFigure() {
  const { stages } = bench.about;
  $("stage-label").hidden = !stages.length;
  $("stage").replaceChildren(...stages.map((s) => make("option", { value: s.name }, s.name)));
  $("stage").value = bench.stage;
  const legend = $("moments").firstElementChild;
  $("moments").replaceChildren(legend, ...MOMENTS.map(([value, words]) => {
    const button = make("input", { type: "radio", name: "moment", value, onchange: () => go(bench.stage, value) });
    return make("label", {}, button, words);
  }));
  choose();
  redraw();
}

// Marks what is chosen.
function choose() {
  const stage = bench.about.stages.find((s) => s.name === bench.stage);
  $("stage").value = bench.stage;
  $("moments").hidden = stage ? !stage.is_impact : false;
  for (const button of $("moments").querySelectorAll("input")) button.checked = button.value === bench.moment;
}

function go(stage, moment) {
  Object.assign(bench, { stage, moment });
  choose();
  remember();
  redraw();
}

$("stage").addEventListener("change", () => go($("stage").value, bench.moment));

const drawn = latest();

export async function redraw() {
  if (!bench.about) return;
  const request = { ...scene(), set: set(), which: bench.moment };
  if (bench.stage) request.stage = bench.stage;
  const figure = $("figure");
  figure.setAttribute("aria-busy", "true");
  try {
    const svg = await drawn((signal) => ask("draw", request, signal));
    if (svg === undefined) return;
    figure.replaceChildren(markup(svg));
    figure.classList.remove("stale");
    refuse(null);
  } catch (error) {
    // The picture before stays, faint: it is not that of these values.
    figure.classList.add("stale");
    refuse(told(error));
  }
  figure.setAttribute("aria-busy", "false");
}

// All pictures in the order of time.
function pictures() {
  const three = ["before", "during", "after"];
  const { stages } = bench.about;
  if (!stages.length) return three.map((moment) => ["", moment]);
  return stages.flatMap((s) => (s.is_impact ? three.map((moment) => [s.name, moment]) : [[s.name, "before"]]));
}

function step(by) {
  const all = pictures();
  const stage = bench.about.stages.find((s) => s.name === bench.stage);
  const moment = stage && !stage.is_impact ? "before" : bench.moment;
  const at = Math.max(0, all.findIndex(([s, m]) => s === bench.stage && m === moment));
  go(...all.at((at + by) % all.length));
}

$("on").addEventListener("click", () => step(1));
$("back").addEventListener("click", () => step(-1));
