// SPDX-License-Identifier: MIT
// What is asked about, and drawn: a scene, and bodies that come and go in it.
import {Bodies} from './bodies.js';

export class AskedScenes {
  scene;
  bodies;  // if there are any: they are asked and drawn like a scene
  #library;
  #picture;

  constructor(library, picture) {
    this.#library = library;
    this.#picture = picture;
  }

  get all() {
    return [this.scene, this.bodies].filter(Boolean);
  }

  /** The number of bounds. */
  get length() {
    return this.all.reduce((sum, {length}) => sum + length, 0);
  }

  /** Shows another scene, without bodies, and frees what was there. May find no memory: then all is as it was. */
  open(scene) {
    this.#picture.add(scene);
    this.#picture.placeFloor(scene);
    for (const old of this.all) this.#remove(old);
    this.scene = scene;
    this.bodies = undefined;
  }

  /** Lets bodies in, or removes them. */
  switchBodies(wanted) {
    if (wanted) {
      const bodies = new Bodies(this.#library);
      this.#picture.add(bodies);
      this.bodies = bodies;
    } else {
      this.#remove(this.bodies);
      this.bodies = undefined;
    }
  }

  /** Makes the changes of a frame. */
  changeBodies() {
    this.bodies.change();
    this.#picture.move(this.bodies);
  }

  #remove(scene) {
    this.#picture.remove(scene);
    scene.free();
  }
}
