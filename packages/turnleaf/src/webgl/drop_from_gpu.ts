/** The three.js resources of a graphics context that was lost. */

import { type IUniform, type Material, Mesh, type Object3D, Texture } from "three";

/**
 * Makes three.js forget the GPU resources of everything in a scene; all of it
 * is uploaded again when it is drawn next. Call it while the context is lost:
 * what three.js still kept would later be deleted on the restored context, to
 * which it does not belong.
 */
export function dropFromCard(scene: Object3D): void {
  scene.traverse((object) => {
    // Textures that an object shows in turn, one bound at a time.
    for (const texture of (object.userData.textures ?? []) as Texture[]) texture.dispose();
    if (!(object instanceof Mesh)) return;
    object.geometry.dispose();
    const material: Material & { uniforms?: Record<string, IUniform> } = object.material;
    for (const { value } of Object.values(material.uniforms ?? {})) {
      if (value instanceof Texture) value.dispose();
    }
    material.dispose();
  });
}
