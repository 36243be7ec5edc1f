/**
 * Writes what editors and frameworks read of `<turnleaf-book>` into the built
 * package, from the same comments as docs/reference.md: `custom-elements.json`
 * (the custom elements manifest, schema 1.0.0), and from it the data of VS Code
 * and of the JetBrains editors.
 */
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { getWebTypesData } from "custom-element-jet-brains-integration";
import { getVsCodeHtmlCustomData } from "custom-element-vs-code-integration";
import { readReference, root } from "./reference/read.mjs";

const folder = join(root, "packages/turnleaf");
const { name, version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
const path = "dist/index.js";

/** Returns the manifest of what a reference holds. */
export function manifestOf(reference) {
  const { attributes, properties, methods, events, parts, customProperties } = reference;
  const text = (type) => ({ text: type });
  const field = ({ name, text: description, type, isWritten }) => ({
    kind: "field",
    name,
    description,
    type: text(type),
    ...(!isWritten && { readonly: true }),
  });
  const declaration = {
    kind: "class",
    customElement: true,
    name: "TurnleafBook",
    tagName: "turnleaf-book",
    description: "A book whose pages turn as paper turns.",
    superclass: { name: "HTMLElement" },
    attributes: attributes.map(({ name, attribute, text: description, type, usual, choice }) => ({
      name: attribute,
      fieldName: name,
      description,
      type: text(choice ? choice.map((word) => `"${word}"`).join(" | ") : type),
      default: usual,
    })),
    members: [
      ...attributes.map((each) => ({ ...field(each), attribute: each.attribute })),
      ...properties.map(field),
      ...methods.map(({ name, text: description, parameters, returns }) => ({
        kind: "method",
        name,
        description,
        parameters: parameters.map((each) => ({
          name: each.name,
          description: each.text,
          type: text(each.type),
        })),
        return: { type: text(returns) },
      })),
    ],
    events: events.map(({ name, text: description, type }) => ({
      name,
      description,
      type: text(`CustomEvent<${type}>`),
    })),
    cssParts: parts.map(({ name, text: description }) => ({ name, description })),
    cssProperties: customProperties.map(({ name, text: description, usual }) => ({
      name,
      description,
      default: usual,
    })),
  };
  const to = { name: "TurnleafBook", module: path };
  return {
    schemaVersion: "1.0.0",
    modules: [
      {
        kind: "javascript-module",
        path,
        declarations: [declaration],
        exports: [
          { kind: "js", name: "TurnleafBook", declaration: to },
          { kind: "custom-element-definition", name: "turnleaf-book", declaration: to },
        ],
      },
    ],
  };
}

/** Returns the files by their names. */
export function editorFiles(manifest) {
  return {
    "custom-elements.json": `${JSON.stringify(manifest, null, 2)}\n`,
    "vscode.html-custom-data.json": getVsCodeHtmlCustomData(manifest, {}),
    // Its generator takes name and version from the folder it runs in.
    "web-types.json": JSON.stringify(
      { ...JSON.parse(getWebTypesData(manifest, {})), name, version },
      null,
      2,
    ),
  };
}

if (process.argv[1] === import.meta.filename) {
  for (const [file, text] of Object.entries(editorFiles(manifestOf(readReference())))) {
    writeFileSync(join(folder, "dist", file), text);
  }
}
