// The little of DOM building that the page needs.

export type Child = Node | string | null | undefined;

/** An element with attributes (`on…` are listeners, `class` a class list) and children. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, unknown> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value as EventListener);
    else if (value === true) element.setAttribute(name, "");
    else element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child): child is Node | string => child !== null && child !== undefined));
  return element;
}

/** A button with an icon or a text, and a title that names its key. */
export function button(label: Child, title: string, onclick: (event: MouseEvent) => void, more: Record<string, unknown> = {}) {
  return el("button", { type: "button", title, "aria-label": title, onclick, ...more }, label);
}

const SVG = "http://www.w3.org/2000/svg";

const PATHS: Record<string, string> = {
  pause: "M7 5v14M17 5v14",
  play: "M7 4l13 8-13 8z",
  step: "M5 5l9 7-9 7zM19 5v14",
  back: "M17 4L4 12l13 8z",
  reset: "M4 4v6h6M4.6 10a8 8 0 1 1-.3 5",
  record: "M12 12m-6 0a6 6 0 1 0 12 0a6 6 0 1 0-12 0",
  fit: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  sun: "M12 12m-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0M12 2v2M12 20v2M2 12h2M20 12h2M5 5l1.4 1.4M17.6 17.6L19 19M5 19l1.4-1.4M17.6 6.4L19 5",
  help: "M9 9a3 3 0 1 1 4.5 2.6c-1 .6-1.5 1.2-1.5 2.4M12 18v.01",
  pin: "M9 4h6l-1 6 3 3H7l3-3zM12 13v7",
  warn: "M12 3l10 18H2zM12 10v5M12 18v.01",
  close: "M6 6l12 12M18 6L6 18",
  lock: "M6 11h12v9H6zM8.5 11V8a3.5 3.5 0 0 1 7 0v3",
};

/** A line icon. */
export function icon(name: keyof typeof PATHS | string): SVGSVGElement {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  svg.classList.add("icon");
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", PATHS[name] ?? "");
  svg.append(path);
  return svg;
}

/** A number as people read it: four digits that say something. */
export function figure(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e7) return String(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(2);
  return value.toFixed(Math.max(0, Math.min(4, digits - 1 - Math.floor(Math.log10(size)))));
}

/** Seconds as a clock shows them. */
export function clock(seconds: number): string {
  const minutes = Math.floor(seconds / 60);
  return `${minutes}:${(seconds - minutes * 60).toFixed(2).padStart(5, "0")}`;
}

/** Says something for a few seconds, to ears as well. */
export function toast(text: string, hint = "", grave = true): void {
  let box = document.querySelector<HTMLElement>("#toasts");
  if (!box) {
    box = el("div", { id: "toasts", role: "status", "aria-live": "polite" });
    document.body.append(box);
  }
  const note = el("div", { class: grave ? "toast grave" : "toast" }, el("b", {}, text), hint ? el("span", {}, hint) : null);
  box.append(note);
  while (box.children.length > 4) box.firstElementChild?.remove();
  setTimeout(() => note.remove(), grave ? 8000 : 4000);
}
