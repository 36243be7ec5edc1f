import "turnleaf";

const year = new Date().getFullYear();
const [width, height] = [800, 560];

/** A page as an image: a Blob needs no address, and no security policy stands against it. */
async function page(draw) {
  const canvas = new OffscreenCanvas(width, height);
  draw(canvas.getContext("2d"));
  return { src: await canvas.convertToBlob(), width, height };
}

/** Hills under a sky, as warm as the month. */
function picture(pen, month) {
  const warmth = 0.5 - Math.cos(((month + 0.5) * Math.PI) / 6) / 2;
  const sky = pen.createLinearGradient(0, 0, 0, height);
  sky.addColorStop(0, `hsl(${215 - 15 * warmth} 60% ${45 + 15 * warmth}%)`);
  sky.addColorStop(1, `hsl(${30 + 20 * warmth} 80% 88%)`);
  pen.fillStyle = sky;
  pen.fillRect(0, 0, width, height);
  pen.fillStyle = "#fff6d8";
  pen.beginPath();
  pen.arc(180 + 36 * month, 330 - 210 * warmth, 34, 0, 7);
  pen.fill();
  for (const hill of [0, 1, 2]) {
    pen.fillStyle = `hsl(${200 - 95 * warmth} ${12 + 30 * warmth}% ${78 - 20 * hill - 14 * warmth}%)`;
    pen.beginPath();
    pen.moveTo(0, height);
    for (let x = 0; x <= width; x += 10) {
      const height = Math.sin(x / (150 - 25 * hill) + month + 2 * hill);
      pen.lineTo(x, 350 + 70 * hill + 40 * height);
    }
    pen.lineTo(width, height);
    pen.fill();
  }
}

/** The days of a month, from Monday on. */
function days(pen, month) {
  pen.fillStyle = "#fdfaf3";
  pen.fillRect(0, 0, width, height);
  pen.textAlign = "center";
  pen.fillStyle = "#8a3324";
  pen.font = "44px Georgia, serif";
  const name = new Intl.DateTimeFormat(undefined, { month: "long" });
  pen.fillText(`${name.format(new Date(year, month))} ${year}`, width / 2, 76);
  const first = (new Date(year, month).getDay() + 6) % 7;
  pen.font = "30px Georgia, serif";
  for (let day = 1; day <= new Date(year, month + 1, 0).getDate(); day++) {
    const place = first + day - 1;
    pen.fillStyle = place % 7 === 6 ? "#8a3324" : "#2b2622";
    pen.fillText(String(day), 100 + 100 * (place % 7), 160 + 70 * Math.floor(place / 7));
  }
}

function cover(pen) {
  picture(pen, 6);
  pen.fillStyle = "#fff";
  pen.textAlign = "center";
  pen.font = "150px Georgia, serif";
  pen.fillText(String(year), width / 2, 505);
}

const months = Array.from({ length: 12 }, (_, month) => month);
document.querySelector("turnleaf-book").pages = await Promise.all([
  page(cover),
  ...months.flatMap((month) => [
    page((pen) => picture(pen, month)),
    page((pen) => days(pen, month)),
  ]),
]);
