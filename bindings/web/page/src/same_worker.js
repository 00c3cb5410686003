// SPDX-License-Identifier: MIT
// Hashes one family in one way at a time, beside the page. Asked {module, family, way, quick}, it tells
// {hash, record} or {error}.
import {load} from 'shaftcull';

let library;

onmessage = async ({data: {module, family, way, quick}}) => {
  try {
    library ??= await load(module);
    postMessage(library.hash(family, way, {quick}));
  } catch (error) {
    postMessage({error: error.message});
  }
};
