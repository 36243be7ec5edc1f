import "turnleaf";

const book = document.querySelector("turnleaf-book");
const said = document.querySelector("output");
const [width, height] = [600, 800];

/** Widths of the pages that are wider, by their numbers. */
const wide = { 5: 1.9, 8: 1.5, 11: 3.8 };

/** A page as an image, so many pages wide; all that makes it a fold-out is its size. */
async function page(number, across = 1) {
  const canvas = new OffscreenCanvas(width * across, height);
  const pen = canvas.getContext("2d");
  pen.fillStyle = "#fbf7ec";
  pen.fillRect(0, 0, canvas.width, height);
  pen.fillStyle = "#2b2622";
  pen.textAlign = "center";
  pen.font = "30px Georgia, serif";
  pen.fillText(String(number), width / 2, height - 40);
  if (across > 2) drawPanorama(pen, canvas.width);
  else if (across > 1) drawMap(pen, canvas.width, number);
  return { src: await canvas.convertToBlob(), width: canvas.width, height };
}

/** An island in contour lines. */
function drawMap(pen, across, number) {
  pen.fillStyle = "#cfe0e4";
  pen.fillRect(30, 30, across - 60, height - 110);
  for (let level = 0; level < 8; level++) {
    pen.fillStyle = `hsl(${80 - 7 * level} ${34 + 2 * level}% ${78 - 5 * level}%)`;
    pen.strokeStyle = "#6d6a55";
    pen.beginPath();
    for (let step = 0; step <= 120; step++) {
      const angle = (step * Math.PI) / 60;
      const swell = Math.sin(3 * angle + number) + 0.5 * Math.sin(7 * angle + level / 2);
      const reach = (1 - level / 8) * (1 + 0.12 * swell);
      const x = across / 2 + 0.42 * across * reach * Math.cos(angle) + 8 * level;
      const y = 360 + 290 * reach * Math.sin(angle) - 4 * level;
      pen.lineTo(x, y);
    }
    pen.fill();
    pen.stroke();
  }
}

/** Hills behind hills, along a road with milestones. */
function drawPanorama(pen, across) {
  pen.fillStyle = "#dfe7ea";
  pen.fillRect(30, 30, across - 60, height - 110);
  for (let range = 0; range < 5; range++) {
    pen.fillStyle = `hsl(${195 - 22 * range} ${18 + 6 * range}% ${74 - 9 * range}%)`;
    pen.beginPath();
    pen.moveTo(30, height - 80);
    for (let x = 30; x <= across - 30; x += 5) {
      const hill = Math.sin(x / (170 - 18 * range) + range) + 0.5 * Math.sin(x / 61 + 3 * range);
      pen.lineTo(x, 220 + 100 * range - (70 - 8 * range) * hill);
    }
    pen.lineTo(across - 30, height - 80);
    pen.fill();
  }
  pen.fillStyle = "#fbf7ec";
  for (let mile = 1; mile * 150 + 60 < across; mile++) {
    pen.fillText(String(mile), mile * 150, height - 100);
  }
}

document.querySelector("p:has(button)").addEventListener("click", async ({ target }) => {
  if (target.value === "foldIn") {
    await book.foldIn();
    said.textContent = "Folded in";
  }
  if (target.value !== "unfold") return;
  const { left, right } = book.spread;
  for (const number of [right, left]) {
    if (number === null || !(await book.unfold(number))) continue;
    said.textContent = `Page ${number} is open`;
    return;
  }
  said.textContent = "None of these pages is wider than the book.";
});

book.pages = await Promise.all(Array.from({ length: 12 }, (_, k) => page(k + 1, wide[k + 1])));
