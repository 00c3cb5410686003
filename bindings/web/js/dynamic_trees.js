// SPDX-License-Identifier: MIT
// Trees of bounds that come, go and move, and snapshots of them.
import {asFloats, asIds, asIndices, asNumber, checkOptions} from './arguments.js';
import {BoxBounds, describe, describeTree, SphereBounds} from './bounds.js';
import {made} from './held.js';
import {sourceOf} from './sources.js';

const idBytes = 8;

/** A state of a dynamic tree, which never changes. */
const asSnapshot = (Base) => class extends Base {
  get box() {
    return describe(this, ({box}) => this.module.floats(box, 6));
  }
};

const snapshots = {boxes: asSnapshot(BoxBounds), spheres: asSnapshot(SphereBounds)};

/** These under a dynamic tree. */
const asDynamic = (Base) => class extends asSnapshot(Base) {
  insert(values, layers) {
    const {module} = this;
    return module.scratch((scratch) => {
      const {pointer, count} = sourceOf(scratch, this.kind, values, this.kind);
      const all = layers === undefined ? undefined : asIndices(layers, 'layers');
      if (all !== undefined && all.length !== count) {
        throw new TypeError(`there are ${all.length} layers for ${count} ${this.kind}; there must be as many of both`);
      }
      const ids = scratch.zeros(idBytes * count);
      module.call('shaftcull_dynamic_tree_insert', this.handle, pointer, all === undefined ? 0 : scratch.copy(all), ids);
      return module.ids(ids, count);
    });
  }

  erase(ids) {
    const erase = (scratch, which, count) => this.module.call('shaftcull_dynamic_tree_erase', this.handle, which, count);
    this.#change(ids, erase);
  }

  move(ids, values) {
    this.#change(ids, (scratch, which, count) => {
      const {pointer} = sourceOf(scratch, this.kind, values, this.kind);
      this.module.call('shaftcull_dynamic_tree_move', this.handle, which, count, pointer, 0);
    });
  }

  moveBy(ids, displacements) {
    const by = asFloats(displacements, 3, 'displacements');
    this.#change(ids, (scratch, which, count) => {
      if (BigInt(by.length) !== 3n * count) {
        throw new TypeError(`there are ${by.length / 3} displacements for ${count} ids; there must be as many of both`);
      }
      this.module.call('shaftcull_dynamic_tree_move', this.handle, which, count, 0, scratch.copy(by));
    });
  }

  commit() {
    this.module.call('shaftcull_dynamic_tree_commit', this.handle);
    this.#measure();
  }

  rebuild() {
    this.module.call('shaftcull_tree_rebuild', this.handle);
    this.#measure();
  }

  snapshot() {
    return new snapshots[this.kind](this.module, made(this.module, 'shaftcull_bounds_copy', this.handle));
  }

  values(ids) {
    const floats = this.kind === 'boxes' ? 6 : 4;
    const {module} = this;
    return this.#change(ids, (scratch, which, count) => {
      const values = scratch.zeros(4 * floats * Number(count));
      module.call('shaftcull_dynamic_tree_read', this.handle, which, count, values);
      return module.floats(values, floats * Number(count));
    });
  }

  get upkeep() {
    const {sah_ratio, bound_count, blocks, waiting, sorted_last} = describeTree(this);
    return {boundCount: bound_count, blocks, sahRatio: sah_ratio, waiting, sortedLast: sorted_last};
  }

  /** use(scratch, pointer to ids, their number) */
  #change(ids, use) {
    const which = asIds(ids);
    return this.module.scratch((scratch) => use(scratch, scratch.copy(which), BigInt(which.length)));
  }

  #measure() {
    this.length = describe(this, ({count}) => count);
  }
};

const trees = {boxes: asDynamic(BoxBounds), spheres: asDynamic(SphereBounds)};
const constants = {boxes: 1, spheres: 2};

export function dynamicTreeOf(module, kind, options = {}) {
  checkOptions(options, ['sortedPerChange']);
  const sorted = asNumber(options.sortedPerChange ?? 2, 'sortedPerChange');
  return new trees[kind](module, made(module, 'shaftcull_dynamic_tree_create', constants[kind], sorted));
}
