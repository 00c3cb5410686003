// SPDX-License-Identifier: MIT
// A scene: bounds of one shape, as the library holds them under a tree and flat.
import {aroundSpheres, boxesAround} from './boxes.js';

/** What a scene is made of: shape 'boxes' (6 floats each), 'spheres' (4) or 'triangles' (9). */
export class Scene {
  /** Throws the library's error if the floats are no bounds; then nothing is held. */
  constructor(library, name, shape, floats) {
    this.name = name;
    this.shape = shape;
    this.floats = floats;
    this.held = [];
    const hold = (object) => {
      this.held.push(object);
      return object;
    };
    try {
      if (shape === 'triangles') {
        this.triangles = {tree: hold(library.triangleTree(floats)), flat: hold(library.triangleStream(floats))};
      }
      const boxes = shape === 'triangles' ? boxesAround(floats) : floats;
      this.bounds = shape === 'spheres'
        ? {tree: hold(library.sphereTree(boxes)), flat: hold(library.sphereStream(boxes))}
        : {tree: hold(library.boxTree(boxes)), flat: hold(library.boxStream(boxes))};
      this.around = shape === 'spheres' ? aroundSpheres(floats) : library.boxAround(boxes);  // of the corners of all
    } catch (error) {
      this.free();
      throw error;
    }
  }

  get length() {
    return this.bounds.tree.length;
  }

  /** The length of the diagonal of the box around it. */
  get extent() {
    return Math.hypot(...[0, 1, 2].map((k) => this.around[k + 3] - this.around[k]));
  }

  /** Floats of bound i: a box, a sphere or a triangle. */
  bound(i) {
    const size = this.floats.length / this.length;
    return this.floats.subarray(i * size, (i + 1) * size);
  }

  free() {
    for (const object of this.held) object.free();
  }
}
