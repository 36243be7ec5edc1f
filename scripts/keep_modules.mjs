/**
 * A plugin of vitest: has the browser keep the modules that the server sends. Every file of tests loads
 * the viewer anew, and asking whether each module has changed takes longer than loading it. While tests
 * are run anew as files change (`vitest --watch`), they are asked for as vite has it.
 *
 * @returns {import("vite").Plugin}
 */
export function keepModules() {
  let isKept = false;
  return {
    name: "turnleaf-keep-modules",
    configureVitest({ vitest }) {
      isKept = !vitest.config.watch;
    },
    configureServer(server) {
      server.middlewares.use((_, response, next) => {
        const { setHeader } = response;
        response.setHeader = (name, value) =>
          setHeader.call(response, name, isKept && isRevalidation(name, value) ? kept : value);
        next();
      });
    },
  };
}

const kept = "max-age=31536000,immutable";

/** Whether a header of vite has the browser ask for a module again. */
const isRevalidation = (name, value) =>
  name.toLowerCase() === "cache-control" && value === "no-cache";
