// SPDX-License-Identifier: MIT
// The built page, open in Chromium, for the tests beside this: node --test tests, with these variables of the environment:
//
// SHAFTCULL_PAGE      the built page
// SHAFTCULL_PACKAGE   the package that it was built with
// SHAFTCULL_MODULES   a node_modules that has playwright-core; without it, the one of the page's folder
// SHAFTCULL_CHROMIUM  the browser, /usr/bin/chromium if it is not set
// SHAFTCULL_PROGRAM   the program `shaftcull`, whose answers must be the page's; without it they are not compared
// SHAFTCULL_SHOTS     a folder for pictures; without it there are none
import assert from 'node:assert/strict';
import {createRequire} from 'node:module';
import {join, resolve} from 'node:path';
import {after, afterEach, before} from 'node:test';
import {fileURLToPath, pathToFileURL} from 'node:url';

const modules = resolve(process.env.SHAFTCULL_MODULES ?? fileURLToPath(new URL('../node_modules', import.meta.url)));
const {chromium} = createRequire(join(modules, 'tests.js'))('playwright-core');
export const built = pathToFileURL(resolve(process.env.SHAFTCULL_PAGE)).href;
export const program = process.env.SHAFTCULL_PROGRAM;
const shots = process.env.SHAFTCULL_SHOTS;

export const DESKTOP = {viewport: shots ? {width: 1280, height: 900} : {width: 900, height: 600}};
export const PHONE = {viewport: {width: 360, height: 740}, hasTouch: true, isMobile: true};
export const KINDS = ['between', 'pointLight', 'sun', 'camera', 'shadow', 'swept'];
export const PATIENCE = {timeout: 120000};

export let page;
let browser;
let errors;

/**
 * Opens the page, and waits for its first answer. Nothing is drawn, unless SHAFTCULL_SHOTS wants pictures: Chromium draws in software
 * here, which takes most of a test's time.
 */
export async function open(options = DESKTOP) {
  await openWith((opened) => shots || opened.addInitScript(drawNothing), options);
  await firstAnswer();
}

/** Likewise with pictures, for tests that look at them. */
export async function openDrawn(options = DESKTOP) {
  await openWith(() => {}, options);
  await firstAnswer();
}

async function firstAnswer() {
  await page.waitForFunction(() => window.shaftcullPage?.state.answer, undefined, PATIENCE);
}

/** Opens the page after prepare(page), and does not wait. */
export async function openWith(prepare, options = DESKTOP) {
  page = await browser.newPage(options);
  errors = [];
  page.on('console', (message) => { if (message.type() === 'error') errors.push(message.text()); });
  page.on('pageerror', (error) => errors.push(error.message));
  await prepare(page);
  await page.goto(built);
}

function drawNothing() {
  for (const shape of ['Arrays', 'Elements']) {
    for (const count of ['', 'Instanced']) WebGL2RenderingContext.prototype[`draw${shape}${count}`] = () => {};
  }
}

/** What the page has found, after the frame that follows what was done last. */
export async function state() {
  return page.evaluate(async () => {
    await new Promise(requestAnimationFrame);
    const {answer, counts, question, bodies, libraryMilliseconds, onCanvas, name, shape} = window.shaftcullPage.state;
    const ascending = ([list, indices]) => [list, [...indices].sort((i, j) => i - j)];
    return {answered: Boolean(answer), first: answer?.first, points: answer?.points && [...answer.points], counts,
      kept: answer?.parts.reduce((sum, {overlap, inside}) => sum + overlap.length + inside.length, 0),
      bodies: bodies && {
        floats: [...bodies.floats],
        answer: bodies.answer && Object.fromEntries(Object.entries(bodies.answer).map(ascending)),
      },
      question: {...question, a: [...question.a], b: [...question.b]}, libraryMilliseconds, onCanvas, name, shape};
  });
}

/** Checks or unchecks a box by its key. A click may miss: results that arrive meanwhile change the layout of the panel. */
export async function toggle(selector, checked) {
  await page.focus(selector);
  await page.keyboard.press('Space');
  assert.equal(await page.isChecked(selector), checked, selector);
}

export async function shot(name) {
  if (!shots) return;
  if (await page.evaluate(() => Boolean(window.shaftcullPage))) await state();
  await page.waitForTimeout(700);
  await page.screenshot({path: join(shots, `${name}.png`)});
}

/** The numbers in a column of a table. */
export async function column(table, which) {
  const texts = await page.$$eval(`${table} tr`, (rows, cell) => rows.map((row) => row.cells[cell].textContent), which);
  return texts.map((text) => Number(text.replaceAll(',', '')));
}

/** Drops files, {name, text} or {name, bytes}, on the page. */
export async function drop(...files) {
  const transfer = await page.evaluateHandle((dropped) => {
    const data = new DataTransfer();
    for (const {name, text, bytes} of dropped) data.items.add(new File([text ?? new Uint8Array(bytes)], name));
    return data;
  }, files);
  await page.dispatchEvent('main', 'drop', {dataTransfer: transfer});
}

export async function dropBroken(...files) {
  await drop(...files);
  await page.waitForSelector('#message:not([hidden])');
  const text = await page.textContent('#message p');
  await page.click('#message button');
  return text;
}

export async function nameOfScene(name) {
  await page.waitForFunction((wanted) => window.shaftcullPage.state.name === wanted, name, PATIENCE);
}

before(async () => {
  browser = await chromium.launch({
    executablePath: process.env.SHAFTCULL_CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
});
after(() => browser.close());

/** No test leaves errors in the console. */
afterEach(async () => {
  await page.close();
  assert.deepEqual(errors, []);
});
