/** What the reference cannot say, because the sources do not. */

import { meaningOf } from "./write.mjs";

/** Attributes of every element, which this one sets or reads too. */
const common = [
  "aria-hidden",
  "aria-label",
  "aria-live",
  "dir",
  "lang",
  "part",
  "role",
  "tabindex",
  // Of canvases that draw elements, and of these.
  "content",
  "drawable",
  "layoutsubtree",
];

/**
 * Sentences that say what of the public list does not say what it is.
 * @param reference,wordings what `readReference` and `readWordings` read
 */
export function faultsOf(reference, wordings) {
  const { attributes, properties, methods, events, functions, types } = reference;
  const found = [];
  const need = (documented, what) =>
    documented || found.push(`${what} has no comment that says what it is`);
  for (const each of [...attributes, ...properties]) need(each.text, `The property ${each.name}`);
  for (const each of attributes) {
    if (each.usual === undefined) found.push(`The attribute ${each.attribute} names no @default`);
  }
  for (const each of events) need(each.text, `The event ${each.name}`);
  for (const each of [...methods, ...functions]) {
    need(each.text, `${each.name}()`);
    for (const { name, text } of each.parameters) {
      const said = text || new RegExp(`\\b${name}\\b`).test(each.text);
      need(said, `The parameter ${name} of ${each.name}()`);
    }
    if (/^Promise/.test(each.returns) && !/\b[Rr]esolves\b/.test(each.text)) {
      found.push(`${each.name}() does not say what its promise resolves to`);
    }
  }
  for (const each of types) {
    need(each.text, `The type ${each.name}`);
    for (const member of each.members)
      need(meaningOf(each.name, member, wordings), `${each.name}.${member.name}`);
  }
  const { parts, customProperties, used, isKnown } = reference;
  const attributeNames = attributes.map((each) => ({ name: each.attribute }));
  agree(found, "attribute", attributeNames, used.attributes, common);
  agree(found, "part", parts, used.parts);
  agree(found, "custom property", customProperties, used.customProperties);
  for (const name of namedTypes([attributes, properties, methods, events, functions, types])) {
    if (!isKnown(name)) found.push(`The type ${name} is named in public and not exported`);
  }
  return found;
}

/** Whatever is used has a comment, and whatever has a comment is used. */
function agree(found, kind, documented, used, exempt = []) {
  const names = documented.map((each) => each.name);
  for (const name of used) {
    if (!names.includes(name) && !exempt.includes(name))
      found.push(`The ${kind} ${name} has no comment that says what it is`);
  }
  for (const each of documented) {
    if (!used.has(each.name))
      found.push(`The ${kind} ${each.name} is documented and does not exist`);
    if (!each.text && each.text !== undefined) found.push(`The ${kind} ${each.name} says nothing`);
  }
}

/** Every name that stands for a type in what is public. */
function namedTypes(groups) {
  const shown = groups
    .flat()
    .flatMap((each) => [
      each.type,
      each.signature,
      each.means,
      ...(each.members ?? []).map((member) => member.type),
    ]);
  const code = shown.filter(Boolean).map((text) => text.replace(/"[^"]*"/g, ""));
  return new Set(code.flatMap((text) => text.match(/(?<![.\w])[A-Z]\w*/g) ?? []));
}
