// The signal table: filter, value, sparkline or edge strip, force, pin.

import { client, signalPath, tell } from "../api";
import { button, el, figure, icon, toast } from "../dom";
import { ink, plot } from "../plot";
import { isSwitch, type Store } from "../store";

/** The most rows at once; a filter narrows what is beyond. */
const MOST = 250;
/** How much of the past a row shows, s. */
const SPAN = 12;

interface Row {
  register: number;
  element: HTMLElement;
  value: HTMLElement;
  canvas: HTMLCanvasElement;
  shown: string;
  seen: boolean;
}

/** Rows of signals that keep up with the values. */
export class Rows {
  readonly element = el("div", { class: "rows", role: "table" });
  private rows: Row[] = [];
  private readonly watch = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const row = this.rows.find((row) => row.element === entry.target);
      if (row) row.seen = entry.isIntersecting;
    }
  });

  constructor(
    private readonly store: Store,
    private readonly onpin: () => void,
    /** Whether signals stand under the names of their devices. */
    private readonly headed: boolean,
  ) {}

  show(registers: number[]): void {
    this.watch.disconnect();
    this.rows = registers.map((register) => this.row(register));
    let device = "";
    const lines = this.rows.flatMap((row) => {
      const own = this.store.signal(row.register).device;
      const heads = this.headed && own !== device ? [el("div", { class: "of" }, own)] : [];
      device = own;
      return [...heads, row.element];
    });
    this.element.replaceChildren(...lines);
    this.rows.forEach((row) => this.watch.observe(row.element));
    this.update();
  }

  private row(register: number): Row {
    const signal = this.store.signal(register);
    const value = el("output", { class: "value" });
    const canvas = el("canvas", { class: "spark", "aria-hidden": "true" });
    const dot = signal.name.indexOf(".");
    const name = el(
      "span",
      { class: "name", title: `${signal.name}: ${signal.type}, ${signal.direction}, ${signal.kind}${signal.unit === "1" ? "" : `, ${signal.unit}`}` },
      el("i", { class: `way ${signal.direction}`, title: signal.direction === "command" ? "the automation sets it" : "the plant reports it" }, signal.direction === "command" ? "▸" : "◂"),
      signal.name.slice(dot + 1),
    );
    const pin = button(icon("pin"), `Pin ${signal.name} to the strip below`, () => {
      if (!this.store.pinned.delete(register)) this.store.pinned.add(register);
      this.onpin();
      this.update();
    }, { class: "ghost pin" });
    const element = el("div", { class: "row", role: "row", "data-signal": signal.name }, name, canvas, value);
    if (this.store.isLive) {
      element.append(button(icon("lock"), `Force ${signal.name}`, () => this.edit(register, element), { class: "ghost force" }));
    }
    element.append(pin);
    return { register, element, value, canvas, shown: "", seen: false };
  }

  /** Opens the line in which a value is forced. */
  private edit(register: number, element: HTMLElement): void {
    const open = element.nextElementSibling;
    if (open?.classList.contains("forcing")) {
      open.remove();
      return;
    }
    const signal = this.store.signal(register);
    const path = `${signalPath(signal.name)}/force`;
    const force = async (value: number | boolean) => {
      const forced = this.store.state?.forced.find((held) => held.name === signal.name);
      const replace = Boolean(forced?.by && forced.by !== client && confirm(`${signal.name} is forced by ${forced.by}. Take it over?`));
      if (await tell("PUT", path, { value, client, replace })) toast(`${signal.name} is forced to ${value}`, "it stays so until it is released", false);
    };
    const release = button("Release", `Release ${signal.name}`, () => void tell("DELETE", path), { class: "release" });
    const form = el("form", { class: "forcing" });
    form.addEventListener("submit", (event) => event.preventDefault());
    form.addEventListener("keydown", (event) => event.key === "Escape" && form.remove());
    if (isSwitch(signal)) {
      form.append(
        button("TRUE", `Force ${signal.name} to TRUE`, () => void force(true), { class: "yes" }),
        button("FALSE", `Force ${signal.name} to FALSE`, () => void force(false), { class: "no" }),
        release,
      );
    } else {
      const input = el("input", {
        type: "number",
        step: signal.type === "REAL" || signal.type === "LREAL" ? "any" : "1",
        min: signal.min ?? undefined,
        max: signal.max ?? undefined,
        value: figure(this.store.values[register], 6).replace("–", "0"),
        "aria-label": `Value to force ${signal.name} to${signal.unit === "1" ? "" : `, ${signal.unit}`}`,
      });
      form.addEventListener("submit", () => void force(input.valueAsNumber));
      form.append(input, el("span", { class: "unit" }, signal.unit === "1" ? "" : signal.unit), el("button", { type: "submit", class: "yes" }, "Force"), release);
      queueMicrotask(() => input.select());
    }
    element.after(form);
    form.querySelector<HTMLElement>("input, button")?.focus();
  }

  update(): void {
    const forced = new Set(this.store.state?.forced.map((held) => held.name));
    const stuck = new Set(this.store.state?.faults.signals.map((held) => held.name));
    const [command, report] = [ink("--command"), ink("--report")];
    for (const row of this.rows) {
      const signal = this.store.signal(row.register);
      const value = this.store.values[row.register]!;
      const digital = isSwitch(signal);
      const shown = Number.isNaN(value) ? "–" : digital ? (value ? "TRUE" : "FALSE") : `${figure(value, 3)}${signal.unit === "1" ? "" : `\u202f${signal.unit}`}`;
      if (shown !== row.shown) {
        row.shown = row.value.textContent = shown;
        row.value.classList.toggle("on", digital && value === 1);
        row.value.classList.toggle("off", digital && value === 0);
      }
      row.element.classList.toggle("forced", forced.has(signal.name));
      row.element.classList.toggle("stuck", stuck.has(signal.name));
      row.element.classList.toggle("pinned", this.store.pinned.has(row.register));
      if (row.seen) {
        const colour = signal.direction === "command" ? command : report;
        plot(row.canvas, this.store.histories[row.register]!, { from: this.store.now - SPAN, to: this.store.now }, digital, colour);
      }
    }
  }
}

/** The table with its filter. */
export class Signals {
  readonly element = el("div", { class: "panel" });
  readonly filter = el("input", { type: "search", placeholder: "Filter: Conveyor1, lightBarrier …  ( / )", "aria-label": "Filter signals by name" });
  private readonly rows: Rows;
  private readonly count = el("p", { class: "quiet count" });
  private which = "all";

  constructor(
    private readonly store: Store,
    onpin: () => void,
  ) {
    this.rows = new Rows(store, onpin, true);
    const kinds = el("div", { class: "segments", role: "group", "aria-label": "Which signals" });
    for (const kind of ["all", "commands", "reports", "forced"]) {
      const one = button(kind, `Show ${kind === "all" ? "all signals" : `${kind} only`}`, () => {
        this.which = kind;
        kinds.querySelectorAll("button").forEach((other) => other.setAttribute("aria-pressed", String(other === one)));
        this.apply();
      }, { "aria-pressed": String(kind === "all") });
      kinds.append(one);
    }
    this.filter.addEventListener("input", () => this.apply());
    this.element.append(el("div", { class: "sticky" }, this.filter, kinds, this.count), this.rows.element);
    this.apply();
  }

  apply(): void {
    const words = this.filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    const forced = new Set(this.store.state?.forced.map((held) => held.name));
    const fits = (register: number) => {
      const signal = this.store.signal(register);
      const kind = this.which === "all" || (this.which === "forced" ? forced.has(signal.name) : `${signal.direction}s` === this.which);
      return kind && words.every((word) => signal.name.toLowerCase().includes(word));
    };
    const found = this.store.plant.signals.map((_, register) => register).filter(fits);
    this.count.textContent = found.length > MOST ? `the first ${MOST} of ${found.length}; filter to see others` : `${found.length} of ${this.store.plant.signals.length} signals`;
    this.rows.show(found.slice(0, MOST));
  }

  update(): void {
    this.rows.update();
  }
}
