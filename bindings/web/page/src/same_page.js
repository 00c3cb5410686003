// SPDX-License-Identifier: MIT
// "Is it the same on your machine?": hashes of answers in this browser beside those on record.
import {byId} from './html.js';
import workerSource from 'worker:./same_worker.js';

export class SamePage {
  #families;
  #module;
  #rows = [];
  #stopped;

  constructor(library, module) {
    this.#families = library.hashFamilies;
    this.#module = module;
    for (const family of this.#families) family.ways.forEach((way, w) => this.#addRow(family, way, w));
    byId('same-quick').addEventListener('click', () => this.#run(true));
    byId('same-all').addEventListener('click', () => this.#run(false));
    byId('same-stop').addEventListener('click', () => this.#stopped());
  }

  /** The name of a family spans all its ways. */
  #addRow(family, way, w) {
    const row = byId('same-table').tBodies[0].insertRow();
    if (w === 0) {
      const head = document.createElement('th');
      head.scope = 'rowgroup';
      head.rowSpan = family.ways.length;
      const what = document.createElement('span');
      what.className = 'what';
      what.textContent = family.what;
      head.append(family.name, what);
      row.append(head);
    }
    row.insertCell().textContent = way;
    const [result, hash, record] = [row.insertCell(), row.insertCell(), row.insertCell()];
    hash.append(document.createElement('code'));
    record.append(document.createElement('code'));
    this.#rows.push({family: family.name, way, hash: hash.firstChild, record: record.firstChild, result});
  }

  /** Asks row after row until all are told, or until it is stopped. */
  async #run(quick) {
    const worker = startWorker();
    const stop = new Promise((resolve) => { this.#stopped = () => resolve('stopped'); });
    this.#setRunning(true);
    for (const row of this.#rows) showRow(row, {});
    let [told, different] = [0, 0];
    for (const row of this.#rows) {
      showRow(row, {result: '…'});
      byId('same-summary').textContent = `${told} of ${this.#rows.length} compared: ${row.family}, ${row.way} …`;
      const answer = await Promise.race([this.#ask(worker, row, quick), stop]);
      if (answer === 'stopped') {
        showRow(row, {});
        break;
      }
      told += 1;
      different += showAnswer(row, answer) ? 0 : 1;
    }
    worker.terminate();
    this.#setRunning(false);
    byId('same-summary').textContent = summary(told, this.#rows.length, different, quick);
  }

  #ask(worker, {family, way}, quick) {
    return new Promise((resolve) => {
      worker.onmessage = ({data}) => resolve(data);
      worker.onerror = (event) => resolve({error: event.message ?? 'the worker could not start'});
      worker.postMessage({module: this.#module, family, way, quick});
    });
  }

  #setRunning(running) {
    byId('same-quick').disabled = running;
    byId('same-all').disabled = running;
    byId('same-stop').disabled = !running;
  }
}

function startWorker() {
  const url = URL.createObjectURL(new Blob([workerSource], {type: 'text/javascript'}));
  const worker = new Worker(url);
  URL.revokeObjectURL(url);
  return worker;
}

function showRow(row, {hash = '', record = '', result = '', mark = ''}) {
  row.hash.textContent = hash;
  row.record.textContent = record;
  row.result.textContent = result;
  row.result.className = mark;
}

/** Whether the hash is the one on record. */
function showAnswer(row, {hash, record, error}) {
  const same = !error && hash === record;
  showRow(row, {hash, record, result: error ?? (same ? 'same' : 'different'), mark: same ? 'yes' : 'no'});
  return same;
}

function summary(told, all, different, quick) {
  const cases = quick ? 'quick cases' : 'all cases';
  const stopped = told < all ? ` Stopped after ${told} of ${all}.` : '';
  if (told === 0) return 'Stopped before the first was compared.';
  if (different === 0) return `All ${told} are the same as on record (${cases}).${stopped}`;
  const please = 'an answer is wrong, here or in the record. Please tell us.';
  return `${different} of ${told} differ (${cases}): ${please}${stopped}`;
}
