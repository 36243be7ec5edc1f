/** Books whose packages are of the Open eBook Publication Structure, or name their parts as it did. */

import { strToU8, zipSync } from "fflate";
import { expect, test } from "vitest";
import { closeBooks, laidOut, wordsOf } from "../../for_tests/laid_out_books.ts";

closeBooks();

const dtd =
  '<!DOCTYPE package PUBLIC "+//ISBN 0-9673008-1-9//DTD OEB 1.2 Package//EN" "http://openebook.org/dtds/oeb-1.2/oebpkg12.dtd">';
const oeb = 'xmlns="http://openebook.org/namespaces/oeb-package/1.0/"';
const opf = 'xmlns="http://www.idpf.org/2007/opf"';

function book(namespace: string, metadata: string, version = "1.0"): Blob {
  const dublinCore = `xmlns:dc="http://purl.org/dc/elements/${version}/"`;
  const files = {
    "book.opf": `<?xml version="1.0"?>${dtd}<package ${namespace} unique-identifier="q"><metadata ${dublinCore}>${metadata}</metadata><manifest><item id="a" href="a.html" media-type="text/x-oeb1-document"/><item id="css" href="a.css" media-type="text/x-oeb1-css"/></manifest><spine><itemref idref="a"/></spine><tours><tour id="t" title="All"><site title="A" href="a.html"/></tour></tours></package>`,
    "a.html":
      '<html><head><title>t</title><link rel="stylesheet" type="text/x-oeb1-css" href="a.css"/></head><body><p>Call me <b>Ishmael</b>.</p></body></html>',
    "a.css": "b { display: none }",
  };
  const zip = Object.fromEntries(Object.entries(files).map(([k, text]) => [k, strToU8(text)]));
  return new Blob([zipSync(zip) as Uint8Array<ArrayBuffer>]);
}

const wrapped =
  "<dc-metadata><dc:Title>Moby Dick</dc:Title><dc:Creator>Melville</dc:Creator><dc:Language>he</dc:Language></dc-metadata><x-metadata><meta name='a' content='b'/></x-metadata>";
const bare =
  "<dc:Title>Moby Dick</dc:Title><dc:Creator>Melville</dc:Creator><dc:Language>he</dc:Language>";

test.each([
  ["in its own namespace", oeb, wrapped, "1.0"],
  ["in none", "", wrapped, "1.1"],
  ["in EPUB's, with its parts in groups", opf, wrapped, "1.1"],
  ["in EPUB's, in capitals", opf, bare, "1.0"],
])("a package %s is read whole", async (_, namespace, metadata, version) => {
  const source = await laidOut(book(namespace, metadata, version));
  expect(source.title).toBe("Moby Dick");
  expect(source.language).toBe("he");
  expect(source.direction).toBe("rtl");
  expect(source.details?.map(({ value }) => value)).toEqual(["Melville"]);
  expect(await wordsOf(source, 0)).toBe("Call me .");
  expect(source.warnings ?? []).toEqual([]);
});
