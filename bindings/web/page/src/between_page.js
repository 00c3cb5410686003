// SPDX-License-Identifier: MIT
// "What is in the way?": a scene, a volume of two boxes, and the library's answers, asked anew whenever they change.
import {ask, measure} from './asking.js';
import {AskedScenes} from './asked_scenes.js';
import {cube, inThrees, joined, middleOf} from './boxes.js';
import {CullPicture} from './cull_picture.js';
import {Dragging} from './dragging.js';
import {OWN_SCENES} from './own_scenes.js';
import {steps} from './planes.js';
import {Scene} from './scenes.js';
import {Eye} from './stage.js';
import {RunningMean} from './stopwatch.js';
import {countsOf, countsOfStep, keptBySteps, layersOf, layersOfStep, summed} from './tally.js';
import {TwoBoxes, startIn} from './two_boxes.js';
import {VOLUMES, travelUntil} from './volumes.js';

const REST = 400;  // ms without a change after which times are measured and counts announced

export class BetweenPage {
  #library;
  #stage;
  #eye;
  #picture;
  #dragging;
  #panel;
  #scenes;
  #boxes;
  #answer;
  #steps;  // of each of the scenes
  #stale = true;
  #cold = true;  // whether something is asked for the first time
  #restTimer;
  #libraryTime = new RunningMean();
  #question = {};
  #file;

  constructor(library, stage, panel) {
    this.#library = library;
    this.#stage = stage;
    this.#panel = panel;
    this.#eye = new Eye(stage);
    this.#picture = new CullPicture(this.#eye);
    this.#scenes = new AskedScenes(library, this.#picture);
    this.#dragging = new Dragging(stage.canvas, this.#picture, {
      middle: (name) => this.#boxes[name].middle,
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
    const {name, shape, make, start, hasBodies} = OWN_SCENES[key];
    this.#setScene(new Scene(this.#library, name, shape, make()), start, hasBodies);
  }

  /** The user's triangles. Throws the library's error if they are no bounds; then all is as it was. */
  openTriangles(name, triangles) {
    const scene = new Scene(this.#library, name, 'triangles', triangles);
    this.#setScene(scene, startIn(scene));
    this.#file = {name, triangles};
  }

  #setScene(scene, start, hasBodies = false) {
    this.#scenes.open(scene);
    this.#boxes = new TwoBoxes(start, scene);
    this.#panel.showScene(scene, hasBodies);
    this.#lookAtBoxes();
    this.#changed();
  }

  get #scene() {
    return this.#scenes.scene;
  }

  /** Puts the boxes where they were first, and looks at them. */
  #restart() {
    this.#boxes.restart();
    this.#lookAtBoxes();
    this.#changed();
  }

  #lookAtBoxes() {
    const {middle, radius} = this.#boxes.around;
    this.#lookAt(middle, radius);
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
    this.#boxes.moveBy(this.#panel.selected, [alongX, y, alongZ].map((share) => share * this.#boxes.half));
    this.#changed();
  }

  #moveTo(name, middle) {
    this.#boxes.moveTo(name, middle);
    this.#changed();
  }

  /** A box that is dragged does not move by itself. */
  #grabbed(name) {
    if (name === 'b') this.#panel.stopWandering();
    this.#panel.select(name);
  }

  #resize(factor) {
    this.#boxes.resize(this.#panel.selected, factor);
    this.#changed();
  }

  #changed() {
    this.#stale = true;
    this.#stage.schedule();
  }

  frame(now) {
    this.#wander(now);
    this.#changeBodies();
    if (this.#stale) this.#askAnew();
    this.#stage.render(this.#picture);
    this.#picture.placeLabels(this.#panel.labels, this.#boxes, this.#stage.canvas);
  }

  #wander(now) {
    if (!this.#panel.wander) {
      this.#boxes.stopWandering();
      return;
    }
    this.#boxes.wander(now);
    this.#changed();
  }

  /** There are bodies as long as the panel says so, and they change in every frame. */
  #changeBodies() {
    const wanted = this.#panel.bodies;
    if (wanted !== Boolean(this.#scenes.bodies)) {
      this.#scenes.switchBodies(wanted);
      this.#cold = true;
    }
    if (!wanted) return;
    this.#scenes.changeBodies();
    this.#changed();
  }

  #askAnew() {
    const {all, bodies, length} = this.#scenes;
    this.#stale = false;
    this.#readQuestion();
    this.#picture.setBoxes(this.#question, this.#boxes.half / 3);
    this.#picture.show(this.#panel.shown);
    try {
      if (this.#cold) this.#warmUp();
      this.#answer = ask(this.#library, all, this.#question);
      this.#steps = this.#panel.stepping ? all.map((scene) => steps(this.#library, scene, this.#question)) : undefined;
      this.#libraryTime.add(this.#answer.milliseconds + (bodies?.milliseconds ?? 0));
      this.#draw();
      this.#panel.showTrouble();
    } catch (error) {
      this.#answer = undefined;
      this.#drawNothing();
      this.#panel.showTrouble(error.message);
    }
    if (this.#answer) this.#panel.showLibraryTime(this.#libraryTime.mean, this.counts(), length, bodies);
    clearTimeout(this.#restTimer);
    this.#restTimer = setTimeout(() => this.#rest(), REST);
  }

  #readQuestion() {
    const {kind, contact, test, time, selected} = this.#panel;
    if (kind !== this.#question.kind) this.#cold = true;
    const volume = VOLUMES[kind];
    const {a, b} = this.#boxes;
    this.#question = {
      kind, test, time,
      contact: volume.hull ? 'closed' : contact,
      a: cube(a.middle, volume.pointLike ? 0 : a.half),
      b: cube(b.middle, b.half),
    };
    this.#panel.showSize(this.#boxes.sizeOf(selected), selected === 'a' && volume.pointLike);
  }

  /** Browsers compile code when it is first called: that is no part of a frame's time. */
  #warmUp() {
    ask(this.#library, this.#scenes.all, this.#question);
    this.#libraryTime = new RunningMean();
    this.#cold = false;
  }

  #draw() {
    const volume = VOLUMES[this.#question.kind];
    const {a, b, time} = this.#question;
    const {points, first} = this.#answer;
    this.#picture.setVolume(points ? inThrees(points) : volume.corners(a, b, this.#scene.extent));
    this.#drawStep();
    const travel = travelUntil(a, b, time);
    this.#picture.setGhost(volume.moves ? a.map((value, k) => value + travel[k % 3]) : undefined);
    const hit = this.#scenes.all[first?.part];
    this.#picture.setFirst(hit, first?.index, this.#scene.extent / 60);
    const {step} = this.#panel;
    this.#paint((i) => (this.#steps ? layersOfStep(this.#steps[i], step) : layersOf(this.#answer.parts[i])));
    this.#panel.showCounts(this.counts());
    if (volume.moves) this.#panel.showFirst(first, this.#scene.shape, hit?.noun);
  }

  #drawNothing() {
    this.#picture.setVolume([]);
    this.#picture.setGhost();
    this.#picture.setStep();
    this.#picture.setFirst();
    this.#paint(() => []);
    this.#panel.showCounts({});
    this.#panel.showNoFirst();
  }

  /** Paints the layers of each of the scenes. */
  #paint(layers) {
    this.#scenes.all.forEach((scene, i) => this.#picture.paint(scene, layers(i)));
  }

  #drawStep() {
    this.#panel.showSteps(this.#steps && keptBySteps(this.#steps), this.#scenes.length);
    const {step} = this.#panel;
    const plane = this.#steps && step > 0 ? this.#steps[0].planes.subarray(4 * step - 4, 4 * step) : undefined;
    this.#picture.setStep(this.#steps && joined(this.#question.a, this.#question.b), plane);
  }

  /** How many bounds get each answer. */
  counts() {
    if (!this.#answer) return {};
    return summed(this.#scenes.all.map((scene, i) => (this.#steps
      ? countsOfStep(this.#steps[i], scene, this.#panel.step)
      : countsOf(this.#answer.parts[i], scene, this.#question))));
  }

  #rest() {
    if (this.#stale || !this.#answer || this.#scenes.bodies) return;
    this.#panel.showSpeed(measure(this.#library, this.#scene, this.#question));
    this.#panel.announce(this.counts());
  }

  /** All that a test needs to ask the same elsewhere, and where the boxes are on the canvas. */
  get state() {
    const {scene: {name, shape, floats}, bodies} = this.#scenes;
    const onCanvas = ({middle}) => this.#picture.onCanvas(middle, this.#stage.canvas);
    return {
      name, shape, floats, question: this.#question, answer: this.#answer, counts: this.counts(),
      bodies: bodies && {floats: bodies.floats, answer: this.#answer?.parts[1]},
      libraryMilliseconds: this.#libraryTime.mean,
      onCanvas: {a: onCanvas(this.#boxes.a), b: onCanvas(this.#boxes.b)},
    };
  }
}
