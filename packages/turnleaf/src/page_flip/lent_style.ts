/** Styles and classes of an element of the web page while it is part of a book. */

/** What a book sets on one element, and takes off it again. */
export class LentStyle {
  private readonly element: HTMLElement;
  /** Whether it had the attribute, so that no empty one is left. */
  private readonly hadStyle: boolean;
  private readonly hadClass: boolean;
  /** By property: the value that it had, and the one that was set. */
  private readonly values = new Map<string, { readonly before: string; readonly set: string }>();
  private classes: readonly string[] = [];

  constructor(element: HTMLElement) {
    this.element = element;
    this.hadStyle = element.hasAttribute("style");
    this.hadClass = element.hasAttribute("class");
  }

  /** Sets properties of the element's own style, by their names in CSS. */
  style(properties: Readonly<Record<string, string>>): void {
    const { style } = this.element;
    for (const [name, value] of Object.entries(properties)) {
      const before = this.values.get(name)?.before ?? style.getPropertyValue(name);
      style.setProperty(name, value);
      this.values.set(name, { before, set: style.getPropertyValue(name) });
    }
  }

  /** Gives the element classes, in place of those that it was given before. */
  wear(classes: readonly string[]): void {
    const { classList } = this.element;
    const own = classes.filter((name) => this.classes.includes(name) || !classList.contains(name));
    classList.remove(...this.classes.filter((name) => !own.includes(name)));
    classList.add(...own);
    this.classes = own;
  }

  /** Takes off what was set, but for what others have changed since. */
  restore(): void {
    const { element, hadStyle, hadClass } = this;
    const { style } = element;
    for (const [name, { before, set }] of this.values) {
      if (style.getPropertyValue(name) === set) style.setProperty(name, before);
    }
    this.values.clear();
    this.wear([]);
    // Chromium keeps an empty attribute if properties were set and it is removed at once.
    if (!hadStyle && style.length === 0) {
      element.setAttribute("style", "");
      element.removeAttribute("style");
    }
    if (!hadClass && element.classList.length === 0) element.removeAttribute("class");
  }
}
