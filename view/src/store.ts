// What the page knows: the plant, the present values, and what they were.

import type { Plant, Signal, State } from "./api";
import type { Frame } from "./stream";

/** When a signal became what. */
export interface History {
  times: number[];
  values: number[];
}

/** Changes that are kept of a signal while a run goes on. */
const KEPT = 1200;

export class Store {
  readonly values: Float64Array;
  readonly histories: History[];
  readonly byName = new Map<string, number>();
  /** Signals by their device. */
  readonly ofDevice = new Map<string, number[]>();
  now = 0;
  run = 0;
  speed = 1;
  state: State | null = null;
  connected = false;
  /** Whose signals are shown large at the bottom. */
  readonly pinned = new Set<number>();

  constructor(readonly plant: Plant) {
    const count = plant.signals.length;
    this.values = new Float64Array(count).fill(NaN);
    this.histories = Array.from({ length: count }, () => ({ times: [], values: [] }));
    plant.signals.forEach((signal, index) => {
      this.byName.set(signal.name, index);
      const own = this.ofDevice.get(signal.device) ?? [];
      own.push(index);
      this.ofDevice.set(signal.device, own);
    });
    plant.scene.beams
      .filter((beam) => beam.signal !== null)
      .slice(0, 4)
      .forEach((beam) => this.pinned.add(beam.signal as number));
  }

  get isLive(): boolean {
    return this.plant.mode === "live";
  }

  signal(register: number): Signal {
    return this.plant.signals[register] as Signal;
  }

  value(name: string): number | undefined {
    const register = this.byName.get(name);
    return register === undefined ? undefined : this.values[register];
  }

  take(frame: Frame): void {
    if (frame.begins || frame.run !== this.run || frame.at > this.now + 2) {
      this.run = frame.run;
      this.histories.forEach((history) => (history.times.length = history.values.length = 0));
    } else if (frame.at < this.now) this.forget(frame.at);
    this.now = frame.at;
    this.speed = frame.speed;
    for (const { register, value } of frame.values) {
      this.values[register] = value;
      const history = this.histories[register];
      if (!history) continue;
      history.times.push(frame.at);
      history.values.push(value);
      if (history.times.length > KEPT) {
        history.times.splice(0, KEPT / 4);
        history.values.splice(0, KEPT / 4);
      }
    }
  }

  /** Forgets what was after `time`: a trace that is played backwards. */
  private forget(time: number): void {
    for (const { times, values } of this.histories) {
      while (times.length > 1 && times.at(-1)! >= time) {
        times.pop();
        values.pop();
      }
    }
  }
}

/** Whether a signal is a switch. */
export const isSwitch = (signal: Signal) => signal.type === "BOOL";
