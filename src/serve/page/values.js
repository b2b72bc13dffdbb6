// A slider and a number box for every parameter, within its domain. A box takes what a scene takes: 0.5, 1/3, pi/6.

import { $, digits, make, markup } from "/ask.js";
import { bench, valuesChanged } from "/main.js";

let rows = {};
const measures = {};

// What the server reads from the boxes, such as 1/3 or acos(3/5): the sliders and the degrees follow.
export function measured(parameters) {
  for (const p of parameters) if (rows[p.name]) measures[p.name]?.(p.value);
}

export function showValues() {
  rows = {};
  const { parameters, directions } = bench.about;
  const inPair = new Map(directions.flatMap(([x, y]) => [[x, [x, y]], [y, null]]));
  const list = parameters.map((p) => {
    if (!inPair.has(p.name)) return row(p);
    const pair = inPair.get(p.name);
    return pair && direction(...pair.map((name) => parameters.find((q) => q.name === name)));
  });
  $("values").replaceChildren(...list.filter(Boolean));
  $("reset").hidden = !parameters.length;
  if (!parameters.length) $("values").append(make("p", { class: "note" }, "Every value stands in the scene."));
  refuse(null);
}

$("reset").addEventListener("click", () => {
  bench.values = {};
  showValues();
  valuesChanged();
});

// Takes values in SI units from elsewhere, such as a counterexample; acos(3/5) is in radians whatever the parameter's unit.
export function putValues(values) {
  for (const [name, number] of Object.entries(values)) {
    const parameter = bench.about.parameters.find((p) => p.name === name);
    if (!parameter) continue;
    const value = parameter.si && !number.includes("(") ? `${number} ${parameter.si}` : number;
    bench.values[name] = value;
    rows[name]?.(value);
  }
  valuesChanged();
}

// Why the values cannot be taken, beside the parameter that it is about.
export function refuse(message) {
  $("values-note").textContent = message ?? "";
  $("values-note").classList.toggle("wrong", Boolean(message));
}

function row(p) {
  const id = `value-${p.name}`;
  const slider = make("input", { type: "range", min: p.min, max: p.max, step: p.step, id: `${id}-slider` });
  slider.setAttribute("aria-label", `${p.name}, slider`);
  const box = make("input", { type: "text", id, inputmode: "text", autocomplete: "off", spellcheck: "false", "aria-describedby": `${id}-meaning` });
  const unit = make("span", { class: "unit" });
  // An angle in radians is told in degrees as well.
  const measure = (value = box.value.trim() ? Number(box.value) : NaN) => {
    slider.setAttribute("aria-valuetext", p.unit === "1" ? box.value : `${box.value} ${p.unit}`);
    const words = p.unit === "1" ? "" : p.unit.replaceAll("^2", "²").replaceAll("^3", "³");
    const inDegrees = p.unit === "rad" && Number.isFinite(value);
    unit.textContent = inDegrees ? `rad ≈ ${Math.round((value * 1800) / Math.PI) / 10}°` : words;
  };
  measures[p.name] = (value) => {
    if (Number.isFinite(Number(box.value))) return;
    slider.value = value;
    measure(value);
  };
  const show = (value) => {
    box.value = value;
    if (Number.isFinite(Number(value)) && value !== "") slider.value = Number(value);
    measure();
  };
  rows[p.name] = show;
  show(bench.values[p.name] ?? digits(p.value));
  slider.addEventListener("input", () => {
    // The step of a slider leaves digits of no meaning behind.
    box.value = bench.values[p.name] = String(Number(Number(slider.value).toPrecision(10)));
    measure();
    valuesChanged();
  });
  box.addEventListener("input", () => {
    const text = box.value.trim();
    if (text) bench.values[p.name] = text;
    else delete bench.values[p.name];
    if (text && Number.isFinite(Number(text))) slider.value = Number(text);
    measure();
    valuesChanged();
  });
  const label = make("label", { for: id, class: "label" }, markup(p.mathml));
  return make("div", { class: "value" }, label, slider, box, unit,
    make("span", { class: "meaning", id: `${id}-meaning` }, markup(p.about_html)));
}

// Two components of a unit vector: one slider, in degrees. Fractions on the unit circle keep the length exactly 1.
function direction(x, y) {
  const degrees = Math.round((Math.atan2(y.value, x.value) * 180) / Math.PI);
  const box = make("output", {}, `${degrees}°`);
  const slider = make("input", { type: "range", min: -179, max: 180, step: 1, value: degrees, id: `value-${x.name}` });
  const put = (angle) => {
    if (angle === 180) return Object.assign(bench.values, { [x.name]: "-1", [y.name]: "0" });
    const t = Math.round(1000 * Math.tan((angle * Math.PI) / 360));
    const size = 1000000 + t * t;
    Object.assign(bench.values, { [x.name]: `${1000000 - t * t}/${size}`, [y.name]: `${2000 * t}/${size}` });
  };
  if (bench.values[x.name] === undefined && !x.is_given) put(degrees);
  slider.addEventListener("input", () => {
    put(Number(slider.value));
    box.textContent = `${slider.value}°`;
    valuesChanged();
  });
  const label = make("label", { for: slider.id, class: "label" }, markup(x.mathml), ", ", markup(y.mathml));
  return make("div", { class: "value" }, label, slider, box, make("span"),
    make("span", { class: "meaning" }, "direction, as an angle from the x axis"));
}
