// SPDX-License-Identifier: MIT
// The sphereflake: each sphere carries nine of a third of its radius, six around its equator and three above
// (E. Haines, "A Proposal for Standard Graphics Environments", 1987). Only +, −, ×, ÷ and square roots are used, which
// IEEE 754 fixes, so that the spheres are the same on every machine.

const HALF = 1 / 2;
const ROOT_3_4 = Math.sqrt(3) / 2;
const UP = Math.sqrt(2 / 3);
const OUT = 1 / Math.sqrt(3);

/** Directions of the nine children where the parent's own axis is z. */
const CHILDREN = [
  [1, 0, 0], [HALF, ROOT_3_4, 0], [-HALF, ROOT_3_4, 0], [-1, 0, 0], [-HALF, -ROOT_3_4, 0], [HALF, -ROOT_3_4, 0],
  [OUT * ROOT_3_4, OUT * HALF, UP], [-OUT * ROOT_3_4, OUT * HALF, UP], [0, -OUT, UP],
];

/** Spheres of `depth` generations below the first one, 4 floats each: centre x, y, z, radius. */
export function sphereflake(depth, radius = 40) {
  const spheres = [];
  grow(spheres, [0, radius, 0], radius, [0, 1, 0], depth);
  return new Float32Array(spheres);
}

function grow(spheres, centre, radius, axis, depth) {
  spheres.push(...centre, radius);
  if (depth === 0) return;
  const [u, v] = across(axis);
  const distance = (4 / 3) * radius;
  for (const [x, y, z] of CHILDREN) {
    const direction = axis.map((w, k) => x * u[k] + y * v[k] + z * w);
    grow(spheres, centre.map((c, k) => c + distance * direction[k]), radius / 3, direction, depth - 1);
  }
}

/** Two unit vectors across a third, and across each other. */
function across([x, y, z]) {
  const u = Math.abs(x) < 0.5 ? unit([0, z, -y]) : unit([-z, 0, x]);
  return [u, [y * u[2] - z * u[1], z * u[0] - x * u[2], x * u[1] - y * u[0]]];
}

function unit(v) {
  const length = Math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return v.map((c) => c / length);
}
