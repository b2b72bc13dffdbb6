// The list of scenes, by folder, with a search.

import { $, get, make } from "/ask.js";

let scenes = null;

export async function showList() {
  if (!scenes) {
    scenes = (await get("/v1/scenes")).scenes;
    $("search").addEventListener("input", () => draw($("search").value));
  }
  draw($("search").value);
}

function draw(wanted) {
  const words = wanted.toLowerCase().split(/\s+/).filter(Boolean);
  const fits = (scene) => {
    const text = `${scene.name} ${scene.title ?? ""} ${scene.source ?? ""}`.toLowerCase();
    return words.every((word) => text.includes(word));
  };
  const folders = new Map();
  for (const scene of scenes.filter(fits)) {
    const folder = scene.name.includes("/") ? scene.name.slice(0, scene.name.lastIndexOf("/")) : "";
    folders.set(folder, [...(folders.get(folder) ?? []), scene]);
  }
  const parts = [...folders].flatMap(([folder, held]) => [
    folder ? make("h2", {}, folder) : null,
    make("ul", {}, ...held.map(item)),
  ]);
  $("scenes").replaceChildren(...parts.filter(Boolean));
  if (!folders.size) $("scenes").append(make("p", {}, "No scene has these words."));
}

function item(scene) {
  const link = make("a", { href: `#scene=${encodeURIComponent(scene.name)}` }, scene.title || scene.name);
  const more = scene.fault ? `cannot be read: ${scene.fault}` : scene.source || scene.name;
  return make("li", {}, link, make("span", { class: scene.fault ? "wrong" : "meaning" }, more));
}
