/** Whether an image file holds several pictures that are shown one after the other. */

/** Bytes in which a PNG's control of its animation is searched for: it stands before the picture. */
const headLength = 1 << 16;

/** Bytes of the header of a GIF, and of that of each of its pictures behind their mark. */
const [gifHeader, pictureHeader] = [13, 9];

/** Marks of blocks of a GIF: a picture, and what is said beside it. */
const [pictureMark, extensionMark] = [0x2c, 0x21];

/** Returns whether a typed image moves: a GIF, PNG, WebP or AVIF of several pictures. */
export async function isMoving(image: Blob): Promise<boolean> {
  if (image.type === "image/gif") {
    return hasPictures(new Uint8Array(await image.arrayBuffer()), 2);
  }
  if (!/^image\/(png|webp|avif)$/.test(image.type)) return false;
  const bytes = new Uint8Array(await image.slice(0, headLength).arrayBuffer());
  const head = new TextDecoder("latin1").decode(bytes);
  if (image.type === "image/avif") return head.startsWith("ftypavis", 4);
  if (image.type === "image/webp") return head.startsWith("VP8X", 12) && ((bytes[20] ?? 0) & 2) > 0;
  const at = head.indexOf("acTL");
  return at >= 0 && at < head.indexOf("IDAT");
}

/** Returns whether a GIF has at least so many pictures. */
function hasPictures(bytes: Uint8Array, count: number): boolean {
  const tableLength = (flags = 0): number => (flags & 0x80 ? 3 * 2 ** ((flags & 7) + 1) : 0);
  let at = gifHeader + tableLength(bytes[10]);
  let found = 0;
  while (at < bytes.length) {
    const mark = bytes[at++];
    if (mark === pictureMark) {
      found += 1;
      if (found >= count) return true;
      // A byte behind its colours says how its pixels are packed.
      at += pictureHeader + tableLength(bytes[at + pictureHeader - 1]) + 1;
    } else if (mark === extensionMark) at += 1;
    else return false;
    // Parts with their lengths, of which the last has none.
    for (let length = bytes[at++] ?? 0; length > 0; length = bytes[at++] ?? 0) at += length;
  }
  return false;
}
