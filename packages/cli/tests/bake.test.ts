import { existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { type Accessor, type Node, NodeIO } from "@gltf-transform/core";
import { KHRMeshQuantization } from "@gltf-transform/extensions";
import { validateBytes } from "gltf-validator";
import { decodeTurn } from "turnleaf/keyframes";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { parseCommand } from "../src/arguments.ts";
import { png } from "./books.ts";
import { folderOf, run } from "./command.ts";

let folder: ReturnType<typeof folderOf>;
const at = (name: string): string => join(folder.path, name);
const options = ["--stock", "office", "--seconds", "0.4", "--size", "140x210"];

beforeAll(() => {
  folder = folderOf({ "front.png": png(6, 9), "back.png": png(4, 6), "page.webp": "RIFF1234WEBP" });
});
afterAll(() => folder.remove());

interface Baked {
  readonly model: string;
  readonly fps: number;
  readonly u: readonly number[];
  readonly v: readonly number[];
  readonly frames: readonly (readonly number[])[];
  /** Of a creased leaf. */
  readonly places: readonly number[];
  readonly triangles: readonly number[];
  readonly parts: readonly number[];
}

/** What was baked, by its arguments: turns are simulated in seconds. */
const baked = new Map<string, Promise<Buffer>>();

/** Bakes a turn with the built command, once for all tests. */
function bake(ending: string, ...args: string[]): Promise<Buffer> {
  const name = `${args.join(" ")}.${ending}`;
  const made = baked.get(name) ?? bakeAnew(`${baked.size}.${ending}`, args);
  baked.set(name, made);
  return made;
}

async function bakeAnew(file: string, args: readonly string[]): Promise<Buffer> {
  const ended = await run("bake", ...options, ...args, "--out", at(file));
  expect(ended.stderr.replace(/^\d+ % .*\n/gm, "")).toBe("");
  expect(ended.status).toBe(0);
  return readFileSync(at(file));
}

const bakeJson = async (...args: string[]): Promise<Baked> =>
  JSON.parse((await bake("json", ...args)).toString());

/** Converts x, y, z to glTF's axes. */
const turned = ([x = 0, y = 0, z = 0]: readonly number[]): number[] => [x, z, -y];

/** Arguments of pictures on both sides, if there are any. */
const imagesOf = ([front, back]: readonly string[]): string[] =>
  front && back ? ["--front", at(front), "--back", at(back)] : [];

/** Arguments of a page whose corner is folded over, and of one that is folded in three. */
const dogEar = ["--crease", "0.6,0 1,0.27 160"];
const letter = ["--crease", "0.67,0 0.67,1 165", "--crease", "0.33,0 0.33,1 165"];
/** Arguments of the folded corner that several tests look at. */
const folded = ["--model", "sheet", "--gesture", "fold", "--points", "14x20", ...dogEar];

describe("glTF", () => {
  it.each([
    ["sheet", "corner", [], []],
    ["cone", "edge", ["front.png", "back.png"], []],
    ["sheet", "fold", ["front.png", "back.png"], dogEar],
    ["sheet", "corner", [], dogEar],
  ])(
    "of %s by its %s passes the validator and holds the turn within the tolerance",
    async (model, gesture, pictures, creases) => {
      const args = ["--model", model, "--gesture", gesture, "--points", "14x20", ...creases];
      const bytes = new Uint8Array(await bake("glb", ...args, ...imagesOf(pictures)));

      const report = await validateBytes(bytes);
      expect(report.issues).toMatchObject({ numErrors: 0, numWarnings: 0 });
      expect(report.info.animationCount).toBe(1);

      const io = new NodeIO().registerExtensions([KHRMeshQuantization]);
      const root = (await io.readBinary(bytes)).getRoot();
      const [node] = root.listNodes() as [Node];
      const primitives = node.getMesh()?.listPrimitives() ?? [];
      expect(primitives.map((primitive) => primitive.getMaterial()?.getName())).toEqual([
        "recto",
        "verso",
      ]);
      expect(root.listTextures().map((texture) => texture.getMimeType())).toEqual(
        pictures.map(() => "image/png"),
      );
      const channel = root.listAnimations()[0]?.listChannels()[0];
      const times = channel?.getSampler()?.getInput()?.getArray() ?? [];
      const weights = channel?.getSampler()?.getOutput()?.getArray() ?? [];

      const turn = await bakeJson(...args, "--fps", "120");
      const [scale] = node.getScale();
      const base = primitives[0]?.getAttribute("POSITION") as Accessor;
      const targets = primitives[0]?.listTargets() ?? [];
      if (creases.length === 0) expect(base.getCount()).toBe(280);
      else expect(base.getCount()).toBeGreaterThan(284);
      let worst = 0;
      for (const [frame, positions] of turn.frames.entries()) {
        const fraction = weightsAt(times, weights, frame / 120);
        for (let point = 0; point < 280; point++) {
          const place: number[] = base.getElement(point, []);
          for (const [k, weight] of fraction) {
            const move: number[] =
              targets[k]?.getAttribute("POSITION")?.getElement(point, []) ?? [];
            for (const axis of [0, 1, 2])
              place[axis] = (place[axis] ?? 0) + weight * (move[axis] ?? 0);
          }
          const truth = turned(positions.slice(3 * point, 3 * point + 3));
          const apart = truth.map((value, axis) => value - scale * (place[axis] ?? 0));
          worst = Math.max(worst, Math.hypot(...apart));
        }
      }
      // The requested thousandth of the width, and the error of 16 bits over twice the width.
      expect(worst).toBeLessThan(0.001 * 0.14 + 3e-5);
      expect(worst).toBeGreaterThan(1e-6);
      // Seen from above, the recto is lit: its normals point up where it lies on the right.
      const normal = primitives[0]?.getAttribute("NORMAL")?.getElement(100, []) ?? [];
      expect(normal[1]).toBeGreaterThan(0.99);
      expect(primitives[1]?.getAttribute("NORMAL")?.getElement(100, [])[1]).toBeLessThan(-0.99);
    },
  );
});

describe("a fold in glTF", () => {
  it("has two vertices for each point of its crease, each with the normal of its side", async () => {
    const bytes = await bake("glb", ...folded, ...imagesOf(["front.png", "back.png"]));
    const io = new NodeIO().registerExtensions([KHRMeshQuantization]);
    const root = (await io.readBinary(new Uint8Array(bytes))).getRoot();
    const [recto, verso] = root.listMeshes()[0]?.listPrimitives() ?? [];
    const get = (name: string, vertex: number): number[] =>
      recto?.getAttribute(name)?.getElement(vertex, []) ?? [];
    const last = recto?.listTargets().at(-1);
    const atEnd = (name: string, vertex: number): number[] => {
      const moved = last?.getAttribute(name)?.getElement(vertex, []) ?? [];
      return get(name, vertex).map((value, axis) => value + (moved[axis] ?? 0));
    };
    const points = 14 * 20;
    const count = recto?.getAttribute("POSITION")?.getCount() ?? 0;
    expect(count).toBeGreaterThan(points + 5);
    for (let vertex = points; vertex < count; vertex++) {
      const [u = 0, v = 0] = get("TEXCOORD_0", vertex);
      // On the line from (0.6, 0) to (1, 0.27); pictures begin at the head.
      expect(1 - v).toBeCloseTo(((u - 0.6) / 0.4) * 0.27, 3);
      const twin = Array.from({ length: points }, (_, point) => point).find((point) =>
        get("POSITION", point).every((x, axis) => x === get("POSITION", vertex)[axis]),
      );
      if (twin === undefined) throw new Error("It is no point's further vertex.");
      expect(atEnd("POSITION", vertex)).toEqual(atEnd("POSITION", twin));
      // Flat at first; at last each side faces its own way.
      const dot = (of: typeof get) =>
        of("NORMAL", vertex).reduce((sum, x, axis) => sum + x * (of("NORMAL", twin)[axis] ?? 0), 0);
      expect(dot(get)).toBeGreaterThan(0.999);
      expect(dot(atEnd)).toBeLessThan(-0.7);
    }
    // Both sides have every triangle, the verso's the other way around.
    const corners = [recto, verso].map((side) => side?.getIndices()?.getArray() ?? []);
    expect(corners[0]).toHaveLength(3 * 2 * 13 * 19);
    expect([...(corners[1] ?? [])]).toEqual(
      Array.from(corners[0] ?? [], (_, k) => corners[0]?.[k - (k % 3) + ((3 - (k % 3)) % 3)]),
    );
  });

  it("comes to rest near its angle, its flap over its page", async () => {
    const { frames, places, triangles, parts } = await bakeJson(...folded, "--fps", "120");
    const end = frames.at(-1) ?? [];
    const normalOf = (part: number): number[] => {
      const sum = [0, 0, 0];
      for (const [at, own] of parts.entries()) {
        if (own !== part) continue;
        const [a = [], b = [], c = []] = [0, 1, 2].map((k) => {
          const point = triangles[3 * at + k] ?? 0;
          return end.slice(3 * point, 3 * point + 3);
        });
        const [p, q] = [b, c].map((to) => to.map((x, axis) => x - (a[axis] ?? 0)));
        for (const axis of [0, 1, 2]) {
          const [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
          sum[axis] += (p?.[i] ?? 0) * (q?.[j] ?? 0) - (p?.[j] ?? 0) * (q?.[i] ?? 0);
        }
      }
      const length = Math.hypot(...sum);
      return sum.map((x) => x / length);
    };
    const [page, flap] = [normalOf(0), normalOf(1)];
    const cosine = page.reduce((sum, x, axis) => sum + x * (flap[axis] ?? 0), 0);
    expect((Math.acos(cosine) * 180) / Math.PI).toBeGreaterThan(145);
    expect(page[2]).toBeGreaterThan(0.99);
    // The corner lies over the page, mirrored in the crease.
    const corner = [...parts.keys()]
      .flatMap((at) => triangles.slice(3 * at, 3 * at + 3))
      .find((point) => places[2 * point] === 1 && places[2 * point + 1] === 0);
    const [x = 0, y = 0, z = 0] = end.slice(3 * (corner ?? 0), 3 * (corner ?? 0) + 3);
    expect(x).toBeLessThan(0.12);
    expect(y).toBeGreaterThan(0.02);
    expect(z).toBeGreaterThan(0);
  });

  it("is made of one crease after another, and nothing of it goes through the table", async () => {
    const { frames, places, parts } = await bakeJson(...letter, "--points", "16x12");
    expect([...new Set(parts)].sort()).toEqual([0, 2, 3]);
    const edge = [...Array(places.length / 2).keys()].filter((point) => places[2 * point] === 1);
    expect(edge).toHaveLength(12);
    const edgeAt = (frame: readonly number[] = []) =>
      edge.map((point) => frame.slice(3 * point, 3 * point + 3));
    // The outer fold is shut while the inner one is not begun; then it is carried to the spine.
    for (const [x = 0, , z = 0] of edgeAt(frames[11])) {
      expect(x).toBeLessThan(0.06);
      expect(z).toBeLessThan(0.01);
    }
    for (const [x = 0] of edgeAt(frames.at(-1))) expect(x).toBeLessThan(0.047);
    for (const frame of frames) {
      for (let k = 2; k < frame.length; k += 3) expect(frame[k]).toBeGreaterThan(-0.001);
    }
  });
});

/** Returns the targets with a weight at a time, on the straight line between two key frames. */
function weightsAt(
  times: ArrayLike<number>,
  weights: ArrayLike<number>,
  time: number,
): (readonly [number, number])[] {
  const count = times.length - 1;
  let after = 1;
  while (after < count && (times[after] ?? 0) < time) after++;
  const [a, b] = [times[after - 1] ?? 0, times[after] ?? 0];
  const t = Math.min(Math.max((time - a) / (b - a), 0), 1);
  return Array.from({ length: count }, (_, k) => {
    const [from, to] = [weights[(after - 1) * count + k] ?? 0, weights[after * count + k] ?? 0];
    return [k, from + t * (to - from)] as const;
  }).filter(([, weight]) => weight !== 0);
}

it.each(["mass-spring", "peel", "rigid", "cylinder"])(
  "a turn of %s goes from the right to the left, at the points asked for",
  async (model) => {
    const { frames, u, v } = await bakeJson("--model", model, "--points", "7x5");
    expect([u.length, v.length]).toEqual([7, 5]);
    for (const frame of frames) expect(frame).toHaveLength(3 * 35);
    const edges = [frames[0], frames.at(-1)].map((frame) => frame?.[18] ?? 0);
    expect(edges[0]).toBeCloseTo(0.14, 3);
    expect(edges[1]).toBeLessThan(-0.13);
  },
);

describe("others", () => {
  it("OBJ, one a frame, with normals and places on both pictures", async () => {
    const args = ["--model", "cylinder", "--fps", "10", "--points", "5x4"];
    const ended = await run(
      "bake",
      ...options,
      ...args,
      "--front",
      at("front.png"),
      "--out",
      at("leaf.obj"),
    );
    const count = Number(/: (\d+) frames/.exec(ended.stdout)?.[1]);
    const names = readdirSync(folder.path).filter((name) => /^leaf_\d{4}\.obj$/.test(name));
    expect(names).toHaveLength(count);
    expect(readFileSync(at("leaf.mtl"), "utf8")).toContain(`map_Kd ${at("front.png")}`);
    const json = await bakeJson(...args);
    const lines = readFileSync(at("leaf_0003.obj"), "utf8").split("\n");
    const of = (kind: string) => lines.filter((line) => line.startsWith(`${kind} `));
    expect(["v", "vt", "vn", "f"].map((kind) => of(kind).length)).toEqual([20, 40, 40, 24]);
    const place = of("v")[13]?.split(" ").slice(1).map(Number);
    expect(place).toEqual(turned(json.frames[2]?.slice(39, 42) ?? []).map((value) => value || 0));
  });

  it.each([
    ["--out", "a\nf 1 2 3.obj"],
    ["--front", "a\rb.png"],
    ["--back", "a\\"],
  ])("OBJ has no %s whose name is another line", async (option, name) => {
    const out = option === "--out" ? [] : ["--out", at("named.obj")];
    const ended = await run("bake", ...options, ...out, option, at(name));
    expect(ended.status).toBe(2);
    expect(ended.stderr).toMatch(/^The files of an \.obj name each other; [^\n]*\n/);
    expect(readdirSync(folder.path).filter((one) => /^(named|a\n)/.test(one))).toEqual([]);
  });

  it("OBJ of a fold: its points once, its vertices by their sides", async () => {
    const args = [...dogEar, "--fps", "10", "--points", "14x20"];
    const ended = await run("bake", ...options, ...args, "--out", at("ear.obj"));
    expect(ended.status, ended.stderr).toBe(0);
    const lines = readFileSync(at("ear_0003.obj"), "utf8").split("\n");
    const of = (kind: string) => lines.filter((line) => line.startsWith(`${kind} `));
    const vertices = of("vn").length / 2;
    expect(vertices).toBeGreaterThan(285);
    expect([of("v").length, of("vt").length]).toEqual([280, 2 * vertices]);
    expect(of("f")).toHaveLength(2 * 2 * 13 * 19);
    const corners = of("f").flatMap((face) => face.split(" ").slice(1));
    const numbers = corners.map((corner) => corner.split("/").map(Number));
    expect(Math.max(...numbers.map(([v = 0]) => v))).toBe(280);
    expect(Math.max(...numbers.map(([, vt = 0]) => vt))).toBe(2 * vertices);
    expect(numbers.every(([, vt, vn]) => vt === vn)).toBe(true);
  });

  it("JSON says what it is of", async () => {
    const turn = await bakeJson("--model", "rigid", "--points", "3x2", "--fps", "20");
    expect(turn).toMatchObject({ model: "rigid", gesture: "corner", stock: "office", fps: 20 });
    expect(turn.u).toEqual([0, 0.5, 1]);
    expect(turn.frames.length).toBeGreaterThan(8);
    const [first, last] = [turn.frames[0] ?? [], turn.frames.at(-1) ?? []];
    expect([first[6], last[6]]).toEqual([0.14, expect.closeTo(-0.14, 3)]);
  });

  it("key frames, which the package plays", async () => {
    const ended = await run("bake", ...options, "--out", at("turn.tlkf"));
    expect(ended.stdout).toMatch(
      /key frames, \d+\.\d kB, error 0\.\d+ % of the width, 0\.\d+ s\n$/,
    );
    const turn = decodeTurn(new Uint8Array(readFileSync(at("turn.tlkf"))));
    expect(turn).toMatchObject({ model: "sheet", columns: 26, rows: 26 });
    expect(turn.error).toBeLessThanOrEqual(0.001);
  });
});

it("key frames of a fold, with its mesh", async () => {
  const points = ["--points", "14x20"];
  const ended = await run("bake", ...options, ...dogEar, ...points, "--out", at("ear.tlkf"));
  expect(ended.status, ended.stderr).toBe(0);
  const turn = decodeTurn(new Uint8Array(readFileSync(at("ear.tlkf"))));
  expect(turn).toMatchObject({ model: "sheet", columns: 14, rows: 20 });
  expect(turn.error).toBeLessThanOrEqual(0.001);
  expect(turn.creased?.parts).toHaveLength(2 * 13 * 19);
});

describe("what cannot be baked ends with one sentence", () => {
  it.each([
    [[], "Say where the turn goes: --out turn.glb, turn.obj, turn.json or turn.tlkf"],
    [["--out", "turn.fbx"], "Say where the turn goes"],
    [["book.pdf", "--out", "a.glb"], "A turn is baked from its options alone"],
    [["--out", "a.glb", "--model", "paper"], "--model is mass-spring, sheet, shell, rigid"],
    [
      ["--out", "a.glb", "--points", "1x9"],
      "--points is a size such as 1280x720, each side 2 to 200.",
    ],
    [["--out", "a.json", "--front", "a.png"], "--front and --back are for .glb and .obj."],
    [["--out", "a.glb", "--crease", "0.6,0 1,0.3"], "--crease is two places on the leaf"],
    [["--out", "a.glb", "--crease", "0.6,0 1.1,0.3 90"], "--crease is two places on the leaf"],
    [["--out", "a.glb", "--crease", "0.6,0 0.6,0 90"], "--crease is two places on the leaf"],
    [["--out", "a.glb", "--crease", "0.6,0 1,0.3 -181"], "--crease is two places on the leaf"],
    [["--out", "a.glb", ...dogEar, "--model", "cone"], "only the sheet can be creased"],
    [["--out", "a.glb", "--gesture", "fold"], "A leaf is folded along a --crease"],
  ])("%j", (args, sentence) => {
    expect(() => parseCommand(["bake", ...args])).toThrow(sentence);
  });

  it("a recording with more points and frames than a file may have", async () => {
    const args = ["--model", "rigid", "--points", "200x200", "--seconds", "1"];
    const ended = await run("bake", ...args, "--out", at("long.tlkf"));
    expect(ended.status).toBe(1);
    expect(ended.stderr).toMatch(/long\.tlkf cannot be written: .* Take fewer --points/);
    expect(ended.stderr).not.toContain("    at ");
    expect(existsSync(at("long.tlkf"))).toBe(false);
  });

  it("a crease that meets the spine", async () => {
    const ended = await run("bake", "--crease", "0,0.5 1,0.5 90", "--out", at("a.glb"));
    expect(ended.stderr).toMatch(/A crease does not meet the spine, where the leaf is bound\.\n$/);
    expect(ended.status).toBe(1);
  });

  it("a picture that glTF does not take, and a folder that is not there", async () => {
    const picture = await run("bake", "--front", at("page.webp"), "--out", at("a.glb"));
    expect(picture.stderr).toMatch(
      /page\.webp is neither PNG nor JPEG; glTF takes no other picture\.\n$/,
    );
    writeFileSync(at("file"), "");
    const out = await run("bake", "--model", "rigid", "--out", at("file/turn.json"));
    expect(out.stderr).toMatch(/was not found; check its name and folder\.\n$/);
    expect([picture.status, out.status]).toEqual([1, 1]);
  });
});
