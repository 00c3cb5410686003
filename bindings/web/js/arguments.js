// SPDX-License-Identifier: MIT
// What callers hand over, checked, as typed arrays.

/** Float32 values, `per` of them for each element. Nothing is rounded: a number that is no float32 is an error. */
export function asFloats(values, per, name) {
  const floats = values instanceof Float32Array ? values : exactFloats(values, name);
  if (floats.length % per !== 0) {
    throw new TypeError(`${name} has ${floats.length} floats, which is no multiple of ${per}`);
  }
  return floats;
}

/** Exactly `count` float32 values. */
export function asFloatsOf(values, count, name) {
  const floats = asFloats(values, 1, name);
  if (floats.length !== count) throw new TypeError(`${name} has ${floats.length} floats instead of ${count}`);
  return floats;
}

function exactFloats(values, name) {
  checkArray(values, name);
  return Float32Array.from(values, (value, i) => {
    if (typeof value !== 'number') throw new TypeError(`${name}[${i}] is no number`);
    if (!Object.is(Math.fround(value), value)) {
      throw new TypeError(`${name}[${i}] = ${value} is no float32; Math.fround() rounds a number to the nearest one, ` +
                          'origin().boxesAround() makes boxes that contain the given ones');
    }
    return value;
  });
}

/** Doubles, `per` of them for each element. */
export function asDoubles(values, per, name) {
  if (!(values instanceof Float64Array)) {
    checkArray(values, name);
    values = Float64Array.from(values, (value, i) => {
      if (typeof value !== 'number') throw new TypeError(`${name}[${i}] is no number`);
      return value;
    });
  }
  if (values.length % per !== 0) {
    throw new TypeError(`${name} has ${values.length} numbers, which is no multiple of ${per}`);
  }
  return values;
}

/** Integers from 0 to 2³² − 1. */
export function asIndices(values, name) {
  if (values instanceof Uint32Array) return values;
  checkArray(values, name);
  return Uint32Array.from(values, (value, i) => {
    if (!Number.isInteger(value) || value < 0 || value > 0xffff_ffff) {
      throw new TypeError(`${name}[${i}] = ${shown(value)} is no integer from 0 to 2^32 - 1`);
    }
    return value;
  });
}

/** Ids of bounds of a dynamic tree, as it returns them. */
export function asIds(values) {
  if (values instanceof BigUint64Array) return values;
  if (!Array.isArray(values)) throw new TypeError('ids is no BigUint64Array, and no array of bigints');
  return BigUint64Array.from(values, (value, i) => {
    if (typeof value !== 'bigint' || value < 0n || value >> 64n !== 0n) {
      throw new TypeError(`ids[${i}] = ${shown(value)} is no id of a bound: insert() returns them`);
    }
    return value;
  });
}

/** true or false. */
export function asBoolean(value, name) {
  if (typeof value !== 'boolean') throw new TypeError(`${name} = ${shown(value)} is neither true nor false`);
  return value;
}

/** A value as messages show it. JSON has no word for some. */
function shown(value) {
  if (typeof value === 'bigint') return `${value}n`;
  if (typeof value !== 'object' && typeof value !== 'string') return String(value);
  try {
    return JSON.stringify(value);
  } catch {
    return 'an object that JSON cannot write';
  }
}

function checkArray(values, name) {
  if (typeof values !== 'object' || values === null || !Number.isInteger(values.length) || values.length < 0) {
    throw new TypeError(`${name} is no array of numbers`);
  }
}

/** The position of a name among these. */
export function asEnumerator(value, names, name) {
  const position = names.indexOf(value);
  if (position === -1) throw new TypeError(`${name} is ${shown(value)}, not one of '${names.join("', '")}'`);
  return position;
}

const depths = ['zero_to_one', 'minus_one_to_one'];

/** The rows of a view-projection matrix that is given column after column, and which depths are in view. */
export function asView(matrix, depth) {
  const columns = asFloatsOf(matrix, 16, 'matrix');
  const rows = columns.map((_, i) => columns[4 * (i % 4) + Math.floor(i / 4)]);
  return {rows, range: asEnumerator(depth, depths, 'depth')};
}

/** An integer from 0 to before `end`. */
export function asPosition(value, end, name) {
  if (end === 0) throw new RangeError('there are no shafts to ask');
  if (!Number.isInteger(value) || value < 0 || value >= end) {
    throw new RangeError(`${name} = ${shown(value)} is no integer from 0 to ${end - 1}`);
  }
  return value;
}

/** A number. */
export function asNumber(value, name) {
  if (typeof value !== 'number') throw new TypeError(`${name} = ${shown(value)} is no number`);
  return value;
}

/** An integer from `least` to 2³² − 1. */
export function asInteger(value, least, name) {
  if (!Number.isInteger(value) || value < least || value > 0xffff_ffff) {
    throw new RangeError(`${name} = ${shown(value)} is no integer from ${least} to 2^32 - 1`);
  }
  return value;
}

/** Refuses options that are none, which may be misspelt. */
export function checkOptions(options, names) {
  if (typeof options !== 'object' || options === null) {
    throw new TypeError(`options are an object with some of '${names.join("', '")}', not ${shown(options)}`);
  }
  for (const name of Object.keys(options)) {
    if (!names.includes(name)) throw new TypeError(`there is no option '${name}'; there are '${names.join("', '")}'`);
  }
}
