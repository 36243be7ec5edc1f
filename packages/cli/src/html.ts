/** HTML whose values are escaped where they are put in. */

/** Markup: made by `html` alone, so that everything in it is escaped. */
export class Html {
  readonly text: string;

  private constructor(text: string) {
    this.text = text;
  }

  /** @internal Joins literal markup and escaped values. */
  static join(literals: readonly string[], values: readonly Content[]): Html {
    return new Html(literals.map((literal, k) => literal + textOf(values[k])).join(""));
  }
}

/** What may stand in a template: text, which is escaped, markup, and lists of both. */
export type Content = string | number | Html | null | undefined | false | readonly Content[];

/** Returns markup; values are escaped, for elements and for quoted attributes. */
export function html(literals: TemplateStringsArray, ...values: readonly Content[]): Html {
  return Html.join(literals, values);
}

/** Returns `text` with the characters escaped that have a meaning in HTML and XML. */
export function escapeText(text: string): string {
  return text.replace(/[&<>"']/g, (character) => `&#${character.charCodeAt(0)};`);
}

function textOf(content: Content): string {
  if (content === null || content === undefined || content === false) return "";
  if (content instanceof Html) return content.text;
  if (Array.isArray(content)) return content.map(textOf).join("");
  return escapeText(String(content));
}
