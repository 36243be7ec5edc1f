/** What a page that shows books holds: counted in the page as it is made and given back. */

import type { CDPSession, Page } from "playwright-core";
import { passFrames } from "./waiting.ts";

/** Runs in the page before anything else: counts what is made and not given back. */
export function countHoldings(): void {
  const holdings = {
    textures: new Map<WebGLTexture, number>(),
    bitmaps: new Map<ImageBitmap, number>(),
    canvases: [] as WeakRef<HTMLCanvasElement>[],
    contexts: [] as WeakRef<WebGL2RenderingContext>[],
    memories: [] as WeakRef<WebAssembly.Memory>[],
    workers: new Set<Worker>(),
    urls: new Set<string>(),
    frames: 0,
    timers: new Set<number>(),
  };
  // The browser's own record of requests is no part of the viewer.
  performance.setResourceTimingBufferSize(0);
  Object.assign(globalThis, { holdings });

  /** Counts the textures of a context. Of one that draws nothing the methods are its own. */
  const watchTextures = (gl: WebGL2RenderingContext): void => {
    const bound = new Map<number, WebGLTexture | null>();
    const { bindTexture, texStorage2D, deleteTexture } = gl;
    gl.bindTexture = (target, texture) => {
      bound.set(target, texture);
      bindTexture.call(gl, target, texture);
    };
    gl.texStorage2D = (target, levels, format, width, height) => {
      const texture = bound.get(target);
      // Smaller levels take a third as much again.
      if (texture) holdings.textures.set(texture, width * height * 4 * (levels > 1 ? 4 / 3 : 1));
      texStorage2D.call(gl, target, levels, format, width, height);
    };
    gl.deleteTexture = (texture) => {
      if (texture) holdings.textures.delete(texture);
      deleteTexture.call(gl, texture);
    };
  };
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...args: unknown[]) {
    const context = Reflect.apply(getContext, this, args);
    if (args[0] !== "webgl2" || !context) return context;
    if (holdings.contexts.every((known) => known.deref() !== context)) {
      holdings.contexts.push(new WeakRef(context));
      watchTextures(context);
    }
    return context;
  } as typeof getContext;
  const { createElement } = Document.prototype;
  Document.prototype.createElement = function (this: Document, ...args: unknown[]) {
    const element = Reflect.apply(createElement, this, args);
    if (element instanceof HTMLCanvasElement) holdings.canvases.push(new WeakRef(element));
    return element;
  } as typeof createElement;

  const make = globalThis.createImageBitmap;
  globalThis.createImageBitmap = (async (...args: Parameters<typeof make>) => {
    const bitmap = await make(...args);
    holdings.bitmaps.set(bitmap, bitmap.width * bitmap.height * 4);
    return bitmap;
  }) as typeof make;
  const { close } = ImageBitmap.prototype;
  ImageBitmap.prototype.close = function () {
    holdings.bitmaps.delete(this);
    close.call(this);
  };

  const { instantiate } = WebAssembly;
  WebAssembly.instantiate = (async (...args: [WebAssembly.Module]) => {
    const made = await instantiate(...args);
    const memory = made.exports?.memory;
    if (memory instanceof WebAssembly.Memory) holdings.memories.push(new WeakRef(memory));
    return made;
  }) as unknown as typeof instantiate;

  globalThis.Worker = class extends Worker {
    constructor(...args: ConstructorParameters<typeof Worker>) {
      super(...args);
      holdings.workers.add(this);
    }
    override terminate(): void {
      holdings.workers.delete(this);
      super.terminate();
    }
  };
  const { createObjectURL, revokeObjectURL } = URL;
  URL.createObjectURL = (blob) => {
    const url = createObjectURL(blob);
    holdings.urls.add(url);
    return url;
  };
  URL.revokeObjectURL = (url) => {
    holdings.urls.delete(url);
    revokeObjectURL(url);
  };
  const request = globalThis.requestAnimationFrame;
  globalThis.requestAnimationFrame = (call) => {
    holdings.frames++;
    return request(call);
  };
  const { setTimeout: start, clearTimeout } = globalThis;
  globalThis.setTimeout = ((call: (...given: unknown[]) => void, delay?: number, ...given: []) => {
    const id = start(() => {
      holdings.timers.delete(id);
      call(...given);
    }, delay) as unknown as number;
    holdings.timers.add(id);
    return id;
  }) as typeof setTimeout;
  globalThis.clearTimeout = (id) => {
    holdings.timers.delete(id as unknown as number);
    clearTimeout(id);
  };
}

/** What a page holds, after its garbage was collected. */
export interface Holdings {
  /** Bytes of the JavaScript heap. */
  readonly heap: number;
  readonly nodes: number;
  readonly listeners: number;
  /** Bytes of textures, and of pictures in bitmaps and canvases. */
  readonly textureBytes: number;
  readonly pictureBytes: number;
  /** Bytes of WASM memories. */
  readonly memoryBytes: number;
  /** WebGL contexts that are not given up, WASM memories, workers and object URLs. */
  readonly contexts: number;
  readonly memories: number;
  readonly workers: number;
  readonly urls: number;
  /** Frames that were requested since the page was opened, and timers that run. */
  readonly frames: number;
  readonly timers: number;
}

/** Frames that {@link holdingsOf} requests. */
export const framesOfMeasuring = 3;

/** Collects a page's garbage and returns what is left. */
export async function holdingsOf(page: Page, session: CDPSession): Promise<Holdings> {
  // Twice: what the first round finalises is free only in the second.
  for (let round = 0; round < framesOfMeasuring; round++) {
    await session.send("HeapProfiler.collectGarbage");
    await passFrames(page, 1);
  }
  const { metrics } = await session.send("Performance.getMetrics");
  const metric = (name: string) =>
    metrics.find((known) => known.name === name)?.value ?? Number.NaN;
  const counted = await page.evaluate(() => {
    const { holdings } = globalThis as unknown as { holdings: Record<string, never> };
    const { textures, bitmaps, canvases, contexts, memories, workers, urls, frames, timers } =
      holdings as never as {
        textures: Map<unknown, number>;
        bitmaps: Map<unknown, number>;
        canvases: WeakRef<HTMLCanvasElement>[];
        contexts: WeakRef<WebGL2RenderingContext>[];
        memories: WeakRef<WebAssembly.Memory>[];
        workers: Set<unknown>;
        urls: Set<unknown>;
        frames: number;
        timers: Set<unknown>;
      };
    const sum = (sizes: Iterable<number>) => [...sizes].reduce((total, size) => total + size, 0);
    const live = <T extends object>(refs: WeakRef<T>[]) =>
      refs.map((ref) => ref.deref()).filter((thing) => thing !== undefined);
    return {
      textureBytes: sum(textures.values()),
      pictureBytes:
        sum(bitmaps.values()) + sum(live(canvases).map(({ width, height }) => width * height * 4)),
      contexts: live(contexts).filter((context) => !context.isContextLost()).length,
      memories: live(memories).length,
      memoryBytes: sum(live(memories).map(({ buffer }) => buffer.byteLength)),
      workers: workers.size,
      urls: urls.size,
      frames,
      timers: timers.size,
    };
  });
  return {
    heap: metric("JSHeapUsedSize"),
    nodes: metric("Nodes"),
    listeners: metric("JSEventListeners"),
    ...counted,
  };
}
