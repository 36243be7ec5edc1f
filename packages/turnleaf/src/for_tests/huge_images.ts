/** The beginnings of images that claim 50,000 by 50,000 pixels, by their format; for tests only. */

const hex = (digits: string): Uint8Array<ArrayBuffer> =>
  Uint8Array.from(digits.replaceAll(" ", "").match(/../g) ?? [], (two) => Number.parseInt(two, 16));

/** 50,000 is c350, and less one c34f. */
export const hugeImages: Readonly<Record<string, Uint8Array<ArrayBuffer>>> = {
  png: hex("89504e470d0a1a0a 0000000d49484452 0000c350 0000c350 0806000000 00000000"),
  jpeg: hex("ffd8 ffe000104a46494600010100000100010000 ffc00011 08 c350 c350 03012200021101031101"),
  gif: hex("474946383961 50c3 50c3 000000 2c 0000 0000 50c3 50c3 00 02 02 4c01 00 3b"),
  webp: hex("52494646 1e000000 57454250 56503858 0a000000 10000000 4fc300 4fc300"),
  avif: hex(
    "0000001c 66747970 61766966 00000000 61766966 6d696631 6d696166 0000003c 6d657461 00000000 00000030 69707270 00000028 6970636f 00000014 69737065 00000000 00000100 00000100 00000014 69737065 00000000 0000c350 0000c350",
  ),
};
