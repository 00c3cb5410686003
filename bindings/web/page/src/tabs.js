// SPDX-License-Identifier: MIT
// Tabs as the ARIA practices describe them: arrow keys, Home and End move between them, Tab leaves them.

/** Calls back with the name of the panel that is shown. */
export function tabs(list, onShow) {
  const all = [...list.querySelectorAll('[role="tab"]')];
  const show = (tab) => {
    for (const other of all) {
      other.setAttribute('aria-selected', String(other === tab));
      other.tabIndex = other === tab ? 0 : -1;
      document.getElementById(other.getAttribute('aria-controls')).hidden = other !== tab;
    }
    onShow(tab.getAttribute('aria-controls'));
  };
  for (const tab of all) tab.addEventListener('click', () => show(tab));
  list.addEventListener('keydown', (event) => {
    const usable = all.filter((tab) => !tab.disabled);
    const at = usable.indexOf(document.activeElement);
    const to = {ArrowLeft: at - 1, ArrowRight: (at + 1) % usable.length, Home: 0, End: -1}[event.key];
    if (to === undefined) return;
    event.preventDefault();
    const next = usable.at(to);
    next.focus();
    show(next);
  });
}
