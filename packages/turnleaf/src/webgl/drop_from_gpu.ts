/** What three.js keeps of a graphics card whose context was lost. */

import { type IUniform, type Material, Mesh, type Object3D, Texture } from "three";

/**
 * Lets three.js forget what everything in a scene has on the card; all of it is sent there again
 * when it is drawn next. To be called while the context is lost: what three.js still kept would be
 * deleted some day on the context that came back, to which it does not belong.
 */
export function dropFromCard(scene: Object3D): void {
  scene.traverse((object) => {
    // Textures that an object shows by turns, and binds one at a time.
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
