/**
 * Writes small books, PDFs of two pages with text, and their catalogue.
 *
 *   node tests/cluster/make_books.mjs FOLDER COUNT
 */
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const [folder = "books", count = "6"] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const books = Array.from({ length: Number(count) }, (_, k) => {
  const file = `volume-${k + 1}.pdf`;
  writeFileSync(join(folder, file), pdf(`Volume ${k + 1}`, ["The first page.", "The second."]));
  return { file, licence: "CC0-1.0", language: "en" };
});
writeFileSync(join(folder, "catalogue.json"), `${JSON.stringify({ books })}\n`);

function pdf(title, lines) {
  const resources = "/Resources << /Font << /F 4 0 R >> >>";
  const objects = [
    "<< /Type /Catalog /Pages 2 0 R >>",
    `<< /Type /Pages /Count ${lines.length} /Kids [${lines.map((_, k) => `${5 + 2 * k} 0 R`).join(" ")}] >>`,
    `<< /Title (${title}) >>`,
    "<< /Type /Font /Subtype /Type1 /BaseFont /Times-Roman >>",
    ...lines.flatMap((line, k) => {
      const content = `BT /F 14 Tf 30 340 Td (${title}: ${line}) Tj ET`;
      return [
        `<< /Type /Page /Parent 2 0 R /MediaBox [0 0 280 400] /Contents ${6 + 2 * k} 0 R ${resources} >>`,
        `<< /Length ${content.length} >>\nstream\n${content}\nendstream`,
      ];
    }),
  ];
  let text = "%PDF-1.7\n";
  const table = objects.map((object, k) => {
    const offset = String(text.length).padStart(10, "0");
    text += `${k + 1} 0 obj\n${object}\nendobj\n`;
    return `${offset} 00000 n \n`;
  });
  const size = objects.length + 1;
  const end = `trailer\n<< /Size ${size} /Root 1 0 R /Info 3 0 R >>\nstartxref\n${text.length}\n%%EOF\n`;
  return `${text}xref\n0 ${size}\n0000000000 65535 f \n${table.join("")}${end}`;
}
