/** Zstandard, unpacked as it comes. */

import { Decompress } from "fzstd";

/** A stream as the browser's `DecompressionStream`. What is written to it comes out unpacked. */
export class ZstdStream extends TransformStream<Uint8Array, Uint8Array> {
  constructor() {
    let unpacking: Decompress;
    super({
      start(controller) {
        unpacking = new Decompress((part) => controller.enqueue(part));
      },
      transform(part) {
        unpacking.push(part);
      },
      flush() {
        unpacking.push(new Uint8Array(), true);
      },
    });
  }
}
