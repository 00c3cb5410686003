// SPDX-License-Identifier: MIT
// "What is in the way?": a scene, a volume of two boxes, and the library's answers, asked anew whenever they change.
import {ask, measure} from './asking.js';
import {cube, inThrees, joined, middleOf} from './boxes.js';
import {city} from './city.js';
import {CullPicture} from './cull_picture.js';
import {Dragging} from './dragging.js';
import {steps} from './planes.js';
import {Scene} from './scenes.js';
import {sphereflake} from './sphereflake.js';
import {Eye} from './stage.js';
import {RunningMean} from './stopwatch.js';
import {countsOf, countsOfStep, layersOf, layersOfStep} from './tally.js';
import {VOLUMES, travelUntil} from './volumes.js';

const REST = 400;  // ms without a change after which times are measured and counts announced

/** Scenes of the page's own: what they are made of, where the boxes start, and half of their side. */
export const OWN_SCENES = {
  city: {
    name: 'city: 200,000 boxes',
    shape: 'boxes',
    make: () => city(200000),
    start: {a: [-110, 34, -50], b: [100, 20, 60], half: 7, radius: 130},
  },
  sphereflake: {
    name: 'sphereflake: 66,430 spheres',
    shape: 'spheres',
    make: () => sphereflake(5),
    start: {a: [-70, 75, 70], b: [75, 50, -40], half: 6, radius: 105},
  },
};

export class BetweenPage {
  #library;
  #stage;
  #eye;
  #picture;
  #dragging;
  #panel;
  #scene;
  #start;
  #answer;
  #steps;
  #stale = true;
  #restTimer;
  #libraryTime = new RunningMean();
  #question = {};
  #places = {a: {middle: [0, 0, 0], half: 1}, b: {middle: [0, 0, 0], half: 1}};
  #wanderFrom;
  #file;

  constructor(library, stage, panel) {
    this.#library = library;
    this.#stage = stage;
    this.#panel = panel;
    this.#eye = new Eye(stage);
    this.#picture = new CullPicture(this.#eye);
    this.#dragging = new Dragging(stage.canvas, this.#picture, {
      middle: (name) => this.#places[name].middle,
      moveTo: (name, place) => this.#moveTo(name, place),
      select: (name) => this.#grabbed(name),
    });
    panel.connect({
      openOwn: (key) => this.openOwn(key),
      openFile: () => this.openTriangles(this.#file.name, this.#file.triangles),
      change: () => this.#changed(),
      move: (direction) => this.#move(direction),
      resize: (factor) => this.#resize(factor),
      lookAtAll: () => this.#lookAt(middleOf(this.#scene.around), this.#scene.extent / 2),
      lookAtBoxes: () => this.#lookAtBoxes(),
      restart: () => this.#restart(),
      toFirst: () => panel.setTime(this.#answer.first.time),
    });
  }

  openOwn(key) {
    const {name, shape, make, start} = OWN_SCENES[key];
    this.#setScene(new Scene(this.#library, name, shape, make()), start);
  }

  /** The user's triangles. Throws the library's error if they are no bounds; then all is as it was. */
  openTriangles(name, triangles) {
    const scene = new Scene(this.#library, name, 'triangles', triangles);
    const middle = middleOf(scene.around);
    const at = (...shares) => middle.map((value, k) => value + shares[k] * scene.extent);
    const start = {a: at(-0.3, 0.1, 0.15), b: at(0.3, 0, -0.1), half: 0.04 * scene.extent, radius: 0.5 * scene.extent};
    this.#setScene(scene, start);
    this.#file = {name, triangles};
  }

  #setScene(scene, start) {
    this.#picture.setScene(scene);
    this.#scene?.free();
    this.#scene = scene;
    this.#start = {...start, half: start.half || 1};
    this.#panel.showScene(scene);
    this.#restart();
  }

  /** Puts the boxes where they were first, and looks at them. */
  #restart() {
    for (const name of ['a', 'b']) this.#places[name] = {middle: this.#start[name], half: this.#start.half};
    this.#wanderFrom = undefined;
    this.#lookAtBoxes();
    this.#changed();
  }

  #lookAtBoxes() {
    const [a, b] = [this.#places.a.middle, this.#places.b.middle];
    const middle = a.map((value, k) => (value + b[k]) / 2);
    const apart = Math.hypot(...a.map((value, k) => value - b[k]));
    this.#lookAt(middle, Math.max(this.#start.radius, 0.6 * apart, 4 * this.#start.half));
  }

  #lookAt(place, radius) {
    this.#eye.lookAt(place, [0.35, 0.75, 1], radius);
  }

  setActive(active) {
    this.#eye.controls.enabled = active;
    this.#dragging.enabled = active;
    if (active) this.#changed();
    else this.#picture.hideLabels(this.#panel.labels);
  }

  readColours() {
    this.#picture.readColours();
  }

  /** Keys while the picture is in focus; tells whether the key means something. */
  key(event) {
    const arrow = {ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 0, -1], ArrowDown: [0, 0, 1]}[event.key];
    const height = {ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0]}[event.key];
    if (arrow) this.#move((event.shiftKey ? height ?? [0, 0, 0] : arrow).map((share) => share / 4));
    else if (['a', 'b'].includes(event.key.toLowerCase())) this.#panel.select(event.key.toLowerCase());
    else return false;
    return true;
  }

  turn(radians) {
    this.#eye.turn(radians);
  }

  zoom(factor) {
    this.#eye.zoom(factor);
  }

  /** Moves the selected box, in directions as seen: x to the right, y up, z towards the viewer. */
  #move([x, y, z]) {
    const quarter = Math.round(this.#eye.controls.getAzimuthalAngle() / (Math.PI / 2));
    const [alongX, alongZ] = [[x, z], [z, -x], [-x, -z], [-z, x]][(quarter + 4) % 4];
    const name = this.#panel.selected;
    const step = this.#start.half;
    const shift = [alongX, y, alongZ];
    this.#moveTo(name, this.#places[name].middle.map((value, k) => value + step * shift[k]));
  }

  /** Not farther out than half the size of the scene, so that no box is lost. */
  #moveTo(name, middle) {
    const {around, extent} = this.#scene;
    const reach = Math.max(extent / 2, 20 * this.#start.half);
    const near = (value, k) => Math.min(Math.max(value, around[k] - reach), around[k + 3] + reach);
    this.#places[name].middle = middle.map(near);
    this.#changed();
  }

  /** A box that is dragged does not move by itself. */
  #grabbed(name) {
    if (name === 'b') this.#panel.stopWandering();
    this.#panel.select(name);
  }

  #resize(factor) {
    this.#places[this.#panel.selected].half = this.#start.half * factor;
    this.#changed();
  }

  /** How large the selected box is, as a multiple of its first size. */
  #sizeOf(name) {
    return this.#places[name].half / this.#start.half;
  }

  #changed() {
    this.#stale = true;
    this.#stage.schedule();
  }

  frame(now) {
    this.#wander(now);
    if (this.#stale) this.#askAnew();
    this.#stage.render(this.#picture);
    this.#picture.placeLabels(this.#panel.labels, this.#places, this.#stage.canvas);
  }

  /** Box B on a circle through the place where it was. */
  #wander(now) {
    if (!this.#panel.wander) {
      this.#wanderFrom = undefined;
      return;
    }
    this.#wanderFrom ??= {middle: this.#places.b.middle, since: now};
    const angle = (now - this.#wanderFrom.since) / 2500;
    const radius = 5 * this.#start.half;
    const [x, y, z] = this.#wanderFrom.middle;
    this.#moveTo('b', [x + radius * Math.sin(angle), y, z + radius * (Math.cos(angle) - 1)]);
  }

  #askAnew() {
    this.#stale = false;
    const kindChanged = this.#readQuestion();
    this.#picture.setBoxes(this.#question, this.#start.half / 3);
    try {
      if (kindChanged) this.#warmUp();
      this.#answer = ask(this.#library, this.#scene, this.#question);
      this.#steps = this.#panel.stepping ? steps(this.#library, this.#scene, this.#question) : undefined;
      this.#libraryTime.add(this.#answer.milliseconds);
      this.#draw();
      this.#panel.showTrouble();
    } catch (error) {
      this.#answer = undefined;
      this.#drawNothing();
      this.#panel.showTrouble(error.message);
    }
    if (this.#answer) this.#panel.showLibraryTime(this.#libraryTime.mean, this.counts(), this.#scene.length);
    clearTimeout(this.#restTimer);
    this.#restTimer = setTimeout(() => this.#rest(), REST);
  }

  /** Tells whether another kind is asked than before. */
  #readQuestion() {
    const {kind, contact, test, time} = this.#panel;
    const kindChanged = kind !== this.#question.kind;
    const volume = VOLUMES[kind];
    const {a, b} = this.#places;
    this.#question = {
      kind, test, time,
      contact: volume.hull ? 'closed' : contact,
      a: cube(a.middle, volume.pointLike ? 0 : a.half),
      b: cube(b.middle, b.half),
    };
    this.#panel.showSize(this.#sizeOf(this.#panel.selected), this.#panel.selected === 'a' && volume.pointLike);
    return kindChanged;
  }

  /** Browsers compile code when it is first called: that is no part of a frame's time. */
  #warmUp() {
    ask(this.#library, this.#scene, this.#question);
    this.#libraryTime = new RunningMean();
  }

  #draw() {
    const volume = VOLUMES[this.#question.kind];
    const {a, b, time} = this.#question;
    const {points, first} = this.#answer;
    this.#picture.setVolume(points ? inThrees(points) : volume.corners(a, b, this.#scene.extent));
    this.#drawStep();
    const travel = travelUntil(a, b, time);
    this.#picture.setGhost(volume.moves ? a.map((value, k) => value + travel[k % 3]) : undefined);
    this.#picture.setFirst(this.#scene, first?.index);
    this.#picture.paint(this.#steps ? layersOfStep(this.#steps, this.#panel.step) : layersOf(this.#answer));
    this.#picture.show(this.#panel.shown);
    this.#panel.showCounts(this.counts());
    if (volume.moves) this.#panel.showFirst(first, this.#scene.shape);
  }

  #drawNothing() {
    this.#picture.setVolume([]);
    this.#picture.setGhost();
    this.#picture.setStep();
    this.#picture.setFirst(this.#scene);
    this.#picture.paint([]);
    this.#panel.showCounts({});
    this.#panel.showNoFirst();
  }

  #drawStep() {
    this.#panel.showSteps(this.#steps && this.#steps.left.map((left) => left.length), this.#scene.length);
    const {step} = this.#panel;
    const plane = this.#steps && step > 0 ? this.#steps.planes.subarray(4 * step - 4, 4 * step) : undefined;
    this.#picture.setStep(this.#steps && joined(this.#question.a, this.#question.b), plane);
  }

  /** How many bounds get each answer. */
  counts() {
    if (!this.#answer) return {};
    if (this.#steps) return countsOfStep(this.#steps, this.#scene, this.#panel.step);
    return countsOf(this.#answer, this.#scene, this.#question);
  }

  #rest() {
    if (this.#stale || !this.#answer) return;
    this.#panel.showSpeed(measure(this.#library, this.#scene, this.#question));
    this.#panel.announce(this.counts());
  }

  /** All that a test needs to ask the same elsewhere, and where the boxes are on the canvas. */
  get state() {
    const {name, shape, floats} = this.#scene;
    const onCanvas = ({middle}) => this.#picture.onCanvas(middle, this.#stage.canvas);
    return {
      name, shape, floats, question: this.#question, answer: this.#answer, counts: this.counts(),
      libraryMilliseconds: this.#libraryTime.mean,
      onCanvas: {a: onCanvas(this.#places.a), b: onCanvas(this.#places.b)},
    };
  }
}
