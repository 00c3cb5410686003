// SPDX-License-Identifier: MIT
// How much patches receive of what others radiate.
import {asBoolean, asFloats, asNumber} from './arguments.js';
import {asOptions, defaultMemory, withScene} from './visibility.js';

export function viewFactor(module, from, to) {
  const polygons = [asFloats(from, 3, 'from'), asFloats(to, 3, 'to')];
  return module.scratch((scratch) => {
    const factor = scratch.zeros(8);
    const given = polygons.flatMap((floats) => [scratch.copy(floats), BigInt(floats.length / 3)]);
    module.call('shaftcull_view_factor', ...given, factor);
    return module.double(factor);
  });
}

const names = ['findSolids', 'tolerance', 'memory', 'part', 'parts', 'rays', 'error', 'seed', 'least', 'closeRows'];
const defaults = {memory: defaultMemory, seed: 1, error: 1e-5, least: 0, rays: 4096, parts: 1};

export function viewFactors(module, scene) {
  return withScene(module, scene, names, ({a, b, occluders}, make, scratch) => {
    if (b !== 0) throw new TypeError('view factors are those of one set: there is no second one');
    const given = {...defaults, ...asOptions(scene), close_rows: asBoolean(scene.closeRows ?? false, 'closeRows') ? 1 : 0};
    if (scene.least !== undefined) given.least = asNumber(scene.least, 'least');
    const options = scratch.struct('view_factor_options', given);
    const matrix = make('shaftcull_factor_matrix_free', 'shaftcull_view_factors', a, occluders, options);
    return new ViewFactors(module, scratch.described('factor_matrix_info', 'shaftcull_factor_matrix_describe', matrix));
  });
}

class ViewFactors {
  constructor(module, {size, factors, first, column, factor, area, sum, error, left_out: leftOut, counts}) {
    const ofRows = (pointer) => module.doubles(pointer, size);
    this.first = module.numbers(first, size + 1);
    this.column = module.words(column, factors);
    this.factor = module.doubles(factor, factors);
    [this.area, this.sum, this.error, this.leftOut] = [area, sum, error, leftOut].map(ofRows);
    this.counts = module.read('sight_counts', counts);
  }

  at(i, j) {
    const row = this.column.subarray(this.first[i], this.first[i + 1]);
    const k = row.indexOf(j);
    return k === -1 ? 0 : this.factor[this.first[i] + k];
  }
}
