// SPDX-License-Identifier: MIT
// A city of boxes: houses on a grid of lots, with streets between blocks, the higher the nearer to the middle.
// Coordinates are multiples of 1/4, and so float32 exactly. y points up.
import {Random} from './random.js';

// Lengths are in quarters of a metre.
const LOT = 48;
const LOTS_IN_BLOCK = 6;
const STREET = 40;
const MOST_STEPS = 3;  // boxes of a house, one upon the other: 2 on average

/** `count` boxes, 6 floats each: lo x, y, z, hi x, y, z. */
export function city(count, seed = 1991) {
  const random = new Random(seed);
  const boxes = new Float32Array(6 * count);
  const rings = Math.ceil(Math.sqrt(count / 2) / 2);
  let filled = 0;
  for (const [column, row] of lotsFromTheMiddle()) {
    for (const box of house(random, column, row, rings)) {
      if (filled === count) return boxes;
      boxes.set(box.map((quarters) => quarters / 4), 6 * filled);
      filled += 1;
    }
  }
}

/** Where a street begins and ends along one axis, in metres: street 0 is the nearest to the middle. */
export function street(number) {
  const end = placeOf(number * LOTS_IN_BLOCK);
  return [(end - STREET) / 4, end / 4];
}

/** Lots ring by ring around the middle one, without end. */
function* lotsFromTheMiddle() {
  yield [0, 0];
  for (let ring = 1; ; ring++) {
    for (let k = -ring; k < ring; k++) {
      yield [k, -ring];
      yield [ring, k];
      yield [-k, ring];
      yield [-ring, -k];
    }
  }
}

/** The boxes of a house, from the ground up. */
function* house(random, column, row, rings) {
  const ring = Math.max(Math.abs(column), Math.abs(row));
  const more = Math.max(0, 80 - Math.trunc((400 * ring) / rings));  // 0 from a fifth of the way out
  const x = placeOf(column);
  const z = placeOf(row);
  const steps = 1 + random.below(MOST_STEPS);
  let margin = 3 + random.below(8);
  let y = 0;
  for (let step = 0; step < steps; step++) {
    const height = 10 + random.below(16) + random.below(1 + more);
    yield [x + margin, y, z + margin, x + LOT - margin, y + height, z + LOT - margin];
    y += height;
    margin += 2 + random.below(4);
  }
}

/** Where a lot begins along one axis, streets included. */
function placeOf(lot) {
  return lot * LOT + Math.floor(lot / LOTS_IN_BLOCK) * STREET;
}
