// SPDX-License-Identifier: MIT
// One question to the library: which bounds of scenes overlap a volume, are inside it, block it, and are hit first.
import {Stopwatch} from './stopwatch.js';
import {VOLUMES, travelUntil} from './volumes.js';

const NONE = new Uint32Array(0);

/** Which of a scene's bounds a question is put to: triangles as they are, or boxes (around them) and spheres. */
export function boundsFor(scene, question) {
  const exactly = scene.triangles && question.test === 'triangles' && !VOLUMES[question.kind].hull;
  return exactly ? scene.triangles : scene.bounds;
}

/**
 * Forms the volume of a question: {kind, a, b, contact, test, time}. a and b are boxes, `time` is how far a moving body
 * has come, from 0 to 1. The caller frees it.
 */
function form(library, {kind, a, b, contact}) {
  return VOLUMES[kind].form(library, a, b, contact);
}

/**
 * All answers to a question about scenes. `parts` has an answer for each scene: `overlap`, `inside` and `blocks` are
 * indices; what blocks is among what overlaps. Of bodies that move, `reached` has the indices of what is hit until
 * `time`, and `first` is what is hit first of all scenes: {part, index, time}. `points` are those of a hull, 3 floats
 * each. `milliseconds` is what the library took. Throws an Error if there is no such volume.
 */
export function ask(library, scenes, question) {
  const kind = VOLUMES[question.kind];
  const trouble = kind.trouble?.(question.a, question.b);
  if (trouble) throw new Error(trouble);
  const stopwatch = new Stopwatch();
  const volume = form(library, question);
  try {
    const parts = scenes.map((scene) => partOf(scene, question, volume));
    const answer = {parts, points: volume.points};
    if (kind.moves) {
      answer.first = firstOf(scenes, volume);
      const lists = reached(library, scenes, question);
      parts.forEach((part, i) => { part.reached = lists[i]; });
    }
    answer.milliseconds = stopwatch.milliseconds();
    return answer;
  } finally {
    volume.free();
  }
}

function partOf(scene, question, volume) {
  const part = {...boundsFor(scene, question).tree.listClassified(volume), blocks: NONE, reached: NONE};
  if (VOLUMES[question.kind].twoEnds && scene.shape === 'boxes') part.blocks = scene.bounds.tree.listOccluders(volume);
  return part;
}

/** What is hit first; of triangles, the boxes around them. */
function firstOf(scenes, volume) {
  const hits = scenes.map(({bounds: {tree}}, part) => ({...tree.firstContact(volume), part}));
  return hits.filter(({index}) => index !== undefined).sort((p, q) => p.time - q.time)[0];
}

/** What a moving body hits of each scene until a time: what it sweeps until then keeps. */
function reached(library, scenes, question) {
  const {a, b, contact, time} = question;
  const volume = library.swept(a, travelUntil(a, b, time), {contact});
  try {
    return scenes.map((scene) => boundsFor(scene, question).tree.list(volume));
  } finally {
    volume.free();
  }
}

/** What lists and counts take of a tree and flat, in µs a query: each repeated for some milliseconds. */
export function measure(library, scene, question) {
  const {tree, flat} = boundsFor(scene, question);
  const volume = form(library, question);
  try {
    return {
      listTree: microseconds(() => tree.listClassified(volume)),
      listFlat: microseconds(() => flat.listClassified(volume)),
      countTree: microseconds(() => tree.count(volume)),
      countFlat: microseconds(() => flat.count(volume)),
    };
  } finally {
    volume.free();
  }
}

/** Repeats a call until it is long enough for the clocks of browsers, which are coarse. */
function microseconds(call) {
  const stopwatch = new Stopwatch();
  let calls = 0;
  do {
    call();
    calls += 1;
  } while (stopwatch.milliseconds() < 8);
  return (1000 * stopwatch.milliseconds()) / calls;
}
