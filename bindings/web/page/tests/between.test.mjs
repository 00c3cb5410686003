// SPDX-License-Identifier: MIT
// "What is in the way?": boxes, kinds of volumes, and what is shown.
import assert from 'node:assert/strict';
import {describe, test} from 'node:test';
import {KINDS, PATIENCE, column, drop, nameOfScene, open, openDrawn, page, shot, state, toggle} from './opened_page.mjs';

describe('boxes', () => {
  test('TheCityHas200000BoxesAndTheFirstShaftKeepsSome', async () => {
    await openDrawn();
    const {counts} = await state();
    assert.equal(counts.outside + counts.overlap + counts.inside, 200000);
    assert.ok(counts.overlap > 0);
    await shot('between_light');
  });

  // docs/page.webp is made of its pictures (docs/web.md).
  test('TheCountsFollowABoxThatIsDraggedInACircle', async () => {
    await open({viewport: {width: 1180, height: 640}});
    const before = await state();
    const canvas = await page.locator('#canvas').boundingBox();
    const x = canvas.x + before.onCanvas.b.x;
    const y = canvas.y + before.onCanvas.b.y;
    const steps = 32;
    const seen = new Set();
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let step = 0; step < steps; step++) {
      const angle = 2 * Math.PI * step / steps;
      await page.mouse.move(x + 150 * Math.sin(angle), y - 100 * (1 - Math.cos(angle)));
      const {counts, question} = await state();
      seen.add(`${counts.overlap} ${counts.inside}`);
      assert.deepEqual(question.a, before.question.a);
      assert.equal(question.b[1], before.question.b[1], 'a box that is dragged without Shift stays level');
      await shot(`dragged_${String(step).padStart(2, '0')}`);
    }
    await page.mouse.up();
    assert.ok(seen.size > steps / 2, `${seen.size} counts`);
  });

  test('DraggingWithShiftMovesABoxUpAndDown', async () => {
    await open();
    const before = await state();
    const canvas = await page.locator('#canvas').boundingBox();
    const {x, y} = before.onCanvas.a;
    await page.keyboard.down('Shift');
    await page.mouse.move(canvas.x + x, canvas.y + y);
    await page.mouse.down();
    await page.mouse.move(canvas.x + x, canvas.y + y - 80, {steps: 4});
    await page.mouse.up();
    await page.keyboard.up('Shift');
    const {question} = await state();
    assert.ok(question.a[1] > before.question.a[1]);
    assert.equal(question.a[0], before.question.a[0]);
  });

  test('ArrowKeysMoveTheSelectedBox', async () => {
    await open();
    const before = await state();
    await page.focus('#canvas');
    await page.keyboard.press('b');
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Shift+ArrowUp');
    const {question} = await state();
    assert.ok(question.b[0] > before.question.b[0]);
    assert.ok(question.b[1] > before.question.b[1]);
    assert.deepEqual(question.a, before.question.a);
  });

  test('EveryControlHasANameAndIsReachedByTab', async () => {
    await open();
    const unnamed = await page.$$eval('button, input:not([type="file"]), select', (controls) => controls
      .filter((control) => !control.textContent.trim() && !control.ariaLabel && control.labels?.length === 0)
      .map((control) => control.outerHTML));
    assert.deepEqual(unnamed, []);
    await page.focus('#tab-between');
    const reached = new Set();
    for (let presses = 0; presses < 60; presses++) {
      await page.keyboard.press('Tab');
      reached.add(await page.evaluate(() => document.activeElement.id));
    }
    for (const id of ['canvas', 'scene', 'open', 'kind', 'open-contact', 'size', 'stepping', 'near']) {
      assert.ok(reached.has(id), `Tab reaches ${id}`);
    }
  });

  test('CountsAreAnnouncedWhenTheBoxesRest', async () => {
    await open();
    await page.waitForSelector('#status:text-matches("overlap [0-9,]+, inside")', {state: 'attached', ...PATIENCE});
  });

  test('TheSizeOfABoxChangesTheCounts', async () => {
    await open();
    const before = await state();
    await page.fill('#size', '100');
    assert.ok((await state()).counts.overlap > before.counts.overlap);
  });
});

describe('kinds of volumes', () => {
  test('AllKindsAreAskedWithoutError', async () => {
    await openDrawn();
    for (const kind of KINDS) {
      await page.selectOption('#kind', kind);
      const {counts, answered} = await state();
      assert.ok(answered, kind);
      assert.ok(counts.overlap > 0, kind);
      await shot(`kind_${kind}`);
    }
  });

  test('SpheresAreAskedAllKinds', async () => {
    await openDrawn();
    await page.selectOption('#scene', 'sphereflake');
    for (const kind of KINDS) {
      await page.selectOption('#kind', kind);
      const {counts} = await state();
      assert.equal(counts.outside + counts.overlap + counts.inside, 66430, kind);
    }
    await shot('sphereflake');
  });

  test('WhatIsHitFirstIsReachedAtItsTime', async () => {
    await open();
    await page.selectOption('#kind', 'swept');
    const {first, counts} = await state();
    assert.ok(first.time > 0 && first.time < 1);
    assert.equal(counts.reached, 0);
    await page.click('#to-first');
    assert.ok((await state()).counts.reached > 0);
    await shot('swept');
  });

  test('ALightThatTouchesItsOccluderIsToldNotToHaveAShadow', async () => {
    await open();
    await page.selectOption('#kind', 'shadow');
    for (const name of ['a', 'b']) {
      await page.check(`[name="selected"][value="${name}"]`);
      await page.fill('#size', '100');
    }
    await page.evaluate(() => {
      const press = (move, times) => {
        for (let i = 0; i < times; i++) document.querySelector(`[data-move="${move}"]`).click();
      };
      press('-1 0 0', 30);
      press('0 0 -1', 16);
    });
    await state();
    for (const place of ['#trouble', '#legend', '#status']) assert.match(await page.textContent(place), /no shadow/);
    await page.selectOption('#kind', 'between');
    await state();
    assert.ok(await page.isHidden('#trouble'));
    assert.match(await page.textContent('#legend'), /kept/);
  });

  test('BoxesAtOnePlaceAreToldWhereADirectionIsNeeded', async () => {
    await open();
    await drop({name: 'point.obj', text: 'v 1 2 3\nf 1 1 1\n'});
    await nameOfScene('point.obj');
    for (const kind of ['sun', 'camera']) {
      await page.selectOption('#kind', kind);
      await state();
      assert.match(await page.textContent('#trouble'), /same place/);
    }
    await page.selectOption('#kind', 'between');
    assert.ok((await state()).answered);
  });

  test('ABoxStaysNearTheSceneAndComesBack', async () => {
    await open();
    const before = await state();
    const goFar = () => page.evaluate(() => {
      for (let i = 0; i < 2000; i++) document.querySelector('[data-move="0 0 -1"]').click();
    });
    await goFar();
    const {question} = await state();
    assert.notDeepEqual(question.a, before.question.a);
    await goFar();
    assert.deepEqual((await state()).question.a, question.a, 'it cannot go farther');
    await page.click('#restart');
    assert.deepEqual((await state()).question.a, before.question.a);
  });

  test('BoxesAreInViewHoweverFarAwayItIs', async () => {
    await open();
    await page.evaluate(() => {
      for (let i = 0; i < 60; i++) document.querySelector('#between [data-zoom="1.25"]').click();
    });
    const {onCanvas} = await state();
    assert.ok(onCanvas.a && onCanvas.b);
  });

  test('ABoxThatIsDraggedStopsMovingByItself', async () => {
    await open();
    await toggle('#wander', true);
    const canvas = await page.locator('#canvas').boundingBox();
    for (let i = 0; i < 30 && await page.isChecked('#wander'); i++) {  // it may move away from under the mouse
      const {onCanvas} = await state();
      await page.mouse.move(canvas.x + onCanvas.b.x, canvas.y + onCanvas.b.y);
      await page.mouse.down();
      await page.mouse.up();
    }
    assert.equal(await page.isChecked('#wander'), false);
  });

  test('OpenContactKeepsNoMoreThanClosed', async () => {
    await open();
    const closed = (await state()).counts;
    await toggle('#open-contact', true);
    const {overlap, inside} = (await state()).counts;
    assert.ok(overlap + inside <= closed.overlap + closed.inside);
  });
});

describe('what is shown', () => {
  async function pixels() {
    await state();
    return page.locator('#canvas').screenshot();
  }

  test('TogglesHideWhatTheySay', async () => {
    await openDrawn();
    let before = await pixels();
    for (const row of [0, 1]) {
      await page.locator('#counts tbody input').nth(row).uncheck();
      const now = await pixels();
      assert.notDeepEqual(now, before);
      before = now;
    }
    await toggle('#shaft-shown', false);
    assert.notDeepEqual(await pixels(), before);
    await shot('hidden');
  });

  test('PlanesStepAndCutUntilWhatTheShaftKeepsIsLeft', async () => {
    await open();
    const {counts: {overlap, inside}} = await state();
    await toggle('#stepping', true);
    await state();
    let cut = 0;
    while (await page.isEnabled('#step-on')) {
      await page.click('#step-on');
      cut += (await state()).counts.cut;
      if (cut > 0) await shot('planes');
    }
    assert.match(await page.textContent('#legend'), /left after step/);
    const rows = await column('#step-rows', 2);
    assert.equal(rows.at(-1), overlap + inside);
    assert.equal(rows[0] - rows.at(-1), cut);
  });

  test('TheLibrarysShareOfAFrameIsTold', async (context) => {
    await open();
    for (const kind of KINDS) {
      await page.selectOption('#kind', kind);
      await toggle('#wander', true);
      await page.waitForTimeout(1000);
      await toggle('#wander', false);
      const {libraryMilliseconds} = await state();
      assert.ok(libraryMilliseconds >= 0);
      context.diagnostic(`${kind}: the library took ${libraryMilliseconds.toFixed(2)} ms a frame`);
    }
    await page.waitForFunction(() => document.getElementById('list-flat').textContent !== '–', undefined, PATIENCE);
  });
});
