// SPDX-License-Identifier: MIT
// Colours, from the style sheet, which has them for light and for dark.
import {Color} from 'three';

/** Answers that bounds are painted with; their positions are what shaders read. */
export const ANSWERS = ['outside', 'overlap', 'inside', 'blocks', 'cut', 'reached'];

/** The colour that the style sheet calls `--name`. */
export function colour(name) {
  return new Color(getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());
}

/** Calls back when the system changes between light and dark. */
export function onThemeChange(callback) {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', callback);
}

const RAMP = ['#0c1a3a', '#23406f', '#426a9f', '#6f96c6', '#a3c1e3', '#d3e3f5'].map((name) => new Color(name));

/** From dark blue, 0, to pale blue, 1; the style sheet has the same colours for `.ramp`. */
export function rampColour(share) {
  const place = share * (RAMP.length - 1);
  const step = Math.min(Math.floor(place), RAMP.length - 2);
  return RAMP[step].clone().lerp(RAMP[step + 1], place - step);
}
