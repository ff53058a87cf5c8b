// What viewers cost a run: its step times with 0, 1 and 5 of them, and one that never reads.
//
//   KINETWIN_PROGRAM=target/release/kinetwin node view/e2e/viewers.mjs

import { spawn } from "node:child_process";
import { connect } from "node:net";
import { chromium } from "playwright-core";
import { program, root } from "./bench.mjs";

const SECONDS = 15;

/** A run of the line with so many viewers: its summary, and the messages that each was sent in a second. */
async function run(viewers, asleep) {
  const child = spawn(program, ["run", "models/depalletizer", "--view", "--for", `${SECONDS}s`, "--json"], { cwd: root });
  let [out, said] = ["", ""];
  child.stdout.on("data", (data) => (out += data));
  const ended = new Promise((end) => child.on("exit", end));
  const url = await new Promise((found) =>
    child.stderr.on("data", (data) => {
      said += data;
      const address = /view: (http:\S+)/.exec(said)?.[1];
      if (address) found(address);
    }),
  );
  const { host, port } = new URL(url);
  if (asleep) {
    const socket = connect(Number(port), "127.0.0.1");
    socket.on("error", () => {});
    socket.write(`GET /api/stream HTTP/1.1\r\nHost: ${host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n`);
    socket.pause();
  }
  let messages = 0;
  if (viewers > 0) {
    // The description in place of the page: nothing is drawn, and the computer's time is the run's.
    const page = await browser.newPage();
    await page.goto(`${url}api/openapi.json`);
    messages = await page.evaluate(
      ([viewers, seconds]) =>
        new Promise((done) => {
          let count = 0;
          for (let i = 0; i < viewers; i++) {
            const socket = new WebSocket(`ws://${location.host}/api/stream`);
            socket.onmessage = () => count++;
          }
          setTimeout(() => done(count), seconds * 1000);
        }),
      [viewers, SECONDS - 3],
    );
    await page.close();
  }
  await ended;
  return { summary: JSON.parse(out), rate: viewers > 0 ? messages / viewers / (SECONDS - 3) : 0 };
}

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
console.log("| viewers | step p50 | p99 | p99.9 | max, µs | overruns | messages a second each |\n| --- | --- | --- | --- | --- | --- | --- |");
for (const [viewers, asleep] of [[0, false], [1, false], [5, false], [1, true]]) {
  const { summary, rate } = await run(viewers, asleep);
  const { p50, p99, p999, max } = summary.step_us;
  console.log(`| ${viewers}${asleep ? " and one that never reads" : ""} | ${p50} | ${p99} | ${p999} | ${max} | ${summary.overruns} | ${viewers > 0 ? rate.toFixed(0) : "–"} |`);
}
await browser.close();
