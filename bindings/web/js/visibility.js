// SPDX-License-Identifier: MIT
// Visibility: which pairs of patches see each other.
import {asEnumerator, asFloats, asInteger, asNumber, checkOptions} from './arguments.js';
import {withHandles} from './held.js';
import {contacts} from './shafts.js';
import {sourceOf} from './sources.js';

const sightNames = ['undecided', 'clear', 'occluded', 'facing_away'];
const sceneOptions = [
  'patches', 'planes', 'corners', 'patchesB', 'planesB', 'cornersB', 'boxes', 'solids', 'hulls', 'polygons', 'triangles',
  'sides',
];
const countOptions = ['contact', 'tolerance', 'solidsAroundEnds', 'findSolids', 'memory', 'part', 'parts'];
const rayOptions = ['rays', 'error', 'seed'];
export const defaultMemory = 2 ** 28;
const patchSides = ['front', 'both'];
const blockWords = 5;  // of shaftcull_pair_block

/** Patches by their boxes, named `name`, or by their corners. */
function patchesOf(scratch, make, boxes, planes, corners, sides, name, cornersName) {
  if (corners) {
    if (boxes || planes) throw new TypeError(`${cornersName} are patches: there are no other patches, and no planes`);
    return make('shaftcull_patches_free', 'shaftcull_patches_create_polygons', ...cornersOf(scratch, corners, cornersName),
                asEnumerator(sides ?? 'front', patchSides, 'sides'));
  }
  const source = sourceOf(scratch, 'boxes', boxes, name);
  const floats = asFloats(planes ?? [], 4, 'planes');
  if (planes && floats.length !== 4 * source.count) {
    const count = floats.length / 4;
    throw new TypeError(`there are ${count} planes for ${source.count} ${name}; each has one, or there are none`);
  }
  return make('shaftcull_patches_free', 'shaftcull_patches_create', source.pointer, scratch.copy(floats),
                    BigInt(floats.length / 4));
}

/** Corners of hulls or polygons as arguments of the C interface: all of them, and where those of each begin. */
function cornersOf(scratch, values, name) {
  if (!Array.isArray(values)) throw new TypeError(`${name} is no array with the corners of each`);
  const all = values.map((corners, i) => asFloats(corners, 3, `${name}[${i}]`));
  const begins = new BigUint64Array(all.length + 1);
  all.forEach(({length}, i) => (begins[i + 1] = begins[i] + BigInt(length / 3)));
  const floats = new Float32Array(3 * Number(begins[all.length]));
  all.forEach((corners, i) => floats.set(corners, 3 * Number(begins[i])));
  return [scratch.copy(floats), begins[all.length], scratch.copy(begins), BigInt(all.length)];
}

/** All occluders of the scene: their handle, and the number of the first group of triangles. */
function occludersOf(module, scratch, make, scene, a, b) {
  const occluders = make('shaftcull_occluders_free', 'shaftcull_occluders_create');
  const source = (kind, name) => sourceOf(scratch, kind, scene[name], name).pointer;
  const add = (name, ...values) => module.call(name, occluders, ...values, 0);
  if (scene.boxes) add('shaftcull_occluders_add_boxes', source('boxes', 'boxes'));
  if (scene.solids) add('shaftcull_occluders_add_solids', source('boxes', 'solids'));
  if (scene.hulls) add('shaftcull_occluders_add_solid_hulls', ...cornersOf(scratch, scene.hulls, 'hulls'));
  if (scene.polygons) add('shaftcull_occluders_add_polygons', ...cornersOf(scratch, scene.polygons, 'polygons'));
  const firstGroup = occludersCount(module, occluders);
  if (scene.findSolids) {
    if (!scene.triangles) throw new TypeError('findSolids looks for solids in triangles, and there are none');
    add('shaftcull_occluders_add_mesh', source('triangles', 'triangles'), 0, 1, a, b, 0);
  } else if (scene.triangles) {
    add('shaftcull_occluders_add_triangles', source('triangles', 'triangles'), 0, 0n);
  }
  return {occluders, firstGroup};
}

const occludersCount = (module, occluders) => Number(module.call('shaftcull_occluders_count', occluders));

/** The triangles of the scene in each occluder: those of a group, and none in others. */
function trianglesOf(module, scratch, {occluders, firstGroup}) {
  const none = new Uint32Array();
  return Array.from({length: occludersCount(module, occluders)}, (_, occluder) => {
    if (occluder < firstGroup) return none;
    const info = scratch.described('occluder_info', 'shaftcull_occluders_describe', occluders, BigInt(occluder));
    return module.words(info.triangles, info.triangle_count);
  });
}

function orderOf(module, scratch, patches) {
  const {order, count} = scratch.described('patches_info', 'shaftcull_patches_describe', patches);
  return module.words(order, count);
}

/** The result of use(scene, make, scratch), which has the handles a, b (0 if there is none), occluders and firstGroup. */
export function withScene(module, scene, names, use) {
  checkOptions(scene, [...sceneOptions, ...names]);
  if (scene.sides && !scene.corners && !scene.cornersB) throw new TypeError('there are sides, but no corners');
  if (scene.planesB && !scene.patchesB && !scene.cornersB) throw new TypeError('there are planesB, but no patchesB');
  return withHandles(module, (make) => module.scratch((scratch) => {
    const a = patchesOf(scratch, make, scene.patches, scene.planes, scene.corners, scene.sides, 'patches', 'corners');
    const b = scene.patchesB || scene.cornersB ?
        patchesOf(scratch, make, scene.patchesB, scene.planesB, scene.cornersB, scene.sides, 'patchesB', 'cornersB') : 0;
    return use({a, b, ...occludersOf(module, scratch, make, scene, a, b)}, make, scratch);
  }));
}

/** The options that visibility, rays and view factors have in common, as far as they are given. */
export function asOptions(scene) {
  const given = {};
  if (scene.tolerance !== undefined) [given.tolerance] = asFloats([scene.tolerance], 1, 'tolerance');
  if (scene.memory !== undefined) given.memory = asInteger(scene.memory, 0, 'memory');
  if (scene.rays !== undefined) given.rays = asInteger(scene.rays, 0, 'rays');
  if (scene.error !== undefined) given.error = asNumber(scene.error, 'error');
  if (scene.seed !== undefined) given.seed = asInteger(scene.seed, 0, 'seed');
  if (scene.part !== undefined) given.part = asInteger(scene.part, 0, 'part');
  if (scene.parts !== undefined) given.parts = asInteger(scene.parts, 0, 'parts');
  return given;
}

function sightOptions(scratch, scene) {
  const {memory = defaultMemory, tolerance = 0, part = 0, parts = 1} = asOptions(scene);
  return scratch.struct('visibility_options', {
    memory, tolerance, part, parts,
    contact: asEnumerator(scene.contact ?? 'open', contacts, 'contact'),
    solids_around_ends: scene.solidsAroundEnds === false ? 0 : 1,
    candidates: scene.candidates === false ? 0 : 1,
  });
}

export function visibility(module, scene) {
  return withScene(module, scene, [...countOptions, 'candidates', ...rayOptions], (sets, make, scratch) => {
    const {a, b, occluders} = sets;
    const misplaced = rayOptions.find((name) => scene[name] !== undefined);
    if (misplaced && scene.rays === undefined) throw new TypeError(`${misplaced} is of rays, and there are none`);
    if (scene.rays !== undefined && scene.candidates === false) throw new TypeError('rays need candidates');
    const answers = [a, b, occluders, sightOptions(scratch, scene)];
    const result = make('shaftcull_visibility_result_free', 'shaftcull_collect_visibility', ...answers);
    const [into, counts] = [scratch.struct('sight_batch'), scratch.struct('sight_counts')];
    module.call('shaftcull_visibility_result_describe', result, into, counts);
    const batch = module.read('sight_batch', into);
    const orderA = orderOf(module, scratch, a);
    const orderB = b === 0 ? orderA : orderOf(module, scratch, b);
    const triangles = trianglesOf(module, scratch, sets);
    const seen = new Visibility(module, batch, module.read('sight_counts', counts), orderA, orderB, triangles);
    if (scene.rays !== undefined) seen.fractions = fractionsOf(module, scratch, sets, batch.undecided, scene);
    return seen;
  });
}

/** The visible fraction of each undecided pair, by rays. */
function fractionsOf(module, scratch, {a, b, occluders}, undecided, scene) {
  const {rays, error = 0, seed = 1, tolerance = 0} = asOptions(scene);
  const {count} = module.read('undecided_pairs', undecided);
  const fractions = scratch.zeros(4 * count);
  const options = scratch.struct('ray_options', {rays, error, seed, tolerance});
  module.call('shaftcull_visible_fractions', a, b, occluders, undecided, options, fractions);
  return module.floats(fractions, count);
}

export function litFractions(module, scene) {
  const names = ['lights', 'findSolids', ...rayOptions, 'tolerance'];
  return withScene(module, scene, names, ({a, b, occluders}, make, scratch) => {
    if (b !== 0) throw new TypeError('lit fractions are those of one set: there is no second one');
    const lights = asFloats(scene.lights, 3, 'lights');
    const {rays = 64, error = 0, seed = 1, tolerance = 0} = asOptions(scene);
    const options = scratch.struct('ray_options', {rays, error, seed, tolerance});
    const {count} = scratch.described('patches_info', 'shaftcull_patches_describe', a);
    const fractions = scratch.zeros(4 * count * (lights.length / 3));
    const given = [scratch.copy(lights), BigInt(lights.length / 3)];
    module.call('shaftcull_lit_fractions', a, occluders, ...given, options, fractions);
    return module.floats(fractions, count * (lights.length / 3));
  });
}

export function countVisibility(module, scene) {
  return withScene(module, scene, countOptions, ({a, b, occluders}, make, scratch) =>
    scratch.described('sight_counts', 'shaftcull_visibility', a, b, occluders, sightOptions(scratch, scene), 0, 0));
}

class Visibility {
  constructor(module, batch, counts, orderA, orderB, triangles) {
    this.counts = counts;
    this.orderA = orderA;
    this.orderB = orderB;
    this.triangles = triangles;
    this.#readBlocks(module, batch.blocks, batch.block_count);
    this.#readUndecided(module, module.read('undecided_pairs', batch.undecided));
  }

  pairs(sight) {
    asEnumerator(sight, sightNames, 'sight');
    if (sight === 'undecided') return this.undecided.slice();
    const pairs = new Uint32Array(2 * this.counts[sight]);
    let at = 0;
    for (let p = 0; p !== this.sights.length; ++p) {
      if (this.sights[p] !== sight) continue;
      const [firstA, countA, firstB, countB] = this.blocks.subarray(4 * p, 4 * p + 4);
      for (let i = firstA; i !== firstA + countA; ++i) {
        for (let j = firstB; j !== firstB + countB; ++j) {
          pairs[at++] = this.orderA[i];
          pairs[at++] = this.orderB[j];
        }
      }
    }
    return pairs;
  }

  bits(sight) {
    asEnumerator(sight, sightNames, 'sight');
    const isOneSet = this.orderA === this.orderB;
    const rows = Array.from(this.orderA, () => new Uint32Array(Math.ceil(this.orderB.length / 32)));
    const set = (i, j) => (rows[i][j >> 5] |= 1 << (j & 31));
    const pairs = this.pairs(sight);
    for (let p = 0; p !== pairs.length; p += 2) {
      set(pairs[p], pairs[p + 1]);
      if (isOneSet) set(pairs[p + 1], pairs[p]);
    }
    return rows;
  }

  #readBlocks(module, blocks, count) {
    const words = module.words(blocks, blockWords * count);
    this.blocks = new Uint32Array(4 * count);
    this.sights = Array.from({length: count}, (_, p) => {
      this.blocks.set(words.subarray(blockWords * p, blockWords * p + 4), 4 * p);
      return sightNames[words[blockWords * p + 4]];
    });
  }

  #readUndecided(module, {pairs, count, first_candidate: offsets, candidates}) {
    this.undecided = module.words(pairs, 2 * count);
    this.offsets = offsets === 0 ? new Float64Array(count + 1) : module.numbers(offsets, count + 1);
    this.candidates = module.words(candidates, this.offsets[count]);
  }
}
