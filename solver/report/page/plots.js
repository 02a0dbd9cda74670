// SPDX-License-Identifier: Apache-2.0
// Tubes against time: the width of each, pass upon pass, and its components with the truth.

class TimePlots {
  constructor(data, tubes, onHover) {
    this.data = data;
    this.onHover = onHover;
    this.frame = data.frames.length - 1;
    this.useLog = false;
    this.time = null;
    const lines = tubes.map((tube) => data.lines[tube.line]);
    this.span = [d3.min(lines, (t) => t[0]), d3.max(lines, (t) => t[t.length - 1])];
    this.domain = this.span;
    this.plots = tubes.flatMap((tube) => this.plotsOf(tube));
    this.useLog = this.plots.some((plot) => plot.component === null && plot.spread > 25);
    const root = d3.select("#plots");
    this.plots.forEach((plot, i) => this.build(plot, root, i));
    new ResizeObserver(() => this.draw()).observe(root.node());
  }

  plotsOf(tube) {
    const truth = this.data.truth[tube.name];
    const frames = this.data.frames.map((frame) => frame.domains[tube.index]);
    const last = lastDomain(this.data, tube.index);
    const isSampled = last.slices > 0 && !d3.range(last.slices).some((k) => last.isBounded(2 * k + 1));
    const first = isSampled ? 0 : 1;  // of the items that are drawn: the gates, or the slices
    const widest = (domain) => {
      let most = 0;
      for (let item = first; item < domain.items; item += 2) if (domain.isBounded(item)) most = Math.max(most, domain.width(item));
      return most;
    };
    const most = d3.max(frames, (domain) => domain ? widest(domain) : 0);
    const width = { tube, truth, first, component: null, title: "width of " + tube.name,
      range: [0, most > 0 ? 1.06 * most : 1], spread: most / (widest(last) || most) };
    // Of a tube that is drawn from phases the slices' widths are how much it moves meanwhile.
    const plots = tube.drawn ? [] : [width];
    const mostComponents = 12;  // as in svg_plots.cpp; the last one that is drawn tells how many there are
    for (let c = 0; c < Math.min(tube.dim, mostComponents); ++c) {
      const more = c + 1 === mostComponents && tube.dim > mostComponents ? " of " + tube.dim : "";
      const title = tube.dim === 1 ? tube.name : tube.name + subscript(c + 1) + more;
      plots.push({ tube, truth, first, component: c, title, range: this.rangeOf(last, truth, c, first) });
    }
    return plots;
  }

  rangeOf(domain, truth, c, first) {
    let lo = Infinity, hi = -Infinity;
    const add = (value) => { if (Number.isFinite(value)) { lo = Math.min(lo, value); hi = Math.max(hi, value); } };
    for (let item = first; item < domain.items; item += 2) { add(domain.lo(c, item)); add(domain.hi(c, item)); }
    for (let row = 0; truth && row < truth.t.length; ++row) add(truth.at(row, c));
    if (!(lo <= hi)) [lo, hi] = [-1, 1];
    const pad = 0.06 * (hi - lo) || 1e-3 * Math.abs(hi) || 1;
    return [lo - pad, hi + pad];
  }

  build(plot, root, i) {
    const svg = root.append("svg").attr("class", "plot").attr("role", "img").attr("aria-label", plot.title);
    plot.svg = svg;
    plot.clip = svg.append("clipPath").attr("id", "clip-" + i).append("rect");
    plot.grid = svg.append("g").attr("class", "grid");
    plot.axisX = svg.append("g").attr("class", "axis");
    plot.axisY = svg.append("g").attr("class", "axis");
    plot.body = svg.append("g").attr("clip-path", `url(#clip-${i})`);
    plot.rule = svg.append("line").attr("class", "rule");
    svg.append("text").attr("class", "title").attr("x", 46).attr("y", 11).text(plot.title);
    plot.key = svg.append("text").attr("y", 11).attr("text-anchor", "end");
    plot.brush = d3.brushX().touchable(false).on("end", (a) => this.brushed(plot, d3.event || a));
    plot.surface = svg.append("g").attr("class", "brush");
    const node = svg.node();
    node.addEventListener("pointermove", (event) => this.hover(plot, event));
    node.addEventListener("pointerleave", () => this.onHover(null));
    node.addEventListener("dblclick", () => { this.domain = this.span; this.draw(); });
  }

  brushed(plot, event) {
    if (!event.selection) return;
    const [t0, t1] = event.selection.map(plot.x.invert);
    plot.surface.call(plot.brush.move, null);
    if (event.selection[1] - event.selection[0] > 4) this.domain = [t0, t1];
    this.draw();
  }

  draw() {
    const root = d3.select("#plots").node();
    const width = root.clientWidth;
    if (!(width > 0)) return;
    const isNarrow = window.matchMedia("(max-width: 860px)").matches;
    const map = document.getElementById("map").clientHeight;
    const height = isNarrow || !map ? 170 : Math.max(130, (map + 22) / this.plots.length);
    for (const plot of this.plots) this.drawPlot(plot, width, height, plot === this.plots[this.plots.length - 1]);
    this.showTime(this.time);
  }

  drawPlot(plot, width, height, isLast) {
    const margin = { left: 46, right: 14, top: 18, bottom: isLast ? 20 : 9 };
    plot.margin = margin;
    plot.height = height;
    plot.svg.attr("viewBox", `0 0 ${width} ${height}`).style("height", height + "px");
    plot.clip.attr("x", margin.left).attr("y", margin.top)
      .attr("width", Math.max(width - margin.left - margin.right, 0)).attr("height", height - margin.top - margin.bottom);
    const isLog = plot.component === null && this.useLog;
    const range = isLog ? [this.leastWidth(plot), plot.range[1]] : plot.range;
    plot.x = d3.scaleLinear(this.domain, [margin.left, width - margin.right]);
    plot.y = (isLog ? d3.scaleLog() : d3.scaleLinear()).domain(range).range([height - margin.bottom, margin.top]);
    const rows = Math.max(2, Math.floor(height / 34));
    const axisY = d3.axisLeft(plot.y).tickSizeOuter(0);
    isLog ? axisY.ticks(rows, "~g").tickSize(4) : axisY.ticks(rows).tickSize(4);
    plot.grid.attr("transform", `translate(${margin.left},0)`)
      .call(d3.axisLeft(plot.y).ticks(rows).tickSize(margin.left + margin.right - width).tickFormat(""));
    plot.axisX.attr("transform", `translate(0,${height - margin.bottom})`)
      .call(d3.axisBottom(plot.x).ticks(Math.max(3, width / 80)).tickSize(4).tickSizeOuter(0)
        .tickFormat(isLast ? null : () => ""));
    plot.axisX.selectAll("text.title").data(isLast ? ["t"] : []).join("text").attr("class", "title")
      .attr("x", 30).attr("y", 14).text((d) => d);
    plot.axisY.attr("transform", `translate(${margin.left},0)`).call(axisY);
    plot.brush.extent([[margin.left, margin.top], [width - margin.right, height - margin.bottom]]);
    plot.surface.call(plot.brush);
    plot.key.attr("x", width - margin.right);
    plot.component === null ? this.drawWidths(plot) : this.drawComponent(plot);
    this.drawBlame(plot);
  }

  leastWidth(plot) {
    const domain = lastDomain(this.data, plot.tube.index);
    let least = plot.range[1] / 10;
    for (let item = plot.first; item < domain.items; item += 2) {
      const width = domain.width(item);
      if (width > 0) least = Math.min(least, width);
    }
    return Math.max(0.7 * least, 1e-9 * plot.range[1]);
  }

  // What is in sight, pixel column by pixel column: [x0, x1, lo, hi], with the hull of all items that share one.
  columns(plot, domain, lo, hi) {
    const columns = [];
    const [t0, t1] = plot.x.domain();
    for (let item = plot.first; item < domain.items; item += 2) {
      const k = item >> 1;
      const from = domain.t[k], to = domain.t[k + (plot.first ? 1 : 0)];
      if (to < t0 || from > t1) continue;
      const x0 = plot.x(from), x1 = plot.x(to);
      const last = columns[columns.length - 1];
      if (last && x1 - last[0] < 0.8) {
        last[1] = x1;
        last[2] = Math.min(last[2], lo(item));
        last[3] = Math.max(last[3], hi(item));
      } else {
        columns.push([x0, x1, lo(item), hi(item)]);
      }
    }
    return columns;
  }

  // Steps along the columns' upper values; broken where one is infinite. Bars instead for a tube known at gates.
  stepPath(plot, domain) {
    const value = (item) => domain.width(item);
    const floor = plot.y.domain()[0];
    let path = "", isOpen = false;
    for (const [x0, x1, , hi] of this.columns(plot, domain, value, value)) {
      if (!Number.isFinite(hi)) { isOpen = false; continue; }
      const y = plot.y(Math.max(hi, floor)).toFixed(2);
      path += plot.first ? `${isOpen ? "L" : "M"}${x0.toFixed(2)},${y}H${x1.toFixed(2)}`
        : `M${(x0 - 0.7).toFixed(2)},${y}h1.4`;
      isOpen = plot.first === 1;
    }
    return path;
  }

  bandPath(plot, domain, c) {
    const [y0, y1] = [plot.height + 9, -9];
    const y = (value) => Math.min(Math.max(plot.y(value), y1), y0).toFixed(2);
    const columns = this.columns(plot, domain, (item) => domain.lo(c, item), (item) => domain.hi(c, item))
      .map(([x0, x1, lo, hi]) => [x0.toFixed(2), x1.toFixed(2), lo === -Infinity ? y0 : y(lo), hi === Infinity ? y1 : y(hi)]);
    if (!plot.first) {
      return columns.filter(([, , lo, hi]) => lo !== y0 || hi !== y1)
        .map(([x0, , lo, hi]) => `M${x0},${lo}V${hi}`).join("");
    }
    const there = columns.map(([x0, x1, , hi]) => `${x0},${hi}H${x1}`);
    const back = columns.reverse().map(([x0, x1, lo]) => `${x1},${lo}H${x0}`);
    return there.length ? "M" + there.concat(back).join("L") + "Z" : "";
  }

  // Every pass thin, the chosen one strong, and how far the truth is from the middle.
  drawWidths(plot) {
    const color = plot.tube.color;
    const isNarrow = plot.x.range()[1] < 420;
    const frames = this.data.frames.map((frame) => frame.domains[plot.tube.index]);
    const now = frames[this.frame];
    const past = frames.filter((domain) => domain && domain !== now).map((domain) => this.stepPath(plot, domain));
    plot.body.selectAll("path.past").data(past).join("path").attr("class", "past").attr("d", (d) => d);
    plot.body.selectAll("path.error").data(now && plot.truth ? [this.errorPath(plot, now)] : []).join("path")
      .attr("class", "error").attr("d", (d) => d);
    plot.body.selectAll("path.now").data(now ? [this.stepPath(plot, now)] : []).join("path").attr("class", "now")
      .style("stroke", `var(${color})`).attr("d", (d) => d);
    plot.key.selectAll("tspan").data([
      isNarrow ? null : { text: "\u2014 this pass", color: `var(${color})` },
      past.length ? { text: "\u2002\u2014 other passes", color: "var(--faint)" } : null,
      plot.truth ? { text: "\u2002\u2014 truth to middle", color: "var(--truth)" } : null].filter((d) => d)).join("tspan")
      .style("fill", (d) => d.color).text((d) => d.text);
  }

  errorPath(plot, domain) {
    const error = (item) => {
      const t = domain.t[item >> 1];
      let most = -Infinity;
      for (let c = 0; c < domain.dim; ++c) {
        const at = truthAt(plot.truth, t, c);
        if (at === undefined) return NaN;
        most = Math.max(most, Math.abs(at - (domain.lo(c, item) + domain.hi(c, item)) / 2));
      }
      return most;
    };
    const floor = plot.y.domain()[0];
    return d3.line().x((k) => plot.x(domain.t[k])).y((k) => plot.y(Math.max(error(2 * k), floor)))
      .defined((k) => Number.isFinite(error(2 * k)))(this.rowsInSight(plot, domain.t));
  }

  // Indices of instants, two to a pixel at most.
  rowsInSight(plot, t) {
    const [t0, t1] = plot.x.domain();
    const from = Math.max(d3.bisectLeft(t, t0) - 1, 0), to = Math.min(d3.bisectRight(t, t1) + 1, t.length);
    const step = Math.max(1, Math.floor((to - from) / (2 * (plot.x.range()[1] - plot.x.range()[0]))));
    return d3.range(from, to, step);
  }

  drawComponent(plot) {
    const c = plot.component;
    const domain = this.data.frames[this.frame].domains[plot.tube.index];
    const color = `var(${plot.tube.color})`;
    plot.body.selectAll("path.band").data(domain ? [this.bandPath(plot, domain, c)] : []).join("path")
      .attr("class", "band").style("fill", color).style("stroke", color)
      .style("stroke-width", plot.first ? null : 1.6).attr("d", (d) => d);
    const truth = plot.truth ? [d3.line().x((k) => plot.x(plot.truth.t[k])).y((k) => plot.y(plot.truth.at(k, c)))(
      this.rowsInSight(plot, plot.truth.t))] : [];
    plot.body.selectAll("path.truth").data(truth).join("path").attr("class", "truth").attr("d", (d) => d);
    plot.key.selectAll("tspan").data(plot.truth ? ["\u2014 truth"] : []).join("tspan")
      .style("fill", "var(--truth)").text((d) => d);
  }

  // When the contradiction arose, and the readings that it takes.
  drawBlame(plot) {
    const why = this.data.explanation;
    const spans = why && why.time ? [why.time] : [];
    const bottom = plot.height - plot.margin.bottom;
    plot.body.selectAll("rect.blame").data(spans).join("rect").attr("class", "blame")
      .attr("x", (d) => plot.x(d[0]) - 1).attr("width", (d) => Math.max(plot.x(d[1]) - plot.x(d[0]), 1) + 2)
      .attr("y", plot.margin.top).attr("height", bottom - plot.margin.top);
    plot.body.selectAll("line.reading").data(why ? why.readings : []).join("line").attr("class", "reading")
      .attr("x1", (d) => plot.x(d[1])).attr("x2", (d) => plot.x(d[1])).attr("y1", bottom - 9).attr("y2", bottom);
  }

  showTime(t) {
    this.time = t;
    for (const plot of this.plots) {
      if (!plot.x) continue;
      const isShown = t !== null && t >= this.domain[0] && t <= this.domain[1];
      plot.rule.style("display", isShown ? null : "none");
      if (isShown) plot.rule.attr("x1", plot.x(t)).attr("x2", plot.x(t)).attr("y1", plot.margin.top)
        .attr("y2", plot.height - plot.margin.bottom);
    }
  }

  hover(plot, event) {
    const frame = plot.svg.node().getBoundingClientRect();
    const t = plot.x.invert(event.clientX - frame.left);
    if (t < this.span[0] || t > this.span[1]) return this.onHover(null);
    const domain = this.data.frames[this.frame].domains[plot.tube.index];
    const rows = [["t", textOfNumber(t)]];
    if (domain) {
      const item = domain.itemAt(t) + (plot.first ? 0 : t - domain.t[domain.itemAt(t) >> 1] <
        domain.t[(domain.itemAt(t) >> 1) + 1] - t ? -1 : 1);
      for (let c = 0; c < domain.dim; ++c) {
        const name = domain.dim === 1 ? plot.tube.name : plot.tube.name + subscript(c + 1);
        const truth = plot.truth ? truthAt(plot.truth, t, c) : undefined;
        rows.push([name, textOfBounds(domain.lo(c, item), domain.hi(c, item)) +
          (truth === undefined ? "" : "  true " + textOfNumber(truth))]);
      }
      rows.push(["width", textOfNumber(domain.width(item))]);
    }
    this.onHover({ event, rows, time: t });
  }
}
