// One device: its state, its signals, its parameters, what can be done to it; or one part.

import { ask, type Device, signalPath, tell } from "../api";
import { button, el, figure, toast } from "../dom";
import { isSwitch, type Store } from "../store";
import type { PartMove } from "../stream";
import { Rows } from "./signals";

export class DevicePanel {
  readonly element = el("div", { class: "panel" });
  readonly list: HTMLSelectElement;
  onchoose: (device: string | null) => void = () => {};
  onremove: (part: number) => void = () => {};
  private readonly body = el("div", {});
  private readonly rows: Rows;
  private readonly state = el("p", { class: "state", role: "status" });
  private readonly actions = el("div", { class: "actions" });
  private chosen: Device | null = null;
  private shown = "";

  constructor(
    private readonly store: Store,
    onpin: () => void,
  ) {
    this.rows = new Rows(store, onpin, false);
    this.list = el("select", { "aria-label": "Device" }, el("option", { value: "" }, "Choose a device, or click one …"));
    const kinds = new Map<string, Device[]>();
    store.plant.devices.forEach((device) => kinds.set(device.prototype, [...(kinds.get(device.prototype) ?? []), device]));
    for (const [kind, devices] of kinds) {
      this.list.append(el("optgroup", { label: kind }, ...devices.map((device) => el("option", { value: device.name }, device.name))));
    }
    this.list.addEventListener("change", () => this.onchoose(this.list.value || null));
    this.element.append(el("div", { class: "sticky" }, this.list), this.body);
    this.show(null);
  }

  show(name: string | null): void {
    this.chosen = this.store.plant.devices.find((device) => device.name === name) ?? null;
    this.list.value = this.chosen?.name ?? "";
    this.shown = "";
    if (!this.chosen) {
      this.body.replaceChildren(
        el("p", { class: "hint" }, "Click a device in the picture, or choose it from the list: its state, its signals, its parameters and what can be done to it stand here."),
        el("dl", { class: "keys" }, ...["Space|pause, go on", ".|one step", "F|fit the picture", "/|filter signals", "1 … 4|panels", "Esc|choose nothing", "?|all keys"].flatMap((line) => {
          const [key, what] = line.split("|");
          return [el("dt", {}, el("kbd", {}, key ?? "")), el("dd", {}, what ?? "")];
        })),
      );
      return;
    }
    const device = this.chosen;
    const own = this.store.ofDevice.get(device.name) ?? [];
    const [head, ...tasks] = [
      el("header", { class: "device" }, el("h2", {}, device.name), el("span", { class: "chip" }, device.prototype)),
      ...device.tasks.map((task) => this.parameters(task)),
    ];
    const effects = device.effects.map((effect) => el("li", {}, el("b", {}, effect.kind), ` at ${effect.place.toLowerCase()}${effect.component ? ` of ${effect.component}` : ""}: ${Object.entries(effect.parameters).map(([key, value]) => `${key} ${value}`).join(", ")}`));
    this.body.replaceChildren(
      head!,
      this.state,
      this.actions,
      el("h3", {}, "Signals"),
      own.length > 0 ? this.rows.element : el("p", { class: "quiet" }, "none"),
      ...tasks,
      ...(effects.length > 0 ? [el("h3", {}, "Effects"), el("ul", { class: "effects" }, ...effects)] : []),
    );
    this.rows.show(own);
    this.act(device, own);
    this.update();
  }

  showPart(part: PartMove): void {
    this.chosen = null;
    this.list.value = "";
    const kind = part.kind === 0 ? "Box" : "Pallet";
    const [x, y, z, turn] = part.place;
    const fact = (name: string, value: string) => [el("dt", {}, name), el("dd", {}, value)];
    this.body.replaceChildren(
      el("header", { class: "device" }, el("h2", {}, `${kind} ${part.number}`), el("span", { class: "chip" }, "part")),
      el("dl", { class: "parameters" },
        ...fact("size", `${part.size.map((side) => figure(side)).join(" × ")} m`),
        ...fact("place", `${figure(x)}, ${figure(y)}, ${figure(z)} m`),
        ...fact("turn", `${figure((turn / Math.PI) * 180)}°`)),
      this.store.isLive ? el("div", { class: "actions" }, button("Take it out", `Take ${kind.toLowerCase()} ${part.number} out of the plant (Del)`, () => this.onremove(part.number), { class: "danger" })) : el("p", {}),
    );
  }

  private parameters(task: Device["tasks"][number]): HTMLElement {
    const rows = task.parameters.flatMap((parameter) => {
      const value = parameter.value;
      const text = Array.isArray(value) ? value.map((one) => figure(one)).join("; ") : typeof value === "number" ? figure(value, 5) : String(value) || "–";
      return [el("dt", { title: parameter.summary }, parameter.name), el("dd", {}, text, parameter.unit && parameter.unit !== "1" ? el("span", { class: "unit" }, `\u202f${parameter.unit}`) : null)];
    });
    return el("details", { open: true }, el("summary", {}, "Parameters", el("span", { class: "quiet" }, ` ${task.summary}`)), el("dl", { class: "parameters" }, ...rows));
  }

  /** What can be done to a device of a run that goes on. */
  private act(device: Device, own: number[]): void {
    this.actions.replaceChildren();
    if (!this.store.isLive) return;
    const length = device.tasks.flatMap((task) => task.parameters).find((parameter) => parameter.name === "length")?.value;
    const isBelt = device.tasks.some((task) => task.kind.includes("Conveyor"));
    const name = encodeURIComponent(device.name);
    const drives = own.some((register) => /Target$|^command$/.test(this.store.signal(register).property) && this.store.signal(register).direction === "command");
    if (drives) {
      this.actions.append(button("Stop the drive", `Take the power from the drives of ${device.name}, or give it back`, () => {
        const dead = this.store.state?.faults.drives.includes(device.name);
        void tell(dead ? "DELETE" : "PUT", `/api/faults/drives/${name}`);
      }, { class: "danger", "data-act": "drive" }));
    }
    for (const register of own) {
      const signal = this.store.signal(register);
      if (signal.direction !== "report" || !isSwitch(signal) || !/barrier/i.test(signal.name)) continue;
      const short = signal.name.slice(signal.name.indexOf(".") + 1);
      this.actions.append(button(`${short} sticks`, `Let ${signal.name} stick at its present value, or mend it`, () => {
        const stuck = this.store.state?.faults.signals.some((held) => held.name === signal.name);
        void tell(stuck ? "DELETE" : "PUT", `/api/faults/signals/${encodeURIComponent(signal.name)}`);
      }, { class: "danger", "data-act": signal.name }));
    }
    if (isBelt) {
      const reach = typeof length === "number" ? length : 1;
      const station = el("input", { type: "number", min: 0, max: reach, step: 0.05, value: figure(reach / 2, 3), "aria-label": "Where on the belt, m from its start" });
      const put = (kind: "box" | "pallet", size: number[]) => async () => {
        const done = await tell("POST", "/api/parts", { kind, size, on: device.name, station: station.valueAsNumber });
        if (done) toast(`a ${kind} stands on ${device.name} at ${station.value} m`, "", false);
      };
      this.actions.append(
        el("span", { class: "insert" }, el("label", {}, "at ", station, " m"), button("Put a box", `Put a box on ${device.name}`, put("box", [0.36, 0.32, 0.24])), button("Put a pallet", `Put a pallet on ${device.name}`, put("pallet", [1.2, 0.8, 0.144]))),
      );
    }
  }

  update(): void {
    if (!this.chosen) return;
    this.rows.update();
    const own = this.store.ofDevice.get(this.chosen.name) ?? [];
    const faults = this.store.state?.faults;
    const dead = faults?.drives.includes(this.chosen.name) ?? false;
    const words: string[] = [];
    if (dead) words.push("no power");
    for (const register of own) {
      const signal = this.store.signal(register);
      const value = this.store.values[register];
      if (signal.direction !== "report" || value === undefined) continue;
      const short = signal.name.slice(signal.name.indexOf(".") + 1);
      if (isSwitch(signal) && value === 1) words.push(short.replace(/([A-Z])/g, " $1").toLowerCase());
      else if (/velocityActual|speedActual/.test(short)) words.push(`${figure(value)} ${signal.unit}`);
    }
    const text = words.join(" · ") || "at rest";
    if (text !== this.shown) this.shown = this.state.textContent = text;
    this.state.classList.toggle("fault", dead);
    for (const act of this.actions.querySelectorAll<HTMLElement>("[data-act]")) {
      const what = act.dataset["act"]!;
      const broken = what === "drive" ? dead : (faults?.signals.some((held) => held.name === what) ?? false);
      act.classList.toggle("active", broken);
      const short = what.slice(what.indexOf(".") + 1);
      act.textContent = what === "drive" ? (broken ? "Give the drive power" : "Stop the drive") : broken ? `Mend ${short}` : `${short} sticks`;
    }
  }
}

/** What a signal's own endpoint says; for those who test by hand. */
export const signalOf = (name: string) => ask(`GET`, signalPath(name));
