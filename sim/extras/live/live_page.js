// SPDX-License-Identifier: Apache-2.0
// The page of make live: controls, picture and figures. Workers draw the frames.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const at = (id) => document.getElementById(id);
/// A new element with properties `of` and the given children.
function element(tag, of = {}, ...children) {
  const made = Object.assign(document.createElement(tag), of);
  made.append(...children);
  return made;
}

// State: what is drawn. The link contains what differs from the default.

const neutral = {
  scene: data.scenes[0].name, shader: "quadratic", preset: "exact", size: "640x480", kind: "hardware",
  azimuth: 0, elevation: 0, distance: 1, tessellation: 0, exponent: 0, lightAzimuth: 0, lightElevation: 0, threshold: 1,
  tables: "", pixel: "",
};
const state = { ...neutral };
let fault = null;  // register, bit and value that stick

function readLink() {
  const link = new URLSearchParams(location.hash.slice(1));
  Object.assign(state, neutral);
  for (const name of Object.keys(neutral)) {
    const text = link.get(name);
    if (text === null) continue;
    const value = typeof neutral[name] === "number" ? Number(text) : text;
    if (typeof value === "string" || Number.isFinite(value)) state[name] = value;
  }
  if (!files.has(state.scene)) state.scene = neutral.scene;
  if (!data.tables[state.preset]?.includes(state.tables)) state.tables = "";
  for (const id of ["shader", "preset", "size", "kind"])
    if (![...at(id).options].some(({ value }) => value === state[id])) state[id] = neutral[id];
}
function writeLink() {
  const link = new URLSearchParams();
  for (const [name, value] of Object.entries(state)) if (value !== neutral[name]) link.set(name, value);
  history.replaceState(null, "", `#${link}`);
}

/// A mesh file has the triangles that it has.
const isMesh = (scene) => !scene.toLowerCase().endsWith(".toml");

// The state as the core takes it: sliders with a logarithmic scale give factors.
function requestOf() {
  const [width, height] = state.size.split("x").map(Number);
  return {
    ...state, width, height, fault, tessellation: isMesh(state.scene) ? 1 : 2 ** state.tessellation, exponent: 2 ** state.exponent,
    threshold: 2 ** state.threshold, pixel: chosenPixel(),
    tables: state.shader === "spherical" && state.tables !== "" ? data.tables[state.preset].indexOf(state.tables) : 0,
  };
}

// Modules. Each is compiled once, when it is first needed.

async function unpacked(text) {
  const packed = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}
const modules = new Map();
function moduleOf(name) {
  const element = at(`module-${name}`);
  if (!element) return Promise.resolve(null);
  if (!modules.has(name)) modules.set(name, unpacked(element.textContent));
  return modules.get(name);
}

// Workers. Each draws one frame at a time. A frame that is older than the shown one is not shown.

const workerUrl = URL.createObjectURL(new Blob([at("worker").textContent], { type: "text/javascript" }));
const files = new Map(data.scenes.map(({ name, text }) => [name, new TextEncoder().encode(text)]));
const workers = [];
let requested = 0, shown = 0;  // numbers of frames
let dirty = true;  // the state is not drawn yet
let exactly = false;  // the state has been still: the frame is drawn with its error
let registersFrom = 1;  // frames from this number on list the hardware's registers, until one of them is shown
const frameTimes = [];

function startWorker() {
  const worker = new Worker(workerUrl);
  const made = { worker, busy: false };
  worker.onmessage = ({ data: message }) => receive(made, message);
  worker.onerror = (event) => showRefusal(`The worker stopped: ${event.message}`);
  moduleOf("core").then((core) => worker.postMessage({ kind: "start", core, names: data.names }));
  for (const [name, bytes] of files) worker.postMessage({ kind: "file", name, bytes });
  return made;
}

function receive(made, message) {
  if (message.kind === "need") {
    moduleOf(message.key).then((module) => made.worker.postMessage({ kind: "hardware", key: message.key, module }));
    return;
  }
  made.busy = false;
  if (message.kind === "refused" && !message.usable) {
    made.worker.terminate();
    workers[workers.indexOf(made)] = startWorker();
  }
  if (message.id > shown) {
    shown = message.id;
    if (message.kind === "frame") showFrame(message);
    else showRefusal(message.text);
  }
  schedule();
}

/// Shows what a link describes.
function followLink() {
  readLink();
  forgetFault();
  at("turning").checked = false;
  change({});
  showControls();
}
addEventListener("hashchange", followLink);

/// True if the current state is drawn, with its error against the reference.
function halfwayIsStill() {
  return exactly && !dirty && shown === requested;
}

let stillTimer = 0;
function change(values) {
  Object.assign(state, values);
  dirty = true;
  exactly = false;
  writeLink();
  schedule();
}

/// Gives work to all workers without work. When the state has not changed for a moment, the frame is drawn again with the
/// reference and its error.
function schedule() {
  for (const free of workers.filter(({ busy }) => !busy)) {
    if (at("turning").checked && !document.hidden) {
      state.azimuth = (state.azimuth + 2) % 360;
      dirty = true;
      exactly = false;
    }
    if (!dirty) return;
    request(free);
  }
}

function request(free) {
  dirty = false;
  free.busy = true;
  const reference = exactly || state.kind === "reference" || state.kind === "difference";
  const kinds = ["hardware", ...(state.kind === "hardware" ? [] : [state.kind])];
  free.worker.postMessage({ kind: "draw", id: ++requested, state: requestOf(), kinds, reference, exactly, registers: requested >= registersFrom });
  clearTimeout(stillTimer);
  if (!exactly)
    stillTimer = setTimeout(() => { if (!dirty && !at("turning").checked) { exactly = dirty = true; schedule(); } }, 250);
}

// Showing a frame.

function paint(canvas, pixels, { width, height }) {
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(pixels), width, height), 0, 0);
}

const number = (value, digits = 0) =>
  value.toLocaleString("en", { minimumFractionDigits: digits, maximumFractionDigits: digits });
const known = (value, text) => (value < 0 || !Number.isFinite(value) ? "unknown" : text(value));

let last = null;  // the last frame
let firstFrameAt = null;  // milliseconds from the opening of the page
/// Over the last two seconds; null if fewer frames were drawn.
function framesPerSecond() {
  const span = frameTimes.at(-1) - frameTimes[0];
  return span > 500 ? 1000 * (frameTimes.length - 1) / span : null;
}
function showFrame(frame) {
  const { state: drawn, pictures, figures } = frame;
  last = frame;
  firstFrameAt ??= performance.now();
  at("refusal").hidden = true;
  paint(at("left"), pictures.hardware, drawn);
  if (pictures[state.kind]) paint(at("right"), pictures[state.kind], drawn);
  at("key").textContent = frame.key;
  if (frame.registers) {
    showRegisters(frame.registers);
    if (frame.id >= registersFrom) registersFrom = Infinity;
  }
  const equal = figures.mismatches === 0 && frame.difference === "";
  at("verdict").className = equal ? "agrees" : "differs";
  at("verdict").textContent = equal ? `${number(figures.fragments)} fragments: 0 differ from the golden model` :
    `${number(figures.mismatches)} of ${number(figures.fragments)} fragments differ from the golden model`;
  at("differences").hidden = equal;
  at("differences").textContent = frame.difference;
  showFirstStage(frame.way);
  frameTimes.push(performance.now());
  while (frameTimes.length > 1 && frameTimes.at(-1) - frameTimes[0] > 2000) frameTimes.shift();
  showFigures(frame);
  at("pixel").hidden = drawn.pixel === null;
  if (drawn.pixel) showPixel(frame);
}

function showFigures({ figures, key, milliseconds }) {
  const clock = data.clocks[key];
  const rate = framesPerSecond();
  const rows = [
    ["triangles of the scene in view", number(figures.triangles)],
    ["triangles after splitting", `${number(figures.leaves)}, ${number(figures.words)} words of init vectors`],
    ["fragments", number(figures.fragments)],
    ["error against the reference", known(figures.rms, (rms) => `${number(rms, 2)} rms, ${number(figures.largest)} at most, in steps of 1/255`)],
    ["clocks per fragment", known(figures.clocks, (clocks) => number(clocks / Math.max(1, figures.fragments), 3))],
    [`hardware on an ${data.device}`, clock && figures.clocks >= 0 ?
      `${number(figures.clocks / clock / 1000, 2)} ms at ${number(clock, 1)} MHz` : "no stored clock"],
    ["set-up here", `${number(figures.setup, 1)} ms`],
    ["simulated hardware here", `${number(figures.hardware, 1)} ms, ` +
      `${number(1e6 * figures.hardware / Math.max(1, figures.fragments), 0)} ns per fragment`],
    ["golden model and comparison here", `${number(figures.golden + figures.compare, 1)} ms`],
    ["frame here", `${number(milliseconds, 1)} ms on one worker`],
    ["frames per second here", rate === null ? "still" : number(rate, 1)],
    ["first picture here", `${number(firstFrameAt)} ms after the page was opened`],
  ];
  at("figures").tBodies[0].replaceChildren(...rows.map(([name, value]) =>
    element("tr", {}, element("th", { scope: "row", textContent: name }), element("td", { textContent: value }))));
}

function showRefusal(text) {
  at("refusal").hidden = false;
  at("refusal").textContent = text;
}

// Controls.

const sliders = {
  tessellation: (value) => `× ${2 ** value}`.slice(0, 6), exponent: (value) => `× ${number(2 ** value, 2)}`,
  lightAzimuth: (value) => `${value}°`, lightElevation: (value) => `${value}°`, threshold: (value) => `${2 ** value}/255`,
};

function showControls() {
  for (const id of ["scene", "shader", "preset", "size", "kind"]) at(id).value = state[id];
  showTables();
  for (const [id, shownAs] of Object.entries(sliders)) {
    at(id).value = state[id];
    at(id).nextElementSibling.textContent = shownAs(state[id]);
  }
  at("tessellation").disabled = isMesh(state.scene);
  at("threshold").disabled = state.shader === "processors";
  at("picture").classList.toggle("whole", state.kind === "hardware");
  at("break").disabled = fault !== null;
  at("mend").disabled = fault === null;
}

/// The sizes of cosine tables of the preset: the first is its own, which the link does not contain.
function showTables() {
  const sizes = data.tables[state.preset];
  at("tables").replaceChildren(...sizes.map((size, i) =>
    element("option", { value: i === 0 ? "" : size, textContent: `${size.replace("x", " address bits, ")} data bits` })));
  at("tables").value = state.tables;
  at("tables").disabled = state.shader !== "spherical" || sizes.length < 2;
}

function listenToControls() {
  for (const { name } of data.scenes) at("scene").append(element("option", { value: name, textContent: name.replace(".toml", "") }));
  for (const id of ["scene", "shader", "preset", "tables", "size", "kind"])
    at(id).onchange = () => {
      if (id !== "kind") forgetFault();
      if (id === "size") state.pixel = "";
      if (id === "preset") state.tables = "";
      change({ [id]: at(id).value });
      showControls();
    };
  for (const id of Object.keys(sliders))
    at(id).oninput = () => { change({ [id]: Number(at(id).value) }); showControls(); };
  at("wipe").oninput = () => at("picture").style.setProperty("--wipe", at("wipe").value / 1000);
  at("picture").style.setProperty("--wipe", 0.5);
  at("turning").onchange = () => { change({}); };
  at("reset").onclick = () => {
    const { scene } = state;
    forgetFault();
    change({ ...neutral, scene });
    showControls();
  };
  at("open").onclick = () => at("file").click();
  at("file").onchange = () => { if (at("file").files.length > 0) openFile(at("file").files[0]); at("file").value = ""; };
}

const mostBytes = 64 * 2 ** 20;
async function openFile(file) {
  if (file.size > mostBytes) {
    showRefusal(`${file.name}: ${number(file.size)} bytes; this page takes at most ${number(mostBytes)}. Use \`halfway sim\` for it.`);
    return;
  }
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (!files.has(file.name)) at("scene").append(element("option", { value: file.name, textContent: file.name }));
  files.set(file.name, bytes);
  for (const { worker } of workers) worker.postMessage({ kind: "file", name: file.name, bytes });
  forgetFault();
  change({ scene: file.name, azimuth: 0, elevation: 0, distance: 1 });
  showControls();
}

function listenToFiles() {
  addEventListener("dragover", (event) => { event.preventDefault(); at("picture").classList.add("dropping"); });
  addEventListener("dragleave", () => at("picture").classList.remove("dropping"));
  addEventListener("drop", (event) => {
    event.preventDefault();
    at("picture").classList.remove("dropping");
    if (event.dataTransfer.files.length > 0) openFile(event.dataTransfer.files[0]);
  });
}

// Turning: pointers, wheel and keys.

const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
function turn(azimuth, elevation) {
  at("turning").checked = false;
  change({ azimuth: (state.azimuth + azimuth) % 360, elevation: clamp(state.elevation + elevation, -85, 85) });
}
function approach(factor) { change({ distance: clamp(state.distance * factor, 0.2, 5) }); }

function listenToPicture() {
  const picture = at("picture"), held = new Map();  // places of pointers that are down
  let moved = 0;
  const gap = () => { const [a, b] = [...held.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
  picture.onpointerdown = (event) => {
    picture.setPointerCapture(event.pointerId);
    picture.classList.add("held");
    if (held.size === 0) moved = 0;
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
  };
  picture.onpointermove = (event) => {
    const from = held.get(event.pointerId);
    if (!from) return;
    const before = held.size === 2 ? gap() : 0, to = { x: event.clientX, y: event.clientY };
    held.set(event.pointerId, to);
    moved += Math.abs(to.x - from.x) + Math.abs(to.y - from.y);
    if (held.size === 2) approach(before / Math.max(1, gap()));
    else if (moved > 3) turn((from.x - to.x) / 2, (to.y - from.y) / 2);
  };
  picture.onpointerup = picture.onpointercancel = (event) => {
    if (event.type === "pointerup" && held.size === 1 && moved <= 3) choosePixel(event);
    held.delete(event.pointerId);
    picture.classList.toggle("held", held.size > 0);
  };
  picture.addEventListener("wheel", (event) => {
    event.preventDefault();
    approach(1.001 ** event.deltaY);
  }, { passive: false });
  const keys = {
    ArrowLeft: () => turn(-5, 0), ArrowRight: () => turn(5, 0), ArrowUp: () => turn(0, 5), ArrowDown: () => turn(0, -5),
    "+": () => approach(0.9), "-": () => approach(1 / 0.9),
  };
  picture.onkeydown = (event) => {
    if (!(event.key in keys)) return;
    event.preventDefault();
    keys[event.key]();
  };
}

// Breaking.

function showRegisters(registers) {
  at("register").replaceChildren(...registers.map(({ name, bits }, i) =>
    element("option", { value: i, textContent: `${name}, ${bits} ${bits === 1 ? "bit" : "bits"}` })));
  const limit = () => { at("bit").max = registers[at("register").value].bits - 1; };
  at("register").onchange = limit;
  if (registers.length > 0) limit();
}
function forgetFault() {
  fault = null;
  registersFrom = requested + 1;
}
function listenToFaults() {
  at("break").onclick = () => {
    const bit = clamp(Math.floor(Number(at("bit").value)) || 0, 0, Number(at("bit").max));
    at("bit").value = bit;
    fault = { register: Number(at("register").value), bit, value: Number(at("stuck").value) };
    change({});
    showControls();
  };
  at("mend").onclick = () => { fault = null; change({}); showControls(); };
}

// One pixel: its colours, and its way through the stages.

/// The chosen pixel, null if there is none in this frame.
function chosenPixel() {
  const [width, height] = state.size.split("x").map(Number);
  const [x, y] = state.pixel.split(",").map(Number);
  return state.pixel !== "" && x >= 0 && x < width && y >= 0 && y < height ? { x, y } : null;
}
function choosePixel(event) {
  const box = at("left").getBoundingClientRect();
  const [width, height] = state.size.split("x").map(Number);
  const x = clamp(Math.floor((event.clientX - box.left) / box.width * width), 0, width - 1);
  const y = clamp(Math.floor((event.clientY - box.top) / box.height * height), 0, height - 1);
  change({ pixel: `${x},${y}` });
}

const headOf = (...names) =>
  element("thead", {}, element("tr", {}, ...names.map((name) => element("th", { scope: "col", textContent: name }))));
function showPixel({ state: drawn, pictures, way }) {
  const { x, y } = drawn.pixel;
  at("pixel-title").textContent = `Pixel ${x}, ${y}`;
  const rows = Object.entries(pictures).map(([kind, pixels]) => {
    const colour = new Uint8Array(pixels, 4 * (y * drawn.width + x), 3);
    return element("tr", {}, element("th", { scope: "row", textContent: kind }),
      ...[...colour].map((value) => element("td", { textContent: value })));
  });
  at("pixel-values").replaceChildren(headOf("picture", "red", "green", "blue"), element("tbody", {}, ...rows));
  showWay(way);
}

/// A table row for each line of the way. It is known once the frame is still.
const rowOfWay = {
  triangle: (triangle, vector) => [heading(`triangle ${triangle}, init vector ${vector}`, "triangle")],
  given: (what) => [heading(`${what}, given to both`)],
  stage: (stage, cycle) => [heading(cycle ? `${stage} stage, clock ${cycle}` : `${stage} stage: the RTL never came here`)],
  value: (name, golden, rtl, result) => [
    element("th", { scope: "row", textContent: name }), element("td", { textContent: golden }),
    element("td", { textContent: rtl ?? "" }),
    element("td", { className: result === "differs" ? "differs" : "agrees", textContent: { equal: "=", differs: "≠ differs" }[result] ?? "" }),
  ],
};
const heading = (text, className = "") => element("th", { colSpan: 4, scope: "rowgroup", className, textContent: text });
function showWay(way) {
  at("way").hidden = way === null;
  if (way === null) return;
  let section = "";
  const rows = way.filter(([kind]) => kind in rowOfWay).map(([kind, ...fields]) => {
    if (kind !== "value") section = kind;
    return element("tr", { className: `${kind} of-${section}` }, ...rowOfWay[kind](...fields));
  });
  at("way-note").textContent = rows.length > 0 ? "The hardware and the golden model draw the triangles of this pixel again, and the values of each stage are recorded." :
    "No triangle covers this pixel.";
  at("way-values").hidden = rows.length === 0;
  at("given").onchange = () => at("way-values").classList.toggle("with-given", at("given").checked);
  at("way-values").replaceChildren(headOf("value", "golden model", "RTL", ""), element("tbody", {}, ...rows));
}

/// Names the first stage that differs, and its entity.
function showFirstStage(way) {
  const texts = (way ?? []).filter(([kind]) => kind === "first" || kind === "fault")
    .map(([kind, text]) => kind === "first" ? `First difference in the stages: ${text}` : `While the signals are recorded, ${text}`);
  at("first-stage").hidden = texts.length === 0;
  at("first-stage").textContent = texts.join(". ");
}

// WebAssembly's vectors: a module of one function that uses them.
const vectors = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253,
  15, 253, 98, 11);

function begin() {
  listenToControls();
  readLink();
  listenToFiles();
  listenToPicture();
  listenToFaults();
  showControls();
  if (!WebAssembly.validate(vectors)) {
    at("still").hidden = false;
    at("verdict").textContent = "This browser has no WebAssembly vectors (SIMD), so it cannot draw here. This is a picture that the VHDL drew.";
    return;
  }
  for (let i = 0; i < clamp(navigator.hardwareConcurrency || 1, 1, 4); ++i) workers.push(startWorker());
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches && location.hash.length < 2) at("turning").checked = true;
  schedule();
}
begin();
