import { expect, test } from "vitest";
import { isSoftwareRenderer } from "./software_gl.ts";

const linux = "Mozilla/5.0 (X11; Linux x86_64) AppleWebKit/605.1.15 Version/60.5 Safari/605.1.15";
const mac = "Mozilla/5.0 (Macintosh; Intel Mac OS X 10_15_7) AppleWebKit/605.1.15 Safari/605.1.15";

test("the processor draws with llvmpipe and SwiftShader, and maybe where WebKit on Linux hides the name", () => {
  expect(isSoftwareRenderer("llvmpipe, or similar", linux)).toBe(true);
  expect(
    isSoftwareRenderer("ANGLE (Mesa, llvmpipe (LLVM 15.0.6 256 bits), OpenGL 4.5)", linux),
  ).toBe(true);
  const swiftshader =
    "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) (0x0000C0DE)), SwiftShader driver)";
  expect(isSoftwareRenderer(swiftshader, linux)).toBe(true);
  expect(isSoftwareRenderer("ANGLE (Microsoft, Microsoft Basic Render Driver, D3D11)", mac)).toBe(
    true,
  );
  expect(isSoftwareRenderer("Apple GPU", linux)).toBe(true);
  expect(isSoftwareRenderer("Apple GPU", mac)).toBe(false);
  expect(isSoftwareRenderer("ANGLE (Intel, Mesa Intel(R) UHD Graphics 620, OpenGL)", linux)).toBe(
    false,
  );
});
