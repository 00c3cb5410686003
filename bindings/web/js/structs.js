// SPDX-License-Identifier: MIT
// The structs of the C interface, by the names of their fields.

/** How fields are read and written, by their types in src/layout.cpp. */
const types = [
  {read: (view, at) => at},  // an array or a struct: its address
  {read: (view, at) => view.getUint32(at, true), write: (view, at, value) => view.setUint32(at, value, true)},
  {
    read: (view, at) => Number(view.getBigUint64(at, true)),
    write: (view, at, value) => view.setBigUint64(at, BigInt(value), true),
  },
  {read: (view, at) => view.getFloat32(at, true), write: (view, at, value) => view.setFloat32(at, value, true)},
  {read: (view, at) => view.getFloat64(at, true), write: (view, at, value) => view.setFloat64(at, value, true)},
];

/** The bytes of each struct, and for each of its fields the place, and how it is read and written. */
export function structsOf(module) {
  const structs = {};
  for (let entry = module.call('structs'); module.word(entry) !== 0; entry += 20) {
    const [struct, field, place, type, bytes] = module.words(entry, 5);
    const {fields} = (structs[module.text(struct)] ??= {bytes, fields: {}});
    fields[module.text(field)] = {place, ...types[type]};
  }
  return structs;
}
