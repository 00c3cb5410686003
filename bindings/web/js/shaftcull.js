// SPDX-License-Identifier: MIT
// The package's interface; shaftcull.d.ts says what each call does.
import * as bounds from './bounds.js';
import * as boxes from './boxes.js';
import {dynamicTreeOf} from './dynamic_trees.js';
import * as hashes from './hashes.js';
import {Module} from './module.js';
import {Origin} from './origin.js';
import * as shafts from './shafts.js';
import {viewFactor, viewFactors} from './view_factors.js';
import {countVisibility, litFractions, visibility} from './visibility.js';

export {ShaftcullError} from './error.js';

export async function load(wasm = new URL('shaftcull.wasm', import.meta.url)) {
  return new Shaftcull(await Module.of(await compiled(wasm)));
}

async function compiled(wasm) {
  if (wasm instanceof WebAssembly.Module) return wasm;
  if (wasm instanceof ArrayBuffer || ArrayBuffer.isView(wasm)) return WebAssembly.compile(wasm);
  if (typeof wasm !== 'string' && !(wasm instanceof URL)) {
    throw new TypeError('load() takes a WebAssembly.Module, its bytes, or where it is, as a text or a URL');
  }
  const url = new URL(wasm, globalThis.location?.href ?? `file://${process.cwd()}/`);
  if (url.protocol === 'file:' && typeof process === 'object') {
    const files = 'node:fs/promises';  // a name that is not known when the module is bundled for a browser
    return WebAssembly.compile(await (await import(files)).readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url} could not be fetched: ${response.status} ${response.statusText}`);
  return WebAssembly.compile(await response.arrayBuffer());
}

/** Methods that need only the module and their arguments. */
const methods = {
  origin: (module, at) => new Origin(module, at),
  boxAround: boxes.boxAround,
  translated: boxes.translated,
  inflated: boxes.inflated,
  inscribedBox: boxes.inscribedBox,
  viewFactor,
  mergedBoxes: boxes.mergedBoxes,
  viewPlanes: boxes.viewPlanes,
  boxStream: (module, values) => bounds.streamOf(module, 'boxes', values),
  boxTree: (module, values) => bounds.treeOf(module, 'boxes', values),
  sphereStream: (module, spheres) => bounds.streamOf(module, 'spheres', spheres),
  sphereTree: (module, spheres) => bounds.treeOf(module, 'spheres', spheres),
  triangleStream: (module, triangles, indices) => bounds.streamOf(module, 'triangles', triangles, indices),
  triangleTree: (module, triangles, indices) => bounds.treeOf(module, 'triangles', triangles, indices),
  dynamicBoxTree: (module, options) => dynamicTreeOf(module, 'boxes', options),
  dynamicSphereTree: (module, options) => dynamicTreeOf(module, 'spheres', options),
  between: shafts.between,
  swept: shafts.swept,
  sweptInfinite: shafts.sweptInfinite,
  shadow: shafts.shadow,
  concatenate: shafts.concatenate,
  hull: shafts.hull,
  betweenPolygons: shafts.betweenPolygons,
  frustum: shafts.frustum,
  casters: (module, view, light) => shafts.castersOf(module, 1, view, light, 'light'),
  castersTowards: (module, view, sun) => shafts.castersOf(module, 0, view, sun, 'sun'),
  visibility,
  viewFactors,
  litFractions,
  countVisibility,
};

class Shaftcull {
  #module;

  static {
    for (const [name, method] of Object.entries(methods)) {
      const value = function (...args) {
        return method(this.#module, ...args);
      };
      Object.defineProperty(this.prototype, name, {value, configurable: true, writable: true});
    }
  }

  constructor(module) {
    this.#module = module;
    const version = module.call('shaftcull_version');
    this.version = [version / 1000000, version / 1000 % 1000, version % 1000].map(Math.trunc).join('.');
    this.instructionSets = Object.freeze(instructionSets(module));
    this.hashFamilies = hashes.hashFamilies(module);
  }

  get instructionSet() {
    return isaName(this.#module, -1n);
  }

  set instructionSet(name) {
    const text = new TextEncoder().encode(`${name}\0    `);
    const module = this.#module;
    module.scratch((scratch) => {
      const pointer = scratch.zeros(text.length);
      new Uint8Array(module.view.buffer, pointer, text.length).set(text);
      module.call('shaftcull_select_isa', pointer);
    });
  }

  hash(family, way, options) {
    return hashes.hash(this.#module, this.hashFamilies, family, way, options);
  }
}

/** The name of the set at a position, or undefined beyond the last one; at −1 of the one in use. */
function isaName(module, position) {
  return module.scratch((scratch) => {
    const out = scratch.zeros(4);
    module.call('shaftcull_isa_name', position, out);
    const name = module.word(out);
    return name === 0 ? undefined : module.text(name);
  });
}

function instructionSets(module) {
  const names = [];
  for (;;) {
    const name = isaName(module, BigInt(names.length));
    if (name === undefined) return names;
    names.push(name);
  }
}
