// SPDX-License-Identifier: MIT
// How much one patch receives of what another one radiates.
import {asFloats} from './arguments.js';

export function viewFactor(module, from, to) {
  const polygons = [asFloats(from, 3, 'from'), asFloats(to, 3, 'to')];
  return module.scratch((scratch) => {
    const factor = scratch.zeros(8);
    const given = polygons.flatMap((floats) => [scratch.copy(floats), BigInt(floats.length / 3)]);
    module.call('shaftcull_view_factor', ...given, factor);
    return module.double(factor);
  });
}
