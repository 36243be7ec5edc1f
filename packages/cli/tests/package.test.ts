import { execFile } from "node:child_process";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { expect, test } from "vitest";

test("the built package is imported on a server, where it does nothing", async () => {
  const script = `const turnleaf = await import("turnleaf");
    console.log(typeof turnleaf.TurnleafBook, typeof globalThis.customElements);`;
  // Of its own process: what the tests load beside it might stand in for a DOM.
  const { stdout, stderr } = await promisify(execFile)(
    process.execPath,
    ["--input-type=module", "--eval", script],
    { cwd: fileURLToPath(new URL("..", import.meta.url)) },
  );
  expect([stdout.trim(), stderr]).toEqual(["function undefined", ""]);
});

test("the public types need none of another package", () => {
  const types = readFileSync(new URL("../../turnleaf/dist/index.d.ts", import.meta.url), "utf8");
  expect(types).toContain("declare class TurnleafBook");
  expect(types.match(/from "[^"]+"|import\("[^"]+"\)/g)).toBeNull();
});
