import { afterEach, expect, test, vi } from "vitest";
import { leafPapers } from "../engine/leaf_papers.ts";
import type { Pile, Surface } from "../engine/shapes.ts";
import { columnPlace } from "../engine/shapes.ts";
import { clock } from "../for_tests/clock.ts";
import { drawAtOnce, drawSharply } from "../for_tests/drawn_when_seen.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";
import type { DrawOptions } from "../stage/book_stage.ts";
import { WebGLStage } from "./webgl_stage.ts";

const shape: BookShape = {
  width: 0.13,
  height: 0.2,
  thickness: 0,
  leaves: 1,
  cover: "none",
  rim: 0,
  cloth: "#6a2a26",
  shadows: 1,
  fromAbove: false,
  tilt: 0,
  margin: 0.03,
  kind: "scan",
  quarterTurned: false,
  alone: 0,
};

drawAtOnce();
drawSharply();

/** One after the other all stages draw on it: what a stage has compiled serves the next one. */
const canvas = document.createElement("canvas");

let close = (): void => {};

/** Opens a stage in place of the one before. */
function newStage(more: Partial<BookShape> = {}, on = canvas): WebGLStage {
  close();
  const stage = new WebGLStage(on, { ...shape, ...more });
  stage.resize(200, 120, 1);
  close = () => {
    stage.destroy(on === canvas);
    close = () => {};
  };
  return stage;
}

afterEach(() => close());

/** Returns a pile of flat pages. */
function flatPile(sign: number): Pile {
  const [columns, layers] = [49, 2];
  const curves = new Float32Array(2 * columns * layers);
  for (let k = 0; k < columns * layers; k++) {
    curves[2 * k] = sign * shape.width * columnPlace(k % columns, columns);
  }
  return { columns, layers, curves };
}

const open: BookPose = {
  left: flatPile(-1),
  right: flatPile(1),
  leaves: [],
  lean: 0,
  frontBoard: Math.PI,
  backBoard: 0,
};

function plainPicture(colour: string): HTMLCanvasElement {
  const picture = document.createElement("canvas");
  picture.width = 64;
  picture.height = 96;
  const context = picture.getContext("2d")!;
  context.fillStyle = colour;
  context.fillRect(0, 0, 64, 96);
  return picture;
}

/** Returns a flat leaf at an angle from lying on the right, radians. */
function standingLeaf(angle: number): Surface {
  const [columns, rows] = [49, 25];
  const positions = new Float32Array(3 * columns * rows);
  const normals = new Float32Array(3 * columns * rows);
  const [across, up] = [Math.cos(angle), Math.sin(angle)];
  for (let k = 0; k < columns * rows; k++) {
    const out = shape.width * columnPlace(k % columns, columns);
    const y = (Math.floor(k / columns) / (rows - 1)) * shape.height;
    positions.set([out * across, y, out * up], 3 * k);
    normals.set([-up, 0, across], 3 * k);
  }
  return { columns, rows, positions, normals, version: 1 };
}

/** Returns the colour where a place is seen, by default halfway up a page that lies flat. */
function colourAt(stage: WebGLStage, x: number, z = 0, how: DrawOptions = {}): number[] {
  stage.draw(how);
  const copy = document.createElement("canvas");
  copy.width = canvas.width;
  copy.height = canvas.height;
  const context = copy.getContext("2d")!;
  context.drawImage(canvas, 0, 0);
  const place = stage.project([x, shape.height / 2, z]);
  return [...context.getImageData(Math.round(place.x), Math.round(place.y), 1, 1).data];
}

test("a flat page of a scan is exactly its own picture", () => {
  const stage = newStage();
  stage.setFace("left", plainPicture("#c08a4b"));
  stage.setFace("right", plainPicture("#fbf5e8"));
  stage.pose(open);
  expect(colourAt(stage, -0.07)).toEqual([0xc0, 0x8a, 0x4b, 255]);
  expect(colourAt(stage, 0.07)).toEqual([0xfb, 0xf5, 0xe8, 255]);
});

test("where a picture is not quite opaque its colour is as bright, drawn on its mesh and on the screen's pixels", () => {
  const stage = newStage();
  stage.setFace("left", plainPicture("rgb(128 128 128 / 0.7)"));
  stage.setFace("right", plainPicture("#fbf5e8"));
  stage.pose(open);
  for (const steady of [false, true]) {
    const [red] = colourAt(stage, -0.07, 0, { steady });
    expect(Math.abs((red ?? 0) - 128), String(steady)).toBeLessThan(3);
  }
});

test("deep among leaves that stand close it is warm and dim, not black", () => {
  const stage = newStage();
  const angle = 1.68;
  stage.pose({ ...open, leaves: [standingLeaf(1.9), standingLeaf(angle), standingLeaf(1.46)] });
  const out = 0.03;
  const [red, green, blue] = colourAt(stage, out * Math.cos(angle), out * Math.sin(angle));
  expect(red).toBeLessThan(150);
  expect(red).toBeGreaterThan(104);
  expect(blue).toBeLessThan(green);
  expect(green).toBeLessThan(red);
});

test("at night the edge of a leaf in the air is seen, and its slope; it comes down as dark as its page", () => {
  const night = "#1c1b1a";
  const stage = newStage({ theme: "night", kind: "typeset" });
  stage.resize(600, 400, 1);
  for (const face of ["left", "right"] as const) stage.setFace(face, plainPicture(night));
  for (const side of ["recto", "verso"] as const) stage.setLeaf(0, side, plainPicture(night));
  const at = (angle: number, out: number): number => {
    const far = out * shape.width;
    stage.pose({ ...open, leaves: [standingLeaf(angle)] });
    return colourAt(stage, far * Math.cos(angle), far * Math.sin(angle))[0];
  };
  // It was 28 on 28.
  for (const angle of [1, 2.1]) {
    expect(at(angle, 0.6)).toBeGreaterThan(36);
    expect(Math.max(at(angle, 0.992), at(angle, 0.996), at(angle, 0.999))).toBeGreaterThan(60);
  }
  for (const angle of [0.01, 3.13]) expect(Math.abs(at(angle, 0.6) - 0x1c)).toBeLessThan(3);
});

/** Returns a level sheet `out` beside the right page at a height, metres, of a layer of loose sheets. */
function looseSheet(layer: number, height: number, out = 0): Surface {
  const { positions, ...sheet } = standingLeaf(0);
  const places = positions.map((x, k) => [x + out, x, height][k % 3]);
  return { ...sheet, positions: places, layer, papers: leafPapers };
}

test("of loose sheets upon each other the uppermost is seen, whichever was torn out first", () => {
  for (const layers of [
    [0, 1],
    [1, 0],
  ]) {
    const stage = newStage();
    stage.setLoose(0, "recto", plainPicture("#000000"));
    stage.setLoose(1, "recto", plainPicture("#ffffff"));
    stage.pose({ ...open, loose: layers.map((layer) => looseSheet(layer, 0.01 + 1e-4 * layer)) });
    const [red] = colourAt(stage, 0.07, 0.01);
    expect(red).toBe(layers[0] > layers[1] ? 0 : 255);
  }
});

test("the uppermost loose sheet shades those under it", () => {
  const stage = newStage();
  for (const k of [0, 1]) stage.setLoose(k, "recto", plainPicture("#ffffff"));
  const under = looseSheet(0, 0.01);
  stage.pose({ ...open, loose: [under] });
  const [alone] = colourAt(stage, 0.1, 0.01);
  stage.pose({ ...open, loose: [under, looseSheet(1, 0.03, -0.04)] });
  const [shaded] = colourAt(stage, 0.1, 0.01);
  expect(shaded).toBeLessThan(alone - 5);
});

/** How far apart a fold's layers are at its free edge, metres: as the engine keeps them. */
const layerGap = 4e-4;

/** Returns a leaf that lies on a side, 1 right or -1 left, folded along a line at u, shut. */
function foldedLeaf(side: 1 | -1, crease: number): Surface {
  const [columns, rows] = [49, 25];
  const fold = Math.round(crease * (columns - 1));
  const positions = new Float32Array(3 * columns * rows);
  const places = new Float32Array(2 * columns * rows);
  const [triangles, parts]: [number[], number[]] = [[], []];
  for (let k = 0; k < columns * rows; k++) {
    const [column, row] = [k % columns, Math.floor(k / columns)];
    const beyond = Math.max(0, column - fold);
    const out = (column - 2 * beyond) / (columns - 1);
    const up = (layerGap * beyond) / (columns - 1 - fold);
    positions.set([side * out * shape.width, (row / (rows - 1)) * shape.height, 1e-4 + up], 3 * k);
    places.set([column / (columns - 1), row / (rows - 1)], 2 * k);
    if (column === columns - 1 || row === rows - 1) continue;
    triangles.push(k, k + 1, k + 1 + columns, k, k + 1 + columns, k + columns);
    for (let half = 0; half < 2; half++) parts.push(column < fold ? 0 : 1);
  }
  const creased = {
    places,
    triangles: Uint32Array.from(triangles),
    parts: Uint16Array.from(parts),
  };
  const normals = positions.map((_, k) => [0, 0, side][k % 3]);
  return { columns, rows, positions, normals, version: 1, creased, papers: leafPapers };
}

/** Returns the red of the pixels halfway up the page from one place across the spine to another. */
function redAcross(stage: WebGLStage, from: number, to: number) {
  stage.draw();
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const pen = copy.getContext("2d")!;
  pen.drawImage(canvas, 0, 0);
  const [a, b] = [from, to].map((x) => stage.project([x, shape.height / 2, 0]));
  const { data } = pen.getImageData(Math.round(a.x), Math.round(a.y), Math.round(b.x - a.x), 1);
  return [...data].filter((_, k) => k % 4 === 0);
}

/** Returns how much darker it is at most about a place than it is 4 mm to either side. */
function shadeAt(stage: WebGLStage, x: number): number {
  const reds = redAcross(stage, x - 0.004, x + 0.004);
  return Math.min(reds[0], reds[reds.length - 1]) - Math.min(...reds);
}

/** Returns a stage on which a millimetre is about 1.5 pixels, all white. */
function whiteStage(): WebGLStage {
  const stage = newStage();
  stage.resize(600, 400, 1);
  for (const face of ["left", "right"] as const) stage.setFace(face, plainPicture("#ffffff"));
  for (const k of [0, 1]) {
    for (const side of ["recto", "verso"] as const) {
      stage.setLeaf(k, side, plainPicture("#ffffff"));
      stage.setLoose(k, side, plainPicture("#ffffff"));
    }
  }
  return stage;
}

test.each([
  ["its own page", 0.75, 0.5],
  ["the other page, over the spine", 0.25, -0.5],
])("white paper folded over onto %s has a shade at its edge", (_, crease, edge) => {
  for (const side of [1, -1] as const) {
    const stage = whiteStage();
    const leaf = foldedLeaf(side, crease);
    stage.pose({ ...open, leaves: [leaf], lying: [leaf], folded: true });
    const shade = shadeAt(stage, side * edge * shape.width);
    // The left is toward the key light, so on that side of paper only the sky is shut out.
    expect(shade).toBeGreaterThan(side === 1 ? 12 : 30);
    expect(shade).toBeLessThan(130);
    // The flap is as bright as its page.
    const [own] = redAcross(stage, side * 0.6 * edge * shape.width, 0.2);
    expect(own).toBeGreaterThan(245);
  }
});

test("a loose sheet has a shade at its edges on a page, on another sheet and on the table", () => {
  const stage = whiteStage();
  stage.pose({ ...open, loose: [looseSheet(0, 1e-4, -0.1), looseSheet(1, 2e-4, -0.06)] });
  const right = shape.width - 0.1;
  expect(shadeAt(stage, right)).toBeLessThan(2);
  expect(shadeAt(stage, right + 0.04)).toBeGreaterThan(12);
  stage.pose({ ...open, loose: [looseSheet(0, 1e-4, -0.1), looseSheet(1, 2e-4, -0.12)] });
  expect(shadeAt(stage, right)).toBeGreaterThan(12);
  expect(shadeAt(stage, right - 0.02)).toBeGreaterThan(12);
  // The table is clear where nothing shades it.
  const beside = () => colourAt(stage, 0.01 + shape.width + 0.0004)[3];
  stage.pose({ ...open, loose: [looseSheet(0, 1e-4, 0.01)] });
  const lying = beside();
  stage.pose(open);
  expect(lying).toBeGreaterThan(beside() + 12);
});

test("as paper comes down its shade draws to its edge", () => {
  const stage = whiteStage();
  const widths = [0.012, 0.006, 0.003, 1e-4].map((height) => {
    stage.pose({ ...open, loose: [looseSheet(0, height, -0.1)] });
    const reds = redAcross(stage, shape.width - 0.1, shape.width - 0.06);
    return reds.filter((red) => red < 240).length;
  });
  expect(widths).toEqual([...widths].sort((a, b) => b - a));
  expect(new Set(widths).size).toBe(widths.length);
});

/** Returns a pile of flat pages on the right of a thickness, metres. */
function thickPile(thickness: number): Pile {
  const pile = flatPile(1);
  for (let k = 0; k < pile.columns; k++) pile.curves[2 * k + 1] = thickness;
  return pile;
}

test("the edges of pages are not seen through a loose sheet that lies over them", () => {
  const stage = whiteStage();
  const thickness = 0.005;
  for (let k = 0; k < 8; k++) {
    // Where pixels lie otherwise about the edge.
    stage.resize(600 + 7 * k, 400, 1);
    const sheet = { ...looseSheet(0, thickness + 1e-4, 0.06), version: k + 1 };
    stage.pose({ ...open, right: thickPile(thickness), loose: [sheet] });
    const reds = redAcross(stage, shape.width - 0.01, shape.width + 0.01);
    expect(Math.max(...reds) - Math.min(...reds), String(reds)).toBeLessThan(8);
  }
});

test("what draws loose sheets is compiled with the frame in which a book is bound that has none yet", () => {
  const compiled = vi.spyOn(WebGL2RenderingContext.prototype, "linkProgram");
  const programs = (loose: readonly Surface[]): number => {
    stage.pose({ ...open, loose });
    compiled.mockClear();
    stage.draw();
    return compiled.mock.calls.length;
  };
  const stage = newStage({}, document.createElement("canvas"));
  const [one, another] = [looseSheet(0, 0.01), looseSheet(1, 0.03, -0.04)];
  for (const sheet of [one, another]) Object.assign(sheet, { thickness: 1e-4 });
  expect(programs([])).toBeGreaterThan(0);
  // Of a book that expects none, as a sheet comes.
  stage.bind(shape);
  expect(programs([])).toBe(0);
  expect(programs([one])).toBeGreaterThan(0);
  stage.bind(shape, true);
  expect(programs([])).toBeGreaterThan(0);
  expect(programs([])).toBe(0);
  expect(programs([one])).toBe(0);
  expect(programs([one, another])).toBe(0);
  compiled.mockRestore();
});

test("a forgotten picture leaves blank paper, and the table is clear", () => {
  const stage = newStage();
  const picture = plainPicture("#000000");
  stage.setFace("right", picture);
  stage.pose(open);
  expect(colourAt(stage, 0.07)).toEqual([0, 0, 0, 255]);
  stage.forget(picture);
  expect(colourAt(stage, 0.07)).toEqual([0xfb, 0xf5, 0xe8, 255]);
  expect(colourAt(stage, -0.5)[3]).toBe(0);
});

test("a line of sight meets the place that it is seen at", () => {
  const stage = newStage({
    thickness: 0.02,
    cover: "hard",
    rim: 0.0032,
  });
  for (const frontBoard of [Math.PI, 1.2, 0]) {
    stage.pose({ ...open, left: null, frontBoard });
    const { origin, direction } = stage.rayAt(57, 83);
    const t = (0.01 - origin[2]) / direction[2];
    const met = stage.project([origin[0] + t * direction[0], origin[1] + t * direction[1], 0.01]);
    expect(met.x).toBeCloseTo(57, 3);
    expect(met.y).toBeCloseTo(83, 3);
  }
});

test("beyond the spine of a page that stands alone nothing is cut off at the canvas's edge", () => {
  for (const alone of [1, -1] as const) {
    const stage = newStage({ alone });
    stage.resize(400, 120, 1);
    stage.pose(open);
    // As far from the spine as the canvas has space.
    expect(colourAt(stage, -0.08 * alone)[3]).toBe(0);
    const half = colourAt(stage, -0.02 * alone)[3];
    expect(half).toBeGreaterThan(60);
    expect(half).toBeLessThan(250);
    expect(colourAt(stage, 0.002 * alone)).toEqual([0xfb, 0xf5, 0xe8, 255]);
    expect(colourAt(stage, 0.07 * alone)).toEqual([0xfb, 0xf5, 0xe8, 255]);
  }
});

test("the shadow on the table ends before the canvas does", () => {
  const stage = newStage({ thickness: 0.02, cover: "hard", rim: 0.0032 });
  stage.pose(open);
  stage.draw();
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const pen = copy.getContext("2d")!;
  pen.drawImage(canvas, 0, 0);
  const { data } = pen.getImageData(0, 0, copy.width, copy.height);
  const alpha = (x: number, y: number) => data[4 * (y * copy.width + x) + 3];
  let shaded = 0;
  for (let x = 0; x < copy.width; x++) {
    for (const y of [0, copy.height - 1]) expect(alpha(x, y)).toBeLessThan(6);
    for (let y = 0; y < copy.height; y++) if (alpha(x, y) > 20 && alpha(x, y) < 200) shaded++;
  }
  for (let y = 0; y < copy.height; y++) {
    for (const x of [0, copy.width - 1]) expect(alpha(x, y)).toBeLessThan(6);
  }
  expect(shaded).toBeGreaterThan(100);
});

test("at rest the canvas has a whole number of pixels for each of the screen: two, where these are large", () => {
  const stage = newStage();
  stage.pose(open);
  stage.draw({ resting: true });
  expect([canvas.width, canvas.height]).toEqual([400, 240]);
  stage.resize(200, 120, 2);
  stage.draw({ resting: true });
  expect([canvas.width, canvas.height]).toEqual([400, 240]);
  stage.resize(200, 120, 1);
  stage.draw();
  expect([canvas.width, canvas.height]).toEqual([200, 120]);
});

test("a lost context comes back with everything on it", async () => {
  const stage = newStage();
  stage.setFace("right", plainPicture("#3366aa"));
  stage.pose(open);
  const before = colourAt(stage, 0.07);
  const loss = canvas.getContext("webgl2")!.getExtension("WEBGL_lose_context")!;
  const lost = new Promise((done) => canvas.addEventListener("webglcontextlost", done));
  loss.loseContext();
  await lost;
  stage.draw();
  const restored = new Promise<void>((done) => {
    stage.onRestored = done;
  });
  // The browser restores a context only after the event has run its course.
  await clock.task();
  loss.restoreContext();
  await restored;
  expect(colourAt(stage, 0.07)).toEqual(before);
});

test("a card without a context says so in one sentence", () => {
  const without = document.createElement("canvas");
  without.getContext = () => null;
  expect(() => new WebGLStage(without, shape)).toThrow(/has no context to give/);
});
