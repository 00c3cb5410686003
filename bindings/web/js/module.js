// SPDX-License-Identifier: MIT
// The instance of WebAssembly: its memory, and calls of the C interface.
import {ShaftcullError, statusNames} from './error.js';
import {structsOf} from './structs.js';
import {wasi} from './wasi.js';

const maxBytes = 0xffff_ffff;  // malloc would take the rest of a division by one more

/** A position, or undefined where the C interface says SHAFTCULL_NONE. */
const positionIn = (number) => (BigInt.asIntN(64, number) === -1n ? undefined : Number(number));

/** What the library is called through. Pointers are numbers, and 64-bit integers BigInts. */
export class Module {
  #exports;
  #view;
  #system = wasi(() => this.view);
  #results = 0;
  #resultBytes = 0;
  #freed = new FinalizationRegistry(({release, handle}) => this.call(release, handle));

  static async of(compiled) {
    const module = new Module();
    const fail = (status, message, position) => module.#fail(status, message, position);
    const imports = {shaftcull: {fail}, wasi_snapshot_preview1: module.#system.imports};
    module.#exports = (await WebAssembly.instantiate(compiled, imports)).exports;
    module.#exports._initialize();
    module.structs = structsOf(module);
    return module;
  }

  /** All bytes of memory. Valid until the next call, which may move them. */
  get view() {
    const {buffer} = this.#exports.memory;
    if (this.#view?.buffer !== buffer) this.#view = new DataView(buffer);
    return this.#view;
  }

  /** Calls a function of the C interface, which throws what the library says. */
  call(name, ...values) {
    const stack = this.#exports.__stack_pointer.value;
    try {
      return this.#exports[name](...values);
    } catch (error) {
      this.#exports.__stack_pointer.value = stack;  // what was thrown through the module has left it where it was
      throw error instanceof WebAssembly.RuntimeError ? this.#trapped(error) : error;
    }
  }

  /** Calls use(scratch), whose memory is free afterwards. */
  scratch(use) {
    const pointers = [];
    try {
      return use(new Scratch(this, pointers));
    } finally {
      for (const pointer of pointers) this.#exports.free(pointer);
    }
  }

  allocate(bytes) {
    const pointer = bytes > maxBytes ? 0 : this.#exports.malloc(Math.max(bytes, 8));
    if (pointer === 0) throw new ShaftcullError('out of memory', `no memory is left for ${bytes} bytes more`);
    return pointer >>> 0;
  }

  /** Memory of so many bytes for results, the same each time: valid until the next call for it. */
  resultsOf(bytes) {
    if (bytes > this.#resultBytes) {
      const room = Math.max(2 * this.#resultBytes, bytes);
      this.#exports.free(this.#results);
      [this.#results, this.#resultBytes] = [0, 0];
      this.#results = this.allocate(room);
      this.#resultBytes = room;
    }
    return this.#results;
  }

  /** How many bytes of results there is memory for already. */
  get resultRoom() {
    return this.#resultBytes;
  }

  words(pointer, count) {
    return new Uint32Array(this.view.buffer, pointer, count).slice();
  }

  floats(pointer, count) {
    return new Float32Array(this.view.buffer, pointer, count).slice();
  }

  doubles(pointer, count) {
    return new Float64Array(this.view.buffer, pointer, count).slice();
  }

  /** Ids of bounds of a dynamic tree. */
  ids(pointer, count) {
    return new BigUint64Array(this.view.buffer, pointer, count).slice();
  }

  /** 64-bit numbers below 2⁵³. */
  numbers(pointer, count) {
    const words = new Uint32Array(this.view.buffer, pointer, 2 * count);
    return new Float64Array(count).map((_, i) => words[2 * i] + 0x1_0000_0000 * words[2 * i + 1]);
  }

  /** One of these that is a position, or undefined for none. */
  position(pointer) {
    return positionIn(this.view.getBigUint64(pointer, true));
  }

  number(pointer) {
    return Number(this.view.getBigUint64(pointer, true));
  }

  word(pointer) {
    return this.view.getUint32(pointer, true);
  }

  double(pointer) {
    return this.view.getFloat64(pointer, true);
  }

  /** The fields of a struct, by their names in C. */
  read(struct, pointer) {
    const {fields} = this.structs[struct];
    const values = {};
    for (const name in fields) values[name] = fields[name].read(this.view, pointer + fields[name].place);
    return values;
  }

  text(pointer) {
    const bytes = new Uint8Array(this.view.buffer, pointer);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }

  /** Has a handle released by a function of the C interface once its object is garbage. */
  watch(object, release, handle) {
    this.#freed.register(object, {release, handle}, object);
  }

  unwatch(object) {
    this.#freed.unregister(object);
  }

  #fail(status, message, position) {
    throw new ShaftcullError(statusNames[status], this.text(message), positionIn(position));
  }

  #trapped(error) {
    const said = this.#system.takeOutput().trim();
    if (said.includes('bad_alloc')) return new ShaftcullError('out of memory', 'memory ran out');
    return new ShaftcullError('internal error', said || error.message);
  }
}

/** Memory for the time of a call. */
class Scratch {
  #module;
  #pointers;

  constructor(module, pointers) {
    this.#module = module;
    this.#pointers = pointers;
  }

  /** Bytes that are 0. */
  zeros(bytes) {
    const pointer = this.#module.allocate(bytes);
    this.#pointers.push(pointer);
    new Uint8Array(this.#module.view.buffer, pointer, bytes).fill(0);
    return pointer;
  }

  /** A struct with these fields; the others are 0. */
  struct(struct, values = {}) {
    const {bytes, fields} = this.#module.structs[struct];
    const pointer = this.zeros(bytes);
    for (const name in values) fields[name].write(this.#module.view, pointer + fields[name].place, values[name]);
    return pointer;
  }

  /** The fields that a function of the C interface writes to a struct, its last argument. */
  described(struct, name, ...values) {
    const pointer = this.struct(struct);
    this.#module.call(name, ...values, pointer);
    return this.#module.read(struct, pointer);
  }

  /** A copy of a typed array. */
  copy(array) {
    const pointer = this.#module.allocate(array.byteLength);
    this.#pointers.push(pointer);
    new array.constructor(this.#module.view.buffer, pointer, array.length).set(array);
    return pointer;
  }
}
