import { expect, test } from "vitest";
import { TurnleafBook } from "../../packages/turnleaf/src/index.ts";
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
