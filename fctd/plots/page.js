// Panels side by side where the window has room for them, else in rows of as many as are readable.
{
  const gd = document.getElementById("fctd");
  const NARROWEST = 110, READABLE = 150, ROW = 420, BELOW = 90, ENTRY = 20; // [px]
  const names = Object.keys(gd.layout).filter((key) => /^xaxis\d*$/.test(key));
  const TOP = gd.layout.margin.t;
  const first = { height: gd.layout.height, "margin.t": gd.layout.margin.t, "margin.b": gd.layout.margin.b,
                  "margin.r": gd.layout.margin.r };
  const inRow = new Set(names.map((x) => gd.layout[x].domain[0])).size;
  const perRow = Math.max(2, inRow);
  for (const x of names) {
    const y = x.replace("x", "y");
    first[`${x}.domain`] = gd.layout[x].domain;
    first[`${y}.domain`] = gd.layout[y].domain;
    first[`${y}.showticklabels`] = gd._fullLayout[y].showticklabels;
    first[`${y}.title.text`] = gd.layout[y].title?.text ?? "";
  }
  // Names of groups stand above their row of panels.
  const groups = (gd.layout.annotations ?? []).flatMap((note, k) => (note.xref === "paper" ? [`annotations[${k}]`] : []));
  groups.forEach((key) => {
    const note = gd.layout.annotations[Number(key.match(/\d+/))];
    [first[`${key}.x`], first[`${key}.y`]] = [note.x, note.y];
  });
  const entries = gd.data.filter((trace) => trace.showlegend !== false).length;
  let shown = 0; // panels in a row; 0 : as they came

  const stacked = (across) => {
    const rows = Math.ceil(names.length / across), height = rows * (ROW + BELOW), change = {};
    names.forEach((x, k) => {
      const y = x.replace("x", "y"), row = Math.floor(k / across), column = k % across;
      const head = names[k - (k % perRow)].replace("x", "y");
      change[`${x}.domain`] = [column / across + (column ? 0.04 : 0), (column + 1) / across - (column < across - 1 ? 0.04 : 0)];
      change[`${y}.domain`] = [1 - (row * (ROW + BELOW) + ROW) / height, 1 - (row * (ROW + BELOW)) / height];
      change[`${y}.showticklabels`] = !column;
      change[`${y}.title.text`] = column ? "" : first[`${head}.title.text`] || first["yaxis.title.text"];
    });
    groups.forEach((key, k) => {
      change[`${key}.x`] = 0.5;
      change[`${key}.y`] = change[`${names[k * perRow].replace("x", "y")}.domain`][1];
    });
    const bottom = 20 + ENTRY * entries;
    return { ...change, height: TOP + height + bottom, "margin.t": TOP, "margin.b": bottom, "margin.r": 20 };
  };

  const arrange = () => {
    const width = document.documentElement.clientWidth, room = width - 90;
    const fits = room / perRow >= Math.max(NARROWEST, 480 / perRow);
    const across = fits ? 0 : perRow === 2 ? 1 : Math.min(perRow, Math.max(1, Math.floor(room / READABLE)));
    const moved = across === shown ? {} : across ? stacked(across) : first;
    shown = across;
    gd.style.height = `${moved.height ?? gd.layout.height}px`;
    Plotly.relayout(gd, { ...moved, width });
  };
  addEventListener("resize", arrange);
  arrange();
}
