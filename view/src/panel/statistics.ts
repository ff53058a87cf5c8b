// Throughput, occupancy, latency, step times.

import { ask, type Quantiles, type Statistics } from "../api";
import { clock, el, figure } from "../dom";
import type { Store } from "../store";

const us = (value: number | null | undefined) => (value === null || value === undefined ? "–" : value < 1000 ? `${figure(value, 3)} µs` : `${figure(value / 1000, 3)} ms`);

export class StatisticsPanel {
  readonly element = el("div", { class: "panel" });

  constructor(private readonly store: Store) {}

  async refresh(): Promise<void> {
    let found: Statistics;
    try {
      found = await ask<Statistics>("GET", "/api/statistics");
    } catch {
      return;
    }
    const card = (title: string, value: string, more = "", alarm = false) =>
      el("div", { class: alarm ? "card alarm" : "card" }, el("span", {}, title), el("b", {}, value), el("small", {}, more));
    const quantiles = (title: string, of: Quantiles | undefined, none: string) =>
      card(title, us(of?.p50), of?.p50 ? `p99 ${us(of.p99)} · p99.9 ${us(of.p999)} · max ${us(of.max)}` : none);
    const { boxes, pallets } = found;
    const cards = [
      card("Boxes an hour", found.at_s > 5 && boxes.out_an_hour !== null ? figure(Math.round(boxes.out_an_hour)) : "–", `${boxes.out} out of ${boxes.in} in ${clock(found.at_s)}`),
      card("Boxes present", String(boxes.present), `${pallets.present} pallets · ${pallets.out} out`),
      card("Lost", String(boxes.lost + pallets.lost), boxes.removed + pallets.removed > 0 ? `${boxes.removed + pallets.removed} taken out by hand` : "fell off", boxes.lost + pallets.lost > 0),
      card("Collisions", String(found.collisions), "parts within one another", found.collisions > 0),
    ];
    if (this.store.isLive) {
      cards.push(
        quantiles("Round trip, median", found.round_trip_us, found.lockstep ? "not measured in lock-step" : "a foreign server is not measured"),
        quantiles("Step, computing", found.step_us, ""),
        card("Overruns", String(found.overruns ?? "–"), `of ${figure(found.steps ?? 0)} steps of ${us((found.step_s ?? 0) * 1e6)} · ${found.late_steps} late`, (found.overruns ?? 0) > 0),
        card("Messages", `${figure(found.messages?.in ?? 0)} in`, `${figure(found.messages?.out ?? 0)} out · ${found.messages?.lost ?? 0} lost`, (found.messages?.lost ?? 0) > 0),
      );
    }
    const busy = Object.entries(found.occupancy)
      .map(([device, share]) => ({ device, share: share ?? 0 }))
      .sort((a, b) => b.share - a.share);
    const bars = busy.map(({ device, share }) =>
      el("div", { class: "bar", title: `${device} had parts ${(share * 100).toFixed(1)} % of the time` }, el("span", {}, device), el("i", { style: `--share:${Math.min(1, share)}` }), el("em", {}, `${(share * 100).toFixed(0)} %`)),
    );
    this.element.replaceChildren(
      el("div", { class: "cards" }, ...cards),
      el("h3", {}, "Occupancy", el("span", { class: "quiet" }, " share of time with parts")),
      ...(bars.length > 0 ? bars : [el("p", { class: "quiet" }, "nothing here handles parts")]),
      found.server ? el("p", { class: "quiet" }, `Automation: ${found.server}`) : el("p", {}),
    );
  }
}
