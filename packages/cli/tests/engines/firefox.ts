import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { findFirefox } from "../../../../scripts/browsers.mjs";
import { connectBidi } from "./bidi.ts";
import { Child } from "./child.ts";
import { type DrivenBrowser, scriptResult, scriptText, windowSize } from "./driven_browser.ts";
import { type Screen, startScreen } from "./screen.ts";
import * as actions from "./webdriver_actions.ts";

/** Starts Firefox on a screen, where it has WebGL. */
export async function startFirefox(): Promise<DrivenBrowser> {
  return start(await startScreen());
}

/** Starts Firefox without a screen, where it has no WebGL. */
export const startHeadlessFirefox = (): Promise<DrivenBrowser> => start(null);

async function start(screen: Screen | null): Promise<DrivenBrowser> {
  const profile = await mkdtemp(join(tmpdir(), "turnleaf-firefox-"));
  await writeFile(join(profile, "user.js"), userPreferences);
  const child = new Child(
    findFirefox() ?? "firefox",
    [
      ...(screen ? [] : ["--headless"]),
      ...["--no-remote", "--profile", profile, "--remote-debugging-port", "0", "about:blank"],
    ],
    screen?.environment,
  );
  const [, url] = await child.says(/WebDriver BiDi listening on (ws:\S+)/);
  const browser = await connectBidi(`${url}/session`);
  const { contexts } = await browser.send("browsingContext.getTree", {});
  const [{ context }] = contexts as [{ context: string }];
  await browser.send("browsingContext.setViewport", { context, viewport: windowSize });
  const perform = async (sources: actions.Actions): Promise<void> => {
    await browser.send("input.performActions", { context, actions: sources });
  };
  return {
    version: `Firefox ${browser.capabilities.browserVersion}`,
    async open(url) {
      await browser.send("browsingContext.navigate", { context, url, wait: "complete" });
    },
    async run(script, ...args) {
      const { result, exceptionDetails } = await browser.send("script.evaluate", {
        expression: scriptText(script as never, args),
        target: { context },
        awaitPromise: true,
        userActivation: false,
      });
      if (exceptionDetails) throw new Error((exceptionDetails as { text: string }).text);
      return scriptResult((result as { value: string }).value);
    },
    movePointer: (x, y) => perform(actions.movePointer(x, y)),
    pressButton: () => perform(actions.pressButton()),
    releaseButton: () => perform(actions.releaseButton()),
    doubleClick: () => perform(actions.doubleClick()),
    pressKeys: (...keys) => perform(actions.pressKeys(...keys)),
    async screenshot() {
      const { data } = await browser.send("browsingContext.captureScreenshot", { context });
      return Buffer.from(data as string, "base64");
    },
    async close() {
      await browser.send("browser.close", {});
      browser.disconnect();
      await child.end();
      await screen?.close();
      await rm(profile, { recursive: true, force: true, maxRetries: 5 });
    },
  };
}

/** Nothing is fetched, asked or shown beside the page. */
const userPreferences = Object.entries({
  "app.normandy.enabled": false,
  "app.update.enabled": false,
  "browser.shell.checkDefaultBrowser": false,
  "browser.startup.page": 0,
  "datareporting.policy.dataSubmissionEnabled": false,
  "extensions.update.enabled": false,
  "media.gmp-manager.updateEnabled": false,
  "network.captive-portal-service.enabled": false,
  "network.connectivity-service.enabled": false,
  "services.settings.server": "data:,",
  "toolkit.telemetry.enabled": false,
})
  .map(([name, value]) => `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});\n`)
  .join("");
