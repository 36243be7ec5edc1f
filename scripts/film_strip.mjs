/** Frames of a moment in one picture, beside each other. */

/** Pixels between two frames. */
const gap = 6;

/** Returns PNGs of one size as one PNG, from left to right. */
export async function filmStrip(browser, frames) {
  const page = await browser.newPage();
  const base64 = frames.map((frame) => frame.toString("base64"));
  const strip = await page.evaluate(
    async ([base64, gap]) => {
      const bytes = base64.map((text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)));
      const images = await Promise.all(
        bytes.map((bytes) => createImageBitmap(new Blob([bytes], { type: "image/png" }))),
      );
      const [{ width, height }] = images;
      const canvas = document.createElement("canvas");
      canvas.width = images.length * (width + gap) - gap;
      canvas.height = height;
      const pen = canvas.getContext("2d");
      pen.fillStyle = "#ffffff";
      pen.fillRect(0, 0, canvas.width, canvas.height);
      for (const [k, image] of images.entries()) pen.drawImage(image, k * (width + gap), 0);
      return canvas.toDataURL("image/png");
    },
    [base64, gap],
  );
  await page.close();
  return Buffer.from(strip.split(",")[1], "base64");
}
