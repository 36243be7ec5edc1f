/** The cloth over the spine and the two hinges, and the headbands at the spine's ends. */

import { type BufferGeometry, Mesh } from "three";
import { caseSizes } from "../stage/case_sizes.ts";
import { clothRepeat } from "./board_mesh.ts";
import type { CaseShape } from "./case_shape.ts";
import { SolidGeometry } from "./solid_geometry.ts";
import type { SolidMaterial } from "./solid_material.ts";

/** Points along the strip from the back board to the front board. */
const steps = 41;
const bandSteps = 41;

/** x, z in the plane across the spine, metres. */
type Place = readonly [number, number];

/** Spine and hinges, one strip of cloth with a thickness. */
export class SpineMesh {
  readonly mesh: Mesh<BufferGeometry, SolidMaterial>;
  readonly #solid: SolidGeometry;
  readonly #height: number;
  readonly #thickness: number;
  readonly #outer = new Float32Array(2 * steps);
  readonly #inner = new Float32Array(2 * steps);
  readonly #normal = new Float32Array(2 * steps);

  /** @param thickness of all leaves, metres */
  constructor(material: SolidMaterial, height: number, thickness: number) {
    this.#height = height;
    this.#thickness = thickness;
    // Outer and inner face, and a cap at the foot and at the head.
    this.#solid = new SolidGeometry(8 * steps, 8 * (steps - 1));
    for (let part = 0; part < 4; part++) {
      const first = this.#solid.reserve(2 * steps);
      this.#solid.grid(first, steps, 2, part === 1 || part === 3);
    }
    this.mesh = new Mesh(this.#solid.geometry, material);
    this.mesh.frustumCulled = false;
  }

  /** Follows the case. */
  shape(shape: CaseShape): void {
    this.#section(shape);
    const { rim } = caseSizes;
    const solid = this.#solid;
    const ends = [-rim, this.#height + rim];
    for (let i = 0; i < steps; i++) {
      const [nx, nz] = [this.#normal[2 * i], this.#normal[2 * i + 1]];
      for (const end of [0, 1]) {
        const outer = end * steps + i;
        const inner = 2 * steps + outer;
        solid.place(outer, this.#outer[2 * i], ends[end], this.#outer[2 * i + 1]);
        solid.face(outer, nx, 0, nz);
        solid.place(inner, this.#inner[2 * i], ends[end], this.#inner[2 * i + 1]);
        solid.face(inner, -nx, 0, -nz);
        // The inside lies under the leaves, and is dark there.
        solid.open[2 * inner] = 0.4;
        solid.open[2 * inner + 1] = 0.25;
        for (const point of [outer, inner]) this.#weave(point, i, ends[end]);
        const cap = (4 + 2 * end) * steps + i;
        solid.place(cap, this.#outer[2 * i], ends[end], this.#outer[2 * i + 1]);
        solid.place(cap + steps, this.#inner[2 * i], ends[end], this.#inner[2 * i + 1]);
        for (const point of [cap, cap + steps]) {
          solid.face(point, 0, 2 * end - 1, 0);
          this.#weave(point, i, ends[end]);
        }
      }
    }
    solid.touch("position", "normal", "grainAt", "open");
  }

  dispose(): void {
    this.mesh.geometry.dispose();
  }

  #weave(point: number, step: number, y: number): void {
    const length = this.#thickness + 2 * caseSizes.joint;
    this.#solid.grainAt[2 * point] = ((step / (steps - 1)) * length) / clothRepeat;
    this.#solid.grainAt[2 * point + 1] = y / clothRepeat;
  }

  /** Computes the strip's outer and inner line in the plane across the spine. */
  #section(shape: CaseShape): void {
    const { backHinge: a, c, d, frontHinge: b } = shape;
    const span = Math.hypot(d[0] - c[0], d[1] - c[1]);
    // A corner is rounded over a fraction of the spine, and all of its hinge.
    const fraction = span > 0 ? Math.min(0.35, 0.007 / span) : 0;
    const mid = (t: number, k: 0 | 1): number => c[k] + (d[k] - c[k]) * t;
    const bent = Math.abs(Math.sin(0.5 * Math.PI * (shape.closedLeft - shape.closedRight)));
    const bulge = bent * Math.min(0.0035, 0.22 * this.#thickness);
    const hinge = 12;
    for (let i = 0; i < steps; i++) {
      let [x, z, dx, dz, out, groove] = [0, 0, 0, 0, 0, 0];
      if (i <= hinge || i >= steps - 1 - hinge) {
        const back = i <= hinge;
        const t = back ? i / hinge : (steps - 1 - i) / hinge;
        const [start, corner] = back ? [a, c] : [b, d];
        const inward = back ? fraction : 1 - fraction;
        const end: Place = [mid(inward, 0), mid(inward, 1)];
        // Begins within the board, so that no gap shows.
        const reach = 1.25;
        const outward = (k: 0 | 1): number => corner[k] + (start[k] - corner[k]) * reach;
        const from: Place = [outward(0), outward(1)];
        const pull = pullAround(from, corner, end);
        const [p, q, r] = [(1 - t) * (1 - t), 2 * t * (1 - t), t * t];
        x = p * from[0] + q * pull[0] + r * end[0];
        z = p * from[1] + q * pull[1] + r * end[1];
        const way = back ? 1 : -1;
        dx = way * ((1 - t) * (pull[0] - from[0]) + t * (end[0] - pull[0]));
        dz = way * ((1 - t) * (pull[1] - from[1]) + t * (end[1] - pull[1]));
        // The groove between board and spine.
        groove = Math.sin(Math.PI * Math.min(1, Math.max(0, (t - 0.1) / 0.7))) ** 2;
        out = 0.0024 - 0.0016 * groove;
      } else {
        const t = fraction + ((i - hinge) / (steps - 1 - 2 * hinge)) * (1 - 2 * fraction);
        x = mid(t, 0);
        z = mid(t, 1);
        dx = d[0] - c[0];
        dz = d[1] - c[1];
        const along = (t - fraction) / (1 - 2 * fraction || 1);
        out = 0.0024 + bulge * 4 * along * (1 - along);
      }
      const length = Math.hypot(dx, dz);
      const [nx, nz] = length > 1e-9 ? [-dz / length, dx / length] : [0, -1];
      this.#solid.open[2 * i] = this.#solid.open[2 * (steps + i)] = 1 - 0.55 * groove;
      this.#outer[2 * i] = x + nx * out;
      this.#outer[2 * i + 1] = z + nz * out;
      const within = Math.max(0.0004, out - 0.0009);
      this.#inner[2 * i] = x + nx * within;
      this.#inner[2 * i + 1] = z + nz * within;
    }
    for (let i = 0; i < steps; i++) {
      const [before, after] = [2 * Math.max(0, i - 1), 2 * Math.min(steps - 1, i + 1)];
      const dx = this.#outer[after] - this.#outer[before];
      const dz = this.#outer[after + 1] - this.#outer[before + 1];
      const length = Math.hypot(dx, dz) || 1;
      this.#normal[2 * i] = -dz / length;
      this.#normal[2 * i + 1] = dx / length;
    }
  }
}

/**
 * Returns the control point that rounds a corner half as much as a curve toward
 * it would. Only the shorter arm counts: the spine of a thin book is shorter
 * than its hinge, and with the hinge's length the strip would run past the
 * other corner and back, turned inside out, and stand up through the gutter.
 */
function pullAround(from: Place, corner: Place, end: Place): Place {
  const arms = [from, end].map(([x, z]) => [x - corner[0], z - corner[1]]);
  const lengths = arms.map(([x, z]) => Math.hypot(x, z) || 1);
  const shorter = Math.min(...lengths);
  const along = (k: 0 | 1): number =>
    corner[k] - 0.25 * shorter * (arms[0][k] / lengths[0] + arms[1][k] / lengths[1]);
  return [along(0), along(1)];
}

/** The two headbands: short striped rolls where the leaves' spine meets head and foot. */
export class HeadbandMesh {
  readonly mesh: Mesh<BufferGeometry, SolidMaterial>;
  readonly #solid: SolidGeometry;
  readonly #height: number;
  static readonly #around = 7;

  constructor(material: SolidMaterial, height: number) {
    this.#height = height;
    const around = HeadbandMesh.#around;
    this.#solid = new SolidGeometry(2 * around * bandSteps, 4 * (around - 1) * (bandSteps - 1));
    for (const end of [0, 1]) {
      const first = this.#solid.reserve(around * bandSteps);
      this.#solid.grid(first, bandSteps, around, end === 0);
    }
    this.mesh = new Mesh(this.#solid.geometry, material);
    this.mesh.frustumCulled = false;
  }

  /** Follows the case: along the middle of the spine, just inside its cloth. */
  shape(shape: CaseShape): void {
    const { c, d } = shape;
    const span = Math.hypot(d[0] - c[0], d[1] - c[1]) || 1e-6;
    const around = HeadbandMesh.#around;
    const solid = this.#solid;
    const [dx, dz] = [(d[0] - c[0]) / span, (d[1] - c[1]) / span];
    const length = Math.min(0.6 * span, 0.03);
    const radius = Math.min(0.0012, 0.12 * span);
    for (let i = 0; i < bandSteps; i++) {
      const s = 0.5 * span + (i / (bandSteps - 1) - 0.5) * length;
      for (const end of [0, 1]) {
        for (let k = 0; k < around; k++) {
          const angle = (Math.PI * k) / (around - 1);
          // From the spine's cloth inward, and out beyond the leaves' ends.
          const inward = radius * (1 - Math.cos(angle));
          const beyond = 1.5 * radius * Math.sin(angle);
          const point = (end * around + k) * bandSteps + i;
          solid.place(
            point,
            c[0] + dx * s + dz * (inward - 0.001),
            end === 0 ? -beyond : this.#height + beyond,
            c[1] + dz * s - dx * (inward - 0.001),
          );
          const ny = (end === 0 ? -1 : 1) * Math.sin(angle);
          solid.face(point, -Math.cos(angle) * dz, ny, Math.cos(angle) * dx);
          solid.grainAt[2 * point] = (i / (bandSteps - 1)) * (length / 0.0016);
          solid.grainAt[2 * point + 1] = 0.5;
          solid.open[2 * point] = 0.8;
          solid.open[2 * point + 1] = 0.6;
        }
      }
    }
    solid.touch("position", "normal", "grainAt", "open");
  }

  dispose(): void {
    this.mesh.geometry.dispose();
  }
}
