// SPDX-License-Identifier: MIT
// "What sees what?" and "The same on your machine?".
import assert from 'node:assert/strict';
import {describe, test} from 'node:test';
import {PATIENCE, column, open, openDrawn, page, shot} from './opened_page.mjs';

describe('what sees what', () => {
  test('PairsAddUpAndAPatchCanBePicked', async () => {
    await openDrawn();
    await page.click('#tab-sights');
    const numbers = (which) => column('#sight-counts', which);
    const patches = Number(await page.getAttribute('#patch', 'max')) + 1;
    const sum = (all) => all.reduce((total, number) => total + number, 0);
    assert.equal(sum(await numbers(1)), (patches * (patches - 1)) / 2);
    const first = await numbers(2);
    assert.equal(sum(first), patches - 1);
    await shot('sights_light');
    const canvas = await page.locator('#canvas').boundingBox();
    await page.mouse.click(canvas.x + canvas.width * 0.7, canvas.y + canvas.height * 0.6);
    assert.notDeepEqual(await numbers(2), first);
    const picked = await page.inputValue('#patch');
    await page.mouse.click(canvas.x + canvas.width * 0.4, canvas.y + canvas.height * 0.6, {button: 'right'});
    assert.equal(await page.inputValue('#patch'), picked, 'a right click picks nothing');
    await page.focus('#canvas');
    await page.keyboard.press('ArrowRight');
    assert.equal(Number(await page.inputValue('#patch')), Number(picked) + 1);
    await page.fill('#patch', '99999');
    await page.press('#patch', 'Tab');
    assert.equal(Number(await page.inputValue('#patch')), patches - 1);
    const all = await numbers(1);
    await page.fill('#cupboard', '9');
    assert.notDeepEqual(await numbers(1), all);
  });
});

describe('the same on your machine', () => {
  test('HashesOfQuickCasesAreThoseOnRecord', async () => {
    await open();
    await page.click('#tab-same');
    await page.click('#same-quick');
    await page.waitForSelector('#same-quick:enabled', PATIENCE);
    const results = await page.$$eval('#same-table tbody tr',
      (rows) => rows.map((row) => row.querySelector('.yes, .no')?.textContent));
    assert.ok(results.length >= 14);
    assert.deepEqual(new Set(results), new Set(['same']));
    assert.match(await page.textContent('#same-summary'), /^All \d+ are the same/);
    await shot('same');
  });

  test('ItCanBeStopped', async () => {
    await open();
    await page.click('#tab-same');
    await page.click('#same-all');
    await page.click('#same-stop');
    await page.waitForFunction(() => /Stopped/.test(document.getElementById('same-summary').textContent));
    assert.ok(await page.isEnabled('#same-quick'));
  });
});

test('HomeAndEndMoveBetweenTabs', async () => {
  await open();
  await page.focus('#tab-between');
  await page.keyboard.press('End');
  assert.equal(await page.getAttribute('#tab-same', 'aria-selected'), 'true');
  await page.keyboard.press('ArrowRight');
  assert.equal(await page.getAttribute('#tab-between', 'aria-selected'), 'true');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('Home');
  assert.equal(await page.getAttribute('#tab-between', 'aria-selected'), 'true');
});
