// SPDX-License-Identifier: MIT
// "What sees what?": of all pairs of patches of two rooms, which see each other, which cannot, and which need rays.
import {byId, tableRow, written} from './html.js';
import {room} from './room.js';
import {SightsPicture} from './sights_picture.js';
import {Eye} from './stage.js';
import {Stopwatch} from './stopwatch.js';

const SIGHTS = ['clear', 'undecided', 'occluded', 'facing_away'];
const WITH_LINES = ['clear', 'undecided', 'occluded'];
const CLICK = 5;  // CSS pixels that a pointer may move and still click

export class SightsPage {
  #library;
  #stage;
  #eye;
  #picture;
  #active = false;
  #pairs;
  #counts;
  #patchCount;
  #down;

  constructor(library, stage) {
    this.#library = library;
    this.#stage = stage;
    this.#eye = new Eye(stage);
    this.#eye.lookAt([4.125, 1.2, 2.5], [0.25, 1.5, 1], 5.6);
    this.#picture = new SightsPicture(this.#eye, WITH_LINES);
    for (const sight of WITH_LINES) this.#addToggle(sight);
    byId('cupboard').addEventListener('input', () => this.#answer());
    byId('patch').addEventListener('input', () => this.#draw());
    byId('patch').addEventListener('change', () => this.#pick(this.#patch));  // shows which one was taken
    for (const radio of document.getElementsByName('share')) radio.addEventListener('change', () => this.#draw());
    stage.canvas.addEventListener('pointerdown', ({offsetX, offsetY}) => { this.#down = [offsetX, offsetY]; });
    stage.canvas.addEventListener('pointerup', (event) => this.#click(event));
  }

  #addToggle(sight) {
    const label = document.createElement('label');
    label.className = 'check';
    label.innerHTML = `<input type="checkbox" id="show-${sight}" checked>
      <span class="swatch ${sight}"></span> lines: ${sight}`;
    byId('sight-shown').append(label);
    byId(`show-${sight}`).addEventListener('change', () => this.#draw());
  }

  setActive(active) {
    this.#active = active;
    if (active) byId('legend').textContent = '';
    this.#eye.controls.enabled = active;
    if (active && !this.#pairs) this.#answer();
  }

  readColours() {
    this.#picture.readColours();
  }

  turn(radians) {
    this.#eye.turn(radians);
  }

  zoom(factor) {
    this.#eye.zoom(factor);
  }

  frame() {
    this.#stage.render(this.#picture);
  }

  /** Arrow keys choose the next or the previous patch. */
  key(event) {
    const step = {ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1}[event.key];
    if (!step) return false;
    this.#pick(this.#patch + step);
    return true;
  }

  /** Asks the library of all pairs. */
  #answer() {
    const scene = room(Number(byId('cupboard').value));
    const stopwatch = new Stopwatch();
    const visibility = this.#library.visibility({patches: scene.boxes, planes: scene.planes, solids: scene.solids});
    const milliseconds = stopwatch.milliseconds();
    this.#counts = visibility.counts;
    this.#pairs = Object.fromEntries(SIGHTS.map((sight) => [sight, visibility.pairs(sight)]));
    this.#patchCount = scene.corners.length;
    byId('patch').max = this.#patchCount - 1;
    const pairs = SIGHTS.reduce((sum, sight) => sum + this.#counts[sight], 0);
    byId('sights-time').textContent =
      `${written(this.#patchCount)} patches, ${written(pairs)} pairs, answered in ${milliseconds.toFixed(0)} ms.`;
    this.#picture.setPatches(scene);
    this.#draw();
    byId('status').textContent = SIGHTS.map((sight) => `${spoken(sight)} ${written(this.#counts[sight])}`).join(', ');
  }

  get #patch() {
    return Math.min(Math.max(Math.trunc(byId('patch').value), 0), this.#patchCount - 1);
  }

  #pick(patch) {
    byId('patch').value = Math.min(Math.max(patch, 0), this.#patchCount - 1);
    this.#draw();
  }

  #draw() {
    this.#paintShares();
    this.#picture.pick(this.#patch);
    const own = Object.fromEntries(SIGHTS.map((sight) => [sight, this.#partners(sight)]));
    for (const sight of WITH_LINES) {
      this.#picture.setLines(sight, this.#patch, byId(`show-${sight}`).checked ? own[sight] : []);
    }
    byId('sight-counts').replaceChildren(...SIGHTS.map((sight) => (
      tableRow(spoken(sight), written(this.#counts[sight]), written(own[sight].length)))));
    this.#stage.schedule();
  }

  /** The other patches of pairs of the picked one. */
  #partners(sight) {
    const pairs = this.#pairs[sight];
    const partners = [];
    for (let p = 0; p < pairs.length; p += 2) {
      if (pairs[p] === this.#patch) partners.push(pairs[p + 1]);
      else if (pairs[p + 1] === this.#patch) partners.push(pairs[p]);
    }
    return partners;
  }

  /** Colours patches by the share of all others that they see; the one that sees the most is palest. */
  #paintShares() {
    const possible = document.querySelector('[name="share"]:checked').value === 'possible';
    const seen = new Float64Array(this.#patchCount);
    for (const sight of possible ? ['clear', 'undecided'] : ['clear']) {
      for (const patch of this.#pairs[sight]) seen[patch] += 1;
    }
    const most = Math.max(...seen, 1);
    this.#picture.paint(seen.map((count) => count / most));
    byId('most').textContent = `${((100 * most) / (this.#patchCount - 1)).toFixed(0)} % of all others`;
  }

  #click(event) {
    if (!this.#active || !this.#down || event.button !== 0) return;
    const [x, y] = this.#down;
    if (Math.hypot(event.offsetX - x, event.offsetY - y) > CLICK) return;
    const {clientWidth: width, clientHeight: height} = this.#stage.canvas;
    const patch = this.#picture.patchAt((2 * x) / width - 1, 1 - (2 * y) / height);
    if (patch !== undefined) this.#pick(patch);
  }
}

function spoken(sight) {
  return sight.replace('_', ' ');
}
