/** A formula as screen readers read it: MathML, of which nothing but what is drawn and said is taken over. */

const mathml = "http://www.w3.org/1998/Math/MathML";

/** Elements and attributes of a formula that have a meaning; the rest is looks, or could do something. */
const elements =
  /^(math|mrow|mi|mn|mo|mtext|ms|mspace|mfrac|msqrt|mroot|msub|msup|msubsup|munder|mover|munderover|mmultiscripts|mprescripts|none|mtable|mtr|mlabeledtr|mtd|mfenced|menclose|mphantom|mpadded|mstyle|merror)$/;
const attributes =
  /^(display|intent|arg|linethickness|notation|open|close|separators|mathvariant|accent|accentunder|form|fence|separator|stretchy)$/;

/** Elements within each other, and all of them, that are taken over. */
const deepest = 60;
const most = 5000;

/** Returns a formula that is read and not seen; null if the markup is none. */
export function formulaOf(markup: string): MathMLElement | null {
  const { documentElement } = new DOMParser().parseFromString(markup, "application/xml");
  let left = most;
  const copy = (part: Element, depth: number): MathMLElement | null => {
    if (part.namespaceURI !== mathml || !elements.test(part.localName)) return null;
    if (depth > deepest || left-- <= 0) return null;
    const made = document.createElementNS(mathml, part.localName) as MathMLElement;
    for (const { name, value } of part.attributes) {
      if (attributes.test(name)) made.setAttribute(name, value);
    }
    for (const child of part.childNodes) {
      if (child instanceof Text) made.append(child.data);
      else if (child instanceof Element) made.append(copy(child, depth + 1) ?? "");
    }
    return made;
  };
  return documentElement.localName === "math" ? copy(documentElement, 0) : null;
}
