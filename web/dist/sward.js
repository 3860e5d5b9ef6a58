// Built from web/src by `npm run build`; do not edit.
// Sward, MIT licence. Contains fzstd, MIT licence, copyright (c) 2020 Arjun Barrett.
var __defProp = Object.defineProperty;
var __export = (target, all) => {
  for (var name in all)
    __defProp(target, name, { get: all[name], enumerable: true });
};

// src/format/error.ts
var SwardError = class extends Error {
  kind;
  constructor(kind, message) {
    super(message);
    this.name = "SwardError";
    this.kind = kind;
  }
};
function fail(kind, message) {
  throw new SwardError(kind, message);
}

// src/format/patches.ts
var patchWord = {
  boundsLow: 0,
  firstBlade: 3,
  boundsHigh: 4,
  bladeCount: 7,
  rootLow: 8,
  rootStep: 11,
  coneAxis: 12,
  coneCosine: 15,
  heightLow: 16,
  heightStep: 17,
  widthLow: 18,
  widthStep: 19,
  parent: 20,
  firstChild: 21,
  childCount: 22,
  level: 23,
  rankLow: 24,
  rankHigh: 25
};
var patchWords = 26;
var noPatch = 4294967295;
var maxPatchBlades = 512;
var Patches = class {
  floats;
  words;
  count;
  /** `bytes`: the chunk PATCHES, at a multiple of 4 in its buffer. */
  constructor(bytes) {
    this.count = bytes.length / (4 * patchWords);
    this.floats = new Float32Array(bytes.buffer, bytes.byteOffset, this.count * patchWords);
    this.words = new Uint32Array(bytes.buffer, bytes.byteOffset, this.count * patchWords);
  }
  firstBlade(patch) {
    return this.words[patch * patchWords + patchWord.firstBlade];
  }
  bladeCount(patch) {
    return this.words[patch * patchWords + patchWord.bladeCount];
  }
  firstChild(patch) {
    return this.words[patch * patchWords + patchWord.firstChild];
  }
  childCount(patch) {
    return this.words[patch * patchWords + patchWord.childCount];
  }
  parent(patch) {
    return this.words[patch * patchWords + patchWord.parent];
  }
  /** The patch that owns a blade. */
  patchOf(blade) {
    let low = 0;
    let high = this.count - 1;
    while (low < high) {
      const middle = low + high + 1 >> 1;
      if (this.firstBlade(middle) <= blade) low = middle;
      else high = middle - 1;
    }
    return low;
  }
  /** Checks what docs/field_format.md says of the tree and of its numbers. */
  verify(blades, place) {
    let nextBlade = 0;
    let nextChild = 1;
    const w = this.words;
    for (let p = 0; p < this.count; ++p) {
      const at = p * patchWords;
      this.verifyNumbers(p, place);
      if (this.firstBlade(p) !== nextBlade)
        fail("input", `${place}: patch ${p} begins at blade ${this.firstBlade(p)} instead of ${nextBlade}`);
      nextBlade += this.bladeCount(p);
      const parent = this.parent(p);
      const level = w[at + patchWord.level];
      if (p === 0 ? parent !== noPatch || level !== 0 : parent >= p)
        fail("input", `${place}: patch ${p} has the parent ${parent}`);
      const children = this.childCount(p);
      if (children > 8) fail("input", `${place}: patch ${p} has ${children} children, more than 8`);
      if (this.firstChild(p) !== (children === 0 ? noPatch : nextChild))
        fail("input", `${place}: patch ${p} has its children at ${this.firstChild(p)}`);
      nextChild += children;
      if (p === 0) continue;
      const first = this.firstChild(parent);
      if (p < first || p - first >= this.childCount(parent))
        fail("input", `${place}: patch ${p} is not a child of its parent ${parent}`);
      if (level !== w[parent * patchWords + patchWord.level] + 1)
        fail("input", `${place}: patch ${p} has level ${level}`);
    }
    if (nextBlade !== blades)
      fail("input", `${place}: the patches own ${nextBlade} blades, of ${blades} that there are`);
    if (this.count > 0 && nextChild !== this.count)
      fail("input", `${place}: ${nextChild} patches are reached from the root, of ${this.count} that there are`);
  }
  verifyNumbers(p, place) {
    const at = p * patchWords;
    const f = this.floats;
    const isFinite3 = (word) => Number.isFinite(f[at + word]) && Number.isFinite(f[at + word + 1]) && Number.isFinite(f[at + word + 2]);
    const { boundsLow, boundsHigh, coneAxis } = patchWord;
    if (!isFinite3(boundsLow) || !isFinite3(boundsHigh) || [0, 1, 2].some((axis2) => f[at + boundsLow + axis2] > f[at + boundsHigh + axis2]))
      fail("input", `${place}: patch ${p} has no valid bounds`);
    for (const key of ["rootStep", "heightLow", "heightStep", "widthLow", "widthStep"]) {
      const step = f[at + patchWord[key]];
      if (!Number.isFinite(step) || step < 0)
        fail("input", `${place}: patch ${p} has the quantisation step ${step}`);
    }
    if (!isFinite3(patchWord.rootLow))
      fail("input", `${place}: patch ${p} has a root that is not finite`);
    const axis = Math.hypot(f[at + coneAxis], f[at + coneAxis + 1], f[at + coneAxis + 2]);
    const cosine = f[at + patchWord.coneCosine];
    if (!(Math.abs(axis - 1) <= 1e-3) || !(cosine >= -1 && cosine <= 1))
      fail("input", `${place}: patch ${p} has no valid normal cone`);
    const low = f[at + patchWord.rankLow];
    const high = f[at + patchWord.rankHigh];
    if (!(low >= 0 && low <= high && high <= 1))
      fail("input", `${place}: patch ${p} has ranks ${low} to ${high}, outside 0 to 1`);
    if (this.bladeCount(p) > maxPatchBlades)
      fail("input", `${place}: patch ${p} owns ${this.bladeCount(p)} blades, more than ${maxPatchBlades}`);
  }
};

// src/format/settings.ts
var longestShown = 80;
function shown(value) {
  const text = JSON.stringify(value) ?? "nothing";
  return text.length <= longestShown ? text : `${text.slice(0, longestShown)}…`;
}
var SettingsReader = class _SettingsReader {
  constructor(value, place) {
    this.place = place;
    if (typeof value !== "object" || value === null || Array.isArray(value))
      fail("input", `${place}: expected an object {…}, found ${shown(value)}`);
    this.object = value;
  }
  place;
  object;
  known = /* @__PURE__ */ new Set();
  /** The value of a key, undefined if it is absent. */
  value(key) {
    this.known.add(key);
    return Object.hasOwn(this.object, key) ? this.object[key] : void 0;
  }
  placeOf(key) {
    return `${this.place}.${key}`;
  }
  number(key, usual, low, high) {
    const value = this.value(key);
    return value === void 0 ? usual : this.checked(value, key, low, high);
  }
  vector(key, usual, low, high) {
    const value = this.value(key);
    if (value === void 0) return usual;
    if (!Array.isArray(value) || value.length !== usual.length)
      fail("input", `${this.placeOf(key)}: expected an array of ${usual.length} numbers, found ${shown(value)}`);
    return value.map((one) => this.checked(one, key, low, high));
  }
  /** A range of two numbers, or one number for both. */
  range(key, usual, low, high) {
    const value = this.value(key);
    if (typeof value !== "number") return this.vector(key, usual, low, high);
    const one = this.checked(value, key, low, high);
    return [one, one];
  }
  text(key, usual) {
    const value = this.value(key);
    if (value === void 0) return usual;
    if (typeof value !== "string")
      fail("input", `${this.placeOf(key)}: expected a text, found ${shown(value)}`);
    return value;
  }
  /** The place of a word among `words`. */
  word(key, words, usual) {
    const value = this.value(key);
    if (value === void 0) return usual;
    const found = words.indexOf(value);
    if (found < 0)
      fail("input", `${this.placeOf(key)}: ${shown(value)} is none of ${words.join(", ")}`);
    return found;
  }
  array(key) {
    const value = this.value(key);
    if (!Array.isArray(value))
      fail("input", `${this.placeOf(key)}: expected an array, found ${shown(value)}`);
    return value;
  }
  child(key) {
    return new _SettingsReader(this.value(key), this.placeOf(key));
  }
  /** Refuses keys that were not read. */
  finish() {
    for (const key of Object.keys(this.object))
      if (!this.known.has(key)) fail("input", `${this.place}: unknown key "${key}"`);
  }
  checked(value, key, low, high) {
    if (typeof value !== "number")
      fail("input", `${this.placeOf(key)}: expected a number, found ${shown(value)}`);
    if (!(value >= low && value <= high))
      fail("input", `${this.placeOf(key)}: ${value} is outside [${low}, ${high}]`);
    return value;
  }
};
function parseJson(text, place) {
  try {
    return JSON.parse(text);
  } catch {
    fail("input", `${place}: not valid JSON`);
  }
}

// src/format/texts.ts
var shapeNames = ["triangle-tip", "quad", "triangle", "quadratic", "dandelion", "leaf"];
var shapeStalkLeaf = 6;
var maxSpecies = 8;
var maxOrganKinds = 32;
var maxRibbons = 63;
var black = [0, 0, 0];
var farthest = 1e12;
function readLook(reader, usual) {
  const unit2 = (key, value, high = 1) => reader.number(key, value, 0, high);
  return {
    rootColor: reader.vector("root_color", usual.rootColor, 0, 1),
    tipColor: reader.vector("tip_color", usual.tipColor, 0, 1),
    tipThreshold: unit2("tip_threshold", usual.tipThreshold, 0.99),
    groundTint: unit2("ground_tint", usual.groundTint),
    colorVariation: unit2("color_variation", usual.colorVariation),
    translucency: unit2("translucency", usual.translucency),
    gloss: unit2("gloss", usual.gloss),
    dryness: unit2("dryness", usual.dryness),
    shape: reader.word("shape", shapeNames, usual.shape),
    fold: unit2("fold", usual.fold)
  };
}
var plainLook = {
  rootColor: black,
  tipColor: black,
  tipThreshold: 0,
  groundTint: 0,
  colorVariation: 0,
  translucency: 0,
  gloss: 0,
  dryness: 0,
  shape: 0,
  fold: 0
};
var organLook = {
  ...plainLook,
  rootColor: [0.05, 0.09, 0.02],
  tipColor: [0.2, 0.3, 0.06],
  tipThreshold: 0.5,
  colorVariation: 0.15,
  translucency: 0.4,
  gloss: 0.2,
  shape: shapeNames.indexOf("leaf")
};
function readOrgan(value, place) {
  const reader = new SettingsReader(value, place);
  const count = reader.number("count", 1, 1, maxRibbons);
  if (!Number.isInteger(count)) fail("input", `${place}.count: ${count} is not a whole number`);
  const look = readLook(reader, organLook);
  if (look.shape === 0) look.shape = shapeStalkLeaf;
  const organ = {
    ...look,
    name: reader.text("name", ""),
    count,
    place: reader.range("place", [1, 1], 0, 1),
    pitch: reader.range("pitch_deg", [60, 60], 0, 180),
    length: reader.range("length", [0.2, 0.2], 1e-4, 1),
    width: reader.number("width", 0.3, 1e-4, 2),
    azimuth: reader.number("azimuth_deg", 0, -360, 360),
    turn: reader.number("turn_deg", 137.508, -360, 360),
    bend: reader.number("bend_deg", 20, -180, 180),
    variation: reader.number("variation", 0.2, 0, 1)
  };
  reader.finish();
  return organ;
}
function ribbonsOf(organs) {
  return organs.reduce((sum, organ) => sum + organ.count, 0);
}
function parseSpecies(text, place) {
  const list = parseJson(text, place);
  if (!Array.isArray(list) || list.length === 0 || list.length > maxSpecies)
    fail("input", `${place}: expected an array of 1 to ${maxSpecies} species`);
  const species = list.map((entry, i) => {
    const at = `${place}[${i}]`;
    const reader = new SettingsReader(entry, at);
    const name = reader.text("name", "");
    const look = readLook(reader, plainLook);
    const organs = reader.value("organs") === void 0 ? [] : reader.array("organs").map((one, k) => readOrgan(one, `${at}.organs[${k}]`));
    reader.finish();
    if (ribbonsOf(organs) > maxRibbons)
      fail("input", `${at}.organs: ${ribbonsOf(organs)} ribbons on a stalk, more than ${maxRibbons}`);
    return { ...look, name, organs };
  });
  const kinds2 = species.reduce((sum, one) => sum + one.organs.length, 0);
  if (kinds2 > maxOrganKinds)
    fail("input", `${place}: ${kinds2} organs of all species, more than ${maxOrganKinds}`);
  return species;
}
function requireUnit(v, place) {
  if (Math.abs(Math.hypot(...v) - 1) > 1e-3)
    fail("input", `${place}: (${v.join(", ")}) is not a unit vector`);
}
function parseDefaults(text, place) {
  const reader = new SettingsReader(parseJson(text, place), place);
  const wind = reader.child("wind");
  const gravity = reader.child("gravity");
  const defaults = {
    wind: {
      direction: wind.vector("direction", [0.8, 0, 0.6], -1, 1),
      strength: wind.number("strength", 3, 0, 1e3),
      waveLength: wind.number("wave_length", 7, 1e-6, 1e9),
      speed: wind.number("speed", 2.6, -1e6, 1e6),
      gustSize: wind.number("gust_size", 3.5, 1e-6, 1e9),
      gustiness: wind.number("gustiness", 0.6, 0, 1)
    },
    gravity: {
      direction: gravity.vector("direction", [0, -1, 0], -1, 1),
      attractor: gravity.vector("attractor", [0, 0, 0], -farthest, farthest),
      strength: gravity.number("strength", 6.5, 0, 1e3),
      blend: gravity.number("blend", 0, 0, 1)
    },
    recovery: reader.number("recovery", 6, 1e-3, 1e3),
    drawDistance: reader.number("draw_distance", 1e9, 0, 1e30),
    copyright: reader.text("copyright", ""),
    cameras: reader.array("cameras").map((entry, i) => {
      const one = new SettingsReader(entry, `${place}.cameras[${i}]`);
      const camera = {
        name: one.text("name", "camera"),
        eye: one.vector("eye", [0, 0, 0], -farthest, farthest),
        target: one.vector("target", [0, 0, 0], -farthest, farthest),
        up: one.vector("up", [0, 1, 0], -1, 1),
        fovYDeg: one.number("fov_y_deg", 45, 0.1, 170)
      };
      one.finish();
      return camera;
    })
  };
  wind.finish();
  gravity.finish();
  reader.finish();
  requireUnit(defaults.wind.direction, wind.placeOf("direction"));
  requireUnit(defaults.gravity.direction, gravity.placeOf("direction"));
  return defaults;
}
function parseCover(text, place) {
  if (text === void 0 || text === "") return 1;
  return new SettingsReader(parseJson(text, place), place).number("thinned", 1, 1, 1e9);
}

// src/format/blades.ts
var bladeWords = 4;
var twoPi = Math.fround(6.283185307179586);
function unpackBlades(packed, patches, first, count) {
  const blades = {
    first,
    count,
    root: new Float32Array(3 * count),
    up: new Float32Array(3 * count),
    facing: new Float32Array(count),
    height: new Float32Array(count),
    width: new Float32Array(count),
    stiffness: new Float32Array(count),
    species: new Uint8Array(count),
    exposure: new Float32Array(count),
    tint: new Float32Array(3 * count),
    clump: new Uint8Array(count),
    hash: new Uint8Array(count),
    patch: new Uint32Array(count)
  };
  const single = Math.fround;
  const f = patches.floats;
  let patch = count > 0 ? patches.patchOf(first) : 0;
  for (let i = 0; i < count; ++i) {
    const blade = first + i;
    while (blade >= patches.firstBlade(patch) + patches.bladeCount(patch)) ++patch;
    const at = patch * patchWords;
    const rootXY = packed[bladeWords * blade];
    const rootZUp = packed[bladeWords * blade + 1];
    const shape = packed[bladeWords * blade + 2];
    const look = packed[bladeWords * blade + 3];
    const step = f[at + patchWord.rootStep];
    const places2 = [rootXY & 65535, rootXY >>> 16, rootZUp & 65535];
    for (let axis = 0; axis < 3; ++axis)
      blades.root[3 * i + axis] = f[at + patchWord.rootLow + axis] + single(step * places2[axis]);
    unfoldUp(rootZUp >>> 16, blades.up, 3 * i);
    blades.facing[i] = (shape & 255) * single(twoPi / 256);
    blades.height[i] = f[at + patchWord.heightLow] + single(f[at + patchWord.heightStep] * (shape >>> 8 & 255));
    blades.width[i] = f[at + patchWord.widthLow] + single(f[at + patchWord.widthStep] * (shape >>> 16 & 63));
    blades.stiffness[i] = (shape >>> 22 & 63) / 63;
    blades.hash[i] = shape >>> 28;
    blades.tint[3 * i] = (look & 31) / 31;
    blades.tint[3 * i + 1] = (look >>> 5 & 63) / 63;
    blades.tint[3 * i + 2] = (look >>> 11 & 31) / 31;
    blades.exposure[i] = (look >>> 16 & 31) / 31;
    blades.species[i] = look >>> 21 & 7;
    blades.clump[i] = look >>> 24;
    blades.patch[i] = patch;
  }
  return blades;
}
function unfoldUp(bits, up, at) {
  let x = ((bits & 255) - 127) / 127;
  let y = ((bits >>> 8) - 127) / 127;
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) {
    const folded = (1 - Math.abs(y)) * (x >= 0 ? 1 : -1);
    y = (1 - Math.abs(x)) * (y >= 0 ? 1 : -1);
    x = folded;
  }
  const size2 = Math.hypot(x, y, z);
  up[at] = x / size2;
  up[at + 1] = y / size2;
  up[at + 2] = z / size2;
}
function bladeId(keys, blade) {
  if (keys.length === 0) return BigInt(blade);
  const mask2 = 0xffffffffffffffffn;
  let x = BigInt(keys[2 * blade]) << 32n | BigInt(keys[2 * blade + 1]);
  x = x + 0x9e3779b97f4a7c15n & mask2;
  x = (x ^ x >> 30n) * 0xbf58476d1ce4e5b9n & mask2;
  x = (x ^ x >> 27n) * 0x94d049bb133111ebn & mask2;
  return (x ^ x >> 31n) >> 11n;
}
var widthBits = 63 << 16;
var clumpBits = 255 << 24;
function verifyBlades(packed, patches, species, first, count, place) {
  const ribbons = species.map((one) => ribbonsOf(one.organs));
  const hasPlants = ribbons.some((n) => n > 0);
  let patch = hasPlants && count > 0 ? patches.patchOf(first) : 0;
  for (let blade = first; blade < first + count; ++blade) {
    const at = bladeWords * blade;
    const kind = packed[at + 3] >>> 21 & 7;
    if (kind >= species.length)
      fail("input", `${place}: blade ${blade} has species ${kind}; there are ${species.length}`);
    if (!hasPlants) continue;
    while (blade >= patches.firstBlade(patch) + patches.bladeCount(patch)) ++patch;
    const number = packed[at + 3] >>> 24;
    if (number === 0 || ribbons[kind] === 0) continue;
    if (number > ribbons[kind])
      fail("input", `${place}: blade ${blade} is ribbon ${number} of a plant with ${ribbons[kind]}`);
    const isFirst = blade === patches.firstBlade(patch);
    if (blade === first && !isFirst) continue;
    if (isFirst || packed[at - 1] >>> 24 !== number - 1 || packed[at - 4] !== packed[at] || packed[at - 3] !== packed[at + 1] || ((packed[at - 2] ^ packed[at + 2]) & ~widthBits) !== 0 || ((packed[at - 1] ^ packed[at + 3]) & ~clumpBits) !== 0)
      fail("input", `${place}: blade ${blade} is ribbon ${number} without its stalk`);
  }
}

// node_modules/fzstd/esm/index.mjs
var ab = ArrayBuffer;
var u8 = Uint8Array;
var u16 = Uint16Array;
var i16 = Int16Array;
var i32 = Int32Array;
var slc = function(v, s, e) {
  if (u8.prototype.slice)
    return u8.prototype.slice.call(v, s, e);
  if (s == null || s < 0)
    s = 0;
  if (e == null || e > v.length)
    e = v.length;
  var n = new u8(e - s);
  n.set(v.subarray(s, e));
  return n;
};
var fill = function(v, n, s, e) {
  if (u8.prototype.fill)
    return u8.prototype.fill.call(v, n, s, e);
  if (s == null || s < 0)
    s = 0;
  if (e == null || e > v.length)
    e = v.length;
  for (; s < e; ++s)
    v[s] = n;
  return v;
};
var cpw = function(v, t, s, e) {
  if (u8.prototype.copyWithin)
    return u8.prototype.copyWithin.call(v, t, s, e);
  if (s == null || s < 0)
    s = 0;
  if (e == null || e > v.length)
    e = v.length;
  while (s < e) {
    v[t++] = v[s++];
  }
};
var ec = [
  "invalid zstd data",
  "window size too large (>2046MB)",
  "invalid block type",
  "FSE accuracy too high",
  "match distance too far back",
  "unexpected EOF"
];
var err = function(ind, msg, nt) {
  var e = new Error(msg || ec[ind]);
  e.code = ind;
  if (Error.captureStackTrace)
    Error.captureStackTrace(e, err);
  if (!nt)
    throw e;
  return e;
};
var rb = function(d, b, n) {
  var i = 0, o = 0;
  for (; i < n; ++i)
    o |= d[b++] << (i << 3);
  return o;
};
var b4 = function(d, b) {
  return (d[b] | d[b + 1] << 8 | d[b + 2] << 16 | d[b + 3] << 24) >>> 0;
};
var rzfh = function(dat, w) {
  var n3 = dat[0] | dat[1] << 8 | dat[2] << 16;
  if (n3 == 3126568 && dat[3] == 253) {
    var flg = dat[4];
    var ss = flg >> 5 & 1, cc = flg >> 2 & 1, df = flg & 3, fcf = flg >> 6;
    if (flg & 8)
      err(0);
    var bt = 6 - ss;
    var db = df == 3 ? 4 : df;
    var di = rb(dat, bt, db);
    bt += db;
    var fsb = fcf ? 1 << fcf : ss;
    var fss = rb(dat, bt, fsb) + (fcf == 1 && 256);
    var ws = fss;
    if (!ss) {
      var wb = 1 << 10 + (dat[5] >> 3);
      ws = wb + (wb >> 3) * (dat[5] & 7);
    }
    if (ws > 2145386496)
      err(1);
    var buf = new u8((w == 1 ? fss || ws : w ? 0 : ws) + 12);
    buf[0] = 1, buf[4] = 4, buf[8] = 8;
    return {
      b: bt + fsb,
      y: 0,
      l: 0,
      d: di,
      w: w && w != 1 ? w : buf.subarray(12),
      e: ws,
      o: new i32(buf.buffer, 0, 3),
      u: fss,
      c: cc,
      m: Math.min(131072, ws)
    };
  } else if ((n3 >> 4 | dat[3] << 20) == 25481893) {
    return b4(dat, 4) + 8;
  }
  err(0);
};
var msb = function(val) {
  var bits = 0;
  for (; 1 << bits <= val; ++bits)
    ;
  return bits - 1;
};
var rfse = function(dat, bt, mal) {
  var tpos = (bt << 3) + 4;
  var al = (dat[bt] & 15) + 5;
  if (al > mal)
    err(3);
  var sz = 1 << al;
  var probs = sz, sym = -1, re = -1, i = -1, ht = sz;
  var buf = new ab(512 + (sz << 2));
  var freq = new i16(buf, 0, 256);
  var dstate = new u16(buf, 0, 256);
  var nstate = new u16(buf, 512, sz);
  var bb1 = 512 + (sz << 1);
  var syms = new u8(buf, bb1, sz);
  var nbits = new u8(buf, bb1 + sz);
  while (sym < 255 && probs > 0) {
    var bits = msb(probs + 1);
    var cbt = tpos >> 3;
    var msk = (1 << bits + 1) - 1;
    var val = (dat[cbt] | dat[cbt + 1] << 8 | dat[cbt + 2] << 16) >> (tpos & 7) & msk;
    var msk1fb = (1 << bits) - 1;
    var msv = msk - probs - 1;
    var sval = val & msk1fb;
    if (sval < msv)
      tpos += bits, val = sval;
    else {
      tpos += bits + 1;
      if (val > msk1fb)
        val -= msv;
    }
    freq[++sym] = --val;
    if (val == -1) {
      probs += val;
      syms[--ht] = sym;
    } else
      probs -= val;
    if (!val) {
      do {
        var rbt = tpos >> 3;
        re = (dat[rbt] | dat[rbt + 1] << 8) >> (tpos & 7) & 3;
        tpos += 2;
        sym += re;
      } while (re == 3);
    }
  }
  if (sym > 255 || probs)
    err(0);
  var sympos = 0;
  var sstep = (sz >> 1) + (sz >> 3) + 3;
  var smask = sz - 1;
  for (var s = 0; s <= sym; ++s) {
    var sf = freq[s];
    if (sf < 1) {
      dstate[s] = -sf;
      continue;
    }
    for (i = 0; i < sf; ++i) {
      syms[sympos] = s;
      do {
        sympos = sympos + sstep & smask;
      } while (sympos >= ht);
    }
  }
  if (sympos)
    err(0);
  for (i = 0; i < sz; ++i) {
    var ns = dstate[syms[i]]++;
    var nb = nbits[i] = al - msb(ns);
    nstate[i] = (ns << nb) - sz;
  }
  return [tpos + 7 >> 3, {
    b: al,
    s: syms,
    n: nbits,
    t: nstate
  }];
};
var rhu = function(dat, bt) {
  var i = 0, wc = -1;
  var buf = new u8(292), hb = dat[bt];
  var hw = buf.subarray(0, 256);
  var rc = buf.subarray(256, 268);
  var ri = new u16(buf.buffer, 268);
  if (hb < 128) {
    var _a = rfse(dat, bt + 1, 6), ebt = _a[0], fdt = _a[1];
    bt += hb;
    var epos = ebt << 3;
    var lb = dat[bt];
    if (!lb)
      err(0);
    var st1 = 0, st2 = 0, btr1 = fdt.b, btr2 = btr1;
    var fpos = (++bt << 3) - 8 + msb(lb);
    for (; ; ) {
      fpos -= btr1;
      if (fpos < epos)
        break;
      var cbt = fpos >> 3;
      st1 += (dat[cbt] | dat[cbt + 1] << 8) >> (fpos & 7) & (1 << btr1) - 1;
      hw[++wc] = fdt.s[st1];
      fpos -= btr2;
      if (fpos < epos)
        break;
      cbt = fpos >> 3;
      st2 += (dat[cbt] | dat[cbt + 1] << 8) >> (fpos & 7) & (1 << btr2) - 1;
      hw[++wc] = fdt.s[st2];
      btr1 = fdt.n[st1];
      st1 = fdt.t[st1];
      btr2 = fdt.n[st2];
      st2 = fdt.t[st2];
    }
    if (++wc > 255)
      err(0);
  } else {
    wc = hb - 127;
    for (; i < wc; i += 2) {
      var byte = dat[++bt];
      hw[i] = byte >> 4;
      hw[i + 1] = byte & 15;
    }
    ++bt;
  }
  var wes = 0;
  for (i = 0; i < wc; ++i) {
    var wt = hw[i];
    if (wt > 11)
      err(0);
    wes += wt && 1 << wt - 1;
  }
  var mb = msb(wes) + 1;
  var ts = 1 << mb;
  var rem = ts - wes;
  if (rem & rem - 1)
    err(0);
  hw[wc++] = msb(rem) + 1;
  for (i = 0; i < wc; ++i) {
    var wt = hw[i];
    ++rc[hw[i] = wt && mb + 1 - wt];
  }
  var hbuf = new u8(ts << 1);
  var syms = hbuf.subarray(0, ts), nb = hbuf.subarray(ts);
  ri[mb] = 0;
  for (i = mb; i > 0; --i) {
    var pv = ri[i];
    fill(nb, i, pv, ri[i - 1] = pv + rc[i] * (1 << mb - i));
  }
  if (ri[0] != ts)
    err(0);
  for (i = 0; i < wc; ++i) {
    var bits = hw[i];
    if (bits) {
      var code = ri[bits];
      fill(syms, i, code, ri[bits] = code + (1 << mb - bits));
    }
  }
  return [bt, {
    n: nb,
    b: mb,
    s: syms
  }];
};
var dllt = rfse(/* @__PURE__ */ new u8([
  81,
  16,
  99,
  140,
  49,
  198,
  24,
  99,
  12,
  33,
  196,
  24,
  99,
  102,
  102,
  134,
  70,
  146,
  4
]), 0, 6)[1];
var dmlt = rfse(/* @__PURE__ */ new u8([
  33,
  20,
  196,
  24,
  99,
  140,
  33,
  132,
  16,
  66,
  8,
  33,
  132,
  16,
  66,
  8,
  33,
  68,
  68,
  68,
  68,
  68,
  68,
  68,
  68,
  36,
  9
]), 0, 6)[1];
var doct = rfse(/* @__PURE__ */ new u8([
  32,
  132,
  16,
  66,
  102,
  70,
  68,
  68,
  68,
  68,
  36,
  73,
  2
]), 0, 5)[1];
var b2bl = function(b, s) {
  var len = b.length, bl = new i32(len);
  for (var i = 0; i < len; ++i) {
    bl[i] = s;
    s += 1 << b[i];
  }
  return bl;
};
var llb = /* @__PURE__ */ new u8((/* @__PURE__ */ new i32([
  0,
  0,
  0,
  0,
  16843009,
  50528770,
  134678020,
  202050057,
  269422093
])).buffer, 0, 36);
var llbl = /* @__PURE__ */ b2bl(llb, 0);
var mlb = /* @__PURE__ */ new u8((/* @__PURE__ */ new i32([
  0,
  0,
  0,
  0,
  0,
  0,
  0,
  0,
  16843009,
  50528770,
  117769220,
  185207048,
  252579084,
  16
])).buffer, 0, 53);
var mlbl = /* @__PURE__ */ b2bl(mlb, 3);
var dhu = function(dat, out, hu) {
  var len = dat.length, ss = out.length, lb = dat[len - 1], msk = (1 << hu.b) - 1, eb = -hu.b;
  if (!lb)
    err(0);
  var st = 0, btr = hu.b, pos = (len << 3) - 8 + msb(lb) - btr, i = -1;
  for (; pos > eb && i < ss; ) {
    var cbt = pos >> 3;
    var val = (dat[cbt] | dat[cbt + 1] << 8 | dat[cbt + 2] << 16) >> (pos & 7);
    st = (st << btr | val) & msk;
    out[++i] = hu.s[st];
    pos -= btr = hu.n[st];
  }
  if (pos != eb || i + 1 != ss)
    err(0);
};
var dhu4 = function(dat, out, hu) {
  var bt = 6;
  var ss = out.length, sz1 = ss + 3 >> 2, sz2 = sz1 << 1, sz3 = sz1 + sz2;
  dhu(dat.subarray(bt, bt += dat[0] | dat[1] << 8), out.subarray(0, sz1), hu);
  dhu(dat.subarray(bt, bt += dat[2] | dat[3] << 8), out.subarray(sz1, sz2), hu);
  dhu(dat.subarray(bt, bt += dat[4] | dat[5] << 8), out.subarray(sz2, sz3), hu);
  dhu(dat.subarray(bt), out.subarray(sz3), hu);
};
var rzb = function(dat, st, out) {
  var _a;
  var bt = st.b;
  var b0 = dat[bt], btype = b0 >> 1 & 3;
  st.l = b0 & 1;
  var sz = b0 >> 3 | dat[bt + 1] << 5 | dat[bt + 2] << 13;
  var ebt = (bt += 3) + sz;
  if (btype == 1) {
    if (bt >= dat.length)
      return;
    st.b = bt + 1;
    if (out) {
      fill(out, dat[bt], st.y, st.y += sz);
      return out;
    }
    return fill(new u8(sz), dat[bt]);
  }
  if (ebt > dat.length)
    return;
  if (btype == 0) {
    st.b = ebt;
    if (out) {
      out.set(dat.subarray(bt, ebt), st.y);
      st.y += sz;
      return out;
    }
    return slc(dat, bt, ebt);
  }
  if (btype == 2) {
    var b3 = dat[bt], lbt = b3 & 3, sf = b3 >> 2 & 3;
    var lss = b3 >> 4, lcs = 0, s4 = 0;
    if (lbt < 2) {
      if (sf & 1)
        lss |= dat[++bt] << 4 | (sf & 2 && dat[++bt] << 12);
      else
        lss = b3 >> 3;
    } else {
      s4 = sf;
      if (sf < 2)
        lss |= (dat[++bt] & 63) << 4, lcs = dat[bt] >> 6 | dat[++bt] << 2;
      else if (sf == 2)
        lss |= dat[++bt] << 4 | (dat[++bt] & 3) << 12, lcs = dat[bt] >> 2 | dat[++bt] << 6;
      else
        lss |= dat[++bt] << 4 | (dat[++bt] & 63) << 12, lcs = dat[bt] >> 6 | dat[++bt] << 2 | dat[++bt] << 10;
    }
    ++bt;
    var buf = out ? out.subarray(st.y, st.y + st.m) : new u8(st.m);
    var spl = buf.length - lss;
    if (lbt == 0)
      buf.set(dat.subarray(bt, bt += lss), spl);
    else if (lbt == 1)
      fill(buf, dat[bt++], spl);
    else {
      var hu = st.h;
      if (lbt == 2) {
        var hud = rhu(dat, bt);
        lcs += bt - (bt = hud[0]);
        st.h = hu = hud[1];
      } else if (!hu)
        err(0);
      (s4 ? dhu4 : dhu)(dat.subarray(bt, bt += lcs), buf.subarray(spl), hu);
    }
    var ns = dat[bt++];
    if (ns) {
      if (ns == 255)
        ns = (dat[bt++] | dat[bt++] << 8) + 32512;
      else if (ns > 127)
        ns = ns - 128 << 8 | dat[bt++];
      var scm = dat[bt++];
      if (scm & 3)
        err(0);
      var dts = [dmlt, doct, dllt];
      for (var i = 2; i > -1; --i) {
        var md = scm >> (i << 1) + 2 & 3;
        if (md == 1) {
          var rbuf = new u8([0, 0, dat[bt++]]);
          dts[i] = {
            s: rbuf.subarray(2, 3),
            n: rbuf.subarray(0, 1),
            t: new u16(rbuf.buffer, 0, 1),
            b: 0
          };
        } else if (md == 2) {
          _a = rfse(dat, bt, 9 - (i & 1)), bt = _a[0], dts[i] = _a[1];
        } else if (md == 3) {
          if (!st.t)
            err(0);
          dts[i] = st.t[i];
        }
      }
      var _b = st.t = dts, mlt = _b[0], oct = _b[1], llt = _b[2];
      var lb = dat[ebt - 1];
      if (!lb)
        err(0);
      var spos = (ebt << 3) - 8 + msb(lb) - llt.b, cbt = spos >> 3, oubt = 0;
      var lst = (dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << llt.b) - 1;
      cbt = (spos -= oct.b) >> 3;
      var ost = (dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << oct.b) - 1;
      cbt = (spos -= mlt.b) >> 3;
      var mst = (dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << mlt.b) - 1;
      for (++ns; --ns; ) {
        var llc = llt.s[lst];
        var lbtr = llt.n[lst];
        var mlc = mlt.s[mst];
        var mbtr = mlt.n[mst];
        var ofc = oct.s[ost];
        var obtr = oct.n[ost];
        cbt = (spos -= ofc) >> 3;
        var ofp = 1 << ofc;
        var off = ofp + ((dat[cbt] | dat[cbt + 1] << 8 | dat[cbt + 2] << 16 | dat[cbt + 3] << 24) >>> (spos & 7) & ofp - 1);
        cbt = (spos -= mlb[mlc]) >> 3;
        var ml = mlbl[mlc] + ((dat[cbt] | dat[cbt + 1] << 8 | dat[cbt + 2] << 16) >> (spos & 7) & (1 << mlb[mlc]) - 1);
        cbt = (spos -= llb[llc]) >> 3;
        var ll = llbl[llc] + ((dat[cbt] | dat[cbt + 1] << 8 | dat[cbt + 2] << 16) >> (spos & 7) & (1 << llb[llc]) - 1);
        cbt = (spos -= lbtr) >> 3;
        lst = llt.t[lst] + ((dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << lbtr) - 1);
        cbt = (spos -= mbtr) >> 3;
        mst = mlt.t[mst] + ((dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << mbtr) - 1);
        cbt = (spos -= obtr) >> 3;
        ost = oct.t[ost] + ((dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << obtr) - 1);
        if (off > 3) {
          st.o[2] = st.o[1];
          st.o[1] = st.o[0];
          st.o[0] = off -= 3;
        } else {
          var idx = off - (ll != 0);
          if (idx) {
            off = idx == 3 ? st.o[0] - 1 : st.o[idx];
            if (idx > 1)
              st.o[2] = st.o[1];
            st.o[1] = st.o[0];
            st.o[0] = off;
          } else
            off = st.o[0];
        }
        for (var i = 0; i < ll; ++i) {
          buf[oubt + i] = buf[spl + i];
        }
        oubt += ll, spl += ll;
        var stin = oubt - off;
        if (stin < 0) {
          var len = -stin;
          var bs = st.e + stin;
          if (len > ml)
            len = ml;
          for (var i = 0; i < len; ++i) {
            buf[oubt + i] = st.w[bs + i];
          }
          oubt += len, ml -= len, stin = 0;
        }
        for (var i = 0; i < ml; ++i) {
          buf[oubt + i] = buf[stin + i];
        }
        oubt += ml;
      }
      if (oubt != spl) {
        while (spl < buf.length) {
          buf[oubt++] = buf[spl++];
        }
      } else
        oubt = buf.length;
      if (out)
        st.y += oubt;
      else
        buf = slc(buf, 0, oubt);
    } else if (out) {
      st.y += lss;
      if (spl) {
        for (var i = 0; i < lss; ++i) {
          buf[i] = buf[spl + i];
        }
      }
    } else if (spl)
      buf = slc(buf, spl);
    st.b = ebt;
    return buf;
  }
  err(2);
};
var cct = function(bufs, ol) {
  if (bufs.length == 1)
    return bufs[0];
  var buf = new u8(ol);
  for (var i = 0, b = 0; i < bufs.length; ++i) {
    var chk = bufs[i];
    buf.set(chk, b);
    b += chk.length;
  }
  return buf;
};
function decompress(dat, buf) {
  var bufs = [], nb = +!buf;
  var bt = 0, ol = 0;
  for (; dat.length; ) {
    var st = rzfh(dat, nb || buf);
    if (typeof st == "object") {
      if (nb) {
        buf = null;
        if (st.w.length == st.u) {
          bufs.push(buf = st.w);
          ol += st.u;
        }
      } else {
        bufs.push(buf);
        st.e = 0;
      }
      for (; !st.l; ) {
        var blk = rzb(dat, st, buf);
        if (!blk)
          err(5);
        if (buf)
          st.e = st.y;
        else {
          bufs.push(blk);
          ol += blk.length;
          cpw(st.w, 0, blk.length);
          st.w.set(blk, st.w.length - blk.length);
        }
      }
      bt = st.b + st.c * 4;
    } else
      bt = st;
    dat = dat.subarray(bt);
  }
  return cct(bufs, ol);
}

// src/format/xxh3.ts
var secretHex = "b8fe6c3923a44bbe7c01812cf721ad1cded46de9839097db7240a4a4b7b3671fcb79e64eccc0e578825ad07dccff7221b8084674f743248ee03590e6813a264c3c2852bb91c300cb88d0658b1b532ea371644897a20df94e3819ef46a9deacd8a8fa763fe39c343ff9dcbbc7c70b4f1d8a51e04bcdb45931c89f7ec9d9787364eac5ac8334d3ebc3c581a0fffa1363eb170ddd51b7f0da49d316552629d4689e2b16be587d47a1fc8ff8b8d17ad031ce45cb3a8f95160428afd7fbcabb4b407e";
var secret = Uint8Array.from(secretHex.match(/../g), (pair) => parseInt(pair, 16));
var secretView = new DataView(secret.buffer);
var secretWords = new Uint32Array(secret.buffer);
var mask = 0xffffffffffffffffn;
var prime32 = [0n, 0x9e3779b1n, 0x85ebca77n, 0xc2b2ae3dn];
var prime64 = [
  0n,
  0x9e3779b185ebca87n,
  0xc2b2ae3d27d4eb4fn,
  0x165667b19e3779f9n,
  0x85ebca77c2b2ae63n,
  0x27d4eb2f165667c5n
];
var secretAt = (at) => secretView.getBigUint64(at, true);
var rotate = (x, bits) => (x << bits | x >> 64n - bits) & mask;
function swap64(x) {
  let result = 0n;
  for (let i = 0n; i < 8n; ++i) result = result << 8n | x >> 8n * i & 255n;
  return result;
}
function foldedProduct(a, b) {
  const product = a * b;
  return product & mask ^ product >> 64n;
}
function avalanche(x) {
  x ^= x >> 37n;
  x = x * 0x165667919e3779f9n & mask;
  return x ^ x >> 32n;
}
function avalanche64(x) {
  x ^= x >> 33n;
  x = x * prime64[2] & mask;
  x ^= x >> 29n;
  x = x * prime64[3] & mask;
  return x ^ x >> 32n;
}
function shortHash(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const length = bytes.length;
  const size2 = BigInt(length);
  const word = (at) => BigInt(view.getUint32(at, true));
  const long = (at) => view.getBigUint64(at, true);
  const mixed = (at, of) => foldedProduct(long(at) ^ secretAt(of), long(at + 8) ^ secretAt(of + 8));
  if (length === 0) return avalanche64(secretAt(56) ^ secretAt(64));
  if (length <= 3) {
    const combined = (bytes[0] << 16 | bytes[length >> 1] << 24 | bytes[length - 1] | length << 8) >>> 0;
    return avalanche64(BigInt((combined ^ secretWords[0] ^ secretWords[1]) >>> 0));
  }
  if (length <= 8) {
    let h = (word(length - 4) | word(0) << 32n) ^ (secretAt(8) ^ secretAt(16));
    h ^= rotate(h, 49n) ^ rotate(h, 24n);
    h = h * 0x9fb21c651e98df25n & mask;
    h ^= (h >> 35n) + size2;
    h = h * 0x9fb21c651e98df25n & mask;
    return h ^ h >> 28n;
  }
  if (length <= 16) {
    const low = long(0) ^ (secretAt(24) ^ secretAt(32));
    const high = long(length - 8) ^ (secretAt(40) ^ secretAt(48));
    return avalanche(size2 + swap64(low) + high + foldedProduct(low, high) & mask);
  }
  let sum = size2 * prime64[1];
  if (length <= 128) {
    for (let i = Math.floor((length - 1) / 32); i >= 0; --i)
      sum += mixed(16 * i, 32 * i) + mixed(length - 16 * (i + 1), 32 * i + 16);
    return avalanche(sum & mask);
  }
  for (let i = 0; i < 8; ++i) sum += mixed(16 * i, 16 * i);
  sum = avalanche(sum & mask);
  for (let i = 8; i < Math.floor(length / 16); ++i) sum += mixed(16 * i, 16 * (i - 8) + 3);
  sum += mixed(length - 16, 136 - 17);
  return avalanche(sum & mask);
}
var stripe = 64;
var stripesPerBlock = 16;
var blockBytes = stripe * stripesPerBlock;
var LongHash = class {
  sums = new Uint32Array(16);
  constructor() {
    const start = [
      prime32[3],
      prime64[1],
      prime64[2],
      prime64[3],
      prime64[4],
      prime32[2],
      prime64[5],
      prime32[1]
    ];
    start.forEach((value, i) => {
      this.sums[2 * i] = Number(value & 0xffffffffn);
      this.sums[2 * i + 1] = Number(value >> 32n);
    });
  }
  /** Adds the stripe at word `at` of `data`; `key` is the word of the secret. */
  addStripe(data, at, keys, key) {
    const sums = this.sums;
    for (let lane = 0; lane < 16; lane += 2) {
      const low = data[at + lane];
      const high = data[at + lane + 1];
      const a = (low ^ keys[key + lane]) >>> 0;
      const b = (high ^ keys[key + lane + 1]) >>> 0;
      const aLow = a & 65535;
      const aHigh = a >>> 16;
      const bLow = b & 65535;
      const bHigh = b >>> 16;
      const middle = aHigh * bLow + aLow * bHigh + (Math.imul(aLow, bLow) >>> 0 >>> 16);
      const productLow = Math.imul(a, b) >>> 0;
      const productHigh = aHigh * bHigh + Math.floor(middle / 65536);
      const own = sums[lane] + productLow;
      sums[lane] = own;
      sums[lane + 1] = sums[lane + 1] + productHigh + (own > 4294967295 ? 1 : 0);
      const other = lane ^ 2;
      const added = sums[other] + low;
      sums[other] = added;
      sums[other + 1] = sums[other + 1] + high + (added > 4294967295 ? 1 : 0);
    }
  }
  addBlock(data, at) {
    for (let i = 0; i < stripesPerBlock; ++i) this.addStripe(data, at + 16 * i, secretWords, 2 * i);
    this.scramble();
  }
  scramble() {
    const sums = this.sums;
    const key = (secret.length - stripe) / 4;
    const prime = 2654435761;
    for (let lane = 0; lane < 16; lane += 2) {
      const low = sums[lane];
      const high = sums[lane + 1];
      const a = (low ^ high >>> 15 ^ secretWords[key + lane]) >>> 0;
      const b = (high ^ secretWords[key + lane + 1]) >>> 0;
      const aLow = a & 65535;
      const aHigh = a >>> 16;
      const primeLow = prime & 65535;
      const primeHigh = prime >>> 16;
      const middle = aHigh * primeLow + aLow * primeHigh + (Math.imul(aLow, primeLow) >>> 0 >>> 16);
      sums[lane] = Math.imul(a, prime);
      sums[lane + 1] = aHigh * primeHigh + Math.floor(middle / 65536) + (Math.imul(b, prime) >>> 0);
    }
  }
  digest(length) {
    const long = (i) => BigInt(this.sums[2 * i]) | BigInt(this.sums[2 * i + 1]) << 32n;
    let result = BigInt(length) * prime64[1];
    for (let i = 0; i < 4; ++i)
      result += foldedProduct(
        long(2 * i) ^ secretAt(11 + 16 * i),
        long(2 * i + 1) ^ secretAt(11 + 16 * i + 8)
      );
    return avalanche(result & mask);
  }
};
var isLittleEndian = new Uint8Array(new Uint32Array([1]).buffer)[0] === 1;
function wordsOf(bytes) {
  if (!isLittleEndian) throw new Error("this machine is not little endian");
  if (bytes.byteOffset % 4 !== 0) bytes = bytes.slice();
  return new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.length >> 2);
}
function* longHash(bytes) {
  const words = wordsOf(bytes);
  const length = bytes.length;
  const hash = new LongHash();
  const blocks2 = Math.floor((length - 1) / blockBytes);
  for (let i = 0; i < blocks2; ++i) {
    hash.addBlock(words, i * blockBytes / 4);
    if (i % 4096 === 4095) yield;
  }
  const stripes = Math.floor((length - 1 - blocks2 * blockBytes) / stripe);
  for (let i = 0; i < stripes; ++i)
    hash.addStripe(words, (blocks2 * blockBytes + i * stripe) / 4, secretWords, 2 * i);
  const lastKey = secret.length - stripe - 7;
  hash.addStripe(
    wordsOf(bytes.slice(length - stripe)),
    0,
    wordsOf(secret.slice(lastKey, lastKey + stripe)),
    0
  );
  return hash.digest(length);
}
function xxh3(bytes) {
  if (bytes.length <= 240) return shortHash(bytes);
  const steps2 = longHash(bytes);
  for (; ; ) {
    const step = steps2.next();
    if (step.done) return step.value;
  }
}
async function xxh3InSteps(bytes) {
  if (bytes.length <= 240) return shortHash(bytes);
  const steps2 = longHash(bytes);
  for (; ; ) {
    const step = steps2.next();
    if (step.done) return step.value;
    await new Promise((resolve) => setTimeout(resolve));
  }
}

// src/format/container.ts
var magic = "SWARD\r\n";
var majorVersion = 1;
var minorVersion = 3;
var endianMark = 16909060;
var headerBytes = 64;
var entryBytes = 64;
var maxChunks = 64;
var alignment = 64;
var critical = 1;
var compressed = 2;
var plainBytes = 256 * 1024 * 1024;
var largestRatio = 4096;
var largestWindow = 32 * 1024 * 1024;
var knownChunks = {
  PATCHES: 104,
  BLADES: 16,
  KEYS: 8,
  SPECIES: 1,
  GVERTICE: 28,
  GINDICES: 4,
  GRANGES: 16,
  GMATERIA: 32,
  GIMAGES: 1,
  DEFAULTS: 1,
  COVER: 1,
  SEEDS: 1,
  SEEDCELL: 48,
  SEEDDATA: 1,
  PROVENAN: 1
};
var hex = (value, digits = 0) => `0x${(value >>> 0).toString(16).padStart(digits, "0")}`;
var Container = class _Container {
  /** `head`: the first bytes of the file, at least header and table. */
  constructor(source, head2) {
    this.source = source;
    this.head = head2;
    const place = source.name;
    const view = new DataView(head2.buffer, head2.byteOffset, head2.length);
    for (let i = 0; i < magic.length; ++i)
      if (head2[i] !== magic.charCodeAt(i))
        fail("input", `${place}: not a field file (it does not begin with "SWARD")`);
    const mark = view.getUint32(12, true);
    if (mark !== endianMark)
      fail("input", `${place}: the byte order mark is ${hex(mark, 8)} instead of ${hex(endianMark, 8)}`);
    this.version = { major: view.getUint16(8, true), minor: view.getUint16(10, true) };
    if (this.version.major > majorVersion)
      fail(
        "unsupported",
        `${place}: field format version ${this.version.major}.${this.version.minor}; this program reads up to version ${majorVersion}.${minorVersion}`
      );
    if (this.version.major === 0) fail("input", `${place}: field format version 0 does not exist`);
    const size2 = view.getBigUint64(16, true);
    if (size2 !== BigInt(source.size))
      fail(
        "input",
        `${place}: ${source.size} bytes instead of ${size2}: ` + (BigInt(source.size) < size2 ? "truncated" : "bytes follow its end")
      );
    const count = view.getUint32(24, true);
    if (count > maxChunks) fail("input", `${place}: ${count} chunks, more than ${maxChunks}`);
    if (count === 0) fail("input", `${place}: no chunks`);
    const end = headerBytes + count * entryBytes;
    if (end > source.size)
      fail("input", `${place}: the table of ${count} chunks does not fit into ${source.size} bytes`);
    const hashed = head2.slice(0, end);
    hashed.fill(0, 56, 64);
    if (xxh3(hashed) !== view.getBigUint64(56, true))
      fail("input", `${place}: header or chunk table is damaged (hash differs)`);
    this.origin = [32, 40, 48].map((at) => view.getFloat64(at, true));
    if (!this.origin.every(Number.isFinite)) fail("input", `${place}: the origin is not finite`);
    this.readTable(view, count, end);
  }
  source;
  head;
  version;
  /** World position of the field's origin [m]. */
  origin;
  chunks = [];
  /** Reads header and table of a field. */
  static async open(source) {
    if (source.size < headerBytes)
      fail(
        "input",
        `${source.name}: ${source.size} bytes, too short for the header of a field (${headerBytes})`
      );
    const bytes = Math.min(source.size, headerBytes + maxChunks * entryBytes);
    return new _Container(source, await source.read(0, bytes));
  }
  readTable(view, count, end) {
    const place = this.source.name;
    let at = end;
    for (let i = 0; i < count; ++i) {
      const base = headerBytes + i * entryBytes;
      const name = Array.from(
        this.head.subarray(base, base + 8),
        (c) => c >= 32 && c < 127 ? String.fromCharCode(c) : "?"
      ).join("").trimEnd();
      const number = (offset) => {
        const value = view.getBigUint64(base + offset, true);
        return value > BigInt(Number.MAX_SAFE_INTEGER) ? Infinity : Number(value);
      };
      const chunk = {
        name,
        offset: number(8),
        storedBytes: number(16),
        rawBytes: number(24),
        hash: view.getBigUint64(base + 32, true),
        flags: view.getUint32(base + 40, true),
        elementBytes: view.getUint32(base + 44, true),
        elementCount: number(48)
      };
      if (chunk.offset % alignment !== 0 || chunk.offset < at || chunk.offset - at >= alignment || chunk.storedBytes > this.source.size - chunk.offset)
        fail(
          "input",
          `${place}: chunk ${name} at ${chunk.offset} with ${chunk.storedBytes} bytes does not fit`
        );
      if ((chunk.flags & ~(critical | compressed)) !== 0)
        fail("unsupported", `${place}: chunk ${name} has unknown flags ${hex(chunk.flags)}`);
      const isCompressed = (chunk.flags & compressed) !== 0;
      if (chunk.elementBytes === 0 || chunk.elementCount * chunk.elementBytes !== chunk.rawBytes || !isCompressed && chunk.rawBytes !== chunk.storedBytes)
        fail(
          "input",
          `${place}: chunk ${name} has ${chunk.elementCount} elements of ${chunk.elementBytes} bytes in ${chunk.rawBytes} bytes`
        );
      const known = knownChunks[name];
      if (known === void 0 && (chunk.flags & critical) !== 0)
        fail("unsupported", `${place}: needs chunk ${name}, which this version does not know`);
      if (known !== void 0 && known !== chunk.elementBytes)
        fail(
          "input",
          `${place}: elements of chunk ${name} have ${chunk.elementBytes} bytes instead of ${known}`
        );
      this.chunks.push(chunk);
      at = chunk.offset + chunk.storedBytes;
    }
  }
  /** The first chunk of this name; undefined if there is none. */
  find(name) {
    return this.chunks.find((chunk) => chunk.name === name);
  }
  /** The same; an error if it is missing. */
  need(name) {
    return this.find(name) ?? fail("input", `${this.source.name}: chunk ${name} is missing`);
  }
  /** Checks that the bytes between chunks are zero. Needs the whole file. */
  async checkPadding() {
    let at = headerBytes + this.chunks.length * entryBytes;
    const check = async (from, to) => {
      const bytes = await this.source.read(from, to);
      const found = bytes.findIndex((byte) => byte !== 0);
      if (found >= 0)
        fail("input", `${this.source.name}: byte ${from + found} between chunks is not zero`);
    };
    for (const chunk of this.chunks) {
      await check(at, chunk.offset);
      at = chunk.offset + chunk.storedBytes;
    }
    await check(at, this.source.size);
  }
  /** Compares the stored bytes of a chunk with its hash. */
  async checkHash(chunk, stored) {
    if (await xxh3InSteps(stored) !== chunk.hash)
      fail("input", `${this.source.name}: chunk ${chunk.name} is damaged (hash differs)`);
  }
  /** The bytes of a chunk, verified and decompressed. Their buffer begins with them. */
  async bytes(chunk) {
    const stored = await this.source.read(chunk.offset, chunk.offset + chunk.storedBytes);
    await this.checkHash(chunk, stored);
    if ((chunk.flags & compressed) === 0) return stored.slice();
    return this.decompressed(chunk, stored);
  }
  decompressed(chunk, stored) {
    if (chunk.elementCount === 0) return new Uint8Array(0);
    const place = `${this.source.name}: chunk ${chunk.name}`;
    const planes = unpackFrame(stored, chunk.rawBytes, place);
    const { elementBytes, elementCount } = chunk;
    if (elementBytes === 1) return planes;
    const raw = new Uint8Array(chunk.rawBytes);
    for (let plane = 0; plane < elementBytes; ++plane) {
      const from = plane * elementCount;
      for (let i = 0, to = plane; i < elementCount; ++i, to += elementBytes) raw[to] = planes[from + i];
    }
    return raw;
  }
  /** The text of a chunk; undefined if it is absent. */
  async text(name) {
    const chunk = this.find(name);
    if (!chunk) return void 0;
    const bytes = await this.bytes(chunk);
    try {
      return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
    } catch {
      fail("input", `${this.source.name}: chunk ${name} is not UTF-8`);
    }
  }
};
function unpackFrame(stored, rawBytes, place) {
  const frame = frameOf(stored);
  const bytes = rawBytes ?? frame?.content ?? 0;
  if (bytes > plainBytes + largestRatio * stored.length)
    fail(
      "input",
      `${place}: ${stored.length} compressed bytes claim to hold ${bytes}, more than ${plainBytes} and ${largestRatio} for each`
    );
  if (!frame || frame.content !== bytes)
    fail("input", `${place}: the compressed data does not hold ${bytes} bytes`);
  if (frame.window > largestWindow)
    fail("input", `${place}: its window is ${frame.window} bytes, more than ${largestWindow}`);
  const plain = new Uint8Array(bytes);
  let result;
  try {
    result = decompress(stored, plain);
  } catch {
    fail("input", `${place}: the compressed data is damaged`);
  }
  if (result.length !== bytes) fail("input", `${place}: decompresses to ${result.length} bytes instead of ${bytes}`);
  return plain;
}
function frameOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  if (bytes.length < 18 && bytes.length < 6) return void 0;
  if (view.getUint32(0, true) !== 4247762216) return void 0;
  const descriptor = bytes[4];
  const isSingle = (descriptor & 32) !== 0;
  let at = 5;
  let window = 0;
  if (!isSingle) {
    const exponent = bytes[at] >> 3;
    window = 2 ** (10 + exponent);
    window += window / 8 * (bytes[at] & 7);
    ++at;
  }
  at += [0, 1, 2, 4][descriptor & 3];
  const size2 = descriptor >> 6;
  let content;
  if (size2 === 0 && !isSingle) return void 0;
  if (at + [1, 2, 4, 8][size2] > bytes.length) return void 0;
  if (size2 === 0) content = bytes[at];
  else if (size2 === 1) content = view.getUint16(at, true) + 256;
  else if (size2 === 2) content = view.getUint32(at, true);
  else content = Number(view.getBigUint64(at, true));
  return { content, window: isSingle ? content : window };
}

// src/format/ground.ts
var groundVertexBytes = 28;
var largestSide = 16384;
var noImage = 4294967295;
async function bytesOf(container, name) {
  const chunk = container.find(name);
  return chunk ? container.bytes(chunk) : new Uint8Array(0);
}
function imagesOf(bytes, place) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const images = [];
  for (let at = 0; at < bytes.length; ) {
    if (bytes.length - at < 8) fail("input", `${place}: image ${images.length} has no size`);
    const width = view.getUint32(at, true);
    const height = view.getUint32(at + 4, true);
    at += 8;
    if (width === 0 || height === 0 || width > largestSide || height > largestSide)
      fail("input", `${place}: image ${images.length} is ${width}×${height}, outside 1 to ${largestSide}`);
    const size2 = 4 * width * height;
    if (size2 > bytes.length - at)
      fail("input", `${place}: image ${images.length} needs ${size2} bytes, ${bytes.length - at} are left`);
    images.push({ width, height, pixels: bytes.subarray(at, at + size2) });
    at += size2;
  }
  return images;
}
function verify(ground, place) {
  const { vertices, vertexCount, indices } = ground;
  const floats = new Float32Array(vertices.buffer, vertices.byteOffset, vertices.length / 4);
  for (let v = 0; v < vertexCount; ++v)
    for (const word of [0, 1, 2, 4, 5])
      if (!Number.isFinite(floats[7 * v + word]))
        fail("input", `${place}: ground vertex ${v} is not finite`);
  for (const index of indices)
    if (index >= vertexCount)
      fail("input", `${place}: ground index ${index} has no vertex; there are ${vertexCount}`);
  for (const range of ground.ranges) {
    if (range.material >= ground.materials.length)
      fail("input", `${place}: ground material ${range.material} is missing; there are ${ground.materials.length}`);
    if (range.indexCount % 3 !== 0 || range.firstIndex + range.indexCount > indices.length)
      fail(
        "input",
        `${place}: a ground range of ${range.indexCount} indices from ${range.firstIndex} does not fit into ${indices.length}`
      );
  }
  for (const material of ground.materials) {
    if (material.image >= ground.images.length)
      fail("input", `${place}: ground image ${material.image} is missing; there are ${ground.images.length}`);
    const isUnit = (x) => x >= 0 && x <= 1;
    if (!material.baseColor.every(Number.isFinite) || !isUnit(material.roughness) || !isUnit(material.metallic))
      fail("input", `${place}: a ground material is out of range`);
  }
}
async function readGround(container) {
  const place = container.source.name;
  const names = ["GVERTICE", "GINDICES", "GRANGES", "GMATERIA", "GIMAGES"];
  const [vertices, indexBytes, rangeBytes, materialBytes, imageBytes] = await Promise.all(
    names.map((name) => bytesOf(container, name))
  );
  const rangeWords = new Uint32Array(rangeBytes.buffer, 0, rangeBytes.length / 4);
  const ranges = [];
  for (let i = 0; i < rangeWords.length; i += 4)
    ranges.push({
      level: rangeWords[i],
      material: rangeWords[i + 1],
      firstIndex: rangeWords[i + 2],
      indexCount: rangeWords[i + 3]
    });
  const view = new DataView(materialBytes.buffer, 0, materialBytes.length);
  const materials = [];
  for (let at = 0; at < materialBytes.length; at += 32) {
    const float = (word) => view.getFloat32(at + 4 * word, true);
    const image = view.getUint32(at + 24, true);
    materials.push({
      baseColor: [float(0), float(1), float(2), float(3)],
      roughness: float(4),
      metallic: float(5),
      image: image === noImage ? -1 : image,
      isDoubleSided: (view.getUint32(at + 28, true) & 1) !== 0
    });
  }
  const ground = {
    vertices,
    vertexCount: vertices.length / groundVertexBytes,
    indices: new Uint32Array(indexBytes.buffer, 0, indexBytes.length / 4),
    ranges,
    materials,
    images: imagesOf(imageBytes, `${place}: ground images`)
  };
  verify(ground, place);
  return ground;
}

// src/format/seeds.ts
var facings = ["outward", "shared", "free"];
var longest = 1e6;
var farthestOrigin = 1e12;
var maxSpecies2 = 8;
function parseSeed(text, place) {
  if (!/^[0-9a-f]{1,16}$/i.test(text))
    fail("input", `${place}: "${text}" is not a number of up to 16 hexadecimal digits`);
  const digits = text.padStart(16, "0");
  return [parseInt(digits.slice(0, 8), 16), parseInt(digits.slice(8), 16)];
}
function parseSeedMeadow(text, place) {
  const reader = new SettingsReader(parseJson(text, place), place);
  const flag = (key) => {
    const value = reader.value(key) ?? false;
    if (typeof value !== "boolean") fail("input", `${place}: expected true or false, found ${JSON.stringify(value)}`);
    return value;
  };
  const meadow = {
    seed: parseSeed(reader.text("seed", ""), place),
    density: reader.number("density", 0, 0, 1e15),
    scale: reader.number("scale", 1, 1e-3, 1e5),
    clumpSpacing: reader.number("clump_spacing", 0, 0, 1e9),
    stored: reader.number("stored", 0, 0, 1),
    storedWidening: reader.number("stored_widening", 1, 1, 2),
    unitBits: reader.number("unit_bits", 20, 11, 24),
    levels: reader.number("levels", 0, 0, 10),
    isMixed: flag("mixed"),
    heightWaves: reader.number("height_waves", 0, 0, 0.5),
    drifts: reader.number("drifts", 0, 0, 1),
    sparseHeight: reader.number("sparse_height", 1, 0, 1),
    wideVariation: reader.number("wide_variation", 0, 0, 1),
    creaseReach: reader.number("crease_reach", 0, 0, longest),
    creaseBlend: reader.number("crease_blend", 0, 0, 1),
    vertical: reader.number("vertical", 0, 0, 1),
    isRadial: flag("radial"),
    up: reader.vector("up", [0, 1, 0], -farthestOrigin, farthestOrigin),
    highest: reader.number("highest", 1, 1e-9, longest),
    widest: reader.number("widest", 1, 1e-9, longest),
    species: reader.array("species").map((entry, i) => {
      const one = new SettingsReader(entry, `${place}: species ${i}`);
      const species = {
        share: one.number("share", 0, 0, 1),
        height: one.vector("height", [0, 0], 0, longest),
        width: one.vector("width", [0, 0], 0, longest),
        stiffness: one.vector("stiffness", [0, 0], 0, 1),
        clumping: one.number("clumping", 0, 0, 1),
        facing: one.word("facing", facings, 2),
        ribbons: one.number("ribbons", 0, 0, 63)
      };
      one.finish();
      return species;
    })
  };
  for (const key of ["unitBits", "levels"])
    if (!Number.isInteger(meadow[key])) fail("input", `${place}: ${meadow[key]} is not a whole number`);
  reader.finish();
  if (meadow.species.length === 0 || meadow.species.length > maxSpecies2)
    fail("input", `${place}: expected an array of 1 to ${maxSpecies2} species`);
  return meadow;
}
var entryBytes2 = 48;
var Seeds = class _Seeds {
  constructor(container, offset, meadow, entries) {
    this.container = container;
    this.offset = offset;
    this.meadow = meadow;
    this.entries = entries;
    this.count = entries.length / entryBytes2;
    this.view = new DataView(entries.buffer, entries.byteOffset, entries.length);
  }
  container;
  offset;
  meadow;
  entries;
  /** Numbers of cells. */
  count;
  view;
  /** The seeds of a field; undefined without any. */
  static async open(container, speciesCount) {
    const text = await container.text("SEEDS");
    if (text === void 0) return void 0;
    const place = container.source.name;
    const meadow = parseSeedMeadow(text, `${place}: seeds`);
    if (meadow.species.length !== speciesCount)
      fail("input", `${place}: the seeds have ${meadow.species.length} species, of ${speciesCount} that there are`);
    const data = container.need("SEEDDATA");
    const entries = await container.bytes(container.need("SEEDCELL"));
    const seeds = new _Seeds(container, data.offset, meadow, entries);
    seeds.verify(data.storedBytes, place);
    return seeds;
  }
  /** The zstd frame of a cell. */
  async frame(index) {
    const at = this.offset + this.number(index, 32);
    return (await this.container.source.read(at, at + this.number(index, 40))).slice();
  }
  number(index, at) {
    return Number(this.view.getBigUint64(index * entryBytes2 + at, true));
  }
  cell(index) {
    return [0, 4, 8].map((at) => this.view.getInt32(index * entryBytes2 + at, true));
  }
  verify(bytes, place) {
    let at = 0;
    for (let i = 0; i < this.count; ++i) {
      if (i > 0) {
        const [a, b] = [this.cell(i - 1), this.cell(i)];
        const axis = [0, 1, 2].find((k) => a[k] !== b[k]);
        if (axis === void 0 || a[axis] > b[axis])
          fail("input", `${place}: cell ${i} of the seeds is out of order`);
      }
      const [offset, size2] = [this.number(i, 32), this.number(i, 40)];
      if (offset !== at || size2 > bytes - at)
        fail("input", `${place}: cell ${i} of the seeds, ${size2} bytes at ${offset}, does not fit`);
      at += size2;
    }
    if (at !== bytes) fail("input", `${place}: bytes follow the last cell of the seeds`);
  }
};

// src/format/source.ts
var BufferSource = class {
  constructor(name, bytes) {
    this.name = name;
    this.bytes = bytes;
    this.size = bytes.length;
    this.received = bytes.length;
  }
  name;
  bytes;
  isWhole = true;
  size;
  received;
  async read(from, to) {
    return this.bytes.subarray(from, to);
  }
};
var firstBytes = 65536;
var RangeSource = class {
  constructor(name, size2, first, get) {
    this.name = name;
    this.size = size2;
    this.first = first;
    this.get = get;
    this.received = first.length;
  }
  name;
  size;
  first;
  get;
  isWhole = false;
  received;
  async read(from, to) {
    if (to <= this.first.length) return this.first.slice(from, to);
    const response = await this.get(from, to);
    if (response.status !== 206)
      fail("io", `${this.name}: status ${response.status} for bytes ${from} to ${to}, instead of 206`);
    const bytes = await bodyOf(response, this.name);
    this.received += bytes.length;
    if (bytes.length !== to - from)
      fail("io", `${this.name}: ${bytes.length} bytes of ${to - from} came: truncated`);
    return bytes;
  }
};
async function bodyOf(response, name) {
  try {
    return new Uint8Array(await response.arrayBuffer());
  } catch (error) {
    if (isAbort(error)) throw error;
    fail("io", `${name}: the connection ended before all bytes came`);
  }
}
async function bodyInParts(response, name, onProgress) {
  if (!onProgress || !response.body) return bodyOf(response, name);
  const total = Number(response.headers.get("content-length") ?? 0);
  const reader = response.body.getReader();
  const parts = [];
  let received = 0;
  try {
    for (; ; ) {
      const { done, value } = await reader.read();
      if (done) break;
      parts.push(value);
      received += value.length;
      onProgress(received, Math.max(total, received));
    }
  } catch (error) {
    if (isAbort(error)) throw error;
    fail("io", `${name}: the connection ended after ${received} bytes`);
  }
  const bytes = new Uint8Array(received);
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}
function isAbort(error) {
  return error instanceof Error && error.name === "AbortError" && !(error instanceof SwardError);
}
async function openSource(address, options = {}) {
  const doFetch = options.fetch ?? fetch;
  const get = async (range) => {
    try {
      return await doFetch(address, {
        headers: range ? { Range: range } : {},
        signal: options.signal ?? null
      });
    } catch (error) {
      if (isAbort(error)) throw error;
      fail("io", `${address}: no answer from the server`);
    }
  };
  const byRanges = options.ranges ?? true;
  const response = await get(byRanges ? `bytes=0-${firstBytes - 1}` : void 0);
  const total = /\/(\d+)$/.exec(response.headers.get("content-range") ?? "");
  if (response.status === 206 && total) {
    const first = await bodyOf(response, address);
    return new RangeSource(
      address,
      Number(total[1]),
      first,
      (from, to) => get(`bytes=${from}-${to - 1}`)
    );
  }
  if (response.status === 416) return new BufferSource(address, new Uint8Array(0));
  if (!response.ok) fail("io", `${address}: the server answers ${response.status}`);
  return new BufferSource(address, await bodyInParts(response, address, options.onProgress));
}

// src/format/field.ts
var pageBlades = 1024;
var pagesPerRequest = 256;
var Field = class _Field {
  constructor(container, bladeChunk, patches, species, defaults, ground, thinned, seeds) {
    this.container = container;
    this.bladeChunk = bladeChunk;
    this.patches = patches;
    this.species = species;
    this.defaults = defaults;
    this.ground = ground;
    this.thinned = thinned;
    this.seeds = seeds;
    this.name = container.source.name;
    this.origin = container.origin;
    this.version = container.version;
    this.bladeCount = bladeChunk.elementCount;
    this.pageCount = Math.ceil(this.bladeCount / pageBlades);
    this.packed = new Uint32Array(bladeWords * this.bladeCount);
    this.states = new Uint8Array(this.pageCount);
  }
  container;
  bladeChunk;
  patches;
  species;
  defaults;
  ground;
  thinned;
  seeds;
  /** Name or address of the file, for messages. */
  name;
  /** World position of the field's origin [m]: world = origin + position. */
  origin;
  version;
  bladeCount;
  pageCount;
  /** Packed blades, four words each; those of pages that are not here are 0. */
  packed;
  states;
  present = 0;
  keys;
  /** Reads all but the blades. */
  static async open(container) {
    const place = container.source.name;
    const bladeChunk = container.need("BLADES");
    if (bladeChunk.rawBytes !== bladeChunk.storedBytes)
      fail("unsupported", `${place}: chunk BLADES is compressed, which this version does not map`);
    container.need("SPECIES");
    container.need("DEFAULTS");
    const [patchBytes, species, defaults, cover, ground] = await Promise.all([
      container.bytes(container.need("PATCHES")),
      container.text("SPECIES"),
      container.text("DEFAULTS"),
      container.text("COVER"),
      readGround(container)
    ]);
    const patches = new Patches(patchBytes);
    patches.verify(bladeChunk.elementCount, place);
    const kinds2 = parseSpecies(species, `${place}: species`);
    return new _Field(
      container,
      bladeChunk,
      patches,
      kinds2,
      parseDefaults(defaults, `${place}: defaults`),
      ground,
      parseCover(cover, `${place}: cover`),
      await Seeds.open(container, kinds2.length)
    );
  }
  /** Whether the file says what bears. */
  get hasSeeds() {
    return this.seeds !== void 0;
  }
  /** Whether the rest of the meadow grows from seeds: some of its blades are stored, but not all. */
  get isSown() {
    const stored = this.seeds?.meadow.stored ?? 1;
    return this.bladeCount > 0 && stored > 0 && stored < 1;
  }
  /** Bytes received so far. */
  get received() {
    return this.container.source.received;
  }
  /** Pages that are here. */
  get presentPages() {
    return this.present;
  }
  /** Whether all blades are here. */
  get isComplete() {
    return this.present === this.pageCount;
  }
  /** Whether all blades from `first` on are here. */
  has(first, count) {
    if (count <= 0) return true;
    for (let p = Math.floor(first / pageBlades); p <= Math.floor((first + count - 1) / pageBlades); ++p)
      if (this.states[p] !== 2) return false;
    return true;
  }
  /** Whether a page is neither here nor under way. */
  isMissing(page) {
    return this.states[page] === 0;
  }
  /** Whether a blade is a ribbon on the stalk of a compound plant, without a root of its own. */
  isRibbon(blade) {
    const look = this.packed[bladeWords * blade + 3];
    return look >>> 24 > 0 && this.species[look >>> 21 & 7].organs.length > 0;
  }
  /**
   * Fetches pages `from` up to, not including, `to` that are neither here nor under way. Blades are checked; their
   * hash is checked when all are here, so that a damaged file is an error of the last page at the latest.
   */
  async loadPages(from, to) {
    const runs = [];
    for (let page = from; page < to; ++page) {
      if (this.states[page] !== 0) continue;
      this.states[page] = 1;
      const last = runs[runs.length - 1];
      if (last && last[1] === page && page - last[0] < pagesPerRequest) last[1] = page + 1;
      else runs.push([page, page + 1]);
    }
    await Promise.all(runs.map(([begin, end]) => this.loadRun(begin, end)));
  }
  /** Fetches all blades, and compares them with their hash. */
  async loadAll() {
    for (let page = 0; page < this.pageCount; page += pagesPerRequest)
      await this.loadPages(page, Math.min(page + pagesPerRequest, this.pageCount));
    if (this.pageCount === 0) await this.checkBlades();
  }
  /** Blades as arrays; all of them, or `count` from `first` on. They must be here. */
  blades(first = 0, count = this.bladeCount - first) {
    if (first < 0 || count < 0 || first + count > this.bladeCount)
      fail("usage", `${this.name}: blades ${first} to ${first + count} of ${this.bladeCount}`);
    if (!this.has(first, count))
      fail("usage", `${this.name}: some of the blades ${first} to ${first + count} are not loaded`);
    return unpackBlades(this.packed, this.patches, first, count);
  }
  /** The id of a blade, as in the CSV export. Call loadKeys() before. */
  idOf(blade) {
    return bladeId(this.keys ?? new Uint32Array(0), blade);
  }
  /** Fetches the origins of all blades, which only idOf() needs. */
  async loadKeys() {
    const chunk = this.container.find("KEYS");
    if (!chunk || this.keys) return;
    if (chunk.elementCount !== 0 && chunk.elementCount !== this.bladeCount)
      fail("input", `${this.name}: ${chunk.elementCount} keys for ${this.bladeCount} blades`);
    const bytes = await this.container.bytes(chunk);
    this.keys = new Uint32Array(bytes.buffer, 0, bytes.length / 4);
  }
  /** The JSON text of the file's provenance. */
  async provenance() {
    return await this.container.text("PROVENAN") ?? "{}";
  }
  /** Compares what only the whole file tells: the bytes between chunks, and chunks that are not drawn. */
  async verifyRest() {
    await this.container.checkPadding();
    for (const chunk of this.container.chunks) await this.container.bytes(chunk);
    await this.loadKeys();
  }
  async loadRun(begin, end) {
    const first = begin * pageBlades;
    const count = Math.min(end * pageBlades, this.bladeCount) - first;
    const from = this.bladeChunk.offset + 16 * first;
    let bytes;
    try {
      bytes = await this.container.source.read(from, from + 16 * count);
    } catch (error) {
      this.states.fill(0, begin, end);
      throw error;
    }
    new Uint8Array(this.packed.buffer).set(bytes, 16 * first);
    verifyBlades(this.packed, this.patches, this.species, first, count, this.name);
    this.states.fill(2, begin, end);
    this.present += end - begin;
    if (this.isComplete) await this.checkBlades();
  }
  async checkBlades() {
    await this.container.checkHash(this.bladeChunk, new Uint8Array(this.packed.buffer));
  }
};
async function readField(file, name = "field") {
  const bytes = file instanceof Uint8Array ? new Uint8Array(file.buffer, file.byteOffset, file.length) : new Uint8Array(file);
  const field = await Field.open(await Container.open(new BufferSource(name, bytes)));
  await field.loadAll();
  await field.verifyRest();
  return field;
}
async function openField(address, options = {}) {
  return Field.open(await Container.open(await openSource(address, options)));
}

// src/generated/layout.ts
var lodFullShare = 1 / 0.9;
var windNoise = 0;
var windWave = 2;
var windsAlike = 16777216;
var latticeX = 2654435761;
var latticeY = 2246822519;
var latticeZ = 3266489917;
var fineNoiseScale = 2.7;
var fineNoiseStart = 17.3;
var unsettledTurn = 2147516416;
var maxHeightCompensation = 1.3;
var outlineMost = 1.35;
var heightSteps = 16;
var bladeShadowTexels = 1024;
var bladeShadowSegments = 8;
var cullPatch = 1;
var cullOrientation = 2;
var cullFrustum = 4;
var cullDistance = 8;
var leaveThinned = 32;
var toneBits = 2147713024;
var shapeCount = 7;
var frameBytes = 2640;
var frameLayout = { "viewProjection": 0, "rays[0]": 64, "rays[1]": 80, "rays[2]": 96, "depthOfEye": 112, "view.planes[0]": 128, "view.planes[1]": 144, "view.planes[2]": 160, "view.planes[3]": 176, "view.planes[4]": 192, "view.planes[5]": 208, "view.eye": 224, "view.drawDistance": 236, "view.pixelsPerUnit": 240, "view.lodThreshold": 244, "view.lodWidth": 248, "view.minWidth": 252, "view.maxLeafArea": 256, "view.maxEdgeOn": 260, "view.samples": 264, "view.buckets": 268, "view.bucketDistance": 272, "view.cullMask": 276, "view.areaFactor": 280, "view.sparseFrom": 284, "view.sparseLeast": 288, "environment.gravity.direction": 304, "environment.gravity.strength": 316, "environment.gravity.attractor": 320, "environment.gravity.blend": 332, "environment.gravity.forward": 336, "environment.recovery": 352, "environment.colliderCount": 356, "environment.wind.counts": 368, "environment.wind.eddySize": 372, "environment.wind.eddySpeed": 376, "environment.wind.sum": 380, "environment.wind.eddyPhase": 384, "environment.wind.lattice.origin": 400, "environment.wind.lattice.x": 416, "environment.wind.lattice.y": 432, "environment.wind.lattice.z": 448, "environment.wind.sources[0].direction": 464, "environment.wind.sources[0].strength": 476, "environment.wind.sources[0].centre": 480, "environment.wind.sources[0].size": 492, "environment.wind.sources[0].speed": 496, "environment.wind.sources[0].rate": 500, "environment.wind.sources[0].turn": 504, "environment.wind.sources[0].alignment": 508, "environment.wind.sources[0].lift": 512, "environment.wind.sources[0].kind": 516, "environment.wind.sources[0].side": 528, "environment.wind.sources[0].perSize": 540, "environment.wind.sources[1].direction": 544, "environment.wind.sources[1].strength": 556, "environment.wind.sources[1].centre": 560, "environment.wind.sources[1].size": 572, "environment.wind.sources[1].speed": 576, "environment.wind.sources[1].rate": 580, "environment.wind.sources[1].turn": 584, "environment.wind.sources[1].alignment": 588, "environment.wind.sources[1].lift": 592, "environment.wind.sources[1].kind": 596, "environment.wind.sources[1].side": 608, "environment.wind.sources[1].perSize": 620, "environment.wind.sources[2].direction": 624, "environment.wind.sources[2].strength": 636, "environment.wind.sources[2].centre": 640, "environment.wind.sources[2].size": 652, "environment.wind.sources[2].speed": 656, "environment.wind.sources[2].rate": 660, "environment.wind.sources[2].turn": 664, "environment.wind.sources[2].alignment": 668, "environment.wind.sources[2].lift": 672, "environment.wind.sources[2].kind": 676, "environment.wind.sources[2].side": 688, "environment.wind.sources[2].perSize": 700, "environment.wind.sources[3].direction": 704, "environment.wind.sources[3].strength": 716, "environment.wind.sources[3].centre": 720, "environment.wind.sources[3].size": 732, "environment.wind.sources[3].speed": 736, "environment.wind.sources[3].rate": 740, "environment.wind.sources[3].turn": 744, "environment.wind.sources[3].alignment": 748, "environment.wind.sources[3].lift": 752, "environment.wind.sources[3].kind": 756, "environment.wind.sources[3].side": 768, "environment.wind.sources[3].perSize": 780, "environment.wind.sources[4].direction": 784, "environment.wind.sources[4].strength": 796, "environment.wind.sources[4].centre": 800, "environment.wind.sources[4].size": 812, "environment.wind.sources[4].speed": 816, "environment.wind.sources[4].rate": 820, "environment.wind.sources[4].turn": 824, "environment.wind.sources[4].alignment": 828, "environment.wind.sources[4].lift": 832, "environment.wind.sources[4].kind": 836, "environment.wind.sources[4].side": 848, "environment.wind.sources[4].perSize": 860, "environment.wind.sources[5].direction": 864, "environment.wind.sources[5].strength": 876, "environment.wind.sources[5].centre": 880, "environment.wind.sources[5].size": 892, "environment.wind.sources[5].speed": 896, "environment.wind.sources[5].rate": 900, "environment.wind.sources[5].turn": 904, "environment.wind.sources[5].alignment": 908, "environment.wind.sources[5].lift": 912, "environment.wind.sources[5].kind": 916, "environment.wind.sources[5].side": 928, "environment.wind.sources[5].perSize": 940, "environment.wind.sources[6].direction": 944, "environment.wind.sources[6].strength": 956, "environment.wind.sources[6].centre": 960, "environment.wind.sources[6].size": 972, "environment.wind.sources[6].speed": 976, "environment.wind.sources[6].rate": 980, "environment.wind.sources[6].turn": 984, "environment.wind.sources[6].alignment": 988, "environment.wind.sources[6].lift": 992, "environment.wind.sources[6].kind": 996, "environment.wind.sources[6].side": 1008, "environment.wind.sources[6].perSize": 1020, "environment.wind.sources[7].direction": 1024, "environment.wind.sources[7].strength": 1036, "environment.wind.sources[7].centre": 1040, "environment.wind.sources[7].size": 1052, "environment.wind.sources[7].speed": 1056, "environment.wind.sources[7].rate": 1060, "environment.wind.sources[7].turn": 1064, "environment.wind.sources[7].alignment": 1068, "environment.wind.sources[7].lift": 1072, "environment.wind.sources[7].kind": 1076, "environment.wind.sources[7].side": 1088, "environment.wind.sources[7].perSize": 1100, "environment.wind.phases[0].shift": 1104, "environment.wind.phases[0].cell": 1116, "environment.wind.phases[0].fineShift": 1120, "environment.wind.phases[0].fineCell": 1132, "environment.wind.phases[0].angle": 1136, "environment.wind.phases[0].turned": 1140, "environment.wind.phases[1].shift": 1152, "environment.wind.phases[1].cell": 1164, "environment.wind.phases[1].fineShift": 1168, "environment.wind.phases[1].fineCell": 1180, "environment.wind.phases[1].angle": 1184, "environment.wind.phases[1].turned": 1188, "environment.wind.phases[2].shift": 1200, "environment.wind.phases[2].cell": 1212, "environment.wind.phases[2].fineShift": 1216, "environment.wind.phases[2].fineCell": 1228, "environment.wind.phases[2].angle": 1232, "environment.wind.phases[2].turned": 1236, "environment.wind.phases[3].shift": 1248, "environment.wind.phases[3].cell": 1260, "environment.wind.phases[3].fineShift": 1264, "environment.wind.phases[3].fineCell": 1276, "environment.wind.phases[3].angle": 1280, "environment.wind.phases[3].turned": 1284, "environment.wind.phases[4].shift": 1296, "environment.wind.phases[4].cell": 1308, "environment.wind.phases[4].fineShift": 1312, "environment.wind.phases[4].fineCell": 1324, "environment.wind.phases[4].angle": 1328, "environment.wind.phases[4].turned": 1332, "environment.wind.phases[5].shift": 1344, "environment.wind.phases[5].cell": 1356, "environment.wind.phases[5].fineShift": 1360, "environment.wind.phases[5].fineCell": 1372, "environment.wind.phases[5].angle": 1376, "environment.wind.phases[5].turned": 1380, "environment.wind.phases[6].shift": 1392, "environment.wind.phases[6].cell": 1404, "environment.wind.phases[6].fineShift": 1408, "environment.wind.phases[6].fineCell": 1420, "environment.wind.phases[6].angle": 1424, "environment.wind.phases[6].turned": 1428, "environment.wind.phases[7].shift": 1440, "environment.wind.phases[7].cell": 1452, "environment.wind.phases[7].fineShift": 1456, "environment.wind.phases[7].fineCell": 1468, "environment.wind.phases[7].angle": 1472, "environment.wind.phases[7].turned": 1476, "patchCount": 1488, "bladeCount": 1492, "visibleCapacity": 1496, "maxTessellation": 1500, "sunDirection": 1504, "exposure": 1516, "sunColor": 1520, "debugMode": 1532, "skyColor": 1536, "fogDensity": 1548, "groundColor": 1552, "skyUp": 1568, "fixedTessellation": 1580, "clouds": 1584, "levelSteps.distance": 1600, "levelSteps.segments": 1616, "levelSteps.count": 1632, "updateRate.everyFrame": 1648, "updateRate.everyThird": 1652, "updateRate.longest": 1656, "updateRate.frame": 1660, "cover.low": 1664, "cover.cellsPerMetre": 1676, "cover.countX": 1680, "cover.countY": 1684, "cover.countZ": 1688, "cover.farthest": 1692, "cover.undergrowth": 1696, "cover.thatch": 1708, "cover.sward": 1712, "cover.thinned": 1724, "cover.structure": 1728, "cover.stepsPerMetre": 1732, "cover.leaves[0]": 1744, "cover.leaves[1]": 1760, "cover.leaves[2]": 1776, "cover.leaves[3]": 1792, "cover.leaves[4]": 1808, "cover.leaves[5]": 1824, "cover.leaves[6]": 1840, "cover.leaves[7]": 1856, "shadow.across": 1872, "shadow.down": 1888, "shadow.depth": 1904, "shadow.size": 1920, "shadow.texel": 1924, "shadow.epsilon": 1928, "shadow.reserved": 1932, "bladeShadow.across": 1936, "bladeShadow.down": 1952, "bladeShadow.depth": 1968, "bladeShadow.size": 1984, "bladeShadow.nearer": 1988, "fogFalloff": 2e3, "lowSun": 2004, "tick": 2008, "floorPlane.middle": 2016, "floorPlane.reach": 2028, "floorPlane.along": 2032, "floorPlane.height": 2044, "floorPlane.halfSides": 2048, "floorPlane.cornerRadius": 2056, "reserved[0]": 2064, "reserved[1]": 2080, "reserved[2]": 2096, "reserved[3]": 2112, "reserved[4]": 2128, "reserved[5]": 2144, "reserved[6]": 2160, "reserved[7]": 2176, "reserved[8]": 2192, "reserved[9]": 2208, "reserved[10]": 2224, "reserved[11]": 2240, "reserved[12]": 2256, "reserved[13]": 2272, "reserved[14]": 2288, "reserved[15]": 2304, "reserved[16]": 2320, "reserved[17]": 2336, "reserved[18]": 2352, "reserved[19]": 2368, "reserved[20]": 2384, "reserved[21]": 2400, "reserved[22]": 2416, "reserved[23]": 2432, "reserved[24]": 2448, "reserved[25]": 2464, "reserved[26]": 2480, "reserved[27]": 2496, "reserved[28]": 2512, "reserved[29]": 2528, "reserved[30]": 2544, "reserved[31]": 2560, "reserved[32]": 2576, "reserved[33]": 2592, "reserved[34]": 2608, "reserved[35]": 2624 };
var looksBytes = 4608;
var looksLayout = { "species[0].rootColor": 0, "species[0].tipThreshold": 12, "species[0].tipColor": 16, "species[0].groundTint": 28, "species[0].colorVariation": 32, "species[0].translucency": 36, "species[0].gloss": 40, "species[0].dryness": 44, "species[0].shape": 48, "species[0].fold": 52, "species[0].firstOrgan": 56, "species[0].organKinds": 60, "species[1].rootColor": 64, "species[1].tipThreshold": 76, "species[1].tipColor": 80, "species[1].groundTint": 92, "species[1].colorVariation": 96, "species[1].translucency": 100, "species[1].gloss": 104, "species[1].dryness": 108, "species[1].shape": 112, "species[1].fold": 116, "species[1].firstOrgan": 120, "species[1].organKinds": 124, "species[2].rootColor": 128, "species[2].tipThreshold": 140, "species[2].tipColor": 144, "species[2].groundTint": 156, "species[2].colorVariation": 160, "species[2].translucency": 164, "species[2].gloss": 168, "species[2].dryness": 172, "species[2].shape": 176, "species[2].fold": 180, "species[2].firstOrgan": 184, "species[2].organKinds": 188, "species[3].rootColor": 192, "species[3].tipThreshold": 204, "species[3].tipColor": 208, "species[3].groundTint": 220, "species[3].colorVariation": 224, "species[3].translucency": 228, "species[3].gloss": 232, "species[3].dryness": 236, "species[3].shape": 240, "species[3].fold": 244, "species[3].firstOrgan": 248, "species[3].organKinds": 252, "species[4].rootColor": 256, "species[4].tipThreshold": 268, "species[4].tipColor": 272, "species[4].groundTint": 284, "species[4].colorVariation": 288, "species[4].translucency": 292, "species[4].gloss": 296, "species[4].dryness": 300, "species[4].shape": 304, "species[4].fold": 308, "species[4].firstOrgan": 312, "species[4].organKinds": 316, "species[5].rootColor": 320, "species[5].tipThreshold": 332, "species[5].tipColor": 336, "species[5].groundTint": 348, "species[5].colorVariation": 352, "species[5].translucency": 356, "species[5].gloss": 360, "species[5].dryness": 364, "species[5].shape": 368, "species[5].fold": 372, "species[5].firstOrgan": 376, "species[5].organKinds": 380, "species[6].rootColor": 384, "species[6].tipThreshold": 396, "species[6].tipColor": 400, "species[6].groundTint": 412, "species[6].colorVariation": 416, "species[6].translucency": 420, "species[6].gloss": 424, "species[6].dryness": 428, "species[6].shape": 432, "species[6].fold": 436, "species[6].firstOrgan": 440, "species[6].organKinds": 444, "species[7].rootColor": 448, "species[7].tipThreshold": 460, "species[7].tipColor": 464, "species[7].groundTint": 476, "species[7].colorVariation": 480, "species[7].translucency": 484, "species[7].gloss": 488, "species[7].dryness": 492, "species[7].shape": 496, "species[7].fold": 500, "species[7].firstOrgan": 504, "species[7].organKinds": 508, "organs[0].look.rootColor": 512, "organs[0].look.tipThreshold": 524, "organs[0].look.tipColor": 528, "organs[0].look.groundTint": 540, "organs[0].look.colorVariation": 544, "organs[0].look.translucency": 548, "organs[0].look.gloss": 552, "organs[0].look.dryness": 556, "organs[0].look.shape": 560, "organs[0].look.fold": 564, "organs[0].look.firstOrgan": 568, "organs[0].look.organKinds": 572, "organs[0].count": 576, "organs[0].place": 584, "organs[0].pitch": 592, "organs[0].size": 600, "organs[0].width": 608, "organs[0].azimuth": 612, "organs[0].turn": 616, "organs[0].bend": 620, "organs[0].leg": 624, "organs[0].variation": 628, "organs[1].look.rootColor": 640, "organs[1].look.tipThreshold": 652, "organs[1].look.tipColor": 656, "organs[1].look.groundTint": 668, "organs[1].look.colorVariation": 672, "organs[1].look.translucency": 676, "organs[1].look.gloss": 680, "organs[1].look.dryness": 684, "organs[1].look.shape": 688, "organs[1].look.fold": 692, "organs[1].look.firstOrgan": 696, "organs[1].look.organKinds": 700, "organs[1].count": 704, "organs[1].place": 712, "organs[1].pitch": 720, "organs[1].size": 728, "organs[1].width": 736, "organs[1].azimuth": 740, "organs[1].turn": 744, "organs[1].bend": 748, "organs[1].leg": 752, "organs[1].variation": 756, "organs[2].look.rootColor": 768, "organs[2].look.tipThreshold": 780, "organs[2].look.tipColor": 784, "organs[2].look.groundTint": 796, "organs[2].look.colorVariation": 800, "organs[2].look.translucency": 804, "organs[2].look.gloss": 808, "organs[2].look.dryness": 812, "organs[2].look.shape": 816, "organs[2].look.fold": 820, "organs[2].look.firstOrgan": 824, "organs[2].look.organKinds": 828, "organs[2].count": 832, "organs[2].place": 840, "organs[2].pitch": 848, "organs[2].size": 856, "organs[2].width": 864, "organs[2].azimuth": 868, "organs[2].turn": 872, "organs[2].bend": 876, "organs[2].leg": 880, "organs[2].variation": 884, "organs[3].look.rootColor": 896, "organs[3].look.tipThreshold": 908, "organs[3].look.tipColor": 912, "organs[3].look.groundTint": 924, "organs[3].look.colorVariation": 928, "organs[3].look.translucency": 932, "organs[3].look.gloss": 936, "organs[3].look.dryness": 940, "organs[3].look.shape": 944, "organs[3].look.fold": 948, "organs[3].look.firstOrgan": 952, "organs[3].look.organKinds": 956, "organs[3].count": 960, "organs[3].place": 968, "organs[3].pitch": 976, "organs[3].size": 984, "organs[3].width": 992, "organs[3].azimuth": 996, "organs[3].turn": 1e3, "organs[3].bend": 1004, "organs[3].leg": 1008, "organs[3].variation": 1012, "organs[4].look.rootColor": 1024, "organs[4].look.tipThreshold": 1036, "organs[4].look.tipColor": 1040, "organs[4].look.groundTint": 1052, "organs[4].look.colorVariation": 1056, "organs[4].look.translucency": 1060, "organs[4].look.gloss": 1064, "organs[4].look.dryness": 1068, "organs[4].look.shape": 1072, "organs[4].look.fold": 1076, "organs[4].look.firstOrgan": 1080, "organs[4].look.organKinds": 1084, "organs[4].count": 1088, "organs[4].place": 1096, "organs[4].pitch": 1104, "organs[4].size": 1112, "organs[4].width": 1120, "organs[4].azimuth": 1124, "organs[4].turn": 1128, "organs[4].bend": 1132, "organs[4].leg": 1136, "organs[4].variation": 1140, "organs[5].look.rootColor": 1152, "organs[5].look.tipThreshold": 1164, "organs[5].look.tipColor": 1168, "organs[5].look.groundTint": 1180, "organs[5].look.colorVariation": 1184, "organs[5].look.translucency": 1188, "organs[5].look.gloss": 1192, "organs[5].look.dryness": 1196, "organs[5].look.shape": 1200, "organs[5].look.fold": 1204, "organs[5].look.firstOrgan": 1208, "organs[5].look.organKinds": 1212, "organs[5].count": 1216, "organs[5].place": 1224, "organs[5].pitch": 1232, "organs[5].size": 1240, "organs[5].width": 1248, "organs[5].azimuth": 1252, "organs[5].turn": 1256, "organs[5].bend": 1260, "organs[5].leg": 1264, "organs[5].variation": 1268, "organs[6].look.rootColor": 1280, "organs[6].look.tipThreshold": 1292, "organs[6].look.tipColor": 1296, "organs[6].look.groundTint": 1308, "organs[6].look.colorVariation": 1312, "organs[6].look.translucency": 1316, "organs[6].look.gloss": 1320, "organs[6].look.dryness": 1324, "organs[6].look.shape": 1328, "organs[6].look.fold": 1332, "organs[6].look.firstOrgan": 1336, "organs[6].look.organKinds": 1340, "organs[6].count": 1344, "organs[6].place": 1352, "organs[6].pitch": 1360, "organs[6].size": 1368, "organs[6].width": 1376, "organs[6].azimuth": 1380, "organs[6].turn": 1384, "organs[6].bend": 1388, "organs[6].leg": 1392, "organs[6].variation": 1396, "organs[7].look.rootColor": 1408, "organs[7].look.tipThreshold": 1420, "organs[7].look.tipColor": 1424, "organs[7].look.groundTint": 1436, "organs[7].look.colorVariation": 1440, "organs[7].look.translucency": 1444, "organs[7].look.gloss": 1448, "organs[7].look.dryness": 1452, "organs[7].look.shape": 1456, "organs[7].look.fold": 1460, "organs[7].look.firstOrgan": 1464, "organs[7].look.organKinds": 1468, "organs[7].count": 1472, "organs[7].place": 1480, "organs[7].pitch": 1488, "organs[7].size": 1496, "organs[7].width": 1504, "organs[7].azimuth": 1508, "organs[7].turn": 1512, "organs[7].bend": 1516, "organs[7].leg": 1520, "organs[7].variation": 1524, "organs[8].look.rootColor": 1536, "organs[8].look.tipThreshold": 1548, "organs[8].look.tipColor": 1552, "organs[8].look.groundTint": 1564, "organs[8].look.colorVariation": 1568, "organs[8].look.translucency": 1572, "organs[8].look.gloss": 1576, "organs[8].look.dryness": 1580, "organs[8].look.shape": 1584, "organs[8].look.fold": 1588, "organs[8].look.firstOrgan": 1592, "organs[8].look.organKinds": 1596, "organs[8].count": 1600, "organs[8].place": 1608, "organs[8].pitch": 1616, "organs[8].size": 1624, "organs[8].width": 1632, "organs[8].azimuth": 1636, "organs[8].turn": 1640, "organs[8].bend": 1644, "organs[8].leg": 1648, "organs[8].variation": 1652, "organs[9].look.rootColor": 1664, "organs[9].look.tipThreshold": 1676, "organs[9].look.tipColor": 1680, "organs[9].look.groundTint": 1692, "organs[9].look.colorVariation": 1696, "organs[9].look.translucency": 1700, "organs[9].look.gloss": 1704, "organs[9].look.dryness": 1708, "organs[9].look.shape": 1712, "organs[9].look.fold": 1716, "organs[9].look.firstOrgan": 1720, "organs[9].look.organKinds": 1724, "organs[9].count": 1728, "organs[9].place": 1736, "organs[9].pitch": 1744, "organs[9].size": 1752, "organs[9].width": 1760, "organs[9].azimuth": 1764, "organs[9].turn": 1768, "organs[9].bend": 1772, "organs[9].leg": 1776, "organs[9].variation": 1780, "organs[10].look.rootColor": 1792, "organs[10].look.tipThreshold": 1804, "organs[10].look.tipColor": 1808, "organs[10].look.groundTint": 1820, "organs[10].look.colorVariation": 1824, "organs[10].look.translucency": 1828, "organs[10].look.gloss": 1832, "organs[10].look.dryness": 1836, "organs[10].look.shape": 1840, "organs[10].look.fold": 1844, "organs[10].look.firstOrgan": 1848, "organs[10].look.organKinds": 1852, "organs[10].count": 1856, "organs[10].place": 1864, "organs[10].pitch": 1872, "organs[10].size": 1880, "organs[10].width": 1888, "organs[10].azimuth": 1892, "organs[10].turn": 1896, "organs[10].bend": 1900, "organs[10].leg": 1904, "organs[10].variation": 1908, "organs[11].look.rootColor": 1920, "organs[11].look.tipThreshold": 1932, "organs[11].look.tipColor": 1936, "organs[11].look.groundTint": 1948, "organs[11].look.colorVariation": 1952, "organs[11].look.translucency": 1956, "organs[11].look.gloss": 1960, "organs[11].look.dryness": 1964, "organs[11].look.shape": 1968, "organs[11].look.fold": 1972, "organs[11].look.firstOrgan": 1976, "organs[11].look.organKinds": 1980, "organs[11].count": 1984, "organs[11].place": 1992, "organs[11].pitch": 2e3, "organs[11].size": 2008, "organs[11].width": 2016, "organs[11].azimuth": 2020, "organs[11].turn": 2024, "organs[11].bend": 2028, "organs[11].leg": 2032, "organs[11].variation": 2036, "organs[12].look.rootColor": 2048, "organs[12].look.tipThreshold": 2060, "organs[12].look.tipColor": 2064, "organs[12].look.groundTint": 2076, "organs[12].look.colorVariation": 2080, "organs[12].look.translucency": 2084, "organs[12].look.gloss": 2088, "organs[12].look.dryness": 2092, "organs[12].look.shape": 2096, "organs[12].look.fold": 2100, "organs[12].look.firstOrgan": 2104, "organs[12].look.organKinds": 2108, "organs[12].count": 2112, "organs[12].place": 2120, "organs[12].pitch": 2128, "organs[12].size": 2136, "organs[12].width": 2144, "organs[12].azimuth": 2148, "organs[12].turn": 2152, "organs[12].bend": 2156, "organs[12].leg": 2160, "organs[12].variation": 2164, "organs[13].look.rootColor": 2176, "organs[13].look.tipThreshold": 2188, "organs[13].look.tipColor": 2192, "organs[13].look.groundTint": 2204, "organs[13].look.colorVariation": 2208, "organs[13].look.translucency": 2212, "organs[13].look.gloss": 2216, "organs[13].look.dryness": 2220, "organs[13].look.shape": 2224, "organs[13].look.fold": 2228, "organs[13].look.firstOrgan": 2232, "organs[13].look.organKinds": 2236, "organs[13].count": 2240, "organs[13].place": 2248, "organs[13].pitch": 2256, "organs[13].size": 2264, "organs[13].width": 2272, "organs[13].azimuth": 2276, "organs[13].turn": 2280, "organs[13].bend": 2284, "organs[13].leg": 2288, "organs[13].variation": 2292, "organs[14].look.rootColor": 2304, "organs[14].look.tipThreshold": 2316, "organs[14].look.tipColor": 2320, "organs[14].look.groundTint": 2332, "organs[14].look.colorVariation": 2336, "organs[14].look.translucency": 2340, "organs[14].look.gloss": 2344, "organs[14].look.dryness": 2348, "organs[14].look.shape": 2352, "organs[14].look.fold": 2356, "organs[14].look.firstOrgan": 2360, "organs[14].look.organKinds": 2364, "organs[14].count": 2368, "organs[14].place": 2376, "organs[14].pitch": 2384, "organs[14].size": 2392, "organs[14].width": 2400, "organs[14].azimuth": 2404, "organs[14].turn": 2408, "organs[14].bend": 2412, "organs[14].leg": 2416, "organs[14].variation": 2420, "organs[15].look.rootColor": 2432, "organs[15].look.tipThreshold": 2444, "organs[15].look.tipColor": 2448, "organs[15].look.groundTint": 2460, "organs[15].look.colorVariation": 2464, "organs[15].look.translucency": 2468, "organs[15].look.gloss": 2472, "organs[15].look.dryness": 2476, "organs[15].look.shape": 2480, "organs[15].look.fold": 2484, "organs[15].look.firstOrgan": 2488, "organs[15].look.organKinds": 2492, "organs[15].count": 2496, "organs[15].place": 2504, "organs[15].pitch": 2512, "organs[15].size": 2520, "organs[15].width": 2528, "organs[15].azimuth": 2532, "organs[15].turn": 2536, "organs[15].bend": 2540, "organs[15].leg": 2544, "organs[15].variation": 2548, "organs[16].look.rootColor": 2560, "organs[16].look.tipThreshold": 2572, "organs[16].look.tipColor": 2576, "organs[16].look.groundTint": 2588, "organs[16].look.colorVariation": 2592, "organs[16].look.translucency": 2596, "organs[16].look.gloss": 2600, "organs[16].look.dryness": 2604, "organs[16].look.shape": 2608, "organs[16].look.fold": 2612, "organs[16].look.firstOrgan": 2616, "organs[16].look.organKinds": 2620, "organs[16].count": 2624, "organs[16].place": 2632, "organs[16].pitch": 2640, "organs[16].size": 2648, "organs[16].width": 2656, "organs[16].azimuth": 2660, "organs[16].turn": 2664, "organs[16].bend": 2668, "organs[16].leg": 2672, "organs[16].variation": 2676, "organs[17].look.rootColor": 2688, "organs[17].look.tipThreshold": 2700, "organs[17].look.tipColor": 2704, "organs[17].look.groundTint": 2716, "organs[17].look.colorVariation": 2720, "organs[17].look.translucency": 2724, "organs[17].look.gloss": 2728, "organs[17].look.dryness": 2732, "organs[17].look.shape": 2736, "organs[17].look.fold": 2740, "organs[17].look.firstOrgan": 2744, "organs[17].look.organKinds": 2748, "organs[17].count": 2752, "organs[17].place": 2760, "organs[17].pitch": 2768, "organs[17].size": 2776, "organs[17].width": 2784, "organs[17].azimuth": 2788, "organs[17].turn": 2792, "organs[17].bend": 2796, "organs[17].leg": 2800, "organs[17].variation": 2804, "organs[18].look.rootColor": 2816, "organs[18].look.tipThreshold": 2828, "organs[18].look.tipColor": 2832, "organs[18].look.groundTint": 2844, "organs[18].look.colorVariation": 2848, "organs[18].look.translucency": 2852, "organs[18].look.gloss": 2856, "organs[18].look.dryness": 2860, "organs[18].look.shape": 2864, "organs[18].look.fold": 2868, "organs[18].look.firstOrgan": 2872, "organs[18].look.organKinds": 2876, "organs[18].count": 2880, "organs[18].place": 2888, "organs[18].pitch": 2896, "organs[18].size": 2904, "organs[18].width": 2912, "organs[18].azimuth": 2916, "organs[18].turn": 2920, "organs[18].bend": 2924, "organs[18].leg": 2928, "organs[18].variation": 2932, "organs[19].look.rootColor": 2944, "organs[19].look.tipThreshold": 2956, "organs[19].look.tipColor": 2960, "organs[19].look.groundTint": 2972, "organs[19].look.colorVariation": 2976, "organs[19].look.translucency": 2980, "organs[19].look.gloss": 2984, "organs[19].look.dryness": 2988, "organs[19].look.shape": 2992, "organs[19].look.fold": 2996, "organs[19].look.firstOrgan": 3e3, "organs[19].look.organKinds": 3004, "organs[19].count": 3008, "organs[19].place": 3016, "organs[19].pitch": 3024, "organs[19].size": 3032, "organs[19].width": 3040, "organs[19].azimuth": 3044, "organs[19].turn": 3048, "organs[19].bend": 3052, "organs[19].leg": 3056, "organs[19].variation": 3060, "organs[20].look.rootColor": 3072, "organs[20].look.tipThreshold": 3084, "organs[20].look.tipColor": 3088, "organs[20].look.groundTint": 3100, "organs[20].look.colorVariation": 3104, "organs[20].look.translucency": 3108, "organs[20].look.gloss": 3112, "organs[20].look.dryness": 3116, "organs[20].look.shape": 3120, "organs[20].look.fold": 3124, "organs[20].look.firstOrgan": 3128, "organs[20].look.organKinds": 3132, "organs[20].count": 3136, "organs[20].place": 3144, "organs[20].pitch": 3152, "organs[20].size": 3160, "organs[20].width": 3168, "organs[20].azimuth": 3172, "organs[20].turn": 3176, "organs[20].bend": 3180, "organs[20].leg": 3184, "organs[20].variation": 3188, "organs[21].look.rootColor": 3200, "organs[21].look.tipThreshold": 3212, "organs[21].look.tipColor": 3216, "organs[21].look.groundTint": 3228, "organs[21].look.colorVariation": 3232, "organs[21].look.translucency": 3236, "organs[21].look.gloss": 3240, "organs[21].look.dryness": 3244, "organs[21].look.shape": 3248, "organs[21].look.fold": 3252, "organs[21].look.firstOrgan": 3256, "organs[21].look.organKinds": 3260, "organs[21].count": 3264, "organs[21].place": 3272, "organs[21].pitch": 3280, "organs[21].size": 3288, "organs[21].width": 3296, "organs[21].azimuth": 3300, "organs[21].turn": 3304, "organs[21].bend": 3308, "organs[21].leg": 3312, "organs[21].variation": 3316, "organs[22].look.rootColor": 3328, "organs[22].look.tipThreshold": 3340, "organs[22].look.tipColor": 3344, "organs[22].look.groundTint": 3356, "organs[22].look.colorVariation": 3360, "organs[22].look.translucency": 3364, "organs[22].look.gloss": 3368, "organs[22].look.dryness": 3372, "organs[22].look.shape": 3376, "organs[22].look.fold": 3380, "organs[22].look.firstOrgan": 3384, "organs[22].look.organKinds": 3388, "organs[22].count": 3392, "organs[22].place": 3400, "organs[22].pitch": 3408, "organs[22].size": 3416, "organs[22].width": 3424, "organs[22].azimuth": 3428, "organs[22].turn": 3432, "organs[22].bend": 3436, "organs[22].leg": 3440, "organs[22].variation": 3444, "organs[23].look.rootColor": 3456, "organs[23].look.tipThreshold": 3468, "organs[23].look.tipColor": 3472, "organs[23].look.groundTint": 3484, "organs[23].look.colorVariation": 3488, "organs[23].look.translucency": 3492, "organs[23].look.gloss": 3496, "organs[23].look.dryness": 3500, "organs[23].look.shape": 3504, "organs[23].look.fold": 3508, "organs[23].look.firstOrgan": 3512, "organs[23].look.organKinds": 3516, "organs[23].count": 3520, "organs[23].place": 3528, "organs[23].pitch": 3536, "organs[23].size": 3544, "organs[23].width": 3552, "organs[23].azimuth": 3556, "organs[23].turn": 3560, "organs[23].bend": 3564, "organs[23].leg": 3568, "organs[23].variation": 3572, "organs[24].look.rootColor": 3584, "organs[24].look.tipThreshold": 3596, "organs[24].look.tipColor": 3600, "organs[24].look.groundTint": 3612, "organs[24].look.colorVariation": 3616, "organs[24].look.translucency": 3620, "organs[24].look.gloss": 3624, "organs[24].look.dryness": 3628, "organs[24].look.shape": 3632, "organs[24].look.fold": 3636, "organs[24].look.firstOrgan": 3640, "organs[24].look.organKinds": 3644, "organs[24].count": 3648, "organs[24].place": 3656, "organs[24].pitch": 3664, "organs[24].size": 3672, "organs[24].width": 3680, "organs[24].azimuth": 3684, "organs[24].turn": 3688, "organs[24].bend": 3692, "organs[24].leg": 3696, "organs[24].variation": 3700, "organs[25].look.rootColor": 3712, "organs[25].look.tipThreshold": 3724, "organs[25].look.tipColor": 3728, "organs[25].look.groundTint": 3740, "organs[25].look.colorVariation": 3744, "organs[25].look.translucency": 3748, "organs[25].look.gloss": 3752, "organs[25].look.dryness": 3756, "organs[25].look.shape": 3760, "organs[25].look.fold": 3764, "organs[25].look.firstOrgan": 3768, "organs[25].look.organKinds": 3772, "organs[25].count": 3776, "organs[25].place": 3784, "organs[25].pitch": 3792, "organs[25].size": 3800, "organs[25].width": 3808, "organs[25].azimuth": 3812, "organs[25].turn": 3816, "organs[25].bend": 3820, "organs[25].leg": 3824, "organs[25].variation": 3828, "organs[26].look.rootColor": 3840, "organs[26].look.tipThreshold": 3852, "organs[26].look.tipColor": 3856, "organs[26].look.groundTint": 3868, "organs[26].look.colorVariation": 3872, "organs[26].look.translucency": 3876, "organs[26].look.gloss": 3880, "organs[26].look.dryness": 3884, "organs[26].look.shape": 3888, "organs[26].look.fold": 3892, "organs[26].look.firstOrgan": 3896, "organs[26].look.organKinds": 3900, "organs[26].count": 3904, "organs[26].place": 3912, "organs[26].pitch": 3920, "organs[26].size": 3928, "organs[26].width": 3936, "organs[26].azimuth": 3940, "organs[26].turn": 3944, "organs[26].bend": 3948, "organs[26].leg": 3952, "organs[26].variation": 3956, "organs[27].look.rootColor": 3968, "organs[27].look.tipThreshold": 3980, "organs[27].look.tipColor": 3984, "organs[27].look.groundTint": 3996, "organs[27].look.colorVariation": 4e3, "organs[27].look.translucency": 4004, "organs[27].look.gloss": 4008, "organs[27].look.dryness": 4012, "organs[27].look.shape": 4016, "organs[27].look.fold": 4020, "organs[27].look.firstOrgan": 4024, "organs[27].look.organKinds": 4028, "organs[27].count": 4032, "organs[27].place": 4040, "organs[27].pitch": 4048, "organs[27].size": 4056, "organs[27].width": 4064, "organs[27].azimuth": 4068, "organs[27].turn": 4072, "organs[27].bend": 4076, "organs[27].leg": 4080, "organs[27].variation": 4084, "organs[28].look.rootColor": 4096, "organs[28].look.tipThreshold": 4108, "organs[28].look.tipColor": 4112, "organs[28].look.groundTint": 4124, "organs[28].look.colorVariation": 4128, "organs[28].look.translucency": 4132, "organs[28].look.gloss": 4136, "organs[28].look.dryness": 4140, "organs[28].look.shape": 4144, "organs[28].look.fold": 4148, "organs[28].look.firstOrgan": 4152, "organs[28].look.organKinds": 4156, "organs[28].count": 4160, "organs[28].place": 4168, "organs[28].pitch": 4176, "organs[28].size": 4184, "organs[28].width": 4192, "organs[28].azimuth": 4196, "organs[28].turn": 4200, "organs[28].bend": 4204, "organs[28].leg": 4208, "organs[28].variation": 4212, "organs[29].look.rootColor": 4224, "organs[29].look.tipThreshold": 4236, "organs[29].look.tipColor": 4240, "organs[29].look.groundTint": 4252, "organs[29].look.colorVariation": 4256, "organs[29].look.translucency": 4260, "organs[29].look.gloss": 4264, "organs[29].look.dryness": 4268, "organs[29].look.shape": 4272, "organs[29].look.fold": 4276, "organs[29].look.firstOrgan": 4280, "organs[29].look.organKinds": 4284, "organs[29].count": 4288, "organs[29].place": 4296, "organs[29].pitch": 4304, "organs[29].size": 4312, "organs[29].width": 4320, "organs[29].azimuth": 4324, "organs[29].turn": 4328, "organs[29].bend": 4332, "organs[29].leg": 4336, "organs[29].variation": 4340, "organs[30].look.rootColor": 4352, "organs[30].look.tipThreshold": 4364, "organs[30].look.tipColor": 4368, "organs[30].look.groundTint": 4380, "organs[30].look.colorVariation": 4384, "organs[30].look.translucency": 4388, "organs[30].look.gloss": 4392, "organs[30].look.dryness": 4396, "organs[30].look.shape": 4400, "organs[30].look.fold": 4404, "organs[30].look.firstOrgan": 4408, "organs[30].look.organKinds": 4412, "organs[30].count": 4416, "organs[30].place": 4424, "organs[30].pitch": 4432, "organs[30].size": 4440, "organs[30].width": 4448, "organs[30].azimuth": 4452, "organs[30].turn": 4456, "organs[30].bend": 4460, "organs[30].leg": 4464, "organs[30].variation": 4468, "organs[31].look.rootColor": 4480, "organs[31].look.tipThreshold": 4492, "organs[31].look.tipColor": 4496, "organs[31].look.groundTint": 4508, "organs[31].look.colorVariation": 4512, "organs[31].look.translucency": 4516, "organs[31].look.gloss": 4520, "organs[31].look.dryness": 4524, "organs[31].look.shape": 4528, "organs[31].look.fold": 4532, "organs[31].look.firstOrgan": 4536, "organs[31].look.organKinds": 4540, "organs[31].count": 4544, "organs[31].place": 4552, "organs[31].pitch": 4560, "organs[31].size": 4568, "organs[31].width": 4576, "organs[31].azimuth": 4580, "organs[31].turn": 4584, "organs[31].bend": 4588, "organs[31].leg": 4592, "organs[31].variation": 4596 };

// src/generated/shaders.ts
var shaders_exports = {};
__export(shaders_exports, {
  bladeFrag: () => bladeFrag,
  bladeShadowFrag: () => bladeShadowFrag,
  bladeShadowVert: () => bladeShadowVert,
  bladeVert: () => bladeVert,
  filmFrag: () => filmFrag,
  filmVert: () => filmVert,
  groundFrag: () => groundFrag,
  groundVert: () => groundVert,
  hostBladeFrag: () => hostBladeFrag,
  hostGroundFrag: () => hostGroundFrag,
  moveFrag: () => moveFrag,
  moveVert: () => moveVert,
  nothingFrag: () => nothingFrag,
  poseVert: () => poseVert,
  skyFrag: () => skyFrag,
  skyVert: () => skyVert,
  sunVert: () => sunVert
});
var pieces = [
  // web/shaders/blades.glsl
  "#ifndef SWARD_WEB_BLADES_GLSL\n#define SWARD_WEB_BLADES_GLSL\n",
  // web/shaders/frame.glsl
  "#ifndef SWARD_WEB_FRAME_GLSL\n#define SWARD_WEB_FRAME_GLSL\n",
  // shaders/shared/frame.h
  "#ifndef SWARD_SHARED_FRAME_H\n#define SWARD_SHARED_FRAME_H\n",
  // shaders/shared/blade.h
  "#ifndef SWARD_SHARED_BLADE_H\n#define SWARD_SHARED_BLADE_H\n",
  // shaders/shared/noise.h
  "#ifndef SWARD_SHARED_NOISE_H\n#define SWARD_SHARED_NOISE_H\n",
  // shaders/shared/noise.h
  "uint mixUint(uint x)\n{\nx ^= x >> 16u;\nx *= 0x7feb352du;\nx ^= x >> 15u;\nx *= 0x846ca68bu;\nx ^= x >> 16u;\nreturn x;\n}\nconst uint latticeX = 0x9e3779b1u;\nconst uint latticeY = 0x85ebca77u;\nconst uint latticeZ = 0xc2b2ae3du;\nuint latticePoint(int x, int y, int z)\n{\nreturn uint(x) * latticeX + uint(y) * latticeY + uint(z) * latticeZ;\n}\nfloat latticeHeight(uint point)\n{\npoint ^= point >> 11u;\npoint *= 0x31848babu;\nreturn float(point);\n}\nconst float latticeUnit = 1.0f / 4294967296.0f;\nfloat latticeValue(int x, int y, int z)\n{\nreturn latticeUnit * latticeHeight(latticePoint(x, y, z));\n}\nfloat valueNoiseFrom(uint origin, vec3 p)\n{\nvec3 cell = floor(p);\nvec3 f = p - cell;\nvec3 s = f * f * (vec3(3.0f) - 2.0f * f);\nuint near = origin + latticePoint(int(cell.x), int(cell.y), int(cell.z));\nuint far = near + latticeZ;\nfloat nearHeight = mix(\nmix(latticeHeight(near), latticeHeight(near + latticeX), s.x),\nmix(latticeHeight(near + latticeY), latticeHeight(near + latticeX + latticeY), s.x), s.y);\nfloat farHeight =\nmix(mix(latticeHeight(far), latticeHeight(far + latticeX), s.x),\nmix(latticeHeight(far + latticeY), latticeHeight(far + latticeX + latticeY), s.x), s.y);\nreturn latticeUnit * mix(nearHeight, farHeight, s.z);\n}\nfloat valueNoise(vec3 p)\n{\nreturn valueNoiseFrom(0u, p);\n}\nvec4 valueNoiseSlope(vec3 p)\n{\nvec3 cell = floor(p);\nvec3 f = p - cell;\nvec3 s = f * f * (vec3(3.0f) - 2.0f * f);\nvec3 slope = 6.0f * f * (vec3(1.0f) - f);\nuint near = latticePoint(int(cell.x), int(cell.y), int(cell.z));\nuint far = near + latticeZ;\nfloat h000 = latticeHeight(near);\nfloat h010 = latticeHeight(near + latticeY);\nfloat h001 = latticeHeight(far);\nfloat h011 = latticeHeight(far + latticeY);\nfloat d00 = latticeHeight(near + latticeX) - h000;\nfloat d10 = latticeHeight(near + latticeX + latticeY) - h010;\nfloat d01 = latticeHeight(far + latticeX) - h001;\nfloat d11 = latticeHeight(far + latticeX + latticeY) - h011;\nfloat h00 = h000 + s.x * d00;\nfloat h10 = h010 + s.x * d10;\nfloat h01 = h001 + s.x * d01;\nfloat h11 = h011 + s.x * d11;\nfloat h0 = mix(h00, h10, s.y);\nfloat h1 = mix(h01, h11, s.y);\nreturn latticeUnit * vec4(slope.x * mix(mix(d00, d10, s.y), mix(d01, d11, s.y), s.z),\nslope.y * mix(h10 - h00, h11 - h01, s.z), slope.z * (h1 - h0),\nmix(h0, h1, s.z));\n}\n#endif\n",
  // shaders/shared/octahedral.h
  "#ifndef SWARD_SHARED_OCTAHEDRAL_H\n#define SWARD_SHARED_OCTAHEDRAL_H\n",
  // shaders/shared/octahedral.h
  "const float octahedralMaxError = 0.0112f;\nfloat signNotZero(float x)\n{\nreturn x >= 0.0f ? 1.0f : -1.0f;\n}\nvec2 unfolded(vec3 v)\n{\nfloat scale = 1.0f / (abs(v.x) + abs(v.y) + abs(v.z));\nfloat x = v.x * scale;\nfloat y = v.y * scale;\nreturn v.z < 0.0f ? vec2((1.0f - abs(y)) * signNotZero(x), (1.0f - abs(x)) * signNotZero(y))\n: vec2(x, y);\n}\nvec3 folded(float x, float y)\n{\nfloat z = 1.0f - abs(x) - abs(y);\nvec3 v =\nz >= 0.0f ? vec3(x, y, z)\n: vec3((1.0f - abs(y)) * signNotZero(x), (1.0f - abs(x)) * signNotZero(y), z);\nreturn normalize(v);\n}\nvec3 decodeOctahedral(uint bits)\n{\nreturn folded(float(int(bits & 255u) - 127) * (1.0f / 127.0f),\nfloat(int((bits >> 8u) & 255u) - 127) * (1.0f / 127.0f));\n}\nuint encodeOctahedral(vec3 v)\n{\nvec2 place = unfolded(v);\nfloat x0 = floor(clamp(place.x, -1.0f, 1.0f) * 127.0f) + 127.0f;\nfloat y0 = floor(clamp(place.y, -1.0f, 1.0f) * 127.0f) + 127.0f;\nuint best = 0u;\nfloat bestCosine = -2.0f;\nfor (uint corner = 0u; corner < 4u; ++corner) {\nuint xi = uint(min(x0 + float(corner & 1u), 254.0f));\nuint yi = uint(min(y0 + float(corner >> 1u), 254.0f));\nuint candidate = xi | (yi << 8u);\nfloat cosine = dot(decodeOctahedral(candidate), v);\nif (cosine > bestCosine) {\nbestCosine = cosine;\nbest = candidate;\n}\n}\nreturn best;\n}\nuint packSnorm16(float x)\n{\nreturn uint(int(floor(clamp(x, -1.0f, 1.0f) * 32767.0f + 0.5f))) & 65535u;\n}\nfloat unpackSnorm16(uint bits)\n{\nreturn float((int(bits & 65535u) ^ 32768) - 32768) * (1.0f / 32767.0f);\n}\nconst float wideOctahedralMaxError = 7e-5f;\nuint encodeWideOctahedral(vec3 v)\n{\nvec2 place = unfolded(v);\nreturn packSnorm16(place.x) | (packSnorm16(place.y) << 16u);\n}\nvec3 decodeWideOctahedral(uint bits)\n{\nreturn folded(unpackSnorm16(bits), unpackSnorm16(bits >> 16u));\n}\nvec3 tangentOf(vec3 n)\n{\nfloat s = signNotZero(n.z);\nfloat a = -1.0f / (s + n.z);\nreturn vec3(1.0f + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);\n}\nvec3 bitangentOf(vec3 n)\n{\nfloat s = signNotZero(n.z);\nfloat a = -1.0f / (s + n.z);\nreturn vec3(n.x * n.y * a, s + n.y * n.y * a, -n.y);\n}\n#endif\n",
  // shaders/shared/patch.h
  "#ifndef SWARD_SHARED_PATCH_H\n#define SWARD_SHARED_PATCH_H\n",
  // shaders/shared/patch.h
  "const uint maxPatchBlades = 512u;\nconst uint noPatch = 0xffffffffu;\nstruct Patch {\nvec3 boundsLow;\nuint firstBlade;\nvec3 boundsHigh;\nuint bladeCount;\nvec3 rootLow;\nfloat rootStep;\nvec3 coneAxis;\nfloat coneCosine;\nfloat heightLow;\nfloat heightStep;\nfloat widthLow;\nfloat widthStep;\nuint parent;\nuint firstChild;\nuint childCount;\nuint level;\nfloat rankLow;\nfloat rankHigh;\n};\nstruct PatchArray { uint none; };\nPatch fetchPatchArray(uint i);\n#endif\n",
  // shaders/shared/blade.h
  "const float twoPi = 6.28318530717958647692f;\nstruct PackedBlade {\nuint rootXY;\nuint rootZUp;\nuint shape;\nuint look;\n};\nstruct BladeArray { uint none; };\nPackedBlade fetchBladeArray(uint i);\nstruct Blade {\nvec3 root;\nfloat facing;\nvec3 up;\nfloat stiffness;\nfloat height;\nfloat width;\nfloat exposure;\nuint species;\nvec3 tint;\nuint clump;\nuint hash;\nuint seed;\n};\nconst uint driedClump = 255u;\nconst float facingMaxError = 0.01228f;\nconst float stiffnessMaxError = 0.00794f;\nconst float exposureMaxError = 0.01613f;\nconst float tintMaxError = 0.01613f;\nuint quantise(float x, float low, float step, uint largest)\n{\nif (step <= 0.0f)\nreturn 0u;\nreturn uint(clamp(floor((x - low) / step + 0.5f), 0.0f, float(largest)));\n}\nuint seedOf(PackedBlade bits)\n{\nuint kept = (bits.shape & 0xffc000ffu) ^ ((bits.rootZUp >> 16u) << 8u);\nreturn mixUint(kept + bits.look * 0x9e3779b9u) >> 16u;\n}\nPackedBlade packBladeWith(Blade blade, Patch cell, uint up)\n{\nuint x = quantise(blade.root.x, cell.rootLow.x, cell.rootStep, 65535u);\nuint y = quantise(blade.root.y, cell.rootLow.y, cell.rootStep, 65535u);\nuint z = quantise(blade.root.z, cell.rootLow.z, cell.rootStep, 65535u);\nuint facing = uint(int(floor(blade.facing * (256.0f / twoPi) + 0.5f))) & 255u;\nuint height = quantise(blade.height, cell.heightLow, cell.heightStep, 255u);\nuint width = quantise(blade.width, cell.widthLow, cell.widthStep, 63u);\nuint stiffness = quantise(blade.stiffness, 0.0f, 1.0f / 63.0f, 63u);\nuint exposure = quantise(blade.exposure, 0.0f, 1.0f / 31.0f, 31u);\nuint red = quantise(blade.tint.x, 0.0f, 1.0f / 31.0f, 31u);\nuint green = quantise(blade.tint.y, 0.0f, 1.0f / 63.0f, 63u);\nuint blue = quantise(blade.tint.z, 0.0f, 1.0f / 31.0f, 31u);\nPackedBlade bits;\nbits.rootXY = x | (y << 16u);\nbits.rootZUp = z | (up << 16u);\nbits.shape =\nfacing | (height << 8u) | (width << 16u) | (stiffness << 22u) | ((blade.hash & 15u) << 28u);\nbits.look = red | (green << 5u) | (blue << 11u) | (exposure << 16u) |\n((blade.species & 7u) << 21u) | ((blade.clump & 255u) << 24u);\nreturn bits;\n}\nPackedBlade packBlade(Blade blade, Patch cell)\n{\nreturn packBladeWith(blade, cell, encodeOctahedral(blade.up));\n}\nBlade unpackBlade(PackedBlade bits, Patch cell)\n{\nBlade blade;\nblade.root =\ncell.rootLow + cell.rootStep * vec3(float(bits.rootXY & 65535u), float(bits.rootXY >> 16u),\nfloat(bits.rootZUp & 65535u));\nblade.up = decodeOctahedral(bits.rootZUp >> 16u);\nblade.facing = float(bits.shape & 255u) * (twoPi / 256.0f);\nblade.height = cell.heightLow + cell.heightStep * float((bits.shape >> 8u) & 255u);\nblade.width = cell.widthLow + cell.widthStep * float((bits.shape >> 16u) & 63u);\nblade.stiffness = float((bits.shape >> 22u) & 63u) * (1.0f / 63.0f);\nblade.hash = bits.shape >> 28u;\nblade.tint = vec3(float(bits.look & 31u) * (1.0f / 31.0f),\nfloat((bits.look >> 5u) & 63u) * (1.0f / 63.0f),\nfloat((bits.look >> 11u) & 31u) * (1.0f / 31.0f));\nblade.exposure = float((bits.look >> 16u) & 31u) * (1.0f / 31.0f);\nblade.species = (bits.look >> 21u) & 7u;\nblade.clump = bits.look >> 24u;\nblade.seed = seedOf(bits);\nreturn blade;\n}\nvec3 widthAxis(vec3 up, float facing)\n{\nreturn tangentOf(up) * cos(facing) + bitangentOf(up) * sin(facing);\n}\nvec3 frontOf(vec3 up, vec3 axis)\n{\nreturn cross(up, axis);\n}\nstruct BladeAxes {\nvec3 front;\nvec3 side;\nvec3 up;\n};\nBladeAxes axesAlong(vec3 up, vec3 axis)\n{\nBladeAxes axes;\naxes.front = frontOf(up, axis);\naxes.side = -axis;\naxes.up = up;\nreturn axes;\n}\nBladeAxes axesTowards(vec3 up, vec3 front)\n{\nBladeAxes axes;\naxes.front = front;\naxes.side = cross(up, front);\naxes.up = up;\nreturn axes;\n}\nvec3 alongAxes(BladeAxes axes, vec3 v)\n{\nreturn vec3(dot(v, axes.front), dot(v, axes.side), dot(v, axes.up));\n}\nvec3 inSpace(BladeAxes axes, vec3 v)\n{\nreturn v.x * axes.front + v.y * axes.side + v.z * axes.up;\n}\n#endif\n",
  // shaders/shared/look/blade_shadow.h
  "#ifndef SWARD_SHARED_LOOK_BLADE_SHADOW_H\n#define SWARD_SHARED_LOOK_BLADE_SHADOW_H\n",
  // shaders/shared/look/blade_shadow.h
  "const uint bladeShadowTexels = 1024u;\nconst float bladeShadowFade = 0.75f;\nstruct BladeShadowTable { uint none; };\nuvec2 fetchBladeShadowTable(uint i);\nbool isShaded(uvec2 texel, float depth, uint seed)\n{\nreturn texel.x != seed && uintBitsToFloat(texel.y) > depth;\n}\nstruct BladeShadow {\nvec4 across;\nvec4 down;\nvec4 depth;\nuint size;\nfloat nearer;\n};\nconst uint noBladeSeed = 0xffffffffu;\nvec2 sunAmongBlades(BladeShadow shadow, vec3 place, uint seed)\n{\nif (shadow.size == 0u)\nreturn vec2(1.0f, 0.0f);\nvec4 at4 = vec4(place, 1.0f);\nvec2 at = vec2(dot(shadow.across, at4), dot(shadow.down, at4)) - 0.5f;\nfloat depth = max(dot(shadow.depth, at4) + shadow.nearer, 0.0f);\nfloat edge = 0.5f * float(shadow.size);\nvec2 off = abs(at + 0.5f - edge) / edge;\nfloat weight = 1.0f - smoothstep(bladeShadowFade, 1.0f, max(off.x, off.y));\nif (weight <= 0.0f)\nreturn vec2(1.0f, 0.0f);\nvec2 corner = floor(at);\nvec2 f = at - corner;\nuint last = shadow.size - 2u;\nuint column = min(uint(max(corner.x, 0.0f)), last);\nuint row = min(uint(max(corner.y, 0.0f)), last);\nuint first = column * shadow.size + row;\nfloat lit00 = isShaded(fetchBladeShadowTable(uint(first)), depth, seed) ? 0.0f : 1.0f;\nfloat lit01 = isShaded(fetchBladeShadowTable(uint(first + 1u)), depth, seed) ? 0.0f : 1.0f;\nfloat lit10 = isShaded(fetchBladeShadowTable(uint(first + shadow.size)), depth, seed) ? 0.0f : 1.0f;\nfloat lit11 = isShaded(fetchBladeShadowTable(uint(first + shadow.size + 1u)), depth, seed) ? 0.0f : 1.0f;\nreturn vec2(mix(mix(lit00, lit01, f.y), mix(lit10, lit11, f.y), f.x), weight);\n}\n#endif\n",
  // shaders/shared/cover.h
  "#ifndef SWARD_SHARED_COVER_H\n#define SWARD_SHARED_COVER_H\n",
  // shaders/shared/cover.h
  "struct CoverTable { uint none; };\nuint fetchCoverTable(uint i);\nconst uint heightSteps = 16u;\nstruct Cover {\nvec3 low;\nfloat cellsPerMetre;\nuint countX;\nuint countY;\nuint countZ;\nfloat farthest;\nvec3 undergrowth;\nfloat thatch;\nvec3 sward;\nfloat thinned;\nfloat structure;\nfloat stepsPerMetre;\nuint leaves[heightSteps / 2u];\n};\nconst uint toneBits = 0x80038000u;\nuint packGrass(float leafArea, float height, float tone)\n{\nuint halves = packHalf2x16(vec2(leafArea, leafArea * height)) + 0x20000u;\nuint step = uint(clamp(tone, 0.0f, 1.0f) * 15.0f + 0.5f);\nreturn (halves & ~toneBits) | ((step & 3u) << 16u) | ((step & 4u) << 13u) |\n((step & 8u) << 28u);\n}\nvec3 unpackGrass(uint corner)\n{\nvec2 grass = unpackHalf2x16(corner & ~toneBits);\nuint step = ((corner >> 16u) & 3u) | ((corner >> 13u) & 4u) | ((corner >> 28u) & 8u);\nreturn vec3(grass.x, grass.y, grass.x * float(step) * (1.0f / 15.0f));\n}\nvec3 mixGrass(uint a, uint b, float share)\n{\nreturn mix(unpackGrass(a), unpackGrass(b), share);\n}\nvec3 grassAt(Cover cover, vec3 position)\n{\nif (cover.countX == 0u)\nreturn vec3(0.0f);\nvec3 last = vec3(float(cover.countX), float(cover.countY), float(cover.countZ)) - 1.0f;\nvec3 place = clamp((position - cover.low) * cover.cellsPerMetre, vec3(0.0f), last);\nvec3 cell = min(floor(place), last - 1.0f);\nvec3 f = place - cell;\nuint stepY = cover.countX;\nuint stepZ = cover.countX * cover.countY;\nuint i = uint(cell.x) + stepY * uint(cell.y) + stepZ * uint(cell.z);\nuint j = i + stepZ;\nvec3 near =\nmix(mixGrass(fetchCoverTable(uint(i)), fetchCoverTable(uint(i + 1u)), f.x),\nmixGrass(fetchCoverTable(uint(i + stepY)), fetchCoverTable(uint(i + stepY + 1u)), f.x), f.y);\nvec3 far =\nmix(mixGrass(fetchCoverTable(uint(j)), fetchCoverTable(uint(j + 1u)), f.x),\nmixGrass(fetchCoverTable(uint(j + stepY)), fetchCoverTable(uint(j + stepY + 1u)), f.x), f.y);\nreturn mix(near, far, f.z);\n}\nfloat leafAreaAt(Cover cover, vec3 position)\n{\nreturn grassAt(cover, position).x;\n}\nfloat toneOf(vec3 grass)\n{\nreturn grass.x > 0.0f ? grass.z / grass.x : 0.5f;\n}\nfloat heightStepsPerMetre(Cover cover, vec3 grass)\n{\nreturn cover.stepsPerMetre * (grass.y > 0.0f ? grass.x / grass.y : 1.0f);\n}\nfloat leafShareAbove(Cover cover, float steps)\n{\nfloat at = clamp(steps, 0.0f, float(heightSteps));\nuint step = min(uint(at), heightSteps - 1u);\nvec2 pair = unpackHalf2x16(cover.leaves[step / 2u]);\nfloat low = step == 0u ? 1.0f : pair.x;\nfloat next = pair.y;\nif ((step & 1u) != 0u) {\nlow = pair.y;\nnext = step + 1u < heightSteps ? unpackHalf2x16(cover.leaves[step / 2u + 1u]).x : 0.0f;\n}\nfloat root = mix(low, next, at - float(step));\nreturn root * root;\n}\nfloat leafProjectionOf(Cover cover)\n{\nreturn unpackHalf2x16(cover.leaves[0]).x;\n}\nfloat undergrowthBelow(float leafArea)\n{\nreturn 1.0f - exp(-0.65f * leafArea);\n}\nvec3 groundUnder(Cover cover, vec3 bare, vec3 shade, float leafArea)\n{\nreturn mix(bare, shade * cover.undergrowth, cover.thatch * undergrowthBelow(leafArea));\n}\nfloat swardShare(Cover cover, float leafArea, float thinned)\n{\nreturn cover.thatch * (undergrowthBelow(leafArea) - undergrowthBelow(leafArea / thinned));\n}\nfloat swardBrightness(float cosine)\n{\nreturn 0.6f - 0.1f * cosine;\n}\nfloat leavesAround(float leafArea, float thinned)\n{\nreturn leafArea * max(pow(thinned, -0.22f), 0.6f);\n}\nfloat heightWithLeafShare(float share)\n{\nreturn pow(clamp(share, 0.0f, 1.0f), 2.0f / 3.0f);\n}\nconst float leafExtinction = 0.46f;\nconst float lowestSun = 0.1f;\nfloat leafProjectionAlong(float upwards, float cosine)\n{\nfloat beside = 0.637f * sqrt(max(1.0f - 1.9f * upwards * upwards, 0.0f));\nfloat sine = sqrt(max(1.0f - cosine * cosine, 0.0f));\nreturn length(vec2(upwards * cosine, beside * sine));\n}\nconst float skyExtinction = 1.2f;\nfloat sunBelow(float upwards, float leafArea, float cosine)\n{\nfloat risen = max(cosine, lowestSun);\nreturn exp(-leafProjectionAlong(upwards, risen) * (leafArea / risen));\n}\nfloat skyBelow(float leafArea)\n{\nreturn exp(-skyExtinction * leafArea);\n}\n#endif\n",
  // shaders/shared/culling.h
  "#ifndef SWARD_SHARED_CULLING_H\n#define SWARD_SHARED_CULLING_H\n",
  // shaders/shared/culling.h
  "const uint cullResultDrawn = 0u;\nconst uint cullResultPatch = 1u;\nconst uint cullResultOrientation = 2u;\nconst uint cullResultFrustum = 3u;\nconst uint cullResultDistance = 4u;\nconst uint cullResultOcclusion = 5u;\nconst uint cullResultLod = 6u;\nconst uint cullResultCount = 7u;\nconst uint cullPatch = 1u;\nconst uint cullOrientation = 2u;\nconst uint cullFrustum = 4u;\nconst uint cullDistance = 8u;\nconst uint cullOcclusion = 16u;\nconst uint leaveThinned = 32u;\nconst float paperEdgeOnCosine = 0.9f;\nfloat planeDistance(vec4 plane, vec3 point)\n{\nreturn dot(vec3(plane.x, plane.y, plane.z), point) + plane.w;\n}\nbool curveOutside(vec4 plane, vec3 v0, vec3 v1, vec3 v2, float margin)\n{\nreturn max(max(planeDistance(plane, v0), planeDistance(plane, v1)), planeDistance(plane, v2)) <\n-margin;\n}\nbool curveInside(vec4 plane, vec3 v0, vec3 v1, vec3 v2, float margin)\n{\nreturn min(min(planeDistance(plane, v0), planeDistance(plane, v1)), planeDistance(plane, v2)) >\nmargin;\n}\nbool boxOutside(vec4 plane, vec3 low, vec3 high)\n{\nvec3 farthest = vec3(plane.x >= 0.0f ? high.x : low.x, plane.y >= 0.0f ? high.y : low.y,\nplane.z >= 0.0f ? high.z : low.z);\nreturn planeDistance(plane, farthest) < 0.0f;\n}\nfloat edgeOnCosine(vec3 eye, vec3 root, vec3 axis)\n{\nvec3 ray = root - eye;\nreturn min(abs(dot(ray, axis)) / max(length(ray), 1e-6f), 1.0f);\n}\nfloat boxDistance(vec3 eye, vec3 low, vec3 high)\n{\nreturn length(max(max(low - eye, eye - high), vec3(0.0f)));\n}\nbool bucketsKeep(float buckets, float last, float distance, float rank)\n{\nreturn buckets <= 0.0f || rank * buckets < floor(buckets * (1.0f - distance / last));\n}\nconst float lodFade = 0.1f;\nconst float lodFullShare = 1.0f / 0.9f;\nfloat lodShare(float pixels, float threshold)\n{\nreturn clamp(pixels / threshold, 1.0f / 256.0f, lodFullShare);\n}\nfloat lodWidthFactor(float rank, float share)\n{\nif (share >= lodFullShare)\nreturn 1.0f;\nfloat fade = lodFade * share;\nfloat weight = clamp((share - rank) / fade, 0.0f, 1.0f);\nfloat beyond = max(share - 1.0f, 0.0f);\nfloat mean = share - 0.5f * fade - 0.5f * beyond * beyond / fade;\nreturn weight / mean;\n}\nconst float flattestRay = 1.0f / 96.0f;\nconst float maxLeafArea = 64.0f;\nfloat leafAreaShare(float most, float leafArea, float cosine, float pixels)\n{\nfloat wide = max(pixels * pixels, 1.0f);\nreturn clamp(most * wide * wide * max(cosine, flattestRay) /\n(leafExtinction * max(leafArea, 1e-6f)),\n1.0f / 256.0f, lodFullShare);\n}\nfloat leafAreaWeight(float rank, float share)\n{\nif (share >= lodFullShare)\nreturn 1.0f;\nreturn clamp((share - rank) / (lodFade * share), 0.0f, 1.0f);\n}\nconst float maxHeightCompensation = 1.3f;\nfloat heightCompensation(float share, float one, float spread)\n{\nif (share >= 1.0f)\nreturn 1.0f;\nfloat full = min(one, 1.0f);\nfloat sunk = pow(full / share, 1.0f / 3.0f) - pow(full, 1.0f / 3.0f);\nfloat rise = clamp(1.0f + (0.4f + 0.2f * spread) * sunk, 1.0f, maxHeightCompensation);\nreturn floor(rise * 1024.0f + 0.5f) / 1024.0f;\n}\nfloat leafAreaLight(float share, float spread)\n{\nreturn share >= 1.0f ? 1.0f : pow(share, 1.0f / (1.0f + 0.8f * spread));\n}\n#endif\n",
  // shaders/shared/environment.h
  "#ifndef SWARD_SHARED_ENVIRONMENT_H\n#define SWARD_SHARED_ENVIRONMENT_H\n",
  // shaders/shared/collision.h
  "#ifndef SWARD_SHARED_COLLISION_H\n#define SWARD_SHARED_COLLISION_H\n",
  // shaders/shared/collision.h
  "struct Collider {\nvec3 from;\nfloat radius;\nvec3 to;\nuint reserved;\nvec3 velocity;\nuint reserved2;\n};\nstruct ColliderTable { uint none; };\nCollider fetchColliderTable(uint i);\nconst uint maxColliders = 256u;\nconst uint colliderWords = 8u;\nstruct ColliderMask {\nuint words[colliderWords];\n};\nColliderMask noColliders()\n{\nColliderMask mask;\nfor (uint i = 0u; i < colliderWords; ++i)\nmask.words[i] = 0u;\nreturn mask;\n}\nbool colliderNear(Collider collider, vec3 low, vec3 high, float elapsed)\n{\nvec3 way = collider.velocity * elapsed;\nvec3 first = min(min(collider.from, collider.to), min(collider.from, collider.to) - way);\nvec3 last = max(max(collider.from, collider.to), max(collider.from, collider.to) - way);\nreturn all(lessThanEqual(first - collider.radius, high)) &&\nall(lessThanEqual(low, last + collider.radius));\n}\nCollider colliderSeenFrom(Collider collider, vec3 root, float height, float back)\n{\nvec3 shift = collider.velocity * back + root;\nCollider seen = collider;\nseen.from = (collider.from - shift) / height;\nseen.to = (collider.to - shift) / height;\nseen.radius = collider.radius / height;\nreturn seen;\n}\nvec3 towardsSegment(Collider collider, vec3 point)\n{\nvec3 along = collider.to - collider.from;\nvec3 to = collider.from - point;\nfloat size = dot(along, along);\nfloat t = size > 0.0f ? clamp(-dot(to, along) / size, 0.0f, 1.0f) : 0.0f;\nreturn to + t * along;\n}\nvec3 pushOut(Collider collider, vec3 point, vec3 otherwise)\n{\nvec3 towards = towardsSegment(collider, point);\nfloat distance = length(towards);\nfloat depth = max(collider.radius - distance, 0.0f);\nreturn depth * (distance > 1e-6f ? -towards / distance : otherwise);\n}\n#endif\n",
  // shaders/shared/environment.h
  "const uint windNoise = 0u;\nconst uint windTurning = 1u;\nconst uint windWave = 2u;\nconst uint windRadial = 3u;\nconst uint windSwirl = 4u;\nconst uint windGusts = 5u;\nconst uint windKinds = 6u;\nconst uint windsAlike = 1u << 24u;\nconst uint maxWindSources = 8u;\nstruct WindSource {\nvec3 direction;\nfloat strength;\nvec3 centre;\nfloat size;\nfloat speed;\nfloat rate;\nfloat turn;\nfloat alignment;\nfloat lift;\nuint kind;\nvec3 side;\nfloat perSize;\n};\nstruct WindPhase {\nvec3 shift;\nuint cell;\nvec3 fineShift;\nuint fineCell;\nfloat angle;\nfloat turned;\n};\nstruct WindLattice {\nvec3 origin;\nvec3 x;\nvec3 y;\nvec3 z;\n};\nstruct Wind {\nuint counts;\nfloat eddySize;\nfloat eddySpeed;\nfloat sum;\nvec3 eddyPhase;\nWindLattice lattice;\nWindSource sources[maxWindSources];\nWindPhase phases[maxWindSources];\n};\nstruct Gravity {\nvec3 direction;\nfloat strength;\nvec3 attractor;\nfloat blend;\nfloat forward;\n};\nconst float forwardShare = 0.25f;\nstruct Environment {\nGravity gravity;\nfloat recovery;\nuint colliderCount;\nWind wind;\n};\n#endif\n",
  // shaders/shared/eyepoint.h
  "#ifndef SWARD_SHARED_EYEPOINT_H\n#define SWARD_SHARED_EYEPOINT_H\n",
  // shaders/shared/eyepoint.h
  "struct Eyepoint {\nvec4 planes[6];\nvec3 eye;\nfloat drawDistance;\nfloat pixelsPerUnit;\nfloat lodThreshold;\nfloat lodWidth;\nfloat minWidth;\nfloat maxLeafArea;\nfloat maxEdgeOn;\nuint samples;\nfloat buckets;\nfloat bucketDistance;\nuint cullMask;\nfloat\nareaFactor;\nfloat sparseFrom;\nfloat sparseLeast;\n};\n#endif\n",
  // shaders/shared/host_light.h
  "struct HostLightArray { uint none; };\nuint fetchHostLightArray(uint i);\n",
  // shaders/shared/look/floor_plane.h
  "#ifndef SWARD_SHARED_LOOK_FLOOR_PLANE_H\n#define SWARD_SHARED_LOOK_FLOOR_PLANE_H\n",
  // shaders/shared/look/floor_plane.h
  "struct FloorPlane {\nvec3 middle;\nfloat reach;\nvec3 along;\nfloat height;\nvec2 halfSides;\nfloat cornerRadius;\n};\nfloat distanceFromFootprint(FloorPlane plane, vec3 place, vec3 across)\n{\nvec3 way = place - plane.middle;\nvec2 at = abs(vec2(dot(way, plane.along), dot(way, across)));\nvec2 beyond = max(at - (plane.halfSides - plane.cornerRadius), vec2(0.0f));\nreturn max(length(beyond) - plane.cornerRadius, 0.0f);\n}\nfloat skyBesideWall(float height, float distance)\n{\nfloat slant = sqrt(height * height + distance * distance);\nreturn slant > 0.0f ? 0.5f + 0.5f * distance / slant : 1.0f;\n}\n#endif\n",
  // shaders/shared/occlusion.h
  "struct DepthPyramid { uint none; };\nuint fetchDepthPyramid(uint i);\n",
  // shaders/shared/organ.h
  "#ifndef SWARD_SHARED_ORGAN_H\n#define SWARD_SHARED_ORGAN_H\n",
  // shaders/shared/bezier.h
  "#ifndef SWARD_SHARED_BEZIER_H\n#define SWARD_SHARED_BEZIER_H\n",
  // shaders/shared/bezier.h
  "vec3 bezierPoint(vec3 v0, vec3 v1, vec3 v2, float t)\n{\nvec3 a = v0 + t * (v1 - v0);\nvec3 b = v1 + t * (v2 - v1);\nreturn a + t * (b - a);\n}\nvec3 bezierTangent(vec3 v0, vec3 v1, vec3 v2, float t)\n{\nreturn 2.0f * ((1.0f - t) * (v1 - v0) + t * (v2 - v1));\n}\n#endif\n",
  // shaders/shared/pose.h
  "#ifndef SWARD_SHARED_POSE_H\n#define SWARD_SHARED_POSE_H\n",
  // shaders/shared/pose.h
  "struct BladeState {\nuint turn;\nfloat eta;\n};\nconst uint unsettledTurn = 0x80008000u;\nstruct Pose {\nvec3 v1;\nvec3 v2;\n};\nconst float turnMaxError = 1.54e-5f;\nvec2 turnTowards(vec3 direction)\n{\nreturn (1.0f / (1.0f + max(direction.z, 0.0f))) * vec2(direction.x, direction.y);\n}\nvec3 directionOfTurn(vec2 turn)\n{\nfloat square = min(dot(turn, turn), 1.0f);\nreturn (1.0f / (1.0f + square)) * vec3(2.0f * turn.x, 2.0f * turn.y, 1.0f - square);\n}\nBladeState stateOfTurn(vec2 turn, float eta)\n{\nBladeState state;\nstate.turn = packSnorm16(turn.x) | (packSnorm16(turn.y) << 16u);\nstate.eta = eta;\nreturn state;\n}\nBladeState stateOf(vec3 up, vec3 front, vec3 direction, float eta)\n{\nreturn stateOfTurn(turnTowards(alongAxes(axesTowards(up, front), direction)), eta);\n}\nvec2 storedTurn(BladeState state)\n{\nreturn vec2(unpackSnorm16(state.turn), unpackSnorm16(state.turn >> 16u));\n}\nvec3 storedDirection(BladeState state)\n{\nreturn directionOfTurn(storedTurn(state));\n}\nvec3 directionOf(vec3 up, vec3 front, BladeState state)\n{\nreturn inSpace(axesTowards(up, front), storedDirection(state));\n}\nfloat lengthCorrection(float side)\n{\nif (side > 0.95f)\nreturn (-0.48620368f * side + 0.92399928f) * side + 0.55642926f;\nfloat high = (-1.3481541f * side + 4.0007265f) * side - 4.6675167f;\nfloat low = (high * side + 2.7635532f) * side - 0.71043977f;\nreturn (low * side - 0.037761414f) * side + 1.0f;\n}\nfloat tipDistance(vec3 direction)\n{\nreturn lengthCorrection(length(vec2(direction.x, direction.y)));\n}\nPose poseTowards(vec3 up, vec3 direction)\n{\nfloat side = length(direction - up * dot(direction, up));\nvec3 v1 = up * max(1.0f - side, 0.05f);\nfloat scale = lengthCorrection(side);\nPose pose;\npose.v1 = v1 * scale;\npose.v2 = direction * scale;\nreturn pose;\n}\nvec3 keptAbove(vec3 up, vec3 front, vec3 direction)\n{\nfloat rise = dot(up, direction);\nif (rise >= 0.0f)\nreturn direction;\nvec3 lifted = direction - up * rise;\nfloat distance = length(lifted);\nvec3 towards = distance > 1e-4f ? lifted / distance : front;\nreturn towards - up * min(dot(up, towards), 0.0f);\n}\nPose poseBlade(vec3 up, vec3 front, vec3 tip)\n{\nvec3 lifted = tip - up * min(dot(up, tip), 0.0f);\nfloat distance = length(lifted);\nreturn poseTowards(up, keptAbove(up, front, distance > 1e-4f ? lifted / distance : front));\n}\nPose poseOfState(BladeAxes axes, BladeState state)\n{\nvec3 direction = storedDirection(state);\nfloat side = length(vec2(direction.x, direction.y));\nfloat scale = lengthCorrection(side);\nPose pose;\npose.v1 = axes.up * (max(1.0f - side, 0.05f) * scale);\npose.v2 = inSpace(axes, direction * scale);\nreturn pose;\n}\n#endif\n",
  // shaders/shared/species.h
  "#ifndef SWARD_SHARED_SPECIES_H\n#define SWARD_SHARED_SPECIES_H\n",
  // shaders/shared/shape.h
  "#ifndef SWARD_SHARED_SHAPE_H\n#define SWARD_SHARED_SHAPE_H\n",
  // shaders/shared/shape.h
  "const uint shapeTriangleTip = 0u;\nconst uint shapeQuad = 1u;\nconst uint shapeTriangle = 2u;\nconst uint shapeQuadratic = 3u;\nconst uint shapeDandelion = 4u;\nconst uint shapeLeaf = 5u;\nconst uint shapeStalkLeaf = 6u;\nconst uint shapeCount = 7u;\nconst uint namedShapes = 6u;\nconst float baseWidth = 0.25f;\nconst float baseLength = 0.3f;\nconst float dandelionLobes = 4.0f;\nconst float segmentsPerLobe = 4.0f;\nvec2 outlineAt(uint shape, float tipThreshold, float t)\n{\nfloat half_ = 0.5f;\nif (shape == shapeTriangleTip)\nhalf_ = 0.5f - 0.5f * max(t - tipThreshold, 0.0f) / max(1.0f - tipThreshold, 1e-3f);\nelse if (shape == shapeTriangle)\nhalf_ = 0.5f - 0.5f * t;\nelse if (shape == shapeQuadratic)\nreturn vec2(-0.5f, 0.5f - t * t);\nelse if (shape == shapeDandelion) {\nfloat rest = 1.0f - t;\nfloat wave = abs(sin(3.14159265f * dandelionLobes * rest));\nhalf_ = 0.5f * sqrt(rest) * (2.0f - rest - sqrt(0.5f * wave));\n} else if (shape == shapeLeaf) {\nfloat away = t < tipThreshold ? (tipThreshold - t) / max(tipThreshold, 1e-3f)\n: (t - tipThreshold) / max(1.0f - tipThreshold, 1e-3f);\nhalf_ = 0.5f - 0.5f * min(away * away, 1.0f);\n} else if (shape == shapeStalkLeaf) {\nfloat before = max(1.0f - t / baseLength, 0.0f);\nhalf_ = (0.5f - 0.5f * max(t - tipThreshold, 0.0f) / max(1.0f - tipThreshold, 1e-3f)) *\n(1.0f - (1.0f - baseWidth) * before * before);\n}\nreturn vec2(-half_, half_);\n}\nbool isEven(uint shape)\n{\nreturn shape != shapeQuadratic;\n}\nbool isTapering(uint shape)\n{\nreturn shape != shapeDandelion && shape != shapeLeaf && shape != shapeStalkLeaf;\n}\nvec2 momentsOfStalkLeaf(float tipThreshold)\n{\nfloat tau = tipThreshold;\nfloat lacks = 1.0f - baseWidth;\nfloat u = max(1.0f - tau / baseLength, 0.0f);\nfloat taper = u * u * u * u * baseLength * baseLength / max(1.0f - tau, 1e-3f);\nreturn vec2(0.5f + 0.5f * tau - lacks * (baseLength / 3.0f - taper / 12.0f),\n(1.0f + tau + tau * tau) / 6.0f -\nlacks * (baseLength * baseLength / 12.0f -\ntaper * baseLength * (1.0f / 12.0f - 0.05f * u)));\n}\nfloat outlineArea(uint shape, float tipThreshold)\n{\nif (shape == shapeTriangleTip)\nreturn 0.5f + 0.5f * tipThreshold;\nif (shape == shapeTriangle)\nreturn 0.5f;\nif (shape == shapeQuadratic || shape == shapeLeaf)\nreturn 2.0f / 3.0f;\nif (shape == shapeStalkLeaf)\nreturn momentsOfStalkLeaf(tipThreshold).x;\nreturn shape == shapeDandelion ? 0.57268f : 1.0f;\n}\nstruct Outline {\nuint shape;\nfloat tipThreshold;\nfloat segments;\nfloat scale;\n};\nconst float exactSegments = 20.0f;\nconst float outlineMost = 1.35f;\nfloat innerWidths(uint shape, float tipThreshold, float segments)\n{\nif (shape == shapeTriangleTip) {\nfloat first = floor(tipThreshold * segments) + 1.0f;\nfloat count = max(segments - first, 0.0f);\nfloat beyond =\n0.5f * count * (first + segments - 1.0f) / segments - tipThreshold * count;\nreturn segments - 1.0f - beyond / max(1.0f - tipThreshold, 1e-3f);\n}\nfloat sum = 0.0f;\nfor (float i = 1.0f; i < segments; i += 1.0f) {\nvec2 edges = outlineAt(shape, tipThreshold, i / segments);\nsum += edges.y - edges.x;\n}\nreturn sum;\n}\nOutline outlineOf(uint shape, float tipThreshold, float segments)\n{\nOutline outline;\noutline.shape = shape;\noutline.tipThreshold = tipThreshold;\noutline.segments = segments;\noutline.scale = 1.0f;\nif (segments < 1.5f || segments > exactSegments)\nreturn outline;\nif (shape == shapeStalkLeaf && segments < 3.5f)\noutline.shape = shapeTriangleTip;\nvec2 first = outlineAt(outline.shape, tipThreshold, 0.0f);\nvec2 last = outlineAt(outline.shape, tipThreshold, 1.0f);\nfloat sum = 0.5f * (first.y - first.x + last.y - last.x) +\ninnerWidths(outline.shape, tipThreshold, segments);\noutline.scale = outlineArea(shape, tipThreshold) * segments / sum;\nreturn outline;\n}\nvec2 singleSegment(uint shape, float tipThreshold)\n{\nif (shape == shapeTriangleTip)\nreturn vec2(1.0f + tipThreshold - tipThreshold * tipThreshold, tipThreshold * tipThreshold);\nif (shape == shapeTriangle)\nreturn vec2(1.0f, 0.0f);\nif (shape == shapeQuadratic)\nreturn vec2(7.0f / 6.0f, 1.0f / 6.0f);\nif (shape == shapeLeaf) {\nfloat moment = 0.25f + tipThreshold * (1.0f / 6.0f);\nreturn vec2(8.0f / 3.0f - 6.0f * moment, 6.0f * moment - 4.0f / 3.0f);\n}\nif (shape == shapeStalkLeaf) {\nvec2 moments = momentsOfStalkLeaf(tipThreshold);\nreturn vec2(4.0f * moments.x - 6.0f * moments.y, 6.0f * moments.y - 2.0f * moments.x);\n}\nreturn shape == shapeDandelion ? vec2(0.64894f, 0.49642f) : vec2(1.0f);\n}\nvec2 edgesAt(Outline outline, float t)\n{\nif (outline.segments < 1.5f) {\nvec2 ends = singleSegment(outline.shape, outline.tipThreshold);\nfloat half_ = 0.5f * mix(ends.x, ends.y, t);\nreturn vec2(-half_, half_);\n}\nreturn outline.scale * outlineAt(outline.shape, outline.tipThreshold, t);\n}\nfloat segmentsFor(vec3 v0, vec3 v1, vec3 v2, float size, uint shape, float heightPixels,\nfloat widthPixels, float most)\n{\nfloat stray = length(v0 - 2.0f * v1 + v2) * (heightPixels / max(size, 1e-9f));\nfloat curve = ceil(sqrt(stray));\nif (shape == shapeDandelion && widthPixels > 2.0f)\nreturn dandelionLobes * segmentsPerLobe;\nfloat tip = widthPixels > 3.0f ? 3.0f : (widthPixels > 1.0f ? 2.0f : 1.0f);\nif ((shape == shapeLeaf || shape == shapeStalkLeaf) && widthPixels > 3.0f)\ntip = widthPixels > 12.0f ? 8.0f : 4.0f;\nreturn clamp(max(curve, tip), 1.0f, max(most, 1.0f));\n}\nstruct LevelSteps {\nvec4 distance;\nvec4 segments;\nuint count;\n};\nfloat segmentsAt(LevelSteps steps, float distance)\n{\nfloat segments = steps.segments[0];\nfor (int i = 1; i < 4;\n++i) if (uint(i) < steps.count && distance >= steps.distance[i - 1])\nsegments = steps.segments[i];\nreturn segments;\n}\n#endif\n",
  // shaders/shared/species.h
  "const uint maxSpecies = 8u;\nstruct Species {\nvec3 rootColor;\nfloat tipThreshold;\nvec3 tipColor;\nfloat groundTint;\nfloat colorVariation;\nfloat translucency;\nfloat gloss;\nfloat dryness;\nuint shape;\nfloat fold;\nuint firstOrgan;\nuint organKinds;\n};\nstruct SpeciesArray { uint none; };\nSpecies fetchSpeciesArray(uint i);\n#endif\n",
  // shaders/shared/organ.h
  "const uint maxRibbons = 63u;\nconst uint maxOrganKinds = 32u;\nstruct Organ {\nSpecies look;\nuint count;\nvec2 place;\nvec2 pitch;\nvec2 size;\nfloat width;\nfloat azimuth;\nfloat turn;\nfloat bend;\nfloat leg;\nfloat variation;\n};\nstruct OrganTable { uint none; };\nOrgan fetchOrganTable(uint i);\nuint ribbonNumber(Species species, Blade blade)\n{\nreturn species.organKinds > 0u ? blade.clump : 0u;\n}\nuint organOf(OrganTable organs, Species species, uint number, inout uint within)\n{\nuint kind = species.firstOrgan;\nwithin = number - 1u;\nwhile (kind + 1u < species.firstOrgan + species.organKinds && within >= fetchOrganTable(uint(kind)).count) {\nwithin -= fetchOrganTable(uint(kind)).count;\n++kind;\n}\nreturn kind;\n}\nfloat legLength(float bend)\n{\nfloat sum = 0.0f;\nfor (uint i = 0u; i <= 32u; ++i) {\nfloat t = float(i) / 32.0f;\nfloat speed = sqrt(max(1.0f - 2.0f * t * (1.0f - t) * (1.0f - cos(bend)), 0.0f));\nsum += (i == 0u || i == 32u ? 1.0f : (i & 1u) != 0u ? 4.0f : 2.0f) * speed;\n}\nreturn 0.5f * 96.0f / sum;\n}\nstruct PosedBlade {\nBlade blade;\nvec3 v0;\nvec3 v1;\nvec3 v2;\nvec3 axis;\n};\nPosedBlade posedBlade(Blade blade, BladeState state)\n{\nPosedBlade posed;\nposed.blade = blade;\nposed.axis = widthAxis(blade.up, blade.facing);\nPose pose = poseOfState(axesAlong(blade.up, posed.axis), state);\nposed.v0 = blade.root;\nposed.v1 = blade.root + blade.height * pose.v1;\nposed.v2 = blade.root + blade.height * pose.v2;\nreturn posed;\n}\nuint plantKey(Blade blade)\n{\nreturn blade.hash | ((uint(blade.facing * (256.0f / twoPi) + 0.5f) & 255u) << 4u);\n}\nfloat organDice(Blade blade, uint number, uint salt)\n{\nreturn float(mixUint(plantKey(blade) | (number << 12u) | (salt << 20u)) >> 8u) *\n(1.0f / 16777215.0f) -\n0.5f;\n}\nvec3 aboveGround(vec3 root, vec3 up, vec3 v)\n{\nreturn v - up * min(dot(up, v - root), 0.0f);\n}\nPosedBlade posedRibbon(PosedBlade stalk, Organ organ, uint number, uint within)\n{\nBlade plant = stalk.blade;\nfloat share = organ.count > 1u ? float(within) / float(organ.count - 1u) : 0.0f;\nfloat t = mix(organ.place.x, organ.place.y, share);\nvec3 along = bezierTangent(stalk.v0, stalk.v1, stalk.v2, t);\nalong = normalize(\ndot(along, along) > 1e-10f * plant.height * plant.height ? along : stalk.v1 - stalk.v0);\nvec3 side = stalk.axis - along * dot(along, stalk.axis);\nfloat level = dot(side, side);\nside = level > 1e-6f ? side * inversesqrt(level) : plant.up;\nvec3 front = cross(along, side);\nfloat azimuth = organ.azimuth + organ.turn * float(within) +\n2.0f * organ.variation * organDice(plant, number, 0u);\nfloat pitch = mix(organ.pitch.x, organ.pitch.y, share) +\n0.8f * organ.variation * organDice(plant, number, 1u);\nvec3 outwards = cos(azimuth) * side + sin(azimuth) * front;\nPosedBlade ribbon;\nribbon.blade = plant;\nribbon.blade.height = plant.height * mix(organ.size.x, organ.size.y, share) *\n(1.0f + 0.6f * organ.variation * organDice(plant, number, 2u));\nribbon.axis = cos(azimuth) * front - sin(azimuth) * side;\nfloat leg = organ.leg * ribbon.blade.height;\nribbon.v0 = bezierPoint(stalk.v0, stalk.v1, stalk.v2, t);\nvec3 v1 = ribbon.v0 + leg * (cos(pitch) * along + sin(pitch) * outwards);\nvec3 v2 =\nv1 + leg * (cos(pitch + organ.bend) * along + sin(pitch + organ.bend) * outwards);\nribbon.v1 = aboveGround(plant.root, plant.up, v1);\nribbon.v2 = aboveGround(plant.root, plant.up, v2);\nreturn ribbon;\n}\nPosedBlade ribbonOf(OrganTable organs, Species species, PosedBlade stalk, uint number)\n{\nuint within = 0u;\nuint kind = organOf(organs, species, number, within);\nreturn posedRibbon(stalk, fetchOrganTable(uint(kind)), number, within);\n}\n#endif\n",
  // shaders/shared/sun_shadow.h
  "#ifndef SWARD_SHARED_SUN_SHADOW_H\n#define SWARD_SHARED_SUN_SHADOW_H\n",
  // shaders/shared/sun_shadow.h
  "struct SunDepthTable { uint none; };\nfloat fetchSunDepthTable(uint i);\nstruct SunShadow {\nvec4 across;\nvec4 down;\nvec4 depth;\nuint size;\nfloat texel;\nfloat epsilon;\nuint reserved;\n};\nconst float shadowOffset = 2.0f;\nfloat sunSeen(SunShadow shadow, vec3 place, vec3 normal)\n{\nif (shadow.size == 0u)\nreturn 1.0f;\nvec4 lifted = vec4(place + normal * (shadowOffset * shadow.texel), 1.0f);\nvec2 at = vec2(dot(shadow.across, lifted), dot(shadow.down, lifted)) - 0.5f;\nfloat depth = dot(shadow.depth, lifted) + shadow.epsilon;\nvec2 f = at - floor(at);\nint last = int(shadow.size) - 2;\nint column = clamp(int(floor(at.x)), 0, last);\nint row = clamp(int(floor(at.y)), 0, last);\nint first = row * int(shadow.size) + column;\nint below = first + int(shadow.size);\nfloat above0 = fetchSunDepthTable(uint(first)) > depth ? 1.0f : 0.0f;\nfloat above1 = fetchSunDepthTable(uint(first + 1)) > depth ? 1.0f : 0.0f;\nfloat below0 = fetchSunDepthTable(uint(below)) > depth ? 1.0f : 0.0f;\nfloat below1 = fetchSunDepthTable(uint(below + 1)) > depth ? 1.0f : 0.0f;\nreturn 1.0f - mix(mix(above0, above1, f.x), mix(below0, below1, f.x), f.y);\n}\n#endif\n",
  // shaders/shared/update_rate.h
  "#ifndef SWARD_SHARED_UPDATE_RATE_H\n#define SWARD_SHARED_UPDATE_RATE_H\n",
  // shaders/shared/update_rate.h
  "struct UpdateRate {\nfloat everyFrame;\nfloat everyThird;\nfloat longest;\nuint frame;\n};\nconst float ticksPerSecond = 262144.0f;\nfloat secondsBetween(uint then, uint now)\n{\nreturn float(now - then) / ticksPerSecond;\n}\nconst float settlingTime = 12.0f;\nbool movesNow(UpdateRate updateRate, uint index, float distance, float elapsed)\n{\nif (distance < updateRate.everyFrame || elapsed >= updateRate.longest)\nreturn true;\nreturn distance < updateRate.everyThird && (updateRate.frame + index) % 3u == 0u;\n}\n#endif\n",
  // shaders/shared/frame.h
  "struct VisibleBlade {\nuint blade;\nuint patchIndex;\nuint factors;\nfloat pixels;\n};\nconst uint heightFactorBits = 0x03ff0000u;\nuint packFactors(float width, float height)\n{\nreturn packHalf2x16(vec2(width, height)) & (heightFactorBits | 0xffffu);\n}\nfloat widthFactorOf(VisibleBlade visible)\n{\nreturn unpackHalf2x16(visible.factors).x;\n}\nfloat heightFactorOf(VisibleBlade visible)\n{\nreturn unpackHalf2x16((visible.factors & heightFactorBits) | 0x3c000000u).y;\n}\nconst uint quarters = 4u;\nconst uint allQuarters = 15u;\nconst uint lateShift = 28u;\nuint beginOfQuarter(uint i, uint segments)\n{\nreturn i * segments / quarters;\n}\nuint quarterOf(float i, float segments)\n{\nreturn uint((4.0f * i + 3.25f) / segments);\n}\nstruct DrawArguments {\nuint vertexCount;\nuint instanceCount;\nuint firstVertex;\nuint firstInstance;\nuint simulated;\nuint cullResults[7];\n};\nstruct VisibleArray { uint none; };\nVisibleBlade fetchVisibleArray(uint i);\nstruct DrawArray { uint none; };\nDrawArguments fetchDrawArray(uint i);\nstruct FloatArray { uint none; };\nfloat fetchFloatArray(uint i);\nstruct UintArray { uint none; };\nuint fetchUintArray(uint i);\nstruct FrameArray { uint none; };\n#endif\n",
  // web/shaders/frame.glsl
  "layout(std140) uniform FrameConstants\n{\nmat4 viewProjection;\nvec3 rays[3];\nfloat depthOfEye;\nEyepoint view;\nEnvironment environment;\nuint patchCount;\nuint bladeCount;\nuint visibleCapacity;\nuint maxTessellation;\nvec3 sunDirection;\nfloat exposure;\nvec3 sunColor;\nuint debugMode;\nvec3 skyColor;\nfloat fogDensity;\nvec3 groundColor;\nvec3 skyUp;\nfloat fixedTessellation;\nfloat clouds;\nLevelSteps levelSteps;\nUpdateRate updateRate;\nCover cover;\nSunShadow shadow;\nBladeShadow bladeShadow;\nfloat\nfogFalloff;\nfloat lowSun;\nuint tick;\nFloorPlane floorPlane;\nuint reserved[36];\n}\nframeConstants;\n#define FRAME frameConstants\nstruct Looks {\nSpecies species[maxSpecies];\nOrgan organs[maxOrganKinds];\n};\nlayout(std140) uniform LookTables\n{\nLooks looks;\n};\nuniform usampler2D coverTexture;\nuniform sampler2D sunTexture;\nuniform usampler2D bladeShadowTexture;\nconst uint tableWidth = 2048u;\nivec2 placeInTable(uint i)\n{\nreturn ivec2(int(i % tableWidth), int(i / tableWidth));\n}\nuint fetchCoverTable(uint i)\n{\nreturn texelFetch(coverTexture, placeInTable(i), 0).x;\n}\nfloat fetchSunDepthTable(uint i)\n{\nuint size = FRAME.shadow.size;\nreturn 1.0 - texelFetch(sunTexture, ivec2(int(i % size), int(size - 1u - i / size)), 0).x;\n}\nuvec2 fetchBladeShadowTable(uint i)\n{\nuint size = FRAME.bladeShadow.size;\nreturn texelFetch(bladeShadowTexture, ivec2(int(i / size), int(size - 1u - i % size)), 0).xy;\n}\nSpecies fetchSpeciesArray(uint i)\n{\nreturn looks.species[i];\n}\nOrgan fetchOrganTable(uint i)\n{\nreturn looks.organs[i];\n}\nCollider fetchColliderTable(uint i)\n{\nCollider none;\nreturn none;\n}\nint findLSB(uint bits)\n{\nreturn -1;\n}\nvec4 unpackUnorm4x8(uint bits)\n{\nreturn vec4(uvec4(bits, bits >> 8u, bits >> 16u, bits >> 24u) & 255u) / 255.0;\n}\nuint packUnorm4x8(vec4 v)\n{\nuvec4 bytes = uvec4(floor(clamp(v, 0.0, 1.0) * 255.0 + 0.5));\nreturn bytes.x | (bytes.y << 8u) | (bytes.z << 16u) | (bytes.w << 24u);\n}\nuniform vec2 jitter;\nvec4 inClip(vec4 place)\n{\nplace.xy -= jitter * place.w;\nreturn vec4(place.x, -place.y, place.w - 2.0 * place.z, place.w);\n}\n#endif\n",
  // web/shaders/blades.glsl
  "uniform usampler2D bladeTexture;\nuniform usampler2D stateTexture;\nuniform usampler2D patchTexture;\nconst uint groupBlades = 32u;\nlayout(location = 0) in uvec3 group;\nconst uint patchTexels = 7u;\nconst uint patchesOfRow = 256u;\nuvec4 patchPart(uint i, uint part)\n{\nreturn texelFetch(patchTexture, ivec2(int((i % patchesOfRow) * patchTexels + part), int(i / patchesOfRow)), 0);\n}\nPatch fetchPatchArray(uint i)\n{\nuvec4 a = patchPart(i, 0u);\nuvec4 b = patchPart(i, 1u);\nuvec4 c = patchPart(i, 2u);\nuvec4 d = patchPart(i, 3u);\nuvec4 e = patchPart(i, 4u);\nuvec4 f = patchPart(i, 5u);\nuvec4 g = patchPart(i, 6u);\nPatch cell;\ncell.boundsLow = uintBitsToFloat(a.xyz);\ncell.firstBlade = a.w;\ncell.boundsHigh = uintBitsToFloat(b.xyz);\ncell.bladeCount = b.w;\ncell.rootLow = uintBitsToFloat(c.xyz);\ncell.rootStep = uintBitsToFloat(c.w);\ncell.coneAxis = uintBitsToFloat(d.xyz);\ncell.coneCosine = uintBitsToFloat(d.w);\ncell.heightLow = uintBitsToFloat(e.x);\ncell.heightStep = uintBitsToFloat(e.y);\ncell.widthLow = uintBitsToFloat(e.z);\ncell.widthStep = uintBitsToFloat(e.w);\ncell.parent = f.x;\ncell.firstChild = f.y;\ncell.childCount = f.z;\ncell.level = f.w;\ncell.rankLow = uintBitsToFloat(g.x);\ncell.rankHigh = uintBitsToFloat(g.y);\nreturn cell;\n}\nPackedBlade fetchBladeArray(uint i)\n{\nuvec4 bits = texelFetch(bladeTexture, placeInTable(i), 0);\nreturn PackedBlade(bits.x, bits.y, bits.z, bits.w);\n}\nuint fetchUintArray(uint i)\n{\nreturn texelFetch(stateTexture, placeInTable(i), 0).x;\n}\n#endif\n",
  // shaders/shared/physics.h
  "#ifndef SWARD_SHARED_PHYSICS_H\n#define SWARD_SHARED_PHYSICS_H\n",
  // shaders/shared/wind.h
  "#ifndef SWARD_SHARED_WIND_H\n#define SWARD_SHARED_WIND_H\n",
  // shaders/shared/wind.h
  "#ifndef WIND_SOURCE\n#define WIND_SOURCE(wind, i) wind.sources[i]\n#define WIND_PHASE(wind, i) wind.phases[i]\n#define WIND_LATTICE(wind) wind.lattice\n#endif\nuint windCount(uint counts, uint kind)\n{\nreturn (counts >> (4u * kind)) & 15u;\n}\nWindSource preparedSource(WindSource source)\n{\nWindSource prepared = source;\nprepared.side = abs(source.direction.y) < 0.99f\n? normalize(cross(source.direction, vec3(0.0f, 1.0f, 0.0f)))\n: vec3(1.0f, 0.0f, 0.0f);\nprepared.perSize = 1.0f / source.size;\nreturn prepared;\n}\nbool blowsLike(WindSource a, WindSource b)\n{\nbool hasAmounts = (a.kind == windNoise || a.kind == windWave || a.kind == windGusts) &&\n(b.kind == windNoise || b.kind == windWave || b.kind == windGusts);\nreturn hasAmounts && a.direction == b.direction && a.alignment == b.alignment &&\na.lift == b.lift;\n}\nconst float fineNoiseStart = 17.3f;\nconst float fineNoiseScale = 2.7f;\nconst uint gustRows = 7u;\nWindPhase windPhaseAtZero()\n{\nWindPhase phase;\nphase.shift = vec3(0.0f);\nphase.cell = 0u;\nphase.fineShift = vec3(fineNoiseStart);\nphase.fineCell = 0u;\nphase.angle = 0.0f;\nphase.turned = 0.0f;\nreturn phase;\n}\nfloat windWaveAt(WindSource source, WindPhase phase, vec3 position, float time)\n{\nfloat k = 6.2831853f * source.perSize;\nfloat along = k * (dot(position, source.direction) - source.speed * time) - phase.angle;\nfloat across = k * dot(position, source.side);\nfloat sum = cos(0.9f * along + 0.4f * across) + sin(0.55f * along - 0.25f * across) +\nsin(0.3f * along + 0.6f * across);\nreturn 1.0f - max(sum / 3.0f, 0.0f);\n}\nvec3 inLattice(Wind wind, vec3 v, vec3 shift)\n{\nvec3 x = WIND_LATTICE(wind).x;\nvec3 y = WIND_LATTICE(wind).y;\nvec3 z = WIND_LATTICE(wind).z;\nreturn vec3(((shift.x + x.x * v.x) + x.y * v.y) + x.z * v.z,\n((shift.y + y.x * v.x) + y.y * v.y) + y.z * v.z,\n((shift.z + z.x * v.x) + z.y * v.y) + z.z * v.z);\n}\nfloat windNoiseAt(Wind wind, WindSource source, WindPhase phase, vec3 position,\nfloat time)\n{\nfloat along = dot(position, source.direction) - 2.0f * source.speed * time;\nvec3 stretched = inLattice(\nwind, (0.5f * source.perSize) * (position + source.direction * along), phase.shift);\nfloat gust =\n0.65f * valueNoiseFrom(phase.cell, stretched) +\n0.35f * valueNoiseFrom(phase.fineCell, fineNoiseScale * stretched + phase.fineShift);\nreturn 2.0f * gust * gust;\n}\nconst float gustRise = 0.12f;\nfloat windGustAt(Wind wind, WindSource source, WindPhase phase, vec3 position, float time)\n{\nfloat along = dot(position, source.direction);\nvec3 across =\ninLattice(wind, source.perSize * (position - source.direction * along), vec3(0.0f));\nfloat bend = 0.8f * (valueNoise(0.7f * across + vec3(5.1f)) - 0.5f) + phase.shift.x;\nfloat fronts = (source.speed * time - along) * source.perSize + bend;\nfloat front = floor(fronts);\nfloat s = fronts - front;\nfloat rise = clamp(s / gustRise, 0.0f, 1.0f);\nfloat fall = clamp((1.0f - s) / (1.0f - gustRise), 0.0f, 1.0f);\nfloat profile = rise * rise * (3.0f - 2.0f * rise) * fall * fall;\nfloat own =\nvalueNoiseFrom(phase.cell, across + vec3(0.0f, 0.0f, float(gustRows) * front));\nreturn profile * clamp(2.0f * own - 0.2f, 0.0f, 1.0f);\n}\nvec3 parabolicSine(vec3 x)\n{\nvec3 f = 2.0f * fract(x) - vec3(1.0f);\nreturn -4.0f * f * (vec3(1.0f) - abs(f));\n}\nconst vec3 eddyDrift = vec3(0.48f, 0.57f, 0.67f);\nvec3 windEddies(float size, float speed, vec3 phase, vec3 position, float time)\n{\nvec3 q = (position + eddyDrift * (speed * time)) / size + phase;\nvec3 s = parabolicSine(q);\nvec3 c = parabolicSine(q + vec3(0.25f));\nreturn 0.7f * (vec3(s.z, s.x, s.y) + vec3(c.y, c.z, c.x));\n}\nconst float radialExtent = 75.0f;\nconst float swirlExtent = 30.0f;\nvec3 windAround(WindSource source, WindPhase phase, vec3 arm, vec3 up, float time,\nbool isSwirl)\n{\nfloat distance = length(arm);\nvec3 away = arm / (distance + 0.01f * source.size);\nfloat unit = (isSwirl ? swirlExtent : radialExtent) / source.size;\nfloat r = unit * distance;\nfloat fade = max(1.0f - 0.25f * log2((isSwirl ? 0.5f : 0.2f) * r + 1.0f), 0.0f);\nfloat along = r - unit * source.speed * time - phase.angle;\nif (!isSwirl)\nreturn away * (fade * (1.0f - max(sin(0.4f * along), 0.0f)));\nfloat ring = sin(0.1f * along);\nreturn (away + 1.5f * (1.0f - fade * fade) * cross(up, away)) * (fade * ring * ring * ring);\n}\nvec3 windAlong(Wind wind, WindSource source, vec3 direction, float amount, vec3 position,\nvec3 up, float time)\n{\nfloat head = (1.0f - source.lift) * abs(dot(source.direction, up));\nvec3 flow = direction;\nif (head > 0.0f)\nflow += head * windEddies(wind.eddySize, wind.eddySpeed, wind.eddyPhase, position, time);\nreturn amount * flow;\n}\nvec3 windFelt(WindSource source, vec3 flow, BladeAxes axes, vec3 direction)\n{\nvec3 wind = alongAxes(axes, flow);\nwind.z *= source.lift;\nfloat square = dot(wind, wind);\nfloat along = square > 1e-12f ? abs(dot(wind, direction)) * inversesqrt(square) : 0.0f;\nreturn (1.0f - source.alignment * along) * wind;\n}\nfloat windAmount(Wind wind, vec3 position, float time)\n{\nfloat sum = 0.0f;\nuint next = 0u;\nfor (uint i = windCount(wind.counts, windNoise); i > 0u; --i) {\nWindPhase phase = WIND_PHASE(wind, next);\nWindSource source = WIND_SOURCE(wind, next++);\nsum += source.strength * windNoiseAt(wind, source, phase, position, time);\n}\nfor (uint i = windCount(wind.counts, windWave); i > 0u; --i) {\nWindPhase phase = WIND_PHASE(wind, next);\nWindSource source = WIND_SOURCE(wind, next++);\nfloat wave = windWaveAt(source, phase, position, time);\nsum += source.strength * wave * wave;\n}\nfor (uint i = windCount(wind.counts, windGusts); i > 0u; --i) {\nWindPhase phase = WIND_PHASE(wind, next);\nWindSource source = WIND_SOURCE(wind, next++);\nsum += source.strength * windGustAt(wind, source, phase, position, time);\n}\nreturn sum;\n}\nvec3 windOfAmount(Wind wind, float amount, vec3 position, BladeAxes axes, vec3 direction,\nfloat time)\n{\nWindSource source = WIND_SOURCE(wind, 0);\nreturn amount *\nwindFelt(source,\nwindAlong(wind, source, source.direction, 1.0f, position, axes.up, time), axes,\ndirection);\n}\nvec3 windAlongAxes(Wind wind, vec3 root, BladeAxes axes, vec3 direction, float time)\n{\nvec3 position = root + WIND_LATTICE(wind).origin;\nif ((wind.counts & windsAlike) != 0u)\nreturn windOfAmount(wind, windAmount(wind, position, time), position, axes, direction,\ntime);\nvec3 sum = vec3(0.0f);\nuint next = 0u;\nfor (uint i = windCount(wind.counts, windNoise); i > 0u; --i) {\nWindPhase phase = WIND_PHASE(wind, next);\nWindSource source = WIND_SOURCE(wind, next++);\nfloat amount = source.strength * windNoiseAt(wind, source, phase, position, time);\nsum += windFelt(source,\nwindAlong(wind, source, source.direction, amount, position, axes.up, time),\naxes, direction);\n}\nfor (uint i = windCount(wind.counts, windTurning); i > 0u; --i) {\nWindPhase phase = WIND_PHASE(wind, next);\nWindSource source = WIND_SOURCE(wind, next++);\nfloat angle = source.turn * time + phase.turned;\nvec3 turned =\nsource.direction * cos(angle) + cross(axes.up, source.direction) * sin(angle);\nfloat amount =\nsource.strength * sin(source.rate * time + phase.angle -\n(6.2831853f * source.perSize) * dot(position, source.direction));\nsum += windFelt(source, windAlong(wind, source, turned, amount, position, axes.up, time),\naxes, direction);\n}\nfor (uint i = windCount(wind.counts, windWave); i > 0u; --i) {\nWindPhase phase = WIND_PHASE(wind, next);\nWindSource source = WIND_SOURCE(wind, next++);\nfloat wave = windWaveAt(source, phase, position, time);\nfloat amount = source.strength * wave * wave;\nsum += windFelt(source,\nwindAlong(wind, source, source.direction, amount, position, axes.up, time),\naxes, direction);\n}\nfor (uint i = windCount(wind.counts, windRadial); i > 0u; --i) {\nWindPhase phase = WIND_PHASE(wind, next);\nWindSource source = WIND_SOURCE(wind, next++);\nsum += windFelt(source,\nsource.strength *\nwindAround(source, phase, root - source.centre, axes.up, time, false),\naxes, direction);\n}\nfor (uint i = windCount(wind.counts, windSwirl); i > 0u; --i) {\nWindPhase phase = WIND_PHASE(wind, next);\nWindSource source = WIND_SOURCE(wind, next++);\nsum += windFelt(source,\nsource.strength *\nwindAround(source, phase, root - source.centre, axes.up, time, true),\naxes, direction);\n}\nfor (uint i = windCount(wind.counts, windGusts); i > 0u; --i) {\nWindPhase phase = WIND_PHASE(wind, next);\nWindSource source = WIND_SOURCE(wind, next++);\nfloat amount = source.strength * windGustAt(wind, source, phase, position, time);\nsum += windFelt(source,\nwindAlong(wind, source, source.direction, amount, position, axes.up, time),\naxes, direction);\n}\nreturn sum;\n}\nvec3 windAt(Wind wind, vec3 position, vec3 up, float time)\n{\nBladeAxes axes = axesTowards(up, tangentOf(up));\nreturn inSpace(axes, windAlongAxes(wind, position, axes, vec3(0.0f), time));\n}\nvec3 windForce(Wind wind, vec3 root, vec3 up, vec3 tip, float time)\n{\nBladeAxes axes = axesTowards(up, tangentOf(up));\nvec3 direction = alongAxes(axes, tip / max(length(tip), 1e-6f));\nreturn max(dot(tip, up), 0.0f) *\ninSpace(axes, windAlongAxes(wind, root, axes, direction, time));\n}\n#endif\n",
  // shaders/shared/physics.h
  "vec3 environmentAt(Gravity gravity, vec3 root)\n{\nvec3 towards = gravity.direction;\nif (gravity.blend > 0.0f) {\nvec3 toAttractor = gravity.attractor - root;\nfloat distance = length(toAttractor);\nvec3 pull = distance > 1e-6f ? toAttractor / distance : vec3(0.0f);\ntowards = mix(gravity.direction, pull, gravity.blend);\n}\nreturn gravity.strength * towards;\n}\nvec3 gravityAt(Gravity gravity, vec3 root, vec3 front)\n{\nvec3 environment = environmentAt(gravity, root);\nreturn environment + gravity.forward * length(environment) * front;\n}\nstruct TurnQuotient {\nvec2 over;\nvec2 under;\n};\nvec2 timesConjugate(vec2 a, vec2 b)\n{\nreturn vec2(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y);\n}\nvec2 turnAbove(TurnQuotient turn)\n{\nvec2 product = timesConjugate(turn.over, turn.under);\nfloat under = dot(turn.under, turn.under);\nif (dot(turn.over, turn.over) <= under)\nreturn (1.0f / under) * product;\nfloat square = dot(product, product);\nreturn square > 1e-30f ? inversesqrt(square) * product : vec2(1.0f, 0.0f);\n}\nvec3 directionOfQuotient(TurnQuotient turn)\n{\nfloat over = dot(turn.over, turn.over);\nfloat under = dot(turn.under, turn.under);\nvec2 product = timesConjugate(turn.over, turn.under);\nreturn (1.0f / (under + over)) * vec3(2.0f * product.x, 2.0f * product.y, under - over);\n}\nconst float lyingBelow = 1e-3f;\nTurnQuotient relaxTurn(float stiffness, vec3 force, float recovery, vec2 turn, bool lies,\nfloat radius, float eta, float dt)\n{\nfloat b = 1.0f - stiffness;\nfloat k = max(recovery * (1.0f - 0.25f * b) * max(1.0f - eta, 0.1f), 1e-3f);\nvec3 pull = b * force;\npull.z += k;\nif (lies)\npull.z = max(pull.z, 0.0f);\nfloat strength = length(pull);\nTurnQuotient turned;\nturned.over = turn;\nturned.under = vec2(1.0f, 0.0f);\nif (strength < 1e-6f * k)\nreturn turned;\nfloat fall = exp(-(strength / radius) * dt);\nfloat above = strength + pull.z;\nfloat below = strength - pull.z;\nvec2 towards = (1.0f - fall) * vec2(pull.x, pull.y);\nturned.over = (fall * above + below) * turn + towards;\nturned.under = timesConjugate(turn, towards);\nturned.under.x += above + fall * below;\nreturn turned;\n}\nvec3 relaxTip(Blade blade, vec3 front, Gravity gravity, vec3 wind, float recovery,\nvec3 tip, float eta, float dt)\n{\nBladeAxes axes = axesTowards(blade.up, front);\nfloat radius = max(length(tip), 1e-6f);\nvec3 force = gravityAt(gravity, blade.root, front) + wind;\nvec3 direction = alongAxes(axes, tip / radius);\nreturn inSpace(axes, directionOfQuotient(relaxTurn(blade.stiffness, alongAxes(axes, force),\nrecovery, turnTowards(direction),\ndirection.z < lyingBelow, radius, eta, dt)));\n}\nconst uint contactRounds = 3u;\nconst float middleLever = 2.0f;\nvec3 pushBlade(Blade blade, vec3 front, ColliderTable colliders, ColliderMask near,\nvec3 tipBefore, vec3 tip, float back, inout float pushed,\ninout bool resting)\n{\nPose pose = poseBlade(blade.up, front, tip);\nvec3 result = tip;\nbool touched = true;\nfor (uint turn = 0u; turn < contactRounds && touched; ++turn) {\ntouched = false;\nfor (uint word = 0u; word < colliderWords; ++word) {\nfor (uint bits = near.words[word]; bits != 0u; bits &= bits - 1u) {\nCollider collider = colliderSeenFrom(\nfetchColliderTable(uint(32u * word + uint(findLSB(bits)))), blade.root, blade.height, back);\nif (length(towardsSegment(collider, vec3(0.0f))) >= collider.radius + 1.0f)\ncontinue;\nfor (uint point = 0u; point < 2u; ++point) {\nvec3 middle = 0.5f * pose.v1 + 0.25f * pose.v2;\nvec3 push = point == 0u ? pushOut(collider, pose.v2, front)\n: middleLever * pushOut(collider, middle, front);\nif (dot(push, push) > 0.0f) {\nvec3 before = pose.v2;\npose = poseBlade(blade.up, front, before + push);\nresult = pose.v2;\npushed += length(result - before);\nresting = resting && dot(collider.velocity, collider.velocity) == 0.0f;\ntouched = true;\n}\n}\n}\n}\n}\nreturn touched && resting ? poseBlade(blade.up, front, tipBefore + result).v2 : result;\n}\nconst float longestStep = 0.034f;\nconst uint maxSteps = 16u;\nconst float stickingSpeed = 0.06f;\nBladeState advanceBlade(Blade blade, Environment environment, ColliderMask near,\nBladeState state, float time, float elapsed)\n{\nBladeAxes axes = axesAlong(blade.up, widthAxis(blade.up, blade.facing));\nfloat fade = 0.5f * max(blade.stiffness, 0.1f);\nuint steps = uint(clamp(ceil(elapsed / longestStep), 1.0f, float(maxSteps)));\nfloat dt = elapsed / float(steps);\nvec3 pull = environmentAt(environment.gravity, blade.root);\nvec3 gravity = alongAxes(axes, pull);\ngravity.x += environment.gravity.forward * length(pull);\nvec2 first = storedTurn(state);\nvec2 turn = first;\nfloat eta = state.eta;\nfloat pushed = 0.0f;\nbool resting = true;\nfor (uint i = 0u; i < steps; ++i) {\nfloat back = elapsed - dt * float(i + 1u);\neta = max(eta - fade * dt, 0.0f);\nvec3 direction = directionOfTurn(turn);\nfloat radius = tipDistance(direction);\nfloat before = pushed;\nvec3 wind =\nwindAlongAxes(environment.wind, blade.root, axes, direction, time - back - 0.5f * dt);\nturn = turnAbove(relaxTurn(blade.stiffness, gravity + (radius * direction.z) * wind,\nenvironment.recovery, turn, direction.z < lyingBelow, radius,\neta, dt));\nif (false) {\nvec3 moved = directionOfTurn(turn);\nvec3 tip = pushBlade(\nblade, axes.front, ColliderTable(0u), near, inSpace(axes, radius * direction),\ninSpace(axes, tipDistance(moved) * moved), back, pushed, resting);\nif (pushed > before)\nturn = turnTowards(alongAxes(axes, normalize(tip)));\neta = min(eta + (pushed - before), 1.0f);\n}\n}\nif (pushed > 0.0f && resting) {\nvec3 from = directionOfTurn(first);\nvec3 to = directionOfTurn(turn);\nif (length(tipDistance(to) * to - tipDistance(from) * from) < stickingSpeed * elapsed)\nreturn state;\n}\nreturn stateOfTurn(turn, eta);\n}\n#endif\n",
  // shaders/shared/visibility.h
  "#ifndef SWARD_SHARED_VISIBILITY_H\n#define SWARD_SHARED_VISIBILITY_H\n",
  // shaders/shared/ribbon.h
  "#ifndef SWARD_SHARED_RIBBON_H\n#define SWARD_SHARED_RIBBON_H\n",
  // shaders/shared/ribbon.h
  "struct Ribbon {\nvec3 v0;\nvec3 v1;\nvec3 v2;\nvec3 axis;\nfloat width;\nfloat fold;\nOutline outline;\nuint seed;\n};\nstruct CrossSection {\nvec3 left;\nvec3 right;\nvec3 ridge;\nfloat wide;\nfloat drawn;\n};\nfloat foldOf(float fold, float widthPixels)\n{\nreturn fold * smoothstep(2.0f, 4.0f, widthPixels);\n}\nvec3 directionAt(Ribbon ribbon, float t)\n{\nvec3 tangent = bezierTangent(ribbon.v0, ribbon.v1, ribbon.v2, t);\nreturn dot(tangent, tangent) > 1e-18f ? tangent : ribbon.v1 - ribbon.v0;\n}\nvec3 tangentAt(Ribbon ribbon, float t)\n{\nreturn normalize(directionAt(ribbon, t));\n}\nvec3 outwardsOf(vec3 across, vec3 level)\n{\nfloat square = dot(level, level);\nvec3 unit = square > 1e-18f ? level * inversesqrt(square) : across;\nfloat upright = dot(unit, across);\nreturn across + (upright / max(upright * upright, 0.25f)) * (unit - upright * across);\n}\nCrossSection crossSectionAt(Ribbon ribbon, float t, vec3 eye, float minWidth)\n{\nvec3 centre = bezierPoint(ribbon.v0, ribbon.v1, ribbon.v2, t);\nvec3 direction = directionAt(ribbon, t);\nvec2 edges = ribbon.width * edgesAt(ribbon.outline, t);\nCrossSection section;\nsection.left = centre + edges.x * ribbon.axis;\nsection.right = centre + edges.y * ribbon.axis;\nsection.wide = edges.y - edges.x;\nsection.drawn = section.wide;\nif (minWidth > 0.0f) {\nfloat half_ = 0.5f / max(ribbon.outline.segments, 1.0f);\nvec3 chord = directionAt(ribbon, clamp(t, half_, 1.0f - half_));\nvec3 ray = centre - eye;\nfloat distance = length(ray);\nvec3 side = cross(ray, chord);\nfloat square = dot(side, side);\nvec3 across = square > 1e-12f * dot(ray, ray) * dot(chord, chord)\n? side * inversesqrt(square)\n: ribbon.axis;\nfloat seen = dot(ribbon.axis, across);\nsection.wide *= abs(seen);\nsection.drawn = max(section.wide, minWidth * distance);\nvec3 outwards = outwardsOf(across, cross(ray, ribbon.v1 - ribbon.v0));\nvec3 grown =\n(0.5f * (section.drawn - section.wide) * (seen < 0.0f ? -1.0f : 1.0f)) * outwards;\nsection.left -= grown;\nsection.right += grown;\n}\nsection.ridge = 0.5f * (section.left + section.right);\nif (ribbon.fold > 0.0f)\nsection.ridge +=\n(0.5f * ribbon.fold * (edges.y - edges.x)) * normalize(cross(direction, ribbon.axis));\nreturn section;\n}\nfloat sectionMargin(float distance, float minWidth)\n{\nreturn minWidth * distance;\n}\nfloat marginBeside(float width, float distance, float minWidth)\n{\nreturn 0.5f * outlineMost * width + sectionMargin(distance, minWidth);\n}\nstruct SampleMask {\nfloat threshold;\nuint first;\nuint samples;\n};\nSampleMask sampleMaskOf(uint seed, uint samples)\n{\nSampleMask mask;\nmask.threshold = (float(seed & 0x1fffu) + 0.5f) / 8192.0f;\nmask.first = (seed >> 13u) % samples;\nmask.samples = samples;\nreturn mask;\n}\nuint keptCount(SampleMask mask, float weight)\n{\nreturn weight < 1.0f ? uint(max(weight, 0.0f) * float(mask.samples) + mask.threshold)\n: mask.samples;\n}\nuint keptBits(SampleMask mask, float weight)\n{\nuint all = (1u << mask.samples) - 1u;\nuint bits = (1u << min(keptCount(mask, weight), mask.samples)) - 1u;\nreturn ((bits << mask.first) | (bits >> (mask.samples - mask.first))) & all;\n}\nuint keptSamples(float weight, uint seed, uint samples)\n{\nreturn keptBits(sampleMaskOf(seed, samples), weight);\n}\n#endif\n",
  // shaders/shared/visibility.h
  "struct Verdict {\nuint cullResult;\nfloat widthFactor;\nfloat pixels;\nfloat margin;\n};\nfloat sparseShare(Eyepoint view, float share, float distance)\n{\nif (view.sparseFrom <= 0.0f || distance <= view.sparseFrom)\nreturn 1.0f;\nfloat nearness = view.sparseFrom / distance;\nreturn max(nearness * nearness * nearness, min(view.sparseLeast / share, 1.0f));\n}\nfloat leavesPerDrawn(Eyepoint view, float distance)\n{\nif (view.sparseFrom <= 0.0f || distance <= view.sparseFrom || view.lodThreshold <= 0.0f)\nreturn 1.0f;\nfloat share =\nlodShare(view.lodWidth * view.pixelsPerUnit / max(distance, 1e-6f), view.lodThreshold);\nreturn 1.0f / sqrt(sparseShare(view, share, distance));\n}\nfloat shareAt(Eyepoint view, float distance)\n{\nif (view.lodThreshold <= 0.0f)\nreturn lodFullShare;\nfloat share =\nlodShare(view.lodWidth * view.pixelsPerUnit / max(distance, 1e-6f), view.lodThreshold);\nreturn share * sparseShare(view, share, distance);\n}\nfloat middleWidth(Patch cell)\n{\nreturn cell.widthLow + 31.5f * cell.widthStep;\n}\nfloat leafAreaAround(Patch cell)\n{\nuint fewest = 4u;\nif (cell.bladeCount < fewest)\nreturn 0.0f;\nfloat count = float(cell.bladeCount);\nfloat side = 65535.0f * cell.rootStep * (count + 1.0f) / (count - 1.0f);\nfloat around = count / max(cell.rankHigh - cell.rankLow, 1e-6f);\nfloat height = cell.heightLow + 127.5f * cell.heightStep;\nreturn min(0.7f * around * middleWidth(cell) * height / max(side * side, 1e-12f), maxLeafArea);\n}\nfloat steepestRay(vec3 eye, Patch cell)\n{\nvec3 low = cell.boundsLow - eye;\nvec3 high = cell.boundsHigh - eye;\nvec3 middle = 0.5f * (low + high);\nfloat above =\nabs(dot(cell.coneAxis, middle)) + dot(abs(cell.coneAxis), 0.5f * (high - low));\nfloat nearest = max(boxDistance(eye, cell.boundsLow, cell.boundsHigh), 1e-6f);\nfloat slope = sqrt(max(1.0f - cell.coneCosine * cell.coneCosine, 0.0f));\nreturn min(above / nearest + max(slope - octahedralMaxError, 0.0f), 1.0f);\n}\nstruct LeafAreaLimit {\nfloat share;\nfloat height;\nfloat light;\n};\nLeafAreaLimit noLeafAreaLimit()\n{\nLeafAreaLimit limit;\nlimit.share = lodFullShare;\nlimit.height = 1.0f;\nlimit.light = 1.0f;\nreturn limit;\n}\nLeafAreaLimit leafAreaLimitOf(Eyepoint view, Patch cell)\n{\nLeafAreaLimit limit = noLeafAreaLimit();\nif (view.maxLeafArea <= 0.0f)\nreturn limit;\nfloat nearest = max(boxDistance(view.eye, cell.boundsLow, cell.boundsHigh), 1e-6f);\nfloat pixels = middleWidth(cell) * view.pixelsPerUnit / nearest;\nif (leafAreaShare(view.maxLeafArea, maxLeafArea, 0.0f, pixels) >= lodFullShare)\nreturn limit;\nfloat leafArea = min(view.areaFactor * leafAreaAround(cell), maxLeafArea);\nfloat cosine = steepestRay(view.eye, cell);\nlimit.share = leafAreaShare(view.maxLeafArea, leafArea, cosine, pixels);\nfloat range = 255.0f * cell.heightStep;\nfloat spread = min(2.0f * range / max(cell.heightLow + range, 1e-6f), 1.0f);\nlimit.height =\nheightCompensation(limit.share, leafAreaShare(1.0f, leafArea, cosine, 1.0f), spread);\nlimit.light = leafAreaLight(limit.share, spread);\nreturn limit;\n}\nBlade raised(Blade blade, float heightFactor)\n{\nBlade drawn = blade;\ndrawn.height = blade.height * heightFactor;\nreturn drawn;\n}\nstruct DrawnSize {\nfloat widthFactor;\nfloat pixels;\n};\nDrawnSize drawnSize(Eyepoint view, LeafAreaLimit limit, Blade blade, float rank,\nfloat distance)\n{\nfloat share = shareAt(view, distance);\nDrawnSize size;\nsize.widthFactor = lodWidthFactor(rank, share) / leavesPerDrawn(view, distance) *\nleafAreaWeight(rank / min(share, 1.0f), limit.share);\nsize.pixels = blade.height * view.pixelsPerUnit / max(distance, 1e-6f);\nreturn size;\n}\nfloat pixelsCovered(Blade blade, float height, float widthFactor)\n{\nreturn height * height * widthFactor * blade.width / blade.height;\n}\nfloat bladeRank(Patch cell, uint i)\n{\nreturn mix(cell.rankLow, cell.rankHigh, (float(i) + 0.5f) / float(cell.bladeCount));\n}\nfloat patchMargin(Eyepoint view, Patch cell, float widest)\n{\nvec3 farthest = max(abs(cell.boundsLow - view.eye), abs(cell.boundsHigh - view.eye));\nfloat share = shareAt(view, length(farthest));\nvec3 size = cell.boundsHigh - cell.boundsLow;\nfloat highest = 0.5f * min(size.x, min(size.y, size.z));\nreturn 0.5f * outlineMost * widest / (0.95f * share * leavesPerDrawn(view, length(farthest))) +\nsectionMargin(length(farthest), view.minWidth) +\n(view.maxLeafArea > 0.0f ? (maxHeightCompensation - 1.0f) * highest : 0.0f);\n}\nuint thickEnough(Eyepoint view, Patch cell)\n{\nif ((view.cullMask & leaveThinned) == 0u || view.lodThreshold <= 0.0f)\nreturn cell.bladeCount;\nfloat thinned = shareAt(view, boxDistance(view.eye, cell.boundsLow, cell.boundsHigh));\nfloat share = min(thinned, min(thinned, 1.0f) * leafAreaLimitOf(view, cell).share);\nif (share <= cell.rankLow)\nreturn 0u;\nif (share >= cell.rankHigh)\nreturn cell.bladeCount;\nfloat count = float(cell.bladeCount);\nfloat first = (share - cell.rankLow) / (cell.rankHigh - cell.rankLow) * count;\nreturn min(uint(ceil(first)) + 1u, cell.bladeCount);\n}\nbool thinnedBelow(Eyepoint view, Patch cell, float rankBelow)\n{\nreturn (view.cullMask & leaveThinned) != 0u && view.lodThreshold > 0.0f &&\nshareAt(view, boxDistance(view.eye, cell.boundsLow, cell.boundsHigh)) <= rankBelow;\n}\nbool patchCulled(Eyepoint view, Patch cell, float widest)\n{\nif ((view.cullMask & cullPatch) == 0u)\nreturn false;\nfloat margin = patchMargin(view, cell, widest);\nvec3 low = cell.boundsLow - vec3(margin);\nvec3 high = cell.boundsHigh + vec3(margin);\nbool outside = false;\nfor (uint i = 0u; i < 6u; ++i) outside =\noutside || boxOutside(view.planes[i], low, high);\nif (outside)\nreturn true;\nreturn (view.cullMask & cullDistance) != 0u &&\nboxDistance(view.eye, cell.boundsLow, cell.boundsHigh) > view.drawDistance;\n}\nbool seenTooNarrow(Eyepoint view, PosedBlade posed, float widthFactor)\n{\nBlade blade = posed.blade;\nfloat distance = length(posed.v0 - view.eye);\nfloat cosine = edgeOnCosine(view.eye, posed.v0, posed.axis);\nif (cosine > view.maxEdgeOn)\nreturn true;\nfloat nearest = distance - blade.height;\nif (nearest <= 0.0f || view.minWidth <= 0.0f)\nreturn false;\nfloat sine = min(sqrt(1.0f - cosine * cosine) + 1.58f * blade.height / distance, 1.0f);\nfloat widest = outlineMost * blade.width * widthFactor * sine;\nreturn keptSamples(widest / (view.minWidth * nearest), blade.seed, view.samples) == 0u;\n}\nVerdict cullBlade(Eyepoint view, LeafAreaLimit limit, PosedBlade posed, float rank)\n{\nBlade blade = posed.blade;\nfloat distance = length(blade.root - view.eye);\nDrawnSize size = drawnSize(view, limit, blade, rank, distance);\nfloat factor = size.widthFactor;\nVerdict verdict;\nverdict.cullResult = cullResultDrawn;\nverdict.widthFactor = factor;\nverdict.pixels = size.pixels;\nverdict.margin = 0.5f * outlineMost * blade.width * max(factor, 1.0f) +\nsectionMargin(distance + blade.height, view.minWidth);\nbool outside = false;\nif ((view.cullMask & cullFrustum) != 0u)\nfor (uint i = 0u; i < 6u; ++i) outside =\noutside || curveOutside(view.planes[i], posed.v0, posed.v1, posed.v2, verdict.margin);\nif ((view.cullMask & cullOrientation) != 0u &&\nseenTooNarrow(view, posed, factor > 0.0f ? factor : 1.0f))\nverdict.cullResult = cullResultOrientation;\nelse if (outside)\nverdict.cullResult = cullResultFrustum;\nelse if ((view.cullMask & cullDistance) != 0u &&\n(distance > view.drawDistance ||\n!bucketsKeep(view.buckets, view.bucketDistance, distance, rank)))\nverdict.cullResult = cullResultDistance;\nelse if (factor <= 0.0f)\nverdict.cullResult = cullResultLod;\nif (verdict.cullResult != cullResultDrawn)\nverdict.widthFactor = 0.0f;\nreturn verdict;\n}\n#endif\n",
  // web/shaders/move.vert
  "uniform float elapsed;\nuniform float stateRows;\nflat out uint outTurn;\nvoid main()\n{\noutTurn = 0u;\ngl_PointSize = 1.0;\ngl_Position = vec4(2.0, 2.0, 2.0, 1.0);\nif (uint(gl_VertexID) >= group.z)\nreturn;\nPatch cell = fetchPatchArray(group.x);\nuint index = cell.firstBlade + group.y + uint(gl_VertexID);\nBlade blade = unpackBlade(fetchBladeArray(index), cell);\nuint before = fetchUintArray(index);\nbool isNew = before == unsettledTurn;\nBladeState state = BladeState(isNew ? 0u : before, 0.0);\nColliderMask none;\noutTurn = before;\nfloat since = isNew ? settlingTime : elapsed;\nif (since > 0.0)\noutTurn = advanceBlade(blade, FRAME.environment, none, state, 0.0, since).turn;\nivec2 place = placeInTable(index);\ngl_Position = vec4((vec2(place) + 0.5) / vec2(float(tableWidth), stateRows) * 2.0 - 1.0, 0.0, 1.0);\n}\n",
  // web/shaders/move.frag
  "flat in uint outTurn;\nlayout(location = 0) out uint turn;\nvoid main()\n{\nturn = outTurn;\n}\n",
  // shaders/blade/blade_colors.glsl
  "#ifndef SWARD_BLADE_BLADE_COLORS_GLSL\n#define SWARD_BLADE_BLADE_COLORS_GLSL\n",
  // shaders/blade/blade_surface.glsl
  "#ifndef SWARD_BLADE_BLADE_SURFACE_GLSL\n#define SWARD_BLADE_BLADE_SURFACE_GLSL\n",
  // shaders/common/lighting.glsl
  "#ifndef SWARD_COMMON_LIGHTING_GLSL\n#define SWARD_COMMON_LIGHTING_GLSL\n",
  // shaders/common/output_mode.glsl
  "#ifndef SWARD_COMMON_OUTPUT_MODE_GLSL\n#define SWARD_COMMON_OUTPUT_MODE_GLSL\n",
  // shaders/shared/constants.h
  "#ifndef SWARD_SHARED_CONSTANTS_H\n#define SWARD_SHARED_CONSTANTS_H\n",
  // shaders/shared/constants.h
  "const uint idKnownDebugMode = 0u;\nconst uint idSamplesPerPixel = 1u;\nconst uint idHasForwardZ = 2u;\nconst uint idOutputMode = 3u;\nconst uint idWritesMotion = 4u;\nconst uint idStoredAs = 5u;\nconst uint idIsPaged = 6u;\nconst uint idOnlyShape = 7u;\nconst uint idMayFold = 8u;\nconst uint idMayHaveOrgans = 9u;\nconst uint idRole = 10u;\nconst uint idTakes = 11u;\nconst uint idFeatures = 12u;\nconst uint idWindCounts = 13u;\nconst uint idHasColliders = 14u;\nconst uint idKeepsBefore = 15u;\nconst uint idKeepsEtas = 16u;\nconst uint idTestsSmall = 17u;\nconst uint idPatchesOfGroup = 18u;\nconst uint idThreadsOfGroup = 19u;\nconst uint idLargeTo = 20u;\nconst uint idFillsAll = 21u;\nconst uint idIsOfColliders = 22u;\nconst uint idDrawsSunMap = 23u;\nconst uint idWritesDraws = 24u;\nconst uint idTileList = 25u;\nconst uint idShowsBlades = 26u;\nconst uint idShowsSky = 27u;\nconst uint idHasShadingCache = 28u;\nconst uint idHasHostLight = 29u;\nconst uint idLimitsLeafArea = 30u;\nconst uint debugNothing = 0u;\nconst uint debugWind = 3u;\nconst uint debugAsTold = 0xffffffffu;\nconst uint outputFilm = 0u;\nconst uint outputHost = 1u;\nconst uint outputRadiance = 2u;\nconst uint outputNone = 3u;\n#endif\n",
  // shaders/common/output_mode.glsl
  "const uint outputMode = 0u;\n#endif\n",
  // shaders/shared/distance_band.h
  "#ifndef SWARD_SHARED_DISTANCE_BAND_H\n#define SWARD_SHARED_DISTANCE_BAND_H\n",
  // shaders/shared/distance_band.h
  "const uint distanceBands = 8u;\nconst uint debugNear = 5u;\nuint distanceBand(float distance, float farthest)\n{\nfloat nearest = min(2.0f, 0.01f * farthest);\nfloat share = log2(max(distance, nearest) / nearest) / log2(farthest / nearest);\nreturn min(uint(float(distanceBands) * share), distanceBands - 1u);\n}\n#endif\n",
  // shaders/shared/look/blade_colors.h
  "#ifndef SWARD_SHARED_LOOK_BLADE_COLORS_H\n#define SWARD_SHARED_LOOK_BLADE_COLORS_H\n",
  // shaders/shared/look/blade_colors.h
  "struct BladeColors {\nvec3 root;\nvec3 tip;\n};\nconst vec3 throughTint = vec3(1.25f, 1.15f, 0.45f);\nconst float throughShare = 0.8f;\nfloat tipShareAt(float along)\n{\nreturn smoothstep(-0.15f, 0.8f, along);\n}\nvec3 decodeSrgb(vec3 c)\n{\nreturn mix(c / 12.92f, pow((c + 0.055f) / 1.055f, vec3(2.4f)), greaterThan(c, vec3(0.04045f)));\n}\nfloat chance(uint key)\n{\nreturn float(mixUint(key) >> 8u) * (1.0f / 16777215.0f);\n}\nfloat meadowAt(vec3 position)\n{\nreturn 0.65f * valueNoise(position / 2.3f) + 0.35f * valueNoise(position / 0.7f);\n}\nfloat regionAt(vec3 position)\n{\nreturn valueNoise(position / 13.0f + 71.0f);\n}\nvec3 shiftOf(float hue)\n{\nreturn vec3(1.0f + 0.75f * hue, 1.0f + 0.10f * hue, 1.0f - 0.45f * hue);\n}\nfloat clumpTone(uint clump)\n{\nreturn chance(clump * 977u + 11u);\n}\nvec3 meadowShade(vec3 position, float tone)\n{\nfloat meadow = meadowAt(position);\nfloat region = regionAt(position);\nfloat hue =\n0.45f * (0.7f * (tone - 0.5f) + 1.1f * (meadow - 0.5f) + 1.2f * (region - 0.5f));\nfloat light = 1.0f + 0.45f * (0.6f * (tone - 0.5f) + 0.5f * (meadow - 0.5f) +\n0.4f * (region - 0.5f));\nreturn light * shiftOf(hue);\n}\nBladeColors bladeColors(Cover cover, Blade blade, Species species, float leafArea)\n{\nfloat clump = clumpTone(blade.clump);\nuint kept = uint(blade.facing * (256.0f / twoPi) + 0.5f) |\n(uint(blade.stiffness * 63.0f + 0.5f) << 8u) |\n(uint(blade.tint.y * 63.0f + 0.5f) << 14u) | (blade.clump << 20u);\nfloat single = chance(kept * 16u + blade.hash);\nfloat other = chance(kept * 16u + blade.hash + 0x9e3779b9u);\nfloat meadow = meadowAt(blade.root);\nfloat region = regionAt(blade.root);\nfloat amount = species.colorVariation;\nfloat light = 1.0f + amount * (0.9f * (single - 0.5f) + 0.6f * (clump - 0.5f) +\n0.5f * (meadow - 0.5f) + 0.4f * (region - 0.5f));\nfloat hue = amount * (0.7f * (clump - 0.5f) + 0.5f * (other - 0.5f) +\n1.1f * (meadow - 0.5f) + 1.2f * (region - 0.5f));\nvec3 shift = shiftOf(hue);\nBladeColors colors;\nvec3 ground = groundUnder(cover, decodeSrgb(blade.tint), shift, cover.thinned * leafArea);\ncolors.root = mix(species.rootColor * shift, ground, species.groundTint) * light;\ncolors.tip = species.tipColor * shift * light;\nfloat dead = blade.clump == driedClump ? 1.0f : 0.0f;\nfloat dry =\nmax(smoothstep(0.0f, 0.25f, species.dryness * (0.6f + 0.8f * meadow) - other), dead);\nvec3 straw = vec3(0.42f, 0.32f, 0.13f) * (0.7f + 0.6f * single);\ncolors.tip = mix(colors.tip, straw, 0.8f * dry);\ncolors.root = mix(colors.root, straw * 0.6f, 0.25f * dry + 0.3f * dead);\nreturn colors;\n}\n#endif\n",
  // shaders/shared/look/film_curve.h
  "#ifndef SWARD_SHARED_LOOK_FILM_CURVE_H\n#define SWARD_SHARED_LOOK_FILM_CURVE_H\n",
  // shaders/shared/look/film_curve.h
  "vec3 filmOf(vec3 exposed)\n{\nvec3 x = exposed * 0.80f;\nvec3 film = (x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f);\nreturn clamp(film, 0.0f, 1.0f);\n}\n#endif\n",
  // shaders/shared/passes.h
  "const uint bladeShadowSegments = 8u;\n",
  // shaders/common/lighting.glsl
  "#ifndef FRAME\n#define FRAME push.frame.at[0]\n#endif\n#ifndef WIND_SOURCE\n#define WIND_SOURCE(wind, i) FRAME.environment.wind.sources[i]\n#define WIND_PHASE(wind, i) FRAME.environment.wind.phases[i]\n#define WIND_LATTICE(wind) FRAME.environment.wind.lattice\n#endif\n",
  // shaders/common/lighting.glsl
  "const uint knownDebugMode = 0u;\nconst bool paintsWind = knownDebugMode == debugWind;\nuint debugMode()\n{\nreturn knownDebugMode == debugAsTold ? FRAME.debugMode : knownDebugMode;\n}\nbool showsBands()\n{\nreturn debugMode() >= debugNear;\n}\nfloat luminance(vec3 color)\n{\nreturn dot(color, vec3(0.2126, 0.7152, 0.0722));\n}\nvec3 paleSky(float sunCosine)\n{\nfloat towards = 0.5 + 0.5 * sunCosine;\nvec3 pale = mix(vec3(1.12, 1.02, 0.90), vec3(1.36, 1.12, 0.96), FRAME.lowSun);\nreturn FRAME.skyColor * mix(pale, vec3(2.50, 1.45, 0.66), FRAME.lowSun * towards * towards);\n}\nvec3 glowAround(float sunCosine)\n{\nfloat toSun = max(sunCosine, 0.0);\nfloat glow = 0.10 * pow(toSun, 4.0) + 0.22 * pow(toSun, 32.0) + 0.5 * pow(toSun, 400.0);\nreturn glow * FRAME.sunColor * mix(vec3(0.36, 0.34, 0.31), vec3(0.45, 0.33, 0.22), FRAME.lowSun);\n}\nvec3 skyAbove(float height, float sunCosine)\n{\nvec3 zenith = FRAME.skyColor * vec3(0.15, 0.30, 0.56);\nreturn mix(paleSky(sunCosine), zenith, 1.0 - exp(-4.0 * height)) + glowAround(sunCosine);\n}\nvec3 skyRadiance(vec3 ray)\n{\nfloat height = dot(ray, FRAME.skyUp);\nfloat sunCosine = dot(ray, FRAME.sunDirection);\nif (height >= 0.0)\nreturn skyAbove(height, sunCosine);\nvec3 pale = paleSky(sunCosine);\nvec3 haze = mix(0.85 * pale, FRAME.groundColor, 0.2);\nreturn mix(pale, haze, 1.0 - exp(2.2 * height)) + glowAround(sunCosine);\n}\nvec3 hemisphere(vec3 n)\n{\nreturn mix(FRAME.groundColor, 1.25 * FRAME.skyColor, 0.5 + 0.5 * dot(n, FRAME.skyUp));\n}\nconst float passedAgain = 0.5;\nvec3 lightAmongLeaves(float leafArea, float below, float cosine, vec3 sun, vec3 sky, vec3 leaf)\n{\nfloat risen = max(cosine, lowestSun);\nfloat crossed = leafProjectionAlong(leafProjectionOf(FRAME.cover), risen) / risen;\nfloat left = exp(-crossed * leafArea);\nfloat open = skyBelow(leafArea);\nfloat leftAbove = leafArea > 1e-3 ? (1.0 - left) / (crossed * leafArea) : 1.0;\nfloat openAbove = leafArea > 1e-3 ? (1.0 - open) / (skyExtinction * leafArea) : 1.0;\nfloat leaves = 1.0 - open;\nfloat sunOfLeaves = leaves * leftAbove + below * left / (1.0 + crossed / skyExtinction);\nfloat skyOfLeaves = leaves * openAbove + below * open * 0.5;\nvec3 once = 0.25 * leaf * (sun * (crossed * risen * sunOfLeaves) + sky * skyOfLeaves);\nreturn once / (1.0 - passedAgain * leaf);\n}\nfloat clearBetween(float climb, float distance)\n{\nfloat rise = FRAME.fogFalloff * distance * climb;\nfloat mean = abs(rise) > 1e-3 ? (1.0 - exp(-rise)) / rise : 1.0 - 0.5 * rise;\nreturn exp(-FRAME.fogDensity * distance * mean);\n}\nvec3 throughAir(vec3 color, vec3 direction, float distance)\n{\nfloat climb = dot(direction, FRAME.skyUp);\nfloat perLength = inversesqrt(max(1.0 - climb * climb, 0.0) + 0.02 * 0.02);\nfloat sunCosine = dot(direction, FRAME.sunDirection) -\n(climb - 0.02) * dot(FRAME.skyUp, FRAME.sunDirection);\nreturn mix(skyAbove(0.02 * perLength, sunCosine * perLength), color, clearBetween(climb, distance));\n}\nvec3 develop(vec3 radiance)\n{\nif (outputMode == outputRadiance)\nreturn radiance * FRAME.exposure;\nreturn filmOf(radiance * FRAME.exposure);\n}\nfloat softness(float distance, float share)\n{\nif (FRAME.view.minWidth <= 0.0 || debugMode() != debugNothing)\nreturn 0.0;\nfloat widthPixels = FRAME.view.lodWidth * FRAME.view.pixelsPerUnit / max(distance, 1e-6);\nreturn share * (1.0 - smoothstep(0.6, 1.5, widthPixels));\n}\nvec3 dithered(vec3 color, vec2 place)\n{\nif (outputMode == outputRadiance)\nreturn color;\nuint h = mixUint(uint(place.x) + 65536u * uint(place.y));\nfloat noise = float(h >> 8u) * (1.0 / 16777215.0) - 0.5;\nreturn color + noise * (2.2 / 255.0) * pow(max(color, 0.0), vec3(0.5454));\n}\nvec3 colorOf(uint number)\n{\nuint h = mixUint(number * 2654435761u + 12345u);\nreturn 0.15 + 0.85 * vec3(h & 255u, (h >> 8u) & 255u, (h >> 16u) & 255u) / 255.0;\n}\nvec3 colorOfWind(vec3 position, vec3 up)\n{\nvec3 wind = windAt(FRAME.environment.wind, position, up, 0.0);\nfloat speed = clamp(length(wind) / max(FRAME.environment.wind.sum, 1e-6), 0.0, 1.0);\nreturn mix(mix(vec3(0.01, 0.03, 0.20), vec3(0.02, 0.45, 0.15), smoothstep(0.0, 0.45, speed)),\nvec3(1.0, 0.95, 0.8), smoothstep(0.35, 1.0, speed));\n}\n#endif\n",
  // shaders/blade/blade_surface.glsl
  "struct BladeSurface {\nvec4 root;\nvec4 tip;\nvec4 material;\n};\nfloat packedLook(vec3 look)\n{\nvec3 bytes = floor(clamp(look, 0.0, 1.0) * 255.0 + 0.5);\nreturn dot(bytes, vec3(65536.0, 256.0, 1.0));\n}\nvec3 unpackedLook(float packed)\n{\nuint bits = uint(packed);\nreturn vec3(uvec3(bits >> 16u, bits >> 8u, bits) & 255u) / 255.0;\n}\nfloat packedHeights(vec3 steps)\n{\nreturn packedLook(steps / float(heightSteps));\n}\nfloat leafAreaAbove(vec4 material, float along)\n{\nvec3 steps = float(heightSteps) * unpackedLook(material.z);\nfloat height = mix(mix(steps.x, steps.y, along), mix(steps.y, steps.z, along), along);\nreturn material.y * leafShareAbove(FRAME.cover, height);\n}\nfloat packedFinish(uint finish, float pixels)\n{\nreturn floor(clamp(pixels * 4.0, 0.0, 255.0) + 0.5) + 256.0 * float(finish);\n}\nuint finishIn(float packed)\n{\nreturn uint(packed) >> 8u;\n}\nfloat pixelsIn(float packed)\n{\nreturn 0.25 * float(uint(packed) & 255u);\n}\nfloat fleckLength()\n{\nreturn 1.5 / max(FRAME.cover.stepsPerMetre, 1e-6);\n}\nfloat fleckCount(float length_)\n{\nreturn clamp(floor(length_ / fleckLength() + 0.5), 1.0, 255.0);\n}\n#endif\n",
  // shaders/blade/drawn_blade.glsl
  "#ifndef SWARD_BLADE_DRAWN_BLADE_GLSL\n#define SWARD_BLADE_DRAWN_BLADE_GLSL\n",
  // shaders/blade/known_shape.glsl
  "#ifndef SWARD_BLADE_KNOWN_SHAPE_GLSL\n#define SWARD_BLADE_KNOWN_SHAPE_GLSL\n",
  // shaders/blade/known_shape.glsl
  "const uint onlyShape = shapeCount;\nuint knownShape(uint shape)\n{\nreturn onlyShape < shapeCount ? onlyShape : shape;\n}\n#endif\n",
  // shaders/blade/pages.glsl
  "uint placeOf(uvec2 pages, uint blade) { return blade; }\n",
  // shaders/blade/drawn_blade.glsl
  "#ifndef FRAME\n#define FRAME push.frame.at[0]\n#endif\nconst bool mayHaveOrgans = true;\nstruct DrawnBlade {\nRibbon ribbon;\nBlade blade;\nSpecies species;\n};\nstruct PosedLook {\nPosedBlade posed;\nSpecies look;\nuint number;\n};\nPosedLook posedLook(Blade blade, BladeState state)\n{\nPosedLook part = PosedLook(posedBlade(blade, state), fetchSpeciesArray(uint(blade.species)), 0u);\nif (!mayHaveOrgans || part.look.organKinds == 0u)\nreturn part;\npart.number = blade.clump;\nif (part.number > 0u) {\nuint within;\nOrganTable organs = OrganTable(0u);\nOrgan organ = fetchOrganTable(uint(organOf(organs, part.look, part.number, within)));\npart.posed = posedRibbon(part.posed, organ, part.number, within);\npart.look = organ.look;\n}\npart.posed.blade.clump = plantKey(blade) % driedClump;\nreturn part;\n}\nfloat maxReach(Blade blade)\n{\nreturn (mayHaveOrgans ? 2.3 : 1.0) * blade.height;\n}\nfloat segmentsOf(Ribbon ribbon, float height, uint shape, float heightPixels, float widthPixels)\n{\nif (FRAME.fixedTessellation > 0.0)\nreturn clamp(FRAME.fixedTessellation, 1.0, 64.0);\nif (FRAME.levelSteps.count > 0u)\nreturn segmentsAt(FRAME.levelSteps, length(ribbon.v0 - FRAME.view.eye));\nreturn segmentsFor(ribbon.v0, ribbon.v1, ribbon.v2, height, shape, heightPixels, widthPixels,\nfloat(FRAME.maxTessellation));\n}\nDrawnBlade drawnBlade(VisibleBlade visible, PosedLook part)\n{\nSpecies species = part.look;\nPosedBlade posed = part.posed;\nDrawnBlade drawn;\ndrawn.blade = posed.blade;\ndrawn.species = species;\nfloat height = posed.blade.height;\nRibbon ribbon;\nribbon.v0 = posed.v0;\nribbon.v1 = posed.v1;\nribbon.v2 = posed.v2;\nribbon.axis = posed.axis;\nribbon.width = posed.blade.width * widthFactorOf(visible);\nfloat widthPixels = visible.pixels * ribbon.width / height;\nribbon.fold = foldOf(species.fold, widthPixels);\nuint shape = knownShape(species.shape);\nribbon.outline = outlineOf(shape, species.tipThreshold,\nsegmentsOf(ribbon, height, shape, visible.pixels, widthPixels));\nribbon.seed = posed.blade.seed;\ndrawn.ribbon = ribbon;\nreturn drawn;\n}\nDrawnBlade drawnBlade(VisibleBlade visible, Blade blade, BladeState state)\n{\nreturn drawnBlade(visible, posedLook(blade, state));\n}\nBladeState stateOf(VisibleBlade visible)\n{\nreturn BladeState(fetchUintArray(uint(placeOf(uvec2(0u), visible.blade))), 0.0);\n}\nBlade visibleBlade(VisibleBlade visible)\n{\nBlade blade = unpackBlade(fetchBladeArray(uint(placeOf(uvec2(0u), visible.blade))),\nfetchPatchArray(uint(visible.patchIndex)));\nreturn raised(blade, heightFactorOf(visible));\n}\nDrawnBlade drawnBlade(VisibleBlade visible)\n{\nreturn drawnBlade(visible, visibleBlade(visible), stateOf(visible));\n}\n#endif\n",
  // shaders/shared/cull_result_color.h
  "#ifndef SWARD_SHARED_CULL_RESULT_COLOR_H\n#define SWARD_SHARED_CULL_RESULT_COLOR_H\n",
  // shaders/shared/cull_result_color.h
  "const uint debugReason = 4u;\nvec3 cullResultColor(uint cullResult)\n{\nif (cullResult == cullResultDrawn)\nreturn vec3(0.06f, 0.34f, 0.12f);\nif (cullResult == cullResultPatch)\nreturn vec3(0.30f, 0.30f, 0.33f);\nif (cullResult == cullResultOrientation)\nreturn vec3(0.86f, 0.77f, 0.05f);\nif (cullResult == cullResultFrustum)\nreturn vec3(0.66f, 0.11f, 0.01f);\nif (cullResult == cullResultDistance)\nreturn vec3(0.02f, 0.17f, 0.45f);\nif (cullResult == cullResultOcclusion)\nreturn vec3(0.60f, 0.19f, 0.38f);\nreturn vec3(0.09f, 0.46f, 0.81f);\n}\n#endif\n",
  // shaders/shared/look/leaf_finish.h
  "#ifndef SWARD_SHARED_LOOK_LEAF_FINISH_H\n#define SWARD_SHARED_LOOK_LEAF_FINISH_H\n",
  // shaders/shared/look/leaf_finish.h
  "const uint finishGrass = 0u;\nconst uint finishBroad = 1u;\nconst uint finishPetal = 2u;\nconst uint finishStalk = 3u;\nconst uint finishPlain = 4u;\nuint finishOf(Species look)\n{\nif (look.shape == shapeQuad)\nreturn finishStalk;\nif (look.shape != shapeLeaf && look.shape != shapeDandelion)\nreturn finishGrass;\nreturn look.tipColor.y > max(look.tipColor.x, look.tipColor.z) ? finishBroad : finishPetal;\n}\nfloat finishDice(uint seed)\n{\nreturn float(seed & 255u) * (1.0f / 255.0f);\n}\nfloat endWave(float away, float falls)\n{\nfloat rest = max(1.0f - away, 0.0f);\nreturn rest * rest * (1.0f - falls * away);\n}\nvec3 toneAlong(uint finish, float along, uint seed)\n{\nif (finish == finishBroad || finish == finishPlain)\nreturn vec3(1.0f);\nif (finish == finishPetal)\nreturn vec3(1.0f) -\nendWave(min(along * (1.0f / 0.6f), 1.0f), 2.5f) * vec3(0.12f, 0.22f, 0.42f);\nvec3 tone =\nvec3(1.0f) + endWave(min(along * 2.5f, 1.0f), 4.0f) * vec3(0.75f, 0.3f, 0.55f);\nif (finish == finishStalk)\nreturn tone;\nfloat dry = smoothstep(0.3f, 1.0f, finishDice(seed));\nreturn tone + (dry * endWave(min(2.2f - 2.2f * along, 1.0f), 2.5f)) * vec3(0.12f, -0.2f, -0.35f);\n}\nstruct Veins {\nvec3 tone;\nfloat slope;\n};\nfloat midribAt(float x, float reach)\n{\nfloat off = x / reach;\nfloat rest = max(1.0f - off * off, 0.0f);\nreturn rest * rest - (8.0f / 15.0f) * reach;\n}\nfloat shareSeen(float spacing)\n{\nreturn smoothstep(2.5f, 5.0f, spacing);\n}\nconst float halfWave = 3.14159265f;\nVeins veinsAt(uint finish, vec2 place, float pixels, uint seed)\n{\nfloat x = place.x;\nfloat t = place.y;\nVeins veins;\nveins.tone = vec3(1.0f);\nveins.slope = 0.0f;\nfloat wide =\nfinish == finishStalk\n? pixels\n: pixels * min(1.0f, finish == finishGrass ? 2.0f - 2.0f * t : 4.0f * t * (1.0f - t));\nfloat ridge = shareSeen(0.6f * wide);\nfloat phase = 40.0f * finishDice(seed);\nif (finish == finishGrass) {\nfloat few = shareSeen(wide / 7.0f);\nfloat many = shareSeen(wide / 17.0f);\nfloat a = 7.0f * halfWave * x + phase;\nfloat b = 17.0f * halfWave * x + 2.0f * phase;\nveins.tone += (ridge * midribAt(x, 0.16f)) * vec3(0.45f, 0.36f, 0.8f) +\n0.09f * few * cos(a) + 0.07f * many * cos(b);\nveins.slope = 0.16f * few * sin(a) + 0.14f * many * sin(b);\n} else if (finish == finishBroad) {\nfloat a = 2.0f * halfWave * (7.0f * t - abs(x)) + phase;\nfloat side = shareSeen(0.3f * wide);\nveins.tone += (ridge * midribAt(x, 0.1f)) * vec3(0.5f, 0.42f, 0.7f) +\nside * (0.1f * cos(a) + 0.06f * cos(2.0f * a) + 0.03f * cos(3.0f * a));\nveins.slope = 0.12f * side * sin(a) * sign(x);\n} else if (finish == finishPetal) {\nfloat a = 5.0f * halfWave * x + phase;\nfloat b = 13.0f * halfWave * x + 2.0f * phase;\nfloat few = shareSeen(wide / 5.0f);\nfloat many = shareSeen(wide / 13.0f);\nveins.tone += 0.07f * few * cos(a) + (0.08f * (1.0f - 0.5f * t)) * many * cos(b);\nveins.slope = 0.3f * few * sin(a) + 0.15f * many * sin(b);\n} else if (finish == finishStalk) {\nfloat a = 4.0f * halfWave * x + phase;\nfloat few = shareSeen(0.4f * wide);\nveins.tone += 0.1f * few * cos(a);\nveins.slope = 0.12f * few * sin(a);\n}\nreturn veins;\n}\nconst float roughnessAcross = 0.46f;\nconst float roughnessAlong = 0.18f;\nconst float mirroredHeadOn = 0.019f;\nfloat coatShine(vec3 normal, vec3 tangent, vec3 source, vec3 eye)\n{\nfloat facing = dot(normal, source);\nvec3 sum = source + eye;\nfloat along = dot(sum, tangent);\nfloat up = dot(sum, normal);\nif (facing <= 0.0f || up <= 0.0f)\nreturn 0.0f;\nfloat square = dot(sum, sum);\nfloat across = max(square - up * up - along * along, 0.0f);\nfloat depth = max(up * up, 0.0625f);\nfloat slopes = (along * along * (1.0f / (roughnessAlong * roughnessAlong)) +\nacross * (1.0f / (roughnessAcross * roughnessAcross))) /\ndepth;\nfloat grazing = max(1.0f - 0.5f * sqrt(square), 0.0f);\nfloat twice = grazing * grazing;\nfloat fresnel = mirroredHeadOn + (1.0f - mirroredHeadOn) * twice * twice * grazing;\nreturn facing * fresnel * exp(-slopes) * square /\n(roughnessAcross * roughnessAlong * depth * depth);\n}\nfloat coatAlbedo(float cosine)\n{\nfloat grazing = 1.0f - clamp(cosine, 0.1f, 1.0f);\nfloat twice = grazing * grazing;\nreturn 0.017f + 0.3f * twice * twice;\n}\n#endif\n",
  // shaders/blade/blade_colors.glsl
  "BladeSurface liftedSurface(BladeSurface surface, float above)\n{\nfloat root = 1.0 - heightWithLeafShare(above);\nsurface.root = vec4(mix(surface.root.rgb, surface.tip.rgb, tipShareAt(root)), mix(surface.root.w, surface.tip.w, root));\nsurface.material.y *= above;\nreturn surface;\n}\nBladeSurface bladeSurface(DrawnBlade drawn, VisibleBlade visible, LeafAreaLimit limit)\n{\nBlade blade = drawn.blade;\nSpecies species = drawn.species;\nvec3 grass = grassAt(FRAME.cover, blade.root);\nfloat leafArea = grass.x;\nBladeColors colors = bladeColors(FRAME.cover, blade, species, leafArea);\nif (debugMode() == 1u)\ncolors.tip = mix(vec3(0.1, 0.6, 0.1), vec3(1.0, 0.1, 0.0),\nclamp(log2(max(widthFactorOf(visible), 1.0)) / 4.0, 0.0, 1.0));\nelse if (debugMode() == 2u)\ncolors.tip = colorOf(visible.patchIndex);\nelse if (debugMode() == debugReason)\ncolors.tip = cullResultColor(fetchUintArray(uint(placeOf(uvec2(0u), visible.blade))));\nif (paintsWind)\ncolors.tip = colorOfWind(blade.root, blade.up);\nif (debugMode() != debugNothing)\ncolors.root = 0.4 * colors.tip;\nfloat risen = smoothstep(-0.15, 0.25, dot(blade.up, FRAME.sunDirection));\nBladeSurface surface;\nsurface.root = vec4(colors.root, risen * sunSeen(FRAME.shadow, drawn.ribbon.v0, blade.up));\nsurface.tip = vec4(colors.tip, risen * sunSeen(FRAME.shadow, drawn.ribbon.v2, blade.up));\nvec3 heights = vec3(dot(drawn.ribbon.v0 - blade.root, blade.up), dot(drawn.ribbon.v1 - blade.root, blade.up),\ndot(drawn.ribbon.v2 - blade.root, blade.up));\nfloat missing = leavesPerDrawn(FRAME.view, distance(blade.root, FRAME.view.eye));\nsurface.material = vec4(packedLook(vec3(blade.exposure, species.translucency, species.gloss)),\nleavesAround(leafArea / missing, FRAME.cover.thinned * missing),\npackedHeights(heightStepsPerMetre(FRAME.cover, grass) / heightFactorOf(visible) * heights),\npackedFinish(finishOf(species), visible.pixels * drawn.ribbon.width / blade.height));\nif (limit.light < 1.0) return liftedSurface(surface, limit.light); return surface;\n}\n#endif\n",
  // web/shaders/pose.vert
  "uniform float maxSegments;\nflat out uvec4 recordV0;\nflat out uvec4 recordV1;\nflat out uvec4 recordV2;\nflat out uvec4 recordSurface;\nflat out uvec4 recordFrame;\nflat out uvec4 recordBend;\nvoid keep(DrawnBlade drawn, BladeSurface surface, uint index)\n{\nRibbon ribbon = drawn.ribbon;\nvec3 lower = normalize(ribbon.v1 - ribbon.v0);\nfloat size = max(length(ribbon.v1 - ribbon.v0), 1e-9);\nvec3 upperWay = (ribbon.v2 - ribbon.v1) / size;\nvec3 upper = dot(upperWay, upperWay) > 1e-6 ? upperWay : 1e-3 * lower;\nfloat bend = length(upper);\nrecordV0 = uvec4(floatBitsToUint(ribbon.v0), floatBitsToUint(ribbon.width));\nrecordV1 = uvec4(floatBitsToUint(ribbon.v1), packHalf2x16(vec2(ribbon.outline.tipThreshold, ribbon.outline.scale)));\nrecordV2 = uvec4(floatBitsToUint(ribbon.v2),\nribbon.seed | (ribbon.outline.shape << 16u) | (uint(ribbon.outline.segments) << 24u));\nrecordSurface = uvec4(packHalf2x16(surface.root.rg), packHalf2x16(vec2(surface.root.b, surface.tip.r)),\npackHalf2x16(surface.tip.gb),\npackUnorm4x8(vec4(unpackedLook(surface.material.x), surface.root.w)));\nrecordFrame = uvec4(packHalf2x16(vec2(surface.material.y, surface.tip.w)), encodeWideOctahedral(ribbon.axis),\nencodeWideOctahedral(lower), packHalf2x16(vec2(ribbon.fold, bend)));\nrecordBend = uvec4(encodeWideOctahedral(upper / bend),\nuint(surface.material.z) | (uint(fleckCount(size * (1.0 + bend))) << 24u),\nuint(surface.material.w), index);\n}\nvoid main()\n{\nrecordV0 = uvec4(0u);\nrecordV1 = uvec4(0u);\nrecordV2 = uvec4(0u);\nrecordSurface = uvec4(0u);\nrecordFrame = uvec4(0u);\nrecordBend = uvec4(0u);\ngl_PointSize = 1.0;\ngl_Position = vec4(2.0, 2.0, 2.0, 1.0);\nif (uint(gl_VertexID) >= group.z)\nreturn;\nPatch cell = fetchPatchArray(group.x);\nuint i = group.y + uint(gl_VertexID);\nuint index = cell.firstBlade + i;\nLeafAreaLimit limit = leafAreaLimitOf(FRAME.view, cell);\nBlade blade = raised(unpackBlade(fetchBladeArray(index), cell), limit.height);\nuint turn = fetchUintArray(index);\nPosedLook part = posedLook(blade, BladeState(turn == unsettledTurn ? 0u : turn, 0.0));\nuint number = part.number;\nVerdict verdict = cullBlade(FRAME.view, limit, part.posed, bladeRank(cell, i - min(number, i)));\nif (verdict.cullResult != cullResultDrawn)\nreturn;\nVisibleBlade visible =\nVisibleBlade(index, group.x, packFactors(verdict.widthFactor, limit.height), verdict.pixels);\nDrawnBlade drawn = drawnBlade(visible, part);\nfloat segments = drawn.ribbon.outline.segments;\nif (segments > maxSegments)\ndrawn.ribbon.outline = outlineOf(drawn.ribbon.outline.shape, drawn.ribbon.outline.tipThreshold, maxSegments);\nkeep(drawn, bladeSurface(drawn, visible, limit), index);\n}\n",
  // web/shaders/ribbon.glsl
  "#ifndef SWARD_WEB_RIBBON_GLSL\n#define SWARD_WEB_RIBBON_GLSL\n",
  // shaders/blade/cross_section_point.glsl
  "#ifndef SWARD_BLADE_CROSS_SECTION_POINT_GLSL\n#define SWARD_BLADE_CROSS_SECTION_POINT_GLSL\n",
  // shaders/blade/cross_section_point.glsl
  "vec3 onCrossSection(CrossSection section, float u)\n{\nreturn u < 0.5 ? mix(section.left, section.ridge, 2.0 * u) : mix(section.ridge, section.right, 2.0 * u - 1.0);\n}\n#endif\n",
  // web/shaders/ribbon.glsl
  "layout(location = 0) in uvec4 recordV0;\nlayout(location = 1) in uvec4 recordV1;\nlayout(location = 2) in uvec4 recordV2;\nlayout(location = 3) in uvec4 recordSurface;\nlayout(location = 4) in uvec4 recordFrame;\nlayout(location = 5) in uvec4 recordBend;\nuniform uint columns;\nRibbon recordedRibbon()\n{\nvec2 outline = unpackHalf2x16(recordV1.w);\nRibbon ribbon;\nribbon.v0 = uintBitsToFloat(recordV0.xyz);\nribbon.v1 = uintBitsToFloat(recordV1.xyz);\nribbon.v2 = uintBitsToFloat(recordV2.xyz);\nribbon.axis = decodeWideOctahedral(recordFrame.y);\nribbon.width = uintBitsToFloat(recordV0.w);\nribbon.fold = unpackHalf2x16(recordFrame.w).x;\nribbon.outline = Outline((recordV2.w >> 16u) & 255u, outline.x, float(recordV2.w >> 24u), outline.y);\nribbon.seed = recordV2.w & 0xffffu;\nreturn ribbon;\n}\nvec2 placeOfVertex(Ribbon ribbon)\n{\nuint column = uint(gl_VertexID) % columns;\nuint row = uint(gl_VertexID) / columns;\nfloat u = float(column) / float(columns - 1u);\nif (ribbon.fold <= 0.0 && column > 0u)\nu = 1.0;\nreturn vec2(u, min(float(row) / ribbon.outline.segments, 1.0));\n}\n#endif\n",
  // web/shaders/blade.vert
  "out vec3 outPosition;\nout vec4 outPlace;\nflat out uvec4 outSurface;\nflat out uvec4 outFrame;\nflat out uvec3 outBend;\nvoid main()\n{\nRibbon ribbon = recordedRibbon();\noutPosition = vec3(0.0);\noutPlace = vec4(0.0);\noutSurface = recordSurface;\noutFrame = recordFrame;\noutBend = uvec3(recordBend.xy, ribbon.seed | (recordBend.z << 16u));\nif (ribbon.width <= 0.0) {\ngl_Position = vec4(2.0, 2.0, 2.0, 1.0);\nreturn;\n}\nvec2 place = placeOfVertex(ribbon);\nCrossSection section = crossSectionAt(ribbon, place.y, FRAME.view.eye, FRAME.view.minWidth);\noutPosition = onCrossSection(section, place.x);\noutPlace = vec4(2.0 * place.x - 1.0, place.y, section.wide, section.drawn);\ngl_Position = inClip(FRAME.viewProjection * vec4(outPosition, 1.0));\n}\n",
  // shaders/blade/blade_light.glsl
  "#ifndef SWARD_BLADE_BLADE_LIGHT_GLSL\n#define SWARD_BLADE_BLADE_LIGHT_GLSL\n",
  // shaders/blade/blade_light.glsl
  "struct BladePoint {\nvec3 position;\nvec3 tangent;\nvec3 axis;\nvec3 up;\nfloat fold;\nvec2 place;\nvec4 rootColor;\nvec4 tipColor;\nvec3 look;\nfloat leafAbove;\nfloat leafBelow;\nuint seed;\nfloat flecks;\nfloat finish;\n};\nvec3 bladeNormal(BladePoint point, vec3 toEye, float distance)\n{\nvec3 flat_ = cross(point.tangent, point.axis);\nfloat size = length(flat_);\nvec3 n = size > 1e-3 ? flat_ / size : point.up;\nif (point.fold > 0.0)\nn += (point.fold * sign(point.place.x)) * point.axis;\nn *= dot(n, toEye) < 0.0 ? -1.0 : 1.0;\nfloat smallness = smoothstep(4.0, 60.0, distance * 1000.0 / FRAME.view.pixelsPerUnit);\nfloat roundness = finishIn(point.finish) == finishStalk ? 1.4 : 0.55;\nreturn normalize(n + (roundness * (1.0 - point.fold) * (1.0 - smallness) * point.place.x) * point.axis);\n}\nstruct Scattering {\nfloat facing;\nfloat diffuse;\nfloat through;\n};\nScattering scatteringOf(vec3 source, vec3 n)\n{\nScattering scattering;\nscattering.facing = dot(n, source);\nscattering.diffuse = max((scattering.facing + 0.15) / 1.3225, 0.0);\nscattering.through = max(-scattering.facing, 0.0);\nreturn scattering;\n}\nvec3 throughBlade(float translucency)\n{\nreturn throughShare * translucency * throughTint;\n}\nstruct Incoming {\nvec3 around;\nvec3 behind;\nvec3 above;\nvec3 mirrored;\nvec3 sun;\n};\nIncoming incomingFromSky(vec3 n, vec2 open)\n{\nvec3 sky = 1.25 * open.x * FRAME.skyColor;\nvec3 ground = open.y * FRAME.groundColor;\nfloat up = 0.5 + 0.5 * dot(n, FRAME.skyUp);\nreturn Incoming(mix(ground, sky, up), mix(sky, ground, up), 1.25 * FRAME.skyColor, FRAME.skyColor, FRAME.sunColor);\n}\n#ifdef HOST_LIGHT\n",
  // shaders/blade/host_light.glsl
  "#ifndef SWARD_BLADE_HOST_LIGHT_GLSL\n#define SWARD_BLADE_HOST_LIGHT_GLSL\nconst bool hasHostLight = false;\nlayout(set = HOST_LIGHT, binding = 0) uniform sampler2DArray hostShadow;\n#define HOST fetchHostLightArray(uint(0))\nfloat shareInCascade(uint cascade, vec2 at, vec2 size, float depth)\n{\nvec2 first = floor(at);\nvec2 f = at - first;\nfloat share = 0.0;\nfor (uint i = 0u; i < 4u; ++i) {\nvec2 corner = first + 2.0 * vec2(i & 1u, i >> 1u);\nvec4 depths = textureGather(hostShadow, vec3(corner / size, cascade));\nvec4 seen = vec4(greaterThanEqual((depths - depth) * HOST.nearer, vec4(0.0)));\nvec2 across = (i & 1u) == 0u ? vec2(1.0 - f.x, 1.0) : vec2(1.0, f.x);\nvec2 down = (i >> 1u) == 0u ? vec2(1.0 - f.y, 1.0) : vec2(1.0, f.y);\nshare += down.y * dot(across, seen.xy) + down.x * dot(across, seen.wz);\n}\nreturn share / 9.0;\n}\nfloat sunShare(vec3 position, vec3 up)\n{\nvec2 size = vec2(textureSize(hostShadow, 0).xy);\nfor (uint i = 0u; i < HOST.cascadeCount; ++i) {\nfloat texel = HOST.cascades[i].width / min(size.x, size.y);\nvec4 place = vec4(position + up * (HOST.lift * texel), 1.0);\nvec2 at = vec2(dot(HOST.cascades[i].across, place), dot(HOST.cascades[i].down, place)) * size - 0.5;\nfloat depth = dot(HOST.cascades[i].depth, place);\nif (all(greaterThanEqual(at, vec2(1.0))) && all(lessThan(at, size - 2.0)) && depth >= 0.0 && depth <= 1.0)\nreturn shareInCascade(i, at, size, depth);\n}\nreturn 1.0;\n}\nvec3 ambientTowards(vec3 n)\n{\nreturn vec3(ambientLight(HOST.ambient[0], n), ambientLight(HOST.ambient[1], n), ambientLight(HOST.ambient[2], n));\n}\nvec3 ambientAmong(vec3 n, vec2 open)\n{\nreturn open.x * ambientTowards(n) +\n(open.y - open.x) * (0.5 - 0.5 * dot(n, FRAME.skyUp)) * ambientTowards(-FRAME.skyUp);\n}\nIncoming incomingAt(vec3 position, vec3 up, vec3 n, vec2 open)\n{\nif (!hasHostLight)\nreturn incomingFromSky(n, open);\nvec3 sun = FRAME.sunColor * sunShare(position, up);\nif (HOST.hasAmbient == 0u) {\nIncoming incoming = incomingFromSky(n, open);\nincoming.sun = sun;\nreturn incoming;\n}\nreturn Incoming(ambientAmong(n, open), ambientAmong(-n, open), HOST.above, HOST.above / 1.25, sun);\n}\nvec3 lampLight(BladePoint point, vec3 n, vec3 toEye, vec3 albedo, float leafArea)\n{\nfloat openSky = point.look.x;\nvec3 through = throughBlade(point.look.y);\nfloat leavesBelow = 1.0 - skyBelow(point.leafBelow);\nvec3 sum = vec3(0.0);\nfor (uint i = 0u; i < HOST.lampCount; ++i) {\nLamp lamp = HOST.lamps[i];\nvec3 toLamp = lamp.position - point.position;\nvec3 color = lamp.color * lampShare(lamp, toLamp);\nif (color == vec3(0.0))\ncontinue;\nvec3 source = toLamp * inversesqrt(max(dot(toLamp, toLamp), 1e-12));\nfloat upright = dot(point.up, source);\nfloat seen = openSky * sunBelow(leafProjectionOf(FRAME.cover), leafArea, upright);\nScattering scattering = scatteringOf(source, n);\nsum += albedo * color * (seen * (scattering.diffuse + through * scattering.through));\nsum += albedo * (openSky * (1.0 + through)) *\nlightAmongLeaves(leafArea, leavesBelow, upright, color, vec3(0.0), albedo * (1.0 + through));\nif (point.look.z > 0.0)\nsum += (point.look.z * point.place.y * seen * coatShine(n, point.tangent, source, toEye)) * color;\n}\nreturn sum;\n}\n#endif\n",
  // shaders/blade/blade_light.glsl
  "#else\nIncoming incomingAt(vec3 position, vec3 up, vec3 n, vec2 open)\n{\nreturn incomingFromSky(n, open);\n}\n#endif\nconst float fleckEdge = 0.15;\nfloat fleckAt(uint key, float mean)\n{\nfloat chance = float(mixUint(key) >> 8u) * (1.0 / 16777216.0);\nreturn clamp((mean - chance) / (2.0 * fleckEdge) + 0.5, 0.0, 1.0);\n}\nfloat fleckOf(BladePoint point, float mean, float distance)\n{\nfloat pixels = FRAME.view.pixelsPerUnit * fleckLength() / distance;\nfloat seen = smoothstep(1.0, 4.0, pixels);\nif (seen <= 0.0)\nreturn mean;\nfloat at = point.place.y * point.flecks + float(point.seed & 255u) * (1.0 / 256.0);\nuint key = point.seed + uint(at) * 0x9e3779b9u;\nfloat fleck = mix(fleckAt(key, mean), fleckAt(key + 0x9e3779b9u, mean), smoothstep(0.25, 0.75, fract(at)));\nreturn mix(mean, fleck, seen);\n}\nstruct LitPoint {\nvec3 normal;\nvec3 albedo;\nfloat risen;\nfloat sunlit;\n};\nLitPoint litPoint(BladePoint point, vec3 toEye, float distance)\n{\nfloat along = point.place.y;\nvec3 n = bladeNormal(point, toEye, distance);\nuint finish = finishIn(point.finish);\nvec3 albedo = mix(point.rootColor.rgb, point.tipColor.rgb, tipShareAt(along));\nbool isPlain = debugMode() != debugNothing;\nif (!isPlain)\nalbedo *= toneAlong(finish, along, point.seed);\nfloat turned = dot(toEye, point.axis);\nfloat wide = pixelsIn(point.finish) * sqrt(max(1.0 - turned * turned, 0.0));\nif (!isPlain && wide > 4.0) {\nVeins veins = veinsAt(finish, point.place, wide, point.seed);\nalbedo *= veins.tone;\nn = normalize(n + veins.slope * point.axis);\n}\nfloat risen = mix(point.rootColor.w, point.tipColor.w, along);\nvec2 among = sunAmongBlades(FRAME.bladeShadow, point.position, point.seed);\nfloat passed = among.x;\nif (among.y < 1.0)\npassed = mix(fleckOf(point, sunBelow(leafProjectionOf(FRAME.cover), point.leafAbove, dot(point.up, FRAME.sunDirection)),\ndistance),\npassed, among.y);\nreturn LitPoint(n, albedo, risen, point.look.x * risen * passed);\n}\nBladePoint ontoBlade(BladePoint point)\n{\npoint.place = clamp(point.place, vec2(-1.0, 0.0), vec2(1.0));\nreturn point;\n}\nvec3 bladePicture(BladePoint point)\n{\npoint = ontoBlade(point);\nfloat along = point.place.y;\nfloat openSky = point.look.x;\nfloat translucency = point.look.y;\nfloat gloss = point.look.z;\nvec3 sun = FRAME.sunDirection;\nvec3 ray = FRAME.view.eye - point.position;\nfloat distance = length(ray);\nif (showsBands()) {\nuint band = distanceBand(distance, FRAME.view.drawDistance);\nuint channel = band - 3u * (debugMode() - debugNear);\nreturn vec3(channel == 0u, channel == 1u, channel == 2u);\n}\nvec3 toEye = ray / max(distance, 1e-6);\nLitPoint lit = litPoint(point, toEye, distance);\nvec3 n = lit.normal;\nvec3 albedo = lit.albedo;\nfloat risen = lit.risen;\nfloat sunlit = lit.sunlit;\nfloat leafArea = point.leafAbove;\nfloat upright = dot(point.up, sun);\nfloat openBelow = skyBelow(point.leafBelow);\nfloat openAbove = openSky * skyBelow(leafArea);\nIncoming incoming = incomingAt(point.position, point.up, n, vec2(openAbove, openSky * openBelow));\nvec3 through = throughBlade(translucency);\nvec3 light = incoming.around + through * incoming.behind +\nopenSky * (1.0 + through) * lightAmongLeaves(leafArea, 1.0 - openBelow, upright, risen * incoming.sun,\nincoming.above, albedo * (1.0 + through));\nScattering scattering = scatteringOf(sun, n);\nlight += incoming.sun * (sunlit * (scattering.diffuse + through * scattering.through));\nvec3 color = albedo * light;\nfloat coat = gloss * along;\nif (coat > 0.0) {\nfloat towards = dot(n, toEye);\nfloat mirrored = coat * coatAlbedo(towards);\nfloat upwards = 0.5 + towards * dot(n, FRAME.skyUp) - 0.5 * dot(toEye, FRAME.skyUp);\ncolor += mirrored * (openAbove * upwards * incoming.mirrored - color);\ncolor += (coat * sunlit * coatShine(n, point.tangent, sun, toEye)) * incoming.sun;\n}\n#ifdef HOST_LIGHT\nif (hasHostLight)\ncolor += lampLight(point, n, toEye, albedo, leafArea);\n#endif\nif (debugMode() != debugNothing)\ncolor = albedo * (0.25 + 0.75 * along) * (0.6 + 0.4 * max(scattering.facing, 0.0));\nelse\ncolor = throughAir(color, -toEye, distance);\nreturn develop(color);\n}\n#endif\n",
  // web/shaders/middle.glsl
  "#ifndef SWARD_WEB_MIDDLE_GLSL\n#define SWARD_WEB_MIDDLE_GLSL\nuniform vec2 sampleOffset;\nvec2 inMiddle(vec2 value)\n{\nreturn value - sampleOffset.x * dFdx(value) + sampleOffset.y * dFdy(value);\n}\nvec3 inMiddle(vec3 value)\n{\nreturn value - sampleOffset.x * dFdx(value) + sampleOffset.y * dFdy(value);\n}\n#endif\n",
  // web/shaders/blade.frag
  "in vec3 outPosition;\nin vec4 outPlace;\nflat in uvec4 outSurface;\nflat in uvec4 outFrame;\nflat in uvec3 outBend;\nuniform uint samples;\nuniform uint sampleOfPixel;\nlayout(location = 0) out vec4 outColor;\nvoid main()\n{\nvec3 position = inMiddle(outPosition);\nvec2 place = inMiddle(outPlace.xy);\nif (abs(place.x) > 1.0 || place.y < 0.0 || place.y > 1.0) {\nposition = outPosition;\nplace = outPlace.xy;\n}\nuint seed = outBend.z & 0xffffu;\nuint kept = keptSamples(outPlace.z / max(outPlace.w, 1e-12), seed, samples);\nif (((kept >> sampleOfPixel) & 1u) == 0u)\ndiscard;\nvec2 middle = unpackHalf2x16(outSurface.y);\nvec4 bytes = unpackUnorm4x8(outSurface.w);\nvec2 shade = unpackHalf2x16(outFrame.x);\nvec2 bent = unpackHalf2x16(outFrame.w);\nfloat along = clamp(place.y, 0.0, 1.0);\nBladePoint point;\npoint.position = position;\npoint.place = place;\npoint.axis = decodeWideOctahedral(outFrame.y);\npoint.up = decodeWideOctahedral(outFrame.z);\npoint.fold = bent.x;\npoint.tangent = normalize(mix(point.up, bent.y * decodeWideOctahedral(outBend.x), along));\npoint.rootColor = vec4(unpackHalf2x16(outSurface.x), middle.x, bytes.w);\npoint.tipColor = vec4(middle.y, unpackHalf2x16(outSurface.z), shade.y);\npoint.look = bytes.xyz;\npoint.leafAbove = leafAreaAbove(vec4(0.0, shade.x, float(outBend.y & 0xffffffu), 0.0), along);\npoint.leafBelow = max(shade.x - point.leafAbove, 0.0);\npoint.seed = seed;\npoint.finish = float(outBend.z >> 16u);\npoint.flecks = float(outBend.y >> 24u);\n#ifdef IN_HOST\noutColor = vec4(forHost(bladePicture(point)), 1.0);\n#else\noutColor = vec4(bladePicture(point), 1.0 - softness(length(FRAME.view.eye - position), 1.0));\n#endif\n}\n",
  // shaders/shared/ground.h
  "#ifndef SWARD_SHARED_GROUND_H\n#define SWARD_SHARED_GROUND_H\n",
  // shaders/shared/ground.h
  "const uint noImage = 0xffffffffu;\nconst uint groundDoubleSided = 1u;\nstruct GroundVertex {\nvec3 position;\nuint normal;\nvec2 uv;\nuint color;\n};\nstruct GroundMaterial {\nvec4 baseColor;\nfloat roughness;\nfloat metallic;\nuint image;\nuint flags;\n};\nconst uint clusterTriangles = 256u;\nstruct GroundCluster {\nvec3 low;\nuint material;\nvec3 high;\nuint indexCount;\n};\nstruct IndexedDraw {\nuint indexCount;\nuint instanceCount;\nuint firstIndex;\nuint vertexOffset;\nuint firstInstance;\n};\nstruct GroundClusterArray { uint none; };\nGroundCluster fetchGroundClusterArray(uint i);\nstruct IndexedDrawArray { uint none; };\nIndexedDraw fetchIndexedDrawArray(uint i);\nstruct GroundVertexArray { uint none; };\nGroundVertex fetchGroundVertexArray(uint i);\nstruct GroundMaterialArray { uint none; };\nGroundMaterial fetchGroundMaterialArray(uint i);\nvec3 decodeNormal32(uint bits)\n{\nfloat x = float((int(bits & 65535u) ^ 32768) - 32768) / 32767.0f;\nfloat y = float((int(bits >> 16u) ^ 32768) - 32768) / 32767.0f;\nfloat z = 1.0f - abs(x) - abs(y);\nfloat fold = max(-z, 0.0f);\nreturn normalize(vec3(x + (x >= 0.0f ? -fold : fold), y + (y >= 0.0f ? -fold : fold), z));\n}\nuint encodeNormal32(vec3 v)\n{\nfloat scale = 1.0f / (abs(v.x) + abs(v.y) + abs(v.z));\nfloat x = v.x * scale;\nfloat y = v.y * scale;\nif (v.z < 0.0f) {\nfloat folded = (1.0f - abs(y)) * (x >= 0.0f ? 1.0f : -1.0f);\ny = (1.0f - abs(x)) * (y >= 0.0f ? 1.0f : -1.0f);\nx = folded;\n}\nuint xi = uint(int(floor(clamp(x, -1.0f, 1.0f) * 32767.0f + 0.5f))) & 65535u;\nuint yi = uint(int(floor(clamp(y, -1.0f, 1.0f) * 32767.0f + 0.5f))) & 65535u;\nreturn xi | (yi << 16u);\n}\n#endif\n",
  // web/shaders/ground.vert
  "layout(location = 0) in vec3 position;\nlayout(location = 1) in uint normal;\nlayout(location = 2) in vec2 uv;\nlayout(location = 3) in vec4 color;\nout vec3 outPosition;\nout vec3 outNormal;\nout vec2 outUv;\nout vec4 outVertexColor;\nvoid main()\n{\noutPosition = position;\noutNormal = decodeNormal32(normal);\noutUv = uv;\noutVertexColor = color;\ngl_Position = inClip(FRAME.viewProjection * vec4(position, 1.0));\n}\n",
  // web/shaders/ground.frag
  "#define AFTER_BLADES\n",
  // shaders/preview/ground_light.glsl
  "#ifndef SWARD_PREVIEW_GROUND_LIGHT_GLSL\n#define SWARD_PREVIEW_GROUND_LIGHT_GLSL\n",
  // shaders/shared/look/ground_detail.h
  "#ifndef SWARD_SHARED_LOOK_GROUND_DETAIL_H\n#define SWARD_SHARED_LOOK_GROUND_DETAIL_H\n",
  // shaders/shared/look/ground_detail.h
  "struct GroundDetail {\nvec3 albedo;\nfloat brightness;\nvec3 slope;\n};\nfloat shownAt(float size, float pixel)\n{\nreturn clamp(0.35f * size / pixel - 1.0f, 0.0f, 1.0f);\n}\nconst uint crumbSizes = 5u;\nconst float nextCrumb = 0.4f;\nconst float meanCrumb = 0.3027f;\nconst float noiseDeviation = 0.185f;\nmat3 slantedLattice()\n{\nreturn mat3(0.36f, 0.48f, -0.8f, -0.8f, 0.6f, 0.0f, 0.48f, 0.64f, 0.6f);\n}\nvoid addCrumbs(inout GroundDetail detail, vec3 position, float size, float pixel,\nfloat roughness)\n{\nmat3 turn = slantedLattice();\nfloat amount = 0.2f * roughness;\nfor (uint i = 0u; i < crumbSizes; ++i) {\nfloat shown = shownAt(size, pixel);\nif (shown <= 0.0f)\nbreak;\nbool other = (i & 1u) != 0u;\nvec3 place = position / size + 0.4f * detail.slope + 17.0f * float(i);\nvec4 noise = valueNoiseSlope(other ? place * turn : turn * place);\nvec3 rise = other ? turn * vec3(noise) : vec3(noise) * turn;\nfloat height = 2.0f * noise.w - 1.0f;\ndetail.brightness += amount * shown * (abs(height) - meanCrumb);\ndetail.slope += (amount * shown * (height < 0.0f ? -1.0f : 1.0f)) * rise;\nsize *= nextCrumb;\namount = min(1.4f * amount, 0.38f * roughness);\n}\n}\nfloat byteOf(uint hash, uint i)\n{\nreturn float((hash >> (8u * i)) & 255u) * (1.0f / 256.0f);\n}\nconst float stoneChance = 0.4f;\nconst float smallestStone = 0.08f;\nconst float largestStone = 0.33f;\nfloat stoneShare()\n{\nfloat low = smallestStone * smallestStone;\nfloat high = largestStone * largestStone;\nfloat meanCube = (high * high - low * low) / (4.0f * (largestStone - smallestStone));\nreturn stoneChance * 4.18879f * meanCube;\n}\nvoid layStones(inout GroundDetail detail, inout vec3 mean, vec3 rock,\nvec3 position, float edge, float pixel, float amount)\n{\nfloat shown = amount * shownAt(0.4f * edge, pixel);\nif (shown <= 0.0f)\nreturn;\nmean = mix(mean, rock, shown * stoneShare());\nmat3 turn = slantedLattice();\nvec3 place = turn * (position / edge + 0.1f * detail.slope);\nvec3 cell = floor(place);\nuint hash = mixUint(latticePoint(int(cell.x), int(cell.y), int(cell.z)) + 0x51ed270bu);\nif (float(hash >> 8u) * (1.0f / 16777216.0f) >= stoneChance)\nreturn;\nuint more = mixUint(hash + 0x9e3779b9u);\nfloat first = 0.82f + 0.4f * byteOf(hash, 0u);\nfloat second = 0.82f + 0.4f * byteOf(more, 0u);\nvec3 radii = mix(smallestStone, largestStone, byteOf(mixUint(more), 0u)) *\nvec3(first, 1.0f / (first * second), second);\nvec3 middle =\nvec3(0.5f) + (vec3(1.0f) - 2.0f * radii) *\n(vec3(byteOf(more, 1u), byteOf(more, 2u), byteOf(more, 3u)) - vec3(0.5f));\nvec3 out_ = (place - cell - middle) / radii;\nfloat soft = max(pixel / (edge * radii.x), 0.08f);\nfloat seen = shown * clamp((1.0f - length(out_)) / soft + 0.5f, 0.0f, 1.0f);\ndetail.albedo = mix(detail.albedo, (0.5f + byteOf(mixUint(more), 1u)) * rock, seen);\ndetail.slope = mix(detail.slope, 0.4f * detail.slope - 0.8f * (out_ * turn), seen);\ndetail.brightness = mix(detail.brightness, 1.0f, seen);\n}\nconst float strawChance = 0.4f;\nconst float strawLength = 0.27f;\nconst float strawWidth = 0.013f;\nconst uint strawLayers = 3u;\nconst vec3 strawColor = vec3(0.21f, 0.165f, 0.095f);\nfloat lineSeen(float distance, float half_, float pixel)\n{\nreturn clamp((distance + half_) / pixel + 0.5f, 0.0f, 1.0f) -\nclamp((distance - half_) / pixel + 0.5f, 0.0f, 1.0f);\n}\nvoid layStraws(inout GroundDetail detail, inout vec3 mean, vec3 straw,\nvec2 place, float edge, float pixel, float amount)\n{\nfloat shown = amount * shownAt(edge, pixel);\nif (shown <= 0.0f)\nreturn;\nfloat width = max(pixel / edge, 0.3f * strawWidth);\nfor (uint layer = 0u; layer < strawLayers; ++layer) {\nmean = mix(mean, straw, shown * strawChance * 4.0f * strawLength * strawWidth);\nplace = vec2(0.8f * place.x - 0.6f * place.y, 0.6f * place.x + 0.8f * place.y) +\nvec2(0.37f, 0.71f);\nvec2 cell = floor(place);\nvec2 drift = floor(0.25f * place);\nuint many = mixUint(latticePoint(int(drift.x), int(drift.y), int(layer) + 7));\nuint hash = mixUint(latticePoint(int(cell.x), int(cell.y), int(layer)));\nif (float(hash >> 8u) * (1.0f / 16777216.0f) >= 2.0f * strawChance * byteOf(many, 1u))\ncontinue;\nuint more = mixUint(hash + 0x9e3779b9u);\nfloat angle = 6.2831853f * byteOf(more, 0u);\nvec2 along = vec2(cos(angle), sin(angle));\nvec2 from = place - cell - vec2(0.5f);\nfloat t = dot(from, along);\nfloat beside = along.x * from.y - along.y * from.x +\n(1.6f * byteOf(more, 1u) - 0.8f) * (t * t - 0.04f);\nfloat length_ = strawLength * (0.4f + 1.2f * byteOf(more, 2u));\nfloat seen =\nshown * lineSeen(beside, strawWidth, width) * lineSeen(t, length_, width);\ndetail.albedo = mix(detail.albedo, (0.35f + 1.3f * byteOf(more, 3u)) * straw, seen);\n}\n}\nconst float damp = 7.0f;\nfloat turfIn(vec3 albedo)\n{\nreturn smoothstep(1.15f, 1.6f, albedo.y / max(max(albedo.x, albedo.z), 1e-4f));\n}\nGroundDetail groundDetail(vec3 position, vec3 normal, vec3 up, vec3 albedo, float size,\nfloat pixel)\n{\nGroundDetail detail;\ndetail.albedo = albedo;\ndetail.brightness = 1.0f;\ndetail.slope = vec3(0.0f);\nif (shownAt(damp * size, pixel) <= 0.0f)\nreturn detail;\nfloat light = dot(albedo, vec3(0.2126f, 0.7152f, 0.0722f));\nfloat soil = 1.0f - 0.75f * smoothstep(0.15f, 0.4f, light);\nfloat wide = damp * size;\ndetail.brightness += 0.5f * soil * shownAt(wide, pixel) * (valueNoise(position / wide) - 0.5f);\naddCrumbs(detail, position, size, pixel, soil);\nfloat lies = soil * (1.0f - turfIn(albedo)) * smoothstep(0.64f, 0.85f, dot(normal, up));\nvec3 mean = albedo;\nfloat dark = min(16.0f * light, 1.0f);\nvec3 rock = mix(albedo, dark * vec3(0.14f, 0.13f, 0.115f), 0.5f);\nlayStones(detail, mean, rock, position, 0.16f * size, pixel, lies);\nlayStones(detail, mean, rock, position, 0.55f * size, pixel, lies);\nvec3 steep = abs(normal);\nvec2 place = steep.y >= max(steep.x, steep.z) ? vec2(position.x, position.z)\n: steep.x >= steep.z             ? vec2(position.y, position.z)\n: vec2(position.x, position.y);\nlayStraws(detail, mean, dark * strawColor, place / (0.5f * size), 0.5f * size, pixel, lies);\ndetail.albedo = max(detail.albedo + albedo - mean, vec3(0.0f));\nreturn detail;\n}\nfloat raggedShare(float mean, vec3 position, float cell, float size, float pixel)\n{\nfloat amount = 0.75f * (1.0f - smoothstep(0.7f, 0.9f, mean));\nif (mean <= 0.0f || amount <= 0.0f)\nreturn mean;\nfloat step = max(0.5f * cell, size);\nfloat whole = shownAt(step, pixel);\nfloat weight = whole;\nfloat sum = 0.0f;\nfloat squares = 0.0f;\nfor (uint i = 0u; i < 4u && weight > 0.0f; ++i) {\nsum += weight * (valueNoise(position / step + 31.0f * float(i)) - 0.5f);\nsquares += weight * weight;\nstep = i == 0u ? 0.6f * size : 0.38f * step;\nweight = shownAt(step, pixel);\n}\nif (squares <= 0.0f)\nreturn mean;\nfloat order = 1.0f / (1.0f + exp(-1.6f * sum / (noiseDeviation * sqrt(squares))));\nfloat half_ = min(0.06f, 0.5f * min(mean, 1.0f - mean));\nfloat covered = clamp(0.5f * (mean - order) / max(half_, 1e-6f) + 0.5f, 0.0f, 1.0f);\nreturn mix(mean, covered, amount * whole);\n}\n#endif\n",
  // shaders/preview/ground_light.glsl
  "struct GroundPoint {\nvec3 position;\nvec3 normal;\nvec3 albedo;\nbool isDoubleSided;\n};\nstruct Relief {\nfloat brightness;\nvec3 slope;\n};\nvoid addNoise(inout Relief relief, vec3 position, vec3 stretch, float size, float amount)\n{\nvec4 noise = valueNoiseSlope(position * stretch / size);\nrelief.brightness += amount * (noise.w - 0.5);\nrelief.slope += (0.5 * amount) * (noise.xyz * stretch);\n}\nRelief crumbs(vec3 position, float size, float pixel)\n{\nRelief relief = Relief(1.0, vec3(0.0));\nfor (uint octave = 0u; octave < 4u; ++octave) {\nfloat shown = shownAt(size, pixel);\nif (shown <= 0.0)\nbreak;\naddNoise(relief, position + 17.0 * float(octave) * size, vec3(1.0), size, 0.4 * shown);\nsize *= 0.37;\n}\nreturn relief;\n}\nRelief strands(vec3 position, float size, float pixel)\n{\nRelief relief = Relief(1.0, vec3(0.0));\nfloat thin = 0.12 * size;\nfloat shown = shownAt(thin, pixel);\nif (shown > 0.0) {\nmat3 turned = mat3(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6);\nRelief turnedRelief = Relief(1.0, vec3(0.0));\naddNoise(relief, position, vec3(0.15, 1.0, 1.0), thin, 0.45 * shown);\naddNoise(relief, position, vec3(1.0, 1.0, 0.15), thin, 0.45 * shown);\naddNoise(turnedRelief, turned * position, vec3(0.15, 1.0, 1.0), thin, 0.45 * shown);\nrelief.brightness += turnedRelief.brightness - 1.0;\nrelief.slope += turnedRelief.slope * turned;\n}\nreturn relief;\n}\nconst float bareStructure = 0.32;\nconst float hiddenBelow = 0.93;\nconst float placeStep = 2.5e-7;\nconst float darkestCrumb = 0.85;\nvec4 groundPicture(GroundPoint point)\n{\nvec3 ray = FRAME.view.eye - point.position;\nfloat distance = length(ray);\nvec3 toEye = ray / max(distance, 1e-6);\nvec3 n = normalize(point.normal);\nif (point.isDoubleSided && dot(n, toEye) < 0.0)\nn = -n;\nfloat farthest = FRAME.cover.farthest;\nfloat grown = 1.0 - smoothstep(0.8 * farthest, farthest, distance);\nvec3 grass = grassAt(FRAME.cover, point.position);\nfloat blades = grass.x * grown;\nfloat leafArea = FRAME.cover.thinned * blades;\nvec3 far = abs(point.position);\nfloat pixel = max(distance / FRAME.view.pixelsPerUnit, placeStep * max(far.x, max(far.y, far.z)));\nfloat size = FRAME.cover.structure > 0.0 ? FRAME.cover.structure : bareStructure;\nfloat closed = undergrowthBelow(leafArea);\nfloat ragged = mix(raggedShare(closed, point.position, 1.0 / max(FRAME.cover.cellsPerMetre, 1e-6), size, pixel),\nclosed, turfIn(point.albedo));\nfloat under = FRAME.cover.thatch * ragged;\nvec3 albedo = point.albedo;\nvec3 shade = vec3(1.0);\nfloat brightness = 1.0 - under;\nvec3 rough = vec3(0.0);\nvec3 crumbled = vec3(0.0);\nif (under < hiddenBelow) {\nGroundDetail detail = groundDetail(point.position, n, FRAME.skyUp, albedo, size, pixel);\nalbedo = detail.albedo;\nbrightness *= detail.brightness;\ncrumbled = (1.0 - under) * (detail.slope - n * dot(n, detail.slope));\n}\nif (under > 0.0) {\nRelief relief = crumbs(point.position, size, pixel);\nRelief litter = strands(point.position, size, pixel);\nbrightness += under * max(relief.brightness * litter.brightness, 0.2);\nrough = under * (relief.slope + litter.slope);\nshade = meadowShade(point.position, toneOf(grass));\nalbedo = mix(albedo, shade * FRAME.cover.undergrowth, under);\n}\nn = normalize(n - (rough - n * dot(n, rough)));\nfloat even = max(dot(n, FRAME.sunDirection), 0.0);\nfloat turned = dot(crumbled, FRAME.sunDirection) / max(even, 0.3);\nfloat facing = even * (1.0 - clamp(turned, -darkestCrumb, darkestCrumb));\nfloat seen = even > 0.0 ? sunSeen(FRAME.shadow, point.position, n) : 0.0;\nfloat below = sunBelow(leafProjectionOf(FRAME.cover), leafArea, even);\n#ifdef AFTER_BLADES\nvec2 among = sunAmongBlades(FRAME.bladeShadow, point.position, noBladeSeed);\nbelow = mix(below, among.x, among.y);\n#endif\nvec3 light = hemisphere(normalize(n - crumbled)) * skyBelow(leafArea) +\nlightAmongLeaves(leafArea, 0.0, even, seen * FRAME.sunColor, 1.25 * FRAME.skyColor,\n1.5 * FRAME.cover.sward) +\nFRAME.sunColor * (facing * seen * below);\nvec3 color = brightness * albedo * light;\nfloat sward = closed > 0.0 ? swardShare(FRAME.cover, leafArea, FRAME.cover.thinned * leavesPerDrawn(FRAME.view, distance)) * (ragged / closed) : 0.0;\nif (sward > 0.0) {\nvec3 open = hemisphere(n) + FRAME.sunColor * (even * seen);\ncolor = mix(color, brightness * swardBrightness(max(dot(n, toEye), 0.0)) * shade * FRAME.cover.sward * open, sward);\n}\nif (debugMode() != debugNothing)\ncolor = showsBands() ? vec3(0.0) : vec3(0.35) * (0.5 + 0.5 * even);\nelse\ncolor = throughAir(color, -toEye, distance);\nif (paintsWind)\ncolor = colorOfWind(point.position, n);\nreturn vec4(develop(color), 1.0 - softness(distance, min(blades, 1.0)));\n}\n#endif\n",
  // shaders/preview/image_probes.glsl
  "#ifndef SWARD_PREVIEW_IMAGE_PROBES_GLSL\n#define SWARD_PREVIEW_IMAGE_PROBES_GLSL\nconst float maxProbes = 8.0;\nstruct ImageProbes {\nvec2 first;\nvec2 step;\nuint count;\nfloat lod;\n};\nImageProbes imageProbes(vec2 uv, vec2 right, vec2 down, vec2 size)\n{\nfloat across = length(right * size);\nfloat along = length(down * size);\nfloat longest = max(across, along);\nfloat ratio = longest > 1.0 ? longest / max(min(across, along), 1e-6) : 1.0;\nfloat count = clamp(ceil(ratio), 1.0, maxProbes);\nImageProbes probes;\nprobes.step = (across > along ? right : down) / (count + 1.0);\nprobes.first = uv - 0.5 * (count - 1.0) * probes.step;\nprobes.count = uint(count);\nprobes.lod = log2(max(longest / count, 1e-6));\nreturn probes;\n}\n#endif\n",
  // web/shaders/ground.frag
  "uniform sampler2D baseColor;\nuniform vec3 materialColor;\nuniform bool isDoubleSided;\nin vec3 outPosition;\nin vec3 outNormal;\nin vec2 outUv;\nin vec4 outVertexColor;\nlayout(location = 0) out vec4 outColor;\nvoid main()\n{\nImageProbes probes = imageProbes(inMiddle(outUv), dFdx(outUv), dFdy(outUv), vec2(textureSize(baseColor, 0)));\nvec3 texel = vec3(0.0);\nfor (uint i = 0u; i < probes.count; ++i)\ntexel += textureLod(baseColor, probes.first + float(i) * probes.step, probes.lod).rgb;\nGroundPoint point;\npoint.position = inMiddle(outPosition);\npoint.normal = inMiddle(outNormal);\npoint.albedo = materialColor * (texel / float(probes.count)) * outVertexColor.rgb;\npoint.isDoubleSided = isDoubleSided;\n#ifdef IN_HOST\noutColor = vec4(forHost(groundPicture(point).rgb), 1.0);\n#else\noutColor = groundPicture(point);\n#endif\n}\n",
  // shaders/common/view_ray.glsl
  "#ifndef SWARD_COMMON_VIEW_RAY_GLSL\n#define SWARD_COMMON_VIEW_RAY_GLSL\n",
  // shaders/common/view_ray.glsl
  "#ifndef FRAME\n#define FRAME push.frame.at[0]\n#endif\nvec3 rayThrough(vec2 place)\n{\nreturn place.x * FRAME.rays[0] + (place.y * FRAME.rays[1] + FRAME.rays[2]);\n}\n#endif\n",
  // web/shaders/sky.vert
  "out vec3 outRay;\nvoid main()\n{\nvec2 place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\noutRay = rayThrough(vec2(place.x, -place.y));\ngl_Position = vec4(place, 1.0, 1.0);\n}\n",
  // shaders/common/sky_light.glsl
  "#ifndef SWARD_COMMON_SKY_LIGHT_GLSL\n#define SWARD_COMMON_SKY_LIGHT_GLSL\n",
  // shaders/common/sky_light.glsl
  "float cloudAt(vec3 place)\n{\nfloat least = mix(0.72, 0.34, FRAME.clouds);\nfloat finest = 1.0 / 32.0;\nfloat sum = 0.0;\nfloat weight = 0.5;\nfor (uint octave = 0u; octave < 5u; ++octave) {\nsum += weight * valueNoise(place);\nif (sum + weight - finest <= least)\nreturn 0.0;\nplace = 2.13 * place.yzx + vec3(3.7, 11.1, 5.3);\nweight *= 0.5;\n}\nreturn smoothstep(0.0, 0.26, sum - least);\n}\nvec3 withClouds(vec3 color, vec3 ray)\n{\nfloat height = dot(ray, FRAME.skyUp);\nif (FRAME.clouds <= 0.0 || height <= 0.0)\nreturn color;\nvec3 place = ray * (1.9 / (height + 0.16));\nfloat thickness = cloudAt(place);\nif (thickness <= 0.0)\nreturn color;\nvec3 sunwards = FRAME.sunDirection - FRAME.skyUp * dot(FRAME.sunDirection, FRAME.skyUp);\nfloat shade = cloudAt(place + 0.35 * sunwards);\nfloat toSun = max(dot(ray, FRAME.sunDirection), 0.0);\nvec3 lit = FRAME.sunColor * (0.30 * exp(-1.4 * shade) * (1.0 + 0.9 * pow(toSun, 6.0))) +\n0.55 * FRAME.skyColor;\nfloat shown = thickness * 0.85 * smoothstep(0.0, 0.22, height);\nreturn mix(color, lit, shown);\n}\nconst vec3 floorAlbedo = vec3(0.160, 0.152, 0.130);\nconst float floorBounce = 0.12;\nfloat sunOnFloor(vec3 place)\n{\nif (FRAME.shadow.size == 0u)\nreturn 1.0;\nfloat depth = dot(FRAME.shadow.depth, vec4(place, 1.0));\nfloat perMetre = dot(FRAME.shadow.depth.xyz, FRAME.sunDirection);\nreturn sunSeen(FRAME.shadow, place + FRAME.sunDirection * (max(0.002 - depth, 0.0) / perMetre), FRAME.skyUp);\n}\nvec3 belowHorizon(vec3 color, vec3 ray)\n{\nfloat climb = dot(ray, FRAME.skyUp);\nif (climb >= 0.0)\nreturn color;\nFloorPlane plane = FRAME.floorPlane;\nif (plane.reach <= 0.0)\nreturn color * (1.0 - 0.35 * smoothstep(0.0, 1.0, -climb));\nfloat distance = dot(plane.middle - FRAME.view.eye, FRAME.skyUp) / climb;\nif (distance <= 0.0)\nreturn color;\nvec3 place = FRAME.view.eye + distance * ray;\nfloat away = distanceFromFootprint(plane, place, cross(FRAME.skyUp, plane.along));\nfloat shown = exp(-away / plane.reach);\nif (shown < 0.002)\nreturn color;\nfloat facing = max(dot(FRAME.sunDirection, FRAME.skyUp), 0.0);\nfloat lit = facing > 0.0 ? sunOnFloor(place) : 0.0;\nfloat open = skyBesideWall(plane.height, away);\nvec3 light = hemisphere(FRAME.skyUp) * open + FRAME.sunColor * (facing * mix(floorBounce * open, 1.0, lit));\nreturn mix(color, throughAir(floorAlbedo * light, ray, distance), shown);\n}\nvec3 skyPicture(vec3 ray, vec2 place)\n{\nif (debugMode() != debugNothing)\nreturn showsBands() ? vec3(0.0) : dithered(develop(vec3(0.6)), place);\nvec3 color = belowHorizon(withClouds(skyRadiance(ray), ray), ray);\nfloat toSun = dot(ray, FRAME.sunDirection);\ncolor += FRAME.sunColor * 6.0 * smoothstep(0.99985, 0.99997, toSun);\nreturn dithered(develop(color), place);\n}\n#endif\n",
  // web/shaders/sky.frag
  "in vec3 outRay;\nlayout(location = 0) out vec4 outColor;\nvoid main()\n{\noutColor = vec4(skyPicture(normalize(outRay), gl_FragCoord.xy), 1.0);\n}\n",
  // web/shaders/film.vert
  "void main()\n{\ngl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n}\n",
  // web/shaders/film.frag
  "uniform sampler2D resolved;\nuniform sampler2D resolved1;\nuniform sampler2D resolved2;\nuniform sampler2D resolved3;\nuniform bool hasSamples;\nlayout(location = 0) out vec4 outColor;\nvec4 pixelAt(ivec2 pixel)\n{\npixel = clamp(pixel, ivec2(0), textureSize(resolved, 0) - 1);\nvec4 first = texelFetch(resolved, pixel, 0);\nif (!hasSamples)\nreturn first;\nreturn 0.25 * (first + texelFetch(resolved1, pixel, 0) + texelFetch(resolved2, pixel, 0) +\ntexelFetch(resolved3, pixel, 0));\n}\n",
  // shaders/resolve/reconstruction_filter.glsl
  "#ifndef SWARD_RESOLVE_RECONSTRUCTION_FILTER_GLSL\n#define SWARD_RESOLVE_RECONSTRUCTION_FILTER_GLSL\nconst float softSide = 1.0 / 6.0;\nfloat splineAt(int offset)\n{\nreturn offset == 0 ? 1.0 - 2.0 * softSide : softSide;\n}\nvec3 reconstructed(ivec2 pixel)\n{\nvec4 here = pixelAt(pixel);\nfloat soft = 1.0 - here.a;\nvec3 sum = here.rgb;\nif (soft <= 0.0)\nreturn sum;\nfor (int y = -1; y <= 1; ++y)\nfor (int x = -1; x <= 1; ++x) {\nvec4 there = pixelAt(pixel + ivec2(x, y));\nsum += splineAt(x) * splineAt(y) * min(soft, 1.0 - there.a) * (there.rgb - here.rgb);\n}\nreturn sum;\n}\n#endif\n",
  // web/shaders/film.frag
  "void main()\n{\nvec3 color = clamp(reconstructed(ivec2(gl_FragCoord.xy)), 0.0, 1.0);\ncolor = mix(12.92 * color, 1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055, greaterThan(color, vec3(0.0031308)));\noutColor = vec4(color, 1.0);\n}\n",
  // web/shaders/sun.vert
  "layout(location = 0) in vec3 position;\nvoid main()\n{\nvec4 place = vec4(position, 1.0);\nvec2 pixel = vec2(dot(FRAME.shadow.across, place), dot(FRAME.shadow.down, place));\ngl_Position = inClip(vec4(pixel * (2.0 / float(FRAME.shadow.size)) - 1.0, dot(FRAME.shadow.depth, place), 1.0));\n}\n",
  // web/shaders/blade_shadow.vert
  "flat out uint outSeed;\nout float outDepth;\nvoid main()\n{\nRibbon ribbon = recordedRibbon();\nribbon.fold = 0.0;\noutSeed = ribbon.seed;\noutDepth = 0.0;\ngl_Position = vec4(2.0, 2.0, 2.0, 1.0);\nif (ribbon.width <= 0.0)\nreturn;\nvec2 place = placeOfVertex(ribbon);\nCrossSection section = crossSectionAt(ribbon, place.y, FRAME.view.eye, 0.0);\nvec4 point = vec4(onCrossSection(section, place.x), 1.0);\nBladeShadow map = FRAME.bladeShadow;\nvec2 texel = vec2(dot(map.across, point), dot(map.down, point));\noutDepth = dot(map.depth, point);\ngl_Position = inClip(vec4(texel * (2.0 / float(map.size)) - 1.0, outDepth, 1.0));\n}\n",
  // web/shaders/blade_shadow.frag
  "flat in uint outSeed;\nin float outDepth;\nlayout(location = 0) out uvec2 texel;\nvoid main()\n{\ntexel = uvec2(outSeed, floatBitsToUint(outDepth));\n}\n",
  // web/shaders/nothing.frag
  "void main()\n{\n}\n",
  // web/shaders/host_blade.frag
  "#define IN_HOST\n",
  // web/shaders/host.glsl
  "#ifndef SWARD_WEB_HOST_GLSL\n#define SWARD_WEB_HOST_GLSL\nuniform bool isLinear;\nvec3 forHost(vec3 color)\n{\ncolor = clamp(color, 0.0, 1.0);\nif (isLinear)\nreturn color;\nreturn mix(12.92 * color, 1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055, greaterThan(color, vec3(0.0031308)));\n}\n#endif\n",
  // web/shaders/host_ground.frag
  "#define IN_HOST\n"
];
var head = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\nprecision highp usampler2D;\n";
var stage = (...numbers) => head + numbers.map((i) => pieces[i]).join("");
var moveVert = stage(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52);
var moveFrag = stage(53);
var poseVert = stage(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 48, 49, 50, 51, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81);
var bladeVert = stage(82, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 49, 50, 83, 84, 85, 86);
var bladeFrag = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 87, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 70, 78, 79, 88, 89, 90, 49, 50, 91, 92);
var groundVert = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 93, 94, 95);
var groundFrag = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 96, 97, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 93, 94, 98, 99, 48, 49, 50, 51, 100, 101, 91, 102);
var skyVert = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 103, 104, 105);
var skyFrag = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 106, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 107, 108);
var filmVert = stage(109);
var filmFrag = stage(110, 111, 112);
var sunVert = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 113);
var bladeShadowVert = stage(82, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 49, 50, 83, 84, 85, 114);
var bladeShadowFrag = stage(115);
var nothingFrag = stage(116);
var hostBladeFrag = stage(117, 118, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 87, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 70, 78, 79, 88, 89, 90, 49, 50, 91, 92);
var hostGroundFrag = stage(119, 118, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 96, 97, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 93, 94, 98, 99, 48, 49, 50, 51, 100, 101, 91, 102);

// src/sow/pages.ts
var sownPageBlades = 2048;
var sownPagePatches = 64;
var bladeWords2 = 4;
var noPatch2 = 4294967295;
function pagesOf(unit2) {
  const all = unit2.patches.length / patchWords;
  const pages = [];
  let current = { first: 0, end: 0, blades: 0 };
  let room = sownPagePatches - 1;
  for (let p = 0; p < all; ++p) {
    const count = unit2.patches[patchWords * p + patchWord.bladeCount];
    if (room === 0 || current.blades + count > sownPageBlades) {
      pages.push(current);
      current = { first: p, end: p, blades: 0 };
      room = sownPagePatches;
    }
    current.end = p + 1;
    current.blades += count;
    --room;
  }
  if (all > 0) pages.push(current);
  const result = {
    count: pages.length,
    blades: new Uint32Array(pages.length * sownPageBlades * bladeWords2),
    patches: new Uint32Array(pages.length * sownPagePatches * patchWords),
    patchCounts: [],
    bladeCount: unit2.blades.length / bladeWords2
  };
  pages.forEach(({ first, end }, i) => {
    const shift = i === 0 ? 1 : 0;
    const at = patchWords * (sownPagePatches * i + shift);
    result.patches.set(unit2.patches.subarray(patchWords * first, patchWords * end), at);
    const from = unit2.patches[patchWords * first + patchWord.firstBlade];
    for (let p = 0; p < end - first; ++p) {
      const word = at + patchWords * p + patchWord.firstBlade;
      result.patches[word] -= from;
    }
    const last = patchWords * (end - 1);
    const to = unit2.patches[last + patchWord.firstBlade] + unit2.patches[last + patchWord.bladeCount];
    result.blades.set(unit2.blades.subarray(bladeWords2 * from, bladeWords2 * to), bladeWords2 * sownPageBlades * i);
    result.patchCounts.push(end - first + shift);
  });
  if (pages.length > 0) {
    result.patches.set(unit2.whole);
    result.patches[patchWord.bladeCount] = 0;
    result.patches[patchWord.firstChild] = noPatch2;
    new Float32Array(result.patches.buffer)[patchWord.widthLow] = unit2.widest;
    new Float32Array(result.patches.buffer)[patchWord.widthStep] = 0;
  }
  return result;
}

// src/render/vector.ts
var add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
var sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
var scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
var dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
var size = (a) => Math.hypot(a[0], a[1], a[2]);
var cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0]
];
function unit(a, otherwise = [0, 1, 0]) {
  const length = size(a);
  return length > 0 ? scaled(a, 1 / length) : otherwise;
}
var clamp = (x, low, high) => Math.min(Math.max(x, low), high);
function turned(v, axis, angle) {
  const cosine = Math.cos(angle);
  return add(
    add(scaled(v, cosine), scaled(cross(axis, v), Math.sin(angle))),
    scaled(axis, dot(axis, v) * (1 - cosine))
  );
}

// src/render/camera.ts
function axesOf(camera) {
  const forward = unit(sub(camera.target, camera.eye), [0, 0, -1]);
  let right = cross(forward, camera.up);
  if (size(right) < 1e-6 * size(camera.up) || size(camera.up) === 0) {
    const away = forward.map(Math.abs);
    const axis = away[2] <= away[0] && away[2] <= away[1] ? [0, 0, -1] : away[0] <= away[1] ? [1, 0, 0] : [0, 1, 0];
    right = cross(forward, axis);
  }
  right = unit(right);
  return { right, up: cross(right, forward), forward };
}
function viewOf(camera, origin, width, height, content) {
  const eye = sub(camera.eye, origin);
  const { right, up, forward } = axesOf(camera);
  const gap = [0, 1, 2].map((i) => Math.max(content.low[i] - eye[i], eye[i] - content.high[i], 0));
  const extent = size(sub(content.high, content.low));
  const near = Math.max(0.5 * size(gap), Math.min(0.05, 1e-3 * extent), 1e-6);
  const reach = [0, 1, 2].map(
    (i) => Math.max(Math.abs(content.low[i] - eye[i]), Math.abs(content.high[i] - eye[i]))
  );
  const far = Math.max(1.01 * size(reach), 1.01 * near);
  const focal = 1 / Math.tan(camera.fovYDeg * Math.PI / 360);
  const aspect = width / height;
  const row = (axis, scale) => [...scaled(axis, scale), -scale * dot(axis, eye)];
  const w = row(forward, 1);
  const x = row(right, focal / aspect);
  const y = row(up, -focal);
  const slope = near / (far - near);
  const z = w.map((value, i) => slope * ((i === 3 ? far : 0) - value));
  const viewProjection = [];
  for (let column = 0; column < 4; ++column) viewProjection.push(x[column], y[column], z[column], w[column]);
  const plane = (a, b, sign) => {
    const sum = a.map((value, i) => value + sign * b[i]);
    const length = Math.hypot(sum[0], sum[1], sum[2]) || 1;
    return sum.map((value) => value / length);
  };
  const zero = [0, 0, 0, 0];
  const rays = [scaled(right, aspect / focal), scaled(up, -1 / focal), forward];
  return {
    eye,
    viewProjection,
    planes: [plane(w, x, 1), plane(w, x, -1), plane(w, y, -1), plane(w, y, 1), plane(w, z, -1), plane(z, zero, 0)],
    rays,
    pixelsPerUnit: 0.5 * focal * height
  };
}
function fittingCamera(content, origin, up, sun, aspect) {
  const fovYDeg = 40;
  const filled = 0.85;
  const sunSide = unit(sub(sun, scaled(up, dot(sun, up))), [1, 0, 0]);
  const beside = cross(up, sunSide);
  const angle = 50 * Math.PI / 180;
  const extent = sub(content.high, content.low);
  const isLevel = Math.abs(dot(extent, up)) < 0.35 * size(extent);
  const elevation = (isLevel ? 17 : 24) * Math.PI / 180;
  const towards = add(scaled(sunSide, Math.cos(angle)), scaled(beside, Math.sin(angle)));
  const forward = sub(scaled(towards, -Math.cos(elevation)), scaled(up, Math.sin(elevation)));
  const right = unit(cross(forward, up));
  const above = cross(right, forward);
  const tanY = filled * Math.tan(fovYDeg * Math.PI / 360);
  const tanX = tanY * aspect;
  let east = -Infinity;
  let west = -Infinity;
  let north = -Infinity;
  let south = -Infinity;
  let nearest = Infinity;
  let farthest2 = -Infinity;
  for (let corner = 0; corner < 8; ++corner) {
    const p = [0, 1, 2].map((i) => corner & 1 << i ? content.high[i] : content.low[i]);
    const x = dot(p, right);
    const y = dot(p, above);
    const z = dot(p, forward);
    east = Math.max(east, x - tanX * z);
    west = Math.max(west, -x - tanX * z);
    north = Math.max(north, y - tanY * z);
    south = Math.max(south, -y - tanY * z);
    nearest = Math.min(nearest, z);
    farthest2 = Math.max(farthest2, z);
  }
  const depth = Math.min(-(east + west) / (2 * tanX), -(north + south) / (2 * tanY), nearest - 1e-3);
  const middle = 0.5 * (north - south);
  const eye = add(
    add(scaled(right, 0.5 * (east - west)), scaled(above, isLevel ? -south - tanY * depth : middle)),
    scaled(forward, depth)
  );
  return {
    name: "fit",
    eye: add(origin, eye),
    target: add(origin, add(eye, scaled(forward, 0.5 * (nearest + farthest2) - depth))),
    up,
    fovYDeg
  };
}

// src/render/half.ts
var buffer = new DataView(new ArrayBuffer(4));
function toHalf(value) {
  buffer.setFloat32(0, value);
  const bits = buffer.getUint32(0);
  const sign = bits >>> 16 & 32768;
  const exponent = (bits >>> 23 & 255) - 112;
  const mantissa = bits & 8388607;
  if (exponent >= 31) return sign | 31744;
  if (exponent <= 0) return exponent < -10 ? sign : sign | Math.round((mantissa | 8388608) / 2 ** (14 - exponent));
  return sign | (exponent << 10) + Math.round(mantissa / 8192);
}
function fromHalf(bits) {
  const sign = bits & 32768 ? -1 : 1;
  const exponent = bits >>> 10 & 31;
  const mantissa = bits & 1023;
  return sign * (exponent === 0 ? mantissa * 2 ** -24 : (1 + mantissa / 1024) * 2 ** (exponent - 15));
}

// src/render/cover.ts
var shapeBytes = 112;
function parseCoverFile(bytes, name) {
  if (bytes.byteLength < shapeBytes || bytes.byteLength % 4 !== 0)
    fail("input", `${name}: ${bytes.byteLength} bytes, not a cover of at least ${shapeBytes}`);
  const view = new DataView(bytes);
  const float = (at) => view.getFloat32(at, true);
  const word = (at) => view.getUint32(at, true);
  const vector = (at) => [float(at), float(at + 4), float(at + 8)];
  const counts = [word(24), word(28), word(32)];
  const corners = new Uint32Array(bytes, shapeBytes);
  if (counts[0] * counts[1] * counts[2] !== corners.length)
    fail("input", `${name}: ${corners.length} corners instead of ${counts.join("·")}`);
  return {
    areaFactor: float(0),
    low: vector(8),
    cellsPerMetre: float(20),
    counts,
    undergrowth: vector(40),
    sward: vector(56),
    thinned: float(68),
    structure: float(72),
    stepsPerMetre: float(76),
    leaves: Array.from({ length: heightSteps / 2 }, (_, i) => word(80 + 4 * i)),
    corners
  };
}
var largestLeafArea = 1e3;
function sownCover(cover, areaPerStored) {
  const corners = cover.corners.map((corner) => {
    const bits = corner & ~toneBits;
    const area = fromHalf(bits & 65535);
    if (!(area > 0)) return corner;
    const leaves = Math.min(area * areaPerStored, largestLeafArea);
    const heights = fromHalf(bits >>> 16) / area * leaves;
    const halves = (toHalf(leaves) | toHalf(heights) << 16) + 131072;
    return (halves & ~toneBits | corner & toneBits) >>> 0;
  });
  return { ...cover, thinned: 1, corners };
}
var noCover = {
  areaFactor: 1,
  low: [0, 0, 0],
  cellsPerMetre: 0,
  counts: [0, 0, 0],
  undergrowth: [0.08, 0.09, 0.03],
  sward: [0.1, 0.16, 0.04],
  thinned: 1,
  structure: 0.2,
  stepsPerMetre: 1,
  leaves: Array(heightSteps / 2).fill(0),
  corners: new Uint32Array(1)
};
function leafAreaAt(cover, place) {
  const [nx, ny] = cover.counts;
  if (nx === 0) return 0;
  const cell = [0, 0, 0];
  const f = [0, 0, 0];
  for (let i = 0; i < 3; ++i) {
    const last = cover.counts[i] - 1;
    const at = Math.min(Math.max((place[i] - cover.low[i]) * cover.cellsPerMetre, 0), last);
    cell[i] = Math.min(Math.floor(at), last - 1);
    f[i] = at - cell[i];
  }
  let sum = 0;
  for (let corner = 0; corner < 8; ++corner) {
    let weight = 1;
    const at = cell.map((c, i) => {
      const far = corner >> i & 1;
      weight *= far ? f[i] : 1 - f[i];
      return c + far;
    });
    const bits = cover.corners[at[0] + nx * (at[1] + ny * at[2])] & ~toneBits;
    sum += weight * fromHalf(bits & 65535);
  }
  return sum;
}
var leafProjectionOf = (cover) => fromHalf(cover.leaves[0] & 65535);
async function coverAt(address) {
  let response;
  try {
    response = await fetch(address);
  } catch {
    throw new SwardError("io", `${address}: no answer from the server`);
  }
  if (!response.ok) throw new SwardError("io", `${address}: the server answers ${response.status}`);
  return parseCoverFile(await response.arrayBuffer(), address);
}

// src/render/block.ts
var Block = class {
  constructor(layout, size2) {
    this.layout = layout;
    this.bytes = new ArrayBuffer(size2);
    this.asFloats = new Float32Array(this.bytes);
    this.asWords = new Uint32Array(this.bytes);
  }
  layout;
  bytes;
  asFloats;
  asWords;
  floats(path, values) {
    this.asFloats.set(values, this.at(path));
  }
  words(path, values) {
    this.asWords.set(values, this.at(path));
  }
  at(path) {
    const offset = this.layout[path];
    if (offset === void 0) throw new Error(`the block has no member ${path}`);
    return offset / 4;
  }
};

// src/render/light.ts
var usualLight = {
  sunDirection: unit([0.72, 0.62, -0.42]),
  sunColor: [3.4, 2.85, 2.1],
  skyColor: [0.42, 0.6, 0.92],
  groundColor: [0.2, 0.23, 0.11],
  adaptation: 1
};
var extinction = [0.08, 0.14, 0.26];
var afterglow = 0.0375;
var twilightFold = 6;
var darkest = 0.04;
var leafProjection = 0.5;
var maxAdaptation = 2;
var usualElevation = Math.asin(usualLight.sunDirection[1]) * 180 / Math.PI;
var each = (f) => [f(0), f(1), f(2)];
function airMass(elevation) {
  const above = Math.max(elevation, 0);
  return 1 / (Math.sin(above * Math.PI / 180) + 0.50572 * Math.pow(above + 6.07995, -1.6364));
}
function scattered(elevation) {
  const rise = Math.max(Math.sin(elevation * Math.PI / 180), 0);
  const factor = Math.sqrt(rise * rise + afterglow * afterglow);
  return each((i) => factor * (1 - Math.exp(-extinction[i] * airMass(elevation))));
}
function skyShare(elevation) {
  if (elevation >= usualElevation) return [1, 1, 1];
  const own = scattered(elevation);
  const usual = scattered(usualElevation);
  return each((i) => {
    const share = own[i] / usual[i];
    return elevation >= 0 ? share : Math.max(share * Math.exp(elevation / twilightFold), darkest);
  });
}
function sunColorAt(elevation) {
  const more = airMass(elevation) - airMass(usualElevation);
  return each((i) => usualLight.sunColor[i] * Math.exp(-extinction[i] * more));
}
function lightAt(azimuth, elevation, up) {
  const a = azimuth * Math.PI / 180;
  const e = elevation * Math.PI / 180;
  const share = skyShare(elevation);
  const lowered = Math.min(elevation, usualElevation);
  const low = elevation > 0 ? sunColorAt(lowered) : [0, 0, 0];
  const loweredShare = skyShare(lowered);
  const groundColor = each((i) => {
    const sky = 0.5 * 1.25 * usualLight.skyColor[i];
    return usualLight.groundColor[i] * (leafProjection * low[i] + sky * loweredShare[i]) / (leafProjection * usualLight.sunColor[i] + sky);
  });
  const luminance2 = (c) => dot(c, [0.2126, 0.7152, 0.0722]);
  const left = luminance2(groundColor) / luminance2(usualLight.groundColor);
  return {
    sunDirection: turnedWith(up, [Math.sin(a) * Math.cos(e), Math.sin(e), -Math.cos(a) * Math.cos(e)]),
    sunColor: elevation > 0 ? sunColorAt(elevation) : [0, 0, 0],
    skyColor: each((i) => usualLight.skyColor[i] * share[i]),
    groundColor,
    adaptation: Math.min(1 / Math.sqrt(left), maxAdaptation)
  };
}
var usualSun = {
  azimuth: Math.atan2(usualLight.sunDirection[0], -usualLight.sunDirection[2]) * 180 / Math.PI,
  elevation: usualElevation
};
function turnedWith(up, direction) {
  const cosine = up[1];
  if (cosine < -0.9999) return [direction[0], -direction[1], -direction[2]];
  const axis = cross([0, 1, 0], up);
  const once = cross(axis, direction);
  return add(add(direction, once), scaled(cross(axis, once), 1 / (1 + cosine)));
}
function lowSunOf(rise) {
  const t = clamp(rise / 0.59, 0, 1);
  return Math.pow(1 - t * t * (3 - 2 * t), 0.6);
}
function skyUpOf(direction, attractor, blend, eye) {
  const way = [attractor[0] - eye[0], attractor[1] - eye[1], attractor[2] - eye[2]];
  const pull = size(way) > 0 ? unit(way) : direction;
  return unit(
    each((i) => -(direction[i] * (1 - blend) + pull[i] * blend)),
    scaled(direction, -1)
  );
}

// src/render/wind.ts
var eddyDrift = [0.48, 0.57, 0.67];
var windPeriod = 65536;
var lessWhole = (x, period) => x - period * Math.round(x / period);
var number32 = (x) => Number(BigInt.asUintN(32, BigInt(Math.round(x))));
var point = (cell) => Math.imul(cell[0], latticeX) + Math.imul(cell[1], latticeY) + Math.imul(cell[2], latticeZ) >>> 0;
function writeWind(block, wind, origin, extent, strength, time) {
  const at = "environment.wind.";
  const sources = [
    { kind: windNoise, strength: wind.strength * wind.gustiness * strength, size: wind.gustSize },
    { kind: windWave, strength: wind.strength * (1 - wind.gustiness) * strength, size: wind.waveLength }
  ].filter((source) => source.strength > 0);
  const direction = unit(wind.direction, [1, 0, 0]);
  const side = Math.abs(direction[1]) < 0.99 ? unit(cross(direction, [0, 1, 0])) : [1, 0, 0];
  let counts = sources.length > 0 ? windsAlike : 0;
  let eddySize = extent > 0 ? 0.25 * extent : 1e9;
  let eddySpeed = 0;
  let sum = 0;
  sources.forEach((source, i) => {
    const s = `${at}sources[${i}].`;
    block.floats(`${s}direction`, direction);
    block.floats(`${s}strength`, [source.strength]);
    block.floats(`${s}size`, [source.size]);
    block.floats(`${s}speed`, [wind.speed]);
    block.floats(`${s}alignment`, [1]);
    block.words(`${s}kind`, [source.kind]);
    block.floats(`${s}side`, side);
    block.floats(`${s}perSize`, [1 / source.size]);
    counts += 1 << 4 * source.kind;
    sum += source.strength;
    eddySize = Math.min(eddySize, 2 * source.size);
    eddySpeed = Math.max(eddySpeed, Math.abs(wind.speed));
    writePhase(block, `${at}phases[${i}].`, source.kind, direction, wind.speed / source.size, time);
  });
  block.words(`${at}counts`, [counts]);
  block.floats(`${at}eddySize`, [eddySize]);
  block.floats(`${at}eddySpeed`, [eddySpeed]);
  block.floats(`${at}sum`, [sum]);
  block.floats(`${at}eddyPhase`, eddyDrift.map((drift) => lessWhole(drift * eddySpeed * time / eddySize, 1)));
  block.floats(`${at}lattice.origin`, origin.map((x) => lessWhole(x, windPeriod)));
  block.floats(`${at}lattice.x`, [1, 0, 0]);
  block.floats(`${at}lattice.y`, [0, 1, 0]);
  block.floats(`${at}lattice.z`, [0, 0, 1]);
}
function writePhase(block, at, kind, direction, pace, time) {
  if (kind === windWave) {
    block.floats(`${at}angle`, [2 * Math.PI * lessWhole(pace * time, 20)]);
    return;
  }
  const cells2 = direction.map((along) => -along * pace * time);
  const whole = cells2.map(Math.round);
  const fine = whole.map((cell) => fineNoiseScale * cell + fineNoiseStart);
  const wholeFine = fine.map(Math.round);
  block.floats(`${at}shift`, cells2.map((cell, i) => cell - whole[i]));
  block.words(`${at}cell`, [point(whole.map(number32))]);
  block.floats(`${at}fineShift`, fine.map((cell, i) => cell - wholeFine[i]));
  block.words(`${at}fineCell`, [point(wholeFine.map(number32))]);
}

// src/render/frame.ts
var frameSettings = { lodThreshold: 0.3, minPixels: 0.8, maxLeafArea: 10, clouds: 0.35, samples: 4 };
var sunMapSize = 2048;
function chosenFog(content, eye) {
  const nearest = [0, 1, 2].map((i) => clamp(eye[i], content.low[i], content.high[i]));
  const reach = Math.max(size(sub(content.high, content.low)), size(sub(eye, nearest)));
  return reach > 0 ? 0.105 / reach : 0;
}
var minWidthOf = (view) => frameSettings.minPixels / (view.pixelsPerUnit * Math.sqrt(frameSettings.samples));
function frameBlock(scene, input) {
  const { field, cover, content } = scene;
  const { view, light } = input;
  const block = new Block(frameLayout, frameBytes);
  const origin = field.origin;
  const gravity = field.defaults.gravity;
  const attractor = sub(gravity.attractor, origin);
  const skyUp = skyUpOf(gravity.direction, attractor, gravity.blend, view.eye);
  block.floats("viewProjection", view.viewProjection);
  view.rays.forEach((ray, i) => block.floats(`rays[${i}]`, ray));
  view.planes.forEach((plane, i) => block.floats(`view.planes[${i}]`, plane));
  block.floats("view.eye", view.eye);
  block.floats("view.drawDistance", [field.defaults.drawDistance]);
  block.floats("view.pixelsPerUnit", [view.pixelsPerUnit]);
  block.floats("view.lodThreshold", [input.lodThreshold]);
  block.floats("view.lodWidth", [scene.bladeWidth]);
  block.floats("view.minWidth", [minWidthOf(view)]);
  block.floats("view.maxLeafArea", [frameSettings.maxLeafArea]);
  block.floats("view.maxEdgeOn", [1]);
  block.words("view.samples", [frameSettings.samples]);
  block.words("view.cullMask", [cullPatch | cullOrientation | cullFrustum | cullDistance | leaveThinned]);
  block.floats("view.areaFactor", [cover.areaFactor]);
  block.floats("view.sparseFrom", [input.sparseFrom]);
  block.floats("view.sparseLeast", [input.sparseLeast]);
  block.words("maxTessellation", [16]);
  const environment = "environment.gravity.";
  block.floats(`${environment}direction`, unit(gravity.direction, [0, -1, 0]));
  block.floats(`${environment}strength`, [gravity.strength]);
  block.floats(`${environment}attractor`, attractor);
  block.floats(`${environment}blend`, [gravity.blend]);
  block.floats(`${environment}forward`, [0.25]);
  block.floats("environment.recovery", [field.defaults.recovery]);
  const extent = Math.max(...sub(content.high, content.low));
  writeWind(block, field.defaults.wind, origin, extent, input.wind, input.time);
  block.floats("sunDirection", light.sunDirection);
  block.floats("sunColor", light.sunColor);
  block.floats("skyColor", light.skyColor);
  block.floats("groundColor", light.groundColor);
  block.floats("skyUp", skyUp);
  block.floats("exposure", [scene.exposure * light.adaptation]);
  block.floats("lowSun", [lowSunOf(dot(light.sunDirection, skyUp))]);
  block.floats("fogDensity", [chosenFog(content, view.eye)]);
  block.floats("clouds", [frameSettings.clouds]);
  writeCover(block, cover, field.defaults.drawDistance);
  writeSun(block, scene.groundBox, light.sunDirection);
  if (input.shadowDistance > 0) writeBladeShadow(block, view, input.camera, light.sunDirection, input.shadowDistance);
  const floor = scene.floor;
  block.floats("floorPlane.middle", floor.middle);
  block.floats("floorPlane.reach", [floor.reach]);
  block.floats("floorPlane.along", floor.along);
  block.floats("floorPlane.height", [floor.height]);
  block.floats("floorPlane.halfSides", floor.halfSides);
  block.floats("floorPlane.cornerRadius", [floor.cornerRadius]);
  return block;
}
function writeCover(block, cover, drawDistance) {
  block.floats("cover.low", cover.low);
  block.floats("cover.cellsPerMetre", [cover.cellsPerMetre]);
  block.words("cover.countX", [cover.counts[0]]);
  block.words("cover.countY", [cover.counts[1]]);
  block.words("cover.countZ", [cover.counts[2]]);
  block.floats("cover.farthest", [drawDistance]);
  block.floats("cover.undergrowth", cover.undergrowth);
  block.floats("cover.thatch", [1]);
  block.floats("cover.sward", cover.sward);
  block.floats("cover.thinned", [cover.thinned]);
  block.floats("cover.structure", [cover.structure]);
  block.floats("cover.stepsPerMetre", [cover.stepsPerMetre]);
  cover.leaves.forEach((word, i) => block.words(`cover.leaves[${i}]`, [word]));
}
function axesAbout(n) {
  const s = n[2] >= 0 ? 1 : -1;
  const a = -1 / (s + n[2]);
  return [
    [1 + s * n[0] * n[0] * a, s * n[0] * n[1] * a, -s * n[0]],
    [n[0] * n[1] * a, s + n[1] * n[1] * a, -n[1]]
  ];
}
function writeSun(block, ground, sun) {
  if (!(ground.low[0] <= ground.high[0])) return;
  const rim = 2;
  const axes = [...axesAbout(sun), sun];
  const centre = [0, 1, 2].map((i) => 0.5 * (ground.low[i] + ground.high[i]));
  const half = [0, 1, 2].map((i) => 0.5 * (ground.high[i] - ground.low[i]));
  const reach = axes.map((axis) => Math.max(dot(axis.map(Math.abs), half), 1e-6));
  const scales = [(0.5 * sunMapSize - rim) / reach[0], (0.5 * sunMapSize - rim) / reach[1], 0.49 / reach[2]];
  const row = (i, middle) => [...scaled(axes[i], scales[i]), middle - scales[i] * dot(axes[i], centre)];
  block.floats("shadow.across", row(0, 0.5 * sunMapSize));
  block.floats("shadow.down", row(1, 0.5 * sunMapSize));
  block.floats("shadow.depth", row(2, 0.5));
  block.words("shadow.size", [sunMapSize]);
  block.floats("shadow.texel", [1 / Math.min(scales[0], scales[1])]);
  block.floats("shadow.epsilon", [4e-6]);
}
function shadowRows(view, camera, sun, distance) {
  const half = 0.5 * distance;
  const across = unit(cross(Math.abs(sun[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0], sun));
  const down = cross(sun, across);
  const middle = axesOf(camera).forward.map((x, i) => view.eye[i] + half * x);
  const texel = 2 * half / bladeShadowTexels;
  const stepped = (axis) => Math.round(dot(axis, middle) / texel) * texel;
  const length = 3 * half;
  return [
    [...scaled(across, 1 / half), -stepped(across) / half],
    [...scaled(down, 1 / half), -stepped(down) / half],
    [...scaled(sun, 1 / length), (half - stepped(sun)) / length]
  ];
}
function writeBladeShadow(block, view, camera, sun, distance) {
  const rows = shadowRows(view, camera, sun, distance);
  const half = 0.5 * bladeShadowTexels;
  const inTexels = (row) => row.map((x, i) => half * x + (i === 3 ? half : 0));
  block.floats("bladeShadow.across", inTexels(rows[0]));
  block.floats("bladeShadow.down", inTexels(rows[1]));
  block.floats("bladeShadow.depth", rows[2]);
  block.words("bladeShadow.size", [bladeShadowTexels]);
  block.floats("bladeShadow.nearer", [1 / (bladeShadowTexels * 3)]);
}
function shadowPlanes(rows) {
  const one = [0, 0, 0, 1];
  const plane = (a, b, sign) => {
    const sum = a.map((x, i) => x + sign * b[i]);
    const length = Math.hypot(sum[0], sum[1], sum[2]) || 1;
    return sum.map((x) => x / length);
  };
  const zero = [0, 0, 0, 0];
  return [
    plane(one, rows[0], 1),
    plane(one, rows[0], -1),
    plane(one, rows[1], 1),
    plane(one, rows[1], -1),
    plane(one, rows[2], -1),
    plane(rows[2], zero, 0)
  ];
}
function looksBlock(field) {
  const block = new Block(looksLayout, looksBytes);
  const radians = (degrees) => degrees * Math.PI / 180;
  const write = (at, look, firstOrgan, organKinds) => {
    block.floats(`${at}rootColor`, look.rootColor);
    block.floats(`${at}tipThreshold`, [look.tipThreshold]);
    block.floats(`${at}tipColor`, look.tipColor);
    block.floats(`${at}groundTint`, [look.groundTint]);
    block.floats(`${at}colorVariation`, [look.colorVariation]);
    block.floats(`${at}translucency`, [look.translucency]);
    block.floats(`${at}gloss`, [look.gloss]);
    block.floats(`${at}dryness`, [look.dryness]);
    block.words(`${at}shape`, [look.shape]);
    block.floats(`${at}fold`, [look.fold]);
    block.words(`${at}firstOrgan`, [firstOrgan]);
    block.words(`${at}organKinds`, [organKinds]);
  };
  let next = 0;
  field.species.forEach((species, i) => {
    write(`species[${i}].`, species, species.organs.length > 0 ? next : 0, species.organs.length);
    for (const organ of species.organs) {
      const at = `organs[${next++}].`;
      write(`${at}look.`, organ, 0, 0);
      block.words(`${at}count`, [organ.count]);
      block.floats(`${at}place`, organ.place);
      block.floats(`${at}pitch`, organ.pitch.map(radians));
      block.floats(`${at}size`, organ.length);
      block.floats(`${at}width`, [organ.width]);
      block.floats(`${at}azimuth`, [radians(organ.azimuth)]);
      block.floats(`${at}turn`, [radians(organ.turn)]);
      block.floats(`${at}bend`, [radians(organ.bend)]);
      block.floats(`${at}leg`, [legLength(radians(organ.bend))]);
      block.floats(`${at}variation`, [organ.variation]);
    }
  });
  return block;
}
function legLength(bend) {
  let sum = 0;
  for (let i = 0; i <= 32; ++i) {
    const t = i / 32;
    const speed = Math.sqrt(Math.max(1 - 2 * t * (1 - t) * (1 - Math.cos(bend)), 0));
    sum += (i === 0 || i === 32 ? 1 : i % 2 === 1 ? 4 : 2) * speed;
  }
  return 0.5 * 96 / sum;
}

// src/render/gl.ts
var units = [
  "bladeTexture",
  "stateTexture",
  "patchTexture",
  "coverTexture",
  "sunTexture",
  "bladeShadowTexture",
  "baseColor",
  "resolved",
  "resolved1",
  "resolved2",
  "resolved3"
];
var blocks = ["FrameConstants", "LookTables"];
var firstBlock = 22;
var Program = class {
  /** `captured`: outputs of the vertex stage that transform feedback keeps, in this order. */
  constructor(gl, name, vertex, fragment, captured2 = []) {
    this.gl = gl;
    this.name = name;
    this.program = gl.createProgram();
    const shaders = [
      [gl.VERTEX_SHADER, vertex],
      [gl.FRAGMENT_SHADER, fragment]
    ].map(([kind, text]) => {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
      return shader;
    });
    if (captured2.length > 0) gl.transformFeedbackVaryings(this.program, captured2, gl.INTERLEAVED_ATTRIBS);
    gl.linkProgram(this.program);
    this.check = () => {
      if (gl.getProgramParameter(this.program, gl.LINK_STATUS) || gl.isContextLost()) return;
      const log = [...shaders.map((shader) => gl.getShaderInfoLog(shader)), gl.getProgramInfoLog(this.program)];
      console.warn(log.join("\n"));
      fail("runtime", `the program ${name} does not compile on this device`);
    };
  }
  gl;
  name;
  program;
  places = /* @__PURE__ */ new Map();
  check;
  /** Waits for the compiler, and sets samplers and blocks. */
  finish() {
    this.check();
    const gl = this.gl;
    gl.useProgram(this.program);
    units.forEach((sampler, unit2) => {
      const place = gl.getUniformLocation(this.program, sampler);
      if (place) gl.uniform1i(place, unit2);
    });
    blocks.forEach((block, binding) => {
      const index = gl.getUniformBlockIndex(this.program, block);
      if (index !== gl.INVALID_INDEX) gl.uniformBlockBinding(this.program, index, firstBlock + binding);
    });
    return this;
  }
  use() {
    this.gl.useProgram(this.program);
  }
  place(name) {
    if (!this.places.has(name)) this.places.set(name, this.gl.getUniformLocation(this.program, name));
    return this.places.get(name);
  }
};
function bindTexture(gl, sampler, texture) {
  gl.activeTexture(gl.TEXTURE0 + units.indexOf(sampler));
  gl.bindTexture(gl.TEXTURE_2D, texture);
}
function makeTexture(gl, format, width, height) {
  const texture = gl.createTexture();
  gl.activeTexture(gl.TEXTURE0 + units.length);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return texture;
}
var tableWidth = 2048;
function wordTable(gl, words) {
  const rows = Math.max(Math.ceil(words.length / tableWidth), 1);
  const texture = makeTexture(gl, gl.R32UI, tableWidth, rows);
  const whole = new Uint32Array(rows * tableWidth);
  whole.set(words);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, tableWidth, rows, gl.RED_INTEGER, gl.UNSIGNED_INT, whole);
  return texture;
}
function imageTexture(gl, image) {
  let { width, height, pixels } = image ?? { width: 1, height: 1, pixels: new Uint8Array([255, 255, 255, 255]) };
  const most = gl.getParameter(gl.MAX_TEXTURE_SIZE);
  while (width > most || height > most) {
    const [w, h] = [Math.max(width >> 1, 1), Math.max(height >> 1, 1)];
    const from = new Uint32Array(pixels.slice().buffer);
    const half = new Uint32Array(w * h);
    for (let y = 0; y < h; ++y)
      for (let x = 0; x < w; ++x)
        half[y * w + x] = from[Math.min(2 * y, height - 1) * width + Math.min(2 * x, width - 1)];
    [width, height, pixels] = [w, h, new Uint8Array(half.buffer)];
  }
  const texture = gl.createTexture();
  gl.activeTexture(gl.TEXTURE0 + units.length);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  gl.generateMipmap(gl.TEXTURE_2D);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
  return texture;
}
function makeTarget(gl, color, depth = null) {
  const target = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  if (color) gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0);
  else gl.drawBuffers([gl.NONE]);
  if (depth) gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
  return target;
}
var samplePlaces = [
  [0.375, 0.125],
  [0.875, 0.375],
  [0.125, 0.625],
  [0.625, 0.875]
];
var Picture = class {
  constructor(gl, width, height, isFine) {
    this.gl = gl;
    this.width = width;
    this.height = height;
    this.isFine = isFine;
    const samples2 = isFine ? 0 : samplePlaces.length;
    this.drawn = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.drawn);
    this.buffers = [
      [gl.SRGB8_ALPHA8, gl.COLOR_ATTACHMENT0],
      [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]
    ].map(([format, place]) => {
      const buffer2 = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer2);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples2, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer2);
      return buffer2;
    });
    this.resolved = (isFine ? samplePlaces : [0]).map(() => makeTexture(gl, gl.SRGB8_ALPHA8, width, height));
    this.targets = this.resolved.map((texture) => makeTarget(gl, texture));
  }
  gl;
  width;
  height;
  isFine;
  /** One texture, or one for each sample. */
  resolved;
  drawn;
  buffers;
  targets;
  begin() {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.drawn);
    gl.viewport(0, 0, this.width, this.height);
    gl.clearDepth(1);
    gl.clear(gl.DEPTH_BUFFER_BIT | gl.COLOR_BUFFER_BIT);
  }
  /** Copies what is drawn into a texture of `resolved`. */
  end(sample) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.drawn);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.targets[sample]);
    const { width, height } = this;
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  }
  delete() {
    const gl = this.gl;
    gl.deleteFramebuffer(this.drawn);
    for (const target of this.targets) gl.deleteFramebuffer(target);
    for (const texture of this.resolved) gl.deleteTexture(texture);
    for (const buffer2 of this.buffers) gl.deleteRenderbuffer(buffer2);
  }
};

// src/render/host.ts
var rowOf = (m, i) => [m[i], m[4 + i], m[8 + i], m[12 + i]];
function rowsOfProduct(a, b) {
  return a.map((row) => [0, 1, 2, 3].map((c) => row.reduce((sum, x, k) => sum + x * b[4 * c + k], 0)));
}
function hostView(input, height, usualLight2) {
  const own = [0, 1, 2, 3].map((i) => rowOf(input.view, i));
  const inEye = input.place ? rowsOfProduct(own, input.place) : own;
  const axes = inEye.slice(0, 3).map((row) => row.slice(0, 3));
  const eye = axes.reduce((sum, axis, i) => add(sum, scaled(axis, -inEye[i][3])), [0, 0, 0]);
  const projection = [0, 1, 2, 3].map((i) => rowOf(input.projection, i));
  const [x, y, z, w] = projection.map((row) => [0, 1, 2, 3].map((c) => row.reduce((sum, v, k) => sum + v * inEye[k][c], 0)));
  const down = y.map((v) => -v);
  const depth = w.map((v, i) => 0.5 * (v - z[i]));
  const viewProjection = [];
  for (let c = 0; c < 4; ++c) viewProjection.push(x[c], down[c], depth[c], w[c]);
  const plane = (a, b, sign) => {
    const sum = a.map((v, i) => v + sign * b[i]);
    const length = Math.hypot(sum[0], sum[1], sum[2]) || 1;
    return sum.map((v) => v / length);
  };
  const zero = [0, 0, 0, 0];
  const focal = input.projection[5];
  const forward = scaled(axes[2], -1);
  const turn = (v) => input.place ? [0, 1, 2].map((c) => dot(v, [input.place[4 * c], input.place[4 * c + 1], input.place[4 * c + 2]])) : v;
  return {
    view: {
      eye,
      viewProjection,
      planes: [plane(w, x, 1), plane(w, x, -1), plane(w, down, -1), plane(w, down, 1), plane(w, depth, -1), plane(depth, zero, 0)],
      rays: [scaled(axes[0], 1 / input.projection[0]), scaled(axes[1], -1 / focal), forward],
      pixelsPerUnit: 0.5 * focal * height
    },
    camera: { name: "host", eye, target: add(eye, forward), up: axes[1], fovYDeg: 360 / Math.PI * Math.atan(1 / focal) },
    light: input.light ? { ...input.light, sunDirection: unit(turn(input.light.sunDirection)) } : usualLight2
  };
}
function enterHost(gl) {
  const state = {
    framebuffer: gl.getParameter(gl.FRAMEBUFFER_BINDING),
    viewport: gl.getParameter(gl.VIEWPORT)
  };
  for (const switchedOff of [
    gl.BLEND,
    gl.CULL_FACE,
    gl.SCISSOR_TEST,
    gl.STENCIL_TEST,
    gl.POLYGON_OFFSET_FILL,
    gl.SAMPLE_ALPHA_TO_COVERAGE,
    gl.SAMPLE_COVERAGE,
    gl.RASTERIZER_DISCARD
  ])
    gl.disable(switchedOff);
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
  gl.depthMask(true);
  gl.depthRange(0, 1);
  gl.clearDepth(1);
  gl.clearColor(0, 0, 0, 0);
  gl.colorMask(true, true, true, true);
  gl.cullFace(gl.BACK);
  gl.frontFace(gl.CCW);
  gl.bindBuffer(gl.PIXEL_UNPACK_BUFFER, null);
  gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, 0);
  gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, 0);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
  for (const skipped of [gl.UNPACK_ROW_LENGTH, gl.UNPACK_SKIP_ROWS, gl.UNPACK_SKIP_PIXELS]) gl.pixelStorei(skipped, 0);
  for (let unit2 = 0; unit2 < 12; ++unit2) gl.bindSampler(unit2, null);
  return state;
}
function leaveHost(gl, state) {
  gl.bindVertexArray(null);
  gl.bindBuffer(gl.ARRAY_BUFFER, null);
  gl.useProgram(null);
  gl.disable(gl.CULL_FACE);
  gl.activeTexture(gl.TEXTURE0);
  gl.bindFramebuffer(gl.FRAMEBUFFER, state.framebuffer);
  gl.viewport(state.viewport[0], state.viewport[1], state.viewport[2], state.viewport[3]);
}

// src/render/exposure.ts
var exposedGrey = 0.163;
var exposedBright = 1.6;
var meadowBrightness = 0.6;
var adaptation = 0.5;
var usualGround = 0.2;
var fewBlades = 0.05;
var groundSamples = 2e4;
var samplesOfTriangle = 256;
var mayClip = 0.01;
var skyExtinction = 1.2;
var lowestSun = 0.1;
var luminance = (c) => 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
var linear = (s) => s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4;
var undergrowthBelow = (leafArea) => 1 - Math.exp(-0.65 * leafArea);
function lightBelow(cover, leafArea, facing) {
  const upwards = leafProjectionOf(cover);
  const risen = Math.max(facing, lowestSun);
  const beside = 0.637 * Math.sqrt(Math.max(1 - 1.9 * upwards * upwards, 0));
  const along = Math.hypot(upwards * risen, beside * Math.sqrt(Math.max(1 - risen * risen, 0)));
  const sun = facing * Math.exp(-along * leafArea / risen);
  const sky = 1.25 * Math.exp(-skyExtinction * leafArea);
  return [0, 1, 2].map((i) => sun * usualLight.sunColor[i] + sky * usualLight.skyColor[i]);
}
function placesOf(ground, cover) {
  const view = new DataView(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length);
  const float = (vertex, word) => view.getFloat32(groundVertexBytes * vertex + 4 * word, true);
  const position = (v) => [float(v, 0), float(v, 1), float(v, 2)];
  const color = (v) => [0, 1, 2].map((i) => view.getUint8(groundVertexBytes * v + 24 + i) / 255);
  const ranges = ground.ranges.filter((range) => range.level === 0);
  const triangles = ranges.reduce((sum, range) => sum + range.indexCount / 3, 0);
  const stride = Math.max(Math.floor(triangles / groundSamples), 1);
  const each2 = clamp(Math.floor(groundSamples / Math.max(triangles, 1)), 1, samplesOfTriangle);
  const places2 = [];
  for (const range of ranges) {
    const material = ground.materials[range.material];
    for (let i = 0; i < range.indexCount / 3; i += stride) {
      const corners = [0, 1, 2].map((k) => ground.indices[range.firstIndex + 3 * i + k]);
      const [a, b, c] = corners.map(position);
      const area = 0.5 * stride * size(cross(sub(b, a), sub(c, a))) / each2;
      for (let k = 0; k < each2; ++k) {
        const n = places2.length;
        let p = (0.5 + n * 0.7548776662466927) % 1;
        let q = (0.5 + n * 0.569840290998053) % 1;
        if (p + q > 1) [p, q] = [1 - p, 1 - q];
        const w = [1 - p - q, p, q];
        const mixed = (values) => values[0].map((_, j) => w[0] * values[0][j] + w[1] * values[1][j] + w[2] * values[2][j]);
        const vertex = mixed(corners.map(color));
        const albedo = [0, 1, 2].map((j) => material.baseColor[j] * vertex[j]);
        const image = ground.images[material.image];
        if (image) {
          const uv = mixed(corners.map((v) => [float(v, 4), float(v, 5)]));
          const x = Math.min(Math.floor((uv[0] - Math.floor(uv[0])) * image.width), image.width - 1);
          const y = Math.min(Math.floor((uv[1] - Math.floor(uv[1])) * image.height), image.height - 1);
          for (let j = 0; j < 3; ++j) albedo[j] *= linear(image.pixels[4 * (y * image.width + x) + j] / 255);
        }
        const place = mixed([a, b, c]);
        places2.push({ color: albedo, area, leafArea: cover.thinned * leafAreaAt(cover, place) });
      }
    }
  }
  return places2;
}
function chosenExposure(ground, cover, hasBlades) {
  const cosine = usualLight.sunDirection[1];
  const times = (a, b) => [a[0] * b[0], a[1] * b[1], a[2] * b[2]];
  const leaves = hasBlades ? luminance(times(cover.sward, lightBelow(cover, 0, cosine))) : 0;
  let area = 0;
  let open = 0;
  let bare = 0;
  let stops = 0;
  const facing = [];
  for (const place of placesOf(ground, cover)) {
    const under = undergrowthBelow(place.leafArea);
    const share = 1 - under;
    const color = place.color.map((c, i) => c * share + cover.undergrowth[i] * under);
    const level = luminance(times(color, lightBelow(cover, place.leafArea, cosine)));
    area += place.area;
    open += share * place.area;
    bare += place.area * luminance(times(place.color, lightBelow(cover, 0, cosine)));
    if (leaves > 0) stops += share * place.area * Math.log(Math.max(level / leaves, 1));
    facing.push({
      radiance: Math.max(...times(color, lightBelow(cover, place.leafArea, 1))),
      area: share * place.area
    });
  }
  facing.sort((a, b) => b.radiance - a.radiance);
  let brightest = 0;
  let above = 0;
  for (const one of facing) {
    above += one.area;
    if (above < mayClip * area) continue;
    brightest = one.radiance;
    break;
  }
  const seen = area > 0 ? { share: open / area, mean: bare / area, stops: stops / area } : { share: 0, mean: 0, stops: 0 };
  let mean = seen.mean > usualGround ? Math.sqrt(seen.mean * usualGround) : seen.mean;
  let raised = 0;
  if (leaves > 0) {
    const meadow = Math.min((1 - seen.share) / fewBlades, 1);
    mean = (meadowBrightness * leaves) ** meadow * Math.max(mean, 1e-6) ** (1 - meadow);
    raised = meadow * adaptation * seen.stops;
  }
  const wanted = mean > 0 ? exposedGrey / mean * Math.exp(-raised) : 1;
  const allowed = brightest > 0 ? exposedBright / brightest : 4;
  return clamp(Math.min(wanted, allowed), 0.25, 4);
}

// src/render/floor.ts
var noFloor = {
  middle: [0, 0, 0],
  reach: 0,
  along: [1, 0, 0],
  height: 0,
  halfSides: [1, 1],
  cornerRadius: 0
};
var Extent = class {
  low = Infinity;
  high = -Infinity;
  add(value) {
    this.low = Math.min(this.low, value);
    this.high = Math.max(this.high, value);
  }
  get length() {
    return Math.max(this.high - this.low, 0);
  }
  get middle() {
    return 0.5 * (this.low + this.high);
  }
};
function isSheet(ground, floats, up) {
  let above = 0;
  let below = 0;
  const at = (v) => [floats[7 * v], floats[7 * v + 1], floats[7 * v + 2]];
  for (const range of ground.ranges) {
    if (range.level !== 0) continue;
    for (let i = range.firstIndex; i + 2 < range.firstIndex + range.indexCount; i += 3) {
      const a = at(ground.indices[i]);
      const area = dot(cross(sub(at(ground.indices[i + 1]), a), sub(at(ground.indices[i + 2]), a)), up);
      if (area > 0) above += area;
      else below -= area;
    }
  }
  return Math.max(above, below) >= 0.8 * (above + below);
}
function floorOf(ground, up) {
  const s = up.map(Math.abs);
  const side = s[0] <= Math.min(s[1], s[2]) ? [1, 0, 0] : [0, 0, 1];
  const alongAxis = unit(sub(side, scaled(up, dot(side, up))));
  const acrossAxis = cross(up, alongAxis);
  const floats = new Float32Array(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length / 4);
  const along = new Extent();
  const across = new Extent();
  const above = new Extent();
  const place = (v) => {
    const p = [floats[7 * v], floats[7 * v + 1], floats[7 * v + 2]];
    return [dot(p, alongAxis), dot(p, acrossAxis), dot(p, up)];
  };
  for (let v = 0; v < ground.vertexCount; ++v) {
    const [x, z, y] = place(v);
    along.add(x);
    across.add(z);
    above.add(y);
  }
  const half = 0.5 * Math.hypot(along.length, across.length);
  if (ground.vertexCount === 0 || !(half > 0)) return noFloor;
  const foot = new Extent();
  const footAcross = new Extent();
  const rim = new Extent();
  let farthest2 = 0;
  const sides = [Math.max(0.5 * along.length, 1e-6), Math.max(0.5 * across.length, 1e-6)];
  for (let v = 0; v < ground.vertexCount; ++v) {
    const [x, z, y] = place(v);
    const a = Math.abs((x - along.middle) / sides[0]);
    const b = Math.abs((z - across.middle) / sides[1]);
    farthest2 = Math.max(farthest2, Math.hypot(a, b));
    if (Math.max(a, b) >= 0.95) rim.add(y);
    if (y > above.low + 0.02 * above.length) continue;
    foot.add(x);
    footAcross.add(z);
  }
  const sheet = isSheet(ground, floats, up);
  const stands = foot.length >= 0.6 * along.length && footAcross.length >= 0.6 * across.length;
  if (!stands && !sheet) return noFloor;
  const level = sheet ? rim.low : above.low;
  const root = Math.SQRT2;
  return {
    middle: add(add(scaled(alongAxis, along.middle), scaled(acrossAxis, across.middle)), scaled(up, level)),
    reach: 2.5 * half,
    along: alongAxis,
    height: 0.5 * (above.high - level),
    halfSides: sides,
    cornerRadius: Math.min(...sides) * clamp((root - farthest2) / (root - 1), 0, 1)
  };
}

// src/render/tree.ts
var groupBlades = 32;
var classes = [
  { segments: 16, above: 120, columns: 3 },
  { segments: 8, above: 26, columns: 3 },
  { segments: 4, above: 5, columns: 2 },
  { segments: 2, above: -1, columns: 2 },
  { segments: bladeShadowSegments, above: Infinity, columns: 2 }
];
var shadowClass = 4;
var lodShare = (pixels, threshold) => Math.min(Math.max(pixels / threshold, 1 / 256), lodFullShare);
function sparseShare(view, share, distance) {
  if (view.sparseFrom <= 0 || distance <= view.sparseFrom) return 1;
  return Math.max((view.sparseFrom / distance) ** 3, Math.min(view.sparseLeast / share, 1));
}
var PatchTree = class {
  /** `sowing`: of a field that is sown; its patches stand for those of the field. */
  constructor(field, sowing) {
    this.field = field;
    this.sowing = sowing;
    const patches = this.patches = sowing?.patches ?? field.patches;
    const stored = field.patches.count;
    this.ribbons = Math.max(0, ...field.species.map((one) => ribbonsOf(one.organs)));
    this.widest = subtreeWidths(patches, stored);
    this.rankBelow = new Float32Array(stored).fill(1);
    this.queue = new Uint32Array(stored);
    const f = patches.floats;
    for (let p = stored - 1; p >= 0; --p) {
      const at = p * patchWords;
      if (p === 0) continue;
      const parent = patches.parent(p);
      const rank = patches.bladeCount(p) > 0 ? f[at + patchWord.rankLow] : 1;
      this.rankBelow[parent] = Math.min(this.rankBelow[parent], rank, this.rankBelow[p]);
    }
  }
  field;
  sowing;
  /** Largest full width of a blade in each subtree [m]. */
  widest;
  /** The lowest rank below each node; 1 if there is none. */
  rankBelow;
  queue;
  patches;
  /** Ribbons of a plant at most. */
  ribbons;
  /** Distance [m] of the eye from a patch's box. */
  distance(view, at) {
    const f = this.patches.floats;
    let square = 0;
    for (let i = 0; i < 3; ++i) {
      const off = Math.max(
        f[at + patchWord.boundsLow + i] - view.eye[i],
        view.eye[i] - f[at + patchWord.boundsHigh + i],
        0
      );
      square += off * off;
    }
    return Math.sqrt(square);
  }
  shareAt(view, distance) {
    if (view.lodThreshold <= 0) return lodFullShare;
    const share = lodShare(view.lodWidth * view.pixelsPerUnit / Math.max(distance, 1e-6), view.lodThreshold);
    return share * sparseShare(view, share, distance);
  }
  leavesPerDrawn(view, distance) {
    if (view.sparseFrom <= 0 || distance <= view.sparseFrom || view.lodThreshold <= 0) return 1;
    const share = lodShare(view.lodWidth * view.pixelsPerUnit / Math.max(distance, 1e-6), view.lodThreshold);
    return 1 / Math.sqrt(sparseShare(view, share, distance));
  }
  /** Whether no blade of a subtree is in the view. */
  isOutside(view, p, nearest, widest) {
    if (nearest > view.drawDistance) return true;
    const f = this.patches.floats;
    const at = p * patchWords;
    let square = 0;
    let thinnest = Infinity;
    for (let i = 0; i < 3; ++i) {
      const low = f[at + patchWord.boundsLow + i];
      const high = f[at + patchWord.boundsHigh + i];
      const far = Math.max(Math.abs(low - view.eye[i]), Math.abs(high - view.eye[i]));
      square += far * far;
      thinnest = Math.min(thinnest, high - low);
    }
    const farthest2 = Math.sqrt(square);
    const margin = 0.5 * outlineMost * widest / (0.95 * this.shareAt(view, farthest2) * this.leavesPerDrawn(view, farthest2)) + view.minWidth * farthest2 + (maxHeightCompensation - 1) * 0.5 * thinnest;
    for (const plane of view.planes) {
      let sum = plane[3];
      for (let i = 0; i < 3; ++i)
        sum += plane[i] * (plane[i] >= 0 ? f[at + patchWord.boundsHigh + i] + margin : f[at + patchWord.boundsLow + i] - margin);
      if (sum < 0) return true;
    }
    return false;
  }
  /** The groups of blades that a view may show. `most`: blades at most. */
  groupsOf(view, most, oneClass = -1) {
    const { patches, sowing } = this;
    const f = patches.floats;
    const seen = [];
    const wanted = [];
    let blades = 0;
    const add2 = (p, share, nearest, isStored) => {
      const at = p * patchWords;
      const own = patches.bladeCount(p);
      const low = f[at + patchWord.rankLow];
      const high = f[at + patchWord.rankHigh];
      if (own === 0 || share <= low) return;
      const thick = share >= high ? own : Math.ceil((share - low) / (high - low) * own) + 1;
      const count = Math.min(thick + this.ribbons, own);
      const begin = patches.firstBlade(p);
      if (isStored && !this.field.has(begin, count)) {
        for (const page of pagesOf2(begin, count))
          if (this.field.isMissing(page)) wanted.push({ page, distance: nearest * (1 + low) });
        return;
      }
      if (blades + count > most) return;
      blades += count;
      seen.push({ patch: p, count, distance: nearest });
    };
    let end = 0;
    if (this.field.patches.count > 0) this.queue[end++] = 0;
    for (let next = 0; next < end; ++next) {
      const p = this.queue[next];
      const nearest = this.distance(view, p * patchWords);
      if (this.isOutside(view, p, nearest, this.widest[p])) continue;
      const share = this.shareAt(view, nearest);
      if (share > this.rankBelow[p]) {
        const first = patches.firstChild(p);
        for (let i = 0; i < patches.childCount(p); ++i) this.queue[end++] = first + i;
      }
      add2(p, share, nearest, true);
    }
    const widestOf = (p) => f[p * patchWords + patchWord.widthLow] + 63 * f[p * patchWords + patchWord.widthStep];
    sowing?.walk(
      (whole) => !this.isOutside(view, whole, this.distance(view, whole * patchWords), widestOf(whole)),
      (p) => {
        const nearest = this.distance(view, p * patchWords);
        const share = this.shareAt(view, nearest);
        if (share <= f[p * patchWords + patchWord.rankLow]) return;
        if (!this.isOutside(view, p, nearest, widestOf(p))) add2(p, share, nearest, false);
      }
    );
    seen.sort((a, b) => a.distance - b.distance);
    const lists = classes.map(() => []);
    for (const { patch, count, distance } of seen) {
      const at = patch * patchWords;
      const height = f[at + patchWord.heightLow] + 255 * f[at + patchWord.heightStep];
      const pixels = height * view.pixelsPerUnit / Math.max(distance, 1e-6);
      const kind = oneClass >= 0 ? oneClass : classes.findIndex((one) => pixels > one.above);
      for (let i = 0; i < count; i += groupBlades) lists[kind].push(patch, i, Math.min(groupBlades, count - i));
    }
    const begins = [0];
    for (const list of lists) begins.push(begins[begins.length - 1] + list.length / 3);
    const words = new Uint32Array(3 * begins[classes.length]);
    lists.forEach((list, i) => words.set(list, 3 * begins[i]));
    wanted.sort((a, b) => a.distance - b.distance);
    return { words, begins, blades, missing: [...new Set(wanted.map((one) => one.page))] };
  }
};
function subtreeWidths(patches, count = patches.count) {
  const f = patches.floats;
  const widest = new Float32Array(count);
  for (let p = count - 1; p >= 0; --p) {
    const at = p * patchWords;
    const own = patches.bladeCount(p) > 0 ? f[at + patchWord.widthLow] + 63 * f[at + patchWord.widthStep] : 0;
    widest[p] = Math.max(widest[p], own);
    if (p > 0) widest[patches.parent(p)] = Math.max(widest[patches.parent(p)], widest[p]);
  }
  return widest;
}
var pageBlades2 = 1024;
function* pagesOf2(first, count) {
  for (let p = Math.floor(first / pageBlades2); p <= Math.floor((first + count - 1) / pageBlades2); ++p) yield p;
}
function meanBladeWidth(patches, patchCount = patches.count) {
  const f = patches.floats;
  let width = 0;
  let count = 0;
  for (let p = 0; p < patchCount; ++p) {
    const own = patches.bladeCount(p);
    width += own * (f[p * patchWords + patchWord.widthLow] + 31.5 * f[p * patchWords + patchWord.widthStep]);
    count += own;
  }
  return count > 0 ? width / count : 0.01;
}

// src/render/scene.ts
function boxOf(field) {
  const ground = { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };
  const vertices = field.ground.vertices;
  const floats = new Float32Array(vertices.buffer, vertices.byteOffset, vertices.length / 4);
  for (let v = 0; v < field.ground.vertexCount; ++v)
    for (let i = 0; i < 3; ++i) {
      ground.low[i] = Math.min(ground.low[i], floats[7 * v + i]);
      ground.high[i] = Math.max(ground.high[i], floats[7 * v + i]);
    }
  const content = { low: [...ground.low], high: [...ground.high] };
  if (field.patches.count > 0)
    for (let i = 0; i < 3; ++i) {
      content.low[i] = Math.min(content.low[i], field.patches.floats[i]);
      content.high[i] = Math.max(content.high[i], field.patches.floats[4 + i]);
    }
  return { content, ground };
}
function sceneOf(field, cover, patches = field.patches) {
  const { content, ground } = boxOf(field);
  const gravity = field.defaults.gravity;
  const up = unit(scaled(gravity.direction, -1));
  return {
    field,
    cover,
    content,
    groundBox: ground,
    floor: gravity.blend === 0 ? floorOf(field.ground, up) : noFloor,
    bladeWidth: meanBladeWidth(patches, field.patches.count),
    exposure: chosenExposure(field.ground, cover, field.bladeCount > 0)
  };
}

// src/render/tables.ts
var patchTexels = 7;
var patchesOfRow = 256;
function patchTexelsOf(patches, first, end, room = end - first) {
  const texels = new Uint32Array(4 * patchTexels * room);
  for (let p = first; p < end; ++p)
    texels.set(patches.words.subarray(p * patchWords, (p + 1) * patchWords), 4 * patchTexels * (p - first));
  return texels;
}
function patchTable(gl, patches) {
  const rows = Math.max(Math.ceil(patches.count / patchesOfRow), 1);
  const width = patchTexels * patchesOfRow;
  const texels = patchTexelsOf(patches, 0, patches.count, rows * patchesOfRow);
  const texture = makeTexture(gl, gl.RGBA32UI, width, rows);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, rows, gl.RGBA_INTEGER, gl.UNSIGNED_INT, texels);
  return texture;
}
function ribbonIndices(gl, segments, columns) {
  const list = [];
  for (let row = 0; row < segments; ++row)
    for (let column = 0; column + 1 < columns; ++column) {
      const first = row * columns + column;
      const above = first + columns;
      list.push(first, first + 1, above, above, first + 1, above + 1);
    }
  const buffer2 = gl.createBuffer();
  gl.bindVertexArray(null);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer2);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint16Array(list), gl.STATIC_DRAW);
  return buffer2;
}
function groundArrayOf(gl, field) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, field.ground.vertices, gl.STATIC_DRAW);
  for (let i = 0; i < 4; ++i) gl.enableVertexAttribArray(i);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, groundVertexBytes, 0);
  gl.vertexAttribIPointer(1, 1, gl.UNSIGNED_INT, groundVertexBytes, 12);
  gl.vertexAttribPointer(2, 2, gl.FLOAT, false, groundVertexBytes, 16);
  gl.vertexAttribPointer(3, 4, gl.UNSIGNED_BYTE, true, groundVertexBytes, 24);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, field.ground.indices, gl.STATIC_DRAW);
  gl.bindVertexArray(null);
  return array;
}

// src/render/renderer.ts
var captured = ["recordV0", "recordV1", "recordV2", "recordSurface", "recordFrame", "recordBend"];
var recordBytes = 16 * captured.length;
var usualMax = 4e5;
var Renderer = class {
  /** `cover`: what `sward export` wrote into field.cover; without it blades do not shade one another. */
  constructor(canvas, field, cover = noCover, sowing, host) {
    this.canvas = canvas;
    this.field = field;
    this.sowing = sowing;
    const options = { antialias: false, alpha: false, depth: false, powerPreference: "high-performance" };
    const gl = host ?? canvas.getContext("webgl2", options);
    if (!gl) fail("unsupported", "this browser has no WebGL 2, or its graphics driver is blocked");
    this.gl = gl;
    this.tree = new PatchTree(field, sowing);
    this.scene = sceneOf(field, sowing ? sownCover(cover, sowing.areaPerStored) : cover, sowing?.patches);
    this.restore();
  }
  canvas;
  field;
  sowing;
  kind = "webgl";
  scene;
  gl;
  tree;
  parts;
  lodThreshold = frameSettings.lodThreshold;
  /** Makes all that lies on the device, first or after the device was lost. */
  restore() {
    this.parts = new Parts(this.gl, this.field, this.scene, this.sowing);
    this.sowing?.forget();
  }
  /** The sun as the viewer has it by default. */
  get usualLight() {
    const up = unit(scaled(this.field.defaults.gravity.direction, -1));
    return { ...usualLight, sunDirection: turnedWith(up, usualLight.sunDirection) };
  }
  /** Draws a picture as large as the canvas. */
  draw(input) {
    const { canvas, field, scene } = this;
    const view = viewOf(input.camera, field.origin, canvas.width, canvas.height, scene.content);
    const { groups, stats } = this.prepare(input, view);
    this.parts.draw(groups, canvas.width, canvas.height, input.isFine ?? false);
    return stats;
  }
  /** Waits until all is sown that a camera wants, of a field with seeds. */
  async sowFor(input) {
    const { canvas, field, scene, sowing } = this;
    const view = viewOf(input.camera, field.origin, canvas.width, canvas.height, scene.content);
    while (sowing) {
      this.choose(input, view);
      if (sowing.isSettled) return;
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
  }
  /** Draws into a framebuffer of a host, whose depth hides grass and is hidden by it. */
  drawInHost(input) {
    const { gl } = this;
    const width = input.width ?? gl.drawingBufferWidth;
    const height = input.height ?? gl.drawingBufferHeight;
    const { view, camera, light } = hostView(input, height, this.usualLight);
    const before = enterHost(gl);
    const { groups, stats } = this.prepare({ ...input, camera, light }, view);
    gl.bindFramebuffer(gl.FRAMEBUFFER, input.framebuffer ?? null);
    gl.viewport(0, 0, width, height);
    this.parts.drawInHost(groups, input.isLinear ?? false, input.ground ?? false);
    leaveHost(gl, before);
    return stats;
  }
  /** Chooses the groups of blades of a view, and brings what has come onto the device. */
  choose(input, view) {
    const { field, scene, sowing } = this;
    const frame = {
      view,
      camera: input.camera,
      light: input.light ?? this.usualLight,
      wind: input.wind ?? 1,
      time: input.time,
      shadowDistance,
      lodThreshold: this.lodThreshold,
      sparseFrom: 0,
      sparseLeast: field.seeds?.meadow.stored ?? 0
    };
    const treeView = {
      eye: view.eye,
      planes: view.planes,
      drawDistance: field.defaults.drawDistance,
      pixelsPerUnit: view.pixelsPerUnit,
      lodThreshold: this.lodThreshold,
      lodWidth: scene.bladeWidth,
      minWidth: minWidthOf(view),
      sparseFrom: 0,
      sparseLeast: frame.sparseLeast
    };
    const find = () => {
      frame.sparseFrom = treeView.sparseFrom = sowing ? this.sparseFrom(view) : 0;
      treeView.lodThreshold = frame.lodThreshold = this.lodThreshold * (sowing?.thinning ?? 1);
      return this.tree.groupsOf(treeView, Infinity);
    };
    if (sowing) sowing.update({ ...treeView, lodThreshold: this.lodThreshold, sparseFrom: this.sparseFrom(view) });
    this.parts.uploadPages();
    const most = input.maxBlades ?? usualMax;
    let groups = find();
    const usual = frameSettings.lodThreshold;
    for (let i = 0; i < 12; ++i) {
      const ratio = Math.sqrt(groups.blades / most);
      if (ratio > 1.15) this.lodThreshold *= Math.min(ratio, 2);
      else if (ratio < 0.7 && this.lodThreshold > usual)
        this.lodThreshold = Math.max(this.lodThreshold * Math.max(1.2 * ratio, 0.5), usual);
      else break;
      groups = find();
    }
    if (groups.blades > most) this.lodThreshold *= 1.02;
    else if (groups.blades < 0.8 * most) this.lodThreshold = Math.max(this.lodThreshold / 1.02, usual);
    return { frame, treeView, groups };
  }
  /** Chooses, moves and poses blades, and draws the maps of shadows. */
  prepare(input, view) {
    const { frame, treeView, groups } = this.choose(input, view);
    const rows = shadowRows(view, input.camera, frame.light.sunDirection, frame.shadowDistance);
    const casters = frame.light.sunColor[0] > 0 ? this.tree.groupsOf({ ...treeView, planes: shadowPlanes(rows), minWidth: 0 }, input.maxBlades ?? usualMax, shadowClass) : void 0;
    this.parts.prepare(frame, groups, casters, shadowPlanes(rows), input.elapsed);
    return { groups, stats: { blades: groups.blades, missing: groups.missing } };
  }
  /** Distance beyond which a sown field is drawn sparsely: frameOf() of src/render/frame/frame.cpp. */
  sparseFrom(view) {
    const { low, high } = this.scene.content;
    const gap = [0, 1, 2].map((i) => Math.max(low[i] - view.eye[i], view.eye[i] - high[i], 0));
    const full = this.scene.bladeWidth * view.pixelsPerUnit / this.lodThreshold;
    return this.sowing.sparseDistance(low, high, full, size(gap));
  }
  /** Records of the blades that the last draw() posed; 24 words each. For tests. */
  readRecords() {
    return this.parts.readRecords();
  }
  get isLost() {
    return this.gl.isContextLost();
  }
};
var shadowDistance = 8;
var Parts = class {
  constructor(gl, field, scene, sowing) {
    this.gl = gl;
    this.field = field;
    this.scene = scene;
    this.sowing = sowing;
    const programs = {
      move: new Program(gl, "move", moveVert, moveFrag),
      pose: new Program(gl, "pose", poseVert, nothingFrag, captured),
      blade: new Program(gl, "blade", bladeVert, bladeFrag),
      ground: new Program(gl, "ground", groundVert, groundFrag),
      sky: new Program(gl, "sky", skyVert, skyFrag),
      film: new Program(gl, "film", filmVert, filmFrag),
      sun: new Program(gl, "sun", sunVert, nothingFrag),
      bladeShadow: new Program(gl, "blade shadow", bladeShadowVert, bladeShadowFrag)
    };
    this.move = programs.move.finish();
    this.pose = programs.pose.finish();
    this.blade = programs.blade.finish();
    this.ground = programs.ground.finish();
    this.sky = programs.sky.finish();
    this.film = programs.film.finish();
    this.sun = programs.sun.finish();
    this.bladeShadow = programs.bladeShadow.finish();
    this.uploaded = new Uint8Array(field.pageCount);
    this.sownRow = (sowing?.firstBlade ?? 0) / tableWidth;
    this.stateRows = sowing ? this.sownRow + sowing.pageCount : Math.max(Math.ceil(field.bladeCount / tableWidth), 1);
    const most = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    if (this.stateRows > most)
      fail("unsupported", `${field.name}: ${this.stateRows * tableWidth} blades, more than ${most * tableWidth} on this device`);
    this.blades = makeTexture(gl, gl.RGBA32UI, tableWidth, this.stateRows);
    this.states = [0, 1].map(() => makeTexture(gl, gl.R32UI, tableWidth, this.stateRows));
    this.stateTargets = this.states.map((states) => {
      const target = makeTarget(gl, states);
      gl.clearBufferuiv(gl.COLOR, 0, [unsettledTurn, 0, 0, 0]);
      return target;
    });
    this.patches = patchTable(gl, sowing?.patches ?? field.patches);
    this.cover = wordTable(gl, scene.cover.corners);
    this.sunMap = makeTexture(gl, gl.DEPTH_COMPONENT24, sunMapSize, sunMapSize);
    this.sunTarget = makeTarget(gl, null, this.sunMap);
    this.shadowMap = makeTexture(gl, gl.RG32UI, bladeShadowTexels, bladeShadowTexels);
    const shadowDepth = makeTexture(gl, gl.DEPTH_COMPONENT24, bladeShadowTexels, bladeShadowTexels);
    this.shadowTarget = makeTarget(gl, this.shadowMap, shadowDepth);
    this.frame = gl.createBuffer();
    this.looks = gl.createBuffer();
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.looks);
    gl.bufferData(gl.UNIFORM_BUFFER, looksBlock(field).bytes, gl.STATIC_DRAW);
    this.groupBuffer = gl.createBuffer();
    this.groupArray = gl.createVertexArray();
    this.records = gl.createBuffer();
    this.feedback = gl.createTransformFeedback();
    this.ribbonArray = gl.createVertexArray();
    this.indices = classes.map(({ segments, columns }) => ribbonIndices(gl, segments, columns));
    this.nothing = gl.createVertexArray();
    this.groundArray = groundArrayOf(gl, field);
    const white = imageTexture(gl);
    const images = field.ground.images.map((image) => imageTexture(gl, image));
    this.groundParts = field.ground.ranges.filter((range) => range.level === 0 && range.indexCount > 0).map((range) => {
      const material = field.ground.materials[range.material];
      return {
        first: range.firstIndex,
        count: range.indexCount,
        color: material.baseColor.slice(0, 3),
        isDoubleSided: material.isDoubleSided,
        image: images[material.image] ?? white
      };
    });
    gl.bindVertexArray(null);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
  }
  gl;
  field;
  scene;
  sowing;
  move;
  pose;
  blade;
  ground;
  sky;
  film;
  sun;
  bladeShadow;
  blades;
  states;
  stateTargets;
  stateRows;
  patches;
  cover;
  sunMap;
  sunTarget;
  shadowMap;
  shadowTarget;
  frame;
  looks;
  groupBuffer;
  groupArray;
  records;
  feedback;
  ribbonArray;
  indices;
  groundArray;
  groundParts;
  nothing;
  uploaded;
  /** First row of blades, and of patches, that are sown. */
  sownRow;
  picture;
  hostPrograms;
  recordRoom = 0;
  recordCount = 0;
  newest = 0;
  sunOf = "";
  /** Copies the pages that have come to the device. */
  uploadPages() {
    const { gl, field } = this;
    if (this.sowing) this.uploadSown(this.sowing);
    if (field.presentPages === 0) return;
    const words = pageBlades * bladeWords;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.blades);
    for (let page = 0; page < field.pageCount; ++page) {
      if (this.uploaded[page] || !field.has(page * pageBlades, 1)) continue;
      let end = page + 1;
      if (page % 2 === 0)
        while (end < field.pageCount && !this.uploaded[end] && field.has(end * pageBlades, 1)) ++end;
      let data = field.packed.subarray(page * words, end * words);
      const width = end - page > 1 ? tableWidth : pageBlades;
      const rows = Math.ceil((end - page) / 2);
      if (data.length < width * rows * bladeWords) {
        const padded = new Uint32Array(width * rows * bladeWords);
        padded.set(data);
        data = padded;
      }
      const x = page % 2 * pageBlades;
      gl.texSubImage2D(gl.TEXTURE_2D, 0, x, page >> 1, width, rows, gl.RGBA_INTEGER, gl.UNSIGNED_INT, data);
      this.uploaded.fill(1, page, end);
    }
  }
  /** The same for what is sown: a row of blades, unsettled, and a quarter of a row of patches each. */
  uploadSown(sowing) {
    const { gl } = this;
    const unsettled = new Uint32Array(tableWidth).fill(unsettledTurn);
    gl.activeTexture(gl.TEXTURE0);
    for (const { page, blades } of sowing.changed) {
      const row = this.sownRow + page;
      gl.bindTexture(gl.TEXTURE_2D, this.blades);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, tableWidth, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, blades);
      for (const states of this.states) {
        gl.bindTexture(gl.TEXTURE_2D, states);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, tableWidth, 1, gl.RED_INTEGER, gl.UNSIGNED_INT, unsettled);
      }
      const first = sowing.firstPatch + sownPagePatches * page;
      const texels = patchTexelsOf(sowing.patches, first, first + sownPagePatches);
      gl.bindTexture(gl.TEXTURE_2D, this.patches);
      const [x, y] = [patchTexels * (first % patchesOfRow), Math.floor(first / patchesOfRow)];
      gl.texSubImage2D(gl.TEXTURE_2D, 0, x, y, patchTexels * sownPagePatches, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, texels);
    }
    sowing.changed = [];
  }
  /** Moves and poses the blades, and draws the maps of shadows. */
  prepare(input, groups, casters, sunPlanes, elapsed) {
    const { gl } = this;
    const block = frameBlock(this.scene, input);
    this.setFrame(block);
    bindTexture(gl, "bladeTexture", this.blades);
    bindTexture(gl, "patchTexture", this.patches);
    bindTexture(gl, "coverTexture", this.cover);
    bindTexture(gl, "sunTexture", this.sunMap);
    bindTexture(gl, "bladeShadowTexture", this.shadowMap);
    gl.disable(gl.BLEND);
    this.drawSunMap(input.light.sunDirection);
    this.setGroups(groups);
    this.moveBlades(groups, elapsed);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
    gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
    if (casters) {
      const bySun = frameBlock(this.scene, input);
      sunPlanes.forEach((plane, i) => bySun.floats(`view.planes[${i}]`, plane));
      bySun.floats("view.minWidth", [0]);
      bySun.floats("fixedTessellation", [bladeShadowSegments]);
      bySun.words("view.cullMask", [cullDistance | cullFrustum | leaveThinned]);
      this.setFrame(bySun);
      this.setGroups(casters);
      this.poseBlades(casters);
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
      gl.viewport(0, 0, bladeShadowTexels, bladeShadowTexels);
      gl.clearBufferfv(gl.DEPTH, 0, [1]);
      this.drawRibbons(this.bladeShadow, casters);
      this.setFrame(block);
      this.setGroups(groups);
    }
    this.poseBlades(groups);
  }
  /** Draws a picture of what is prepared onto the canvas. */
  draw(groups, width, height, isFine) {
    const { gl } = this;
    let picture = this.picture;
    if (!picture || picture.width !== width || picture.height !== height || picture.isFine !== isFine) {
      picture?.delete();
      picture = this.picture = new Picture(gl, width, height, isFine);
    }
    picture.resolved.forEach((_, sample) => {
      const place = isFine ? samplePlaces[sample] : [0.5, 0.5];
      const jitter = [(2 * place[0] - 1) / width, (2 * place[1] - 1) / height];
      const offset = [place[0] - 0.5, place[1] - 0.5];
      picture.begin();
      this.blade.use();
      gl.uniform2fv(this.blade.place("jitter"), jitter);
      gl.uniform2fv(this.blade.place("sampleOffset"), offset);
      gl.uniform1ui(this.blade.place("samples"), picture.resolved.length);
      gl.uniform1ui(this.blade.place("sampleOfPixel"), sample);
      this.drawRibbons(this.blade, groups);
      this.ground.use();
      gl.uniform2fv(this.ground.place("jitter"), jitter);
      gl.uniform2fv(this.ground.place("sampleOffset"), offset);
      this.drawGround(this.ground);
      this.sky.use();
      gl.bindVertexArray(this.nothing);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      picture.end(sample);
    });
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.disable(gl.DEPTH_TEST);
    for (const [i, unit2] of ["resolved", "resolved1", "resolved2", "resolved3"].entries())
      bindTexture(gl, unit2, picture.resolved[i] ?? picture.resolved[0]);
    this.film.use();
    gl.uniform1i(this.film.place("hasSamples"), isFine ? 1 : 0);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.DEPTH_TEST);
    gl.bindVertexArray(null);
  }
  /** Draws what is prepared into the framebuffer that is bound, with its depth. */
  drawInHost(groups, isLinear, hasGround) {
    const { gl } = this;
    const { blade, ground } = this.hostPrograms ??= {
      blade: new Program(gl, "blade of a host", bladeVert, hostBladeFrag).finish(),
      ground: new Program(gl, "ground of a host", groundVert, hostGroundFrag).finish()
    };
    blade.use();
    gl.uniform2f(blade.place("jitter"), 0, 0);
    gl.uniform1ui(blade.place("samples"), 1);
    gl.uniform1ui(blade.place("sampleOfPixel"), 0);
    gl.uniform1i(blade.place("isLinear"), isLinear ? 1 : 0);
    this.drawRibbons(blade, groups);
    if (!hasGround) return;
    ground.use();
    gl.uniform2f(ground.place("jitter"), 0, 0);
    gl.uniform1i(ground.place("isLinear"), isLinear ? 1 : 0);
    this.drawGround(ground);
  }
  readRecords() {
    const { gl } = this;
    const words = new Uint32Array(recordBytes / 4 * this.recordCount);
    gl.bindBuffer(gl.COPY_READ_BUFFER, this.records);
    gl.getBufferSubData(gl.COPY_READ_BUFFER, 0, words);
    gl.bindBuffer(gl.COPY_READ_BUFFER, null);
    return words;
  }
  setFrame(block) {
    const { gl } = this;
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.frame);
    gl.bufferData(gl.UNIFORM_BUFFER, block.bytes, gl.DYNAMIC_DRAW);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, firstBlock, this.frame);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, firstBlock + 1, this.looks);
  }
  /** The ground as the sun sees it, when the sun has moved. */
  drawSunMap(sun) {
    const { gl } = this;
    if (this.sunOf === sun.join()) return;
    this.sunOf = sun.join();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.sunTarget);
    gl.viewport(0, 0, sunMapSize, sunMapSize);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.sun.use();
    gl.bindVertexArray(this.groundArray);
    for (const part of this.groundParts) gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 4 * part.first);
  }
  setGroups(groups) {
    const { gl } = this;
    gl.bindVertexArray(this.groupArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.groupBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, groups.words, gl.DYNAMIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribDivisor(0, 1);
  }
  /** Draws a point for each blade of the groups of some classes. */
  drawGroups(begin, end) {
    const { gl } = this;
    gl.vertexAttribIPointer(0, 3, gl.UNSIGNED_INT, 12, 12 * begin);
    gl.drawArraysInstanced(gl.POINTS, 0, groupBlades, end - begin);
  }
  moveBlades(groups, elapsed) {
    const { gl } = this;
    const all = groups.begins[classes.length];
    if (all === 0) return;
    bindTexture(gl, "stateTexture", this.states[this.newest]);
    this.newest = 1 - this.newest;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.stateTargets[this.newest]);
    gl.viewport(0, 0, tableWidth, this.stateRows);
    gl.disable(gl.DEPTH_TEST);
    this.move.use();
    gl.uniform1f(this.move.place("elapsed"), elapsed);
    gl.uniform1f(this.move.place("stateRows"), this.stateRows);
    gl.bindVertexArray(this.groupArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.groupBuffer);
    this.drawGroups(0, all);
    gl.enable(gl.DEPTH_TEST);
  }
  poseBlades(groups) {
    const { gl } = this;
    const all = groups.begins[classes.length];
    this.recordCount = all * groupBlades;
    if (all === 0) return;
    if (this.recordRoom < this.recordCount) {
      this.recordRoom = Math.ceil(1.25 * all) * groupBlades;
      gl.bindBuffer(gl.COPY_WRITE_BUFFER, this.records);
      gl.bufferData(gl.COPY_WRITE_BUFFER, this.recordRoom * recordBytes, gl.DYNAMIC_COPY);
      gl.bindBuffer(gl.COPY_WRITE_BUFFER, null);
    }
    bindTexture(gl, "stateTexture", this.states[this.newest]);
    this.pose.use();
    gl.bindVertexArray(this.groupArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.groupBuffer);
    gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, this.feedback);
    gl.enable(gl.RASTERIZER_DISCARD);
    classes.forEach(({ segments }, i) => {
      const [begin, end] = [groups.begins[i], groups.begins[i + 1]];
      if (begin === end) return;
      const step = recordBytes * groupBlades;
      gl.bindBufferRange(gl.TRANSFORM_FEEDBACK_BUFFER, 0, this.records, begin * step, (end - begin) * step);
      gl.uniform1f(this.pose.place("maxSegments"), segments);
      gl.beginTransformFeedback(gl.POINTS);
      this.drawGroups(begin, end);
      gl.endTransformFeedback();
    });
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
    gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, null);
    gl.disable(gl.RASTERIZER_DISCARD);
  }
  drawRibbons(program, groups) {
    const { gl } = this;
    program.use();
    gl.bindVertexArray(this.ribbonArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.records);
    classes.forEach(({ segments, columns }, i) => {
      const [begin, end] = [groups.begins[i], groups.begins[i + 1]];
      if (begin === end) return;
      for (let attribute = 0; attribute < captured.length; ++attribute) {
        gl.enableVertexAttribArray(attribute);
        gl.vertexAttribDivisor(attribute, 1);
        const at = begin * groupBlades * recordBytes + 16 * attribute;
        gl.vertexAttribIPointer(attribute, 4, gl.UNSIGNED_INT, recordBytes, at);
      }
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indices[i]);
      gl.uniform1ui(program.place("columns"), columns);
      const count = 6 * segments * (columns - 1);
      gl.drawElementsInstanced(gl.TRIANGLES, count, gl.UNSIGNED_SHORT, 0, (end - begin) * groupBlades);
    });
  }
  drawGround(program) {
    const { gl } = this;
    gl.bindVertexArray(this.groundArray);
    for (const part of this.groundParts) {
      bindTexture(gl, "baseColor", part.image);
      gl.uniform3fv(program.place("materialColor"), part.color);
      gl.uniform1i(program.place("isDoubleSided"), part.isDoubleSided ? 1 : 0);
      if (part.isDoubleSided) gl.disable(gl.CULL_FACE);
      else gl.enable(gl.CULL_FACE);
      gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 4 * part.first);
    }
    gl.disable(gl.CULL_FACE);
  }
};

// src/render/webgpu/device.ts
var atomic64 = "atomic-vec2u-min-max";
async function openDevice({
  gpu = globalThis.navigator?.gpu,
  acceptsSoftware = false,
  only32 = false
} = {}) {
  const adapter = await gpu?.requestAdapter({ powerPreference: "high-performance" }).catch(() => null);
  if (!adapter || adapter.info?.isFallbackAdapter && !acceptsSoftware) return void 0;
  const { maxBufferSize, maxStorageBufferBindingSize } = adapter.limits;
  const features = [...only32 ? [] : [atomic64], "timestamp-query"].filter((one) => adapter.features.has(one));
  return adapter.requestDevice({ requiredFeatures: features, requiredLimits: { maxBufferSize, maxStorageBufferBindingSize } }).catch(() => void 0);
}
var hasAtomic64 = (device) => device.features.has(atomic64);
function overridesOf(field) {
  const looks = field.species.flatMap((one) => [one, ...one.organs]);
  const shapes = new Set(looks.map((one) => one.shape));
  return {
    mayFold: looks.some((one) => one.fold > 0) ? 1 : 0,
    mayHaveOrgans: field.species.some((one) => one.organs.length > 0) ? 1 : 0,
    onlyShape: shapes.size === 1 ? looks[0].shape : shapeCount
  };
}

// src/generated/wgsl.ts
var pieces2 = [
  "const octahedralMaxError : f32 = 0.0112;",
  "struct Patch {\n boundsLow : vec3f,\n firstBlade : u32,\n boundsHigh : vec3f,\n bladeCount : u32,\n rootLow : vec3f,\n rootStep : f32,\n coneAxis : vec3f,\n coneCosine : f32,\n heightLow : f32,\n heightStep : f32,\n widthLow : f32,\n widthStep : f32,\n parent : u32,\n firstChild : u32,\n childCount : u32,\n level : u32,\n rankLow : f32,\n rankHigh : f32,\n}",
  "struct BladeShadow {\n @align(16) across : vec4f,\n down : vec4f,\n depth : vec4f,\n size : u32,\n nearer : f32,\n}",
  "struct Cover {\n @align(16) low : vec3f,\n cellsPerMetre : f32,\n countX : u32,\n countY : u32,\n countZ : u32,\n farthest : f32,\n undergrowth : vec3f,\n thatch : f32,\n sward : vec3f,\n thinned : f32,\n structure : f32,\n stepsPerMetre : f32,\n leaves : array<vec4u, 8>,\n}",
  "const leafExtinction : f32 = 0.46;",
  "const cullPatch : u32 = 1u;",
  "const cullDistance : u32 = 8u;",
  "const leaveThinned : u32 = 32u;",
  "fn planeDistance(plane : vec4f, point : vec3f) -> f32 {\n return dot(vec3f(plane.x, plane.y, plane.z), point) + plane.w;\n}",
  "fn boxOutside(plane : vec4f, low : vec3f, high : vec3f) -> bool {\n let farthest = vec3f(select(low.x, high.x, plane.x >= 0.0), select(low.y, high.y, plane.y >= 0.0), select(low.z, high.z, plane.z >= 0.0));\n return planeDistance(plane, farthest) < 0.0;\n}",
  "fn boxDistance(eye : vec3f, low : vec3f, high : vec3f) -> f32 {\n return length(max(max(low - eye, eye - high), vec3f(0.0)));\n}",
  "const lodFullShare : f32 = 1.0 / 0.9;",
  "fn lodShare(pixels : f32, threshold : f32) -> f32 {\n return clamp(pixels / threshold, 1.0 / 256.0, lodFullShare);\n}",
  "const flattestRay : f32 = 1.0 / 96.0;",
  "const maxLeafArea : f32 = 64.0;",
  "fn leafAreaShare(most : f32, leafArea : f32, cosine : f32, pixels : f32) -> f32 {\n let wide = max(pixels * pixels, 1.0);\n return clamp(most * wide * wide * max(cosine, flattestRay) / (leafExtinction * max(leafArea, 1e-6)), 1.0 / 256.0, lodFullShare);\n}",
  "const maxHeightCompensation : f32 = 1.3;",
  "fn heightCompensation(share : f32, one : f32, spread : f32) -> f32 {\n if (share >= 1.0) {\n  return 1.0;\n }\n let full = min(one, 1.0);\n let sunk = pow(full / share, 1.0 / 3.0) - pow(full, 1.0 / 3.0);\n let rise = clamp(1.0 + (0.4 + 0.2 * spread) * sunk, 1.0, maxHeightCompensation);\n return floor(rise * 1024.0 + 0.5) / 1024.0;\n}",
  "fn leafAreaLight(share : f32, spread : f32) -> f32 {\n return select(pow(share, 1.0 / (1.0 + 0.8 * spread)), 1.0, share >= 1.0);\n}",
  "struct WindSource {\n @align(16) direction : vec3f,\n strength : f32,\n centre : vec3f,\n size : f32,\n speed : f32,\n rate : f32,\n turn : f32,\n alignment : f32,\n lift : f32,\n kind : u32,\n side : vec3f,\n perSize : f32,\n}",
  "struct WindPhase {\n @align(16) shift : vec3f,\n cell : u32,\n fineShift : vec3f,\n fineCell : u32,\n angle : f32,\n turned : f32,\n}",
  "struct WindLattice {\n @align(16) origin : vec3f,\n x : vec3f,\n y : vec3f,\n z : vec3f,\n}",
  "struct Wind {\n @align(16) counts : u32,\n eddySize : f32,\n eddySpeed : f32,\n sum : f32,\n eddyPhase : vec3f,\n lattice : WindLattice,\n sources : array<WindSource, 8>,\n phases : array<WindPhase, 8>,\n}",
  "struct Gravity {\n @align(16) direction : vec3f,\n strength : f32,\n attractor : vec3f,\n blend : f32,\n forward : f32,\n}",
  "struct Environment {\n @align(16) gravity : Gravity,\n recovery : f32,\n colliderCount : u32,\n wind : Wind,\n}",
  "struct Eyepoint {\n @align(16) planes : array<vec4f, 6>,\n eye : vec3f,\n drawDistance : f32,\n pixelsPerUnit : f32,\n lodThreshold : f32,\n lodWidth : f32,\n minWidth : f32,\n maxLeafArea : f32,\n maxEdgeOn : f32,\n samples : u32,\n buckets : f32,\n bucketDistance : f32,\n cullMask : u32,\n areaFactor : f32,\n sparseFrom : f32,\n sparseLeast : f32,\n}",
  "struct FloorPlane {\n @align(16) middle : vec3f,\n reach : f32,\n along : vec3f,\n height : f32,\n halfSides : vec2f,\n cornerRadius : f32,\n}",
  "const pyramidFactorBits : u32 = 2u;",
  "fn pyramidCells(pixels : u32, level : u32) -> u32 {\n let bits = pyramidFactorBits * (level + 1u);\n return max((pixels + (1u << bits) - 1u) >> bits, 1u);\n}",
  "struct ScreenBox {\n low : vec2i,\n high : vec2i,\n nearest : f32,\n isKnown : bool,\n}",
  "fn screenBoxOf(viewProjection : mat4x4f, size : vec2u, low : vec3f, high : vec3f) -> ScreenBox {\n var box : ScreenBox;\n var lowest = vec2f(1e30);\n var highest = vec2f(-1e30);\n box.nearest = 0.0;\n box.isKnown = true;\n for (var i = 0u; i < 8u; i++) {\n  let corner = vec4f(select(low.x, high.x, (i & 1u) != 0u), select(low.y, high.y, (i & 2u) != 0u), select(low.z, high.z, (i & 4u) != 0u), 1.0);\n  let clip = viewProjection * corner;\n  if (!(clip.w > 0.0) || clip.z > clip.w) {\n   box.isKnown = false;\n   box.low = vec2i(0);\n   box.high = vec2i(0);\n   return box;\n  }\n  let place = vec2f(clip.x, clip.y) / clip.w;\n  lowest = min(lowest, place);\n  highest = max(highest, place);\n  box.nearest = max(box.nearest, clip.z / clip.w);\n }\n let pixels = vec2f(f32(size.x), f32(size.y));\n let last = pixels - vec2f(1.0);\n lowest = clamp(floor((lowest * 0.5 + vec2f(0.5)) * pixels) - vec2f(1.0), vec2f(0.0), last);\n highest = clamp(floor((highest * 0.5 + vec2f(0.5)) * pixels) + vec2f(1.0), vec2f(0.0), last);\n box.low = vec2i(i32(lowest.x), i32(lowest.y));\n box.high = vec2i(i32(highest.x), i32(highest.y));\n return box;\n}",
  "const pyramidReach : i32 = 4;",
  "fn pyramidLevelFor(box : ScreenBox, levels : u32) -> u32 {\n let extent = max(box.high.x - box.low.x, box.high.y - box.low.y);\n let level = u32(max(i32(firstLeadingBit(extent)) - 2, 0)) / pyramidFactorBits;\n let bits = pyramidFactorBits * (level + 1u);\n let fits = (box.high.x >> bits) - (box.low.x >> bits) < pyramidReach && (box.high.y >> bits) - (box.low.y >> bits) < pyramidReach;\n return min(select(level + 1u, level, fits), levels - 1u);\n}",
  "const outlineMost : f32 = 1.35;",
  "struct LevelSteps {\n @align(16) distance_ : vec4f,\n segments : vec4f,\n count : u32,\n}",
  "struct SunShadow {\n @align(16) across : vec4f,\n down : vec4f,\n depth : vec4f,\n size : u32,\n texel : f32,\n epsilon : f32,\n reserved : u32,\n}",
  "struct UpdateRate {\n @align(16) everyFrame : f32,\n everyThird : f32,\n longest : f32,\n frame : u32,\n}",
  "struct Frame {\n @align(16) viewProjection : mat4x4f,\n rays : array<vec3f, 3>,\n depthOfEye : f32,\n view : Eyepoint,\n environment : Environment,\n patchCount : u32,\n bladeCount : u32,\n visibleCapacity : u32,\n maxTessellation : u32,\n sunDirection : vec3f,\n exposure : f32,\n sunColor : vec3f,\n debugMode : u32,\n skyColor : vec3f,\n fogDensity : f32,\n groundColor : vec3f,\n skyUp : vec3f,\n fixedTessellation : f32,\n clouds : f32,\n levelSteps : LevelSteps,\n updateRate : UpdateRate,\n cover : Cover,\n shadow : SunShadow,\n bladeShadow : BladeShadow,\n fogFalloff : f32,\n lowSun : f32,\n tick : u32,\n floorPlane : FloorPlane,\n reserved : array<vec4u, 36>,\n}",
  "@group(0) @binding(0) var<uniform> frameConstants_ : Frame;",
  "struct Pyramid {\n @align(16) size : vec2u,\n first : array<vec4u, 7>,\n levels : u32,\n}",
  "struct Push {\n @align(16) pyramid : Pyramid,\n size : vec2u,\n patchCount : u32,\n tick : u32,\n isIdPass : u32,\n firstBlade : u32,\n capacity : u32,\n}",
  "@group(0) @binding(2) var<uniform> push_ : Push;",
  "@group(0) @binding(5) var<storage, read> patches_ : array<Patch>;",
  "@group(0) @binding(10) var<storage, read_write> visiblePatches_ : array<VisiblePatch>;",
  "@group(0) @binding(12) var<storage, read_write> counters_ : array<atomic<u32>>;",
  "const countPatches : u32 = 0u;",
  "const groupsOfRow : u32 = 4096u;",
  "struct VisiblePatch {\n patchIndex : u32,\n count : u32,\n}",
  "const pageBlades : u32 = 1024u;",
  "fn sectionMargin(distance_ : f32, minWidth : f32) -> f32 {\n return minWidth * distance_;\n}",
  "fn sparseShare(view : Eyepoint, share : f32, distance_ : f32) -> f32 {\n if (view.sparseFrom <= 0.0 || distance_ <= view.sparseFrom) {\n  return 1.0;\n }\n let nearness = view.sparseFrom / distance_;\n return max(nearness * nearness * nearness, min(view.sparseLeast / share, 1.0));\n}",
  "fn leavesPerDrawn(view : Eyepoint, distance_ : f32) -> f32 {\n if (view.sparseFrom <= 0.0 || distance_ <= view.sparseFrom || view.lodThreshold <= 0.0) {\n  return 1.0;\n }\n let share = lodShare(view.lodWidth * view.pixelsPerUnit / max(distance_, 1e-6), view.lodThreshold);\n return 1.0 / sqrt(sparseShare(view, share, distance_));\n}",
  "fn shareAt(view : Eyepoint, distance_ : f32) -> f32 {\n if (view.lodThreshold <= 0.0) {\n  return lodFullShare;\n }\n let share = lodShare(view.lodWidth * view.pixelsPerUnit / max(distance_, 1e-6), view.lodThreshold);\n return share * sparseShare(view, share, distance_);\n}",
  "fn middleWidth(cell : Patch) -> f32 {\n return cell.widthLow + 31.5 * cell.widthStep;\n}",
  "fn leafAreaAround(cell : Patch) -> f32 {\n let fewest = 4u;\n if (cell.bladeCount < fewest) {\n  return 0.0;\n }\n let count = f32(cell.bladeCount);\n let side = 65535.0 * cell.rootStep * (count + 1.0) / (count - 1.0);\n let around = count / max(cell.rankHigh - cell.rankLow, 1e-6);\n let height = cell.heightLow + 127.5 * cell.heightStep;\n return min(0.7 * around * middleWidth(cell) * height / max(side * side, 1e-12), maxLeafArea);\n}",
  "fn steepestRay(eye : vec3f, cell : Patch) -> f32 {\n let low = cell.boundsLow - eye;\n let high = cell.boundsHigh - eye;\n let middle = 0.5 * (low + high);\n let above = abs(dot(cell.coneAxis, middle)) + dot(abs(cell.coneAxis), 0.5 * (high - low));\n let nearest = max(boxDistance(eye, cell.boundsLow, cell.boundsHigh), 1e-6);\n let slope = sqrt(max(1.0 - cell.coneCosine * cell.coneCosine, 0.0));\n return min(above / nearest + max(slope - octahedralMaxError, 0.0), 1.0);\n}",
  "struct LeafAreaLimit {\n share : f32,\n height : f32,\n light : f32,\n}",
  "fn noLeafAreaLimit() -> LeafAreaLimit {\n var limit : LeafAreaLimit;\n limit.share = lodFullShare;\n limit.height = 1.0;\n limit.light = 1.0;\n return limit;\n}",
  "fn leafAreaLimitOf(view : Eyepoint, cell : Patch) -> LeafAreaLimit {\n var limit = noLeafAreaLimit();\n if (view.maxLeafArea <= 0.0) {\n  return limit;\n }\n let nearest = max(boxDistance(view.eye, cell.boundsLow, cell.boundsHigh), 1e-6);\n let pixels = middleWidth(cell) * view.pixelsPerUnit / nearest;\n if (leafAreaShare(view.maxLeafArea, maxLeafArea, 0.0, pixels) >= lodFullShare) {\n  return limit;\n }\n let leafArea = min(view.areaFactor * leafAreaAround(cell), maxLeafArea);\n let cosine = steepestRay(view.eye, cell);\n limit.share = leafAreaShare(view.maxLeafArea, leafArea, cosine, pixels);\n let range = 255.0 * cell.heightStep;\n let spread = min(2.0 * range / max(cell.heightLow + range, 1e-6), 1.0);\n limit.height = heightCompensation(limit.share, leafAreaShare(1.0, leafArea, cosine, 1.0), spread);\n limit.light = leafAreaLight(limit.share, spread);\n return limit;\n}",
  "fn patchMargin(view : Eyepoint, cell : Patch, widest : f32) -> f32 {\n let farthest = max(abs(cell.boundsLow - view.eye), abs(cell.boundsHigh - view.eye));\n let share = shareAt(view, length(farthest));\n let size = cell.boundsHigh - cell.boundsLow;\n let highest = 0.5 * min(size.x, min(size.y, size.z));\n return 0.5 * outlineMost * widest / (0.95 * share * leavesPerDrawn(view, length(farthest))) + sectionMargin(length(farthest), view.minWidth) + select(0.0, (maxHeightCompensation - 1.0) * highest, view.maxLeafArea > 0.0);\n}",
  "fn thickEnough(view : Eyepoint, cell : Patch) -> u32 {\n if ((view.cullMask & leaveThinned) == 0u || view.lodThreshold <= 0.0) {\n  return cell.bladeCount;\n }\n let thinned = shareAt(view, boxDistance(view.eye, cell.boundsLow, cell.boundsHigh));\n let share = min(thinned, min(thinned, 1.0) * leafAreaLimitOf(view, cell).share);\n if (share <= cell.rankLow) {\n  return 0u;\n }\n if (share >= cell.rankHigh) {\n  return cell.bladeCount;\n }\n let count = f32(cell.bladeCount);\n let first = (share - cell.rankLow) / (cell.rankHigh - cell.rankLow) * count;\n return min(u32(ceil(first)) + 1u, cell.bladeCount);\n}",
  "fn patchCulled(view : Eyepoint, cell : Patch, widest : f32) -> bool {\n if ((view.cullMask & cullPatch) == 0u) {\n  return false;\n }\n let margin = patchMargin(view, cell, widest);\n let low = cell.boundsLow - vec3f(margin);\n let high = cell.boundsHigh + vec3f(margin);\n var outside = false;\n for (var i = 0u; i < 6u; i++) {\n  outside = outside || boxOutside(view.planes[i], low, high);\n }\n if (outside) {\n  return true;\n }\n return (view.cullMask & cullDistance) != 0u && boxDistance(view.eye, cell.boundsLow, cell.boundsHigh) > view.drawDistance;\n}",
  "@group(0) @binding(19) var<storage, read> cellBits_ : array<u32>;",
  "fn fetch_cells(i : u32) -> f32 {\n return bitcast<f32>(cellBits_[i]);\n}",
  "fn behindPyramid(box : ScreenBox) -> bool {\n let level = pyramidLevelFor(box, push_.pyramid.levels);\n let bits = pyramidFactorBits * (level + 1u);\n if (any((box.high >> vec2u(bits)) - (box.low >> vec2u(bits)) >= vec2i(pyramidReach))) {\n  return false;\n }\n let row = pyramidCells(push_.pyramid.size.x, level);\n let first = push_.pyramid.first[level].x;\n let nearest = box.nearest * 1.00001;\n let low = box.low >> vec2u(bits);\n let high = box.high >> vec2u(bits);\n for (var y = low.y; y <= high.y; y++) {\n  for (var x = low.x; x <= high.x; x++) {\n   if (fetch_cells(first + u32(y) * row + u32(x)) <= nearest) {\n    return false;\n   }\n  }\n }\n return true;\n}",
  "fn isHidden(low : vec3f, high : vec3f) -> bool {\n if (push_.pyramid.levels == 0u) {\n  return false;\n }\n let box = screenBoxOf(frameConstants_.viewProjection, push_.pyramid.size, low, high);\n return box.isKnown && behindPyramid(box);\n}",
  "@group(0) @binding(14) var<storage, read> widest_ : array<f32>;",
  "@group(0) @binding(15) var<storage, read> present_ : array<u32>;",
  "fn isHere(page : u32) -> bool {\n return (present_[page / 32u] & (1u << (page % 32u))) != 0u;\n}",
  "@compute @workgroup_size(64, 1, 1)\nfn main(@builtin(workgroup_id) WorkGroupID_ : vec3u, @builtin(global_invocation_id) GlobalInvocationID_ : vec3u) {\n let node = WorkGroupID_.y * groupsOfRow * 64u + GlobalInvocationID_.x;\n if (node >= push_.patchCount) {\n  return;\n }\n let cell = patches_[node];\n if (cell.bladeCount == 0u || patchCulled(frameConstants_.view, cell, widest_[node])) {\n  return;\n }\n let margin = vec3f(patchMargin(frameConstants_.view, cell, widest_[node]));\n if (isHidden(cell.boundsLow - margin, cell.boundsHigh + margin)) {\n  return;\n }\n let count = thickEnough(frameConstants_.view, cell);\n if (count == 0u || !isHere(cell.firstBlade / pageBlades) || !isHere((cell.firstBlade + count - 1u) / pageBlades)) {\n  return;\n }\n visiblePatches_[atomicAdd(&counters_[countPatches], 1u)] = VisiblePatch(node, count);\n}",
  "@group(0) @binding(12) var<storage, read> counters_ : array<u32>;",
  "@group(0) @binding(13) var<storage, read_write> arguments_ : array<u32>;",
  "const countBlades : u32 = 1u;",
  "const countRows : u32 = 3u;",
  "const argumentsPatches : u32 = 0u;",
  "const argumentsBlades : u32 = 4u;",
  "const argumentsRows : u32 = 8u;",
  "const maxRowBlocks : u32 = 1u << 20u;",
  "const rowBlocksOfGroup : u32 = 8u;",
  "fn argue(first : u32, groups : u32, count : u32) {\n arguments_[first] = min(groups, groupsOfRow);\n arguments_[first + 1u] = (groups + groupsOfRow - 1u) / groupsOfRow;\n arguments_[first + 2u] = 1u;\n arguments_[first + 3u] = count;\n}",
  "@compute @workgroup_size(1, 1, 1)\nfn main() {\n let cells = min(counters_[countPatches], push_.patchCount);\n argue(argumentsPatches, cells, cells);\n let drawn = min(counters_[countBlades], push_.capacity);\n argue(argumentsBlades, (drawn + 63u) / 64u, drawn);\n let rows = min(counters_[countRows], maxRowBlocks);\n argue(argumentsRows, (rows + rowBlocksOfGroup - 1u) / rowBlocksOfGroup, rows);\n}",
  "fn mixUint(x_in : u32) -> u32 {\n var x = x_in;\n x ^= x >> 16u;\n x *= 0x7feb352du;\n x ^= x >> 15u;\n x *= 0x846ca68bu;\n x ^= x >> 16u;\n return x;\n}",
  "const latticeX : u32 = 0x9e3779b1u;",
  "const latticeY : u32 = 0x85ebca77u;",
  "const latticeZ : u32 = 0xc2b2ae3du;",
  "fn latticePoint(x : i32, y : i32, z : i32) -> u32 {\n return u32(x) * latticeX + u32(y) * latticeY + u32(z) * latticeZ;\n}",
  "fn latticeHeight(point_in : u32) -> f32 {\n var point = point_in;\n point ^= point >> 11u;\n point *= 0x31848babu;\n return f32(point);\n}",
  "const latticeUnit : f32 = 1.0 / 4294967296.0;",
  "fn valueNoiseFrom(origin : u32, p : vec3f) -> f32 {\n let cell = floor(p);\n let f = p - cell;\n let s = f * f * (vec3f(3.0) - 2.0 * f);\n let near = origin + latticePoint(i32(cell.x), i32(cell.y), i32(cell.z));\n let far = near + latticeZ;\n let nearHeight = mix(mix(latticeHeight(near), latticeHeight(near + latticeX), s.x), mix(latticeHeight(near + latticeY), latticeHeight(near + latticeX + latticeY), s.x), s.y);\n let farHeight = mix(mix(latticeHeight(far), latticeHeight(far + latticeX), s.x), mix(latticeHeight(far + latticeY), latticeHeight(far + latticeX + latticeY), s.x), s.y);\n return latticeUnit * mix(nearHeight, farHeight, s.z);\n}",
  "fn valueNoise(p : vec3f) -> f32 {\n return valueNoiseFrom(0u, p);\n}",
  "fn signNotZero(x : f32) -> f32 {\n return select(-1.0, 1.0, x >= 0.0);\n}",
  "fn folded(x : f32, y : f32) -> vec3f {\n let z = 1.0 - abs(x) - abs(y);\n var t1_ : vec3f;\n if (z >= 0.0) {\n  t1_ = vec3f(x, y, z);\n } else {\n  t1_ = vec3f((1.0 - abs(y)) * signNotZero(x), (1.0 - abs(x)) * signNotZero(y), z);\n }\n let v = t1_;\n return normalize(v);\n}",
  "fn decodeOctahedral(bits : u32) -> vec3f {\n return folded(f32(i32(bits & 255u) - 127) * (1.0 / 127.0), f32(i32((bits >> 8u) & 255u) - 127) * (1.0 / 127.0));\n}",
  "fn packSnorm16(x : f32) -> u32 {\n return u32(i32(floor(clamp(x, -1.0, 1.0) * 32767.0 + 0.5))) & 65535u;\n}",
  "fn unpackSnorm16(bits : u32) -> f32 {\n return f32((i32(bits & 65535u) ^ 32768) - 32768) * (1.0 / 32767.0);\n}",
  "fn tangentOf(n : vec3f) -> vec3f {\n let s = signNotZero(n.z);\n let a = -1.0 / (s + n.z);\n return vec3f(1.0 + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);\n}",
  "fn bitangentOf(n : vec3f) -> vec3f {\n let s = signNotZero(n.z);\n let a = -1.0 / (s + n.z);\n return vec3f(n.x * n.y * a, s + n.y * n.y * a, -n.y);\n}",
  "const twoPi : f32 = 6.28318530717958647692;",
  "struct PackedBlade {\n rootXY : u32,\n rootZUp : u32,\n shape : u32,\n look : u32,\n}",
  "struct Blade {\n root : vec3f,\n facing : f32,\n up : vec3f,\n stiffness : f32,\n height : f32,\n width : f32,\n exposure : f32,\n species : u32,\n tint : vec3f,\n clump : u32,\n hash : u32,\n seed : u32,\n}",
  "fn seedOf(bits : PackedBlade) -> u32 {\n let kept = (bits.shape & 0xffc000ffu) ^ ((bits.rootZUp >> 16u) << 8u);\n return mixUint(kept + bits.look * 0x9e3779b9u) >> 16u;\n}",
  "fn unpackBlade(bits : PackedBlade, cell : Patch) -> Blade {\n var blade : Blade;\n blade.root = cell.rootLow + cell.rootStep * vec3f(f32(bits.rootXY & 65535u), f32(bits.rootXY >> 16u), f32(bits.rootZUp & 65535u));\n blade.up = decodeOctahedral(bits.rootZUp >> 16u);\n blade.facing = f32(bits.shape & 255u) * (twoPi / 256.0);\n blade.height = cell.heightLow + cell.heightStep * f32((bits.shape >> 8u) & 255u);\n blade.width = cell.widthLow + cell.widthStep * f32((bits.shape >> 16u) & 63u);\n blade.stiffness = f32((bits.shape >> 22u) & 63u) * (1.0 / 63.0);\n blade.hash = bits.shape >> 28u;\n blade.tint = vec3f(f32(bits.look & 31u) * (1.0 / 31.0), f32((bits.look >> 5u) & 63u) * (1.0 / 63.0), f32((bits.look >> 11u) & 31u) * (1.0 / 31.0));\n blade.exposure = f32((bits.look >> 16u) & 31u) * (1.0 / 31.0);\n blade.species = (bits.look >> 21u) & 7u;\n blade.clump = bits.look >> 24u;\n blade.seed = seedOf(bits);\n return blade;\n}",
  "fn widthAxis(up : vec3f, facing : f32) -> vec3f {\n return tangentOf(up) * cos(facing) + bitangentOf(up) * sin(facing);\n}",
  "fn frontOf(up : vec3f, axis : vec3f) -> vec3f {\n return cross(up, axis);\n}",
  "struct BladeAxes {\n front : vec3f,\n side : vec3f,\n up : vec3f,\n}",
  "fn axesAlong(up : vec3f, axis : vec3f) -> BladeAxes {\n var axes : BladeAxes;\n axes.front = frontOf(up, axis);\n axes.side = -axis;\n axes.up = up;\n return axes;\n}",
  "fn alongAxes(axes : BladeAxes, v : vec3f) -> vec3f {\n return vec3f(dot(v, axes.front), dot(v, axes.side), dot(v, axes.up));\n}",
  "fn inSpace(axes : BladeAxes, v : vec3f) -> vec3f {\n return v.x * axes.front + v.y * axes.side + v.z * axes.up;\n}",
  "const cullResultDrawn : u32 = 0u;",
  "const cullResultOrientation : u32 = 2u;",
  "const cullResultFrustum : u32 = 3u;",
  "const cullResultDistance : u32 = 4u;",
  "const cullResultLod : u32 = 6u;",
  "const cullOrientation : u32 = 2u;",
  "const cullFrustum : u32 = 4u;",
  "fn curveOutside(plane : vec4f, v0 : vec3f, v1 : vec3f, v2 : vec3f, margin : f32) -> bool {\n return max(max(planeDistance(plane, v0), planeDistance(plane, v1)), planeDistance(plane, v2)) < -margin;\n}",
  "fn edgeOnCosine(eye : vec3f, root : vec3f, axis : vec3f) -> f32 {\n let ray = root - eye;\n return min(abs(dot(ray, axis)) / max(length(ray), 1e-6), 1.0);\n}",
  "fn bucketsKeep(buckets : f32, last : f32, distance_ : f32, rank : f32) -> bool {\n return buckets <= 0.0 || rank * buckets < floor(buckets * (1.0 - distance_ / last));\n}",
  "const lodFade : f32 = 0.1;",
  "fn lodWidthFactor(rank : f32, share : f32) -> f32 {\n if (share >= lodFullShare) {\n  return 1.0;\n }\n let fade = lodFade * share;\n let weight = clamp((share - rank) / fade, 0.0, 1.0);\n let beyond = max(share - 1.0, 0.0);\n let mean = share - 0.5 * fade - 0.5 * beyond * beyond / fade;\n return weight / mean;\n}",
  "fn leafAreaWeight(rank : f32, share : f32) -> f32 {\n if (share >= lodFullShare) {\n  return 1.0;\n }\n return clamp((share - rank) / (lodFade * share), 0.0, 1.0);\n}",
  "struct ColliderMask {\n words : array<u32, 8>,\n}",
  "const windNoise : u32 = 0u;",
  "const windTurning : u32 = 1u;",
  "const windWave : u32 = 2u;",
  "const windRadial : u32 = 3u;",
  "const windSwirl : u32 = 4u;",
  "const windGusts : u32 = 5u;",
  "const windsAlike : u32 = 1u << 24u;",
  "fn rowOf(m : mat4x4f, i : i32) -> vec3f {\n return vec3f(m[0][i], m[1][i], m[2][i]);\n}",
  "fn screenBoxOfCurve(viewProjection : mat4x4f, size : vec2u, v0 : vec3f, v1 : vec3f, v2 : vec3f, margin : f32) -> ScreenBox {\n let a = viewProjection * vec4f(v0, 1.0);\n let b = viewProjection * vec4f(v1, 1.0);\n let c = viewProjection * vec4f(v2, 1.0);\n let ofW = length(rowOf(viewProjection, 3));\n let minW = min(min(a.w, b.w), c.w) - margin * ofW;\n let maxZ = max(max(a.z, b.z), c.z) + margin * length(rowOf(viewProjection, 2));\n var box : ScreenBox;\n box.low = vec2i(0);\n box.high = vec2i(0);\n box.nearest = 0.0;\n box.isKnown = minW > 0.0 && maxZ <= minW;\n if (!box.isKnown) {\n  return box;\n }\n let placeA = vec2f(a.x, a.y) * (1.0 / a.w);\n let placeB = vec2f(b.x, b.y) * (1.0 / b.w);\n let placeC = vec2f(c.x, c.y) * (1.0 / c.w);\n var lowest = min(min(placeA, placeB), placeC);\n var highest = max(max(placeA, placeB), placeC);\n let ofPlace = vec2f(length(rowOf(viewProjection, 0)), length(rowOf(viewProjection, 1)));\n let perW = 1.0 / minW;\n let reach = (ofPlace + max(abs(lowest), abs(highest)) * ofW) * (margin * perW);\n let pixels = vec2f(f32(size.x), f32(size.y));\n let last = pixels - vec2f(1.0);\n lowest = floor(((lowest - reach) * 0.5 + vec2f(0.5)) * pixels) - vec2f(1.0);\n highest = floor(((highest + reach) * 0.5 + vec2f(0.5)) * pixels) + vec2f(1.0);\n box.low = vec2i(clamp(lowest, vec2f(0.0), last));\n box.high = vec2i(clamp(highest, vec2f(0.0), last));\n box.nearest = maxZ * perW;\n return box;\n}",
  "fn bezierPoint(v0 : vec3f, v1 : vec3f, v2 : vec3f, t : f32) -> vec3f {\n let a = v0 + t * (v1 - v0);\n let b = v1 + t * (v2 - v1);\n return a + t * (b - a);\n}",
  "fn bezierTangent(v0 : vec3f, v1 : vec3f, v2 : vec3f, t : f32) -> vec3f {\n return 2.0 * ((1.0 - t) * (v1 - v0) + t * (v2 - v1));\n}",
  "struct BladeState {\n turn : u32,\n eta : f32,\n}",
  "const unsettledTurn : u32 = 0x80008000u;",
  "struct Pose {\n v1 : vec3f,\n v2 : vec3f,\n}",
  "fn directionOfTurn(turn : vec2f) -> vec3f {\n let square = min(dot(turn, turn), 1.0);\n return 1.0 / (1.0 + square) * vec3f(2.0 * turn.x, 2.0 * turn.y, 1.0 - square);\n}",
  "fn stateOfTurn(turn : vec2f, eta : f32) -> BladeState {\n var state : BladeState;\n state.turn = packSnorm16(turn.x) | (packSnorm16(turn.y) << 16u);\n state.eta = eta;\n return state;\n}",
  "fn storedTurn(state : BladeState) -> vec2f {\n return vec2f(unpackSnorm16(state.turn), unpackSnorm16(state.turn >> 16u));\n}",
  "fn storedDirection(state : BladeState) -> vec3f {\n return directionOfTurn(storedTurn(state));\n}",
  "fn lengthCorrection(side : f32) -> f32 {\n if (side > 0.95) {\n  return (-0.48620368 * side + 0.92399928) * side + 0.55642926;\n }\n let high = (-1.3481541 * side + 4.0007265) * side - 4.6675167;\n let low = (high * side + 2.7635532) * side - 0.71043977;\n return (low * side - 0.037761414) * side + 1.0;\n}",
  "fn tipDistance(direction : vec3f) -> f32 {\n return lengthCorrection(length(vec2f(direction.x, direction.y)));\n}",
  "fn poseOfState(axes : BladeAxes, state : BladeState) -> Pose {\n let direction = storedDirection(state);\n let side = length(vec2f(direction.x, direction.y));\n let scale = lengthCorrection(side);\n var pose : Pose;\n pose.v1 = axes.up * (max(1.0 - side, 0.05) * scale);\n pose.v2 = inSpace(axes, direction * scale);\n return pose;\n}",
  "struct Species {\n @align(16) rootColor : vec3f,\n tipThreshold : f32,\n tipColor : vec3f,\n groundTint : f32,\n colorVariation : f32,\n translucency : f32,\n gloss : f32,\n dryness : f32,\n shape : u32,\n fold : f32,\n firstOrgan : u32,\n organKinds : u32,\n}",
  "struct Organ {\n @align(16) look : Species,\n count : u32,\n place : vec2f,\n pitch : vec2f,\n size : vec2f,\n width : f32,\n azimuth : f32,\n turn : f32,\n bend : f32,\n leg : f32,\n variation : f32,\n}",
  "fn ribbonNumber(species : Species, blade : Blade) -> u32 {\n return select(0u, blade.clump, species.organKinds > 0u);\n}",
  "fn organOf(species : Species, number : u32, within : ptr<function, u32>) -> u32 {\n var kind = species.firstOrgan;\n (*within) = number - 1u;\n while (kind + 1u < species.firstOrgan + species.organKinds && (*within) >= fetch_organs(kind).count) {\n  (*within) -= fetch_organs(kind).count;\n  kind++;\n }\n return kind;\n}",
  "struct PosedBlade {\n blade : Blade,\n v0 : vec3f,\n v1 : vec3f,\n v2 : vec3f,\n axis : vec3f,\n}",
  "fn posedBlade(blade : Blade, state : BladeState) -> PosedBlade {\n var posed : PosedBlade;\n posed.blade = blade;\n posed.axis = widthAxis(blade.up, blade.facing);\n let pose = poseOfState(axesAlong(blade.up, posed.axis), state);\n posed.v0 = blade.root;\n posed.v1 = blade.root + blade.height * pose.v1;\n posed.v2 = blade.root + blade.height * pose.v2;\n return posed;\n}",
  "fn plantKey(blade : Blade) -> u32 {\n return blade.hash | ((u32(blade.facing * (256.0 / twoPi) + 0.5) & 255u) << 4u);\n}",
  "fn organDice(blade : Blade, number : u32, salt : u32) -> f32 {\n return f32(mixUint(plantKey(blade) | (number << 12u) | (salt << 20u)) >> 8u) * (1.0 / 16777215.0) - 0.5;\n}",
  "fn aboveGround(root : vec3f, up : vec3f, v : vec3f) -> vec3f {\n return v - up * min(dot(up, v - root), 0.0);\n}",
  "fn posedRibbon(stalk : PosedBlade, organ : Organ, number : u32, within : u32) -> PosedBlade {\n let plant = stalk.blade;\n let share = select(0.0, f32(within) / f32(organ.count - 1u), organ.count > 1u);\n let t = mix(organ.place.x, organ.place.y, share);\n var along = bezierTangent(stalk.v0, stalk.v1, stalk.v2, t);\n along = normalize(select(stalk.v1 - stalk.v0, along, dot(along, along) > 1e-10 * plant.height * plant.height));\n var side = stalk.axis - along * dot(along, stalk.axis);\n let level = dot(side, side);\n side = select(plant.up, side * inverseSqrt(level), level > 1e-6);\n let front = cross(along, side);\n let azimuth = organ.azimuth + organ.turn * f32(within) + 2.0 * organ.variation * organDice(plant, number, 0u);\n let pitch = mix(organ.pitch.x, organ.pitch.y, share) + 0.8 * organ.variation * organDice(plant, number, 1u);\n let outwards = cos(azimuth) * side + sin(azimuth) * front;\n var ribbon : PosedBlade;\n ribbon.blade = plant;\n ribbon.blade.height = plant.height * mix(organ.size.x, organ.size.y, share) * (1.0 + 0.6 * organ.variation * organDice(plant, number, 2u));\n ribbon.axis = cos(azimuth) * front - sin(azimuth) * side;\n let leg = organ.leg * ribbon.blade.height;\n ribbon.v0 = bezierPoint(stalk.v0, stalk.v1, stalk.v2, t);\n let v1 = ribbon.v0 + leg * (cos(pitch) * along + sin(pitch) * outwards);\n let v2 = v1 + leg * (cos(pitch + organ.bend) * along + sin(pitch + organ.bend) * outwards);\n ribbon.v1 = aboveGround(plant.root, plant.up, v1);\n ribbon.v2 = aboveGround(plant.root, plant.up, v2);\n return ribbon;\n}",
  "fn ribbonOf(species : Species, stalk : PosedBlade, number : u32) -> PosedBlade {\n var within = 0u;\n let kind = organOf(species, number, &within);\n return posedRibbon(stalk, fetch_organs(kind), number, within);\n}",
  "const ticksPerSecond : f32 = 262144.0;",
  "fn secondsBetween(then : u32, now : u32) -> f32 {\n return f32(now - then) / ticksPerSecond;\n}",
  "const settlingTime : f32 = 12.0;",
  "struct VisibleBlade {\n blade : u32,\n patchIndex : u32,\n factors : u32,\n pixels : f32,\n}",
  "const heightFactorBits : u32 = 0x03ff0000u;",
  "fn packFactors(width : f32, height : f32) -> u32 {\n return pack2x16float(vec2f(width, height)) & (heightFactorBits | 0xffffu);\n}",
  "struct Looks {\n @align(16) species : array<Species, 8>,\n organs : array<Organ, 32>,\n}",
  "@group(0) @binding(1) var<uniform> looks_ : Looks;",
  "@group(0) @binding(3) var<storage, read> blades_ : array<PackedBlade>;",
  "@group(0) @binding(4) var<storage, read_write> states_ : array<u32>;",
  "@group(0) @binding(10) var<storage, read> visiblePatches_ : array<VisiblePatch>;",
  "@group(0) @binding(11) var<storage, read_write> visible_ : array<VisibleBlade>;",
  "const countMoved : u32 = 4u;",
  "fn fetch_species(i : u32) -> Species {\n return looks_.species[i];\n}",
  "fn fetch_organs(i : u32) -> Organ {\n return looks_.organs[i];\n}",
  "struct SampleMask {\n threshold : f32,\n first : u32,\n samples : u32,\n}",
  "fn sampleMaskOf(seed : u32, samples : u32) -> SampleMask {\n var mask : SampleMask;\n mask.threshold = (f32(seed & 0x1fffu) + 0.5) / 8192.0;\n mask.first = (seed >> 13u) % samples;\n mask.samples = samples;\n return mask;\n}",
  "fn keptCount(mask : SampleMask, weight : f32) -> u32 {\n return select(mask.samples, u32(max(weight, 0.0) * f32(mask.samples) + mask.threshold), weight < 1.0);\n}",
  "fn keptBits(mask : SampleMask, weight : f32) -> u32 {\n let all_ = (1u << mask.samples) - 1u;\n let bits = (1u << min(keptCount(mask, weight), mask.samples)) - 1u;\n return ((bits << mask.first) | (bits >> (mask.samples - mask.first))) & all_;\n}",
  "fn keptSamples(weight : f32, seed : u32, samples : u32) -> u32 {\n return keptBits(sampleMaskOf(seed, samples), weight);\n}",
  "struct Verdict {\n cullResult : u32,\n widthFactor : f32,\n pixels : f32,\n margin : f32,\n}",
  "fn raised(blade : Blade, heightFactor : f32) -> Blade {\n var drawn = blade;\n drawn.height = blade.height * heightFactor;\n return drawn;\n}",
  "struct DrawnSize {\n widthFactor : f32,\n pixels : f32,\n}",
  "fn drawnSize(view : Eyepoint, limit : LeafAreaLimit, blade : Blade, rank : f32, distance_ : f32) -> DrawnSize {\n let share = shareAt(view, distance_);\n var size : DrawnSize;\n size.widthFactor = lodWidthFactor(rank, share) / leavesPerDrawn(view, distance_) * leafAreaWeight(rank / min(share, 1.0), limit.share);\n size.pixels = blade.height * view.pixelsPerUnit / max(distance_, 1e-6);\n return size;\n}",
  "fn bladeRank(cell : Patch, i : u32) -> f32 {\n return mix(cell.rankLow, cell.rankHigh, (f32(i) + 0.5) / f32(cell.bladeCount));\n}",
  "fn seenTooNarrow(view : Eyepoint, posed : PosedBlade, widthFactor : f32) -> bool {\n let blade = posed.blade;\n let distance_ = length(posed.v0 - view.eye);\n let cosine = edgeOnCosine(view.eye, posed.v0, posed.axis);\n if (cosine > view.maxEdgeOn) {\n  return true;\n }\n let nearest = distance_ - blade.height;\n if (nearest <= 0.0 || view.minWidth <= 0.0) {\n  return false;\n }\n let sine = min(sqrt(1.0 - cosine * cosine) + 1.58 * blade.height / distance_, 1.0);\n let widest = outlineMost * blade.width * widthFactor * sine;\n return keptSamples(widest / (view.minWidth * nearest), blade.seed, view.samples) == 0u;\n}",
  "fn cullBlade(view : Eyepoint, limit : LeafAreaLimit, posed : PosedBlade, rank : f32) -> Verdict {\n let blade = posed.blade;\n let distance_ = length(blade.root - view.eye);\n let size = drawnSize(view, limit, blade, rank, distance_);\n let factor = size.widthFactor;\n var verdict : Verdict;\n verdict.cullResult = cullResultDrawn;\n verdict.widthFactor = factor;\n verdict.pixels = size.pixels;\n verdict.margin = 0.5 * outlineMost * blade.width * max(factor, 1.0) + sectionMargin(distance_ + blade.height, view.minWidth);\n var outside = false;\n if ((view.cullMask & cullFrustum) != 0u) {\n  for (var i = 0u; i < 6u; i++) {\n   outside = outside || curveOutside(view.planes[i], posed.v0, posed.v1, posed.v2, verdict.margin);\n  }\n }\n if ((view.cullMask & cullOrientation) != 0u && seenTooNarrow(view, posed, select(1.0, factor, factor > 0.0))) {\n  verdict.cullResult = cullResultOrientation;\n } else {\n  if (outside) {\n   verdict.cullResult = cullResultFrustum;\n  } else {\n   if ((view.cullMask & cullDistance) != 0u && (distance_ > view.drawDistance || !bucketsKeep(view.buckets, view.bucketDistance, distance_, rank))) {\n    verdict.cullResult = cullResultDistance;\n   } else {\n    if (factor <= 0.0) {\n     verdict.cullResult = cullResultLod;\n    }\n   }\n  }\n }\n if (verdict.cullResult != cullResultDrawn) {\n  verdict.widthFactor = 0.0;\n }\n return verdict;\n}",
  "override mayHaveOrgans : bool = true;",
  "fn windCount(counts : u32, kind : u32) -> u32 {\n return (counts >> (4u * kind)) & 15u;\n}",
  "const fineNoiseScale : f32 = 2.7;",
  "const gustRows : u32 = 7u;",
  "fn windWaveAt(source : WindSource, phase : WindPhase, position : vec3f, time : f32) -> f32 {\n let k = 6.2831853 * source.perSize;\n let along = k * (dot(position, source.direction) - source.speed * time) - phase.angle;\n let across = k * dot(position, source.side);\n let sum = cos(0.9 * along + 0.4 * across) + sin(0.55 * along - 0.25 * across) + sin(0.3 * along + 0.6 * across);\n return 1.0 - max(sum / 3.0, 0.0);\n}",
  "fn inLattice(wind : Wind, v : vec3f, shift : vec3f) -> vec3f {\n let x = frameConstants_.environment.wind.lattice.x;\n let y = frameConstants_.environment.wind.lattice.y;\n let z = frameConstants_.environment.wind.lattice.z;\n return vec3f(shift.x + x.x * v.x + x.y * v.y + x.z * v.z, shift.y + y.x * v.x + y.y * v.y + y.z * v.z, shift.z + z.x * v.x + z.y * v.y + z.z * v.z);\n}",
  "fn windNoiseAt(wind : Wind, source : WindSource, phase : WindPhase, position : vec3f, time : f32) -> f32 {\n let along = dot(position, source.direction) - 2.0 * source.speed * time;\n let stretched = inLattice(wind, 0.5 * source.perSize * (position + source.direction * along), phase.shift);\n let gust = 0.65 * valueNoiseFrom(phase.cell, stretched) + 0.35 * valueNoiseFrom(phase.fineCell, fineNoiseScale * stretched + phase.fineShift);\n return 2.0 * gust * gust;\n}",
  "const gustRise : f32 = 0.12;",
  "fn windGustAt(wind : Wind, source : WindSource, phase : WindPhase, position : vec3f, time : f32) -> f32 {\n let along = dot(position, source.direction);\n let across = inLattice(wind, source.perSize * (position - source.direction * along), vec3f(0.0));\n let bend = 0.8 * (valueNoise(0.7 * across + vec3f(5.1)) - 0.5) + phase.shift.x;\n let fronts = (source.speed * time - along) * source.perSize + bend;\n let front = floor(fronts);\n let s = fronts - front;\n let rise = clamp(s / gustRise, 0.0, 1.0);\n let fall = clamp((1.0 - s) / (1.0 - gustRise), 0.0, 1.0);\n let profile = rise * rise * (3.0 - 2.0 * rise) * fall * fall;\n let own = valueNoiseFrom(phase.cell, across + vec3f(0.0, 0.0, f32(gustRows) * front));\n return profile * clamp(2.0 * own - 0.2, 0.0, 1.0);\n}",
  "fn parabolicSine(x : vec3f) -> vec3f {\n let f = 2.0 * fract(x) - vec3f(1.0);\n return -4.0 * f * (vec3f(1.0) - abs(f));\n}",
  "const eddyDrift : vec3f = vec3f(0.48, 0.57, 0.67);",
  "fn windEddies(size : f32, speed : f32, phase : vec3f, position : vec3f, time : f32) -> vec3f {\n let q = (position + eddyDrift * (speed * time)) / size + phase;\n let s = parabolicSine(q);\n let c = parabolicSine(q + vec3f(0.25));\n return 0.7 * (vec3f(s.z, s.x, s.y) + vec3f(c.y, c.z, c.x));\n}",
  "const radialExtent : f32 = 75.0;",
  "const swirlExtent : f32 = 30.0;",
  "fn windAround(source : WindSource, phase : WindPhase, arm : vec3f, up : vec3f, time : f32, isSwirl : bool) -> vec3f {\n let distance_ = length(arm);\n let away = arm / (distance_ + 0.01 * source.size);\n let unit = select(radialExtent, swirlExtent, isSwirl) / source.size;\n let r = unit * distance_;\n let fade = max(1.0 - 0.25 * log2(select(0.2, 0.5, isSwirl) * r + 1.0), 0.0);\n let along = r - unit * source.speed * time - phase.angle;\n if (!isSwirl) {\n  return away * (fade * (1.0 - max(sin(0.4 * along), 0.0)));\n }\n let ring = sin(0.1 * along);\n return (away + 1.5 * (1.0 - fade * fade) * cross(up, away)) * (fade * ring * ring * ring);\n}",
  "fn windAlong(wind : Wind, source : WindSource, direction : vec3f, amount : f32, position : vec3f, up : vec3f, time : f32) -> vec3f {\n let head = (1.0 - source.lift) * abs(dot(source.direction, up));\n var flow = direction;\n if (head > 0.0) {\n  flow += head * windEddies(wind.eddySize, wind.eddySpeed, wind.eddyPhase, position, time);\n }\n return amount * flow;\n}",
  "fn windFelt(source : WindSource, flow : vec3f, axes : BladeAxes, direction : vec3f) -> vec3f {\n var wind = alongAxes(axes, flow);\n wind.z *= source.lift;\n let square = dot(wind, wind);\n let along = select(0.0, abs(dot(wind, direction)) * inverseSqrt(square), square > 1e-12);\n return (1.0 - source.alignment * along) * wind;\n}",
  "fn windAmount(wind : Wind, position : vec3f, time : f32) -> f32 {\n var sum = 0.0;\n var next = 0u;\n for (var i = windCount(wind.counts, windNoise); i > 0u; i--) {\n  let phase = frameConstants_.environment.wind.phases[next];\n  let t1_ = next;\n  next++;\n  let source = frameConstants_.environment.wind.sources[t1_];\n  sum += source.strength * windNoiseAt(wind, source, phase, position, time);\n }\n for (var i = windCount(wind.counts, windWave); i > 0u; i--) {\n  let phase = frameConstants_.environment.wind.phases[next];\n  let t2_ = next;\n  next++;\n  let source = frameConstants_.environment.wind.sources[t2_];\n  let wave = windWaveAt(source, phase, position, time);\n  sum += source.strength * wave * wave;\n }\n for (var i = windCount(wind.counts, windGusts); i > 0u; i--) {\n  let phase = frameConstants_.environment.wind.phases[next];\n  let t3_ = next;\n  next++;\n  let source = frameConstants_.environment.wind.sources[t3_];\n  sum += source.strength * windGustAt(wind, source, phase, position, time);\n }\n return sum;\n}",
  "fn windOfAmount(wind : Wind, amount : f32, position : vec3f, axes : BladeAxes, direction : vec3f, time : f32) -> vec3f {\n let source = frameConstants_.environment.wind.sources[0];\n return amount * windFelt(source, windAlong(wind, source, source.direction, 1.0, position, axes.up, time), axes, direction);\n}",
  "fn windAlongAxes(wind : Wind, root : vec3f, axes : BladeAxes, direction : vec3f, time : f32) -> vec3f {\n let position = root + frameConstants_.environment.wind.lattice.origin;\n if ((wind.counts & windsAlike) != 0u) {\n  return windOfAmount(wind, windAmount(wind, position, time), position, axes, direction, time);\n }\n var sum = vec3f(0.0);\n var next = 0u;\n for (var i = windCount(wind.counts, windNoise); i > 0u; i--) {\n  let phase = frameConstants_.environment.wind.phases[next];\n  let t1_ = next;\n  next++;\n  let source = frameConstants_.environment.wind.sources[t1_];\n  let amount = source.strength * windNoiseAt(wind, source, phase, position, time);\n  sum += windFelt(source, windAlong(wind, source, source.direction, amount, position, axes.up, time), axes, direction);\n }\n for (var i = windCount(wind.counts, windTurning); i > 0u; i--) {\n  let phase = frameConstants_.environment.wind.phases[next];\n  let t2_ = next;\n  next++;\n  let source = frameConstants_.environment.wind.sources[t2_];\n  let angle = source.turn * time + phase.turned;\n  let turned = source.direction * cos(angle) + cross(axes.up, source.direction) * sin(angle);\n  let amount = source.strength * sin(source.rate * time + phase.angle - 6.2831853 * source.perSize * dot(position, source.direction));\n  sum += windFelt(source, windAlong(wind, source, turned, amount, position, axes.up, time), axes, direction);\n }\n for (var i = windCount(wind.counts, windWave); i > 0u; i--) {\n  let phase = frameConstants_.environment.wind.phases[next];\n  let t3_ = next;\n  next++;\n  let source = frameConstants_.environment.wind.sources[t3_];\n  let wave = windWaveAt(source, phase, position, time);\n  let amount = source.strength * wave * wave;\n  sum += windFelt(source, windAlong(wind, source, source.direction, amount, position, axes.up, time), axes, direction);\n }\n for (var i = windCount(wind.counts, windRadial); i > 0u; i--) {\n  let phase = frameConstants_.environment.wind.phases[next];\n  let t4_ = next;\n  next++;\n  let source = frameConstants_.environment.wind.sources[t4_];\n  sum += windFelt(source, source.strength * windAround(source, phase, root - source.centre, axes.up, time, false), axes, direction);\n }\n for (var i = windCount(wind.counts, windSwirl); i > 0u; i--) {\n  let phase = frameConstants_.environment.wind.phases[next];\n  let t5_ = next;\n  next++;\n  let source = frameConstants_.environment.wind.sources[t5_];\n  sum += windFelt(source, source.strength * windAround(source, phase, root - source.centre, axes.up, time, true), axes, direction);\n }\n for (var i = windCount(wind.counts, windGusts); i > 0u; i--) {\n  let phase = frameConstants_.environment.wind.phases[next];\n  let t6_ = next;\n  next++;\n  let source = frameConstants_.environment.wind.sources[t6_];\n  let amount = source.strength * windGustAt(wind, source, phase, position, time);\n  sum += windFelt(source, windAlong(wind, source, source.direction, amount, position, axes.up, time), axes, direction);\n }\n return sum;\n}",
  "fn environmentAt(gravity : Gravity, root : vec3f) -> vec3f {\n var towards = gravity.direction;\n if (gravity.blend > 0.0) {\n  let toAttractor = gravity.attractor - root;\n  let distance_ = length(toAttractor);\n  let pull = select(vec3f(0.0), toAttractor / distance_, distance_ > 1e-6);\n  towards = mix(gravity.direction, pull, gravity.blend);\n }\n return gravity.strength * towards;\n}",
  "struct TurnQuotient {\n over : vec2f,\n under : vec2f,\n}",
  "fn timesConjugate(a : vec2f, b : vec2f) -> vec2f {\n return vec2f(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y);\n}",
  "fn turnAbove(turn : TurnQuotient) -> vec2f {\n let product = timesConjugate(turn.over, turn.under);\n let under = dot(turn.under, turn.under);\n if (dot(turn.over, turn.over) <= under) {\n  return 1.0 / under * product;\n }\n let square = dot(product, product);\n return select(vec2f(1.0, 0.0), inverseSqrt(square) * product, square > 1e-30);\n}",
  "const lyingBelow : f32 = 1e-3;",
  "fn relaxTurn(stiffness : f32, force : vec3f, recovery : f32, turn : vec2f, lies : bool, radius : f32, eta : f32, dt : f32) -> TurnQuotient {\n let b = 1.0 - stiffness;\n let k = max(recovery * (1.0 - 0.25 * b) * max(1.0 - eta, 0.1), 1e-3);\n var pull = b * force;\n pull.z += k;\n if (lies) {\n  pull.z = max(pull.z, 0.0);\n }\n let strength = length(pull);\n var turned : TurnQuotient;\n turned.over = turn;\n turned.under = vec2f(1.0, 0.0);\n if (strength < 1e-6 * k) {\n  return turned;\n }\n let fall = exp(-(strength / radius) * dt);\n let above = strength + pull.z;\n let below = strength - pull.z;\n let towards = (1.0 - fall) * vec2f(pull.x, pull.y);\n turned.over = (fall * above + below) * turn + towards;\n turned.under = timesConjugate(turn, towards);\n turned.under.x += above + fall * below;\n return turned;\n}",
  "const longestStep : f32 = 0.034;",
  "const maxSteps : u32 = 16u;",
  "const stickingSpeed : f32 = 0.06;",
  "fn advanceBlade(blade : Blade, environment : Environment, near : ColliderMask, state : BladeState, time : f32, elapsed : f32) -> BladeState {\n let axes = axesAlong(blade.up, widthAxis(blade.up, blade.facing));\n let fade = 0.5 * max(blade.stiffness, 0.1);\n let steps = u32(clamp(ceil(elapsed / longestStep), 1.0, f32(maxSteps)));\n let dt = elapsed / f32(steps);\n let pull = environmentAt(environment.gravity, blade.root);\n var gravity = alongAxes(axes, pull);\n gravity.x += environment.gravity.forward * length(pull);\n let first = storedTurn(state);\n var turn = first;\n var eta = state.eta;\n var pushed = 0.0;\n var resting = true;\n for (var i = 0u; i < steps; i++) {\n  let back = elapsed - dt * f32(i + 1u);\n  eta = max(eta - fade * dt, 0.0);\n  let direction = directionOfTurn(turn);\n  let radius = tipDistance(direction);\n  let before = pushed;\n  let wind = windAlongAxes(environment.wind, blade.root, axes, direction, time - back - 0.5 * dt);\n  turn = turnAbove(relaxTurn(blade.stiffness, gravity + radius * direction.z * wind, environment.recovery, turn, direction.z < lyingBelow, radius, eta, dt));\n }\n if (pushed > 0.0 && resting) {\n  let from_ = directionOfTurn(first);\n  let to = directionOfTurn(turn);\n  if (length(tipDistance(to) * to - tipDistance(from_) * from_) < stickingSpeed * elapsed) {\n   return state;\n  }\n }\n return stateOfTurn(turn, eta);\n}",
  "fn isHidden_2(v0 : vec3f, v1 : vec3f, v2 : vec3f, margin : f32) -> bool {\n if (push_.pyramid.levels == 0u) {\n  return false;\n }\n let box = screenBoxOfCurve(frameConstants_.viewProjection, push_.pyramid.size, v0, v1, v2, margin);\n return box.isKnown && behindPyramid(box);\n}",
  "@group(0) @binding(16) var<storage, read_write> patchTimes_ : array<u32>;",
  "var<workgroup> kept : atomic<u32>;",
  "var<workgroup> listBase : u32;",
  "var<workgroup> survivors : array<vec4u, 512>;",
  "@compute @workgroup_size(64, 1, 1)\nfn main(@builtin(workgroup_id) WorkGroupID_ : vec3u, @builtin(local_invocation_index) LocalInvocationIndex_ : u32) {\n let thread = LocalInvocationIndex_;\n let place = WorkGroupID_.y * groupsOfRow + WorkGroupID_.x;\n let count = min(atomicLoad(&counters_[countPatches]), push_.patchCount);\n let item = visiblePatches_[min(place, max(count, 1u) - 1u)];\n let wanted = select(0u, item.count, place < count);\n let patchIndex = item.patchIndex;\n let cell = patches_[patchIndex];\n let limit = leafAreaLimitOf(frameConstants_.view, cell);\n let elapsed = secondsBetween(patchTimes_[patchIndex], push_.tick);\n if (thread == 0u) {\n  atomicStore(&kept, 0u);\n }\n workgroupBarrier();\n for (var i = thread; i < wanted; i += 64u) {\n  let index = cell.firstBlade + i;\n  let blade = unpackBlade(blades_[index], cell);\n  var turn = states_[index];\n  let isNew = turn == unsettledTurn;\n  let since = select(elapsed, settlingTime, isNew);\n  if (since > 0.0) {\n   var none : ColliderMask;\n   turn = advanceBlade(blade, frameConstants_.environment, none, BladeState(select(turn, 0u, isNew), 0.0), 0.0, since).turn;\n   states_[index] = turn;\n  }\n  var number = 0u;\n  var drawn = posedBlade(raised(blade, limit.height), BladeState(turn, 0.0));\n  if (mayHaveOrgans) {\n   let species = fetch_species(blade.species);\n   number = ribbonNumber(species, blade);\n   if (number > 0u) {\n    drawn = ribbonOf(species, drawn, number);\n   }\n  }\n  let verdict = cullBlade(frameConstants_.view, limit, drawn, bladeRank(cell, i - min(number, i)));\n  if (verdict.cullResult == cullResultDrawn && !isHidden_2(drawn.v0, drawn.v1, drawn.v2, verdict.margin)) {\n   survivors[atomicAdd(&kept, 1u)] = vec4u(i, packFactors(verdict.widthFactor, limit.height), bitcast<u32>(verdict.pixels), 0u);\n  }\n }\n workgroupBarrier();\n if (thread == 0u && wanted > 0u) {\n  listBase = atomicAdd(&counters_[countBlades], atomicLoad(&kept));\n  atomicAdd(&counters_[countMoved], wanted);\n  patchTimes_[patchIndex] = push_.tick;\n }\n workgroupBarrier();\n for (var i = thread; i < atomicLoad(&kept); i += 64u) {\n  let survivor = survivors[i];\n  if (listBase + i < push_.capacity) {\n   visible_[listBase + i] = VisibleBlade(cell.firstBlade + survivor.x, patchIndex, survivor.y, bitcast<f32>(survivor.z));\n  }\n }\n}",
  "const driedClump : u32 = 255u;",
  "fn curveInside(plane : vec4f, v0 : vec3f, v1 : vec3f, v2 : vec3f, margin : f32) -> bool {\n return min(min(planeDistance(plane, v0), planeDistance(plane, v1)), planeDistance(plane, v2)) > margin;\n}",
  "const shapeTriangleTip : u32 = 0u;",
  "const shapeTriangle : u32 = 2u;",
  "const shapeQuadratic : u32 = 3u;",
  "const shapeDandelion : u32 = 4u;",
  "const shapeLeaf : u32 = 5u;",
  "const shapeStalkLeaf : u32 = 6u;",
  "const shapeCount : u32 = 7u;",
  "const baseWidth : f32 = 0.25;",
  "const baseLength : f32 = 0.3;",
  "const dandelionLobes : f32 = 4.0;",
  "const segmentsPerLobe : f32 = 4.0;",
  "fn outlineAt(shape : u32, tipThreshold : f32, t : f32) -> vec2f {\n var half_ = 0.5;\n if (shape == shapeTriangleTip) {\n  half_ = 0.5 - 0.5 * max(t - tipThreshold, 0.0) / max(1.0 - tipThreshold, 1e-3);\n } else {\n  if (shape == shapeTriangle) {\n   half_ = 0.5 - 0.5 * t;\n  } else {\n   if (shape == shapeQuadratic) {\n    return vec2f(-0.5, 0.5 - t * t);\n   } else {\n    if (shape == shapeDandelion) {\n     let rest = 1.0 - t;\n     let wave = abs(sin(3.14159265 * dandelionLobes * rest));\n     half_ = 0.5 * sqrt(rest) * (2.0 - rest - sqrt(0.5 * wave));\n    } else {\n     if (shape == shapeLeaf) {\n      let away = select((t - tipThreshold) / max(1.0 - tipThreshold, 1e-3), (tipThreshold - t) / max(tipThreshold, 1e-3), t < tipThreshold);\n      half_ = 0.5 - 0.5 * min(away * away, 1.0);\n     } else {\n      if (shape == shapeStalkLeaf) {\n       let before = max(1.0 - t / baseLength, 0.0);\n       half_ = (0.5 - 0.5 * max(t - tipThreshold, 0.0) / max(1.0 - tipThreshold, 1e-3)) * (1.0 - (1.0 - baseWidth) * before * before);\n      }\n     }\n    }\n   }\n  }\n }\n return vec2f(-half_, half_);\n}",
  "fn momentsOfStalkLeaf(tipThreshold : f32) -> vec2f {\n let tau = tipThreshold;\n let lacks = 1.0 - baseWidth;\n let u = max(1.0 - tau / baseLength, 0.0);\n let taper = u * u * u * u * baseLength * baseLength / max(1.0 - tau, 1e-3);\n return vec2f(0.5 + 0.5 * tau - lacks * (baseLength / 3.0 - taper / 12.0), (1.0 + tau + tau * tau) / 6.0 - lacks * (baseLength * baseLength / 12.0 - taper * baseLength * (1.0 / 12.0 - 0.05 * u)));\n}",
  "fn outlineArea(shape : u32, tipThreshold : f32) -> f32 {\n if (shape == shapeTriangleTip) {\n  return 0.5 + 0.5 * tipThreshold;\n }\n if (shape == shapeTriangle) {\n  return 0.5;\n }\n if (shape == shapeQuadratic || shape == shapeLeaf) {\n  return 2.0 / 3.0;\n }\n if (shape == shapeStalkLeaf) {\n  return momentsOfStalkLeaf(tipThreshold).x;\n }\n return select(1.0, 0.57268, shape == shapeDandelion);\n}",
  "struct Outline {\n shape : u32,\n tipThreshold : f32,\n segments : f32,\n scale : f32,\n}",
  "const exactSegments : f32 = 20.0;",
  "fn innerWidths(shape : u32, tipThreshold : f32, segments : f32) -> f32 {\n if (shape == shapeTriangleTip) {\n  let first = floor(tipThreshold * segments) + 1.0;\n  let count = max(segments - first, 0.0);\n  let beyond = 0.5 * count * (first + segments - 1.0) / segments - tipThreshold * count;\n  return segments - 1.0 - beyond / max(1.0 - tipThreshold, 1e-3);\n }\n var sum = 0.0;\n for (var i = 1.0; i < segments; i += 1.0) {\n  let edges = outlineAt(shape, tipThreshold, i / segments);\n  sum += edges.y - edges.x;\n }\n return sum;\n}",
  "fn outlineOf(shape : u32, tipThreshold : f32, segments : f32) -> Outline {\n var outline : Outline;\n outline.shape = shape;\n outline.tipThreshold = tipThreshold;\n outline.segments = segments;\n outline.scale = 1.0;\n if (segments < 1.5 || segments > exactSegments) {\n  return outline;\n }\n if (shape == shapeStalkLeaf && segments < 3.5) {\n  outline.shape = shapeTriangleTip;\n }\n let first = outlineAt(outline.shape, tipThreshold, 0.0);\n let last = outlineAt(outline.shape, tipThreshold, 1.0);\n let sum = 0.5 * (first.y - first.x + last.y - last.x) + innerWidths(outline.shape, tipThreshold, segments);\n outline.scale = outlineArea(shape, tipThreshold) * segments / sum;\n return outline;\n}",
  "fn singleSegment(shape : u32, tipThreshold : f32) -> vec2f {\n if (shape == shapeTriangleTip) {\n  return vec2f(1.0 + tipThreshold - tipThreshold * tipThreshold, tipThreshold * tipThreshold);\n }\n if (shape == shapeTriangle) {\n  return vec2f(1.0, 0.0);\n }\n if (shape == shapeQuadratic) {\n  return vec2f(7.0 / 6.0, 1.0 / 6.0);\n }\n if (shape == shapeLeaf) {\n  let moment = 0.25 + tipThreshold * (1.0 / 6.0);\n  return vec2f(8.0 / 3.0 - 6.0 * moment, 6.0 * moment - 4.0 / 3.0);\n }\n if (shape == shapeStalkLeaf) {\n  let moments = momentsOfStalkLeaf(tipThreshold);\n  return vec2f(4.0 * moments.x - 6.0 * moments.y, 6.0 * moments.y - 2.0 * moments.x);\n }\n return select(vec2f(1.0), vec2f(0.64894, 0.49642), shape == shapeDandelion);\n}",
  "fn edgesAt(outline : Outline, t : f32) -> vec2f {\n if (outline.segments < 1.5) {\n  let ends = singleSegment(outline.shape, outline.tipThreshold);\n  let half_ = 0.5 * mix(ends.x, ends.y, t);\n  return vec2f(-half_, half_);\n }\n return outline.scale * outlineAt(outline.shape, outline.tipThreshold, t);\n}",
  "fn segmentsFor(v0 : vec3f, v1 : vec3f, v2 : vec3f, size : f32, shape : u32, heightPixels : f32, widthPixels : f32, most : f32) -> f32 {\n let stray = length(v0 - 2.0 * v1 + v2) * (heightPixels / max(size, 1e-9));\n let curve = ceil(sqrt(stray));\n if (shape == shapeDandelion && widthPixels > 2.0) {\n  return dandelionLobes * segmentsPerLobe;\n }\n var tip = select(select(1.0, 2.0, widthPixels > 1.0), 3.0, widthPixels > 3.0);\n if ((shape == shapeLeaf || shape == shapeStalkLeaf) && widthPixels > 3.0) {\n  tip = select(4.0, 8.0, widthPixels > 12.0);\n }\n return clamp(max(curve, tip), 1.0, max(most, 1.0));\n}",
  "fn segmentsAt(steps : LevelSteps, distance_ : f32) -> f32 {\n var segments = steps.segments[0];\n for (var i = 1; i < 4; i++) {\n  if (u32(i) < steps.count && distance_ >= steps.distance_[i - 1]) {\n   segments = steps.segments[i];\n  }\n }\n return segments;\n}",
  "fn widthFactorOf(visible : VisibleBlade) -> f32 {\n return unpack2x16float(visible.factors).x;\n}",
  "fn heightFactorOf(visible : VisibleBlade) -> f32 {\n return unpack2x16float((visible.factors & heightFactorBits) | 0x3c000000u).y;\n}",
  "@group(0) @binding(4) var<storage, read> states_ : array<u32>;",
  "@group(0) @binding(11) var<storage, read> visible_ : array<VisibleBlade>;",
  "const countQuads : u32 = 2u;",
  "override onlyShape : u32 = shapeCount;",
  "fn knownShape(shape : u32) -> u32 {\n return select(shape, onlyShape, onlyShape < shapeCount);\n}",
  "fn placeOf(pages : vec2u, blade : u32) -> u32 {\n return blade;\n}",
  "fn rowsOfColumn(height : u32) -> u32 {\n return (height + 3u) & ~3u;\n}",
  "struct Ribbon {\n v0 : vec3f,\n v1 : vec3f,\n v2 : vec3f,\n axis : vec3f,\n width : f32,\n fold : f32,\n outline : Outline,\n seed : u32,\n}",
  "struct CrossSection {\n left : vec3f,\n right : vec3f,\n ridge : vec3f,\n wide : f32,\n drawn : f32,\n}",
  "fn foldOf(fold : f32, widthPixels : f32) -> f32 {\n return fold * smoothstep(2.0, 4.0, widthPixels);\n}",
  "fn directionAt(ribbon : Ribbon, t : f32) -> vec3f {\n let tangent = bezierTangent(ribbon.v0, ribbon.v1, ribbon.v2, t);\n return select(ribbon.v1 - ribbon.v0, tangent, dot(tangent, tangent) > 1e-18);\n}",
  "fn outwardsOf(across : vec3f, level : vec3f) -> vec3f {\n let square = dot(level, level);\n let unit = select(across, level * inverseSqrt(square), square > 1e-18);\n let upright = dot(unit, across);\n return across + upright / max(upright * upright, 0.25) * (unit - upright * across);\n}",
  "fn crossSectionAt(ribbon : Ribbon, t : f32, eye : vec3f, minWidth : f32) -> CrossSection {\n let centre = bezierPoint(ribbon.v0, ribbon.v1, ribbon.v2, t);\n let direction = directionAt(ribbon, t);\n let edges = ribbon.width * edgesAt(ribbon.outline, t);\n var section : CrossSection;\n section.left = centre + edges.x * ribbon.axis;\n section.right = centre + edges.y * ribbon.axis;\n section.wide = edges.y - edges.x;\n section.drawn = section.wide;\n if (minWidth > 0.0) {\n  let half_ = 0.5 / max(ribbon.outline.segments, 1.0);\n  let chord = directionAt(ribbon, clamp(t, half_, 1.0 - half_));\n  let ray = centre - eye;\n  let distance_ = length(ray);\n  let side = cross(ray, chord);\n  let square = dot(side, side);\n  let across = select(ribbon.axis, side * inverseSqrt(square), square > 1e-12 * dot(ray, ray) * dot(chord, chord));\n  let seen = dot(ribbon.axis, across);\n  section.wide *= abs(seen);\n  section.drawn = max(section.wide, minWidth * distance_);\n  let outwards = outwardsOf(across, cross(ray, ribbon.v1 - ribbon.v0));\n  let grown = 0.5 * (section.drawn - section.wide) * select(1.0, -1.0, seen < 0.0) * outwards;\n  section.left -= grown;\n  section.right += grown;\n }\n section.ridge = 0.5 * (section.left + section.right);\n if (ribbon.fold > 0.0) {\n  section.ridge += 0.5 * ribbon.fold * (edges.y - edges.x) * normalize(cross(direction, ribbon.axis));\n }\n return section;\n}",
  "fn marginBeside(width : f32, distance_ : f32, minWidth : f32) -> f32 {\n return 0.5 * outlineMost * width + sectionMargin(distance_, minWidth);\n}",
  "struct DrawnBlade {\n ribbon : Ribbon,\n blade : Blade,\n species : Species,\n}",
  "struct PosedLook {\n posed : PosedBlade,\n look : Species,\n number : u32,\n}",
  "fn posedLook(blade : Blade, state : BladeState) -> PosedLook {\n var part = PosedLook(posedBlade(blade, state), fetch_species(blade.species), 0u);\n if (!mayHaveOrgans || part.look.organKinds == 0u) {\n  return part;\n }\n part.number = blade.clump;\n if (part.number > 0u) {\n  var within : u32;\n  let organ = fetch_organs(organOf(part.look, part.number, &within));\n  part.posed = posedRibbon(part.posed, organ, part.number, within);\n  part.look = organ.look;\n }\n part.posed.blade.clump = plantKey(blade) % driedClump;\n return part;\n}",
  "fn segmentsOf(ribbon : Ribbon, height : f32, shape : u32, heightPixels : f32, widthPixels : f32) -> f32 {\n if (frameConstants_.fixedTessellation > 0.0) {\n  return clamp(frameConstants_.fixedTessellation, 1.0, 64.0);\n }\n if (frameConstants_.levelSteps.count > 0u) {\n  return segmentsAt(frameConstants_.levelSteps, length(ribbon.v0 - frameConstants_.view.eye));\n }\n return segmentsFor(ribbon.v0, ribbon.v1, ribbon.v2, height, shape, heightPixels, widthPixels, f32(frameConstants_.maxTessellation));\n}",
  "fn drawnBlade(visible : VisibleBlade, part : PosedLook) -> DrawnBlade {\n let species = part.look;\n let posed = part.posed;\n var drawn : DrawnBlade;\n drawn.blade = posed.blade;\n drawn.species = species;\n let height = posed.blade.height;\n var ribbon : Ribbon;\n ribbon.v0 = posed.v0;\n ribbon.v1 = posed.v1;\n ribbon.v2 = posed.v2;\n ribbon.axis = posed.axis;\n ribbon.width = posed.blade.width * widthFactorOf(visible);\n let widthPixels = visible.pixels * ribbon.width / height;\n ribbon.fold = foldOf(species.fold, widthPixels);\n let shape = knownShape(species.shape);\n ribbon.outline = outlineOf(shape, species.tipThreshold, segmentsOf(ribbon, height, shape, visible.pixels, widthPixels));\n ribbon.seed = posed.blade.seed;\n drawn.ribbon = ribbon;\n return drawn;\n}",
  "fn drawnBlade_2(visible : VisibleBlade, blade : Blade, state : BladeState) -> DrawnBlade {\n return drawnBlade(visible, posedLook(blade, state));\n}",
  "fn stateOf_2(visible : VisibleBlade) -> BladeState {\n return BladeState(states_[placeOf(vec2u(), visible.blade)], 0.0);\n}",
  "fn visibleBlade(visible : VisibleBlade) -> Blade {\n let blade = unpackBlade(blades_[placeOf(vec2u(), visible.blade)], patches_[visible.patchIndex]);\n return raised(blade, heightFactorOf(visible));\n}",
  "fn drawnBlade_3(visible : VisibleBlade) -> DrawnBlade {\n return drawnBlade_2(visible, visibleBlade(visible), stateOf_2(visible));\n}",
  "const samplesPerPixel : u32 = 4u;",
  "const fourPlaces : array<vec2f, 4> = array<vec2f, 4>(vec2f(0.375, 0.125), vec2f(0.875, 0.375), vec2f(0.125, 0.625), vec2f(0.625, 0.875));",
  "fn samplePlace(s : u32) -> vec2f {\n return fourPlaces[s];\n}",
  "fn rowsBetween(low : f32, high : f32, edge : f32) -> vec2i {\n let uppermost = samplePlace(0u).y;\n let lowermost = samplePlace(samplesPerPixel - 1u).y;\n return vec2i(i32(max(ceil(low - lowermost), 0.0)), i32(min(floor(high - uppermost), edge - 1.0)));\n}",
  "fn middleOf(covered : u32) -> vec2f {\n var sum = vec2f(0.0);\n for (var s = 0u; s < samplesPerPixel; s++) {\n  var t1_ : vec2f;\n  if ((covered & (1u << s)) != 0u) {\n   t1_ = samplePlace(s);\n  } else {\n   t1_ = vec2f(0.0);\n  }\n  sum += t1_;\n }\n return sum / f32(i32(countOneBits(covered)));\n}",
  "fn upperHalf(i : f32, segments : f32) -> bool {\n return 2.0 * i > segments;\n}",
  "struct Lens {\n viewProjection : mat4x4f,\n eye : vec3f,\n minWidth : f32,\n size : vec2f,\n}",
  "fn lensOf() -> Lens {\n return Lens(frameConstants_.viewProjection, frameConstants_.view.eye, frameConstants_.view.minWidth, vec2f(push_.size));\n}",
  "fn columnStride() -> u32 {\n return rowsOfColumn(push_.size.y) * samplesPerPixel;\n}",
  "fn sampleIndex(pixel : vec2u, s : u32) -> u32 {\n return pixel.x * columnStride() + pixel.y * samplesPerPixel + s;\n}",
  "@group(0) @binding(9) var<storage, read_write> seenSamples_ : array<atomic<u32>>;",
  "fn putOne(index : u32, depth : f32, blade : u32) {\n let bits = bitcast<u32>(depth);\n if (push_.isIdPass == 0u) {\n  atomicMax(&seenSamples_[2u * index + 1u], bits);\n } else {\n  if (atomicLoad(&seenSamples_[2u * index + 1u]) == bits) {\n   atomicMax(&seenSamples_[2u * index], push_.firstBlade + blade);\n  }\n }\n}",
  "fn putSmall(pixel : vec2u, covered : u32, depths : array<f32, 4>, blade : u32) {\n let first = sampleIndex(pixel, 0u);\n for (var s = 0u; s < samplesPerPixel; s++) {\n  if ((covered & (1u << s)) != 0u) {\n   putOne(first + s, depths[s], blade);\n  }\n }\n}",
  "override mayFold : bool = true;",
  "fn isFolded(ribbon : Ribbon) -> bool {\n return mayFold && ribbon.fold > 0.0;\n}",
  "fn seenPoint(lens : Lens, position : vec3f) -> vec4f {\n let clip = lens.viewProjection * vec4f(position, 1.0);\n return vec4f((0.5 * clip.xy + 0.5 * clip.w) * lens.size, clip.z, clip.w);\n}",
  "struct SeenSection {\n section : CrossSection,\n left : vec4f,\n right : vec4f,\n ridge : vec4f,\n}",
  "fn seenSection(lens : Lens, ribbon : Ribbon, t : f32) -> SeenSection {\n var seen : SeenSection;\n seen.section = crossSectionAt(ribbon, t, lens.eye, lens.minWidth);\n seen.left = seenPoint(lens, seen.section.left);\n seen.right = seenPoint(lens, seen.section.right);\n seen.ridge = 0.5 * (seen.left + seen.right);\n if (isFolded(ribbon)) {\n  seen.ridge = seenPoint(lens, seen.section.ridge);\n }\n return seen;\n}",
  "fn isBefore(seen : vec4f) -> bool {\n return seen.w <= 0.0 || seen.z > seen.w;\n}",
  "fn trianglesOf(isFolded : bool) -> u32 {\n return select(2u, 4u, isFolded);\n}",
  "struct TriangleOf {\n isRight : bool,\n endsAtRidge : bool,\n isSecond : bool,\n beginsRight : bool,\n endsLeft : bool,\n}",
  "fn triangleOf(i : u32, isFolded : bool, isUpper : bool) -> TriangleOf {\n var part : TriangleOf;\n part.isRight = i >= 2u;\n part.endsAtRidge = isFolded && i < 2u;\n part.isSecond = (i & 1u) != 0u;\n part.beginsRight = part.isSecond && isUpper;\n part.endsLeft = part.isSecond || isUpper;\n return part;\n}",
  "fn crossOf(a : vec2f, b : vec2f) -> f32 {\n return a.x * b.y - a.y * b.x;\n}",
  "struct ScreenSection {\n left : vec3f,\n right : vec3f,\n ridge : vec3f,\n weight : vec2f,\n}",
  "const subpixels : f32 = 256.0;",
  "fn screenPoint(seen : vec4f) -> vec3f {\n let inverse = 1.0 / seen.w;\n return vec3f(round(seen.xy * (inverse * subpixels)) / subpixels, seen.z * inverse);\n}",
  "fn screenSection(seen : SeenSection, isFolded : bool) -> ScreenSection {\n var screen : ScreenSection;\n screen.left = screenPoint(seen.left);\n screen.right = screenPoint(seen.right);\n screen.ridge = screen.left;\n if (isFolded) {\n  screen.ridge = screenPoint(seen.ridge);\n }\n screen.weight = vec2f(seen.section.wide, seen.section.drawn) / seen.ridge.w;\n return screen;\n}",
  "struct Quad {\n a0 : vec3f,\n a1 : vec3f,\n b0 : vec3f,\n b1 : vec3f,\n weightA0 : vec2f,\n weightA1 : vec2f,\n weightB : vec2f,\n}",
  "fn halvesOf(isFolded : bool) -> u32 {\n return select(1u, 2u, isFolded);\n}",
  "fn halfOf(i : u32, before : ScreenSection, after : ScreenSection, isFolded : bool) -> Quad {\n let isRight = i > 0u;\n let endsAtRidge = isFolded && !isRight;\n return Quad(select(before.left, before.ridge, isRight), select(before.right, before.ridge, endsAtRidge), select(after.left, after.ridge, isRight), select(after.right, after.ridge, endsAtRidge), before.weight, before.weight, after.weight);\n}",
  "fn triangleBetween(i : u32, before : ScreenSection, after : ScreenSection, isFolded : bool, isUpper : bool) -> Quad {\n let part = triangleOf(i, isFolded, isUpper);\n let whole = halfOf(i / 2u, before, after, isFolded);\n var quad : Quad;\n quad.a0 = select(whole.a0, whole.b1, part.isSecond);\n quad.a1 = select(whole.a1, whole.b0, part.isSecond);\n quad.b0 = select(select(whole.b1, whole.b0, part.endsLeft), select(whole.a0, whole.a1, part.beginsRight), part.isSecond);\n quad.b1 = quad.b0;\n quad.weightA0 = select(before.weight, after.weight, part.isSecond);\n quad.weightA1 = quad.weightA0;\n quad.weightB = select(after.weight, before.weight, part.isSecond);\n return quad;\n}",
  "fn isConvex(quad : Quad) -> bool {\n let a = quad.a1.xy - quad.a0.xy;\n let b = quad.b1.xy - quad.a1.xy;\n let c = quad.b0.xy - quad.b1.xy;\n let d = quad.a0.xy - quad.b0.xy;\n let turns = vec4f(crossOf(a, b), crossOf(b, c), crossOf(c, d), crossOf(d, a));\n return all(turns >= vec4f(0.0)) || all(turns <= vec4f(0.0));\n}",
  "struct Corner {\n seen : vec4f,\n widths : vec2f,\n}",
  "fn cutBetween(a : Corner, b : Corner) -> Corner {\n let depthA = a.seen.w - a.seen.z;\n let depthB = b.seen.w - b.seen.z;\n let share = depthA / (depthA - depthB);\n return Corner(mix(a.seen, b.seen, share), mix(a.widths, b.widths, share));\n}",
  "fn behindNear(a : Corner, b : Corner, c : Corner, quad : ptr<function, Quad>) -> bool {\n let lost = u32(isBefore(a.seen)) + u32(isBefore(b.seen)) + u32(isBefore(c.seen));\n if (lost == 3u) {\n  return false;\n }\n let isLost = lost == 1u;\n var first = a;\n var second = b;\n var third = c;\n if (isBefore(b.seen) == isLost && lost > 0u) {\n  first = b;\n  second = c;\n  third = a;\n } else {\n  if (isBefore(c.seen) == isLost && lost > 0u) {\n   first = c;\n   second = a;\n   third = b;\n  }\n }\n var fourth = third;\n if (lost == 1u) {\n  fourth = cutBetween(first, third);\n  first = cutBetween(first, second);\n } else {\n  if (lost == 2u) {\n   second = cutBetween(first, second);\n   third = cutBetween(first, third);\n   fourth = third;\n  }\n }\n (*quad).a0 = screenPoint(first.seen);\n (*quad).a1 = screenPoint(second.seen);\n (*quad).b1 = screenPoint(third.seen);\n (*quad).b0 = screenPoint(fourth.seen);\n (*quad).weightA0 = first.widths / first.seen.w;\n (*quad).weightA1 = second.widths / second.seen.w;\n (*quad).weightB = 0.5 * (third.widths / third.seen.w + fourth.widths / fourth.seen.w);\n return true;\n}",
  "fn triangleBehindNear(i : u32, before : SeenSection, after : SeenSection, isFolded : bool, isUpper : bool, quad : ptr<function, Quad>) -> bool {\n let part = triangleOf(i, isFolded, isUpper);\n let first = vec2f(before.section.wide, before.section.drawn);\n let second = vec2f(after.section.wide, after.section.drawn);\n let a = Corner(select(before.left, before.ridge, part.isRight), first);\n let b = Corner(select(before.right, before.ridge, part.endsAtRidge), first);\n let c = Corner(select(after.left, after.ridge, part.isRight), second);\n let d = Corner(select(after.right, after.ridge, part.endsAtRidge), second);\n var t1_ : Corner;\n if (part.beginsRight) {\n  t1_ = b;\n } else {\n  t1_ = a;\n }\n var t2_ : Corner;\n if (part.isSecond) {\n  t2_ = d;\n } else {\n  t2_ = b;\n }\n var t3_ : Corner;\n if (part.endsLeft) {\n  t3_ = c;\n } else {\n  t3_ = d;\n }\n return behindNear(t1_, t2_, t3_, quad);\n}",
  "struct Sides {\n leftPlaces : vec4f,\n leftSlopes : vec4f,\n rightPlaces : vec4f,\n rightSlopes : vec4f,\n}",
  "fn sidesOf(p0 : vec2f, p1 : vec2f, p2 : vec2f, p3 : vec2f, area : f32) -> Sides {\n let xs = vec4f(p0.x, p1.x, p2.x, p3.x);\n let ys = vec4f(p0.y, p1.y, p2.y, p3.y);\n let rises = ys.yzwx - ys;\n let slopes = (xs.yzwx - xs) / select(rises, vec4f(1.0), rises == vec4f(0.0));\n let places = xs + (p0.y - ys) * slopes;\n let turned = select(rises, -rises, area < 0.0);\n let lefts = turned < vec4f(0.0);\n let rights = turned > vec4f(0.0);\n return Sides(select(vec4f(-1e30), places, lefts), select(vec4f(0.0), slopes, lefts), select(vec4f(1e30), places, rights), select(vec4f(0.0), slopes, rights));\n}",
  "fn between(from_ : vec4f, to : vec4f) -> vec2f {\n return vec2f(max(max(from_.x, from_.y), max(from_.z, from_.w)), min(min(to.x, to.y), min(to.z, to.w)));\n}",
  "fn intervalAt(sides : Sides, below : f32) -> vec2f {\n return between(sides.leftPlaces + below * sides.leftSlopes, sides.rightPlaces + below * sides.rightSlopes);\n}",
  "fn isThin(quad : Quad) -> bool {\n return quad.weightA0.x < quad.weightA0.y || quad.weightA1.x < quad.weightA1.y || quad.weightB.x < quad.weightB.y;\n}",
  "fn drawSmall(quad : Quad, mask : SampleMask, blade : u32) {\n let p0 = quad.a0.xy;\n let p1 = quad.a1.xy;\n let p2 = quad.b1.xy;\n let p3 = quad.b0.xy;\n let low = min(min(p0, p1), min(p2, p3));\n let high = max(max(p0, p1), max(p2, p3));\n let edge = vec2f(push_.size);\n let middle = 0.5 * (quad.b0 + quad.b1);\n let across = p1 - p0;\n let along = middle.xy - p0;\n let area = crossOf(across, along);\n if (high.x < 0.0 || high.y < 0.0 || low.x > edge.x || low.y > edge.y || area == 0.0) {\n  return;\n }\n let sStep = vec2f(along.y, -along.x) / area;\n let tStep = vec2f(-across.y, across.x) / area;\n let depthStep = sStep * (quad.a1.z - quad.a0.z) + tStep * (middle.z - quad.a0.z);\n let shallowest = max(max(quad.a0.z, quad.a1.z), max(quad.b0.z, quad.b1.z));\n let deepest = min(min(quad.a0.z, quad.a1.z), min(quad.b0.z, quad.b1.z));\n let mayBeThin = isThin(quad);\n let keepsFirst = quad.weightA0.x - (1.0 - mask.threshold) * quad.weightA0.y;\n let keepsLast = quad.weightB.x - (1.0 - mask.threshold) * quad.weightB.y;\n let sides = sidesOf(p0, p1, p2, p3, area);\n let rows = rowsBetween(low.y, high.y, edge.y);\n for (var row = rows.x; row <= rows.y; row++) {\n  var spans : array<vec2f, 4>;\n  var widest = vec2f(1e30, -1e30);\n  for (var s = 0u; s < samplesPerPixel; s++) {\n   let place = samplePlace(s);\n   let y = f32(row) + place.y;\n   spans[s] = intervalAt(sides, y - p0.y) - place.x;\n   if (y < low.y || y > high.y) {\n    spans[s] = vec2f(1e30, -1e30);\n   }\n   widest = vec2f(min(widest.x, spans[s].x), max(widest.y, spans[s].y));\n  }\n  if (widest.x > widest.y) {\n   continue;\n  }\n  let left = i32(max(ceil(widest.x), 0.0));\n  let right = i32(min(floor(widest.y), edge.x - 1.0));\n  for (var column = left; column <= right; column++) {\n   var covered = 0u;\n   for (var s = 0u; s < samplesPerPixel; s++) {\n    if (f32(column) >= spans[s].x && f32(column) <= spans[s].y) {\n     covered |= 1u << s;\n    }\n   }\n   if (covered == 0u) {\n    continue;\n   }\n   let corner = vec2f(f32(column), f32(row)) - p0;\n   if (mayBeThin) {\n    let t = dot(corner + middleOf(covered), tStep);\n    let weight = mix(quad.weightA0, quad.weightB, clamp(t, 0.0, 1.0));\n    covered &= keptBits(mask, weight.x / max(weight.y, 1e-12));\n   }\n   var depths : array<f32, 4>;\n   for (var s = 0u; s < samplesPerPixel; s++) {\n    depths[s] = clamp(quad.a0.z + dot(corner + samplePlace(s), depthStep), deepest, shallowest);\n   }\n   putSmall(vec2u(u32(column), u32(row)), covered, depths, blade);\n  }\n }\n}",
  "const quadBits : u32 = 18u;",
  "const maxQuads : u32 = 1u << quadBits;",
  "const noRowBlock : u32 = 0xffffffffu;",
  "const rowsOfBlock : u32 = 8u;",
  "@group(0) @binding(17) var<storage, read_write> quads_ : array<vec4f>;",
  "@group(0) @binding(18) var<storage, read_write> rowBlocks_ : array<u32>;",
  "const alonePixels : f32 = 64.0;",
  "fn lowOf(quad : Quad) -> vec2f {\n return min(min(quad.a0.xy, quad.a1.xy), min(quad.b0.xy, quad.b1.xy));\n}",
  "fn highOf(quad : Quad) -> vec2f {\n return max(max(quad.a0.xy, quad.a1.xy), max(quad.b0.xy, quad.b1.xy));\n}",
  "fn listQuad(quad : Quad, rows : vec2i, seed : u32, blade : u32) -> bool {\n let blocks = (u32(rows.y - rows.x) + rowsOfBlock) / rowsOfBlock;\n let slot = atomicAdd(&counters_[countQuads], 1u);\n let first = atomicAdd(&counters_[countRows], blocks);\n let hasRoom = slot < maxQuads && first + blocks <= maxRowBlocks;\n for (var i = 0u; i < blocks && first + i < maxRowBlocks; i++) {\n  rowBlocks_[first + i] = select(noRowBlock, slot | (i << quadBits), hasRoom);\n }\n if (!hasRoom) {\n  return false;\n }\n quads_[5u * slot] = vec4f(quad.a0, quad.weightA0.x);\n quads_[5u * slot + 1u] = vec4f(quad.a1, quad.weightA0.y);\n quads_[5u * slot + 2u] = vec4f(quad.b0, quad.weightA1.x);\n quads_[5u * slot + 3u] = vec4f(quad.b1, quad.weightA1.y);\n quads_[5u * slot + 4u] = vec4f(quad.weightB, bitcast<f32>(blade), bitcast<f32>(seed));\n return true;\n}",
  "fn drawQuad(quad : Quad, mask : SampleMask, seed : u32, blade : u32) {\n let edge = vec2f(push_.size);\n let low = lowOf(quad);\n let high = highOf(quad);\n let rows = rowsBetween(low.y, high.y, edge.y);\n let wide = min(high.x, edge.x) - max(low.x, 0.0);\n if (wide < 0.0 || rows.y < rows.x) {\n  return;\n }\n if (wide * f32(rows.y - rows.x + 1) > alonePixels) {\n  let haveRoom = atomicLoad(&counters_[countQuads]) <= maxQuads && atomicLoad(&counters_[countRows]) <= maxRowBlocks;\n  var t1_ : bool;\n  if (push_.isIdPass == 0u) {\n   t1_ = listQuad(quad, rows, seed, blade);\n  } else {\n   t1_ = haveRoom;\n  }\n  if (t1_) {\n   return;\n  }\n }\n drawSmall(quad, mask, blade);\n}",
  "fn drawCut(lens : Lens, ribbon : Ribbon, blade : u32) {\n let segments = ribbon.outline.segments;\n let hasRidge = isFolded(ribbon);\n let mask = sampleMaskOf(ribbon.seed, samplesPerPixel);\n for (var segment = 1.0; segment <= segments; segment += 1.0) {\n  let before = seenSection(lens, ribbon, (segment - 1.0) / segments);\n  let after = seenSection(lens, ribbon, segment / segments);\n  for (var i = 0u; i < trianglesOf(hasRidge); i++) {\n   var quad : Quad;\n   if (triangleBehindNear(i, before, after, hasRidge, upperHalf(segment, segments), &quad)) {\n    drawQuad(quad, mask, ribbon.seed, blade);\n   }\n  }\n }\n}",
  "fn drawWhole(lens : Lens, ribbon : Ribbon, blade : u32) {\n let hasRidge = isFolded(ribbon);\n let segments = ribbon.outline.segments;\n let mask = sampleMaskOf(ribbon.seed, samplesPerPixel);\n var before = screenSection(seenSection(lens, ribbon, 0.0), hasRidge);\n var segment = 1.0;\n var part = 0u;\n while (segment <= segments) {\n  let after = screenSection(seenSection(lens, ribbon, segment / segments), hasRidge);\n  var isTwisted = false;\n  for (var i = 0u; i < halvesOf(hasRidge); i++) {\n   isTwisted = isTwisted || !isConvex(halfOf(i, before, after, hasRidge));\n  }\n  var t1_ : Quad;\n  if (isTwisted) {\n   t1_ = triangleBetween(part, before, after, hasRidge, upperHalf(segment, segments));\n  } else {\n   t1_ = halfOf(part, before, after, hasRidge);\n  }\n  let quad = t1_;\n  part++;\n  var t2_ : u32;\n  if (isTwisted) {\n   t2_ = trianglesOf(hasRidge);\n  } else {\n   t2_ = halvesOf(hasRidge);\n  }\n  if (part >= t2_) {\n   before = after;\n   segment += 1.0;\n   part = 0u;\n  }\n  drawQuad(quad, mask, ribbon.seed, blade);\n }\n}",
  "@compute @workgroup_size(64, 1, 1)\nfn main(@builtin(workgroup_id) WorkGroupID_ : vec3u, @builtin(local_invocation_index) LocalInvocationIndex_ : u32) {\n let place = (WorkGroupID_.y * groupsOfRow + WorkGroupID_.x) * 64u + LocalInvocationIndex_;\n if (place >= min(atomicLoad(&counters_[countBlades]), push_.capacity)) {\n  return;\n }\n let lens = lensOf();\n let drawn = drawnBlade_3(visible_[place]);\n let ribbon = drawn.ribbon;\n let margin = marginBeside(ribbon.width, length(ribbon.v0 - lens.eye) + drawn.blade.height, lens.minWidth);\n if (curveInside(frameConstants_.view.planes[4], ribbon.v0, ribbon.v1, ribbon.v2, margin)) {\n  drawWhole(lens, ribbon, place);\n } else {\n  drawCut(lens, ribbon, place);\n }\n}",
  "fn depthAt(index : u32) -> u32 {\n return atomicLoad(&seenSamples_[2u * index + 1u]);\n}",
  "fn depthsAt(index : u32) -> vec2u {\n return vec2u(depthAt(index), depthAt(index + 1u));\n}",
  "struct Span {\n xs : vec4f,\n ys : vec4f,\n slopes : vec4f,\n depth : vec3f,\n deepest : f32,\n shallowest : f32,\n isThin : bool,\n wide : vec3f,\n drawn : vec3f,\n}",
  "fn linearIn(steps : mat2x2f, a0 : f32, a1 : f32, b : f32) -> vec3f {\n return vec3f(a0, steps * vec2f(a1 - a0, b - a0));\n}",
  "fn spanOfQuad(quad : Quad, mayBeThin : bool, span : ptr<function, Span>) -> bool {\n (*span).xs = vec4f(quad.a0.x, quad.a1.x, quad.b1.x, quad.b0.x);\n (*span).ys = vec4f(quad.a0.y, quad.a1.y, quad.b1.y, quad.b0.y);\n (*span).slopes = ((*span).xs.yzwx - (*span).xs) / ((*span).ys.yzwx - (*span).ys);\n let middle = 0.5 * (quad.b0 + quad.b1);\n let across = quad.a1.xy - quad.a0.xy;\n let along = middle.xy - quad.a0.xy;\n let area = crossOf(across, along);\n let steps = mat2x2f(along.y, -along.x, -across.y, across.x) * (1.0 / area);\n (*span).depth = linearIn(steps, quad.a0.z, quad.a1.z, middle.z);\n (*span).deepest = min(min(quad.a0.z, quad.a1.z), min(quad.b0.z, quad.b1.z));\n (*span).shallowest = max(max(quad.a0.z, quad.a1.z), max(quad.b0.z, quad.b1.z));\n (*span).isThin = mayBeThin;\n (*span).wide = linearIn(steps, quad.weightA0.x, quad.weightA1.x, quad.weightB.x);\n (*span).drawn = linearIn(steps, quad.weightA0.y, quad.weightA1.y, quad.weightB.y);\n return area != 0.0;\n}",
  "fn crossingsOf(span : Span, y : f32) -> vec2f {\n let places = span.xs + (y - span.ys) * span.slopes;\n let isAbove = span.ys <= vec4f(y);\n let isMet = isAbove != isAbove.yzwx;\n let from_ = select(vec4f(1e30), places, isMet);\n let to = select(vec4f(-1e30), places, isMet);\n return vec2f(min(min(from_.x, from_.y), min(from_.z, from_.w)), max(max(to.x, to.y), max(to.z, to.w)));\n}",
  "fn spanOf(span : Span, mask : SampleMask, s : u32, row : i32) -> vec2f {\n let place = samplePlace(s) + vec2f(0.0, f32(row));\n let crossings = crossingsOf(span, place.y) - place.x;\n var ends = vec2f(max(ceil(crossings.x), 0.0), min(floor(crossings.y), f32(push_.size.x) - 1.0));\n if (span.isThin) {\n  let turn = (s + samplesPerPixel - mask.first) % samplesPerPixel;\n  let least = (f32(turn + 1u) - mask.threshold) / f32(samplesPerPixel);\n  let keeps = span.wide - least * span.drawn;\n  let atLeft = keeps.x + dot(place - vec2f(span.xs.x, span.ys.x), keeps.yz);\n  let zero = -atLeft / keeps.y;\n  if (keeps.y > 0.0) {\n   ends.x = max(ends.x, ceil(zero));\n  } else {\n   if (keeps.y < 0.0) {\n    ends.y = min(ends.y, floor(zero));\n   } else {\n    if (atLeft < 0.0) {\n     ends.y = -1.0;\n    }\n   }\n  }\n }\n return ends;\n}",
  "const pixelsTogether : u32 = 4u;",
  "fn drawRow(span : Span, blade : u32, seed : u32, row : i32) {\n let mask = sampleMaskOf(seed, samplesPerPixel);\n var spans : array<vec2f, 4>;\n var reach = vec2f(1e30, -1.0);\n for (var s = 0u; s < samplesPerPixel; s++) {\n  spans[s] = spanOf(span, mask, s, row);\n  reach = vec2f(min(reach.x, spans[s].x), max(reach.y, spans[s].y));\n }\n if (reach.x > reach.y) {\n  return;\n }\n var first = sampleIndex(vec2u(u32(reach.x), u32(row)), 0u);\n let depth = span.depth.x + dot(vec2f(reach.x, f32(row)) - vec2f(span.xs.x, span.ys.x), span.depth.yz);\n {\n  var begin = 0.0;\n  loop {\n   if (!(begin <= reach.y - reach.x)) { break; }\n   let here = depth + begin * span.depth.y;\n   var before : array<u32, 16>;\n   for (var i = 0u; i < pixelsTogether; i++) {\n    let pixel = first + i * columnStride();\n    let isTested = begin + f32(i) <= reach.y - reach.x;\n    {\n     if (isTested) {\n      for (var s = 0u; s < samplesPerPixel; s += 2u) {\n       let two = depthsAt(pixel + s);\n       before[i * samplesPerPixel + s] = two.x;\n       before[i * samplesPerPixel + s + 1u] = two.y;\n      }\n     }\n    }\n   }\n   for (var i = 0u; i < pixelsTogether; i++) {\n    for (var s = 0u; s < samplesPerPixel; s++) {\n     let own = clamp(here + dot(samplePlace(s) + vec2f(f32(i), 0.0), span.depth.yz), span.deepest, span.shallowest);\n     let column = reach.x + begin + f32(i);\n     if (column >= spans[s].x && column <= spans[s].y && bitcast<u32>(own) >= before[i * samplesPerPixel + s]) {\n      putOne(first + i * columnStride() + s, own, blade);\n     }\n    }\n   }\n   continuing {\n    begin += f32(pixelsTogether);\n    first += pixelsTogether * columnStride();\n   }\n  }\n }\n}",
  "@group(0) @binding(17) var<storage, read> quads_ : array<vec4f>;",
  "@group(0) @binding(18) var<storage, read> rowBlocks_ : array<u32>;",
  "@compute @workgroup_size(64, 1, 1)\nfn main(@builtin(workgroup_id) WorkGroupID_ : vec3u, @builtin(local_invocation_index) LocalInvocationIndex_ : u32) {\n let place = (WorkGroupID_.y * groupsOfRow + WorkGroupID_.x) * rowBlocksOfGroup + LocalInvocationIndex_ / rowsOfBlock;\n if (place >= min(counters_[countRows], maxRowBlocks)) {\n  return;\n }\n let listed = rowBlocks_[place];\n if (listed == noRowBlock) {\n  return;\n }\n let slot = listed & (maxQuads - 1u);\n let a = quads_[5u * slot];\n let b = quads_[5u * slot + 1u];\n let c = quads_[5u * slot + 2u];\n let d = quads_[5u * slot + 3u];\n let e = quads_[5u * slot + 4u];\n let quad = Quad(a.xyz, b.xyz, c.xyz, d.xyz, vec2f(a.w, b.w), vec2f(c.w, d.w), e.xy);\n let rows = rowsBetween(min(min(a.y, b.y), min(c.y, d.y)), max(max(a.y, b.y), max(c.y, d.y)), f32(push_.size.y));\n let row = rows.x + i32((listed >> quadBits) * rowsOfBlock + LocalInvocationIndex_ % rowsOfBlock);\n var span : Span;\n if (row <= rows.y && spanOfQuad(quad, isThin(quad), &span)) {\n  drawRow(span, bitcast<u32>(e.z), bitcast<u32>(e.w), row);\n }\n}",
  "@group(0) @binding(13) var<storage, read> arguments_ : array<u32>;",
  "const bladeShadowSegments : u32 = 8u;",
  "const samplesPerPixel : u32 = 1u;",
  "fn samplePlace(s : u32) -> vec2f {\n return vec2f(0.5);\n}",
  "fn drawSmall(quad : Quad, mask : SampleMask, blade : u32) {\n let p0 = quad.a0.xy;\n let p1 = quad.a1.xy;\n let p2 = quad.b1.xy;\n let p3 = quad.b0.xy;\n let low = min(min(p0, p1), min(p2, p3));\n let high = max(max(p0, p1), max(p2, p3));\n let edge = vec2f(push_.size);\n let middle = 0.5 * (quad.b0 + quad.b1);\n let across = p1 - p0;\n let along = middle.xy - p0;\n let area = crossOf(across, along);\n if (high.x < 0.0 || high.y < 0.0 || low.x > edge.x || low.y > edge.y || area == 0.0) {\n  return;\n }\n let sStep = vec2f(along.y, -along.x) / area;\n let tStep = vec2f(-across.y, across.x) / area;\n let depthStep = sStep * (quad.a1.z - quad.a0.z) + tStep * (middle.z - quad.a0.z);\n let shallowest = max(max(quad.a0.z, quad.a1.z), max(quad.b0.z, quad.b1.z));\n let deepest = min(min(quad.a0.z, quad.a1.z), min(quad.b0.z, quad.b1.z));\n let mayBeThin = isThin(quad);\n let keepsFirst = quad.weightA0.x - (1.0 - mask.threshold) * quad.weightA0.y;\n let keepsLast = quad.weightB.x - (1.0 - mask.threshold) * quad.weightB.y;\n let sides = sidesOf(p0, p1, p2, p3, area);\n let rows = rowsBetween(low.y, high.y, edge.y);\n for (var row = rows.x; row <= rows.y; row++) {\n  var spans : array<vec2f, 1>;\n  var widest = vec2f(1e30, -1e30);\n  for (var s = 0u; s < samplesPerPixel; s++) {\n   let place = samplePlace(s);\n   let y = f32(row) + place.y;\n   spans[s] = intervalAt(sides, y - p0.y) - place.x;\n   widest = vec2f(min(widest.x, spans[s].x), max(widest.y, spans[s].y));\n  }\n  if (widest.x > widest.y) {\n   continue;\n  }\n  let left = i32(max(ceil(widest.x), 0.0));\n  let right = i32(min(floor(widest.y), edge.x - 1.0));\n  {\n   let corner = vec2f(f32(left), f32(row)) + samplePlace(0u) - p0;\n   var depth = quad.a0.z + dot(corner, depthStep);\n   var t = dot(corner, tStep);\n   for (var column = left; column <= right; column++) {\n    if (keepsFirst + clamp(t, 0.0, 1.0) * (keepsLast - keepsFirst) >= 0.0) {\n     putOne(sampleIndex(vec2u(u32(column), u32(row)), 0u), clamp(depth, deepest, shallowest), blade);\n    }\n    depth += depthStep.x;\n    t += tStep.x;\n   }\n   continue;\n  }\n }\n}",
  "fn drawBlade(lens : Lens, patchIndex : u32, cell : Patch, limit : LeafAreaLimit, i : u32) {\n let index = cell.firstBlade + i;\n var turn = states_[index];\n turn = select(turn, 0u, turn == unsettledTurn);\n let part = posedLook(raised(unpackBlade(blades_[index], cell), limit.height), BladeState(turn, 0.0));\n let size = drawnSize(frameConstants_.view, limit, part.posed.blade, bladeRank(cell, i - min(part.number, i)), length(part.posed.blade.root - frameConstants_.view.eye));\n if (size.widthFactor <= 0.0) {\n  return;\n }\n let margin = 0.5 * outlineMost * part.posed.blade.width * size.widthFactor;\n var outside = false;\n for (var side = 0u; side < 4u; side++) {\n  outside = outside || curveOutside(frameConstants_.view.planes[side], part.posed.v0, part.posed.v1, part.posed.v2, margin);\n }\n if (outside) {\n  return;\n }\n let blade = VisibleBlade(index, patchIndex, packFactors(size.widthFactor, limit.height), size.pixels);\n var ribbon = drawnBlade(blade, part).ribbon;\n ribbon.fold = 0.0;\n ribbon.outline = outlineOf(ribbon.outline.shape, ribbon.outline.tipThreshold, f32(bladeShadowSegments));\n let each = 1.0 / f32(bladeShadowSegments);\n let mask = sampleMaskOf(ribbon.seed, 1u);\n var before = screenSection(seenSection(lens, ribbon, 0.0), false);\n for (var segment = 0u; segment < bladeShadowSegments; segment++) {\n  let after = screenSection(seenSection(lens, ribbon, f32(segment + 1u) * each), false);\n  let whole = halfOf(0u, before, after, false);\n  let isTwisted = !isConvex(whole);\n  for (var half_ = 0u; half_ < select(1u, 2u, isTwisted); half_++) {\n   var quad = whole;\n   if (isTwisted) {\n    quad = triangleBetween(half_, before, after, false, 2u * segment >= bladeShadowSegments);\n   }\n   drawSmall(quad, mask, ribbon.seed);\n  }\n  before = after;\n }\n}",
  "@compute @workgroup_size(64, 1, 1)\nfn main(@builtin(workgroup_id) WorkGroupID_ : vec3u, @builtin(local_invocation_index) LocalInvocationIndex_ : u32) {\n let place = WorkGroupID_.y * groupsOfRow + WorkGroupID_.x;\n if (place >= arguments_[argumentsPatches + 3u]) {\n  return;\n }\n let item = visiblePatches_[place];\n let cell = patches_[item.patchIndex];\n let limit = leafAreaLimitOf(frameConstants_.view, cell);\n let lens = lensOf();\n for (var i = LocalInvocationIndex_; i < item.count; i += 64u) {\n  drawBlade(lens, item.patchIndex, cell, limit, i);\n }\n}",
  "@group(0) @binding(9) var<storage, read_write> seenSamples_ : array<atomic<vec2u>>;",
  "fn putOne(index : u32, depth : f32, blade : u32) {\n atomicStoreMax(&seenSamples_[index], vec2u(push_.firstBlade + blade, bitcast<u32>(depth)));\n}",
  "fn depthAt(index : u32) -> u32 {\n return 0u;\n}",
  "@group(0) @binding(9) var<storage, read_write> seenSamples_ : array<vec2u>;",
  "@group(0) @binding(19) var<storage, read_write> cellBits_ : array<atomic<u32>>;",
  "@group(0) @binding(20) var groundDepth_ : texture_depth_multisampled_2d;",
  "const nearestBits : u32 = 0x3f800000u;",
  "var<workgroup> ofFirst : array<atomic<u32>, 16>;",
  "var<workgroup> ofSecond : atomic<u32>;",
  "fn putCell(level : u32, cell : vec2u, bits : u32) {\n if (level < push_.pyramid.levels) {\n  atomicMin(&cellBits_[push_.pyramid.first[level].x + cell.y * pyramidCells(push_.pyramid.size.x, level) + cell.x], bits);\n }\n}",
  "@compute @workgroup_size(16, 16, 1)\nfn main(@builtin(workgroup_id) WorkGroupID_ : vec3u, @builtin(local_invocation_id) LocalInvocationID_ : vec3u, @builtin(local_invocation_index) LocalInvocationIndex_ : u32, @builtin(global_invocation_id) GlobalInvocationID_ : vec3u) {\n let pixel = GlobalInvocationID_.xy;\n let thread = LocalInvocationIndex_;\n if (thread < 16u) {\n  atomicStore(&ofFirst[thread], nearestBits);\n }\n if (thread == 0u) {\n  atomicStore(&ofSecond, nearestBits);\n }\n workgroupBarrier();\n if (all(pixel < push_.size)) {\n  let first = sampleIndex(pixel, 0u);\n  var farthest = nearestBits;\n  for (var s = 0u; s < samplesPerPixel; s++) {\n   let bits = bitcast<u32>(textureLoad(groundDepth_, vec2i(pixel), i32(s)));\n   seenSamples_[first + s] = vec2u(0u, bits);\n   farthest = min(farthest, bits);\n  }\n  let cell = LocalInvocationID_.xy / 4u;\n  atomicMin(&ofFirst[cell.y * 4u + cell.x], farthest);\n }\n workgroupBarrier();\n if (thread < 16u) {\n  let cell = WorkGroupID_.xy * 4u + vec2u(thread % 4u, thread / 4u);\n  if (all(cell < vec2u(pyramidCells(push_.size.x, 0u), pyramidCells(push_.size.y, 0u)))) {\n   putCell(0u, cell, atomicLoad(&ofFirst[thread]));\n  }\n  atomicMin(&ofSecond, atomicLoad(&ofFirst[thread]));\n }\n workgroupBarrier();\n if (thread > 0u) {\n  return;\n }\n let bits = atomicLoad(&ofSecond);\n for (var level = 1u; level < push_.pyramid.levels; level++) {\n  putCell(level, WorkGroupID_.xy >> vec2u(pyramidFactorBits * (level - 1u)), bits);\n }\n}",
  "const bladeShadowFade : f32 = 0.75;",
  "fn isShaded(texel : vec2u, depth : f32, seed : u32) -> bool {\n return texel.x != seed && bitcast<f32>(texel.y) > depth;\n}",
  "fn sunAmongBlades(shadow : BladeShadow, place : vec3f, seed : u32) -> vec2f {\n if (shadow.size == 0u) {\n  return vec2f(1.0, 0.0);\n }\n let at4 = vec4f(place, 1.0);\n let at = vec2f(dot(shadow.across, at4), dot(shadow.down, at4)) - 0.5;\n let depth = max(dot(shadow.depth, at4) + shadow.nearer, 0.0);\n let edge = 0.5 * f32(shadow.size);\n let off = abs(at + 0.5 - edge) / edge;\n let weight = 1.0 - smoothstep(bladeShadowFade, 1.0, max(off.x, off.y));\n if (weight <= 0.0) {\n  return vec2f(1.0, 0.0);\n }\n let corner = floor(at);\n let f = at - corner;\n let last = shadow.size - 2u;\n let column = min(u32(max(corner.x, 0.0)), last);\n let row = min(u32(max(corner.y, 0.0)), last);\n let first = column * shadow.size + row;\n let lit00 = select(1.0, 0.0, isShaded(map_[first], depth, seed));\n let lit01 = select(1.0, 0.0, isShaded(map_[first + 1u], depth, seed));\n let lit10 = select(1.0, 0.0, isShaded(map_[first + shadow.size], depth, seed));\n let lit11 = select(1.0, 0.0, isShaded(map_[first + shadow.size + 1u], depth, seed));\n return vec2f(mix(mix(lit00, lit01, f.y), mix(lit10, lit11, f.y), f.x), weight);\n}",
  "const heightSteps : u32 = 16u;",
  "const toneBits : u32 = 0x80038000u;",
  "fn unpackGrass(corner : u32) -> vec3f {\n let grass = unpack2x16float(corner & ~toneBits);\n let step_ = ((corner >> 16u) & 3u) | ((corner >> 13u) & 4u) | ((corner >> 28u) & 8u);\n return vec3f(grass.x, grass.y, grass.x * f32(step_) * (1.0 / 15.0));\n}",
  "fn mixGrass(a : u32, b : u32, share : f32) -> vec3f {\n return mix(unpackGrass(a), unpackGrass(b), share);\n}",
  "fn grassAt(cover : Cover, position : vec3f) -> vec3f {\n if (cover.countX == 0u) {\n  return vec3f(0.0);\n }\n let last = vec3f(f32(cover.countX), f32(cover.countY), f32(cover.countZ)) - 1.0;\n let place = clamp((position - cover.low) * cover.cellsPerMetre, vec3f(0.0), last);\n let cell = min(floor(place), last - 1.0);\n let f = place - cell;\n let stepY = cover.countX;\n let stepZ = cover.countX * cover.countY;\n let i = u32(cell.x) + stepY * u32(cell.y) + stepZ * u32(cell.z);\n let j = i + stepZ;\n let near = mix(mixGrass(grass_[i], grass_[i + 1u], f.x), mixGrass(grass_[i + stepY], grass_[i + stepY + 1u], f.x), f.y);\n let far = mix(mixGrass(grass_[j], grass_[j + 1u], f.x), mixGrass(grass_[j + stepY], grass_[j + stepY + 1u], f.x), f.y);\n return mix(near, far, f.z);\n}",
  "fn heightStepsPerMetre(cover : Cover, grass : vec3f) -> f32 {\n return cover.stepsPerMetre * select(1.0, grass.x / grass.y, grass.y > 0.0);\n}",
  "fn leafShareAbove(cover : Cover, steps : f32) -> f32 {\n let at = clamp(steps, 0.0, f32(heightSteps));\n let step_ = min(u32(at), heightSteps - 1u);\n let pair = unpack2x16float(cover.leaves[step_ / 2u].x);\n var low = select(pair.x, 1.0, step_ == 0u);\n var next = pair.y;\n if ((step_ & 1u) != 0u) {\n  low = pair.y;\n  next = select(0.0, unpack2x16float(cover.leaves[step_ / 2u + 1u].x).x, step_ + 1u < heightSteps);\n }\n let root = mix(low, next, at - f32(step_));\n return root * root;\n}",
  "fn leafProjectionOf(cover : Cover) -> f32 {\n return unpack2x16float(cover.leaves[0].x).x;\n}",
  "fn undergrowthBelow(leafArea : f32) -> f32 {\n return 1.0 - exp(-0.65 * leafArea);\n}",
  "fn groundUnder(cover : Cover, bare : vec3f, shade : vec3f, leafArea : f32) -> vec3f {\n return mix(bare, shade * cover.undergrowth, cover.thatch * undergrowthBelow(leafArea));\n}",
  "fn leavesAround(leafArea : f32, thinned : f32) -> f32 {\n return leafArea * max(pow(thinned, -0.22), 0.6);\n}",
  "fn heightWithLeafShare(share : f32) -> f32 {\n return pow(clamp(share, 0.0, 1.0), 2.0 / 3.0);\n}",
  "const lowestSun : f32 = 0.1;",
  "fn leafProjectionAlong(upwards : f32, cosine : f32) -> f32 {\n let beside = 0.637 * sqrt(max(1.0 - 1.9 * upwards * upwards, 0.0));\n let sine = sqrt(max(1.0 - cosine * cosine, 0.0));\n return length(vec2f(upwards * cosine, beside * sine));\n}",
  "const skyExtinction : f32 = 1.2;",
  "fn sunBelow(upwards : f32, leafArea : f32, cosine : f32) -> f32 {\n let risen = max(cosine, lowestSun);\n return exp(-leafProjectionAlong(upwards, risen) * (leafArea / risen));\n}",
  "fn skyBelow(leafArea : f32) -> f32 {\n return exp(-skyExtinction * leafArea);\n}",
  "const cullResultPatch : u32 = 1u;",
  "const cullResultOcclusion : u32 = 5u;",
  "fn distanceFromFootprint(plane : FloorPlane, place : vec3f, across : vec3f) -> f32 {\n let way = place - plane.middle;\n let at = abs(vec2f(dot(way, plane.along), dot(way, across)));\n let beyond = max(at - (plane.halfSides - plane.cornerRadius), vec2f(0.0));\n return max(length(beyond) - plane.cornerRadius, 0.0);\n}",
  "fn skyBesideWall(height : f32, distance_ : f32) -> f32 {\n let slant = sqrt(height * height + distance_ * distance_);\n return select(1.0, 0.5 + 0.5 * distance_ / slant, slant > 0.0);\n}",
  "const shapeQuad : u32 = 1u;",
  "fn isEven(shape : u32) -> bool {\n return shape != shapeQuadratic;\n}",
  "const shadowOffset : f32 = 2.0;",
  "fn sunSeen(shadow : SunShadow, place : vec3f, normal : vec3f) -> f32 {\n if (shadow.size == 0u) {\n  return 1.0;\n }\n let lifted = vec4f(place + normal * (shadowOffset * shadow.texel), 1.0);\n let at = vec2f(dot(shadow.across, lifted), dot(shadow.down, lifted)) - 0.5;\n let depth = dot(shadow.depth, lifted) + shadow.epsilon;\n let f = at - floor(at);\n let last = i32(shadow.size) - 2;\n let column = clamp(i32(floor(at.x)), 0, last);\n let row = clamp(i32(floor(at.y)), 0, last);\n let first = row * i32(shadow.size) + column;\n let below = first + i32(shadow.size);\n let above0 = select(0.0, 1.0, fetch_depths(u32(first)) > depth);\n let above1 = select(0.0, 1.0, fetch_depths(u32(first + 1)) > depth);\n let below0 = select(0.0, 1.0, fetch_depths(u32(below)) > depth);\n let below1 = select(0.0, 1.0, fetch_depths(u32(below + 1)) > depth);\n return 1.0 - mix(mix(above0, above1, f.x), mix(below0, below1, f.x), f.y);\n}",
  "@group(0) @binding(6) var<storage, read> grass_ : array<u32>;",
  "@group(0) @binding(7) var<storage, read> map_ : array<vec2u>;",
  "@group(0) @binding(8) var sunMap_ : texture_depth_2d;",
  "fn fetch_cullResults(i : u32) -> u32 {\n return 0u;\n}",
  "fn fetch_depths(i : u32) -> f32 {\n let size = frameConstants_.shadow.size;\n return textureLoad(sunMap_, vec2i(i32(i % size), i32(i / size)), 0);\n}",
  "const debugNothing : u32 = 0u;",
  "const distanceBands : u32 = 8u;",
  "const debugNear : u32 = 5u;",
  "fn distanceBand(distance_ : f32, farthest : f32) -> u32 {\n let nearest = min(2.0, 0.01 * farthest);\n let share = log2(max(distance_, nearest) / nearest) / log2(farthest / nearest);\n return min(u32(f32(distanceBands) * share), distanceBands - 1u);\n}",
  "struct BladeColors {\n root : vec3f,\n tip : vec3f,\n}",
  "const throughTint : vec3f = vec3f(1.25, 1.15, 0.45);",
  "const throughShare : f32 = 0.8;",
  "fn tipShareAt(along : f32) -> f32 {\n return smoothstep(-0.15, 0.8, along);\n}",
  "fn decodeSrgb(c : vec3f) -> vec3f {\n return select(c / 12.92, pow((c + 0.055) / 1.055, vec3f(2.4)), c > vec3f(0.04045));\n}",
  "fn chance(key : u32) -> f32 {\n return f32(mixUint(key) >> 8u) * (1.0 / 16777215.0);\n}",
  "fn meadowAt(position : vec3f) -> f32 {\n return 0.65 * valueNoise(position / 2.3) + 0.35 * valueNoise(position / 0.7);\n}",
  "fn regionAt(position : vec3f) -> f32 {\n return valueNoise(position / 13.0 + 71.0);\n}",
  "fn shiftOf(hue : f32) -> vec3f {\n return vec3f(1.0 + 0.75 * hue, 1.0 + 0.10 * hue, 1.0 - 0.45 * hue);\n}",
  "fn clumpTone(clump : u32) -> f32 {\n return chance(clump * 977u + 11u);\n}",
  "fn bladeColors(cover : Cover, blade : Blade, species : Species, leafArea : f32) -> BladeColors {\n let clump = clumpTone(blade.clump);\n let kept = u32(blade.facing * (256.0 / twoPi) + 0.5) | (u32(blade.stiffness * 63.0 + 0.5) << 8u) | (u32(blade.tint.y * 63.0 + 0.5) << 14u) | (blade.clump << 20u);\n let single = chance(kept * 16u + blade.hash);\n let other = chance(kept * 16u + blade.hash + 0x9e3779b9u);\n let meadow = meadowAt(blade.root);\n let region = regionAt(blade.root);\n let amount = species.colorVariation;\n let light = 1.0 + amount * (0.9 * (single - 0.5) + 0.6 * (clump - 0.5) + 0.5 * (meadow - 0.5) + 0.4 * (region - 0.5));\n let hue = amount * (0.7 * (clump - 0.5) + 0.5 * (other - 0.5) + 1.1 * (meadow - 0.5) + 1.2 * (region - 0.5));\n let shift = shiftOf(hue);\n var colors : BladeColors;\n let ground = groundUnder(cover, decodeSrgb(blade.tint), shift, cover.thinned * leafArea);\n colors.root = mix(species.rootColor * shift, ground, species.groundTint) * light;\n colors.tip = species.tipColor * shift * light;\n let dead = select(0.0, 1.0, blade.clump == driedClump);\n let dry = max(smoothstep(0.0, 0.25, species.dryness * (0.6 + 0.8 * meadow) - other), dead);\n let straw = vec3f(0.42, 0.32, 0.13) * (0.7 + 0.6 * single);\n colors.tip = mix(colors.tip, straw, 0.8 * dry);\n colors.root = mix(colors.root, straw * 0.6, 0.25 * dry + 0.3 * dead);\n return colors;\n}",
  "fn filmOf(exposed : vec3f) -> vec3f {\n let x = exposed * 0.80;\n let film = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);\n return clamp(film, vec3f(0.0), vec3f(1.0));\n}",
  "const knownDebugMode : u32 = 0u;",
  "fn debugMode() -> u32 {\n return knownDebugMode;\n}",
  "fn showsBands() -> bool {\n return debugMode() >= debugNear;\n}",
  "fn paleSky(sunCosine : f32) -> vec3f {\n let towards = 0.5 + 0.5 * sunCosine;\n let pale = mix(vec3f(1.12, 1.02, 0.90), vec3f(1.36, 1.12, 0.96), frameConstants_.lowSun);\n return frameConstants_.skyColor * mix(pale, vec3f(2.50, 1.45, 0.66), frameConstants_.lowSun * towards * towards);\n}",
  "fn glowAround(sunCosine : f32) -> vec3f {\n let toSun = max(sunCosine, 0.0);\n let glow = 0.10 * pow(toSun, 4.0) + 0.22 * pow(toSun, 32.0) + 0.5 * pow(toSun, 400.0);\n return glow * frameConstants_.sunColor * mix(vec3f(0.36, 0.34, 0.31), vec3f(0.45, 0.33, 0.22), frameConstants_.lowSun);\n}",
  "fn skyAbove(height : f32, sunCosine : f32) -> vec3f {\n let zenith = frameConstants_.skyColor * vec3f(0.15, 0.30, 0.56);\n return mix(paleSky(sunCosine), zenith, 1.0 - exp(-4.0 * height)) + glowAround(sunCosine);\n}",
  "fn skyRadiance(ray : vec3f) -> vec3f {\n let height = dot(ray, frameConstants_.skyUp);\n let sunCosine = dot(ray, frameConstants_.sunDirection);\n if (height >= 0.0) {\n  return skyAbove(height, sunCosine);\n }\n let pale = paleSky(sunCosine);\n let haze = mix(0.85 * pale, frameConstants_.groundColor, 0.2);\n return mix(pale, haze, 1.0 - exp(2.2 * height)) + glowAround(sunCosine);\n}",
  "fn hemisphere(n : vec3f) -> vec3f {\n return mix(frameConstants_.groundColor, 1.25 * frameConstants_.skyColor, 0.5 + 0.5 * dot(n, frameConstants_.skyUp));\n}",
  "const passedAgain : f32 = 0.5;",
  "fn lightAmongLeaves(leafArea : f32, below : f32, cosine : f32, sun : vec3f, sky : vec3f, leaf : vec3f) -> vec3f {\n let risen = max(cosine, lowestSun);\n let crossed = leafProjectionAlong(leafProjectionOf(frameConstants_.cover), risen) / risen;\n let left = exp(-crossed * leafArea);\n let open = skyBelow(leafArea);\n let leftAbove = select(1.0, (1.0 - left) / (crossed * leafArea), leafArea > 1e-3);\n let openAbove = select(1.0, (1.0 - open) / (skyExtinction * leafArea), leafArea > 1e-3);\n let leaves = 1.0 - open;\n let sunOfLeaves = leaves * leftAbove + below * left / (1.0 + crossed / skyExtinction);\n let skyOfLeaves = leaves * openAbove + below * open * 0.5;\n let once = 0.25 * leaf * (sun * (crossed * risen * sunOfLeaves) + sky * skyOfLeaves);\n return once / (1.0 - passedAgain * leaf);\n}",
  "fn clearBetween(climb : f32, distance_ : f32) -> f32 {\n let rise = frameConstants_.fogFalloff * distance_ * climb;\n let mean = select(1.0 - 0.5 * rise, (1.0 - exp(-rise)) / rise, abs(rise) > 1e-3);\n return exp(-frameConstants_.fogDensity * distance_ * mean);\n}",
  "fn throughAir(color : vec3f, direction : vec3f, distance_ : f32) -> vec3f {\n let climb = dot(direction, frameConstants_.skyUp);\n let perLength = inverseSqrt(max(1.0 - climb * climb, 0.0) + 0.02 * 0.02);\n let sunCosine = dot(direction, frameConstants_.sunDirection) - (climb - 0.02) * dot(frameConstants_.skyUp, frameConstants_.sunDirection);\n return mix(skyAbove(0.02 * perLength, sunCosine * perLength), color, clearBetween(climb, distance_));\n}",
  "fn develop(radiance : vec3f) -> vec3f {\n return filmOf(radiance * frameConstants_.exposure);\n}",
  "fn softness(distance_ : f32, share : f32) -> f32 {\n if (frameConstants_.view.minWidth <= 0.0 || debugMode() != debugNothing) {\n  return 0.0;\n }\n let widthPixels = frameConstants_.view.lodWidth * frameConstants_.view.pixelsPerUnit / max(distance_, 1e-6);\n return share * (1.0 - smoothstep(0.6, 1.5, widthPixels));\n}",
  "fn dithered(color : vec3f, place : vec2f) -> vec3f {\n let h = mixUint(u32(place.x) + 65536u * u32(place.y));\n let noise = f32(h >> 8u) * (1.0 / 16777215.0) - 0.5;\n return color + noise * (2.2 / 255.0) * pow(max(color, vec3f(0.0)), vec3f(0.5454));\n}",
  "fn colorOf(number : u32) -> vec3f {\n let h = mixUint(number * 2654435761u + 12345u);\n return 0.15 + 0.85 * vec3f(f32(h & 255u), f32((h >> 8u) & 255u), f32((h >> 16u) & 255u)) / 255.0;\n}",
  "struct BladeSurface {\n root : vec4f,\n tip : vec4f,\n material : vec4f,\n}",
  "fn packedLook(look : vec3f) -> f32 {\n let bytes = floor(clamp(look, vec3f(0.0), vec3f(1.0)) * 255.0 + 0.5);\n return dot(bytes, vec3f(65536.0, 256.0, 1.0));\n}",
  "fn unpackedLook(packed : f32) -> vec3f {\n let bits = u32(packed);\n return vec3f(vec3u(bits >> 16u, bits >> 8u, bits) & vec3u(255u)) / 255.0;\n}",
  "fn packedHeights(steps : vec3f) -> f32 {\n return packedLook(steps / f32(heightSteps));\n}",
  "fn leafAreaAbove(material : vec4f, along : f32) -> f32 {\n let steps = f32(heightSteps) * unpackedLook(material.z);\n let height = mix(mix(steps.x, steps.y, along), mix(steps.y, steps.z, along), along);\n return material.y * leafShareAbove(frameConstants_.cover, height);\n}",
  "fn packedFinish(finish : u32, pixels : f32) -> f32 {\n return floor(clamp(pixels * 4.0, 0.0, 255.0) + 0.5) + 256.0 * f32(finish);\n}",
  "fn finishIn(packed : f32) -> u32 {\n return u32(packed) >> 8u;\n}",
  "fn pixelsIn(packed : f32) -> f32 {\n return 0.25 * f32(u32(packed) & 255u);\n}",
  "fn fleckLength() -> f32 {\n return 1.5 / max(frameConstants_.cover.stepsPerMetre, 1e-6);\n}",
  "fn fleckCount(length_ : f32) -> f32 {\n return clamp(floor(length_ / fleckLength() + 0.5), 1.0, 255.0);\n}",
  "const finishGrass : u32 = 0u;",
  "const finishBroad : u32 = 1u;",
  "const finishPetal : u32 = 2u;",
  "const finishStalk : u32 = 3u;",
  "const finishPlain : u32 = 4u;",
  "fn finishOf(look : Species) -> u32 {\n if (look.shape == shapeQuad) {\n  return finishStalk;\n }\n if (look.shape != shapeLeaf && look.shape != shapeDandelion) {\n  return finishGrass;\n }\n return select(finishPetal, finishBroad, look.tipColor.y > max(look.tipColor.x, look.tipColor.z));\n}",
  "fn finishDice(seed : u32) -> f32 {\n return f32(seed & 255u) * (1.0 / 255.0);\n}",
  "fn endWave(away : f32, falls : f32) -> f32 {\n let rest = max(1.0 - away, 0.0);\n return rest * rest * (1.0 - falls * away);\n}",
  "fn toneAlong(finish : u32, along : f32, seed : u32) -> vec3f {\n if (finish == finishBroad || finish == finishPlain) {\n  return vec3f(1.0);\n }\n if (finish == finishPetal) {\n  return vec3f(1.0) - endWave(min(along * (1.0 / 0.6), 1.0), 2.5) * vec3f(0.12, 0.22, 0.42);\n }\n let tone = vec3f(1.0) + endWave(min(along * 2.5, 1.0), 4.0) * vec3f(0.75, 0.3, 0.55);\n if (finish == finishStalk) {\n  return tone;\n }\n let dry = smoothstep(0.3, 1.0, finishDice(seed));\n return tone + dry * endWave(min(2.2 - 2.2 * along, 1.0), 2.5) * vec3f(0.12, -0.2, -0.35);\n}",
  "struct Veins {\n tone : vec3f,\n slope : f32,\n}",
  "fn midribAt(x : f32, reach : f32) -> f32 {\n let off = x / reach;\n let rest = max(1.0 - off * off, 0.0);\n return rest * rest - 8.0 / 15.0 * reach;\n}",
  "fn shareSeen(spacing : f32) -> f32 {\n return smoothstep(2.5, 5.0, spacing);\n}",
  "const halfWave : f32 = 3.14159265;",
  "fn veinsAt(finish : u32, place : vec2f, pixels : f32, seed : u32) -> Veins {\n let x = place.x;\n let t = place.y;\n var veins : Veins;\n veins.tone = vec3f(1.0);\n veins.slope = 0.0;\n let wide = select(pixels * min(1.0, select(4.0 * t * (1.0 - t), 2.0 - 2.0 * t, finish == finishGrass)), pixels, finish == finishStalk);\n let ridge = shareSeen(0.6 * wide);\n let phase = 40.0 * finishDice(seed);\n if (finish == finishGrass) {\n  let few = shareSeen(wide / 7.0);\n  let many = shareSeen(wide / 17.0);\n  let a = 7.0 * halfWave * x + phase;\n  let b = 17.0 * halfWave * x + 2.0 * phase;\n  veins.tone += ridge * midribAt(x, 0.16) * vec3f(0.45, 0.36, 0.8) + 0.09 * few * cos(a) + 0.07 * many * cos(b);\n  veins.slope = 0.16 * few * sin(a) + 0.14 * many * sin(b);\n } else {\n  if (finish == finishBroad) {\n   let a = 2.0 * halfWave * (7.0 * t - abs(x)) + phase;\n   let side = shareSeen(0.3 * wide);\n   veins.tone += ridge * midribAt(x, 0.1) * vec3f(0.5, 0.42, 0.7) + side * (0.1 * cos(a) + 0.06 * cos(2.0 * a) + 0.03 * cos(3.0 * a));\n   veins.slope = 0.12 * side * sin(a) * sign(x);\n  } else {\n   if (finish == finishPetal) {\n    let a = 5.0 * halfWave * x + phase;\n    let b = 13.0 * halfWave * x + 2.0 * phase;\n    let few = shareSeen(wide / 5.0);\n    let many = shareSeen(wide / 13.0);\n    veins.tone += 0.07 * few * cos(a) + 0.08 * (1.0 - 0.5 * t) * many * cos(b);\n    veins.slope = 0.3 * few * sin(a) + 0.15 * many * sin(b);\n   } else {\n    if (finish == finishStalk) {\n     let a = 4.0 * halfWave * x + phase;\n     let few = shareSeen(0.4 * wide);\n     veins.tone += 0.1 * few * cos(a);\n     veins.slope = 0.12 * few * sin(a);\n    }\n   }\n  }\n }\n return veins;\n}",
  "const roughnessAcross : f32 = 0.46;",
  "const roughnessAlong : f32 = 0.18;",
  "const mirroredHeadOn : f32 = 0.019;",
  "fn coatShine(normal : vec3f, tangent : vec3f, source : vec3f, eye : vec3f) -> f32 {\n let facing = dot(normal, source);\n let sum = source + eye;\n let along = dot(sum, tangent);\n let up = dot(sum, normal);\n if (facing <= 0.0 || up <= 0.0) {\n  return 0.0;\n }\n let square = dot(sum, sum);\n let across = max(square - up * up - along * along, 0.0);\n let depth = max(up * up, 0.0625);\n let slopes = (along * along * (1.0 / (roughnessAlong * roughnessAlong)) + across * (1.0 / (roughnessAcross * roughnessAcross))) / depth;\n let grazing = max(1.0 - 0.5 * sqrt(square), 0.0);\n let twice = grazing * grazing;\n let fresnel = mirroredHeadOn + (1.0 - mirroredHeadOn) * twice * twice * grazing;\n return facing * fresnel * exp(-slopes) * square / (roughnessAcross * roughnessAlong * depth * depth);\n}",
  "fn coatAlbedo(cosine : f32) -> f32 {\n let grazing = 1.0 - clamp(cosine, 0.1, 1.0);\n let twice = grazing * grazing;\n return 0.017 + 0.3 * twice * twice;\n}",
  "struct BladePoint {\n position : vec3f,\n tangent : vec3f,\n axis : vec3f,\n up : vec3f,\n fold : f32,\n place : vec2f,\n rootColor : vec4f,\n tipColor : vec4f,\n look : vec3f,\n leafAbove : f32,\n leafBelow : f32,\n seed : u32,\n flecks : f32,\n finish : f32,\n}",
  "fn bladeNormal(point : BladePoint, toEye : vec3f, distance_ : f32) -> vec3f {\n let flat_ = cross(point.tangent, point.axis);\n let size = length(flat_);\n var n = select(point.up, flat_ / size, size > 1e-3);\n if (point.fold > 0.0) {\n  n += point.fold * sign(point.place.x) * point.axis;\n }\n n *= select(1.0, -1.0, dot(n, toEye) < 0.0);\n let smallness = smoothstep(4.0, 60.0, distance_ * 1000.0 / frameConstants_.view.pixelsPerUnit);\n let roundness = select(0.55, 1.4, finishIn(point.finish) == finishStalk);\n return normalize(n + roundness * (1.0 - point.fold) * (1.0 - smallness) * point.place.x * point.axis);\n}",
  "struct Scattering {\n facing : f32,\n diffuse : f32,\n through : f32,\n}",
  "fn scatteringOf(source : vec3f, n : vec3f) -> Scattering {\n var scattering : Scattering;\n scattering.facing = dot(n, source);\n scattering.diffuse = max((scattering.facing + 0.15) / 1.3225, 0.0);\n scattering.through = max(-scattering.facing, 0.0);\n return scattering;\n}",
  "fn throughBlade(translucency : f32) -> vec3f {\n return throughShare * translucency * throughTint;\n}",
  "struct Incoming {\n around : vec3f,\n behind : vec3f,\n above : vec3f,\n mirrored : vec3f,\n sun : vec3f,\n}",
  "fn incomingFromSky(n : vec3f, open : vec2f) -> Incoming {\n let sky = 1.25 * open.x * frameConstants_.skyColor;\n let ground = open.y * frameConstants_.groundColor;\n let up = 0.5 + 0.5 * dot(n, frameConstants_.skyUp);\n return Incoming(mix(ground, sky, up), mix(sky, ground, up), 1.25 * frameConstants_.skyColor, frameConstants_.skyColor, frameConstants_.sunColor);\n}",
  "fn incomingAt(position : vec3f, up : vec3f, n : vec3f, open : vec2f) -> Incoming {\n return incomingFromSky(n, open);\n}",
  "const fleckEdge : f32 = 0.15;",
  "fn fleckAt(key : u32, mean : f32) -> f32 {\n let chance = f32(mixUint(key) >> 8u) * (1.0 / 16777216.0);\n return clamp((mean - chance) / (2.0 * fleckEdge) + 0.5, 0.0, 1.0);\n}",
  "fn fleckOf(point : BladePoint, mean : f32, distance_ : f32) -> f32 {\n let pixels = frameConstants_.view.pixelsPerUnit * fleckLength() / distance_;\n let seen = smoothstep(1.0, 4.0, pixels);\n if (seen <= 0.0) {\n  return mean;\n }\n let at = point.place.y * point.flecks + f32(point.seed & 255u) * (1.0 / 256.0);\n let key = point.seed + u32(at) * 0x9e3779b9u;\n let fleck = mix(fleckAt(key, mean), fleckAt(key + 0x9e3779b9u, mean), smoothstep(0.25, 0.75, fract(at)));\n return mix(mean, fleck, seen);\n}",
  "struct LitPoint {\n normal : vec3f,\n albedo : vec3f,\n risen : f32,\n sunlit : f32,\n}",
  "fn litPoint(point : BladePoint, toEye : vec3f, distance_ : f32) -> LitPoint {\n let along = point.place.y;\n var n = bladeNormal(point, toEye, distance_);\n let finish = finishIn(point.finish);\n var albedo = mix(point.rootColor.rgb, point.tipColor.rgb, tipShareAt(along));\n let isPlain = debugMode() != debugNothing;\n if (!isPlain) {\n  albedo *= toneAlong(finish, along, point.seed);\n }\n let turned = dot(toEye, point.axis);\n let wide = pixelsIn(point.finish) * sqrt(max(1.0 - turned * turned, 0.0));\n if (!isPlain && wide > 4.0) {\n  let veins = veinsAt(finish, point.place, wide, point.seed);\n  albedo *= veins.tone;\n  n = normalize(n + veins.slope * point.axis);\n }\n let risen = mix(point.rootColor.w, point.tipColor.w, along);\n let among = sunAmongBlades(frameConstants_.bladeShadow, point.position, point.seed);\n var passed = among.x;\n if (among.y < 1.0) {\n  passed = mix(fleckOf(point, sunBelow(leafProjectionOf(frameConstants_.cover), point.leafAbove, dot(point.up, frameConstants_.sunDirection)), distance_), passed, among.y);\n }\n return LitPoint(n, albedo, risen, point.look.x * risen * passed);\n}",
  "fn ontoBlade(point_in : BladePoint) -> BladePoint {\n var point = point_in;\n point.place = clamp(point.place, vec2f(-1.0, 0.0), vec2f(1.0));\n return point;\n}",
  "fn bladePicture(point_in : BladePoint) -> vec3f {\n var point = point_in;\n point = ontoBlade(point);\n let along = point.place.y;\n let openSky = point.look.x;\n let translucency = point.look.y;\n let gloss = point.look.z;\n let sun = frameConstants_.sunDirection;\n let ray = frameConstants_.view.eye - point.position;\n let distance_ = length(ray);\n if (showsBands()) {\n  let band = distanceBand(distance_, frameConstants_.view.drawDistance);\n  let channel = band - 3u * (debugMode() - debugNear);\n  return vec3f(f32(channel == 0u), f32(channel == 1u), f32(channel == 2u));\n }\n let toEye = ray / max(distance_, 1e-6);\n let lit = litPoint(point, toEye, distance_);\n let n = lit.normal;\n let albedo = lit.albedo;\n let risen = lit.risen;\n let sunlit = lit.sunlit;\n let leafArea = point.leafAbove;\n let upright = dot(point.up, sun);\n let openBelow = skyBelow(point.leafBelow);\n let openAbove = openSky * skyBelow(leafArea);\n let incoming = incomingAt(point.position, point.up, n, vec2f(openAbove, openSky * openBelow));\n let through = throughBlade(translucency);\n var light = incoming.around + through * incoming.behind + openSky * (1.0 + through) * lightAmongLeaves(leafArea, 1.0 - openBelow, upright, risen * incoming.sun, incoming.above, albedo * (1.0 + through));\n let scattering = scatteringOf(sun, n);\n light += incoming.sun * (sunlit * (scattering.diffuse + through * scattering.through));\n var color = albedo * light;\n let coat = gloss * along;\n if (coat > 0.0) {\n  let towards = dot(n, toEye);\n  let mirrored = coat * coatAlbedo(towards);\n  let upwards = 0.5 + towards * dot(n, frameConstants_.skyUp) - 0.5 * dot(toEye, frameConstants_.skyUp);\n  color += mirrored * (openAbove * upwards * incoming.mirrored - color);\n  color += coat * sunlit * coatShine(n, point.tangent, sun, toEye) * incoming.sun;\n }\n if (debugMode() != debugNothing) {\n  color = albedo * (0.25 + 0.75 * along) * (0.6 + 0.4 * max(scattering.facing, 0.0));\n } else {\n  color = throughAir(color, -toEye, distance_);\n }\n return develop(color);\n}",
  "const debugReason : u32 = 4u;",
  "fn cullResultColor(cullResult : u32) -> vec3f {\n if (cullResult == cullResultDrawn) {\n  return vec3f(0.06, 0.34, 0.12);\n }\n if (cullResult == cullResultPatch) {\n  return vec3f(0.30, 0.30, 0.33);\n }\n if (cullResult == cullResultOrientation) {\n  return vec3f(0.86, 0.77, 0.05);\n }\n if (cullResult == cullResultFrustum) {\n  return vec3f(0.66, 0.11, 0.01);\n }\n if (cullResult == cullResultDistance) {\n  return vec3f(0.02, 0.17, 0.45);\n }\n if (cullResult == cullResultOcclusion) {\n  return vec3f(0.60, 0.19, 0.38);\n }\n return vec3f(0.09, 0.46, 0.81);\n}",
  "fn liftedSurface(surface_in : BladeSurface, above : f32) -> BladeSurface {\n var surface = surface_in;\n let root = 1.0 - heightWithLeafShare(above);\n surface.root = vec4f(mix(surface.root.rgb, surface.tip.rgb, tipShareAt(root)), mix(surface.root.w, surface.tip.w, root));\n surface.material.y *= above;\n return surface;\n}",
  "fn bladeSurface(drawn : DrawnBlade, visible : VisibleBlade, limit : LeafAreaLimit) -> BladeSurface {\n let blade = drawn.blade;\n let species = drawn.species;\n let grass = grassAt(frameConstants_.cover, blade.root);\n let leafArea = grass.x;\n var colors = bladeColors(frameConstants_.cover, blade, species, leafArea);\n if (debugMode() == 1u) {\n  colors.tip = mix(vec3f(0.1, 0.6, 0.1), vec3f(1.0, 0.1, 0.0), clamp(log2(max(widthFactorOf(visible), 1.0)) / 4.0, 0.0, 1.0));\n } else {\n  if (debugMode() == 2u) {\n   colors.tip = colorOf(visible.patchIndex);\n  } else {\n   if (debugMode() == debugReason) {\n    colors.tip = cullResultColor(fetch_cullResults(placeOf(vec2u(), visible.blade)));\n   }\n  }\n }\n if (debugMode() != debugNothing) {\n  colors.root = 0.4 * colors.tip;\n }\n let risen = smoothstep(-0.15, 0.25, dot(blade.up, frameConstants_.sunDirection));\n var surface : BladeSurface;\n surface.root = vec4f(colors.root, risen * sunSeen(frameConstants_.shadow, drawn.ribbon.v0, blade.up));\n surface.tip = vec4f(colors.tip, risen * sunSeen(frameConstants_.shadow, drawn.ribbon.v2, blade.up));\n let heights = vec3f(dot(drawn.ribbon.v0 - blade.root, blade.up), dot(drawn.ribbon.v1 - blade.root, blade.up), dot(drawn.ribbon.v2 - blade.root, blade.up));\n let missing = leavesPerDrawn(frameConstants_.view, distance(blade.root, frameConstants_.view.eye));\n surface.material = vec4f(packedLook(vec3f(blade.exposure, species.translucency, species.gloss)), leavesAround(leafArea / missing, frameConstants_.cover.thinned * missing), packedHeights(heightStepsPerMetre(frameConstants_.cover, grass) / heightFactorOf(visible) * heights), packedFinish(finishOf(species), visible.pixels * drawn.ribbon.width / blade.height));\n var t1_ : BladeSurface;\n if (limit.light < 1.0) {\n  t1_ = liftedSurface(surface, limit.light);\n } else {\n  t1_ = surface;\n }\n return t1_;\n}",
  "struct SeenBlade {\n ribbon : Ribbon,\n surface : BladeSurface,\n blade : u32,\n patchIndex : u32,\n hasHistory : bool,\n}",
  "struct SeenPoint {\n shares : vec3f,\n depth : f32,\n least : f32,\n}",
  "fn seenAt(a : vec4f, b : vec4f, c : vec4f, place : vec2f) -> SeenPoint {\n let p = a.xy - place * a.w;\n let q = b.xy - place * b.w;\n let r = c.xy - place * c.w;\n let areas = vec3f(q.x * r.y - q.y * r.x, r.x * p.y - r.y * p.x, p.x * q.y - p.y * q.x);\n let sum = areas.x + areas.y + areas.z;\n var seen : SeenPoint;\n seen.shares = select(vec3f(0.0), areas / sum, sum != 0.0);\n let w = dot(seen.shares, vec3f(a.w, b.w, c.w));\n seen.depth = select(0.0, dot(seen.shares, vec3f(a.z, b.z, c.z)) / w, w > 0.0);\n seen.least = select(-1e9, min(min(seen.shares.x, seen.shares.y), seen.shares.z), w > 0.0 && sum != 0.0);\n return seen;\n}",
  "fn rayThrough(place : vec2f) -> vec3f {\n return place.x * frameConstants_.rays[0] + (place.y * frameConstants_.rays[1] + frameConstants_.rays[2]);\n}",
  "struct Corner {\n seen : vec4f,\n place : vec2f,\n}",
  "struct Found {\n point : vec3f,\n place : vec2f,\n}",
  "struct Guess {\n error : f32,\n depth : f32,\n place : vec2f,\n}",
  "struct Sighting {\n pixel : vec2f,\n depth : f32,\n middle : vec2f,\n}",
  "const foundError : f32 = 0.02;",
  "fn errorOf(seen : SeenPoint, sighting : Sighting) -> f32 {\n return max(-seen.least, 0.0) + abs(seen.depth / sighting.depth - 1.0);\n}",
  "fn sharesInMiddle(first : vec4f, second : vec4f, third : vec4f, seen : SeenPoint, sighting : Sighting) -> vec3f {\n let inside = max(seenAt(first, second, third, sighting.middle).shares, vec3f(0.0));\n return inside / max(inside.x + inside.y + inside.z, 1e-6);\n}",
  "fn depthOf(first : vec4f, second : vec4f, third : vec4f, shares : vec3f) -> f32 {\n return dot(shares, vec3f(first.z, second.z, third.z)) / dot(shares, vec3f(first.w, second.w, third.w));\n}",
  "fn lookAtHalves(lens : Lens, ribbon : Ribbon, low : f32, high : f32, isUpper : bool, sighting : Sighting, guess : ptr<function, Guess>) {\n let before = seenSection(lens, ribbon, low);\n let after = seenSection(lens, ribbon, high);\n let left = Corner(before.left, vec2f(-1.0, low));\n let right = Corner(before.right, vec2f(1.0, low));\n let ridge = Corner(before.ridge, vec2f(0.0, low));\n let leftAfter = Corner(after.left, vec2f(-1.0, high));\n let rightAfter = Corner(after.right, vec2f(1.0, high));\n let ridgeAfter = Corner(after.ridge, vec2f(0.0, high));\n for (var i = 0u; i < trianglesOf(true); i++) {\n  let part = triangleOf(i, true, isUpper);\n  var t1_ : Corner;\n  if (part.isRight) {\n   t1_ = ridge;\n  } else {\n   t1_ = left;\n  }\n  let a = t1_;\n  var t2_ : Corner;\n  if (part.endsAtRidge) {\n   t2_ = ridge;\n  } else {\n   t2_ = right;\n  }\n  let b = t2_;\n  var t3_ : Corner;\n  if (part.isRight) {\n   t3_ = ridgeAfter;\n  } else {\n   t3_ = leftAfter;\n  }\n  let c = t3_;\n  var t4_ : Corner;\n  if (part.endsAtRidge) {\n   t4_ = ridgeAfter;\n  } else {\n   t4_ = rightAfter;\n  }\n  let d = t4_;\n  var t5_ : Corner;\n  if (part.beginsRight) {\n   t5_ = b;\n  } else {\n   t5_ = a;\n  }\n  let first = t5_;\n  var t6_ : Corner;\n  if (part.isSecond) {\n   t6_ = d;\n  } else {\n   t6_ = b;\n  }\n  let second = t6_;\n  var t7_ : Corner;\n  if (part.endsLeft) {\n   t7_ = c;\n  } else {\n   t7_ = d;\n  }\n  let third = t7_;\n  let seen = seenAt(first.seen, second.seen, third.seen, sighting.pixel);\n  let error = errorOf(seen, sighting);\n  if (error >= (*guess).error) {\n   continue;\n  }\n  let shares = sharesInMiddle(first.seen, second.seen, third.seen, seen, sighting);\n  (*guess).error = error;\n  (*guess).depth = depthOf(first.seen, second.seen, third.seen, shares);\n  (*guess).place = shares.x * first.place + shares.y * second.place + shares.z * third.place;\n }\n}",
  "struct Curve {\n toMiddle : vec3f,\n bend : vec3f,\n}",
  "fn curveOf(ribbon : Ribbon) -> Curve {\n let toMiddle = 2.0 * (ribbon.v1 - ribbon.v0);\n let bend = ribbon.v2 - ribbon.v0 - toMiddle;\n return Curve(toMiddle, bend);\n}",
  "fn tangentOf_2(curve : Curve, t : f32) -> vec3f {\n let along = curve.toMiddle + 2.0 * t * curve.bend;\n return normalize(select(curve.toMiddle, along, dot(along, along) > 1e-18));\n}",
  "fn placeAlong(ribbon : Ribbon, curve : Curve, point : vec3f) -> f32 {\n let upwards = curve.toMiddle;\n let forwards = cross(upwards, ribbon.axis);\n let toPoint = point - ribbon.v0;\n let rise = dot(upwards, upwards);\n let bend = vec2f(dot(curve.bend, upwards), dot(curve.bend, forwards));\n let tip = bend + vec2f(rise, 0.0);\n let p = vec2f(dot(toPoint, upwards), dot(toPoint, forwards));\n var t = clamp(dot(p, tip) / max(dot(tip, tip), 1e-30), 0.0, 1.0);\n for (var i = 0u; i < 2u; i++) {\n  let half_ = vec2f(rise, 0.0) + t * bend;\n  let off = t * half_ - p;\n  let speed = half_ + t * bend;\n  t = clamp(t - dot(off, speed) / max(dot(speed, speed), 1e-30), 0.0, 1.0);\n }\n return t;\n}",
  "fn rayTo(lens : Lens, pixel : vec2f) -> vec3f {\n return rayThrough(2.0 * pixel / lens.size - 1.0);\n}",
  "fn pointSeen(lens : Lens, ray : vec3f, depth : f32) -> vec3f {\n let depthRow = vec3f(lens.viewProjection[0].z, lens.viewProjection[1].z, lens.viewProjection[2].z);\n return lens.eye + frameConstants_.depthOfEye / (depth - dot(depthRow, ray)) * ray;\n}",
  "fn findOnFold(lens : Lens, ribbon : Ribbon, sighting : Sighting) -> Found {\n var guess : Guess;\n guess.error = 1e30;\n let segments = ribbon.outline.segments;\n let point = pointSeen(lens, rayTo(lens, sighting.pixel), sighting.depth);\n var t1_ : f32;\n if (segments > 1.5) {\n  t1_ = placeAlong(ribbon, curveOf(ribbon), point);\n } else {\n  t1_ = 0.0;\n }\n let place = t1_;\n var segment = clamp(floor(place * segments) + 1.0, 1.0, segments);\n var step_ = select(1.0, -1.0, fract(place * segments) < 0.5);\n for (var turn = 0.0; turn < 2.0 * segments; turn += 1.0) {\n  if (segment >= 1.0 && segment <= segments) {\n   lookAtHalves(lens, ribbon, (segment - 1.0) / segments, segment / segments, upperHalf(segment, segments), sighting, &guess);\n  }\n  if (guess.error < foundError || segments < 1.5) {\n   break;\n  }\n  segment += step_;\n  step_ = -step_ - sign(step_);\n }\n return Found(pointSeen(lens, rayTo(lens, sighting.middle), guess.depth), guess.place);\n}",
  "fn placeAcross(toLeft : f32, toRight : f32, widths : vec2f, share : f32, isUpper : bool) -> f32 {\n let isFirst = select(toRight, toLeft, isUpper) <= widths.x * (1.0 - share);\n let width = max(select(widths.y, widths.x, isFirst), 1e-6);\n return select(1.0 - 2.0 * toRight / width, 2.0 * toLeft / width - 1.0, isFirst == isUpper);\n}",
  "fn findOnPlane(lens : Lens, ribbon : Ribbon, sighting : Sighting) -> Found {\n let segments = ribbon.outline.segments;\n let point = pointSeen(lens, rayTo(lens, sighting.pixel), sighting.depth);\n let curve = curveOf(ribbon);\n let guess = placeAlong(ribbon, curve, point) * segments;\n let segment = min(floor(guess), segments - 1.0);\n let each = 1.0 / segments;\n let low = segment * each;\n let high = low + each;\n let begin = ribbon.v0 + low * (curve.toMiddle + low * curve.bend);\n let chord = each * (curve.toMiddle + (low + high) * curve.bend);\n let ray = rayTo(lens, sighting.middle);\n let side = cross(ray, chord);\n let square = dot(side, side);\n let isAtEye = square <= 1e-12 * dot(ray, ray) * dot(chord, chord);\n var across = select(side * inverseSqrt(square), ribbon.axis, isAtEye);\n let seen = dot(ribbon.axis, across);\n across = select(across, -across, seen < 0.0);\n let first = ribbon.width * edgesAt(ribbon.outline, low);\n let second = ribbon.width * edgesAt(ribbon.outline, high);\n let ends = vec2f(first.y - first.x, second.y - second.x);\n let wide = abs(seen) * ends;\n let drawn = max(wide, vec2f(lens.minWidth * length(begin - lens.eye)));\n let grown = drawn - wide;\n var axis = ribbon.axis;\n if (grown.x + grown.y > 0.0) {\n  axis = (ends.x + ends.y) * axis + (grown.x + grown.y) * outwardsOf(across, cross(ray, ribbon.v1 - ribbon.v0));\n }\n var toEye = lens.eye - begin;\n var upwards = chord;\n if (!isEven(ribbon.outline.shape)) {\n  toEye -= 0.5 * (first.x + first.y) * ribbon.axis;\n  upwards += 0.5 * (second.x + second.y - first.x - first.y) * ribbon.axis;\n }\n let turned = cross(ray, axis);\n let steepness = dot(upwards, turned);\n let isLine = isAtEye || steepness == 0.0;\n let share = clamp(select(dot(toEye, turned) / steepness, guess - segment, isLine), 0.0, 1.0);\n let reach = 0.5 * mix(drawn.x, drawn.y, share);\n let off = dot(toEye - share * upwards, across);\n let placeX = placeAcross(reach + off, reach - off, drawn, share, upperHalf(segment + 1.0, segments));\n return Found(pointSeen(lens, ray, sighting.depth), vec2f(placeX, (segment + share) * each));\n}",
  "fn find(lens : Lens, ribbon : Ribbon, sighting : Sighting) -> Found {\n if (isFolded(ribbon)) {\n  return findOnFold(lens, ribbon, sighting);\n }\n return findOnPlane(lens, ribbon, sighting);\n}",
  "fn pointOf(seen : SeenBlade, found : Found) -> BladePoint {\n let ribbon = seen.ribbon;\n var point : BladePoint;\n point.position = found.point;\n point.place = found.place;\n point.tangent = tangentOf_2(curveOf(ribbon), point.place.y);\n point.axis = ribbon.axis;\n point.up = normalize(ribbon.v1 - ribbon.v0);\n point.fold = select(0.0, ribbon.fold, isFolded(ribbon));\n point.rootColor = seen.surface.root;\n point.tipColor = seen.surface.tip;\n point.look = unpackedLook(seen.surface.material.x);\n point.leafAbove = leafAreaAbove(seen.surface.material, clamp(found.place.y, 0.0, 1.0));\n point.leafBelow = max(seen.surface.material.y - point.leafAbove, 0.0);\n point.seed = ribbon.seed;\n point.finish = seen.surface.material.w;\n point.flecks = fleckCount(length(ribbon.v1 - ribbon.v0) + length(ribbon.v2 - ribbon.v1));\n return point;\n}",
  "fn shadeFound(seen : SeenBlade, found : Found) -> vec4f {\n let point = pointOf(seen, found);\n return vec4f(bladePicture(point), 1.0 - softness(length(frameConstants_.view.eye - point.position), 1.0));\n}",
  "fn cloudAt(place_in : vec3f) -> f32 {\n var place = place_in;\n let least = mix(0.72, 0.34, frameConstants_.clouds);\n let finest = 1.0 / 32.0;\n var sum = 0.0;\n var weight = 0.5;\n for (var octave = 0u; octave < 5u; octave++) {\n  sum += weight * valueNoise(place);\n  if (sum + weight - finest <= least) {\n   return 0.0;\n  }\n  place = 2.13 * place.yzx + vec3f(3.7, 11.1, 5.3);\n  weight *= 0.5;\n }\n return smoothstep(0.0, 0.26, sum - least);\n}",
  "fn withClouds(color : vec3f, ray : vec3f) -> vec3f {\n let height = dot(ray, frameConstants_.skyUp);\n if (frameConstants_.clouds <= 0.0 || height <= 0.0) {\n  return color;\n }\n let place = ray * (1.9 / (height + 0.16));\n let thickness = cloudAt(place);\n if (thickness <= 0.0) {\n  return color;\n }\n let sunwards = frameConstants_.sunDirection - frameConstants_.skyUp * dot(frameConstants_.sunDirection, frameConstants_.skyUp);\n let shade = cloudAt(place + 0.35 * sunwards);\n let toSun = max(dot(ray, frameConstants_.sunDirection), 0.0);\n let lit = frameConstants_.sunColor * (0.30 * exp(-1.4 * shade) * (1.0 + 0.9 * pow(toSun, 6.0))) + 0.55 * frameConstants_.skyColor;\n let shown = thickness * 0.85 * smoothstep(0.0, 0.22, height);\n return mix(color, lit, shown);\n}",
  "const floorAlbedo : vec3f = vec3f(0.160, 0.152, 0.130);",
  "const floorBounce : f32 = 0.12;",
  "fn sunOnFloor(place : vec3f) -> f32 {\n if (frameConstants_.shadow.size == 0u) {\n  return 1.0;\n }\n let depth = dot(frameConstants_.shadow.depth, vec4f(place, 1.0));\n let perMetre = dot(frameConstants_.shadow.depth.xyz, frameConstants_.sunDirection);\n return sunSeen(frameConstants_.shadow, place + frameConstants_.sunDirection * (max(0.002 - depth, 0.0) / perMetre), frameConstants_.skyUp);\n}",
  "fn belowHorizon(color : vec3f, ray : vec3f) -> vec3f {\n let climb = dot(ray, frameConstants_.skyUp);\n if (climb >= 0.0) {\n  return color;\n }\n let plane = frameConstants_.floorPlane;\n if (plane.reach <= 0.0) {\n  return color * (1.0 - 0.35 * smoothstep(0.0, 1.0, -climb));\n }\n let distance_ = dot(plane.middle - frameConstants_.view.eye, frameConstants_.skyUp) / climb;\n if (distance_ <= 0.0) {\n  return color;\n }\n let place = frameConstants_.view.eye + distance_ * ray;\n let away = distanceFromFootprint(plane, place, cross(frameConstants_.skyUp, plane.along));\n let shown = exp(-away / plane.reach);\n if (shown < 0.002) {\n  return color;\n }\n let facing = max(dot(frameConstants_.sunDirection, frameConstants_.skyUp), 0.0);\n var t1_ : f32;\n if (facing > 0.0) {\n  t1_ = sunOnFloor(place);\n } else {\n  t1_ = 0.0;\n }\n let lit = t1_;\n let open = skyBesideWall(plane.height, away);\n let light = hemisphere(frameConstants_.skyUp) * open + frameConstants_.sunColor * (facing * mix(floorBounce * open, 1.0, lit));\n return mix(color, throughAir(floorAlbedo * light, ray, distance_), shown);\n}",
  "fn skyPicture(ray : vec3f, place : vec2f) -> vec3f {\n if (debugMode() != debugNothing) {\n  var t1_ : vec3f;\n  if (showsBands()) {\n   t1_ = vec3f(0.0);\n  } else {\n   t1_ = dithered(develop(vec3f(0.6)), place);\n  }\n  return t1_;\n }\n var color = belowHorizon(withClouds(skyRadiance(ray), ray), ray);\n let toSun = dot(ray, frameConstants_.sunDirection);\n color += frameConstants_.sunColor * 6.0 * smoothstep(0.99985, 0.99997, toSun);\n return dithered(develop(color), place);\n}",
  "fn halfRounded(value : vec4f) -> vec4f {\n let droppedBits = 13u;\n let bits = bitcast<vec4u>(value) + (1u << (droppedBits - 1u));\n return bitcast<vec4f>(bits & vec4u(~((1u << droppedBits) - 1u)));\n}",
  "@group(0) @binding(9) var<storage, read> seenSamples_ : array<vec2u>;",
  "@group(0) @binding(21) var groundLight_ : texture_multisampled_2d<f32>;",
  "@group(0) @binding(22) var resolved_ : texture_storage_2d<rgba16float, write>;",
  "const gatherTile : u32 = 8u;",
  "const gatherThreads : u32 = gatherTile * gatherTile;",
  "var<workgroup> gathered : array<u32, 256>;",
  "var<workgroup> gatheredCount : atomic<u32>;",
  "var<workgroup> lights : array<vec4f, 256>;",
  "fn pixelOf(tile : vec2u, thread : u32) -> vec2u {\n return tile * gatherTile + vec2u(thread % gatherTile, thread / gatherTile);\n}",
  "struct ShadingTask {\n thread : u32,\n s : u32,\n samples : u32,\n}",
  "fn taskAt(i : u32) -> ShadingTask {\n return ShadingTask(gathered[i] & 0xffu, (gathered[i] >> 8u) & 0xffu, gathered[i] >> 16u);\n}",
  "fn gatherTasks(thread : u32, seen : array<u32, 4>, first : u32, end : u32) -> u32 {\n var leaders = 0u;\n for (var s = 0u; s < samplesPerPixel; s++) {\n  var samples = 0u;\n  for (var other = 0u; other < samplesPerPixel; other++) {\n   samples |= select(0u, 1u << other, seen[other] == seen[s]);\n  }\n  if (seen[s] < first || seen[s] >= end || i32(countOneBits(samples & ((1u << s) - 1u))) != i32(countOneBits(samples)) / 2) {\n   continue;\n  }\n  leaders |= 1u << s;\n  gathered[atomicAdd(&gatheredCount, 1u)] = thread | (s << 8u) | (samples << 16u);\n }\n return leaders;\n}",
  "fn putLight(task : ShadingTask, light : vec4f) {\n lights[samplesPerPixel * task.thread + task.s] = f32(i32(countOneBits(task.samples))) * light;\n}",
  "fn sumOfLight(thread : u32, leaders : u32) -> vec4f {\n var sum = vec4f(0.0);\n for (var s = 0u; s < samplesPerPixel; s++) {\n  if ((leaders & (1u << s)) != 0u) {\n   sum += lights[samplesPerPixel * thread + s];\n  }\n }\n return sum;\n}",
  "fn listedBlade(place : u32) -> SeenBlade {\n let item = visible_[place];\n let drawn = drawnBlade_3(item);\n var seen : SeenBlade;\n seen.ribbon = drawn.ribbon;\n seen.surface = bladeSurface(drawn, item, leafAreaLimitOf(frameConstants_.view, patches_[item.patchIndex]));\n return seen;\n}",
  "@compute @workgroup_size(8, 8, 1)\nfn main(@builtin(workgroup_id) WorkGroupID_ : vec3u, @builtin(local_invocation_index) LocalInvocationIndex_ : u32) {\n let lens = lensOf();\n let thread = LocalInvocationIndex_;\n let tile = WorkGroupID_.xy;\n let pixel = pixelOf(tile, thread);\n let isInside = all(pixel < push_.size);\n if (thread == 0u) {\n  atomicStore(&gatheredCount, 0u);\n }\n workgroupBarrier();\n var seen : array<u32, 4>;\n var leaders = 0u;\n if (isInside) {\n  for (var s = 0u; s < samplesPerPixel; s++) {\n   seen[s] = seenSamples_[sampleIndex(pixel, s)].x;\n  }\n  leaders = gatherTasks(thread, seen, push_.firstBlade, ~0u);\n }\n workgroupBarrier();\n for (var i = thread; i < atomicLoad(&gatheredCount); i += gatherThreads) {\n  let task = taskAt(i);\n  let place = pixelOf(tile, task.thread);\n  let sample_ = seenSamples_[sampleIndex(place, task.s)];\n  let blade = listedBlade(sample_.x - push_.firstBlade);\n  let sighting = Sighting(vec2f(place) + samplePlace(task.s), bitcast<f32>(sample_.y), vec2f(place) + middleOf(task.samples));\n  putLight(task, shadeFound(blade, find(lens, blade.ribbon, sighting)));\n }\n workgroupBarrier();\n if (!isInside) {\n  return;\n }\n var sum = sumOfLight(thread, leaders);\n var sky = 0.0;\n for (var s = 0u; s < samplesPerPixel; s++) {\n  if (seen[s] >= push_.firstBlade) {\n   continue;\n  }\n  if (seenSamples_[sampleIndex(pixel, s)].y == 0u) {\n   sky += 1.0;\n  } else {\n   sum += textureLoad(groundLight_, vec2i(pixel), i32(s));\n  }\n }\n if (sky > 0.0) {\n  let middle = vec2f(pixel) + 0.5;\n  sum += sky * vec4f(skyPicture(normalize(rayTo(lens, middle)), middle), 1.0);\n }\n textureStore(resolved_, vec2i(pixel), halfRounded(sum / f32(samplesPerPixel)));\n}",
  "@group(0) @binding(23) var<storage, read_write> records_ : array<vec4f>;",
  "@compute @workgroup_size(64, 1, 1)\nfn main(@builtin(workgroup_id) WorkGroupID_ : vec3u, @builtin(local_invocation_index) LocalInvocationIndex_ : u32) {\n let place = (WorkGroupID_.y * groupsOfRow + WorkGroupID_.x) * 64u + LocalInvocationIndex_;\n if (place >= min(counters_[countBlades], push_.capacity)) {\n  return;\n }\n let item = visible_[place];\n let ribbon = drawnBlade_3(item).ribbon;\n records_[3u * place] = vec4f(ribbon.v0, bitcast<f32>(item.blade));\n records_[3u * place + 1u] = vec4f(ribbon.v1, ribbon.width);\n records_[3u * place + 2u] = vec4f(ribbon.v2, 0.0);\n}",
  "fn decodeNormal32(bits : u32) -> vec3f {\n let x = f32((i32(bits & 65535u) ^ 32768) - 32768) / 32767.0;\n let y = f32((i32(bits >> 16u) ^ 32768) - 32768) / 32767.0;\n let z = 1.0 - abs(x) - abs(y);\n let fold = max(-z, 0.0);\n return normalize(vec3f(x + select(fold, -fold, x >= 0.0), y + select(fold, -fold, y >= 0.0), z));\n}",
  "var<private> position : vec3f;",
  "var<private> normal : u32;",
  "var<private> uv : vec2f;",
  "var<private> color : vec4f;",
  "var<private> outPosition : vec3f;",
  "var<private> outNormal : vec3f;",
  "var<private> outUv : vec2f;",
  "var<private> outVertexColor : vec4f;",
  "var<private> ownPosition : vec4f;\nstruct Drawn {\n @builtin(position) @invariant at : vec4f,\n @location(0) outPosition : vec3f,\n @location(1) outNormal : vec3f,\n @location(2) outUv : vec2f,\n @location(3) outVertexColor : vec4f,\n}\nfn run() {\n outPosition = position;\n outNormal = decodeNormal32(normal);\n outUv = uv;\n outVertexColor = color;\n ownPosition = frameConstants_.viewProjection * vec4f(position, 1.0) * vec4f(1.0, -1.0, 1.0, 1.0);\n}\n@vertex\nfn main(@location(0) position_in : vec3f, @location(1) normal_in : u32, @location(2) uv_in : vec2f, @location(3) color_in : vec4f) -> Drawn {\n position = position_in;\n normal = normal_in;\n uv = uv_in;\n color = color_in;\n run();\n return Drawn(ownPosition, outPosition, outNormal, outUv, outVertexColor);\n}",
  "fn valueNoiseSlope(p : vec3f) -> vec4f {\n let cell = floor(p);\n let f = p - cell;\n let s = f * f * (vec3f(3.0) - 2.0 * f);\n let slope = 6.0 * f * (vec3f(1.0) - f);\n let near = latticePoint(i32(cell.x), i32(cell.y), i32(cell.z));\n let far = near + latticeZ;\n let h000 = latticeHeight(near);\n let h010 = latticeHeight(near + latticeY);\n let h001 = latticeHeight(far);\n let h011 = latticeHeight(far + latticeY);\n let d00 = latticeHeight(near + latticeX) - h000;\n let d10 = latticeHeight(near + latticeX + latticeY) - h010;\n let d01 = latticeHeight(far + latticeX) - h001;\n let d11 = latticeHeight(far + latticeX + latticeY) - h011;\n let h00 = h000 + s.x * d00;\n let h10 = h010 + s.x * d10;\n let h01 = h001 + s.x * d01;\n let h11 = h011 + s.x * d11;\n let h0 = mix(h00, h10, s.y);\n let h1 = mix(h01, h11, s.y);\n return latticeUnit * vec4f(slope.x * mix(mix(d00, d10, s.y), mix(d01, d11, s.y), s.z), slope.y * mix(h10 - h00, h11 - h01, s.z), slope.z * (h1 - h0), mix(h0, h1, s.z));\n}",
  "const noBladeSeed : u32 = 0xffffffffu;",
  "fn toneOf(grass : vec3f) -> f32 {\n return select(0.5, grass.z / grass.x, grass.x > 0.0);\n}",
  "fn swardShare(cover : Cover, leafArea : f32, thinned : f32) -> f32 {\n return cover.thatch * (undergrowthBelow(leafArea) - undergrowthBelow(leafArea / thinned));\n}",
  "fn swardBrightness(cosine : f32) -> f32 {\n return 0.6 - 0.1 * cosine;\n}",
  "fn meadowShade(position : vec3f, tone : f32) -> vec3f {\n let meadow = meadowAt(position);\n let region = regionAt(position);\n let hue = 0.45 * (0.7 * (tone - 0.5) + 1.1 * (meadow - 0.5) + 1.2 * (region - 0.5));\n let light = 1.0 + 0.45 * (0.6 * (tone - 0.5) + 0.5 * (meadow - 0.5) + 0.4 * (region - 0.5));\n return light * shiftOf(hue);\n}",
  "struct GroundDetail {\n albedo : vec3f,\n brightness : f32,\n slope : vec3f,\n}",
  "fn shownAt(size : f32, pixel : f32) -> f32 {\n return clamp(0.35 * size / pixel - 1.0, 0.0, 1.0);\n}",
  "const crumbSizes : u32 = 5u;",
  "const nextCrumb : f32 = 0.4;",
  "const meanCrumb : f32 = 0.3027;",
  "const noiseDeviation : f32 = 0.185;",
  "fn slantedLattice() -> mat3x3f {\n return mat3x3f(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6);\n}",
  "fn addCrumbs(detail : ptr<function, GroundDetail>, position : vec3f, size_in : f32, pixel : f32, roughness : f32) {\n var size = size_in;\n let turn = slantedLattice();\n var amount = 0.2 * roughness;\n for (var i = 0u; i < crumbSizes; i++) {\n  let shown = shownAt(size, pixel);\n  if (shown <= 0.0) {\n   break;\n  }\n  let other = (i & 1u) != 0u;\n  let place = position / size + 0.4 * (*detail).slope + 17.0 * f32(i);\n  let noise = valueNoiseSlope(select(turn * place, place * turn, other));\n  let rise = select(vec3f(noise.xyz) * turn, turn * vec3f(noise.xyz), other);\n  let height = 2.0 * noise.w - 1.0;\n  (*detail).brightness += amount * shown * (abs(height) - meanCrumb);\n  (*detail).slope += amount * shown * select(1.0, -1.0, height < 0.0) * rise;\n  size *= nextCrumb;\n  amount = min(1.4 * amount, 0.38 * roughness);\n }\n}",
  "fn byteOf(hash : u32, i : u32) -> f32 {\n return f32((hash >> (8u * i)) & 255u) * (1.0 / 256.0);\n}",
  "const stoneChance : f32 = 0.4;",
  "const smallestStone : f32 = 0.08;",
  "const largestStone : f32 = 0.33;",
  "fn stoneShare() -> f32 {\n let low = smallestStone * smallestStone;\n let high = largestStone * largestStone;\n let meanCube = (high * high - low * low) / (4.0 * (largestStone - smallestStone));\n return stoneChance * 4.18879 * meanCube;\n}",
  "fn layStones(detail : ptr<function, GroundDetail>, mean : ptr<function, vec3f>, rock : vec3f, position : vec3f, edge : f32, pixel : f32, amount : f32) {\n let shown = amount * shownAt(0.4 * edge, pixel);\n if (shown <= 0.0) {\n  return;\n }\n (*mean) = mix((*mean), rock, shown * stoneShare());\n let turn = slantedLattice();\n let place = turn * (position / edge + 0.1 * (*detail).slope);\n let cell = floor(place);\n let hash = mixUint(latticePoint(i32(cell.x), i32(cell.y), i32(cell.z)) + 0x51ed270bu);\n if (f32(hash >> 8u) * (1.0 / 16777216.0) >= stoneChance) {\n  return;\n }\n let more = mixUint(hash + 0x9e3779b9u);\n let first = 0.82 + 0.4 * byteOf(hash, 0u);\n let second = 0.82 + 0.4 * byteOf(more, 0u);\n let radii = mix(smallestStone, largestStone, byteOf(mixUint(more), 0u)) * vec3f(first, 1.0 / (first * second), second);\n let middle = vec3f(0.5) + (vec3f(1.0) - 2.0 * radii) * (vec3f(byteOf(more, 1u), byteOf(more, 2u), byteOf(more, 3u)) - vec3f(0.5));\n let out_ = (place - cell - middle) / radii;\n let soft = max(pixel / (edge * radii.x), 0.08);\n let seen = shown * clamp((1.0 - length(out_)) / soft + 0.5, 0.0, 1.0);\n (*detail).albedo = mix((*detail).albedo, (0.5 + byteOf(mixUint(more), 1u)) * rock, seen);\n (*detail).slope = mix((*detail).slope, 0.4 * (*detail).slope - 0.8 * (out_ * turn), seen);\n (*detail).brightness = mix((*detail).brightness, 1.0, seen);\n}",
  "const strawChance : f32 = 0.4;",
  "const strawLength : f32 = 0.27;",
  "const strawWidth : f32 = 0.013;",
  "const strawLayers : u32 = 3u;",
  "const strawColor : vec3f = vec3f(0.21, 0.165, 0.095);",
  "fn lineSeen(distance_ : f32, half_ : f32, pixel : f32) -> f32 {\n return clamp((distance_ + half_) / pixel + 0.5, 0.0, 1.0) - clamp((distance_ - half_) / pixel + 0.5, 0.0, 1.0);\n}",
  "fn layStraws(detail : ptr<function, GroundDetail>, mean : ptr<function, vec3f>, straw : vec3f, place_in : vec2f, edge : f32, pixel : f32, amount : f32) {\n var place = place_in;\n let shown = amount * shownAt(edge, pixel);\n if (shown <= 0.0) {\n  return;\n }\n let width = max(pixel / edge, 0.3 * strawWidth);\n for (var layer = 0u; layer < strawLayers; layer++) {\n  (*mean) = mix((*mean), straw, shown * strawChance * 4.0 * strawLength * strawWidth);\n  place = vec2f(0.8 * place.x - 0.6 * place.y, 0.6 * place.x + 0.8 * place.y) + vec2f(0.37, 0.71);\n  let cell = floor(place);\n  let drift = floor(0.25 * place);\n  let many = mixUint(latticePoint(i32(drift.x), i32(drift.y), i32(layer) + 7));\n  let hash = mixUint(latticePoint(i32(cell.x), i32(cell.y), i32(layer)));\n  if (f32(hash >> 8u) * (1.0 / 16777216.0) >= 2.0 * strawChance * byteOf(many, 1u)) {\n   continue;\n  }\n  let more = mixUint(hash + 0x9e3779b9u);\n  let angle = 6.2831853 * byteOf(more, 0u);\n  let along = vec2f(cos(angle), sin(angle));\n  let from_ = place - cell - vec2f(0.5);\n  let t = dot(from_, along);\n  let beside = along.x * from_.y - along.y * from_.x + (1.6 * byteOf(more, 1u) - 0.8) * (t * t - 0.04);\n  let length_ = strawLength * (0.4 + 1.2 * byteOf(more, 2u));\n  let seen = shown * lineSeen(beside, strawWidth, width) * lineSeen(t, length_, width);\n  (*detail).albedo = mix((*detail).albedo, (0.35 + 1.3 * byteOf(more, 3u)) * straw, seen);\n }\n}",
  "const damp : f32 = 7.0;",
  "fn turfIn(albedo : vec3f) -> f32 {\n return smoothstep(1.15, 1.6, albedo.y / max(max(albedo.x, albedo.z), 1e-4));\n}",
  "fn groundDetail(position : vec3f, normal : vec3f, up : vec3f, albedo : vec3f, size : f32, pixel : f32) -> GroundDetail {\n var detail : GroundDetail;\n detail.albedo = albedo;\n detail.brightness = 1.0;\n detail.slope = vec3f(0.0);\n if (shownAt(damp * size, pixel) <= 0.0) {\n  return detail;\n }\n let light = dot(albedo, vec3f(0.2126, 0.7152, 0.0722));\n let soil = 1.0 - 0.75 * smoothstep(0.15, 0.4, light);\n let wide = damp * size;\n detail.brightness += 0.5 * soil * shownAt(wide, pixel) * (valueNoise(position / wide) - 0.5);\n addCrumbs(&detail, position, size, pixel, soil);\n let lies = soil * (1.0 - turfIn(albedo)) * smoothstep(0.64, 0.85, dot(normal, up));\n var mean = albedo;\n let dark = min(16.0 * light, 1.0);\n let rock = mix(albedo, dark * vec3f(0.14, 0.13, 0.115), 0.5);\n layStones(&detail, &mean, rock, position, 0.16 * size, pixel, lies);\n layStones(&detail, &mean, rock, position, 0.55 * size, pixel, lies);\n let steep = abs(normal);\n let place = select(select(vec2f(position.x, position.y), vec2f(position.y, position.z), steep.x >= steep.z), vec2f(position.x, position.z), steep.y >= max(steep.x, steep.z));\n layStraws(&detail, &mean, dark * strawColor, place / (0.5 * size), 0.5 * size, pixel, lies);\n detail.albedo = max(detail.albedo + albedo - mean, vec3f(0.0));\n return detail;\n}",
  "fn raggedShare(mean : f32, position : vec3f, cell : f32, size : f32, pixel : f32) -> f32 {\n let amount = 0.75 * (1.0 - smoothstep(0.7, 0.9, mean));\n if (mean <= 0.0 || amount <= 0.0) {\n  return mean;\n }\n var step_ = max(0.5 * cell, size);\n let whole = shownAt(step_, pixel);\n var weight = whole;\n var sum = 0.0;\n var squares = 0.0;\n for (var i = 0u; i < 4u && weight > 0.0; i++) {\n  sum += weight * (valueNoise(position / step_ + 31.0 * f32(i)) - 0.5);\n  squares += weight * weight;\n  step_ = select(0.38 * step_, 0.6 * size, i == 0u);\n  weight = shownAt(step_, pixel);\n }\n if (squares <= 0.0) {\n  return mean;\n }\n let order = 1.0 / (1.0 + exp(-1.6 * sum / (noiseDeviation * sqrt(squares))));\n let half_ = min(0.06, 0.5 * min(mean, 1.0 - mean));\n let covered = clamp(0.5 * (mean - order) / max(half_, 1e-6) + 0.5, 0.0, 1.0);\n return mix(mean, covered, amount * whole);\n}",
  "struct GroundPoint {\n position : vec3f,\n normal : vec3f,\n albedo : vec3f,\n isDoubleSided : bool,\n}",
  "struct Relief {\n brightness : f32,\n slope : vec3f,\n}",
  "fn addNoise(relief : ptr<function, Relief>, position : vec3f, stretch : vec3f, size : f32, amount : f32) {\n let noise = valueNoiseSlope(position * stretch / size);\n (*relief).brightness += amount * (noise.w - 0.5);\n (*relief).slope += 0.5 * amount * (noise.xyz * stretch);\n}",
  "fn crumbs(position : vec3f, size_in : f32, pixel : f32) -> Relief {\n var size = size_in;\n var relief = Relief(1.0, vec3f(0.0));\n for (var octave = 0u; octave < 4u; octave++) {\n  let shown = shownAt(size, pixel);\n  if (shown <= 0.0) {\n   break;\n  }\n  addNoise(&relief, position + 17.0 * f32(octave) * size, vec3f(1.0), size, 0.4 * shown);\n  size *= 0.37;\n }\n return relief;\n}",
  "fn strands(position : vec3f, size : f32, pixel : f32) -> Relief {\n var relief = Relief(1.0, vec3f(0.0));\n let thin = 0.12 * size;\n let shown = shownAt(thin, pixel);\n if (shown > 0.0) {\n  let turned = mat3x3f(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6);\n  var turnedRelief = Relief(1.0, vec3f(0.0));\n  addNoise(&relief, position, vec3f(0.15, 1.0, 1.0), thin, 0.45 * shown);\n  addNoise(&relief, position, vec3f(1.0, 1.0, 0.15), thin, 0.45 * shown);\n  addNoise(&turnedRelief, turned * position, vec3f(0.15, 1.0, 1.0), thin, 0.45 * shown);\n  relief.brightness += turnedRelief.brightness - 1.0;\n  relief.slope += turnedRelief.slope * turned;\n }\n return relief;\n}",
  "const bareStructure : f32 = 0.32;",
  "const hiddenBelow : f32 = 0.93;",
  "const placeStep : f32 = 2.5e-7;",
  "const darkestCrumb : f32 = 0.85;",
  "fn groundPicture(point : GroundPoint) -> vec4f {\n let ray = frameConstants_.view.eye - point.position;\n let distance_ = length(ray);\n let toEye = ray / max(distance_, 1e-6);\n var n = normalize(point.normal);\n if (point.isDoubleSided && dot(n, toEye) < 0.0) {\n  n = -n;\n }\n let farthest = frameConstants_.cover.farthest;\n let grown = 1.0 - smoothstep(0.8 * farthest, farthest, distance_);\n let grass = grassAt(frameConstants_.cover, point.position);\n let blades = grass.x * grown;\n let leafArea = frameConstants_.cover.thinned * blades;\n let far = abs(point.position);\n let pixel = max(distance_ / frameConstants_.view.pixelsPerUnit, placeStep * max(far.x, max(far.y, far.z)));\n let size = select(bareStructure, frameConstants_.cover.structure, frameConstants_.cover.structure > 0.0);\n let closed = undergrowthBelow(leafArea);\n let ragged = mix(raggedShare(closed, point.position, 1.0 / max(frameConstants_.cover.cellsPerMetre, 1e-6), size, pixel), closed, turfIn(point.albedo));\n let under = frameConstants_.cover.thatch * ragged;\n var albedo = point.albedo;\n var shade = vec3f(1.0);\n var brightness = 1.0 - under;\n var rough = vec3f(0.0);\n var crumbled = vec3f(0.0);\n if (under < hiddenBelow) {\n  let detail = groundDetail(point.position, n, frameConstants_.skyUp, albedo, size, pixel);\n  albedo = detail.albedo;\n  brightness *= detail.brightness;\n  crumbled = (1.0 - under) * (detail.slope - n * dot(n, detail.slope));\n }\n if (under > 0.0) {\n  var relief = crumbs(point.position, size, pixel);\n  let litter = strands(point.position, size, pixel);\n  brightness += under * max(relief.brightness * litter.brightness, 0.2);\n  rough = under * (relief.slope + litter.slope);\n  shade = meadowShade(point.position, toneOf(grass));\n  albedo = mix(albedo, shade * frameConstants_.cover.undergrowth, under);\n }\n n = normalize(n - (rough - n * dot(n, rough)));\n let even = max(dot(n, frameConstants_.sunDirection), 0.0);\n let turned = dot(crumbled, frameConstants_.sunDirection) / max(even, 0.3);\n let facing = even * (1.0 - clamp(turned, -darkestCrumb, darkestCrumb));\n var t1_ : f32;\n if (even > 0.0) {\n  t1_ = sunSeen(frameConstants_.shadow, point.position, n);\n } else {\n  t1_ = 0.0;\n }\n let seen = t1_;\n var below = sunBelow(leafProjectionOf(frameConstants_.cover), leafArea, even);\n let among = sunAmongBlades(frameConstants_.bladeShadow, point.position, noBladeSeed);\n below = mix(below, among.x, among.y);\n let light = hemisphere(normalize(n - crumbled)) * skyBelow(leafArea) + lightAmongLeaves(leafArea, 0.0, even, seen * frameConstants_.sunColor, 1.25 * frameConstants_.skyColor, 1.5 * frameConstants_.cover.sward) + frameConstants_.sunColor * (facing * seen * below);\n var color = brightness * albedo * light;\n var t2_ : f32;\n if (closed > 0.0) {\n  t2_ = swardShare(frameConstants_.cover, leafArea, frameConstants_.cover.thinned * leavesPerDrawn(frameConstants_.view, distance_)) * (ragged / closed);\n } else {\n  t2_ = 0.0;\n }\n let sward = t2_;\n if (sward > 0.0) {\n  let open = hemisphere(n) + frameConstants_.sunColor * (even * seen);\n  color = mix(color, brightness * swardBrightness(max(dot(n, toEye), 0.0)) * shade * frameConstants_.cover.sward * open, sward);\n }\n if (debugMode() != debugNothing) {\n  color = select(vec3f(0.35) * (0.5 + 0.5 * even), vec3f(0.0), showsBands());\n } else {\n  color = throughAir(color, -toEye, distance_);\n }\n return vec4f(develop(color), 1.0 - softness(distance_, min(blades, 1.0)));\n}",
  "const maxProbes : f32 = 8.0;",
  "struct ImageProbes {\n first : vec2f,\n step_ : vec2f,\n count : u32,\n lod : f32,\n}",
  "fn imageProbes(uv : vec2f, right : vec2f, down : vec2f, size : vec2f) -> ImageProbes {\n let across = length(right * size);\n let along = length(down * size);\n let longest = max(across, along);\n let ratio = select(1.0, longest / max(min(across, along), 1e-6), longest > 1.0);\n let count = clamp(ceil(ratio), 1.0, maxProbes);\n var probes : ImageProbes;\n probes.step_ = select(down, right, across > along) / (count + 1.0);\n probes.first = uv - 0.5 * (count - 1.0) * probes.step_;\n probes.count = u32(count);\n probes.lod = log2(max(longest / count, 1e-6));\n return probes;\n}",
  "struct Material {\n @align(16) color : vec3f,\n isDoubleSided : u32,\n}",
  "@group(1) @binding(0) var<uniform> material_ : Material;",
  "@group(1) @binding(1) var baseColor_ : texture_2d<f32>;\n@group(1) @binding(2) var baseColor_sampler : sampler;",
  "var<private> outColor : vec4f;",
  "var<private> ownFragCoord : vec4f;\nstruct Drawn {\n @location(0) outColor : vec4f,\n}\nfn run() {\n let right = dpdx(outUv);\n let down = dpdy(outUv);\n let first = sampleIndex(vec2u(ownFragCoord.xy), 0u);\n var isSeen = false;\n for (var s = 0u; s < samplesPerPixel; s++) {\n  isSeen = isSeen || seenSamples_[first + s].x < push_.firstBlade;\n }\n outColor = vec4f(0.0);\n if (!isSeen) {\n  return;\n }\n let probes = imageProbes(outUv, right, down, vec2f(vec2i(textureDimensions(baseColor_))));\n var texel = vec3f(0.0);\n for (var i = 0u; i < probes.count; i++) {\n  texel += textureSampleLevel(baseColor_, baseColor_sampler, probes.first + f32(i) * probes.step_, probes.lod).rgb;\n }\n var point : GroundPoint;\n point.position = outPosition;\n point.normal = outNormal;\n point.albedo = material_.color * (texel / f32(probes.count)) * outVertexColor.rgb;\n point.isDoubleSided = material_.isDoubleSided != 0u;\n outColor = groundPicture(point);\n}\n@fragment\nfn main(@builtin(position) FragCoord_ : vec4f, @location(0) outPosition_in : vec3f, @location(1) outNormal_in : vec3f, @location(2) outUv_in : vec2f, @location(3) outVertexColor_in : vec4f) -> Drawn {\n ownFragCoord = FragCoord_;\n outPosition = outPosition_in;\n outNormal = outNormal_in;\n outUv = outUv_in;\n outVertexColor = outVertexColor_in;\n run();\n return Drawn(outColor);\n}",
  "var<private> ownPosition : vec4f;\nstruct Drawn {\n @builtin(position) @invariant at : vec4f,\n}\nfn run() {\n let place = vec4f(position, 1.0);\n let pixel = vec2f(dot(frameConstants_.shadow.across, place), dot(frameConstants_.shadow.down, place));\n let clip = pixel * (2.0 / f32(frameConstants_.shadow.size)) - 1.0;\n ownPosition = vec4f(clip.x, -clip.y, dot(frameConstants_.shadow.depth, place), 1.0);\n}\n@vertex\nfn main(@location(0) position_in : vec3f) -> Drawn {\n position = position_in;\n run();\n return Drawn(ownPosition);\n}",
  "var<private> ownPosition : vec4f;\nvar<private> ownVertexIndex : u32;\nstruct Drawn {\n @builtin(position) @invariant at : vec4f,\n}\nfn run() {\n ownPosition = vec4f(select(-1.0, 3.0, ownVertexIndex == 1u), select(-1.0, 3.0, ownVertexIndex == 2u), 0.0, 1.0);\n}\n@vertex\nfn main(@builtin(vertex_index) VertexIndex_ : u32) -> Drawn {\n ownVertexIndex = VertexIndex_;\n run();\n return Drawn(ownPosition);\n}",
  "@group(0) @binding(0) var resolvedPicture_ : texture_2d<f32>;",
  "fn pixelAt(pixel : vec2i) -> vec4f {\n return textureLoad(resolvedPicture_, clamp(pixel, vec2i(0), vec2i(textureDimensions(resolvedPicture_)) - 1), 0);\n}",
  "const softSide : f32 = 1.0 / 6.0;",
  "fn splineAt(offset : i32) -> f32 {\n return select(softSide, 1.0 - 2.0 * softSide, offset == 0);\n}",
  "fn reconstructed(pixel : vec2i) -> vec3f {\n let here = pixelAt(pixel);\n let soft = 1.0 - here.a;\n var sum = here.rgb;\n if (soft <= 0.0) {\n  return sum;\n }\n for (var y = -1; y <= 1; y++) {\n  for (var x = -1; x <= 1; x++) {\n   let there = pixelAt(pixel + vec2i(x, y));\n   sum += splineAt(x) * splineAt(y) * min(soft, 1.0 - there.a) * (there.rgb - here.rgb);\n  }\n }\n return sum;\n}",
  "var<private> ownFragCoord : vec4f;\nstruct Drawn {\n @location(0) outColor : vec4f,\n}\nfn run() {\n var color = clamp(reconstructed(vec2i(ownFragCoord.xy)), vec3f(0.0), vec3f(1.0));\n color = select(12.92 * color, 1.055 * pow(color, vec3f(1.0 / 2.4)) - 0.055, color > vec3f(0.0031308));\n outColor = vec4f(color, 1.0);\n}\n@fragment\nfn main(@builtin(position) FragCoord_ : vec4f) -> Drawn {\n ownFragCoord = FragCoord_;\n run();\n return Drawn(outColor);\n}"
];
var stages = {
  walk: { head: "", pieces: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 69], resources: { "frameConstants": 0, "push": 2, "patches": 5, "visiblePatches": 10, "counters": 12, "widest": 14, "present": 15, "cellBits": 19 } },
  arguments: { head: "", pieces: [39, 40, 41, 70, 71, 45, 72, 73, 74, 75, 76, 46, 77, 78, 79, 80], resources: { "push": 2, "counters": 12, "arguments": 13 } },
  update: { head: "", pieces: [81, 82, 83, 84, 85, 86, 87, 88, 89, 0, 90, 91, 92, 93, 94, 95, 96, 1, 97, 98, 99, 100, 101, 102, 103, 104, 105, 106, 107, 2, 3, 4, 108, 109, 110, 111, 112, 113, 114, 6, 8, 115, 116, 10, 117, 118, 11, 12, 119, 13, 14, 15, 120, 16, 17, 18, 121, 122, 123, 124, 125, 126, 127, 128, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 129, 130, 31, 32, 131, 132, 133, 134, 135, 136, 137, 138, 139, 140, 141, 142, 33, 34, 143, 144, 145, 146, 147, 148, 149, 150, 151, 152, 153, 35, 36, 154, 155, 156, 157, 158, 159, 37, 38, 160, 161, 39, 40, 41, 162, 163, 42, 164, 165, 44, 45, 72, 166, 46, 167, 168, 47, 49, 169, 170, 171, 172, 173, 174, 50, 51, 52, 53, 54, 55, 56, 57, 58, 175, 176, 177, 178, 179, 180, 181, 182, 183, 184, 185, 186, 187, 188, 189, 190, 191, 192, 193, 194, 195, 196, 197, 198, 199, 200, 201, 202, 203, 204, 205, 206, 207, 208, 209, 210, 62, 63, 64, 211, 212, 213, 214, 215, 216], resources: { "frameConstants": 0, "looks": 1, "push": 2, "blades": 3, "states": 4, "patches": 5, "visiblePatches": 10, "visible": 11, "counters": 12, "patchTimes": 16, "cellBits": 19 } },
  raster: { head: "", pieces: [81, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 2, 3, 8, 218, 19, 20, 21, 22, 23, 24, 25, 26, 131, 132, 133, 135, 136, 138, 139, 140, 142, 219, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 231, 232, 233, 234, 33, 235, 236, 237, 238, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 36, 157, 158, 241, 242, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 244, 44, 72, 245, 73, 46, 167, 168, 246, 247, 248, 249, 250, 251, 252, 253, 254, 255, 49, 256, 169, 170, 171, 172, 175, 181, 257, 258, 259, 260, 261, 262, 263, 264, 265, 266, 267, 268, 269, 270, 271, 272, 273, 274, 275, 276, 277, 278, 279, 280, 281, 282, 283, 284, 285, 286, 287, 288, 289, 290, 291, 292, 293, 294, 295, 296, 297, 298, 299, 300, 301, 302, 303, 304, 305, 306, 307, 308, 309, 77, 310, 311, 312, 313, 314, 315, 316, 317, 318, 319, 320, 321], resources: { "frameConstants": 0, "looks": 1, "push": 2, "blades": 3, "states": 4, "patches": 5, "seenSamples": 9, "visible": 11, "counters": 12, "quads": 17, "rowBlocks": 18 } },
  rasterQuads: { head: "", pieces: [39, 40, 41, 70, 73, 46, 249, 266, 267, 268, 269, 274, 275, 169, 170, 276, 277, 322, 323, 288, 293, 324, 325, 306, 326, 327, 328, 329, 330, 308, 309, 77, 310, 311, 78, 331, 332, 333], resources: { "push": 2, "seenSamples": 9, "counters": 12, "quads": 17, "rowBlocks": 18 } },
  shadow: { head: "", pieces: [81, 0, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 2, 3, 4, 8, 115, 10, 118, 11, 12, 119, 13, 14, 15, 120, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 131, 132, 133, 134, 135, 136, 138, 139, 140, 142, 219, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 231, 232, 233, 234, 33, 235, 236, 237, 238, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 36, 157, 158, 159, 241, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 164, 334, 74, 46, 167, 168, 47, 246, 247, 249, 335, 250, 251, 252, 253, 254, 255, 169, 170, 50, 51, 52, 53, 54, 55, 56, 57, 58, 175, 176, 177, 178, 181, 257, 258, 259, 260, 261, 336, 337, 269, 272, 273, 274, 275, 276, 277, 279, 280, 281, 282, 283, 286, 287, 288, 289, 290, 291, 292, 293, 295, 296, 297, 302, 303, 304, 305, 306, 338, 339, 340], resources: { "frameConstants": 0, "looks": 1, "push": 2, "blades": 3, "states": 4, "patches": 5, "seenSamples": 9, "visiblePatches": 10, "arguments": 13 } },
  raster64: { head: "enable atomic_vec2u_min_max;\n", pieces: [81, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 2, 3, 8, 218, 19, 20, 21, 22, 23, 24, 25, 26, 131, 132, 133, 135, 136, 138, 139, 140, 142, 219, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 231, 232, 233, 234, 33, 235, 236, 237, 238, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 36, 157, 158, 241, 242, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 244, 44, 72, 245, 73, 46, 167, 168, 246, 247, 248, 249, 250, 251, 252, 253, 254, 255, 49, 256, 169, 170, 171, 172, 175, 181, 257, 258, 259, 260, 261, 262, 263, 264, 265, 266, 267, 268, 269, 270, 271, 272, 273, 274, 275, 341, 342, 278, 279, 280, 281, 282, 283, 284, 285, 286, 287, 288, 289, 290, 291, 292, 293, 294, 295, 296, 297, 298, 299, 300, 301, 302, 303, 304, 305, 306, 307, 308, 309, 77, 310, 311, 312, 313, 314, 315, 316, 317, 318, 319, 320, 321], resources: { "frameConstants": 0, "looks": 1, "push": 2, "blades": 3, "states": 4, "patches": 5, "seenSamples": 9, "visible": 11, "counters": 12, "quads": 17, "rowBlocks": 18 } },
  rasterQuads64: { head: "enable atomic_vec2u_min_max;\n", pieces: [39, 40, 41, 70, 73, 46, 249, 266, 267, 268, 269, 274, 275, 169, 170, 341, 342, 343, 323, 288, 293, 324, 325, 306, 326, 327, 328, 329, 330, 308, 309, 77, 310, 311, 78, 331, 332, 333], resources: { "push": 2, "seenSamples": 9, "counters": 12, "quads": 17, "rowBlocks": 18 } },
  shadow64: { head: "enable atomic_vec2u_min_max;\n", pieces: [81, 0, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 2, 3, 4, 8, 115, 10, 118, 11, 12, 119, 13, 14, 15, 120, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 131, 132, 133, 134, 135, 136, 138, 139, 140, 142, 219, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 231, 232, 233, 234, 33, 235, 236, 237, 238, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 36, 157, 158, 159, 241, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 164, 334, 74, 46, 167, 168, 47, 246, 247, 249, 335, 250, 251, 252, 253, 254, 255, 169, 170, 50, 51, 52, 53, 54, 55, 56, 57, 58, 175, 176, 177, 178, 181, 257, 258, 259, 260, 261, 336, 337, 269, 272, 273, 274, 275, 341, 342, 279, 280, 281, 282, 283, 286, 287, 288, 289, 290, 291, 292, 293, 295, 296, 297, 302, 303, 304, 305, 306, 338, 339, 340], resources: { "frameConstants": 0, "looks": 1, "push": 2, "blades": 3, "states": 4, "patches": 5, "seenSamples": 9, "visiblePatches": 10, "arguments": 13 } },
  seed: { head: "", pieces: [27, 28, 39, 40, 41, 249, 266, 274, 275, 344, 345, 346, 347, 348, 349, 350, 351], resources: { "push": 2, "seenSamples": 9, "cellBits": 19, "groundDepth": 20 } },
  resolve: { head: "", pieces: [81, 82, 83, 84, 85, 86, 87, 88, 89, 0, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 352, 353, 2, 354, 355, 3, 356, 357, 358, 359, 360, 361, 362, 363, 364, 365, 366, 4, 367, 368, 369, 370, 371, 108, 372, 109, 110, 111, 373, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 374, 375, 131, 132, 133, 135, 136, 138, 139, 140, 142, 219, 376, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 377, 231, 232, 233, 234, 235, 236, 237, 238, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 378, 379, 36, 157, 158, 241, 242, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 380, 381, 382, 244, 167, 168, 383, 384, 385, 249, 266, 267, 268, 270, 271, 272, 273, 274, 275, 386, 387, 388, 389, 390, 391, 392, 393, 394, 395, 396, 397, 398, 399, 400, 401, 402, 403, 404, 405, 406, 407, 408, 409, 410, 411, 412, 413, 414, 415, 416, 417, 418, 419, 420, 421, 422, 423, 424, 425, 426, 427, 428, 429, 430, 431, 432, 433, 434, 435, 436, 437, 438, 439, 440, 441, 442, 443, 444, 445, 446, 447, 448, 449, 450, 451, 452, 453, 454, 455, 456, 457, 458, 459, 460, 246, 247, 248, 250, 251, 252, 253, 254, 255, 50, 51, 53, 54, 55, 56, 57, 58, 175, 181, 257, 258, 259, 260, 261, 262, 263, 264, 265, 461, 462, 463, 464, 465, 279, 280, 281, 282, 283, 285, 286, 287, 466, 467, 468, 469, 470, 471, 472, 473, 474, 475, 476, 477, 478, 479, 480, 481, 482, 483, 484, 485, 486, 487, 488, 489, 490, 491, 492, 493, 494, 495, 496, 497, 498, 499, 500, 501, 502, 503, 504, 505, 506, 507, 508, 509, 510, 511, 512, 513], resources: { "frameConstants": 0, "looks": 1, "push": 2, "blades": 3, "states": 4, "patches": 5, "grass": 6, "map": 7, "sunMap": 8, "seenSamples": 9, "visible": 11, "groundLight": 21, "resolved": 22 } },
  records: { head: "", pieces: [81, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 2, 3, 19, 20, 21, 22, 23, 24, 25, 26, 131, 132, 133, 135, 136, 138, 139, 140, 142, 219, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 231, 232, 233, 234, 235, 236, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 36, 157, 158, 241, 242, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 244, 70, 72, 46, 167, 168, 246, 247, 248, 250, 252, 175, 181, 257, 258, 259, 260, 261, 262, 263, 264, 265, 514, 515], resources: { "frameConstants": 0, "looks": 1, "push": 2, "blades": 3, "states": 4, "patches": 5, "visible": 11, "counters": 12, "records": 23 } },
  groundVertex: { head: "", pieces: [2, 3, 19, 20, 21, 22, 23, 24, 25, 26, 34, 35, 36, 37, 38, 516, 517, 518, 519, 520, 521, 522, 523, 524, 525], resources: { "frameConstants": 0 } },
  groundFragment: { head: "", pieces: [81, 82, 83, 84, 85, 86, 87, 88, 89, 526, 352, 353, 2, 527, 354, 3, 356, 357, 358, 359, 528, 362, 363, 529, 530, 367, 368, 369, 370, 371, 11, 12, 19, 20, 21, 22, 23, 24, 25, 26, 34, 35, 378, 379, 36, 37, 38, 39, 40, 41, 380, 381, 382, 384, 385, 249, 266, 274, 275, 387, 395, 396, 397, 531, 400, 401, 402, 403, 404, 405, 406, 408, 409, 410, 411, 412, 413, 414, 532, 533, 534, 535, 536, 537, 538, 539, 540, 541, 542, 543, 544, 545, 546, 547, 548, 549, 550, 551, 552, 553, 554, 555, 556, 50, 51, 557, 558, 559, 560, 561, 562, 563, 564, 565, 566, 567, 568, 569, 498, 570, 571, 572, 521, 522, 523, 524, 573, 574], resources: { "frameConstants": 0, "push": 2, "grass": 6, "map": 7, "sunMap": 8, "seenSamples": 9 } },
  sunVertex: { head: "", pieces: [2, 3, 19, 20, 21, 22, 23, 24, 25, 26, 34, 35, 36, 37, 38, 517, 575], resources: { "frameConstants": 0 } },
  filmVertex: { head: "", pieces: [576], resources: {} },
  filmFragment: { head: "", pieces: [577, 573, 578, 579, 580, 581, 582], resources: { "resolvedPicture": 0 } }
};
var places = {
  Push: { size: 176, members: { "pyramid.size": 0, "pyramid.first[0]": 16, "pyramid.first[1]": 32, "pyramid.first[2]": 48, "pyramid.first[3]": 64, "pyramid.first[4]": 80, "pyramid.first[5]": 96, "pyramid.first[6]": 112, "pyramid.levels": 128, "size": 144, "patchCount": 152, "tick": 156, "isIdPass": 160, "firstBlade": 164, "capacity": 168 } },
  Material: { size: 16, members: { "color": 0, "isDoubleSided": 12 } },
  Patch: { size: 112, members: { "boundsLow": 0, "firstBlade": 12, "boundsHigh": 16, "bladeCount": 28, "rootLow": 32, "rootStep": 44, "coneAxis": 48, "coneCosine": 60, "heightLow": 64, "heightStep": 68, "widthLow": 72, "widthStep": 76, "parent": 80, "firstChild": 84, "childCount": 88, "level": 92, "rankLow": 96, "rankHigh": 100 } }
};

// src/render/webgpu/memory.ts
var maxVisible = 1 << 22;
var maxQuads = 1 << 18;
var maxRowBlocks = 1 << 20;
var counterWords = 8;
var argumentWords = 12;
function makeBuffer(device, label, size2, usage) {
  const most = Math.min(device.limits.maxBufferSize, device.limits.maxStorageBufferBindingSize);
  if (size2 > most) fail("unsupported", `this device has room for ${most} bytes of ${label}, not for ${size2}`);
  return device.createBuffer({ label, size: Math.max(Math.ceil(size2 / 16) * 16, 16), usage });
}
function filledBuffer(device, label, data, usage) {
  const buffer2 = makeBuffer(device, label, data.byteLength, usage | GPUBufferUsage.COPY_DST);
  const whole = data.byteLength - data.byteLength % 4;
  device.queue.writeBuffer(buffer2, 0, data.buffer, data.byteOffset, whole);
  return buffer2;
}
var FieldMemory = class {
  constructor(device, field, scene) {
    this.device = device;
    this.field = field;
    const { STORAGE, COPY_DST, COPY_SRC, UNIFORM, INDIRECT, VERTEX, INDEX } = GPUBufferUsage;
    const blades = Math.max(field.bladeCount, 1);
    const make2 = (label, size2, usage = 0) => makeBuffer(device, label, size2, STORAGE | COPY_DST | usage);
    this.capacity = Math.min(blades, maxVisible);
    this.uploaded = new Uint8Array(field.pageCount);
    this.present = new Uint32Array(Math.ceil(Math.max(field.pageCount, 1) / 32));
    const corners = scene.cover.corners;
    this.buffers = {
      looks: filledBuffer(device, "looks", new Uint8Array(looksBlock(field).bytes), UNIFORM),
      blades: make2("blades", 4 * bladeWords * pageBlades * Math.max(field.pageCount, 1)),
      states: statesOf(device, blades),
      patches: filledBuffer(device, "patches", patchTable2(field), STORAGE),
      widest: filledBuffer(device, "widths", subtreeWidths(field.patches), STORAGE),
      grass: filledBuffer(device, "cover", corners, STORAGE),
      patchTimes: make2("patch times", 4 * field.patches.count),
      present: make2("pages", this.present.byteLength),
      visiblePatches: make2("visible patches", 8 * field.patches.count),
      visible: make2("visible blades", 16 * this.capacity),
      counters: make2("counters", 4 * counterWords, COPY_SRC),
      arguments: make2("arguments", 4 * argumentWords, INDIRECT),
      quads: make2("quads", 80 * maxQuads),
      rowBlocks: make2("rows", 4 * maxRowBlocks),
      map: make2("blade shadow", 8 * bladeShadowTexels * bladeShadowTexels)
    };
    this.sunMap = device.createTexture({
      label: "sun map",
      size: [sunMapSize, sunMapSize],
      format: "depth32float",
      usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.TEXTURE_BINDING
    });
    this.vertices = filledBuffer(device, "ground", field.ground.vertices, VERTEX);
    this.indices = filledBuffer(device, "triangles", field.ground.indices, INDEX);
    this.parts = this.groundParts();
  }
  device;
  field;
  /** Buffers by the names of bindings. */
  buffers;
  sunMap;
  vertices;
  indices;
  parts;
  /** Visible blades at most. */
  capacity;
  uploaded;
  present;
  groundParts() {
    const { device, field } = this;
    const white = imageTexture2(device, { width: 1, height: 1, pixels: new Uint8Array([255, 255, 255, 255]) });
    const images = field.ground.images.map((image) => imageTexture2(device, image));
    return field.ground.ranges.filter((range) => range.level === 0 && range.indexCount > 0).map((range) => {
      const material = field.ground.materials[range.material];
      const bytes = new ArrayBuffer(places.Material.size);
      new Float32Array(bytes).set(material.baseColor.slice(0, 3), places.Material.members.color / 4);
      new Uint32Array(bytes)[places.Material.members.isDoubleSided / 4] = material.isDoubleSided ? 1 : 0;
      return {
        first: range.firstIndex,
        count: range.indexCount,
        isDoubleSided: material.isDoubleSided,
        material: filledBuffer(device, "material", new Uint8Array(bytes), GPUBufferUsage.UNIFORM),
        image: images[material.image] ?? white
      };
    });
  }
  /** Copies the pages that have come to the device. */
  uploadPages() {
    const { device, field } = this;
    if (field.presentPages === 0) return;
    const bytes = 4 * pageBlades * bladeWords;
    let hasChanged = false;
    for (let page = 0; page < field.pageCount; ++page) {
      if (this.uploaded[page] || !field.has(page * pageBlades, 1)) continue;
      let end = page + 1;
      while (end < field.pageCount && !this.uploaded[end] && field.has(end * pageBlades, 1)) ++end;
      const words = field.packed.subarray(page * bytes / 4, end * bytes / 4);
      device.queue.writeBuffer(this.buffers.blades, page * bytes, words.buffer, words.byteOffset, words.byteLength);
      this.uploaded.fill(1, page, end);
      for (let p = page; p < end; ++p) this.present[p >> 5] |= 1 << (p & 31);
      hasChanged = true;
    }
    if (hasChanged) device.queue.writeBuffer(this.buffers.present, 0, this.present);
  }
  destroy() {
    for (const one of Object.values(this.buffers)) one.destroy();
    for (const one of [this.sunMap, this.vertices, this.indices]) one.destroy();
    for (const part of this.parts) {
      part.material.destroy();
      part.image.destroy();
    }
  }
};
function statesOf(device, blades) {
  const { STORAGE, COPY_DST } = GPUBufferUsage;
  const buffer2 = makeBuffer(device, "states", 4 * blades, STORAGE | COPY_DST);
  const step = 1 << 20;
  const words = new Uint32Array(Math.min(step, blades)).fill(unsettledTurn);
  for (let first = 0; first < blades; first += step)
    device.queue.writeBuffer(buffer2, 4 * first, words, 0, Math.min(step, blades - first));
  return buffer2;
}
function patchTable2(field) {
  const stride = places.Patch.size / 4;
  const table = new Uint32Array(Math.max(field.patches.count, 1) * stride);
  for (let p = 0; p < field.patches.count; ++p)
    table.set(field.patches.words.subarray(p * patchWords, (p + 1) * patchWords), p * stride);
  return table;
}
var toLinear = Float32Array.from(
  { length: 256 },
  (_, i) => i / 255 <= 0.04045 ? i / 255 / 12.92 : ((i / 255 + 0.055) / 1.055) ** 2.4
);
var steps = 4095;
var toBytes = Uint8Array.from({ length: steps + 1 }, (_, i) => {
  const x = i / steps;
  return Math.round(255 * (x <= 31308e-7 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
});
function halved({ width, height, pixels }) {
  const [w, h] = [Math.max(width >> 1, 1), Math.max(height >> 1, 1)];
  const half = new Uint8Array(4 * w * h);
  for (let y = 0; y < h; ++y) {
    const [above, below] = [2 * y, Math.min(2 * y + 1, height - 1)].map((row) => row * width);
    for (let x = 0; x < w; ++x) {
      const [left, right] = [2 * x, Math.min(2 * x + 1, width - 1)];
      const four = [above + left, above + right, below + left, below + right];
      for (let c = 0; c < 4; ++c) {
        let sum = 0;
        for (const texel of four) sum += c < 3 ? toLinear[pixels[4 * texel + c]] : pixels[4 * texel + c];
        half[4 * (y * w + x) + c] = c < 3 ? toBytes[Math.round(0.25 * sum * steps)] : Math.round(0.25 * sum);
      }
    }
  }
  return { width: w, height: h, pixels: half };
}
function imageTexture2(device, image) {
  const most = device.limits.maxTextureDimension2D;
  let level = image;
  while (level.width > most || level.height > most) level = halved(level);
  const count = Math.floor(Math.log2(Math.max(level.width, level.height))) + 1;
  const texture = device.createTexture({
    label: "image of the ground",
    size: [level.width, level.height],
    mipLevelCount: count,
    format: "rgba8unorm-srgb",
    usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST
  });
  for (let i = 0; i < count; ++i) {
    const pixels = new Uint8Array(level.pixels);
    const size2 = [level.width, level.height];
    device.queue.writeTexture({ texture, mipLevel: i }, pixels, { bytesPerRow: 4 * level.width }, size2);
    level = halved(level);
  }
  return texture;
}

// src/render/webgpu/stages.ts
var textOf = (name) => stages[name].head + stages[name].pieces.map((i) => pieces2[i]).join("\n");
var bindingsOf = (name) => stages[name].resources;
function ownOverrides(text, overrides) {
  return Object.fromEntries(Object.entries(overrides).filter(([name]) => text.includes(`override ${name} `)));
}
async function computeStage(device, name, overrides) {
  const code = textOf(name);
  const module = device.createShaderModule({ label: name, code });
  const pipeline = await device.createComputePipelineAsync({
    label: name,
    layout: "auto",
    compute: { module, entryPoint: "main", constants: ownOverrides(code, overrides) }
  });
  return { pipeline, bindings: bindingsOf(name) };
}
async function drawingStage(device, vertex, fragment, state) {
  const { vertex: buffers, targets, ...rest2 } = state;
  const module = (name) => device.createShaderModule({ label: name, code: textOf(name) });
  const pipeline = await device.createRenderPipelineAsync({
    label: fragment ?? vertex,
    layout: "auto",
    vertex: { module: module(vertex), entryPoint: "main", buffers: buffers ?? [] },
    ...fragment ? { fragment: { module: module(fragment), entryPoint: "main", targets: targets ?? [] } } : {},
    ...rest2
  });
  return { pipeline, bindings: { ...bindingsOf(vertex), ...fragment ? bindingsOf(fragment) : {} } };
}

// src/render/webgpu/passes.ts
var ticksPerSecond = 262144;
var samples = 4;
var pushBytes = places.Push.size;
var argumentsPatches = 0;
var argumentsBlades = 16;
var argumentsRows = 32;
var firstBlade = 1;
function pyramidLevels(width, height) {
  const levels = [];
  let first = 0;
  for (let bits = 2; levels.length < 7; bits += 2) {
    const [x, y] = [width, height].map((pixels) => Math.max(Math.ceil(pixels / 2 ** bits), 1));
    levels.push({ first, cells: x * y });
    first += x * y;
    if (x === 1 && y === 1) break;
  }
  return levels;
}
var nearestBits = 1065353216;
var Picture2 = class {
  constructor(device, width, height) {
    this.device = device;
    this.width = width;
    this.height = height;
    const { RENDER_ATTACHMENT, TEXTURE_BINDING, STORAGE_BINDING } = GPUTextureUsage;
    const make2 = (label, format, sampleCount, usage) => device.createTexture({ label, size: [width, height], format, sampleCount, usage });
    this.visibility = makeBuffer(device, "visibility", 8 * samples * width * (4 * Math.ceil(height / 4)), GPUBufferUsage.STORAGE);
    this.levels = pyramidLevels(width, height);
    const last = this.levels[this.levels.length - 1];
    this.nearest = new Uint32Array(last.first + last.cells).fill(nearestBits);
    this.cells = makeBuffer(device, "pyramid", this.nearest.byteLength, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST);
    this.depth = make2("depth", "depth32float", samples, RENDER_ATTACHMENT | TEXTURE_BINDING);
    this.light = make2("light of the ground", "rgba16float", samples, RENDER_ATTACHMENT | TEXTURE_BINDING);
    this.resolved = make2("picture", "rgba16float", 1, STORAGE_BINDING | TEXTURE_BINDING);
  }
  device;
  width;
  height;
  depth;
  light;
  resolved;
  visibility;
  levels;
  cells;
  /** What the pyramid begins with. */
  nearest;
  /** Levels beyond the first are made by minima. */
  beginPyramid() {
    this.device.queue.writeBuffer(this.cells, 0, this.nearest);
  }
  destroy() {
    for (const one of [this.cells, this.depth, this.light, this.resolved, this.visibility]) one.destroy();
  }
};
var computeNames = ["walk", "arguments", "update", "seed", "resolve", "records"];
var rasterNames = ["raster", "rasterQuads", "shadow"];
var Pipelines = class _Pipelines {
  constructor(compute, has64, groundDepth, ground, sun, film) {
    this.compute = compute;
    this.has64 = has64;
    this.groundDepth = groundDepth;
    this.ground = ground;
    this.sun = sun;
    this.film = film;
  }
  compute;
  has64;
  groundDepth;
  ground;
  sun;
  film;
  /** Compiles all of them side by side. `format`: of the texture that the film is drawn into. */
  static async make(device, field, format) {
    const overrides = overridesOf(field);
    const stage2 = (name) => computeStage(device, name, overrides);
    const position = { shaderLocation: 0, offset: 0, format: "float32x3" };
    const layout = (attributes) => [{ arrayStride: groundVertexBytes, attributes }];
    const all = layout([
      position,
      { shaderLocation: 1, offset: 12, format: "uint32" },
      { shaderLocation: 2, offset: 16, format: "float32x2" },
      { shaderLocation: 3, offset: 24, format: "unorm8x4" }
    ]);
    const depthOf = (depthCompare, depthWriteEnabled) => ({
      format: "depth32float",
      depthCompare,
      depthWriteEnabled
    });
    const sides = ["back", "none"];
    const [plain, raster, groundDepth, ground, sun, film] = await Promise.all([
      Promise.all(computeNames.map(stage2)),
      rasterStages(device, stage2),
      Promise.all(
        sides.map(
          (cullMode) => drawingStage(device, "groundVertex", null, {
            vertex: all,
            primitive: { cullMode },
            multisample: { count: samples },
            depthStencil: depthOf("greater", true)
          })
        )
      ),
      Promise.all(
        sides.map(
          (cullMode) => drawingStage(device, "groundVertex", "groundFragment", {
            vertex: all,
            primitive: { cullMode },
            multisample: { count: samples },
            depthStencil: depthOf("equal", false),
            targets: [{ format: "rgba16float" }]
          })
        )
      ),
      drawingStage(device, "sunVertex", null, { vertex: layout([position]), depthStencil: depthOf("greater", true) }),
      drawingStage(device, "filmVertex", "filmFragment", { targets: [{ format }] })
    ]);
    const compute = Object.fromEntries([
      ...computeNames.map((name, i) => [name, plain[i]]),
      ...rasterNames.map((name, i) => [name, raster.stages[i]])
    ]);
    return new _Pipelines(compute, raster.has64, groundDepth, ground, sun, film);
  }
};
async function rasterStages(device, stage2) {
  if (hasAtomic64(device)) {
    try {
      return { stages: await Promise.all(rasterNames.map((name) => stage2(`${name}64`))), has64: true };
    } catch {
    }
  }
  return { stages: await Promise.all(rasterNames.map(stage2)), has64: false };
}
var Passes = class {
  constructor(device, field, scene, pipelines) {
    this.device = device;
    this.field = field;
    this.scene = scene;
    this.pipelines = pipelines;
    this.memory = new FieldMemory(device, field, scene);
    const uniform = (label, size2) => makeBuffer(device, label, size2, GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST);
    this.frames = { eye: uniform("frame", frameBytes), sun: uniform("frame of the sun", frameBytes) };
    this.pushes = {
      eye: uniform("push", pushBytes),
      eyeIds: uniform("push", pushBytes),
      sun: uniform("push", pushBytes),
      sunIds: uniform("push", pushBytes)
    };
    this.sampler = device.createSampler({
      addressModeU: "repeat",
      addressModeV: "repeat",
      magFilter: "linear",
      minFilter: "linear",
      mipmapFilter: "linear"
    });
  }
  device;
  field;
  scene;
  pipelines;
  picture;
  memory;
  frames;
  pushes;
  sampler;
  groups = /* @__PURE__ */ new Map();
  sunOf = "";
  staging = [];
  /** Of a frame that has ended. */
  counts = { blades: 0, quads: 0, rows: 0, moved: 0 };
  destroy() {
    this.picture?.destroy();
    this.memory.destroy();
  }
  /** The bind group of a stage. `view`: whose frame and push it has; `ids`: that of the pass of ids. */
  group(stage2, view, ids = false, target) {
    const key = `${stage2.pipeline.label} ${view} ${ids} ${target ?? ""}`;
    const known = this.groups.get(key);
    if (known) return known;
    const picture = this.picture;
    const { buffers, sunMap } = this.memory;
    const textures = {
      sunMap,
      groundDepth: picture.depth,
      groundLight: picture.light,
      resolved: picture.resolved,
      resolvedPicture: picture.resolved
    };
    const resource = (name) => {
      if (name === "frameConstants") return { buffer: this.frames[view] };
      if (name === "push") return { buffer: this.pushes[ids ? `${view}Ids` : view] };
      if (name === "seenSamples") return { buffer: target === "map" ? buffers.map : picture.visibility };
      if (name === "cellBits") return { buffer: picture.cells };
      return textures[name]?.createView() ?? { buffer: buffers[name] };
    };
    const made = this.device.createBindGroup({
      label: key,
      layout: stage2.pipeline.getBindGroupLayout(0),
      entries: Object.entries(stage2.bindings).map(([name, binding]) => ({ binding, resource: resource(name) }))
    });
    this.groups.set(key, made);
    return made;
  }
  /** Draws a frame into `target`. `time`: of the wind [s]. */
  draw(input, target, width, height, timing) {
    const { device, memory, pipelines } = this;
    if (this.picture?.width !== width || this.picture.height !== height) {
      this.picture?.destroy();
      this.picture = new Picture2(device, width, height);
      this.groups.clear();
    }
    memory.uploadPages();
    this.picture.beginPyramid();
    this.writeFrames(input, width, height);
    const encoder = device.createCommandEncoder();
    this.drawSunMap(encoder, input);
    const { buffers } = memory;
    const timed = timerOf(timing);
    const compute = (name, act) => {
      const pass = encoder.beginComputePass({ label: name, timestampWrites: timed(name) });
      act(pass);
      pass.end();
    };
    const run = (pass, name, view, ids = false, map) => {
      const stage2 = pipelines.compute[name];
      pass.setPipeline(stage2.pipeline);
      pass.setBindGroup(0, this.group(stage2, view, ids, map));
    };
    const walk = (pass, view) => {
      const groups = Math.ceil(this.field.patches.count / 64);
      if (groups === 0) return;
      run(pass, "walk", view);
      pass.dispatchWorkgroups(Math.min(groups, 4096), Math.ceil(groups / 4096));
      run(pass, "arguments", view);
      pass.dispatchWorkgroups(1);
    };
    const passesOfSamples = pipelines.has64 ? [false] : [false, true];
    this.drawGround(encoder, "ground depth", true, timed);
    encoder.clearBuffer(buffers.counters);
    compute("seed", (pass) => {
      run(pass, "seed", "eye");
      pass.dispatchWorkgroups(Math.ceil(width / 16), Math.ceil(height / 16));
    });
    compute("walk", (pass) => walk(pass, "eye"));
    compute("update", (pass) => {
      run(pass, "update", "eye");
      pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsPatches);
      run(pass, "arguments", "eye");
      pass.dispatchWorkgroups(1);
    });
    for (const ids of passesOfSamples) {
      compute(ids ? "blades, ids" : "blades", (pass) => {
        run(pass, "raster", "eye", ids);
        pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsBlades);
        if (ids) return;
        run(pass, "arguments", "eye");
        pass.dispatchWorkgroups(1);
      });
      compute(ids ? "large, ids" : "large", (pass) => {
        run(pass, "rasterQuads", "eye", ids);
        pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsRows);
      });
    }
    if (input.shadowDistance > 0 && input.light.sunColor[0] > 0) {
      encoder.clearBuffer(buffers.counters, 0, 4);
      encoder.clearBuffer(buffers.map);
      compute("shadow", (pass) => {
        walk(pass, "sun");
        for (const ids of passesOfSamples) {
          run(pass, "shadow", "sun", ids, "map");
          pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsPatches);
        }
      });
    } else encoder.clearBuffer(buffers.map);
    this.drawGround(encoder, "ground light", false, timed);
    compute("resolve", (pass) => {
      run(pass, "resolve", "eye");
      pass.dispatchWorkgroups(Math.ceil(width / 8), Math.ceil(height / 8));
    });
    const film = encoder.beginRenderPass({
      label: "film",
      colorAttachments: [{ view: target, loadOp: "clear", storeOp: "store" }],
      timestampWrites: timed("film")
    });
    film.setPipeline(pipelines.film.pipeline);
    film.setBindGroup(0, this.group(pipelines.film, "eye"));
    film.draw(3);
    film.end();
    const read = this.staging.pop() ?? device.createBuffer({ label: "counts", size: 4 * counterWords, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    encoder.copyBufferToBuffer(buffers.counters, 0, read, 0, 4 * counterWords);
    device.queue.submit([encoder.finish()]);
    void this.readCounts(read);
  }
  async readCounts(read) {
    try {
      await read.mapAsync(GPUMapMode.READ);
    } catch {
      return;
    }
    const [, blades, quads, rows, moved] = new Uint32Array(read.getMappedRange());
    this.counts = { blades, quads, rows, moved };
    read.unmap();
    this.staging.push(read);
  }
  writeFrames(input, width, height) {
    const { device, scene } = this;
    const eye = frameBlock(scene, input);
    const depthOfEye = [2, 6, 10, 14].reduce(
      (sum, at, i) => sum + input.view.viewProjection[at] * (i < 3 ? input.view.eye[i] : 1),
      0
    );
    eye.floats("depthOfEye", [depthOfEye]);
    device.queue.writeBuffer(this.frames.eye, 0, eye.bytes);
    const push = (buffer2, size2, isIdPass) => {
      const block = new Block(places.Push.members, pushBytes);
      block.words("size", size2);
      block.words("patchCount", [this.field.patches.count]);
      block.words("tick", [Math.round(input.time % 16384 * ticksPerSecond)]);
      block.words("isIdPass", [isIdPass ? 1 : 0]);
      block.words("firstBlade", [firstBlade]);
      block.words("capacity", [this.memory.capacity]);
      if (buffer2 === this.pushes.eye) {
        const { levels } = this.picture;
        block.words("pyramid.size", size2);
        block.words("pyramid.levels", [levels.length]);
        levels.forEach((level, i) => block.words(`pyramid.first[${i}]`, [level.first]));
      }
      device.queue.writeBuffer(buffer2, 0, block.bytes);
    };
    push(this.pushes.eye, [width, height], false);
    push(this.pushes.eyeIds, [width, height], true);
    if (!(input.shadowDistance > 0)) return;
    const rows = shadowRows(input.view, input.camera, input.light.sunDirection, input.shadowDistance);
    const sun = frameBlock(scene, input);
    shadowPlanes(rows).forEach((plane, i) => sun.floats(`view.planes[${i}]`, plane));
    sun.floats("view.minWidth", [0]);
    sun.words("view.cullMask", [cullDistance | cullFrustum | leaveThinned | 1]);
    sun.floats("viewProjection", [0, 1, 2, 3].flatMap((k) => [rows[0][k], rows[1][k], rows[2][k], k === 3 ? 1 : 0]));
    device.queue.writeBuffer(this.frames.sun, 0, sun.bytes);
    push(this.pushes.sun, [bladeShadowTexels, bladeShadowTexels], false);
    push(this.pushes.sunIds, [bladeShadowTexels, bladeShadowTexels], true);
  }
  /** The ground as the sun sees it, when the sun has moved. */
  drawSunMap(encoder, input) {
    const key = input.light.sunDirection.join();
    if (this.sunOf === key) return;
    this.sunOf = key;
    const { memory, pipelines } = this;
    const pass = encoder.beginRenderPass({
      label: "sun map",
      colorAttachments: [],
      depthStencilAttachment: {
        view: memory.sunMap.createView(),
        depthClearValue: 0,
        depthLoadOp: "clear",
        depthStoreOp: "store"
      }
    });
    pass.setPipeline(pipelines.sun.pipeline);
    pass.setBindGroup(0, this.group(pipelines.sun, "eye"));
    pass.setVertexBuffer(0, memory.vertices);
    pass.setIndexBuffer(memory.indices, "uint32");
    for (const part of memory.parts) pass.drawIndexed(part.count, 1, part.first);
    pass.end();
  }
  /** Depths of the ground, or its light where samples show it. */
  drawGround(encoder, label, isDepth, timed) {
    const { memory, pipelines } = this;
    const picture = this.picture;
    const pass = encoder.beginRenderPass({
      label,
      colorAttachments: isDepth ? [] : [{ view: picture.light.createView(), clearValue: [0, 0, 0, 0], loadOp: "clear", storeOp: "store" }],
      depthStencilAttachment: isDepth ? { view: picture.depth.createView(), depthClearValue: 0, depthLoadOp: "clear", depthStoreOp: "store" } : { view: picture.depth.createView(), depthReadOnly: true },
      timestampWrites: timed(label)
    });
    pass.setVertexBuffer(0, memory.vertices);
    pass.setIndexBuffer(memory.indices, "uint32");
    memory.parts.forEach((part, i) => {
      const stage2 = (isDepth ? pipelines.groundDepth : pipelines.ground)[part.isDoubleSided ? 1 : 0];
      pass.setPipeline(stage2.pipeline);
      pass.setBindGroup(0, this.group(stage2, "eye", false, `${label} ${part.isDoubleSided}`));
      if (!isDepth) pass.setBindGroup(1, this.materialGroup(stage2, i));
      pass.drawIndexed(part.count, 1, part.first);
    });
    pass.end();
  }
  materialGroup(stage2, i) {
    const key = `material ${i}`;
    const known = this.groups.get(key);
    if (known) return known;
    const part = this.memory.parts[i];
    const made = this.device.createBindGroup({
      label: key,
      layout: stage2.pipeline.getBindGroupLayout(1),
      entries: [
        { binding: 0, resource: { buffer: part.material } },
        { binding: 1, resource: part.image.createView() },
        { binding: 2, resource: this.sampler }
      ]
    });
    this.groups.set(key, made);
    return made;
  }
  /** Curves of the blades that the last frame drew, for tests: 12 words each (web/shaders/webgpu/records.comp). */
  async readRecords() {
    const { device, memory, pipelines } = this;
    const size2 = 48 * memory.capacity;
    const { STORAGE, COPY_SRC, COPY_DST, MAP_READ } = GPUBufferUsage;
    const records = makeBuffer(device, "records", size2, STORAGE | COPY_SRC);
    memory.buffers.records = records;
    const read = device.createBuffer({ size: records.size + 4 * counterWords, usage: MAP_READ | COPY_DST });
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipelines.compute.records.pipeline);
    pass.setBindGroup(0, this.group(pipelines.compute.records, "eye"));
    pass.dispatchWorkgroups(Math.min(Math.ceil(memory.capacity / 64), 4096), Math.ceil(memory.capacity / 64 / 4096));
    pass.end();
    encoder.copyBufferToBuffer(records, 0, read, 0, records.size);
    encoder.copyBufferToBuffer(memory.buffers.counters, 0, read, records.size, 4 * counterWords);
    device.queue.submit([encoder.finish()]);
    await read.mapAsync(GPUMapMode.READ);
    const words = new Uint32Array(read.getMappedRange()).slice();
    read.destroy();
    records.destroy();
    delete memory.buffers.records;
    this.groups.clear();
    return words.subarray(0, 12 * Math.min(words[records.size / 4 + 1], memory.capacity));
  }
};
function timerOf(timing) {
  if (!timing) return () => void 0;
  timing.names.length = 0;
  return (name) => {
    const at = 2 * timing.names.length;
    timing.names.push(name);
    return { querySet: timing.set, beginningOfPassWriteIndex: at, endOfPassWriteIndex: at + 1 };
  };
}

// src/render/webgpu/renderer.ts
var usualMax2 = 4e6;
var WebGpuRenderer = class _WebGpuRenderer {
  constructor(canvas, context, device, field, scene, passes) {
    this.canvas = canvas;
    this.context = context;
    this.device = device;
    this.field = field;
    this.passes = passes;
    this.scene = scene;
    this.tree = new PatchTree(field);
    void device.lost.then(() => {
      this.wasLost = true;
    });
  }
  canvas;
  context;
  device;
  field;
  passes;
  kind = "webgpu";
  /** Fields that are sown are drawn by WebGL. */
  sowing = void 0;
  scene;
  tree;
  lodThreshold = frameSettings.lodThreshold;
  wasLost = false;
  isStopped = false;
  /**
   * A renderer; undefined where there is no WebGPU. The canvas may have no other context. Without a canvas it draws
   * pictures for readPicture(). `acceptsSoftware`: also a device that is the processor.
   */
  static async make(canvas, field, cover = noCover, { device, acceptsSoftware = false } = {}) {
    const own = device ?? await openDevice({ acceptsSoftware });
    if (!own) return void 0;
    const format = canvas ? navigator.gpu.getPreferredCanvasFormat() : "rgba8unorm";
    const scene = sceneOf(field, cover);
    try {
      const pipelines = await Pipelines.make(own, field, format);
      const passes = new Passes(own, field, scene, pipelines);
      const context = canvas?.getContext("webgpu") ?? void 0;
      if (canvas && !context) return void 0;
      context?.configure({ device: own, format, alphaMode: "opaque" });
      return new _WebGpuRenderer(canvas, context, own, field, scene, passes);
    } catch (error) {
      if (!(error instanceof SwardError)) console.warn(error);
      if (!device) own.destroy();
      return void 0;
    }
  }
  /** The sun as the viewer has it by default. */
  get usualLight() {
    const up = unit(scaled(this.field.defaults.gravity.direction, -1));
    return { ...usualLight, sunDirection: turnedWith(up, usualLight.sunDirection) };
  }
  get isLost() {
    return this.wasLost;
  }
  /** Calls back when the device is lost, unless stop() ended it. */
  onLost(act) {
    void this.device.lost.then(() => {
      if (!this.isStopped) act();
    });
  }
  /** Frees all that lies on the device. */
  stop() {
    this.isStopped = true;
    this.passes.destroy();
    this.context?.unconfigure();
    this.device.destroy();
  }
  /** Draws a picture as large as the canvas. `isFine` changes nothing: all pictures have four samples a pixel. */
  draw(input) {
    const { width, height } = this.canvas;
    return this.drawInto(input, this.context.getCurrentTexture().createView(), width, height);
  }
  /** Whether samples are written by atomics of 64 bits; else by two passes of 32 bits. */
  get has64() {
    return this.passes.pipelines.has64;
  }
  /** What a frame that has ended drew. */
  get counts() {
    return this.passes.counts;
  }
  /** Draws into a texture. `timing`: where passes note when they begin and end. */
  drawInto(input, target, width, height, timing) {
    const { field, scene, passes } = this;
    const view = viewOf(input.camera, field.origin, width, height, scene.content);
    this.adapt(input.maxBlades ?? usualMax2);
    const frame = {
      view,
      camera: input.camera,
      light: input.light ?? this.usualLight,
      wind: input.wind ?? 1,
      time: input.time,
      shadowDistance,
      lodThreshold: this.lodThreshold,
      sparseFrom: 0,
      sparseLeast: 1
    };
    passes.draw(frame, target, width, height, timing);
    let missing = [];
    if (!field.isComplete)
      missing = this.tree.groupsOf(
        {
          eye: view.eye,
          planes: view.planes,
          drawDistance: field.defaults.drawDistance,
          pixelsPerUnit: view.pixelsPerUnit,
          lodThreshold: this.lodThreshold,
          lodWidth: scene.bladeWidth,
          minWidth: minWidthOf(view),
          sparseFrom: 0,
          sparseLeast: 1
        },
        Infinity
      ).missing;
    return { blades: passes.counts.moved, missing };
  }
  /** Level of detail follows the number of blades that the frames before had. */
  adapt(most) {
    const { moved } = this.passes.counts;
    const usual = frameSettings.lodThreshold;
    const ratio = Math.sqrt(moved / most);
    if (ratio > 1.15) this.lodThreshold *= Math.min(ratio, 2);
    else if (ratio > 1) this.lodThreshold *= 1.02;
    else if (ratio < 0.9) this.lodThreshold = Math.max(this.lodThreshold / 1.05, usual);
  }
  /** Draws a picture and returns it: rows from the top, four bytes a pixel, sRGB. */
  async readPicture(input, width, height, timing) {
    const { device } = this;
    const format = this.canvas ? navigator.gpu.getPreferredCanvasFormat() : "rgba8unorm";
    const { RENDER_ATTACHMENT, COPY_SRC } = GPUTextureUsage;
    const texture = device.createTexture({ size: [width, height], format, usage: RENDER_ATTACHMENT | COPY_SRC });
    this.drawInto(input, texture.createView(), width, height, timing);
    const bytesPerRow = 256 * Math.ceil(4 * width / 256);
    const read = device.createBuffer({ size: bytesPerRow * height, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    const encoder = device.createCommandEncoder();
    encoder.copyTextureToBuffer({ texture }, { buffer: read, bytesPerRow }, [width, height]);
    device.queue.submit([encoder.finish()]);
    await read.mapAsync(GPUMapMode.READ);
    const rows = new Uint8Array(read.getMappedRange());
    const pixels = new Uint8ClampedArray(4 * width * height);
    for (let y = 0; y < height; ++y) pixels.set(rows.subarray(y * bytesPerRow, y * bytesPerRow + 4 * width), 4 * width * y);
    if (format === "bgra8unorm")
      for (let i = 0; i < pixels.length; i += 4) [pixels[i], pixels[i + 2]] = [pixels[i + 2], pixels[i]];
    read.destroy();
    texture.destroy();
    return pixels;
  }
  /** Curves of the blades that the last picture drew, 12 words each; for tests. */
  readRecords() {
    return this.passes.readRecords();
  }
};

// src/render/choice.ts
async function makeRenderer(canvas, field, cover, kind, sowing) {
  if (sowing && kind === "webgpu")
    fail("usage", `${field.name}: a field that is sown is drawn by WebGL; sow: false shows its stored blades by WebGPU`);
  if (kind !== "webgl" && !sowing) {
    const own = await WebGpuRenderer.make(canvas, field, cover, { acceptsSoftware: kind === "webgpu" });
    if (own) return own;
    if (kind === "webgpu") fail("unsupported", "this browser has no WebGPU for this field, or its graphics driver is blocked");
  }
  return new Renderer(canvas, field, cover, sowing);
}

// src/sow/module.ts
var kinds = { 1: "usage", 2: "io", 3: "input", 4: "runtime", 5: "unsupported" };
var unitWords = 8;
var eyeNumbers = 9;
function numbersOf(meadow, species, origin) {
  const flag = (value) => value ? 1 : 0;
  const m = meadow;
  const list = [
    ...m.seed,
    m.density,
    m.scale,
    m.clumpSpacing,
    m.stored,
    m.unitBits,
    m.levels,
    flag(m.isMixed),
    m.heightWaves,
    m.drifts,
    m.sparseHeight,
    m.wideVariation,
    m.creaseReach,
    m.creaseBlend,
    m.vertical,
    flag(m.isRadial),
    ...m.up,
    m.highest,
    m.widest,
    ...origin,
    m.species.length
  ];
  m.species.forEach((one, i) => {
    list.push(one.share, ...one.height, ...one.width, ...one.stiffness, one.clumping, one.facing, one.ribbons);
    const organs = species[i].organs;
    list.push(organs.length);
    for (const organ of organs) list.push(organ.count, ...organ.length, organ.width, organ.variation);
  });
  return Float64Array.from(list);
}
var SowModule = class {
  exports;
  unit;
  eyes = 0;
  eyeCount = 0;
  /** `place` is for messages. */
  constructor(module, place) {
    const refuse = (kind, message, bytes) => {
      const text = new TextDecoder().decode(new Uint8Array(this.exports.memory.buffer, message, bytes));
      throw new SwardError(kinds[kind] ?? "runtime", `${place}: ${text}`);
    };
    this.exports = new WebAssembly.Instance(module, { sward: { refuse } }).exports;
    this.exports._initialize();
    this.unit = this.exports.take(4 * unitWords);
  }
  begin(numbers, entries) {
    const at = this.put(numbers);
    const table = this.put(entries);
    this.exports.begin(at, table, entries.length / 48);
    this.exports.give(table);
    this.exports.give(at);
  }
  /** Opens a cell: `plain` is its frame without zstd. */
  openCell(index, plain) {
    const at = this.put(plain);
    this.exports.openCell(index, at, plain.length);
    this.exports.give(at);
  }
  closeCell(index) {
    this.exports.closeCell(index);
  }
  /** Grows a unit of an open cell. */
  grow(unit2) {
    this.writeUnit(unit2);
    const at = this.exports.grow(this.unit);
    const { buffer: buffer2 } = this.exports.memory;
    const [patches, patchCount, blades, bladeCount, keys, whole] = new Uint32Array(buffer2, at, 6);
    const words = (from, count) => new Uint32Array(buffer2, from, count).slice();
    return {
      patches: words(patches, patchWords * patchCount),
      blades: words(blades, 4 * bladeCount),
      keys: words(keys, 2 * bladeCount),
      whole: words(whole, patchWords),
      widest: new Float32Array(buffer2, at + 24, 1)[0]
    };
  }
  /** The eyes of find() and score(). */
  look(eyes) {
    const numbers = eyes.flatMap((one) => [
      ...one.eye,
      one.drawDistance,
      one.pixelsPerUnit,
      one.lodThreshold,
      one.lodWidth,
      one.sparseFrom,
      one.sparseLeast
    ]);
    if (this.eyes !== 0) this.exports.give(this.eyes);
    this.eyes = this.put(Float64Array.from(numbers));
    this.eyeCount = numbers.length / eyeNumbers;
  }
  /** All that the eyes want, in falling order of scores. */
  find() {
    const count = this.exports.find(this.eyes, this.eyeCount);
    const at = this.exports.found();
    const words = new Uint32Array(this.exports.memory.buffer, at, unitWords * count);
    const floats = new Float32Array(this.exports.memory.buffer, at, unitWords * count);
    return Array.from({ length: count }, (_, i) => {
      const w = words.subarray(unitWords * i, unitWords * (i + 1));
      return { score: floats[unitWords * i], isCell: w[1] !== 0, cell: w[2], level: w[3], half: w[4], place: [w[5], w[6], w[7]] };
    });
  }
  /** Score of any unit. */
  score(unit2) {
    this.writeUnit(unit2);
    return this.exports.score(this.unit, this.eyes, this.eyeCount);
  }
  /** render::sparseDistance(). */
  sparseDistance(room, bladesPerArea, blades, low, high, full, nearest) {
    return this.exports.sparseDistance(room, bladesPerArea, blades, ...low, ...high, full, nearest);
  }
  writeUnit(unit2) {
    new Uint32Array(this.exports.memory.buffer, this.unit, unitWords).set([0, 0, unit2.cell, unit2.level, unit2.half, ...unit2.place]);
  }
  /** A copy in the module's memory, at a multiple of 16. */
  put(array) {
    const at = this.exports.take(Math.max(array.byteLength, 1));
    new Uint8Array(this.exports.memory.buffer).set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), at);
    return at;
  }
};
async function compileSower(bytes, place) {
  try {
    return await WebAssembly.compile(bytes);
  } catch {
    fail("unsupported", `${place}: the sower does not run in this browser`);
  }
}

// src/sow/sower.ts
var replacing = 1.19;
var unitsAtOnce = 16;
var cellsAtOnce = 4;
var maxOpenCells = 96;
var unitName = (unit2) => [unit2.cell, unit2.level, unit2.half, ...unit2.place].join();
var Sower = class {
  /** `later` runs a step once other messages have been heard. */
  constructor(tell, later) {
    this.tell = tell;
    this.later = later;
  }
  tell;
  later;
  module;
  room = 0;
  used = 0;
  blades = 0;
  place = "";
  present = /* @__PURE__ */ new Map();
  wanted = [];
  next = 0;
  flying = 0;
  /** Open cells, the last used one at the end. */
  open = /* @__PURE__ */ new Set();
  asked = /* @__PURE__ */ new Set();
  isFull = false;
  isBusy = false;
  hasFailed = false;
  lookNumber = 0;
  hear(message) {
    try {
      this.take(message);
      this.wake();
    } catch (error) {
      this.failWith(error);
    }
  }
  take(message) {
    switch (message.kind) {
      case "begin":
        this.place = message.place;
        this.room = message.pages;
        this.module = new SowModule(message.module, message.place);
        this.module.begin(message.numbers, message.entries);
        break;
      case "cell":
        this.asked.delete(message.cell);
        this.module.openCell(message.cell, unpackFrame(message.frame, void 0, `${this.place}: seeds of cell ${message.cell}`));
        this.open.add(message.cell);
        if (this.open.size > maxOpenCells) {
          const oldest = this.open.values().next().value;
          this.open.delete(oldest);
          this.module.closeCell(oldest);
        }
        this.choose();
        break;
      case "look":
        this.lookNumber = message.number;
        this.module.look(message.eyes);
        for (const one of this.present.values()) one.score = this.module.score(one.unit);
        this.choose();
        break;
      case "taken":
        --this.flying;
        break;
      case "forget":
        this.present.clear();
        this.used = this.blades = 0;
        this.choose();
    }
  }
  choose() {
    this.wanted = this.module.find();
    this.next = 0;
    this.isFull = false;
  }
  wake() {
    if (this.isBusy || this.hasFailed || !this.module) return;
    this.isBusy = true;
    this.later(() => {
      this.isBusy = false;
      try {
        if (this.step()) this.wake();
      } catch (error) {
        this.failWith(error);
      }
    });
  }
  failWith(error) {
    this.hasFailed = true;
    if (!(error instanceof SwardError)) throw error;
    this.tell({ kind: "failed", error: error.kind, message: error.message }, []);
  }
  /** Grows one unit, or asks for cells. Whether there is more to do now. */
  step() {
    let ready = false;
    for (; this.next < this.wanted.length && !this.isFull; ++this.next) {
      const one = this.wanted[this.next];
      if (!one.isCell && this.present.has(unitName(one))) continue;
      if (one.isCell || !this.open.has(one.cell)) {
        if (!this.ask(one.cell)) break;
        continue;
      }
      if (this.flying >= unitsAtOnce) break;
      this.bring(one);
      ready = true;
      break;
    }
    this.report();
    return ready;
  }
  /** Asks for a cell. Whether more may be asked for. */
  ask(cell) {
    if (this.asked.has(cell)) return true;
    if (this.asked.size >= cellsAtOnce) return false;
    this.asked.add(cell);
    this.tell({ kind: "wants", cell }, []);
    return true;
  }
  bring(one) {
    const unit2 = { cell: one.cell, level: one.level, half: one.half, place: one.place };
    this.open.delete(one.cell);
    this.open.add(one.cell);
    const pages = pagesOf(this.module.grow(unit2));
    if (!this.makeRoom(pages.count, one.score)) {
      this.isFull = true;
      return;
    }
    const name = unitName(unit2);
    this.present.set(name, { unit: unit2, score: one.score, pages: pages.count, blades: pages.bladeCount });
    if (pages.count === 0) return;
    this.used += pages.count;
    this.blades += pages.bladeCount;
    ++this.flying;
    const moved = [pages.blades.buffer, pages.patches.buffer];
    this.tell({ kind: "unit", name, unit: unit2, pages }, moved);
  }
  /** Removes units that are wanted less than `score` until so many pages are free. Whether they are. */
  makeRoom(pages, score) {
    const names = [];
    if (this.room - this.used < pages) {
      const least = [...this.present].filter(([, one]) => one.pages > 0 && one.score * replacing < score).sort(([, a], [, b]) => a.score - b.score);
      let free = this.room - this.used;
      for (const [name, one] of least) {
        if (free >= pages) break;
        free += one.pages;
        names.push(name);
      }
      if (free < pages) return false;
    }
    for (const name of names) {
      const one = this.present.get(name);
      this.used -= one.pages;
      this.blades -= one.blades;
      this.present.delete(name);
    }
    if (names.length > 0) this.tell({ kind: "gone", names }, []);
    return true;
  }
  report() {
    let missing = 0;
    let missingScore = 0;
    for (const one of this.wanted)
      if (one.isCell || !this.present.has(unitName(one))) {
        ++missing;
        missingScore = Math.max(missingScore, one.score);
      }
    this.tell({ kind: "state", state: { look: this.lookNumber, missing, missingScore, isFull: this.isFull, blades: this.blades } }, []);
  }
};

// src/sow/worker.ts
var sowerName = "sward-sower";
var scope = globalThis;
if (scope.WorkerGlobalScope !== void 0 && scope.name === sowerName) {
  const sower = new Sower(
    (message, moved) => scope.postMessage(message, moved),
    // Messages that have come are heard first.
    (step) => setTimeout(step)
  );
  scope.onmessage = (event) => sower.hear(event.data);
}

// src/sow/sowing.ts
var usualBlades = 4e6;
var pagesOfFrame = 192;
var ignoredStep = 0.2;
var ignoredPart = 0.01;
var maxThinning = 8;
var thinningStep = 1.1;
var Sowing = class _Sowing {
  constructor(field, options, module) {
    this.field = field;
    this.options = options;
    const seeds = field.seeds;
    const { meadow } = seeds;
    this.bladesPerStored = 1 / Math.min(meadow.stored, 1);
    this.areaPerStored = this.bladesPerStored / meadow.storedWidening;
    this.pageCount = Math.max(Math.ceil((options.blades ?? usualBlades) / sownPageBlades), 16);
    this.storedPatches = field.patches.count;
    this.firstPatch = Math.ceil(this.storedPatches / 256) * 256;
    this.firstBlade = Math.ceil(field.bladeCount / sownPageBlades) * sownPageBlades;
    const words = new Uint32Array(patchWords * (this.firstPatch + this.pageCount * sownPagePatches));
    words.set(field.patches.words);
    this.patches = new Patches(new Uint8Array(words.buffer));
    for (let p = 0; p < this.storedPatches; ++p)
      this.patches.floats[patchWords * p + patchWord.widthStep] /= meadow.storedWidening;
    for (let page = this.pageCount; page-- > 0; ) this.free.push(page);
    const numbers = numbersOf(meadow, field.species, field.origin);
    this.local = new SowModule(module, field.name);
    this.local.begin(numbers, new Uint8Array(0));
    this.start();
    this.tell({ kind: "begin", module, numbers, entries: seeds.entries, pages: this.pageCount, place: field.name });
  }
  field;
  options;
  /** All patches: the stored ones with the widths of the whole meadow, then places for those of pages. */
  patches;
  /** Patches that are stored. */
  storedPatches;
  /** First patch and first blade of the first page. */
  firstPatch;
  firstBlade;
  /** Places for pages. */
  pageCount;
  /** Blades of the whole meadow that a stored one stands for, and the leaf area of these over that of the stored one. */
  bladesPerStored;
  areaPerStored;
  /** Pages whose rows have changed since the last update(). */
  changed = [];
  units = /* @__PURE__ */ new Map();
  free = [];
  local;
  arrived = [];
  looked;
  state = { look: 0, missing: 1, missingScore: maxThinning, isFull: false, blades: 0 };
  looks = 0;
  thinned = 0;
  tell = () => {
  };
  worker;
  isStopped = false;
  /** Begins to sow a field, which must have seeds. */
  static async open(field, options = {}) {
    if (!field.isSown) fail("usage", `${field.name}: has no seeds of which some blades are stored`);
    const bytes = options.wasm ?? await wasmBeside();
    return new _Sowing(field, options, await compileSower(bytes, field.name));
  }
  /** Ends its work. */
  stop() {
    this.isStopped = true;
    this.worker?.terminate();
    this.tell = () => {
    };
  }
  /** Factor by which the threshold of level of detail is raised while blades are missing, 1 to 8. */
  get thinning() {
    return Math.max(this.thinned, 1);
  }
  /** Whether further frames with this eye change nothing. */
  get isSettled() {
    return this.looks === this.state.look && this.looks > 0 && this.arrived.length === 0 && (this.state.missing === 0 || this.state.isFull) && this.thinned === this.wantedThinning;
  }
  /** Whether the next frame shows something else than the last one. */
  get hasNews() {
    return this.arrived.length > 0 || this.thinned !== this.wantedThinning;
  }
  /** Blades that are sown now. */
  get bladeCount() {
    return this.state.blades;
  }
  /** Distance beyond which less is drawn, for an eye: render::sparseDistance(). `full`: up to which all is drawn [m]. */
  sparseDistance(low, high, full, nearest) {
    const { meadow } = this.field.seeds;
    let shares = 0;
    let blades = 0;
    for (const kind of meadow.species) {
      shares += kind.share;
      blades += kind.share * (1 + kind.ribbons);
    }
    const perArea = meadow.density * (shares > 0 ? blades / shares : 1);
    const all = this.field.bladeCount * this.bladesPerStored;
    return this.local.sparseDistance(this.pageCount * sownPageBlades, perArea, all, low, high, full, nearest);
  }
  /** Takes over what has come, at most 6 MB, and tells the sower where the eye is. Call once a frame. */
  update(eye) {
    if (!this.looked || hasMoved(this.looked, eye)) {
      this.looked = eye;
      this.tell({ kind: "look", number: ++this.looks, eyes: [eye] });
    }
    let room = pagesOfFrame;
    while (this.arrived.length > 0 && room > 0) {
      const { name, pages } = this.arrived.shift();
      this.add(name, pages);
      room -= pages.count;
      this.tell({ kind: "taken" });
    }
    const wanted = this.wantedThinning;
    this.thinned = this.thinned === 0 ? wanted : Math.min(Math.max(wanted, this.thinned / thinningStep), this.thinned * thinningStep);
  }
  /** All is sown anew: the device was lost. */
  forget() {
    for (const name of [...this.units.keys()]) this.remove(name);
    for (let i = 0; i < this.arrived.length; ++i) this.tell({ kind: "taken" });
    this.arrived = [];
    this.changed = [];
    this.looked = void 0;
    this.tell({ kind: "forget" });
  }
  /** Numbers of the patches of units: `visit` is told the one that bounds a unit, and returns whether it is seen. */
  walk(seesUnit, visit) {
    for (const unit2 of this.units.values()) {
      if (!seesUnit(this.firstPatch + sownPagePatches * unit2.pages[0])) continue;
      unit2.pages.forEach((page, i) => {
        const first = this.firstPatch + sownPagePatches * page;
        for (let p = i === 0 ? 1 : 0; p < unit2.patchCounts[i]; ++p) visit(first + p);
      });
    }
  }
  get wantedThinning() {
    return Math.min(Math.max(this.state.missingScore, 1), maxThinning);
  }
  start() {
    const hear = (message) => {
      if (!this.isStopped) this.hear(message);
    };
    const inPage = () => {
      const sower = new Sower(hear, (step) => setTimeout(step));
      this.tell = (message) => sower.hear(message);
    };
    if (this.options.worker === false || typeof Worker === "undefined") return inPage();
    try {
      this.worker = new Worker(new URL("./sward.js", import.meta.url), { type: "module", name: sowerName });
    } catch {
      return inPage();
    }
    const sent = [];
    let hasAnswered = false;
    this.tell = (message) => {
      if (!hasAnswered) sent.push(message);
      this.worker.postMessage(message);
    };
    this.worker.onmessage = (event) => {
      hasAnswered = true;
      sent.length = 0;
      hear(event.data);
    };
    this.worker.onerror = (event) => {
      event.preventDefault();
      if (hasAnswered) return this.end(new SwardError("runtime", `${this.field.name}: sowing has stopped`));
      this.worker?.terminate();
      inPage();
      for (const message of sent) this.tell(message);
    };
  }
  hear(message) {
    switch (message.kind) {
      case "wants":
        this.field.seeds.frame(message.cell).then(
          (frame) => this.tell({ kind: "cell", cell: message.cell, frame }),
          (error) => this.end(error)
        );
        break;
      case "unit":
        this.arrived.push(message);
        this.options.onChange?.();
        break;
      case "gone":
        for (const name of message.names) {
          const at = this.arrived.findIndex((one) => one.name === name);
          if (at >= 0) {
            this.arrived.splice(at, 1);
            this.tell({ kind: "taken" });
          } else {
            this.remove(name);
          }
        }
        break;
      case "state": {
        const before = this.wantedThinning;
        this.state = message.state;
        if (this.wantedThinning !== before) this.options.onChange?.();
        break;
      }
      case "failed":
        this.end(new SwardError(message.error, message.message));
    }
  }
  end(error) {
    if (this.isStopped) return;
    this.stop();
    this.state = { ...this.state, look: this.looks, missing: 0, missingScore: 0 };
    this.options.onError?.(error instanceof SwardError ? error : new SwardError("runtime", String(error)));
  }
  add(name, unit2) {
    const pages = Array.from({ length: unit2.count }, () => this.free.pop());
    const words = sownPageBlades * 4;
    pages.forEach((page, i) => {
      const first = this.firstPatch + sownPagePatches * page;
      const own = unit2.patches.subarray(i * sownPagePatches * patchWords, (i + 1) * sownPagePatches * patchWords);
      this.patches.words.set(own, patchWords * first);
      for (let p = 0; p < unit2.patchCounts[i]; ++p)
        this.patches.words[patchWords * (first + p) + patchWord.firstBlade] += this.firstBlade + sownPageBlades * page;
      this.changed.push({ page, blades: unit2.blades.subarray(i * words, (i + 1) * words) });
    });
    this.units.set(name, { pages, patchCounts: unit2.patchCounts });
  }
  remove(name) {
    const unit2 = this.units.get(name);
    if (!unit2) return;
    this.units.delete(name);
    this.free.push(...unit2.pages);
    const gone = new Set(unit2.pages);
    this.changed = this.changed.filter((row) => !gone.has(row.page));
  }
};
function hasMoved(a, b) {
  const step = Math.hypot(a.eye[0] - b.eye[0], a.eye[1] - b.eye[1], a.eye[2] - b.eye[2]);
  const changed = (x, y) => Math.abs(x - y) > ignoredPart * Math.abs(y);
  return step >= ignoredStep || changed(a.pixelsPerUnit, b.pixelsPerUnit) || changed(a.lodThreshold, b.lodThreshold) || a.lodWidth !== b.lodWidth || a.drawDistance !== b.drawDistance || changed(a.sparseFrom, b.sparseFrom);
}
async function wasmBeside() {
  const address = new URL("./sow.wasm", import.meta.url);
  let response;
  try {
    response = await fetch(address);
  } catch {
    fail("io", `${address}: no answer from the server`);
  }
  if (!response.ok) fail("io", `${address}: the server answers ${response.status}`);
  return response.arrayBuffer();
}

// src/page/grass.ts
var firstPages = 384;
var pagesAtOnce = 256;
var Grass = class _Grass {
  constructor(field, renderer) {
    this.field = field;
    this.renderer = renderer;
  }
  field;
  renderer;
  /** Opens a field. `gl`: the host's context, whose state the host forgets afterwards as after draw(). */
  static async open(gl, options) {
    const { onChange, onError } = options;
    const field = await openField(options.field);
    const [cover, sowing] = await Promise.all([
      options.cover ? coverAt(options.cover) : noCover,
      field.isSown && options.sow !== false ? Sowing.open(field, { onChange, onError, ...options.sow }) : void 0,
      field.loadPages(0, Math.min(firstPages, field.pageCount))
    ]);
    const before = enterHost(gl);
    const grass = new _Grass(field, new Renderer(gl.canvas, field, cover, sowing, gl));
    leaveHost(gl, before);
    grass.loadRest(onChange).catch((error) => {
      if (!(error instanceof SwardError)) throw error;
      onError?.(error);
    });
    return grass;
  }
  /**
   * Draws the grass into the host's framebuffer. Call it after the host has drawn its opaque objects, and let the host
   * forget the state of the context afterwards: `renderer.resetState()` of three.js, `engine.wipeCaches(true)` of
   * Babylon.js.
   */
  draw(input) {
    return this.renderer.drawInHost(input);
  }
  /** Ends its work. */
  stop() {
    this.renderer.sowing?.stop();
  }
  async loadRest(onChange) {
    const { field } = this;
    for (let page = 0; page < field.pageCount; page += pagesAtOnce) {
      await field.loadPages(page, Math.min(page + pagesAtOnce, field.pageCount));
      onChange?.();
    }
  }
};
function groundMesh(field) {
  const { ground } = field;
  const floats = new Float32Array(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length / 4);
  const count = ground.vertexCount;
  const mesh = {
    positions: new Float32Array(3 * count),
    uvs: new Float32Array(2 * count),
    colors: new Uint8Array(4 * count),
    // Level 0 alone: the others are the same ground, coarser.
    indices: Uint32Array.from(
      ground.ranges.filter((range) => range.level === 0).flatMap((range) => [...ground.indices.subarray(range.firstIndex, range.firstIndex + range.indexCount)])
    )
  };
  for (let v = 0; v < count; ++v) {
    mesh.positions.set(floats.subarray(7 * v, 7 * v + 3), 3 * v);
    mesh.uvs.set(floats.subarray(7 * v + 4, 7 * v + 6), 2 * v);
    mesh.colors.set(ground.vertices.subarray(28 * v + 24, 28 * v + 28), 4 * v);
  }
  return mesh;
}

// src/page/controls.ts
var eyeHeight = 1.7;
var moves = {
  KeyW: [2, 1],
  ArrowUp: [2, 1],
  KeyS: [2, -1],
  ArrowDown: [2, -1],
  KeyA: [0, -1],
  ArrowLeft: [0, -1],
  KeyD: [0, 1],
  ArrowRight: [0, 1],
  KeyE: [1, 1],
  PageUp: [1, 1],
  KeyQ: [1, -1],
  PageDown: [1, -1]
};
var Controls = class {
  /**
   * `reach` [m]: size of what is shown. `heightAt`: of the ground along `up`, at a place relative to the field's
   * origin. `onChange` is called when something has moved.
   */
  constructor(element, camera, up, reach, origin, heightAt, onChange) {
    this.element = element;
    this.camera = camera;
    this.up = up;
    this.reach = reach;
    this.origin = origin;
    this.heightAt = heightAt;
    this.onChange = onChange;
    element.addEventListener("pointerdown", (event) => {
      if (event.isTrusted) element.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
      this.pinch = this.spread();
    });
    element.addEventListener("pointermove", (event) => this.drag(event));
    for (const name of ["pointerup", "pointercancel"])
      element.addEventListener(name, (event) => {
        this.pointers.delete(event.pointerId);
        this.pinch = this.spread();
      });
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.dolly(Math.exp(clamp(event.deltaY, -200, 200) * 2e-3));
      },
      { passive: false }
    );
    element.addEventListener("keydown", (event) => {
      this.isFast = event.shiftKey;
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.code === "Equal" || event.code === "NumpadAdd") this.dolly(0.9);
      else if (event.code === "Minus" || event.code === "NumpadSubtract") this.dolly(1 / 0.9);
      else if (moves[event.code]) this.held.add(event.code);
      else return;
      event.preventDefault();
      this.onChange();
    });
    element.addEventListener("keyup", (event) => {
      this.isFast = event.shiftKey;
      this.held.delete(event.code);
    });
    element.addEventListener("blur", () => this.held.clear());
  }
  element;
  camera;
  up;
  reach;
  origin;
  heightAt;
  onChange;
  mode = "orbit";
  held = /* @__PURE__ */ new Set();
  pointers = /* @__PURE__ */ new Map();
  pinch = 0;
  isFast = false;
  /** Whether keys are held, so that the camera moves with time. */
  get isMoving() {
    return this.held.size > 0;
  }
  setMode(mode) {
    this.mode = mode;
    if (mode === "walk") this.land();
    this.onChange();
  }
  /** Moves the camera by the keys that are held for `seconds`. */
  step(seconds) {
    if (this.held.size === 0) return;
    const way = [0, 0, 0];
    for (const code of this.held) way[moves[code][0]] += moves[code][1];
    const { right, forward } = axesOf(this.camera);
    if (this.mode === "orbit") {
      this.turnAround(-0.9 * way[0] * seconds, 0.7 * way[2] * seconds);
      if (way[1] !== 0) this.dolly(Math.exp(-way[1] * seconds));
      return;
    }
    const level = unit(sub(forward, scaled(this.up, dot(forward, this.up))), forward);
    const ahead = this.mode === "walk" ? level : forward;
    const speed = (this.mode === "walk" ? 2.5 : 0.15 * this.reach) * (this.isFast ? 3 : 1) * seconds;
    this.shift(add(add(scaled(right, way[0] * speed), scaled(this.up, way[1] * speed)), scaled(ahead, way[2] * speed)));
    if (this.mode === "walk") this.stand();
    this.onChange();
  }
  spread() {
    const [a, b] = [...this.pointers.values()];
    return a && b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  }
  drag(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    const perPixel = Math.PI / Math.max(this.element.clientHeight, 1);
    if (this.pointers.size === 2) {
      const spread = this.spread();
      if (this.pinch > 0 && spread > 0) this.dolly(this.pinch / spread);
      this.pinch = spread;
      this.pan(0.5 * dx, 0.5 * dy);
    } else if (this.mode === "orbit" && (event.buttons !== 1 || event.shiftKey)) this.pan(dx, dy);
    else if (this.mode === "orbit") this.turnAround(-dx * perPixel, -dy * perPixel);
    else this.look(-dx * 0.5 * perPixel, -dy * 0.5 * perPixel);
  }
  /** Turns the eye around the target. */
  turnAround(side, rise) {
    const { camera, up } = this;
    let arm = turned(sub(camera.eye, camera.target), up, side);
    const axis = unit(cross(arm, up), [1, 0, 0]);
    const angle = Math.acos(clamp(dot(unit(arm), up), -1, 1));
    arm = turned(arm, axis, angle - clamp(angle + rise, 0.05, 3.09));
    this.camera = { ...camera, up, eye: this.above(add(camera.target, arm)) };
    this.onChange();
  }
  /** Turns the view around the eye. */
  look(side, rise) {
    const { camera, up } = this;
    let way = turned(sub(camera.target, camera.eye), up, side);
    const axis = unit(cross(way, up), [1, 0, 0]);
    const angle = Math.acos(clamp(dot(unit(way), up), -1, 1));
    way = turned(way, axis, angle - clamp(angle - rise, 0.05, 3.09));
    this.camera = { ...camera, up, target: add(camera.eye, way) };
    this.onChange();
  }
  /** Brings the eye nearer to the target, or moves it ahead. */
  dolly(factor) {
    const { camera } = this;
    const arm = sub(camera.eye, camera.target);
    if (this.mode !== "orbit") this.shift(scaled(unit(arm), 0.1 * this.reach * Math.log(factor)));
    else if (size(arm) * factor > 0.02 && size(arm) * factor < 20 * this.reach)
      this.camera = { ...camera, eye: this.above(add(camera.target, scaled(arm, factor))) };
    if (this.mode === "walk") this.stand();
    this.onChange();
  }
  pan(dx, dy) {
    const { camera } = this;
    const { right, up } = axesOf(camera);
    const metres = 2 * size(sub(camera.eye, camera.target)) * Math.tan(camera.fovYDeg * Math.PI / 360) / Math.max(this.element.clientHeight, 1);
    this.shift(add(scaled(right, -dx * metres), scaled(up, dy * metres)));
    this.onChange();
  }
  shift(way) {
    this.camera = { ...this.camera, eye: add(this.camera.eye, way), target: add(this.camera.target, way) };
  }
  /** The place, lifted above the ground if it lies in it. */
  above(eye) {
    const place = sub(eye, this.origin);
    const ground = this.heightAt(place);
    const lift = ground === void 0 ? 0 : ground + 0.02 - dot(place, this.up);
    return lift > 0 && lift < 0.05 * this.reach ? add(eye, scaled(this.up, lift)) : eye;
  }
  /** Brings the eye above the ground: where it is, else at the target, else in the middle of the field. */
  land() {
    const { camera, up } = this;
    const isOver = (place) => this.heightAt(sub(place, this.origin)) !== void 0;
    if (!isOver(camera.eye)) {
      const to = isOver(camera.target) ? camera.target : this.origin;
      const level = sub(sub(camera.target, camera.eye), scaled(up, dot(sub(camera.target, camera.eye), up)));
      this.camera = { ...camera, eye: to, target: add(to, unit(level, [1, 0, 0])) };
    } else {
      const way = sub(camera.target, camera.eye);
      const level = unit(sub(way, scaled(up, dot(way, up))), [1, 0, 0]);
      this.camera = { ...camera, target: add(camera.eye, level) };
    }
    this.stand();
  }
  /** Puts the eye as high above the ground as a person's. */
  stand() {
    const place = sub(this.camera.eye, this.origin);
    const ground = this.heightAt(place);
    if (ground === void 0) return;
    this.shift(scaled(this.up, ground + eyeHeight - dot(place, this.up)));
  }
};

// src/page/ground_height.ts
var cells = 512;
var GroundHeight = class {
  along;
  across;
  heights = new Float32Array(cells * cells).fill(NaN);
  low = [Infinity, Infinity];
  step = [1, 1];
  constructor(ground, up) {
    const side = Math.abs(up[0]) < 0.7 ? [1, 0, 0] : [0, 0, 1];
    this.along = unit(sub(side, scaled(up, dot(side, up))));
    this.across = cross(up, this.along);
    const floats = new Float32Array(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length / 4);
    const places2 = new Float32Array(3 * ground.vertexCount);
    const high = [-Infinity, -Infinity];
    for (let v = 0; v < ground.vertexCount; ++v) {
      const p = [floats[7 * v], floats[7 * v + 1], floats[7 * v + 2]];
      const place = [dot(p, this.along), dot(p, this.across), dot(p, up)];
      places2.set(place, 3 * v);
      for (const i of [0, 1]) {
        this.low[i] = Math.min(this.low[i], place[i]);
        high[i] = Math.max(high[i], place[i]);
      }
    }
    this.step = [0, 1].map((i) => Math.max((high[i] - this.low[i]) / (cells - 1), 1e-6));
    for (const range of ground.ranges)
      if (range.level === 0)
        for (let i = range.firstIndex; i < range.firstIndex + range.indexCount; i += 3)
          this.fill([0, 1, 2].map((k) => places2.subarray(3 * ground.indices[i + k], 3 * ground.indices[i + k] + 3)));
  }
  /** Height along `up` at a place, both relative to the field's origin; undefined beside the ground. */
  at(place) {
    const x = (dot(place, this.along) - this.low[0]) / this.step[0];
    const y = (dot(place, this.across) - this.low[1]) / this.step[1];
    const [i, j] = [Math.floor(x), Math.floor(y)];
    if (i < 0 || j < 0 || i + 1 >= cells || j + 1 >= cells) return void 0;
    const [u, v] = [x - i, y - j];
    const corner = (k, l) => this.heights[(j + l) * cells + i + k];
    const height = (corner(0, 0) * (1 - u) + corner(1, 0) * u) * (1 - v) + (corner(0, 1) * (1 - u) + corner(1, 1) * u) * v;
    return Number.isNaN(height) ? void 0 : height;
  }
  /** The grid's points below a triangle. */
  fill(corners) {
    const [a, b, c] = corners.map((p) => [(p[0] - this.low[0]) / this.step[0], (p[1] - this.low[1]) / this.step[1], p[2]]);
    const area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if (Math.abs(area) < 1e-12) return;
    const first = (i) => Math.max(Math.ceil(Math.min(a[i], b[i], c[i]) - 1e-6), 0);
    const last = (i) => Math.min(Math.floor(Math.max(a[i], b[i], c[i]) + 1e-6), cells - 1);
    for (let y = first(1); y <= last(1); ++y)
      for (let x = first(0); x <= last(0); ++x) {
        const v = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area;
        const w = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
        if (v < -1e-4 || w < -1e-4 || v + w > 1.0001) continue;
        const height = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]);
        const at = y * cells + x;
        if (!(this.heights[at] >= height)) this.heights[at] = height;
      }
  }
};

// src/page/panel.ts
var megabytes = (bytes) => `${(bytes / 1e6).toFixed(1)} MB`;
function make(name, attributes, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}
var Panel = class {
  constructor(element, canvas) {
    this.element = element;
    element.classList.add("sward");
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute(
      "aria-label",
      "A field of grass in three dimensions. Arrow keys turn the view, plus and minus come nearer and go away."
    );
    this.poster = element.querySelector(".sward-poster");
    element.replaceChildren(canvas, ...this.poster ? [this.poster] : [], this.message, this.bar, this.note);
    this.say("The field is coming.");
  }
  element;
  message = make("p", { class: "sward-message", role: "status", "aria-live": "polite" });
  bar = make("progress", { class: "sward-progress", "aria-label": "Blades that have come", max: "1" });
  note = make("small", { class: "sward-note", role: "note" });
  poster;
  hasFailed = false;
  /** Shows a text; none if it is empty. */
  say(text) {
    if (this.hasFailed) return;
    this.message.textContent = text;
    this.message.hidden = text === "";
  }
  /** Shows an error instead of anything else. */
  fail(error) {
    const text = error instanceof SwardError ? error.message : "The field cannot be shown: something unexpected happened.";
    if (!(error instanceof SwardError)) console.error(error);
    this.say(text);
    this.hasFailed = true;
    this.message.setAttribute("role", "alert");
    this.message.classList.add("sward-error");
    this.bar.hidden = true;
  }
  /** The first picture is there: that of the page fades, or goes at once where less motion is asked for. */
  begin() {
    const { poster } = this;
    if (!poster) return;
    poster.classList.add("sward-gone");
    if (parseFloat(getComputedStyle(poster).transitionDuration) > 0)
      poster.addEventListener("transitionend", () => poster.remove());
    else poster.remove();
  }
  /** Says that the blades between the stored ones of a field with seeds are missing. */
  lacksBlades(error) {
    const why = error instanceof SwardError ? error.message : String(error);
    this.note.append(`These are the stored blades of a field with seeds; the others are not sown: ${why} `);
  }
  /** Bytes of a file that comes as a whole. */
  receive(received, total) {
    this.bar.value = received / Math.max(total, 1);
    this.say(`${megabytes(received)} of ${megabytes(total)}`);
  }
  /** How much of a field is here. */
  progress(field) {
    const share = field.pageCount > 0 ? field.presentPages / field.pageCount : 1;
    this.bar.value = share;
    this.bar.hidden = share >= 1;
    if (this.hasFailed) return;
    this.say(share >= 1 ? "" : `${Math.floor(100 * share)} % of ${field.bladeCount.toLocaleString("en")} blades`);
  }
  /** Adds the controls of a view. */
  control(view) {
    const modes = [
      ["orbit", "Orbit", "Drag turns around the field, right drag moves it, the wheel comes nearer"],
      ["fly", "Fly", "Drag looks around; W A S D or arrows fly, E and Q rise and sink, Shift is faster"],
      ["walk", "Walk", "Drag looks around; W A S D or arrows walk on the ground"]
    ];
    const usable = modes.filter(([mode]) => mode !== "walk" || view.field.defaults.gravity.blend === 0);
    const buttons = usable.map(([mode, text, title]) => {
      const button = make("button", { type: "button", title, "aria-pressed": String(mode === "orbit") }, text);
      button.addEventListener("click", () => {
        view.setMode(mode);
        buttons.forEach((other) => other.setAttribute("aria-pressed", String(other === button)));
        view.canvas.focus();
      });
      return button;
    });
    const home = make("button", { type: "button", title: "Show all of the field" }, "Home");
    home.addEventListener("click", () => view.setCamera(view.wholeView()));
    const slider = (text, low, high, step, value, shown2, set) => {
      const input = make("input", {
        type: "range",
        min: String(low),
        max: String(high),
        step: String(step),
        value: String(value),
        "aria-label": text,
        "aria-valuetext": shown2(value)
      });
      const output = make("output", {}, shown2(value));
      input.addEventListener("input", () => {
        set(input.valueAsNumber);
        output.textContent = shown2(input.valueAsNumber);
        input.setAttribute("aria-valuetext", output.textContent);
        view.change();
      });
      return make("label", {}, make("span", {}, text), input, output);
    };
    const clock = (hour) => `${Math.floor(hour)}:${String(Math.round(hour % 1 * 60)).padStart(2, "0")}`;
    const tools = make(
      "div",
      { class: "sward-tools", role: "toolbar", "aria-label": "View of the field" },
      ...buttons,
      home,
      slider("Wind", 0, 3, 0.1, view.wind, (x) => `${Math.round(100 * x)} %`, (x) => view.wind = x),
      slider("Time", 5.25, 18.75, 0.25, view.hour, clock, (x) => view.hour = x),
      slider("Detail", -2, 2, 0.5, 0, (x) => `×${2 ** x < 1 ? (2 ** x).toFixed(2) : (2 ** x).toFixed(1)}`, (x) => view.detail = 2 ** x)
    );
    const cameras = view.field.defaults.cameras;
    if (cameras.length > 0) {
      const select = make(
        "select",
        { "aria-label": "Saved view" },
        ...cameras.map((camera, i) => make("option", { value: String(i) }, camera.name))
      );
      select.addEventListener("change", () => view.setCamera(cameras[select.selectedIndex]));
      tools.append(select);
    }
    this.note.append(view.field.defaults.copyright);
    this.element.append(tools);
  }
};

// src/page/page.ts
var firstPages2 = 384;
var pagesAtOnce2 = 128;
var requestsAtOnce = 4;
var minBlades = 6e4;
var firstBlades = { webgl: 15e4, webgpu: 1e6 };
var maxBlades = { webgl: 2e6, webgpu: 4e6 };
var messageTime = 6e3;
var longestFrame = 0.1;
var rest = 250;
var FieldView = class {
  constructor(element, field, renderer, panel, camera) {
    this.element = element;
    this.field = field;
    this.renderer = renderer;
    this.panel = panel;
    this.budget = firstBlades[renderer.kind];
    const isPlanet = field.defaults.gravity.blend > 0;
    this.heights = isPlanet ? void 0 : new GroundHeight(field.ground, this.up);
    this.observer = new ResizeObserver(() => this.resize());
    this.adopt(renderer, camera ?? field.defaults.cameras[0]);
    document.addEventListener("visibilitychange", this.wake);
    requestAnimationFrame(this.tick);
  }
  element;
  field;
  renderer;
  canvas;
  panel;
  controls;
  /** Pictures drawn. */
  frames = 0;
  /** Milliseconds from one frame to the next, smoothed. */
  frameTime = 0;
  /** Factor of the field's wind. */
  wind = 1;
  /** Hour of the day, 5 to 19; at 9 the sun stands as in the viewer. */
  hour = 9;
  /** Factor of the number of blades that are drawn at most. */
  detail = 1;
  time = 0;
  last = 0;
  isDirty = true;
  changedAt = 0;
  isRefined = false;
  requests = 0;
  budget;
  isLost = false;
  isStopped = false;
  hasFailed = false;
  observer;
  heights;
  stillness = matchMedia("(prefers-reduced-motion: reduce)");
  /** Takes a renderer with its canvas. */
  adopt(renderer, camera) {
    this.renderer = renderer;
    this.canvas = renderer.canvas;
    const { content } = renderer.scene;
    this.resize();
    this.controls = new Controls(
      this.canvas,
      camera ?? this.wholeView(),
      this.up,
      size(sub(content.high, content.low)),
      this.field.origin,
      (place) => this.heights?.at(place),
      () => this.change()
    );
    this.observer.disconnect();
    this.observer.observe(this.canvas);
    const wasLost = () => {
      this.isLost = true;
      this.panel.say("The graphics device was lost. The picture comes back when it does.");
    };
    if (renderer.kind === "webgpu") {
      renderer.onLost(() => {
        wasLost();
        void this.replaceRenderer();
      });
      return;
    }
    this.canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      wasLost();
    });
    this.canvas.addEventListener("webglcontextrestored", () => {
      renderer.restore();
      this.isLost = false;
      this.panel.say("");
      this.change();
    });
  }
  /** Goes on with another device, or by WebGL 2, on a new canvas. */
  async replaceRenderer() {
    const { mode, camera } = this.controls;
    const canvas = this.canvas.cloneNode();
    this.canvas.replaceWith(canvas);
    try {
      this.adopt(await makeRenderer(canvas, this.field, this.renderer.scene.cover), camera);
    } catch (error) {
      this.panel.fail(error);
      return;
    }
    this.controls.setMode(mode);
    this.budget = firstBlades[this.renderer.kind];
    this.isLost = false;
    const isOther = this.renderer.kind === "webgl";
    this.panel.say(isOther ? "The graphics device was lost. Now WebGL draws." : "");
    if (isOther) setTimeout(() => this.panel.say(""), messageTime);
    this.change();
  }
  /** Up direction of the field, against gravity. */
  get up() {
    return unit(scaled(this.field.defaults.gravity.direction, -1));
  }
  /** A camera that shows all of the field. */
  wholeView() {
    const { renderer, field, canvas } = this;
    const aspect = canvas.width / canvas.height;
    return fittingCamera(renderer.scene.content, field.origin, this.up, renderer.usualLight.sunDirection, aspect);
  }
  setMode(mode) {
    this.controls.setMode(mode);
  }
  setCamera(camera) {
    this.controls.camera = camera;
    this.change();
  }
  /** Asks for a new picture: something has changed. */
  change() {
    this.isDirty = true;
    this.isRefined = false;
    this.changedAt = performance.now();
  }
  /** Ends the work in the element. */
  stop() {
    this.isStopped = true;
    this.observer.disconnect();
    document.removeEventListener("visibilitychange", this.wake);
    this.renderer.sowing?.stop();
    if (this.renderer.kind === "webgpu") this.renderer.stop();
  }
  wake = () => {
    this.last = 0;
    this.change();
  };
  resize() {
    const ratio = Math.min(devicePixelRatio || 1, 2);
    const width = Math.max(Math.round(this.canvas.clientWidth * ratio), 1);
    const height = Math.max(Math.round(this.canvas.clientHeight * ratio), 1);
    if (this.canvas.width === width && this.canvas.height === height) return;
    this.canvas.width = width;
    this.canvas.height = height;
    this.change();
  }
  tick = (now) => {
    if (this.isStopped) return;
    requestAnimationFrame(this.tick);
    if (this.isLost || document.hidden) return;
    const since = this.last > 0 ? now - this.last : 0;
    this.last = now;
    this.controls.step(Math.min(since / 1e3, longestFrame));
    const blows = this.wind > 0 && !this.stillness.matches;
    const isResting = !blows && !this.controls.isMoving && performance.now() - this.changedAt > rest;
    if (!blows && !this.isDirty && (!isResting || this.isRefined)) return;
    const elapsed = blows ? Math.min(since / 1e3, longestFrame) : 0;
    this.isDirty = this.renderer.sowing?.hasNews ?? false;
    this.isRefined = isResting && !this.isDirty;
    this.draw(elapsed, isResting);
    if (blows && since > 0) this.adapt(since);
  };
  draw(elapsed, isFine) {
    this.time += elapsed;
    const { azimuth, elevation } = sunAt(this.hour);
    const stats = this.renderer.draw({
      camera: this.controls.camera,
      time: this.time,
      elapsed,
      light: this.hour === 9 ? void 0 : lightAt(azimuth, elevation, this.up),
      wind: this.wind,
      // A picture at rest may take longer.
      maxBlades: this.budget * this.detail * (isFine ? 2 : 1),
      isFine
    });
    if (++this.frames === 1) this.panel.begin();
    this.load(stats.missing);
  }
  /** Fewer blades where frames take long, more where they do not. */
  adapt(since) {
    this.frameTime = this.frameTime === 0 ? since : 0.9 * this.frameTime + 0.1 * since;
    const slow = clamp(40 / this.frameTime, 0.3, 0.97);
    if (this.frameTime > 45) this.budget = Math.max(slow * this.budget, minBlades);
    else if (this.frameTime < 20) this.budget = Math.min(1.02 * this.budget, maxBlades[this.renderer.kind]);
  }
  /** Fetches what is visible and not here, then the rest. */
  load(missing) {
    const { field, panel } = this;
    panel.progress(field);
    if (field.isComplete || this.hasFailed || this.requests >= requestsAtOnce) return;
    let wanted = missing.slice(0, pagesAtOnce2);
    for (let page = 0; wanted.length < pagesAtOnce2 && page < field.pageCount; ++page)
      if (field.isMissing(page) && !wanted.includes(page)) wanted.push(page);
    wanted = wanted.sort((a, b) => a - b);
    if (wanted.length === 0) return;
    ++this.requests;
    loadRuns(field, wanted).then(() => this.change()).catch((error) => {
      this.hasFailed = true;
      panel.fail(error);
    }).finally(() => {
      --this.requests;
      panel.progress(field);
    });
  }
};
async function loadRuns(field, pages) {
  const runs = [];
  for (const page of pages) {
    const last = runs[runs.length - 1];
    if (last && page - last[1] < 4) last[1] = page + 1;
    else runs.push([page, page + 1]);
  }
  for (const [from, to] of runs) await field.loadPages(from, to);
}
function sunAt(hour) {
  const rise = (h) => Math.sin(Math.PI * (h - 5) / 14);
  return {
    azimuth: usualSun.azimuth + 15 * (hour - 9),
    elevation: usualSun.elevation * rise(hour) / rise(9)
  };
}
async function showField(element, options) {
  const canvas = document.createElement("canvas");
  const panel = new Panel(element, canvas);
  try {
    const field = await openField(options.field, {
      onProgress: (received, total) => panel.receive(received, total)
    });
    panel.progress(field);
    const [cover] = await Promise.all([
      options.cover ? coverAt(options.cover) : noCover,
      field.loadPages(0, Math.min(firstPages2, field.pageCount))
    ]);
    const sowing = await sowingOf(field, options, panel, () => view.change());
    const renderer = await makeRenderer(canvas, field, cover, options.renderer, sowing);
    const view = new FieldView(element, field, renderer, panel, options.camera);
    if (options.panel ?? true) panel.control(view);
    return view;
  } catch (error) {
    panel.fail(error);
    throw error;
  }
}
async function sowingOf(field, options, panel, onChange) {
  if (!field.isSown || options.sow === false) return void 0;
  const onError = (error) => panel.lacksBlades(error);
  try {
    return await Sowing.open(field, { onChange, onError, ...options.sow });
  } catch (error) {
    onError(error);
    return void 0;
  }
}
export {
  Field,
  FieldView,
  Grass,
  Patches,
  Renderer,
  SowModule,
  Sowing,
  SwardError,
  WebGpuRenderer,
  bladeId,
  compileSower,
  fittingCamera,
  groundMesh,
  lightAt,
  makeRenderer,
  noCover,
  numbersOf,
  openDevice,
  openField,
  pageBlades,
  pagesOf,
  parseCoverFile,
  patchWord,
  patchWords,
  readField,
  shaders_exports as shaders,
  showField,
  unpackFrame,
  usualLight,
  usualSun,
  textOf as wgslOf,
  xxh3
};
