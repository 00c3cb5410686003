// SPDX-License-Identifier: MIT
// The bodies of the page, frame by frame, in Node.js. SHAFTCULL_PACKAGE names the folder of the package.
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {before, describe, test} from 'node:test';
import {pathToFileURL} from 'node:url';
import {Bodies} from '../src/bodies.js';

const {load} = await import(pathToFileURL(join(process.env.SHAFTCULL_PACKAGE, 'shaftcull.js')));

describe('bodies in Node.js', () => {
  let library;
  before(async () => {
    library = await load();
  });

  function after(frames, ...seed) {
    const bodies = new Bodies(library, ...seed);
    for (let frame = 0; frame < frames; frame++) bodies.change();
    return bodies;
  }

  const sizeOf = (box) => [0, 1, 2].map((k) => box[k + 3] - box[k]);

  test('ASeedGivesTheSameBodiesInEveryFrame', () => {
    const {floats} = after(250);
    assert.deepEqual(after(250).floats, floats);
    assert.notDeepEqual(after(250, 7).floats, floats);
  });

  test('TheTreeHasTheirFloats', () => {
    for (const frames of [0, 1, 199, 200, 450]) {
      const {bounds: {tree}, floats, length} = after(frames);
      assert.equal(tree.length, length);
      assert.equal(tree.upkeep.boundCount, length);
      const flat = library.boxStream(floats);
      for (const b of [[90, 10, 50, 110, 30, 70], [-10, 30, -10, 10, 60, 10]]) {
        const shaft = library.between([-120, 20, -60, -100, 40, -40], b);
        const {overlap, inside} = tree.listClassified(shaft);
        assert.deepEqual({overlap: overlap.sort(), inside: inside.sort()}, flat.listClassified(shaft));
        assert.ok(overlap.length > 0);
      }
    }
  });

  test('AllMoveALittleAndTenAreReplacedInAFrame', () => {
    const bodies = after(20);
    const old = bodies.floats.slice();
    bodies.change();
    let replaced = 0;
    for (let i = 0; i < bodies.length; i++) {
      const was = old.subarray(6 * i, 6 * i + 6);
      const is = bodies.bound(i);
      const moved = [0, 1, 2].map((k) => Math.abs(is[k] - was[k]));
      const far = Math.max(...moved) > 0.25 || sizeOf(is).some((size, k) => size !== sizeOf(was)[k]);
      if (far) replaced += 1;
      else assert.ok(Math.max(...moved) > 0, `body ${i} rests`);
      for (const size of sizeOf(is)) assert.ok(size >= 3 && size <= 6, `body ${i} has size ${size}`);
    }
    assert.equal(replaced, 10);
  });

  test('TheyAreFreed', () => {
    const bodies = after(1);
    const {tree} = bodies.bounds;
    bodies.free();
    assert.throws(() => tree.commit(), TypeError);
  });
});
