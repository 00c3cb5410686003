// SPDX-License-Identifier: MIT
// Bodies that come, go and move in the streets of the city and in the air: small boxes in a dynamic tree of the
// library. Coordinates are multiples of 1/16, and so float32 exactly.
import {street} from './city.js';
import {Random} from './random.js';
import {RunningMean, Stopwatch} from './stopwatch.js';

const COUNT = 2000;
const REPLACED = 10;  // of them in a frame, so each stays for 200 frames

// Lengths are in sixteenths of a metre. Bodies come into this region, around where the boxes A and B start.
const METRE = 16;
const FROM = [-200 * METRE, 0, -160 * METRE];
const TO = [200 * METRE, 80 * METRE, 160 * METRE];
const LEAST_HEIGHT_IN_AIR = 20 * METRE;
const MOST_HEIGHT_IN_STREETS = 40 * METRE;

/** They are asked like a scene of boxes. Their number never changes, so their indices are 0 to length − 1. */
export class Bodies {
  shape = 'boxes';
  noun = 'body';
  outsideColour = 'body';  // so that one can tell them from houses
  floats = new Float32Array(6 * COUNT);
  milliseconds = 0;  // what the library took for the last changes
  #steps = new Float32Array(6 * COUNT);  // what is added to the floats in a frame
  #ids;
  #oldest = 0;
  #random;
  #times = new RunningMean();

  /** The same seed gives the same bodies in every frame. */
  constructor(library, seed = 2000) {
    this.#random = new Random(seed);
    for (let i = 0; i < COUNT; i++) this.#put(i, this.#newBody());
    this.bounds = {tree: library.dynamicBoxTree()};
    this.#ids = this.bounds.tree.insert(this.floats);
    this.change();  // browsers compile code when it is first called: that is no part of a frame's time
    this.#times = new RunningMean();
  }

  get length() {
    return COUNT;
  }

  /** The mean of the last frames. */
  get meanMilliseconds() {
    return this.#times.mean;
  }

  bound(i) {
    return this.floats.subarray(6 * i, 6 * i + 6);
  }

  /** The changes of a frame: all move, the oldest go, and as many come, which get their indices. */
  change() {
    const {tree} = this.bounds;
    for (let k = 0; k < this.floats.length; k++) this.floats[k] += this.#steps[k];
    const gone = this.#ids.slice(this.#oldest, this.#oldest + REPLACED);
    const come = Array.from(gone, () => this.#newBody());
    const boxes = come.flatMap(({box}) => box);
    const stopwatch = new Stopwatch();
    tree.move(this.#ids, this.floats);
    tree.erase(gone);
    const ids = tree.insert(boxes);
    tree.commit();
    this.milliseconds = stopwatch.milliseconds();
    this.#times.add(this.milliseconds);
    ids.forEach((id, i) => {
      const index = Number(id & 0xffffffffn);
      this.#ids[index] = id;
      this.#put(index, come[i]);
    });
    this.#oldest = (this.#oldest + REPLACED) % COUNT;
  }

  #put(index, {box, step}) {
    this.floats.set(box, 6 * index);
    this.#steps.set([...step, ...step], 6 * index);
  }

  /** A box of 3 to 6 m, and how it moves in a frame. */
  #newBody() {
    const size = [0, 1, 2].map(() => this.#between(3 * METRE, 6 * METRE));
    const {lo, step} = this.#random.below(2) === 0 ? this.#inStreet(size) : this.#inAir();
    const inMetres = (lengths) => lengths.map((length) => length / METRE);
    return {box: inMetres([...lo, ...lo.map((from, k) => from + size[k])]), step: inMetres(step)};
  }

  /** It moves along its street. */
  #inStreet(size) {
    const along = 2 * this.#random.below(2);
    const across = 2 - along;
    const [from, to] = street(this.#between(-2, 2)).map((metres) => metres * METRE);
    const lo = [0, this.#random.below(MOST_HEIGHT_IN_STREETS), 0];
    lo[along] = this.#between(FROM[along], TO[along]);
    lo[across] = this.#between(from, to - size[across]);
    const step = [0, 0, 0];
    step[along] = this.#speed(4);
    return {lo, step};
  }

  #inAir() {
    const lo = [0, 1, 2].map((k) => this.#between(k === 1 ? LEAST_HEIGHT_IN_AIR : FROM[k], TO[k]));
    return {lo, step: [this.#speed(2), this.#between(-1, 1), this.#speed(2)]};
  }

  /** Up to this much in a frame, to either side. */
  #speed(most) {
    return this.#between(1, most) * (this.#random.below(2) === 0 ? -1 : 1);
  }

  /** An integer from one to another, which may come, too. */
  #between(from, to) {
    return from + this.#random.below(to - from + 1);
  }

  free() {
    this.bounds.tree.free();
  }
}
