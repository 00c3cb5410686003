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

class Shaftcull {
  #module;

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

  origin(at) {
    return new Origin(this.#module, at);
  }

  boxAround(points) {
    return boxes.boxAround(this.#module, points);
  }

  translated(box, by) {
    return boxes.translated(this.#module, box, by);
  }

  inflated(box, by) {
    return boxes.inflated(this.#module, box, by);
  }

  inscribedBox(corners) {
    return boxes.inscribedBox(this.#module, corners);
  }

  viewFactor(from, to) {
    return viewFactor(this.#module, from, to);
  }

  mergedBoxes(solids) {
    return boxes.mergedBoxes(this.#module, solids);
  }

  viewPlanes(matrix, depth) {
    return boxes.viewPlanes(this.#module, matrix, depth);
  }

  boxStream(values) {
    return bounds.streamOf(this.#module, 'boxes', values);
  }

  boxTree(values) {
    return bounds.treeOf(this.#module, 'boxes', values);
  }

  sphereStream(spheres) {
    return bounds.streamOf(this.#module, 'spheres', spheres);
  }

  sphereTree(spheres) {
    return bounds.treeOf(this.#module, 'spheres', spheres);
  }

  triangleStream(triangles, indices) {
    return bounds.streamOf(this.#module, 'triangles', triangles, indices);
  }

  triangleTree(triangles, indices) {
    return bounds.treeOf(this.#module, 'triangles', triangles, indices);
  }

  dynamicBoxTree(options) {
    return dynamicTreeOf(this.#module, 'boxes', options);
  }

  dynamicSphereTree(options) {
    return dynamicTreeOf(this.#module, 'spheres', options);
  }

  between(a, b, options) {
    return shafts.between(this.#module, a, b, options);
  }

  swept(bodies, displacements, options) {
    return shafts.swept(this.#module, bodies, displacements, options);
  }

  sweptInfinite(bodies, directions, options) {
    return shafts.sweptInfinite(this.#module, bodies, directions, options);
  }

  shadow(lights, occluders, options) {
    return shafts.shadow(this.#module, lights, occluders, options);
  }

  concatenate(parts) {
    return shafts.concatenate(this.#module, parts);
  }

  hull(points, directions, options) {
    return shafts.hull(this.#module, points, directions, options);
  }

  betweenPolygons(p, q, options) {
    return shafts.betweenPolygons(this.#module, p, q, options);
  }

  frustum(matrix, depth, options) {
    return shafts.frustum(this.#module, matrix, depth, options);
  }

  casters(view, light) {
    return shafts.castersOf(this.#module, 1, view, light, 'light');
  }

  castersTowards(view, sun) {
    return shafts.castersOf(this.#module, 0, view, sun, 'sun');
  }

  visibility(scene) {
    return visibility(this.#module, scene);
  }

  viewFactors(scene) {
    return viewFactors(this.#module, scene);
  }

  litFractions(scene) {
    return litFractions(this.#module, scene);
  }

  countVisibility(scene) {
    return countVisibility(this.#module, scene);
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
