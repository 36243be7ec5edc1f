import "turnleaf";

const book = document.querySelector("turnleaf-book");
const { model } = document.querySelector("form").elements;

model.addEventListener("input", () => {
  book.model = model.value;
});
