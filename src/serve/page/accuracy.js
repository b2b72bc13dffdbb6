// How accurate the numbers are and what they cost: every route to them, its error against its run time, and its code.

import { $, ask, latest, make, markup, told } from "/ask.js";
import { bench, scene } from "/main.js";

const LANGUAGES = [["python", "Python"], ["numpy", "NumPy"], ["c", "C"], ["rust", "Rust"], ["no-std", "Rust without std"]];

const measured = latest();
const written = latest();

// The impact that is chosen, or the first one where that is a motion; undefined where there are motions alone.
function impact() {
  const { stages } = bench.about;
  if (!stages.length) return {};
  const chosen = stages.find((s) => s.is_impact && s.name === bench.stage) ?? stages.find((s) => s.is_impact);
  return chosen && { stage: chosen.name };
}

export async function showAccuracy() {
  const panel = $("accuracy");
  const stage = impact();
  if (!stage) {
    panel.replaceChildren(make("p", { class: "note" }, "Motions have no equations to solve, and so no other routes beside their formulas."), code());
    return;
  }
  panel.replaceChildren(make("p", { class: "note", role: "status" }, "Measuring every route; this takes some seconds …"));
  try {
    const found = await measured((signal) => ask("report", { ...scene(), ...stage }, signal));
    if (!found) return;
    const [report] = found.reports;
    const machine = report.machine;
    const slow = machine.optimized ? "" : " This carom is not optimized: times mean little.";
    panel.replaceChildren(
      make("p", { class: "advice" }, report.verdict),
      make("div", { class: "scatter" }, markup(report.plot ?? "")),
      make("p", { class: "note" }, "Largest error at usual values over the time of one evaluation; the line joins the routes that no other one beats in both. Point at a mark for its figures."),
      table(report.routes), code(),
      make("p", { class: "note" }, `${report.effort.points} points a level, ${report.effort.runs} timed runs of ${report.effort.repeat}, on ${machine.architecture} under ${machine.system}; errors in units in the last place (ulp) of the exact answer.${slow} carom report measures more.`));
  } catch (error) {
    panel.replaceChildren(make("p", { class: "wrong" }, told(error)), code());
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

function table(routes) {
  const head = ["route", "time", "usual [ulp]", "worst [ulp]", "worst in"];
  const rows = routes.map((r) => make("tr", r.dominated ? { class: "beaten" } : {},
    ...[r.words, r.seconds[1] > 0 ? time(r.seconds[1]) : "–", error(r.usual_max), error(r.worst), r.worst_family].map((cell) => make("td", {}, String(cell)))));
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
      const request = { ...scene(), ...impact(), lang: language.value, plain: plain.checked };
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
