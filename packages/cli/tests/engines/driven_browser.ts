/** A browser that a test opens a page in and uses as a reader does, whatever its engine. */

/** A page in a browser of its own, with the pointer and the keyboard over it. */
export interface DrivenBrowser {
  /** Name and version, such as "Firefox 140.5.0esr". */
  readonly version: string;
  /** Loads a page. Resolves once it is loaded. */
  open(url: string): Promise<void>;
  /**
   * Runs a function in the page and returns its result.
   * Arguments and result are copied as JSON; the function refers to nothing outside of itself.
   */
  run<A extends readonly unknown[], T>(script: (...args: A) => T, ...args: A): Promise<Awaited<T>>;
  /** Moves the mouse to a place, in CSS pixels from the page's upper left corner. */
  movePointer(x: number, y: number): Promise<void>;
  pressButton(): Promise<void>;
  releaseButton(): Promise<void>;
  doubleClick(): Promise<void>;
  /** Presses keys one after another, then releases them in the opposite order. */
  pressKeys(...keys: readonly Key[]): Promise<void>;
  /** The window's content as PNG. */
  screenshot(): Promise<Buffer>;
  /** Ends the browser. */
  close(): Promise<void>;
}

/** A key, by the name that `KeyboardEvent.key` has for it. */
export type Key = "ArrowLeft" | "ArrowRight" | "Control" | "a" | "c" | "v";

/** Source text of an expression that runs a function and yields a promise of its result as JSON. */
export function scriptText(
  script: (...args: never[]) => unknown,
  args: readonly unknown[],
): string {
  return `(async () => JSON.stringify([await (${script})(...${JSON.stringify(args)})]))()`;
}

/** The result of such an expression. */
export const scriptResult = (json: string): never => JSON.parse(json)[0] as never;

/** Starts a browser. */
export type StartBrowser = () => Promise<DrivenBrowser>;

/** Width and height of the window's content, CSS pixels. */
export const windowSize = { width: 480, height: 360 } as const;
