/** The element in its page: the attributes it writes on itself, and where it is moved to. */

import { afterEach, expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import type { TurnleafBook } from "../element.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";

afterEach(() => document.body.replaceChildren());

const frameOf = (element: TurnleafBook): HTMLElement =>
  element.shadowRoot?.querySelector(".frame") as HTMLElement;

test("no attribute is written on the element", async () => {
  const element = book(scans(6), { cover: "none", duration: "60" });
  const written = element.getAttributeNames();
  await happens(element, "load");
  await element.next();
  await element.zoomTo(2);
  element.controls = true;
  await settled(element);
  expect(element.getAttributeNames()).toEqual([...written, "controls"]);
});

test("Tab, a click and focus() give the book the focus, and keys then turn its pages", async () => {
  const element = book(scans(12), { page: "6", duration: "60" });
  await happens(element, "load");
  const before = document.createElement("button");
  element.before(before);
  before.focus();
  await userEvent.tab();
  expect(document.activeElement).toBe(element);
  expect(element.shadowRoot?.activeElement).toBe(frameOf(element));
  expect(frameOf(element).matches(":focus-visible")).toBe(true);
  const turned = happens(element, "pagechange");
  await userEvent.keyboard("{ArrowRight}");
  await turned;
  expect(element.page).toBe(8);
  element.blur();
  frameOf(element).blur();
  element.focus();
  expect(element.matches(":focus")).toBe(true);
  expect(element.shadowRoot?.activeElement).toBe(frameOf(element));
  frameOf(element).blur();
  await userEvent.click(element, { position: { x: 150, y: 110 } });
  expect(element.shadowRoot?.activeElement).toBe(frameOf(element));
});

test("its page may say that it is not in the order of Tab", async () => {
  const element = book(scans(6), { tabindex: "-1" });
  const after = document.createElement("button");
  element.after(after);
  await happens(element, "load");
  (document.activeElement as HTMLElement | null)?.blur();
  const before = document.createElement("button");
  element.before(before);
  before.focus();
  await userEvent.tab();
  expect(document.activeElement).toBe(after);
});

test("asking how large the book would be beside a panel moves nothing of one that is zoomed", async () => {
  const element = book(scans(12), { page: "6", duration: "60" });
  await happens(element, "load");
  for (const [x, y] of [
    [1, 1],
    [element.clientWidth - 1, element.clientHeight - 1],
  ]) {
    element.zoom = 1;
    await settled(element);
    element.zoomTo(3, { x, y });
    await settled(element);
    const before = element.bookBounds?.toJSON();
    expect(element.fractionBeside(element.clientWidth / 2)).toBeLessThan(1);
    // Not the rectangle: two of them count as equal whatever they are.
    expect(element.bookBounds?.toJSON()).toEqual(before);
  }
});

test("moved within its page it keeps its page and its zoom", async () => {
  const element = book(scans(12), { page: "6", duration: "60" });
  await happens(element, "load");
  element.zoomTo(3, { x: 60, y: 80 });
  await settled(element);
  const shown = () => {
    const text = element.shadowRoot?.querySelector("canvas")?.getAttribute("aria-label");
    return [element.page, element.zoom, text];
  };
  const before = shown();
  const elsewhere = document.createElement("div");
  document.body.append(elsewhere);
  const loaded = happens(element, "load");
  elsewhere.append(element);
  // Also while it opens again.
  expect(element.zoom).toBe(3);
  await loaded;
  await settled(element);
  expect(shown()).toEqual(before);
  // Another book is shown whole.
  const another = happens(element, "load");
  element.pages = scans(4);
  await another;
  expect(element.zoom).toBe(1);
});

test("in another document it is styled, turns and can come back", async () => {
  const complaints: unknown[] = [];
  const hear = (event: ErrorEvent) => complaints.push(event.message);
  addEventListener("error", hear);
  const element = book(scans(12), { page: "6", duration: "60", controls: "" });
  await happens(element, "load");
  await settled(element);
  const iframe = document.createElement("iframe");
  iframe.style.cssText = "width: 400px; height: 300px";
  document.body.append(iframe);
  const inside = iframe.contentDocument as Document;
  for (const [from, to] of [
    [6, inside.body],
    [8, document.body],
  ] as const) {
    const loaded = happens(element, "load");
    to.append(element);
    await loaded;
    await settled(element);
    const bar = () => element.shadowRoot?.querySelector("[part=bar], [role=toolbar]");
    await eventually(bar).not.toBe(null);
    expect(element.ownerDocument).toBe(to.ownerDocument);
    const view = element.ownerDocument.defaultView as Window;
    expect(view.getComputedStyle(frameOf(element)).position).toBe("absolute");
    expect(view.getComputedStyle(bar() as Element).display).toBe("flex");
    expect(element.page).toBe(from);
    expect(await element.next()).toBe(true);
    expect(element.page).toBe(from + 2);
  }
  removeEventListener("error", hear);
  expect(complaints).toEqual([]);
});
