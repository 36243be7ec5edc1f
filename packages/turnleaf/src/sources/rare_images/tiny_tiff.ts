/** Small TIFFs of several pictures; for tests only. */

/** A picture of one colour. */
export interface TinyPicture {
  readonly colour: readonly [red: number, green: number, blue: number];
  readonly width?: number;
  readonly height?: number;
  /** Its kind: bits that say whether it is smaller, of several pages, or a mask. The default has none. */
  readonly subfile?: number;
  /** The old number of its kind. */
  readonly oldSubfile?: number;
  readonly orientation?: number;
}

/** Builds a TIFF of pictures in order, not packed. */
export function tinyTiff(
  pictures: readonly TinyPicture[],
  isLittle = true,
): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(8 + pictures.reduce((sum, one) => sum + lengthOf(one), 0));
  const view = new DataView(bytes.buffer);
  const put16 = (at: number, value: number): void => view.setUint16(at, value, isLittle);
  const put32 = (at: number, value: number): void => view.setUint32(at, value, isLittle);
  bytes.set(isLittle ? [0x49, 0x49] : [0x4d, 0x4d]);
  put16(2, 42);
  let link = 4;
  let at = 8;
  for (const picture of pictures) {
    const { width, height } = sizeOf(picture);
    put32(link, at);
    const tags = tagsOf(picture);
    const end = at + 2 + 12 * tags.length;
    const pixels = end + 4 + 6;
    put16(at, tags.length);
    tags.forEach(([tag, type, value], k) => {
      const entry = at + 2 + 12 * k;
      put16(entry, tag);
      put16(entry + 2, type);
      put32(entry + 4, tag === 258 ? 3 : 1);
      const said = tag === 273 ? pixels : tag === 258 ? end + 4 : value;
      if (type === 3 && tag !== 258) put16(entry + 8, said);
      else put32(entry + 8, said);
    });
    for (const k of [0, 1, 2]) put16(end + 4 + 2 * k, 8);
    for (let k = 0; k < width * height; k++) bytes.set(picture.colour, pixels + 3 * k);
    link = end;
    at += lengthOf(picture);
  }
  return bytes;
}

const sizeOf = ({ width = 8, height = 12 }: TinyPicture) => ({ width, height });

function lengthOf(picture: TinyPicture): number {
  const { width, height } = sizeOf(picture);
  const length = 2 + 12 * tagsOf(picture).length + 4 + 6 + 3 * width * height;
  return length + (length & 1);
}

/** Returns the tags of a picture with their types, 3 of two bytes and 4 of four, and their values. */
function tagsOf(picture: TinyPicture): (readonly [tag: number, type: number, value: number])[] {
  const { width, height } = sizeOf(picture);
  const { subfile, oldSubfile, orientation = 1 } = picture;
  return [
    ...(subfile === undefined ? [] : [[254, 4, subfile] as const]),
    ...(oldSubfile === undefined ? [] : [[255, 3, oldSubfile] as const]),
    [256, 4, width],
    [257, 3, height],
    [258, 3, 0],
    [259, 3, 1],
    [262, 3, 2],
    [273, 4, 0],
    [274, 3, orientation],
    [277, 3, 3],
    [278, 4, height],
    [279, 4, 3 * width * height],
  ];
}
