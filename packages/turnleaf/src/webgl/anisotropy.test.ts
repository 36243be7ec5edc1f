import { expect, test } from "vitest";
import { isSlowAtAngles } from "./anisotropy.ts";

const linux = "Mozilla/5.0 (X11; Linux x86_64) AppleWebKit/605.1.15 Version/60.5 Safari/605.1.15";
const mac = "Mozilla/5.0 (Macintosh; Intel Mac OS X 10_15_7) AppleWebKit/605.1.15 Safari/605.1.15";

test("textures are not filtered at angles by llvmpipe, nor by a card that WebKit on Linux hides", () => {
  expect(isSlowAtAngles("llvmpipe, or similar", linux)).toBe(true);
  expect(isSlowAtAngles("ANGLE (Mesa, llvmpipe (LLVM 15.0.6 256 bits), OpenGL 4.5)", linux)).toBe(
    true,
  );
  expect(isSlowAtAngles("Apple GPU", linux)).toBe(true);
  expect(isSlowAtAngles("Apple GPU", mac)).toBe(false);
  expect(isSlowAtAngles("ANGLE (Intel, Mesa Intel(R) UHD Graphics 620, OpenGL)", linux)).toBe(
    false,
  );
});
