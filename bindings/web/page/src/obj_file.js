// SPDX-License-Identifier: MIT
// What OBJLoader takes without a word, and should not.

const COORDINATE = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const CORNER = /^-?\d+(\/-?\d*){0,2}$/;
const NOT_FINITE = /^[+-]?(nan|inf|infinity)$/i;  // told later, with the triangle

/**
 * The text of an OBJ file without its points and lines: one of them makes OBJLoader drop all faces of its object.
 * Throws an Error that names the line where a coordinate is no number, or a corner of a face no index.
 */
export function facesAlone(text) {
  const lines = text.replace(/\\\r?\n/g, ' ').split(/\r?\n/);
  lines.forEach((line, i) => {
    const [keyword, ...words] = line.trim().split(/\s+/);
    const check = (checked, pattern, what) => {
      const bad = checked.find((word) => !pattern.test(word) && !NOT_FINITE.test(word));
      if (bad !== undefined) throw new Error(`line ${i + 1}: ${bad} is no ${what}.`);
    };
    if (keyword === 'v') check(words.slice(0, 3), COORDINATE, 'number');
    if (keyword === 'f') check(words.map((word) => word.split('#')[0]).filter(Boolean), CORNER, 'corner of a face');
  });
  return lines.filter((line) => !/^\s*[lp]\s/.test(line)).join('\n');
}
