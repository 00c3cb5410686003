// SPDX-License-Identifier: MIT
// Large worlds: bounds in doubles, as floats relative to an origin.
import {asDoubles, asFloats} from './arguments.js';

const roundings = {boxesAround: 0, boxesWithin: 1, spheresAround: 2, nearest: 3};

/** The floats that a rounding makes of elements of `per` doubles. */
function relative(module, at, rounding, values, per, name) {
  const doubles = asDoubles(values, per, name);
  return module.scratch((scratch) => {
    const [origin, from, to] = [scratch.copy(at), scratch.copy(doubles), scratch.zeros(4 * doubles.length)];
    module.call('shaftcull_relative', origin, roundings[rounding], from, BigInt(doubles.length / per), to);
    return module.floats(to, doubles.length);
  });
}

export class Origin {
  #module;
  #at;

  constructor(module, at = [0, 0, 0]) {
    this.#module = module;
    this.#at = asDoubles(at, 3, 'at').slice();
    if (this.#at.length !== 3) throw new TypeError(`at has ${this.#at.length} numbers instead of 3`);
    this.nearest([]);  // refuses an origin that is not finite
  }

  get at() {
    return this.#at.slice();
  }

  boxesAround(boxes) {
    return relative(this.#module, this.#at, 'boxesAround', boxes, 6, 'boxes');
  }

  boxesWithin(boxes) {
    return relative(this.#module, this.#at, 'boxesWithin', boxes, 6, 'boxes');
  }

  spheresAround(spheres) {
    return relative(this.#module, this.#at, 'spheresAround', spheres, 4, 'spheres');
  }

  nearest(points) {
    return relative(this.#module, this.#at, 'nearest', points, 3, 'points');
  }

  toWorld(points) {
    return Float64Array.from(asFloats(points, 3, 'points'), (value, i) => this.#at[i % 3] + value);
  }
}
