/** For tests only: what is in an archive, unpacked in this thread. */

import { unpack } from "../../../packed.ts";
import { type Unpacked, type UnpackingBounds, unpackAll } from "./unpack_all.ts";
import type { Packing } from "./unpacker.ts";
import packed from "./unpacker.wasm";

/** Bounds that small archives keep. */
export const bounds: UnpackingBounds = {
  entries: 100,
  fileBytes: 1_000_000,
  allBytes: 8_000_000,
  pathLength: 300,
};

/** Returns everything that comes of an archive's bytes. */
export async function unpacked(
  bytes: Uint8Array,
  within: Partial<UnpackingBounds> = {},
  packing: Packing = "archive",
): Promise<Unpacked[]> {
  const read = (offset: number, length: number) => bytes.subarray(offset, offset + length);
  const all: Unpacked[] = [];
  const archive = { length: bytes.length, read };
  const code = await unpack(packed);
  for await (const one of unpackAll(code, archive, { ...bounds, ...within }, packing)) {
    all.push(one);
  }
  return all;
}
