/**
 * WebGL 2 without a graphics card, for tests that read no pixel: three.js and the stage do all that
 * they do for a frame, cameras, projections and meshes included, and the browser's graphics process
 * has nothing to do.
 */

import { hookContexts } from "./webgl_contexts.ts";

type Context = WebGL2RenderingContext;

/** Values of a context that three.js asks for and cannot do without. */
const parameters: Readonly<Record<string, unknown>> = {
  VERSION: "WebGL 2.0 (undrawn)",
  // A book waits for its pages where the processor draws, as in the browser that draws the others.
  RENDERER: "SwiftShader (undrawn)",
  MAX_TEXTURE_SIZE: 8192,
  MAX_CUBE_MAP_TEXTURE_SIZE: 8192,
  MAX_TEXTURE_IMAGE_UNITS: 16,
  MAX_VERTEX_TEXTURE_IMAGE_UNITS: 16,
  MAX_COMBINED_TEXTURE_IMAGE_UNITS: 32,
  MAX_VERTEX_ATTRIBS: 16,
  MAX_VERTEX_UNIFORM_VECTORS: 1024,
  MAX_FRAGMENT_UNIFORM_VECTORS: 1024,
  MAX_VARYING_VECTORS: 30,
  MAX_SAMPLES: 4,
  SAMPLES: 0,
};

const contexts = new WeakMap<HTMLCanvasElement, Context>();
let isInstalled = false;

/**
 * Gives every canvas of this page whose WebGL 2 context is requested from now on one that draws nothing.
 *
 * @param onFirst called as the first is requested
 */
export function drawNothing(onFirst: () => void = () => {}): void {
  if (isInstalled) return;
  isInstalled = true;
  let isFirst = true;
  hookContexts((canvas, options) => {
    if (isFirst) onFirst();
    isFirst = false;
    const context = contexts.get(canvas) ?? undrawnContext(canvas, options);
    contexts.set(canvas, context);
    return context;
  });
}

function undrawnContext(canvas: HTMLCanvasElement, options: object = {}): Context {
  const constants = new Map<number, string>();
  const context: Record<string, unknown> = { canvas, drawingBufferColorSpace: "srgb" };
  for (let at: object = WebGL2RenderingContext.prototype; at; at = Object.getPrototypeOf(at)) {
    for (const [name, { value }] of Object.entries(Object.getOwnPropertyDescriptors(at))) {
      if (typeof value === "number") {
        context[name] = value;
        if (name in parameters) constants.set(value, name);
      } else if (typeof value === "function") context[name] ??= () => null;
    }
  }
  const size = () => [0, 0, canvas.width, canvas.height];
  const made = (): object => ({});
  const succeeds = (): boolean => true;
  let isLost = false;
  /** Whether a listener has asked for the lost context, by preventing the default. */
  let isAwaited = false;
  const setLost = (lost: boolean, name: string): void => {
    if (lost === isLost || (isLost && !isAwaited)) return;
    isLost = lost;
    // As from a browser, once whatever lost it has returned.
    queueMicrotask(() => {
      isAwaited = !canvas.dispatchEvent(new Event(name, { cancelable: true }));
    });
  };
  const extensions: Readonly<Record<string, object>> = {
    WEBGL_lose_context: {
      loseContext: () => setLost(true, "webglcontextlost"),
      restoreContext: () => setLost(false, "webglcontextrestored"),
    },
  };
  Object.assign(context, {
    getContextAttributes: () =>
      isLost ? null : { alpha: true, depth: true, ...options, antialias: false },
    getExtension: (name: string) => extensions[name] ?? null,
    getParameter: (name: number) => {
      if (name === context.SCISSOR_BOX || name === context.VIEWPORT) return size();
      const constant = constants.get(name);
      return constant === undefined ? 0 : parameters[constant];
    },
    getShaderPrecisionFormat: () => ({ rangeMin: 127, rangeMax: 127, precision: 23 }),
    getShaderParameter: succeeds,
    getProgramParameter: (_: object, name: number) => name === context.LINK_STATUS || 0,
    getProgramInfoLog: () => "",
    getShaderInfoLog: () => "",
    getError: () => 0,
    isContextLost: () => isLost,
    createBuffer: made,
    createFramebuffer: made,
    createProgram: made,
    createRenderbuffer: made,
    createSampler: made,
    createShader: made,
    createTexture: made,
    createVertexArray: made,
    checkFramebufferStatus: () => context.FRAMEBUFFER_COMPLETE,
  });
  return context as unknown as Context;
}
