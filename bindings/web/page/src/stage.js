// SPDX-License-Identifier: MIT
// The canvas: one renderer for both pictures, and its size.
import {PerspectiveCamera, Spherical, Vector3, WebGLRenderer} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

/** Renders whatever picture is current, when something has changed. */
export class Stage {
  /** Whether this browser draws pictures at all. */
  static get isPossible() {
    return document.createElement('canvas').getContext('webgl2') !== null;
  }

  #renderer;
  #scheduled = false;

  constructor(canvas, onFrame) {
    this.canvas = canvas;
    this.onFrame = onFrame;
    this.#renderer = new WebGLRenderer({canvas, antialias: true});
    canvas.addEventListener('webglcontextrestored', () => this.schedule());
    new ResizeObserver(() => this.#resize()).observe(canvas.parentElement);
  }

  #resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.setSize(width, height, false);
    this.onFrame(performance.now());  // at once, since the picture is empty now
  }

  /** Asks for a frame. */
  schedule() {
    if (this.#scheduled) return;
    this.#scheduled = true;
    requestAnimationFrame((now) => {
      this.#scheduled = false;
      this.onFrame(now);
    });
  }

  render(picture) {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    if (width === 0 || height === 0) return;
    fit(picture.eye, width / height);
    this.#renderer.render(picture.world, picture.eye);
  }
}

const FIELD = 45;  // of view, in degrees, along the shorter side of the picture

function fit(camera, aspect) {
  const half = (FIELD / 2) * (Math.PI / 180);
  camera.fov = aspect < 1 ? (2 * Math.atan(Math.tan(half) / aspect) * 180) / Math.PI : FIELD;
  camera.aspect = aspect;
  camera.updateProjectionMatrix();
}

/** An eye that turns around a target, by mouse, touch and buttons. */
export class Eye {
  constructor(stage) {
    this.camera = new PerspectiveCamera(FIELD, 1, 1, 10000);
    this.controls = new OrbitControls(this.camera, stage.canvas);
    this.controls.enabled = false;
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.addEventListener('change', () => stage.schedule());
  }

  /** Looks at a place from a direction, so far away that a ball of this radius fills the picture. */
  lookAt(place, direction, radius) {
    const distance = radius / Math.sin((FIELD / 2) * (Math.PI / 180));
    this.camera.near = distance / 200;
    this.camera.far = distance * 20;
    this.controls.minDistance = distance / 100;
    this.controls.maxDistance = distance * 8;  // what is looked at stays well before `far`
    this.camera.position.copy(new Vector3(...direction).setLength(distance).add(new Vector3(...place)));
    this.controls.target.set(...place);
    this.controls.update();
  }

  turn(radians) {
    this.#moveAround((spherical) => { spherical.theta += radians; });
  }

  zoom(factor) {
    this.#moveAround((spherical) => { spherical.radius *= factor; });
  }

  #moveAround(change) {
    const spherical = new Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    change(spherical);
    this.camera.position.setFromSpherical(spherical).add(this.controls.target);
    this.controls.update();
  }
}
