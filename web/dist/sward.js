// Built from web/src by `npm run build`; do not edit.
// Sward, MIT licence. Contains fzstd, MIT licence, copyright (c) 2020 Arjun Barrett.

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
  const unit = (key, value, high = 1) => reader.number(key, value, 0, high);
  return {
    rootColor: reader.vector("root_color", usual.rootColor, 0, 1),
    tipColor: reader.vector("tip_color", usual.tipColor, 0, 1),
    tipThreshold: unit("tip_threshold", usual.tipThreshold, 0.99),
    groundTint: unit("ground_tint", usual.groundTint),
    colorVariation: unit("color_variation", usual.colorVariation),
    translucency: unit("translucency", usual.translucency),
    gloss: unit("gloss", usual.gloss),
    dryness: unit("dryness", usual.dryness),
    shape: reader.word("shape", shapeNames, usual.shape),
    fold: unit("fold", usual.fold)
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
  const kinds = species.reduce((sum, one) => sum + one.organs.length, 0);
  if (kinds > maxOrganKinds)
    fail("input", `${place}: ${kinds} organs of all species, more than ${maxOrganKinds}`);
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
    const places = [rootXY & 65535, rootXY >>> 16, rootZUp & 65535];
    for (let axis = 0; axis < 3; ++axis)
      blades.root[3 * i + axis] = f[at + patchWord.rootLow + axis] + single(step * places[axis]);
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
  const size = Math.hypot(x, y, z);
  up[at] = x / size;
  up[at + 1] = y / size;
  up[at + 2] = z / size;
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

// ../../../h-web/npm/node_modules/fzstd/esm/index.mjs
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
  const size = BigInt(length);
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
    h ^= (h >> 35n) + size;
    h = h * 0x9fb21c651e98df25n & mask;
    return h ^ h >> 28n;
  }
  if (length <= 16) {
    const low = long(0) ^ (secretAt(24) ^ secretAt(32));
    const high = long(length - 8) ^ (secretAt(40) ^ secretAt(48));
    return avalanche(size + swap64(low) + high + foldedProduct(low, high) & mask);
  }
  let sum = size * prime64[1];
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
  const blocks = Math.floor((length - 1) / blockBytes);
  for (let i = 0; i < blocks; ++i) {
    hash.addBlock(words, i * blockBytes / 4);
    if (i % 4096 === 4095) yield;
  }
  const stripes = Math.floor((length - 1 - blocks * blockBytes) / stripe);
  for (let i = 0; i < stripes; ++i)
    hash.addStripe(words, (blocks * blockBytes + i * stripe) / 4, secretWords, 2 * i);
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
  const steps = longHash(bytes);
  for (; ; ) {
    const step = steps.next();
    if (step.done) return step.value;
  }
}
async function xxh3InSteps(bytes) {
  if (bytes.length <= 240) return shortHash(bytes);
  const steps = longHash(bytes);
  for (; ; ) {
    const step = steps.next();
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
  constructor(source, head) {
    this.source = source;
    this.head = head;
    const place = source.name;
    const view = new DataView(head.buffer, head.byteOffset, head.length);
    for (let i = 0; i < magic.length; ++i)
      if (head[i] !== magic.charCodeAt(i))
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
    const size = view.getBigUint64(16, true);
    if (size !== BigInt(source.size))
      fail(
        "input",
        `${place}: ${source.size} bytes instead of ${size}: ` + (BigInt(source.size) < size ? "truncated" : "bytes follow its end")
      );
    const count = view.getUint32(24, true);
    if (count > maxChunks) fail("input", `${place}: ${count} chunks, more than ${maxChunks}`);
    if (count === 0) fail("input", `${place}: no chunks`);
    const end = headerBytes + count * entryBytes;
    if (end > source.size)
      fail("input", `${place}: the table of ${count} chunks does not fit into ${source.size} bytes`);
    const hashed = head.slice(0, end);
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
    if (chunk.rawBytes > plainBytes + largestRatio * stored.length)
      fail(
        "input",
        `${place}: ${stored.length} compressed bytes claim to hold ${chunk.rawBytes}, more than ${plainBytes} and ${largestRatio} for each`
      );
    const frame = frameOf(stored);
    if (!frame || frame.content !== chunk.rawBytes)
      fail("input", `${place}: the compressed data does not hold ${chunk.rawBytes} bytes`);
    if (frame.window > largestWindow)
      fail("input", `${place}: its window is ${frame.window} bytes, more than ${largestWindow}`);
    const planes = new Uint8Array(chunk.rawBytes);
    let result;
    try {
      result = decompress(stored, planes);
    } catch {
      fail("input", `${place}: the compressed data is damaged`);
    }
    if (result.length !== chunk.rawBytes)
      fail("input", `${place}: decompresses to ${result.length} bytes instead of ${chunk.rawBytes}`);
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
  const size = descriptor >> 6;
  let content;
  if (size === 0 && !isSingle) return void 0;
  if (at + [1, 2, 4, 8][size] > bytes.length) return void 0;
  if (size === 0) content = bytes[at];
  else if (size === 1) content = view.getUint16(at, true) + 256;
  else if (size === 2) content = view.getUint32(at, true);
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
    const size = 4 * width * height;
    if (size > bytes.length - at)
      fail("input", `${place}: image ${images.length} needs ${size} bytes, ${bytes.length - at} are left`);
    images.push({ width, height, pixels: bytes.subarray(at, at + size) });
    at += size;
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
  constructor(name, size, first, get) {
    this.name = name;
    this.size = size;
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
  constructor(container, bladeChunk, patches, species, defaults, ground, thinned, hasSeeds) {
    this.container = container;
    this.bladeChunk = bladeChunk;
    this.patches = patches;
    this.species = species;
    this.defaults = defaults;
    this.ground = ground;
    this.thinned = thinned;
    this.hasSeeds = hasSeeds;
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
  hasSeeds;
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
    return new _Field(
      container,
      bladeChunk,
      patches,
      parseSpecies(species, `${place}: species`),
      parseDefaults(defaults, `${place}: defaults`),
      ground,
      parseCover(cover, `${place}: cover`),
      container.find("SEEDS") !== void 0
    );
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
  const bytes = file instanceof Uint8Array ? file : new Uint8Array(file);
  const field = await Field.open(await Container.open(new BufferSource(name, bytes)));
  await field.loadAll();
  await field.verifyRest();
  return field;
}
async function openField(address, options = {}) {
  return Field.open(await Container.open(await openSource(address, options)));
}
export {
  Field,
  Patches,
  SwardError,
  openField,
  pageBlades,
  patchWord,
  patchWords,
  readField,
  xxh3
};
