/** The tables of the docs that are made of the viewer's sources, each rows of cells, the first of them headings. */
import { importTs } from "./import_ts.mjs";

/** Returns these tables by their names in docs/data. */
export async function sourceTables() {
  return { formats: await formatsTable(), stock_pictures: await stockPictures() };
}

/** Returns the stocks of paper, from the lightest to the heaviest: no book is of board as a whole. */
export async function paperStocks() {
  const { presetStocks } = await importTs("stocks.ts");
  return Object.keys(presetStocks).filter((name) => name !== "board");
}

/** Returns the pictures of the stocks, which scripts/pictures.mjs takes. */
async function stockPictures() {
  const stocks = await paperStocks();
  return [stocks, stocks.map((name) => `![](pictures/stock-${name}.png)`)];
}

/** Returns the files that can be opened. */
async function formatsTable() {
  const { formats } = await importTs("sources/formats.ts");
  const code = (words) => words.map((word) => `\`${word}\``).join(", ");
  const rows = formats.flatMap(({ labels, family, endings = [], type }) =>
    family === undefined
      ? []
      : [[labels.join(", "), code(endings.map((ending) => `.${ending}`)), code([type])]],
  );
  return [
    ["format", "endings of names", "media type"],
    ...rows.sort(([a], [b]) => (a < b ? -1 : 1)),
  ];
}
