// SPDX-License-Identifier: Apache-2.0
// The map: pavings, sets of the plane and tubes on a canvas, cell by cell; truth, axes and marks in SVG above it.

class MapView {
  constructor(data, layers, onHover) {
    this.data = data;
    this.layers = layers;  // [{ kind: "inside" | "unknown" | "tube" | "truth", index, name, color, on }, ...]
    this.onHover = onHover;
    this.frame = data.frames.length - 1;
    this.time = null;
    this.box = d3.select("#map");
    this.canvas = this.box.select("canvas").node();
    this.overlay = document.createElement("canvas");
    this.svg = this.box.select("svg");
    this.axisX = this.svg.append("g").attr("class", "axis");
    this.axisY = this.svg.append("g").attr("class", "axis");
    this.marks = this.svg.append("g");
    const paving = layers.filter((layer) => layer.kind === "boundary").map((layer) => lastDomain(data, layer.index))[0];
    this.stretch = paving ? paving.stretch : 1;
    this.axisNames = paving ? [paving.names[0], paving.strip ? "" : paving.names[1]] : null;
    this.world = this.extent();
    this.zoom = d3.zoom().scaleExtent([0.3, 400]).on("zoom", () => this.draw());
    this.svg.call(this.zoom).on("dblclick.zoom", null);
    const surface = this.svg.node();
    surface.addEventListener("pointermove", (event) => this.hover(event));
    surface.addEventListener("pointerleave", () => this.onHover(null));
    surface.addEventListener("dblclick", () => this.fit());
    new ResizeObserver(() => this.draw()).observe(this.box.node());
  }

  fit() { this.svg.transition().duration(250).call(this.zoom.transform, d3.zoomIdentity); }

  // The frame's domain of a layer; null where it is empty.
  domain(layer) { return this.data.frames[this.frame].domains[layer.index]; }

  // What the map frames: of the layers that are on at first, everything bounded of the last frame.
  extent() {
    const xs = [], ys = [];
    const add = (x, y) => { if (Number.isFinite(x) && Number.isFinite(y)) { xs.push(x); ys.push(y); } };
    const addBoxes = (boxes, h) => {
      for (let k = 0; k < boxes.length; k += 4) {
        add(boxes[k] * h, boxes[k + 2] * h);
        add(boxes[k + 1] * h, boxes[k + 3] * h);
      }
    };
    for (const layer of this.layers.filter((each) => each.on)) {
      const domain = lastDomain(this.data, layer.index);
      if (layer.kind === "boundary") {
        addBoxes(domain.reach, 1);
      } else if (layer.kind === "truth") {
        const truth = this.data.truth[layer.name];
        for (let row = 0; row < truth.t.length; ++row) add(truth.at(row, 0), truth.at(row, 1));
      } else if (!domain) {
        continue;
      } else if (layer.kind === "tube") {
        for (let item = 0; item < domain.items; ++item) {
          add(domain.lo(0, item), domain.lo(1, item));
          add(domain.hi(0, item), domain.hi(1, item));
        }
      } else if (layer.kind === "inside" || domain.background === "outside") {
        addBoxes(domain[layer.kind], domain.h);
      }
    }
    const [x0, x1] = xs.length ? d3.extent(xs) : [-1, 1];
    const [y0, y1] = ys.length ? d3.extent(ys) : [-1, 1];
    return { x: (x0 + x1) / 2, y: (y0 + y1) / 2, width: Math.max(x1 - x0, 1e-9), height: Math.max(y1 - y0, 1e-9) };
  }

  // Pixels of the canvas: screen = a * world + b on each axis, alike but for the sign and the stretch of a paving.
  place() {
    const { width, height } = this.box.node().getBoundingClientRect();
    const zoom = d3.zoomTransform(this.svg.node());
    const scale = 0.94 * Math.min(width / this.world.width, height / (this.stretch * this.world.height));
    this.size = { width, height };
    this.a = scale * zoom.k;
    this.bx = zoom.applyX(width / 2 - scale * this.world.x);
    this.by = zoom.applyY(height / 2 + scale * this.stretch * this.world.y);
  }
  toX(x) { return this.a * x + this.bx; }
  toY(y) { return this.by - this.a * this.stretch * y; }
  fromX(px) { return (px - this.bx) / this.a; }
  fromY(py) { return (this.by - py) / (this.a * this.stretch); }

  draw() {
    this.place();
    if (!(this.size.width > 0 && this.size.height > 0)) return;
    this.dpr = Math.min(window.devicePixelRatio || 1, 3);
    for (const canvas of [this.canvas, this.overlay]) {
      canvas.width = Math.round(this.size.width * this.dpr);
      canvas.height = Math.round(this.size.height * this.dpr);
    }
    const context = this.canvas.getContext("2d");
    for (const kind of ["unexplored", "boundary", "unknown", "inside"]) {
      for (const layer of this.layers) if (layer.kind === kind && layer.on) this.drawSet(context, layer);
    }
    for (const layer of this.layers) if (layer.kind === "tube" && layer.on) this.drawTube(context, layer);
    this.drawAxes();
    this.drawTruth();
    this.drawMarks();
  }

  // Whole device pixels, so that cells that touch leave no seam; null where nothing of the box is in sight.
  pixels(x0, x1, y0, y1) {
    const clampX = (px) => Math.min(Math.max(Math.round(px * this.dpr), -4), this.canvas.width + 4);
    const clampY = (py) => Math.min(Math.max(Math.round(py * this.dpr), -4), this.canvas.height + 4);
    const left = clampX(this.toX(x0)), right = clampX(this.toX(x1));
    const top = clampY(this.toY(y1)), bottom = clampY(this.toY(y0));
    const inSight = right >= 0 && left <= this.canvas.width && bottom >= 0 && top <= this.canvas.height;
    return inSight ? [left, top, right - left, bottom - top] : null;
  }

  drawSet(context, layer) {
    const domain = this.domain(layer);
    if (!domain) return;
    context.fillStyle = cssColor(layer.color);
    context.globalAlpha = { inside: 0.55, boundary: domain.projected ? 0.3 : 0.9, unexplored: 0.3, unknown: 0.17 }[layer.kind];
    const boxes = domain[layer.kind], h = domain.h;
    for (let k = 0; k < boxes.length; k += 4) {
      const rect = this.pixels(boxes[k] * h, boxes[k + 1] * h, boxes[k + 2] * h, boxes[k + 3] * h);
      // A boundary is seen from afar.
      if (rect && layer.kind === "boundary") context.fillRect(rect[0], rect[1], Math.max(rect[2], 1), Math.max(rect[3], 1));
      else if (rect && rect[2] && rect[3]) context.fillRect(...rect);
    }
    if (domain.background === layer.kind) {
      const [lo1, hi1, lo2, hi2] = domain.reach.map((cell) => cell * h);
      const far = 1e300;
      for (const side of [[-far, far, hi2, far], [-far, far, -far, lo2], [-far, lo1, lo2, hi2], [hi1, far, lo2, hi2]]) {
        const rect = this.pixels(...side);
        if (rect && rect[2] > 0 && rect[3] > 0) context.fillRect(...rect);
      }
    }
    context.globalAlpha = 1;
  }

  // The union of the boxes of the slices with its outline: all outlines, less the union, plus the union as a tint.
  drawTube(context, layer) {
    const domain = this.domain(layer);
    if (!domain) return;
    const path = new Path2D();
    let last = "";
    for (let item = 1; item < domain.items; item += 2) {
      if (!domain.isBounded(item)) continue;
      const rect = this.pixels(domain.lo(0, item), domain.hi(0, item), domain.lo(1, item), domain.hi(1, item));
      const key = String(rect);
      if (!rect || key === last) continue;
      last = key;
      path.rect(rect[0], rect[1], Math.max(rect[2], 1), Math.max(rect[3], 1));
    }
    const over = this.overlay.getContext("2d");
    over.strokeStyle = over.fillStyle = cssColor(layer.color);
    over.lineWidth = 2.2 * this.dpr;
    over.lineJoin = "round";
    over.stroke(path);
    over.globalCompositeOperation = "destination-out";
    over.fill(path);
    over.globalCompositeOperation = "source-over";
    over.globalAlpha = 0.4;
    over.fill(path);
    over.globalAlpha = 1;
    context.drawImage(this.overlay, 0, 0);
    over.clearRect(0, 0, this.overlay.width, this.overlay.height);
  }

  drawAxes() {
    const { width, height } = this.size;
    const x = d3.scaleLinear([this.fromX(0), this.fromX(width)], [0, width]);
    const y = d3.scaleLinear([this.fromY(height), this.fromY(0)], [height, 0]);
    const keep = (scale, lo, hi) => scale.ticks(7).filter((value) => scale(value) > lo && scale(value) < hi);
    const names = this.layers.filter((layer) => layer.kind === "tube" && layer.on).concat(this.layers);
    const name = names.length ? names[0].name : "";
    const [nameX, nameY] = this.axisNames || [name + "\u2081", name + "\u2082"];
    const room = 16 + 7 * nameX.length;
    this.axisX.attr("transform", `translate(0,${height - 18})`)
      .call(d3.axisBottom(x).tickValues(keep(x, 34, width - room)).tickSize(4).tickPadding(2));
    this.axisY.attr("transform", "translate(26,0)")
      .call(d3.axisLeft(y).tickValues(keep(y, 24, height - 26)).tickSize(4).tickPadding(2));
    if (this.axisNames && !this.axisNames[1]) this.axisY.selectAll("*").remove();
    const label = (axis, text, anchor, dx, dy) => axis.selectAll("text.title").data([text]).join("text")
      .attr("class", "title").attr("x", dx).attr("y", dy).attr("text-anchor", anchor).text((d) => d);
    label(this.axisX, nameX, "end", width - 6, 13);
    label(this.axisY, nameY, "start", -20, 15);
  }

  drawTruth() {
    const paths = this.layers.filter((layer) => layer.kind === "truth" && layer.on).map((layer) => {
      const truth = this.data.truth[layer.name];
      const rows = d3.range(truth.t.length);
      return d3.line().x((row) => this.toX(truth.at(row, 0))).y((row) => this.toY(truth.at(row, 1)))(rows);
    });
    this.svg.selectAll("path.truth").data(paths).join("path").attr("class", "truth").attr("d", (d) => d);
    this.marks.raise();
  }

  // Where the tubes are at the time that the pointer chose.
  drawMarks() {
    const boxes = [], dots = [];
    for (const layer of this.time === null ? [] : this.layers.filter((each) => each.on)) {
      const domain = this.domain(layer);
      if (layer.kind === "tube" && domain) {
        const item = domain.itemAt(this.time);
        if (domain.isBounded(item)) boxes.push([0, 1].map((c) => [domain.lo(c, item), domain.hi(c, item)]));
      } else if (layer.kind === "truth") {
        const at = [0, 1].map((c) => truthAt(this.data.truth[layer.name], this.time, c));
        if (at[0] !== undefined) dots.push(at);
      }
    }
    this.marks.selectAll("rect").data(boxes).join("rect").attr("class", "here")
      .attr("x", ([x]) => this.toX(x[0]) - 3).attr("y", ([, y]) => this.toY(y[1]) - 3)
      .attr("width", ([x]) => this.a * (x[1] - x[0]) + 6).attr("height", ([, y]) => this.a * (y[1] - y[0]) + 6);
    this.marks.selectAll("circle").data(dots).join("circle").attr("class", "here-truth").attr("r", 4.5)
      .attr("cx", ([x]) => this.toX(x)).attr("cy", ([, y]) => this.toY(y));
  }

  showTime(t) {
    this.time = t;
    if (this.size) this.drawMarks();
  }

  // The slice whose box is nearest to a point, if it is within 14 pixels.
  nearest(domain, x, y) {
    let best = null, least = 14 / this.a, middle = Infinity;
    for (let item = 1; item < domain.items; item += 2) {
      const [x0, x1, y0, y1] = [domain.lo(0, item), domain.hi(0, item), domain.lo(1, item), domain.hi(1, item)];
      const distance = Math.hypot(Math.max(x0 - x, 0, x - x1), Math.max(y0 - y, 0, y - y1));
      const toMiddle = Math.hypot((x0 + x1) / 2 - x, (y0 + y1) / 2 - y);
      if (!(distance < least || (distance === least && toMiddle < middle)) || !domain.isBounded(item)) continue;
      [best, least, middle] = [item, distance, toMiddle];
    }
    return best;
  }

  hover(event) {
    const frame = this.svg.node().getBoundingClientRect();
    const x = this.fromX(event.clientX - frame.left), y = this.fromY(event.clientY - frame.top);
    const digits = (scale) => Math.max(0, Math.ceil(Math.log10(scale)));
    const at = [x.toFixed(digits(this.a)), y.toFixed(digits(this.a * this.stretch))];
    const rows = [["", this.axisNames && !this.axisNames[1] ? at[0] : `(${at.join(", ")})`]];
    let time = null;
    const seen = new Set();
    for (const layer of this.layers) {
      const domain = this.domain(layer);
      if (layer.kind === "truth" || !domain || seen.has(layer.index)) continue;
      if (layer.kind !== "tube") {
        seen.add(layer.index);
        rows.push([layer.name, domain.stateAt(x, y)]);
      } else if (layer.on) {
        const item = this.nearest(domain, x, y);
        if (item === null) continue;
        const k = (item - 1) / 2;
        time = (domain.t[k] + domain.t[k + 1]) / 2;
        rows.push(["t", `(${textOfNumber(domain.t[k])}, ${textOfNumber(domain.t[k + 1])})`]);
        for (let c = 0; c < domain.dim; ++c) {
          rows.push([layer.name + subscript(c + 1), textOfBounds(domain.lo(c, item), domain.hi(c, item))]);
        }
      }
    }
    this.onHover({ event, rows, time });
  }
}
