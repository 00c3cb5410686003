// SPDX-License-Identifier: MIT
// Objects of the library: each is released by free(), or once it is garbage.
export class Held {
  #handle;
  #release;

  constructor(module, release, handle) {
    this.module = module;
    this.#release = release;
    this.#handle = handle;
    module.watch(this, release, handle);
  }

  get handle() {
    if (this.#handle === 0) throw new TypeError('this object was freed');
    return this.#handle;
  }

  free() {
    if (this.#handle === 0) return;
    this.module.unwatch(this);
    this.module.call(this.#release, this.#handle);
    this.#handle = 0;
  }
}

/** Calls a function of the C interface that makes an object, whose last argument is where its handle goes. */
export function made(module, name, ...values) {
  return module.scratch((scratch) => {
    const out = scratch.zeros(4);
    module.call(name, ...values, out);
    return module.word(out);
  });
}

/** The result of use(make); make(release, create, ...values) makes an object that is released afterwards. */
export function withHandles(module, use) {
  const held = [];
  try {
    return use((release, create, ...values) => {
      const handle = made(module, create, ...values);
      held.push([release, handle]);
      return handle;
    });
  } finally {
    for (const [release, handle] of held.reverse()) module.call(release, handle);
  }
}
