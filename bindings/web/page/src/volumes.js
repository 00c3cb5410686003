// SPDX-License-Identifier: MIT
// The kinds of volumes between, around and behind two boxes, and how the library forms each of them.
import {Matrix4, PerspectiveCamera, Vector3} from 'three';
import {cornersOf, middleOf} from './boxes.js';

/**
 * Of each kind:
 * form      the volume, from the two boxes and the contact
 * corners   points whose convex hull is drawn; what has no end is drawn as far as `far`. A hull tells its own points
 * pointLike whether box A is only its middle
 * twoEnds   whether it is a shaft between two boxes: it has joining planes, and boxes can block it
 * moves     whether box A moves, so that there is a first contact
 * hull      whether it is a convex hull, which has closed contact and tests no triangles exactly
 * trouble   why two boxes have no such volume, if they have none
 */
export const VOLUMES = {
  between: {
    name: 'between two boxes',
    asks: 'What can block the view from box A to box B? The shaft is the convex hull of both.',
    ends: ['box A', 'box B'],
    twoEnds: true,
    form: (library, a, b, contact) => library.between(a, b, {contact}),
    corners: (a, b) => [...cornersOf(a), ...cornersOf(b)],
  },
  pointLight: {
    name: 'from a point light',
    asks: 'What can cast a shadow of a point light, A, on a receiver, B?',
    ends: ['light', 'receiver'],
    pointLike: true,
    twoEnds: true,
    form: (library, a, b, contact) => library.between(a, b, {contact}),
    corners: (a, b) => [...cornersOf(a), ...cornersOf(b)],
  },
  sun: {
    name: 'towards the sun',
    asks: 'What can cast the sun’s shadow on a receiver, B? The sun stands in the direction of A, infinitely far.',
    ends: ['direction of the sun', 'receiver'],
    pointLike: true,
    form: (library, a, b, contact) => library.sweptInfinite(b, fromTo(b, a), {contact}),
    corners: (a, b, far) => sweptCorners(b, scaledTo(fromTo(b, a), far)),
    trouble: samePlace,
  },
  camera: {
    name: 'view of a camera',
    asks: 'What does a camera at A see that looks at B? Large boxes behind a corner of its view are outside, too. '
      + 'Spheres near an edge of it may be kept. Triangles are tested as the boxes around them.',
    ends: ['camera', 'target'],
    pointLike: true,
    hull: true,
    form: (library, a, b) => library.frustum(viewMatrix(a, b), 'minus_one_to_one'),
    trouble: samePlace,
  },
  shadow: {
    name: 'shadow of an occluder',
    asks: 'What lies in the shadow of an occluder, B, by an area light, A, wholly or in part? It has no end.',
    ends: ['light', 'occluder'],
    form: (library, a, b, contact) => library.shadow(a, b, {contact}),
    corners: shadowCorners,
    trouble: (a, b) => (areApart(a, b) ? undefined : 'The light touches the occluder: no shadow. Move them apart.'),
  },
  swept: {
    name: 'body that moves',
    asks: 'What may a body, A, hit on its way to B, and what first?',
    ends: ['body', 'goal'],
    moves: true,
    form: (library, a, b, contact) => library.swept(a, fromTo(a, b), {contact}),
    corners: (a, b) => sweptCorners(a, fromTo(a, b)),
  },
};

/** The displacement between the middles of two boxes, rounded to float32: it is what is asked, and what is drawn. */
function fromTo(a, b) {
  const [from, to] = [middleOf(a), middleOf(b)];
  return new Float32Array(to.map((value, k) => value - from[k]));
}

/** The displacement of a body on its way from a to b until a time, rounded likewise. */
export function travelUntil(a, b, time) {
  return fromTo(a, b).map((value) => time * value);
}

function scaledTo(direction, length) {
  const scale = length / Math.hypot(...direction);
  return direction.map((value) => value * scale);
}

function sweptCorners(body, travel) {
  const start = cornersOf(body);
  return [...start, ...start.map((corner) => corner.map((value, k) => value + travel[k]))];
}

/** The occluder, and where rays from corners of the light through its own corners have gone as far as `far`. */
function shadowCorners(light, occluder, far) {
  const scale = 1 + (2 * far) / Math.max(Math.hypot(...fromTo(light, occluder)), far / 1000);
  const corners = cornersOf(occluder);
  const behind = (from, to) => to.map((value, k) => from[k] + scale * (value - from[k]));
  return [...corners, ...cornersOf(light).flatMap((from) => corners.map((to) => behind(from, to)))];
}

function samePlace(a, b) {
  return fromTo(a, b).some((value) => value !== 0) ? undefined : 'A and B are at the same place: move one of them.';
}

function areApart(a, b) {
  return [0, 1, 2].some((k) => a[k] > b[k + 3] || b[k] > a[k + 3]);
}

/** A view-projection matrix of float32 from A to B, and as far behind B as half the way to it. */
function viewMatrix(a, b) {
  const way = Math.hypot(...fromTo(a, b));
  const camera = new PerspectiveCamera(40, 1.6, way / 50, way * 1.5);
  camera.position.set(...middleOf(a));
  camera.lookAt(new Vector3(...middleOf(b)));
  camera.updateMatrixWorld();
  const product = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  return new Float32Array(product.elements);
}
