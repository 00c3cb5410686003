// SPDX-License-Identifier: MIT
// Drags the two boxes with mouse, pen or finger: level, and with Shift up and down.
import {Plane, Raycaster, Vector2, Vector3} from 'three';

const REACH = 24;  // how near to the middle of a box a pointer grabs it, in CSS pixels, however small it is drawn

export class Dragging {
  #grabbed;
  #raycaster = new Raycaster();

  /**
   * `boxes` tells and moves the boxes: middle(name), moveTo(name, place), select(name). Listens before the controls of
   * the eye do, which hear nothing of a pointer that drags a box.
   */
  constructor(canvas, picture, boxes) {
    Object.assign(this, {canvas, picture, boxes, enabled: true});
    canvas.addEventListener('pointerdown', (event) => this.#grab(event), {capture: true});
    canvas.addEventListener('pointermove', (event) => this.#drag(event), {capture: true});
    for (const end of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(end, (event) => this.#drop(event), {capture: true});
    }
  }

  #grab(event) {
    if (this.#grabbed) event.stopImmediatePropagation();  // a second finger does not turn the view meanwhile
    if (!this.enabled || this.#grabbed || event.button !== 0) return;
    const name = this.#under(event);
    if (!name) return;
    event.stopImmediatePropagation();
    this.canvas.focus();
    this.canvas.setPointerCapture(event.pointerId);
    this.boxes.select(name);
    const from = new Vector3(...this.boxes.middle(name));
    this.#grabbed = {name, pointer: event.pointerId, from, vertical: event.shiftKey};
    this.#grabbed.start = this.#onPlane(event);
  }

  #drag(event) {
    if (this.#grabbed?.pointer !== event.pointerId) {
      if (this.enabled) this.canvas.style.cursor = this.#under(event) ? 'grab' : '';
      return;
    }
    event.stopImmediatePropagation();
    const here = this.#onPlane(event);
    const {name, from, start, vertical} = this.#grabbed;
    if (!here || !start) return;
    const moved = here.sub(start);
    if (vertical) moved.set(0, moved.y, 0);
    this.boxes.moveTo(name, from.clone().add(moved).toArray());
  }

  #drop(event) {
    if (this.#grabbed?.pointer !== event.pointerId) return;
    event.stopImmediatePropagation();
    this.#grabbed = undefined;
  }

  /** The name of the box under a pointer, if there is one. */
  #under(event) {
    this.#aim(event);
    const {handles} = this.picture;
    const hits = this.#raycaster.intersectObjects([handles.a, handles.b]);
    if (hits.length > 0) return hits[0].object === handles.a ? 'a' : 'b';
    return ['a', 'b'].find((name) => {
      const place = this.picture.onCanvas(this.boxes.middle(name), this.canvas);
      return place && Math.hypot(place.x - event.offsetX, place.y - event.offsetY) < REACH;
    });
  }

  /** Where a pointer meets the plane in which the grabbed box moves. */
  #onPlane(event) {
    this.#aim(event);
    const {from, vertical} = this.#grabbed;
    const towards = this.picture.eye.getWorldDirection(new Vector3());
    const normal = vertical ? towards.setY(0).normalize() : new Vector3(0, 1, 0);
    const plane = new Plane().setFromNormalAndCoplanarPoint(normal, from);
    return this.#raycaster.ray.intersectPlane(plane, new Vector3());
  }

  #aim(event) {
    const x = (event.offsetX / this.canvas.clientWidth) * 2 - 1;
    const y = 1 - (event.offsetY / this.canvas.clientHeight) * 2;
    this.#raycaster.setFromCamera(new Vector2(x, y), this.picture.eye);
  }
}
