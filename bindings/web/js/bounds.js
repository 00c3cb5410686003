// SPDX-License-Identifier: MIT
// Bounds in streams and trees, and queries about them.
import {asIndices, asInteger, checkOptions} from './arguments.js';
import {many, one} from './asked.js';
import {Held, made} from './held.js';
import {oneShaft} from './shafts.js';
import {boundsSource, kindName} from './sources.js';

/** The result of use(info), of a shaftcull_bounds_info. */
export const describe = ({module, handle}, use) =>
    module.scratch((scratch) => use(scratch.described('bounds_info', 'shaftcull_bounds_describe', handle)));

/** The fields of a shaftcull_tree_info. */
export const describeTree = ({module, handle}) =>
    module.scratch((scratch) => scratch.described('tree_info', 'shaftcull_tree_describe', handle));

/** Bounds of all kinds. */
class Bounds extends Held {
  constructor(module, handle) {
    super(module, 'shaftcull_bounds_free', handle);
    [this.length, this.kind] = describe(this, ({count, kind}) => [count, kindName(kind)]);
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

  copy() {
    return new this.constructor(this.module, made(this.module, 'shaftcull_bounds_copy', this.handle));
  }

  get memoryBytes() {
    return describe(this, (info) => info.memory_bytes);
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

/** These in a stream, which can be overwritten. */
const asStream = (Base) => class extends Base {
  update(values, options = {}) {
    checkOptions(options, this.kind === 'triangles' ? ['first', 'indices'] : ['first']);
    const first = asInteger(options.first ?? 0, 0, 'first');
    const {module} = this;
    module.scratch((scratch) => {
      const {pointer} = boundsSource(scratch, this.kind, values, options.indices);
      module.call('shaftcull_bounds_update', this.handle, BigInt(first), pointer);
    });
  }
};

/** These under a tree. */
const asTree = (Base) => class extends Base {
  get order() {
    return describe(this, ({order, count}) => this.module.words(order, count));
  }

  get box() {
    return describe(this, ({box}) => this.module.floats(box, 6));
  }
};

/** These under a tree, whose bounds may move. */
const asMovingTree = (Base) => class extends asTree(Base) {
  update(values, options = {}) {
    checkOptions(options, this.kind === 'triangles' ? ['indices'] : []);
    const {module} = this;
    module.scratch((scratch) => {
      const {pointer} = boundsSource(scratch, this.kind, values, options.indices);
      module.call('shaftcull_bounds_update', this.handle, 0n, pointer);
    });
  }

  updateSome(indices, values, options = {}) {
    checkOptions(options, this.kind === 'triangles' ? ['indices'] : []);
    const {module} = this;
    const which = asIndices(indices, 'indices');
    module.scratch((scratch) => {
      const {pointer} = boundsSource(scratch, this.kind, values, options.indices);
      const count = BigInt(which.length);
      module.call('shaftcull_tree_update_some', this.handle, scratch.copy(which), count, pointer);
    });
  }

  refit() {
    this.module.call('shaftcull_tree_refit', this.handle);
  }

  rebuild() {
    this.module.call('shaftcull_tree_rebuild', this.handle);
  }

  reorder() {
    this.module.call('shaftcull_tree_reorder', this.handle);
  }

  get needsRefit() {
    return describe(this, (info) => info.needs_refit === 1);
  }

  get sahRatio() {
    return describeTree(this).sah_ratio;
  }
};

const streams = {boxes: asStream(BoxBounds), spheres: asStream(SphereBounds), triangles: asStream(Bounds)};
const trees = {boxes: asMovingTree(BoxBounds), spheres: asMovingTree(SphereBounds), triangles: asMovingTree(Bounds)};

const created = (module, Class, create, ...values) => module.scratch(
    (scratch) => new Class(module, made(module, create, boundsSource(scratch, ...values).pointer)));

/** A stream of 'boxes', 'spheres' or 'triangles'. */
export const streamOf = (module, kind, values, indices) =>
    created(module, streams[kind], 'shaftcull_stream_create', kind, values, indices);

export const treeOf = (module, kind, values, indices) =>
    created(module, trees[kind], 'shaftcull_tree_create', kind, values, indices);
