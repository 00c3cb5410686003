// SPDX-License-Identifier: MIT
// Bounds in the caller's arrays, as the C interface reads them.
import {asFloats, asIndices} from './arguments.js';

const sourceBytes = 56;  // src/layout.cpp

/** Each kind of bounds: floats each, its constants as bounds and as a source, and the byte of its second part. */
const kinds = {
  boxes: {floats: 6, bound: 1, kind: 1, second: 12},
  spheres: {floats: 4, bound: 2, kind: 3, second: 12},
  triangles: {floats: 9, bound: 3, kind: 4},
};
const mesh = 5;

/** Writes a source; pointers of parts that the kind does not have are 0. Valid as long as the scratch memory. */
function written(module, scratch, {kind, count, first, second = 0, stride, indices = 0, vertexCount = 0}) {
  const pointer = scratch.zeros(sourceBytes);
  const {view} = module;
  view.setUint32(pointer, kind, true);
  view.setBigUint64(pointer + 8, BigInt(count), true);
  view.setUint32(pointer + 16, first, true);
  view.setUint32(pointer + 20, second, true);
  view.setBigUint64(pointer + 24, BigInt(stride), true);
  view.setUint32(pointer + 32, indices, true);
  view.setBigUint64(pointer + 40, BigInt(vertexCount), true);
  return {pointer, count};
}

/** A source of bounds of a kind, and how many there are. */
export function sourceOf(module, scratch, name, values, argument) {
  const {floats, kind, second} = kinds[name];
  const array = asFloats(values, floats, argument);
  const first = scratch.copy(array);
  return written(module, scratch, {
    kind, count: array.length / floats, first, second: second && first + second, stride: 4 * floats,
  });
}

/** The kind of one bound, by its number of floats: the name, and the constant of the C interface. */
export function kindOf(floats) {
  const found = Object.entries(kinds).find(([, kind]) => kind.floats === floats.length);
  if (!found) throw new TypeError(`bound has ${floats.length} floats; a box has 6, a sphere 4 and a triangle 9`);
  return {name: found[0], constant: found[1].bound};
}

/** A source of triangles that indices name. */
export function meshSource(module, scratch, vertices, indices) {
  const points = asFloats(vertices, 3, 'triangles');
  const corners = asIndices(indices, 'indices');
  if (corners.length % 3 !== 0) throw new TypeError(`indices has ${corners.length} numbers, which is no multiple of 3`);
  return written(module, scratch, {
    kind: mesh, count: corners.length / 3, first: scratch.copy(points), stride: 12, indices: scratch.copy(corners),
    vertexCount: points.length / 3,
  });
}
