// The motion of a scene in time, as the numbers follow it: up to the first impact, through the stages, and on from the last
// impact; beside it the motion that somebody's answer would give. Played, paused, or moved by hand.

import { $, ask, digits, latest, told } from "/ask.js";
import { bench, scene, set } from "/main.js";
import { measured } from "/values.js";

// The longest a film takes, and how long an impact is shown, in seconds.
const LONGEST = 8;
const IMPACT = 0.6;
const SPACE = "http://www.w3.org/2000/svg";

const filmed = latest();
let film = null;
let running = null;
// The question and somebody's answer to it that is played beside the right motion.
let claim = null;

// Whether the next film begins at once.
let atOnce = false;

// From the next film on a wrong answer is played beside the right motion; `null` leaves the right motion alone.
export function beside(other) {
  const had = claim !== null;
  claim = other;
  atOnce = Boolean(other);
  if (had && !other) showFilm();
}

// Makes the film at the values of the sliders; where nothing moves there is none.
export async function showFilm() {
  pause();
  film = null;
  try {
    const request = { ...scene(), set: set() };
    const found = await filmed((signal) => Promise.all([
      ask("describe", { ...request, film: true, ...claim }, signal),
      bench.about.stages.length ? ask("solve", request, signal) : { stages: [] },
    ]));
    if (!found) return;
    measured(found[0].parameters);
    film = made(...found);
    $("film").hidden = !film.parts.length && !film.note;
    $("film-note").textContent = film.note;
    $("film-time").max = film.length;
    $("film-time").step = film.length / 400 || 0.01;
    $("film-play").disabled = $("film-time").disabled = !film.length;
    $("film-picture").replaceChildren();
    at(0);
    if (atOnce && film.length) play();
    atOnce = false;
  } catch (error) {
    $("film").hidden = false;
    $("film-note").textContent = told(error);
    $("film-picture").replaceChildren();
  }
}

// Parts of the film: where every body is from one time to another.
// What is said of an answer that leads to no other motion.
const none = (claim) => `${claim.quantity} is not a velocity or a spin just after the last impact, so your answer has no motion of its own; the right one is shown.`;

function made(about, solved) {
  const { before, after, claimed, bodies: names } = about.film;
  const free = (name, stage, samples, other) => ({
    name, stage, poses: new Map(), courses: [{ moving: names, samples }], other: other && [{ moving: names, samples: other }], time: samples.at(-1).time,
  });
  const parts = [];
  let note = "";
  if (before.length) parts.push(free("before the impact", 0, before));
  for (const [k, stage] of solved.stages.entries()) {
    if (stage.lost) { note = `${stage.name}: ${stage.reason}`; break; }
    const poses = new Map(stage.bodies.map((b) => [b.name, pose(b.before)]));
    const moves = (stage.samples?.length ?? 0) > 1;
    if (stage.kind !== "impact" && !moves) { note = `${stage.name}: its course in time is not known`; break; }
    const course = { moving: stage.moving ?? [], samples: stage.samples ?? [] };
    // What moves at the same time is one part.
    if (stage.during) {
      parts.at(-1).courses.push(course);
      parts.at(-1).name += ` and ${stage.name}`;
    } else parts.push({ name: stage.name, stage: k, poses, courses: [course], time: moves ? stage.samples.at(-1).time : 0 });
    const passing = (stage.pass_through_each_other ?? []).map((pair) => `${pair.join(" and ")} pass through each other`);
    const [broken] = [...(stage.not_possible ?? []), ...passing];
    if (broken) { note = `${stage.name}: not possible at these values, ${broken}`; break; }
  }
  if (!note && after.length) {
    const end = Math.max(0, solved.stages.length - 1);
    if (!solved.stages.length) parts.push({ ...free("impact", end, [after[0]]), time: 0 });
    parts.push(free("after the impact", end, after, claimed.length ? claimed : null));
    if (claim) note = claimed.length
      ? `After the impact: full lines, the right motion; broken lines, that of ${claim.quantity} = ${claim.answer}.`
      : none(claim);
  } else if (!note && claim) note = none(claim);
  const real = parts.reduce((sum, part) => sum + part.time, 0);
  const slow = real ? Math.max(1, LONGEST / 2 / real) : 1;
  const speed = real > LONGEST ? real / LONGEST : 1 / slow;
  let length = 0;
  for (const part of parts) {
    part.start = length;
    part.speed = speed;
    length = part.end = length + (part.time ? part.time / speed : IMPACT);
  }
  const [first] = solved.stages;
  const from = (name) => {
    const k = names.indexOf(name);
    return first ? pose(first.bodies?.find((b) => b.name === name)?.before) : (before.at(-1) ?? after[0])?.poses[k];
  };
  const bodies = about.outlines.map((o) => ({ ...o, from: from(o.body) }));
  return { bodies, parts, length, note, standing: about.film.standing, strings: about.film.strings };
}

const pose = (b) => (b && [b.x, b.y, b.angle].every(Number.isFinite) ? [b.x, b.y, b.angle] : null);

// Where a body is within a part: between two samples by the cubic that keeps the slopes of the course.
function place(part, body, time, courses = part.courses) {
  const course = courses.find(({ moving }) => moving.includes(body));
  if (!course) return part.poses.get(body);
  const [k, s] = [course.moving.indexOf(body), course.samples];
  if (s.length < 2) return s[0]?.poses[k];
  let i = s.findIndex((one) => one.time >= time);
  if (i < 0) i = s.length - 1;
  i = Math.max(1, i);
  const [a, b] = [s[i - 1], s[i]];
  const h = b.time - a.time;
  const u = h ? Math.min(1, Math.max(0, (time - a.time) / h)) : 1;
  const slope = (j, c) => {
    const [p, q] = [s[Math.max(0, j - 1)], s[Math.min(s.length - 1, j + 1)]];
    return (q.poses[k][c] - p.poses[k][c]) / (q.time - p.time);
  };
  return a.poses[k].map((from, c) => {
    const to = b.poses[k][c];
    const [m, n] = [slope(i - 1, c) * h, slope(i, c) * h];
    return from + u * m + u * u * (3 * (to - from) - 2 * m - n) + u * u * u * (m + n - 2 * (to - from));
  });
}

// The lines of a body where it is.
function moved(body, to) {
  if (!body.from || !to) return body.lines;
  const [x, y, angle] = body.from;
  const [c, s] = [Math.cos(to[2] - angle), Math.sin(to[2] - angle)];
  return body.lines.map((line) => line.map(([px, py]) => [
    to[0] + c * (px - x) - s * (py - y), to[1] + s * (px - x) + c * (py - y)]));
}

// Where a string ends at a time: at rest, or carried along by a body.
function end({ body, at: [x, y], turns }, part, time) {
  if (body === null) return [x, y];
  const [px, py, angle] = place(part, body, time) ?? film.bodies.find((b) => b.body === body).from;
  const [c, s] = turns ? [Math.cos(angle), Math.sin(angle)] : [1, 0];
  return [px + c * x - s * y, py + s * x + c * y];
}

// The strings that are taut in a part of the film.
const strings = (part, time) => film.strings.filter((s) => s.stage === part.stage).map((s) => s.ends.map((e) => end(e, part, time)));

// Shows a moment of the film.
function at(moment) {
  const part = film.parts.find((p) => moment <= p.end) ?? film.parts.at(-1);
  if (!part) return;
  const time = Math.min(part.time, Math.max(0, (moment - part.start) * part.speed));
  film.box ??= box();
  const svg = document.createElementNS(SPACE, "svg");
  svg.setAttribute("viewBox", film.box.join(" "));
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", `${part.name}, ${digits(time)} s`);
  const thick = Math.max(film.box[2] / 150, film.box[3] / 80);
  const taut = [[strings(part, time), "string"]];
  const begin = film.bodies.map((body) => [body.lines, "begin"]);
  const now = film.bodies.map((body) => [moved(body, place(part, body.body, time)), "now"]);
  const other = part.other ? film.bodies.map((body) => [moved(body, place(part, body.body, time, part.other)), "claimed"]) : [];
  for (const [lines, when] of [...taut, ...begin, ...now, ...other, [film.standing, "standing"]]) {
    for (const line of lines) {
      const isOpen = when === "standing" || when === "string";
      const kind = isOpen ? "polyline" : line.length === 1 ? "circle" : "polygon";
      const shape = document.createElementNS(SPACE, kind);
      if (line.length === 1) {
        for (const [name, value] of [["cx", line[0][0]], ["cy", -line[0][1]], ["r", 3 * thick]]) shape.setAttribute(name, value);
      } else shape.setAttribute("points", line.map(([x, y]) => `${x},${-y}`).join(" "));
      shape.setAttribute("class", when);
      shape.setAttribute("stroke-width", thick * (isOpen ? 0.7 : line.length === 2 ? 2.5 : 1));
      svg.append(shape);
    }
  }
  $("film-picture").replaceChildren(svg);
  $("film-time").value = moment;
  $("film-time").setAttribute("aria-valuetext", `${part.name}, ${digits(time)} s`);
  $("film-where").textContent = part.time ? `${part.name}, ${digits(Number(time.toPrecision(3)))} s` : part.name;
}

// Room for all that is shown in the film.
function box() {
  const courses = film.parts.flatMap((part) => [part.courses, part.other].filter(Boolean).map((found) => [part, found]));
  const moving = courses.flatMap(([part, found]) => [0, 0.25, 0.5, 0.75, 1].flatMap((u) =>
    film.bodies.flatMap((body) => moved(body, place(part, body.body, u * part.time, found)).flat())));
  const all = [...film.standing.flat(), ...moving];
  const [xs, ys] = [all.map((p) => p[0]), all.map((p) => -p[1])];
  const [left, top] = [Math.min(...xs), Math.min(...ys)];
  const [wide, high] = [Math.max(...xs) - left, Math.max(...ys) - top];
  const room = 0.08 * Math.max(wide, high, 1e-6);
  return [left - room, top - room, wide + 2 * room, high + 2 * room];
}

function pause() {
  cancelAnimationFrame(running);
  running = null;
  $("film-play").textContent = "Play";
}

function play() {
  $("film-play").textContent = "Pause";
  const from = Number($("film-time").value);
  const begin = performance.now() - 1000 * (from < film.length - 1e-6 ? from : 0);
  const frame = (now) => {
    const moment = (now - begin) / 1000;
    at(Math.min(moment, film.length));
    running = moment < film.length ? requestAnimationFrame(frame) : null;
    if (running === null) pause();
  };
  running = requestAnimationFrame(frame);
}

$("film-play").addEventListener("click", () => (running === null ? play() : pause()));
$("film-time").addEventListener("input", () => {
  pause();
  at(Number($("film-time").value));
});
addEventListener("hashchange", () => {
  pause();
  claim = null;
});
