// The strip at the bottom: pinned signals over time, and of a recorded trace its time bar.

import { ask, signalPath } from "./api";
import { button, clock, el, figure, icon } from "./dom";
import { context, ink, plot } from "./plot";
import { type History, isSwitch, type Store } from "./store";

/** How much of the past is shown of a run that goes on, s. */
const SPAN = 20;
const SPEEDS = [-4, -1, -0.25, 0.25, 1, 4, 16];

interface Lane {
  register: number;
  canvas: HTMLCanvasElement;
  value: HTMLElement;
  history: History;
  ghost: History | undefined;
}

const EMPTY: History = { times: [], values: [] };

export class Timeline {
  readonly element = el("section", { class: "timeline", "aria-label": "Signals over time" });
  private readonly lanes = el("div", { class: "lanes" });
  private readonly axis = el("canvas", { class: "axis", "aria-hidden": "true" });
  private shown: Lane[] = [];
  private readonly bar: HTMLInputElement;
  private readonly go: HTMLButtonElement;
  private readonly time = el("output", { class: "clock" });
  private readonly paces: HTMLButtonElement[] = [];
  private sending = false;
  private wanted: number | null = null;

  constructor(private readonly store: Store) {
    const ends = store.plant.ends_s ?? 0;
    this.bar = el("input", { type: "range", min: 0, max: ends, step: 0.01, value: 0, "aria-label": "Time in the trace, s", class: "scrub" });
    this.go = button(icon("pause"), "Play or pause (Space)", () => this.toggle(), { class: "round" });
    if (!store.isLive) {
      this.bar.addEventListener("input", () => this.seek(this.bar.valueAsNumber));
      for (const speed of SPEEDS) {
        const label = speed < 0 ? `◂ ${-speed}×` : `${speed}× ▸`;
        this.paces.push(button(label, speed < 0 ? `Backwards at ${-speed} times` : `Forwards at ${speed} times`, () => void this.set({ speed, paused: false }), { "data-speed": speed }));
      }
      const marks = el("div", { class: "marks", "aria-hidden": "true" }, ...store.plant.markers.slice(0, 200).map((mark) => el("i", { title: `${clock(mark.at_s)}: ${mark.text}`, style: `left:${(mark.at_s / ends) * 100}%` })));
      this.element.append(
        el("div", { class: "playback" }, this.go, el("div", { class: "segments" }, ...this.paces), el("div", { class: "track" }, this.bar, marks), this.time, el("span", { class: "quiet" }, `of ${clock(ends)}`)),
      );
    }
    this.element.append(this.lanes, this.axis);
    this.pins();
  }

  /** Shows what is pinned. */
  pins(): void {
    this.shown = [...this.store.pinned].slice(0, 8).map((register) => {
      const signal = this.store.signal(register);
      return { register, canvas: el("canvas", { "aria-hidden": "true" }), value: el("output", {}), history: EMPTY, ghost: undefined, name: signal.name };
    });
    this.lanes.replaceChildren(
      ...this.shown.map((lane) => {
        const name = this.store.signal(lane.register).name;
        const off = button(icon("close"), `Unpin ${name}`, () => {
          this.store.pinned.delete(lane.register);
          this.pins();
        }, { class: "ghost" });
        return el("div", { class: "lane" }, el("span", { class: "name", title: name }, name), lane.canvas, lane.value, off);
      }),
    );
    this.element.classList.toggle("bare", this.shown.length === 0);
    if (!this.store.isLive) this.shown.forEach((lane) => void this.fetch(lane));
    this.update();
  }

  private async fetch(lane: Lane): Promise<void> {
    const of = (points: [number, number][]): History => ({ times: points.map((point) => point[0]), values: points.map((point) => point[1]) });
    const found = await ask<{ trace: [number, number][]; ghost: [number, number][] | null }>("GET", `${signalPath(this.store.signal(lane.register).name)}/history`);
    lane.history = of(found.trace);
    lane.ghost = found.ghost ? of(found.ghost) : undefined;
    this.update();
  }

  toggle(): void {
    void this.set({ paused: !this.store.state?.paused });
  }

  /** Goes to an instant; of many asked for quickly, the last counts. */
  seek(time: number): void {
    this.wanted = time;
    if (!this.sending) void this.send();
  }

  nudge(seconds: number): void {
    this.seek(Math.max(0, this.store.now + seconds));
  }

  private async send(): Promise<void> {
    this.sending = true;
    while (this.wanted !== null) {
      const time_s = this.wanted;
      this.wanted = null;
      await this.set({ time_s, paused: true });
    }
    this.sending = false;
  }

  private async set(change: { time_s?: number; speed?: number; paused?: boolean }): Promise<void> {
    try {
      const { paused } = await ask<{ paused: boolean }>("POST", "/api/playback", change);
      if (this.store.state) this.store.state.paused = paused;
    } catch {
      // The link's own light tells of a server that is gone.
    }
    this.update();
  }

  update(): void {
    const { now, plant } = this.store;
    const span = this.store.isLive ? { from: now - SPAN, to: now } : { from: 0, to: plant.ends_s ?? 1 };
    const [command, report] = [ink("--command"), ink("--report")];
    for (const lane of this.shown) {
      const signal = this.store.signal(lane.register);
      const history = this.store.isLive ? this.store.histories[lane.register]! : lane.history;
      plot(lane.canvas, history, span, isSwitch(signal), signal.direction === "command" ? command : report, lane.ghost);
      if (!this.store.isLive) this.head(lane.canvas, now, span.to);
      const value = this.store.values[lane.register]!;
      const text = Number.isNaN(value) ? "–" : isSwitch(signal) ? (value ? "TRUE" : "FALSE") : `${figure(value)}${signal.unit === "1" ? "" : `\u202f${signal.unit}`}`;
      if (lane.value.textContent !== text) lane.value.textContent = text;
    }
    this.ticks(span);
    if (!this.store.isLive) {
      if (document.activeElement !== this.bar || !this.sending) this.bar.value = String(now);
      this.bar.style.setProperty("--share", String(now / (plant.ends_s || 1)));
      this.time.textContent = clock(now);
      const paused = this.store.state?.paused ?? false;
      this.go.replaceChildren(icon(paused ? "play" : "pause"));
      this.paces.forEach((pace) => pace.setAttribute("aria-pressed", String(!paused && Number(pace.dataset["speed"]) === this.store.speed)));
    }
  }

  private head(canvas: HTMLCanvasElement, now: number, ends: number): void {
    const pen = canvas.getContext("2d");
    if (!pen) return;
    const x = (now / ends) * canvas.clientWidth;
    pen.fillStyle = ink("--accent");
    pen.fillRect(Math.max(0, x - 0.75), 0, 1.5, canvas.clientHeight);
  }

  private ticks(span: { from: number; to: number }): void {
    if (this.shown.length === 0) return;
    const pen = context(this.axis);
    if (!pen) return;
    const width = this.axis.clientWidth;
    const length = span.to - span.from;
    const step = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800, 3600].find((step) => (step / length) * width > 70) ?? 7200;
    pen.fillStyle = ink("--quiet");
    pen.font = "11px system-ui, sans-serif";
    pen.textAlign = "center";
    for (let time = Math.ceil(Math.max(0, span.from) / step) * step; time <= span.to; time += step) {
      const x = ((time - span.from) / length) * width;
      pen.fillRect(x, 0, 1, 4);
      if (x > 14 && x < width - 14) pen.fillText(`${figure(time, 5)} s`, x, 14);
    }
  }
}
