import "turnleaf";

const hours = ["6:00", "8:00", "10:00", "12:00", "15:00", "18:00", "20:00", "23:00"];

// The least that a page needs is an address. A size spares the book a look at each
// image before it opens; `alt` is read out to those who do not see it.
document.querySelector("turnleaf-book").pages = hours.map((hour, k) => ({
  src: `pictures/hours/${k + 1}.webp`,
  width: 600,
  height: 800,
  label: hour,
  alt: `A bay with a lighthouse at ${hour}`,
}));
