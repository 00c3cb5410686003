// SPDX-License-Identifier: MIT
// The page on other screens, and in browsers that lack something.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {describe, test} from 'node:test';
import {fileURLToPath} from 'node:url';
import {DESKTOP, KINDS, PATIENCE, PHONE, built, open, openDrawn, openWith, page, shot, state} from './opened_page.mjs';

describe('screens', () => {
  async function assertFits() {
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= PHONE.viewport.width, `the page is ${width} pixels wide on a screen of ${PHONE.viewport.width}`);
  }

  test('APhoneHasNoHorizontalOverflow', async () => {
    await open(PHONE);
    for (const tab of ['between', 'sights', 'same']) {
      await page.click(`#tab-${tab}`);
      await assertFits();
      await shot(`phone_${tab}`);
    }
    await page.click('#tab-between');
    await page.click('#fold');
    await assertFits();
    assert.ok(await page.isHidden('#scene'));
    await shot('phone_folded');
  });

  test('AFingerDragsABox', async () => {
    await open(PHONE);
    const before = await state();
    const canvas = await page.locator('#canvas').boundingBox();
    const client = await page.context().newCDPSession(page);
    const touch = (type, ...touchPoints) => client.send('Input.dispatchTouchEvent', {type, touchPoints});
    const [x, y] = [canvas.x + before.onCanvas.b.x, canvas.y + before.onCanvas.b.y];
    await touch('touchStart', {x, y});
    await touch('touchMove', {x: x - 30, y});
    await touch('touchMove', {x: x - 60, y});
    await touch('touchEnd');
    const {question} = await state();
    assert.notDeepEqual(question.b, before.question.b);
    assert.deepEqual(question.a, before.question.a);
  });

  test('ASecondFingerDoesNotTurnTheViewMeanwhile', async () => {
    await open(PHONE);
    const before = await state();
    const canvas = await page.locator('#canvas').boundingBox();
    const client = await page.context().newCDPSession(page);
    const touch = (type, ...touchPoints) => client.send('Input.dispatchTouchEvent', {type, touchPoints});
    const first = {x: canvas.x + before.onCanvas.b.x, y: canvas.y + before.onCanvas.b.y, id: 1};
    const second = (x) => ({x: canvas.x + x, y: canvas.y + 40, id: 2});
    await touch('touchStart', first);
    await touch('touchStart', first, second(40));
    for (const x of [80, 120, 160]) await touch('touchMove', first, second(x));
    await touch('touchEnd');
    assert.deepEqual((await state()).onCanvas.a, before.onCanvas.a);
  });

  test('LabelsAreNotCutOffOnAPhone', async () => {
    await open(PHONE);
    for (const kind of KINDS) {
      await page.selectOption('#kind', kind);
      await state();
      for (const label of ['#label-a', '#label-b']) {
        const {x, width} = await page.locator(label).boundingBox();
        assert.ok(x + width <= PHONE.viewport.width, `${kind}: ${label} ends at ${x + width}`);
      }
    }
  });

  test('SwatchesKeepTheirColoursWhereTheSystemHasItsOwn', async () => {
    await open({...DESKTOP, forcedColors: 'active'});
    const colour = await page.$eval('.swatch.overlap', (swatch) => getComputedStyle(swatch).backgroundColor);
    assert.equal(colour, 'rgb(240, 168, 0)');
  });

  test('DarkAndLightHaveTheirOwnColours', async () => {
    await open({...DESKTOP, colorScheme: 'dark'});
    const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    await shot('between_dark');
    await page.click('#tab-sights');
    await shot('sights_dark');
    const dark = await ground();
    await page.emulateMedia({colorScheme: 'light'});
    assert.notEqual(await ground(), dark);
  });
});

test('ThePageAsksNothingOfTheNetwork', async () => {
  const text = readFileSync(fileURLToPath(built), 'utf8');
  assert.match(text, /default-src 'none'/);
  const asked = [];
  await openWith((opened) => {
    opened.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) asked.push(request.url()); });
  });
  await page.waitForFunction(() => window.shaftcullPage?.state.answer, undefined, PATIENCE);
  assert.deepEqual(asked, []);
});

test('WithoutWebGlHashesAreComparedAllTheSame', async () => {
  await openWith((opened) => opened.addInitScript(() => { HTMLCanvasElement.prototype.getContext = () => null; }));
  await page.waitForSelector('#message:not([hidden])', PATIENCE);
  assert.match(await page.textContent('#message p'), /Pictures need WebGL 2/);
  await shot('no_webgl');
  await page.click('#same-quick');
  await page.waitForSelector('#same-quick:enabled', PATIENCE);
  assert.match(await page.textContent('#same-summary'), /^All \d+ are the same/);
});

test('APictureThatWasLostComesBack', async () => {
  await openDrawn();
  const before = await page.locator('#canvas').screenshot();
  await page.evaluate(async () => {
    const context = document.getElementById('canvas').getContext('webgl2').getExtension('WEBGL_lose_context');
    context.loseContext();
    await new Promise((resolve) => { setTimeout(resolve, 300); });
    context.restoreContext();
    await new Promise((resolve) => { setTimeout(resolve, 1000); });
  });
  await state();
  assert.deepEqual(await page.locator('#canvas').screenshot(), before);
});
