// Laws of contact side by side at the values of the sliders: of friction with the plane of impulses, and what they make of
// several smooth contacts at once.

import { $, ask, digits, latest, make, markup, told } from "/ask.js";
import { bench, scene, set } from "/main.js";
import { behaves } from "/answers.js";

const compared = latest();

// The impact whose laws are compared: the chosen stage, or the first that has laws; `undefined` where there is none.
export function lawful() {
  const { stages, has_laws } = bench.about;
  const fit = stages.filter((s) => s.has_laws).map((s) => s.name);
  if (!stages.length) return has_laws ? "" : undefined;
  return fit.includes(bench.stage) ? bench.stage : fit[0];
}

export async function showLaws() {
  const panel = $("laws");
  const stage = lawful();
  try {
    const found = await compared((signal) => ask("compare", { ...scene(), ...(stage ? { stage } : {}), set: set() }, signal));
    if (!found) return;
    const where = stage ? `In ${stage}, at the values of the sliders.` : "At the values of the sliders.";
    panel.replaceChildren(make("p", { class: "note" }, where), ...(found.laws ? friction(found) : several(found)));
  } catch (error) {
    panel.replaceChildren(make("p", { class: "wrong" }, told(error)));
  }
}

function friction(found) {
  const pair = (both) => make("span", { class: "pair" }, `(${both.map(few).join(", ")})`);
  const rows = found.laws.map((l) => (l.reason ? [l.law, `no answer: ${l.reason}`, "", "", ""]
    : [l.law, behaves(l.mode), pair(l.impulse), pair(l.velocity_after), l.energy]));
  return [
    found.plane && make("figure", { class: "plane" }, markup(found.plane), make("figcaption", { class: "note" },
      `The impulse at ${found.contact}: within the friction cone; the contact sticks on one line, and compression ends on the other. The path runs from 0, and each law ends at its point.`)),
    table(["law", "what happens", "impulse along t, n (N s)", "velocity after along t, n (m/s)", "energy"], rows),
  ].filter(Boolean);
}

function several(found) {
  const motion = (b) => `${b.body}: (${b.velocity.map(few).join(", ")}) m/s${b.spin ? `, ${few(b.spin)} rad/s` : ""}`;
  const rows = found.candidates.map((c) => [
    lines(c.laws), lines(Object.entries(c.impulses).map(([at, p]) => `${at}: ${few(p)}`), "pair"), lines(c.bodies.map(motion), "pair"), c.energy]);
  return [make("p", { class: "advice" }, found.verdict), table(["laws", "impulses (N s)", "motion after", "energy"], rows)];
}

// Digits enough to compare by.
const few = (value) => digits(Number(value.toPrecision(4))).replace("-", "−");

const lines = (all, kind) => make("span", { class: kind }, ...all.flatMap((line, i) => (i ? [make("br"), line] : [line])));

function table(head, rows) {
  return make("div", { class: "wide", tabindex: "0" }, make("table", { class: "lines" }, make("tr", {}, ...head.map((h) => make("th", { scope: "col" }, h))),
    ...rows.map((row) => make("tr", {}, ...row.map((cell) => make("td", {}, cell))))));
}
