// SPDX-License-Identifier: MIT
// The options of questions, as the C interface reads them.
import {asBoolean, asEnumerator, asIndices, asInteger} from './arguments.js';

/** Options that are arrays: the fields of shaftcull_query for the numbers, and for how many these are. */
const arrays = {
  exclude: ['exclude', 'exclude_count'],
  excludeEach: ['exclude_each', 'exclude_each_count'],
  excludeMask: ['exclude_mask', 'exclude_mask_words'],
  layerMask: ['layer_masks', 'layer_mask_count'],
  only: ['only', 'only_count'],
};

const triangleTests = ['exact', 'vertices'];
export const asTriangleTest = (value) => asEnumerator(value, triangleTests, 'triangleTest');

const ofAll = ['exclude', 'excludeMask', 'layerMask', 'limit', 'only', 'skipOverlapping', 'triangleTest'];

/** The names of all options of questions about one shaft, and of those about many. */
export const optionsOfOne = ['at', ...ofAll];
export const optionsOfMany = ['excludeEach', ...ofAll];

export const bitWords = (bounds) => 2 * Math.ceil(bounds / 64);  // of 32 bits

/** Bits as cull() returns them; the C interface reads 64 at a time. */
function maskOf(values, bounds) {
  const [words, count] = [asIndices(values, 'excludeMask'), Math.ceil(bounds / 32)];
  if (words.length !== count) {
    throw new TypeError(`excludeMask has ${words.length} words instead of ${count}, one for each 32 bounds`);
  }
  const mask = new Uint32Array(bitWords(bounds));
  mask.set(words);
  return mask;
}

/** One mask for all shafts, or one for each. */
function layerMaskOf(value, shafts) {
  const masks = asIndices(typeof value === 'number' ? [value] : value, 'layerMask');
  if (masks.length !== 1 && masks.length !== shafts) {
    const must = 'there must be one for all, or one for each';
    throw new TypeError(`layerMask has ${masks.length} masks for ${shafts} shafts; ${must}`);
  }
  return masks;
}

function arrayOf(name, value, shafts, bounds) {
  if (name === 'excludeMask') return maskOf(value, bounds);
  if (name === 'layerMask') return layerMaskOf(value, shafts);
  return asIndices(value, name);
}

/** The query of these options, or NULL if there are none, for so many shafts and bounds. */
export function queryOf(scratch, options, shafts, bounds) {
  const given = Object.entries(arrays).filter(([name]) => options[name] !== undefined);
  const limit = options.limit === undefined ? 0 : asInteger(options.limit, 1, 'limit');
  const test = asTriangleTest(options.triangleTest ?? 'exact');
  const skip = asBoolean(options.skipOverlapping ?? false, 'skipOverlapping') ? 1 : 0;
  if (given.length === 0 && limit === 0 && test === 0 && skip === 0) return 0;
  const query = {limit, triangle_test: test, skip_overlapping: skip};
  for (const [name, [numbers, count]] of given) {
    const array = arrayOf(name, options[name], shafts, bounds);
    query[numbers] = scratch.copy(array);
    query[count] = name === 'excludeMask' ? array.length / 2 : array.length;  // words of a mask have 64 bits
  }
  return scratch.struct('query', query);
}
