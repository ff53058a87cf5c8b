// Small plots of a signal over time: a line for a level, a strip for an edge.

import type { History } from "./store";

/** Colours of the present theme, as the style sheet has them. */
export function ink(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** Sizes a canvas to its place, once; its context in CSS pixels. */
export function context(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const pen = canvas.getContext("2d");
  pen?.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen?.clearRect(0, 0, width, height);
  return pen;
}

export interface Span {
  from: number;
  to: number;
}

/** Draws a history over `span`; a second one beneath it, as a ghost. */
export function plot(canvas: HTMLCanvasElement, history: History, span: Span, digital: boolean, colour: string, ghost?: History): void {
  const pen = context(canvas);
  if (!pen || canvas.clientWidth < 4) return;
  if (ghost) draw(pen, canvas, ghost, span, digital, ink("--ghost"), [history, ghost]);
  draw(pen, canvas, history, span, digital, colour, ghost ? [history, ghost] : [history]);
}

function draw(
  pen: CanvasRenderingContext2D,
  canvas: HTMLCanvasElement,
  history: History,
  span: Span,
  digital: boolean,
  colour: string,
  scale: History[],
): void {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const { times, values } = history;
  const x = (time: number) => ((time - span.from) / (span.to - span.from)) * width;
  let first = 0;
  while (first + 1 < times.length && (times[first + 1] as number) <= span.from) first++;
  let [low, high] = [Infinity, -Infinity];
  if (digital) [low, high] = [0, 1];
  else
    for (const { values } of scale)
      for (const value of values) {
        if (value < low) low = value;
        if (value > high) high = value;
      }
  if (!(high > low)) [low, high] = [Number.isFinite(low) ? low - 0.5 : 0, Number.isFinite(high) ? high + 0.5 : 1];
  const y = (value: number) => height - 2 - ((value - low) / (high - low)) * (height - 4);
  if (times.length === 0) return;
  pen.beginPath();
  let last = values[first] as number;
  pen.moveTo(Math.max(0, x(times[first] as number)), y(last));
  for (let i = first + 1; i < times.length && (times[i] as number) <= span.to; i++) {
    const [at, value] = [x(times[i] as number), values[i] as number];
    // A held value; what moves at every picture is a line.
    const steady = digital || (times[i] as number) - (times[i - 1] as number) > 0.2;
    if (steady) pen.lineTo(at, y(last));
    pen.lineTo(at, y(value));
    last = value;
  }
  pen.lineTo(Math.min(width, x(span.to)), y(last));
  pen.strokeStyle = colour;
  pen.lineWidth = 1.5;
  pen.lineJoin = "round";
  pen.stroke();
  if (digital) {
    pen.lineTo(Math.min(width, x(span.to)), height - 2);
    pen.lineTo(Math.max(0, x(times[first] as number)), height - 2);
    pen.closePath();
    pen.globalAlpha = 0.22;
    pen.fillStyle = colour;
    pen.fill();
    pen.globalAlpha = 1;
  }
}
