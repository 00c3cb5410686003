// SPDX-License-Identifier: MIT
// What OBJLoader takes without a word, and should not.

const COORDINATE = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const CORNER = /^-?\d+(\/-?\d*){0,2}$/;
const NOT_FINITE = /^[+-]?(nan|inf|infinity)$/i;  // told later, with the triangle
const CONTINUED = /\\\r?\n/g;

/**
 * The text of an OBJ file without its points and lines: one of them makes OBJLoader drop all faces of its object.
 * Throws an Error that names the line where a coordinate is no number, or a corner of a face no index.
 */
export function facesAlone(text) {
  const kept = [];
  let number = 1;
  for (const line of text.replace(CONTINUED, '\0').split(/\r?\n/)) {
    const statement = facesOrMore(line.replaceAll('\0', ' '), number);
    if (statement !== undefined) kept.push(statement);
    number += line.split('\0').length;
  }
  return kept.join('\n');
}

/** A line, checked; undefined for points and lines. */
function facesOrMore(line, number) {
  const [keyword] = line.trim().split(/\s+/);
  if (keyword === 'l' || keyword === 'p') return undefined;
  if (keyword !== 'v' && keyword !== 'f') return line;
  const [statement] = line.split('#');  // a comment may follow
  const words = statement.trim().split(/\s+/).slice(1);
  if (keyword === 'v') check(words.slice(0, 3), COORDINATE, 'number', number);
  else check(words, CORNER, 'corner of a face', number);
  return statement;
}

function check(words, pattern, what, number) {
  const bad = words.find((word) => !pattern.test(word) && !NOT_FINITE.test(word));
  if (bad !== undefined) throw new Error(`line ${number}: ${bad} is no ${what}.`);
}
