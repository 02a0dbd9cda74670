// SPDX-License-Identifier: Apache-2.0
// The page: fills in the text, and joins the slider, the map, the plots and the tables.

// The domain of a variable in the last frame where it is not empty.
function lastDomain(data, index) {
  for (let i = data.frames.length - 1; i >= 0; --i) {
    if (data.frames[i].domains[index]) return data.frames[i].domains[index];
  }
  return null;
}

function cssColor(name) { return getComputedStyle(document.documentElement).getPropertyValue(name).trim(); }

// The tube that the map shows at first: one whose truth is known, or else that was contracted, or else the first.
function leadingTube(data, tubes) {
  const changes = (tube) => data.frames.some((frame) => frame.domains[tube.index] !== data.frames[0].domains[tube.index]);
  return tubes.find((tube) => data.truth[tube.name]) || tubes.find(changes) || tubes[0];
}

// Whether a tube on phases leads from where another starts to where that ends: ways to compare. A derivative is none.
function isSameWay(data, tube, other) {
  if (!tube.drawn || !other.drawn || tube.degree !== other.degree) return false;
  const a = lastDomain(data, tube.index), b = lastDomain(data, other.index);
  const isKnown = (item) => [0, 1].every((c) => [a.lo(c, item), a.hi(c, item), b.lo(c, item), b.hi(c, item)].every(Number.isFinite));
  let last = a.items - 1;  // one may be over before the picture is
  while (last > 0 && !isKnown(last)) --last;
  return [0, last].every((item) => [0, 1].every((c) => a.lo(c, item) <= b.hi(c, item) && b.lo(c, item) <= a.hi(c, item)));
}

// Of a paving, what its boxes are.
function layersOfPaving(data) {
  return data.variables.filter((each) => each.kind === "paving").flatMap(({ index, name }) => {
    const domain = data.frames[0].domains[index];
    const colors = { inside: "--set-0", boundary: "--set-1", unexplored: "--set-3" };
    return ["inside", "boundary", "unexplored"].filter((kind) => kind === "boundary" || domain[kind].length)
      .map((kind) => ({ kind, index, name, color: colors[kind], on: true }));
  });
}

// What the map can show. At first: what is known of every set, what is open of the bounded ones, one tube.
function layersOf(data) {
  const layers = layersOfPaving(data);
  const sets = data.variables.filter((each) => each.kind === "set" && each.dim === 2 && lastDomain(data, each.index));
  const isBounded = (set) => lastDomain(data, set.index).background === "outside";
  sets.forEach((set, i) => {
    const color = "--set-" + (i % 4), { index, name } = set;
    const hasInside = data.frames.some((frame) => frame.domains[index] && frame.domains[index].inside.length);
    if (hasInside) layers.push({ kind: "inside", index, name, color, on: true });
    layers.push({ kind: "unknown", index, name, color, on: isBounded(set) || !sets.some(isBounded) });
  });
  const tubes = data.variables.filter((each) => each.kind === "tube" && each.dim >= 2 && lastDomain(data, each.index));
  const leading = leadingTube(data, tubes);
  for (const tube of tubes) {
    const { index, name, color } = tube, on = tube === leading || isSameWay(data, tube, leading);
    layers.push({ kind: "tube", index, name, color, on });
    if (data.truth[name]) layers.push({ kind: "truth", index, name, color: "--truth", on });
  }
  return layers;
}

function fillHeader(data) {
  document.title = data.model + " \u2013 hcsp";
  d3.select("#model").text(data.model);
  d3.select("#status").text(data.status).classed(data.status, true)
    .attr("title", { contracted: "No solution was lost; whether one exists is not said.",
      infeasible: "It is proven that no solution exists.",
      solved: data.paving ? "No point outside belongs to the set, every point inside does." : "Every solution is in one of the boxes.",
      limit: "Stopped early; the domains still hold every solution." }[data.status] || null);
  const facts = [["solved in", textOfSeconds(number(data.seconds))], data.search || data.paving ? ["cells", (data.search || data.paving).cells] : ["passes", data.passes],
    ["threads", data.threads]];
  const rows = d3.select("#facts").selectAll("div").data(facts).join("div");
  rows.append("dt").text((d) => d[0]);
  rows.append("dd").text((d) => d[1]);
  d3.select("#footer").text("hcsp " + data.hcsp + " \u2013 every domain encloses every solution of the model.");
}

function fillExplanation(data) {
  const why = data.explanation;
  if (!why) return;
  const card = d3.select("#explanation").attr("hidden", null);
  const line = card.append("p");
  line.append("strong").text("No solution exists. ");
  line.append("span").text("Constraint ");
  line.append("code").text(why.constraint);
  line.append("span").text(why.variable ? " leaves no value for " : " refutes it.");
  if (why.variable) line.append("code").text(why.variable);
  if (why.time) {
    line.append("span").text(why.time[0] === why.time[1] ? ` at t = ${textOfNumber(why.time[0])}.`
      : ` for t in [${why.time.map(textOfNumber).join(", ")}].`);
  }
  if (!why.readings.length) return;
  const few = why.readings.slice(0, 40);
  card.append("p").attr("class", "note").text(`These ${why.readings.length} readings cannot all be right` +
    (why.complete ? ", whatever the others say:" : "; the search for a smaller set was stopped:"));
  const items = card.append("ul").attr("class", "readings").selectAll("li").data(few).join("li");
  items.text(([variable, time, source]) => `${variable}(${textOfNumber(time)})` + (source ? `  ${source}` : ""));
  if (few.length < why.readings.length) card.select("ul").append("li").text("and " + (why.readings.length - few.length) + " more");
}

// A side of a box in which a solution is isolated is a number with as many digits as are known.
function textOfSide([lo, hi]) {
  const digits = -Math.log10((hi - lo) / Math.max(Math.abs(lo), Math.abs(hi)));
  if (lo === hi) return String(lo);
  return digits > 4 ? ((lo + hi) / 2).toPrecision(Math.min(12, Math.floor(digits))) : textOfBounds(lo, hi);
}

function fillSolutions(data) {
  if (!data.search) return;
  const { solutions, boxes, unexplored, cells } = data.search;
  d3.select("#solutions-card").attr("hidden", null);
  d3.select("#solutions-note").text(`${boxes} ${boxes === 1 ? "box" : "boxes"}` + (unexplored ? `, ${unexplored} unexplored` : "") +
    (solutions.length < boxes ? `, the first ${solutions.length}` : "") + `; ${cells} cells` +
    (data.objective ? `; objective in [${data.objective.join(", ")}]` : ""));
  const table = d3.select("#solutions");
  table.append("thead").append("tr").selectAll("th").data(["", "certificate", ...data.variables.map((v) => v.name)]).join("th").text((d) => d);
  const sides = (each) => each.map(([lo, hi]) => textOfSide([number(lo), number(hi)])).join(", ");
  const lines = table.append("tbody").selectAll("tr").data(solutions).join("tr");
  lines.selectAll("td").data(([certificate, reason, variables], i) =>
    [i + 1, certificate === "none" ? `not proven: ${reason}` : certificate, ...variables.map(sides)]).join("td").text((d) => d);
}

function fillContractors(data) {
  if (!data.contractors.length) return;
  d3.select("#contractors-card").attr("hidden", null);
  const table = d3.select("#contractors");
  table.append("thead").append("tr").selectAll("th").data(["contractor", "calls", "time", ""]).join("th")
    .attr("class", (d, i) => i === 1 || i === 2 ? "number" : null).text((d) => d);
  const rows = data.contractors.map(([name, calls, seconds]) => ({ name, calls, seconds: number(seconds) }))
    .sort((a, b) => b.seconds - a.seconds);
  const most = d3.max(rows, (row) => row.seconds) || 1;
  const lines = table.append("tbody").selectAll("tr").data(rows).join("tr");
  lines.append("td").append("span").attr("class", "name").text((d) => d.name);
  lines.append("td").attr("class", "number").text((d) => d.calls);
  lines.append("td").attr("class", "number").text((d) => textOfSeconds(d.seconds));
  lines.append("td").style("width", "30%").append("span").attr("class", "bar").style("width", (d) => 100 * d.seconds / most + "%");
}

function textOfDomain(domain, variable) {
  if (domain === null) return "empty";
  if (variable.kind === "tube") {
    return `width ${textOfNumber(domain.meanWidth())} on average, ${textOfNumber(domain.maxWidth())} at most`;
  }
  if (variable.kind === "set" || variable.kind === "paving") {
    return `${variable.dim === 1 ? "length" : variable.dim === 2 ? "area" : "volume"} in ${textOfBounds(...domain.volume)}`;
  }
  return domain.map(([lo, hi]) => textOfBounds(lo, hi)).join(" \u00d7 ");
}

function fillDomains(data, frame) {
  const kinds = { tube: (v) => "tube real" + (v.dim > 1 ? `[${v.dim}]` : ""), set: (v) => `set real[${v.dim}]`,
    paving: (v) => v.dim > 2 ? `a set, projected` : "a set", real: () => "real", vector: (v) => `real[${v.dim}]` };
  const rows = d3.select("#domains").selectAll("tr").data(data.variables).join("tr").selectAll("td")
    .data((v) => [v.name, kinds[v.kind](v), textOfDomain(data.frames[frame].domains[v.index], v)]).join("td");
  rows.attr("class", (d, i) => i === 0 ? "name" : i === 1 ? "note" : null).text((d) => d);
}

function showTip(hover) {
  const tip = d3.select("#tip").attr("hidden", hover ? null : "");
  if (!hover) return;
  const rows = tip.selectAll("div").data(hover.rows).join("div");
  rows.text("");
  rows.append("b").text((d) => d[0] ? d[0] + "  " : "");
  rows.append("span").text((d) => d[1]);
  const { offsetWidth: width, offsetHeight: height } = tip.node();
  const { clientX: x, clientY: y } = hover.event;
  tip.style("left", (x + 16 + width > window.innerWidth ? Math.max(x - 16 - width, 4) : x + 16) + "px")
    .style("top", (y + 16 + height > window.innerHeight ? Math.max(y - 12 - height, 4) : y + 16) + "px");
}

function buildLegend(layers, redraw) {
  const label = { boundary: () => "boundary", unexplored: () => "unexplored", inside: (l) => l.name + " inside", unknown: (l) => l.name + " unknown", tube: (l) => l.name,
    truth: (l) => "true " + l.name };
  const buttons = d3.select("#legend").selectAll("button").data(layers).join("button").attr("type", "button");
  buttons.append("span").attr("class", (d) => d.kind === "truth" ? "swatch is-line" : "swatch")
    .style("background", (d) => d.kind === "truth" ? null : `var(${d.color})`)
    .style("border-color", (d) => d.kind === "truth" ? `var(${d.color})` : null)
    .style("opacity", (d) => ({ unknown: 0.35, inside: 0.75, unexplored: 0.5 })[d.kind] || null);
  buttons.append("span").text((d) => label[d.kind](d));
  const mark = () => buttons.attr("aria-pressed", (d) => String(d.on));
  buttons.on("click", function () {
    const layer = d3.select(this).datum();
    layer.on = !layer.on;
    mark();
    redraw();
  });
  mark();
}

// The slider over the passes, with a button that plays them; onPass(frame) shows one.
function buildSlider(data, start, onPass) {
  const slider = document.getElementById("pass"), button = document.getElementById("play");
  const icons = { play: "M3 1.5v13l11-6.5z", pause: "M3 1.5h3.5v13H3zM9.5 1.5H13v13H9.5z" };
  let timer = null;
  const most = Math.max(data.passes, data.frames[data.frames.length - 1].pass);
  const label = (frame) => {
    const { pass, domains } = data.frames[frame];
    if (domains.includes(null)) return "contradiction";
    return pass === 0 ? "before any pass" : `pass ${pass} of ${most}`;
  };
  const show = (frame) => {
    slider.value = frame;
    slider.setAttribute("aria-valuetext", label(frame));
    d3.select("#pass-label").text(label(frame));
    d3.select("#domains-pass").text(data.frames.length > 1 ? label(frame) : "");
    onPass(frame);
  };
  const setPlaying = (isPlaying) => {
    clearInterval(timer);
    timer = isPlaying ? setInterval(step, 900) : null;
    button.setAttribute("aria-label", isPlaying ? "Pause" : "Play the passes");
    d3.select(button).html(`<svg viewBox="0 0 16 16" aria-hidden="true"><path d="${icons[isPlaying ? "pause" : "play"]}"/></svg>`);
  };
  const step = () => {
    if (Number(slider.value) + 1 < data.frames.length) show(Number(slider.value) + 1);
    if (Number(slider.value) + 1 >= data.frames.length) setPlaying(false);
  };
  slider.max = data.frames.length - 1;
  slider.addEventListener("input", () => { setPlaying(false); show(Number(slider.value)); });
  button.addEventListener("click", () => {
    if (timer !== null) return setPlaying(false);
    if (Number(slider.value) + 1 >= data.frames.length) show(0);
    setPlaying(true);
  });
  d3.select("#passes").attr("hidden", data.frames.length > 1 ? null : "");
  setPlaying(false);
  show(start);
}

function noteOf(data, layers, frame) {
  const notes = [];
  for (const layer of layers.filter((each) => each.kind === "tube" && each.on)) {
    const domain = data.frames[frame].domains[layer.index];
    if (!domain) { notes.push(layer.name + " is empty"); continue; }
    const open = d3.range(domain.slices).filter((k) => !domain.isBounded(2 * k + 1)).length;
    if (open) notes.push(`${layer.name} is not bounded yet in ${open} of ${domain.slices} slices`);
  }
  return notes.join("; ");
}

function main() {
  const data = decode(JSON.parse(document.getElementById("data").textContent));
  let tubeCount = 0;
  for (const each of data.variables) if (each.kind === "tube") each.color = "--tube-" + (tubeCount++ % 3);
  fillHeader(data);
  fillExplanation(data);
  fillSolutions(data);
  fillContractors(data);
  const layers = layersOf(data);
  const tubes = data.variables.filter((each) => each.kind === "tube" && lastDomain(data, each.index));
  d3.select("#map-card").attr("hidden", layers.length ? null : "");
  d3.select("#plots-card").attr("hidden", tubes.length ? null : "");
  d3.select("main").classed("single", !layers.length || !tubes.length);
  let map = null, plots = null;
  const onHover = (hover) => {
    showTip(hover);
    if (map) map.showTime(hover ? hover.time : null);
    if (plots) plots.showTime(hover ? hover.time : null);
  };
  if (layers.length) map = new MapView(data, layers, onHover);
  if (tubes.length) plots = new TimePlots(data, tubes, onHover);
  let frame = 0;
  const redraw = () => {
    if (map) { map.frame = frame; map.draw(); }
    if (plots) { plots.frame = frame; plots.draw(); }
    d3.select("#map-note").text(noteOf(data, layers, frame));
    fillDomains(data, frame);
  };
  buildLegend(layers, redraw);
  const whole = data.frames.map((each) => each.domains.every((domain) => domain !== null)).lastIndexOf(true);
  buildSlider(data, whole >= 0 ? whole : data.frames.length - 1, (chosen) => { frame = chosen; redraw(); });
  d3.select("#fit").on("click", () => map && map.fit());
  if (plots) {
    const log = d3.select("#log").attr("aria-pressed", String(plots.useLog));
    log.on("click", () => { plots.useLog = !plots.useLog; log.attr("aria-pressed", String(plots.useLog)); plots.draw(); });
  }
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
}

main();
