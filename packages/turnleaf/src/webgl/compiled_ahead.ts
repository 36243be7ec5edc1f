/** Compiles what is drawn later while nothing moves. */

import { BufferAttribute, BufferGeometry, Group, type Material, Mesh } from "three";

/**
 * Returns an object of which nothing is seen, and for which the first frame that draws it compiles
 * the programs of some materials: as a page gives way there is no time for it. Drawn, and not
 * compiled alone, as graphics drivers leave much of that until a program draws.
 */
export function compiledAhead(materials: readonly Material[]): Group {
  const group = new Group();
  // A triangle of no area; programs differ by whether there are normals.
  const geometry = new BufferGeometry();
  const zeros = new BufferAttribute(new Float32Array(9), 3);
  geometry.setAttribute("position", zeros).setAttribute("normal", zeros);
  for (const material of materials) {
    const mesh = new Mesh(geometry, material);
    mesh.frustumCulled = false;
    mesh.onAfterRender = () => {
      mesh.visible = false;
      if (group.children.every(({ visible }) => !visible)) geometry.dispose();
    };
    group.add(mesh);
  }
  return group;
}
