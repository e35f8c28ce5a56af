// The run as C++ packed it (report.cpp): facts as JSON; meshes and frames as deflated arrays in one base64 blob.
'use strict';

const facts = JSON.parse(document.getElementById('data').textContent);

function bytesOf(base64) {
  const text = atob(base64), out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) out[i] = text.charCodeAt(i);
  return out;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

// Takes typed arrays off a buffer, one after the other; each starts at a multiple of four.
class Taker {
  constructor(buffer) { this.buffer = buffer; this.at = 0; }
  take(Type, count) {
    const array = new Type(this.buffer, this.at, count);
    this.at += Math.ceil(count * Type.BYTES_PER_ELEMENT / 4) * 4;
    return array;
  }
}

async function loadMesh(blob, mesh) {
  const taker = new Taker(await inflate(blob.subarray(mesh.at, mesh.at + mesh.bytes)));
  return {
    start: taker.take(Float32Array, 3 * mesh.vertices),
    triangles: taker.take(Uint32Array, 3 * mesh.faces),
    materials: taker.take(Uint8Array, mesh.vertices),
  };
}

// What a frame moved: vertices, and how far from the start, in steps of `step` metres.
async function loadFrame(blob, frame) {
  const taker = new Taker(await inflate(blob.subarray(frame.at, frame.at + frame.bytes)));
  return {
    vertices: taker.take(Uint32Array, frame.moved),
    offset: taker.take(Int16Array, 3 * frame.moved),
  };
}

async function loadRun() {
  const blob = bytesOf(document.getElementById('blob').textContent);
  const meshes = await Promise.all(facts.meshes.map((mesh) => loadMesh(blob, mesh)));
  const frames = await Promise.all(facts.frames.map((frame) => loadFrame(blob, frame)));
  return { meshes, frames };
}
