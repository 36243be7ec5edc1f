/** A baked turn in another program: three's own loader, in a real Chromium. */

import { readFileSync, writeFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { page as pageOf } from "./books.ts";
import { chromiumForTests } from "./browser.ts";
import { folderOf, run } from "./command.ts";

const modules = fileURLToPath(new URL("../../../node_modules/three/", import.meta.url));

const html = `<!doctype html><title>Turn</title><script type="importmap">
{"imports":{"three":"/three/build/three.module.js","three/addons/":"/three/examples/jsm/"}}</script>
<script type="module">
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
// One for all pictures: another would compile its shaders anew, which takes seconds in software.
const [width, height] = [200, 150];
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(width, height);
document.body.append(renderer.domElement);
globalThis.show = async (time) => {
  const gltf = await new GLTFLoader().loadAsync("/turn.glb");
  const mixer = new THREE.AnimationMixer(gltf.scene);
  mixer.clipAction(gltf.animations[0]).play();
  mixer.setTime(time);
  gltf.scene.updateMatrixWorld(true);
  const meshes = [];
  gltf.scene.traverse((object) => object.isMesh && meshes.push(object));
  const at = new THREE.Vector3();
  const places = meshes.map((mesh) => {
    const count = mesh.geometry.attributes.position.count;
    return Array.from({ length: count }, (_, i) =>
      mesh.localToWorld(mesh.getVertexPosition(i, at)).toArray());
  });
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0x8a8f98);
  const sun = new THREE.DirectionalLight(0xffffff, 2.5);
  sun.position.set(-1, 2, 1);
  scene.add(gltf.scene, sun, new THREE.AmbientLight(0xffffff, 1));
  const camera = new THREE.PerspectiveCamera(35, 4 / 3, 0.01, 10);
  camera.position.set(0, 0.42, 0.28);
  camera.lookAt(0, 0.03, -0.1);
  renderer.render(scene, camera);
  const pixels = new Uint8Array(width * height * 4);
  const gl = renderer.getContext();
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let [red, blue] = [0, 0];
  for (let i = 0; i < pixels.length; i += 4) {
    if (pixels[i] > pixels[i + 2] + 60) red++;
    if (pixels[i + 2] > pixels[i] + 60) blue++;
  }
  return { places, red, blue, image: renderer.domElement.toDataURL() };
};
</script>`;

let folder: ReturnType<typeof folderOf>;
let server: Server;
const tests = chromiumForTests({ isDrawn: true, keepsPages: true });
let page: Page;

beforeAll(async () => {
  folder = folderOf({
    "front.png": pageOf([200, 60, 40]),
    "back.png": pageOf([40, 70, 200]),
  });
  server = createServer((request, response) => {
    const path = new URL(request.url ?? "/", "http://localhost").pathname;
    try {
      const file = path === "/turn.glb" ? join(folder.path, "turn.glb") : modules + path.slice(7);
      const body = path === "/" ? html : readFileSync(file);
      const type =
        path === "/" ? "text/html" : path.endsWith(".js") ? "text/javascript" : "model/gltf-binary";
      response.writeHead(200, { "Content-Type": type }).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  page = await tests.newPage();
  await page.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
  await page.waitForFunction(() => "show" in globalThis);
});
afterAll(async () => {
  server.closeAllConnections();
  await new Promise<void>((resolve) => server.close(() => resolve()));
  folder.remove();
});

/** A leaf of few points: three is to put each where it is. */
const bake = ["bake", "--stock", "office", "--size", "140x210", "--points", "14x20"];

interface Shown {
  readonly places: readonly (readonly (readonly number[])[])[];
  readonly red: number;
  readonly blue: number;
  readonly image: string;
}

it("three shows a fold, the verso's picture on what is folded over", async () => {
  const at = (name: string): string => join(folder.path, name);
  const crease = ["--crease", "0.5,0 0.5,1 160"];
  const args = [...bake, "--seconds", "0.4", ...crease];
  const pictures = ["--front", at("front.png"), "--back", at("back.png")];
  expect((await run(...args, ...pictures, "--out", at("turn.glb"))).status).toBe(0);
  await run(...args, "--fps", "120", "--out", at("turn.json"));
  const { frames } = JSON.parse(readFileSync(at("turn.json"), "utf8")) as { frames: number[][] };
  const shown: Shown[] = [];
  for (const time of [0, (frames.length - 1) / 120 - 1e-4]) {
    const now = await page.evaluate(
      (time) => (globalThis as unknown as { show(time: number): Promise<Shown> }).show(time),
      time,
    );
    shown.push(now);
    if (process.env.TURNLEAF_PICTURES) {
      const image = Buffer.from(now.image.split(",")[1] ?? "", "base64");
      writeFileSync(join(process.env.TURNLEAF_PICTURES, `bake-fold-${shown.length}.png`), image);
    }
  }
  const [flat, folded] = shown;
  expect(flat?.blue).toBe(0);
  // Of the page one half shows its recto, under the other's verso.
  expect(folded?.blue).toBeGreaterThan(0.25 * (flat?.red ?? 0));
  expect(folded?.red).toBeLessThan(0.6 * (flat?.red ?? 0));
});

it("three shows the turn where it is, its recto before and its verso after", async () => {
  const at = (name: string): string => join(folder.path, name);
  const args = [...bake, "--seconds", "0.8"];
  const pictures = ["--front", at("front.png"), "--back", at("back.png")];
  expect((await run(...args, ...pictures, "--out", at("turn.glb"))).status).toBe(0);
  await run(...args, "--fps", "120", "--out", at("turn.json"));
  const frames = JSON.parse(readFileSync(at("turn.json"), "utf8")).frames as number[][];

  const shown: Shown[] = [];
  for (const frame of [0, 36, 52, frames.length - 1]) {
    const now = await page.evaluate(
      (time) => (globalThis as unknown as { show(time: number): Promise<Shown> }).show(time),
      // At its very end three would restart the turn.
      Math.min(frame / 120, (frames.length - 1) / 120 - 1e-4),
    );
    shown.push(now);
    if (process.env.TURNLEAF_PICTURES) {
      const image = Buffer.from(now.image.split(",")[1] ?? "", "base64");
      writeFileSync(join(process.env.TURNLEAF_PICTURES, `bake-${frame}.png`), image);
    }
    expect(now.places).toHaveLength(2);
    for (const places of now.places) {
      let worst = 0;
      for (const [point, [x = 0, y = 0, z = 0]] of places.entries()) {
        const truth = frames[frame]?.slice(3 * point, 3 * point + 3) ?? [];
        const [a = 0, b = 0, c = 0] = truth;
        worst = Math.max(worst, Math.hypot(x - a, y - c, z + b));
      }
      // The requested thousandth of the width, and the error of 16 bits and three's floats.
      expect(worst).toBeLessThan(0.00014 + 5e-5);
    }
  }
  const [first, , , last] = shown;
  expect(first?.red).toBeGreaterThan(1000);
  expect(first?.blue).toBe(0);
  expect(last?.blue).toBeGreaterThan(1000);
  expect(last?.red).toBe(0);
  expect(shown[1]?.red && shown[1].red + (shown[1]?.blue ?? 0)).toBeGreaterThan(500);
});
