// How accurate the numbers are and what they cost: every route to them, its error against its run time, and its code.

import { $, ask, latest, make, told } from "/ask.js";
import { bench, scene } from "/main.js";

const SPACE = "http://www.w3.org/2000/svg";
// Room of the plot, in its own units: width, height, margins left, right, top and bottom.
const [WIDE, HIGH, LEFT, RIGHT, TOP, BOTTOM] = [560, 340, 58, 20, 26, 44];
const LANGUAGES = [["python", "Python"], ["numpy", "NumPy"], ["c", "C"], ["rust", "Rust"], ["no-std", "Rust without std"]];

const measured = latest();
const written = latest();

// The impact that is chosen; a motion has no routes, and the first impact takes its place.
function stage() {
  const chosen = bench.about.stages.find((s) => s.name === bench.stage);
  return chosen?.is_impact ? { stage: chosen.name } : {};
}

export async function showAccuracy() {
  const panel = $("accuracy");
  panel.replaceChildren(make("p", { class: "note", role: "status" }, "Measuring every route; this takes some seconds …"));
  try {
    const found = await measured((signal) => ask("report", { ...scene(), ...stage() }, signal));
    if (!found) return;
    const [report] = found.reports;
    const machine = report.machine;
    const slow = machine.optimized ? "" : " This carom is not optimized: times mean little.";
    panel.replaceChildren(
      make("p", { class: "advice" }, report.verdict),
      plot(report.routes),
      make("p", { class: "note" }, "Filled: largest error at usual values; hollow: largest error towards every extreme, ∞ on top. Routes that another one beats in both are faint. Point at a mark for its figures."),
      table(report.routes), code(),
      make("p", { class: "note" }, `${report.effort.points} points a level, ${report.effort.runs} timed runs of ${report.effort.repeat}, on ${machine.architecture} under ${machine.system}; errors in units in the last place (ulp) of the exact answer.${slow} carom report measures more.`));
  } catch (error) {
    panel.replaceChildren(make("p", { class: "wrong" }, told(error)));
  }
}

// A time in a unit of its own, with three digits.
function time(seconds) {
  const [unit, scale] = [["ns", 1e9], ["µs", 1e6], ["ms", 1e3]].find(([, k]) => seconds * k < 1000) ?? ["s", 1];
  return `${Number((seconds * scale).toPrecision(3))} ${unit}`;
}

// An error; JSON has none for ∞.
function error(ulps) {
  if (ulps == null) return "∞";
  return ulps < 1e4 ? String(Number(ulps.toPrecision(3))) : ulps.toExponential(1).replace("e+", "e");
}

const about = (r) => `${r.words}: ${time(r.seconds[1])} (quartiles ${time(r.seconds[0])} to ${time(r.seconds[2])}), `
  + `within ${error(r.usual_max)} ulp at usual values, ${error(r.worst)} ulp at worst (${r.worst_family})`;

function shape(tag, given, ...children) {
  const element = document.createElementNS(SPACE, tag);
  for (const [name, value] of Object.entries(given)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

// Error against run time, both logarithmic.
function plot(routes) {
  const timed = routes.map((r, i) => ({ ...r, number: i + 1 })).filter((r) => r.seconds[1] > 0);
  const times = timed.map((r) => Math.log10(r.seconds[1]));
  const [first, last] = [Math.floor(Math.min(...times)), Math.max(Math.floor(Math.min(...times)) + 1, Math.ceil(Math.max(...times)))];
  const largest = Math.max(...timed.flatMap((r) => [r.usual_max, r.worst]).map((e) => Math.log10(Math.max(e ?? 0, 1))));
  const top = Math.max(2, Math.ceil(largest + 0.3));
  const x = (seconds) => LEFT + ((Math.log10(seconds) - first) / (last - first)) * (WIDE - LEFT - RIGHT);
  const level = (log) => HIGH - BOTTOM - ((log + 1) / (top + 1)) * (HIGH - TOP - BOTTOM - 14);
  const y = (ulps) => (ulps == null ? TOP : level(Math.max(-1, Math.log10(ulps || 0.1))));
  const parts = [];
  for (let k = first; k <= last; k += 1) {
    const at = x(10 ** k);
    parts.push(shape("line", { x1: at, x2: at, y1: TOP, y2: HIGH - BOTTOM, class: "grid" }),
      shape("text", { x: at, y: HIGH - BOTTOM + 18, "text-anchor": "middle" }, time(10 ** k)));
  }
  const step = Math.ceil(top / 6);
  for (let k = 0; k <= top; k += step) {
    parts.push(shape("line", { x1: LEFT, x2: WIDE - RIGHT, y1: level(k), y2: level(k), class: "grid" }),
      shape("text", { x: LEFT - 8, y: level(k) + 4, "text-anchor": "end" }, k < 4 ? String(10 ** k) : `1e${k}`));
  }
  parts.push(shape("text", { x: LEFT - 8, y: TOP + 4, "text-anchor": "end" }, "∞"),
    shape("text", { x: LEFT, y: 12 }, "largest error [ulp]"),
    shape("text", { x: WIDE - RIGHT, y: HIGH - 6, "text-anchor": "end" }, "median time of one evaluation"));
  const taken = [];
  for (const r of timed) {
    const at = x(r.seconds[1]);
    const mark = shape("g", { class: r.dominated ? "route beaten" : "route", tabindex: "0", role: "img", "aria-label": about(r) },
      shape("title", {}, about(r)),
      shape("line", { x1: at, x2: at, y1: y(r.usual_max), y2: y(r.worst) }),
      shape("circle", { cx: at, cy: y(r.worst), r: 6, class: "worst" }),
      shape("circle", { cx: at, cy: y(r.usual_max), r: 5, class: "usual" }));
    // The numbers of marks that lie on each other stand beside each other.
    let label = at + 10;
    while (taken.some(([px, py]) => Math.abs(px - label) < 12 && Math.abs(py - y(r.usual_max)) < 13)) label += 13;
    taken.push([label, y(r.usual_max)]);
    mark.append(shape("text", { x: label, y: y(r.usual_max) - 5 }, String(r.number)));
    parts.push(mark);
  }
  return shape("svg", { viewBox: `0 0 ${WIDE} ${HIGH}`, class: "scatter", role: "group", "aria-label": "Error against run time of every route" }, ...parts);
}

function table(routes) {
  const head = ["", "route", "time", "usual [ulp]", "worst [ulp]", "worst in"];
  const rows = routes.map((r, i) => make("tr", r.dominated ? { class: "beaten" } : {},
    ...[i + 1, r.words, r.seconds[1] > 0 ? time(r.seconds[1]) : "–", error(r.usual_max), error(r.worst), r.worst_family].map((cell) => make("td", {}, String(cell)))));
  return make("div", { class: "wide" }, make("table", { class: "lines" },
    make("tr", {}, ...head.map((h) => make("th", { scope: "col" }, h))), ...rows));
}

// The code of the closed forms in a language; the other routes solve the equations anew, which a program asks of carom.
function code() {
  const language = make("select", { id: "language" }, ...LANGUAGES.map(([value, words]) => make("option", { value }, words)));
  const plain = make("input", { type: "checkbox", id: "plain" });
  const text = make("pre", { tabindex: "0", "aria-label": "Code" });
  const write = async () => {
    try {
      const request = { ...scene(), ...stage(), lang: language.value, plain: plain.checked };
      const found = await written((signal) => ask("emit", request, signal));
      if (found !== undefined) text.textContent = found;
    } catch (problem) {
      text.textContent = told(problem);
    }
  };
  language.addEventListener("change", write);
  plain.addEventListener("change", write);
  write();
  return make("section", {}, make("h3", {}, "Code of the closed forms"),
    make("div", { class: "bar" }, make("label", {}, "Language ", language), make("label", {}, plain, " without scaling by powers of two")), text,
    make("p", { class: "note" }, "The other routes solve the equations of the scene anew at every point: carom solve, with --exact in fractions."));
}
