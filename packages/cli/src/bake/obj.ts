/** A turn as OBJ files, one per frame, for programs that read nothing else. */

import { basename } from "node:path";
import type { BakedMesh } from "./baked_mesh.ts";
import type { Frame } from "./baked_turn.ts";

/** A file to be written: its name's suffix after that of the turn, and its text. */
export interface NamedText {
  readonly ending: string;
  readonly text: string;
}

/** Returns one OBJ per frame and the materials of them all; y is up, lengths are metres. */
export function* writeObj(
  name: string,
  mesh: BakedMesh,
  frames: readonly Frame[],
  pictures: { readonly front: string | undefined; readonly back: string | undefined },
): Generator<NamedText> {
  yield { ending: ".mtl", text: materials(pictures) };
  const faces = facesOf(mesh);
  for (const [at, { positions }] of frames.entries()) {
    const normals = mesh.normals(positions);
    const lines = [
      `# Turnleaf, frame ${at + 1} of ${frames.length}`,
      `mtllib ${basename(name)}.mtl`,
      ...vectors("v", positions, 1),
      ...picturePlaces(mesh),
      ...vectors("vn", normals, 1),
      ...vectors("vn", normals, -1),
      ...faces,
    ];
    yield { ending: `_${String(at + 1).padStart(4, "0")}.obj`, text: `${lines.join("\n")}\n` };
  }
}

function vectors(kind: string, values: Float32Array, sign: 1 | -1): string[] {
  const lines: string[] = [];
  for (let i = 0; i < values.length; i += 3) {
    const [x, y, z] = [values[i] ?? 0, values[i + 1] ?? 0, values[i + 2] ?? 0];
    lines.push([kind, ...[x, z, -y].map((value) => short(sign * value))].join(" "));
  }
  return lines;
}

/**
 * Returns the texture coordinates of the recto, then those of the verso, whose
 * spine is at its right.
 */
function picturePlaces({ places }: BakedMesh): string[] {
  const side = (isVerso: boolean) =>
    Array.from({ length: places.length / 2 }, (_, vertex) => {
      const [x = 0, y = 0] = places.subarray(2 * vertex, 2 * vertex + 2);
      return `vt ${short(isVerso ? 1 - x : x)} ${short(y)}`;
    });
  return [...side(false), ...side(true)];
}

/** Returns faces over the points, with the texture coordinates and normals of their vertices. */
function facesOf({ points, faces }: BakedMesh): string[] {
  const side = (isVerso: boolean): string[] => {
    const corner = (vertex: number) => {
      const own = vertex + 1 + (isVerso ? points.length : 0);
      return `${(points[vertex] ?? 0) + 1}/${own}/${own}`;
    };
    const lines = [`usemtl ${isVerso ? "verso" : "recto"}`];
    for (const face of faces) {
      lines.push(`f ${(isVerso ? [...face].reverse() : face).map(corner).join(" ")}`);
    }
    return lines;
  };
  return [...side(false), ...side(true)];
}

function materials({
  front,
  back,
}: {
  front: string | undefined;
  back: string | undefined;
}): string {
  const side = (name: string, picture: string | undefined) => [
    `newmtl ${name}`,
    "Kd 0.94 0.92 0.87",
    ...(picture === undefined ? [] : [`map_Kd ${picture}`]),
  ];
  return `${[...side("recto", front), ...side("verso", back)].join("\n")}\n`;
}

function short(value: number): string {
  return String(Math.round(value * 1e6) / 1e6 || 0);
}
