/**
 * Takes comments and indentation out of shaders, which are text that no minifier shortens: of every
 * template after a comment "glsl". Lines stay where they are, so that maps are right.
 */
export function slimShaders() {
  return {
    name: "turnleaf-slim-shaders",
    transform(code, id) {
      if (!/\/src\/.*\.ts\b/.test(id) || !code.includes("/* glsl */ `")) return null;
      const slim = code.replace(/\/\* glsl \*\/ `[^`]*`/g, (shader) =>
        shader.replace(/^[ \t]+/gm, "").replace(/(^|[ \t]+)\/\/.*$/gm, ""),
      );
      return { code: slim, map: null };
    },
  };
}
