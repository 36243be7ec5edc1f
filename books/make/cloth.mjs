/**
 * Book cloth as a small picture: threads of uneven thickness crossing over and
 * under. Nothing in it repeats, so that it makes no moire when it is scaled.
 */
import { zlibSync } from "fflate";
import { BLEED, COLOUR, num, PAGE } from "./measures.mjs";
import { noise } from "./plates/noise.mjs";

const WIDE = 480;
const HIGH = 720;
const LEVELS = 12;
const DEPTH = 0.1; // how far the shade goes from the ground, either way

/** Shade of a thread point in [-1, 1]: warp runs down, weft across, slubs here and there. */
function shade(x, y) {
  const warp = noise(x * 0.52, y * 0.05, 11) - 0.5;
  const weft = noise(x * 0.05, y * 0.52, 23) - 0.5;
  const over = noise(x * 0.5, y * 0.5, 37) - 0.5;
  const slub = Math.max(0, noise(x * 0.012, y * 0.33, 51) - 0.72) * 1.6;
  const rib = Math.max(0, noise(x * 0.33, y * 0.012, 53) - 0.74) * 1.4;
  const wear = noise(x * 0.008, y * 0.008, 71) - 0.5;
  return warp * 0.75 + weft * 0.85 + over * 0.45 + slub + rib + wear * 0.35;
}

/** The cloth as an indexed picture, made once for both boards. */
function picture(paper) {
  if (paper.cloth) return paper.cloth;
  const packed = new Uint8Array((WIDE / 2) * HIGH);
  for (let y = 0; y < HIGH; y++) {
    for (let x = 0; x < WIDE; x++) {
      const v = Math.round((shade(x, y) * 0.5 + 0.5) * (LEVELS - 1));
      packed[(y * WIDE + x) >> 1] |= Math.min(LEVELS - 1, Math.max(0, v)) << (x % 2 ? 0 : 4);
    }
  }
  const ref = paper.doc.ref({
    Type: "XObject",
    Subtype: "Image",
    Width: WIDE,
    Height: HIGH,
    BitsPerComponent: 4,
    ColorSpace: ["Indexed", "DeviceRGB", LEVELS - 1, palette()],
    Interpolate: true,
    Filter: "FlateDecode",
  });
  ref.end(Buffer.from(zlibSync(packed, { level: 9 })));
  paper.cloth = ref;
  return ref;
}

function palette() {
  const base = [1, 3, 5].map((i) => Number.parseInt(COLOUR.cloth.slice(i, i + 2), 16));
  const bytes = [];
  for (let i = 0; i < LEVELS; i++) {
    const t = (i / (LEVELS - 1)) * 2 - 1;
    for (const c of base)
      bytes.push(Math.max(0, Math.min(255, Math.round(c * (1 + t * DEPTH * 2)))));
  }
  return Buffer.from(bytes);
}

/** Cover the whole page with cloth. */
export function boardCloth(paper) {
  const image = picture(paper);
  paper.doc.page.xobjects.Cloth = image;
  const [w, h] = [PAGE.width + 2 * BLEED, PAGE.height + 2 * BLEED];
  paper.op(`q ${num(w)} 0 0 ${num(-h)} ${-BLEED} ${num(h - BLEED)} cm /Cloth Do Q`);
}
