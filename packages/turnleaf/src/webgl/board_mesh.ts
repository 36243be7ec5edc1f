/** A cover board: a rigid plate with rounded corners and bevels, cloth or picture outside, pastedown inside. */

import { type BufferGeometry, Group, Mesh, Vector3 } from "three";
import type { Vec3 } from "../engine/shapes.ts";
import { caseSizes } from "../stage/case_sizes.ts";
import type { CaseShape } from "./case_shape.ts";
import type { LeafSection } from "./leaf_section.ts";
import {
  compassToRadians,
  keyFraction,
  type LightFractions,
  leftEndUnder,
  lightBetween,
  skyFraction,
} from "./light.ts";
import type { Overhead } from "./page_mesh.ts";
import { pageRows } from "./page_mesh.ts";
import type { PileShape } from "./pile_shape.ts";
import { SolidGeometry } from "./solid_geometry.ts";
import type { SolidMaterial } from "./solid_material.ts";

/** Period of the cloth's threads, metres. */
export const clothRepeat = 0.06;

/** Points around each corner of a board. */
const cornerPoints = 5;
const innerColumns = 25;

/** The front or the back board. Local x runs from the hinge outward, z out of the inner face. */
export class BoardMesh {
  readonly group: Group = new Group();
  readonly #outside: Mesh<BufferGeometry, SolidMaterial>;
  readonly #inside: Mesh<BufferGeometry, SolidMaterial>;
  readonly #inner: SolidGeometry;
  readonly #front: boolean;
  readonly #width: number;
  readonly #height: number;
  readonly #light: LightFractions = { left: 0, right: 0, sky: 1, key: 1 };

  /** @param pageWidth,pageHeight metres */
  constructor(
    front: boolean,
    pageWidth: number,
    pageHeight: number,
    outside: SolidMaterial,
    inside: SolidMaterial,
  ) {
    const { rim, joint } = caseSizes;
    this.#front = front;
    this.#width = pageWidth + rim - joint;
    this.#height = pageHeight;
    this.#inner = this.#innerFace();
    this.#outside = new Mesh(this.#shell().geometry, outside);
    this.#inside = new Mesh(this.#inner.geometry, inside);
    // The pastedown leaves a border of turned-in cloth, except at the hinge.
    const [edge, end] = [(1.1 * rim) / this.#width, (1.1 * rim) / (pageHeight + 2 * rim)];
    inside.panel = front ? [edge, end, 1.001, 1 - end] : [-0.001, end, 1 - edge, 1 - end];
    for (const mesh of [this.#outside, this.#inside]) {
      mesh.frustumCulled = false;
      this.group.add(mesh);
    }
  }

  /** Puts the hinge at x, z and the board at `angle` from lying on the right, radians. */
  place(hinge: readonly [number, number], angle: number): void {
    const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
    // The front board's inner face looks down at angle 0, the back board's up:
    // the front is the back's mirror image, and three.js turns its triangles round.
    const out = this.#front ? -1 : 1;
    this.group.matrixAutoUpdate = false;
    // biome-ignore format: a matrix reads row by row
    this.group.matrix.set(
      cos, 0, -sin * out, hinge[0],
      0, 1, 0, 0,
      sin, 0, cos * out, hinge[1],
      0, 0, 0, 1,
    );
    this.group.matrixWorldNeedsUpdate = true;
  }

  /**
   * Returns a place on the picture of the outer or the inner face, in fractions
   * from its upper left corner, in book space.
   */
  placeOn(outer: boolean, x: number, y: number): Vec3 {
    const { rim, board } = caseSizes;
    const [left, top, right, bottom] = (outer ? this.#outside : this.#inside).material.panel;
    const u = left + (right - left) * x;
    const v = top + (bottom - top) * y;
    // The inverse of the faces' texture coordinates.
    const across = this.#width * (outer === this.#front ? u : 1 - u);
    const along = (1 - v) * (this.#height + 2 * rim) - rim;
    const place = new Vector3(across, along, outer ? -board : 0);
    return place.applyMatrix4(this.group.matrix).toArray();
  }

  /** Computes the light on the inner face between the two piles, and under the leaf in flight. */
  light(shape: CaseShape, left: PileShape, right: PileShape, over: Overhead): void {
    const front = this.#front;
    const [hinge, angle] = front
      ? [shape.frontHinge, shape.frontAngle]
      : [shape.backHinge, shape.backAngle];
    const [lidHinge, lidAngle] = front
      ? [shape.backHinge, shape.backAngle]
      : [shape.frontHinge, shape.frontAngle];
    const lid: [number, number, number] = [
      lidHinge[0] + this.#width * Math.cos(lidAngle),
      lidHinge[1] + this.#width * Math.sin(lidAngle),
      front ? -1 : 1,
    ];
    const lidOpen = 1 - (front ? shape.closedLeft : shape.closedRight);
    const normal = front ? Math.PI - angle : -angle;
    const block = front ? left : right;
    const edge = block.present ? Math.abs(block.curves[block.curves.length - 2]) : 0;
    const solid = this.#inner;
    const rows = solid.positions.length / 3 / innerColumns;
    for (let i = 0; i < innerColumns; i++) {
      const local = solid.positions[3 * i];
      const x = hinge[0] + local * Math.cos(angle);
      const z = hinge[1] + local * Math.sin(angle);
      const piles = [left.obstacles, right.obstacles];
      lightBetween(x, z, normal, piles, lid, this.#light);
      // Points under the pile are dark; points beside it see past its edge.
      const covered = block.present && Math.abs(x) < edge;
      const { sky: openSky, key: openKey } = this.#light;
      for (let row = 0; row < rows; row++) {
        const point = row * innerColumns + i;
        const beyond = (row === 0 || row === rows - 1) && block.present;
        let [sky, key] = [openSky, openKey];
        const section = Math.min(over.sky.rows - 1, Math.max(0, row - 1));
        if (over.sky.counts[section] > 0 && !block.present) {
          [sky, key] = this.#under(over, section, x, z, normal);
          // No leaf lies over the rims at head and foot.
          if (row === 0 || row === rows - 1) [sky, key] = [Math.max(sky, 0.55), openKey];
        }
        if (covered) [sky, key] = [0, 0];
        if (beyond) {
          // The key light comes from the head, and is therefore blocked before the foot.
          sky = Math.max(sky, 0.55 * lidOpen);
          key = row === 0 ? 0.1 : lidOpen;
        }
        solid.open[2 * point] = sky;
        solid.open[2 * point + 1] = key;
      }
    }
    solid.touch("open");
  }

  /** Returns the fractions of sky and key light under the leaf in one of its sections. */
  #under(over: Overhead, row: number, x: number, z: number, normal: number): [number, number] {
    const sign = this.#front ? -1 : 1;
    const { left, right } = this.#light;
    const fraction = (section: LeafSection, of: (from: number, to: number) => number): number => {
      const end = leftEndUnder(sign * x, z, section.row(row), section.counts[row]);
      const shut = sign * compassToRadians(end);
      return sign === 1 ? of(Math.max(left, shut), right) : of(left, Math.min(right, shut));
    };
    const sky = fraction(over.sky, (from, to) => skyFraction(from, to, normal));
    let key = 0;
    for (const section of over.keys) key += fraction(section, keyFraction) / over.keys.length;
    return [sky, key];
  }

  dispose(): void {
    this.#outside.geometry.dispose();
    this.#inside.geometry.dispose();
  }

  /** Returns the rows of a page, and one beyond it at either end. */
  #rowPlaces(): number[] {
    const { rim, bevel } = caseSizes;
    const rows = Array.from({ length: pageRows }, (_, k) => (this.#height * k) / (pageRows - 1));
    return [bevel - rim, ...rows, this.#height + rim - bevel];
  }

  /** Writes texture and grain coordinates of a point of the board. */
  #dress(solid: SolidGeometry, point: number, x: number, y: number, outer: boolean): void {
    const { rim } = caseSizes;
    const u = x / this.#width;
    // The front's outside and the back's inside have the hinge on their left.
    solid.uv[2 * point] = outer === this.#front ? u : 1 - u;
    solid.uv[2 * point + 1] = 1 - (y + rim) / (this.#height + 2 * rim);
    solid.grainAt[2 * point] = x / clothRepeat;
    solid.grainAt[2 * point + 1] = y / clothRepeat;
  }

  #innerFace(): SolidGeometry {
    const rows = this.#rowPlaces();
    const solid = new SolidGeometry(
      innerColumns * rows.length,
      2 * (innerColumns - 1) * (rows.length - 1),
    );
    const { rim, bevel } = caseSizes;
    solid.reserve(innerColumns * rows.length);
    rows.forEach((y, row) => {
      for (let i = 0; i < innerColumns; i++) {
        // The last columns lie in the rim, where the pile's shadow is.
        const inner = innerColumns - 8;
        const page = this.#width - rim;
        const x =
          i < inner
            ? (page * i) / (inner - 1)
            : page + ((rim - bevel) * (i - inner + 1)) / (innerColumns - inner);
        const point = row * innerColumns + i;
        solid.place(point, x, y, 0);
        solid.face(point, 0, 0, 1);
        this.#dress(solid, point, x, y, false);
      }
    });
    solid.grid(0, innerColumns, rows.length);
    return solid;
  }

  /** Builds the outer face, sides and bevels. */
  #shell(): SolidGeometry {
    const { board, bevel } = caseSizes;
    const around = 4 * cornerPoints;
    const solid = new SolidGeometry(around * 6 + around, 2 * around * 3 + around);
    // From the inner face's border over the side to the outer face's.
    const rings: [inset: number, z: number, nz: number][] = [
      [bevel, 0, 0.7],
      [0, -bevel, 0.7],
      [0, -bevel, 0],
      [0, bevel - board, 0],
      [0, bevel - board, -0.7],
      [bevel, -board, -0.7],
    ];
    const ring = rings.map(([inset, z, nz]) => this.#ring(solid, inset, z, nz));
    for (const k of [0, 2, 4]) {
      for (let i = 0; i < around; i++) {
        // The cloth hinge covers the wall by the hinge.
        if (k < 4 && i === 2 * cornerPoints - 1) continue;
        const j = (i + 1) % around;
        const [a, b, c, d] = [ring[k] + i, ring[k] + j, ring[k + 1] + j, ring[k + 1] + i];
        solid.square(a, d, c, b);
      }
    }
    const face = this.#ring(solid, bevel, -board, -1);
    for (let i = 1; i + 1 < around; i++) {
      solid.triangle(face, face + i + 1, face + i);
    }
    return solid;
  }

  /** Adds a rounded rectangle of points, anticlockwise as seen from the inner face. */
  #ring(solid: SolidGeometry, inset: number, z: number, nz: number): number {
    const { rim, corner } = caseSizes;
    const first = solid.reserve(4 * cornerPoints);
    const radius = Math.max(corner - inset, 1e-5);
    const [x0, x1] = [inset + radius, this.#width - inset - radius];
    const [y0, y1] = [-rim + inset + radius, this.#height + rim - inset - radius];
    const centres = [
      [x1, y1],
      [x0, y1],
      [x0, y0],
      [x1, y0],
    ];
    const flat = Math.sqrt(Math.max(0, 1 - nz * nz));
    for (let k = 0; k < 4 * cornerPoints; k++) {
      const turn = Math.floor(k / cornerPoints);
      const angle = (turn + (k % cornerPoints) / (cornerPoints - 1)) * (Math.PI / 2);
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
      const [x, y] = [centres[turn][0] + radius * cos, centres[turn][1] + radius * sin];
      solid.place(first + k, x, y, z);
      solid.face(first + k, flat * cos, flat * sin, nz);
      this.#dress(solid, first + k, x, y, true);
    }
    return first;
  }
}
