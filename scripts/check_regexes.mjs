/**
 * Checks that every regular expression of the shipped sources matches in linear time, whatever the input:
 * books are written by strangers. recheck decides it, by automata where it can and else by fuzzing.
 *
 *   node scripts/check_regexes.mjs
 */
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { availableParallelism } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { isMainThread, parentPort, Worker, workerData } from "node:worker_threads";
// Its entry for browsers needs neither Java nor a binary of this platform.
import recheck from "recheck/lib/browser.js";
import ts from "typescript";

const root = join(import.meta.dirname, "..");

/** The folders whose sources are shipped. */
const folders = ["packages/turnleaf/src", "packages/cli/src", "packages/cli/app"];

/** Expressions that are not linear, by file, each with the bound of its input. */
const bounded = [
  // The text behind a found word, `around` characters.
  ["packages/cli/app/publish/search.ts", String.raw`/\S*$/`],
];

/** Greatest bound of a repeat that recheck's automata count; it guesses at expressions with others. */
const mostCounted = 20;

/**
 * How recheck looks: bounded by steps and seeded, so that a loaded machine finds what an idle one does.
 * The time is for an expression that would take all day.
 */
const settings = {
  attackLimit: 100_000_000,
  attackTimeout: null,
  incubationTimeout: null,
  randomSeed: 1,
  timeout: 300_000,
};

/**
 * Returns the regular expressions of a source: literals, and what `RegExp` is called with where that is made
 * of constants of the file.
 *
 * @returns {{ line: number, source: string | null, flags: string }[]} `source` is null where it is not
 */
export function expressionsIn(text) {
  const file = ts.createSourceFile("source.ts", text, ts.ScriptTarget.Latest, true);
  const constants = new Map();
  const found = [];
  const visit = (node) => {
    if (ts.isVariableDeclaration(node) && node.initializer && ts.isIdentifier(node.name)) {
      constants.set(node.name.text, node.initializer);
    }
    if (ts.isRegularExpressionLiteral(node)) found.push({ node });
    if ((ts.isNewExpression(node) || ts.isCallExpression(node)) && isRegExp(node.expression)) {
      found.push({ node, parts: node.arguments ?? [] });
    }
    ts.forEachChild(node, visit);
  };
  visit(file);
  return found.map(({ node, parts }) => {
    const line = file.getLineAndCharacterOfPosition(node.getStart()).line + 1;
    if (!parts) return { line, ...partsOf(node.text) };
    const [source, flags = ""] = parts.map((part) => textOf(part, constants));
    return { line, source: flags === null ? null : source, flags };
  });
}

const isRegExp = (callee) => ts.isIdentifier(callee) && callee.text === "RegExp";

/** Returns a literal's source and flags. */
function partsOf(literal) {
  const end = literal.lastIndexOf("/");
  return { source: literal.slice(1, end), flags: literal.slice(end + 1) };
}

/** Returns the text of a constant expression; null if it is none. */
function textOf(node, constants) {
  if (ts.isStringLiteralLike(node)) return node.text;
  if (ts.isNumericLiteral(node)) return node.text;
  if (ts.isIdentifier(node)) {
    const constant = constants.get(node.text);
    return constant ? textOf(constant, constants) : null;
  }
  if (!ts.isTemplateExpression(node)) return null;
  const pieces = node.templateSpans.map(({ expression, literal }) => {
    const value = textOf(expression, constants);
    return value === null ? null : value + literal.text;
  });
  return pieces.includes(null) ? null : node.head.text + pieces.join("");
}

/**
 * Returns why an expression is not known to be linear; null if it is. It is checked in a form that takes no
 * less time, and far less to check: repeats of more than 20 are unbounded, letters without case are small.
 */
export function faultOf(source, flags) {
  const unbounded = source.replace(/\{(\d+)(?:,(\d*))?\}/g, (repeat, least, most) => {
    if (Number((most ?? least) || Number.POSITIVE_INFINITY) <= mostCounted) return repeat;
    return Number(least) > 0 ? "+" : "*";
  });
  const form = flags.includes("i")
    ? unbounded.replace(/\\.|[A-Z]/g, (part) => (part.length > 1 ? part : part.toLowerCase()))
    : unbounded;
  const { status, complexity, attack, error } = recheck.checkSync(
    form,
    flags.replace("i", ""),
    settings,
  );
  if (status === "safe") return null;
  if (status === "vulnerable") return `${complexity.summary}, as of ${attack.pattern}`;
  return `not decided: ${JSON.stringify(error)}`;
}

/** Returns what is wrong with one expression of a file; null if nothing is. */
function errorOf({ file, line, source, flags }) {
  if (source === null) return `${file}:${line}: write it as a literal, or of the file's constants`;
  const literal = `/${source}/${flags}`;
  const isAllowed = bounded.some(([path, text]) => path === file && text === literal);
  const fault = faultOf(source, flags);
  if (isAllowed && fault === null) return `${file}:${line}: ${literal} needs no exception`;
  return isAllowed || fault === null ? null : `${file}:${line}: ${literal} is ${fault}`;
}

/** Returns the errors of some expressions, found in a thread of its own. */
function errorsOf(expressions) {
  return new Promise((resolve, reject) => {
    const thread = new Worker(new URL(import.meta.url), { workerData: expressions });
    thread.once("message", resolve);
    thread.once("error", reject);
  });
}

async function check() {
  const files = execFileSync("git", ["ls-files", ...folders], { cwd: root, encoding: "utf8" })
    .split("\n")
    .filter((path) => /(?<!\.test|\.d)\.tsx?$/.test(path) && !path.includes("/for_tests/"));
  const all = files.flatMap((file) =>
    expressionsIn(readFileSync(join(root, file), "utf8")).map((one) => ({ file, ...one })),
  );
  const count = Math.min(availableParallelism(), 8);
  const turns = Array.from({ length: count }, (_, thread) =>
    errorsOf(all.filter((_, at) => at % count === thread)),
  );
  const missing = bounded
    .filter(([path, text]) => {
      return !all.some(
        ({ file, source, flags }) => file === path && `/${source}/${flags}` === text,
      );
    })
    .map(([path, text]) => `${path}: ${text}, an exception, is not there`);
  const errors = [...(await Promise.all(turns)).flat(), ...missing];
  if (errors.length > 0) {
    console.error(errors.join("\n"));
    process.exit(1);
  }
  console.log(`${all.length} regular expressions match in linear time.`);
}

if (!isMainThread && parentPort && Array.isArray(workerData)) {
  parentPort.postMessage(workerData.map(errorOf).filter((error) => error !== null));
} else if (process.argv[1] === fileURLToPath(import.meta.url)) await check();
