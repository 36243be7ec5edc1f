import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";

/**
 * The reader app, the filming page and the playground, built beside the command
 * that serves them.
 */
export default defineConfig({
  root: fileURLToPath(new URL("./app", import.meta.url)),
  publicDir: false,
  build: {
    outDir: "../dist/app",
    emptyOutDir: true,
    // Nothing inline: the server's security policy allows only files.
    assetsInlineLimit: 0,
    rolldownOptions: {
      input: ["index.html", "film.html", "playground.html"].map((name) =>
        fileURLToPath(new URL(`./app/${name}`, import.meta.url)),
      ),
    },
    modulePreload: { polyfill: false },
    target: "es2022",
    chunkSizeWarningLimit: 2000,
    license: { fileName: "licenses.md" },
  },
});
