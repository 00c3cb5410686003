// SPDX-License-Identifier: MIT
// The picture of a question: all bounds, the two boxes, the volume, a plane of it, and what is hit first.
import {
  BoxGeometry, BufferGeometry, DoubleSide, EdgesGeometry, Float32BufferAttribute, Group, LineBasicMaterial,
  LineSegments, Mesh, MeshBasicMaterial, PlaneGeometry, Scene as World, SphereGeometry, Vector3,
} from 'three';
import {ConvexGeometry} from 'three/addons/geometries/ConvexGeometry.js';
import {aroundSpheres, boxesAround, cornersOf, middleOf} from './boxes.js';
import {BoundsMesh} from './bounds_mesh.js';
import {colour} from './palette.js';

export class CullPicture {
  world = new World();
  #meshes = new Map();  // of bounds, by their scenes
  #floor = new Mesh(new PlaneGeometry(1, 1).rotateX(-Math.PI / 2), new MeshBasicMaterial());
  #boxes = {a: outlinedBox(), b: outlinedBox()};
  #ghost = outlinedBox();
  #volume = translucentSolid(0.2);
  #around = outlinedBox();
  #plane = translucentSolid(0.3);
  #first = outline();

  constructor(eye) {
    this.eye = eye.camera;
    this.#around.children[0].visible = false;
    this.world.add(this.#floor, this.#boxes.a, this.#boxes.b, this.#ghost);
    this.world.add(this.#volume, this.#around, this.#plane, this.#first);
    this.readColours();
  }

  readColours() {
    this.world.background = colour('sky');
    this.#floor.material.color = colour('floor');
    tint(this.#boxes.a, colour('a'));
    tint(this.#boxes.b, colour('b'));
    tint(this.#ghost, colour('a'));
    tint(this.#volume, colour('shaft'));
    tint(this.#around, colour('plane'));
    tint(this.#plane, colour('plane'));
    this.#first.material.color = colour('first');
    for (const mesh of this.#meshes.values()) mesh.readColours();
  }

  /** Draws the bounds of a scene, too. May find no memory: then all is as it was. */
  add(scene) {
    const bounds = new BoundsMesh(scene);
    this.#meshes.set(scene, bounds);
    this.world.add(bounds.mesh);
  }

  remove(scene) {
    const bounds = this.#meshes.get(scene);
    this.#meshes.delete(scene);
    this.world.remove(bounds.mesh);
    bounds.dispose();
  }

  /** Draws the bounds of a scene where they are now. */
  move(scene) {
    this.#meshes.get(scene).move();
  }

  /** Puts the floor under a scene. */
  placeFloor(scene) {
    const middle = middleOf(scene.around);
    this.#floor.scale.setScalar(2.5 * scene.extent);
    this.#floor.position.set(middle[0], scene.around[1] - scene.extent / 20000, middle[2]);
  }

  paint(scene, layers) {
    this.#meshes.get(scene).paint(layers);
  }

  show(shown) {
    for (const mesh of this.#meshes.values()) mesh.show(shown);
    this.#volume.visible = shown.volume;
  }

  /** The two boxes; a point is drawn as a small ball of this radius. */
  setBoxes(boxes, pointRadius) {
    for (const name of ['a', 'b']) placeBox(this.#boxes[name], boxes[name], pointRadius);
  }

  /** What a pointer may grab: {a, b}. */
  get handles() {
    return {a: this.#boxes.a.children[0], b: this.#boxes.b.children[0]};
  }

  /** The volume as the convex hull of its corners; without corners there is none. */
  setVolume(corners) {
    const points = corners.map((corner) => new Vector3(...corner));
    setSolid(this.#volume, points.length > 0 ? new ConvexGeometry(points) : undefined);
  }

  /** The box around both ends, and where a plane, normal and offset, cuts it; without a box there is neither. */
  setStep(around, plane) {
    this.#around.visible = around !== undefined;
    if (around) placeBox(this.#around, around, 0);
    const cut = plane ? sectionOf(around, plane) : [];
    setSolid(this.#plane, cut.length > 2 ? polygon(cut) : undefined);
  }

  /** Where the moving body is; without a box it is not shown. */
  setGhost(box) {
    this.#ghost.visible = box !== undefined;
    if (box) placeBox(this.#ghost, box, 0);
  }

  /** Marks what is hit first: its edges, and a line up from it. */
  setFirst(scene, index, lineLength) {
    this.#first.visible = index !== undefined;
    if (index === undefined) return;
    const box = boxOf(scene, index);
    const size = [0, 1, 2].map((k) => box[k + 3] - box[k]);
    const edges = new EdgesGeometry(new BoxGeometry(...size).translate(...middleOf(box))).attributes.position.array;
    const [x, , z] = middleOf(box);
    const points = [...edges, x, box[4], z, x, box[4] + lineLength, z];
    this.#first.geometry.dispose();
    this.#first.geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(points, 3));
  }

  /** Puts the names of the boxes beside them, and not beyond the right edge. */
  placeLabels(labels, places, canvas) {
    for (const [name, label] of Object.entries(labels)) {
      const place = this.onCanvas(places[name].middle, canvas);
      label.hidden = !place;
      if (!place) continue;
      const room = canvas.clientWidth - label.offsetWidth - 4;
      const x = place.x > canvas.clientWidth ? place.x : Math.min(place.x + 16, room);
      label.style.transform = `translate(${x}px, calc(${place.y}px - 2rem))`;
    }
  }

  hideLabels(labels) {
    for (const label of Object.values(labels)) label.hidden = true;
  }

  /** Where a place is on the canvas, in CSS pixels; undefined if it is behind the eye. */
  onCanvas(place, canvas) {
    const point = new Vector3(...place).project(this.eye);
    if (point.z > 1) return undefined;
    return {x: ((point.x + 1) / 2) * canvas.clientWidth, y: ((1 - point.y) / 2) * canvas.clientHeight};
  }
}

function boxOf(scene, index) {
  const bound = scene.bound(index);
  if (scene.shape === 'spheres') return aroundSpheres(bound);
  return scene.shape === 'triangles' ? boxesAround(bound) : bound;
}

/** Corners of the polygon in which a plane cuts a box, in order around it. */
function sectionOf(box, plane) {
  const corners = cornersOf(box);
  const height = corners.map((corner) => plane[0] * corner[0] + plane[1] * corner[1] + plane[2] * corner[2] - plane[3]);
  const points = [];
  for (let c = 0; c < 8; c++) {
    for (const other of [1, 2, 4].map((bit) => c | bit).filter((d) => d !== c)) {
      if (height[c] === height[other] || height[c] * height[other] > 0) continue;
      const share = height[c] / (height[c] - height[other]);
      points.push(new Vector3(...corners[c]).lerp(new Vector3(...corners[other]), share));
    }
  }
  return aroundTheirMiddle(points, new Vector3(plane[0], plane[1], plane[2]));
}

function aroundTheirMiddle(points, normal) {
  const middle = points.reduce((sum, point) => sum.addScaledVector(point, 1 / points.length), new Vector3());
  const u = new Vector3().subVectors(points[0] ?? middle, middle);
  const v = new Vector3().crossVectors(normal.normalize(), u);
  const angle = (point) => Math.atan2(v.dot(point.clone().sub(middle)), u.dot(point.clone().sub(middle)));
  return points.sort((p, q) => angle(p) - angle(q));
}

/** A flat convex polygon, as triangles that share its first corner. */
function polygon(corners) {
  const geometry = new BufferGeometry().setFromPoints(corners);
  return geometry.setIndex(corners.slice(2).flatMap((_, i) => [0, i + 1, i + 2]));
}

/** A solid of which one sees what is behind it, with its edges. */
function translucentSolid(opacity) {
  const material = new MeshBasicMaterial({transparent: true, opacity, side: DoubleSide, depthWrite: false});
  const faces = new Mesh(new BufferGeometry(), material);
  faces.renderOrder = 1;
  const group = new Group();
  return group.add(faces, outline());
}

/** Gives it another shape, or none. */
function setSolid(solid, geometry) {
  const [faces, edges] = solid.children;
  faces.geometry.dispose();
  edges.geometry.dispose();
  faces.geometry = geometry ?? new BufferGeometry();
  edges.geometry = geometry ? new EdgesGeometry(geometry, 1) : new BufferGeometry();
}

/** Lines that nothing hides. */
function outline() {
  const lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({depthTest: false, transparent: true}));
  lines.renderOrder = 2;
  return lines;
}

const CUBE = new BoxGeometry(1, 1, 1);
const CUBE_EDGES = new EdgesGeometry(CUBE);
const BALL = new SphereGeometry(0.5, 24, 16);

function outlinedBox() {
  const edges = outline();
  edges.geometry = CUBE_EDGES;
  return new Group().add(new Mesh(CUBE, new MeshBasicMaterial()), edges);
}

function placeBox(group, box, pointRadius) {
  const size = [0, 1, 2].map((k) => box[k + 3] - box[k]);
  const isPoint = Math.max(...size) === 0;
  const [solid, edges] = group.children;
  solid.geometry = isPoint ? BALL : CUBE;
  edges.visible = !isPoint;
  group.position.set(...middleOf(box));
  group.scale.set(...(isPoint ? [2, 2, 2].map((twice) => twice * pointRadius) : size));
}

function tint(group, value) {
  for (const child of group.children) child.material.color = value;
}
