import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "../../../../scripts/chromium.mjs";
import { type DrivenBrowser, scriptResult, scriptText, windowSize } from "./driven_browser.ts";

/** Starts Chromium, without a screen. */
export async function startChromium(): Promise<DrivenBrowser> {
  const browser = await chromium.launch({
    executablePath: findChromium(),
    args: chromiumArguments,
  });
  const context = await browser.newContext({
    viewport: windowSize,
    permissions: ["clipboard-read", "clipboard-write"],
  });
  const page = await context.newPage();
  return {
    version: `Chromium ${browser.version()}`,
    async open(url) {
      await page.goto(url);
    },
    run: async (script, ...args) =>
      scriptResult(await page.evaluate(scriptText(script as never, args))),
    movePointer: (x, y) => page.mouse.move(x, y),
    pressButton: () => page.mouse.down(),
    releaseButton: () => page.mouse.up(),
    async doubleClick() {
      for (const clickCount of [1, 2]) {
        await page.mouse.down({ clickCount });
        await page.mouse.up({ clickCount });
      }
    },
    pressKeys: (...keys) => page.keyboard.press(keys.join("+")),
    screenshot: () => page.screenshot(),
    close: () => browser.close(),
  };
}
