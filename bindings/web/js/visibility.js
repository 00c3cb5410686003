// SPDX-License-Identifier: MIT
// Visibility: which pairs of patches see each other.
import {asEnumerator, asFloats, checkOptions} from './arguments.js';
import {withHandles} from './held.js';
import {contacts} from './shafts.js';
import {sourceOf} from './sources.js';

const sightNames = ['undecided', 'clear', 'occluded', 'facing_away'];
const names = ['patches', 'planes', 'patchesB', 'planesB', 'boxes', 'solids', 'triangles', 'contact'];
const productWords = 5;  // of shaftcull_pair_block

function patchesOf(scratch, make, boxes, planes, name) {
  const source = sourceOf(scratch, 'boxes', boxes, name);
  const floats = asFloats(planes ?? [], 4, 'planes');
  if (planes && floats.length !== 4 * source.count) {
    const count = floats.length / 4;
    throw new TypeError(`there are ${count} planes for ${source.count} ${name}; each has one, or there are none`);
  }
  return make('shaftcull_patches_free', 'shaftcull_patches_create', source.pointer, scratch.copy(floats),
                    BigInt(floats.length / 4));
}

function occludersOf(module, scratch, make, scene) {
  const occluders = make('shaftcull_occluders_free', 'shaftcull_occluders_create');
  const source = (kind, name) => sourceOf(scratch, kind, scene[name], name).pointer;
  if (scene.boxes) module.call('shaftcull_occluders_add_boxes', occluders, source('boxes', 'boxes'), 0);
  if (scene.solids) module.call('shaftcull_occluders_add_solids', occluders, source('boxes', 'solids'), 0);
  if (scene.triangles) {
    module.call('shaftcull_occluders_add_triangles', occluders, source('triangles', 'triangles'), 0, 0n, 0);
  }
  return occluders;
}

/** The triangles of the scene in each occluder: none in boxes, which come first, and those of a group in the others. */
function trianglesOf(module, scratch, occluders, boxes) {
  const none = new Uint32Array();
  return Array.from({length: Number(module.call('shaftcull_occluders_count', occluders))}, (_, occluder) => {
    if (occluder < boxes) return none;
    const info = scratch.described('occluder_info', 'shaftcull_occluders_describe', occluders, BigInt(occluder));
    return module.words(info.triangles, info.triangle_count);
  });
}

function orderOf(module, scratch, patches) {
  const {order, count} = scratch.described('patches_info', 'shaftcull_patches_describe', patches);
  return module.words(order, count);
}

export function visibility(module, scene) {
  checkOptions(scene, names);
  if (scene.planesB && !scene.patchesB) throw new TypeError('there are planesB, but no patchesB');
  const contact = asEnumerator(scene.contact ?? 'open', contacts, 'contact');
  return withHandles(module, (make) => module.scratch((scratch) => {
    const a = patchesOf(scratch, make, scene.patches, scene.planes, 'patches');
    const two = Boolean(scene.patchesB);
    const b = two ? patchesOf(scratch, make, scene.patchesB, scene.planesB, 'patchesB') : 0;
    const occluders = occludersOf(module, scratch, make, scene);
    const defaults = scratch.described('visibility_options', 'shaftcull_default_visibility_options');
    const options = scratch.struct('visibility_options', {...defaults, contact});
    const result = make('shaftcull_visibility_result_free', 'shaftcull_collect_visibility', a, b, occluders, options);
    const orderA = orderOf(module, scratch, a);
    const boxes = ((scene.boxes?.length ?? 0) + (scene.solids?.length ?? 0)) / 6;
    const orderB = two ? orderOf(module, scratch, b) : orderA;
    return new Visibility(module, scratch, result, orderA, orderB, trianglesOf(module, scratch, occluders, boxes));
  }));
}

class Visibility {
  constructor(module, scratch, result, orderA, orderB, triangles) {
    const [into, counts] = [scratch.struct('sight_batch'), scratch.struct('sight_counts')];
    module.call('shaftcull_visibility_result_describe', result, into, counts);
    const batch = module.read('sight_batch', into);
    this.counts = module.read('sight_counts', counts);
    this.orderA = orderA;
    this.orderB = orderB;
    this.triangles = triangles;
    this.#readProducts(module, batch.products, batch.product_count);
    this.#readUndecided(module, module.read('undecided_pairs', batch.undecided));
  }

  pairs(sight) {
    asEnumerator(sight, sightNames, 'sight');
    if (sight === 'undecided') return this.undecided.slice();
    const pairs = new Uint32Array(2 * this.counts[sight]);
    let at = 0;
    for (let p = 0; p !== this.sights.length; ++p) {
      if (this.sights[p] !== sight) continue;
      const [firstA, countA, firstB, countB] = this.products.subarray(4 * p, 4 * p + 4);
      for (let i = firstA; i !== firstA + countA; ++i) {
        for (let j = firstB; j !== firstB + countB; ++j) {
          pairs[at++] = this.orderA[i];
          pairs[at++] = this.orderB[j];
        }
      }
    }
    return pairs;
  }

  #readProducts(module, products, count) {
    const words = module.words(products, productWords * count);
    this.products = new Uint32Array(4 * count);
    this.sights = Array.from({length: count}, (_, p) => {
      this.products.set(words.subarray(productWords * p, productWords * p + 4), 4 * p);
      return sightNames[words[productWords * p + 4]];
    });
  }

  #readUndecided(module, {pairs, count, first_candidate: offsets, candidates}) {
    this.undecided = module.words(pairs, 2 * count);
    this.offsets = count === 0 ? new Float64Array(1) : module.numbers(offsets, count + 1);
    this.candidates = module.words(candidates, this.offsets[count]);
  }
}
