import "turnleaf";

const book = document.querySelector("turnleaf-book");
const said = document.querySelector("output");

/** Lines from the head to the foot of a page on the right, at fractions of its width, and angles. */
const ways = {
  letter: [
    [0.7, 0.7, 175],
    [0.4, 0.4, 160],
  ],
  slanted: [[0.5, 0.75, 160]],
  open: [],
};

document.querySelector("form").addEventListener("click", async ({ target }) => {
  const way = ways[target.value];
  const page = book.spread.right;
  if (way === undefined || page === null) return;
  try {
    await book.unfold(page);
    for (const [head, foot, angle] of way) {
      await book.fold(page, { x: head, y: 0 }, { x: foot, y: 1 }, angle);
    }
  } catch (error) {
    said.textContent = error.message;
  }
});

book.addEventListener("foldchange", ({ detail }) => {
  said.textContent = `Folds: ${detail.folds.length}`;
});
