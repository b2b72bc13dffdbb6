// The answers: formulas as derived, numbers at the values of the sliders, and how each is known.

import { $, ask, digits, latest, make, markup, quietly, told } from "/ask.js";
import { bench, scene, set } from "/main.js";

const derivedOnce = latest();
const solved = latest();
const valued = latest();
// Where the number of an answer stands, by the answer's name.
let places = new Map();
// Whether an answer holds in one case alone, and the formulas that are shown.
let [conditional, shown] = [false, ""];
// Names of the answers, and how they are written.
let answerNames = [];
let letters = new Map();
// What was derived last, for the panels that build on it.
let last = Promise.resolve(null);

export const derived = () => last;

// Words without the marks around names in them.
const plain = (words) => words.replaceAll("`", "");

const TOKEN = /`[^`]*`|[\p{L}_][\p{L}\p{N}_]*|\d+(?:\.\d+)?|<=|>=|\s+|./gu;
const SIGN = /^(?:[-+*/^()=<>≤≥]|<=|>=|\d.*|\s+)$/;
const FUNCTIONS = new Set(["sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "ln", "exp", "abs", "min", "max", "pi"]);
const GREEK = /^(?:alpha|beta|gamma|delta|epsilon|zeta|eta|theta|kappa|lambda|mu|nu|xi|rho|sigma|tau|phi|chi|psi|omega)$/i;
// Words of the language that could be names too.
const LITTLE = /^(?:a|i|an|as|at|be|by|if|in|is|it|no|of|on|or|so|to|up|we)$/i;

// A sentence as pieces in order: words, and formulas in names of the scene.
export function pieces(text) {
  const names = new Set([...bench.about.parameters.map((p) => p.name), ...answerNames]
    .filter((name) => name.length < 3 || /[\d_]/.test(name) || GREEK.test(name)));
  const out = [];
  let run = [];
  const end = () => {
    // Blanks, signs and brackets at the ends belong to the sentence.
    let [first, last] = [0, run.length];
    const count = (sign) => run.slice(first, last).filter((t) => t === sign).length;
    while (first < last && /^(?:[+*/^)=<>≤≥]|<=|>=|\s+)$/.test(run[first])) first += 1;
    while (first < last && /^(?:[-+*/^(=<>≤≥]|<=|>=|\s+)$/.test(run[last - 1])) last -= 1;
    while (run[first] === "(" && count("(") > count(")")) first += 1;
    while (run[last - 1] === ")" && count(")") > count("(")) last -= 1;
    const inner = run.slice(first, last);
    const isFormula = inner.some((t) => names.has(t)) && !(inner.length === 1 && LITTLE.test(inner[0]));
    out.push({ words: run.slice(0, first).join("") }, { [isFormula ? "formula" : "words"]: inner.join("") },
      { words: run.slice(last).join("") });
    run = [];
  };
  for (const [token] of text.matchAll(TOKEN)) {
    if (names.has(token) || FUNCTIONS.has(token) || SIGN.test(token)) run.push(token);
    else {
      end();
      out.push({ words: plain(token) });
    }
  }
  end();
  return out.filter((piece) => piece.words !== "");
}

// The formulas in sentences.
export const formulasIn = (sentences) => sentences.flatMap((s) => pieces(s).flatMap((p) => p.formula ?? []));

// A sentence with its formulas typeset.
export const prose = (set, sentence) => pieces(sentence).map((p) => (p.formula ? written(set, p.formula) : p.words));

export function showAnswers() {
  places = new Map();
  const panel = $("answers");
  panel.replaceChildren(make("p", { class: "note", role: "status" }, "Deriving …"));
  last = derivedOnce((signal) => ask("derive", scene(), signal));
  last.then((found) => found && draw(found)).catch((error) => {
    panel.replaceChildren(make("p", { class: "wrong", role: "status" }, told(error)));
    last = Promise.resolve(null);
  });
  return last;
}

// The answers of what was derived; with friction, of every case.
export function cases(found) {
  return found.cases ?? [found];
}

const formulasOf = (found) => cases(found).flatMap((one) => one.answers.map((a) => `${a.name} = ${a.formula}`)).join("; ");

// What an answer rests on beside the domains of the parameters.
const restsOn = (a) => (a.assumptions ?? []).filter((words) => /[<>≤≥]/.test(words) && !bench.about.conditions.includes(words));

async function draw(found) {
  places = new Map();
  shown = formulasOf(found);
  const all = cases(found);
  conditional = !found.cases && all[0].answers.some((a) => restsOn(a).length);
  answerNames = all.flatMap((one) => one.answers.map((a) => a.name));
  const formulas = [];
  const symbols = [];
  for (const one of all) {
    for (const a of one.answers) {
      formulas.push(a.formula ?? "", ...(a.range ?? []));
      symbols.push(a.symbol ?? a.name);
      formulas.push(...formulasIn([a.words, ...(a.text ?? []), ...(a.assumptions ?? []), ...a.checks.map((c) => c.words)]));
    }
    formulas.push(...formulasIn((one.checks ?? []).map((c) => c.words)));
    for (const w of one.where ?? []) formulas.push(`${w.name} = ${w.formula}`);
    for (const c of one.conditions ?? []) formulas.push(`${c.left.formula} ${c.relation} ${c.right.formula}`);
  }
  const set = await typeset(formulas, symbols);
  letters = new Map(all.flatMap((one) => one.answers.map((a) => [a.name, set.symbols.get(a.symbol ?? a.name)])));
  const everywhere = (a) => all.length > 1 && all.every((one) => one.answers.some((b) => b.name === a.name && b.formula === a.formula));
  const common = all[0].answers.filter(everywhere);
  const parts = [];
  if (found.refusals?.length) parts.push(...found.refusals.map((why) => make("p", { class: "failed" }, `✗ ${why}.`)));
  for (const one of all) {
    if (one.mode) parts.push(make("h3", {}, `If ${behaves(one.mode)}`), conditions(one, set));
    parts.push(...one.answers.filter((a) => !everywhere(a)).map((a) => answer(a, set, !one.mode)));
    const defined = (one.where ?? []).filter((w) => !one.answers.some((a) => a.name === w.name));
    if (defined.length) parts.push(make("h3", {}, "where"), ...defined.map((w) => definition(w, set)));
    parts.push(known(one, set));
  }
  if (common.length) parts.push(make("h3", {}, "In every case"), ...common.map((a) => answer(a, set, false)));
  if (found.cases) parts.unshift(make("section", { id: "numbers" }));
  $("answers").replaceChildren(...parts.filter(Boolean));
  renumber();
}

// Formulas and symbols as markup, by their texts.
export async function typeset(formulas, symbols) {
  const most = 250;
  const out = { formulas: new Map(), symbols: new Map() };
  const lists = [[...new Set(formulas.filter(Boolean))], [...new Set(symbols)]];
  for (let i = 0; i < Math.max(...lists.map((l) => l.length)); i += most) {
    const [some, names] = lists.map((l) => l.slice(i, i + most));
    const found = await ask("describe", { ...scene(), formulas: some, symbols: names }).catch(() => null);
    some.forEach((f, k) => out.formulas.set(f, found?.readings[k]?.mathml));
    names.forEach((s, k) => out.symbols.set(s, found?.symbols[k]));
  }
  return out;
}

const written = (set, formula) => {
  const math = set.formulas.get(formula);
  return math ? markup(math) : formula;
};

function answer(a, set, numbered) {
  const symbol = set.symbols.get(a.symbol ?? a.name);
  const line = make("div", { class: "formula", tabindex: "0", "aria-label": `${a.name} = ${a.formula ?? "open"}` });
  if (a.range?.length) line.append(...a.range.flatMap((r, i) => [i ? ", " : "", written(set, r)]));
  else if (a.formula) line.append(...(/[=<>≤≥]/.test(a.formula) ? [] : [symbol ? markup(symbol) : a.name, " = "]), written(set, a.formula));
  else if (a.undetermined) line.append(`not determined by the laws: ${a.undetermined.join(", ")}`);
  else if (a.matrix) line.append("a matrix; it stands in the solution");
  const number = make("div", { class: "number" });
  // A formula that is a number needs none beside it.
  if (numbered && !/^-?\d+$/.test(a.formula ?? "")) places.set(a.name, number);
  const doubts = a.checks.filter((c) => c.holds !== true);
  // What is true of one case alone says so beside its formula: the sliders may lead to another, of which the number is.
  const given = restsOn(a);
  const where = given.length ? make("p", { class: "note" }, "given that ", ...given.flatMap((r, i) => [i ? ", and that " : "", ...prose(set, r)])) : null;
  return make("article", { class: "answer" }, make("div", { class: "meaning" }, ...prose(set, a.words)), line,
    where, ...(a.text ?? []).map((t) => make("p", {}, ...prose(set, t))), number, ...doubts.map((c) => check(c, set)));
}

function definition(w, set) {
  const line = make("div", { class: "formula", tabindex: "0" }, written(set, `${w.name} = ${w.formula}`));
  return make("div", {}, line, w.meaning ? make("div", { class: "meaning" }, w.meaning) : null);
}

function conditions(one, set) {
  const each = (one.conditions ?? []).map((c) => written(set, `${c.left.formula} ${c.relation} ${c.right.formula}`));
  return each.length ? make("ul", {}, ...each.map((c) => make("li", {}, make("div", { class: "formula", tabindex: "0" }, c)))) : null;
}

function check(c, set) {
  const [mark, kind, word] = { true: ["✓", "held", "holds"], false: ["✗", "failed", "fails"] }[c.holds] ?? ["?", "unsure", "open"];
  return make("div", { class: `checks ${kind}` }, make("span", { "aria-label": word }, mark), ` `, ...prose(set, c.words));
}

// How everything is known, folded away.
function known(one, set) {
  const checks = [...(one.checks ?? []), ...one.answers.flatMap((a) => a.checks)];
  const seen = new Set();
  const each = checks.filter((c) => !seen.has(c.words) && seen.add(c.words));
  const rests = [...new Set(one.answers.flatMap((a) => a.assumptions ?? []))];
  const refuted = each.some((c) => c.holds === false) || one.verified === false;
  const title = refuted ? "✗ A check failed" : one.verified ? "How this is known" : "Not everything is proved";
  return make("details", refuted ? { open: true } : {}, make("summary", {}, title), ...each.map((c) => check(c, set)),
    rests.length ? make("p", { class: "note" }, "Given that ", ...rests.flatMap((r, i) => [i ? ", " : "", ...prose(set, r)]), ".") : null);
}

const number = (n) => (n.value === null ? (n.reason ?? "open") : `≈ ${digits(n.value).replaceAll("-", "−")} ${n.unit === "1" ? "" : n.unit}`);

const letter = (name) => (letters.get(name) ? markup(letters.get(name)) : name);

// What a contact does, or where its impulse lies.
export const behaves = (mode) => mode.endsWith("the cone") ? `the impulse lies ${mode}`
  : mode === "given ratio" ? "the impulse has the given ratio" : `the contact ${mode}`;

// The numbers at the values of the sliders, from the geometry alone.
export async function renumber() {
  if (!bench.about || (!places.size && !$("numbers"))) return;
  try {
    const found = await solved((signal) => ask("solve", { ...scene(), set: set() }, signal));
    if (!found) return;
    const told = new Map(found.answers.map((n) => [n.name, n]));
    for (const [name, place] of places) {
      const n = told.get(name);
      if (n) place.textContent = number(n);
    }
    $("numbers")?.replaceChildren(make("h3", { id: "mode" }, "At these values"),
      ...found.answers.map((n) => make("div", { class: "number" }, letter(n.name), " ", number(n))));
    if ($("numbers")) return modeAtValues();
    // What the numbers of the motion leave open may have one from its closed form.
    const missing = [...places.keys()].filter((name) => (told.get(name)?.value ?? null) === null);
    if (missing.length || conditional) revalue(missing);
  } catch (error) {
    for (const place of places.values()) place.textContent = "";
    $("numbers")?.replaceChildren(make("p", { class: "wrong" }, told(error)));
  }
}

// What the contact with friction does at these values by the scene's law; the numbers follow it, whatever a scene supposes.
const modeAtValues = quietly(async () => {
  const [found, compared] = await Promise.all([last, valued((signal) => ask("compare", { ...scene(), set: set() }, signal))]).catch(() => []);
  const law = compared?.laws.find((l) => l.law === found?.hypothesis);
  if (law && $("mode")) $("mode").textContent = `At these values ${behaves(law.mode)}`;
}, 250);

// Answers about answers, such as a threshold, have their numbers from their closed forms, once the sliders rest. Where these
// lead to another case than the one that is shown, its formulas take the place of those.
const revalue = quietly(async (missing) => {
  const about = bench.about;
  const found = await valued((signal) => ask("derive", { ...scene(), set: set() }, signal)).catch(() => null);
  if (!found || bench.about !== about) return;
  if (conditional && formulasOf(found) !== shown) return draw(found);
  for (const a of found.answers ?? []) {
    const place = places.get(a.name);
    if (place && missing.includes(a.name) && (a.value ?? null) !== null) place.textContent = number(a);
  }
}, 250);
