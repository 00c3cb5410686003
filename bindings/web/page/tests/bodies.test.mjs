// SPDX-License-Identifier: MIT
// Bodies that come and go in the city of the page.
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {describe, test} from 'node:test';
import {pathToFileURL} from 'node:url';
import {
  KINDS, PATIENCE, column, drop, nameOfScene, open, openDrawn, page, shot, state, toggle,
} from './opened_page.mjs';

const {load} = await import(pathToFileURL(join(process.env.SHAFTCULL_PACKAGE, 'shaftcull.js')));

describe('bodies that come and go', () => {
  const sum = ({outside, overlap, inside}) => outside + overlap + inside;

  test('OnlyTheCityHasThem', async () => {
    await open();
    assert.ok(await page.isVisible('#bodies'));
    assert.equal(await page.isChecked('#bodies'), false);
    await toggle('#bodies', true);
    await state();
    await page.selectOption('#scene', 'sphereflake');
    const {counts, bodies} = await state();
    assert.equal(sum(counts), 66430);
    assert.equal(bodies, undefined);
    assert.ok(await page.isHidden('#bodies'));
    await drop({name: 'triangle.obj', text: 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'});
    await nameOfScene('triangle.obj');
    assert.ok(await page.isHidden('#bodies'));
    await page.selectOption('#scene', 'city');
    assert.equal(sum((await state()).counts), 200000);
    assert.equal(await page.isChecked('#bodies'), false);
  });

  test('TheyAreCountedAndChangeWhileTheBoxesRest', async () => {
    await open();
    const before = await state();
    await toggle('#bodies', true);
    const first = await state();
    assert.equal(first.bodies.floats.length, 6 * 2000);
    assert.equal(sum(first.counts), 202000);
    assert.match(await page.textContent('#legend'), /of 202,000 kept.*2,000 bodies, changes and commit: .* ms/);
    await page.waitForFunction(({overlap, inside}) => {
      const {counts} = window.shaftcullPage.state;
      return counts.overlap !== overlap || counts.inside !== inside;
    }, first.counts, PATIENCE);
    const later = await state();
    assert.notDeepEqual(later.bodies.floats, first.bodies.floats);
    assert.equal(sum(later.counts), 202000);
    assert.deepEqual(later.question, before.question);
    await toggle('#bodies', false);
    const after = await state();
    assert.deepEqual(after.counts, before.counts);
    assert.equal(after.bodies, undefined);
    assert.doesNotMatch(await page.textContent('#legend'), /bodies/);
    assert.ok(await page.isHidden('#bodies-time'));
  });

  test('TheirAnswersAreThoseOfAFlatQuestion', async () => {
    const library = await load();
    const middle = (box) => [0, 1, 2].map((k) => box[k] / 2 + box[k + 3] / 2);
    const way = (from, to) => middle(to).map((value, k) => Math.fround(value - middle(from)[k]));
    const volumes = {
      between: ({a, b}) => library.between(a, b),
      pointLight: ({a, b}) => library.between(a, b),
      sun: ({a, b}) => library.sweptInfinite(b, way(b, a)),
      camera: (_, points) => library.hull(points),
      shadow: ({a, b}) => library.shadow(a, b),
      swept: ({a, b}) => library.swept(a, way(a, b)),
    };
    await open();
    await toggle('#bodies', true);
    let kept = 0;
    for (const kind of KINDS) {
      await page.selectOption('#kind', kind);
      const {question, points, first, counts, bodies: {floats, answer}} = await state();
      assert.equal(sum(counts), 202000, kind);
      const flat = library.boxStream(floats);
      const volume = volumes[kind](question, points);
      const {overlap, inside} = flat.listClassified(volume);
      kept += overlap.length;
      assert.deepEqual(answer.overlap, [...overlap], kind);
      assert.deepEqual(answer.inside, [...inside], kind);
      if (counts.blocks !== undefined) assert.deepEqual(answer.blocks, [...flat.listOccluders(volume)], kind);
      if (kind === 'swept') assert.ok(first.time <= (flat.firstContact(volume)?.time ?? 1));
    }
    assert.ok(kept > 0);
    assert.match(await page.textContent('#first'), /^First contact: (box|body) /);
  });

  test('PlanesCutThem', async () => {
    await open();
    await toggle('#bodies', true);
    await toggle('#stepping', true);
    await state();
    while (await page.isEnabled('#step-on')) {
      await page.focus('#step-on');
      await page.keyboard.press('Enter');
      const {counts: {outside, cut, overlap}} = await state();
      assert.equal(outside + cut + overlap, 202000);
    }
    const {counts, kept} = await state();
    assert.equal(counts.overlap, kept);
    await toggle('#bodies', false);
    const {counts: {overlap}} = await state();
    assert.equal((await column('#step-rows', 2)).at(-1), overlap);
  });

  test('TheyAreDrawnUntilTheyAreSwitchedOff', async () => {
    const pixels = () => page.locator('#canvas').screenshot({style: '#legend { display: none; }'});
    await openDrawn();
    await state();
    const before = await pixels();
    await toggle('#bodies', true);
    await state();
    const first = await pixels();
    assert.notDeepEqual(first, before);
    await state();
    assert.notDeepEqual(await pixels(), first);
    await shot('bodies_light');
    await page.emulateMedia({colorScheme: 'dark'});
    await shot('bodies_dark');
    await page.emulateMedia({colorScheme: 'light'});
    await toggle('#bodies', false);
    await state();
    assert.deepEqual(await pixels(), before);
  });
});
