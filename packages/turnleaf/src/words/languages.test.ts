import { expect, it } from "vitest";
import { en as controls } from "../controls/texts_en.ts";
import {
  addLanguage,
  elementTexts,
  errorText,
  fill,
  list,
  loadLanguage,
  number,
  pageNamed,
  textsFor,
} from "./languages.ts";
import { plural } from "./plural.ts";
import type { Texts } from "./texts.ts";

it("speaks the language nearest to the one asked for, English where it knows none", async () => {
  expect(await loadLanguage("zh")).toBe(true);
  expect([await loadLanguage("zh-CN"), await loadLanguage("en"), await loadLanguage("xx")]).toEqual(
    [false, false, false],
  );
  const zh = elementTexts("zh").back;
  expect(zh).not.toBe(elementTexts("en").back);
  expect(elementTexts("zh-Hans-CN").back).toBe(zh);
  expect(elementTexts("EN-us").back).toBe("Back of {n}");
  for (const tag of ["", "xx", "constructor", "__proto__", "not a tag"]) {
    expect(elementTexts(tag).back).toBe("Back of {n}");
  }
});

it("fills in texts, and writes numbers and lists as the language does", () => {
  expect(fill("{page} of {n} {else}", { page: "3", n: "{page}" })).toBe("3 of {page} {else}");
  expect(number("de", 12345)).toBe("12.345");
  expect(list("en", ["iv", "v"])).toBe("iv and v");
  expect(plural("en", { one: "{n} place", other: "{n} places" }, 1)).toBe("1 place");
  expect(plural("pl", { few: "{n} miejsca", other: "{n} miejsc" }, 3)).toBe("3 miejsca");
  expect(plural("zh", { one: "no", other: "{n}" }, 1)).toBe("1");
  expect([number("not a tag", 5), list("not a tag", ["a"])]).toEqual(["5", "a"]);
});

it("English stands in for texts that are missing in a language, or of another form", () => {
  addLanguage("pt", { back: "Contracapa", opening: "Abrindo" });
  addLanguage("pt-BR", { opening: "Abrindo o livro", leave: 5, found: "x" } as unknown as Texts);
  const { back, opening, leave, missing } = elementTexts("pt-BR");
  expect([back, opening]).toEqual(["Contracapa", "Abrindo o livro"]);
  expect([leave, missing]).toEqual([elementTexts("en").leave, elementTexts("en").missing]);
  const english = { found: { one: "{n} place", other: "{n} places" } };
  expect(textsFor("pt-BR", english)).toMatchObject(english);
  addLanguage("pl", { found: { few: "{n} miejsca", other: "{n} miejsc" } });
  expect(textsFor("pl", english).found).toEqual({ few: "{n} miejsca", other: "{n} miejsc" });
  addLanguage("xy", null as unknown as Texts);
  expect(elementTexts("xy").back).toBe("Back of {n}");
});

it("says what errors mean in a language, where that has a sentence for them", async () => {
  await loadLanguage("de");
  expect(errorText("de-AT", "gone")).toMatch(/^\{source\} kann nicht mehr gelesen werden/);
  expect(errorText("en", "gone")).toBeUndefined();
  addLanguage("de-AT", { errors: { gone: "Weg ist {source}" } as Texts["errors"] });
  expect(errorText("de-AT", "gone")).toBe("Weg ist {source}");
  expect(errorText("de-AT", "empty")).toBe(errorText("de", "empty"));
});

it("a page is said by its number, in any writing, or by its name alone", () => {
  const said = ["12", "iv", "XII", "A-3", "Cover", "Plate 3", "表紙"].map((one) =>
    pageNamed("en", one),
  );
  const numbers = ["Page 12", "Page iv", "Page XII", "Page A-3"];
  expect(said).toEqual([...numbers, "Cover", "Plate 3", "表紙"]);
});

const names = ["ar", "de", "es", "fr", "ja", "zh"];

it.each(names)(
  "in %s every placeholder of the English text has its place, and no other",
  async (tag) => {
    const { texts } = await import(`./texts_${tag}.ts`);
    const holes = (text: unknown): string[] =>
      [...new Set(JSON.stringify(text).match(/\{\w+\}/g) ?? [])].sort();
    for (const [name, text] of Object.entries({ ...elementTexts("en"), ...controls })) {
      // A language may say a number in words where the form says which it is.
      expect(holes(texts[name]), name).toEqual(holes(text));
    }
    for (const [code, text] of Object.entries(texts.errors)) {
      for (const hole of holes(text)) {
        const known = code === "onPage" ? /\{(page|sentence)\}/ : /\{(source|status|detail)\}/;
        expect(hole, code).toMatch(known);
      }
    }
    for (const [code, text] of Object.entries(texts.warnings)) {
      expect(holes(text), code).toEqual(["{source}"]);
    }
  },
);
