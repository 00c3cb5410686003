// SPDX-License-Identifier: MIT
// The package as a user has it. SHAFTCULL_PACKAGE names its folder.
import assert from 'node:assert/strict';
import {readFile, readdir} from 'node:fs/promises';
import {join, relative} from 'node:path';
import {cwd, env} from 'node:process';
import {before, describe, test} from 'node:test';
import {pathToFileURL} from 'node:url';

const folder = env.SHAFTCULL_PACKAGE;
const {load, ShaftcullError} = await import(pathToFileURL(join(folder, 'shaftcull.js')));

let shaftcull;
before(async () => {
  shaftcull = await load();
});

const lamp = [0, 9, 0, 1, 10, 1];
const table = [4, 0, 4, 6, 1, 6];
const scene = [2, 4, 2, 3, 5, 3, 8, 0, 0, 9, 3, 1, 4, -1, 4, 6, 0, 6];

/** Whole numbers, the same everywhere. */
function random(seed) {
  let state = seed;
  return (below) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 0x1_0000_0000) * below);
  };
}

function boxesOf(count, seed, space = 100, size = 6) {
  const below = random(seed);
  const boxes = new Float32Array(6 * count);
  for (let i = 0; i !== count; ++i) {
    for (let axis = 0; axis !== 3; ++axis) {
      boxes[6 * i + axis] = below(space);
      boxes[6 * i + 3 + axis] = boxes[6 * i + axis] + below(size);
    }
  }
  return boxes;
}

const upTo = (count) => Array.from({length: count}, (_, i) => i);
const positionsOf = (bits, count) => upTo(count).filter((i) => bits[i >> 5] >>> (i & 31) & 1);
const ascending = (indices) => Array.from(indices).sort((a, b) => a - b);

/** Arrays as an array: element i has an element of each under the same name. */
const zipped = (arrays) => Array.from(Object.values(arrays)[0], (_, i) => Object.fromEntries(
    Object.entries(arrays).map(([name, array]) => [name, array[i]])));
const listsOf = ({offsets, indices}) =>
    upTo(offsets.length - 1).map((s) => indices.slice(offsets[s], offsets[s + 1]));
const flagsOf = (bits, count) => upTo(count).map((i) => (bits[i >> 5] >>> (i & 31) & 1) === 1);

/** Options of a query about many shafts as those of the query about shaft `at`. */
function optionsAt(at, shafts, {excludeEach = [], layerMask, ...options}) {
  const perShaft = excludeEach.length / shafts.length;
  const row = Array.from(excludeEach).slice(at * perShaft, (at + 1) * perShaft);
  const one = {...options, at, exclude: [...options.exclude ?? [], ...row]};
  return layerMask === undefined ? one : {...one, layerMask: typeof layerMask === 'number' ? layerMask : layerMask[at]};
}

/** Queries about many shafts answer as those about one; `verbs` have the names of these. */
function agreesWithOne(holder, shafts, options, verbs, said) {
  const {length} = shafts;
  const asArray = {
    cull: (rows) => rows,
    classify: zipped,
    count: (counts) => [...counts],
    countClassified: zipped,
    list: listsOf,
    listClassified: ({overlap, inside}) => zipped({overlap: listsOf(overlap), inside: listsOf(inside)}),
    any: (bits) => flagsOf(bits, length),
    firstContact: (contacts) => contacts,
    occluded: (bits) => flagsOf(bits, length),
    listOccluders: listsOf,
  };
  for (const verb of verbs) {
    const one = upTo(length).map((at) => holder[verb](shafts, optionsAt(at, shafts, options)));
    assert.deepEqual(asArray[verb](holder[`${verb}Many`](shafts, options)), one, `${said}, ${verb}`);
  }
}

const ofAnyBounds = ['cull', 'classify', 'count', 'countClassified', 'list', 'listClassified', 'any'];
const withLimit = ['count', 'list'];

/** A box that moves by whole numbers, asked about another one: when they first touch, by fractions of whole numbers. */
function touches(body, by, box) {
  let [enter, leave] = [0, 1];
  for (let axis = 0; axis !== 3; ++axis) {
    const [gapLo, gapHi] = [box[axis] - body[3 + axis], box[3 + axis] - body[axis]];
    if (by[axis] === 0) {
      if (gapLo > 0 || gapHi < 0) return undefined;
      continue;
    }
    const times = [gapLo / by[axis], gapHi / by[axis]];
    enter = Math.max(enter, Math.min(...times));
    leave = Math.min(leave, Math.max(...times));
  }
  return enter <= leave ? enter : undefined;
}

describe('loading', () => {
  test('takes bytes, a compiled module and an address', async () => {
    const bytes = await readFile(join(folder, 'shaftcull.wasm'));
    const file = join(folder, 'shaftcull.wasm');
    for (const wasm of [bytes, await WebAssembly.compile(bytes), pathToFileURL(file), relative(cwd(), file)]) {
      const one = await load(wasm);
      assert.equal(one.boxTree(scene).count(one.between(lamp, table)), 2);
    }
  });

  test('says which version and which instruction sets there are', async () => {
    const {version} = JSON.parse(await readFile(join(folder, 'package.json')));
    assert.equal(shaftcull.version, version);
    assert.deepEqual(shaftcull.instructionSets, ['scalar', 'portable128']);
    assert.equal(shaftcull.instructionSet, 'portable128');
    shaftcull.instructionSet = 'scalar';
    assert.equal(shaftcull.instructionSet, 'scalar');
    shaftcull.instructionSet = 'portable128';
    const refusal = /avx2 is not available here; this machine has scalar, portable128/;
    assert.throws(() => (shaftcull.instructionSet = 'avx2'), refusal);
  });

  test('reaches every function of the C interface, except those that mean nothing here', async () => {
    const scripts = (await readdir(folder)).filter((name) => name.endsWith('.js'));
    const text = (await Promise.all(scripts.map((name) => readFile(join(folder, name), 'utf8')))).join('');
    const module = await WebAssembly.compile(await readFile(join(folder, 'shaftcull.wasm')));
    const names = WebAssembly.Module.exports(module).map(({name}) => name).filter((name) => /^shaftcull_/.test(name));
    assert.deepEqual(names.filter((name) => !new RegExp(`\\b${name}\\b`).test(text)).sort(), [
      'shaftcull_error_message', 'shaftcull_error_position', 'shaftcull_set_error_handler',
      'shaftcull_view_create', 'shaftcull_visibility_bits',
    ]);
  });
});

describe('bounds', () => {
  test('boxes in streams and trees are asked the same', () => {
    const shaft = shaftcull.between(lamp, table);
    for (const boxes of [shaftcull.boxStream(scene), shaftcull.boxTree(scene)]) {
      assert.equal(boxes.length, 3);
      assert.deepEqual(ascending(boxes.list(shaft)), [0, 2]);
      assert.deepEqual(positionsOf(boxes.cull(shaft), 3), [0, 2]);
      assert.equal(boxes.count(shaft), 2);
      assert.equal(boxes.any(shaft), true);
      const open = shaftcull.between(lamp, table, {contact: 'open'});
      assert.deepEqual(ascending(boxes.list(open)), [0]);
    }
  });

  test('all questions about many boxes agree', () => {
    const boxes = boxesOf(1000, 1);
    const ends = boxesOf(140, 2);
    const shafts = shaftcull.between(ends.subarray(0, 420), ends.subarray(420));
    for (const holder of [shaftcull.boxStream(boxes), shaftcull.boxTree(boxes)]) {
      const counts = holder.countMany(shafts);
      const {offsets, indices} = holder.listMany(shafts);
      for (let at = 0; at !== shafts.length; ++at) {
        const {overlap, inside} = holder.listClassified(shafts, {at});
        const bits = holder.classify(shafts, {at});
        const kept = ascending([...overlap, ...inside]);
        assert.equal(kept.length, counts[at]);
        assert.deepEqual(ascending(holder.list(shafts, {at})), kept);
        assert.deepEqual(ascending(indices.subarray(offsets[at], offsets[at + 1])), kept);
        assert.deepEqual(positionsOf(bits.kept, 1000), kept);
        assert.deepEqual(positionsOf(bits.inside, 1000), ascending(inside));
        assert.deepEqual(positionsOf(holder.cull(shafts, {at}), 1000), kept);
        assert.equal(holder.any(shafts, {at}), kept.length !== 0);
        const countsOfBoth = {overlap: overlap.length, inside: inside.length};
        assert.deepEqual(holder.countClassified(shafts, {at}), countsOfBoth);
      }
      agreesWithOne(holder, shafts, {}, ofAnyBounds, holder.kind);
    }
    assert(shaftcull.boxTree(boxes).countMany(shafts).some((count) => count > 0));
  });

  test('are asked about no shafts', () => {
    const none = shaftcull.between([], []);
    const lists = {offsets: Float64Array.of(0), indices: new Uint32Array()};
    for (const holder of [shaftcull.boxStream(scene), shaftcull.boxTree(scene)]) {
      assert.deepEqual(holder.cullMany(none), []);
      assert.deepEqual(holder.classifyMany(none), {kept: [], inside: []});
      assert.deepEqual(holder.countMany(none), new Float64Array());
      assert.deepEqual(holder.countClassifiedMany(none), {overlap: new Float64Array(), inside: new Float64Array()});
      assert.deepEqual(holder.listMany(none), lists);
      assert.deepEqual(holder.listClassifiedMany(none), {overlap: lists, inside: lists});
      assert.deepEqual(holder.anyMany(none), new Uint32Array());
      assert.deepEqual(holder.firstContactMany(none), []);
      assert.deepEqual(holder.occludedMany(none), new Uint32Array());
      assert.deepEqual(holder.listOccludersMany(none), lists);
    }
  });

  test('are none, and are asked about many shafts', () => {
    const shafts = shaftcull.between(lamp, scene);
    for (const holder of [shaftcull.boxStream([]), shaftcull.boxTree([]), shaftcull.triangleTree([])]) {
      agreesWithOne(holder, shafts, {}, ofAnyBounds, holder.kind);
      assert.deepEqual(holder.cullMany(shafts), [new Uint32Array(), new Uint32Array(), new Uint32Array()]);
    }
  });

  test('lists that are longer than the memory for them', () => {
    const boxes = boxesOf(200_000, 3);
    const everything = shaftcull.between([-1, -1, -1, -1, -1, -1], [200, 200, 200, 200, 200, 200]);
    const around = shaftcull.between([-1, -1, -1, 200, 200, 200], [-1, -1, -1, 200, 200, 200]);
    const tree = shaftcull.boxTree(boxes);
    assert.equal(tree.list(around).length, 200_000);
    assert.equal(tree.listClassified(around).inside.length, 200_000);
    assert.equal(tree.list(everything).length, tree.count(everything));
  });

  test('spheres', () => {
    const spheres = [2, 5, 2, 1, 20, 0, 0, 1];
    const shaft = shaftcull.between(lamp, table);
    for (const holder of [shaftcull.sphereStream(spheres), shaftcull.sphereTree(spheres)]) {
      assert.deepEqual([...holder.list(shaft)], [0]);
      assert.deepEqual(holder.listClassified(shaft), {overlap: Uint32Array.of(0), inside: new Uint32Array()});
    }
  });

  test('triangles, by vertices and by indices', () => {
    const shaft = shaftcull.between(lamp, table);
    const vertices = [2, 4, 2, 3, 5, 3, 2, 5, 3, 20, 0, 0, 21, 0, 0, 20, 1, 0];
    const indices = upTo(6);
    for (const holder of [shaftcull.triangleStream(vertices), shaftcull.triangleStream(vertices, indices),
                          shaftcull.triangleTree(vertices), shaftcull.triangleTree(vertices, indices)]) {
      assert.equal(holder.length, 2);
      assert.deepEqual([...holder.list(shaft)], [0]);
      assert.equal(holder.count(shaft), 1);
    }
    assert.throws(() => shaftcull.triangleTree(vertices, [0, 1, 6]), /6/);
  });

  test('triangles are tested exactly or by their vertices, and are inside or not', () => {
    const [a, b] = [[0, 0, 0, 1, 1, 1], [4, 0, 0, 5, 1, 1]];
    const near = [0, 0.5, 3, 0, 3, 0.5, 1, 3, 3];  // only the box around it meets the shaft
    const inside = [1, 0.25, 0.25, 2, 0.5, 0.25, 2, 0.25, 0.5];
    const across = [1, 0.5, 0.5, 2, 0.5, 0.5, 2, 7, 0.5];
    const triangles = [...near, ...inside, ...across];
    const shaft = shaftcull.between(a, b);
    const corners = upTo(8).flatMap((c) => [c & 1 ? 5 : 0, c >> 1 & 1, c >> 2]);
    const hull = shaftcull.hull(corners);
    const lists = (overlap, within) => ({overlap: Uint32Array.from(overlap), inside: Uint32Array.from(within)});
    const sorted = ({overlap, inside: within}) => lists(ascending(overlap), ascending(within));
    for (const holder of [shaftcull.triangleStream(triangles), shaftcull.triangleTree(triangles)]) {
      assert.deepEqual(sorted(holder.listClassified(shaft)), lists([2], [1]));
      assert.deepEqual(sorted(holder.listClassified(shaft, {triangleTest: 'exact'})), lists([2], [1]));
      assert.deepEqual(sorted(holder.listClassified(shaft, {triangleTest: 'vertices'})), lists([0, 2], [1]));
      assert.deepEqual(sorted(holder.listClassified(hull)), lists([2], [1]));
      assert.deepEqual(sorted(holder.listClassified(hull, {triangleTest: 'exact'})), lists([2], [1]));
      assert.deepEqual(sorted(holder.listClassified(hull, {triangleTest: 'vertices'})), lists([0, 2], [1]));
      assert.deepEqual([...holder.countMany(shaft)], [2]);
      assert.deepEqual([...holder.countMany(shaft, {triangleTest: 'vertices'})], [3]);
      const {kept, inside: within} = holder.classify(shaft);
      assert.deepEqual([positionsOf(kept, 3), positionsOf(within, 3)], [[1, 2], [1]]);
    }
  });

  test('trees are updated and rebuilt', () => {
    const boxes = boxesOf(500, 4);
    const tree = shaftcull.boxTree(boxes);
    assert.equal(tree.sahRatio, 1);
    const moved = boxesOf(500, 5);
    tree.update(moved);
    assert(tree.sahRatio > 1);
    const shaft = shaftcull.between([0, 0, 0, 9, 9, 9], [80, 80, 80, 99, 99, 99]);
    assert.deepEqual(ascending(tree.list(shaft)), [...shaftcull.boxStream(moved).list(shaft)]);
    tree.rebuild();
    assert.equal(tree.sahRatio, 1);
    assert.deepEqual(ascending(tree.list(shaft)), [...shaftcull.boxStream(moved).list(shaft)]);
    assert.throws(() => tree.update(boxesOf(499, 5)), ShaftcullError);
  });
});

describe('dynamic trees', () => {
  const all = () => shaftcull.between([-9, -9, -9, 200, 200, 200], [-9, -9, -9, 200, 200, 200]);
  const indexOf = (id) => Number(id & 0xffff_ffffn);

  test('show boxes that come, go and move after a commit', () => {
    const tree = shaftcull.dynamicBoxTree();
    const values = boxesOf(500, 41);
    const ids = tree.insert(values);
    assert.deepEqual([...ids].map(indexOf), Array.from({length: 500}, (_, i) => i));
    assert.deepEqual([tree.length, tree.count(all())], [0, 0]);
    tree.commit();
    assert.deepEqual([tree.length, tree.count(all()), tree.kind], [500, 500, 'boxes']);
    const stream = shaftcull.boxStream(values);
    const shaft = shaftcull.between(values.subarray(0, 6), values.subarray(60, 66));
    assert.deepEqual(ascending(tree.list(shaft)), [...stream.list(shaft)]);
    assert.deepEqual(tree.cull(shaft), stream.cull(shaft));
    assert.deepEqual([...tree.box], [...shaftcull.boxTree(values).box]);
    const before = tree.snapshot();
    tree.erase(ids.subarray(0, 100));
    tree.move(ids.subarray(100, 102), [0, 0, 0, 1, 1, 1, 5, 5, 5, 6, 6, 6]);
    tree.moveBy([ids[101]], [1, 0, 0]);
    assert.deepEqual([...tree.values([ids[101]])], [6, 5, 5, 7, 6, 6]);
    const [again] = tree.insert([1, 2, 3, 4, 5, 6]);
    assert(indexOf(again) < 100 && again !== ids[indexOf(again)]);
    assert.equal(tree.count(all()), 500);
    tree.commit();
    assert.deepEqual([tree.count(all()), before.count(all()), tree.length], [401, 500, 500]);
    assert.equal(tree.upkeep.boundCount, 401);
    assert(tree.upkeep.blocks >= 1 && tree.upkeep.sahRatio > 0);
    tree.rebuild();
    assert.equal(tree.upkeep.sahRatio, 1);
    assert.throws(() => tree.erase([ids[3]]), (error) => error instanceof ShaftcullError && /was erased/.test(error.message));
    assert.throws(() => tree.values([ids[3]]), /has no bound/);
    tree.free();
    assert.equal(before.copy().count(all()), 500);
  });

  test('are of spheres, in layers', () => {
    const tree = shaftcull.dynamicSphereTree({sortedPerChange: 0});
    const ids = tree.insert([1, 1, 1, 1, 5, 5, 5, 1, 9, 9, 9, 1], [1, 2, 4]);
    tree.commit();
    assert.deepEqual(ascending(tree.list(all(), {layerMask: 6})), [1, 2]);
    tree.setLayersOf([0], [2]);
    assert.deepEqual(ascending(tree.list(all(), {layerMask: 2})), [1]);
    tree.commit();
    assert.deepEqual(ascending(tree.list(all(), {layerMask: 2})), [0, 1]);
    const contact = tree.firstContact(shaftcull.swept([0, 4, 4, 0, 6, 6], [9, 0, 0]));
    assert.equal(contact.index, indexOf(ids[1]));
    assert.throws(() => tree.setLayers([1, 2, 3]), ShaftcullError);
  });

  test('refuse what is wrong, and stay as they were', () => {
    const tree = shaftcull.dynamicBoxTree();
    const ids = tree.insert(boxesOf(3, 42));
    tree.commit();
    assert.throws(() => tree.insert([0, 0, 0, 1, 1]), TypeError);
    assert.throws(() => tree.insert([1, 0, 0, 0, 1, 1]), ShaftcullError);
    assert.throws(() => tree.insert(boxesOf(2, 1), [1]), /1 layers for 2 boxes/);
    assert.throws(() => tree.moveBy(ids, [1, 0, 0]), /1 displacements for 3 ids/);
    assert.throws(() => tree.move(ids, boxesOf(2, 1)), ShaftcullError);
    assert.throws(() => tree.erase([1]), /ids\[0\] = 1 is no id/);
    assert.throws(() => tree.erase('all'), TypeError);
    assert.throws(() => tree.erase([ids[0], ids[0]]), /twice/);
    assert.throws(() => shaftcull.dynamicBoxTree({sortedPerChange: -1}), ShaftcullError);
    assert.throws(() => shaftcull.dynamicBoxTree({upkeep: 1}), /no option 'upkeep'/);
    tree.commit();
    assert.equal(tree.count(all()), 3);
  });
});

describe('bounds that change', () => {
  const everywhere = () => shaftcull.between([-9, -9, -9, -9, -9, -9], [200, 200, 200, 200, 200, 200]);
  const spheresOf = (count, seed) => boxesOf(count, seed).filter((_, i) => i % 6 < 4).map((x) => Math.abs(x));
  const trianglesOf = (count, seed) => Float32Array.from(
      {length: 9 * count}, (_, i) => boxesOf(count, seed)[6 * Math.floor(i / 9) + i % 3] + i % 4);

  test('trees of triangles are updated, and rebuilt', () => {
    const [values, moved] = [trianglesOf(300, 51), trianglesOf(300, 52)];
    const tree = shaftcull.triangleTree(values);
    const answer = () => ascending(tree.list(shaftcull.between([0, 0, 0, 9, 9, 9], [80, 80, 80, 99, 99, 99])));
    const of = (floats) => [...shaftcull.triangleStream(floats)
        .list(shaftcull.between([0, 0, 0, 9, 9, 9], [80, 80, 80, 99, 99, 99]))];
    tree.update(moved);
    assert.deepEqual(answer(), of(moved));
    tree.updateSome([7], values.subarray(63, 72));
    assert.equal(tree.needsRefit, true);
    assert.throws(answer, ShaftcullError);
    tree.refit();
    const now = Float32Array.from(moved);
    now.set(values.subarray(63, 72), 63);
    assert.deepEqual(answer(), of(now));
    tree.rebuild();
    assert.equal(tree.sahRatio, 1);
    assert.deepEqual(answer(), of(now));
    tree.update(now, {indices: Array.from({length: 900}, (_, i) => i)});
    assert.deepEqual(answer(), of(now));
    assert.throws(() => tree.update(now, {first: 1}), /no option 'first'/);
  });

  test('trees are updated by index, and refuse queries until they are refitted', () => {
    for (const [kind, of, floats] of [['box', boxesOf, 6], ['sphere', spheresOf, 4]]) {
      const [values, moved] = [of(500, 21), of(3, 22)];
      const tree = shaftcull[`${kind}Tree`](values);
      tree.updateSome([499, 7, 499], moved);
      assert.equal(tree.needsRefit, true);
      assert.throws(() => tree.count(everywhere()), (error) => error.status === 'needs refit');
      tree.refit();
      assert.equal(tree.needsRefit, false);
      values.set(moved.subarray(floats, 2 * floats), 7 * floats);
      values.set(moved.subarray(2 * floats), 499 * floats);
      const stream = shaftcull[`${kind}Stream`](values);
      const shafts = shaftcull.between(boxesOf(40, 23), boxesOf(40, 24));
      for (let at = 0; at !== 40; ++at) {
        assert.deepEqual(ascending(tree.list(shafts, {at})), [...stream.list(shafts, {at})]);
      }
      assert.throws(() => tree.updateSome([500], of(1, 22)), ShaftcullError);
      assert.throws(() => tree.updateSome([0, 1], of(1, 22)), ShaftcullError);
      assert.throws(() => tree.updateSome([-1], of(1, 22)), /indices\[0\] = -1 is no integer/);
      assert.equal(tree.needsRefit, false, 'nothing was changed');
    }
  });

  test('trees tell their order and box, and are reordered', () => {
    const boxes = boxesOf(300, 25);
    const tree = shaftcull.boxTree(boxes);
    const {order} = tree;
    assert.deepEqual(ascending(order), upTo(300));
    const before = tree.list(everywhere());
    assert.deepEqual(before, order.filter((i) => before.includes(i)), 'lists have the order of the tree');
    tree.reorder();
    assert.deepEqual([...tree.order], upTo(300));
    assert.deepEqual([...tree.list(everywhere())].map((i) => order[i]), [...before]);
    const around = upTo(6).map((c) => Math[c < 3 ? 'min' : 'max'](...boxes.filter((_, i) => i % 6 === c)));
    assert.deepEqual([...tree.box], around);
    const triangles = shaftcull.triangleTree(trianglesOf(70, 26));
    assert.deepEqual(ascending(triangles.order), upTo(70));
    assert(triangles.box.every((x) => Number.isFinite(x)));
    assert.deepEqual([...shaftcull.sphereTree([]).order], []);
  });

  test('streams are overwritten from any position on', () => {
    for (const [kind, of, floats] of [['box', boxesOf, 6], ['sphere', spheresOf, 4], ['triangle', trianglesOf, 9]]) {
      const [values, moved] = [of(50, 27), of(10, 28)];
      const stream = shaftcull[`${kind}Stream`](values);
      stream.update(moved, {first: 33});
      values.set(moved, 33 * floats);
      const shafts = shaftcull.between(boxesOf(40, 23), boxesOf(40, 24));
      const rebuilt = shaftcull[`${kind}Stream`](values);
      assert.deepEqual(stream.listMany(shafts), rebuilt.listMany(shafts));
      stream.update(of(50, 29));
      assert.deepEqual(stream.listMany(shafts), shaftcull[`${kind}Stream`](of(50, 29)).listMany(shafts));
      assert.throws(() => stream.update(moved, {first: 41}), ShaftcullError);
      assert.throws(() => stream.update(moved, {first: -1}), /first = -1 is no integer from 0/);
      assert.throws(() => stream.update(moved, {at: 1}), /no option 'at'/);
    }
    const mesh = shaftcull.triangleStream([2, 4, 2, 3, 5, 3, 2, 5, 3], [0, 1, 2, 2, 1, 0]);
    mesh.update([20, 0, 0, 21, 0, 0, 20, 1, 0], {first: 1, indices: [0, 1, 2]});
    assert.deepEqual([...mesh.list(shaftcull.between(lamp, table))], [0]);
    assert.throws(() => shaftcull.boxStream(scene).update(scene, {indices: [0]}), /no option 'indices'/);
  });

  test('copies are separate, layers included', () => {
    for (const make of ['boxStream', 'boxTree']) {
      const holder = shaftcull[make](scene);
      holder.setLayers([1, 2, 4]);
      const copy = holder.copy();
      assert.equal(copy.length, 3);
      assert.equal(copy.kind, 'boxes');
      assert(copy.memoryBytes >= 72 && copy.memoryBytes === holder.memoryBytes);
      holder.update([...lamp, ...lamp, ...lamp]);
      holder.free();
      assert.deepEqual([...copy.list(shaftcull.between(lamp, table), {layerMask: 6})], [2]);
    }
  });
});

describe('options', () => {
  const COUNT = 400;
  const LAST = 0x8000_0000;  // the last layer
  const layers = upTo(COUNT).map((i) => [1, 2, 4, LAST, 0][i % 5]);

  /** All kinds of bounds in all holders, by name. */
  function holders(seed) {
    const below = random(seed);
    const boxes = boxesOf(COUNT, seed);
    const spheres = Float32Array.from({length: 4 * COUNT}, (_, i) => below(i % 4 === 3 ? 6 : 100));
    const triangles = upTo(COUNT).flatMap(() => {
      const at = [below(100), below(100), below(100)];
      return [...at, ...at, ...at].map((x) => x + below(8));
    });
    return {
      boxStream: shaftcull.boxStream(boxes), boxTree: shaftcull.boxTree(boxes),
      sphereStream: shaftcull.sphereStream(spheres), sphereTree: shaftcull.sphereTree(spheres),
      triangleStream: shaftcull.triangleStream(triangles), triangleTree: shaftcull.triangleTree(triangles),
    };
  }

  /** Large shafts, which keep a part of the bounds each. */
  function manyShafts() {
    const a = [10, 10, 10, 40, 40, 40, 0, 60, 0, 30, 90, 30, 70, 0, 70, 99, 20, 99];
    const b = [60, 50, 40, 90, 80, 70, 50, 50, 50, 99, 99, 99, 20, 20, 20, 60, 60, 60];
    return shaftcull.between(a, b);
  }

  /** What options leave of a list, in the order that they give it. */
  function narrowed(whole, {exclude = [], excludeMask, layerMask, only, limit}) {
    const candidates = only ? only.filter((i) => whole.includes(i)) : whole;
    const isLeft = (i) => !exclude.includes(i) && (!excludeMask || (excludeMask[i >> 5] >>> (i & 31) & 1) === 0)
      && (layerMask === undefined || (layers[i] & layerMask) !== 0);
    return candidates.filter(isLeft).slice(0, limit);
  }

  /** Sets of options, none of which leaves all or nothing; `kept` is what the shaft keeps. */
  function optionSets(holder, hasLayers, kept) {
    const exclude = kept.filter((_, k) => k % 3 === 0);
    const excludeMask = holder.cull(shaftcull.between([0, 0, 0, 50, 50, 50], [50, 50, 0, 60, 60, 60]));
    const only = upTo(COUNT).filter((i) => i % 7 !== 0).reverse();
    const all = [{exclude}, {excludeMask}, {only}, {exclude, excludeMask, only}];
    if (hasLayers) all.push({layerMask: 2}, {layerMask: (LAST | 1) >>> 0}, {exclude, only, layerMask: LAST});
    return all;
  }

  /** Names, holders with layers, and whether they have them: trees of triangles do not. */
  function prepared(seed) {
    return Object.entries(holders(seed)).map(([name, holder]) => {
      const hasLayers = name !== 'triangleTree';
      if (hasLayers) holder.setLayers(layers);
      return [name, holder, hasLayers];
    });
  }

  test('narrow all questions about one shaft, of all bounds', () => {
    const shafts = manyShafts();
    for (const [name, holder, hasLayers] of prepared(11)) {
      for (let at = 0; at !== shafts.length; ++at) {
        const whole = [...holder.list(shafts, {at})];
        const wholeInside = [...holder.listClassified(shafts, {at}).inside];
        for (const options of optionSets(holder, hasLayers, whole)) {
          const said = `${name}, shaft ${at}, ${Object.keys(options)}`;
          const asked = {at, ...options};
          const left = narrowed(whole, options);
          assert(left.length > 2 && left.length < whole.length, `${said} are no question`);
          const inside = ascending(narrowed(wholeInside, options));
          assert.deepEqual([...holder.list(shafts, asked)], left, said);
          assert.equal(holder.count(shafts, asked), left.length, said);
          assert.equal(holder.any(shafts, asked), true, said);
          assert.deepEqual(positionsOf(holder.cull(shafts, asked), COUNT), ascending(left), said);
          const bits = holder.classify(shafts, asked);
          assert.deepEqual(positionsOf(bits.kept, COUNT), ascending(left), said);
          assert.deepEqual(positionsOf(bits.inside, COUNT), inside, said);
          const lists = holder.listClassified(shafts, asked);
          assert.deepEqual(ascending([...lists.overlap, ...lists.inside]), ascending(left), said);
          assert.deepEqual(ascending(lists.inside), inside, said);
          for (const limit of [1, 2, left.length, 4 * COUNT]) {
            assert.deepEqual([...holder.list(shafts, {...asked, limit})], left.slice(0, limit), said);
            assert.equal(holder.count(shafts, {...asked, limit}), Math.min(left.length, limit), said);
          }
        }
        assert.equal(holder.any(shafts, {at, exclude: whole}), false, name);
        assert.equal(holder.any(shafts, {at, only: []}), false, name);
        assert.deepEqual([...holder.list(shafts, {at, only: []})], [], name);
      }
    }
  });

  test('narrow all questions about many shafts, each by a row of its own', () => {
    const shafts = manyShafts();
    for (const [name, holder, hasLayers] of prepared(12)) {
      const whole = upTo(shafts.length).map((at) => [...holder.list(shafts, {at})]);
      const rows = whole.map((kept) => kept.slice(-4));
      const masks = [1, LAST, 6];
      const sets = optionSets(holder, hasLayers, whole[0]).flatMap((options) => [options, {...options, limit: 2}]);
      sets.push({excludeEach: rows.flat()}, {exclude: [0, 1, 2], excludeEach: Uint32Array.from(rows.flat()), limit: 3});
      if (hasLayers) sets.push({layerMask: masks}, {layerMask: Uint32Array.from(masks), limit: 1});
      for (const options of sets) {
        const said = `${name}, ${Object.keys(options)}`;
        const left = whole.map((kept, s) => {
          const exclude = [...options.exclude ?? [], ...options.excludeEach ? rows[s] : []];
          const layerMask = typeof options.layerMask === 'object' ? options.layerMask[s] : options.layerMask;
          return narrowed(kept, {...options, exclude, layerMask});
        });
        assert.deepEqual([...holder.countMany(shafts, options)], left.map((list) => list.length), said);
        const {offsets, indices} = holder.listMany(shafts, options);
        assert.deepEqual(left.map((_, s) => [...indices.subarray(offsets[s], offsets[s + 1])]), left, said);
        agreesWithOne(holder, shafts, options, options.limit === undefined ? ofAnyBounds : withLimit, said);
      }
    }
  });

  test('leave out what a moving box would reach first', () => {
    const shaft = shaftcull.swept([0, 0, 0, 30, 30, 30], [70, 70, 70]);
    for (const [name, holder, hasLayers] of prepared(13).filter(([one]) => !one.startsWith('triangle'))) {
      const whole = [...holder.list(shaft)];
      const first = [holder.firstContact(shaft).index];
      for (const options of [{exclude: first}, ...optionSets(holder, hasLayers, whole)]) {
        const left = narrowed(whole, options);
        const times = holder.entryTimes(shaft, left);
        const {index, time} = holder.firstContact(shaft, options);
        const said = `${name}, ${Object.keys(options)}`;
        assert.equal(time, Math.min(...times), said);
        assert.equal(times[left.indexOf(index)], time, said);
      }
      assert.equal(holder.firstContact(shaft, {exclude: whole}), undefined, name);
      const bodies = [0, 0, 0, 30, 30, 30, 90, 90, 90, 91, 91, 91, 200, 0, 0, 201, 1, 1];
      const shafts = shaftcull.swept(bodies, [70, 70, 70, -90, -90, -90, 1, 0, 0]);
      const sets = [{}, {exclude: whole}, {excludeEach: [first[0], 1, 2]}, ...optionSets(holder, hasLayers, whole)];
      if (hasLayers) sets.push({layerMask: [1, LAST, 6]});
      for (const options of sets) agreesWithOne(holder, shafts, options, ['firstContact'], name);
      assert.equal(holder.firstContactMany(shafts)[2], undefined, name);
    }
  });

  test('skip what a moving box overlaps at the start', () => {
    const boxes = [-9, -1, -9, 9, 0, 9, 0.5, 0.5, 0, 2, 2, 2, 1, 0, 0, 2, 1, 1, 4, 0, 0, 5, 1, 1];
    const ends = [[0, 0, 0, 1, 1, 1], [8, 0, 0, 9, 1, 1]];
    const [closed, open] = [{}, {contact: 'open'}].map((options) => shaftcull.between(...ends, options));
    const skip = {skipOverlapping: true};
    for (const holder of [shaftcull.boxStream(boxes), shaftcull.boxTree(boxes)]) {
      assert.deepEqual(holder.firstContact(closed), {index: 0, time: 0, normal: [0, 0, 0]});
      assert.deepEqual(holder.firstContact(closed, {skipOverlapping: false}), {index: 0, time: 0, normal: [0, 0, 0]});
      const far = {index: 3, time: 0.375, normal: [-1, 0, 0]};
      assert.deepEqual(holder.firstContact(closed, skip), far);
      assert.deepEqual(holder.firstContactMany(closed, skip), [far]);
      assert.deepEqual(holder.firstContact(open), {index: 1, time: 0, normal: [0, 0, 0]});
      assert.deepEqual(holder.firstContact(open, skip), {index: 2, time: 0, normal: [-1, 0, 0]});
      assert.throws(() => holder.firstContact(closed, {skipOverlapping: 1}), /skipOverlapping = 1 is neither/);
      assert.throws(() => holder.count(closed, skip), /skip_overlapping means nothing to count/);
    }
    const spheres = shaftcull.sphereTree([2, 0.5, 0.5, 1, 6, 0.5, 0.5, 1]);  // the first touches the start
    assert.equal(spheres.firstContact(closed, skip).index, 1);
    assert.equal(spheres.firstContact(open, skip).index, 0);
  });

  test('leave out what would block', () => {
    const wall = (x) => [x, -9, -9, x + 1, 9, 9];
    const shaft = shaftcull.between([0, 0, 0, 1, 1, 1], [9, 0, 0, 10, 1, 1]);
    const solids = [...wall(2), ...wall(4), 6, 5, 5, 7, 6, 6, ...wall(7)];
    for (const holder of [shaftcull.boxStream(solids), shaftcull.boxTree(solids)]) {
      const whole = [...holder.listOccluders(shaft)];
      assert.deepEqual(ascending(whole), [0, 1, 3]);
      assert.deepEqual([...holder.listOccluders(shaft, {limit: 2})], whole.slice(0, 2));
      assert.deepEqual(ascending(holder.listOccluders(shaft, {exclude: [0, 2]})), [1, 3]);
      assert.deepEqual(ascending(holder.listOccluders(shaft, {excludeMask: [0b1010]})), [0]);
      assert.equal(holder.findOccluder(shaft, {exclude: [1, 3]}), 0);
      assert.equal(holder.findOccluder(shaft, {exclude: [0, 1, 3]}), undefined);
      holder.setLayers([1, 2, 2, 4]);
      assert.equal(holder.findOccluder(shaft, {layerMask: 4}), 3);
      assert.deepEqual(ascending(holder.listOccluders(shaft, {layerMask: 6})), [1, 3]);
      const ends = upTo(70).flatMap((i) => [8 - i % 9, 0, 0, 9 - i % 9, 1, 1]);
      const shafts = shaftcull.between([0, 0, 0, 1, 1, 1], ends);
      const sets = [{}, {exclude: [1]}, {excludeMask: [0b1010]}, {excludeEach: upTo(70).map((i) => i % 4)},
                    {layerMask: 6}, {layerMask: upTo(70).map((i) => i % 8)}];
      for (const options of sets) {
        const said = Object.keys(options).join();
        agreesWithOne(holder, shafts, options, ['occluded', 'listOccluders'], said);
        const isFound = upTo(70).map((at) => holder.findOccluder(shafts, optionsAt(at, shafts, options)) !== undefined);
        assert.deepEqual(flagsOf(holder.occludedMany(shafts, options), 70), isFound, said);
        assert(isFound.includes(true) && isFound.includes(false), said);
      }
      agreesWithOne(holder, shafts, {limit: 1}, ['listOccluders'], 'limit');
    }
  });

  test('that name layers need some, which are set, changed and cleared', () => {
    const around = shaftcull.between([-1, -1, -1, 200, 200, 200], [-1, -1, -1, 200, 200, 200]);
    for (const [name, holder] of Object.entries(holders(14))) {
      assert.throws(() => holder.count(around, {layerMask: 1}), /layer_mask/, name);
      if (name === 'triangleTree') {
        assert.throws(() => holder.setLayers(layers), ShaftcullError);
        continue;
      }
      assert.throws(() => holder.setLayersOf([0], [1]), ShaftcullError, name);
      assert.throws(() => holder.setLayers(layers.slice(1)), ShaftcullError, name);
      holder.setLayers(layers);
      assert.equal(holder.count(around, {layerMask: 0}), 0, name);
      assert.deepEqual(ascending(holder.list(around, {layerMask: 4})), upTo(COUNT).filter((i) => i % 5 === 2), name);
      holder.setLayersOf([0, 399, 0], [LAST, 8, 8]);
      assert.deepEqual(ascending(holder.list(around, {layerMask: 8})), [0, 399], name);
      assert.throws(() => holder.setLayersOf([400], [1]), ShaftcullError, name);
      assert.throws(() => holder.setLayersOf([0, 1], [1]), /1 layers for 2 indices/, name);
      holder.setLayers(Uint32Array.from(layers));
      assert.equal(holder.count(around, {layerMask: 8}), 0, name);
      holder.clearLayers();
      assert.throws(() => holder.count(around, {layerMask: 1}), /layer_mask/, name);
      assert.equal(holder.count(around), COUNT, name);
    }
  });

  test('that mean nothing are refused, by their name', () => {
    const shafts = shaftcull.between([...lamp, ...lamp], [...table, ...table]);
    for (const holder of [shaftcull.boxStream(scene), shaftcull.boxTree(scene)]) {
      for (const question of ['cull', 'classify', 'any', 'listClassified', 'firstContact', 'findOccluder']) {
        assert.throws(() => holder[question](shafts, {limit: 1}), /limit/, question);
      }
      for (const question of ['countClassified', 'cullMany', 'classifyMany', 'countClassifiedMany', 'anyMany',
                              'listClassifiedMany', 'firstContactMany', 'occluded', 'occludedMany']) {
        assert.throws(() => holder[question](shafts, {limit: 1}), /limit/, question);
      }
      for (const question of ['findOccluder', 'listOccluders', 'occluded', 'occludedMany', 'listOccludersMany']) {
        assert.throws(() => holder[question](shafts, {only: [0]}), /only/, question);
      }
      for (const [options, message] of [
        [{triangleTest: 'vertices'}, /triangle_test/], [{exclude: [0, 3]}, /exclude.*3/], [{only: [3]}, /only.*3/],
        [{excludeEach: [0, 3]}, /exclude_each.*3/], [{excludeEach: [0, 1, 2]}, /exclude_each.*3/],
      ]) {
        assert.throws(() => holder.countMany(shafts, options), (error) => {
          assert(error instanceof ShaftcullError);
          assert.match(error.message, message);
          return true;
        });
      }
      assert.deepEqual([...holder.countMany(shafts)], [2, 2], 'and goes on');
    }
  });

  test('may be large, so that memory grows while they are copied', async () => {
    const one = await load();
    const [tree, shaft] = [one.boxTree(scene), one.between(lamp, table)];
    assert.deepEqual([...tree.list(shaft, {exclude: new Uint32Array(4_000_000)})], [2]);
  });
});

describe('shafts', () => {
  test('are between pairs, or of one box and many', () => {
    const tree = shaftcull.boxTree(scene);
    const pairs = shaftcull.between(scene, [...lamp, ...table], {pairs: [0, 1, 1, 1, 2, 0]});
    const ofScene = (i) => scene.slice(6 * i, 6 * i + 6);
    const one = [table, table, lamp].map((end, i) => tree.count(shaftcull.between(ofScene(i), end)));
    assert.deepEqual([...tree.countMany(pairs)], one);
    const fan = shaftcull.between(lamp, scene);
    assert.equal(fan.length, 3);
    assert.equal(tree.count(fan, {at: 2}), tree.count(shaftcull.between(lamp, scene.slice(12))));
    assert.throws(() => shaftcull.between(scene, [...lamp, ...table]), /3 of a and 2 of b/);
    assert.equal(shaftcull.between([], lamp).length, 0);
  });

  test('are cut by planes', () => {
    const tree = shaftcull.boxTree(scene);
    assert.deepEqual([...tree.list(shaftcull.between(lamp, table, {planes: [0, 1, 0, 2]}))], [2]);
    const swept = shaftcull.swept([...lamp, ...lamp], [4, -9, 4], {planes: [0, -1, 0, -1, 0, 1, 0, 20]});
    assert.deepEqual([...tree.countMany(swept)], [1, 1]);
  });

  test('are cut by planes of their boxes', () => {
    const below = random(41);
    const [a, b, bodies] = [boxesOf(6, 42), boxesOf(6, 43), boxesOf(6, 44)];
    const planesOf = (count) => Float32Array.from(
        {length: 4 * count}, (_, i) => (i % 4 < 3 ? below(9) - 4.5 : below(400)));
    const [planes, ofA, ofB] = [planesOf(1), planesOf(12), planesOf(6)];
    const tree = shaftcull.boxTree(boxesOf(400, 45, 100, 20));
    const pairs = [0, 5, 2, 2, 5, 1];
    const part = (floats, i, per) => floats.subarray(i * per, (i + 1) * per);
    const one = (i, j) => [...planes, ...part(ofA, i, 8), ...part(ofB, j, 4)];
    for (const contact of ['closed', 'open']) {
      const shafts = shaftcull.between(a, b, {pairs, contact, planes, planesA: ofA, planesB: ofB});
      const alike = upTo(3).map((s) => {
        const [i, j] = pairs.slice(2 * s);
        return shaftcull.between(part(a, i, 6), part(b, j, 6), {contact, planes: one(i, j)});
      });
      assert.deepEqual(listsOf(tree.listMany(shafts)), alike.map((shaft) => tree.list(shaft)));
    }
    const fan = shaftcull.between(a.subarray(0, 6), b, {planesA: part(ofA, 0, 8), planesB: ofB});
    const rays = upTo(6).map((j) => shaftcull.between(part(a, 0, 6), part(b, j, 6), {planes: one(0, j).slice(4)}));
    assert.deepEqual(listsOf(tree.listMany(fan)), rays.map((shaft) => tree.list(shaft)));
    assert(tree.countMany(fan).some((count) => count > 0));
    assert.notDeepEqual(tree.countMany(fan), tree.countMany(shaftcull.between(a.subarray(0, 6), b)));
    const swept = shaftcull.swept(bodies, [9, 9, 30], {planes, planesBodies: ofB});
    const moves = upTo(6).map((i) => shaftcull.swept(part(bodies, i, 6), [9, 9, 30], {
      planes: [...planes, ...part(ofB, i, 4)],
    }));
    assert.deepEqual(listsOf(tree.listMany(swept)), moves.map((shaft) => tree.list(shaft)));
    const lights = Float32Array.from(boxesOf(6, 46), (x) => x - 500);
    const shadows = shaftcull.shadow(lights, b, {planesLights: ofA, planesOccluders: ofB});
    const cast = upTo(6).map((i) => shaftcull.shadow(part(lights, i, 6), part(b, i, 6), {planes: one(i, i).slice(4)}));
    assert.deepEqual(listsOf(tree.listMany(shadows)), cast.map((shaft) => tree.list(shaft)));
    assert.throws(() => shaftcull.between(a, b, {planesB: planesOf(7)}), /planesB has 7 planes for 6 boxes/);
    assert.equal(shaftcull.between([], lamp, {planesB: planes}).length, 0);
  });

  test('have joining planes that no point of their boxes is outside of', () => {
    const planes = shaftcull.between(lamp, table).joiningPlanes();
    assert.equal(planes.length, 24);
    for (let i = 0; i !== 6; ++i) {
      const [x, y, z, offset] = planes.subarray(4 * i, 4 * i + 4);
      const most = (box) => x * box[x > 0 ? 3 : 0] + y * box[y > 0 ? 4 : 1] + z * box[z > 0 ? 5 : 2];
      assert(Math.max(most(lamp), most(table)) <= offset + 1e-5);
      assert(Math.abs(most(lamp) - most(table)) < 1e-5, 'it joins the two');
    }
    const both = shaftcull.between(lamp, [...scene.slice(0, 6), ...table]);
    assert.deepEqual(both.joiningPlanes({at: 1}), planes);
    assert.notDeepEqual(both.joiningPlanes(), planes);
    assert.throws(() => shaftcull.swept(lamp, [1, 0, 0]).joiningPlanes(), /between two boxes/);
  });

  test('are described, and answer the same whether they are completed or not', () => {
    const shafts = shaftcull.between(lamp, [...table, ...scene.slice(0, 6)]);
    const described = {a: Float32Array.from(lamp), b: Float32Array.from(table), contact: 'closed',
                       hasPlanes: false, isHull: false};
    assert.deepEqual(shafts.describe(), described);
    const streams = [shaftcull.boxStream(boxesOf(500, 31, 12)), shaftcull.sphereStream([2, 5, 2, 1, 20, 0, 0, 1])];
    const answers = () => streams.map((stream) => stream.listClassifiedMany(shafts));
    const before = answers();
    shafts.complete();
    const second = {...described, b: Float32Array.from(scene.slice(0, 6)), hasPlanes: true};
    assert.deepEqual(shafts.describe({at: 1}), second);
    assert.deepEqual(answers(), before);
    shafts.setContact('open');
    assert.equal(shafts.describe().contact, 'open');
    const open = shaftcull.between(lamp, [...table, ...scene.slice(0, 6)], {contact: 'open'});
    assert.deepEqual(answers(), streams.map((stream) => stream.listClassifiedMany(open)));
    assert.notDeepEqual(answers(), before);
    shafts.setContact('closed');
    assert.deepEqual(answers(), before);
  });

  test('are concatenated with hulls, and asked at once', () => {
    const [a, b] = [shaftcull.between(lamp, [...table, ...lamp]), shaftcull.swept(table, [0, 9, 0])];
    const hull = shaftcull.hull([-5, -5, -5, 9, -5, -5, 0, 9, -5, 0, 0, 9]);
    const all = shaftcull.concatenate([a, hull, b]);
    assert.equal(all.length, 4);
    assert.deepEqual(upTo(4).map((at) => all.describe({at}).isHull), [false, false, true, false]);
    const tree = shaftcull.boxTree(boxesOf(300, 32, 12));
    const apart = [[a, 0], [a, 1], [hull, 0], [b, 0]].map(([shaft, at]) => tree.list(shaft, {at}));
    for (const shafts of [a, b, hull]) shafts.free();
    assert.deepEqual(listsOf(tree.listMany(all)), apart);
    assert(apart.some((list) => list.length > 0));
    const triangles = shaftcull.triangleStream([2, 4, 2, 3, 5, 3, 2, 5, 3]);
    assert.equal(triangles.countMany(all).length, 4);
    assert.equal(triangles.countMany(all, {triangleTest: 'vertices'}).length, 4);
    assert.throws(() => all.joiningPlanes(), /between two boxes/);
    all.setContact('open');
    listsOf(tree.listMany(all)).forEach((list, i) => assert(list.length <= apart[i].length));
    const between = shaftcull.between(lamp, table);
    assert.equal(shaftcull.concatenate([between, between]).joiningPlanes({at: 1}).length, 24);
    assert.equal(shaftcull.concatenate([]).length, 0);
  });

  test('of moving boxes find what they touch, and when', () => {
    const boxes = boxesOf(600, 6);
    const below = random(7);
    for (const tree of [shaftcull.boxTree(boxes), shaftcull.boxStream(boxes)]) {
      for (let i = 0; i !== 30; ++i) {
        const body = [below(100), below(100), below(100)];
        body.push(...body.map((lo) => lo + below(5)));
        const by = [below(80) - 40, below(80) - 40, below(80) - 40];
        const times = Array.from({length: 600}, (_, k) => touches(body, by, boxes.subarray(6 * k, 6 * k + 6)));
        const kept = times.flatMap((time, k) => (time === undefined ? [] : [k]));
        const shaft = shaftcull.swept(body, by);
        assert.deepEqual(ascending(tree.list(shaft)), kept);
        const entries = tree.entryTimes(shaft, Uint32Array.from(times.keys()));
        times.forEach((time, k) => {
          const entry = entries[k];
          const isRight = time === undefined ? entry === Infinity : entry <= time && time - entry < 1e-6 * time + 1e-30;
          assert(isRight, `${entry}, ${time}`);
        });
        const first = tree.firstContact(shaft);
        assert.equal(first?.time, kept.length === 0 ? undefined : Math.min(...entries));
        if (first) assert.equal(entries[first.index], first.time);
      }
    }
  });

  test('without end, and shadows', () => {
    const tree = shaftcull.boxTree([50, 0, 0, 51, 1, 1, -50, 0, 0, -49, 1, 1]);
    assert.deepEqual([...tree.list(shaftcull.sweptInfinite([0, 0, 0, 1, 1, 1], [1, 0, 0]))], [0]);
    const [light, occluder] = [[-10, 0.5, 0.5, -10, 0.5, 0.5], [0, 0, 0, 1, 1, 1]];
    assert.deepEqual([...tree.list(shaftcull.shadow(light, occluder))], [0]);
    assert.deepEqual([...tree.list(shaftcull.shadow(light, occluder, {reach: 2}))], []);
    assert.deepEqual([...tree.list(shaftcull.shadow(light, occluder, {reach: 8, contact: 'open'}))], [0]);
  });

  test('answer for one bound as for bounds in streams', () => {
    const boxes = boxesOf(200, 8);
    const spheres = Float32Array.from({length: 4 * 200}, (_, i) => boxes[6 * (i >> 2) + i % 4] % (i % 4 < 3 ? 100 : 6));
    const triangles = Float32Array.from({length: 9 * 200}, (_, i) => boxes[6 * Math.floor(i / 9) + i % 3] + i % 5);
    const [a, b] = [[10, 10, 10, 50, 50, 50], [60, 50, 40, 95, 90, 80]];
    const shafts = shaftcull.between([...lamp, ...a], [...table, ...b]);
    const cornersOf = (box) => upTo(8).flatMap((c) => [box[c & 1 ? 3 : 0], box[c & 2 ? 4 : 1], box[c & 4 ? 5 : 2]]);
    const hull = shaftcull.hull([...cornersOf(a), ...cornersOf(b)]);
    for (const [holder, values, tests] of [
      [shaftcull.boxStream(boxes), boxes, [undefined]],
      [shaftcull.sphereStream(spheres), spheres, [undefined]],
      [shaftcull.triangleStream(triangles), triangles, [undefined, 'exact', 'vertices']],
    ]) {
      const floats = values.length / 200;
      for (const [volume, at, triangleTest] of [
        ...tests.flatMap((each) => [[shafts, 0, each], [shafts, 1, each], [hull, 0, each]]),
      ]) {
        const options = {at, triangleTest};
        const {kept, inside} = holder.classify(volume, options);
        const answers = upTo(200).map((i) => volume.classify(values.subarray(floats * i, floats * (i + 1)), options));
        const flags = {kept: flagsOf(kept, 200), inside: flagsOf(inside, 200)};
        const expected = zipped(flags).map((one) => (one.inside ? 'inside' : one.kept ? 'overlap' : 'outside'));
        assert.deepEqual(answers, expected, `${holder.kind}, ${triangleTest}`);
        const keeps = upTo(200).map((i) => volume.keeps(values.subarray(floats * i, floats * (i + 1)), options));
        assert.deepEqual(keeps, flags.kept, `${holder.kind}, ${triangleTest}`);
        if (at === 1) assert.equal(new Set(answers).size, 3, `${holder.kind}: all answers come up`);
      }
    }
    assert.equal(shafts.classify(scene.slice(0, 6)), 'overlap', 'the first shaft is asked by default');
    assert.throws(() => shafts.classify(lamp, {triangleTest: 'vertices'}), ShaftcullError);
  });

  test('are occluded by one box or polygon', () => {
    const [end, far] = [[0, 0, 0, 1, 1, 1], [8, 0, 0, 9, 1, 1]];
    const shafts = shaftcull.between(end, [...far, 8, 50, 0, 9, 51, 1]);
    const solids = [[3, -9, -9, 4, 9, 9], [3, 0, 0, 4, 0.5, 1], [5, -20, -20, 6, 20, 20], [5, -20, -20, 6, 90, 20]];
    for (const solid of solids) {
      for (const at of [0, 1]) {
        const expected = shaftcull.boxStream(solid).occluded(shafts, {at});
        assert.equal(shafts.occludedByBox(solid, {at}), expected, `${solid}, ${at}`);
        const [, y, z, x, top, back] = solid;
        const polygon = [x, y, z, x, top, z, x, top, back, x, y, back];
        assert.equal(shafts.occludedByPolygon(polygon, {at}), expected, `${solid}, ${at}`);
      }
    }
    assert.deepEqual(solids.map((solid) => shafts.occludedByBox(solid)), [true, false, true, true]);
    const swept = shaftcull.swept(end, [9, 0, 0]);
    for (const refused of [() => swept.occludedByBox(solids[0]), () => shafts.occludedByPolygon([1, 2, 3, 4, 5, 6]),
                           () => shafts.occludedByPolygon([1, 2, 3, 4, 5, NaN, 7, 8, 9]),
                           () => swept.occludedByPolygon([1, 2, 3, 4, 5, 6, 7, 8, 0])]) {
      assert.throws(refused, ShaftcullError);
    }
  });

  test('are occluded by solids', () => {
    const wall = [3, -9, -9, 4, 9, 9];
    const solids = [...wall, 3, 0, 0, 4, 0.5, 1, 5, -20, -20, 6, 20, 20];
    const shaft = shaftcull.between([0, 0, 0, 1, 1, 1], [8, 0, 0, 9, 1, 1]);
    for (const holder of [shaftcull.boxStream(solids), shaftcull.boxTree(solids)]) {
      assert.deepEqual(ascending(holder.listOccluders(shaft)), [0, 2]);
      assert.equal(typeof holder.findOccluder(shaft), 'number');
    }
    assert.equal(shaftcull.boxTree(scene).findOccluder(shaftcull.between(lamp, table)), undefined);
  });
});

describe('boxes and planes', () => {
  test('are made of points, boxes and hulls', () => {
    assert.deepEqual([...shaftcull.boxAround([1, 2, 3, 0, 5, 1])], [0, 2, 1, 1, 5, 3]);
    assert.deepEqual([...shaftcull.boxAround([])], [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity]);
    assert.deepEqual([...shaftcull.translated(lamp, [1, 2, 3])], [1, 11, 3, 2, 12, 4]);
    assert.deepEqual([...shaftcull.inflated(lamp, 0.5)], [-0.5, 8.5, -0.5, 1.5, 10.5, 1.5]);
    const corners = upTo(8).flatMap((c) => [c & 1, c >> 1 & 1, c >> 2]);
    assert.deepEqual([...shaftcull.inscribedBox(corners)], [0, 0, 0, 1, 1, 1]);
    const [floor, ceiling] = [[0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0], [0, 0, 1, 0, 1, 1, 1, 1, 1, 1, 0, 1]];
    assert(Math.abs(shaftcull.viewFactor(floor, ceiling) - 0.199824895698) < 1e-11);
    assert.throws(() => shaftcull.viewFactor(floor, [0, 0, 0]), /1 corner/);
    const small = 2 ** -149;
    assert(shaftcull.translated(lamp, [small, 0, 0])[3] > 1, 'rounded outwards');
    for (const refused of [() => shaftcull.boxAround([NaN, 0, 0]), () => shaftcull.inflated(lamp, -1),
                           () => shaftcull.translated(lamp, [Infinity, 0, 0]),
                           () => shaftcull.inscribedBox([0, 0, 0])]) {
      assert.throws(refused, ShaftcullError);
    }
    assert.throws(() => shaftcull.inflated(lamp, 0.1), /by\[0\] = 0\.1 is no float32/);
  });

  test('are joined to larger boxes, of which there may be more', () => {
    assert.deepEqual([...shaftcull.mergedBoxes([0, 0, 0, 1, 1, 1, 1, 0, 0, 2, 1, 1])], [0, 0, 0, 2, 1, 1]);
    assert.deepEqual([...shaftcull.mergedBoxes([])], []);
    const cells = upTo(216).map((i) => [i % 6, Math.floor(i / 6) % 6, Math.floor(i / 36)]).filter(([x, y, z]) => {
      const sum = x + y + z;
      return sum >= 6 && sum < 9;
    });
    const merged = shaftcull.mergedBoxes(cells.flatMap(([x, y, z]) => [x, y, z, x + 1, y + 1, z + 1]));
    assert(merged.length / 6 > cells.length);
    const volume = (box) => upTo(3).reduce((product, k) => product * (box[3 + k] - box[k]), 1);
    assert(upTo(merged.length / 6).some((i) => volume(merged.subarray(6 * i, 6 * i + 6)) > 1));
    assert.throws(() => shaftcull.mergedBoxes([...lamp, 1, 0, 0, 0, 1, 1]), (error) => error.position === 1);
  });

  test('of a view cut shafts to it', () => {
    const matrix = [0.125, 0, 0, 0, 0, 0.125, 0, 0, 0, 0, -0.125, 0, 0, 0, 0, 1];  // 8 to each side
    const planes = shaftcull.viewPlanes(matrix, 'minus_one_to_one');
    assert.equal(planes.length, 24);
    const [end, far] = [[-50, 0, 0, -49, 1, 1], [49, 0, 0, 50, 1, 1]];
    const tree = shaftcull.boxTree([0, 0, 0, 1, 1, 1, 20, 0, 0, 21, 1, 1, 8, 0, 0, 9, 1, 1]);
    assert.deepEqual(ascending(tree.list(shaftcull.between(end, far, {planes}))), [0, 2]);
    assert.deepEqual([...tree.list(shaftcull.between(end, far, {planes, contact: 'open'}))], [0], 'both in one call');
    matrix[12] = -2;  // column after column: x from 8 to 24
    const right = shaftcull.between(end, far, {planes: shaftcull.viewPlanes(matrix, 'minus_one_to_one')});
    assert.deepEqual(ascending(tree.list(right)), [1, 2]);
    assert.throws(() => shaftcull.viewPlanes(new Float32Array(16).fill(NaN), 'zero_to_one'), ShaftcullError);
  });
});

describe('hulls', () => {
  const orthographic = [0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, -0.1, 0, 0, 0, 0, 1];  // 10 to each side


  test('go wherever a shaft goes', () => {
    const tree = shaftcull.boxTree([0, 0, 0, 1, 1, 1, 20, 0, 0, 21, 1, 1]);
    const hull = shaftcull.hull([-5, -5, -5, 5, -5, -5, 0, 5, -5, 0, 0, 9]);
    assert.deepEqual([...tree.list(hull)], [0]);
    assert.deepEqual(hull.points, Float32Array.of(-5, -5, -5, 5, -5, -5, 0, 5, -5, 0, 0, 9));
    assert.deepEqual([...tree.list(shaftcull.hull([0, 0, 0], [1, 0, 0]))].sort(), [0, 1]);
    assert.throws(() => tree.firstContact(hull), ShaftcullError);
    hull.points.fill(0);
    assert.equal(hull.points[0], -5, 'points are copies');
    const open = shaftcull.concatenate([hull]);
    open.setContact('open');
    const below = [-9, -9, -9, 9, 9, -5];
    assert.deepEqual([hull.keeps(below), open.keeps(below), open.describe().contact], [true, false, 'open']);
    const triangles = [0, 0, 0, 1, 0, 0, 0, 1, 0, 20, 0, 0, 21, 0, 0, 20, 1, 0];
    for (const holder of [shaftcull.triangleStream(triangles), shaftcull.triangleTree(triangles)]) {
      assert.deepEqual([...holder.list(hull)], [0]);
      assert.equal(holder.count(hull), 1);
    }
  });

  test('of two polygons are asked what is between them and what hides one from the other', () => {
    const p = [0, 0, 0, 0, 2, 0, 0, 2, 2];
    const between = shaftcull.betweenPolygons(p, [9, 0, 0, 9, 2, 0, 9, 2, 2]);
    assert.equal(between.points.length, 18);
    const walls = shaftcull.boxTree([4, -9, -9, 5, 9, 9, 4, 1, 1, 5, 9, 9, 40, -9, -9, 41, 9, 9]);
    assert.deepEqual(ascending(walls.list(between)), [0, 1]);
    assert.equal(walls.occluded(between), true);
    const shaft = shaftcull.concatenate([between]);
    assert.equal(shaft.occludedByPolygon([4, -9, -9, 5, 9, -9, 5, 9, 9, 4, -9, 9]), true);
    assert.equal(shaft.occludedByPolygon([4, 1, 1, 5, 9, 1, 5, 9, 9]), false);
    assert.throws(() => walls.occluded(shaftcull.hull(p)), ShaftcullError);
    assert.throws(() => shaftcull.betweenPolygons([], p), /p has no corner/);
  });

  test('that are conservative keep boxes that no single face leaves out', () => {
    const corners = [0, 0, 0, 8, 2, 1, 1, 9, 3, 2, 1, 7];
    const tree = shaftcull.boxTree([-1, 10, 4, 3, 11, 6, 2, 2, 2, 3, 3, 3, 20, 0, 0, 21, 1, 1]);
    assert.deepEqual([...tree.list(shaftcull.hull(corners))], [1]);
    assert.deepEqual(ascending(tree.list(shaftcull.hull(corners, [], {test: 'conservative'}))), [0, 1]);
  });

  test('are views, and what casts shadows into them', () => {
    const tree = shaftcull.boxTree([0, 0, 0, 1, 1, 1, 0, 30, 0, 1, 31, 1, 0, -30, 0, 1, -29, 1]);
    const view = shaftcull.frustum(new Float32Array(orthographic), 'minus_one_to_one');
    assert.deepEqual([...tree.list(view)], [0]);
    assert.deepEqual(ascending(tree.list(shaftcull.castersTowards(view, [0, 1, 0]))), [0, 1]);
    assert.deepEqual(ascending(tree.list(shaftcull.casters(view, [0, 40, 0]))), [0, 1]);
    // Column after column: what is moved by 30 upwards is the box of index 1.
    const moved = new Float32Array(orthographic);
    moved[13] = -3;
    assert.deepEqual([...tree.list(shaftcull.frustum(moved, 'minus_one_to_one'))], [1]);
  });
});

describe('visibility', () => {
  const row = (y, count) => Array.from({length: count}, (_, x) => [2 * x, y, 0, 2 * x + 1, y, 1]).flat();

  test('says of all pairs whether they see each other', () => {
    const planes = (y, sign) => Array.from({length: 8}, () => [0, sign, 0, sign * y]).flat();
    const seen = shaftcull.visibility({
      patches: row(0, 8), planes: planes(0, 1), patchesB: row(10, 8), planesB: planes(10, -1),
      solids: [-100, 4, -100, 7, 6, 100], boxes: [9, 4, 0, 9.5, 5, 1],
    });
    const {clear, occluded, undecided, facing_away: away} = seen.counts;
    assert.equal(clear + occluded + undecided + away, 64);
    assert(clear > 0 && occluded > 0 && undecided > 0);
    for (const sight of ['clear', 'occluded', 'undecided']) {
      assert.equal(seen.pairs(sight).length, 2 * seen.counts[sight]);
    }
    const occludedPairs = seen.pairs('occluded');
    const isOccluded = new Set(upTo(occluded).map((p) => occludedPairs.subarray(2 * p, 2 * p + 2).join(' ')));
    assert(isOccluded.has('0 0') && !isOccluded.has('7 7'));
    assert.equal(seen.offsets.length, undecided + 1);
    assert.equal(seen.candidates.length, seen.offsets[undecided]);
    assert(seen.candidates.includes(0), 'the box that is not solid');
    const facing = shaftcull.visibility({patches: row(0, 8), planes: planes(0, -1), patchesB: row(10, 8)});
    assert.equal(facing.counts.facing_away, 64);
  });

  test('of undecided pairs is measured by rays', () => {
    const facing = (x, reversed) => {
      const square = [[x, 0, 0], [x, 1, 0], [x, 1, 1], [x, 0, 1]];
      return (reversed ? square.reverse() : square).flat();
    };
    const scene = {corners: [facing(0, false)], cornersB: [facing(4, true)], solids: [1.5, -1, -1, 2.5, 0.5, 2]};
    const seen = shaftcull.visibility({...scene, rays: 256});
    assert.equal(seen.counts.undecided, 1);
    assert(Math.abs(seen.fractions[0] - 0.4) < 0.05, 'both planes of the box are to be passed on one side');
    assert.equal(seen.fractions.length, 1);
    const again = shaftcull.visibility({...scene, rays: 256, seed: 1, error: 0});
    assert.deepEqual(again.fractions, seen.fractions);
    assert.notDeepEqual(shaftcull.visibility({...scene, rays: 256, seed: 2}).fractions, seen.fractions);
    assert.equal(shaftcull.visibility(scene).fractions, undefined);
    assert.throws(() => shaftcull.visibility({...scene, rays: 0}), ShaftcullError);
    assert.throws(() => shaftcull.visibility({...scene, rays: 16, candidates: false}), /rays need candidates/);
    assert.throws(() => shaftcull.visibility({...scene, seed: 2}), /seed is of rays/);
    assert.throws(() => shaftcull.visibility({...scene, rays: 16, error: '0'}), /error = "0" is no number/);
    assert.throws(() => shaftcull.countVisibility({...scene, rays: 16}), /no option 'rays'/);
  });

  test('of lights far away says how much of each patch is lit', () => {
    const floor = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]].flat();
    const beside = floor.map((x, i) => (i % 3 === 0 ? x + 5 : x));
    const scene = {corners: [floor, beside], solids: [-1, -1, 2, 0.5, 2, 3], lights: [0, 0, 1, 0, 0, -1]};
    const lit = shaftcull.litFractions({...scene, rays: 1024});
    assert.equal(lit.length, 4);
    assert(Math.abs(lit[0] - 0.5) < 0.01, 'half is in the shadow');
    assert.deepEqual([...lit.subarray(1)], [0, 1, 0]);
    assert.deepEqual(shaftcull.litFractions({...scene, rays: 1024, seed: 1, tolerance: 0}), lit);
    const both = shaftcull.litFractions({...scene, sides: 'both'});
    assert(both[1] === 1 && both[3] === 1, 'from below');
    assert.equal(shaftcull.litFractions({...scene, lights: []}).length, 0);
    assert.throws(() => shaftcull.litFractions({...scene, lights: [0, 0, 0]}), ShaftcullError);
    assert.throws(() => shaftcull.litFractions({corners: [floor]}), /lights/);
    assert.throws(() => shaftcull.litFractions({...scene, patchesB: row(0, 1)}), /one set/);
    assert.throws(() => shaftcull.litFractions({...scene, rays: 0}), ShaftcullError);
  });

  test('of one set with itself has each pair once', () => {
    const seen = shaftcull.visibility({patches: row(0, 20)});
    assert.equal(seen.counts.clear, 190);
    const pairs = seen.pairs('clear');
    const once = new Set(upTo(190).map((p) => ascending(pairs.subarray(2 * p, 2 * p + 2)).join()));
    assert.equal(once.size, 190);
  });

  test('takes triangles', () => {
    const between = [0, 5, 0, 1, 5, 0, 0, 5, 1];
    const seen = shaftcull.visibility({patches: row(0, 1), patchesB: row(10, 1), triangles: between});
    assert.equal(seen.counts.undecided, 1);
    assert.deepEqual([...seen.candidates], [0]);
    assert.deepEqual(seen.triangles, [Uint32Array.of(0)]);
    const triangles = boxesOf(150, 8).map((x, i) => x + (i % 9));
    const many = shaftcull.visibility({patches: row(0, 3), boxes: lamp, triangles});
    assert.equal(many.triangles[0].length, 0, 'a box has none');
    assert.deepEqual(ascending(many.triangles.flatMap((group) => [...group])), upTo(100));
  });

  test('is blocked by hulls and polygons, by their corners', () => {
    const wall = [-9, 5, -9, -9, 5, 9, 9, 5, 9, 9, 5, -9];
    const pillar = [-9, 4, -9, 9, 4, -9, 0, 4, 20, 0, 6, 0];
    const ends = {patches: row(0, 1), patchesB: row(10, 1)};
    for (const scene of [{polygons: [wall]}, {hulls: [pillar]}, {polygons: [[0, 50, 0, 1, 50, 0, 0, 50, 1], wall]}]) {
      const seen = shaftcull.visibility({...ends, ...scene});
      assert.deepEqual(seen.counts, {undecided: 0, clear: 0, occluded: 1, facing_away: 0});
      assert(seen.triangles.every((group) => group.length === 0));
    }
    const triangles = [0, 5, 0, 1, 5, 0, 0, 5, 1];
    const polygons = [[0, 50, 0, 1, 50, 0, 0, 50, 1]];
    const seen = shaftcull.visibility({...ends, boxes: [...lamp, ...lamp], hulls: [], polygons, triangles});
    assert.deepEqual(seen.triangles.map((group) => group.length), [0, 0, 0, 1], 'triangles come last');
    const [four, threeFloats] = [[...wall, 0], [0, 0, 0]];
    assert.throws(() => shaftcull.visibility({...ends, polygons: [four]}), /polygons\[0\] has 13 floats/);
    assert.throws(() => shaftcull.visibility({...ends, hulls: [pillar, threeFloats]}), ShaftcullError);
    assert.throws(() => shaftcull.visibility({...ends, polygons: Float32Array.from(wall)}), /polygons is no array/);
  });

  test('is counted, and answered without candidates', () => {
    const scene = {
      patches: row(0, 8), patchesB: row(10, 8), solids: [-100, 4, -100, 7, 6, 100], boxes: [9, 4, 0, 9.5, 5, 1],
    };
    const seen = shaftcull.visibility(scene);
    assert.deepEqual(shaftcull.countVisibility({...scene, memory: 1 << 20}), seen.counts);
    const fewer = shaftcull.visibility({...scene, candidates: false});
    assert.deepEqual(fewer.counts, seen.counts);
    assert(seen.counts.undecided > 0 && seen.candidates.length > 0);
    assert.deepEqual(fewer.undecided, seen.undecided);
    assert.deepEqual(fewer.offsets, new Float64Array(seen.counts.undecided + 1));
    assert.equal(fewer.candidates.length, 0);
    const parts = [0, 1, 2].map((part) => shaftcull.countVisibility({...scene, part, parts: 3}));
    for (const sight of Object.keys(seen.counts)) {
      assert.equal(parts.reduce((sum, counts) => sum + counts[sight], 0), seen.counts[sight]);
    }
    assert.throws(() => shaftcull.visibility({...scene, part: 3, parts: 3}), /part is 3; of 3 parts, it is 0 to 2/);
    const around = {patches: row(0, 1), patchesB: row(10, 1), solids: [-1, -1, -1, 2, 2, 2]};
    assert.equal(shaftcull.countVisibility(around).occluded, 1);
    assert.equal(shaftcull.countVisibility({...around, solidsAroundEnds: false}).occluded, 0);
    assert.throws(() => shaftcull.countVisibility({...scene, candidates: true}), /no option 'candidates'/);
    assert.throws(() => shaftcull.countVisibility({...scene, memory: 9}), ShaftcullError);
  });

  test('takes patches by their corners, within a tolerance', () => {
    const leaning = [[0, 0, 0, 1, 0, 1, 1, 1, 1], [0, 0, 0, 1, 1, 1, 0, 1, 0]];  // one square
    assert.equal(shaftcull.countVisibility({corners: leaning}).facing_away, 1);
    const behind = [[3, 0, 0, 3, 0, 1, 3, 1, 0]];
    assert.equal(shaftcull.countVisibility({corners: leaning, cornersB: behind}).facing_away, 2);
    assert.equal(shaftcull.countVisibility({corners: leaning, cornersB: behind, sides: 'both'}).clear, 2);
    assert.equal(shaftcull.countVisibility({corners: leaning, sides: 'both'}).facing_away, 1);
    assert.throws(() => shaftcull.countVisibility({corners: leaning, sides: 'back'}), /sides/);
    assert.throws(() => shaftcull.countVisibility({patches: [0, 0, 0, 1, 1, 1], sides: 'both'}), /no corners/);
    const lifted = [leaning[0], [0, 0, 0.125, 1, 1, 1.125, 0, 1, 0.125]];
    assert.equal(shaftcull.countVisibility({corners: lifted}).facing_away, 1);
    const above = [[0, 0, 9, 0, 1, 9, 1, 0, 9]];
    assert.equal(shaftcull.countVisibility({corners: [[0, 0, 0, 1, 0, 0, 0, 1, 0]], cornersB: above}).clear, 1);
    const low = [[0, 0, 0.125, 0, 1, 0.125, 1, 0, 0.125]];
    const near = {corners: [[0, 0, 0, 1, 0, 0, 0, 1, 0]], cornersB: low};
    assert.equal(shaftcull.countVisibility({...near, tolerance: 0.125}).facing_away, 1);
    assert.equal(shaftcull.countVisibility(near).clear, 1);
    assert.throws(() => shaftcull.countVisibility({corners: leaning, planes: [0, 0, 1, 0]}), /corners are patches/);
    assert.throws(() => shaftcull.countVisibility({corners: [[0, 0, 0, 1, 0, 0]]}), ShaftcullError);
  });

  test('finds solids in triangles', () => {
    const baffle = [-9, -9, 5, 9, -9, 5, 9, 9, 5, -9, -9, 5, 9, 9, 5, -9, 9, 5];
    const scene = {corners: [[0, 0, 0, 1, 0, 0, 0, 1, 0]], cornersB: [[0, 0, 9, 0, 1, 9, 1, 0, 9]], triangles: baffle};
    assert.equal(shaftcull.countVisibility(scene).undecided, 1);
    assert.equal(shaftcull.countVisibility({...scene, findSolids: true}).occluded, 1);
    assert.throws(() => shaftcull.countVisibility({patches: row(0, 2), findSolids: true}), /there are none/);
    // A building without a bottom, which hides two opposite corners from each other if it stands on their ground.
    const quad = (a, b, c, d) => [...a, ...b, ...c, ...a, ...c, ...d];
    const at = (z) => [[0, 0, z], [10, 0, z], [10, 10, z], [0, 10, z]];
    const [low, high] = [at(0), at(10)];
    const walls = [0, 1, 2, 3].flatMap((i) => quad(low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]));
    const triangles = [...walls, ...quad(...high)];
    const between = (z) => ({patches: [-3, -3, z, -2, -2, 1, 12, 12, z, 13, 13, 1], triangles, findSolids: true});
    assert.equal(shaftcull.countVisibility(between(0)).occluded, 1);
    assert.equal(shaftcull.countVisibility(between(-1)).undecided, 1);
  });

  test('has a bit per pair', () => {
    const [two, one] = [{patches: row(0, 40), patchesB: row(10, 3)}, {patches: row(0, 40)}];
    for (const scene of [two, one]) {
      const seen = shaftcull.visibility({...scene, solids: [5, 3, 0, 9, 5, 1]});
      for (const sight of ['clear', 'undecided']) {
        const rows = seen.bits(sight);
        assert.equal(rows.length, 40);
        const pairs = seen.pairs(sight);
        const expected = new Set(upTo(pairs.length / 2).flatMap((p) => {
          const [a, b] = pairs.subarray(2 * p, 2 * p + 2);
          return scene === one ? [`${a} ${b}`, `${b} ${a}`] : [`${a} ${b}`];
        }));
        const columns = scene === one ? 40 : 3;
        const set = rows.flatMap((bits, i) => positionsOf(bits, columns).map((j) => `${i} ${j}`));
        assert.deepEqual(new Set(set), expected);
      }
    }
  });
});

describe('what cannot be answered is refused', () => {
  test('by the library, with the position of what is wrong', () => {
    assert.throws(() => shaftcull.boxTree([...lamp, 0, 0, 2, 1, 1, 1]), (error) => {
      assert(error instanceof ShaftcullError);
      assert.deepEqual([error.name, error.status, error.position], ['ShaftcullError', 'bad bound', 1]);
      assert.match(error.message, /^box 1: lo\.z = 2 is above hi\.z = 1/);
      return true;
    });
    const upsideDown = [1, 0, 0, 0, 1, 1];
    const where = (box) => new RegExp(`^ShaftcullError: shaft 0: box ${box}: lo\\.x = 1 is above hi\\.x = 0; lo must`);
    assert.throws(() => shaftcull.between(upsideDown, lamp), where('a'));
    assert.throws(() => shaftcull.between(lamp, upsideDown), where('b'));
    assert.throws(() => shaftcull.shadow(lamp, upsideDown), where('occluder'));
    assert.throws(() => shaftcull.swept(upsideDown, [1, 0, 0]), where('body'));
    assert.throws(() => shaftcull.shadow([...lamp, ...lamp], [...table, ...lamp]), (error) => {
      assert.deepEqual([error.status, error.position], ['bad bound', 1]);
      assert.match(error.message, /^shaft 1: shadow: light and occluder overlap or touch/);
      return true;
    });
    assert.throws(() => shaftcull.hull([]), ShaftcullError);
    assert.throws(() => shaftcull.shadow(lamp, lamp), ShaftcullError);
    assert.equal(shaftcull.boxTree(scene).count(shaftcull.between(lamp, table)), 2, 'and goes on');
  });

  test('before it, if it is no float32, no index, or no option', () => {
    const ask = (options) => shaftcull.boxTree(scene).list(shaftcull.between(lamp, table), options);
    const askMany = (options) => shaftcull.boxTree(scene).listMany(shaftcull.between(lamp, table), options);
    for (const [call, message] of [
      [() => shaftcull.boxTree([0, 0, 0, 0.1, 1, 1]), /boxes\[3\] = 0\.1 is no float32/],
      [() => shaftcull.boxTree([0, 0, 0, 1, 1]), /boxes has 5 floats, which is no multiple of 6/],
      [() => shaftcull.boxTree([0, 0, 0, 1, 1, '1']), /boxes\[5\] is no number/],
      [() => shaftcull.boxTree(7), /boxes is no array/],
      [() => shaftcull.boxTree({length: -6}), /boxes is no array/],
      [() => shaftcull.boxTree(scene).list(shaftcull.between(lamp, table), {at: 0n}), /at = 0n is no integer/],
      [() => shaftcull.boxTree(scene).list(shaftcull.between(lamp, table), {at: NaN}), /at = NaN is no integer/],
      [() => shaftcull.between(lamp, table, {contact: globalThis}), /contact is an object that JSON cannot write/],
      [() => shaftcull.between(lamp, table, {contacts: 'open'}), /no option 'contacts'/],
      [() => shaftcull.between(lamp, table, {contact: 'ajar'}), /contact is "ajar", not one of/],
      [() => shaftcull.between(lamp, table, {pairs: [0.5, 0]}), /pairs\[0\] = 0.5 is no integer/],
      [() => shaftcull.boxTree(scene).list(shaftcull.between(lamp, table), {at: 1}), /at = 1/],
      [() => shaftcull.boxTree(scene).list(lamp), /a shaft is made by/],
      [() => shaftcull.visibility({patches: lamp, walls: []}), /no option 'walls'/],
      [() => shaftcull.boxTree(scene).list(shaftcull.between(lamp, table), 1),
       /options are an object with some of 'at', 'exclude', .*'triangleTest', not 1/],
      [() => ask({own: [0]}), /no option 'own'/],
      [() => ask({excludeEach: [0]}), /no option 'excludeEach'/],
      [() => askMany({at: 0}), /no option 'at'/],
      [() => shaftcull.boxTree(scene).cullMany(shaftcull.between(lamp, table), {at: 0}), /no option 'at'/],
      [() => shaftcull.boxTree(scene).cullMany(shaftcull.hull([0, 0, 0])), /shafts are made by/],
      [() => shaftcull.boxTree(scene).anyMany(lamp), /shafts are made by/],
      [() => shaftcull.between(lamp, table).classify([1, 2, 3, 4, 5]), /bound has 5 floats; a box has 6/],
      [() => shaftcull.between(lamp, table).classify([0.1, 0, 0, 1, 1, 1]), /bound\[0\] = 0\.1 is no float32/],
      [() => shaftcull.between(lamp, table).keeps(lamp, {limit: 1}), /no option 'limit'/],
      [() => shaftcull.between(lamp, table).keeps(lamp, {at: 1}), /at = 1 is no integer/],
      [() => shaftcull.hull([0, 0, 0]).keeps(lamp, {at: 1}), /at = 1 is no integer/],
      [() => shaftcull.between(lamp, table).occludedByBox([1, 2, 3]), /solid has 3 floats instead of 6/],
      [() => shaftcull.between(lamp, table).occludedByBox(lamp, {only: [0]}), /no option 'only'/],
      [() => shaftcull.between(lamp, table).occludedByPolygon([1, 2]), /corners has 2 floats/],
      [() => ask({exclude: [-1]}), /exclude\[0\] = -1 is no integer/],
      [() => ask({only: 0}), /only is no array/],
      [() => ask({excludeMask: [0, 0]}), /excludeMask has 2 words instead of 1/],
      [() => ask({layerMask: 1 << 31}), /layerMask\[0\] = -2147483648 is no integer/],
      [() => ask({layerMask: [1, 1]}), /layerMask has 2 masks for 1 shafts/],
      [() => askMany({layerMask: []}), /layerMask has 0 masks for 1 shafts/],
      [() => ask({limit: 0}), /limit = 0 is no integer from 1/],
      [() => ask({limit: 2 ** 32}), /limit = 4294967296 is no integer from 1/],
      [() => askMany({limit: 1.5}), /limit = 1.5 is no integer from 1/],
      [() => ask({triangleTest: 'box'}), /triangleTest is "box", not one of 'exact', 'vertices'/],
      [() => shaftcull.boxTree(scene).list(shaftcull.between([], []), {}), /no shafts to ask/],
      [() => shaftcull.boxTree(scene).list(shaftcull.between(lamp, table), {at: '0'}), /at = "0" is no integer/],
      [() => shaftcull.visibility({patches: lamp, planesB: [0, 0, 1, 0]}), /planesB, but no patchesB/],
      [() => shaftcull.visibility({patches: lamp, planes: []}), /0 planes for 1 patches/],
      [() => shaftcull.frustum([1], 'zero_to_one'), /16/],
      [() => shaftcull.hash('none', 'slab form'), /no family 'none'/],
    ]) {
      assert.throws(call, message);
    }
  });

  test('objects that were freed', () => {
    const tree = shaftcull.boxTree(scene);
    tree.free();
    tree.free();
    assert.throws(() => tree.count(shaftcull.between(lamp, table)), /was freed/);
    const hull = shaftcull.hull([0, 0, 0]);
    hull.free();
    assert.throws(() => shaftcull.boxTree(scene).count(hull), /was freed/);
  });

  test('objects of another module', async () => {
    const other = await load();
    await assert.rejects(load({}), /load\(\) takes a WebAssembly\.Module, its bytes/);
    const [tree, shaft, hull] = [shaftcull.boxTree(scene), other.between(lamp, table), other.hull([0, 0, 0])];
    for (const call of [() => tree.list(shaft), () => tree.countMany(shaft), () => tree.listMany(shaft),
                        () => tree.count(hull), () => tree.entryTimes(shaft, [0]),
                        () => shaftcull.casters(hull, [1, 1, 1])]) {
      assert.throws(call, /of two modules/);
    }
  });

  test('what memory cannot hold, and the next call is answered', async () => {
    const one = await load();
    const held = [];
    assert.throws(() => {
      const boxes = new Float32Array(6 * 20_000_000);
      for (;;) held.push(one.boxStream(boxes));
    }, (error) => error.status === 'out of memory');
    for (const boxes of held) boxes.free();
    // A row of bits per shaft: more than 4 GB, by a little.
    const boxes = one.boxStream(new Float32Array(6 * 350_000));
    const shafts = one.swept(lamp, new Float32Array(3 * 100_000));
    assert.throws(() => boxes.cullMany(shafts), (error) => error.status === 'out of memory');
    boxes.free();
    shafts.free();
    assert.equal(one.boxStream(scene).count(one.between(lamp, table)), 2);
  });
});

test('memory of a hundred thousand objects is used again', async () => {
  const one = await load();
  for (let i = 0; i !== 100_000; ++i) {
    const shaft = one.between(lamp, table);
    const tree = one.boxTree(scene);
    assert.equal(tree.count(shaft), 2);
    tree.free();
    shaft.free();
    if (i % 1000 === 0) assert.throws(() => one.boxTree([1, 0, 0, 0, 0, 0]));
  }
});

test('many objects are kept at once', async () => {
  const one = await load();
  const held = Array.from({length: 20_000}, () => one.between(lamp, table));
  const tree = one.boxTree(scene);
  assert(held.every((shaft) => tree.count(shaft) === 2));
});

test('an origin makes boxes and spheres that contain what they are given, and boxes within', () => {
  const boxes = [0.1, -0.1, 1e-60, 0.1, -0.1, 1e-60, -1e39, -1e39, 0, 1e39, 1e39, 1];
  const world = shaftcull.origin();
  assert.deepEqual([...world.at], [0, 0, 0]);
  const around = world.boxesAround(boxes);
  boxes.forEach((value, i) => {
    assert(i % 6 < 3 ? around[i] <= value : around[i] >= value, `${value}, ${around[i]}`);
  });
  const above = Math.fround(0.1);
  assert.deepEqual([...world.boxesAround([0.1, 1, 2, 0.1, 3, 4])], [above - 2 ** -27, 1, 2, above, 3, 4]);
  assert.deepEqual([...world.boxesWithin([0, 1, 2, 0.1, 3, 4])], [0, 1, 2, above - 2 ** -27, 3, 4]);
  assert.deepEqual([...world.boxesWithin([0.1, 1, 2, 0.1, 3, 4])],
                   [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity]);

  const there = shaftcull.origin([4512345, 500000, 100]);
  assert.deepEqual([...there.boxesAround([4512345.25, 500001, 100, 4512346, 500002, 101])], [0.25, 1, 0, 1, 2, 1]);
  const [x, y, z, radius] = there.spheresAround(new Float64Array([4512345.5, 500000, 100, 0.1]));
  assert.deepEqual([x, y, z], [0.5, 0, 0]);
  assert(radius >= 0.1 && radius < 0.1000001);
  assert.deepEqual([...there.nearest([4512345.1, 500000, 100])], [Math.fround(4512345.1 - 4512345), 0, 0]);
  assert.deepEqual([...there.toWorld([0.25, 1, 2])], [4512345.25, 500001, 102]);
  const region = [4512345, 500000, 100, 4512445, 500100, 200];
  const [, , , offset, ...level] = there.planesAround([1, 0, 0, 4512345.1, 0, -1, 0, -500001], region);
  assert(offset >= 4512345.1 - 4512345 && offset < 0.1000001);
  assert.deepEqual(level, [0, -1, 0, -1]);
  assert.deepEqual(there.boxesAround([]), new Float32Array());
  assert.deepEqual(there.planesAround([], region), new Float32Array());

  assert(Number.isNaN(world.boxesAround([NaN, 0, 0, 0, 0, 0])[0]));
  assert.throws(() => shaftcull.boxStream(world.boxesAround([NaN, 0, 0, 0, 0, 0])), /not a number|NaN|lo/);
  assert.throws(() => world.boxesAround([1, 2, 3]), /boxes has 3 numbers, which is no multiple of 6/);
  assert.throws(() => there.planesAround([1, 0, 0, 0], [1, 2, 3]), /box has 3 numbers/);
  assert.throws(() => there.planesAround([1, 0, 0, 0, NaN, 0, 0, 0], region), /plane 1 is not finite/);
  assert.throws(() => world.nearest(['1', 2, 3]), /points\[0\] is no number/);
  assert.throws(() => shaftcull.origin([1, 2]), /at has 2 numbers/);
  assert.throws(() => shaftcull.origin([0, Infinity, 0]), /not finite/);
});

test('all hashes are those on record, on both instruction sets', () => {
  for (const set of shaftcull.instructionSets) {
    shaftcull.instructionSet = set;
    for (const family of shaftcull.hashFamilies) {
      for (const way of family.ways) {
        const {hash, record} = shaftcull.hash(family.name, way, {quick: true});
        assert.equal(hash, record, `${set}, ${family.name}, ${way}`);
      }
    }
  }
});

describe('view factors', () => {
  // A room of six unit squares that face inwards.
  const room = [
    [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0], [0, 0, 1, 0, 1, 1, 1, 1, 1, 1, 0, 1], [0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1],
    [1, 0, 0, 1, 0, 1, 1, 1, 1, 1, 1, 0], [0, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0], [0, 1, 0, 1, 1, 0, 1, 1, 1, 0, 1, 1],
  ];
  const screen = {polygons: [[0, 0, 0.5, 0.5, 0, 0.5, 0.5, 1, 0.5, 0, 1, 0.5]]};

  test('of a closed room sum to 1', () => {
    const factors = shaftcull.viewFactors({corners: room});
    assert.deepEqual([...factors.first], [0, 5, 10, 15, 20, 25, 30]);
    assert.equal(factors.counts.clear, 15);
    for (let i = 0; i !== 6; ++i) {
      assert(Math.abs(factors.sum[i] - 1) < 1e-7 && factors.area[i] === 1);
      assert.equal(factors.error[i], 0);
      for (let j = 0; j !== 6; ++j) assert.equal(factors.at(i, j), i === j ? 0 : shaftcull.viewFactor(room[i], room[j]));
    }
  });

  test('of what is hidden in part are smaller, and rows that are nearly whole can be closed', () => {
    const open = shaftcull.viewFactors({corners: room});
    const hidden = shaftcull.viewFactors({corners: room, ...screen});
    assert(hidden.at(0, 1) < 0.8 * open.at(0, 1) && hidden.at(0, 1) > 0.2 * open.at(0, 1));
    assert(hidden.error[0] > 0 && hidden.sum[0] < 0.9);
    const fewer = shaftcull.viewFactors({corners: room, ...screen, least: 0.15, rays: 64, error: 0, seed: 5});
    assert(fewer.leftOut[0] > 0 && fewer.factor.length < 30);
    const parts = [0, 1].map((part) => shaftcull.viewFactors({corners: room, ...screen, part, parts: 2}));
    assert.equal(parts[0].at(0, 1) + parts[1].at(0, 1), hidden.at(0, 1));
    const closed = shaftcull.viewFactors({corners: room.slice(0, 6), closeRows: true});
    assert(closed.sum.every((sum) => Math.abs(sum - 1) < 1e-12));
  });

  test('of what cannot be are refused', () => {
    assert.throws(() => shaftcull.viewFactors({corners: room, ...screen, closeRows: true}), ShaftcullError);
    assert.throws(() => shaftcull.viewFactors({corners: room, cornersB: room}), /no second one/);
    assert.throws(() => shaftcull.viewFactors({corners: room, sides: 'both'}), /both sides/);
    assert.throws(() => shaftcull.viewFactors({corners: room, rays: 65537}), /rays/);
    assert.throws(() => shaftcull.viewFactors({corners: room, least: 'none'}), /least = "none" is no number/);
    assert.throws(() => shaftcull.viewFactors({corners: room, contact: 'open'}), /no option 'contact'/);
    assert.throws(() => shaftcull.viewFactors({patches: [0, 0, 0, 1, 1, 1]}), ShaftcullError);
  });
});
