// Answers to try: how each reads while it is typed, what is found of it, and the point that shows it wrong. Below, a worked
// solution whose lines are marked.

import { $, ask, latest, make, markup, quietly, told } from "/ask.js";
import { bench, scene } from "/main.js";
import { cases, derived, formulasIn, prose, typeset } from "/answers.js";
import { beside } from "/film.js";
import { putValues } from "/values.js";

const WORDS = { equivalent: ["✓ Right", "held"], different: ["✗ Not right", "failed"], invalid: ["? Not readable", "unsure"], undecided: ["? Not decided", "unsure"] };

export async function showTry() {
  const panel = $("try");
  panel.replaceChildren(make("p", { class: "note", role: "status" }, "Deriving …"));
  const found = await derived().catch(() => null);
  if (!found) {
    panel.replaceChildren(make("p", { class: "note" }, "Nothing is derived, so nothing can be judged."));
    return;
  }
  const asked = new Map();
  for (const a of cases(found).flatMap((one) => one.answers)) {
    const about = asked.get(a.question) ?? { name: a.question, words: a.words.replace(/, along [xy]$/, "").replace(/^(\w+)_[xy] for /, "$1 for "), symbols: [] };
    about.symbols.push(a.symbol ?? a.name);
    asked.set(a.question, about);
  }
  const all = [...asked.values()];
  const set = await typeset(formulasIn(all.map((a) => a.words)), all.flatMap((a) => a.symbols));
  panel.replaceChildren(
    make("p", { class: "note" }, "Type formulas as you like: 3v cos(theta)/(2l), \\frac{1}{2} m v^2; vectors as (a, b). Enter judges."),
    ...all.map((a) => question(a, set)), steps());
}

function question(about, set) {
  const id = `try-${about.name}`;
  const symbols = [...new Set(about.symbols)].flatMap((s, i) => [i ? ", " : "", set.symbols.get(s) ? markup(set.symbols.get(s)) : s]);
  const box = make("input", { type: "text", id, autocomplete: "off", autocapitalize: "none", spellcheck: "false", maxlength: 4000, "aria-describedby": `${id}-echo` });
  const echo = make("div", { class: "echo", id: `${id}-echo` });
  const verdict = make("div", { role: "status" });
  const reading = latest();
  const read = quietly(async () => {
    if (!box.value.trim()) return echo.replaceChildren();
    const found = await reading((signal) => ask("describe", { ...scene(), formulas: [box.value] }, signal)).catch(() => undefined);
    if (found) echo.replaceChildren(...understood(found.readings[0]));
  }, 120);
  box.addEventListener("input", () => {
    verdict.replaceChildren();
    read();
  });
  const judging = latest();
  const judge = async (event) => {
    event.preventDefault();
    if (!box.value.trim()) return;
    verdict.replaceChildren(make("p", { class: "note" }, "Judging …"));
    beside(null);
    try {
      const grade = await judging((signal) => ask("grade", { ...scene(), quantity: about.name, answer: box.value }, signal));
      if (grade) verdict.replaceChildren(await shown(grade, about.name, box.value));
    } catch (error) {
      verdict.replaceChildren(make("p", { class: "wrong" }, told(error)));
    }
  };
  const form = make("form", { onsubmit: judge }, make("label", { for: id }, ...symbols, " ="), box, make("button", {}, "Judge"));
  return make("section", { class: "try" }, make("h3", {}, ...prose(set, about.words)), form, echo, verdict);
}

// How a formula reads.
function understood(reading) {
  if (reading.error) return [reading.error.message, reading.error.hint ? ` ${reading.error.hint}` : ""];
  const unknown = reading.unknown.length ? ` — the scene has no ${reading.unknown.join(", ")}` : "";
  return ["reads ", markup(reading.mathml), unknown, ...reading.notes.map((n) => make("div", {}, n))];
}

async function shown(grade, quantity, answer) {
  const c = grade.counterexample;
  const at = c?.at ? `With ${c.at}: yours` : "Yours";
  const differ = c ? `${at} ${c.yours}, expected ${c.expected}.` : "";
  const hints = grade.diagnosis ?? [];
  const set = await typeset(formulasIn([differ, ...hints.flatMap((d) => [d.hint, d.message])]), []);
  const [words, kind] = WORDS[grade.verdict] ?? [grade.verdict, "unsure"];
  const parts = [make("strong", {}, words), make("p", { class: "note" }, grade.proof.words)];
  if (grade.error) parts.push(make("p", {}, grade.error.message), grade.error.hint ? make("p", {}, grade.error.hint) : null);
  for (const [i, d] of hints.entries()) {
    const isNew = hints.findIndex((other) => other.hint === d.hint) === i;
    if (isNew) parts.push(make("p", {}, ...prose(set, d.hint)));
    if (d.message !== d.hint) parts.push(make("details", {}, make("summary", {}, "What it seems to be"), ...prose(set, d.message)));
  }
  if (c) {
    parts.push(make("p", {}, ...prose(set, differ)));
    const values = point(c.at);
    const known = Object.keys(values).some((name) => bench.about.parameters.some((p) => p.name === name));
    const play = () => {
      beside({ quantity, answer });
      putValues(values);
      $("film").scrollIntoView({ block: "nearest", behavior: "smooth" });
    };
    if (known) parts.push(make("button", { type: "button", onclick: play }, "Play both motions at these values"));
  }
  if (grade.assumed?.length) parts.push(make("p", { class: "note" }, `Taken for granted: ${grade.assumed.join(", ")}.`));
  for (const doubt of grade.doubts ?? []) parts.push(make("p", { class: "unsure" }, doubt));
  return make("div", { class: `verdict ${kind}` }, ...parts.filter(Boolean));
}

// The values of a point in words: `l = 1, theta with cos(theta) = 3/5, sin(theta) = -4/5`.
function point(words) {
  const out = {};
  for (const [, name, value] of words.matchAll(/([^\s,=]+) = ([^,]+)/g)) {
    const angle = name.match(/^(cos|sin)\((.+)\)$/);
    if (!angle) out[name] = value.trim();
    else if (angle[1] === "cos") out[angle[2]] = `acos(${value.trim()})`;
    else if (value.trim().startsWith("-")) out[angle[2]] = `-${out[angle[2]]}`;
  }
  return out;
}

const MARKS = { holds: "✓", defines: "✓", wrong: "✗", carried: "→", unread: "?", open: "?", words: "" };

// A whole solution, marked line by line.
function steps() {
  const box = make("textarea", { id: "lines", rows: 5, spellcheck: "false", autocapitalize: "none" });
  const found = make("div", { role: "status" });
  const mark = async () => {
    if (!box.value.trim()) return;
    try {
      const marked = await ask("grade", { ...scene(), steps: box.value });
      const rows = marked.lines.map((l) => make("tr", {}, make("td", { "aria-label": l.status }, MARKS[l.status] ?? "?"), make("td", {}, l.text),
        make("td", {}, [l.words, ...l.diagnosis.map((d) => d.message)].filter(Boolean).join("; "))));
      found.replaceChildren(make("p", {}, marked.summary), make("table", { class: "lines" }, ...rows));
    } catch (error) {
      found.replaceChildren(make("p", { class: "wrong" }, told(error)));
    }
  };
  return make("section", { class: "try" }, make("h3", {}, make("label", { for: "lines" }, "A worked solution, one equation a line")), box,
    make("button", { type: "button", onclick: mark }, "Mark the lines"), found);
}
