/**
 * The reference holds for the element, and what editors and frameworks read of it is valid and has all of
 * it. One file asks both, as the compiler reads the sources for some seconds.
 */
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import Ajv from "ajv";
import { expect, test } from "vitest";
import { TurnleafBook } from "../../packages/turnleaf/src/index.ts";
import { editorFiles, manifestOf } from "../manifest.mjs";
import { faultsOf } from "./faults.mjs";
import { readReference, readWordings } from "./read.mjs";

const reference = readReference();
const wordings = readWordings();

/** An element without a DOM: its attributes are in a map. */
function bare() {
  const has = new Map();
  const element = Object.create(TurnleafBook.prototype, {
    ownerDocument: { value: { defaultView: null } },
    getAttribute: { value: (name) => has.get(name) ?? null },
    hasAttribute: { value: (name) => has.has(name) },
    setAttribute: { value: (name, value) => has.set(name, String(value)) },
    removeAttribute: { value: (name) => has.delete(name) },
  });
  return { element, has };
}

// Where the book lies open is not in the attribute alone.
const reflected = reference.attributes.filter(({ name }) => name !== "page");

test("an element without attributes is as the reference says", () => {
  const { element } = bare();
  const asWord = (value) =>
    typeof value === "boolean" ? (value ? "on" : "off") : value === "" ? '""' : String(value);
  const said = reflected.map(({ name, usual }) => [name, usual]);
  expect(said).toEqual(reflected.map(({ name }) => [name, asWord(element[name])]));
  expect(said.length).toBeGreaterThan(15);
});

test("a property says its attribute, and what it is set to comes back, as frameworks rely on", () => {
  for (const { name, attribute, choice, type } of reflected) {
    // A number that the attribute accepts: all but these take more than 1.
    const number =
      { shadows: 0.75, margin: 0.125, letterSpacing: 0.5, wordSpacing: 0.5 }[name] ?? 1.25;
    const values = { boolean: [true, false], number: [number], string: ["2-3"] }[type];
    for (const value of values ?? choice.map((word) => (/^\d$/.test(word) ? Number(word) : word))) {
      const { element, has } = bare();
      // From the other value: a flag that is not there cannot be seen to go.
      if (value === false) element[name] = true;
      element[name] = value;
      expect([name, element[name]]).toEqual([name, value]);
      expect([name, has.has(attribute)]).toEqual([name, value !== false || name === "assist"]);
    }
  }
});

test("every observed attribute is in the reference", () => {
  const names = reference.attributes.map(({ attribute }) => attribute);
  // The language is HTML's own.
  const own = TurnleafBook.observedAttributes.filter((name) => name !== "lang");
  expect(names).toEqual(expect.arrayContaining(own));
});

test("whatever says nothing of itself is found", () => {
  expect(faultsOf(reference, wordings)).toEqual([]);
  const [first] = reference.attributes;
  const [goTo] = reference.methods.filter(({ name }) => name === "goTo");
  const changed = (change) => faultsOf({ ...reference, ...change }, wordings).join("\n");
  expect(changed({ properties: [{ ...first, name: "mute", text: "" }] })).toMatch(/mute/);
  expect(changed({ methods: [{ ...goTo, text: "Turns." }] })).toMatch(
    /parameter page[\s\S]*resolves/,
  );
  expect(changed({ attributes: reference.attributes.slice(1) })).toMatch(
    `The attribute ${first.attribute}`,
  );
  expect(changed({ parts: reference.parts.slice(1) })).toMatch("The part button");
  expect(changed({ parts: [...reference.parts, { name: "gone", text: "Was." }] })).toMatch("gone");
  expect(changed({ customProperties: [] })).toMatch("The custom property --turnleaf-desk");
  expect(changed({ events: [{ name: "e", text: "E.", type: "Inner" }] })).toMatch(
    "The type Inner is named in public and not exported",
  );
});

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
