// SPDX-License-Identifier: MIT
// Runs a program of WebAssembly with its arguments, all files and the variables of the environment, and ends as it does. Programs
// have no exceptions, so two functions stand for them: `attempt` calls a function, and `leave` goes back to the last `attempt`.
import {readFile} from 'node:fs/promises';
import {WASI} from 'node:wasi';

const left = new Error('left a function outside of any attempt');
let exports;

const attempts = {
  /** Calls the function of this number with an address, and returns 0, or 1 if it was left. */
  attempt(call, argument) {
    const stack = exports.__stack_pointer.value;
    try {
      exports.__indirect_function_table.get(call)(argument);
      return 0;
    } catch (error) {
      if (error !== left) throw error;
      exports.__stack_pointer.value = stack;
      return 1;
    }
  },
  leave() {
    throw left;
  },
};

const [file, ...rest] = process.argv.slice(2);
const wasi = new WASI({version: 'preview1', args: [file, ...rest], env: process.env, preopens: {'/': '/'}});
const module = await WebAssembly.compile(await readFile(file));
const instance = await WebAssembly.instantiate(module, {wasi_snapshot_preview1: wasi.wasiImport, attempts});
exports = instance.exports;
process.exitCode = wasi.start(instance) ?? 0;
