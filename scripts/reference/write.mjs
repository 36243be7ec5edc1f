/** The reference as a page of Markdown. */

/** @param reference what `readReference` read */
export function writeReference(reference, wordings) {
  const { attributes, properties, methods, events, parts, customProperties } = reference;
  const byName = (a, b) => a.name.localeCompare(b.name);
  return `${[
    "# Reference",
    'What `import "turnleaf"` gives a page: the element `<turnleaf-book>`, some functions and types. Pages count from 1. This page is written from the comments in the sources by `make reference`; `make check` fails where it is out of date.',
    "## Attributes",
    "Each is a property too, and may change at any time.",
    table(
      ["attribute", "property", "values", "default", "meaning"],
      [...attributes]
        .sort(byName)
        .map((each) => [
          code(each.attribute),
          code(each.name),
          values(each),
          each.usual === '""' ? "" : code(each.usual),
          each.text,
        ]),
    ),
    "## Properties",
    table(
      ["property", "type", "", "meaning"],
      [...properties]
        .sort(byName)
        .map((each) => [
          code(each.name),
          code(each.type),
          each.isWritten ? "" : "read only",
          each.text,
        ]),
    ),
    "## Methods",
    ...[...methods].sort(byName).map(callable),
    "## Events",
    "Each is a `CustomEvent`; `addEventListener` knows their types.",
    table(
      ["event", "`detail`", "when"],
      [...events].sort(byName).map((each) => [code(each.name), code(each.type), each.text]),
    ),
    "## CSS parts",
    "For `turnleaf-book::part(name)`.",
    table(
      ["part", "what it is"],
      parts.map((each) => [code(each.name), each.text]),
    ),
    "## Custom properties",
    "Set on the element, they go before every theme's own. The values are those of the light theme.",
    table(
      ["property", "value", "meaning"],
      customProperties.map((each) => [code(each.name), code(each.usual), each.text]),
    ),
    "## Functions",
    ...[...reference.functions].sort(byName).map(callable),
    "## Types",
    ...[...reference.types].sort(byName).map((each) => type(each, wordings)),
  ].join("\n\n")}\n`;
}

function callable({ name, text, signature, parameters, throws }) {
  const described = parameters.filter((each) => each.text);
  return [
    `### \`${name}\``,
    fenced(signature),
    text,
    ...(described.length > 0
      ? [described.map((each) => `- ${code(each.name)}: ${each.text}`).join("\n")]
      : []),
    ...throws.map((each) => `Throws ${each}.`),
  ].join("\n\n");
}

function type({ name, text, means, members, isClass, bases }, wordings) {
  const head = `### \`${name}\``;
  if (means !== undefined) return [head, text, fenced(`type ${name} = ${means}`)].join("\n\n");
  const kind = isClass ? ` A class that extends \`${bases.join("`, `")}\`.` : "";
  const rows = members.map((each) => [
    code(each.name + (each.isOptional ? "?" : "")),
    code(each.type),
    meaningOf(name, each, wordings),
  ]);
  return [head, text + kind, table(["member", "type", "meaning"], rows)].join("\n\n");
}

/** What a member's comment says; of a text of the element, how it reads in English. */
export function meaningOf(type, { name, text }, wordings) {
  const wording = wordings.get(`${type}.${name}`);
  return [text, wording && `“${wording}”`].filter(Boolean).join(" ");
}

/** An attribute's values: the words or numbers it takes, the usual one first, else its property's type. */
function values({ choice, type, usual }) {
  if (choice) {
    const others = choice.map((word) => word || '""').filter((word) => word !== usual);
    return [usual, ...others].map(code).join(", ");
  }
  if (type !== "boolean") return code(type);
  return usual === "on" ? "`on`, `off`" : "there or not";
}

function table(heads, rows) {
  const line = (cells) => `| ${cells.map((cell) => cell.replaceAll("|", "\\|")).join(" | ")} |`;
  return [line(heads), `|${"---|".repeat(heads.length)}`, ...rows.map(line)].join("\n");
}

function fenced(text) {
  return ["```ts", plain(text), "```"].join("\n");
}

function code(text) {
  return text ? `\`${plain(text)}\`` : "";
}

/** A type as one writes it: `?` says already that it may be undefined. */
function plain(type) {
  const optional = /(\?: (?:\{[^}]*\}|[^;,)}]*?)) \| undefined/g;
  // Twice, as one that is left out may hold another.
  return type.replace(optional, "$1").replace(optional, "$1").replace(/; \}/g, " }");
}
