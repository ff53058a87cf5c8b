// The HTTP interface, as /api/openapi.json describes it.

import { toast } from "./dom";

export interface Parameter {
  name: string;
  value: number | string | boolean | number[];
  unit: string | null;
  summary: string;
}
export interface Task {
  name: string;
  kind: string;
  summary: string;
  parameters: Parameter[];
}
export interface Device {
  name: string;
  prototype: string;
  tasks: Task[];
  effects: { place: string; kind: string; component: string | null; parameters: Record<string, unknown> }[];
}
export interface Signal {
  name: string;
  type: string;
  direction: "command" | "report";
  kind: "edge" | "level";
  unit: string;
  min: number | null;
  max: number | null;
  device: string;
  property: string;
}
export type Pose = [number, number, number, number, number, number, number];
export type Colour = [number, number, number];
export interface Shape {
  nodes: { name: string; device: number }[];
  bodies: { node: number; mesh: number; place: Pose; colour: Colour }[];
  beams: { name: string; node: number; ends: [number, number, number][]; signal: number | null }[];
  triangles: number;
  parts: { box: Colour; pallet: Colour };
}
export interface Plant {
  model: string;
  name: string;
  mode: "live" | "playback";
  trace: string | null;
  ghost: string | null;
  ends_s: number | null;
  markers: { at_s: number; text: string }[];
  needs_token: boolean;
  has_report: boolean;
  devices: Device[];
  signals: Signal[];
  scene: Shape;
}
export interface State {
  run: number;
  at_s: number;
  speed: number;
  paused: boolean;
  forced: { name: string; value: number; by: string | null }[];
  faults: { signals: { name: string; value: number }[]; drives: string[]; message: boolean };
  viewers: number;
  ended?: boolean;
  connected?: boolean;
  recording?: string | null;
}
export interface Quantiles {
  count: number;
  p50: number | null;
  p99: number | null;
  p999: number | null;
  max: number | null;
}
export interface Statistics {
  at_s: number;
  boxes: { in: number; out: number; lost: number; present: number; removed: number; out_an_hour: number | null };
  pallets: { in: number; out: number; lost: number; present: number; removed: number };
  collisions: number;
  occupancy: Record<string, number | null>;
  steps?: number;
  step_s?: number;
  overruns?: number;
  late_steps?: number;
  step_us?: Quantiles;
  round_trip_us?: Quantiles;
  messages?: { in: number; out: number; lost: number };
  values?: { in: number; out: number };
  server?: string;
  lockstep?: boolean;
  can_be_max?: boolean;
}
export interface Happening {
  number: number;
  at_s: number;
  gravity: "information" | "warning" | "error";
  text: string;
  place: [number, number, number] | null;
}
export interface GapReport {
  answer: string;
  cause: string;
  report: {
    verdict: string;
    where: { device: string; share: number; signals: { name: string; before: number | null; after: number | null; unit: string }[] }[];
    cause: { device: string; effect: string; [other: string]: unknown }[];
    gap: { before: number | null; after: number | null; floor: number | null };
  };
}

/** How this page calls itself to others that force signals. */
export const client = `page-${Math.random().toString(36).slice(2, 7)}`;

const given = new URLSearchParams(location.hash.slice(1)).get("token");
if (given) {
  sessionStorage.setItem("token", given);
  history.replaceState(null, "", location.pathname + location.search);
}

/** What the server refused, and what it says to do. */
export class Refused extends Error {
  constructor(
    readonly status: number,
    text: string,
    readonly hint: string,
  ) {
    super(text);
  }
}

/** Asks the server; throws what it refuses. */
export async function ask<T>(method: string, path: string, body?: unknown): Promise<T> {
  const headers: Record<string, string> = {};
  if (body !== undefined) headers["Content-Type"] = "application/json";
  const token = sessionStorage.getItem("token");
  if (token) headers["Authorization"] = `Bearer ${token}`;
  const response = await fetch(path, { method, headers, body: body === undefined ? null : JSON.stringify(body) });
  const answer = await response.json();
  if (!response.ok) throw new Refused(response.status, answer.error ?? response.statusText, answer.hint ?? "");
  return answer as T;
}

/** Asks, and shows what was refused. Whether it was done. */
export async function tell(method: string, path: string, body?: unknown): Promise<boolean> {
  try {
    await ask(method, path, body);
    return true;
  } catch (error) {
    if (error instanceof Refused) toast(error.message, error.hint);
    else toast("The program does not answer", "look whether it still runs");
    return false;
  }
}

export const signalPath = (name: string) => `/api/signals/${encodeURIComponent(name)}`;
