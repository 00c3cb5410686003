// SPDX-License-Identifier: MIT
// Hashes of answers to made-up questions, and those on record (docs/hashes.md).
import {checkOptions} from './arguments.js';

const hexadecimal = (hash) => BigInt.asUintN(64, hash).toString(16).padStart(16, '0');

/** Names and ways of all families. */
export function hashFamilies(module) {
  const families = [];
  for (let family = 0; family !== module.call('hash_families'); ++family) {
    const ways = [];
    for (let way = 0; way !== module.call('hash_ways', family); ++way) {
      ways.push(module.text(module.call('hash_way_name', family, way)));
    }
    families.push(Object.freeze({
      name: module.text(module.call('hash_family_name', family)),
      what: module.text(module.call('hash_family_what', family)),
      ways: Object.freeze(ways),
    }));
  }
  return Object.freeze(families);
}

export function hash(module, families, name, way, options = {}) {
  checkOptions(options, ['quick']);
  const family = families.findIndex((one) => one.name === name);
  if (family === -1) throw new TypeError(`there is no family '${name}'`);
  const position = families[family].ways.indexOf(way);
  if (position === -1) {
    throw new TypeError(`'${name}' is asked as '${families[family].ways.join("', '")}', not '${way}'`);
  }
  const quick = options.quick ? 1 : 0;
  return {
    hash: hexadecimal(module.call('hash_of', family, position, quick)),
    record: hexadecimal(module.call('hash_on_record', family, quick)),
  };
}
