import "turnleaf";

const book = document.querySelector("turnleaf-book");
const { model } = document.querySelector("form").elements;

/** What some models show; a turn of your own would be one of `replay`. */
const sources = { photographs: "pictures/turn/{01-24}.webp#ratio=2:3" };

model.addEventListener("input", () => {
  book.modelSrc = sources[model.value] ?? "";
  book.model = model.value;
});
