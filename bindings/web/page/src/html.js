// SPDX-License-Identifier: MIT
// Short words for what the page's markup is asked.

export function byId(id) {
  return document.getElementById(id);
}

/** A number as English writes it: 200,000. */
export function written(number) {
  return number.toLocaleString('en');
}

/** A row of a table: its heading, and numbers. */
export function tableRow(heading, ...numbers) {
  const row = document.createElement('tr');
  const head = document.createElement('th');
  head.scope = 'row';
  head.textContent = heading;
  row.append(head, ...numbers.map((number) => {
    const cell = document.createElement('td');
    cell.className = 'number';
    cell.textContent = number;
    return cell;
  }));
  return row;
}
