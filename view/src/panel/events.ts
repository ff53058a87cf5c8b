// What happened: sessions, lost parts, collisions. A click goes where it was.

import { ask, type Happening } from "../api";
import { button, clock, el } from "../dom";

export class Events {
  readonly element = el("div", { class: "panel events" });
  onplace: (place: [number, number, number], isNew: boolean) => void = () => {};
  onalarm: (count: number) => void = () => {};
  private last = 0;
  private alarms = 0;
  private first = true;

  constructor() {
    this.element.append(el("p", { class: "hint" }, "Nothing has happened yet."));
  }

  async refresh(): Promise<void> {
    let events: Happening[];
    try {
      ({ events } = await ask<{ events: Happening[] }>("GET", `/api/events?after=${this.last}`));
    } catch {
      return;
    }
    if (events.length > 0 && this.last === 0) this.element.replaceChildren();
    for (const event of events) {
      this.last = Math.max(this.last, event.number);
      const line = [el("time", {}, clock(event.at_s)), el("span", {}, event.text)];
      const place = event.place;
      this.element.prepend(
        place
          ? button(el("span", { class: `event ${event.gravity}` }, ...line), "Show where", () => this.onplace(place, false), { class: "event-place" })
          : el("div", { class: `event ${event.gravity}` }, ...line),
      );
      if (place && !this.first) this.onplace(place, true);
      if (event.gravity !== "information") this.onalarm(++this.alarms);
    }
    while (this.element.children.length > 200) this.element.lastElementChild?.remove();
    this.first = false;
  }
}
