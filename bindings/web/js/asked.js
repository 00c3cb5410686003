// SPDX-License-Identifier: MIT
// Queries about a range of shafts: a method per kind of result, for one shaft and for many.
import {checkOptions} from './arguments.js';
import {made, withHandles} from './held.js';
import {bitWords, optionsOfMany, optionsOfOne, queryOf} from './query.js';
import {allShafts, oneShaft} from './shafts.js';

const words32 = (bits) => Math.ceil(bits / 32);

/** Where parts of so many bytes begin. */
function begins(first, bytes, count) {
  const all = [];
  for (let i = 0; i !== count; ++i) all.push(first + i * bytes);
  return all;
}

/** Bounds, a range of shafts, and options. Each method makes the query of the C interface that has the given name. */
class Asked {
  #bounds;
  #module;
  #range;
  #count;
  #options;

  /** The range is the handle of an array of shafts, the first shaft and their number. */
  constructor(bounds, range, options) {
    this.#bounds = bounds;
    this.#module = bounds.module;
    this.#range = range;
    this.#count = Number(range[2]);
    this.#options = options;
  }

  /** For each output of the query an array of rows of bits, one bit per bound, one row per shaft. */
  rows(query, outputs) {
    const [module, {length}] = [this.#module, this.#bounds];
    const rowBytes = 4 * bitWords(length);
    const bytes = this.#count * rowBytes;
    const all = begins(module.resultsOf(outputs * bytes), bytes, outputs);
    this.#call(query, this.#range, ...all, BigInt(bytes / 8));
    return all.map((first) => begins(first, rowBytes, this.#count).map((row) => module.words(row, words32(length))));
  }

  /** One bit per shaft. */
  bits(query) {
    const bits = this.#module.resultsOf(4 * bitWords(this.#count));
    this.#call(query, this.#range, bits);
    return this.#module.words(bits, words32(this.#count));
  }

  /** `per` numbers per shaft. */
  numbers(query, per) {
    const numbers = this.#module.resultsOf(8 * per * this.#count);
    this.#call(query, this.#range, numbers);
    return this.#module.numbers(numbers, per * this.#count);
  }

  /** One contact per shaft, or undefined. */
  contacts(query) {
    const module = this.#module;
    const {bytes} = module.structs.contact_found;
    const contacts = module.resultsOf(bytes * this.#count);
    this.#call(query, this.#range, contacts);
    return begins(contacts, bytes, this.#count).map((contact) => {
      const {index, time, found, normal} = module.read('contact_found', contact);
      return found ? {index, time, normal: [...module.floats(normal, 3)]} : undefined;
    });
  }

  /** For each output of the query the lists of all shafts, and where each list begins. */
  lists(query, outputs) {
    const module = this.#module;
    return withHandles(module, (make) => module.scratch((scratch) => {
      const all = Array.from({length: outputs}, () => make('shaftcull_lists_free', 'shaftcull_lists_create'));
      this.#call(query, this.#range, ...all);
      return all.map((lists) => {
        const info = scratch.described('lists_info', 'shaftcull_lists_describe', lists);
        const offsets = module.numbers(info.offsets, info.count + 1);
        return {offsets, indices: module.words(info.indices, offsets[info.count])};
      });
    }));
  }

  /** For each output a list of the one shaft: into the memory that there is, and again if that was too little. */
  list(query, outputs) {
    const module = this.#module;
    for (let room = 1024;;) {
      room = Math.max(room, Math.floor((module.resultRoom / outputs - 8) / 4));
      const counts = module.resultsOf(outputs * (8 + 4 * room));
      const all = begins(counts + 8 * outputs, 4 * room, outputs);
      const places = [];
      for (const list of all) places.push(list, BigInt(room));
      this.#call(query, this.#one, ...places, counts);
      const found = all.map((_, i) => module.number(counts + 8 * i));
      const most = Math.max(...found);
      if (most <= room) return all.map((list, i) => module.words(list, found[i]));
      room = most;
    }
  }

  /** A position for the one shaft, or undefined. */
  position(query) {
    const position = this.#module.resultsOf(8);
    this.#call(query, this.#one, position);
    return this.#module.position(position);
  }

  /** The range of one shaft for calls that take no more. */
  get #one() {
    return this.#range.slice(0, 2);
  }

  #call(query, shafts, ...values) {
    const [module, bounds] = [this.#module, this.#bounds];
    module.scratch((scratch) => {
      const options = queryOf(scratch, this.#options, this.#count, bounds.length);
      module.call(query, ...shafts, bounds.handle, options, ...values);
    });
  }
}

/** A query about one shaft or hull. */
export function one(bounds, shaft, options = {}) {
  checkOptions(options, optionsOfOne);
  return new Asked(bounds, [...oneShaft(bounds.module, shaft, options.at), 1n], options);
}

/** A query about all shafts of an array. */
export function many(bounds, shafts, options = {}) {
  checkOptions(options, optionsOfMany);
  return new Asked(bounds, allShafts(bounds.module, shafts), options);
}
