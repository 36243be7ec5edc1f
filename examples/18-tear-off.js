import "turnleaf";

const book = document.querySelector("turnleaf-book");
const [width, height] = [480, 600];
const days = 30;

/** A day as an image. */
async function day(number) {
  const date = new Date();
  date.setDate(date.getDate() + number);
  const canvas = new OffscreenCanvas(width, height);
  const pen = canvas.getContext("2d");
  pen.fillStyle = "#fdfaf3";
  pen.fillRect(0, 0, width, height);
  const isSunday = date.getDay() === 0;
  pen.textAlign = "center";
  const line = (text, font, y, colour) => {
    pen.fillStyle = colour;
    pen.font = `${font} Georgia, serif`;
    pen.fillText(text, width / 2, y);
  };
  const name = (part) => new Intl.DateTimeFormat(undefined, part).format(date);
  line(name({ month: "long", year: "numeric" }), "34px", 96, "#5c5349");
  line(String(date.getDate()), "280px", 385, isSunday ? "#8a3324" : "#2b2622");
  line(name({ weekday: "long" }), "44px", 500, isSunday ? "#8a3324" : "#2b2622");
  return { src: await canvas.convertToBlob(), width, height };
}

const tear = document.getElementById("tear");
const back = document.getElementById("back");
function count() {
  document.getElementById("left").textContent = `${book.pageCount} days left`;
  back.disabled = book.tornLeaves === 0;
}
book.addEventListener("load", count);
book.addEventListener("pageschange", () => queueMicrotask(count));
tear.addEventListener("click", () => book.tearOut());
back.addEventListener("click", () => book.putBack());

// One page a leaf: the layout shows single pages, whose backs are blank.
book.pages = await Promise.all(Array.from({ length: days }, (_, number) => day(number)));
