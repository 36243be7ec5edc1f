/** The properties of `<turnleaf-book>` that reflect its attributes. */

import {
  type Attribute,
  type AttributeProperties,
  attributeName,
  attributeOf,
  attributeProperties,
  attributes,
} from "../attributes.ts";
import type { TurnleafEventMap, TypedEventElement } from "./events.ts";

/** On a server there is no DOM: importing the package is safe there, using the element is not. */
const Base = (globalThis.HTMLElement ?? class {}) as unknown as new () => TypedEventElement &
  AttributeProperties;

/** An element whose attributes can be read and set as properties. */
export class ReflectingElement extends Base {
  /** @internal */
  protected emit<K extends keyof TurnleafEventMap>(
    name: K,
    detail: TurnleafEventMap[K]["detail"],
  ): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  /**
   * Returns whether no listener cancels an event.
   *
   * @internal
   */
  protected ask<K extends keyof TurnleafEventMap>(
    name: K,
    detail: TurnleafEventMap[K]["detail"],
  ): boolean {
    return this.dispatchEvent(new CustomEvent(name, { detail, cancelable: true }));
  }
}

for (const property of attributeProperties) {
  const name = attributeName(property);
  const { write } = attributes[property] as Attribute<unknown>;
  Object.defineProperty(ReflectingElement.prototype, property, {
    configurable: true,
    enumerable: true,
    get(this: Element) {
      return attributeOf(this, property);
    },
    set(this: Element, value: unknown) {
      const text = write(value);
      if (text === null) this.removeAttribute(name);
      else this.setAttribute(name, text === true ? "" : text);
    },
  });
}

/**
 * Applies properties that were set before the element was defined: they lie on
 * the element and hide the accessors.
 */
export function adopt(element: HTMLElement): void {
  for (const name of Object.keys(element)) {
    if (!(name in Object.getPrototypeOf(element))) continue;
    const value: unknown = Reflect.get(element, name);
    Reflect.deleteProperty(element, name);
    Reflect.set(element, name, value);
  }
}
