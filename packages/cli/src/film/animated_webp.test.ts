import { expect, it } from "vitest";
import { animatedWebp } from "./animated_webp.ts";

/** Returns a file of one picture whose data is some bytes, after a chunk that is none of it. */
function still(data: readonly number[]): Uint8Array {
  const chunk = (name: string, bytes: readonly number[]): number[] => [
    ...Buffer.from(name),
    ...[bytes.length, 0, 0, 0],
    ...bytes,
    ...(bytes.length % 2 ? [0] : []),
  ];
  const body = [...Buffer.from("WEBP"), ...chunk("EXIF", [9, 9, 9]), ...chunk("VP8 ", data)];
  return Uint8Array.from([...Buffer.from("RIFF"), body.length, 0, 0, 0, ...body]);
}

/** Returns the chunks of a file from a byte on, by name. */
function chunksOf(bytes: Buffer, from: number): [string, Buffer][] {
  const found: [string, Buffer][] = [];
  for (let at = from; at < bytes.length; ) {
    const length = bytes.readUInt32LE(at + 4);
    found.push([bytes.toString("latin1", at, at + 4), bytes.subarray(at + 8, at + 8 + length)]);
    at += 8 + length + (length % 2);
  }
  return found;
}

it("holds each picture's own data, where it goes and how long it is seen", () => {
  const file = animatedWebp(
    [
      { still: still([1, 2, 3]), x: 0, y: 0, width: 800, height: 500, milliseconds: 40 },
      { still: still([4, 5]), x: 300, y: 20, width: 70, height: 60, milliseconds: 1000 },
    ],
    800,
    500,
  );
  expect(file.toString("latin1", 0, 4) + file.toString("latin1", 8, 12)).toBe("RIFFWEBP");
  expect(file.readUInt32LE(4)).toBe(file.length - 8);
  const chunks = chunksOf(file, 12);
  expect(chunks.map(([name]) => name)).toEqual(["VP8X", "ANIM", "ANMF", "ANMF"]);
  const [header, loop, ...pictures] = chunks.map(([, data]) => data) as [Buffer, Buffer];
  expect([header[0], header.readUIntLE(4, 3), header.readUIntLE(7, 3)]).toEqual([2, 799, 499]);
  // For ever.
  expect(loop.readUInt16LE(4)).toBe(0);
  const places = pictures.map((one: Buffer) => [0, 3, 6, 9, 12].map((at) => one.readUIntLE(at, 3)));
  expect(places).toEqual([
    [0, 0, 799, 499, 40],
    [150, 10, 69, 59, 1000],
  ]);
  const data = pictures.map((one: Buffer) => chunksOf(one, 16));
  expect(data.map((chunks) => chunks.map(([name, bytes]) => [name, ...bytes]))).toEqual([
    [["VP8 ", 1, 2, 3]],
    [["VP8 ", 4, 5]],
  ]);
});
