/**
 * Runs in the browser: what an EPUB says, read without the package. Its own
 * documents are shown by plain Chromium, without scripts, in the order of its spine.
 */

/** Milliseconds after which a document counts as shown though not all of it has arrived. */
const patience = 10_000;

/** The difference of a colour within a picture, of 255, that is the noise of its compression, and the width at which it is seen. */
const [blankNoise, seenWidth] = [8, 500];

const ncx = "http://www.daisy.org/z3986/2005/ncx/";
const ops = "http://www.idpf.org/2007/ops";

async function xmlAt(address) {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`${address} is not there`);
  const text = await response.text();
  const parsed = new DOMParser().parseFromString(text, "application/xml");
  if (parsed.querySelector("parsererror")) throw new Error(`${address} is not well-formed`);
  return parsed;
}

/** Shows a document in a frame. */
function shown(address) {
  const frame = document.createElement("iframe");
  frame.sandbox = "allow-same-origin";
  frame.style.cssText = "position: absolute; left: 0; top: 0; width: 500px; height: 700px";
  const loaded = new Promise((resolve) => {
    frame.addEventListener("load", resolve);
    setTimeout(resolve, patience);
  });
  frame.src = address;
  document.body.append(frame);
  return loaded.then(() => frame);
}

const isSeen = (element) => element.checkVisibility({ visibilityProperty: true });

/** Returns whether a text has a place that can be scrolled to: not beyond where its document begins. */
function isPlaced(node) {
  const range = node.ownerDocument.createRange();
  range.selectNodeContents(node);
  const { documentElement, body } = node.ownerDocument;
  const isFromRight = [documentElement, body ?? documentElement].some((root) => {
    const { direction, writingMode } = getComputedStyle(root);
    return direction === "rtl" || writingMode === "vertical-rl";
  });
  // Marks over the letter before them take no room.
  const isMarks = /^\s*\p{M}+\s*$/u.test(node.data);
  return [...range.getClientRects()].some(
    ({ width, height, right, bottom }) =>
      (width > 0 || isMarks) && height > 0 && bottom > 0 && (isFromRight || right > 0),
  );
}

/** Languages of markup that plain Chromium shows. */
const languages = ["1999/xhtml", "2000/svg", "1998/Math/MathML"].map(
  (one) => `http://www.w3.org/${one}`,
);

/** Returns whether an element is in a version of a switched content that is not the one to be read. */
function isInOtherVersion(element) {
  const version = element.closest("case, default");
  if (version?.namespaceURI !== ops) return false;
  const versions = [...version.parentElement.children];
  const language = (one) => one.getAttribute("required-namespace") ?? "";
  const read =
    versions.find((one) => languages.includes(language(one))) ??
    versions.find(({ localName }) => localName === "default");
  return version !== read || isInOtherVersion(version.parentElement);
}

/** The pieces of a document's text that are seen. */
function* piecesOf(root) {
  const walker = root.ownerDocument.createTreeWalker(root, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    // Readings stand beside what they read, and are no text of their own.
    if (node.parentElement.closest("rt, rp")) continue;
    if (isInOtherVersion(node.parentElement)) continue;
    if (/\S/.test(node.data) && isSeen(node.parentElement) && isPlaced(node)) yield node;
  }
}

/** Returns whether a picture at an address is of more than one colour; one that cannot be loaded counts as such. */
async function hasInk(address) {
  // What lies elsewhere is fetched by none.
  if (new URL(address, location.href).origin !== location.origin && !/^data:/i.test(address)) {
    return false;
  }
  const image = new Image();
  image.src = address;
  try {
    await image.decode();
    const height = Math.ceil((seenWidth * image.height) / image.width);
    const pen = new OffscreenCanvas(seenWidth, height).getContext("2d");
    pen.drawImage(image, 0, 0, seenWidth, height);
    const { data } = pen.getImageData(0, 0, seenWidth, height);
    return data.some((value, k) => Math.abs(value - data[k % 4]) > blankNoise);
  } catch {
    return true;
  }
}

/** Returns whether anything besides text is seen in a document. */
async function hasPictures(root) {
  const images = [...root.querySelectorAll("img")].filter(isSeen);
  for (const { currentSrc } of images) if (await hasInk(currentSrc)) return true;
  const pictures = "image, video, object, embed, iframe, canvas, math, hr, audio[controls]";
  if ([...root.querySelectorAll(pictures)].some(isSeen)) return true;
  // A drawing in which nothing is drawn is an empty page.
  const shapes = "circle, ellipse, line, path, polygon, polyline, rect, text, use, foreignObject";
  if ([...root.querySelectorAll(shapes)].some(isSeen)) return true;
  return [root, ...root.querySelectorAll("*")].some((element) => {
    const { backgroundImage, backgroundColor, borderTopWidth, content } = getComputedStyle(element);
    return (
      backgroundImage !== "none" ||
      !/^rgba\(0, 0, 0, 0\)$|^rgb\(255, 255, 255\)$/.test(backgroundColor) ||
      parseFloat(borderTopWidth) > 0 ||
      content !== "normal"
    );
  });
}

/** Returns the letters that follow an element, at most `most`. */
function lettersFrom(element, pieces, most) {
  let [text, letters] = ["", ""];
  for (const piece of pieces) {
    const isAfter =
      element.contains(piece) ||
      element.compareDocumentPosition(piece) & Node.DOCUMENT_POSITION_FOLLOWING;
    if (!isAfter) continue;
    // Together, as marks join the letters before them; one more, as it may be joined by the next piece's.
    text += piece.data;
    letters = lettersOf(text);
    if (letters.length > most) break;
  }
  return letters.slice(0, most);
}

/**
 * Returns a text's letters: without blanks, brackets and what is never seen, in one form. Control characters that
 * no text has are letters of Windows' encoding, as browsers read them in HTML.
 */
export function lettersOf(text) {
  const windows = new TextDecoder("windows-1252");
  return (
    text
      .replace(/[\u0080-\u009f]/g, (one) => windows.decode(Uint8Array.of(one.charCodeAt(0))))
      .normalize("NFKC")
      .replace(/[\s\p{Cc}\p{Cf}\u{FFFD}^_(){}[\],;]+/gu, "")
      // A mark that stood behind a blank joins the letter before it now, as it does where there was none.
      .normalize("NFC")
  );
}

/** Returns the text that a formula shows, as XML. */
export function textOfFormula(xml) {
  const { documentElement: math } = new DOMParser().parseFromString(xml, "application/xml");
  for (const hidden of math.querySelectorAll("mphantom, annotation, annotation-xml")) {
    hidden.remove();
  }
  return math.textContent;
}

/** Returns what may be read of a document besides what is seen of it, or in its place. */
function insteadOf(root) {
  const closed = 'details:not([open]), [hidden="until-found" i]';
  const others = `audio, video, object, iframe, canvas, textarea, option, ${closed}`;
  const texts = [...root.querySelectorAll(others)].map(({ textContent }) => textContent);
  const fields = [...root.querySelectorAll("input, textarea")];
  return [...texts, ...fields.map(({ value, placeholder }) => value || placeholder)].map(lettersOf);
}

/** Shows parts of drawings that ask for EPUB's own markup, which stands for XHTML in them. */
function showExtensions(root) {
  for (const element of root.querySelectorAll("[requiredExtensions]")) {
    if (element.getAttribute("requiredExtensions").trim() === ops) {
      element.removeAttribute("requiredExtensions");
      // Put anew, the browser chooses anew.
      const whole = element.closest("switch") ?? element;
      whole.replaceWith(whole.cloneNode(true));
    }
  }
}

/** Reads the package of a book whose files lie at an address. */
async function readPackage(base) {
  const container = await xmlAt(new URL("META-INF/container.xml", base));
  const path = container.querySelector("rootfile")?.getAttribute("full-path");
  const address = new URL(path.split("/").map(encodeURIComponent).join("/"), base);
  const xml = await xmlAt(address);
  const items = new Map();
  for (const item of xml.getElementsByTagNameNS("*", "item")) {
    items.set(item.getAttribute("id"), {
      address: new URL(item.getAttribute("href"), address).href,
      type: item.getAttribute("media-type"),
      properties: item.getAttribute("properties") ?? "",
      fallback: item.getAttribute("fallback"),
    });
  }
  const isShown = ({ type }) => /xhtml|svg|html|dtbook|oeb1|^image/.test(type ?? "");
  const spine = [...xml.getElementsByTagNameNS("*", "itemref")].flatMap((reference) => {
    let item = items.get(reference.getAttribute("idref"));
    for (let k = 0; item && !isShown(item) && k < 10; k++) item = items.get(item.fallback);
    return item ? [{ ...item, isLinear: reference.getAttribute("linear") !== "no" }] : [];
  });
  if (spine.length === 0) throw new Error("Its spine names no document");
  const toc = xml.getElementsByTagNameNS("*", "spine")[0]?.getAttribute("toc");
  const listed = [...items.values()];
  const ncx = items.get(toc) ?? listed.find(({ type }) => type === "application/x-dtbncx+xml");
  return { items: listed, spine, ncx };
}

/** Returns the lines of the book's contents: title and address. */
async function contentsOf({ items, ncx: old }) {
  const nav = items.find(({ properties }) => /\bnav\b/.test(properties));
  if (nav) {
    const xml = await xmlAt(nav.address);
    const list = [...xml.querySelectorAll("nav")].find((one) =>
      /\btoc\b/.test(one.getAttributeNS(ops, "type") ?? ""),
    );
    return [...(list?.querySelectorAll("li > a, li > span") ?? [])].map((line) => ({
      title: line.textContent,
      address: line.hasAttribute("href")
        ? new URL(line.getAttribute("href"), nav.address).href
        : "",
    }));
  }
  if (!old) return [];
  const xml = await xmlAt(old.address);
  return [...xml.getElementsByTagNameNS(ncx, "navPoint")].map((point) => ({
    title: point.getElementsByTagNameNS(ncx, "text")[0]?.textContent ?? "",
    address: new URL(
      point.getElementsByTagNameNS(ncx, "content")[0]?.getAttribute("src") ?? "",
      old.address,
    ).href,
  }));
}

/**
 * Reads a book whose files lie at an address. Resolves to the letters of its
 * documents in the order in which they are read, which of these show nothing at
 * all, what may be read besides or in place of sounds and films ("instead"), and the
 * lines of its contents with the letters to which they lead.
 * Rejects if its package or a document is not well-formed.
 */
export async function secondOpinion(base) {
  const book = await readPackage(base);
  const lines = await contentsOf(book);
  const chapters = [];
  for (const { address, isLinear, type } of book.spine) {
    if (/^image\/(?!svg)/.test(type)) {
      chapters.push({ letters: "", isLinear, isEmpty: !(await hasInk(address)), instead: [] });
      continue;
    }
    const response = await fetch(address);
    if (!response.ok) throw new Error(`${address} is not there`);
    await response.arrayBuffer();
    const frame = await shown(address);
    try {
      const { contentDocument } = frame;
      if (contentDocument.querySelector("parsererror")) {
        throw new Error(`${address} is not well-formed`);
      }
      const root = contentDocument.body ?? contentDocument.documentElement;
      if (!/1999\/xhtml$|2000\/svg$/.test(root.namespaceURI)) {
        throw new Error(`${address} is not XHTML`);
      }
      showExtensions(root);
      const pieces = [...piecesOf(root)];
      const letters = lettersOf(pieces.map(({ data }) => data).join(""));
      chapters.push({
        letters,
        isLinear,
        isEmpty: letters === "" && !(await hasPictures(root)),
        instead: insteadOf(root),
      });
      for (const line of lines) {
        const [document, id] = line.address.split("#");
        if (document !== address) continue;
        const target = id ? contentDocument.getElementById(decodeURIComponent(id)) : root;
        line.letters = target ? lettersFrom(target, pieces, 24) : undefined;
      }
    } finally {
      frame.remove();
    }
  }
  return { chapters, lines };
}
