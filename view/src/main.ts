// The page: puts its pieces together and keeps them up to date.

import "./style.css";
import { ask, type Plant, Refused, type State, type Statistics, tell } from "./api";
import { button, el, icon, toast } from "./dom";
import { DevicePanel } from "./panel/device";
import { Events } from "./panel/events";
import { GapPanel } from "./panel/gap";
import { Signals } from "./panel/signals";
import { StatisticsPanel } from "./panel/statistics";
import { readMeshes } from "./scene/meshes";
import { World } from "./scene/world";
import { Store } from "./store";
import { type Frame, follow } from "./stream";
import { Timeline } from "./timeline";
import { Transport } from "./transport";

/** How often the texts follow the values, and the state is asked for, ms. */
const REFRESH = 100;
const ASK = 400;

const dark = matchMedia("(prefers-color-scheme: dark)");
const themed = () => localStorage.getItem("theme") ?? (dark.matches ? "dark" : "light");
document.documentElement.dataset["theme"] = themed();

async function begin(): Promise<void> {
  // The stream begins while the meshes are on their way; what it brings before there is a picture to put it in waits.
  const early: Frame[] = [];
  let take = (frame: Frame): void => void early.push(frame);
  let link = (_connected: boolean): void => {};
  let isConnected = false;
  follow((frame) => take(frame), (connected) => link((isConnected = connected)));
  const [plant, meshes] = await Promise.all([ask<Plant>("GET", "/api/plant"), fetch("/api/meshes").then((answer) => answer.arrayBuffer())]);
  document.title = `${plant.trace ?? plant.model} – kinetwin`;
  const store = new Store(plant);
  const world = new World(plant, readMeshes(meshes));
  const timeline = new Timeline(store);
  const transport = new Transport(store);
  const signals = new Signals(store, () => timeline.pins());
  const device = new DevicePanel(store, () => timeline.pins());
  const statistics = new StatisticsPanel(store);
  const events = new Events();
  const gap = plant.has_report ? new GapPanel() : null;

  // The panels on the right.
  const tabs = el("div", { class: "tabs", role: "tablist", "aria-label": "Panels" });
  const panels = new Map<string, HTMLElement>([["Device", device.element], ["Signals", signals.element], ["Statistics", statistics.element], ["Events", events.element]]);
  if (gap) panels.set("Gap", gap.element);
  let open = "Device";
  const show = (name: string) => {
    open = name;
    panels.forEach((panel, other) => panel.classList.toggle("open", other === name));
    tabs.querySelectorAll("button").forEach((tab) => {
      const isOpen = tab.dataset["panel"] === name;
      tab.setAttribute("aria-selected", String(isOpen));
      tab.tabIndex = isOpen ? 0 : -1;
    });
    if (name === "Statistics") void statistics.refresh();
    if (name === "Events") tabs.querySelector("[data-panel=Events]")?.removeAttribute("data-count");
  };
  for (const name of panels.keys()) {
    tabs.append(button(name, `${name} (${[...panels.keys()].indexOf(name) + 1})`, () => show(name), { role: "tab", "data-panel": name, "aria-selected": "false" }));
  }
  tabs.addEventListener("keydown", (event) => {
    const way = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (way === 0) return;
    const names = [...panels.keys()];
    show(names[(names.indexOf(open) + way + names.length) % names.length]!);
    tabs.querySelector<HTMLElement>("[aria-selected=true]")?.focus();
  });

  const banner = el("div", { class: "banner", role: "alert", hidden: true });
  const label = el("div", { class: "label", hidden: true });
  const view = el("main", { class: "view" }, el("div", { class: "canvas" }, world.canvas), banner, label,
    el("div", { class: "corner" }, button(icon("fit"), "Show all (F)", () => world.fit(), { class: "round" })));
  const side = el("aside", { class: "side" }, tabs, ...panels.values());
  document.querySelector("#app")?.replaceChildren(transport.element, view, side, timeline.element);
  show(gap ? "Gap" : "Device");

  // What is chosen.
  let chosen: string | null = null;
  let part: number | null = null;
  const choose = (name: string | null) => {
    [chosen, part] = [name, null];
    world.choose(name, null);
    device.show(name);
    label.textContent = name ?? "";
    if (name && open !== "Gap") show("Device");
  };
  const choosePart = (number: number) => {
    [chosen, part] = [null, number];
    world.choose(null, number);
    const found = world.parts.all.get(number);
    if (found) device.showPart(found);
    show("Device");
  };
  const remove = async (number: number) => {
    if (await tell("DELETE", `/api/parts/${number}`)) choose(null);
  };
  device.onchoose = choose;
  device.onremove = (number) => void remove(number);
  world.onpick = (picked) => {
    if (!picked) choose(null);
    else if ("part" in picked) choosePart(picked.part);
    else {
      choose(picked.device);
      if (gap?.shares.has(picked.device)) gap.open();
    }
  };
  world.onlabel = (place) => {
    label.hidden = !place || !chosen;
    if (place) label.style.transform = `translate(${place.x}px, ${place.y}px) translate(-50%, -140%)`;
  };
  if (gap) {
    await gap.load();
    world.heat(gap.shares);
    gap.onchoose = choose;
  }
  events.onplace = (place, isNew) => {
    world.mark(place);
    if (!isNew) world.lookAt(place);
  };
  events.onalarm = (count) => open !== "Events" && tabs.querySelector("[data-panel=Events]")?.setAttribute("data-count", String(count));

  // The banner while anything is not as automation and plant would have it.
  const warn = (state: State) => {
    const held = state.forced.map((one) => `${one.name} = ${one.value}`);
    const broken = [...state.faults.signals.map((one) => `${one.name} sticks`), ...state.faults.drives.map((name) => `${name} has no power`), ...(state.faults.message ? ["the next message is lost"] : [])];
    banner.hidden = held.length + broken.length === 0;
    const text = `${held.join("|")}/${broken.join("|")}`;
    if (banner.dataset["text"] === text) return;
    banner.dataset["text"] = text;
    banner.replaceChildren(
      icon("warn"),
      el("span", {}, ...(held.length > 0 ? [el("b", {}, `${held.length} forced: `), held.slice(0, 4).join(", ") + (held.length > 4 ? " …" : "")] : []), held.length > 0 && broken.length > 0 ? " · " : "", ...(broken.length > 0 ? [el("b", {}, "Faults: "), broken.slice(0, 4).join(", ")] : [])),
      ...(store.isLive && held.length > 0 ? [button("Release all", "Release all forced signals", () => void tell("DELETE", "/api/forces"))] : []),
    );
  };

  const setTheme = (theme: string) => {
    document.documentElement.dataset["theme"] = theme;
    world.theme();
    timeline.update();
  };
  transport.ontheme = () => {
    const theme = document.documentElement.dataset["theme"] === "dark" ? "light" : "dark";
    localStorage.setItem("theme", theme);
    setTheme(theme);
  };
  dark.addEventListener("change", () => setTheme(themed()));
  transport.onhelp = () => help(store.isLive);

  // Keys.
  document.addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    const writes = target.matches("input:not([type=range]), textarea, select");
    if (event.key === "Escape" && !document.querySelector("dialog[open]")) {
      if (writes) target.blur();
      else choose(null);
    }
    if (writes || event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    const onCanvas = target === world.canvas;
    const far = event.shiftKey ? 0.1 : 1;
    const keys: Record<string, () => void> = {
      " ": () => (store.isLive ? transport.toggle() : timeline.toggle()),
      f: () => world.fit(chosen ?? undefined),
      F: () => world.fit(),
      t: () => transport.ontheme(),
      "?": () => help(store.isLive),
      g: () => gap?.open(),
      "/": () => {
        show("Signals");
        signals.filter.focus();
      },
      "+": () => world.nudge(0, 0, 0.85),
      "-": () => world.nudge(0, 0, 1.18),
    };
    [...panels.keys()].forEach((name, index) => (keys[String(index + 1)] = () => show(name)));
    if (store.isLive) {
      keys["."] = () => transport.step(1);
      keys[">"] = keys[":"] = () => transport.step(10);
      keys["r"] = () => void transport.recordOrEnd();
      keys["Delete"] = () => void (part !== null && remove(part));
    }
    if (onCanvas || store.isLive) {
      keys["ArrowLeft"] = () => world.nudge(-0.08, 0, 1);
      keys["ArrowRight"] = () => world.nudge(0.08, 0, 1);
      keys["ArrowUp"] = () => world.nudge(0, 0.06, 1);
      keys["ArrowDown"] = () => world.nudge(0, -0.06, 1);
    } else {
      keys["ArrowLeft"] = () => timeline.nudge(-far);
      keys["ArrowRight"] = () => timeline.nudge(far);
      keys["Home"] = () => timeline.seek(0);
      keys["End"] = () => timeline.seek(plant.ends_s ?? 0);
    }
    const act = keys[event.key];
    // A button that has the focus takes the space bar itself.
    if (!act || (event.key === " " && target.matches("button, summary")) || (event.key.startsWith("Arrow") && target.closest("[role=tablist], input"))) return;
    event.preventDefault();
    act();
  });

  // What comes in.
  link = (connected) => (store.connected = connected);
  link(isConnected);
  take = (frame) => {
    store.take(frame);
    world.take(frame);
    if (frame.begins) choose(null);
  };
  early.splice(0).forEach(take);
  const refresh = async () => {
    try {
      store.state = await ask<State>("GET", "/api/state");
    } catch (error) {
      if (!(error instanceof Refused) && store.state) store.connected = false;
    }
    if (store.state) {
      transport.take(store.state);
      warn(store.state);
    }
  };
  setInterval(() => void refresh(), ASK);
  setInterval(() => {
    void events.refresh();
    if (open === "Statistics") void statistics.refresh();
  }, 1000);
  setInterval(() => {
    transport.tick();
    timeline.update();
    if (open === "Signals") signals.update();
    if (open === "Device") device.update();
  }, REFRESH);
  await refresh();
  if (store.isLive) void ask<Statistics>("GET", "/api/statistics").then((found) => found.can_be_max && transport.allowMax());
  if (plant.needs_token && !sessionStorage.getItem("token")) toast("You can look, and change nothing", "open the address with the token that was printed when the program started");
  // For those who test: where something is on the page.
  Object.assign(window, { kinetwin: { world, store } });
}

/** All keys. */
function help(isLive: boolean): void {
  const keys: [string, string][] = [
    ["Space", isLive ? "pause, go on" : "play, pause"],
    ...(isLive ? ([[". / Shift .", "one step, ten steps"], ["R", "record, end the recording"], ["Del", "take the chosen part out"]] as [string, string][]) : ([["← →", "a second back, on; with Shift a tenth"], ["Home End", "start, end of the trace"]] as [string, string][])),
    ["F", "fit what is chosen; Shift F all"],
    ["arrows", isLive ? "orbit the camera" : "orbit, while the picture has the focus"],
    ["+ −", "nearer, farther"],
    ["/", "filter the signals"],
    ["1 … 5", "panels"],
    ["G", "the report of the gap"],
    ["T", "light or dark"],
    ["Esc", "choose nothing, close"],
  ];
  const dialog = el("dialog", { class: "help", "aria-label": "Keys" },
    el("header", {}, el("b", {}, "Keys"), button(icon("close"), "Close (Esc)", () => dialog.close(), { class: "ghost" })),
    el("dl", { class: "keys" }, ...keys.flatMap(([key, what]) => [el("dt", {}, el("kbd", {}, key)), el("dd", {}, what)])),
    el("p", { class: "quiet" }, "Mouse: drag to orbit, wheel to zoom, right drag to move; click a device or a part, double click to come near. All that this page does is an endpoint: ", el("a", { href: "/api/openapi.json", target: "_blank", rel: "noopener" }, "openapi.json")));
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}

begin().catch((error: unknown) => {
  const text = error instanceof Error ? error.message : String(error);
  document.querySelector("#app")?.replaceChildren(el("p", { class: "loading" }, `The page cannot begin: ${text}`));
});
