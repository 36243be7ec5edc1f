/**
 * Draws the examples' pictures anew: a bay by the hour, and a comic without
 * words. Each is an SVG made here, set as WebP by a real Chromium.
 *
 *   node examples/pictures/make.mjs
 */
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "../../scripts/chromium.mjs";

/** The sky's upper and lower colour, and the land's, at eight hours of a day. */
const hours = [
  ["6:00", "#5d6d9b", "#f6c1a0", "#4d4a63"],
  ["8:00", "#8ab6d6", "#fbe6c4", "#5f7463"],
  ["10:00", "#6fb1e0", "#e3f2f4", "#5d8a5c"],
  ["12:00", "#4fa3e3", "#dff3fb", "#5a9a55"],
  ["15:00", "#5aa5d9", "#f2eed8", "#6b9150"],
  ["18:00", "#7b88b8", "#ffc27a", "#6a6a4f"],
  ["20:00", "#3b3a66", "#e8745a", "#38344f"],
  ["23:00", "#0e1531", "#33406e", "#141a30"],
];

function bay(k) {
  const [hour, high, low, land] = hours[k];
  const [x, y] = [90 + k * 60, 420 - Math.sin((Math.PI * (k + 0.4)) / 7.6) * 290];
  const isNight = k === 7;
  const stars = Array.from({ length: isNight ? 60 : 0 }, (_, i) => {
    const [sx, sy] = [(i * 197) % 600, (i * 131) % 430];
    return `<circle cx="${sx}" cy="${sy}" r="${1 + (i % 3) * 0.5}" fill="#fff" opacity="0.8"/>`;
  });
  const lamp = k > 5 ? `<path d="M462 392 L0 330 V450 Z" fill="#ffe9a8" opacity="0.25"/>` : "";
  return svg(
    600,
    800,
    `<defs><linearGradient id="sky" x2="0" y2="1"><stop stop-color="${high}"/><stop offset="0.62" stop-color="${low}"/></linearGradient></defs>
    <rect width="600" height="800" fill="url(#sky)"/>${stars.join("")}
    <circle cx="${isNight ? 430 : x}" cy="${isNight ? 150 : y}" r="38" fill="${isNight ? "#f4efd8" : "#fff3c9"}"/>
    <rect y="490" width="600" height="310" fill="${high}"/>
    <path d="M0 490 H600 M40 530 H220 M300 545 H560 M90 580 H330" stroke="${low}" stroke-width="4" opacity="0.5"/>
    <path d="M0 490 C120 400 210 430 330 490 Z" fill="${land}" opacity="0.55"/>${lamp}
    <path d="M600 380 C520 410 470 470 380 492 H600 Z" fill="${land}"/>
    <path d="M446 480 L454 400 H472 L480 480 Z" fill="#fbf5e8"/><path d="M450 440 H476 L478 460 H448 Z" fill="#a33b2b"/><rect x="453" y="384" width="20" height="16" fill="${k > 5 ? "#ffe9a8" : "#444"}"/>
    <path d="M0 660 C180 580 330 720 600 640 V800 H0 Z" fill="${land}"/>
    <path d="M0 730 C220 660 380 760 600 710 V800 H0 Z" fill="#000" opacity="0.25"/>
    <text x="40" y="762" font-family="Georgia, serif" font-size="44" fill="#fff">${hour}</text>`,
  );
}

const cat = (x, y, size, look = 0) =>
  `<g transform="translate(${x} ${y}) scale(${size})"><path d="M-34 10 L-30 -40 L-8 -24 H8 L30 -40 L34 10 C34 38 -34 38 -34 10 Z M-26 30 C-44 100 44 100 26 30" fill="#111"/>
  <circle cx="-13" cy="2" r="9" fill="#fff"/><circle cx="13" cy="2" r="9" fill="#fff"/><circle cx="${-13 + look}" cy="3" r="4" fill="#111"/><circle cx="${13 + look}" cy="3" r="4" fill="#111"/>
  <path d="M-4 16 H4 L0 20 Z" fill="#fff"/><path d="M28 84 C70 86 60 50 74 46" fill="none" stroke="#111" stroke-width="8" stroke-linecap="round"/></g>`;
const leaf = (x, y, size, turn) =>
  `<g transform="translate(${x} ${y}) rotate(${turn}) scale(${size})"><path d="M0 -40 C34 -20 30 22 0 40 C-30 22 -34 -20 0 -40 Z" fill="#fff" stroke="#111" stroke-width="5"/><path d="M0 -30 V62 M0 -6 L14 -18 M0 -6 L-14 -18 M0 14 L14 2 M0 14 L-14 2" fill="none" stroke="#111" stroke-width="4"/></g>`;
const speed = (x, y) =>
  Array.from({ length: 36 }, (_, i) => {
    const [c, s] = [Math.cos((i * Math.PI) / 18), Math.sin((i * Math.PI) / 18)];
    const near = 90 + (i % 3) * 25;
    return `<path d="M${x + c * near} ${y + s * near} L${x + c * 600} ${y + s * 600}" stroke="#111" stroke-width="${2 + (i % 4)}"/>`;
  }).join("");
const dots = `<rect width="600" height="800" fill="url(#dots)"/>`;
const shout = (x, y, word) =>
  `<path d="M${x - 46} ${y} C${x - 46} ${y - 66} ${x + 46} ${y - 66} ${x + 46} ${y} C${x + 46} ${y + 66} ${x - 46} ${y + 66} ${x - 46} ${y} Z" fill="#fff" stroke="#111" stroke-width="4"/><text x="${x}" y="${y + 24}" text-anchor="middle" font-family="sans-serif" font-weight="800" font-size="68">${word}</text>`;

/** A panel: where it is on its page, and what is drawn in it. */
const panel = (x, y, width, height, drawn) =>
  `<svg x="${x}" y="${y}" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}">${drawn}<rect width="${width}" height="${height}" fill="none" stroke="#111" stroke-width="8"/></svg>`;

/** The comic, from its cover on; it is read from the right. */
const comic = [
  `<rect width="520" height="740" fill="#d9432f"/>${leaf(260, 230, 3.4, 24)}${cat(260, 520, 1.9)}`,
  panel(30, 30, 460, 320, dots + cat(230, 190, 1.3, 0)) +
    panel(270, 370, 220, 340, leaf(120, 120, 1.2, 30)) +
    panel(30, 370, 220, 340, cat(110, 170, 1.1, 5) + shout(160, 70, "?")),
  panel(30, 30, 220, 330, leaf(110, 80, 1, 70) + leaf(110, 240, 1, -40)) +
    panel(270, 30, 220, 330, dots + cat(110, 160, 1.1, -5)) +
    panel(30, 380, 460, 330, speed(230, 165) + cat(230, 150, 1.2, 0)),
  panel(30, 30, 460, 680, speed(230, 330) + leaf(330, 130, 1.6, 50) + cat(190, 380, 2, 6)),
  panel(270, 30, 220, 220, leaf(110, 110, 1.4, 100)) +
    panel(30, 30, 220, 220, cat(110, 110, 1, 6) + shout(180, 60, "!")) +
    panel(30, 270, 460, 440, dots + leaf(330, 110, 1.5, -60) + cat(170, 250, 1.8, 5)),
  panel(30, 30, 460, 200, leaf(90, 100, 1, 80) + leaf(230, 100, 1, 20) + leaf(370, 100, 1, -50)) +
    panel(30, 250, 460, 460, speed(230, 230) + cat(230, 200, 2) + leaf(230, 90, 1, 90)),
  panel(30, 30, 460, 680, dots + cat(230, 330, 2.6) + leaf(236, 175, 1.7, 70)),
  `<rect width="520" height="740" fill="#d9432f"/>${leaf(260, 370, 2.2, -30)}`,
].map((drawn) =>
  svg(
    520,
    740,
    `<defs><pattern id="dots" width="10" height="10" patternUnits="userSpaceOnUse"><circle cx="5" cy="5" r="2" fill="#999"/></pattern></defs><rect width="520" height="740" fill="#fff"/>${drawn}`,
  ),
);

function svg(width, height, drawn) {
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}">${drawn}</svg>`;
}

const browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
const page = await browser.newPage();
const books = { hours: hours.map((_, k) => bay(k)), comic };
for (const [name, drawings] of Object.entries(books)) {
  const folder = join(import.meta.dirname, name);
  mkdirSync(folder, { recursive: true });
  for (const [k, drawing] of drawings.entries()) {
    const webp = await page.evaluate(async (source) => {
      const image = new Image();
      image.src = `data:image/svg+xml,${encodeURIComponent(source)}`;
      await image.decode();
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [image.width, image.height];
      canvas.getContext("2d").drawImage(image, 0, 0);
      return canvas.toDataURL("image/webp", 0.6).split(",")[1];
    }, drawing);
    writeFileSync(join(folder, `${k + 1}.webp`), Buffer.from(webp, "base64"));
  }
}
await browser.close();
