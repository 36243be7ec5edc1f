/** The pictures on the leaf and on the pages under it: a few lines that show every bend. */

import type { LeafPictures } from "turnleaf/leaf-stage";

/** Melville, Moby-Dick (1851), chapter 1. */
const text =
  "Call me Ishmael. Some years ago—never mind how long precisely—having little or no money in my purse, and nothing particular to interest me on shore, I thought I would sail about a little and see the watery part of the world. It is a way I have of driving off the spleen and regulating the circulation. Whenever I find myself growing grim about the mouth; whenever it is a damp, drizzly November in my soul; whenever I find myself involuntarily pausing before coffin warehouses, and bringing up the rear of every funeral I meet; and especially whenever my hypos get such an upper hand of me, that it requires a strong moral principle to prevent me from deliberately stepping into the street, and methodically knocking people’s hats off—then, I account it high time to get to sea as soon as I can. This is my substitute for pistol and ball. With a philosophical flourish Cato throws himself upon his sword; I quietly take to the ship. There is nothing surprising in this. If they but knew it, almost all men in their degree, some time or other, cherish very nearly the same feelings towards the ocean with me.";

const words = text.split(" ");

/** Pixels of a page. */
const [width, height] = [888, 1260];
const margin = 118;
const size = 33;

/** Returns the four visible pages, from left to right. */
export function drawPages(): LeafPictures {
  const [left, recto, verso, right] = [2, 3, 4, 5].map(drawPage);
  return { left, recto, verso, right };
}

function drawPage(number: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const pen = canvas.getContext("2d");
  if (!pen) return canvas;
  pen.fillStyle = "#fbf5e8";
  pen.fillRect(0, 0, width, height);
  pen.fillStyle = "#211d1a";
  pen.textAlign = "center";
  let y = 150;
  if (number === 3) {
    pen.font = `italic ${size}px Georgia, serif`;
    pen.fillText("Chapter 1", width / 2, 230);
    pen.font = `${1.5 * size}px Georgia, serif`;
    pen.fillText("Loomings", width / 2, 300);
    y = 400;
  }
  pen.font = `${size}px Georgia, serif`;
  pen.fillText(String(number), width / 2, height - 70);
  pen.textAlign = "left";
  // Each page begins elsewhere in the text.
  let at = number === 3 ? 0 : 37 * number;
  while (y < height - 140) {
    const line: string[] = [];
    const room = width - 2 * margin;
    while (pen.measureText([...line, words[at % words.length]].join(" ")).width < room) {
      line.push(words[at++ % words.length] ?? "");
    }
    const spare = room - pen.measureText(line.join("")).width;
    let x = margin;
    for (const word of line) {
      pen.fillText(word, x, y);
      x += pen.measureText(word).width + spare / Math.max(1, line.length - 1);
    }
    y += 1.42 * size;
  }
  return canvas;
}
