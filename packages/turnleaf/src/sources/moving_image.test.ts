import { expect, test } from "vitest";
import { isMoving } from "./moving_image.ts";
import { latin1 } from "./tiny_pdf.ts";

const blob = (text: string, type: string): Blob => new Blob([latin1(text)], { type });

const screen = "GIF89a\x01\0\x01\0\x80\0\0\xff\xff\xff\0\0\0";
const picture = "\x2c\0\0\0\0\x01\0\x01\0\0\x02\x02\x44\x01\0";
const delay = "\x21\xf9\x04\0\x0a\0\0\0";
const png = (chunk: string): string => `\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR${chunk}IDAT`;

test.each([
  [false, "image/gif", `${screen}${picture};`],
  [false, "image/gif", `${screen}${delay}${picture};${picture}`],
  [true, "image/gif", `${screen}${delay}${picture}${delay}${picture};`],
  [false, "image/gif", screen.slice(0, 9)],
  [false, "image/png", png("")],
  [true, "image/png", png("acTL")],
  [false, "image/webp", "RIFF\0\0\0\0WEBPVP8X\x0a\0\0\0\x10"],
  [true, "image/webp", "RIFF\0\0\0\0WEBPVP8X\x0a\0\0\0\x12"],
  [false, "image/avif", "\0\0\0\x1cftypavif"],
  [true, "image/avif", "\0\0\0\x1cftypavis"],
  [false, "image/jpeg", "\xff\xd8\xff"],
])("it is %s that an %s moves: %j", async (expected, type, text) => {
  expect(await isMoving(blob(text, type))).toBe(expected);
});
