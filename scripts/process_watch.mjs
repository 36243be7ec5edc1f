/**
 * What the browser's processes take, for tests that run in it: time of processors, which a loaded machine
 * leaves about as it is, and memory at its greatest, which only the operating system knows.
 */
import { readFileSync, writeFileSync } from "node:fs";

/** The session by the page that asked for it, and what its processes had when it was last asked. */
const watches = new WeakMap();

/**
 * Returns the memory of a process in bytes, now and at its greatest since `begin` was true here; null where
 * the operating system does not say.
 */
function memoryOf(process, begin) {
  const folder = `/proc/${process}`;
  try {
    // Linux: the greatest since then is measured anew.
    if (begin) writeFileSync(`${folder}/clear_refs`, "5");
    const status = readFileSync(`${folder}/status`, "utf8");
    const bytes = (name) => 1024 * Number(new RegExp(`${name}:\\s*(\\d+) kB`).exec(status)?.[1]);
    return { now: bytes("VmRSS"), most: bytes("VmHWM") };
  } catch {
    return null;
  }
}

/**
 * Commands of the browser tests.
 * @type {Record<string, (context: import("vitest/node").BrowserCommandContext) => Promise<unknown>>}
 */
export const processCommands = {
  /**
   * Returns what all processes of the browser have taken since the last call, or since the page was opened:
   * seconds of processors, and by how many bytes more than at that call they had at their greatest.
   *
   * @returns {Promise<{ seconds: number, bytes: number | null }>} `bytes` is null where the operating
   *   system does not say it: on other systems than Linux
   */
  async processUse({ page }) {
    const watch = watches.get(page) ?? {
      session: await page.context().browser().newBrowserCDPSession(),
      before: new Map(),
    };
    watches.set(page, watch);
    const { processInfo } = await watch.session.send("SystemInfo.getProcessInfo");
    let [seconds, bytes] = [0, 0];
    const now = new Map();
    for (const { id, cpuTime } of processInfo) {
      const before = watch.before.get(id) ?? { cpuTime: 0, memory: 0 };
      const most = memoryOf(id, false)?.most;
      const memory = memoryOf(id, true)?.now;
      seconds += cpuTime - before.cpuTime;
      bytes =
        most === undefined || bytes === null ? null : bytes + Math.max(most - before.memory, 0);
      now.set(id, { cpuTime, memory: memory ?? 0 });
    }
    watch.before = now;
    return { seconds, bytes };
  },
};
