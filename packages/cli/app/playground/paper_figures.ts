/**
 * Energies and strains of points as if they were paper's: the same as
 * `LooseLeaf.measure` returns for nodes.
 */

import type { LeafFigures, LeafNodes, LeafStock } from "turnleaf/models";

/** Poisson's ratio of the engine's papers. */
const poisson = 0.29;

/** The leaf of the points. */
export interface PaperLeaf {
  readonly width: number;
  readonly height: number;
  readonly stock: LeafStock;
  /** m/s². */
  readonly gravity: number;
}

/**
 * Returns the energies of a leaf of paper with these points and velocities, and
 * the strains between neighbours.
 */
export function paperFigures(
  { width, height, stock, gravity }: PaperLeaf,
  points: LeafNodes,
): LeafFigures {
  const { columns, rows, positions, velocities } = points;
  const [du, dv] = [width / (columns - 1), height / (rows - 1)];
  const [d11, d22] = [stock.stiffnessAcross, stock.stiffnessAlong];
  const mean = Math.sqrt(d11 * d22);
  const [d12, d66] = [poisson * mean, ((1 - poisson) * mean) / 2];
  let [kinetic, bending, potential, stretch, compression] = [0, 0, 0, 0, 0];
  const strain = (at: number, other: number, rest: number): void => {
    const way = [0, 1, 2].map((axis) => positions[other + axis] - positions[at + axis]);
    const change = Math.hypot(...way) / rest - 1;
    stretch = Math.max(stretch, change);
    compression = Math.min(compression, change);
  };
  const up = 3 * columns;
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const at = 3 * (row * columns + column);
      const [insideU, insideV] = [column > 0 && column + 1 < columns, row > 0 && row + 1 < rows];
      const area = du * dv * (insideU ? 1 : 0.5) * (insideV ? 1 : 0.5);
      const mass = area * stock.grammage;
      potential += mass * gravity * positions[at + 2];
      if (column + 1 < columns) strain(at, at + 3, du);
      if (row + 1 < rows) strain(at, at + up, dv);
      for (let axis = at; axis < at + 3; axis++) {
        kinetic += 0.5 * mass * velocities[axis] ** 2;
        const second = (step: number, cell: number) =>
          (positions[axis + step] - 2 * positions[axis] + positions[axis - step]) / cell ** 2;
        const uu = insideU ? second(3, du) : 0;
        const vv = insideV ? second(up, dv) : 0;
        const twist =
          positions[axis + up + 3] -
          positions[axis + up - 3] -
          positions[axis - up + 3] +
          positions[axis - up - 3];
        const uv = insideU && insideV ? twist / (4 * du * dv) : 0;
        bending +=
          0.5 * area * (d11 * uu * uu + d22 * vv * vv + 2 * d12 * uu * vv + 4 * d66 * uv * uv);
      }
    }
  }
  return { kinetic, bending, gravity: potential, stretch, compression };
}
