// The bar at the top: how time goes by, recording, faults, theme.

import { ask, Refused, type State, tell } from "./api";
import { button, clock, el, icon, toast } from "./dom";
import type { Store } from "./store";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10];

export class Transport {
  readonly element = el("header", { class: "top" });
  ontheme: () => void = () => {};
  onhelp: () => void = () => {};
  private readonly time = el("output", { class: "clock", "aria-label": "Simulated time" });
  private readonly pill = el("span", { class: "pill", role: "status" });
  private readonly go = button(icon("pause"), "Pause or go on (Space)", () => this.toggle(), { class: "round" });
  private readonly record = button(icon("record"), "Record the session, or end the recording (R)", () => void this.recordOrEnd(), { class: "round record" });
  private readonly speed = el("select", { "aria-label": "Simulated seconds to a second" });
  private readonly lose = button("Lose a message", "Lose the automation's next message", () => void tell(this.store.state?.faults.message ? "DELETE" : "PUT", "/api/faults/message"), { class: "danger" });
  private isPaused = false;

  constructor(private readonly store: Store) {
    const { plant } = store;
    const brand = el("div", { class: "brand" }, el("img", { src: "./assets/icon.svg", alt: "", width: 26, height: 26 }), el("b", {}, "kinetwin"), el("span", { class: "model", title: plant.trace ?? plant.model }, plant.trace ?? plant.model));
    const tools = el("div", { class: "tools" });
    if (store.isLive) {
      for (const factor of SPEEDS) this.speed.append(el("option", { value: factor, selected: factor === 1 }, `${factor}×`));
      this.speed.addEventListener("change", () => {
        const value = this.speed.value;
        void tell("POST", "/api/run/speed", { factor: value === "max" ? value : Number(value) });
      });
      tools.append(
        button(icon("reset"), "Reset: begin the run anew", () => void this.reset(), { class: "round" }),
        this.go,
        button(icon("step"), "One step (.), ten with Shift", (event) => this.step(event.shiftKey ? 10 : 1), { class: "round" }),
        this.speed,
        this.record,
        this.lose,
      );
    } else {
      const over = plant.ghost ? el("span", { class: "ghostly", title: `${plant.ghost} is laid over it` }, `ghost: ${plant.ghost}`) : null;
      if (over) tools.append(over);
    }
    this.element.append(brand, el("div", { class: "now" }, this.pill, this.time), tools, el("div", { class: "ends" }, button(icon("sun"), "Light or dark (T)", () => this.ontheme(), { class: "round ghost" }), button(icon("help"), "All keys (?)", () => this.onhelp(), { class: "round ghost" })));
  }

  toggle(): void {
    void tell("POST", this.isPaused ? "/api/run/resume" : "/api/run/pause");
  }

  step(steps: number): void {
    void tell("POST", "/api/run/step", { steps });
  }

  private async reset(): Promise<void> {
    if (await tell("POST", "/api/run/reset")) toast("The run begins anew", "", false);
  }

  async recordOrEnd(): Promise<void> {
    try {
      if (this.store.state?.recording) {
        const { recorded } = await ask<{ recorded: string }>("DELETE", "/api/recording");
        toast(`Recorded to ${recorded}`, "kinetwin view plays it", false);
      } else {
        const stamp = new Date().toISOString().slice(0, 19).replace(/[T:]/g, "-");
        const { recording } = await ask<{ recording: string }>("POST", "/api/recording", { file: `run-${stamp}.cps.jsonl.zst` });
        toast(`Recording to ${recording}`, "in the folder that the program was started in", false);
      }
    } catch (error) {
      if (error instanceof Refused) toast(error.message, error.hint);
    }
  }

  allowMax(): void {
    if (!this.speed.querySelector("[value=max]")) this.speed.append(el("option", { value: "max" }, "max"));
  }

  /** Takes the state, as it is asked for now and then. */
  take(state: State): void {
    this.isPaused = state.paused;
    this.go.replaceChildren(icon(state.paused ? "play" : "pause"));
    const words = !this.store.connected ? "no link" : state.ended ? "ended" : state.paused ? "paused" : this.store.isLive ? (state.connected ? "running" : "no session") : "playing";
    this.pill.textContent = words;
    this.pill.dataset["is"] = words;
    this.record.classList.toggle("active", Boolean(state.recording));
    this.record.title = state.recording ? `Recording to ${state.recording}; end it (R)` : "Record the session (R)";
    this.lose.classList.toggle("active", state.faults.message);
    const speed = state.speed === 0 ? "max" : String(state.speed);
    if (document.activeElement !== this.speed && this.speed.value !== speed) {
      if (![...this.speed.options].some((option) => option.value === speed)) this.speed.append(el("option", { value: speed }, speed === "max" ? "max" : `${speed}×`));
      this.speed.value = speed;
    }
  }

  tick(): void {
    const text = clock(this.store.now);
    if (this.time.textContent !== text) this.time.textContent = text;
  }
}
