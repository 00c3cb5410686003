// SPDX-License-Identifier: MIT
// Large worlds: bounds in doubles, as floats relative to an origin.
import {asDoubles, asFloats} from './arguments.js';

const roundings = {boxesAround: 0, boxesWithin: 1, spheresAround: 2, nearest: 3, planesAround: 4};

/** The floats that a rounding makes of elements of `per` doubles, behind the doubles of `before`. */
function relative(module, at, rounding, values, per, name, before = []) {
  const doubles = asDoubles(values, per, name);
  return module.scratch((scratch) => {
    const given = new Float64Array(before.length + doubles.length);
    given.set(before);
    given.set(doubles, before.length);
    const [origin, from, to] = [scratch.copy(at), scratch.copy(given), scratch.zeros(4 * doubles.length)];
    module.call('shaftcull_relative', origin, roundings[rounding], from, BigInt(doubles.length / per), to);
    return module.floats(to, doubles.length);
  });
}

/** A number of doubles for one thing. */
function asOne(values, numbers, name) {
  const doubles = asDoubles(values, numbers, name);
  if (doubles.length !== numbers) throw new TypeError(`${name} has ${doubles.length} numbers instead of ${numbers}`);
  return doubles;
}

export class Origin {
  #module;
  #at;

  constructor(module, at = [0, 0, 0]) {
    this.#module = module;
    this.#at = asOne(at, 3, 'at').slice();
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

  planesAround(planes, box) {
    return relative(this.#module, this.#at, 'planesAround', planes, 4, 'planes', asOne(box, 6, 'box'));
  }

  nearest(points) {
    return relative(this.#module, this.#at, 'nearest', points, 3, 'points');
  }

  toWorld(points) {
    return Float64Array.from(asFloats(points, 3, 'points'), (value, i) => this.#at[i % 3] + value);
  }
}
