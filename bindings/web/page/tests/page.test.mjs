// SPDX-License-Identifier: MIT
// Tests of the built page in Chromium: node --test tests/page.test.mjs, with these variables of the environment:
//
// SHAFTCULL_PAGE      the built page
// SHAFTCULL_MODULES   a node_modules that has playwright-core; without it, the one of the page's folder
// SHAFTCULL_CHROMIUM  the browser, /usr/bin/chromium if it is not set
// SHAFTCULL_PROGRAM   the program `shaftcull`, whose answers must be the page's; without it they are not compared
// SHAFTCULL_SHOTS     a folder for pictures; without it there are none
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {after, afterEach, before, describe, test} from 'node:test';
import {fileURLToPath, pathToFileURL} from 'node:url';

const modules = resolve(process.env.SHAFTCULL_MODULES ?? fileURLToPath(new URL('../node_modules', import.meta.url)));
const {chromium} = createRequire(join(modules, 'tests.js'))('playwright-core');
const built = pathToFileURL(resolve(process.env.SHAFTCULL_PAGE)).href;
const program = process.env.SHAFTCULL_PROGRAM;
const shots = process.env.SHAFTCULL_SHOTS;

const DESKTOP = {viewport: shots ? {width: 1280, height: 900} : {width: 900, height: 600}};
const PHONE = {viewport: {width: 360, height: 740}, hasTouch: true, isMobile: true};
const KINDS = ['between', 'pointLight', 'sun', 'camera', 'shadow', 'swept'];
const PATIENCE = {timeout: 120000};

let browser;
let page;
let errors;

/** Opens the page, and waits for its first answer. */
async function open(options = DESKTOP) {
  page = await browser.newPage(options);
  errors = [];
  page.on('console', (message) => { if (message.type() === 'error') errors.push(message.text()); });
  page.on('pageerror', (error) => errors.push(error.message));
  await page.goto(built);
  await page.waitForFunction(() => window.shaftcullPage?.state.answer, undefined, PATIENCE);
}

/** What the page has found, after the frame that follows what was done last. */
async function state() {
  return page.evaluate(async () => {
    await new Promise(requestAnimationFrame);
    const {answer, counts, question, libraryMilliseconds, onCanvas, name, shape} = window.shaftcullPage.state;
    return {answered: Boolean(answer), first: answer?.first, points: answer?.points && [...answer.points], counts,
      question: {...question, a: [...question.a], b: [...question.b]}, libraryMilliseconds, onCanvas, name, shape};
  });
}

async function shot(name) {
  if (!shots) return;
  if (await page.evaluate(() => Boolean(window.shaftcullPage))) await state();
  await page.waitForTimeout(700);
  await page.screenshot({path: join(shots, `${name}.png`)});
}

/** The numbers in a column of a table. */
async function column(table, which) {
  const texts = await page.$$eval(`${table} tr`, (rows, cell) => rows.map((row) => row.cells[cell].textContent), which);
  return texts.map((text) => Number(text.replaceAll(',', '')));
}

/** Drops files, {name, text} or {name, bytes}, on the page. */
async function drop(...files) {
  const transfer = await page.evaluateHandle((dropped) => {
    const data = new DataTransfer();
    for (const {name, text, bytes} of dropped) data.items.add(new File([text ?? new Uint8Array(bytes)], name));
    return data;
  }, files);
  await page.dispatchEvent('main', 'drop', {dataTransfer: transfer});
}

async function dropBroken(...files) {
  await drop(...files);
  await page.waitForSelector('#message:not([hidden])');
  const text = await page.textContent('#message p');
  await page.click('#message button');
  return text;
}

async function nameOfScene(name) {
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

describe('boxes', () => {
  test('TheCityHas200000BoxesAndTheFirstShaftKeepsSome', async () => {
    await open();
    const {counts} = await state();
    assert.equal(counts.outside + counts.overlap + counts.inside, 200000);
    assert.ok(counts.overlap > 0);
    await shot('between_light');
  });

  test('DraggingABoxChangesTheCounts', async () => {
    await open();
    const before = await state();
    const canvas = await page.locator('#canvas').boundingBox();
    const {x, y} = before.onCanvas.b;
    await page.mouse.move(canvas.x + x, canvas.y + y);
    await page.mouse.down();
    await page.mouse.move(canvas.x + x - 120, canvas.y + y - 60, {steps: 4});
    await page.mouse.up();
    const {counts, question} = await state();
    assert.notDeepEqual(counts, before.counts);
    assert.notDeepEqual(question.b, before.question.b);
    assert.deepEqual(question.a, before.question.a);
    assert.equal(question.b[1], before.question.b[1], 'a box that is dragged without Shift stays level');
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
    await open();
    for (const kind of KINDS) {
      await page.selectOption('#kind', kind);
      const {counts, answered} = await state();
      assert.ok(answered, kind);
      assert.ok(counts.overlap > 0, kind);
      await shot(`kind_${kind}`);
    }
  });

  test('SpheresAreAskedAllKinds', async () => {
    await open();
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

  test('ABoxThatIsDraggedStopsMovingByItself', async () => {
    await open();
    await page.check('#wander');
    const {onCanvas} = await state();
    const canvas = await page.locator('#canvas').boundingBox();
    await page.mouse.move(canvas.x + onCanvas.b.x, canvas.y + onCanvas.b.y);
    await page.mouse.down();
    await page.mouse.up();
    assert.equal(await page.isChecked('#wander'), false);
  });

  test('OpenContactKeepsNoMoreThanClosed', async () => {
    await open();
    const closed = (await state()).counts;
    await page.check('#open-contact');
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
    await open();
    let before = await pixels();
    for (const row of [0, 1]) {
      await page.locator('#counts tbody input').nth(row).uncheck();
      const now = await pixels();
      assert.notDeepEqual(now, before);
      before = now;
    }
    await page.uncheck('#shaft-shown');
    assert.notDeepEqual(await pixels(), before);
    await shot('hidden');
  });

  test('PlanesStepAndCutUntilWhatTheShaftKeepsIsLeft', async () => {
    await open();
    const {counts: {overlap, inside}} = await state();
    await page.check('#stepping');
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
      await page.check('#wander');
      await page.waitForTimeout(1000);
      await page.uncheck('#wander');
      const {libraryMilliseconds} = await state();
      assert.ok(libraryMilliseconds >= 0);
      context.diagnostic(`${kind}: the library took ${libraryMilliseconds.toFixed(2)} ms a frame`);
    }
    await page.waitForFunction(() => document.getElementById('list-flat').textContent !== '–', undefined, PATIENCE);
  });
});

describe('the program', {skip: program ? false : 'SHAFTCULL_PROGRAM is not set'}, () => {
  const folder = mkdtempSync(join(tmpdir(), 'shaftcull-page-'));
  const scene = join(folder, 'scene.obj');
  after(() => rmSync(folder, {recursive: true}));

  /** Boxes as triangles that they are the bounds of, as the program reads them. */
  function boxesAsObj() {
    const {floats} = window.shaftcullPage.state;
    const lines = [];
    for (let i = 0; i < floats.length; i += 6) {
      const [x, y, z, X, Y, Z] = floats.subarray(i, i + 6);
      lines.push(`v ${x} ${y} ${z}`, `v ${X} ${Y} ${Z}`, `v ${x} ${Y} ${z}`);
      lines.push(`f ${i / 2 + 1} ${i / 2 + 2} ${i / 2 + 3}`);
    }
    return lines.join('\n');
  }

  function inThrees(floats) {
    return Array.from({length: floats.length / 3}, (_, i) => floats.slice(3 * i, 3 * i + 3).join(','));
  }

  /** Options of the program for a question of the page. */
  function optionsOf(kind, {a, b}, points) {
    const middle = (box) => [0, 1, 2].map((k) => box[k] / 2 + box[k + 3] / 2);
    const way = (from, to) => middle(to).map((value, k) => Math.fround(value - middle(from)[k])).join(',');
    const ends = [`--from=${a}`, `--to=${b}`];
    return {
      between: [...ends, '--solid'], pointLight: [...ends, '--solid'], shadow: [...ends, '--shadow'],
      sun: [`--from=${b}`, `--swept=${way(b, a)}`, '--without-end'], swept: [`--from=${a}`, `--swept=${way(a, b)}`],
      camera: ['--hull', ...inThrees(points ?? [])],
    }[kind];
  }

  /** Small triangles in a cube, at multiples of 1/16, which follow from integers. */
  function trianglesAsObj(count) {
    let seed = 1;
    const below = (n) => {
      seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
      return (seed >>> 8) % n;
    };
    const lines = [];
    for (let t = 0; t < count; t++) {
      const [x, y, z] = [below(320), below(320), below(320)];
      for (let c = 0; c < 3; c++) lines.push(`v ${[x, y, z].map((at) => (at + below(32)) / 16).join(' ')}`);
      lines.push(`f ${3 * t + 1} ${3 * t + 2} ${3 * t + 3}`);
    }
    return lines.join('\n');
  }

  test('TrianglesAreKeptAsByTheProgram', async () => {
    await open();
    const text = trianglesAsObj(5000);
    writeFileSync(scene, text);
    await drop({name: 'triangles.obj', text});
    await nameOfScene('triangles.obj');
    for (const kind of KINDS.filter((name) => name !== 'camera')) {
      await page.selectOption('#kind', kind);
      const {counts, question} = await state();
      const asked = optionsOf(kind, question).filter((option) => option !== '--solid');
      const options = ['cull', '--scene', scene, '--triangles', 'exact', '--format', 'json', ...asked];
      const {pairs: [{candidates}]} = JSON.parse(execFileSync(program, options, {encoding: 'utf8'}));
      assert.ok(candidates.length > 0, kind);
      assert.equal(counts.overlap, candidates.length, kind);
    }
  });

  test('CountsAreThoseOfTheProgram', async (context) => {
    await open();
    writeFileSync(scene, await page.evaluate(boxesAsObj));
    for (const kind of KINDS) {
      await page.selectOption('#kind', kind);
      const {counts, question, points} = await state();
      const asked = optionsOf(kind, question, points);
      const options = ['cull', '--scene', scene, '--bounds', 'triangle', '--format', 'json', ...asked];
      const output = execFileSync(program, options, {maxBuffer: 2 ** 30, encoding: 'utf8'});
      const {count, pairs: [{candidates}]} = JSON.parse(output);
      const number = (name) => candidates.filter(({answer}) => answer === name).length;
      const answers = {
        outside: count - candidates.length, overlap: number('overlap') + number('blocks'), inside: number('inside'),
        blocks: number('blocks'),
      };
      const told = {blocks: 0, ...counts};
      delete told.reached;
      context.diagnostic(`${kind}: ${JSON.stringify(answers)}`);
      assert.deepEqual(told, answers, kind);
    }
  });
});

describe('files', () => {
  const CUBE = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n'
    + 'f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n';

  /** A triangle; its buffer is in the file, or beside it. It names a picture, which nobody needs. */
  function gltf(uri) {
    return JSON.stringify({
      asset: {version: '2.0'}, scene: 0, scenes: [{nodes: [0]}], nodes: [{mesh: 0, scale: [2, 2, 2]}],
      meshes: [{primitives: [{attributes: {POSITION: 0}, material: 0}]}],
      materials: [{pbrMetallicRoughness: {baseColorTexture: {index: 0}}}], textures: [{source: 0}],
      images: [{uri: 'picture.png'}],
      accessors: [{bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0]}],
      bufferViews: [{buffer: 0, byteLength: 36}], buffers: [{byteLength: 36, uri}],
    });
  }
  /** The same in one binary file: a header, and chunks of JSON and of the buffer. */
  function glb() {
    const json = Buffer.from(gltf());
    const padded = Buffer.concat([json, Buffer.alloc(-json.length & 3, ' ')]);
    const words = (...all) => Buffer.from(new Uint32Array(all).buffer);
    const chunks = [words(padded.length, 0x4e4f534a), padded, words(corners.length, 0x004e4942), corners];
    const length = chunks.reduce((sum, chunk) => sum + chunk.length, 12);
    return Buffer.concat([words(0x46546c67, 2, length), ...chunks]);
  }

  const corners = Buffer.from(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]).buffer);
  const INSIDE = `data:application/octet-stream;base64,${corners.toString('base64')}`;
  const floats = () => page.evaluate(() => [...window.shaftcullPage.state.floats]);

  test('AnObjIsOpenedAndItsTrianglesAreAskedAllKinds', async () => {
    await open();
    await drop({name: 'cube.obj', text: CUBE});
    await nameOfScene('cube.obj');
    for (const wanted of ['triangles', 'boxes']) {
      await page.selectOption('#test', wanted);
      for (const kind of KINDS) {
        await page.selectOption('#kind', kind);
        const {counts, answered} = await state();
        assert.ok(answered, kind);
        assert.equal(counts.outside + counts.overlap + (counts.inside ?? 0), 12, kind);
      }
    }
    await page.selectOption('#kind', 'between');
    assert.ok((await state()).counts.overlap > 0);
    await shot('obj');
    await page.selectOption('#scene', 'city');
    await nameOfScene('city: 200,000 boxes');
  });

  test('AGltfIsOpenedWithItsBufferInsideOrBeside', async () => {
    await open();
    await drop({name: 'binary.glb', bytes: [...glb()]});
    await nameOfScene('binary.glb');
    await drop({name: 'inside.gltf', text: gltf(INSIDE)});
    await nameOfScene('inside.gltf');
    await drop({name: 'beside.gltf', text: gltf('corners.bin')}, {name: 'corners.bin', bytes: [...corners]});
    await nameOfScene('beside.gltf');
    assert.deepEqual(await floats(), [0, 0, 0, 2, 0, 0, 0, 2, 0]);
  });

  test('MorphTargetsAreAppliedAsTheirWeightsSay', async () => {
    await open();
    const text = gltf(INSIDE).replace('"material":0}]', '"material":0,"targets":[{"POSITION":0}]}],"weights":[0.5]');
    await drop({name: 'morph.gltf', text});
    await nameOfScene('morph.gltf');
    assert.deepEqual(await floats(), [0, 0, 0, 3, 0, 0, 0, 3, 0]);
  });

  test('LinesAndPointsOfAnObjCostNoTriangle', async () => {
    await open();
    const wall = 'o wall\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\nl 1 2\np 3\n';
    await drop({name: 'house.obj', text: `${wall}o roof\nv 0 0 5\nv 1 0 5 # an eave\nv 0 1 5\nf -3 -2 -1 # the gable\n`});
    await nameOfScene('house.obj');
    assert.deepEqual(await floats(), [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 5, 1, 0, 5, 0, 1, 5]);
    await page.selectOption('#scene', 'sphereflake');
    await nameOfScene('sphereflake: 66,430 spheres');
    await page.selectOption('#scene', 'file');
    await nameOfScene('house.obj');
  });

  test('OfTrianglesItIsSaidThatBoxesAroundThemAreHitFirst', async () => {
    await open();
    await drop({name: 'cube.obj', text: CUBE});
    await nameOfScene('cube.obj');
    await page.selectOption('#kind', 'swept');
    await state();
    assert.match(await page.textContent('#first'), /box around .*Triangles themselves have no times/);
  });

  test('ABrokenFileIsToldByNameAndLosesNothing', async () => {
    await open();
    const before = await state();
    const cases = [
      [[{name: 'broken.gltf', text: '{"asset": '}], /broken\.gltf cannot be read/],
      [[{name: 'broken.glb', bytes: [103, 108, 84, 70, 2, 0, 0, 0]}], /broken\.glb cannot be read/],
      [[{name: 'alone.gltf', text: gltf('corners.bin')}], /alone\.gltf cannot be read: it needs corners\.bin/],
      [[{name: 'empty.obj', text: ''}], /empty\.obj has no triangles/],
      [[{name: 'nan.obj', text: 'v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n'}], /nan\.obj: triangle 0 .* NaN/],
      [[{name: 'short.obj', text: 'v 0 0 0\nf 1 2 3\n'}], /short\.obj: triangle 0/],
      [[{name: 'picture.png', bytes: [1, 2, 3]}], /picture\.png is no glTF, GLB or OBJ file/],
      [[{name: 'null.gltf', text: 'null'}], /null\.gltf cannot be read: it is damaged or incomplete\. The scene is/],
      [[{name: 'empty.glb', text: ''}], /empty\.glb cannot be read: it is damaged or incomplete\. The scene is/],
      [[{name: 'short.glb', bytes: [...glb().subarray(0, -8)]}], /short\.glb cannot be read: it is damaged/],
      [[{name: 'bare.gltf', text: '{"asset": {"version": "2.0"}}'}],
       /bare\.gltf cannot be read: it has no scene\. The/],
      [[{name: 'more.gltf', text: gltf(INSIDE).replace('{', '{"extensionsRequired": ["ACME_spheres"],')}],
       /more\.gltf cannot be read: it needs the extension ACME_spheres/],
      [[{name: 'comma.obj', text: 'v 0 0 0\nv 1,5 0 0\nv 0 1 0\nf 1 2 3\n'}], /comma\.obj .* line 2: 1,5 is no number/],
      [[{name: 'half.obj', text: 'v 0 0 0\nv 1 0 0\nv 0 1 \\\n0\nf 1.5 2 3 # c d\n'}],
       /half\.obj .* line 5: 1\.5 is no corner/],
      [[{name: 'lines.obj', text: 'v 0 0 0\nv 1 0 0\nl 1 2\n'}], /lines\.obj has no triangles/],
      [[{name: 'one.obj', text: CUBE}, {name: 'two.obj', text: CUBE}], /one\.obj and two\.obj .* one at a time/],
    ];
    for (const [files, expected] of cases) assert.match(await dropBroken(...files), expected);
    await drop({name: 'picture.png', bytes: [1]});
    await page.waitForSelector('#message:not([hidden])');
    await shot('broken_file');
    assert.deepEqual((await state()).counts, before.counts);
    assert.equal((await state()).name, before.name);
  });
});

describe('what sees what', () => {
  test('PairsAddUpAndAPatchCanBePicked', async () => {
    await open();
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
    await page.focus('#canvas');
    const picked = await page.inputValue('#patch');
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
  page = await browser.newPage(DESKTOP);
  errors = [];
  const asked = [];
  page.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) asked.push(request.url()); });
  await page.goto(built);
  await page.waitForFunction(() => window.shaftcullPage?.state.answer, undefined, PATIENCE);
  assert.deepEqual(asked, []);
});

test('WithoutWebGlHashesAreComparedAllTheSame', async () => {
  page = await browser.newPage(DESKTOP);
  errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  await page.addInitScript(() => { HTMLCanvasElement.prototype.getContext = () => null; });
  await page.goto(built);
  await page.waitForSelector('#message:not([hidden])', PATIENCE);
  assert.match(await page.textContent('#message p'), /Pictures need WebGL 2/);
  await shot('no_webgl');
  await page.click('#same-quick');
  await page.waitForSelector('#same-quick:enabled', PATIENCE);
  assert.match(await page.textContent('#same-summary'), /^All \d+ are the same/);
});

test('APictureThatWasLostComesBack', async () => {
  await open();
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
