// SPDX-License-Identifier: MIT
// One message over the page, until it is closed.
import {byId} from './html.js';

const box = byId('message');
box.querySelector('button').addEventListener('click', hideMessage);

export function showMessage(text) {
  box.querySelector('p').textContent = text;
  box.hidden = false;
}

export function hideMessage() {
  box.hidden = true;
}
