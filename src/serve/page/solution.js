// The worked solution, hint first, then section by section. It stands in a tree of its own, with its own style.

import { $, ask, latest, make, told } from "/ask.js";
import { bench, scene, set } from "/main.js";
import { cases, derived } from "/answers.js";

const FRAME = `
:host { font: 17px/1.55 Georgia, 'Times New Roman', serif; }
details { border-bottom: 1px solid var(--line); padding: .35rem 0; }
summary { cursor: pointer; font-weight: 600; padding: .2rem 0; }
summary:focus-visible { outline: 2px solid var(--accent); }
.source, figcaption { color: var(--faint) !important; }`;

const asked = latest();

export async function showSolution() {
  const panel = $("solution");
  panel.replaceChildren(make("p", { class: "note", role: "status" }, "Writing the solution …"));
  try {
    const found = await derived().catch(() => null);
    const write = (more) => asked((signal) => ask("solution", { ...scene(), ...more, format: "html" }, signal));
    // Where friction leaves several cases, the values of the sliders pick the one that is worked out.
    let note = null;
    const page = await write({}).catch((error) => {
      if (!found?.cases) throw error;
      note = make("p", { class: "note" }, "Worked out for the case that the values of the sliders pick.");
      return write({ set: exact(set()) });
    });
    if (page === undefined) return;
    const written = new DOMParser().parseFromString(page, "text/html");
    const steps = [...hints(found), ...sections(written)];
    const next = make("button", { type: "button" }, "Next step");
    const all = make("button", { type: "button" }, "Show everything");
    const closed = () => steps.filter((s) => !s.open);
    const look = () => { next.disabled = all.disabled = !closed().length; };
    next.addEventListener("click", () => {
      const [first] = closed();
      first.open = true;
      first.scrollIntoView({ block: "nearest" });
      look();
    });
    all.addEventListener("click", () => {
      closed().forEach((s) => { s.open = true; });
      look();
    });
    const host = make("div");
    const tree = host.attachShadow({ mode: "open" });
    tree.append(style(written), make("style", {}, FRAME), ...steps);
    steps.forEach((s) => s.addEventListener("toggle", look));
    panel.replaceChildren(...[note, make("div", { class: "bar" }, next, all), host].filter(Boolean));
  } catch (error) {
    panel.replaceChildren(make("p", { class: "wrong" }, told(error)));
  }
}

// The values with angles whose cosine and sine are fractions, to a millionth: a case is picked in exact arithmetic.
function exact(values) {
  const most = 1000000;
  const out = { ...values };
  for (const { name, unit } of bench.about.parameters) {
    const angle = Number(out[name]);
    if (unit !== "rad" || !(Math.abs(angle) < Math.PI) || angle === 0) continue;
    const t = Math.round(most * Math.tan(Math.abs(angle) / 2));
    const cosine = `${BigInt(most) ** 2n - BigInt(t) ** 2n}/${BigInt(most) ** 2n + BigInt(t) ** 2n}`;
    out[name] = `${angle < 0 ? "-" : ""}acos(${cosine})`;
  }
  return out;
}

// The solution's own style, without the font: the page has it.
function style(written) {
  const text = [...written.querySelectorAll("head style")].map((s) => s.textContent).join("\n");
  return make("style", {}, text.replace(/@font-face\s*\{[^}]*\}/, ""));
}

// What to think about first: how much it takes, then which laws.
function hints(found) {
  if (!found) return [];
  const out = [];
  const [one] = cases(found);
  const laws = (one?.blocks ?? []).flatMap((b) => b.equations.map((e) => e.law));
  const stages = found.stages ?? [];
  if (laws.length) {
    const count = laws.length === 1 ? "One equation is enough" : `${laws.length} equations are enough`;
    out.push(fold("Hint: how much it takes", make("p", {}, `${count}; the full system has ${one.equations_full} in ${one.unknowns_full} unknowns.`)));
    out.push(fold("Hint: which laws", make("ul", {}, ...[...new Set(laws)].map((law) => make("li", {}, law)))));
  }
  if (stages.length) {
    const kept = (s) => s.conserved.filter((k) => k.conserved).map((k) => k.what).join(", ");
    out.push(fold("Hint: the stages", make("ul", {}, ...stages.map((s) => make("li", {}, `${s.name}: ${s.kind}${kept(s) ? `; what stays: ${kept(s)}` : ""}`)))));
  }
  return out;
}

const fold = (title, ...inner) => make("details", {}, make("summary", {}, title), ...inner);

// Every section of the page folds under its heading; what stands before the first heading is the problem itself.
function sections(written) {
  const out = [];
  for (const section of written.querySelectorAll("main > section")) {
    const heading = section.querySelector("h2, h3, h4");
    const part = make("details", {}, make("summary", {}, ...(heading ? [...heading.childNodes] : ["The problem"])));
    heading?.remove();
    part.append(...section.childNodes);
    if (!heading) part.open = true;
    out.push(document.adoptNode(part));
  }
  return out;
}
