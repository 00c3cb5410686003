// SPDX-License-Identifier: MIT
// Scenes of the page's own.
import {city} from './city.js';
import {sphereflake} from './sphereflake.js';

/**
 * What they are made of, whether bodies can come and go there, where the boxes A and B start, half of their side, and
 * the radius of what is looked at.
 */
export const OWN_SCENES = {
  city: {
    name: 'city: 200,000 boxes',
    shape: 'boxes',
    make: () => city(200000),
    hasBodies: true,
    start: {a: [-110, 34, -50], b: [100, 20, 60], half: 7, radius: 130},
  },
  sphereflake: {
    name: 'sphereflake: 66,430 spheres',
    shape: 'spheres',
    make: () => sphereflake(5),
    start: {a: [-70, 75, 70], b: [75, 50, -40], half: 6, radius: 105},
  },
};
