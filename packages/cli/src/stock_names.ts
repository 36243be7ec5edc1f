/** The stocks that the command takes: read from the viewer's table, so that it loads no model. */

import type { LeafStockName } from "turnleaf/models";
import { presetStocks } from "../../turnleaf/src/stocks.ts";

const { board: _, ...papers } = presetStocks;
const names = Object.keys(papers) as LeafStockName[];

/** The default first, then from the lightest to the heaviest. */
export const stockNames: readonly LeafStockName[] = [
  "book",
  ...names.filter((name) => name !== "book"),
];

/** The same for sentences, from the lightest to the heaviest. */
export const stockWords = `${names.slice(0, -1).join(", ")} or ${names.at(-1)}`;
