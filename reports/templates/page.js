"use strict";
// Tables sort by a click on a heading; what is folded is open on paper.
for (const table of document.querySelectorAll("table.sortable")) {
  const heads = [...table.tHead.rows[0].cells];
  // A number as it is printed: narrow spaces between thousands, ×10 with raised digits, a typographic minus.
  const value = (text) => {
    const raised = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹", plain = text.trim().replace(/[\u202f]/g, "").replace(/\u2212/g, "-");
    const found = plain.match(/^(-?[\d.]+)(?:\u00a0×\u00a010([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?/);
    if (!found) return plain.startsWith("∞") ? Infinity : plain.startsWith("-∞") ? -Infinity : NaN;
    const power = [...(found[2] || "")].map((c) => "-0123456789"[raised.indexOf(c)]).join("");
    return Number(found[1]) * 10 ** Number(power || 0);
  };
  heads.forEach((head, column) => {
    head.tabIndex = 0;
    const sort = () => {
      const down = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
      for (const other of heads) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", down > 0 ? "ascending" : "descending");
      // A table of checks has a body for each check, which keeps a row and its explanation together.
      const parts = table.tBodies.length > 1 ? [...table.tBodies] : [...table.tBodies[0].rows];
      const text = (part) => (part.rows ? part.rows[0] : part).cells[column].textContent;
      const numeric = head.classList.contains("number");
      const compare = (a, b) => {
        if (!numeric) return down * text(a).localeCompare(text(b), "en", { numeric: true });
        const [x, y] = [value(text(a)), value(text(b))];
        if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y);
        return down * (x === y ? 0 : x - y);
      };
      const parent = parts[0] && parts[0].parentNode;
      for (const part of parts.sort(compare)) parent.append(part);
    };
    head.addEventListener("click", sort);
    head.addEventListener("keydown", (event) => { if (event.key === "Enter") sort(); });
  });
}
addEventListener("beforeprint", () => { for (const fold of document.querySelectorAll("details")) fold.open = true; });
// A link to what is folded opens it.
const unfold = () => {
  const target = location.hash && document.getElementById(location.hash.slice(1));
  const fold = target && target.closest("details");
  if (fold) fold.open = true;
};
addEventListener("hashchange", unfold);
unfold();
