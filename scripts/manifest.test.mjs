/** What editors and frameworks read of the element is valid, and has all of it. */
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import Ajv from "ajv";
import { expect, test } from "vitest";
import { editorFiles, manifestOf } from "./manifest.mjs";
import { readReference } from "./reference/read.mjs";

const reference = readReference();
const manifest = manifestOf(reference);
const schema = createRequire(import.meta.url).resolve("custom-elements-manifest/schema.json");

test("the manifest keeps to the schema", () => {
  const ajv = new Ajv({ strict: false });
  const isValid = ajv.compile(JSON.parse(readFileSync(schema, "utf8")));
  isValid(manifest);
  expect(isValid.errors).toBeNull();
});

test("every attribute, event and part is in it, and in the data of both editors", () => {
  const files = editorFiles(manifest);
  const [element] = manifest.modules[0].declarations;
  const names = (list) => list.map(({ name }) => name);
  expect(names(element.attributes)).toEqual(reference.attributes.map((each) => each.attribute));
  expect(names(element.events)).toEqual(names(reference.events));
  expect(names(element.cssParts)).toEqual(names(reference.parts));
  const [tag] = JSON.parse(files["vscode.html-custom-data.json"]).tags;
  expect(tag.name).toBe("turnleaf-book");
  expect(names(tag.attributes).sort()).toEqual(names(element.attributes).sort());
  const cover = tag.attributes.find(({ name }) => name === "cover");
  expect(names(cover.values)).toEqual(["auto", "hard", "soft", "none"]);
  const webTypes = JSON.parse(files["web-types.json"]);
  expect(webTypes.name).toBe("turnleaf");
  const [web] = webTypes.contributions.html.elements;
  expect(names(web.attributes).sort()).toEqual(names(element.attributes).sort());
});
