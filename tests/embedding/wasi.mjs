// SPDX-License-Identifier: MIT
// Runs a program of wasm32-wasi in node, as a shell runs one: `wasi.mjs PROGRAM [argument…]`.
import {readFile} from 'node:fs/promises';
import {argv, exit} from 'node:process';
import {WASI} from 'node:wasi';

const wasi = new WASI({version : 'preview1', args : argv.slice(2), env : {}});
const program = await WebAssembly.compile(await readFile(argv[2]));
exit(wasi.start(await WebAssembly.instantiate(program, {wasi_snapshot_preview1 : wasi.wasiImport})));
