/** Pointer and keys as WebDriver has them: the same in its classic form and in BiDi. */

import type { Key } from "./driven_browser.ts";

/** Input sources with their actions, as `performActions` takes them. */
export type Actions = readonly object[];

/** Code points that WebDriver has for keys without a character. */
const codes: Partial<Record<Key, string>> = {
  ArrowLeft: "\uE012",
  ArrowRight: "\uE014",
  Control: "\uE009",
};

const pointer = (...actions: readonly object[]): Actions => [
  { type: "pointer", id: "mouse", parameters: { pointerType: "mouse" }, actions },
];

const key = (type: "keyDown" | "keyUp", name: Key): object => ({
  type,
  value: codes[name] ?? name,
});

export const movePointer = (x: number, y: number): Actions =>
  pointer({ type: "pointerMove", x: Math.round(x), y: Math.round(y), duration: 0 });

export const pressButton = (): Actions => pointer({ type: "pointerDown", button: 0 });

export const releaseButton = (): Actions => pointer({ type: "pointerUp", button: 0 });

export const doubleClick = (): Actions => {
  const click = [
    { type: "pointerDown", button: 0 },
    { type: "pointerUp", button: 0 },
  ];
  return pointer(...click, ...click);
};

export const pressKeys = (...keys: readonly Key[]): Actions => {
  const down = keys.map((name) => key("keyDown", name));
  const up = keys.toReversed().map((name) => key("keyUp", name));
  return [{ type: "key", id: "keyboard", actions: [...down, ...up] }];
};
