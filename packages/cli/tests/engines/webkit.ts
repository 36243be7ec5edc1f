import { findMiniBrowser, findWebKitDriver } from "../../../../scripts/browsers.mjs";
import { Child } from "./child.ts";
import { type DrivenBrowser, scriptResult, scriptText, windowSize } from "./driven_browser.ts";
import { freePort } from "./free_port.ts";
import { startScreen } from "./screen.ts";
import * as actions from "./webdriver_actions.ts";

/** Timeout of a script, milliseconds: software rendering is slow. */
const scriptTime = 120_000;

/** Starts WebKitGTK's MiniBrowser on a screen. */
export async function startWebKit(): Promise<DrivenBrowser> {
  const screen = await startScreen();
  const port = await freePort();
  const driver = new Child(
    findWebKitDriver() ?? "WebKitWebDriver",
    [`--port=${port}`],
    screen.environment,
  );
  const send = async (method: "POST" | "GET" | "DELETE", path: string, body?: object) => {
    const response = await fetch(`http://127.0.0.1:${port}${path}`, {
      method,
      ...(body && { body: JSON.stringify(body) }),
    });
    const { value } = (await response.json()) as { value: Record<string, unknown> };
    if (!response.ok) throw new Error(`${path}: ${value.error} ${value.message}`);
    return value;
  };
  await respondsAt(`http://127.0.0.1:${port}/status`);
  const made = await send("POST", "/session", {
    capabilities: {
      alwaysMatch: {
        "webkitgtk:browserOptions": { binary: findMiniBrowser(), args: ["--automation"] },
      },
    },
  });
  const session = `/session/${made.sessionId}`;
  await send("POST", `${session}/timeouts`, { script: scriptTime });
  await send("POST", `${session}/window/rect`, { x: 0, y: 0, ...windowSize });
  const perform = async (sources: actions.Actions): Promise<void> => {
    await send("POST", `${session}/actions`, { actions: sources });
  };
  const { browserVersion } = made.capabilities as { browserVersion: string };
  return {
    version: `WebKitGTK ${browserVersion}`,
    async open(url) {
      await send("POST", `${session}/url`, { url });
    },
    async run(script, ...args) {
      const value = (await send("POST", `${session}/execute/async`, {
        script: `const done = arguments[0];
          ${scriptText(script as never, args)}.then(
            (value) => done({ value }),
            (error) => done({ error: String(error) }),
          );`,
        args: [],
      })) as { value: string; error?: string };
      if (value.error !== undefined) throw new Error(value.error);
      return scriptResult(value.value);
    },
    movePointer: (x, y) => perform(actions.movePointer(x, y)),
    pressButton: () => perform(actions.pressButton()),
    releaseButton: () => perform(actions.releaseButton()),
    doubleClick: () => perform(actions.doubleClick()),
    pressKeys: (...keys) => perform(actions.pressKeys(...keys)),
    async screenshot() {
      const data = (await send("GET", `${session}/screenshot`)) as unknown as string;
      return Buffer.from(data, "base64");
    },
    async close() {
      await send("DELETE", session);
      await driver.kill();
      await screen.close();
    },
  };
}

/** Resolves once a starting server responds at an address. */
async function respondsAt(url: string): Promise<void> {
  for (let round = 0; round < 300; round++) {
    const response = await fetch(url).catch(() => null);
    if (response?.ok) return;
    // biome-ignore lint/plugin: Whether another process listens is only seen by asking.
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  throw new Error(`Nothing responds at ${url}.`);
}
