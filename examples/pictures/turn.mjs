/**
 * Makes the photographs of a turn that 12-models.html shows: pictures/turn/01.webp
 * to 24.webp. No camera took them: the viewer's own sheet is turned, lit as in a
 * book, and its leaf of bare paper is drawn by itself, with its shadow, as seen
 * through a camera where a reader's eyes are. Each is then put right as a
 * photographer puts right a picture of a table: what lies on the pages lies in it
 * where it lies on the pages. Needs the built viewer and a Chromium.
 *
 *   node examples/pictures/turn.mjs
 */
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "../../scripts/chromium.mjs";
import { serve } from "../serve.mjs";

const turn = {
  /** Photographs. */
  count: 24,
  /** Width and height of one, pixels. */
  size: [800, 1120],
  quality: 0.82,
  /** Width and height of the leaf, metres: of books/moby-dick.pdf. */
  leaf: [0.14, 0.21],
  /** Degrees over the table, and metres from the middle of the book, from where it is seen. */
  elevation: 69,
  distance: 0.85,
};

const out = join(import.meta.dirname, "turn");

/** Runs in the page: every photograph as base64 of its file. */
async function photograph({ count, size, quality, leaf, elevation, distance }) {
  const { LeafStage } = await import("/packages/turnleaf/dist/leaf-stage.js");
  const { LooseLeaf } = await import("/packages/turnleaf/dist/models.js");
  const { Matrix4, Matrix3, PerspectiveCamera } = await import("three");
  const [width, height] = leaf;
  const canvas = new OffscreenCanvas(1, 1);
  const stage = new LeafStage(canvas, { width, height });
  stage.resize(...size, 1);

  // The camera, and what puts its picture right: the plane of the pages fills it from edge to edge.
  const camera = new PerspectiveCamera(20, 1, 0.1, 5);
  const angle = (elevation * Math.PI) / 180;
  camera.up.set(0, Math.sin(angle), Math.cos(angle));
  camera.position.set(0, height / 2 - distance * Math.cos(angle), distance * Math.sin(angle));
  camera.lookAt(0, height / 2, 0);
  camera.updateMatrixWorld();
  const seen = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  const s = seen.elements;
  const ofPlane = new Matrix3(s[0], s[4], s[12], s[1], s[5], s[13], s[3], s[7], s[15]);
  const half = (width * size[1]) / size[0];
  const wanted = new Matrix3(1 / width, 0, 0, 0, 1 / half, -height / 2 / half, 0, 0, 1);
  const m = wanted.multiply(ofPlane.invert()).elements;
  const right = new Matrix4().set(
    ...[m[0], m[3], 0, m[6]],
    ...[m[1], m[4], 0, m[7]],
    ...[0, 0, 1, 0],
    ...[m[2], m[5], 0, m[8]],
  );
  const projection = right.multiply(camera.projectionMatrix);
  stage.scene.onBeforeRender = (_renderer, _scene, eye) => {
    eye.matrixWorld.copy(camera.matrixWorld);
    eye.matrixWorldInverse.copy(camera.matrixWorldInverse);
    eye.projectionMatrix.copy(projection);
  };

  // When each fraction of the turn is done first.
  const grid = [49, 33];
  const sheet = await LooseLeaf.create({ model: "sheet", width, height, points: grid });
  const fraction = ({ positions }) => {
    let sum = 0;
    for (let row = 1; row <= grid[1]; row++) {
      const at = 3 * (row * grid[0] - 1);
      sum += Math.atan2(Math.max(positions[at + 2], 0), positions[at]);
    }
    return sum / (grid[1] * Math.PI);
  };
  const [ground, leftPage, rightPage, recto, verso] = stage.scene.children;
  const pen = new OffscreenCanvas(...size).getContext("2d", { willReadFrequently: true });
  /** What is drawn of these alone, colours multiplied by alpha, from 0 to 1. */
  const drawn = (...parts) => {
    for (const part of [ground, leftPage, rightPage, recto, verso]) {
      part.visible = parts.includes(part);
    }
    stage.draw();
    pen.clearRect(0, 0, ...size);
    pen.drawImage(canvas, 0, 0);
    const { data } = pen.getImageData(0, 0, ...size);
    return Float32Array.from(data, (value, k) =>
      k % 4 === 3 ? value / 255 : (value / 255) * (data[k | 3] / 255),
    );
  };
  sheet.update();
  stage.show(sheet.surface());
  const bare = drawn(leftPage, rightPage);
  sheet.play("corner", "right", 1.2);
  const photographs = [];
  for (let step = 0; photographs.length < count && step < 1200; step++) {
    sheet.update();
    const surface = sheet.surface();
    const isLast = !sheet.playing && step > 900;
    if (fraction(surface) >= photographs.length / (count - 1) - 1e-3 || isLast) {
      stage.show(surface);
      const paper = drawn(recto, verso);
      const shaded = drawn(leftPage, rightPage);
      const picture = pen.createImageData(...size);
      for (let k = 0; k < paper.length; k += 4) {
        // What the pages lose of their light is the shadow's: the darkest film that leaves that.
        const through = [0, 1, 2].map((c) => Math.min(1, shaded[k + c] / (bare[k + c] || 1)));
        const shade = bare[k + 3] < 0.99 ? 0 : 1 - Math.max(...through);
        const film = shade < 0.012 ? 0 : shade;
        const alpha = paper[k + 3] + (1 - paper[k + 3]) * film;
        for (let c = 0; c < 3; c++) picture.data[k + c] = (255 * paper[k + c]) / (alpha || 1);
        picture.data[k + 3] = 255 * alpha;
      }
      pen.putImageData(picture, 0, 0);
      const blob = await pen.canvas.convertToBlob({ type: "image/webp", quality });
      const bytes = new Uint8Array(await blob.arrayBuffer());
      photographs.push(btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join("")));
      continue;
    }
    sheet.advance(1 / 480);
  }
  return photographs;
}

const { url, stop } = await serve(0);
const browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
try {
  const page = await browser.newPage();
  // Its import map says where three.js is.
  await page.goto(`${url}12-models.html`);
  const photographs = await page.evaluate(photograph, turn);
  if (photographs.length !== turn.count) throw new Error("The leaf did not turn.");
  mkdirSync(out, { recursive: true });
  for (const [k, base64] of photographs.entries()) {
    const name = `${String(k + 1).padStart(2, "0")}.webp`;
    writeFileSync(join(out, name), Buffer.from(base64, "base64"));
  }
  console.log(`examples/pictures/turn: ${photographs.length} pictures`);
} finally {
  await browser.close();
  await stop();
}
