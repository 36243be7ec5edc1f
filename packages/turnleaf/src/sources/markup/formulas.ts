/** Formulas of MathML: what is drawn of one, and its text on one line. */

import { cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import { takeContent } from "./take_content.ts";

/** The attribute that has a formula's text, for copying and searching. */
export const formulaAttribute = "data-turnleaf-formula";

/** Elements within each other that are written out. */
const deepest = 60;

const tex = /tex/i;

/**
 * Leaves of the formulas in a document what is drawn, and gives each its text: its annotation in TeX, or else
 * what its author says in `alttext`, or else its signs on one line.
 */
export function prepareFormulas(root: Element): void {
  const formulas = [...root.querySelectorAll("math:not(math math)")];
  // What stands for other formulas too says nothing of any: programs that have no words write some.
  const said = new Map<string, string>();
  const others = new Set<string>();
  for (const math of formulas) {
    const [words, signs] = [math.getAttribute("alttext")?.trim() ?? "", math.textContent ?? ""];
    if ((said.get(words) ?? signs) !== signs) others.add(words);
    said.set(words, signs);
  }
  for (const math of formulas) {
    if (others.has(math.getAttribute("alttext")?.trim() ?? "")) math.removeAttribute("alttext");
    prepareFormula(math);
  }
}

function prepareFormula(math: Element): void {
  const annotations = [...math.querySelectorAll("annotation")];
  const source = annotations.find((one) => tex.test(one.getAttribute("encoding") ?? ""));
  for (const whole of math.querySelectorAll("semantics")) {
    const shown = [...whole.children].find(isPresentation);
    const other = whole.querySelector(':scope > annotation-xml[encoding="MathML-Presentation"]');
    whole.replaceWith(...(shown ? [shown] : other ? [takeContent(other)] : []));
  }
  for (const one of math.querySelectorAll("annotation, annotation-xml")) one.remove();
  const said = [source?.textContent, math.getAttribute("alttext"), linear(math, 0)];
  const text = said.map((one) => cleanText(one, limits.runLength)).find((one) => one !== "");
  if (text) math.setAttribute(formulaAttribute, text);
}

/** Returns whether the first part of a formula is drawn: parts of its meaning alone are not. */
const isPresentation = ({ localName }: Element): boolean =>
  !/^(annotation|annotation-xml|apply|ci|cn|csymbol|bind|lambda)$/.test(localName);

/** Returns the signs of a part of a formula on one line, as they would be typed. */
function linear(part: Element, depth: number): string {
  if (depth > deepest) return part.textContent ?? "";
  const parts = [...part.children];
  const at = (k: number): string => (parts[k] ? linear(parts[k], depth + 1) : "");
  const all = (between = ""): string => parts.map((_, k) => at(k)).join(between);
  switch (part.localName) {
    case "mfrac":
      return `${grouped(at(0))}/${grouped(at(1))}`;
    case "msqrt":
      return `√${grouped(all())}`;
    case "mroot":
      return `root(${at(1)}, ${at(0)})`;
    case "msup":
    case "mover":
      return `${at(0)}^${grouped(at(1))}`;
    case "msub":
    case "munder":
      return `${at(0)}_${grouped(at(1))}`;
    case "msubsup":
    case "munderover":
      return `${at(0)}_${grouped(at(1))}^${grouped(at(2))}`;
    case "mtable":
      return `[${all("; ")}]`;
    case "mtr":
    case "mlabeledtr":
      return all(", ");
    case "mfenced": {
      const [open, close] = [part.getAttribute("open") ?? "(", part.getAttribute("close") ?? ")"];
      return `${open}${all(`${(part.getAttribute("separators") ?? ",").trim()[0] ?? ""} `)}${close}`;
    }
    case "ms":
      return `"${part.textContent ?? ""}"`;
    case "mspace":
      return " ";
    case "mphantom":
      return "";
    case "mo": {
      const sign = (part.textContent ?? "").trim();
      // What is not seen, such as "times" between two letters, has no sign.
      if (/^[\u2061-\u2064]$/.test(sign)) return "";
      return /^[=<>≤≥≠≈≡∈→⇒+±×·∪∩]$/.test(sign) ? ` ${sign} ` : sign;
    }
    default:
      return parts.length > 0 ? all() : (part.textContent ?? "").trim();
  }
}

/** Returns a part in parentheses, if it is more than a name, a number or such a group. */
function grouped(text: string): string {
  const one = text.trim();
  return /^[\p{Letter}\p{Number}.]*$/u.test(one) || /^\([^()]*\)$/.test(one) ? one : `(${one})`;
}
