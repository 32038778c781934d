"use strict";
// The page of a view: the data of one string after the other go into traces whose looks were made by scene.py.
(() => {
  const view = JSON.parse(document.getElementById("fctd-data").textContent);
  const element = (id) => document.getElementById(id);

  // Little-endian float32, as page.py packs them.
  const unpack = (text) => new Float32Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
  const unpackAll = (table) => Object.fromEntries(Object.entries(table).map(([key, text]) => [key, unpack(text)]));
  const axis = unpackAll(view.axis), columns = unpackAll(view.columns), offset = unpack(view.offset);
  const [lines, rings, shoes] = [view.lines, view.rings, view.shoes].map(unpackAll);
  const starts = [0];
  for (const count of view.counts) starts.push(starts[starts.length - 1] + count);
  const firsts = [0];
  for (const group of view.groups) firsts.push(firsts[firsts.length - 1] + group.steps.length);

  const shown = { group: 0, step: 0, colour: view.colour, times: view.exaggeration, picked: NaN, camera: "free" };
  const sceneData = view.scene.data, panelData = view.panels.data;
  const trace = (data, name) => data.findIndex((one) => one.name === name);

  // Columns of the string that is shown.
  function string() {
    const k = firsts[shown.group] + shown.step, from = starts[k], to = starts[k + 1];
    const of = (name) => columns[name].subarray(from, to);
    return { n: to - from, of, offset: offset.subarray(3 * from, 3 * to) };
  }

  // Linear between rows of rising depths; places are rows of `width` numbers.
  function interpolate(md, values, width, at, out, to) {
    let low = 0, high = md.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (md[middle] <= at) low = middle; else high = middle;
    }
    const share = (at - md[low]) / (md[high] - md[low] || 1);
    for (let k = 0; k < width; k++) {
      const a = values[width * low + k], b = values[width * high + k];
      out[to + k] = a + share * (b - a);
    }
  }

  // Drawn radius of the hole at stations: the exaggerated clearance of the string beside them.
  function radii(stations, one) {
    const found = new Float32Array(stations.md.length);
    if (!one.n) return found;
    const md = one.of("md_m"), clearance = one.of("clearance_m");
    for (let k = 0; k < found.length; k++) {
      const at = Math.min(Math.max(stations.md[k], md[0]), md[one.n - 1]);
      if (one.n > 1) interpolate(md, clearance, 1, at, found, k); else found[k] = clearance[0];
      found[k] = shown.times * Math.max(found[k], 0);
    }
    return found;
  }

  class Places {
    constructor(size) { [this.x, this.y, this.z] = [0, 1, 2].map(() => new Float32Array(size).fill(NaN)); this.n = 0; }
    add(x, y, z) { this.x[this.n] = x; this.y[this.n] = y; this.z[this.n++] = z; }
    skip() { this.n++; }
  }

  function beside(out, stations, k, radius, angle) {
    const a = radius * Math.cos(angle), b = radius * Math.sin(angle), j = 3 * k;
    const { centre, first, second } = stations;
    out.add(
      centre[j] + a * first[j] + b * second[j], centre[j + 1] + a * first[j + 1] + b * second[j + 1],
      centre[j + 2] + a * first[j + 2] + b * second[j + 2]);
  }

  function wallLines(one) {
    const radius = radii(lines, one), out = new Places(view.sides.length * (radius.length + 1));
    for (const side of view.sides) {
      for (let k = 0; k < radius.length; k++) beside(out, lines, k, radius[k], side);
      out.skip();
    }
    return out;
  }

  function ringsOf(stations, one) {
    const radius = radii(stations, one), out = new Places(radius.length * (view.around.length + 1));
    for (let k = 0; k < radius.length; k++) {
      for (const angle of view.around) beside(out, stations, k, radius[k], angle);
      out.skip();
    }
    return out;
  }

  function stringPlaces(one) {
    const out = new Places(one.n), at = new Float32Array(3), md = one.of("md_m");
    for (let k = 0; k < one.n; k++) {
      interpolate(axis.md, axis.at, 3, md[k], at, 0);
      out.add(...[0, 1, 2].map((i) => at[i] + shown.times * one.offset[3 * k + i]));
    }
    return out;
  }

  const short = (value) => Math.abs(value) >= 1e5 ? value.toExponential(3) : String(Number(value.toPrecision(4)));

  function texts(one) {
    const md = one.of("md_m"), found = [];
    const parts = view.quantities.map((q) => [q, one.of(q.column)]);
    for (let k = 0; k < one.n; k++) {
      let text = `${(md[k] * view.depth.factor).toFixed(1)} ${view.depth.label}`;
      for (const [q, values] of parts) {
        text += `<br>${q.label} ` + (q.unit ? `${short(values[k] * q.factor)} ${q.unit}` : view.modes[values[k]]);
      }
      found.push(text);
    }
    return found;
  }

  const scaled = (values, factor) => values.map((value) => Number.isFinite(value * factor) ? value * factor : NaN);
  const quantity = () => view.quantities.find((one) => one.name === shown.colour);
  const set = (data, name, change) => { const k = trace(data, name); data[k] = { ...data[k], ...change }; };

  // New data of all traces for the string that is shown.
  function fill() {
    const one = string(), q = quantity(), colour = scaled(one.of(q.column), q.factor);
    const force = one.of("contact_force_N"), touching = [];
    for (let k = 0; k < one.n; k++) if (force[k] > 0) touching.push(k);
    const pick = (values) => Float32Array.from(touching, (k) => values[k]);
    const places = stringPlaces(one), text = texts(one);
    const { x: wx, y: wy, z: wz } = wallLines(one), ring = ringsOf(rings, one), shoe = ringsOf(shoes, one);
    set(sceneData, "wall", { x: wx, y: wy, z: wz });
    set(sceneData, "rings", { x: ring.x, y: ring.y, z: ring.z });
    set(sceneData, "shoes", { x: shoe.x, y: shoe.y, z: shoe.z });
    set(sceneData, "string", { x: places.x, y: places.y, z: places.z, text, line: { ...q.line, color: colour } });
    set(sceneData, "contacts", {
      x: pick(places.x), y: pick(places.y), z: pick(places.z), text: touching.map((k) => text[k]) });
    const chosen = nearest(one, shown.picked);
    set(sceneData, "picked", chosen < 0 ? { x: [], y: [], z: [] }
      : { x: [places.x[chosen]], y: [places.y[chosen]], z: [places.z[chosen]] });
    const md = scaled(one.of("md_m"), view.depth.factor), tension = view.tension.factor;
    const { color: _, showscale: __, colorbar: ___, width: ____, ...scale } = q.line;
    set(panelData, "angle", {
      x: pick(one.of("contact_angle_deg")).map((angle) => angle > 270 ? angle - 360 : angle), y: pick(md),
      marker: { ...panelData[trace(panelData, "angle")].marker, ...scale, color: pick(colour) } });
    set(panelData, "side force", { x: scaled(one.of("side_force"), view.force.factor), y: md });
    set(panelData, "tension", { x: scaled(one.of("effective_tension_N"), tension), y: md });
    for (const mode of ["sinusoidal", "helical"]) {
      set(panelData, `${mode} limit`, { x: scaled(one.of(`${mode}_limit_N`), -tension), y: md });
    }
    return { one, places };
  }

  function nearest(one, at) {
    if (!one.n || !Number.isFinite(at)) return -1;
    const md = one.of("md_m");
    let found = 0;
    for (let k = 1; k < one.n; k++) if (Math.abs(md[k] - at) < Math.abs(md[found] - at)) found = k;
    return found;
  }

  // A place in the unit cube of plotly's camera.
  function inCube(place) {
    const { xaxis, yaxis, zaxis, aspectratio: ratio } = view.scene.layout.scene, found = {};
    for (const [k, name, ends] of [[0, "x", xaxis.range], [1, "y", yaxis.range], [2, "z", zaxis.range]]) {
      found[name] = ((place[k] - ends[0]) / (ends[1] - ends[0]) - 0.5) * ratio[name];
    }
    return found;
  }

  // A camera near the bit, or one within the hole that looks along it towards a place on the string.
  function camera(one, places) {
    const md = one.of("md_m"), at = new Float32Array(3), back = new Float32Array(3), last = one.n - 1;
    if (shown.camera === "along") {
      const force = one.of("side_force");
      let k = nearest(one, shown.picked);
      if (k < 0) for (let j = k = 0; j < one.n; j++) if (force[j] > force[k]) k = j;
      const behind = Math.max(12 * view.radius * shown.times / view.exaggeration, 60);
      interpolate(axis.md, axis.at, 3, md[k], at, 0);
      interpolate(axis.md, axis.at, 3, Math.max(md[k] - behind, axis.md[0]), back, 0);
      if (Math.hypot(at[0] - back[0], at[1] - back[1]) < 0.05 * behind) back[0] -= 0.05 * behind;
      return { eye: inCube(back), center: inCube(at), up: { x: 0, y: 0, z: 1 } };
    }
    const center = inCube([places.x[last], places.y[last], places.z[last]]);
    const { eye } = view.scene.layout.scene.camera, size = Math.hypot(eye.x, eye.y);
    const far = 0.28;
    return {
      eye: { x: center.x + far * eye.x / size, y: center.y + far * eye.y / size, z: center.z + 0.1 },
      center, up: { x: 0, y: 0, z: 1 } };
  }

  const titles = { name: document.title };
  function caption() {
    const group = view.groups[shown.group], step = group.steps[shown.step];
    element("name").textContent = titles.name;
    element("where").textContent = view.along === "time" ? step.where : `${group.label}, ${step.where}`;
    element("words").innerHTML = step.words;  // escaped where it was written
    element("exaggerated").textContent = short(shown.times);
    element("step").setAttribute("aria-valuetext", step.where);
  }

  let busy = false, again = false;
  const times = [];
  // Draw what is shown; while a drawing is on its way the latest wish alone is kept.
  async function draw() {
    if (busy) { again = true; return; }
    busy = true;
    do {
      again = false;
      const start = performance.now(), { one, places } = fill();
      caption();
      const layout = { ...view.scene.layout };
      if (shown.camera !== "free" && one.n) {
        layout.scene = { ...layout.scene, camera: camera(one, places), uirevision: `${Math.random()}` };
      } else if (element("scene").layout) {
        layout.scene = { ...layout.scene, uirevision: "free", camera: element("scene").layout.scene.camera };
      }
      await Plotly.react("scene", [...sceneData], layout, view.config);
      const middle = performance.now();
      const lines = Number.isFinite(shown.picked) ? [{
        type: "line", xref: "paper", x0: 0, x1: 1, y0: shown.picked * view.depth.factor,
        y1: shown.picked * view.depth.factor, line: { color: "#004C98", width: 1 } }] : [];
      const panels = { ...view.panels.layout, shapes: [...view.panels.layout.shapes, ...lines] };
      await Plotly.react("panels", [...panelData], panels, view.config);
      times.push([middle - start, performance.now() - start]);
    } while (again);
    busy = false;
  }

  function choices(select, names) {
    for (const [value, label] of names) select.add(new Option(label, value));
  }

  function restep() {
    const slider = element("step");
    slider.max = view.groups[shown.group].steps.length - 1;
    shown.step = Math.min(shown.step, Number(slider.max));
    slider.value = shown.step;
  }

  let playing = false;
  async function play() {
    playing = !playing;
    element("play").textContent = playing ? "⏸ pause" : "▶ play";
    while (playing) {
      shown.step = (shown.step + 1) % view.groups[shown.group].steps.length;
      element("step").value = shown.step;
      await draw();
      await new Promise((done) => setTimeout(done, 60));
    }
  }

  function webgl() {
    const canvas = document.createElement("canvas");
    return Boolean(canvas.getContext("webgl2") || canvas.getContext("webgl"));
  }

  function fault(text) { element("fault").textContent = text; element("fault").hidden = false; }

  async function start() {
    choices(element("group"), view.groups.map((group, k) => [k, group.label]));
    element("group").parentElement.hidden = view.groups.length < 2;
    choices(element("colour"), view.quantities.map((q) => [q.name, q.label]));
    element("colour").value = shown.colour;
    element("along").firstElementChild.textContent = view.along;
    element("times").value = shown.times;
    shown.step = view.groups[0].steps.length - 1;
    restep();
    element("tools").addEventListener("submit", (event) => event.preventDefault());
    element("step").addEventListener("input", (event) => { shown.step = Number(event.target.value); draw(); });
    element("group").addEventListener("change", (event) => { shown.group = Number(event.target.value); restep(); draw(); });
    element("colour").addEventListener("change", (event) => { shown.colour = event.target.value; draw(); });
    element("times").addEventListener("change", (event) => {
      const given = Number(event.target.value);
      shown.times = Number.isFinite(given) && given >= 1 ? given : view.exaggeration;
      event.target.value = shown.times;
      draw();
    });
    element("play").addEventListener("click", play);
    const views = document.querySelectorAll("[data-view]");
    for (const button of views) {
      button.addEventListener("click", async () => {
        shown.camera = button.dataset.view === "well" ? "free" : button.dataset.view;
        for (const other of views) other.setAttribute("aria-pressed", other === button);
        if (shown.camera === "free") {
          await Plotly.relayout("scene", { "scene.camera": view.scene.layout.scene.camera });
        } else {
          draw();
        }
      });
    }
    if (!webgl()) fault("This browser has no WebGL, which the picture in three dimensions needs; the panels need none.");
    await draw();
    const scene = element("scene"), panels = element("panels");
    // A hand on the camera ends following.
    scene.on("plotly_relayouting", () => { shown.camera = "free"; });
    panels.on("plotly_click", ({ points }) => { shown.picked = points[0].y / view.depth.factor; draw(); });
    scene.on("plotly_click", ({ points }) => {
      const one = string(), name = points[0].data.name;
      const touching = Array.from(one.of("md_m")).filter((_, k) => one.of("contact_force_N")[k] > 0);
      const md = name === "contacts" ? touching : one.of("md_m");
      shown.picked = md[points[0].pointNumber];
      draw();
    });
    document.documentElement.dataset.ready = "yes";
  }

  const show = async (step) => { shown.step = step; restep(); await draw(); };
  window.fctd = { show, shown, times, ready: start(), data: { scene: sceneData, panels: panelData } };
  window.fctd.ready.catch((error) => fault(`The view cannot be drawn: ${error.message}`));
})();
