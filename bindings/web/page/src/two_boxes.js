// SPDX-License-Identifier: MIT
// The boxes A and B: where they are, how large they are, and how they move.
import {middleOf} from './boxes.js';

/** Where they start in a scene of the user. */
export function startIn({around, extent}) {
  const middle = middleOf(around);
  const at = (...shares) => middle.map((value, k) => value + shares[k] * extent);
  return {a: at(-0.3, 0.1, 0.15), b: at(0.3, 0, -0.1), half: 0.04 * extent, radius: 0.5 * extent};
}

/** Each of `a` and `b` is {middle, half}: half of its side. */
export class TwoBoxes {
  #start;
  #scene;
  #wanderFrom;

  /** `start` has the middles a and b where they are first, and half of their side. They stay near the scene. */
  constructor(start, scene) {
    this.#start = {...start, half: start.half || 1};
    this.#scene = scene;
    this.restart();
  }

  /** Half of the side that they have first. */
  get half() {
    return this.#start.half;
  }

  restart() {
    for (const name of ['a', 'b']) this[name] = {middle: this.#start[name], half: this.half};
    this.#wanderFrom = undefined;
  }

  /** A ball around both: {middle, radius}. */
  get around() {
    const [a, b] = [this.a.middle, this.b.middle];
    const middle = a.map((value, k) => (value + b[k]) / 2);
    const apart = Math.hypot(...a.map((value, k) => value - b[k]));
    return {middle, radius: Math.max(this.#start.radius, 0.6 * apart, 4 * this.half)};
  }

  /** Not farther out than half the size of the scene, so that no box is lost. */
  moveTo(name, middle) {
    const {around, extent} = this.#scene;
    const reach = Math.max(extent / 2, 20 * this.half);
    const near = (value, k) => Math.min(Math.max(value, around[k] - reach), around[k + 3] + reach);
    this[name].middle = middle.map(near);
  }

  moveBy(name, shift) {
    this.moveTo(name, this[name].middle.map((value, k) => value + shift[k]));
  }

  /** Makes it so many times as large as it was first. */
  resize(name, factor) {
    this[name].half = this.half * factor;
  }

  /** How large it is, as a multiple of its first size. */
  sizeOf(name) {
    return this[name].half / this.half;
  }

  /** Moves box B on a circle through the place where it was. */
  wander(now) {
    this.#wanderFrom ??= {middle: this.b.middle, since: now};
    const angle = (now - this.#wanderFrom.since) / 2500;
    const radius = 5 * this.half;
    const [x, y, z] = this.#wanderFrom.middle;
    this.moveTo('b', [x + radius * Math.sin(angle), y, z + radius * (Math.cos(angle) - 1)]);
  }

  stopWandering() {
    this.#wanderFrom = undefined;
  }
}
