/**
 * Reads what `turnleaf` offers from its own sources: the public list, the
 * element's class, and the tags that say what only markup and style see:
 *
 * - `@attribute name` and `@default value` at the property of an attribute,
 * - `@csspart name what it is` where an element gets that part,
 * - `@cssproperty --turnleaf-name what it colours` where it gets its value.
 */
import { readFileSync } from "node:fs";
import { join, relative } from "node:path";
import ts from "typescript";

export const root = join(import.meta.dirname, "../..");
const source = join(root, "packages/turnleaf/src");

const whole = ts.NodeBuilderFlags.NoTruncation;
const spelledOut = whole | ts.TypeFormatFlags.InTypeAlias;

/** Everything public, each with its name, its type where it has one, and what its comment says. */
export function readReference() {
  const { options, fileNames } = ts.parseJsonConfigFileContent(
    ts.readConfigFile(join(source, "../tsconfig.json"), ts.sys.readFile).config,
    ts.sys,
    join(source, ".."),
  );
  const names = fileNames.filter((name) => !/\.test\.ts$|\/for_tests\//.test(name));
  const program = ts.createProgram(names, options);
  const checker = program.getTypeChecker();
  const files = program.getSourceFiles().filter((file) => isOurs(file.fileName));
  const ours = (symbol) => symbol.declarations?.some((at) => isOurs(at.getSourceFile().fileName));

  const exported = checker.getExportsOfModule(
    checker.getSymbolAtLocation(program.getSourceFile(join(source, "index.ts"))),
  );
  const items = exported.map((symbol) => {
    const isAlias = symbol.flags & ts.SymbolFlags.Alias;
    return isAlias ? checker.getAliasedSymbol(symbol) : symbol;
  });
  const types = items.filter((item) => item.flags & ts.SymbolFlags.Type);
  const called = (name) => types.find((item) => item.name === name);
  const members = (symbol) =>
    checker.getPropertiesOfType(checker.getDeclaredTypeOfSymbol(symbol)).filter(ours);
  const plainElement = checker.resolveName("HTMLElement", undefined, ts.SymbolFlags.Type, false);
  const isOwn = ({ name }) =>
    checker.getDeclaredTypeOfSymbol(plainElement).getProperty(name) === undefined;
  const element = members(called("TurnleafBook")).filter(isPublic).filter(isOwn);
  const accessors = element.filter((member) => !(member.flags & ts.SymbolFlags.Method));

  return {
    attributes: accessors.filter((member) => tag(member, "attribute")).map(attribute),
    properties: accessors.filter((member) => !tag(member, "attribute")).map(property),
    methods: element.filter((member) => member.flags & ts.SymbolFlags.Method).map(callable),
    events: members(called("TurnleafEventMap")).map(event),
    parts: tagged(files, "csspart"),
    customProperties: tagged(files, "cssproperty").map(withValue),
    functions: items.filter((item) => item.flags & ts.SymbolFlags.Function).map(callable),
    types: types.filter((item) => item !== called("TurnleafBook")).map(type),
    /** Whether a name in a type is known to importers of the package. */
    isKnown: (name) => called(name) || isGlobal(checker, name, ours),
    /** What the sources use, whether or not a comment tells of it. */
    used: usedIn(files),
  };

  function documented(symbol) {
    const text = ts.displayPartsToString(symbol.getDocumentationComment(checker));
    return { name: symbol.name, text: oneLine(text) };
  }

  function typeOf(symbol) {
    const of = checker.getTypeOfSymbol(symbol);
    const isOptional = symbol.flags & ts.SymbolFlags.Optional;
    return checker.typeToString(isOptional ? checker.getNonNullableType(of) : of, undefined, whole);
  }

  function property(symbol) {
    const isWritten = symbol.declarations.some(
      (at) =>
        ts.isSetAccessor(at) ||
        ((ts.isPropertyDeclaration(at) || ts.isPropertySignature(at)) && !isReadonly(at)),
    );
    return { ...documented(symbol), type: typeOf(symbol), isWritten };
  }

  function attribute(symbol) {
    const of = checker.getNonNullableType(checker.getTypeOfSymbol(symbol));
    const isChoice = of.isUnion() && of.types.every((each) => each.isLiteral());
    return {
      ...property(symbol),
      attribute: tag(symbol, "attribute"),
      usual: tag(symbol, "default"),
      choice: isChoice ? of.types.map((each) => String(each.value)) : null,
    };
  }

  function callable(symbol) {
    const at = symbol.valueDeclaration;
    const [signature] = checker.getTypeOfSymbol(symbol).getCallSignatures();
    const shown = checker.signatureToString(signature, undefined, whole);
    const parameters = signature.parameters.map((each) => ({
      ...documented(each),
      text: documented(each).text.replace(/^- /, ""),
      type: typeOf(each),
    }));
    const returns = checker.typeToString(signature.getReturnType(), undefined, whole);
    const { name, text } = documented(symbol);
    const errors = ts.getJSDocTags(at).filter((each) => each.tagName.text === "throws");
    const throws = errors.map((each) => oneLine(ts.getTextOfJSDocComment(each.comment) ?? ""));
    return { name, text, signature: `${name}${shown}`, parameters, returns, throws };
  }

  function event(symbol) {
    const [detail] = checker.getTypeArguments(checker.getTypeOfSymbol(symbol));
    return { ...documented(symbol), type: checker.typeToString(detail, undefined, spelledOut) };
  }

  function type(symbol) {
    const declared = checker.getDeclaredTypeOfSymbol(symbol);
    const isShape = symbol.flags & (ts.SymbolFlags.Interface | ts.SymbolFlags.Class);
    if (!isShape) {
      const means = checker.typeToString(declared, undefined, spelledOut);
      return { ...documented(symbol), means, members: [] };
    }
    const shape = checker.getPropertiesOfType(declared).filter(ours);
    const each = shape.map((member) => ({
      ...property(member),
      isOptional: Boolean(member.flags & ts.SymbolFlags.Optional),
    }));
    const bases = checker.getBaseTypes(declared).map((base) => base.symbol.name);
    return {
      ...documented(symbol),
      members: each,
      isClass: !!(symbol.flags & ts.SymbolFlags.Class),
      bases,
    };
  }
}

/** What every text of the element is in English, by its name: what a translator goes by. */
export function readWordings() {
  const wordings = new Map();
  for (const file of ["words/languages.ts", "controls/texts_en.ts"]) {
    const text = readFileSync(join(source, file), "utf8");
    const [, type, english] = /const en: (\w+) = \{\n([\s\S]*?)\n\};/.exec(text);
    for (const [, name, one, other] of english.matchAll(
      /^ {2}(\w+): (?:"(.*)"|\{.*other: "(.*)" \}),$/gm,
    ))
      wordings.set(`${type}.${name}`, one ?? other);
  }
  return wordings;
}

function isOurs(file) {
  return !relative(source, file).startsWith("..");
}

function isPublic(symbol) {
  const hidden = ts.ModifierFlags.Private | ts.ModifierFlags.Protected;
  return symbol.declarations.every(
    (at) =>
      !(ts.getCombinedModifierFlags(at) & hidden) &&
      !ts.getJSDocTags(at).some((each) => each.tagName.text === "internal") &&
      !(at.name && ts.isPrivateIdentifier(at.name)),
  );
}

function isReadonly(declaration) {
  return Boolean(ts.getCombinedModifierFlags(declaration) & ts.ModifierFlags.Readonly);
}

/** Whether a name is a type of the language or of browsers. */
function isGlobal(checker, name, ours) {
  const symbol = checker.resolveName(name, undefined, ts.SymbolFlags.Type, false);
  if (symbol) return !ours(symbol);
  const intl = checker.resolveName("Intl", undefined, ts.SymbolFlags.Namespace, false);
  return checker.getExportsOfModule(intl).some((each) => each.name === name);
}

function tag(symbol, name) {
  const found = symbol.getJsDocTags().find((each) => each.name === name);
  return found && ts.displayPartsToString(found.text);
}

/** What the comments of all files say under a tag, by name. */
function tagged(files, name) {
  const pattern = new RegExp(`@${name} (\\S+)\\s+((?:(?!@|\\*/)[\\s\\S])*)`, "g");
  const all = files.flatMap((file) =>
    [...file.text.matchAll(/\/\*\*[\s\S]*?\*\//g)].flatMap(([comment]) =>
      [...comment.matchAll(pattern)].map(([, of, text]) => ({
        name: of,
        text: oneLine(text.replace(/^\s*\*/gm, "")),
      })),
    ),
  );
  return all.sort((a, b) => a.name.localeCompare(b.name));
}

/** A custom property with the value that it has where nobody sets it. */
function withValue(property) {
  const usual = ["element/shadow_tree.ts", "controls/themes.css.ts"].map((file) => {
    const style = readFileSync(join(source, file), "utf8");
    return style.slice(style.indexOf("\n:host {"));
  });
  const value = new RegExp(`${property.name}: ([^;]*);`).exec(usual.join(""))?.[1];
  return { ...property, usual: value };
}

function usedIn(files) {
  const used = { attributes: new Set(), parts: new Set(), customProperties: new Set() };
  const note = (set, text, pattern) => {
    for (const [, names] of text.matchAll(pattern)) {
      for (const name of names.split(" ")) set.add(name);
    }
  };
  for (const file of files) {
    const path = relative(source, file.fileName);
    const text = file.text.replace(/\/\*\*[\s\S]*?\*\//g, "");
    note(used.parts, text, /\bpart: "([^"]+)",/g);
    for (const [, words] of text.matchAll(/setAttribute\("part", (.*)\);/g)) {
      note(used.parts, words, /"([^"]+)"/g);
    }
    note(used.customProperties, text, /(--turnleaf-[\w-]+)/g);
    if (path === "attributes.ts") {
      const [, table] = /export const attributes[\s\S]*? = \{([\s\S]*?)\n\};/.exec(text);
      for (const [, property] of table.matchAll(/^ {2}(\w+): \w+[(<]/gm))
        used.attributes.add(property.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`));
    }
    if (/^element(\/|\.ts)/.test(path))
      note(used.attributes, text, /(?:get|has|set|toggle)Attribute\("([^"]+)"/g);
  }
  return used;
}

function oneLine(text) {
  return text.replace(/\s+/g, " ").trim();
}
