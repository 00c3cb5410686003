// SPDX-License-Identifier: MIT
// Random numbers by integer arithmetic alone, so that a seed gives the same scene on every machine.

/** Numbers from a seed, by Marsaglia's xorshift with 32 bits. */
export class Random {
  #state;

  constructor(seed) {
    this.#state = seed | 0 || 1;
  }

  /** An integer from 0 to n − 1. */
  below(n) {
    this.#state ^= this.#state << 13;
    this.#state ^= this.#state >>> 17;
    this.#state ^= this.#state << 5;
    return (this.#state >>> 0) % n;
  }
}
