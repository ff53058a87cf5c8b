// The gap that a diagnosis found: devices by their shares, and the plots of the winner.

import { ask, type GapReport } from "../api";
import { button, el, figure, icon } from "../dom";

export class GapPanel {
  readonly element = el("div", { class: "panel" });
  readonly shares = new Map<string, number>();
  onchoose: (device: string) => void = () => {};
  private report: GapReport | null = null;

  async load(): Promise<void> {
    this.report = await ask<GapReport>("GET", "/api/report");
    const { report, answer, cause } = this.report;
    report.where.forEach((one) => this.shares.set(one.device, one.share));
    const causes = new Map<string, string[]>();
    report.cause.forEach((one) => causes.set(one.device, [...(causes.get(one.device) ?? []), one.effect]));
    const rows = report.where.map((one) =>
      button(
        el("span", { class: "gap" },
          el("b", {}, one.device),
          el("em", {}, `${(one.share * 100).toFixed(0)} %`),
          el("i", { style: `--share:${one.share}` }),
          el("small", {}, causes.get(one.device)?.join(", ") ?? "no effect named")),
        `Open the plots of ${one.device}`,
        () => {
          this.onchoose(one.device);
          this.open();
        },
        { class: "gap-row" },
      ),
    );
    const { before, after, floor } = report.gap;
    this.element.replaceChildren(
      el("header", { class: "device" }, el("h2", {}, "Sim-to-real gap"), el("span", { class: "chip" }, report.verdict)),
      el("p", { class: "answer" }, answer, " ", cause),
      el("div", { class: "cards" },
        el("div", { class: "card" }, el("span", {}, "Model as it is"), el("b", {}, figure(before, 3)), el("small", {}, "× the noise")),
        el("div", { class: "card" }, el("span", {}, "With the causes"), el("b", {}, figure(after, 3)), el("small", {}, `a perfect model ${figure(floor, 3)}`))),
      el("h3", {}, "Where", el("span", { class: "quiet" }, " share of the gap by device")),
      ...(rows.length > 0 ? rows : [el("p", { class: "quiet" }, "no device has a gap of its own")]),
      button("Open the whole report", "Open the report's page (G)", () => this.open(), { class: "wide" }),
      el("div", { class: "legend" }, el("span", {}, "no share"), el("i", {}), el("span", {}, "largest share")),
    );
  }

  /** Opens the report's page over the picture. */
  open(): void {
    document.querySelector("dialog.report")?.remove();
    const dialog = el("dialog", { class: "report", "aria-label": "Report of the gap" });
    const frame = el("iframe", { src: "/api/report/page", title: "The report with its plots" });
    dialog.append(el("header", {}, el("b", {}, "Report of the diagnosis"), button(icon("close"), "Close (Esc)", () => dialog.close(), { class: "ghost" })), frame);
    dialog.addEventListener("close", () => dialog.remove());
    document.body.append(dialog);
    dialog.showModal();
  }
}
