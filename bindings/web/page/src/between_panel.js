// SPDX-License-Identifier: MIT
// The controls and figures of "What is in the way?".
import {byId, tableRow, written} from './html.js';
import {hideMessage} from './message.js';
import {ANSWERS} from './palette.js';
import {VOLUMES} from './volumes.js';

/** What a row of the counts means. */
const MEANINGS = {
  outside: 'outside',
  overlap: 'overlap',
  inside: 'inside',
  blocks: 'overlap, and hide all of B',
  cut: 'cut by this step',
  reached: 'of all these: reached by now',
};
const NOUNS = {boxes: 'box', spheres: 'sphere', triangles: 'the box around triangle'};
const COARSE = 0.05;  // ms: clocks of browsers tick in a tenth of one
const FILE = 'file';

export class BetweenPanel {
  labels = {a: byId('label-a'), b: byId('label-b')};
  #step = 0;
  #stepCount = 1;
  #rows = {};
  #actions;

  constructor(ownScenes) {
    fillSelect(byId('scene'), Object.entries(ownScenes).map(([key, {name}]) => [key, name]));
    fillSelect(byId('kind'), Object.entries(VOLUMES).map(([key, {name}]) => [key, name]));
    for (const answer of ANSWERS) this.#rows[answer] = this.#addCount(answer);
    this.#showKind();
  }

  #addCount(answer) {
    const number = document.createElement('td');
    number.className = 'number';
    const row = document.createElement('tr');
    row.innerHTML = `<td><label class="check"><input type="checkbox" checked> <span class="swatch ${answer}"></span>
      <span class="meaning"></span></label></td>`;
    row.append(number);
    byId('counts').tBodies[0].append(row);
    row.querySelector('input').addEventListener('change', () => this.#actions.change());
    return {row, number, box: row.querySelector('input'), meaning: row.querySelector('.meaning')};
  }

  /** Ties controls to what they do. */
  connect(actions) {
    this.#actions = actions;
    byId('scene').addEventListener('change', (event) => {
      hideMessage();
      if (event.target.value === FILE) actions.openFile();
      else actions.openOwn(event.target.value);
    });
    byId('kind').addEventListener('change', () => this.#showKind());
    for (const id of ['bodies', 'kind', 'test', 'open-contact', 'shaft-shown', 'wander', 'stepping']) {
      byId(id).addEventListener('change', actions.change);
    }
    for (const radio of document.getElementsByName('selected')) radio.addEventListener('change', actions.change);
    byId('time').addEventListener('input', actions.change);
    byId('size').addEventListener('input', (event) => actions.resize(2 ** ((event.target.value - 50) / 25)));
    byId('to-first').addEventListener('click', actions.toFirst);
    byId('all').addEventListener('click', actions.lookAtAll);
    byId('near').addEventListener('click', actions.lookAtBoxes);
    byId('restart').addEventListener('click', actions.restart);
    byId('step-back').addEventListener('click', () => this.#goToStep(this.#step - 1));
    byId('step-on').addEventListener('click', () => this.#goToStep(this.#step + 1));
    for (const button of document.querySelectorAll('[data-move]')) {
      button.addEventListener('click', () => actions.move(button.dataset.move.split(' ').map(Number)));
    }
  }

  get kind() { return byId('kind').value; }
  get test() { return byId('test').value; }
  get contact() { return byId('open-contact').checked ? 'open' : 'closed'; }
  get time() { return Number(byId('time').value); }
  get bodies() { return byId('bodies').checked; }
  get wander() { return byId('wander').checked; }
  get selected() { return document.querySelector('[name="selected"]:checked').value; }
  get stepping() { return byId('stepping').checked && Boolean(VOLUMES[this.kind].twoEnds); }
  get step() { return this.#step; }

  /** Which answers, and whether the volume, are shown. */
  get shown() {
    const shown = Object.fromEntries(ANSWERS.map((answer) => [answer, this.#rows[answer].box.checked]));
    return {...shown, volume: byId('shaft-shown').checked};
  }

  select(name) {
    document.querySelector(`[name="selected"][value="${name}"]`).checked = true;
    this.#actions.change();
  }

  stopWandering() {
    byId('wander').checked = false;
  }

  setTime(time) {
    byId('time').value = Math.ceil(time * 1000) / 1000;
    this.#actions.change();
  }

  #goToStep(step) {
    this.#step = step;
    this.#actions.change();
  }

  #showKind() {
    const {asks, ends, twoEnds, moves, hull} = VOLUMES[this.kind];
    byId('asks').textContent = asks;
    ['a', 'b'].forEach((name, i) => {
      byId(`name-${name}`).textContent = `${name.toUpperCase()}: ${ends[i]}`;
      this.labels[name].textContent = `${name.toUpperCase()} ${ends[i].replace(/^box .$/, '')}`;
    });
    byId('planes').hidden = !twoEnds;
    byId('time-row').hidden = !moves;
    byId('open-contact').disabled = Boolean(hull);
    byId('test').disabled = Boolean(hull);
  }

  /** After another scene was opened. The last file of the user has an entry of its own. */
  showScene({name, shape}, hasBodies) {
    const select = byId('scene');
    if (shape === 'triangles') {
      const file = [...select.options].find((option) => option.value === FILE);
      const option = file ?? select.appendChild(new Option('', FILE));
      option.textContent = name;
      select.value = FILE;
    }
    byId('triangle-test').hidden = shape !== 'triangles';
    byId('bodies').checked = false;
    byId('bodies-row').hidden = !hasBodies;
  }

  /** The slider of sizes, for a factor from 1/4 to 4; points have none. */
  showSize(factor, isPoint) {
    byId('size').value = 50 + 25 * Math.log2(factor);
    byId('size').disabled = Boolean(isPoint);
  }

  showCounts(counts) {
    for (const answer of ANSWERS) {
      const {row, number, meaning} = this.#rows[answer];
      row.hidden = counts[answer] === undefined;
      number.textContent = written(counts[answer] ?? 0);
      meaning.textContent = this.#meaningOf(answer);
    }
    byId('time-value').textContent = this.time.toFixed(3);
  }

  #meaningOf(answer) {
    return answer === 'overlap' && this.stepping ? 'left after it' : MEANINGS[answer];
  }

  /** What is hit first, of bounds of a shape. */
  showFirst(first, shape, noun = NOUNS[shape]) {
    const told = (index, time) => `${noun} ${written(index)} at time ${time.toFixed(4)}, marked in the picture`;
    const none = shape === 'triangles' ? 'It hits no box around a triangle.' : 'It hits nothing.';
    const note = shape === 'triangles' ? ' Triangles themselves have no times.' : '';
    byId('first').textContent = (first ? `First contact: ${told(first.index, first.time)}.` : none) + note;
    byId('to-first').disabled = !first;
  }

  /** While there is no answer. */
  showNoFirst() {
    byId('first').textContent = '';
    byId('to-first').disabled = true;
  }

  /** How many bounds are left after each step; none while they are not stepped through. */
  showSteps(left, length) {
    byId('steps').hidden = !left;
    if (!left) return;
    this.#stepCount = left.length;
    this.#step = Math.min(Math.max(this.#step, 0), left.length - 1);
    byId('step-back').disabled = this.#step === 0;
    byId('step-on').disabled = this.#step === left.length - 1;
    byId('step-name').textContent = `step ${this.#step} of ${left.length - 1}: ${nameOfStep(this.#step)}`;
    byId('step-rows').replaceChildren(...left.map((kept, k) => {
      const row = tableRow(nameOfStep(k), written((k > 0 ? left[k - 1] : length) - kept), written(kept));
      row.classList.toggle('current', k === this.#step);
      return row;
    }));
  }

  /**
   * Tells why there is no answer: beside the picture, in its corner, and to screen readers. Without a message there is
   * an answer.
   */
  showTrouble(message = '') {
    byId('trouble').textContent = message;
    byId('trouble').hidden = message === '';
    if (message === '') return;
    byId('library-time').textContent = '–';
    byId('bodies-time').hidden = true;
    byId('legend').textContent = message;
    byId('status').textContent = message;
  }

  /** The mean of the last frames; in a corner of the picture, too, with what is kept. There may be bodies. */
  showLibraryTime(milliseconds, {overlap = 0, inside = 0}, length, bodies) {
    const time = shortTime(milliseconds);
    const left = this.stepping ? `left after step ${this.#step}` : 'kept';
    byId('library-time').textContent = time;
    byId('legend').textContent = `${written(overlap + inside)} of ${written(length)} ${left}, library ${time} a frame`;
    byId('bodies-time').hidden = !bodies;
    if (!bodies) return;
    const count = written(bodies.length);
    const changes = shortTime(bodies.meanMilliseconds);
    byId('legend').append(`; ${count} bodies, changes and commit: ${changes}`);
    byId('bodies-time').textContent = `This includes changes and commit of ${count} bodies: ${changes}.`;
  }

  showSpeed(microseconds) {
    const ids = {listTree: 'list-tree', listFlat: 'list-flat', countTree: 'count-tree', countFlat: 'count-flat'};
    for (const [key, id] of Object.entries(ids)) {
      byId(id).textContent = written(Number(microseconds[key].toPrecision(3)));
    }
  }

  /** Tells those who do not see the picture. */
  announce(counts) {
    const told = ([answer, count]) => `${this.#meaningOf(answer)} ${written(count)}`;
    byId('status').textContent = Object.entries(counts).map(told).join(', ');
  }
}

function shortTime(milliseconds) {
  return milliseconds < COARSE ? 'less than 0.1 ms' : `${milliseconds.toFixed(2)} ms`;
}

function nameOfStep(k) {
  return k === 0 ? 'box around both' : `plane ${k}`;
}

function fillSelect(select, entries) {
  select.replaceChildren(...entries.map(([value, text]) => new Option(text, value)));
}
