import "turnleaf";

const book = document.querySelector("turnleaf-book");
const form = document.querySelector("form");
const list = document.querySelector("ol");
const status = document.querySelector("output");
let running = new AbortController();

/** A line of the list: what it says, and what it does. */
function line(text, act) {
  const item = document.createElement("li");
  const button = item.appendChild(document.createElement("button"));
  button.textContent = text;
  button.onclick = act;
  return item;
}

/** The book's contents, chapters within their parts. */
function contents(entries) {
  return entries.map(({ title, page, children }) => {
    const item = line(title, () => page !== null && book.goTo(page));
    if (children.length > 0) {
      item.appendChild(document.createElement("ol")).append(...contents(children));
    }
    return item;
  });
}

async function showContents() {
  book.showHit(null);
  status.textContent = "Contents";
  list.replaceChildren(...contents(await book.outline()));
}

async function search(query) {
  // A new search ends the one before.
  running.abort();
  running = new AbortController();
  const { signal } = running;
  if (query === "") return await showContents();
  status.textContent = "Searching …";
  const hits = await book.search(query, { signal });
  status.textContent = `${hits.length} places`;
  list.replaceChildren(
    ...hits.slice(0, 100).map((hit) =>
      line(`${book.label(hit.page)}: ${hit.before}${hit.text}${hit.after}`, () => {
        book.showHit(hit);
      }),
    ),
  );
}

form.addEventListener("submit", (event) => {
  event.preventDefault();
  search(form.elements.query.value.trim()).catch((error) => {
    if (error.name !== "AbortError") status.textContent = error.message;
  });
});
book.addEventListener("load", showContents);
