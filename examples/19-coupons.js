import "turnleaf";

const book = document.querySelector("turnleaf-book");
const said = document.getElementById("said");
const undo = document.getElementById("undo");
const [width, height] = [720, 320];

const coupons = [
  { gives: "One coffee", code: "CF-204", hue: 28 },
  { gives: "A slice of cake", code: "CK-118", hue: 338 },
  { gives: "Two for one", code: "TF-377", hue: 205, isExpired: true },
  { gives: "A pot of tea", code: "TE-052", hue: 128 },
];
/** The coupons that are still in the book, in their order. */
let left = [...coupons];
/** Those that were torn out, the last one last. */
const used = [];

/** A coupon as an image. */
async function page(coupon) {
  const canvas = new OffscreenCanvas(width, height);
  const pen = canvas.getContext("2d");
  pen.fillStyle = "#fdfaf3";
  pen.fillRect(0, 0, width, height);
  draw(pen, coupon);
  return { src: await canvas.convertToBlob(), width, height };
}

function draw(pen, { gives, code, hue, isExpired }) {
  pen.fillStyle = `hsl(${hue} 55% 88%)`;
  pen.fillRect(40, 30, width - 70, height - 60);
  pen.strokeStyle = `hsl(${hue} 45% 45%)`;
  pen.lineWidth = 3;
  pen.strokeRect(52, 42, width - 94, height - 84);
  pen.fillStyle = `hsl(${hue} 45% 25%)`;
  pen.textAlign = "center";
  pen.font = "64px Georgia, serif";
  pen.fillText(gives, width / 2, 170);
  pen.font = "26px Georgia, serif";
  pen.fillText(isExpired ? `${code} (expired)` : code, width / 2, 235);
}

/** Returns the coupon on a leaf: single pages are shown, one a leaf. */
const couponOf = ([page]) => left[page - 1];

book.addEventListener("tear", (event) => {
  const coupon = couponOf(event.detail.pages);
  if (!coupon.isExpired) return;
  event.preventDefault();
  said.textContent = `${coupon.gives} has expired.`;
});
book.addEventListener("torn", (event) => {
  const coupon = couponOf(event.detail.pages);
  used.push({ coupon, at: left.indexOf(coupon) });
  left = left.filter((one) => one !== coupon);
  said.textContent = `${coupon.gives}: show ${coupon.code}.`;
  undo.disabled = false;
});
document.getElementById("use").addEventListener("click", () => book.tearOut());
undo.addEventListener("click", async () => {
  if (!(await book.putBack())) return;
  const { coupon, at } = used.pop();
  left.splice(at, 0, coupon);
  said.textContent = `${coupon.gives} is back.`;
  undo.disabled = used.length === 0;
});

book.pages = await Promise.all(coupons.map(page));
