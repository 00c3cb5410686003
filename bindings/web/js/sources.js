// SPDX-License-Identifier: MIT
// Bounds in the caller's arrays, as the C interface reads them.
import {asFloats, asIndices} from './arguments.js';

/** Each kind of bounds: floats each, its constants as bounds and as a source, and the byte of its second part. */
const kinds = {
  boxes: {floats: 6, bound: 1, kind: 1, second: 12},
  spheres: {floats: 4, bound: 2, kind: 3, second: 12},
  triangles: {floats: 9, bound: 3, kind: 4},
};
const mesh = 5;

/** A source of bounds of a kind, and how many there are. Valid as long as the scratch memory. */
export function sourceOf(scratch, name, values, argument) {
  const {floats, kind, second} = kinds[name];
  const array = asFloats(values, floats, argument);
  const first = scratch.copy(array);
  const count = array.length / floats;
  const parts = {first, second: second === undefined ? 0 : first + second};
  return {pointer: scratch.struct('source', {kind, count, ...parts, stride: 4 * floats}), count};
}

/** The name of a kind by its constant. */
export const kindName = (bound) => Object.keys(kinds).find((name) => kinds[name].bound === bound);

/** The kind of one bound, by its number of floats: the name, and the constant of the C interface. */
export function kindOf(floats) {
  const found = Object.entries(kinds).find(([, kind]) => kind.floats === floats.length);
  if (!found) throw new TypeError(`bound has ${floats.length} floats; a box has 6, a sphere 4 and a triangle 9`);
  return {name: found[0], constant: found[1].bound};
}

/** The same if `indices` are undefined, and otherwise a source of triangles that they name. */
export function boundsSource(scratch, name, values, indices) {
  return indices === undefined ? sourceOf(scratch, name, values, name) : meshSource(scratch, values, indices);
}

function meshSource(scratch, vertices, indices) {
  const points = asFloats(vertices, 3, 'triangles');
  const corners = asIndices(indices, 'indices');
  if (corners.length % 3 !== 0) throw new TypeError(`indices has ${corners.length} numbers, which is no multiple of 3`);
  const count = corners.length / 3;
  const parts = {first: scratch.copy(points), indices: scratch.copy(corners), vertex_count: points.length / 3};
  return {pointer: scratch.struct('source', {kind: mesh, count, ...parts, stride: 12}), count};
}
