// SPDX-License-Identifier: MIT
// What answers amount to: how bounds are painted, and how many get which answer.
import {VOLUMES} from './volumes.js';

/** Layers to paint, later ones over earlier ones. */
export function layersOf(answer) {
  return ['overlap', 'inside', 'blocks', 'reached'].map((name) => ({answer: name, indices: answer[name]}));
}

/** Layers of a step through planes: bounds that the step cuts, and bounds that are left after it. */
export function layersOfStep({left}, step) {
  const kept = {answer: 'overlap', indices: left[step]};
  return step > 0 ? [{answer: 'cut', indices: left[step - 1]}, kept] : [kept];
}

/** How many bounds of a scene get each answer; those that are not asked for are not there. */
export function countsOf({overlap, inside, blocks, reached}, scene, question) {
  const kind = VOLUMES[question.kind];
  const outside = scene.length - overlap.length - inside.length;
  const counts = {outside, overlap: overlap.length, inside: inside.length};
  if (kind.twoEnds && scene.shape === 'boxes') counts.blocks = blocks.length;
  if (kind.moves) counts.reached = reached.length;
  return counts;
}

export function countsOfStep({left}, scene, step) {
  const before = step > 0 ? left[step - 1].length : scene.length;
  return {outside: scene.length - before, cut: before - left[step].length, overlap: left[step].length};
}

/** How many bounds of all scenes are left after each step. */
export function keptBySteps(steps) {
  return steps[0].left.map((_, k) => steps.reduce((sum, {left}) => sum + left[k].length, 0));
}

/** Counts of several scenes, which have the same answers, added up. */
export function summed(counts) {
  const names = Object.keys(counts[0]);
  return Object.fromEntries(names.map((name) => [name, counts.reduce((sum, each) => sum + each[name], 0)]));
}
