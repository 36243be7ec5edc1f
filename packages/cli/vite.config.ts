import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";

/**
 * The reader app and its shelf, the filming page, the playground and what `turnleaf publish`
 * draws and writes with, built beside the command that serves them.
 */
export default defineConfig({
  root: fileURLToPath(new URL("./app", import.meta.url)),
  publicDir: false,
  // A published site may lie in any folder of its host.
  base: "./",
  build: {
    outDir: "../dist/app",
    emptyOutDir: true,
    // By which a published site finds its scripts.
    manifest: "site_assets.json",
    // Nothing inline: the server's security policy allows only files.
    assetsInlineLimit: 0,
    rolldownOptions: {
      input: [
        ...["index.html", "shelf.html", "film.html", "playground.html", "publish/draw.html"],
        ...["book", "search", "shelf", "service_worker"].map((name) => `publish/${name}.ts`),
      ].map((name) => fileURLToPath(new URL(`./app/${name}`, import.meta.url))),
    },
    modulePreload: { polyfill: false },
    target: "es2022",
    chunkSizeWarningLimit: 2000,
  },
});
