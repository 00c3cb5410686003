// SPDX-License-Identifier: MIT
// Bounds in streams and trees, and queries about them.
import {asIndices, checkOptions} from './arguments.js';
import {many, one} from './asked.js';
import {Held, made} from './held.js';
import {oneShaft} from './shafts.js';
import {meshSource, sourceOf} from './sources.js';

/** Bounds of all kinds. */
export class Bounds extends Held {
  #kind;

  /** A kind is 'boxes', 'spheres' or 'triangles', a holder 'stream' or 'tree'. */
  constructor(module, kind, holder, values, indices) {
    let length = 0;
    super(module, 'shaftcull_bounds_free', module.scratch((scratch) => {
      const source = indices === undefined ? sourceOf(scratch, kind, values, kind)
        : meshSource(scratch, values, indices);
      length = source.count;
      return made(module, holder === 'tree' ? 'shaftcull_tree_create' : 'shaftcull_stream_create', source.pointer);
    }));
    this.length = length;
    this.#kind = kind;
  }

  cull(shaft, options) {
    return one(this, shaft, options).rows('shaftcull_cull', 1)[0][0];
  }

  cullMany(shafts, options) {
    return many(this, shafts, options).rows('shaftcull_cull', 1)[0];
  }

  classify(shaft, options) {
    const [[kept], [inside]] = one(this, shaft, options).rows('shaftcull_classify', 2);
    return {kept, inside};
  }

  classifyMany(shafts, options) {
    const [kept, inside] = many(this, shafts, options).rows('shaftcull_classify', 2);
    return {kept, inside};
  }

  count(shaft, options) {
    return one(this, shaft, options).numbers('shaftcull_count', 1)[0];
  }

  countMany(shafts, options) {
    return many(this, shafts, options).numbers('shaftcull_count', 1);
  }

  countClassified(shaft, options) {
    const [overlap, inside] = one(this, shaft, options).numbers('shaftcull_count_classified', 2);
    return {overlap, inside};
  }

  countClassifiedMany(shafts, options) {
    const pairs = many(this, shafts, options).numbers('shaftcull_count_classified', 2);
    return {overlap: pairs.filter((_, i) => i % 2 === 0), inside: pairs.filter((_, i) => i % 2 === 1)};
  }

  list(shaft, options) {
    return one(this, shaft, options).list('shaftcull_list', 1)[0];
  }

  listMany(shafts, options) {
    return many(this, shafts, options).lists('shaftcull_list_many', 1)[0];
  }

  listClassified(shaft, options) {
    const [overlap, inside] = one(this, shaft, options).list('shaftcull_list_classified', 2);
    return {overlap, inside};
  }

  listClassifiedMany(shafts, options) {
    const [overlap, inside] = many(this, shafts, options).lists('shaftcull_list_classified_many', 2);
    return {overlap, inside};
  }

  any(shaft, options) {
    return one(this, shaft, options).bits('shaftcull_any')[0] !== 0;
  }

  anyMany(shafts, options) {
    return many(this, shafts, options).bits('shaftcull_any');
  }

  setLayers(layers) {
    this.#putIntoLayers(undefined, asIndices(layers, 'layers'));
  }

  setLayersOf(indices, layers) {
    const [which, all] = [asIndices(indices, 'indices'), asIndices(layers, 'layers')];
    if (which.length !== all.length) {
      throw new TypeError(`there are ${all.length} layers for ${which.length} indices; there must be as many of both`);
    }
    this.#putIntoLayers(which, all);
  }

  clearLayers() {
    this.module.call('shaftcull_bounds_set_layers', this.handle, 0, 0, BigInt(this.length));
  }

  get kind() {
    return this.#kind;
  }

  #putIntoLayers(indices, layers) {
    const {module} = this;
    module.scratch((scratch) => {
      const which = indices === undefined ? 0 : scratch.copy(indices);
      module.call('shaftcull_bounds_set_layers', this.handle, which, scratch.copy(layers), BigInt(layers.length));
    });
  }
}

/** What spheres and boxes can be asked, too. */
export class SphereBounds extends Bounds {
  firstContact(shaft, options) {
    return one(this, shaft, options).contacts('shaftcull_first_contact')[0];
  }

  firstContactMany(shafts, options) {
    return many(this, shafts, options).contacts('shaftcull_first_contact');
  }

  entryTimes(shaft, indices, options = {}) {
    checkOptions(options, ['at']);
    const {module} = this;
    const which = asIndices(indices, 'indices');
    return module.scratch((scratch) => {
      const times = scratch.zeros(4 * which.length);
      const asked = oneShaft(module, shaft, options.at);
      module.call('shaftcull_entry_times', ...asked, this.handle, scratch.copy(which), times, BigInt(which.length));
      return module.floats(times, which.length);
    });
  }
}

/** What boxes can be asked, too, as solids. */
export class BoxBounds extends SphereBounds {
  occluded(shaft, options) {
    return one(this, shaft, options).bits('shaftcull_occluded')[0] !== 0;
  }

  occludedMany(shafts, options) {
    return many(this, shafts, options).bits('shaftcull_occluded');
  }

  findOccluder(shaft, options) {
    return one(this, shaft, options).position('shaftcull_find_occluder');
  }

  listOccluders(shaft, options) {
    return one(this, shaft, options).lists('shaftcull_list_occluders', 1)[0].indices;
  }

  listOccludersMany(shafts, options) {
    return many(this, shafts, options).lists('shaftcull_list_occluders', 1)[0];
  }
}

/** These under a tree, whose bounds may move. */
const asTree = (Base) => class extends Base {
  update(values) {
    const {module} = this;
    module.scratch((scratch) => {
      const source = sourceOf(scratch, this.kind, values, this.kind);
      module.call('shaftcull_bounds_update', this.handle, 0n, source.pointer);
    });
  }

  get sahRatio() {
    const {module} = this;
    const ratio = module.resultsOf(8);
    module.call('shaftcull_tree_sah_ratio', this.handle, ratio);
    return module.view.getFloat64(ratio, true);
  }

  rebuild() {
    this.module.call('shaftcull_tree_rebuild', this.handle);
  }
};

export const SphereTree = asTree(SphereBounds);
export const BoxTree = asTree(BoxBounds);
