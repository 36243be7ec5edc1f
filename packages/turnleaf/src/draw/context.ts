/** A canvas's WebGL 2 context; null where there is none to be had. Free of three.js: asked before it is loaded. */
export function openContext(canvas: HTMLCanvasElement): WebGL2RenderingContext | null {
  return canvas.getContext("webgl2", {
    alpha: true,
    antialias: true,
    depth: true,
    stencil: false,
    premultipliedAlpha: true,
  });
}
