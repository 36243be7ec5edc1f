import { join } from "node:path";
import { playwright } from "@vitest/browser-playwright";
import { defineConfig, type TestProjectConfiguration } from "vitest/config";
import { packedFiles } from "./packages/turnleaf/packed_files.js";
import { svelteFiles } from "./packages/turnleaf/svelte_files.js";
import { turnInline } from "./packages/turnleaf/turn_inline.js";
import { wasmInline } from "./packages/turnleaf/wasm_inline.js";
import { workerInline } from "./packages/turnleaf/worker_inline.js";
import { chromiumArguments, findChromium } from "./scripts/chromium.mjs";
import { consoleCommands } from "./scripts/console_watch.mjs";
import { keepModules } from "./scripts/keep_modules.mjs";
import { printingCommands } from "./scripts/printed_pdf.mjs";
import { processCommands } from "./scripts/process_watch.mjs";
import { requestCommands } from "./scripts/request_watch.mjs";

/** The list of steps that Chromium, Firefox and WebKitGTK go through with the built package. */
const engines = "packages/cli/tests/engines/*.test.ts";

/** Tests of where pages come from, but for those of which modules are loaded when. */
const sources = "packages/turnleaf/src/sources/**/!(preparing).browser.test.ts";

/** Tests of which modules are loaded when, and of all that a page has for assistive technology. */
const alone = [
  "packages/turnleaf/src/canvas2d/canvas2d.browser.test.ts",
  "packages/turnleaf/src/element/opening.browser.test.ts",
  "packages/turnleaf/src/sources/preparing.browser.test.ts",
  "packages/turnleaf/src/text/text_layer.browser.test.ts",
];

/** Nothing is drawn by WebGL. */
const undrawn = { setup: "browser_setup.ts", flags: ["--disable-gpu"] };

/** Tests of what Chromium has behind a flag: pages that are elements, drawn while they turn. */
const htmlInCanvas = ["packages/turnleaf/src/element/live_drawings.canvas.test.ts"];

/** What the random tests and those of long samples read, for those that run in a browser. */
const { TURNLEAF_SEED = "1", TURNLEAF_FUZZ = "1", TURNLEAF_LONG = "" } = process.env;

/** Where no test is looked for. */
const installed = ["**/node_modules/**", "**/dist/**"];

/** Archives that tests read. */
const archives = ["**/*.rar", "**/*.7z", "**/*.cb7"];

/**
 * The projects of a group run beside each other. Those of Chromium run their files one at a time, each in
 * its own browser; those of Node share this many processes, so that none of them is alone at the end.
 */
const beside = { maxWorkers: 2, sequence: { groupOrder: 1 } };

/** A project whose files run in Chromium. */
interface ChromiumProject {
  readonly name: string;
  readonly include: string[];
  readonly exclude?: string[];
  /** What runs before each file. */
  readonly setup: string;
  /** Flags of Chromium besides those of all. */
  readonly flags?: string[];
}

/**
 * Projects that run in the real Chromium of this machine, a browser each. They share a server, as one for
 * each would find, bundle and transform the same modules again. With `sharesPage` the files of a project run
 * one after another in a page that has the viewer's modules loaded, otherwise each in a page of its own.
 */
function inChromium(
  name: string,
  { sharesPage }: { sharesPage: boolean },
  projects: readonly ChromiumProject[],
): TestProjectConfiguration {
  return {
    plugins: [
      keepModules(),
      wasmInline(),
      turnInline(),
      packedFiles(),
      workerInline(),
      svelteFiles(),
    ],
    assetsInclude: archives,
    optimizeDeps: {
      include: [
        "three",
        "pdfjs-dist/legacy/build/pdf.mjs",
        "axe-core",
        "chardet",
        "htmlparser2",
        "hyphen/hyphen.js",
        "hyphen/patterns/en-gb.js",
        "hyphen/patterns/en-us.js",
        "page-flip/dist/js/page-flip.module.js",
        "react",
        "react-dom/client",
        "react-dom/server.browser",
        "svelte",
        "svelte/internal/client",
        "svelte/internal/disclose-version",
        "svelte/internal/server",
        "svelte/server",
        "vue",
        "vue/server-renderer",
      ],
    },
    // As bundlers are to say it to Vue.
    define: {
      __VUE_OPTIONS_API__: "true",
      __VUE_PROD_DEVTOOLS__: "false",
      __VUE_PROD_HYDRATION_MISMATCH_DETAILS__: "true",
    },
    // The examples import the package by its name.
    resolve: {
      alias: [
        {
          find: /^turnleaf$/,
          replacement: join(import.meta.dirname, "packages/turnleaf/src/index.ts"),
        },
      ],
    },
    test: {
      name,
      include: projects.flatMap(({ include }) => include),
      exclude: installed,
      // Nothing takes as long; on a machine that does eight other things as well it is a tenth of it.
      testTimeout: 120_000,
      hookTimeout: 120_000,
      ...beside,
      env: { TURNLEAF_SEED, TURNLEAF_FUZZ, TURNLEAF_LONG },
      browser: {
        enabled: true,
        fileParallelism: false,
        isolate: !sharesPage,
        headless: true,
        screenshotFailures: false,
        commands: {
          ...consoleCommands,
          ...printingCommands,
          ...processCommands,
          ...requestCommands,
        },
        provider: playwright(),
        instances: projects.map(({ name, include, exclude = [], setup, flags = [] }) => ({
          browser: "chromium",
          name,
          viewport: { width: 800, height: 600 },
          include,
          exclude: [...installed, ...exclude],
          setupFiles: [join(import.meta.dirname, "packages/turnleaf/src/for_tests", setup)],
          provider: playwright({
            launchOptions: {
              executablePath: findChromium(),
              args: [...chromiumArguments, ...flags],
            },
          }),
        })),
      },
    },
  };
}

/**
 * Files that run in Node, each in a process of its own unless `sharesProcess`: then a process runs one
 * after another. Those of what is built say so if it is stale.
 */
function inNode(
  name: string,
  include: string[],
  {
    exclude = [],
    isOfBuild = false,
    sharesProcess = false,
  }: { exclude?: string[]; isOfBuild?: boolean; sharesProcess?: boolean } = {},
): TestProjectConfiguration {
  return {
    plugins: [wasmInline(), turnInline(), packedFiles(), workerInline(), svelteFiles()],
    assetsInclude: ["**/*.tlkf", ...archives],
    test: {
      name,
      environment: "node",
      include,
      exclude: [...["**/*.{browser,drawn,canvas}.test.ts", ...exclude], ...installed],
      testTimeout: 120_000,
      hookTimeout: 120_000,
      globalSetup: isOfBuild ? ["scripts/stale_build.mjs"] : [],
      ...beside,
      isolate: !sharesProcess,
    },
  };
}

/**
 * `*.test.ts` runs in Node; in the real Chromium of this machine run `*.browser.test.ts`, of which nothing
 * is drawn, and `*.drawn.test.ts`, which read pixels.
 */
export default defineConfig({
  test: {
    projects: [
      inNode("engines", [engines], { isOfBuild: true }),
      inNode("command", ["packages/cli/{app,tests}/**/*.test.ts"], {
        exclude: [engines],
        isOfBuild: true,
        // What drives the browsers is loaded once in a process, and they are started once.
        sharesProcess: true,
      }),
      inNode(
        "node",
        [
          "packages/turnleaf/**/*.test.{ts,mjs}",
          "packages/cli/src/**/*.test.ts",
          "books/**/*.test.{ts,mjs}",
          "scripts/**/*.test.mjs",
          "tests/**/*.test.mjs",
        ],
        // Starting one for each file takes a sixth of the processors' time.
        { sharesProcess: true },
      ),
      inChromium("chromium, in one page", { sharesPage: true }, [
        {
          name: "chromium",
          include: ["packages/**/*.browser.test.ts"],
          exclude: [sources, ...alone],
          ...undrawn,
        },
        // They read books and show few, and loading the readers takes as long as most of these files.
        { name: "chromium, sources", include: [sources], ...undrawn },
      ]),
      inChromium("chromium, each in a page", { sharesPage: false }, [
        { name: "chromium, alone", include: alone, ...undrawn },
        {
          name: "chromium, drawn",
          include: ["packages/**/*.drawn.test.ts"],
          setup: "drawn_setup.ts",
          // What is around a book is painted and composed without the graphics process, in which software
          // imitates a graphics card, and so are pages' pictures: that is for the books.
          flags: [
            "--disable-accelerated-2d-canvas",
            "--disable-gpu-rasterization",
            "--disable-gpu-compositing",
          ],
        },
        {
          name: "chromium with HTML in canvas",
          include: htmlInCanvas,
          setup: "drawn_setup.ts",
          flags: ["--enable-blink-features=CanvasDrawElement"],
        },
      ]),
    ],
  },
});
