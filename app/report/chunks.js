"use strict";

// Packed numbers, unpacked when they are first shown: see chunks.py.

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const fromBase64 = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

function unpacked(chunk, planes) {
  const { count, low, step } = chunk;
  const values = new Float32Array(count);
  const wide = chunk.bytes === 2;
  const absent = wide ? 65535 : 255;
  let code = 0;
  for (let i = 0; i < count; ++i) {
    code = (code + planes[i] + (wide ? 256 * planes[count + i] : 0)) & absent;
    values[i] = code === absent ? NaN : low + step * code;
  }
  return values;
}

// Keeps the last arrays that were asked for. `load` gives the packed bytes of a key, or their promise.
class ChunkStore {
  constructor(load, most = 240) {
    this.load = load;
    this.most = most;
    this.kept = new Map();
  }

  values(chunk) {
    const name = [chunk.key, chunk.low, chunk.step, chunk.bytes].join(" ");
    const known = this.kept.get(name);
    if (known) return known;
    const found = Promise.resolve(this.load(chunk.key)).then(inflated).then((planes) => unpacked(chunk, planes));
    found.catch(() => this.kept.delete(name));  // to be asked for again
    this.kept.set(name, found);
    if (this.kept.size > this.most) this.kept.delete(this.kept.keys().next().value);
    return found;
  }
}
