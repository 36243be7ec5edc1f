import { expect, test } from "vitest";
import formats from "../../../docs/formats.md?raw";
import methods from "../../../docs/methods.md?raw";
import golden from "../../../engine/tests/turns.golden?raw";
import example from "../../../examples/12-models.html?raw";
import attributes from "./attributes.ts?raw";
import { turnModels } from "./leaf_models/model_choice.ts";
import { models } from "./model_names.ts";

test("model_names.ts has the engine's models in their order", () => {
  const engine = [...golden.matchAll(/^loose (\S+)/gm)].map(([, name]) => name);
  expect(models).toEqual(engine);
});

test("docs/formats.md gives every model its number", () => {
  const numbers = models.map((name, index) => `${index + 1} ${name}`).join(", ");
  expect(formats).toContain(`u32 model: ${numbers} |`);
});

test("the comment of `model` in attributes.ts says what every model does", () => {
  const comment = attributes.slice(0, attributes.indexOf("@attribute model\n"));
  for (const name of turnModels) expect(comment).toContain(`\`${name}\``);
});

test("examples/12-models.html offers every model", () => {
  const options = [...example.matchAll(/<option value="([^"]+)"/g)];
  expect(options.map(([, name]) => name).sort()).toEqual([...turnModels].sort());
});

test("docs/methods.md says under “In a book” what every model draws", () => {
  const [, section = ""] = methods.split("\n## In a book\n");
  const [table = ""] = section.split("\n## ");
  for (const name of turnModels) expect(table).toContain(`\`${name}\``);
});
