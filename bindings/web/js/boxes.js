// SPDX-License-Identifier: MIT
// Boxes and planes made of others.
import {asFloats, asFloatsOf, asView} from './arguments.js';

const maxPlanes = 6;

/** The box that a function of the C interface writes. Arrays are passed as their addresses. */
const boxFrom = (module, name, ...values) => module.scratch((scratch) => {
  const box = scratch.struct('box');
  module.call(name, ...values.map((value) => (value instanceof Float32Array ? scratch.copy(value) : value)), box);
  return module.floats(box, 6);
});

export function boxAround(module, points) {
  const floats = asFloats(points, 3, 'points');
  return boxFrom(module, 'shaftcull_box_around', floats, BigInt(floats.length / 3));
}

export const translated = (module, box, by) =>
    boxFrom(module, 'shaftcull_translated', asFloatsOf(box, 6, 'box'), asFloatsOf(by, 3, 'by'), 0);

export const inflated = (module, box, by) =>
    boxFrom(module, 'shaftcull_translated', asFloatsOf(box, 6, 'box'), 0, asFloatsOf([by], 1, 'by')[0]);

export function inscribedBox(module, corners) {
  const floats = asFloats(corners, 3, 'corners');
  return boxFrom(module, 'shaftcull_inscribed_box', floats, BigInt(floats.length / 3));
}

export function mergedBoxes(module, boxes) {
  const floats = asFloats(boxes, 6, 'boxes');
  return module.scratch((scratch) => {
    const [given, found] = [scratch.copy(floats), scratch.zeros(8)];
    for (let room = floats.length / 6;;) {
      const merged = scratch.zeros(24 * room);
      module.call('shaftcull_merged_boxes', given, BigInt(floats.length / 6), merged, BigInt(room), found);
      const count = module.number(found);
      if (count <= room) return module.floats(merged, 6 * count);
      room = count;
    }
  });
}

export function viewPlanes(module, matrix, depth) {
  const {rows, range} = asView(matrix, depth);
  return module.scratch((scratch) => {
    const [planes, count] = [scratch.zeros(16 * maxPlanes), scratch.zeros(8)];
    module.call('shaftcull_view_planes', scratch.copy(rows), range, planes, count);
    return module.floats(planes, 4 * module.number(count));
  });
}
