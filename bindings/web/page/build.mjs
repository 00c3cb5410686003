// SPDX-License-Identifier: MIT
// Makes the page one HTML file that needs nothing else:
//
//     node build.mjs PACKAGE_FOLDER OUT.html [--modules FOLDER]
//
// PACKAGE_FOLDER has the built package, shaftcull.js and shaftcull.wasm among others. FOLDER is a node_modules that has
// esbuild and three; without it, the one beside this file.
import {mkdir, readFile, writeFile} from 'node:fs/promises';
import {createRequire} from 'node:module';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {parseArgs} from 'node:util';

const here = dirname(fileURLToPath(import.meta.url));
const {values, positionals} = parseArgs({allowPositionals: true, options: {modules: {type: 'string'}}});
if (positionals.length !== 2) {
  console.error('Usage: node build.mjs PACKAGE_FOLDER OUT.html [--modules FOLDER]');
  process.exit(2);
}
const [packageFolder, out] = positionals.map((path) => resolve(path));
const modules = resolve(values.modules ?? join(here, 'node_modules'));
const esbuild = createRequire(join(modules, 'page.js'))('esbuild');

/** Options of everything that is bundled. */
const common = {
  bundle: true,
  write: false,
  minify: true,
  legalComments: 'inline',
  target: 'es2022',
  nodePaths: [modules],
  loader: {'.wasm': 'binary'},
  logLevel: 'warning',
};

/** Old browsers start no modules as workers. Scripts have no import.meta, but only load() without a module needs it. */
const workerOptions = {format: 'iife', logOverride: {'empty-import-meta': 'silent'}};

/** `shaftcull` is the built package. */
const packagePlugin = {
  name: 'package',
  setup(build) {
    build.onResolve({filter: /^shaftcull$/}, () => ({path: join(packageFolder, 'shaftcull.js')}));
    build.onResolve({filter: /^shaftcull\/shaftcull\.wasm$/}, () => ({path: join(packageFolder, 'shaftcull.wasm')}));
  },
};

/** `worker:FILE` is the text of a script that holds FILE and all it needs. */
const workerPlugin = {
  name: 'worker',
  setup(build) {
    build.onResolve({filter: /^worker:/}, ({path, resolveDir}) => (
      {path: join(resolveDir, path.slice('worker:'.length)), namespace: 'worker'}));
    build.onLoad({filter: /.*/, namespace: 'worker'}, async ({path}) => (
      {contents: await bundled(path, {...workerOptions, plugins: [packagePlugin]}), loader: 'text'}));
  },
};

async function bundled(entry, options) {
  const {outputFiles} = await esbuild.build({...common, ...options, entryPoints: [entry]});
  return outputFiles[0].text;
}

const script = await bundled(join(here, 'src', 'main.js'), {format: 'esm', plugins: [packagePlugin, workerPlugin]});
const style = await readFile(join(here, 'style.css'), 'utf8');
const page = (await readFile(join(here, 'index.html'), 'utf8'))
  .replace('<!-- style -->', () => style)
  .replace('<!-- script -->', () => script);
await mkdir(dirname(out), {recursive: true});
await writeFile(out, page);
console.log(`${out}: ${(Buffer.byteLength(page) / 2 ** 20).toFixed(1)} MiB`);
