/**
 * The same book by every library: runs in the page. Each opens a book of images in a place as its
 * documentation says, with a turn of 800 ms and nothing else that is not its default.
 *
 * @typedef {object} OpenBook
 * @property {() => Promise<void>} next turns a page forward; resolves when it lies
 * @property {() => void} destroy takes the book away
 */

const milliseconds = 800;
const [width, height] = [500, 707];

const wait = (time) => new Promise((resolve) => setTimeout(resolve, time));

/** A classic script of a package, once it has run. */
function script(address) {
  return new Promise((resolve, reject) => {
    const element = Object.assign(document.createElement("script"), { src: address });
    element.addEventListener("load", resolve);
    element.addEventListener("error", () => reject(new Error(`No ${address}.`)));
    document.head.append(element);
  });
}

function style(address) {
  const element = Object.assign(document.createElement("link"), {
    rel: "stylesheet",
    href: address,
  });
  document.head.append(element);
}

/** Elements of the pages, each with its image, which the browser loads when it comes near. */
function divs(place, images) {
  for (const src of images) {
    const page = document.createElement("div");
    const image = Object.assign(document.createElement("img"), { loading: "lazy", src });
    image.style.cssText = "display: block; width: 100%; height: 100%";
    page.append(image);
    place.append(page);
  }
  return [...place.children];
}

/** page-flip, drawn as HTML or on a canvas. */
async function pageFlip(place, load) {
  const { PageFlip } = await import("/packages/page-flip/dist/js/page-flip.module.js");
  const host = document.createElement("div");
  place.append(host);
  const book = new PageFlip(host, { width, height, flippingTime: milliseconds });
  const ready = new Promise((resolve) => book.on("init", resolve));
  load(book, host);
  await ready;
  const next = () =>
    new Promise((resolve) => {
      const hear = ({ data }) => {
        if (data !== "read") return;
        book.off("changeState");
        resolve();
      };
      book.on("changeState", hear);
      book.flipNext();
    });
  return { next, destroy: () => book.destroy() };
}

/** dFlip, by WebGL or by CSS. */
async function dFlip(place, images, webgl) {
  const folder = "/packages/@dearhive/dearflip-jquery-flipbook/dflip";
  style(`${folder}/css/dflip.min.css`);
  window.dFlipLocation = `${folder}/`;
  await script(`${folder}/js/libs/jquery.min.js`);
  await script(`${folder}/js/dflip.min.js`);
  const host = document.createElement("div");
  place.append(host);
  const book = await new Promise((resolve) => {
    const book = window.jQuery(host).flipBook(images, {
      webgl,
      duration: milliseconds,
      height: place.clientHeight,
      soundEnable: false,
      onReady: () => setTimeout(() => resolve(book)),
    });
  });
  const next = async () => {
    const { target } = book;
    target.next();
    // It tells of no end of a turn: its sheets know whether they still move.
    const moves = () => [...(target.pages ?? target.children)].some((page) => page.isFlipping);
    await wait(50);
    while (moves()) await wait(10);
  };
  return { next, destroy: () => book.dispose() };
}

async function turnleaf(place, images) {
  await import("/turnleaf/index.js");
  const element = document.createElement("turnleaf-book");
  element.style.cssText = "display: block; width: 100%; height: 100%";
  element.duration = milliseconds;
  element.pages = images.map((src) => ({ src }));
  place.append(element);
  // Its first pages can be read, and turned.
  while (!element.ready) await wait(5);
  return {
    next: async () => {
      await element.next();
    },
    destroy: () => element.remove(),
  };
}

/** @type {Record<string, (place: HTMLElement, images: string[]) => Promise<OpenBook>>} */
export const books = {
  "page-flip HTML": (place, images) =>
    pageFlip(place, (book, host) => book.loadFromHTML(divs(host, images))),
  "page-flip canvas": (place, images) => pageFlip(place, (book) => book.loadFromImages(images)),
  "turn.js": async (place, images) => {
    await script("/packages/jquery/dist/jquery.min.js");
    // The package is a CommonJS module.
    window.require = () => window.jQuery;
    await script("/packages/turn.js/index.js");
    const host = document.createElement("div");
    place.append(host);
    divs(host, images);
    const book = window.jQuery(host);
    book.turn({ width: 2 * width, height, duration: milliseconds, display: "double" });
    const next = () =>
      new Promise((resolve) => {
        book.one("turned", () => resolve());
        book.turn("next");
      });
    return { next, destroy: () => host.remove() };
  },
  "dFlip WebGL": (place, images) => dFlip(place, images, true),
  "dFlip CSS": (place, images) => dFlip(place, images, false),
  "html-flip-book": async (place, images) => {
    style("/packages/html-flip-book-vanilla/dist/html-flip-book.css");
    const { FlipBook } = await import("/packages/html-flip-book-vanilla/dist/flipbook.js");
    const host = document.createElement("div");
    host.id = "html-flip-book";
    host.style.cssText = "width: 100%; height: 100%";
    place.append(host);
    for (const page of divs(host, images)) page.className = "page";
    const book = new FlipBook({
      pagesCount: images.length,
      leafAspectRatio: { width, height },
      coverAspectRatio: { width, height },
    });
    book.render("#html-flip-book");
    return { next: () => book.flipNext(), destroy: () => book.destroy() };
  },
  "Turnleaf WebGL": turnleaf,
  "Turnleaf flat": turnleaf,
};
