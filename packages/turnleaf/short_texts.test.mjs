import { expect, test } from "vitest";
import { shortened } from "./short_texts.js";

// What is put in stands in the text as it is written.
const [chunk, half] = ["chunk", "number(0.5)"].map((inside) => `\${${inside}}`);

test("a shader keeps its directives' lines and loses comments and spaces", () => {
  const text = [
    "const chunk = 1; // stays",
    "const shader = /* glsl */ `",
    "varying vec2 vUv; // what is seen",
    "#ifdef ROLLED",
    "  // turned",
    "  float a = b - -c * ( d + 1.0 ) - 10.05 / 0.50;",
    "#else",
    "  return  x;",
    "#endif",
    chunk,
    `vec3 light() { return vec3(${half}, 1.0); }\`;`,
  ].join("\n");
  expect(shortened(text).split("\n")).toEqual([
    "const chunk = 1; // stays",
    "const shader = /* glsl */ `varying vec2 vUv;",
    "#ifdef ROLLED",
    "float a=b - -c*(d+1.)-10.05/.50;",
    "#else",
    "return x;",
    "#endif",
    chunk,
    `vec3 light(){return vec3(${half},1.);}\`;`,
  ]);
});

test("a style keeps the spaces that mean something", () => {
  const text = `/* css */ \`
/* A bar. */
.bar :focus-visible, .bar:not([a], [b]) {
  margin: 0 auto; inset: calc(1px + 2px) 0;
}
@media (min-width: 30em) and (hover) { .a { color: red; } }\``;
  expect(shortened(text)).toBe(
    "/* css */ `.bar :focus-visible,.bar:not([a],[b]){margin:0 auto;inset:calc(1px + 2px) 0}" +
      "@media (min-width:30em) and (hover){.a{color:red}}`",
  );
});

test("other template strings stay as they are", () => {
  expect(shortened("const a = `x  ;  y`")).toBe("const a = `x  ;  y`");
});
