// SPDX-License-Identifier: MIT
// Arrays of shafts, and convex hulls.
import {asEnumerator, asFloats, asFloatsOf, asIndices, asPosition, asView, checkOptions} from './arguments.js';
import {ShaftcullError} from './error.js';
import {Held, made} from './held.js';
import {asTriangleTest} from './query.js';
import {kindOf, sourceOf} from './sources.js';

export const contacts = ['closed', 'open'];
const answers = ['outside', 'overlap', 'inside'];
const maxPlanes = 8;

/** A shaft of an array, or a hull, which can be asked about single bounds. */
class Volume extends Held {
  classify(bound, options = {}) {
    checkOptions(options, ['at', 'triangleTest']);
    const floats = asFloats(bound, 1, 'bound');
    const {name, constant} = kindOf(floats);
    const test = asTriangleTest(options.triangleTest ?? 'exact');
    const values = (scratch) => [constant, scratch.copy(floats), test];
    return answers[askOne(this, options.at, 'shaftcull_classify_one', values)];
  }

  keeps(bound, options) {
    return this.classify(bound, options) !== 'outside';
  }
}

/** The word that a query about one shaft of a volume writes; values(scratch) are its arguments. */
function askOne(volume, at, query, values) {
  const {module} = volume;
  const result = module.resultsOf(4);
  module.scratch((scratch) => module.call(query, ...oneShaft(module, volume, at), ...values(scratch), result));
  return module.word(result);
}

export class Shafts extends Volume {
  /** `areBetween` says that all are between two boxes, so that they have joining planes. */
  constructor(module, length, areBetween) {
    super(module, 'shaftcull_shafts_free', made(module, 'shaftcull_shafts_create', BigInt(length)));
    this.length = length;
    this.areBetween = areBetween;
  }

  joiningPlanes(options) {
    if (!this.areBetween) throw new TypeError('only shafts between two boxes have joining planes');
    const {module} = this;
    return this.#described(options, ({a, b}, scratch) => {
      const planes = scratch.zeros(16 * maxPlanes);
      return module.floats(planes, 4 * module.call('joining_planes', a, b, planes));
    });
  }

  describe(options) {
    const {module} = this;
    return this.#described(options, (info) => ({
      a: module.floats(info.a, 6),
      b: module.floats(info.b, 6),
      contact: contacts[info.contact],
      hasPlanes: info.has_planes === 1,
      isHull: info.is_hull === 1,
    }));
  }

  setContact(contact) {
    const value = asEnumerator(contact, contacts, 'contact');
    this.module.call('shaftcull_shafts_set_contact', ...allShafts(this.module, this), value);
  }

  complete() {
    this.module.call('shaftcull_shafts_complete', ...allShafts(this.module, this));
  }

  occludedByBox(solid, options = {}) {
    checkOptions(options, ['at']);
    const box = asFloatsOf(solid, 6, 'solid');
    return askOne(this, options.at, 'shaftcull_occluded_by', (scratch) => [scratch.copy(box), 2n]) === 1;
  }

  occludedByPolygon(corners, options = {}) {
    checkOptions(options, ['at']);
    const floats = asFloats(corners, 3, 'corners');
    const count = BigInt(floats.length / 3);
    if (count === 2n) {  // which the C interface takes for a box
      throw new ShaftcullError('invalid argument', 'a polygon has three corners or more, not 2');
    }
    return askOne(this, options.at, 'shaftcull_occluded_by', (scratch) => [scratch.copy(floats), count]) === 1;
  }

  /** The result of use(info, scratch), of the shaftcull_shafts_info of one shaft. */
  #described(options = {}, use) {
    checkOptions(options, ['at']);
    const {module} = this;
    return module.scratch((scratch) => {
      const shaft = oneShaft(module, this, options.at);
      return use(scratch.described('shafts_info', 'shaftcull_shafts_describe', ...shaft), scratch);
    });
  }
}

/** A hull, with the array of one shaft that bounds are asked about. */
export class Hull extends Volume {
  #asked;
  #points;
  #directions;

  constructor(module, handle) {
    super(module, 'shaftcull_hull_free', handle);
    this.#asked = new Shafts(module, 1, false);
    module.call('shaftcull_shafts_set_hull', this.#asked.handle, 0n, handle);
    module.scratch((scratch) => {
      const info = scratch.described('hull_info', 'shaftcull_hull_describe', handle);
      this.#points = module.floats(info.points, 3 * info.point_count);
      this.#directions = module.floats(info.directions, 3 * info.direction_count);
    });
  }

  get points() {
    return this.#points.slice();
  }

  get directions() {
    return this.#directions.slice();
  }

  get asked() {
    return this.#asked;
  }

  free() {
    this.#asked.free();
    super.free();
  }
}

/** The array and the position of the one shaft of a query. */
export function oneShaft(module, shaft, at = 0) {
  const shafts = shaft instanceof Hull ? shaft.asked : shaft;
  if (!(shafts instanceof Shafts)) throw new TypeError('a shaft is made by between(), swept(), hull() and so on');
  const position = asPosition(at, shafts.length, 'at');
  return [ofModule(module, shafts, 'the shaft').handle, BigInt(position)];
}

/** The range of all shafts of an array. */
export function allShafts(module, shafts) {
  if (!(shafts instanceof Shafts)) throw new TypeError('shafts are made by between(), swept() or shadow()');
  return [ofModule(module, shafts, 'the shafts').handle, 0n, BigInt(shafts.length)];
}

/** Refuses an object of another module, whose handle means something else here. */
function ofModule(module, held, name) {
  if (held.module !== module) {
    throw new TypeError(`${name} and what is asked are of two modules, made by two calls of load()`);
  }
  return held;
}

/** Two arrays as long as there are shafts, and how many these are. An array of one element is repeated for all. */
function aligned(a, perA, nameA, b, perB, nameB) {
  const [countA, countB] = [a.length / perA, b.length / perB];
  if (countA !== countB && countA !== 1 && countB !== 1) {
    const must = 'there must be as many of both, or one of either';
    throw new TypeError(`there are ${countA} of ${nameA} and ${countB} of ${nameB}; ${must}`);
  }
  const count = countA === 0 || countB === 0 ? 0 : Math.max(countA, countB);
  return [repeated(a, count / countA || 0), repeated(b, count / countB || 0), count];
}

function repeated(floats, times) {
  if (times === 1) return floats;
  const all = new Float32Array(floats.length * times);
  for (let i = 0; i !== times; ++i) all.set(floats, i * floats.length);
  return all;
}

/**
 * For each of `count` boxes the planes for all, and then its own. `values` are those of all `given` boxes, which are
 * `count` or one.
 */
function planesFor(all, values, name, given, count) {
  const own = asFloats(values ?? [], 4, name);
  if (own.length % (4 * given) > 0) {
    throw new TypeError(`${name} has ${own.length / 4} planes for ${given} boxes; there must be as many for each`);
  }
  const per = own.length / given || 0;
  const floats = new Float32Array(count * (all.length + per));
  for (let i = 0; i !== count; ++i) {
    const first = given === 1 ? 0 : i * per;
    floats.set(all, i * (all.length + per));
    floats.set(own.subarray(first, first + per), i * (all.length + per) + all.length);
  }
  return floats;
}

/** The option for planes of boxes that are called so: planesA. */
const planesName = (boxes) => `planes${boxes[0].toUpperCase()}${boxes.slice(1)}`;

const asContact = ({contact}) => asEnumerator(contact ?? 'closed', contacts, 'contact');

/** `count` shafts that form(range, scratch) forms. */
function formed(module, count, areBetween, form) {
  const shafts = new Shafts(module, count, areBetween);
  try {
    module.scratch((scratch) => form(allShafts(module, shafts), scratch));
    return shafts;
  } catch (error) {
    shafts.free();
    throw error;
  }
}

/** Boxes and pairs of them as arguments of the C interface: how many shafts they make, and write(scratch). */
function pairsOf(a, b, names, options) {
  let [boxesA, boxesB] = [asFloats(a, 6, names[0]), asFloats(b, 6, names[1])];
  const given = [boxesA.length / 6, boxesB.length / 6];
  const pairs = options.pairs === undefined ? undefined : asIndices(options.pairs, 'pairs');
  if (pairs === undefined) [boxesA, boxesB] = aligned(boxesA, 6, names[0], boxesB, 6, names[1]);
  if (pairs !== undefined && pairs.length % 2 !== 0) {
    throw new TypeError(`pairs has ${pairs.length} numbers, which is no multiple of 2`);
  }
  const write = (scratch) => {
    const sourceA = sourceOf(scratch, 'boxes', boxesA, names[0]);
    const sourceB = sourceOf(scratch, 'boxes', boxesB, names[1]);
    const all = asFloats(options.planes ?? [], 4, 'planes');
    const [planesA, planesB] = [[all, sourceA], [[], sourceB]].map(([common, {count}], i) =>
        planesFor(common, options[planesName(names[i])], planesName(names[i]), given[i], count));
    const planes = scratch.struct('batch_planes', {
      a: scratch.copy(planesA), a_count: planesA.length / 4, b: scratch.copy(planesB), b_count: planesB.length / 4,
    });
    const named = pairs === undefined ? 0 : scratch.copy(pairs);
    return {sources: [sourceA.pointer, sourceB.pointer, named], planes};
  };
  return {count: pairs === undefined ? boxesA.length / 6 : pairs.length / 2, write};
}

export function between(module, a, b, options = {}) {
  checkOptions(options, ['pairs', 'contact', 'planes', 'planesA', 'planesB']);
  const contact = asContact(options);
  const {count, write} = pairsOf(a, b, ['a', 'b'], options);
  return formed(module, count, true, (range, scratch) => {
    const {sources, planes} = write(scratch);
    module.call('shaftcull_shafts_set_between', ...range, ...sources, planes, contact);
  });
}

export function shadow(module, lights, occluders, options = {}) {
  checkOptions(options, ['pairs', 'reach', 'contact', 'planes', 'planesLights', 'planesOccluders']);
  const contact = asContact(options);
  const {count, write} = pairsOf(lights, occluders, ['lights', 'occluders'], options);
  return formed(module, count, false, (range, scratch) => {
    const {sources, planes} = write(scratch);
    const reach = options.reach === undefined ? 0 : scratch.copy(asFloatsOf([options.reach], 1, 'reach'));
    module.call('shaftcull_shafts_set_shadow', ...range, ...sources, reach, planes);
    module.call('shaftcull_shafts_set_contact', ...range, contact);
  });
}

function moving(module, sweep, bodies, vectors, name, options = {}) {
  checkOptions(options, ['contact', 'planes', 'planesBodies']);
  const contact = asContact(options);
  const given = asFloats(bodies, 6, 'bodies');
  const [boxes, travels, count] = aligned(given, 6, 'bodies', asFloats(vectors, 3, name), 3, name);
  return formed(module, count, false, (range, scratch) => {
    const source = sourceOf(scratch, 'boxes', boxes, 'bodies');
    const all = asFloats(options.planes ?? [], 4, 'planes');
    const planes = planesFor(all, options.planesBodies, 'planesBodies', given.length / 6, count);
    const planeCount = BigInt(planes.length / 4);
    const moved = [source.pointer, scratch.copy(travels), sweep, scratch.copy(planes), planeCount];
    module.call('shaftcull_shafts_set_swept', ...range, ...moved);
    module.call('shaftcull_shafts_set_contact', ...range, contact);
  });
}

export function swept(module, bodies, displacements, options) {
  return moving(module, 0, bodies, displacements, 'displacements', options);
}

export function sweptInfinite(module, bodies, directions, options) {
  return moving(module, 1, bodies, directions, 'directions', options);
}

/** Copies of the shafts of all parts, one behind the other. */
export function concatenate(module, parts) {
  if (!Array.isArray(parts)) throw new TypeError('parts is no array of shafts and hulls');
  const all = parts.map((part) => (part instanceof Hull ? part.asked : part));
  const ranges = all.map((shafts) => allShafts(module, shafts));
  const count = all.reduce((sum, {length}) => sum + length, 0);
  return formed(module, count, all.every(({areBetween}) => areBetween), ([handle]) => {
    let at = 0n;
    for (const range of ranges) {
      module.call('shaftcull_shafts_copy', handle, at, ...range);
      at += range[2];
    }
  });
}

/** How a hull culls boxes, as C names it. */
function hullTest(options) {
  checkOptions(options, ['test']);
  return asEnumerator(options.test ?? 'exact', ['exact', 'conservative'], 'test');
}

export function hull(module, points, directions = [], options = {}) {
  const [from, along] = [asFloats(points, 3, 'points'), asFloats(directions, 3, 'directions')];
  return module.scratch((scratch) => new Hull(module, made(module, 'shaftcull_hull_create', scratch.copy(from),
      BigInt(from.length / 3), 0n, scratch.copy(along), BigInt(along.length / 3), hullTest(options))));
}

export function betweenPolygons(module, p, q, options = {}) {
  const [first, second] = [asFloats(p, 3, 'p'), asFloats(q, 3, 'q')];
  if (first.length === 0) throw new RangeError('p has no corner');
  const both = Float32Array.of(...first, ...second);
  const none = new Float32Array(0);
  return module.scratch((scratch) => new Hull(module, made(module, 'shaftcull_hull_create', scratch.copy(both),
      BigInt(both.length / 3), BigInt(first.length / 3), scratch.copy(none), 0n, hullTest(options))));
}

export function frustum(module, matrix, depth, options = {}) {
  const {rows, range} = asView(matrix, depth);
  return module.scratch(
      (scratch) => new Hull(module, made(module, 'shaftcull_hull_of_frustum', scratch.copy(rows), range, hullTest(options))));
}

/** What can cast a shadow into view, by a light at a point, where `w` is 1, or by a sun in a direction, where it is 0. */
export function castersOf(module, w, view, vector, name) {
  if (!(view instanceof Hull)) throw new TypeError('view is no hull: frustum() and hull() make one');
  const floats = asFloatsOf(vector, 3, name);
  const {handle} = ofModule(module, view, 'the view');
  const light = Float32Array.of(...floats, w);
  return module.scratch(
      (scratch) => new Hull(module, made(module, 'shaftcull_hull_of_casters', handle, scratch.copy(light))));
}
