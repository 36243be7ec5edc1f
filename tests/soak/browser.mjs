/**
 * A browser with one page, driven over a pipe by the protocol of its developer
 * tools. A driver made for tests, such as Playwright, has the page keep the bodies
 * of all that it fetches, up to 100 MB and more: here that would be measured as the
 * page's own memory.
 */
import { spawn } from "node:child_process";
import { EventEmitter } from "node:events";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromiumArguments, findChromium } from "../../scripts/chromium.mjs";

/** Commands to the browser or to its page, and their events. */
class Session extends EventEmitter {
  constructor(send) {
    super();
    this.send = send;
  }
}

export class Browser {
  /** The browser's own session, and the page's. */
  session;
  page;
  #child;
  #profile;
  #waiting = new Map();
  #count = 0;
  #unread = [];

  /** Starts a browser whose page has a size in CSS pixels. */
  static async start(width, height) {
    const browser = new Browser();
    browser.#profile = await mkdtemp(join(tmpdir(), "turnleaf-soak-"));
    const own = ["--headless", "--remote-debugging-pipe", `--user-data-dir=${browser.#profile}`];
    browser.#child = spawn(findChromium(), [...chromiumArguments, ...own], {
      stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"],
    });
    browser.#child.stdio[4].on("data", (data) => browser.#read(data));
    browser.#child.stdio[3].on("error", () => {});
    browser.#child.once("exit", () => browser.#end("The browser has ended."));
    browser.session = new Session((...what) => browser.#ask(undefined, ...what));
    const { targetId } = await browser.session.send("Target.createTarget", { url: "about:blank" });
    const attached = { targetId, flatten: true };
    const { sessionId } = await browser.session.send("Target.attachToTarget", attached);
    browser.page = new Session((...what) => browser.#ask(sessionId, ...what));
    for (const domain of ["Page", "Runtime", "Log", "Performance", "Inspector"]) {
      await browser.page.send(`${domain}.enable`);
    }
    browser.page.on("Inspector.targetCrashed", () => browser.#end("The page has crashed."));
    const size = { width, height, deviceScaleFactor: 1, mobile: false };
    await browser.page.send("Emulation.setDeviceMetricsOverride", size);
    return browser;
  }

  get pid() {
    return this.#child.pid;
  }

  /** Has a function run in the page before anything else. */
  async runFirst(work, argument) {
    const source = `(${work})(${JSON.stringify(argument)})`;
    await this.page.send("Page.addScriptToEvaluateOnNewDocument", { source });
  }

  /** Goes to an address; resolves once it is loaded. */
  async goTo(url) {
    const loaded = new Promise((resolve) => this.page.once("Page.loadEventFired", resolve));
    await this.page.send("Page.navigate", { url });
    await loaded;
  }

  /** What a function returns in the page. Rejects where it fails there. */
  async evaluate(work, argument) {
    const expression = `(${work})(${JSON.stringify(argument)})`;
    const options = { expression, awaitPromise: true, returnByValue: true };
    const { result, exceptionDetails } = await this.page.send("Runtime.evaluate", options);
    if (!exceptionDetails) return result.value;
    throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
  }

  /** What the page looks like, as PNG in base64. */
  async picture() {
    return (await this.page.send("Page.captureScreenshot", { format: "png" })).data;
  }

  /** Lets the page call a function, of no argument, by a name. */
  async expose(name, work) {
    await this.page.send("Runtime.addBinding", { name: `${name}Binding` });
    this.page.on("Runtime.bindingCalled", async (event) => {
      if (event.name !== `${name}Binding`) return;
      const value = await work();
      await this.evaluate(([name, value]) => globalThis[`${name}Done`](value), [name, value]);
    });
    await this.runFirst((name) => {
      globalThis[name] = () =>
        new Promise((resolve) => {
          globalThis[`${name}Done`] = (value) => resolve(value);
          globalThis[`${name}Binding`]("");
        });
    }, name);
  }

  /** Ends it and removes what it wrote. */
  async close() {
    const ended = new Promise((resolve) => this.#child.once("close", resolve));
    this.session.send("Browser.close").catch(() => {});
    await ended;
    await rm(this.#profile, { recursive: true, force: true, maxRetries: 5 });
  }

  #ask(sessionId, method, params = {}) {
    const id = ++this.#count;
    this.#child.stdio[3].write(`${JSON.stringify({ id, sessionId, method, params })}\0`);
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }

  #read(data) {
    let start = 0;
    for (let end = data.indexOf(0); end >= 0; end = data.indexOf(0, start)) {
      const text = Buffer.concat([...this.#unread, data.subarray(start, end)]).toString();
      this.#unread = [];
      start = end + 1;
      this.#hear(JSON.parse(text));
    }
    this.#unread.push(data.subarray(start));
  }

  #hear({ id, result, error, method, params, sessionId }) {
    const waiting = this.#waiting.get(id);
    this.#waiting.delete(id);
    if (error) waiting?.reject(new Error(error.message));
    else waiting?.resolve(result);
    if (method) (sessionId ? this.page : this.session)?.emit(method, params);
  }

  #end(sentence) {
    for (const { reject } of this.#waiting.values()) reject(new Error(sentence));
    this.#waiting.clear();
  }
}
