import { dirname, join } from "node:path";

/**
 * Lets tests import components of Svelte, which are packed as they are: compiled for the browser, or
 * for a server in Node and where the address ends in `?server`. A plugin of vite.
 */
export function svelteFiles() {
  return {
    name: "turnleaf-svelte-files",
    enforce: "pre",
    resolveId(id, importer) {
      const [file, query] = importer?.split("?") ?? [];
      if (!file?.endsWith(".svelte")) return null;
      // Beside them once they are built.
      if (id === "./book_props.js" && file.includes("/src/"))
        return join(import.meta.dirname, "src/frameworks/book_props.ts");
      // A server's component has servers' components in it.
      const isServers = query?.startsWith("server") && id.endsWith(".svelte");
      return isServers ? `${join(dirname(file), id)}?server` : null;
    },
    async transform(code, id, options) {
      const [file, query] = id.split("?");
      if (!file.endsWith(".svelte")) return null;
      const { compile } = await import("svelte/compiler");
      const generate = options?.ssr || query?.startsWith("server") ? "server" : "client";
      return { code: compile(code, { generate, filename: file }).js.code, map: null };
    },
  };
}
