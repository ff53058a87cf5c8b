// End to end: the program, its page in a headless Chromium, and what a commissioning engineer does there.
//
//   node e2e/main.mjs            pictures go to target/view
//   node e2e/main.mjs --write    to docs/view, where the documentation shows them
//   node e2e/main.mjs run        that step alone: run, trace (and after it gap), machine

import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { ask, browse, differing, done, drawn, root, shoot, start, until } from "./bench.mjs";

const folder = mkdtempSync(join(tmpdir(), "kinetwin-view-"));
cpSync(join(root, "models"), join(folder, "models"), { recursive: true });
cpSync(join(root, "signals-maps"), join(folder, "signals-maps"), { recursive: true });
const browser = await browse();
const say = (what) => console.log(`  ${what}`);
let trace;

const wanted = process.argv.slice(2).filter((word) => !word.startsWith("--"));
const steps = [["run", live], ["trace", playback], ["machine", machine], ["gap", gap]].filter(([name]) => wanted.length === 0 || wanted.includes(name));
let failed = 0;
for (const [name, step] of steps) {
  const begun = Date.now();
  console.log(name);
  try {
    await step();
    console.log(`  good, ${((Date.now() - begun) / 1000).toFixed(1)} s`);
  } catch (error) {
    failed++;
    console.error(`  FAILED: ${error.stack}`);
  }
}
await browser.close();
rmSync(folder, { recursive: true, force: true });
if (browser.faults.length > 0) console.error(`the page complained: ${browser.faults.join("\n")}`);
process.exit(failed > 0 || browser.faults.length > 0 ? 1 : 0);

async function live() {
  const run = start(["run", "models/depalletizer", "--view=" + (process.env.KINETWIN_PORT ?? "0")], folder);
  const url = await run.url;
  const state = async () => (await ask(url, "GET", "/api/state")).body;
  const value = async (name) => (await ask(url, "GET", `/api/signals/${name}`)).body.value;
  try {
    const page = await browser.open(url);
    say("the page of a running line is there");

    // It moves: the same place, twice.
    await ask(url, "POST", "/api/run/speed", { factor: 2 });
    await until(async () => (await state()).at_s > 12);
    await ask(url, "POST", "/api/run/pause");
    await page.waitForTimeout(300);
    await drawn(page);
    const robot = await page.evaluate(() => window.kinetwin.world.placeOf("Robot"));
    const view = await page.evaluate(() => document.querySelector(".canvas").getBoundingClientRect().toJSON());
    const around = { x: Math.max(0, view.x + robot.x - 110), y: Math.max(view.y, view.y + robot.y - 110), width: 220, height: 200 };
    const before = await shoot(page, null, around);
    await shoot(page, "run-light");
    const joint = () => page.evaluate(() => [...window.kinetwin.world.bodies.frames].map((frame) => frame.elements.slice(12, 15)).flat());
    const was = await joint();
    await ask(url, "POST", "/api/run/resume");
    await until(async () => (await joint()).some((place, index) => Math.abs(place - was[index]) > 0.3));
    await ask(url, "POST", "/api/run/pause");
    await page.waitForTimeout(300);
    await drawn(page);
    const after = await shoot(page, null, around);
    assert.ok((await differing(page, before, after)) > 200, "the robot is elsewhere in the picture");
    const corner = { x: 4, y: view.y + 4, width: 60, height: 40 };
    assert.equal(await differing(page, await shoot(page, null, corner), await shoot(page, null, corner)), 0, "where nothing is, nothing differs");
    say("it moves, where the robot is");

    // Paused, it stands; a step is a step.
    const at = (await state()).at_s;
    await page.waitForTimeout(400);
    assert.equal((await state()).at_s, at, "paused");
    await page.locator(".view canvas").focus();
    await page.keyboard.press(".");
    await until(async () => Math.abs((await state()).at_s - at - 0.001) < 1e-9);
    await page.keyboard.press("Shift+Period");
    await until(async () => Math.abs((await state()).at_s - at - 0.011) < 1e-9);
    await until(async () => (await page.textContent(".pill")) === "paused");
    await shoot(page, "paused-and-stepped");
    await page.keyboard.press("Space");
    await until(async () => !(await state()).paused);
    say("it pauses and steps, by keys");

    // Pick a device by pointing at it.
    await ask(url, "POST", "/api/run/pause");
    await page.waitForTimeout(200);
    await drawn(page);
    // A point of the picture where it is seen, and nothing before it.
    const hit = await page.evaluate(() => {
      const { world } = window.kinetwin;
      const place = world.placeOf("Pusher1");
      const box = world.canvas.getBoundingClientRect();
      for (let dy = -40; dy <= 40; dy += 4)
        for (let dx = -60; dx <= 60; dx += 4) {
          const [clientX, clientY] = [box.x + place.x + dx, box.y + place.y + dy];
          if (world.at({ clientX, clientY })?.device === "Pusher1") return { x: clientX, y: clientY };
        }
      return null;
    });
    assert.ok(hit, "it is in the picture");
    await page.mouse.click(hit.x, hit.y);
    await until(async () => (await page.locator("header.device h2").textContent()) === "Pusher1", 15);
    await page.selectOption("select[aria-label=Device]", "Conveyor2");
    await until(async () => (await page.textContent("header.device h2")) === "Conveyor2");
    assert.ok((await page.locator(".panel.open .row").count()) >= 8, "its signals");
    await page.evaluate(() => window.kinetwin.world.fit("Conveyor2"));
    await drawn(page);
    await shoot(page, "device");
    await page.evaluate(() => window.kinetwin.world.fit());
    await ask(url, "POST", "/api/run/resume");
    say("a device is picked, and its signals and parameters are there");

    // Force a light barrier, and see the automation react: it stops the belt that the barrier guards.
    await page.keyboard.press("Escape");
    await page.keyboard.press("/");
    await page.keyboard.type("Conveyor8");
    const guarded = await reaction(url, page, value);
    await shoot(page, "forced");
    await page.getByRole("button", { name: "Release all forced signals" }).click();
    await until(async () => (await state()).forced.length === 0);
    say(`a forced signal, and the automation reacted: ${guarded}`);

    // Faults and parts by hand.
    await ask(url, "PUT", "/api/faults/drives/Conveyor3");
    await until(async () => (await value("Conveyor3.velocityActual")) === 0);
    await page.waitForSelector(".banner:not([hidden])");
    await page.getByRole("tab", { name: /Statistics/ }).click();
    await until(async () => (await page.locator(".panel.open .card").count()) >= 8);
    await shoot(page, "statistics-and-a-fault");
    await ask(url, "DELETE", "/api/faults/drives/Conveyor3");
    say("a drive without power stands still, with a banner");

    // Record.
    await page.locator(".view canvas").focus();
    await page.keyboard.press("r");
    await until(async () => (await state()).recording);
    await page.waitForTimeout(1500);
    await page.keyboard.press("r");
    await until(async () => !(await state()).recording);
    trace = readdirSync(folder).find((name) => name.endsWith(".cps.jsonl.zst"));
    assert.ok(trace, "a trace was written");
    say(`recorded to ${trace}`);

    // Reset: from t = 0, and it runs again.
    await page.getByRole("button", { name: "Reset: begin the run anew" }).click();
    await until(async () => (await state()).run === 2 && (await state()).at_s > 0.5);
    say("a reset begins anew");

    // Others that look: dark, a tablet, and one that goes away.
    const dark = await browser.open(url, { scheme: "dark" });
    await dark.waitForTimeout(2500);
    await shoot(dark, "run-dark");
    await contrast(dark);
    await dark.close();
    const tablet = await browser.open(url, { width: 820, height: 1180, touch: true });
    await tablet.waitForTimeout(2500);
    await tablet.getByRole("tab", { name: /Signals/ }).tap();
    await shoot(tablet, "tablet");
    const wide = await tablet.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= 820, `nothing is beyond the edge: ${wide}`);
    await contrast(tablet);
    await tablet.close();
    await until(async () => (await state()).viewers === (process.env.KINETWIN_PAGE ? (await state()).viewers : 1));
    say("in the dark, on a tablet; those who go leave no trace");
    await page.close();
  } finally {
    assert.equal(await run.end(), 0, run.said());
  }
}

/** Forces `Conveyor8`'s barrier until a command of the automation's follows. */
async function reaction(url, page, value) {
  const commands = ["Conveyor7.velocityTarget", "Conveyor7.motorDirection", "Conveyor8.velocityTarget", "Conveyor8.motorDirection", "Pusher1.command", "Pusher2.command", "Pusher3.command"];
  for (const barrier of ["Conveyor8.lightBarrierB", "Conveyor8.lightBarrierA"]) {
    const row = page.locator(`.row[data-signal="${barrier}"]`);
    await row.getByRole("button", { name: `Force ${barrier}` }).click();
    const all = async () => Object.fromEntries(await Promise.all(commands.map(async (name) => [name, await value(name)])));
    const was = await all();
    await page.getByRole("button", { name: `Force ${barrier} to TRUE` }).click();
    await until(async () => (await value(barrier)) === true);
    const end = Date.now() + 12_000;
    while (Date.now() < end) {
      const now = await all();
      const changed = commands.find((name) => now[name] !== was[name]);
      if (changed) {
        await page.waitForSelector(".banner:not([hidden])");
        return `${barrier} TRUE, then ${changed} ${was[changed]} → ${now[changed]}`;
      }
      await page.waitForTimeout(100);
    }
  }
  assert.fail("the automation took no notice");
}

/** Text and ground of every kind that the page has differ enough: 4.5 to 1 (WCAG 2.2, 1.4.3). */
async function contrast(page) {
  const pairs = [["--text", "--ground"], ["--text", "--raised"], ["--text", "--sunk"], ["--quiet", "--raised"], ["--quiet", "--ground"], ["--accent", "--raised"], ["--on-accent", "--accent"], ["--good", "--raised"], ["--bad", "--raised"], ["--bad", "--bad-soft"], ["--warn", "--raised"], ["--warn-text", "--warn-ground"], ["--command", "--raised"], ["--report", "--raised"], ["--accent", "--accent-soft"], ["--text", "--bad-soft"]];
  const found = await page.evaluate((pairs) => {
    const style = getComputedStyle(document.documentElement);
    const light = (name) => {
      const hex = style.getPropertyValue(name).trim();
      const part = (at) => {
        const one = parseInt(hex.slice(at, at + 2), 16) / 255;
        return one <= 0.04045 ? one / 12.92 : ((one + 0.055) / 1.055) ** 2.4;
      };
      return 0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5);
    };
    return pairs.map(([text, ground]) => {
      const [a, b] = [light(text), light(ground)];
      return { pair: `${text} on ${ground}`, ratio: (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) };
    });
  }, pairs);
  const low = found.filter((one) => !(one.ratio >= 4.5));
  assert.deepEqual(low, []);
}

async function playback() {
  // Two seeds of the same line: what a machine measured, and what a model does.
  for (const [seed, file] of [["1", "one.cps.jsonl"], ["2", "two.cps.jsonl"]]) {
    await done(["run", "models/depalletizer", "--speed", "max", "--for", "30s", "--seed", seed, "--record", file], folder);
  }
  const view = start(["view", "one.cps.jsonl", "--model", "models/depalletizer", "--ghost", "two.cps.jsonl", "--listen", process.env.KINETWIN_PORT ?? "0"], folder);
  const url = await view.url;
  const head = async () => (await ask(url, "GET", "/api/playback")).body;
  try {
    const page = await browser.open(url);
    await ask(url, "POST", "/api/playback", { paused: true });
    const bar = page.locator("input.scrub");
    const go = async (seconds) => {
      await bar.evaluate((bar, seconds) => {
        bar.value = seconds;
        bar.dispatchEvent(new Event("input", { bubbles: true }));
      }, seconds);
      await until(async () => Math.abs((await head()).time_s - seconds) < 0.011);
      await page.waitForFunction((seconds) => Math.abs(window.kinetwin.store.now - seconds) < 0.02, seconds);
      await page.waitForTimeout(200);
      await drawn(page);
    };
    const clip = await page.evaluate(() => document.querySelector(".canvas").getBoundingClientRect().toJSON());
    await go(8);
    const early = await shoot(page, null, clip);
    await go(22);
    await shoot(page, "scrub-with-ghost");
    const late = await shoot(page, null, clip);
    await go(8);
    const again = await shoot(page, null, clip);
    assert.ok((await differing(page, early, late)) > 500, "another instant is another picture");
    assert.ok((await differing(page, early, again)) < 60, "the same instant is the same picture");
    say("scrubbed forwards and back; the same instant is the same picture");

    await page.getByRole("button", { name: "Backwards at 1 times" }).click();
    await until(async () => (await head()).time_s < 7);
    assert.equal((await head()).paused, false);
    await page.locator(".view canvas").blur();
    await page.keyboard.press("Space");
    await until(async () => (await head()).paused);
    await page.keyboard.press("End");
    await until(async () => Math.abs((await head()).time_s - (await head()).ends_s) < 0.01);
    say("it plays backwards, stops and goes to its end by keys");
    assert.equal((await ask(url, "POST", "/api/run/pause")).status, 409, "a trace cannot be changed");
    await page.close();
  } finally {
    assert.equal(await view.end(), 0, view.said());
  }
}

// A machine whose robot is slower than the model's: what it reported, and over it what the model does under the same commands.
async function machine() {
  const slow = join(folder, "slow");
  cpSync(join(folder, "models"), join(slow, "models"), { recursive: true });
  cpSync(join(folder, "signals-maps"), join(slow, "signals-maps"), { recursive: true });
  const plant = join(slow, "models/depalletizer/plant.xml");
  const nominal = readFileSync(plant, "utf8");
  const slower = nominal.replace('name="maxVelocityY" value="2.0 m/s"', 'name="maxVelocityY" value="0.6 m/s"');
  assert.notEqual(slower, nominal);
  writeFileSync(plant, slower);
  await done(["run", "models/depalletizer", "--speed", "max", "--for", "20s", "--record", "../machine.cps.jsonl"], slow);
  const view = start(["view", "machine.cps.jsonl", "--model", "models/depalletizer", "--simulated", "--listen", process.env.KINETWIN_PORT ?? "0"], folder);
  const url = await view.url;
  try {
    const page = await browser.open(url);
    const { body } = await ask(url, "GET", "/api/signals/Robot.actualPosY/history");
    const at = (history, time) => history.findLast(([told]) => told <= time)?.[1] ?? 0;
    const times = body.trace.map(([told]) => told).filter((told) => told < 20);
    const apart = (time) => Math.abs(at(body.trace, time) - at(body.ghost, time));
    const widest = times.reduce((best, time) => (apart(time) > apart(best) ? time : best));
    assert.ok(apart(widest) > 0.3, `the model's robot is ahead: ${apart(widest)} m`);
    await ask(url, "POST", "/api/playback", { time_s: widest, paused: true });
    await page.waitForTimeout(500);
    await drawn(page);
    await page.selectOption("select[aria-label=Device]", "Robot");
    for (const signal of ["Robot.YTarget", "Robot.actualPosY"]) await page.getByRole("button", { name: `Pin ${signal} to the strip below` }).first().click();
    await page.waitForTimeout(800);
    await page.evaluate(() => window.kinetwin.world.fit("Robot"));
    await page.waitForTimeout(800);
    await drawn(page);
    const along = () => page.evaluate(() => {
      const { bodies, ghost } = window.kinetwin.world;
      return bodies.frames.map((frame, index) => Math.abs(frame.elements[13] - ghost.frames[index].elements[13]));
    });
    const shown = Math.max(...(await along()));
    assert.ok(Math.abs(shown - apart(widest)) < 0.02, `the bodies are as far apart as the signals: ${shown} m, ${apart(widest)} m`);
    await shoot(page, "measured-and-simulated");
    say(`a machine and its model, ${shown.toFixed(2)} m apart`);
    await page.close();
  } finally {
    assert.equal(await view.end(), 0, view.said());
  }
}

async function gap() {
  cpSync(join(root, "tests/data/gap-report/effect.json"), join(folder, "report.json"));
  const view = start(["view", "one.cps.jsonl", "--model", "models/depalletizer", "--report", "report.json", "--listen", process.env.KINETWIN_PORT ?? "0"], folder);
  const url = await view.url;
  try {
    const { body } = await ask(url, "GET", "/api/report");
    const worst = body.report.where[0];
    const page = await browser.open(url);
    await page.waitForTimeout(1500);
    await ask(url, "POST", "/api/playback", { time_s: 15, paused: true });
    await page.waitForTimeout(500);
    await drawn(page);
    await shoot(page, "gap");
    await page.getByRole("button", { name: `Open the plots of ${worst.device}` }).click();
    const inside = page.frameLocator("dialog.report iframe");
    await inside.locator("h1").waitFor();
    await page.waitForTimeout(500);
    await shoot(page, "gap-report");
    await page.keyboard.press("Escape");
    await page.waitForFunction(() => !document.querySelector("dialog[open]"));
    say(`${worst.device} holds ${(worst.share * 100).toFixed(0)} % of the gap; a click opens the report`);
    await page.close();
  } finally {
    assert.equal(await view.end(), 0, view.said());
  }
}
