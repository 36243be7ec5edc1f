/** The anisotropic filtering of textures, for pages seen at a low angle. */

import type { WebGLRenderer } from "three";

/** Maximum used: more makes no visible difference on a page. */
const most = 8;

/** The placeholder that browsers report for a masked renderer name. */
const masked = "WebKit WebGL";

/**
 * Returns whether anisotropic filtering is slow. Mesa's software rasteriser,
 * llvmpipe, takes a time that grows with the square of a footprint's length: a
 * frame with leaves seen edge-on takes it minutes. WebKit masks the name; on
 * Linux it may be this one.
 */
export function isSlowAtAngles(renderer: string, userAgent: string): boolean {
  return /llvmpipe/i.test(renderer) || (renderer === "Apple GPU" && /\bLinux\b/.test(userAgent));
}

/** Returns the anisotropy for a renderer's textures, from 1 for none. */
export function anisotropyOf(renderer: WebGLRenderer): number {
  const gl = renderer.getContext();
  let name = String(gl.getParameter(gl.RENDERER));
  if (name === masked) {
    const info = gl.getExtension("WEBGL_debug_renderer_info");
    if (info) name = String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
  }
  if (isSlowAtAngles(name, navigator.userAgent)) return 1;
  return Math.min(most, renderer.capabilities.getMaxAnisotropy());
}
