/**
 * One page in a headless Chromium, driven over a pipe by the protocol of its
 * developer tools: for the few commands of a film no library need be installed.
 */

import { type ChildProcess, spawn } from "node:child_process";
import type { Readable, Writable } from "node:stream";
import { Problem, printable } from "../problem.ts";
import { makeTemporary, noteProgram, removeTemporary } from "../temporary.ts";

/** Pages of its own that a browser loads for its window: what drops down from its address bar. */
const unseen = ["WebUIOmniboxPopup", "WebUIOmniboxAimPopup", "WebUIOmniboxFullPopup"];

/**
 * No network requests of its own, no traces left, no page but the one that is asked for, no experiments of
 * its makers, and software rendering without a graphics card.
 */
const flags = [
  "--headless",
  "--remote-debugging-pipe",
  "--no-startup-window",
  "--disable-field-trial-config",
  `--disable-features=${unseen.join(",")}`,
  "--no-first-run",
  "--no-default-browser-check",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--disable-quic",
  "--disable-extensions",
  "--mute-audio",
  "--hide-scrollbars",
  "--force-color-profile=srgb",
  "--enable-unsafe-swiftshader",
  "--ignore-gpu-blocklist",
];

/**
 * The root user has no sandbox on Linux, and the file system's shared memory
 * may be small there.
 */
const rootFlags = ["--no-sandbox", "--disable-dev-shm-usage"];

/** Timeout for the browser to end by itself, milliseconds. */
const patience = 5000;

interface Waiting {
  readonly resolve: (result: Record<string, unknown>) => void;
  readonly reject: (error: Error) => void;
}

/** A page of a running Chromium. */
export class ChromiumPage {
  readonly #child: ChildProcess;
  readonly #profile: string;
  readonly #waiting = new Map<number, Waiting>();
  readonly #ended: Promise<void>;
  #unread: Buffer[] = [];
  #count = 0;
  #session = "";
  #complaint = "";
  /** Why no command can be sent any more. */
  #gone: Problem | null = null;

  private constructor(child: ChildProcess, profile: string) {
    this.#child = child;
    this.#profile = profile;
    (child.stdio[4] as Readable).on("data", (data: Buffer) => this.#read(data));
    (child.stdio[3] as Writable).on("error", () => {});
    child.stderr?.on("data", (data: Buffer) => {
      this.#complaint = (this.#complaint + data.toString()).slice(-4000);
    });
    this.#ended = new Promise((resolve) => {
      child.once("error", () => this.#end(resolve));
      child.once("close", () => this.#end(resolve));
    });
  }

  /**
   * Starts a browser with one empty page of a size in pixels.
   *
   * @param moreFlags of its command line, besides those that every browser gets
   * @throws Problem if it does not start
   */
  static async start(
    program: string,
    width: number,
    height: number,
    moreFlags: readonly string[] = [],
  ): Promise<ChromiumPage> {
    const profile = await makeTemporary("chromium");
    const root = process.getuid?.() === 0 ? rootFlags : [];
    const child = spawn(program, [...flags, ...moreFlags, ...root, `--user-data-dir=${profile}`], {
      stdio: ["ignore", "ignore", "pipe", "pipe", "pipe"],
      // This command handles Ctrl+C in the terminal: it ends the browser itself.
      detached: process.platform !== "win32",
    });
    noteProgram(profile, child.pid);
    const page = new ChromiumPage(child, profile);
    try {
      const { targetId } = await page.#ask("Target.createTarget", { url: "about:blank" });
      const { sessionId } = await page.#ask("Target.attachToTarget", { targetId, flatten: true });
      page.#session = String(sessionId);
      const size = { width, height, deviceScaleFactor: 1, mobile: false };
      await page.#ask("Emulation.setDeviceMetricsOverride", size);
      // A film needs full motion.
      const features = [{ name: "prefers-reduced-motion", value: "no-preference" }];
      await page.#ask("Emulation.setEmulatedMedia", { features });
      return page;
    } catch (error) {
      await page.close();
      throw error;
    }
  }

  /** Whether the browser has ended. */
  get isGone(): boolean {
    return this.#gone !== null;
  }

  /** Goes to an address; resolves before it is loaded. */
  async goTo(url: string): Promise<void> {
    await this.#ask("Page.navigate", { url });
  }

  /**
   * Returns the value of an expression in the page, awaited.
   *
   * @throws Problem with the page's own sentence if it fails
   */
  async evaluate<T>(expression: string): Promise<T> {
    const options = { expression, awaitPromise: true, returnByValue: true };
    const reply = await this.#ask("Runtime.evaluate", options);
    const { exceptionDetails, result } = reply as {
      exceptionDetails?: { text: string; exception?: { description?: string } };
      result: { value: T };
    };
    if (!exceptionDetails) return result.value;
    const text = exceptionDetails.exception?.description ?? exceptionDetails.text;
    throw new Problem(printable((text.split("\n")[0] ?? "").replace(/^\w*Error: /, "")));
  }

  /** Returns a screenshot of the page, as PNG. */
  async picture(): Promise<Buffer> {
    const options = { format: "png", optimizeForSpeed: true };
    const { data } = await this.#ask("Page.captureScreenshot", options);
    return Buffer.from(String(data), "base64");
  }

  /** Ends the browser and removes its profile. */
  async close(): Promise<void> {
    if (this.#gone === null) this.#ask("Browser.close", {}).catch(() => {});
    const timer = setTimeout(() => this.#child.kill("SIGKILL"), patience);
    await this.#ended;
    clearTimeout(timer);
    await removeTemporary(this.#profile).catch(() => {});
  }

  #ask(method: string, params: object): Promise<Record<string, unknown>> {
    if (this.#gone) return Promise.reject(this.#gone);
    const id = ++this.#count;
    const isOfPage = !/^(Target|Browser)\./.test(method);
    const session = isOfPage ? { sessionId: this.#session } : {};
    (this.#child.stdio[3] as Writable).write(
      `${JSON.stringify({ id, method, params, ...session })}\0`,
    );
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }

  #read(data: Buffer): void {
    let start = 0;
    for (let end = data.indexOf(0); end >= 0; end = data.indexOf(0, start)) {
      this.#unread.push(data.subarray(start, end));
      this.#hear(Buffer.concat(this.#unread).toString());
      this.#unread = [];
      start = end + 1;
    }
    this.#unread.push(data.subarray(start));
  }

  #hear(text: string): void {
    const { id, result, error } = JSON.parse(text) as {
      id?: number;
      result?: Record<string, unknown>;
      error?: { message: string };
    };
    const waiting = id === undefined ? undefined : this.#waiting.get(id);
    if (id === undefined || !waiting) return;
    this.#waiting.delete(id);
    if (error)
      waiting.reject(new Problem(`Chromium reported an error: ${printable(error.message)}`));
    else waiting.resolve(result ?? {});
  }

  #end(resolve: () => void): void {
    const lines = this.#complaint.split("\n").filter((line) => /error|fatal/i.test(line));
    const reason = lines.length > 0 ? ` (${printable(lines.at(-1) ?? "")})` : "";
    this.#gone = new Problem(`Chromium ended before its work was done${reason}.`);
    for (const { reject } of this.#waiting.values()) reject(this.#gone);
    this.#waiting.clear();
    resolve();
  }
}
