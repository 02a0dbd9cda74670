// SPDX-License-Identifier: Apache-2.0
// The data of the page, decoded: what page_data.h documents, with typed arrays for base64 text.

const number = (value) => value === "oo" ? Infinity : value === "-oo" ? -Infinity : value;

function bytes(base64) {
  const text = atob(base64);
  const array = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) array[i] = text.charCodeAt(i);
  return array.buffer;
}

// A tube's domain: lo(c, item), hi(c, item), items in the order of time, gates even and slices odd.
class TubeDomain {
  constructor(base64, variable, line) {
    const buffer = bytes(base64);
    this.values = variable.wide ? new Float64Array(buffer) : new Float32Array(buffer);
    this.dim = variable.dim;
    this.t = line;
    this.items = 2 * line.length - 1;
    this.slices = line.length - 1;
  }
  lo(c, item) { return this.values[2 * c * this.items + item]; }
  hi(c, item) { return this.values[(2 * c + 1) * this.items + item]; }
  width(item) {
    let widest = 0;
    for (let c = 0; c < this.dim; ++c) widest = Math.max(widest, this.hi(c, item) - this.lo(c, item));
    return widest;
  }
  isBounded(item) { return this.width(item) < Infinity; }
  // The slice that an instant is in: its item.
  itemAt(t) {
    const k = d3.bisectRight(this.t, t) - 1;
    return 2 * Math.min(Math.max(k, 0), this.slices - 1) + 1;
  }
  meanWidth() {
    let sum = 0;
    for (let item = 1; item < this.items; item += 2) sum += this.width(item);
    return sum / this.slices;
  }
  maxWidth() {
    let widest = 0;
    for (let item = 1; item < this.items; item += 2) widest = Math.max(widest, this.width(item));
    return widest;
  }
}

// A set's domain. In the plane: boxes of cells lo1 hi1 lo2 hi2, four numbers each.
class SetDomain {
  constructor(data, variable) {
    this.h = variable.precision;
    this.volume = data.volume.map(number);
    this.background = data.background;
    if (variable.dim !== 2) return;
    this.reach = data.reach;
    this.inside = SetDomain.boxes(data.inside);
    this.unknown = SetDomain.boxes(data.unknown);
  }
  static boxes(coded) {
    const buffer = bytes(coded.boxes);
    return coded.wide ? new Int32Array(buffer) : new Int16Array(buffer);
  }
  static holds(boxes, i, j) {
    for (let k = 0; k < boxes.length; k += 4) {
      if (boxes[k] <= i && i < boxes[k + 1] && boxes[k + 2] <= j && j < boxes[k + 3]) return true;
    }
    return false;
  }
  stateAt(x, y) {
    const i = Math.floor(x / this.h), j = Math.floor(y / this.h);
    if (SetDomain.holds(this.inside, i, j)) return "inside";
    if (SetDomain.holds(this.unknown, i, j)) return "unknown";
    const [lo1, hi1, lo2, hi2] = this.reach;
    return lo1 <= i && i < hi1 && lo2 <= j && j < hi2 ? "outside" : this.background;
  }
}

// A paving, as the map shows sets: rectangles lo1 hi1 lo2 hi2; `unknown` are those of the boundary.
class PavingDomain {
  constructor(data) {
    Object.assign(this, data);
    this.h = 1;
    this.background = "outside";
    this.volume = data.volume.map(number);
    for (const kind of ["inside", "boundary", "unexplored"]) this[kind] = new Float64Array(bytes(data[kind]));
  }
  static holds(boxes, x, y) {
    for (let k = 0; k < boxes.length; k += 4) {
      if (boxes[k] <= x && x <= boxes[k + 1] && boxes[k + 2] <= y && y <= boxes[k + 3]) return true;
    }
    return false;
  }
  stateAt(x, y) {
    const kinds = ["inside", "boundary", "unexplored"].filter((kind) => PavingDomain.holds(this[kind], x, y));
    if (kinds.length) return this.projected ? "some " + kinds.join(" and ") : kinds[0];
    const [lo1, hi1, lo2, hi2] = this.reach;
    return lo1 <= x && x <= hi1 && lo2 <= y && y <= hi2 ? "outside" : "beyond the domain";
  }
}

function decodeDomain(coded, variable, lines) {
  if (variable.kind === "tube") return new TubeDomain(coded, variable, lines[variable.line]);
  if (variable.kind === "set") return new SetDomain(coded, variable);
  return coded.map((pair) => pair.map(number));
}

function decodeTruth(coded) {
  if (!coded) return null;
  const t = new Float64Array(bytes(coded.t));
  const tubes = {};
  for (const name of Object.keys(coded.tubes)) {
    const values = new Float64Array(bytes(coded.tubes[name]));
    const dim = t.length ? values.length / t.length : 0;
    tubes[name] = { t, dim, at: (row, c) => values[row * dim + c] };
  }
  return tubes;
}

// { model, status, ..., variables: [{ name, kind, ..., index }], frames: [{ pass, domains: [...] }], truth }
function decode(data) {
  const lines = data.lines.map((line) => new Float64Array(bytes(line)));
  const frames = [];
  for (const frame of data.frames) {
    const before = frames[frames.length - 1];
    frames.push({ pass: frame.pass, domains: frame.domains.map((coded, i) => {
      if (coded === null) return null;
      return coded === 0 ? before.domains[i] : decodeDomain(coded, data.variables[i], lines);
    }) });
  }
  const variables = data.variables.map((variable, index) => Object.assign({}, variable, { index }));
  if (data.paving) {
    const dim = data.paving.names.length, name = dim === 1 ? data.paving.names[0] : "(" + data.paving.names.join(", ") + ")";
    variables.push({ name, kind: "paving", dim, index: variables.length });
    const domain = new PavingDomain(data.paving);
    for (const frame of frames) frame.domains.push(domain);
  }
  const truth = decodeTruth(data.truth) || {};
  return Object.assign({}, data, { lines, frames, variables, truth });
}

// The true value of component c at an instant, on the line between its rows; undefined beyond them.
function truthAt(truth, t, c) {
  const k = d3.bisectRight(truth.t, t) - 1;
  if (k < 0 || t > truth.t[truth.t.length - 1]) return undefined;
  if (k + 1 >= truth.t.length) return truth.at(k, c);
  const part = (t - truth.t[k]) / (truth.t[k + 1] - truth.t[k]);
  return truth.at(k, c) + part * (truth.at(k + 1, c) - truth.at(k, c));
}

// Text for people. Bounds are rounded outward, to a hundredth of the width.
function textOfNumber(value) {
  if (value === Infinity) return "\u221e";
  if (value === -Infinity) return "-\u221e";
  return Math.abs(value) >= 1e5 || (value !== 0 && Math.abs(value) < 1e-4)
    ? value.toExponential(3) : String(Number(value.toPrecision(5)));
}
function textOfBounds(lo, hi) {
  if (lo === hi) return textOfNumber(lo);
  const width = hi - lo;
  const digits = width < Infinity ? Math.min(Math.max(2 - Math.floor(Math.log10(width)), 0), 15) : 3;
  const scale = Math.pow(10, digits);
  const outward = (bound, round) => Number.isFinite(bound)
    ? (round(bound * scale) / scale).toFixed(digits) : textOfNumber(bound);
  return "[" + outward(lo, Math.floor) + ", " + outward(hi, Math.ceil) + "]";
}
function textOfSeconds(seconds) {
  if (seconds < 1e-3) return textOfNumber(Number((seconds * 1e6).toPrecision(3))) + " \u00b5s";
  if (seconds < 1) return Number((seconds * 1e3).toPrecision(3)) + " ms";
  return Number(seconds.toPrecision(4)) + " s";
}
const subscript = (n) => String(n).replace(/\d/g, (d) => String.fromCharCode(0x2080 + Number(d)));
