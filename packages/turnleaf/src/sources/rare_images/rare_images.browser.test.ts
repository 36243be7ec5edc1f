import { describe, expect, it } from "vitest";
import { messageOf } from "../message_of.ts";
import { openSource } from "../open.ts";
import { BookError } from "../page_source.ts";

const never = new AbortController().signal;

const fixture = async (name: string): Promise<File> => {
  const response = await fetch(new URL(`./fixtures/${name}`, import.meta.url));
  return new File([await response.blob()], name);
};

/** Returns the colours in the middle of the quarters of a page, left to right and top to bottom. */
async function quartersOf(image: string | File): Promise<number[][]> {
  const source = await openSource(typeof image === "string" ? await fixture(image) : image);
  const { width, height } = await source.size(0);
  const drawn = (await source.draw(0, width, never)) as ImageBitmap;
  expect([drawn.width, drawn.height]).toEqual([width, height]);
  const pen = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true })!;
  pen.drawImage(drawn, 0, 0);
  source.close();
  const places = [1, 3].flatMap((y) => [1, 3].map((x) => [(x * width) / 4, (y * height) / 4]));
  return places.map(([x, y]) => [...pen.getImageData(x!, y!, 1, 1).data]);
}

const [red, green, blue, white, black] = [
  [255, 0, 0, 255],
  [0, 255, 0, 255],
  [0, 0, 255, 255],
  [255, 255, 255, 255],
  [0, 0, 0, 255],
];
const colours = [red, green, blue, white];
const halves = [black, white, black, white];

/** Expects colours, each channel by no more than a distance from what it should be. */
function expectColours(seen: number[][], meant: (number[] | undefined)[], distance: number): void {
  const far = seen.flatMap((one, k) => one.map((c, i) => Math.abs(c - (meant[k]?.[i] ?? -999))));
  expect(Math.max(...far), JSON.stringify(seen)).toBeLessThanOrEqual(distance);
}

describe("images of formats that few browsers show", () => {
  it.each([
    ...["rgb-raw.tif", "rgb-lzw.tif", "rgb-adobe_deflate.tif", "rgb-packbits.tif", "rgba.tif"],
    ...["palette.tif", "cmyk.tif", "deep.tif", "deep-big-endian.tif", "tiles.tif", "strips.tif"],
    ...["rgb.jp2", "rgb.j2k", "rgba.jp2", "rgb.jxl", "rgba.jxl"],
    ...["float-rgb.tif", "float-rgb-be.tif", "float-rgb255.tif", "float-pred3.tif"],
    ...["half-rgb.tif", "double-rgb.tif"],
    ...["11", "21", "22", "42", "-default", "-range"].map((way) => `ycbcr-raw${way}.tif`),
  ])("%s has its colours", async (name) => {
    expectColours(await quartersOf(name), colours, 1);
  });

  it.each(["rgb-jpeg.tif", "ycbcr-jpeg.tif", "lossy.jp2", "lossy.jxl"])(
    "%s has about its colours",
    async (name) => {
      expectColours(await quartersOf(name), colours, 40);
    },
  );

  it.each([
    ...["bits-group3.tif", "bits-group4.tif", "bits-raw.tif", "grey.tif", "grey-alpha.tif"],
    ...["grey.jp2", "grey-alpha.jp2", "deep.jp2", "grey.jxl"],
  ])("%s is black and white", async (name) => {
    expectColours(await quartersOf(name), halves, 1);
  });

  it.each(["float-grey.tif", "float-grey-be.tif", "float-grey255.tif", "half-grey.tif"])(
    "%s, of floating-point numbers, is white and black",
    async (name) => {
      expectColours(await quartersOf(name), [white, black, white, black], 1);
    },
  );

  it.each([
    ["cmyk-adobe.jpg", colours],
    ["cmyk-unmarked.jpg", colours],
    ["cmyk-turned.jpg", [blue, red, white, green]],
  ])("%s, in the colours of print, has about its colours", async (name, meant) => {
    expectColours(await quartersOf(name), meant, 8);
  });

  it.each([
    [1, colours],
    [2, [green, red, white, blue]],
    [3, [white, blue, green, red]],
    [4, [blue, white, red, green]],
    [5, [red, blue, green, white]],
    [6, [blue, red, white, green]],
    [7, [white, green, blue, red]],
    [8, [green, white, red, blue]],
  ])("a TIFF of orientation %i is upright", async (orientation, meant) => {
    expectColours(await quartersOf(`turned-${orientation}.tif`), meant, 1);
  });

  it.each([
    ["planes.tif", "its colours are stored one after another"],
    ["big.tif", "it is a BigTIFF"],
  ])("%s is rejected with its reason: %s", async (name, reason) => {
    const source = await openSource(await fixture(name));
    expect(await messageOf(source.draw(0, 10, never))).toBe(
      `Page 1 of ${name} is a TIFF that is damaged or of a kind that cannot be read (${reason}); convert it to PNG or JPEG.`,
    );
  });

  it.each([
    [262, 8, "its colours are of Lab"],
    [258, 32, "its samples are whole numbers of 32 bits"],
  ])("a TIFF of whose tag %i is %i is rejected with its reason: %s", async (tag, said, reason) => {
    const bytes = new Uint8Array(await (await fixture("grey.tif")).arrayBuffer());
    const isLittle = bytes[0] === 0x49;
    const view = new DataView(bytes.buffer);
    const directory = view.getUint32(4, isLittle);
    for (let k = 0; k < view.getUint16(directory, isLittle); k++) {
      const entry = directory + 2 + 12 * k;
      if (view.getUint16(entry, isLittle) === tag) view.setUint16(entry + 8, said, isLittle);
    }
    const source = await openSource(new File([bytes], "a.tif"));
    expect(await messageOf(source.draw(0, 10, never))).toBe(
      `Page 1 of a.tif is a TIFF that is damaged or of a kind that cannot be read (${reason}); convert it to PNG or JPEG.`,
    );
  });

  it.each([
    // Tag 256, and the right edge in the marker SIZ.
    ["rgb-raw.tif", [0, 1, 4, 0], 8, 0xff, 2],
    ["rgb.j2k", [0xff, 0x51], 6, 0x7f, 4],
  ])(
    "%s of too many pixels is rejected before it is decoded",
    async (name, mark, at, byte, count) => {
      const bytes = new Uint8Array(await (await fixture(name)).arrayBuffer());
      const place = bytes.findIndex((_, k) => mark.every((one, j) => bytes[k + j] === one)) + at;
      bytes.fill(byte, place, place + count);
      // And the height beside it.
      bytes.fill(byte, place + (count === 2 ? 12 : 4), place + (count === 2 ? 14 : 8));
      const source = await openSource(new File([bytes], name));
      expect(await messageOf(source.draw(0, 10, never))).toMatch(
        /has \d+ x \d+ pixels, more than can be shown; make it smaller\.$/,
      );
    },
  );

  it.each(["rgb-lzw.tif", "bits-group4.tif", "rgb-jpeg.tif", "rgb.jp2"])(
    "%s that is cut off or garbled is drawn or rejected in a sentence",
    async (name) => {
      const whole = new Uint8Array(await (await fixture(name)).arrayBuffer());
      for (const [length, step] of [
        [whole.length >> 1, 0],
        [whole.length, 7],
      ] as const) {
        const bytes = whole.slice(0, length);
        for (let k = 24; step > 0 && k < length; k += step) bytes[k] = 255 - (bytes[k] as number);
        const source = await openSource(new File([bytes], name));
        const drawn = source.draw(0, 10, never).then(
          () => "drawn",
          (error: unknown) => (error instanceof BookError ? error.message : `a fault: ${error}`),
        );
        expect(await drawn).toMatch(/^drawn$|(convert it to PNG or JPEG|make it smaller)\.$/);
      }
    },
  );

  it("a list of four billion values that a TIFF does not have is not read, and its picture is", async () => {
    const bytes = new Uint8Array(await (await fixture("rgb-raw.tif")).arrayBuffer());
    const directory = new DataView(bytes.buffer, new DataView(bytes.buffer).getUint32(4, true));
    // Its last entry becomes a private one.
    const last = 2 + 12 * (directory.getUint16(0, true) - 1);
    directory.setUint16(last, 65_000, true);
    directory.setUint16(last + 2, 4, true);
    directory.setUint32(last + 4, 0xffff_ffff, true);
    expectColours(await quartersOf(new File([bytes], "list.tif")), colours, 1);
  });

  it("a HEIC is rejected with what it is", async () => {
    const source = await openSource(await fixture("rgb.heic"));
    expect(await messageOf(source.draw(0, 10, never))).toBe(
      "Page 1 of rgb.heic is a HEIC, which this browser does not show; convert it to PNG or JPEG.",
    );
  });
});
