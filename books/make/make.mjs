/** Make the book: `npm run book` writes books/moby-dick.pdf. */
import { writeFile } from "node:fs/promises";
import { makeBook } from "./book.mjs";

const { bytes, pages } = await makeBook();
await writeFile(new URL("../moby-dick.pdf", import.meta.url), bytes);
console.log(`books/moby-dick.pdf: ${pages.length} pages, ${(bytes.length / 1024).toFixed(0)} KB`);
