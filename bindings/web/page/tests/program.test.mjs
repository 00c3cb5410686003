// SPDX-License-Identifier: MIT
// The page against the program: the same counts of the same scene.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, describe, test} from 'node:test';
import {KINDS, drop, nameOfScene, open, page, program, state} from './opened_page.mjs';

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
      sun: [`--from=${b}`, `--swept=${way(b, a)}`, '--infinite'], swept: [`--from=${a}`, `--swept=${way(a, b)}`],
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
      assert.equal(counts.overlap + counts.inside, candidates.length, kind);
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
