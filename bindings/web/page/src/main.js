// SPDX-License-Identifier: MIT
// Loads the library and ties the three pages together.
import {load} from 'shaftcull';
import wasm from 'shaftcull/shaftcull.wasm';
import {BetweenPage} from './between_page.js';
import {BetweenPanel} from './between_panel.js';
import {onFiles} from './dropping.js';
import {byId} from './html.js';
import {readMesh} from './mesh_file.js';
import {hideMessage, showMessage} from './message.js';
import {OWN_SCENES} from './own_scenes.js';
import {onThemeChange} from './palette.js';
import {SamePage} from './same_page.js';
import {SightsPage} from './sights_page.js';
import {Stage} from './stage.js';
import {tabs} from './tabs.js';

const TURN = Math.PI / 12;
const PICTURES = {
  between: 'Scene with two boxes, a volume, and bounds in the colours of their answers',
  sights: 'Two rooms, patches coloured by how much they see',
};

async function start() {
  const module = await WebAssembly.compile(wasm);
  const library = await load(module);
  new SamePage(library, module);
  const tabList = document.querySelector('[role="tablist"]');
  if (!Stage.isPossible) {
    startWithoutPictures(tabList);
    return;
  }
  const stage = new Stage(byId('canvas'), (now) => pages[current]?.frame(now));
  const pages = {
    between: new BetweenPage(library, stage, new BetweenPanel(OWN_SCENES)),
    sights: new SightsPage(library, stage),
  };
  let current = 'between';
  pages.between.openOwn('city');

  const show = (name) => {
    current = name;
    document.body.classList.toggle('wide-panel', !pages[name]);
    for (const [other, page] of Object.entries(pages)) page.setActive(other === name);
    if (pages[name]) {
      byId('canvas').setAttribute('aria-label', PICTURES[name]);
      byId('canvas').setAttribute('aria-describedby', `${name}-keys`);
    }
    byId('sections').scrollTop = 0;
    stage.schedule();
  };
  show(current);
  tabs(tabList, show);
  listenToKeys(byId('canvas'), () => pages[current]);
  onThemeChange(() => {
    for (const page of Object.values(pages)) page.readColours();
    stage.schedule();
  });
  onFiles(async (files) => {
    if (await openFiles(pages.between, files)) byId('tab-between').click();
  });
  byId('fold').addEventListener('click', fold);
  // For tests, and for whoever wants the numbers in the console.
  window.shaftcullPage = {get state() { return pages.between.state; }};
}

/** What needs no pictures works without them. */
function startWithoutPictures(tabList) {
  for (const tab of tabList.querySelectorAll('#tab-between, #tab-sights')) tab.disabled = true;
  tabs(tabList, () => {});
  byId('tab-same').click();
  document.body.classList.add('wide-panel');
  byId('status').textContent = '';
  showMessage('Pictures need WebGL 2, which this browser does not have, or which is switched off. '
    + 'Hashes are compared without them.');
}

/** Turning and zooming are the same for all pictures; other keys are the page's own. */
function listenToKeys(canvas, page) {
  const act = {
    '[': () => page().turn(-TURN),
    ']': () => page().turn(TURN),
    '+': () => page().zoom(0.8),
    '-': () => page().zoom(1.25),
  };
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (act[event.key]) act[event.key]();
    else if (!page().key(event)) return;
    event.preventDefault();
  });
  for (const button of document.querySelectorAll('[data-turn]')) {
    button.addEventListener('click', () => page().turn(TURN * Number(button.dataset.turn)));
  }
  for (const button of document.querySelectorAll('[data-zoom]')) {
    button.addEventListener('click', () => page().zoom(Number(button.dataset.zoom)));
  }
}

/** Opens what was dropped, or tells why it cannot be. Then all is as it was. */
async function openFiles(page, files) {
  try {
    const {name, triangles} = await readMesh(files);
    openTriangles(page, name, triangles);
    hideMessage();
    return true;
  } catch (error) {
    showMessage(`${error.message.replace(/[.!]?$/, '.')} The scene is as it was.`);
    return false;
  }
}

function openTriangles(page, name, triangles) {
  try {
    page.openTriangles(name, triangles);
  } catch (error) {
    throw new Error(`${name} cannot be opened: ${error.message}`);
  }
}

/** Hides the controls on a phone, or shows them again. */
function fold() {
  const folded = byId('panel').classList.toggle('folded');
  byId('fold').setAttribute('aria-expanded', String(!folded));
  byId('fold').textContent = folded ? 'Show controls' : 'Hide controls';
}

start().catch((error) => {
  byId('legend').textContent = '';
  showMessage(`The page cannot start: ${error.message}`);
});
