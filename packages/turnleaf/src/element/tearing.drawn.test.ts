/** Leaves torn out by command and by hand: their pages leave the book, lie beside it, and are put back. */

import { expect, test } from "vitest";
import { clock } from "../for_tests/clock.ts";
import { drawRoughly, happens, keepWhatIsDrawn, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { besideBook, pull, tearableInPlace, tearOutPage5 } from "../for_tests/tearable_books.ts";

keepWhatIsDrawn();
drawRoughly();
test("a leaf is torn out by command, lies beside the book, and is put back", async () => {
  const element = await tearableInPlace();
  const heard: string[] = [];
  for (const name of ["tear", "pageschange", "torn", "turnstart", "pagechange"]) {
    element.addEventListener(name, (event) =>
      heard.push(`${name} ${JSON.stringify((event as CustomEvent).detail)}`),
    );
  }
  expect(besideBook(element)).toBe(0);
  expect(await element.tearOut(5)).toBe(true);
  expect(heard).toEqual([
    'tear {"pages":[5,6]}',
    'pageschange {"pageCount":10}',
    'torn {"pages":[5,6]}',
  ]);
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([10, 1]);
  expect(element.spread).toEqual({ left: 4, right: 5 });
  expect(element.state).toBe("resting");
  await eventually(() => besideBook(element)).toBeGreaterThan(0.2);
  expect(await element.putBack()).toBe(true);
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([12, 0]);
  expect(element.spread).toEqual({ left: 4, right: 5 });
  await eventually(() => besideBook(element)).toBe(0);
  expect(await element.putBack()).toBe(false);
});

test("a page with a folded corner is torn out as it is, crumpled, and put back folded", async () => {
  const element = await tearableInPlace();
  expect(await element.dogEar(5, "head", 0.3)).toBe(true);
  await settled(element);
  const dogEars = [{ page: 5, corner: "head", size: 0.3 }];
  expect(element.dogEars).toEqual(dogEars);
  clock.hold();
  await tearOutPage5(element);
  expect([element.pageCount, element.dogEars]).toEqual([10, []]);
  expect(besideBook(element)).toBeGreaterThan(0.2);
  expect(element.wholeSheet).toBe("folded");
  expect(element.tearAcross({ x: 0, y: 0.5 }, { x: 1, y: 0.5 })).toBe(false);
  expect(element.crumple()).toBe(true);
  expect(element.wholeSheet).toBeNull();
  await clock.until(() => element.settled);
  expect(await element.putBack()).toBe(true);
  await clock.until(() => element.settled);
  expect([element.pageCount, element.dogEars]).toEqual([12, dogEars]);
});

test("a pointer tears a leaf out, carries it, lays it down and takes it again", async () => {
  const element = await tearableInPlace();
  const torn = happens<{ pages: number[] }>(element, "torn");
  const pointer = await pull(element, 30);
  expect((await torn).pages).toEqual([5, 6]);
  expect(element.spread).toEqual({ left: 4, right: 5 });
  // Carried to the table at the right.
  pointer.point("pointermove", 690, 120, { buttons: 1 });
  await clock.pass(300);
  pointer.point("pointerup", 690, 120);
  await settled(element);
  expect(element.state).toBe("resting");
  await eventually(() => besideBook(element)).toBeGreaterThan(0.1);
  // Taken again it is no turn of a page, however it is flicked.
  const turns: Event[] = [];
  element.addEventListener("turnstart", (event) => turns.push(event));
  pointer.point("pointerdown", 660, 160);
  pointer.flick([660, 160], [1500, 160], { buttons: 1 });
  await clock.pass(400);
  pointer.point("pointerup", 1500, 160);
  // Out of sight it is thrown away; its pages can still be put back.
  await eventually(() => besideBook(element)).toBe(0);
  expect(turns).toEqual([]);
  expect(element.tornLeaves).toBe(1);
  expect(await element.putBack()).toBe(true);
  expect(element.pageCount).toBe(12);
});

/** Returns what is drawn while a leaf that was pulled taut first is held over the spine, in grey. */
async function heldOverSpine(tearable: string): Promise<Uint8ClampedArray> {
  const element = await tearableInPlace({ tearable });
  const pointer = await pull(element, 10, 2);
  const { left, right, top } = element.bookBounds as DOMRect;
  const [from, to] = [right, (left + right) / 2];
  for (let k = 1; k <= 20; k++) {
    pointer.point("pointermove", from + ((to - from) * k) / 20, top + 10 + 2 * k, { buttons: 1 });
    await new Promise((resolve) => requestAnimationFrame(resolve));
  }
  await eventually(() => element.settled).toBe(true);
  const drawn = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [190, 80];
  const pen = copy.getContext("2d") as CanvasRenderingContext2D;
  pen.drawImage(drawn, 0, 0, copy.width, copy.height);
  const grey = pen.getImageData(0, 0, copy.width, copy.height).data.filter((_, k) => k % 4 === 0);
  pointer.point("pointerup", to, top + 50);
  return grey;
}

test("a leaf that was pulled taut and taken back turns as any other", async () => {
  const plain = await heldOverSpine("none");
  const tearable = await heldOverSpine("sewn");
  const differing = plain.filter((grey, k) => Math.abs(grey - tearable[k]) > 40).length;
  expect(differing / plain.length).toBeLessThan(0.01);
});
