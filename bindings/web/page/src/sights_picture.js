// SPDX-License-Identifier: MIT
// The picture of two rooms: patches in colours, seen from outside through walls that face away; lines of one patch.
import {
  BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, Raycaster,
  Scene as World, Vector2, LineLoop,
} from 'three';
import {colour, rampColour} from './palette.js';

const TWO_TRIANGLES = [0, 1, 2, 0, 2, 3];

export class SightsPicture {
  world = new World();
  #patches = new Mesh(new BufferGeometry(), new MeshBasicMaterial({vertexColors: true}));
  #grid = new LineSegments(new BufferGeometry(), new LineBasicMaterial({transparent: true, opacity: 0.25}));
  #lines = {};
  #picked = new LineLoop(new BufferGeometry(), new LineBasicMaterial({depthTest: false, transparent: true}));
  #corners = [];

  constructor(eye, sights) {
    this.eye = eye.camera;
    for (const sight of sights) {
      const material = new LineBasicMaterial({transparent: true, opacity: 0.55});
      this.#lines[sight] = new LineSegments(new BufferGeometry(), material);
    }
    this.#picked.renderOrder = 2;
    this.world.add(this.#patches, this.#grid, ...Object.values(this.#lines), this.#picked);
    this.readColours();
  }

  readColours() {
    this.world.background = colour('sky');
    this.#grid.material.color = colour('grid');
    this.#picked.material.color = colour('picked');
    for (const [sight, lines] of Object.entries(this.#lines)) lines.material.color = colour(sight);
  }

  /** Patches: four corners each, and whether they are listed against the sun as seen from where they face. */
  setPatches({corners, planes}) {
    this.#corners = corners;
    const points = corners.flatMap((four, p) => {
      const up = planes[4 * p] + planes[4 * p + 1] + planes[4 * p + 2] > 0;
      return TWO_TRIANGLES.flatMap((c) => four[up ? c : (4 - c) % 4]);
    });
    this.#patches.geometry = geometryOf(points);
    const edges = corners.map((four) => four.flatMap((corner, c) => [...corner, ...four[(c + 1) % 4]]));
    this.#grid.geometry = geometryOf(edges.flat());
  }

  /** A share from 0 to 1 for each patch. */
  paint(shares) {
    const colours = [...shares].flatMap((share) => {
      const {r, g, b} = rampColour(share);
      return TWO_TRIANGLES.flatMap(() => [r, g, b]);
    });
    this.#patches.geometry.setAttribute('color', new Float32BufferAttribute(colours, 3));
  }

  pick(patch) {
    this.#picked.geometry = geometryOf(this.#corners[patch].flat());
  }

  /** Lines from a patch to others. */
  setLines(sight, patch, others) {
    const from = middle(this.#corners[patch]);
    this.#lines[sight].geometry.dispose();
    this.#lines[sight].geometry = geometryOf(others.flatMap((other) => [...from, ...middle(this.#corners[other])]));
  }

  /** The patch at a place of the canvas, -1 to 1 in x and y, or undefined. */
  patchAt(x, y) {
    const raycaster = new Raycaster();
    raycaster.setFromCamera(new Vector2(x, y), this.eye);
    const [hit] = raycaster.intersectObject(this.#patches);
    return hit && Math.floor(hit.faceIndex / 2);
  }
}

function geometryOf(points) {
  return new BufferGeometry().setAttribute('position', new Float32BufferAttribute(points, 3));
}

function middle([first, , third]) {
  return first.map((value, k) => (value + third[k]) / 2);
}
