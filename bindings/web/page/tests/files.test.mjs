// SPDX-License-Identifier: MIT
// Files that are dropped on the page, whole and broken.
import assert from 'node:assert/strict';
import {describe, test} from 'node:test';
import {KINDS, drop, dropBroken, nameOfScene, open, openDrawn, page, shot, state} from './opened_page.mjs';

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
    await openDrawn();
    await drop({name: 'cube.obj', text: CUBE});
    await nameOfScene('cube.obj');
    for (const wanted of ['triangles', 'boxes']) {
      await page.selectOption('#test', wanted);
      for (const kind of KINDS) {
        await page.selectOption('#kind', kind);
        const {counts, answered} = await state();
        assert.ok(answered, kind);
        assert.equal(counts.outside + counts.overlap + counts.inside, 12, kind);
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
