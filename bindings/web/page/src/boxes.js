// SPDX-License-Identifier: MIT
// Boxes as the library takes them: 6 floats, lo x, y, z, hi x, y, z.

/** A cube by its middle and half its side, rounded to float32; a point if that is 0. */
export function cube([x, y, z], half) {
  return new Float32Array([x - half, y - half, z - half, x + half, y + half, z + half]);
}

/** Points of 3 floats each, as arrays. */
export function inThrees(floats) {
  return Array.from({length: floats.length / 3}, (_, i) => [floats[3 * i], floats[3 * i + 1], floats[3 * i + 2]]);
}

export function middleOf(box) {
  return [0, 1, 2].map((k) => box[k] / 2 + box[k + 3] / 2);
}

/** Its eight corners, or fewer times eight the same ones if it is flat. */
export function cornersOf(box) {
  return Array.from({length: 8}, (_, c) => [0, 1, 2].map((k) => box[k + 3 * ((c >> k) & 1)]));
}

/** The box around two. */
export function joined(a, b) {
  return a.map((value, k) => (k < 3 ? Math.min(value, b[k]) : Math.max(value, b[k])));
}

/** The boxes around triangles of 9 floats each. */
export function boxesAround(triangles) {
  const boxes = new Float32Array((triangles.length / 9) * 6);
  for (let t = 0; t < triangles.length / 9; t++) {
    for (let k = 0; k < 3; k++) {
      const [p, q, r] = [triangles[9 * t + k], triangles[9 * t + 3 + k], triangles[9 * t + 6 + k]];
      boxes[6 * t + k] = Math.min(p, q, r);
      boxes[6 * t + 3 + k] = Math.max(p, q, r);
    }
  }
  return boxes;
}

/** The box around spheres of 4 floats each, rounded to the nearest: to place things, not to cull. */
export function aroundSpheres(spheres) {
  const box = new Float32Array([Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity]);
  for (let s = 0; s < spheres.length; s += 4) {
    for (let k = 0; k < 3; k++) {
      box[k] = Math.min(box[k], spheres[s + k] - spheres[s + 3]);
      box[k + 3] = Math.max(box[k + 3], spheres[s + k] + spheres[s + 3]);
    }
  }
  return box;
}
