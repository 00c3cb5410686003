// SPDX-License-Identifier: MIT

/** Time since it was made. */
export class Stopwatch {
  #start = performance.now();

  milliseconds() {
    return performance.now() - this.#start;
  }
}

/** The mean of the last numbers, 60 at most. */
export class RunningMean {
  #numbers = [];

  add(number) {
    this.#numbers.push(number);
    if (this.#numbers.length > 60) this.#numbers.shift();
  }

  get mean() {
    return this.#numbers.reduce((sum, number) => sum + number, 0) / this.#numbers.length;
  }
}
