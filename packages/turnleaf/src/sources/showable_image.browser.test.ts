import { expect, it } from "vitest";
import { pictureData } from "./showable_image.ts";

it.each(["rgb-lzw.tif", "rgb.jp2"])(
  "a picture in a book that is %s is written as PNG",
  async (name) => {
    const response = await fetch(new URL(`./rare_images/fixtures/${name}`, import.meta.url));
    const bytes = new Uint8Array(await response.arrayBuffer());
    const address = await pictureData(bytes, name);
    expect(address).toMatch(/^data:image\/png;base64,/);
    const image = new Image();
    image.src = address ?? "";
    await image.decode();
    expect([image.naturalWidth, image.naturalHeight]).toEqual([24, 16]);
  },
);
