/** Mutated files are read or rejected here as the engine reads or rejects them. */
import { expect, it } from "vitest";
import corner from "../../../../engine/tests/fixtures/corner.tlkf?inline";
import cornerWhole from "../../../../engine/tests/fixtures/corner-whole.tlkf?inline";
import folded from "../../../../engine/tests/fixtures/folded.tlkf?inline";
import usual from "../../../../engine/tests/fixtures/mutated.verdicts?raw";
import inScript from "../../../../engine/tests/fixtures/recorded-in-script.tlkf?inline";
import { fuzz, Random, seed } from "../for_tests/random_numbers.ts";
import { checksum, checksumLength } from "./file.ts";
import { decodeTurn, TurnError } from "./key_frames.ts";

const files = [corner, cornerWhole, inScript, folded].map((file) =>
  Uint8Array.from(atob(file.slice(file.indexOf(",") + 1)), (c) => c.charCodeAt(0)),
);

/** A sound file with some bytes changed, as `mutated` in engine/tests/hostile_key_frames.rs changes them. */
function mutated(random: Random): Uint8Array {
  let bytes = [...random.among(files)];
  const way = random.below(8);
  if (way === 0) bytes = bytes.slice(0, random.below(bytes.length));
  else if (way === 1) for (let k = random.below(16); k >= 0; k--) bytes.push(random.below(256));
  for (let k = random.below(4); k > 0 && bytes.length > 0; k--) {
    const within = random.below(2) === 0 ? 64 : bytes.length;
    const at = random.below(Math.min(within, bytes.length));
    const how = random.below(4);
    if (how === 0) bytes[at] ^= 1 << random.below(8);
    else bytes[at] = how === 1 ? 0 : how === 2 ? 255 : random.below(256);
  }
  const file = Uint8Array.from(bytes);
  if (random.below(8) > 0 && file.length >= checksumLength) {
    const end = file.length - checksumLength;
    file.set(checksum(file.subarray(0, end)), end);
  }
  return file;
}

/** Address of the engine's verdicts on another seed or more rounds. */
const other: string | undefined = import.meta.env.TURNLEAF_VERDICTS;

it.skipIf((seed !== 1 || fuzz !== 1) && other === undefined)(
  `gives the engine's verdicts (seed ${seed})`,
  { timeout: 120_000 * fuzz },
  async () => {
    const verdicts: string = other
      ? (await import(/* @vite-ignore */ `${other}?raw`)).default
      : usual;
    expect(verdicts).toMatch(/^[01]{2000,}$/);
    const random = new Random();
    for (const [round, verdict] of [...verdicts].entries()) {
      const file = mutated(random);
      let reason = "";
      try {
        decodeTurn(file);
      } catch (error) {
        expect(error).toBeInstanceOf(TurnError);
        reason = (error as TurnError).message;
      }
      const plays = reason === "" ? "1" : "0";
      expect(plays, `seed ${seed}, round ${round}: ${reason}`).toBe(verdict);
    }
  },
);
