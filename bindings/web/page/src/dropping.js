// SPDX-License-Identifier: MIT
// Files that are dropped on the page, or chosen by its button.
import {byId} from './html.js';

/** Calls back with an array of files. */
export function onFiles(callback) {
  const hint = byId('drop-hint');
  addEventListener('dragover', (event) => {
    event.preventDefault();
    hint.hidden = false;
  });
  addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) hint.hidden = true;
  });
  addEventListener('drop', (event) => {
    event.preventDefault();
    hint.hidden = true;
    if (event.dataTransfer.files.length > 0) callback([...event.dataTransfer.files]);
  });
  byId('open').addEventListener('click', () => byId('file').click());
  byId('file').addEventListener('change', ({target}) => {
    if (target.files.length > 0) callback([...target.files]);
    target.value = '';
  });
}
