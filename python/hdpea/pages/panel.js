// SPDX-License-Identifier: GPL-3.0-or-later
// The panel: what is shown, beside what, in which colours. A link may say it, too: page.html#coloring=curvature&edges=0&panel=0

const asked = new URLSearchParams(location.hash.slice(1));
const [first, second, coloring, edgesShown, pointsShown] = ["first", "second", "coloring", "edges", "points"].map((id) =>
  document.getElementById(id));
const dots = page.shapes.find((shape) => shape.kind === "points");

function fill(select, names, chosen) {
  select.replaceChildren(...names.map(([value, name]) => new Option(name, value, false, value === chosen)));
  if (select.selectedIndex < 0) select.selectedIndex = 0;
}

function shapesShown() {
  return [first, second].filter((each) => each.value !== "").map((each) => page.shapes[each.value]);
}

function listColorings() {
  const names = new Set(shapesShown().flatMap((shape) => shape.colorings.map((each) => each.name)));
  fill(coloring, [["", "nothing"], ...[...names].map((name) => [name, name])], coloring.value);
  coloring.parentElement.hidden = names.size === 0;
}

function update() {
  listColorings();
  const shown = shapesShown(), colored = shown.map((shape) => shape.colorings.find((each) => each.name === coloring.value));
  show(shown.map((shape, i) => [
    ...objectsOf(shape, colored[i], edgesShown.checked),
    ...(pointsShown.checked && dots && shape !== dots ? [dotsOf(dots)] : []),
  ]));
  edgesShown.parentElement.hidden = !shown.some((shape) => shape.kind === "mesh");
  pointsShown.parentElement.hidden = !dots || shown.every((shape) => shape === dots);
  legend(colored.find((each) => each && each.kind === "ramp"));
  names(shown);
}

function legend(shown) {
  document.getElementById("legend").hidden = !shown;
  if (!shown) return;
  document.getElementById("marks").replaceChildren(...shown.marks.map((mark) => {
    const span = document.createElement("span");
    span.textContent = mark;
    return span;
  }));
  document.getElementById("note").textContent = shown.note;
}

/** Captions of the panels, which need none if there is one. */
function names(shown) {
  document.getElementById("names").replaceChildren(...(shown.length < 2 ? [] : shown).map((shape) => {
    const caption = document.createElement("span");
    caption.textContent = shape.name;
    return caption;
  }));
}

const all = page.shapes.map((shape, i) => [String(i), shape.name]);
fill(first, all, asked.get("first") ?? "0");
fill(second, [["", "nothing"], ...all], asked.get("second") ?? page.beside);
for (const each of [first, second]) each.parentElement.hidden = page.shapes.length < 2;
listColorings();
coloring.value = asked.get("coloring") ?? page.coloring;
edgesShown.checked = asked.has("edges") ? asked.get("edges") === "1" : page.edges;
if (asked.has("points")) pointsShown.checked = asked.get("points") === "1";
for (const each of [first, second, coloring, edgesShown, pointsShown]) each.addEventListener("change", update);
document.getElementById("legend").style.setProperty("--ramp", page.ramp.map((each) => `rgb(${each})`).join(","));

const panel = document.querySelector("details");
function makeRoom() {
  document.documentElement.classList.toggle("beside", panel.open && !panel.parentElement.hidden);
  redraw();
}
panel.parentElement.hidden = asked.get("panel") === "0";
panel.open = window.innerWidth > 700;
panel.addEventListener("toggle", makeRoom);
makeRoom();
reset();
update();
