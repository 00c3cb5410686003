// SPDX-License-Identifier: MIT
// What the C library asks the system for: there is a clock, there are no variables of the environment and no files, and
// what is written is kept until somebody asks why the module ended.

const badFile = 8;  // WASI's errno for a file that is not open

export function wasi(view) {
  let output = '';
  const imports = {
    environ_get: () => 0,
    environ_sizes_get(count, bytes) {
      view().setUint32(count, 0, true);
      view().setUint32(bytes, 0, true);
      return 0;
    },
    clock_time_get(clock, precision, time) {
      view().setBigUint64(time, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    fd_close: () => badFile,
    fd_seek: () => badFile,
    fd_write(file, parts, count, written) {
      let bytes = 0;
      for (let part = 0; part !== count; ++part) {
        const first = view().getUint32(parts + 8 * part, true);
        const size = view().getUint32(parts + 8 * part + 4, true);
        output += new TextDecoder().decode(new Uint8Array(view().buffer, first, size).slice());
        bytes += size;
      }
      view().setUint32(written, bytes, true);
      return 0;
    },
    proc_exit(code) {
      throw new WebAssembly.RuntimeError(`the module ended with ${code}`);
    },
  };
  const takeOutput = () => {
    const taken = output;
    output = '';
    return taken;
  };
  return {imports, takeOutput};
}
