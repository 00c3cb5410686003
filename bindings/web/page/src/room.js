// SPDX-License-Identifier: MIT
// Two furnished rooms with a door between them, as patches and as solids. Coordinates are multiples of 1/16 of a metre,
// and so float32 exactly. y points up.

const SIZE = 0.5;  // of a patch, at most
const HEIGHT = 3;
const DEPTH = 5;

const ROOMS = [[0, 0, 0, 4, HEIGHT, DEPTH], [4.25, 0, 0, 8.25, HEIGHT, DEPTH]];
const PASSAGE = [4, 0, 2, 4.25, 2, 3];
const DOORS = [[4, 0, 2, 4, 2, 3], [4.25, 0, 2, 4.25, 2, 3]];  // its two ends, where no wall is
const WALL = [[4, 0, 0, 4.25, HEIGHT, 2], [4, 0, 3, 4.25, HEIGHT, DEPTH], [4, 2, 2, 4.25, HEIGHT, 3]];
const FURNITURE = [
  [0.5, 0.25, 0.5, 2, 1.25, 1],
  [1.25, 0.6875, 2.5, 2.75, 0.75, 3.5],
  [6, 0.6875, 0.75, 7.5, 0.75, 1.75],
];

/** Places of the cupboard along the second room, from 0 to 12. */
function cupboard(place) {
  const x = 4.75 + place / 4;
  return [x, 0.25, 3, x + 0.5, 2.25, 4];
}

/**
 * `corners` of patches, 4 points each; `boxes` around them, 6 floats each; `planes`, 4 floats each, whose normals point
 * to where they face; `solids`, 6 floats each.
 */
export function room(place) {
  const things = [...FURNITURE, cupboard(place)];
  const patches = [
    ...ROOMS.flatMap((box) => sides(box, true)), ...sides(PASSAGE, true), ...things.flatMap((box) => sides(box, false)),
  ];
  return {
    corners: patches.map(({corners}) => corners),
    boxes: new Float32Array(patches.flatMap(({corners}) => [...corners[0], ...corners[2]])),
    planes: new Float32Array(patches.flatMap(({plane}) => plane)),
    solids: new Float32Array([...WALL, ...things].flat()),
  };
}

/** The sides of a box in patches, which face into it or away from it. What lies in a door is left out. */
function sides(box, inwards) {
  return [0, 1, 2].flatMap((k) => [0, 3].flatMap((end) => {
    const up = (end === 3) !== inwards;
    return cells(box, k, end)
      .filter(([first, , third]) => !DOORS.some((door) => holds(door, first) && holds(door, third)))
      .map((corners) => ({corners, up, plane: planeAcross(k, box[k + end], up)}));
  }));
}

function planeAcross(axis, offset, up) {
  const normal = [0, 0, 0];
  normal[axis] = up ? 1 : -1;
  return [...normal, up ? offset : -offset];
}

/** One side of a box, across axis k, in cells: four corners each, the lowest first and the highest third. */
function cells(box, k, end) {
  const [i, j] = [(k + 1) % 3, (k + 2) % 3];
  const result = [];
  for (const [fromI, toI] of pieces(box[i], box[i + 3])) {
    for (const [fromJ, toJ] of pieces(box[j], box[j + 3])) {
      result.push([[fromI, fromJ], [toI, fromJ], [toI, toJ], [fromI, toJ]].map(([atI, atJ]) => {
        const corner = [0, 0, 0];
        corner[k] = box[k + end];
        corner[i] = atI;
        corner[j] = atJ;
        return corner;
      }));
    }
  }
  return result;
}

function pieces(from, to) {
  const count = Math.ceil((to - from) / SIZE);
  return Array.from({length: count}, (_, n) => [from + n * SIZE, Math.min(from + (n + 1) * SIZE, to)]);
}

function holds(box, point) {
  return point.every((value, k) => box[k] <= value && value <= box[k + 3]);
}
