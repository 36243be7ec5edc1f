import "turnleaf";

const hours = ["6:00", "8:00", "10:00", "12:00", "15:00", "18:00", "20:00", "23:00"];
const book = document.querySelector("turnleaf-book");
const list = document.querySelector("ol");
const say = (text) => {
  document.querySelector("output").textContent = text;
};

for (const [k, hour] of hours.entries()) {
  const button = document.createElement("button");
  button.textContent = hour;
  button.onclick = async () => {
    say(`To ${hour} …`);
    // A promise of the book is kept once it lies still: true where it lies there, false
    // where somebody turned elsewhere meanwhile.
    const isThere = await book.goTo(k + 1);
    say(isThere ? `${hour} it is.` : "Somebody turned elsewhere.");
  };
  list.appendChild(document.createElement("li")).append(button);
}

/** Marks the pages that lie open, however they were turned to. */
function follow() {
  const { left, right } = book.spread;
  for (const [k, button] of list.querySelectorAll("button").entries()) {
    if (k + 1 === left || k + 1 === right) button.setAttribute("aria-current", "page");
    else button.removeAttribute("aria-current");
  }
}

book.addEventListener("load", ({ detail }) => {
  say(`${detail.pageCount} pages`);
  follow();
});
book.addEventListener("pagechange", ({ detail }) => {
  say(`From page ${detail.from} ${detail.direction} to ${detail.to}`);
  follow();
});
book.addEventListener("layoutchange", follow);
book.addEventListener("error", ({ detail }) => say(detail.message));

document.querySelector("#on").onclick = () => book.next();
document.querySelector("#back").onclick = () => book.previous();
document.querySelector("#tour").onclick = async () => {
  for (const k of hours.keys()) {
    if (!(await book.goTo(k + 1))) return say("Somebody turned elsewhere.");
  }
  say("The day is over.");
};

book.pages = hours.map((_, k) => `pictures/hours/${k + 1}.webp`);
