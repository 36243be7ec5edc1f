import { expect, test } from "vitest";

test("the package's public list, importable where there is no DOM", async () => {
  expect(globalThis.document).toBeUndefined();
  const turnleaf = await import("./index.ts");
  expect(Object.keys(turnleaf).sort()).toEqual(["BookError", "TurnleafBook", "addLanguage"]);
});
