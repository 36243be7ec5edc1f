import { readdirSync, readFileSync, writeFileSync } from "node:fs";
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
}

async function bakeJson(...args: string[]): Promise<Baked> {
  const ended = await run("bake", ...options, ...args, "--out", at("turn.json"));
  expect(ended.stderr.replace(/^\d+ % .*\n/gm, "")).toBe("");
  return JSON.parse(readFileSync(at("turn.json"), "utf8"));
}

/** Converts x, y, z to glTF's axes. */
const turned = ([x = 0, y = 0, z = 0]: readonly number[]): number[] => [x, z, -y];

describe("glTF", () => {
  it.each([
    ["sheet", "corner", []],
    ["cone", "edge", ["front.png", "back.png"]],
  ])(
    "of %s by its %s passes the validator and holds the turn within the tolerance",
    async (model, gesture, pictures) => {
      const file = at(`${model}.glb`);
      const [front, back] = pictures.map(at);
      const images = front && back ? ["--front", front, "--back", back] : [];
      const args = ["--model", model, "--gesture", gesture, "--points", "14x20"];
      const ended = await run("bake", ...options, ...args, ...images, "--out", file);
      expect(ended.status, ended.stderr).toBe(0);
      const bytes = new Uint8Array(readFileSync(file));

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
      expect(base.getCount()).toBe(280);
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
  ])("%j", (args, sentence) => {
    expect(() => parseCommand(["bake", ...args])).toThrow(sentence);
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
