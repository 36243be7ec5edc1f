/** How long and how large the values of a book's style are, with all that they name. */

/** CSS pixels of the units in which books give shadows; others count as the largest. */
const unitPixels: Readonly<Record<string, number>> = { px: 1, pt: 4 / 3, em: 16, rem: 16 };

/** A variable of CSS, where it is used. */
const variable = /var\(\s*(--[^\s,)]+)/g;

/** Arguments of a function, such as a colour's. */
const functionArguments = /\([^()]*\)/g;

/** A length that is not negative, as the browser writes it. */
const positiveLength = /(?<![\w.#-])(\d{1,15}(?:\.\d{1,15})?)([a-z]{1,6})/g;

/** An address in a value that is data. */
export const dataAddress: RegExp = /url\("(data:[^"]*)"\)/g;

/** The values of style sheets, with what they put in by name. */
export class StyleValues {
  readonly #custom = new Map<string, string[]>();
  readonly #lengths = new Map<string, number>();
  readonly #longestAttribute: number;

  /** @param elements those whose attributes may be put in */
  constructor(
    rules: readonly { readonly style: CSSStyleDeclaration }[],
    elements: readonly Element[],
  ) {
    for (const { style } of rules) {
      for (const name of style) {
        if (!name.startsWith("--")) continue;
        const values = this.#custom.get(name) ?? [];
        this.#custom.set(name, values);
        values.push(style.getPropertyValue(name));
      }
    }
    let longest = 0;
    for (const { attributes } of elements) {
      for (const { name, value } of attributes) {
        if (!/^(src|href)$/.test(name)) longest = Math.max(longest, value.length);
      }
    }
    this.#longestAttribute = longest;
  }

  /** Returns the characters of a value once what it names is put in, but for data. */
  lengthOf(value: string): number {
    const text = value.replace(dataAddress, "");
    let { length } = text;
    for (const [, name] of text.matchAll(variable)) length += this.#expanded(name ?? "");
    return length + (text.split("attr(").length - 1) * this.#longestAttribute;
  }

  /** Returns all that the variables in a value may be, and those in these, in any order. */
  namedIn(value: string): string {
    const names = new Set<string>();
    const add = (text: string): void => {
      for (const [, name = ""] of text.matchAll(variable)) {
        if (names.has(name)) continue;
        names.add(name);
        this.#custom.get(name)?.forEach(add);
      }
    };
    add(value);
    return [...names].flatMap((name) => this.#custom.get(name) ?? []).join(" ");
  }

  /** Returns how many pixels the blur of a rule's shadows covers beside each of its boxes, or words, at least. */
  blurOf(style: CSSStyleDeclaration): number {
    let pixels = 0;
    for (const name of ["text-shadow", "box-shadow"]) {
      const value = style.getPropertyValue(name);
      if (value === "" || value === "none") continue;
      const text = `${value} ${this.namedIn(value)}`;
      let largest = 0;
      for (const [, count, unit = ""] of text.matchAll(positiveLength)) {
        largest = Math.max(largest, Number(count) * (unitPixels[unit] ?? 16));
      }
      // A blur reaches as far to each side as it is long.
      pixels += text.replace(functionArguments, "").split(",").length * (2 * largest) ** 2;
    }
    return pixels;
  }

  #expanded(name: string): number {
    const known = this.#lengths.get(name);
    if (known !== undefined) return known;
    // One that names itself has no value.
    this.#lengths.set(name, 0);
    const lengths = (this.#custom.get(name) ?? []).map((value) => this.lengthOf(value));
    const length = lengths.reduce((longest, one) => Math.max(longest, one), 0);
    this.#lengths.set(name, length);
    return length;
  }
}
