// Questions to the server, and small helpers to build what the page shows. Texts go in as text, never as markup; markup
// comes from the server alone: pictures, formulas and solutions that carom has written.

// An error with what the server told of it.
export class Refused extends Error {
  constructor(error) {
    super(error.message);
    this.hint = error.hint;
    this.faults = error.faults;
  }
}

// Asks for a command; gives JSON, or text where the answer is none.
export async function ask(command, request, signal) {
  const response = await fetch(`/v1/${command}`, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(request),
    signal,
  });
  return read(response);
}

export async function get(address) {
  return read(await fetch(address));
}

async function read(response) {
  const isJson = (response.headers.get("Content-Type") ?? "").startsWith("application/json");
  const body = isJson ? await response.json() : await response.text();
  if (!response.ok) throw new Refused(body.error ?? { message: response.statusText });
  return body;
}

// Asks one thing at a time: who asks anew gives up what was asked before.
export function latest() {
  let last = null;
  return async (work) => {
    last?.abort();
    const own = (last = new AbortController());
    try {
      const found = await work(own.signal);
      return own.signal.aborted ? undefined : found;
    } catch (error) {
      if (own.signal.aborted) return undefined;
      throw error;
    }
  };
}

// Calls once what was to be called often, when it has been quiet for a while.
export function quietly(work, milliseconds) {
  let waiting;
  return (...given) => {
    clearTimeout(waiting);
    waiting = setTimeout(() => work(...given), milliseconds);
  };
}

export const $ = (id) => document.getElementById(id);

// An element with attributes, handlers and children.
export function make(tag, given = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(given)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child != null));
  return element;
}

// What carom has written as markup.
export function markup(text) {
  const held = document.createElement("template");
  held.innerHTML = text;
  return held.content;
}

export function say(error) {
  const trouble = $("trouble");
  trouble.hidden = !error;
  trouble.textContent = error ? told(error) : "";
}

export function told(error) {
  if (error instanceof TypeError) return "The server does not answer.";
  return error.hint ? `${error.message}. ${error.hint[0].toUpperCase()}${error.hint.slice(1)}.` : error.message;
}

// A number as people read it.
export function digits(value) {
  if (value == null) return "";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e6) return value.toExponential(4).replace(/\.?0+e/, "e").replace("e+", "e");
  return String(Number(value.toPrecision(6)));
}
