/** What docs/requests.md says that there is, or is not, agrees with the tests that there are. */
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";

const root = join(import.meta.dirname, "..");
const page = readFileSync(join(root, "docs/requests.md"), "utf8");
const rows = [...page.matchAll(/^\| (\d+) \| (.*) \| (.*) \| (.*) \|$/gm)].map(
  ([, number, asked, reply, shown]) => ({ number: Number(number), asked, reply, shown }),
);

/** What is tested, by a word for it in a request, and the folder of its tests. */
const tested = [
  ...readdirSync(join(root, "tests/apps")).map((name) => ({ word: name, tests: "tests/apps" })),
  ...readdirSync(join(root, "packages/cli/tests/engines")).flatMap((name) => {
    const word = { "firefox.ts": "Firefox", "webkit.ts": "Safari|iOS" }[name];
    return word ? [{ word, tests: "packages/cli/tests/engines" }] : [];
  }),
  ...readdirSync(join(root, "packages/turnleaf/src/frameworks")).flatMap((name) => {
    const [, word] = /^(\w+)\.browser\.test\.ts$/.exec(name) ?? [];
    return word ? [{ word, tests: "packages/turnleaf/src/frameworks" }] : [];
  }),
];

test("the requests are numbered, and each names what shows its reply", () => {
  expect(rows.map(({ number }) => number)).toEqual(Array.from({ length: 25 }, (_, i) => i + 1));
  for (const { number, shown } of rows) {
    expect(shown, `request ${number}`).toMatch(/\]\([^)]*\.test\.\w+\)/);
  }
});

test("what has tests is not said to have none, and they are named", () => {
  const errors = rows.flatMap(({ number, asked, reply, shown }) =>
    tested.flatMap(({ word, tests }) => {
      if (!new RegExp(`\\b(${word})\\b`, "i").test(asked)) return [];
      const isNamed = `${reply} ${shown}`.includes(tests);
      // Safari's engine is tested, and Safari itself is not.
      const denied = reply
        .replace(/\w+ itself is not tested/g, "")
        .match(/not tested|\*\*Open|alone\./i);
      return [
        ...(isNamed ? [] : [`${number}: ${word} is tested in ${tests}, which it does not name`]),
        ...(denied ? [`${number}: ${word} is tested in ${tests}, and it says "${denied[0]}"`] : []),
      ];
    }),
  );
  expect(errors).toEqual([]);
});
