import { expect, test } from "vitest";
import { TurnleafBook } from "../../packages/turnleaf/src/index.ts";
import { faultsOf } from "./faults.mjs";
import { readReference, readWordings } from "./read.mjs";

const reference = readReference();
const wordings = readWordings();

test("an element without attributes is as the reference says", () => {
  const bare = Object.create(TurnleafBook.prototype, {
    getAttribute: { value: () => null },
    hasAttribute: { value: () => false },
  });
  const asWord = (value) =>
    typeof value === "boolean" ? (value ? "on" : "off") : value === "" ? '""' : String(value);
  // Where the book lies open is not in the attribute alone.
  const others = reference.attributes.filter(({ name }) => name !== "page");
  const said = others.map(({ name, usual }) => [name, usual]);
  expect(said).toEqual(others.map(({ name }) => [name, asWord(bare[name])]));
  expect(said.length).toBeGreaterThan(15);
});

test("every attribute that is answered when it changes is in the reference", () => {
  const names = reference.attributes.map(({ attribute }) => attribute);
  expect(names).toEqual(expect.arrayContaining([...TurnleafBook.observedAttributes]));
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
