/** Books of each kind that are opened for measurements, made of the text of the book that comes with the project. */
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { zipSync } from "fflate";
import PDFDocument from "pdfkit";
import { PNG } from "pngjs";

const root = join(import.meta.dirname, "..");

/** Length of a long text, characters. */
const longText = 1_000_000;

/** Pages of the PDF, and of books of pictures. */
const pdfPages = 400;
const pictures = 40;

/** The paragraphs of a text that is as long as asked for: that of the book, again and again. */
function paragraphs(length) {
  const folder = join(root, "books/make/text");
  const own = readdirSync(folder)
    .filter((name) => name.startsWith("chapter_"))
    .flatMap((name) => readFileSync(join(folder, name), "utf8").split(/\n\s*\n/))
    .map((text) => text.replace(/\s+/g, " ").trim())
    .filter((text) => text !== "");
  const found = [];
  for (let k = 0, left = length; left > 0; k++) {
    const text = own[k % own.length];
    found.push(text);
    left -= text.length;
  }
  return found;
}

/** Parts of a list whose texts have some length together. */
function parts(texts, length) {
  const found = [[]];
  let left = length;
  for (const text of texts) {
    if (left <= 0) {
      found.push([]);
      left = length;
    }
    found.at(-1).push(text);
    left -= text.length;
  }
  return found;
}

const asMarkup = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");

/** An EPUB of a text, in chapters of some length. */
function epub(texts, chapterLength) {
  const chapters = parts(texts, chapterLength).map(
    (chapter, k) =>
      `<?xml version="1.0" encoding="utf-8"?><html xmlns="http://www.w3.org/1999/xhtml"><head><title>${k + 1}</title></head><body><h1>Chapter ${k + 1}</h1>${chapter.map((text) => `<p>${asMarkup(text)}</p>`).join("")}</body></html>`,
  );
  const names = chapters.map((_, k) => `c${k + 1}.xhtml`);
  const item = (id, href, more = "") =>
    `<item id="${id}" href="${href}" media-type="application/xhtml+xml"${more}/>`;
  const files = {
    mimetype: "application/epub+zip",
    "META-INF/container.xml":
      '<container xmlns="urn:oasis:names:tc:opendocument:xmlns:container" version="1.0"><rootfiles><rootfile full-path="book.opf" media-type="application/oebps-package+xml"/></rootfiles></container>',
    "book.opf": `<package xmlns="http://www.idpf.org/2007/opf" version="3.0" unique-identifier="id"><metadata xmlns:dc="http://purl.org/dc/elements/1.1/"><dc:identifier id="id">bench</dc:identifier><dc:title>A long book</dc:title><dc:language>en</dc:language></metadata><manifest>${names.map((name, k) => item(`c${k}`, name)).join("")}${item("nav", "nav.xhtml", ' properties="nav"')}</manifest><spine>${names.map((_, k) => `<itemref idref="c${k}"/>`).join("")}</spine></package>`,
    "nav.xhtml": `<html xmlns="http://www.w3.org/1999/xhtml" xmlns:epub="http://www.idpf.org/2007/ops"><body><nav epub:type="toc"><ol>${names.map((name, k) => `<li><a href="${name}">Chapter ${k + 1}</a></li>`).join("")}</ol></nav></body></html>`,
    ...Object.fromEntries(names.map((name, k) => [name, chapters[k]])),
  };
  return zipSync(
    Object.fromEntries(
      Object.entries(files).map(([name, text]) => [
        name,
        [Buffer.from(text), { level: name === "mimetype" ? 0 : 6 }],
      ]),
    ),
  );
}

/** A PDF of pages of text in an embedded font. */
function pdf(texts, pageCount) {
  const garamond = join(
    root,
    "node_modules/@expo-google-fonts/eb-garamond/400Regular/EBGaramond_400Regular.ttf",
  );
  const document = new PDFDocument({ size: [396, 612], margin: 45, autoFirstPage: false });
  const chunks = [];
  document.on("data", (chunk) => chunks.push(chunk));
  const pages = parts(texts, 1400);
  for (let k = 0; k < pageCount; k++) {
    document.addPage().font(garamond).fontSize(10.5);
    const text = pages[k % pages.length].join("\n").slice(0, 1900);
    document.text(text, { align: "justify", height: 520 });
  }
  document.end();
  return new Promise((resolve) => document.on("end", () => resolve(Buffer.concat(chunks))));
}

/** A scan of a page: a PNG of noise and lines, which compresses as scans do. */
function scan(seed) {
  const [width, height] = [800, 1200];
  const png = new PNG({ width, height });
  let state = seed + 1;
  for (let at = 0; at < png.data.length; at += 4) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    const y = Math.floor(at / 4 / width);
    const ink = y % 24 < 10 && state % 7 < 3 ? 60 : 235 + (state >>> 29);
    png.data.set([ink, ink, ink, 255], at);
  }
  return PNG.sync.write(png, { colorType: 0 });
}

/** The books' files by their names, and the name of each kind's book. */
export async function benchBooks() {
  const texts = paragraphs(longText);
  const scans = Object.fromEntries(
    Array.from({ length: pictures }, (_, k) => [`scan-${k + 1}.png`, scan(k % 4)]),
  );
  const manifest = { title: "Scans", pages: Object.keys(scans) };
  const canvases = Object.keys(scans).map((name, k) => ({
    id: `https://book.invalid/canvas/${k + 1}`,
    type: "Canvas",
    width: 800,
    height: 1200,
    items: [
      {
        type: "AnnotationPage",
        items: [
          {
            type: "Annotation",
            motivation: "painting",
            target: `https://book.invalid/canvas/${k + 1}`,
            body: { id: name, type: "Image", format: "image/png", width: 800, height: 1200 },
          },
        ],
      },
    ],
  }));
  const iiif = {
    "@context": "http://iiif.io/api/presentation/3/context.json",
    id: "https://book.invalid/manifest",
    type: "Manifest",
    label: { en: ["Scans"] },
    items: canvases,
  };
  const zip = Object.fromEntries(
    Object.entries(scans).map(([name, bytes]) => [name, [bytes, { level: 0 }]]),
  );
  return {
    kinds: {
      "PDF, 400 pages": "book.pdf",
      "EPUB, 1 MB of text in 100 chapters": "chapters.epub",
      "EPUB, 1 MB of text in one chapter": "chapter.epub",
      "text, 1 MB": "book.txt",
      "comic (CBZ), 40 scans": "book.cbz",
      "manifest, 40 scans": "book.json",
      "IIIF, 40 scans": "iiif.json",
    },
    files: {
      "book.pdf": await pdf(texts, pdfPages),
      "chapters.epub": epub(texts, longText / 100),
      "chapter.epub": epub(texts, longText * 2),
      "book.txt": Buffer.from(texts.join("\n\n")),
      "book.cbz": zipSync(zip),
      "book.json": Buffer.from(JSON.stringify(manifest)),
      "iiif.json": Buffer.from(JSON.stringify(iiif)),
      ...scans,
    },
  };
}
