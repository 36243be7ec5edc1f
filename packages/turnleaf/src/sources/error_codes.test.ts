import ts from "typescript";
import { expect, test } from "vitest";
import { httpError } from "./fetch_bytes.ts";

const sources = import.meta.glob<string>(
  ["../**/*.ts", "!../**/*.test.ts", "!../for_tests/**", "!../**/*.d.ts"],
  { query: "?raw", import: "default", eager: true },
);

/** Returns the texts of the expressions that make a `BookError` without saying its code. */
function withoutCode(text: string): string[] {
  const found: string[] = [];
  const visit = (node: ts.Node): void => {
    if (ts.isNewExpression(node) && node.expression.getText() === "BookError") {
      const detail = node.arguments?.[1];
      const says =
        detail !== undefined &&
        ts.isObjectLiteralExpression(detail) &&
        detail.properties.some(
          (property) => ts.isSpreadAssignment(property) || property.name?.getText() === "code",
        );
      if (!says) found.push(node.getText());
    }
    ts.forEachChild(node, visit);
  };
  visit(ts.createSourceFile("a.ts", text, ts.ScriptTarget.Latest, true));
  return found;
}

test("every error says its code, by which it is said in other languages", () => {
  expect(withoutCode('new BookError("A sentence.")')).toHaveLength(1);
  const all = Object.entries(sources).flatMap(([file, text]) =>
    withoutCode(text).map((error) => `${file}: ${error}`),
  );
  expect(all).toEqual([]);
});

test.each([
  [404, "absent"],
  [410, "absent"],
  [401, "forbidden"],
  [403, "forbidden"],
  [429, "server"],
  [503, "server"],
])("the status %i of a server is an error of its own kind", (status, code) => {
  const error = httpError(status, "book.pdf");
  expect(error).toMatchObject({ name: "BookError", code, status, source: "book.pdf" });
  expect(error.message).toMatch(/^book\.pdf .*\.$/);
});
