// SPDX-License-Identifier: MIT
// The planes of a shaft between two boxes, one by one: what is left after each of them, as the library tells.
import {boundsFor} from './asking.js';
import {joined} from './boxes.js';

/**
 * The joining planes in the order in which they are tested, 4 floats each, and what is left after step k: step 0 keeps
 * what meets the box around both ends, step k also cuts by plane k. A step is asked as a shaft of its own: from the box
 * around both ends to itself, cut by the planes so far.
 */
export function steps(library, scene, question) {
  const {a, b, contact} = question;
  const {tree} = boundsFor(scene, question);
  const planes = planesOf(library, a, b, contact);
  const around = joined(a, b);
  const left = [];
  for (let k = 0; k <= planes.length / 4; k++) {
    const shaft = library.between(around, around, {contact, planes: planes.subarray(0, 4 * k)});
    try {
      left.push(tree.list(shaft));
    } finally {
      shaft.free();
    }
  }
  return {planes, left};
}

function planesOf(library, a, b, contact) {
  const shaft = library.between(a, b, {contact});
  try {
    return shaft.joiningPlanes();
  } finally {
    shaft.free();
  }
}
