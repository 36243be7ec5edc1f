import { expect, test } from "vitest";
import { legacyText } from "./legacy_encoding.ts";

/** Returns a text in an encoding of one byte a letter. */
function encoded(text: string, encoding: string): Uint8Array {
  const decoder = new TextDecoder(encoding);
  const letters = Array.from({ length: 256 }, (_, byte) => decoder.decode(Uint8Array.of(byte)));
  return Uint8Array.from(text, (letter) => letters.indexOf(letter));
}

const greek =
  "Άνδρα μοι έννεπε, μούσα, πολύτροπον, ος μάλα πολλά πλάγχθη, επεί Τροίης ιερόν πτολίεθρον έπερσε. Άλλοι δε, Άργος και Αθήνα.";
const texts = {
  French:
    "Longtemps, je me suis couché de bonne heure. Parfois, à peine ma bougie éteinte, mes yeux se fermaient si vite que je n’avais pas le temps de me dire : « Je m’endors. » Et, une demi-heure après, la pensée qu’il était temps de chercher le sommeil m’éveillait.",
  German:
    "Es war einmal ein König, der hatte eine Tochter; die war so schön, dass die Sonne sich verwunderte. Über die Brücke führte der Weg, und niemand hörte “Grüße”.",
  Spanish:
    "En un lugar de la Mancha, de cuyo nombre no quiero acordarme, no ha mucho tiempo que vivía un hidalgo de los de lanza en astillero, adarga antigua, rocín flaco y galgo corredor. Tenía en su casa una ama que pasaba de los cuarenta años, y una sobrina que no llegaba a más, y también después.",
};

test.each(["windows-1253", "iso-8859-7"])("Greek in %s", (encoding) => {
  expect(legacyText(encoded(greek, encoding))).toBe(greek);
});

test.each(
  Object.entries(texts).flatMap(([language, text]) =>
    ["macintosh", "windows-1252"].map((encoding) => [language, encoding, text] as const),
  ),
)("%s in %s", (_, encoding, text) => {
  expect(legacyText(encoded(text, encoding))).toBe(text);
});

test("English with signs alone is that of Windows", () => {
  const text = "“Don’t,” he said – and left… It was Ahab’s £5—or “mine”.";
  expect(legacyText(encoded(text, "windows-1252"))).toBe(text);
});
