// SPDX-License-Identifier: MIT
// Bounds in the caller's arrays, as the C interface reads them.
import {asFloats, asIndices} from './arguments.js';

const sourceBytes = 64;  // src/layout.cpp

/** What is known of each kind of bounds: floats each, and the function that makes a source of them. */
const kinds = {
  boxes: {floats: 6, source: 'shaftcull_boxes'},
  spheres: {floats: 4, source: 'shaftcull_spheres'},
  triangles: {floats: 9, source: 'shaftcull_triangles'},
};

/** A source of bounds of a kind, and how many there are. Valid as long as the scratch memory. */
export function sourceOf(module, scratch, kind, values, name) {
  const {floats, source} = kinds[kind];
  const array = asFloats(values, floats, name);
  const count = array.length / floats;
  const pointer = scratch.zeros(sourceBytes);
  module.call(source, pointer, scratch.copy(array), BigInt(count));
  return {pointer, count};
}

/** A source of triangles that indices name. */
export function meshSource(module, scratch, vertices, indices) {
  const points = asFloats(vertices, 3, 'triangles');
  const corners = asIndices(indices, 'indices');
  if (corners.length % 3 !== 0) throw new TypeError(`indices has ${corners.length} numbers, which is no multiple of 3`);
  const count = corners.length / 3;
  const pointer = scratch.zeros(sourceBytes);
  const vertexCount = BigInt(points.length / 3);
  module.call('shaftcull_mesh', pointer, scratch.copy(points), vertexCount, scratch.copy(corners), BigInt(count));
  return {pointer, count};
}
