"use strict";
// What the page does between its events and the server: while one wish is answered the latest of the others waits.
(() => {
  const REST = 300; // a slider that has rested so long is solved at all depths [ms]
  const LOST = 30000; // an answer that has not come by then will not come [ms]
  const PATIENCE = 500; // after which the pictures are marked as those of before [ms]
  // Largest files [bytes]: a request has at most 5 MiB, and files go in base64, which takes a third more.
  const MOST = 3.5 * 2 ** 20;
  const state = {
    busy: false, since: 0, next: null, rest: null, drawing: false, turn: 0, n: 0, values: {}, own: {}, shown: {}, opened: 0, of: "" };
  const set = (id, props) => dash_clientside.set_props(id, props);
  const unchanged = () => dash_clientside.no_update;

  // Whether the pictures are those of before.
  function waiting(late) {
    document.getElementById("page").setAttribute("aria-busy", String(late));
  }

  function send(wish) {
    const now = performance.now();
    if (state.busy && now - state.since < LOST) {
      state.next = { ...wish, hole: wish.hole || Boolean(state.next && state.next.hole) };
      return unchanged();
    }
    state.busy = true;
    state.since = now;
    clearTimeout(state.late);
    state.late = setTimeout(() => waiting(true), PATIENCE);
    return wish;
  }

  function wish(coarse, hole) {
    // Those that stand where the case has them are left to the case.
    const moved = Object.entries(state.values).filter(([name, value]) => value !== state.own[name]);
    return { ...state.shown, values: Object.fromEntries(moved), coarse, hole, of: state.of, n: ++state.n };
  }

  function later() {
    clearTimeout(state.rest);
    state.rest = setTimeout(() => {
      if (state.drawing) return later();  // a server on the same machine would slow the pictures of the last move
      const wanted = send(wish(false, false));
      if (wanted !== unchanged()) set("wish", { data: wanted });
    }, REST);
  }

  // Sliders are named for those who do not see what stands above them.
  function nameSliders() {
    for (const thumb of document.querySelectorAll(".slider [role=slider]")) {
      thumb.setAttribute("aria-label", thumb.closest(".slider").querySelector("label").textContent);
    }
  }

  const told = {};
  // A number beside its slider, where it has changed.
  function say(id, value) {
    const key = JSON.stringify(id), text = String(Number(value.toPrecision(5)));
    if (told[key] === text) return;
    told[key] = text;
    set(id, { children: text });
  }

  function moved(drags, values, depthDrag, depth, operations, operation, colour, opened, ids) {
    if (!opened) return unchanged();
    const triggered = dash_clientside.callback_context.triggered.map(({ prop_id, value }) => {
      const dot = prop_id.lastIndexOf("."), id = prop_id.slice(0, dot), prop = prop_id.slice(dot + 1);
      return { name: id.startsWith("{") ? JSON.parse(id).slider : "", id, prop, value };
    });
    const fresh = opened.n !== state.opened;
    if (fresh) {
      state.opened = opened.n;
      state.of = opened.of;
      state.own = opened.own;
      state.values = { ...opened.own, ...opened.values };
      for (const key of Object.keys(told)) delete told[key];
      requestAnimationFrame(nameSliders);
    }
    let hole = fresh, dragged = false, loads = false;
    for (const { name, id, prop, value } of triggered) {
      if (name && typeof value === "number") {
        loads = loads || state.values[name] !== value;
        state.values[name] = value;
        hole = hole || name === "segment";
        dragged = true;
      } else if (!name) {
        hole = hole || id === "depth" || id === "operation";
        dragged = dragged || id === "depth";
      }
    }
    for (const { slider } of ids) if (slider in state.values) say({ shown: slider }, state.values[slider]);
    const at = triggered.some(({ id, prop }) => id === "depth" && prop === "drag_value") ? depthDrag : depth;
    say("depth-shown", at);
    const shown = { operations, operation, colour, depth: at };
    const same = !loads && !fresh && !opened.again && JSON.stringify(shown) === JSON.stringify(state.shown);
    state.shown = shown;
    if (same && !dragged) return unchanged();
    if (fresh || !dragged) return send(wish(false, hole));
    later();
    return same ? unchanged() : send(wish(true, hole));
  }

  // A figure with changes, which are ways and values; what stays is shared with the figure before.
  function changed(figure, changes) {
    const own = new Set();
    const copy = (part) => {
      const made = Array.isArray(part) ? [...part] : { ...part };
      own.add(made);
      return made;
    };
    const found = copy(figure);
    for (const [way, value] of changes) {
      const last = way.length - 1;
      let place = found;
      for (const key of way.slice(0, last)) {
        if (!own.has(place[key])) place[key] = copy(place[key]);
        place = place[key];
      }
      place[way[last]] = value;
    }
    return found;
  }

  // One picture is painted after the other, the chart first: what is drawn in one turn is painted at once, and without
  // a graphics card the scene takes longer than all the rest.
  const due = { panels: [], scene: [] };
  const names = Object.keys(due);
  function turnTo(name) {
    state.drawing = true;
    requestAnimationFrame(() => setTimeout(() => {
      state.drawing = Boolean(name);
      if (name) set("turn", { data: { name, n: ++state.turn } });
    }));
  }

  function drawn(answered, loads) {
    state.busy = false;
    clearTimeout(state.late);
    if (!state.next) waiting(false);
    document.getElementById("page").toggleAttribute("data-before", !answered.loads);  // refused
    if (state.next) {
      const next = state.next;
      state.next = null;
      set("wish", { data: send(next) });
    }
    if (!answered.loads) return unchanged();
    for (const name of names) due[name].push(...answered[name]);
    turnTo(names[0]);
    return changed(loads, answered.loads);
  }

  function drawnInTurn(turn, ...figures) {
    turnTo(names[names.indexOf(turn.name) + 1]);
    return names.map((name, k) => {
      if (name !== turn.name || !due[name].length) return unchanged();
      return changed(figures[k], due[name].splice(0));
    });
  }

  window.dash_clientside = Object.assign(window.dash_clientside || {}, {
    fctd: { moved, drawn, drawnInTurn, empty: (text) => !text },
  });

  // Files that the server would refuse are not sent: the page's framework says nothing of such an answer.
  const ends = { upload: "upload-fault", "measured-file": "measured-told" };
  function weigh(event) {
    const box = event.target.closest?.("#upload, #measured-file");
    const files = [...((event.type === "drop" ? event.dataTransfer : event.target)?.files ?? [])];
    if (!box || files.reduce((sum, { size }) => sum + size, 0) <= MOST) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (event.type === "change") event.target.value = "";
    set(ends[box.id], { children: `${files.map(({ name }) => name).join(", ")}: expected files of at most 3.5 MiB` });
  }
  for (const type of ["change", "drop"]) document.addEventListener(type, weigh, { capture: true });

  // The server ends the run of a page that is closed; one that is loaded again asks at once.
  window.addEventListener("pagehide", () => navigator.sendBeacon(`${location.pathname}closed`));
})();
