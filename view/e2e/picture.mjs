// A screenshot as a picture of 256 colours: a third of the size, and nobody sees the difference.

import { deflateSync } from "node:zlib";

/** The pixels of a PNG, reduced to a palette, by the page's own canvas. */
async function reduced(page, png) {
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const picture = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const canvas = new OffscreenCanvas(picture.width, picture.height);
    const pen = canvas.getContext("2d");
    pen.drawImage(picture, 0, 0);
    const { data } = pen.getImageData(0, 0, picture.width, picture.height);
    const counts = new Map();
    for (let i = 0; i < data.length; i += 4) {
      const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
      counts.set(colour, (counts.get(colour) ?? 0) + 1);
    }
    // Of colours that are alike the most frequent stands for all.
    const cells = new Map();
    for (const [colour, count] of counts) {
      const cell = ((colour >> 20) << 8) | (((colour >> 12) & 15) << 4) | ((colour >> 4) & 15);
      const best = cells.get(cell);
      if (!best) cells.set(cell, { colour, most: count, count });
      else {
        best.count += count;
        if (count > best.most) [best.colour, best.most] = [colour, count];
      }
    }
    const frequent = [...counts].sort((a, b) => b[1] - a[1]).slice(0, 96).map(([colour]) => colour);
    const spread = [...cells.values()].sort((a, b) => b.count - a.count).map((cell) => cell.colour);
    const palette = [...new Set([...frequent, ...spread])].slice(0, 256);
    const nearest = new Map();
    const find = (colour) => {
      const [r, g, b] = [colour >> 16, (colour >> 8) & 255, colour & 255];
      let [best, least] = [0, Infinity];
      palette.forEach((other, index) => {
        const far = ((other >> 16) - r) ** 2 + (((other >> 8) & 255) - g) ** 2 + ((other & 255) - b) ** 2;
        if (far < least) [best, least] = [index, far];
      });
      return best;
    };
    const out = new Uint8Array(data.length / 4);
    for (let i = 0; i < out.length; i++) {
      const colour = (data[i * 4] << 16) | (data[i * 4 + 1] << 8) | data[i * 4 + 2];
      let index = nearest.get(colour);
      if (index === undefined) nearest.set(colour, (index = find(colour)));
      out[i] = index;
    }
    let text = "";
    for (let i = 0; i < out.length; i += 8192) text += String.fromCharCode(...out.subarray(i, i + 8192));
    return { width: picture.width, height: picture.height, palette, pixels: btoa(text) };
  }, png.toString("base64"));
}

const CRC = Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; k++) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});

function chunk(kind, data) {
  const body = Buffer.concat([Buffer.from(kind, "latin1"), data]);
  let crc = 0xffffffff;
  for (const byte of body) crc = CRC[(crc ^ byte) & 255] ^ (crc >>> 8);
  const out = Buffer.alloc(body.length + 8);
  out.writeUInt32BE(data.length, 0);
  body.copy(out, 4);
  out.writeUInt32BE((crc ^ 0xffffffff) >>> 0, body.length + 4);
  return out;
}

/** The PNG with a palette (PNG specification, third edition, colour type 3). */
export async function small(page, png) {
  const { width, height, palette, pixels } = await reduced(page, png);
  const rows = Buffer.from(pixels, "base64");
  const raw = Buffer.alloc((width + 1) * height);
  for (let y = 0; y < height; y++) rows.copy(raw, y * (width + 1) + 1, y * width, (y + 1) * width);
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 3, 0, 0, 0], 8);
  const colours = Buffer.from(palette.flatMap((colour) => [colour >> 16, (colour >> 8) & 255, colour & 255]));
  const signature = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);
  return Buffer.concat([signature, chunk("IHDR", head), chunk("PLTE", colours), chunk("IDAT", deflateSync(raw, { level: 9 })), chunk("IEND", Buffer.alloc(0))]);
}
