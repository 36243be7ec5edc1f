/**
 * Any numbers at every export of the machine code that is shipped: nothing traps,
 * hangs, or draws what is no number. All calls are made in a process of their own,
 * which is given up after two minutes of a few seconds' work, so that a hang fails.
 */
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import test from "node:test";

const seed = process.env.SEED ?? "20260729";
const patience = 120_000;

/** Runs `any_numbers.mjs` on the machine code of a file. */
function run(...words) {
  const script = join(import.meta.dirname, "any_numbers.mjs");
  const options = { encoding: "utf8", timeout: patience };
  const { status, signal, stdout, stderr } = spawnSync(
    process.execPath,
    [script, ...words, seed],
    options,
  );
  const end = signal ? `stopped after ${patience / 1000} s` : `exit ${status}`;
  assert.equal(status, 0, `SEED=${seed} ${words.join(" ")}: ${end}\n${stdout}\n${stderr}`);
}

test("every function of a book takes any number", () => run("book"));
test("every function of a loose leaf takes any number", () => run("leaf"));
test("no call steps a book by more than a minute", () => run("step"));
