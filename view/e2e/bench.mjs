// The test bench: a program, a browser on its page, and what is asked of both.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { small } from "./picture.mjs";

export const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
export const program = process.env.KINETWIN_PROGRAM ?? join(root, "target/ci/kinetwin");
/** Where pictures go: `--write` puts them under docs/, where the documentation shows them. */
const pictures = process.argv.includes("--write") ? join(root, "docs/view") : join(root, "target/view");
/** A page being written, in place of the one in the program: `vite preview` hands the interface on. */
const instead = process.env.KINETWIN_PAGE;

mkdirSync(pictures, { recursive: true });

/** Starts the program; its page's address, once it is printed. */
export function start(args, folder) {
  const child = spawn(program, args, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  let said = "";
  const url = new Promise((found, failed) => {
    const hear = (data) => {
      said += data;
      const address = /view: (http:\S+)/.exec(said)?.[1];
      if (address) found(address);
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("exit", (code) => failed(new Error(`the program ended with ${code}: ${said}`)));
  });
  const end = () =>
    new Promise((ended) => {
      if (child.exitCode !== null) return ended(child.exitCode);
      child.on("exit", ended);
      child.kill("SIGINT");
    });
  return { url, end, said: () => said };
}

/** Runs the program to its end. */
export function done(args, folder) {
  return new Promise((good, bad) => {
    const child = spawn(program, args, { cwd: folder, stdio: ["ignore", "ignore", "pipe"] });
    let said = "";
    child.stderr.on("data", (data) => (said += data));
    child.on("exit", (code) => (code === 0 ? good() : bad(new Error(`${args.join(" ")} ended with ${code}: ${said}`))));
  });
}

/** Asks the interface. */
export async function ask(url, method, path, body) {
  const answer = await fetch(new URL(path, url), { method, headers: { "Content-Type": "application/json" }, body: body && JSON.stringify(body) });
  return { status: answer.status, body: await answer.json() };
}

/** Asks until it is so. */
export async function until(what, seconds = 40) {
  const end = Date.now() + seconds * 1000;
  let last;
  while (Date.now() < end) {
    last = await what();
    if (last) return last;
    await new Promise((later) => setTimeout(later, 100));
  }
  assert.fail(`it never became so: ${what}`);
}

export async function browse() {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    // Software rendering, and no sandbox within a container.
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  });
  const faults = [];
  return {
    faults,
    close: () => browser.close(),
    /** A page on `url`, once it has drawn. */
    async open(url, { width = 1280, height = 720, scheme = "light", touch = false } = {}) {
      const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, hasTouch: touch });
      const page = await context.newPage();
      page.setDefaultTimeout(60_000);
      page.on("pageerror", (error) => faults.push(error.message));
      page.on("console", (message) => message.type() === "error" && !/Failed to load resource|ERR_CONNECTION_REFUSED/.test(message.text()) && faults.push(message.text()));
      await page.goto(instead ?? url, { waitUntil: "commit" });
      await page.waitForFunction(() => window.kinetwin && Number(document.documentElement.dataset.pictures) > 1);
      return page;
    },
  };
}

/** Waits until what came in by now has been drawn. */
export async function drawn(page) {
  const before = await page.evaluate(() => Number(document.documentElement.dataset.pictures));
  await page.evaluate(() => (window.kinetwin.world.stale = true));
  await page.waitForFunction((before) => Number(document.documentElement.dataset.pictures) > before, before);
}

/** Takes a picture of the page; where it is for the documentation, under its name. */
export async function shoot(page, name, clip) {
  const png = await page.screenshot({ clip });
  if (name) {
    const picture = await small(page, png);
    assert.ok(picture.length < 200_000, `${name}.png has ${picture.length} bytes`);
    writeFileSync(join(pictures, `${name}.png`), picture);
  }
  return png;
}

/** How many pixels of two pictures differ by more than a shade. */
export function differing(page, a, b) {
  return page.evaluate(
    async ([a, b]) => {
      const pixels = async (png) => {
        const bytes = Uint8Array.from(atob(png), (c) => c.charCodeAt(0));
        const picture = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
        const canvas = new OffscreenCanvas(picture.width, picture.height);
        const pen = canvas.getContext("2d");
        pen.drawImage(picture, 0, 0);
        return pen.getImageData(0, 0, picture.width, picture.height).data;
      };
      const [one, other] = [await pixels(a), await pixels(b)];
      let count = 0;
      for (let i = 0; i < one.length; i += 4) if (Math.abs(one[i] - other[i]) + Math.abs(one[i + 1] - other[i + 1]) + Math.abs(one[i + 2] - other[i + 2]) > 40) count++;
      return count;
    },
    [a.toString("base64"), b.toString("base64")],
  );
}
