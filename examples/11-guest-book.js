import "turnleaf";

const book = document.querySelector("turnleaf-book");
const form = document.querySelector("form");
const [width, height] = [600, 800];

/** A page with a line of writing. */
async function page(text, paper = "#fdfaf3", ink = "#2b2622") {
  const canvas = new OffscreenCanvas(width, height);
  const pen = canvas.getContext("2d");
  pen.fillStyle = paper;
  pen.fillRect(0, 0, width, height);
  pen.fillStyle = ink;
  pen.textAlign = "center";
  pen.font = "italic 54px Georgia, serif";
  pen.fillText(text, width / 2, 330, width - 80);
  return await canvas.convertToBlob();
}

const cover = "#33475b";
// Pages 1, 2 and the last two are the boards; 3 and 4 are a leaf of board among the paper.
book.pages = await Promise.all([
  page("Guests", cover, "#f3ead6"),
  page("", cover),
  page("Welcome", "#d9c9a3"),
  page("", "#d9c9a3"),
  page("Ada"),
  page("Grace"),
  page("", cover),
  page("", cover),
]);

form.addEventListener("submit", async (event) => {
  event.preventDefault();
  const at = book.pageCount - 1;
  await book.insertPages(at, [await page(form.elements.guest.value)]);
  form.reset();
  await book.goTo(at);
});
document.querySelector("#out").onclick = () => {
  if (book.pageCount > 4) book.removePages(book.pageCount - 2);
};

function count() {
  document.querySelector("output").textContent = `${book.pageCount} pages`;
}
book.addEventListener("load", count);
book.addEventListener("pageschange", count);
