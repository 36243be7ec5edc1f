/** How far textures are filtered along the direction in which a page is seen at a low angle. */

import type { WebGLRenderer } from "three";

/** The most that is asked of a graphics card: more is not seen on a page. */
const most = 8;

/** What browsers say in place of a name that they keep to themselves. */
const masked = "WebKit WebGL";

/**
 * Mesa's rasteriser in software, llvmpipe, filters anisotropically in a time that
 * grows with the square of a footprint's length: a frame in which leaves are
 * seen edge-on takes it minutes. WebKit names no card; on Linux it may be this one.
 */
export function isSlowAtAngles(renderer: string, userAgent: string): boolean {
  return /llvmpipe/i.test(renderer) || (renderer === "Apple GPU" && /\bLinux\b/.test(userAgent));
}

/** The anisotropy that a renderer's textures get, from 1 for none. */
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
