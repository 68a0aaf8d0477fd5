// SPDX-License-Identifier: Apache-2.0
// Interactive parts of the report: pictures with wipe and zoom, and panels for points.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);

/// A new element with properties `of` and the given children.
function element(tag, of = {}, ...children) {
  const made = Object.assign(document.createElement(tag), of);
  made.append(...children);
  return made;
}

/// Pixels of each PNG, decoded once.
const pictures = new Map();
function pictureOf(uri) {
  if (!pictures.has(uri)) {
    pictures.set(uri, (async () => {
      const image = new Image();
      image.src = uri;
      await image.decode();
      const canvas = element("canvas", { width: image.naturalWidth, height: image.naturalHeight });
      const context = canvas.getContext("2d", { willReadFrequently: true });
      context.drawImage(image, 0, 0);
      return { canvas, pixels: context.getImageData(0, 0, canvas.width, canvas.height).data };
    })());
  }
  return pictures.get(uri);
}

/// 32 times the difference of two pictures, as in diff.png.
function differenceOf(a, b) {
  const canvas = element("canvas", { width: a.canvas.width, height: a.canvas.height });
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const image = context.createImageData(canvas.width, canvas.height);
  for (let i = 0; i < image.data.length; ++i)
    image.data[i] = i % 4 === 3 ? 255 : Math.min(255, 32 * Math.abs(a.pixels[i] - b.pixels[i]));
  context.putImageData(image, 0, 0);
  return { canvas, pixels: image.data };
}

/// The pixel nearest to the centre whose colour differs from the corner's, if any: a pixel of a body.
function firstPixelOf({ canvas, pixels }) {
  const { width, height } = canvas;
  let best = { x: width >> 1, y: height >> 1 }, least = Infinity;
  for (let at = 0; at < pixels.length; at += 4) {
    if (pixels[at] === pixels[0] && pixels[at + 1] === pixels[1] && pixels[at + 2] === pixels[2]) continue;
    const x = (at >> 2) % width, y = Math.floor((at >> 2) / width);
    const distance = (x - (width >> 1)) ** 2 + (y - (height >> 1)) ** 2;
    if (distance < least) [best, least] = [{ x, y }, distance];
  }
  return best;
}

const zooms = [1, 2, 4, 8, 16, 32, 64, 128];
const valuesFrom = 30;  // minimum CSS pixels per pixel for writing values into the pixels

/// Shows two of several pictures of equal size, separated by a movable line.
class Viewer {
  constructor(root) {
    this.root = root;
    this.wipe = 0.5;  // position of the line, as a part of the canvas's width
    this.zoom = 1;  // 1: the whole picture is visible
    this.left = this.top = 0;  // picture coordinates of the canvas's corner
    this.layers = [];
    this.canvas = element("canvas", { tabIndex: 0 });
    this.canvas.setAttribute("role", "application");
    this.range = element("input", { type: "range", min: 0, max: 1000, value: 500 });
    this.range.setAttribute("aria-label", "wipe: where the left picture ends");
    this.choices = ["left", "right"].map((side) => element("select", { className: side }));
    this.values = element("div", { className: "values" });
    this.label = element("p", { className: "on-paper" });  // names the picture if there are no lists
    this.values.setAttribute("aria-live", "polite");
    const button = (text, label, act) => {
      const made = element("button", { type: "button", textContent: text, onclick: act });
      made.setAttribute("aria-label", label);
      return made;
    };
    this.root.replaceChildren(
      element("div", { className: "bar" },
        element("label", {}, "left ", this.choices[0]), element("label", {}, "right ", this.choices[1]),
        element("span", {}, button("−", "zoom out", () => this.zoomOut()), " ",
          button("+", "zoom in", () => this.zoomIn()), " ", button("whole", "show the whole picture",
            () => this.zoomTo(1)))),
      element("div", { className: "panes" },
        element("div", {}, this.canvas, this.label, element("label", { className: "bar wipe" }, "wipe ", this.range)),
        this.values));
    this.range.oninput = () => { this.wipe = this.range.value / 1000; this.draw(); };
    for (const choice of this.choices) choice.onchange = () => { this.draw(); this.tellPixel(); };
    this.listen();
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    matchMedia("(resolution: 1dppx)").addEventListener("change", () => this.draw());
  }

  /// Layers are { id, name, picture }; `left` and `right` are ids of two of them.
  show(what, layers, left, right) {
    this.what = what;
    const same = this.layers.length > 0 && layers.length > 0 &&
      this.width === layers[0].picture.canvas.width && this.height === layers[0].picture.canvas.height;
    this.layers = layers;
    this.width = layers[0].picture.canvas.width;
    this.height = layers[0].picture.canvas.height;
    if (!same) {
      this.zoom = 1;
      this.left = this.top = 0;
      this.pixel = firstPixelOf(layers[0].picture);
    }
    this.choices.forEach((choice, side) => {
      choice.replaceChildren(...layers.map((layer) => element("option", { value: layer.id, textContent: layer.name })));
      choice.value = [left, right][side];
    });
    this.canvas.style.aspectRatio = `${this.width} / ${this.height}`;
    this.draw();
    this.tellPixel();
  }

  layer(side) { return this.layers.find((layer) => layer.id === this.choices[side].value); }
  /// CSS pixels per picture pixel.
  get scale() { return this.zoom * this.canvas.clientWidth / this.width; }

  draw() {
    const { canvas } = this;
    if (this.layers.length === 0 || canvas.clientWidth === 0) return;
    const ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth, height = canvas.clientWidth * this.height / this.width;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    canvas.classList.toggle("zoomed", this.zoom > 1);
    const context = canvas.getContext("2d");
    context.scale(ratio, ratio);
    const scale = this.scale, line = this.wipe * width;
    context.imageSmoothingEnabled = scale < 1;
    for (const [side, from, to] of [[0, 0, line], [1, line, width]]) {
      context.save();
      context.beginPath();
      context.rect(from, 0, to - from, height);
      context.clip();
      context.drawImage(this.layer(side).picture.canvas, -this.left * scale, -this.top * scale,
        this.width * scale, this.height * scale);
      if (scale >= valuesFrom) this.writeValues(context, side, scale, from, to, height);
      context.restore();
    }
    if (scale >= 8) {
      context.lineWidth = 2;
      context.strokeStyle = "#ffd33d";
      context.strokeRect((this.pixel.x - this.left) * scale, (this.pixel.y - this.top) * scale, scale, scale);
    }
    context.fillStyle = "#000";
    context.fillRect(line - 2, 0, 4, height);
    context.fillStyle = "#fff";
    context.fillRect(line - 1, 0, 2, height);
    canvas.setAttribute("aria-label", `${this.what}: ${this.layer(0).name} left of ` +
      `${Math.round(100 * this.wipe)} percent of the width, ${this.layer(1).name} right of it, zoom ` +
      `${Math.round(10 * this.zoom) / 10}. Arrow keys choose a pixel, plus and minus zoom, square brackets move the line.`);
    this.label.textContent =
      `${this.what}: ${this.layer(0).name} left of the line, ${this.layer(1).name} right of it`;
    this.range.value = Math.round(1000 * this.wipe);
    this.range.setAttribute("aria-valuetext", `${Math.round(100 * this.wipe)} percent`);
  }

  writeValues(context, side, scale, from, to, height) {
    const { pixels } = this.layer(side).picture;
    context.font = `${Math.floor(scale / 4.5)}px ui-monospace, monospace`;
    context.textAlign = "center";
    const first = Math.max(0, Math.floor(this.left + from / scale));
    const last = Math.min(this.width - 1, Math.floor(this.left + to / scale));
    const bottom = Math.min(this.height - 1, Math.floor(this.top + height / scale));
    for (let y = Math.max(0, Math.floor(this.top)); y <= bottom; ++y)
      for (let x = first; x <= last; ++x) {
        const at = 4 * (y * this.width + x);
        const bright = pixels[at] * 0.3 + pixels[at + 1] * 0.6 + pixels[at + 2] * 0.1;
        context.fillStyle = bright > 110 ? "#000" : "#fff";
        for (let c = 0; c < 3; ++c)
          context.fillText(pixels[at + c], (x + 0.5 - this.left) * scale, (y + 0.3 + 0.25 * c - this.top) * scale);
      }
  }

  /// Show the values of all layers at the chosen pixel.
  tellPixel() {
    const { x, y } = this.pixel;
    const rows = this.layers.map((layer) => {
      const value = [...layer.picture.pixels.slice(4 * (y * this.width + x), 4 * (y * this.width + x) + 3)];
      const swatch = element("span", { className: "swatch" });
      swatch.style.background = `rgb(${value})`;
      const row = element("tr", {}, element("th", { scope: "row", textContent: layer.name }),
        element("td", {}, swatch), ...value.map((v) => element("td", { textContent: v })));
      row.dataset.layer = layer.id;
      return row;
    });
    this.values.replaceChildren(element("table", {},
      element("caption", { textContent: `pixel ${x}, ${y}: red, green, blue` }), element("tbody", {}, ...rows)));
  }

  choosePixel(x, y) {
    this.pixel = {
      x: Math.min(this.width - 1, Math.max(0, Math.floor(x))), y: Math.min(this.height - 1, Math.max(0, Math.floor(y))),
    };
    this.tellPixel();
  }

  /// Picture coordinates of a canvas position.
  pictureAt(place) {
    return { x: this.left + place.x / this.scale, y: this.top + place.y / this.scale };
  }
  /// Zoom, and move the picture so that `point` of the picture is at `place` of the canvas.
  hold(point, place, zoom) {
    this.zoom = Math.min(zooms.at(-1), Math.max(1, zoom));
    this.left = point.x - place.x / this.scale;
    this.top = point.y - place.y / this.scale;
    this.keepInside();
    this.draw();
  }
  /// Zoom around a canvas position; without one, around the chosen pixel.
  zoomTo(zoom, at = null) {
    const { scale } = this;
    const place = at || { x: (this.pixel.x + 0.5 - this.left) * scale, y: (this.pixel.y + 0.5 - this.top) * scale };
    this.hold(this.pictureAt(place), place, zoom);
  }
  zoomIn(at = null) { this.zoomTo(zooms.find((zoom) => zoom > this.zoom) || this.zoom, at); }
  zoomOut(at = null) { this.zoomTo(zooms.findLast((zoom) => zoom < this.zoom) || this.zoom, at); }
  keepInside() {
    this.left = Math.min(this.width - this.width / this.zoom, Math.max(0, this.left));
    this.top = Math.min(this.height - this.height / this.zoom, Math.max(0, this.top));
  }
  /// Scroll the picture until the chosen pixel is visible.
  seePixel() {
    const width = this.width / this.zoom, height = this.height / this.zoom;
    this.left = Math.min(this.pixel.x, Math.max(this.left, this.pixel.x + 1 - width));
    this.top = Math.min(this.pixel.y, Math.max(this.top, this.pixel.y + 1 - height));
    this.keepInside();
  }

  listen() {
    const { canvas } = this;
    const place = (event) => {
      const box = canvas.getBoundingClientRect();
      return { x: event.clientX - box.left, y: event.clientY - box.top };
    };
    const down = new Map();  // position of each pointer, by its id
    let drag = null, pinch = null;  // state of one-pointer and two-pointer gestures
    const spread = () => {
      const [a, b] = [...down.values()];
      return { middle: { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 }, distance: Math.max(1, Math.hypot(a.x - b.x, a.y - b.y)) };
    };
    const lift = (event) => {
      down.delete(event.pointerId);
      drag = pinch = null;  // after a pinch, the remaining finger has no effect
    };
    canvas.onpointerdown = (event) => {
      const at = place(event);
      down.set(event.pointerId, at);
      canvas.setPointerCapture(event.pointerId);
      const onLine = Math.abs(at.x - this.wipe * canvas.clientWidth) < 16;
      drag = down.size > 1 ? null :
        { at, left: this.left, top: this.top, wipes: this.zoom === 1 || onLine, moved: false };
      if (down.size !== 2) return;
      const { middle, distance } = spread();
      pinch = { point: this.pictureAt(middle), distance, zoom: this.zoom };
    };
    canvas.onpointermove = (event) => {
      const at = place(event);
      if (down.has(event.pointerId)) down.set(event.pointerId, at);
      if (pinch !== null && down.size === 2) {
        const { middle, distance } = spread();
        this.hold(pinch.point, middle, pinch.zoom * distance / pinch.distance);
        return;
      }
      if (drag === null) return;
      drag.moved = drag.moved || Math.hypot(at.x - drag.at.x, at.y - drag.at.y) > 4;
      if (!drag.moved) return;
      if (drag.wipes) {
        this.wipe = Math.min(1, Math.max(0, at.x / canvas.clientWidth));
      } else {
        this.left = drag.left + (drag.at.x - at.x) / this.scale;
        this.top = drag.top + (drag.at.y - at.y) / this.scale;
        this.keepInside();
      }
      this.draw();
    };
    canvas.onpointerup = (event) => {
      if (drag !== null && !drag.moved) {
        const at = place(event);
        this.choosePixel(this.left + at.x / this.scale, this.top + at.y / this.scale);
        this.draw();
      }
      lift(event);
    };
    canvas.onpointercancel = lift;
    // Two fingers on the canvas neither scroll nor zoom the page.
    canvas.addEventListener("touchstart", (event) => {
      if (event.touches.length > 1) event.preventDefault();
    }, { passive: false });
    canvas.ondblclick = (event) => this.zoomIn(place(event));
    canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey) return;  // without Ctrl the page scrolls
      event.preventDefault();
      if (event.deltaY < 0) this.zoomIn(place(event));
      else this.zoomOut(place(event));
    }, { passive: false });
    canvas.onkeydown = (event) => {
      const step = event.shiftKey ? 10 : 1;
      const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.key in moves) {
        this.choosePixel(this.pixel.x + moves[event.key][0], this.pixel.y + moves[event.key][1]);
        this.seePixel();
      } else if (event.key === "+" || event.key === "=") {
        this.zoomIn();
      } else if (event.key === "-") {
        this.zoomOut();
      } else if (event.key === "0") {
        this.zoomTo(1);
      } else if (event.key === "[" || event.key === "]") {
        this.wipe = Math.min(1, Math.max(0, this.wipe + (event.key === "]" ? 0.02 : -0.02)));
      } else {
        return;
      }
      event.preventDefault();
      this.draw();
    };
  }
}

/// Frames: scene and shader are chosen from lists or by links such as #frame/spheres/quadratic.
function makeFrames() {
  const root = document.getElementById("frame-viewer");
  if (root === null || data.frames.length === 0) return;
  const scene = element("select", { id: "scene" }), shader = element("select", { id: "shader" });
  const body = element("div");
  root.append(element("div", { className: "bar" }, element("label", {}, "scene ", scene),
    element("label", {}, "shader ", shader)), body);
  const viewer = new Viewer(body);
  const fill = (select, names) =>
    select.replaceChildren(...names.map((name) => element("option", { value: name, textContent: name })));
  const shaders = (of) => data.frames.filter((frame) => frame.scene === of).map((frame) => frame.shader);

  async function show(sceneName, shaderName) {
    scene.value = sceneName;
    fill(shader, shaders(sceneName));
    shader.value = shaderName;
    const frame = data.frames.find((f) => f.scene === sceneName && f.shader === shaderName);
    const layers = await Promise.all(frame.layers.map(async ({ id, name, image }) =>
      ({ id, name, picture: await pictureOf(data.images[image]) })));
    // another frame was chosen meanwhile
    if (scene.value !== sceneName || shader.value !== shaderName) return;
    const has = (id) => layers.some((layer) => layer.id === id);
    viewer.show(`${sceneName} by the shader ${shaderName}`, layers, has("reference") ? "reference" : layers[0].id,
      ["verilator", "ghdl", "golden"].find(has) || layers[0].id);
  }
  fill(scene, [...new Set(data.frames.map((frame) => frame.scene))]);
  scene.onchange = () => {
    const there = shaders(scene.value);
    show(scene.value, there.includes(shader.value) ? shader.value : there[0]);
  };
  shader.onchange = () => show(scene.value, shader.value);
  const follow = () => {
    const [, sceneName, shaderName] = decodeURIComponent(location.hash.slice(1)).split("/");
    if (!location.hash.startsWith("#frame/") || !shaders(sceneName).includes(shaderName)) return false;
    show(sceneName, shaderName);
    root.scrollIntoView();
    return true;
  };
  addEventListener("hashchange", follow);
  const first = data.frames.find((frame) => frame.scene === "spheres" && frame.shader === "quadratic") || data.frames[0];
  if (!follow()) show(first.scene, first.shader);
}

/// Points: links to #point-<number> open the panel.
function makePoints() {
  const dialog = document.getElementById("point");
  const holder = document.getElementById("point-viewer");
  const crowd = document.getElementById("point-crowd");
  let viewer = null;

  /// Points of the same plot close to the pointer, nearest first.
  function crowdOf(link, event) {
    const svg = link.closest(".plot svg");
    if (svg === null || event.detail === 0) return [];  // with keys, each point can be reached separately
    const distance = (other) => {
      const box = other.querySelector("circle").getBoundingClientRect();
      return Math.hypot(box.x + box.width / 2 - event.clientX, box.y + box.height / 2 - event.clientY);
    };
    return [...svg.querySelectorAll("a")].map((other) => ({ other, far: distance(other) }))
      .filter(({ far }) => far <= 10).sort((a, b) => a.far - b.far)
      .map(({ other }) => Number(other.getAttribute("href").slice(7)));
  }
  function tellCrowd(numbers) {
    crowd.hidden = numbers.length < 2;
    crowd.open = false;
    crowd.replaceChildren(element("summary", { textContent: `${numbers.length} points are at this place` }),
      element("ul", {}, ...numbers.map((number) =>
        element("li", {}, element("a", { href: `#point-${number}`, textContent: data.points[number].name })))));
  }

  async function open(number) {
    const point = data.points[number];
    document.getElementById("point-name").textContent = point.name;
    document.getElementById("point-values").replaceChildren(...point.values.map(([what, value]) =>
      element("tr", {}, element("th", { scope: "row", textContent: what }), element("td", { textContent: value }))));
    holder.hidden = !point.image;
    if (!dialog.open) dialog.showModal();
    dialog.scrollTop = 0;
    if (!point.image) return;
    viewer = viewer || new Viewer(holder);
    const frame = { id: "frame", name: "this frame", picture: await pictureOf(point.image) };
    const layers = [frame];
    const reference = data.points[point.reference];
    if (reference && reference.image) {
      const phong = { id: "reference", name: "Phong per pixel", picture: await pictureOf(reference.image) };
      layers.unshift(phong);
      layers.push({ id: "difference", name: "difference, 32 times", picture: differenceOf(frame.picture, phong.picture) });
    }
    viewer.show(point.name, layers, layers[0].id, "frame");
  }
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a[href^='#point-']");
    if (link === null) return;
    event.preventDefault();
    const numbers = crowdOf(link, event);
    if (!crowd.contains(link)) tellCrowd(numbers);
    open(numbers[0] ?? Number(link.getAttribute("href").slice(7)));
  });

  // Each plot is one stop of the Tab key. In a plot, an arrow key selects the nearest point in its direction.
  for (const svg of document.querySelectorAll(".plot svg")) {
    const links = [...svg.querySelectorAll("a")];
    links.forEach((link, i) => link.setAttribute("tabindex", i === 0 ? "0" : "-1"));
    const centre = (link) => {
      const box = link.getBoundingClientRect();
      return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    };
    svg.addEventListener("keydown", (event) => {
      const along = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      const from = links.indexOf(document.activeElement);
      if (along === undefined || from < 0) return;
      event.preventDefault();
      const here = centre(links[from]);
      let best = null, least = Infinity;
      links.forEach((link, i) => {
        const there = centre(link), dx = there.x - here.x, dy = there.y - here.y;
        const ahead = dx * along[0] + dy * along[1];
        // Points at the same place are ordered by number.
        const cost = ahead + 2 * Math.abs(dx * along[1] + dy * along[0]) + (ahead === 0 ? 1e-3 * (i - from) : 0);
        const isAhead = ahead > 0 || (dx === 0 && dy === 0 && (along[0] + along[1]) * (i - from) > 0);
        if (i !== from && isAhead && cost < least) [best, least] = [link, cost];
      });
      if (best === null) return;
      for (const link of links) link.setAttribute("tabindex", link === best ? "0" : "-1");
      best.focus();
    });
  }
}

/// A link to an element in a folded section unfolds the section.
function unfold() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const folded = target && target.closest("details");
  if (!folded) return;
  folded.open = true;
  target.scrollIntoView();
}

makeFrames();
makePoints();
addEventListener("hashchange", unfold);
unfold();
