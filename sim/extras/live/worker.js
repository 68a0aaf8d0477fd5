// SPDX-License-Identifier: Apache-2.0
// Draws frames in the background. A worker holds the core (set-up, golden model, reference, comparison) and the
// hardware of one key. Each is a WebAssembly module with its own memory; this file copies between the two.
"use strict";

let names = null;  // of the core's settings, figures, shaders, presets and pictures, each in its order
let receiveCore = null;
const ready = new Promise((receive) => { receiveCore = receive; });
let core = null;
let hardware = null, key = "";
const hardwareOf = new Map();  // instances by key
const files = new Map();  // bytes of scenes and meshes by file name
const waiting = new Map();  // keys whose modules were requested, with the functions that receive them
let loaded = "", planned = "", stuck = "";

const bytesOf = (module, address, count) => new Uint8Array(module.memory.buffer, address, count);
const textAt = (module, address, count) => new TextDecoder().decode(bytesOf(module, address, count));
function textFrom(module, address) {
  const bytes = new Uint8Array(module.memory.buffer, address);
  return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}

/// Copies words of 32 bits from the core to the room that `reserve` returns in the hardware's memory.
function copyWords(reserve, from, count) {
  const to = reserve(count);
  new Uint32Array(hardware.memory.buffer, to, count).set(new Uint32Array(core.memory.buffer, from, count));
}

// What the core imports.
const live = {
  hardware_draw(words, wordCount, units, unitCount, most) {
    copyWords(hardware.hardware_words, words, wordCount);
    copyWords(hardware.hardware_units, units, unitCount);
    return hardware.hardware_draw(most);
  },
  hardware_count: () => hardware.hardware_fragment_count(),
  hardware_take(to) {
    const count = 16 * hardware.hardware_fragment_count();
    bytesOf(core, to, count).set(bytesOf(hardware, hardware.hardware_fragments(), count));
  },
  hardware_observe(words, wordCount, most) {
    copyWords(hardware.hardware_words, words, wordCount);
    return hardware.hardware_observe(most);
  },
  hardware_trace_words: () => hardware.hardware_trace_words(),
  hardware_take_trace(to) {
    const count = 4 * hardware.hardware_trace_words();
    bytesOf(core, to, count).set(bytesOf(hardware, hardware.hardware_trace(), count));
  },
  hardware_reset() { hardware.hardware_reset(); },
  now: () => performance.now(),
};

/// An instance of a module. Functions of an operating system, which the C library imports, report "not supported".
async function start(module) {
  const imports = { live };
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    imports[from] ??= {};
    imports[from][name] ??= () => 58;
  }
  const instance = (await WebAssembly.instantiate(module, imports)).exports;
  instance._initialize();
  return instance;
}

class Refused extends Error {}

/// Calls a function of the core. Its text explains a result that is not 0.
function call(result) {
  if (result !== 0) throw new Refused(coreText());
}
const coreText = () => textAt(core, core.live_text(), core.live_text_size());

function loadScene({ scene, tessellation }) {
  const wanted = JSON.stringify([scene, tessellation, files.get(scene).length]);
  if (wanted === loaded) return;
  loaded = planned = "";
  const name = new TextEncoder().encode(scene), text = files.get(scene);
  const room = core.live_input(name.length + text.length);
  bytesOf(core, room, name.length).set(name);
  bytesOf(core, room + name.length, text.length).set(text);
  call(core.live_scene(name.length, text.length, tessellation));
  loaded = wanted;
}

async function planHardware({ shader, preset, tables }) {
  const wanted = JSON.stringify([shader, preset, tables]);
  if (wanted === planned) return;
  planned = "";
  call(core.live_plan(names.shaders.indexOf(shader), names.presets.indexOf(preset), tables));
  key = coreText();
  if (!hardwareOf.has(key)) {
    const module = await new Promise((receive) => {
      waiting.set(key, receive);
      postMessage({ kind: "need", key });
    });
    if (!module) throw new Refused(`This page has no hardware ${key}. It has that of the built-in scenes, without shadows; shading processors in preset exact have at most four lights here. \`make sim\` draws with any hardware.`);
    hardwareOf.set(key, await start(module));
  }
  hardware = hardwareOf.get(key);
  stuck = "";
  planned = wanted;
}

/// Makes a bit of a register stick, or none.
function breakHardware(fault) {
  const wanted = JSON.stringify(fault);
  if (wanted === stuck) return;
  hardware.hardware_heal();
  if (fault) hardware.hardware_stick(fault.register, fault.bit, fault.value);
  stuck = wanted;
}

/// Names and widths of the hardware's registers, in its order.
function registers() {
  const list = [];
  for (let i = 0; i < hardware.hardware_register_count(); ++i)
    list.push({ name: textFrom(hardware, hardware.hardware_register_name(i)), bits: hardware.hardware_register_bits(i) });
  return list;
}

const pictureOf = (kind, { width, height }) =>
  bytesOf(core, core.live_pixels(names.pictures.indexOf(kind)), 4 * width * height).slice().buffer;

/// The way of a pixel through the stages, as the core's lines of fields. Without a pixel: what differs first.
function wayOf(pixel) {
  const { x, y } = pixel ?? { x: -1, y: -1 };
  call(core.live_way(x, y));
  return coreText().split("\n").slice(0, -1).map((line) => line.split("\t"));
}

async function drawFrame(request) {
  const { state, kinds } = request;
  loadScene(state);
  await planHardware(state);
  breakHardware(state.fault);
  new Float64Array(core.memory.buffer, core.live_settings(), names.settings.length)
    .set(names.settings.map((name) => state[name]));
  const begin = performance.now();
  const end = core.live_draw();
  if (end === 2) throw new Refused(coreText());
  const difference = end === 0 ? "" : coreText();
  const milliseconds = performance.now() - begin;
  if (request.reference) call(core.live_reference());
  const values = new Float64Array(core.memory.buffer, core.live_figures(), names.figures.length);
  const figures = Object.fromEntries(names.figures.map((name, i) => [name, values[i]]));
  const way = request.exactly && (state.pixel || end !== 0) ? wayOf(state.pixel) : null;
  const pictures = Object.fromEntries(kinds.map((kind) => [kind, pictureOf(kind, state)]));
  postMessage({
    kind: "frame", id: request.id, state, pictures, figures, difference, way, milliseconds, key,
    registers: request.registers ? registers() : null,
  }, Object.values(pictures));
}

onmessage = async ({ data }) => {
  if (data.kind === "start") {
    names = data.names;
    receiveCore(start(data.core));
  }
  if (data.kind === "file") files.set(data.name, data.bytes);
  if (data.kind === "hardware") waiting.get(data.key)(data.module);
  if (data.kind !== "draw") return;
  try {
    core = await ready;
    await drawFrame(data);
  } catch (error) {
    // After a trap the memory of the modules is not valid any more.
    const usable = error instanceof Refused;
    postMessage({ kind: "refused", id: data.id, state: data.state, usable,
      text: usable ? error.message : `The core stopped: ${error.message}` });
  }
};
