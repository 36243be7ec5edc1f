/** Whether WebGL draws on the processor, where every pixel and every sample of one costs much. */

/** The placeholder that browsers report for a masked renderer name. */
const masked = "WebKit WebGL";

/** What is known of contexts, as asking may wait for the process that draws. */
const known = new WeakMap<WebGLRenderingContext | WebGL2RenderingContext, boolean>();

/**
 * Returns whether a renderer is a software rasteriser: Chromium's SwiftShader, Mesa's llvmpipe and
 * softpipe, or Windows's. Anisotropic filtering costs them most: llvmpipe's time grows with the square
 * of a footprint's length, and a frame with leaves seen edge-on takes it minutes. WebKit masks the
 * name; on Linux it may be llvmpipe.
 */
export function isSoftwareRenderer(renderer: string, userAgent: string): boolean {
  return (
    /swiftshader|llvmpipe|softpipe|microsoft basic render/i.test(renderer) ||
    (renderer === "Apple GPU" && /\bLinux\b/.test(userAgent))
  );
}

/** Returns whether a context draws on the processor. */
export function drawsInSoftware(gl: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  let isSoftware = known.get(gl);
  if (isSoftware === undefined) {
    isSoftware = isSoftwareRenderer(rendererName(gl), navigator.userAgent);
    known.set(gl, isSoftware);
  }
  return isSoftware;
}

function rendererName(gl: WebGLRenderingContext | WebGL2RenderingContext): string {
  const name = String(gl.getParameter(gl.RENDERER));
  if (name !== masked) return name;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  return info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : name;
}
