/** Photographs of a turn that are served to the viewer, each known by its colour. */

import { vi } from "vitest";

/** Returns the hue of a photograph by its number. */
export const hueOf = (number: number): number => 20 + 72 * number;

/** Resolves to a photograph: its left half in a colour of its own, its right half transparent. */
export async function photograph(number: number, width = 200, height = 160): Promise<Blob> {
  const canvas = new OffscreenCanvas(width, height);
  const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.fillStyle = `hsl(${hueOf(number)} 100% 50%)`;
  pen.fillRect(0, 0, width / 2, height);
  return await canvas.convertToBlob({ type: "image/png" });
}

/** Until mocks are restored, responds to requests below /photographs/ with the result of `respond` for the number in it. */
export function serve(respond: (number: number) => Promise<BodyInit | null>): void {
  const { fetch } = globalThis;
  vi.spyOn(globalThis, "fetch").mockImplementation(async (input, init) => {
    const [, number] = /\/photographs\/(\d+)\.png$/.exec(String(input)) ?? [];
    if (number === undefined) return fetch(input, init);
    const body = await respond(Number(number));
    return new Response(body, { status: body === null ? 404 : 200 });
  });
}
