import "turnleaf";

const book = document.querySelector("turnleaf-book");
const select = document.querySelector("select");

// Each leaf bends as what it is; an open book is bound anew, at the page that lies open.
select.addEventListener("change", () => {
  book.stocks = select.value;
});
