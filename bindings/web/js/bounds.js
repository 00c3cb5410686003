// SPDX-License-Identifier: MIT
// Bounds in streams and trees, and queries about them.
import {asIndices, checkOptions} from './arguments.js';
import {Held, made} from './held.js';
import {optionsOfMany, optionsOfOne, queryOf, bitWords} from './query.js';
import {allShafts, Hull, oneShaft} from './shafts.js';
import {meshSource, sourceOf} from './sources.js';

const listsInfoBytes = 16;  // src/layout.cpp

/** Bounds of all kinds. */
export class Bounds extends Held {
  #kind;

  /** A kind is 'boxes', 'spheres' or 'triangles', a holder 'stream' or 'tree'. */
  constructor(module, kind, holder, values, indices) {
    let length = 0;
    super(module, 'shaftcull_bounds_free', module.scratch((scratch) => {
      const source = indices === undefined ? sourceOf(module, scratch, kind, values, kind) :
                                             meshSource(module, scratch, values, indices);
      length = source.count;
      return made(module, holder === 'tree' ? 'shaftcull_tree_create' : 'shaftcull_stream_create', source.pointer);
    }));
    this.length = length;
    this.#kind = kind;
  }

  cull(shaft, options = {}) {
    const {module} = this;
    const kept = module.resultsOf(4 * bitWords(this.length));
    this.askRange('shaftcull_cull', shaft, options, kept, BigInt(bitWords(this.length) / 2));
    return module.words(kept, Math.ceil(this.length / 32));
  }

  count(shaft, options = {}) {
    const count = this.module.resultsOf(8);
    this.askRange('shaftcull_count', shaft, options, count);
    return this.module.number(count);
  }

  any(shaft, options = {}) {
    const any = this.module.resultsOf(8);
    this.askRange('shaftcull_any', shaft, options, any);
    return this.module.word(any) !== 0;
  }

  /** A list: into the memory that there is, and again if that was too little. */
  list(shaft, options = {}) {
    const {module} = this;
    for (let room = 1024;;) {
      room = Math.max(room, module.resultRoom / 4 - 2);
      const count = module.resultsOf(8 + 4 * room);
      this.ask('shaftcull_list', shaft, options, count + 8, BigInt(room), count);
      const found = module.number(count);
      if (found <= room) return module.words(count + 8, found);
      room = found;
    }
  }

  classify(shaft, options = {}) {
    const {module} = this;
    const words = bitWords(this.length);
    const kept = module.resultsOf(8 * words);
    this.askRange('shaftcull_classify', shaft, options, kept, kept + 4 * words, BigInt(words / 2));
    const used = Math.ceil(this.length / 32);
    return {kept: module.words(kept, used), inside: module.words(kept + 4 * words, used)};
  }

  listClassified(shaft, options = {}) {
    const {module} = this;
    for (let room = 1024;;) {
      room = Math.max(room, Math.floor((module.resultRoom - 16) / 8));
      const counts = module.resultsOf(16 + 8 * room);
      const [overlap, inside] = [counts + 16, counts + 16 + 4 * room];
      this.ask('shaftcull_list_classified', shaft, options, overlap, BigInt(room), inside, BigInt(room), counts);
      const [overlaps, insides] = module.numbers(counts, 2);
      if (overlaps <= room && insides <= room) {
        return {overlap: module.words(overlap, overlaps), inside: module.words(inside, insides)};
      }
      room = Math.max(overlaps, insides);
    }
  }

  countMany(shafts, options = {}) {
    const {module} = this;
    allShafts(module, shafts);
    const counts = module.resultsOf(8 * shafts.length);
    this.askMany('shaftcull_count', shafts, options, counts);
    return module.numbers(counts, shafts.length);
  }

  listMany(shafts, options = {}) {
    allShafts(this.module, shafts);
    return this.lists((lists) => this.askMany('shaftcull_list_many', shafts, options, lists));
  }

  setLayers(layers) {
    const {module} = this;
    const all = asIndices(layers, 'layers');
    module.scratch((scratch) => {
      module.call('shaftcull_bounds_set_layers', this.handle, 0, scratch.copy(all), BigInt(all.length));
    });
  }

  setLayersOf(indices, layers) {
    const {module} = this;
    const [which, all] = [asIndices(indices, 'indices'), asIndices(layers, 'layers')];
    if (which.length !== all.length) {
      throw new TypeError(`there are ${all.length} layers for ${which.length} indices; there must be as many of both`);
    }
    module.scratch((scratch) => {
      module.call('shaftcull_bounds_set_layers', this.handle, scratch.copy(which), scratch.copy(all),
                  BigInt(all.length));
    });
  }

  clearLayers() {
    this.module.call('shaftcull_bounds_set_layers', this.handle, 0, 0, BigInt(this.length));
  }

  get kind() {
    return this.#kind;
  }

  /** Makes a query about one shaft, by its position; values are the arguments of the C interface behind the query. */
  ask(query, shaft, options, ...values) {
    this.#askOne(query, oneShaft(this.module, shaft, options.at), shaft, options, values);
  }

  /** The same by a range, which is that one shaft. */
  askRange(query, shaft, options, ...values) {
    this.#askOne(query, [...oneShaft(this.module, shaft, options.at), 1n], shaft, options, values);
  }

  #askOne(query, asked, shaft, options, values) {
    checkOptions(options, optionsOfOne);
    const {module} = this;
    const test = this.#kind === 'triangles' && shaft instanceof Hull ? 'vertices' : 'exact';
    module.scratch((scratch) => {
      module.call(query, ...asked, this.handle, queryOf(module, scratch, options, 1, this.length, test), ...values);
    });
  }

  /** The same about all shafts of an array. */
  askMany(query, shafts, options, ...values) {
    checkOptions(options, optionsOfMany);
    const {module} = this;
    module.scratch((scratch) => {
      const all = queryOf(module, scratch, options, shafts.length, this.length, 'exact');
      module.call(query, ...allShafts(module, shafts), this.handle, all, ...values);
    });
  }

  /** Lists that fill(lists) fills, and where each of them begins. */
  lists(fill) {
    const {module} = this;
    const lists = made(module, 'shaftcull_lists_create');
    try {
      fill(lists);
      return module.scratch((scratch) => {
        const info = scratch.zeros(listsInfoBytes);
        module.call('shaftcull_lists_describe', lists, info);
        const offsets = module.numbers(module.word(info + 8), module.number(info) + 1);
        return {offsets, indices: module.words(module.word(info + 12), offsets[offsets.length - 1])};
      });
    } finally {
      module.call('shaftcull_lists_free', lists);
    }
  }
}

/** What spheres and boxes can be asked, too. */
export class SphereBounds extends Bounds {
  firstContact(shaft, options = {}) {
    const {module} = this;
    const contact = module.resultsOf(16);
    this.askRange('shaftcull_first_contact', shaft, options, contact);
    if (module.word(contact + 12) === 0) return undefined;
    return {index: module.number(contact), time: module.view.getFloat32(contact + 8, true)};
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
  findOccluder(shaft, options = {}) {
    const index = this.module.resultsOf(8);
    this.ask('shaftcull_find_occluder', shaft, options, index);
    return this.module.position(index);
  }

  listOccluders(shaft, options = {}) {
    return this.lists((lists) => this.askRange('shaftcull_list_occluders', shaft, options, lists)).indices;
  }
}

/** These under a tree, whose bounds may move. */
const asTree = (Base) => class extends Base {
  update(values) {
    const {module} = this;
    module.scratch((scratch) => {
      const source = sourceOf(module, scratch, this.kind, values, this.kind);
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
