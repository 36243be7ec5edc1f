/** The one place at which the tests' helpers come between a canvas and its WebGL 2 context. */

type Context = WebGL2RenderingContext | null;

/**
 * Returns the context that a canvas is to have.
 *
 * @param next returns the one that it would have otherwise, with the options of the request or others
 */
type Hook = (
  canvas: HTMLCanvasElement,
  options: object | undefined,
  next: (options?: object) => Context,
) => Context;

const { getContext } = HTMLCanvasElement.prototype;
const hooks: Hook[] = [];

/** Has each request of a file for a WebGL 2 context go through a hook, before those that were added earlier. */
export function hookContexts(hook: Hook): void {
  if (hooks.push(hook) === 1) HTMLCanvasElement.prototype.getContext = hooked as typeof getContext;
}

function hooked(this: HTMLCanvasElement, kind: string, options?: object): RenderingContext | null {
  if (kind !== "webgl2") return getContext.call(this, kind, options);
  const from = (last: number, options?: object): Context =>
    last < 0
      ? (getContext.call(this, kind, options) as Context)
      : hooks[last](this, options, (options) => from(last - 1, options));
  return from(hooks.length - 1, options);
}
