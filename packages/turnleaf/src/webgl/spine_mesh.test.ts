import { expect, test } from "vitest";
import { caseSizes } from "../stage/case_sizes.ts";
import { placeCase, restingCase } from "./case_shape.ts";
import type { SolidMaterial } from "./solid_material.ts";
import { SpineMesh } from "./spine_mesh.ts";

const steps = 41;

/** Returns x and z of the strip's outer line from the back board to the front board. */
function outerLine(thickness: number, front: number): [x: number, z: number][] {
  const shape = restingCase();
  placeCase(shape, thickness, 0, front, 0, caseSizes.joint);
  const strip = new SpineMesh(null as unknown as SolidMaterial, 0.2, thickness);
  strip.shape(shape);
  const at = strip.mesh.geometry.getAttribute("position");
  return Array.from({ length: steps }, (_, i) => [at.getX(i), at.getZ(i)]);
}

test.each([0.0004, 0.001, 0.003, 0.012, 0.04])(
  "under an open book %d m thick the cloth runs from board to board and stays below the leaves",
  (thickness) => {
    const line = outerLine(thickness, Math.PI);
    for (const [i, [x, z]] of line.entries()) {
      expect(z).toBeLessThan(-caseSizes.sink);
      if (i > 0) expect(x).toBeLessThan(line[i - 1][0]);
    }
  },
);
