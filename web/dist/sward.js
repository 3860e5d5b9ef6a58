// Built from web/src by `npm run build`; do not edit.
// Sward, MIT licence. Contains fzstd, MIT licence, copyright (c) 2020 Arjun Barrett.
var __defProp = Object.defineProperty;
var __export = (target, all) => {
  for (var name in all)
    __defProp(target, name, { get: all[name], enumerable: !0 });
};

// src/format/error.ts
var SwardError = class extends Error {
  kind;
  constructor(kind, message) {
    super(message), this.name = "SwardError", this.kind = kind;
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
}, patchWords = 26, noPatch = 4294967295, maxPatchBlades = 512, Patches = class {
  floats;
  words;
  count;
  /** `bytes`: the chunk PATCHES, at a multiple of 4 in its buffer. */
  constructor(bytes) {
    this.count = bytes.length / (4 * patchWords), this.floats = new Float32Array(bytes.buffer, bytes.byteOffset, this.count * patchWords), this.words = new Uint32Array(bytes.buffer, bytes.byteOffset, this.count * patchWords);
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
    let low = 0, high = this.count - 1;
    for (; low < high; ) {
      let middle = low + high + 1 >> 1;
      this.firstBlade(middle) <= blade ? low = middle : high = middle - 1;
    }
    return low;
  }
  /** Checks what docs/field_format.md says of the tree and of its numbers. */
  verify(blades, place) {
    let nextBlade = 0, nextChild = 1, w = this.words;
    for (let p = 0; p < this.count; ++p) {
      let at = p * patchWords;
      this.verifyNumbers(p, place), this.firstBlade(p) !== nextBlade && fail("input", `${place}: patch ${p} begins at blade ${this.firstBlade(p)} instead of ${nextBlade}`), nextBlade += this.bladeCount(p);
      let parent = this.parent(p), level = w[at + patchWord.level];
      (p === 0 ? parent !== noPatch || level !== 0 : parent >= p) && fail("input", `${place}: patch ${p} has the parent ${parent}`);
      let children = this.childCount(p);
      if (children > 8 && fail("input", `${place}: patch ${p} has ${children} children, more than 8`), this.firstChild(p) !== (children === 0 ? noPatch : nextChild) && fail("input", `${place}: patch ${p} has its children at ${this.firstChild(p)}`), nextChild += children, p === 0) continue;
      let first = this.firstChild(parent);
      (p < first || p - first >= this.childCount(parent)) && fail("input", `${place}: patch ${p} is not a child of its parent ${parent}`), level !== w[parent * patchWords + patchWord.level] + 1 && fail("input", `${place}: patch ${p} has level ${level}`);
    }
    nextBlade !== blades && fail("input", `${place}: the patches own ${nextBlade} blades, of ${blades} that there are`), this.count > 0 && nextChild !== this.count && fail("input", `${place}: ${nextChild} patches are reached from the root, of ${this.count} that there are`);
  }
  verifyNumbers(p, place) {
    let at = p * patchWords, f = this.floats, isFinite3 = (word) => Number.isFinite(f[at + word]) && Number.isFinite(f[at + word + 1]) && Number.isFinite(f[at + word + 2]), { boundsLow, boundsHigh, coneAxis } = patchWord;
    (!isFinite3(boundsLow) || !isFinite3(boundsHigh) || [0, 1, 2].some((axis2) => f[at + boundsLow + axis2] > f[at + boundsHigh + axis2])) && fail("input", `${place}: patch ${p} has no valid bounds`);
    for (let key of ["rootStep", "heightLow", "heightStep", "widthLow", "widthStep"]) {
      let step = f[at + patchWord[key]];
      (!Number.isFinite(step) || step < 0) && fail("input", `${place}: patch ${p} has the quantisation step ${step}`);
    }
    isFinite3(patchWord.rootLow) || fail("input", `${place}: patch ${p} has a root that is not finite`);
    let axis = Math.hypot(f[at + coneAxis], f[at + coneAxis + 1], f[at + coneAxis + 2]), cosine = f[at + patchWord.coneCosine];
    (!(Math.abs(axis - 1) <= 1e-3) || !(cosine >= -1 && cosine <= 1)) && fail("input", `${place}: patch ${p} has no valid normal cone`);
    let low = f[at + patchWord.rankLow], high = f[at + patchWord.rankHigh];
    low >= 0 && low <= high && high <= 1 || fail("input", `${place}: patch ${p} has ranks ${low} to ${high}, outside 0 to 1`), this.bladeCount(p) > maxPatchBlades && fail("input", `${place}: patch ${p} owns ${this.bladeCount(p)} blades, more than ${maxPatchBlades}`);
  }
};

// src/format/settings.ts
var longestShown = 80;
function shown(value) {
  let text2 = JSON.stringify(value) ?? "nothing";
  return text2.length <= longestShown ? text2 : `${text2.slice(0, longestShown)}…`;
}
var SettingsReader = class _SettingsReader {
  constructor(value, place) {
    this.place = place;
    (typeof value != "object" || value === null || Array.isArray(value)) && fail("input", `${place}: expected an object {…}, found ${shown(value)}`), this.object = value;
  }
  place;
  object;
  known = /* @__PURE__ */ new Set();
  /** The value of a key, undefined if it is absent. */
  value(key) {
    return this.known.add(key), Object.hasOwn(this.object, key) ? this.object[key] : void 0;
  }
  placeOf(key) {
    return `${this.place}.${key}`;
  }
  number(key, usual, low, high) {
    let value = this.value(key);
    return value === void 0 ? usual : this.checked(value, key, low, high);
  }
  vector(key, usual, low, high) {
    let value = this.value(key);
    return value === void 0 ? usual : ((!Array.isArray(value) || value.length !== usual.length) && fail("input", `${this.placeOf(key)}: expected an array of ${usual.length} numbers, found ${shown(value)}`), value.map((one) => this.checked(one, key, low, high)));
  }
  /** A range of two numbers, or one number for both. */
  range(key, usual, low, high) {
    let value = this.value(key);
    if (typeof value != "number") return this.vector(key, usual, low, high);
    let one = this.checked(value, key, low, high);
    return [one, one];
  }
  text(key, usual) {
    let value = this.value(key);
    return value === void 0 ? usual : (typeof value != "string" && fail("input", `${this.placeOf(key)}: expected a text, found ${shown(value)}`), value);
  }
  /** The place of a word among `words`. */
  word(key, words, usual) {
    let value = this.value(key);
    if (value === void 0) return usual;
    let found = words.indexOf(value);
    return found < 0 && fail("input", `${this.placeOf(key)}: ${shown(value)} is none of ${words.join(", ")}`), found;
  }
  array(key) {
    let value = this.value(key);
    return Array.isArray(value) || fail("input", `${this.placeOf(key)}: expected an array, found ${shown(value)}`), value;
  }
  child(key) {
    return new _SettingsReader(this.value(key), this.placeOf(key));
  }
  /** Refuses keys that were not read. */
  finish() {
    for (let key of Object.keys(this.object))
      this.known.has(key) || fail("input", `${this.place}: unknown key "${key}"`);
  }
  checked(value, key, low, high) {
    return typeof value != "number" && fail("input", `${this.placeOf(key)}: expected a number, found ${shown(value)}`), value >= low && value <= high || fail("input", `${this.placeOf(key)}: ${value} is outside [${low}, ${high}]`), value;
  }
};
function parseJson(text2, place) {
  try {
    return JSON.parse(text2);
  } catch {
    fail("input", `${place}: not valid JSON`);
  }
}

// src/format/texts.ts
var shapeNames = ["triangle-tip", "quad", "triangle", "quadratic", "dandelion", "leaf"], shapeStalkLeaf = 6, maxSpecies = 8, maxOrganKinds = 32, maxRibbons = 63, black = [0, 0, 0], farthest = 1e12;
function readLook(reader, usual) {
  let unit2 = (key, value, high = 1) => reader.number(key, value, 0, high);
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
}, organLook = {
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
  let reader = new SettingsReader(value, place), count = reader.number("count", 1, 1, maxRibbons);
  Number.isInteger(count) || fail("input", `${place}.count: ${count} is not a whole number`);
  let look = readLook(reader, organLook);
  look.shape === 0 && (look.shape = shapeStalkLeaf);
  let organ = {
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
  return reader.finish(), organ;
}
function ribbonsOf(organs) {
  return organs.reduce((sum, organ) => sum + organ.count, 0);
}
function parseSpecies(text2, place) {
  let list = parseJson(text2, place);
  (!Array.isArray(list) || list.length === 0 || list.length > maxSpecies) && fail("input", `${place}: expected an array of 1 to ${maxSpecies} species`);
  let species = list.map((entry, i) => {
    let at = `${place}[${i}]`, reader = new SettingsReader(entry, at), name = reader.text("name", ""), look = readLook(reader, plainLook), organs = reader.value("organs") === void 0 ? [] : reader.array("organs").map((one, k) => readOrgan(one, `${at}.organs[${k}]`));
    return reader.finish(), ribbonsOf(organs) > maxRibbons && fail("input", `${at}.organs: ${ribbonsOf(organs)} ribbons on a stalk, more than ${maxRibbons}`), { ...look, name, organs };
  }), kinds2 = species.reduce((sum, one) => sum + one.organs.length, 0);
  return kinds2 > maxOrganKinds && fail("input", `${place}: ${kinds2} organs of all species, more than ${maxOrganKinds}`), species;
}
function requireUnit(v, place) {
  Math.abs(Math.hypot(...v) - 1) > 1e-3 && fail("input", `${place}: (${v.join(", ")}) is not a unit vector`);
}
function parseDefaults(text2, place) {
  let reader = new SettingsReader(parseJson(text2, place), place), wind = reader.child("wind"), gravity = reader.child("gravity"), defaults = {
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
      let one = new SettingsReader(entry, `${place}.cameras[${i}]`), camera2 = {
        name: one.text("name", "camera"),
        eye: one.vector("eye", [0, 0, 0], -farthest, farthest),
        target: one.vector("target", [0, 0, 0], -farthest, farthest),
        up: one.vector("up", [0, 1, 0], -1, 1),
        fovYDeg: one.number("fov_y_deg", 45, 0.1, 170)
      };
      return one.finish(), camera2;
    })
  };
  return wind.finish(), gravity.finish(), reader.finish(), requireUnit(defaults.wind.direction, wind.placeOf("direction")), requireUnit(defaults.gravity.direction, gravity.placeOf("direction")), defaults;
}
function parseCover(text2, place) {
  return text2 === void 0 || text2 === "" ? 1 : new SettingsReader(parseJson(text2, place), place).number("thinned", 1, 1, 1e9);
}

// src/format/blades.ts
var bladeWords = 4, twoPi = Math.fround(6.283185307179586);
function unpackBlades(packed, patches, first, count) {
  let blades = {
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
  }, single = Math.fround, f = patches.floats, patch = count > 0 ? patches.patchOf(first) : 0;
  for (let i = 0; i < count; ++i) {
    let blade = first + i;
    for (; blade >= patches.firstBlade(patch) + patches.bladeCount(patch); ) ++patch;
    let at = patch * patchWords, rootXY = packed[bladeWords * blade], rootZUp = packed[bladeWords * blade + 1], shape = packed[bladeWords * blade + 2], look = packed[bladeWords * blade + 3], step = f[at + patchWord.rootStep], places2 = [rootXY & 65535, rootXY >>> 16, rootZUp & 65535];
    for (let axis = 0; axis < 3; ++axis)
      blades.root[3 * i + axis] = f[at + patchWord.rootLow + axis] + single(step * places2[axis]);
    unfoldUp(rootZUp >>> 16, blades.up, 3 * i), blades.facing[i] = (shape & 255) * single(twoPi / 256), blades.height[i] = f[at + patchWord.heightLow] + single(f[at + patchWord.heightStep] * (shape >>> 8 & 255)), blades.width[i] = f[at + patchWord.widthLow] + single(f[at + patchWord.widthStep] * (shape >>> 16 & 63)), blades.stiffness[i] = (shape >>> 22 & 63) / 63, blades.hash[i] = shape >>> 28, blades.tint[3 * i] = (look & 31) / 31, blades.tint[3 * i + 1] = (look >>> 5 & 63) / 63, blades.tint[3 * i + 2] = (look >>> 11 & 31) / 31, blades.exposure[i] = (look >>> 16 & 31) / 31, blades.species[i] = look >>> 21 & 7, blades.clump[i] = look >>> 24, blades.patch[i] = patch;
  }
  return blades;
}
function unfoldUp(bits, up, at) {
  let x = ((bits & 255) - 127) / 127, y = ((bits >>> 8) - 127) / 127, z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) {
    let folded = (1 - Math.abs(y)) * (x >= 0 ? 1 : -1);
    y = (1 - Math.abs(x)) * (y >= 0 ? 1 : -1), x = folded;
  }
  let size2 = Math.hypot(x, y, z);
  up[at] = x / size2, up[at + 1] = y / size2, up[at + 2] = z / size2;
}
function bladeId(keys, blade) {
  if (keys.length === 0) return BigInt(blade);
  let mask2 = 0xffffffffffffffffn, x = BigInt(keys[2 * blade]) << 32n | BigInt(keys[2 * blade + 1]);
  return x = x + 0x9e3779b97f4a7c15n & mask2, x = (x ^ x >> 30n) * 0xbf58476d1ce4e5b9n & mask2, x = (x ^ x >> 27n) * 0x94d049bb133111ebn & mask2, (x ^ x >> 31n) >> 11n;
}
var widthBits = 63 << 16, clumpBits = 255 << 24;
function verifyBlades(packed, patches, species, first, count, place) {
  let ribbons = species.map((one) => ribbonsOf(one.organs)), hasPlants = ribbons.some((n) => n > 0), patch = hasPlants && count > 0 ? patches.patchOf(first) : 0;
  for (let blade = first; blade < first + count; ++blade) {
    let at = bladeWords * blade, kind = packed[at + 3] >>> 21 & 7;
    if (kind >= species.length && fail("input", `${place}: blade ${blade} has species ${kind}; there are ${species.length}`), !hasPlants) continue;
    for (; blade >= patches.firstBlade(patch) + patches.bladeCount(patch); ) ++patch;
    let number = packed[at + 3] >>> 24;
    if (number === 0 || ribbons[kind] === 0) continue;
    number > ribbons[kind] && fail("input", `${place}: blade ${blade} is ribbon ${number} of a plant with ${ribbons[kind]}`);
    let isFirst = blade === patches.firstBlade(patch);
    blade === first && !isFirst || (isFirst || packed[at - 1] >>> 24 !== number - 1 || packed[at - 4] !== packed[at] || packed[at - 3] !== packed[at + 1] || ((packed[at - 2] ^ packed[at + 2]) & ~widthBits) !== 0 || ((packed[at - 1] ^ packed[at + 3]) & ~clumpBits) !== 0) && fail("input", `${place}: blade ${blade} is ribbon ${number} without its stalk`);
  }
}

// node_modules/fzstd/esm/index.mjs
var ab = ArrayBuffer, u8 = Uint8Array, u16 = Uint16Array, i16 = Int16Array;
var i32 = Int32Array, slc = function(v, s, e) {
  if (u8.prototype.slice)
    return u8.prototype.slice.call(v, s, e);
  (s == null || s < 0) && (s = 0), (e == null || e > v.length) && (e = v.length);
  var n = new u8(e - s);
  return n.set(v.subarray(s, e)), n;
}, fill = function(v, n, s, e) {
  if (u8.prototype.fill)
    return u8.prototype.fill.call(v, n, s, e);
  for ((s == null || s < 0) && (s = 0), (e == null || e > v.length) && (e = v.length); s < e; ++s)
    v[s] = n;
  return v;
}, cpw = function(v, t, s, e) {
  if (u8.prototype.copyWithin)
    return u8.prototype.copyWithin.call(v, t, s, e);
  for ((s == null || s < 0) && (s = 0), (e == null || e > v.length) && (e = v.length); s < e; )
    v[t++] = v[s++];
};
var ec = [
  "invalid zstd data",
  "window size too large (>2046MB)",
  "invalid block type",
  "FSE accuracy too high",
  "match distance too far back",
  "unexpected EOF"
], err = function(ind, msg, nt) {
  var e = new Error(msg || ec[ind]);
  if (e.code = ind, Error.captureStackTrace && Error.captureStackTrace(e, err), !nt)
    throw e;
  return e;
}, rb = function(d, b, n) {
  for (var i = 0, o = 0; i < n; ++i)
    o |= d[b++] << (i << 3);
  return o;
}, b4 = function(d, b) {
  return (d[b] | d[b + 1] << 8 | d[b + 2] << 16 | d[b + 3] << 24) >>> 0;
}, rzfh = function(dat, w) {
  var n3 = dat[0] | dat[1] << 8 | dat[2] << 16;
  if (n3 == 3126568 && dat[3] == 253) {
    var flg = dat[4], ss = flg >> 5 & 1, cc = flg >> 2 & 1, df = flg & 3, fcf = flg >> 6;
    flg & 8 && err(0);
    var bt = 6 - ss, db = df == 3 ? 4 : df, di = rb(dat, bt, db);
    bt += db;
    var fsb = fcf ? 1 << fcf : ss, fss = rb(dat, bt, fsb) + (fcf == 1 && 256), ws = fss;
    if (!ss) {
      var wb = 1 << 10 + (dat[5] >> 3);
      ws = wb + (wb >> 3) * (dat[5] & 7);
    }
    ws > 2145386496 && err(1);
    var buf = new u8((w == 1 ? fss || ws : w ? 0 : ws) + 12);
    return buf[0] = 1, buf[4] = 4, buf[8] = 8, {
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
  } else if ((n3 >> 4 | dat[3] << 20) == 25481893)
    return b4(dat, 4) + 8;
  err(0);
}, msb = function(val) {
  for (var bits = 0; 1 << bits <= val; ++bits)
    ;
  return bits - 1;
}, rfse = function(dat, bt, mal) {
  var tpos = (bt << 3) + 4, al = (dat[bt] & 15) + 5;
  al > mal && err(3);
  for (var sz = 1 << al, probs = sz, sym = -1, re = -1, i = -1, ht = sz, buf = new ab(512 + (sz << 2)), freq = new i16(buf, 0, 256), dstate = new u16(buf, 0, 256), nstate = new u16(buf, 512, sz), bb1 = 512 + (sz << 1), syms = new u8(buf, bb1, sz), nbits = new u8(buf, bb1 + sz); sym < 255 && probs > 0; ) {
    var bits = msb(probs + 1), cbt = tpos >> 3, msk = (1 << bits + 1) - 1, val = (dat[cbt] | dat[cbt + 1] << 8 | dat[cbt + 2] << 16) >> (tpos & 7) & msk, msk1fb = (1 << bits) - 1, msv = msk - probs - 1, sval = val & msk1fb;
    if (sval < msv ? (tpos += bits, val = sval) : (tpos += bits + 1, val > msk1fb && (val -= msv)), freq[++sym] = --val, val == -1 ? (probs += val, syms[--ht] = sym) : probs -= val, !val)
      do {
        var rbt = tpos >> 3;
        re = (dat[rbt] | dat[rbt + 1] << 8) >> (tpos & 7) & 3, tpos += 2, sym += re;
      } while (re == 3);
  }
  (sym > 255 || probs) && err(0);
  for (var sympos = 0, sstep = (sz >> 1) + (sz >> 3) + 3, smask = sz - 1, s = 0; s <= sym; ++s) {
    var sf = freq[s];
    if (sf < 1) {
      dstate[s] = -sf;
      continue;
    }
    for (i = 0; i < sf; ++i) {
      syms[sympos] = s;
      do
        sympos = sympos + sstep & smask;
      while (sympos >= ht);
    }
  }
  for (sympos && err(0), i = 0; i < sz; ++i) {
    var ns = dstate[syms[i]]++, nb = nbits[i] = al - msb(ns);
    nstate[i] = (ns << nb) - sz;
  }
  return [tpos + 7 >> 3, {
    b: al,
    s: syms,
    n: nbits,
    t: nstate
  }];
}, rhu = function(dat, bt) {
  var i = 0, wc = -1, buf = new u8(292), hb = dat[bt], hw = buf.subarray(0, 256), rc = buf.subarray(256, 268), ri = new u16(buf.buffer, 268);
  if (hb < 128) {
    var _a = rfse(dat, bt + 1, 6), ebt = _a[0], fdt = _a[1];
    bt += hb;
    var epos = ebt << 3, lb = dat[bt];
    lb || err(0);
    for (var st1 = 0, st2 = 0, btr1 = fdt.b, btr2 = btr1, fpos = (++bt << 3) - 8 + msb(lb); fpos -= btr1, !(fpos < epos); ) {
      var cbt = fpos >> 3;
      if (st1 += (dat[cbt] | dat[cbt + 1] << 8) >> (fpos & 7) & (1 << btr1) - 1, hw[++wc] = fdt.s[st1], fpos -= btr2, fpos < epos)
        break;
      cbt = fpos >> 3, st2 += (dat[cbt] | dat[cbt + 1] << 8) >> (fpos & 7) & (1 << btr2) - 1, hw[++wc] = fdt.s[st2], btr1 = fdt.n[st1], st1 = fdt.t[st1], btr2 = fdt.n[st2], st2 = fdt.t[st2];
    }
    ++wc > 255 && err(0);
  } else {
    for (wc = hb - 127; i < wc; i += 2) {
      var byte = dat[++bt];
      hw[i] = byte >> 4, hw[i + 1] = byte & 15;
    }
    ++bt;
  }
  var wes = 0;
  for (i = 0; i < wc; ++i) {
    var wt = hw[i];
    wt > 11 && err(0), wes += wt && 1 << wt - 1;
  }
  var mb = msb(wes) + 1, ts = 1 << mb, rem = ts - wes;
  for (rem & rem - 1 && err(0), hw[wc++] = msb(rem) + 1, i = 0; i < wc; ++i) {
    var wt = hw[i];
    ++rc[hw[i] = wt && mb + 1 - wt];
  }
  var hbuf = new u8(ts << 1), syms = hbuf.subarray(0, ts), nb = hbuf.subarray(ts);
  for (ri[mb] = 0, i = mb; i > 0; --i) {
    var pv = ri[i];
    fill(nb, i, pv, ri[i - 1] = pv + rc[i] * (1 << mb - i));
  }
  for (ri[0] != ts && err(0), i = 0; i < wc; ++i) {
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
}, dllt = rfse(/* @__PURE__ */ new u8([
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
]), 0, 6)[1], dmlt = rfse(/* @__PURE__ */ new u8([
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
]), 0, 6)[1], doct = rfse(/* @__PURE__ */ new u8([
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
]), 0, 5)[1], b2bl = function(b, s) {
  for (var len = b.length, bl = new i32(len), i = 0; i < len; ++i)
    bl[i] = s, s += 1 << b[i];
  return bl;
}, llb = /* @__PURE__ */ new u8((/* @__PURE__ */ new i32([
  0,
  0,
  0,
  0,
  16843009,
  50528770,
  134678020,
  202050057,
  269422093
])).buffer, 0, 36), llbl = /* @__PURE__ */ b2bl(llb, 0), mlb = /* @__PURE__ */ new u8((/* @__PURE__ */ new i32([
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
])).buffer, 0, 53), mlbl = /* @__PURE__ */ b2bl(mlb, 3), dhu = function(dat, out, hu) {
  var len = dat.length, ss = out.length, lb = dat[len - 1], msk = (1 << hu.b) - 1, eb = -hu.b;
  lb || err(0);
  for (var st = 0, btr = hu.b, pos = (len << 3) - 8 + msb(lb) - btr, i = -1; pos > eb && i < ss; ) {
    var cbt = pos >> 3, val = (dat[cbt] | dat[cbt + 1] << 8 | dat[cbt + 2] << 16) >> (pos & 7);
    st = (st << btr | val) & msk, out[++i] = hu.s[st], pos -= btr = hu.n[st];
  }
  (pos != eb || i + 1 != ss) && err(0);
}, dhu4 = function(dat, out, hu) {
  var bt = 6, ss = out.length, sz1 = ss + 3 >> 2, sz2 = sz1 << 1, sz3 = sz1 + sz2;
  dhu(dat.subarray(bt, bt += dat[0] | dat[1] << 8), out.subarray(0, sz1), hu), dhu(dat.subarray(bt, bt += dat[2] | dat[3] << 8), out.subarray(sz1, sz2), hu), dhu(dat.subarray(bt, bt += dat[4] | dat[5] << 8), out.subarray(sz2, sz3), hu), dhu(dat.subarray(bt), out.subarray(sz3), hu);
}, rzb = function(dat, st, out) {
  var _a, bt = st.b, b0 = dat[bt], btype = b0 >> 1 & 3;
  st.l = b0 & 1;
  var sz = b0 >> 3 | dat[bt + 1] << 5 | dat[bt + 2] << 13, ebt = (bt += 3) + sz;
  if (btype == 1)
    return bt >= dat.length ? void 0 : (st.b = bt + 1, out ? (fill(out, dat[bt], st.y, st.y += sz), out) : fill(new u8(sz), dat[bt]));
  if (!(ebt > dat.length)) {
    if (btype == 0)
      return st.b = ebt, out ? (out.set(dat.subarray(bt, ebt), st.y), st.y += sz, out) : slc(dat, bt, ebt);
    if (btype == 2) {
      var b3 = dat[bt], lbt = b3 & 3, sf = b3 >> 2 & 3, lss = b3 >> 4, lcs = 0, s4 = 0;
      lbt < 2 ? sf & 1 ? lss |= dat[++bt] << 4 | (sf & 2 && dat[++bt] << 12) : lss = b3 >> 3 : (s4 = sf, sf < 2 ? (lss |= (dat[++bt] & 63) << 4, lcs = dat[bt] >> 6 | dat[++bt] << 2) : sf == 2 ? (lss |= dat[++bt] << 4 | (dat[++bt] & 3) << 12, lcs = dat[bt] >> 2 | dat[++bt] << 6) : (lss |= dat[++bt] << 4 | (dat[++bt] & 63) << 12, lcs = dat[bt] >> 6 | dat[++bt] << 2 | dat[++bt] << 10)), ++bt;
      var buf = out ? out.subarray(st.y, st.y + st.m) : new u8(st.m), spl = buf.length - lss;
      if (lbt == 0)
        buf.set(dat.subarray(bt, bt += lss), spl);
      else if (lbt == 1)
        fill(buf, dat[bt++], spl);
      else {
        var hu = st.h;
        if (lbt == 2) {
          var hud = rhu(dat, bt);
          lcs += bt - (bt = hud[0]), st.h = hu = hud[1];
        } else hu || err(0);
        (s4 ? dhu4 : dhu)(dat.subarray(bt, bt += lcs), buf.subarray(spl), hu);
      }
      var ns = dat[bt++];
      if (ns) {
        ns == 255 ? ns = (dat[bt++] | dat[bt++] << 8) + 32512 : ns > 127 && (ns = ns - 128 << 8 | dat[bt++]);
        var scm = dat[bt++];
        scm & 3 && err(0);
        for (var dts = [dmlt, doct, dllt], i = 2; i > -1; --i) {
          var md = scm >> (i << 1) + 2 & 3;
          if (md == 1) {
            var rbuf = new u8([0, 0, dat[bt++]]);
            dts[i] = {
              s: rbuf.subarray(2, 3),
              n: rbuf.subarray(0, 1),
              t: new u16(rbuf.buffer, 0, 1),
              b: 0
            };
          } else md == 2 ? (_a = rfse(dat, bt, 9 - (i & 1)), bt = _a[0], dts[i] = _a[1]) : md == 3 && (st.t || err(0), dts[i] = st.t[i]);
        }
        var _b = st.t = dts, mlt = _b[0], oct = _b[1], llt = _b[2], lb = dat[ebt - 1];
        lb || err(0);
        var spos = (ebt << 3) - 8 + msb(lb) - llt.b, cbt = spos >> 3, oubt = 0, lst = (dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << llt.b) - 1;
        cbt = (spos -= oct.b) >> 3;
        var ost = (dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << oct.b) - 1;
        cbt = (spos -= mlt.b) >> 3;
        var mst = (dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << mlt.b) - 1;
        for (++ns; --ns; ) {
          var llc = llt.s[lst], lbtr = llt.n[lst], mlc = mlt.s[mst], mbtr = mlt.n[mst], ofc = oct.s[ost], obtr = oct.n[ost];
          cbt = (spos -= ofc) >> 3;
          var ofp = 1 << ofc, off = ofp + ((dat[cbt] | dat[cbt + 1] << 8 | dat[cbt + 2] << 16 | dat[cbt + 3] << 24) >>> (spos & 7) & ofp - 1);
          cbt = (spos -= mlb[mlc]) >> 3;
          var ml = mlbl[mlc] + ((dat[cbt] | dat[cbt + 1] << 8 | dat[cbt + 2] << 16) >> (spos & 7) & (1 << mlb[mlc]) - 1);
          cbt = (spos -= llb[llc]) >> 3;
          var ll = llbl[llc] + ((dat[cbt] | dat[cbt + 1] << 8 | dat[cbt + 2] << 16) >> (spos & 7) & (1 << llb[llc]) - 1);
          if (cbt = (spos -= lbtr) >> 3, lst = llt.t[lst] + ((dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << lbtr) - 1), cbt = (spos -= mbtr) >> 3, mst = mlt.t[mst] + ((dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << mbtr) - 1), cbt = (spos -= obtr) >> 3, ost = oct.t[ost] + ((dat[cbt] | dat[cbt + 1] << 8) >> (spos & 7) & (1 << obtr) - 1), off > 3)
            st.o[2] = st.o[1], st.o[1] = st.o[0], st.o[0] = off -= 3;
          else {
            var idx = off - (ll != 0);
            idx ? (off = idx == 3 ? st.o[0] - 1 : st.o[idx], idx > 1 && (st.o[2] = st.o[1]), st.o[1] = st.o[0], st.o[0] = off) : off = st.o[0];
          }
          for (var i = 0; i < ll; ++i)
            buf[oubt + i] = buf[spl + i];
          oubt += ll, spl += ll;
          var stin = oubt - off;
          if (stin < 0) {
            var len = -stin, bs = st.e + stin;
            len > ml && (len = ml);
            for (var i = 0; i < len; ++i)
              buf[oubt + i] = st.w[bs + i];
            oubt += len, ml -= len, stin = 0;
          }
          for (var i = 0; i < ml; ++i)
            buf[oubt + i] = buf[stin + i];
          oubt += ml;
        }
        if (oubt != spl)
          for (; spl < buf.length; )
            buf[oubt++] = buf[spl++];
        else
          oubt = buf.length;
        out ? st.y += oubt : buf = slc(buf, 0, oubt);
      } else if (out) {
        if (st.y += lss, spl)
          for (var i = 0; i < lss; ++i)
            buf[i] = buf[spl + i];
      } else spl && (buf = slc(buf, spl));
      return st.b = ebt, buf;
    }
    err(2);
  }
}, cct = function(bufs, ol) {
  if (bufs.length == 1)
    return bufs[0];
  for (var buf = new u8(ol), i = 0, b = 0; i < bufs.length; ++i) {
    var chk = bufs[i];
    buf.set(chk, b), b += chk.length;
  }
  return buf;
};
function decompress(dat, buf) {
  for (var bufs = [], nb = +!buf, bt = 0, ol = 0; dat.length; ) {
    var st = rzfh(dat, nb || buf);
    if (typeof st == "object") {
      for (nb ? (buf = null, st.w.length == st.u && (bufs.push(buf = st.w), ol += st.u)) : (bufs.push(buf), st.e = 0); !st.l; ) {
        var blk = rzb(dat, st, buf);
        blk || err(5), buf ? st.e = st.y : (bufs.push(blk), ol += blk.length, cpw(st.w, 0, blk.length), st.w.set(blk, st.w.length - blk.length));
      }
      bt = st.b + st.c * 4;
    } else
      bt = st;
    dat = dat.subarray(bt);
  }
  return cct(bufs, ol);
}

// src/format/xxh3.ts
var secretHex = "b8fe6c3923a44bbe7c01812cf721ad1cded46de9839097db7240a4a4b7b3671fcb79e64eccc0e578825ad07dccff7221b8084674f743248ee03590e6813a264c3c2852bb91c300cb88d0658b1b532ea371644897a20df94e3819ef46a9deacd8a8fa763fe39c343ff9dcbbc7c70b4f1d8a51e04bcdb45931c89f7ec9d9787364eac5ac8334d3ebc3c581a0fffa1363eb170ddd51b7f0da49d316552629d4689e2b16be587d47a1fc8ff8b8d17ad031ce45cb3a8f95160428afd7fbcabb4b407e", secret = Uint8Array.from(secretHex.match(/../g), (pair) => parseInt(pair, 16)), secretView = new DataView(secret.buffer), secretWords = new Uint32Array(secret.buffer), mask = 0xffffffffffffffffn, prime32 = [0n, 0x9e3779b1n, 0x85ebca77n, 0xc2b2ae3dn], prime64 = [
  0n,
  0x9e3779b185ebca87n,
  0xc2b2ae3d27d4eb4fn,
  0x165667b19e3779f9n,
  0x85ebca77c2b2ae63n,
  0x27d4eb2f165667c5n
], secretAt = (at) => secretView.getBigUint64(at, !0), rotate = (x, bits) => (x << bits | x >> 64n - bits) & mask;
function swap64(x) {
  let result = 0n;
  for (let i = 0n; i < 8n; ++i) result = result << 8n | x >> 8n * i & 255n;
  return result;
}
function foldedProduct(a, b) {
  let product = a * b;
  return product & mask ^ product >> 64n;
}
function avalanche(x) {
  return x ^= x >> 37n, x = x * 0x165667919e3779f9n & mask, x ^ x >> 32n;
}
function avalanche64(x) {
  return x ^= x >> 33n, x = x * prime64[2] & mask, x ^= x >> 29n, x = x * prime64[3] & mask, x ^ x >> 32n;
}
function shortHash(bytes) {
  let view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length), length = bytes.length, size2 = BigInt(length), word = (at) => BigInt(view.getUint32(at, !0)), long = (at) => view.getBigUint64(at, !0), mixed = (at, of) => foldedProduct(long(at) ^ secretAt(of), long(at + 8) ^ secretAt(of + 8));
  if (length === 0) return avalanche64(secretAt(56) ^ secretAt(64));
  if (length <= 3) {
    let combined = (bytes[0] << 16 | bytes[length >> 1] << 24 | bytes[length - 1] | length << 8) >>> 0;
    return avalanche64(BigInt((combined ^ secretWords[0] ^ secretWords[1]) >>> 0));
  }
  if (length <= 8) {
    let h = (word(length - 4) | word(0) << 32n) ^ (secretAt(8) ^ secretAt(16));
    return h ^= rotate(h, 49n) ^ rotate(h, 24n), h = h * 0x9fb21c651e98df25n & mask, h ^= (h >> 35n) + size2, h = h * 0x9fb21c651e98df25n & mask, h ^ h >> 28n;
  }
  if (length <= 16) {
    let low = long(0) ^ (secretAt(24) ^ secretAt(32)), high = long(length - 8) ^ (secretAt(40) ^ secretAt(48));
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
  return sum += mixed(length - 16, 119), avalanche(sum & mask);
}
var stripe = 64, stripesPerBlock = 16, blockBytes = stripe * stripesPerBlock, LongHash = class {
  sums = new Uint32Array(16);
  constructor() {
    [
      prime32[3],
      prime64[1],
      prime64[2],
      prime64[3],
      prime64[4],
      prime32[2],
      prime64[5],
      prime32[1]
    ].forEach((value, i) => {
      this.sums[2 * i] = Number(value & 0xffffffffn), this.sums[2 * i + 1] = Number(value >> 32n);
    });
  }
  /** Adds the stripe at word `at` of `data`; `key` is the word of the secret. */
  addStripe(data, at, keys, key) {
    let sums = this.sums;
    for (let lane = 0; lane < 16; lane += 2) {
      let low = data[at + lane], high = data[at + lane + 1], a = (low ^ keys[key + lane]) >>> 0, b = (high ^ keys[key + lane + 1]) >>> 0, aLow = a & 65535, aHigh = a >>> 16, bLow = b & 65535, bHigh = b >>> 16, middle = aHigh * bLow + aLow * bHigh + (Math.imul(aLow, bLow) >>> 0 >>> 16), productLow = Math.imul(a, b) >>> 0, productHigh = aHigh * bHigh + Math.floor(middle / 65536), own = sums[lane] + productLow;
      sums[lane] = own, sums[lane + 1] = sums[lane + 1] + productHigh + (own > 4294967295 ? 1 : 0);
      let other = lane ^ 2, added = sums[other] + low;
      sums[other] = added, sums[other + 1] = sums[other + 1] + high + (added > 4294967295 ? 1 : 0);
    }
  }
  addBlock(data, at) {
    for (let i = 0; i < stripesPerBlock; ++i) this.addStripe(data, at + 16 * i, secretWords, 2 * i);
    this.scramble();
  }
  scramble() {
    let sums = this.sums, key = (secret.length - stripe) / 4, prime = 2654435761;
    for (let lane = 0; lane < 16; lane += 2) {
      let low = sums[lane], high = sums[lane + 1], a = (low ^ high >>> 15 ^ secretWords[key + lane]) >>> 0, b = (high ^ secretWords[key + lane + 1]) >>> 0, aLow = a & 65535, aHigh = a >>> 16, primeLow = prime & 65535, primeHigh = prime >>> 16, middle = aHigh * primeLow + aLow * primeHigh + (Math.imul(aLow, primeLow) >>> 0 >>> 16);
      sums[lane] = Math.imul(a, prime), sums[lane + 1] = aHigh * primeHigh + Math.floor(middle / 65536) + (Math.imul(b, prime) >>> 0);
    }
  }
  digest(length) {
    let long = (i) => BigInt(this.sums[2 * i]) | BigInt(this.sums[2 * i + 1]) << 32n, result = BigInt(length) * prime64[1];
    for (let i = 0; i < 4; ++i)
      result += foldedProduct(
        long(2 * i) ^ secretAt(11 + 16 * i),
        long(2 * i + 1) ^ secretAt(11 + 16 * i + 8)
      );
    return avalanche(result & mask);
  }
}, isLittleEndian = new Uint8Array(new Uint32Array([1]).buffer)[0] === 1;
function wordsOf(bytes) {
  if (!isLittleEndian) throw new Error("this machine is not little endian");
  return bytes.byteOffset % 4 !== 0 && (bytes = bytes.slice()), new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.length >> 2);
}
function* longHash(bytes) {
  let words = wordsOf(bytes), length = bytes.length, hash = new LongHash(), blocks2 = Math.floor((length - 1) / blockBytes);
  for (let i = 0; i < blocks2; ++i)
    hash.addBlock(words, i * blockBytes / 4), i % 4096 === 4095 && (yield);
  let stripes = Math.floor((length - 1 - blocks2 * blockBytes) / stripe);
  for (let i = 0; i < stripes; ++i)
    hash.addStripe(words, (blocks2 * blockBytes + i * stripe) / 4, secretWords, 2 * i);
  let lastKey = secret.length - stripe - 7;
  return hash.addStripe(
    wordsOf(bytes.slice(length - stripe)),
    0,
    wordsOf(secret.slice(lastKey, lastKey + stripe)),
    0
  ), hash.digest(length);
}
function xxh3(bytes) {
  if (bytes.length <= 240) return shortHash(bytes);
  let steps2 = longHash(bytes);
  for (; ; ) {
    let step = steps2.next();
    if (step.done) return step.value;
  }
}
async function xxh3InSteps(bytes) {
  if (bytes.length <= 240) return shortHash(bytes);
  let steps2 = longHash(bytes);
  for (; ; ) {
    let step = steps2.next();
    if (step.done) return step.value;
    await new Promise((resolve) => setTimeout(resolve));
  }
}

// src/format/container.ts
var magic = `SWARD\r
`, majorVersion = 1, minorVersion = 3, endianMark = 16909060, headerBytes = 64, entryBytes = 64, maxChunks = 64, alignment = 64, critical = 1, compressed = 2, plainBytes = 256 * 1024 * 1024, largestRatio = 4096, largestWindow = 32 * 1024 * 1024, knownChunks = {
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
}, hex = (value, digits = 0) => `0x${(value >>> 0).toString(16).padStart(digits, "0")}`, Container = class _Container {
  /** `head`: the first bytes of the file, at least header and table. */
  constructor(source, head2) {
    this.source = source;
    this.head = head2;
    let place = source.name, view = new DataView(head2.buffer, head2.byteOffset, head2.length);
    for (let i = 0; i < magic.length; ++i)
      head2[i] !== magic.charCodeAt(i) && fail("input", `${place}: not a field file (it does not begin with "SWARD")`);
    let mark = view.getUint32(12, !0);
    mark !== endianMark && fail("input", `${place}: the byte order mark is ${hex(mark, 8)} instead of ${hex(endianMark, 8)}`), this.version = { major: view.getUint16(8, !0), minor: view.getUint16(10, !0) }, this.version.major > majorVersion && fail(
      "unsupported",
      `${place}: field format version ${this.version.major}.${this.version.minor}; this program reads up to version ${majorVersion}.${minorVersion}`
    ), this.version.major === 0 && fail("input", `${place}: field format version 0 does not exist`);
    let size2 = view.getBigUint64(16, !0);
    size2 !== BigInt(source.size) && fail(
      "input",
      `${place}: ${source.size} bytes instead of ${size2}: ` + (BigInt(source.size) < size2 ? "truncated" : "bytes follow its end")
    );
    let count = view.getUint32(24, !0);
    count > maxChunks && fail("input", `${place}: ${count} chunks, more than ${maxChunks}`), count === 0 && fail("input", `${place}: no chunks`);
    let end = headerBytes + count * entryBytes;
    end > source.size && fail("input", `${place}: the table of ${count} chunks does not fit into ${source.size} bytes`);
    let hashed = head2.slice(0, end);
    hashed.fill(0, 56, 64), xxh3(hashed) !== view.getBigUint64(56, !0) && fail("input", `${place}: header or chunk table is damaged (hash differs)`), this.origin = [32, 40, 48].map((at) => view.getFloat64(at, !0)), this.origin.every(Number.isFinite) || fail("input", `${place}: the origin is not finite`), this.readTable(view, count, end);
  }
  source;
  head;
  version;
  /** World position of the field's origin [m]. */
  origin;
  chunks = [];
  /** Reads header and table of a field. */
  static async open(source) {
    source.size < headerBytes && fail(
      "input",
      `${source.name}: ${source.size} bytes, too short for the header of a field (${headerBytes})`
    );
    let bytes = Math.min(source.size, headerBytes + maxChunks * entryBytes);
    return new _Container(source, await source.read(0, bytes));
  }
  readTable(view, count, end) {
    let place = this.source.name, at = end;
    for (let i = 0; i < count; ++i) {
      let base = headerBytes + i * entryBytes, name = Array.from(
        this.head.subarray(base, base + 8),
        (c) => c >= 32 && c < 127 ? String.fromCharCode(c) : "?"
      ).join("").trimEnd(), number = (offset) => {
        let value = view.getBigUint64(base + offset, !0);
        return value > BigInt(Number.MAX_SAFE_INTEGER) ? 1 / 0 : Number(value);
      }, chunk = {
        name,
        offset: number(8),
        storedBytes: number(16),
        rawBytes: number(24),
        hash: view.getBigUint64(base + 32, !0),
        flags: view.getUint32(base + 40, !0),
        elementBytes: view.getUint32(base + 44, !0),
        elementCount: number(48)
      };
      (chunk.offset % alignment !== 0 || chunk.offset < at || chunk.offset - at >= alignment || chunk.storedBytes > this.source.size - chunk.offset) && fail(
        "input",
        `${place}: chunk ${name} at ${chunk.offset} with ${chunk.storedBytes} bytes does not fit`
      ), (chunk.flags & ~(critical | compressed)) !== 0 && fail("unsupported", `${place}: chunk ${name} has unknown flags ${hex(chunk.flags)}`);
      let isCompressed = (chunk.flags & compressed) !== 0;
      (chunk.elementBytes === 0 || chunk.elementCount * chunk.elementBytes !== chunk.rawBytes || !isCompressed && chunk.rawBytes !== chunk.storedBytes) && fail(
        "input",
        `${place}: chunk ${name} has ${chunk.elementCount} elements of ${chunk.elementBytes} bytes in ${chunk.rawBytes} bytes`
      );
      let known = knownChunks[name];
      known === void 0 && (chunk.flags & critical) !== 0 && fail("unsupported", `${place}: needs chunk ${name}, which this version does not know`), known !== void 0 && known !== chunk.elementBytes && fail(
        "input",
        `${place}: elements of chunk ${name} have ${chunk.elementBytes} bytes instead of ${known}`
      ), this.chunks.push(chunk), at = chunk.offset + chunk.storedBytes;
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
    let at = headerBytes + this.chunks.length * entryBytes, check = async (from, to) => {
      let found = (await this.source.read(from, to)).findIndex((byte) => byte !== 0);
      found >= 0 && fail("input", `${this.source.name}: byte ${from + found} between chunks is not zero`);
    };
    for (let chunk of this.chunks)
      await check(at, chunk.offset), at = chunk.offset + chunk.storedBytes;
    await check(at, this.source.size);
  }
  /** Compares the stored bytes of a chunk with its hash. */
  async checkHash(chunk, stored) {
    await xxh3InSteps(stored) !== chunk.hash && fail("input", `${this.source.name}: chunk ${chunk.name} is damaged (hash differs)`);
  }
  /** The bytes of a chunk, verified and decompressed. Their buffer begins with them. */
  async bytes(chunk) {
    let stored = await this.source.read(chunk.offset, chunk.offset + chunk.storedBytes);
    return await this.checkHash(chunk, stored), (chunk.flags & compressed) === 0 ? stored.slice() : this.decompressed(chunk, stored);
  }
  decompressed(chunk, stored) {
    if (chunk.elementCount === 0) return new Uint8Array(0);
    let place = `${this.source.name}: chunk ${chunk.name}`, planes = unpackFrame(stored, chunk.rawBytes, place), { elementBytes, elementCount } = chunk;
    if (elementBytes === 1) return planes;
    let raw = new Uint8Array(chunk.rawBytes);
    for (let plane = 0; plane < elementBytes; ++plane) {
      let from = plane * elementCount;
      for (let i = 0, to = plane; i < elementCount; ++i, to += elementBytes) raw[to] = planes[from + i];
    }
    return raw;
  }
  /** The text of a chunk; undefined if it is absent. */
  async text(name) {
    let chunk = this.find(name);
    if (!chunk) return;
    let bytes = await this.bytes(chunk);
    try {
      return new TextDecoder("utf-8", { fatal: !0 }).decode(bytes);
    } catch {
      fail("input", `${this.source.name}: chunk ${name} is not UTF-8`);
    }
  }
};
function unpackFrame(stored, rawBytes, place) {
  let frame = frameOf(stored), bytes = rawBytes ?? frame?.content ?? 0;
  bytes > plainBytes + largestRatio * stored.length && fail(
    "input",
    `${place}: ${stored.length} compressed bytes claim to hold ${bytes}, more than ${plainBytes} and ${largestRatio} for each`
  ), (!frame || frame.content !== bytes) && fail("input", `${place}: the compressed data does not hold ${bytes} bytes`), frame.window > largestWindow && fail("input", `${place}: its window is ${frame.window} bytes, more than ${largestWindow}`);
  let plain = new Uint8Array(bytes), result;
  try {
    result = decompress(stored, plain);
  } catch {
    fail("input", `${place}: the compressed data is damaged`);
  }
  return result.length !== bytes && fail("input", `${place}: decompresses to ${result.length} bytes instead of ${bytes}`), plain;
}
function frameOf(bytes) {
  let view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  if (bytes.length < 18 && bytes.length < 6 || view.getUint32(0, !0) !== 4247762216) return;
  let descriptor = bytes[4], isSingle = (descriptor & 32) !== 0, at = 5, window = 0;
  isSingle || (window = 2 ** (10 + (bytes[at] >> 3)), window += window / 8 * (bytes[at] & 7), ++at), at += [0, 1, 2, 4][descriptor & 3];
  let size2 = descriptor >> 6, content;
  if (!(size2 === 0 && !isSingle) && !(at + [1, 2, 4, 8][size2] > bytes.length))
    return size2 === 0 ? content = bytes[at] : size2 === 1 ? content = view.getUint16(at, !0) + 256 : size2 === 2 ? content = view.getUint32(at, !0) : content = Number(view.getBigUint64(at, !0)), { content, window: isSingle ? content : window };
}

// src/format/ground.ts
var groundVertexBytes = 28, largestSide = 16384, noImage = 4294967295;
async function bytesOf(container, name) {
  let chunk = container.find(name);
  return chunk ? container.bytes(chunk) : new Uint8Array(0);
}
function imagesOf(bytes, place) {
  let view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length), images = [];
  for (let at = 0; at < bytes.length; ) {
    bytes.length - at < 8 && fail("input", `${place}: image ${images.length} has no size`);
    let width = view.getUint32(at, !0), height = view.getUint32(at + 4, !0);
    at += 8, (width === 0 || height === 0 || width > largestSide || height > largestSide) && fail("input", `${place}: image ${images.length} is ${width}×${height}, outside 1 to ${largestSide}`);
    let size2 = 4 * width * height;
    size2 > bytes.length - at && fail("input", `${place}: image ${images.length} needs ${size2} bytes, ${bytes.length - at} are left`), images.push({ width, height, pixels: bytes.subarray(at, at + size2) }), at += size2;
  }
  return images;
}
function verify(ground, place) {
  let { vertices, vertexCount, indices } = ground, floats = new Float32Array(vertices.buffer, vertices.byteOffset, vertices.length / 4);
  for (let v = 0; v < vertexCount; ++v)
    for (let word of [0, 1, 2, 4, 5])
      Number.isFinite(floats[7 * v + word]) || fail("input", `${place}: ground vertex ${v} is not finite`);
  for (let index of indices)
    index >= vertexCount && fail("input", `${place}: ground index ${index} has no vertex; there are ${vertexCount}`);
  for (let range of ground.ranges)
    range.material >= ground.materials.length && fail("input", `${place}: ground material ${range.material} is missing; there are ${ground.materials.length}`), (range.indexCount % 3 !== 0 || range.firstIndex + range.indexCount > indices.length) && fail(
      "input",
      `${place}: a ground range of ${range.indexCount} indices from ${range.firstIndex} does not fit into ${indices.length}`
    );
  for (let material of ground.materials) {
    material.image >= ground.images.length && fail("input", `${place}: ground image ${material.image} is missing; there are ${ground.images.length}`);
    let isUnit = (x) => x >= 0 && x <= 1;
    (!material.baseColor.every(Number.isFinite) || !isUnit(material.roughness) || !isUnit(material.metallic)) && fail("input", `${place}: a ground material is out of range`);
  }
}
async function readGround(container) {
  let place = container.source.name, names = ["GVERTICE", "GINDICES", "GRANGES", "GMATERIA", "GIMAGES"], [vertices, indexBytes, rangeBytes, materialBytes, imageBytes] = await Promise.all(
    names.map((name) => bytesOf(container, name))
  ), rangeWords = new Uint32Array(rangeBytes.buffer, 0, rangeBytes.length / 4), ranges = [];
  for (let i = 0; i < rangeWords.length; i += 4)
    ranges.push({
      level: rangeWords[i],
      material: rangeWords[i + 1],
      firstIndex: rangeWords[i + 2],
      indexCount: rangeWords[i + 3]
    });
  let view = new DataView(materialBytes.buffer, 0, materialBytes.length), materials = [];
  for (let at = 0; at < materialBytes.length; at += 32) {
    let float = (word) => view.getFloat32(at + 4 * word, !0), image = view.getUint32(at + 24, !0);
    materials.push({
      baseColor: [float(0), float(1), float(2), float(3)],
      roughness: float(4),
      metallic: float(5),
      image: image === noImage ? -1 : image,
      isDoubleSided: (view.getUint32(at + 28, !0) & 1) !== 0
    });
  }
  let ground = {
    vertices,
    vertexCount: vertices.length / groundVertexBytes,
    indices: new Uint32Array(indexBytes.buffer, 0, indexBytes.length / 4),
    ranges,
    materials,
    images: imagesOf(imageBytes, `${place}: ground images`)
  };
  return verify(ground, place), ground;
}

// src/format/seeds.ts
var facings = ["outward", "shared", "free"], longest = 1e6, farthestOrigin = 1e12, maxSpecies2 = 8;
function parseSeed(text2, place) {
  /^[0-9a-f]{1,16}$/i.test(text2) || fail("input", `${place}: "${text2}" is not a number of up to 16 hexadecimal digits`);
  let digits = text2.padStart(16, "0");
  return [parseInt(digits.slice(0, 8), 16), parseInt(digits.slice(8), 16)];
}
function parseSeedMeadow(text2, place) {
  let reader = new SettingsReader(parseJson(text2, place), place), flag2 = (key) => {
    let value = reader.value(key) ?? !1;
    return typeof value != "boolean" && fail("input", `${place}: expected true or false, found ${JSON.stringify(value)}`), value;
  }, meadow = {
    seed: parseSeed(reader.text("seed", ""), place),
    density: reader.number("density", 0, 0, 1e15),
    scale: reader.number("scale", 1, 1e-3, 1e5),
    clumpSpacing: reader.number("clump_spacing", 0, 0, 1e9),
    stored: reader.number("stored", 0, 0, 1),
    storedWidening: reader.number("stored_widening", 1, 1, 2),
    unitBits: reader.number("unit_bits", 20, 11, 24),
    levels: reader.number("levels", 0, 0, 10),
    isMixed: flag2("mixed"),
    heightWaves: reader.number("height_waves", 0, 0, 0.5),
    drifts: reader.number("drifts", 0, 0, 1),
    sparseHeight: reader.number("sparse_height", 1, 0, 1),
    wideVariation: reader.number("wide_variation", 0, 0, 1),
    creaseReach: reader.number("crease_reach", 0, 0, longest),
    creaseBlend: reader.number("crease_blend", 0, 0, 1),
    vertical: reader.number("vertical", 0, 0, 1),
    isRadial: flag2("radial"),
    up: reader.vector("up", [0, 1, 0], -farthestOrigin, farthestOrigin),
    highest: reader.number("highest", 1, 1e-9, longest),
    widest: reader.number("widest", 1, 1e-9, longest),
    species: reader.array("species").map((entry, i) => {
      let one = new SettingsReader(entry, `${place}: species ${i}`), species = {
        share: one.number("share", 0, 0, 1),
        height: one.vector("height", [0, 0], 0, longest),
        width: one.vector("width", [0, 0], 0, longest),
        stiffness: one.vector("stiffness", [0, 0], 0, 1),
        clumping: one.number("clumping", 0, 0, 1),
        facing: one.word("facing", facings, 2),
        ribbons: one.number("ribbons", 0, 0, 63)
      };
      return one.finish(), species;
    })
  };
  for (let key of ["unitBits", "levels"])
    Number.isInteger(meadow[key]) || fail("input", `${place}: ${meadow[key]} is not a whole number`);
  return reader.finish(), (meadow.species.length === 0 || meadow.species.length > maxSpecies2) && fail("input", `${place}: expected an array of 1 to ${maxSpecies2} species`), meadow;
}
var entryBytes2 = 48, Seeds = class _Seeds {
  constructor(container, offset, meadow, entries) {
    this.container = container;
    this.offset = offset;
    this.meadow = meadow;
    this.entries = entries;
    this.count = entries.length / entryBytes2, this.view = new DataView(entries.buffer, entries.byteOffset, entries.length);
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
    let text2 = await container.text("SEEDS");
    if (text2 === void 0) return;
    let place = container.source.name, meadow = parseSeedMeadow(text2, `${place}: seeds`);
    meadow.species.length !== speciesCount && fail("input", `${place}: the seeds have ${meadow.species.length} species, of ${speciesCount} that there are`);
    let data = container.need("SEEDDATA"), entries = await container.bytes(container.need("SEEDCELL")), seeds = new _Seeds(container, data.offset, meadow, entries);
    return seeds.verify(data.storedBytes, place), seeds;
  }
  /** The zstd frame of a cell. */
  async frame(index) {
    let at = this.offset + this.number(index, 32);
    return (await this.container.source.read(at, at + this.number(index, 40))).slice();
  }
  number(index, at) {
    return Number(this.view.getBigUint64(index * entryBytes2 + at, !0));
  }
  cell(index) {
    return [0, 4, 8].map((at) => this.view.getInt32(index * entryBytes2 + at, !0));
  }
  verify(bytes, place) {
    let at = 0;
    for (let i = 0; i < this.count; ++i) {
      if (i > 0) {
        let [a, b] = [this.cell(i - 1), this.cell(i)], axis = [0, 1, 2].find((k) => a[k] !== b[k]);
        (axis === void 0 || a[axis] > b[axis]) && fail("input", `${place}: cell ${i} of the seeds is out of order`);
      }
      let [offset, size2] = [this.number(i, 32), this.number(i, 40)];
      (offset !== at || size2 > bytes - at) && fail("input", `${place}: cell ${i} of the seeds, ${size2} bytes at ${offset}, does not fit`), at += size2;
    }
    at !== bytes && fail("input", `${place}: bytes follow the last cell of the seeds`);
  }
};

// src/format/options.ts
function shown2(value) {
  let text2 = typeof value == "function" ? "a function" : JSON.stringify(value) ?? String(value);
  return text2.length > 80 ? `${text2.slice(0, 79)}…` : text2;
}
function expectOption(place, value, allowed, isAllowed) {
  isAllowed || fail("usage", `${place}: ${shown2(value)} is not ${allowed}`);
}
function numberIn(place, value, low, high) {
  return expectOption(place, value, `a number from ${low} to ${high}`, typeof value == "number" && value >= low && value <= high), value;
}
function checkOptions(place, options, rules2, needed) {
  let isObject = typeof options == "object" && options !== null;
  expectOption(place, options, `an object with some of ${Object.keys(rules2).join(", ")}`, isObject);
  let values = options;
  for (let name of Object.keys(values))
    Object.hasOwn(rules2, name) || fail("usage", `${place}: no option ${name}; there are ${Object.keys(rules2).join(", ")}`);
  for (let [name, [allowed, test]] of Object.entries(rules2))
    (values[name] !== void 0 || name === needed) && expectOption(`${place}: option ${name}`, values[name], allowed, test(values[name]));
}
var address = ["the address of a file", (value) => typeof value == "string" && value !== "" || value instanceof URL], flag = ["true or false", (value) => typeof value == "boolean"], callback = ["a function", (value) => typeof value == "function"];

// src/format/source.ts
var BufferSource = class {
  constructor(name, bytes) {
    this.name = name;
    this.bytes = bytes;
    this.size = bytes.length, this.received = bytes.length;
  }
  name;
  bytes;
  isWhole = !0;
  size;
  received;
  async read(from, to) {
    return this.bytes.subarray(from, to);
  }
}, firstBytes = 65536, RangeSource = class {
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
  isWhole = !1;
  received;
  async read(from, to) {
    if (to <= this.first.length) return this.first.slice(from, to);
    let response = await this.get(from, to);
    response.status !== 206 && fail("io", `${this.name}: status ${response.status} for bytes ${from} to ${to}, instead of 206`);
    let bytes = await bodyOf(response, this.name);
    return this.received += bytes.length, bytes.length !== to - from && fail("io", `${this.name}: ${bytes.length} bytes of ${to - from} came: truncated`), bytes;
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
  let total = Number(response.headers.get("content-length") ?? 0), reader = response.body.getReader(), parts = [], received = 0;
  try {
    for (; ; ) {
      let { done, value } = await reader.read();
      if (done) break;
      parts.push(value), received += value.length, onProgress(received, Math.max(total, received));
    }
  } catch (error) {
    if (isAbort(error)) throw error;
    fail("io", `${name}: the connection ended after ${received} bytes`);
  }
  let bytes = new Uint8Array(received), at = 0;
  for (let part of parts)
    bytes.set(part, at), at += part.length;
  return bytes;
}
function isAbort(error) {
  return error instanceof Error && error.name === "AbortError" && !(error instanceof SwardError);
}
async function openSource(address2, options = {}) {
  expectOption("openField", address2, address[0], address[1](address2)), address2 = String(address2);
  let doFetch = options.fetch ?? fetch, get = async (range) => {
    try {
      return await doFetch(address2, {
        headers: range ? { Range: range } : {},
        signal: options.signal ?? null
      });
    } catch (error) {
      if (isAbort(error)) throw error;
      fail("io", `${address2}: no answer from the server`);
    }
  }, byRanges = options.ranges ?? !0, response = await get(byRanges ? `bytes=0-${firstBytes - 1}` : void 0), total = /\/(\d+)$/.exec(response.headers.get("content-range") ?? "");
  if (response.status === 206 && total) {
    let first = await bodyOf(response, address2);
    return new RangeSource(
      address2,
      Number(total[1]),
      first,
      (from, to) => get(`bytes=${from}-${to - 1}`)
    );
  }
  return response.status === 416 ? new BufferSource(address2, new Uint8Array(0)) : (response.ok || fail("io", `${address2}: the server answers ${response.status}`), new BufferSource(address2, await bodyInParts(response, address2, options.onProgress)));
}

// src/format/field.ts
var pageBlades = 1024, pagesPerRequest = 256, Field = class _Field {
  constructor(container, bladeChunk, patches, species, defaults, ground, thinned, seeds) {
    this.container = container;
    this.bladeChunk = bladeChunk;
    this.patches = patches;
    this.species = species;
    this.defaults = defaults;
    this.ground = ground;
    this.thinned = thinned;
    this.seeds = seeds;
    this.name = container.source.name, this.origin = container.origin, this.version = container.version, this.bladeCount = bladeChunk.elementCount, this.pageCount = Math.ceil(this.bladeCount / pageBlades), this.packed = new Uint32Array(bladeWords * this.bladeCount), this.states = new Uint8Array(this.pageCount);
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
    let place = container.source.name, bladeChunk = container.need("BLADES");
    bladeChunk.rawBytes !== bladeChunk.storedBytes && fail("unsupported", `${place}: chunk BLADES is compressed, which this version does not map`), container.need("SPECIES"), container.need("DEFAULTS");
    let [patchBytes, species, defaults, cover, ground] = await Promise.all([
      container.bytes(container.need("PATCHES")),
      container.text("SPECIES"),
      container.text("DEFAULTS"),
      container.text("COVER"),
      readGround(container)
    ]), patches = new Patches(patchBytes);
    patches.verify(bladeChunk.elementCount, place);
    let kinds2 = parseSpecies(species, `${place}: species`);
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
    let stored = this.seeds?.meadow.stored ?? 1;
    return this.bladeCount > 0 && stored > 0 && stored < 1;
  }
  /** Hash of the packed blades, which tells fields apart. */
  get bladesHash() {
    return this.bladeChunk.hash;
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
    if (count <= 0) return !0;
    for (let p = Math.floor(first / pageBlades); p <= Math.floor((first + count - 1) / pageBlades); ++p)
      if (this.states[p] !== 2) return !1;
    return !0;
  }
  /** Whether a page is neither here nor under way. */
  isMissing(page) {
    return this.states[page] === 0;
  }
  /** Whether a blade is a ribbon on the stalk of a compound plant, without a root of its own. */
  isRibbon(blade) {
    let look = this.packed[bladeWords * blade + 3];
    return look >>> 24 > 0 && this.species[look >>> 21 & 7].organs.length > 0;
  }
  /**
   * Fetches pages `from` up to, not including, `to` that are neither here nor under way. Blades are checked; their
   * hash is checked when all are here, so that a damaged file is an error of the last page at the latest.
   */
  async loadPages(from, to) {
    let runs = [];
    for (let page = from; page < to; ++page) {
      if (this.states[page] !== 0) continue;
      this.states[page] = 1;
      let last = runs[runs.length - 1];
      last && last[1] === page && page - last[0] < pagesPerRequest ? last[1] = page + 1 : runs.push([page, page + 1]);
    }
    await Promise.all(runs.map(([begin, end]) => this.loadRun(begin, end)));
  }
  /** Fetches all blades, and compares them with their hash. */
  async loadAll() {
    for (let page = 0; page < this.pageCount; page += pagesPerRequest)
      await this.loadPages(page, Math.min(page + pagesPerRequest, this.pageCount));
    this.pageCount === 0 && await this.checkBlades();
  }
  /** Blades as arrays; all of them, or `count` from `first` on. They must be here. */
  blades(first = 0, count = this.bladeCount - first) {
    return (first < 0 || count < 0 || first + count > this.bladeCount) && fail("usage", `${this.name}: blades ${first} to ${first + count} of ${this.bladeCount}`), this.has(first, count) || fail("usage", `${this.name}: some of the blades ${first} to ${first + count} are not loaded`), unpackBlades(this.packed, this.patches, first, count);
  }
  /** The id of a blade, as in the CSV export. Call loadKeys() before. */
  idOf(blade) {
    return bladeId(this.keys ?? new Uint32Array(0), blade);
  }
  /** Fetches the origins of all blades, which only idOf() needs. */
  async loadKeys() {
    let chunk = this.container.find("KEYS");
    if (!chunk || this.keys) return;
    chunk.elementCount !== 0 && chunk.elementCount !== this.bladeCount && fail("input", `${this.name}: ${chunk.elementCount} keys for ${this.bladeCount} blades`);
    let bytes = await this.container.bytes(chunk);
    this.keys = new Uint32Array(bytes.buffer, 0, bytes.length / 4);
  }
  /** The JSON text of the file's provenance. */
  async provenance() {
    return await this.container.text("PROVENAN") ?? "{}";
  }
  /** Compares what only the whole file tells: the bytes between chunks, and chunks that are not drawn. */
  async verifyRest() {
    await this.container.checkPadding();
    for (let chunk of this.container.chunks) await this.container.bytes(chunk);
    await this.loadKeys();
  }
  async loadRun(begin, end) {
    let first = begin * pageBlades, count = Math.min(end * pageBlades, this.bladeCount) - first, from = this.bladeChunk.offset + 16 * first, bytes;
    try {
      bytes = await this.container.source.read(from, from + 16 * count);
    } catch (error) {
      throw this.states.fill(0, begin, end), error;
    }
    new Uint8Array(this.packed.buffer).set(bytes, 16 * first), verifyBlades(this.packed, this.patches, this.species, first, count, this.name), this.states.fill(2, begin, end), this.present += end - begin, this.isComplete && await this.checkBlades();
  }
  async checkBlades() {
    await this.container.checkHash(this.bladeChunk, new Uint8Array(this.packed.buffer));
  }
};
async function readField(file, name = "field") {
  let bytes = file instanceof Uint8Array ? new Uint8Array(file.buffer, file.byteOffset, file.length) : new Uint8Array(file), field = await Field.open(await Container.open(new BufferSource(name, bytes)));
  return await field.loadAll(), await field.verifyRest(), field;
}
async function openField(address2, options = {}) {
  return Field.open(await Container.open(await openSource(address2, options)));
}

// src/generated/layout.ts
var lodFullShare = 1.1111111111111112;
var windNoise = 0, windWave = 2, windsAlike = 16777216, latticeX = 2654435761, latticeY = 2246822519, latticeZ = 3266489917, fineNoiseScale = 2.7, fineNoiseStart = 17.3, unsettledTurn = 2147516416, maxHeightCompensation = 1.3, outlineMost = 1.35, heightSteps = 16, bladeShadowTexels = 1024, bladeShadowSegments = 8, cullPatch = 1, cullOrientation = 2, cullFrustum = 4, cullDistance = 8, leaveThinned = 32, toneBits = 2147713024, shapeCount = 7, frameBytes = 2640, frameLayout = { viewProjection: 0, "rays[0]": 64, "rays[1]": 80, "rays[2]": 96, depthOfEye: 112, "view.planes[0]": 128, "view.planes[1]": 144, "view.planes[2]": 160, "view.planes[3]": 176, "view.planes[4]": 192, "view.planes[5]": 208, "view.eye": 224, "view.drawDistance": 236, "view.pixelsPerUnit": 240, "view.lodThreshold": 244, "view.lodWidth": 248, "view.minWidth": 252, "view.maxLeafArea": 256, "view.maxEdgeOn": 260, "view.samples": 264, "view.buckets": 268, "view.bucketDistance": 272, "view.cullMask": 276, "view.areaFactor": 280, "view.sparseFrom": 284, "view.sparseLeast": 288, "environment.gravity.direction": 304, "environment.gravity.strength": 316, "environment.gravity.attractor": 320, "environment.gravity.blend": 332, "environment.gravity.forward": 336, "environment.recovery": 352, "environment.colliderCount": 356, "environment.wind.counts": 368, "environment.wind.eddySize": 372, "environment.wind.eddySpeed": 376, "environment.wind.sum": 380, "environment.wind.eddyPhase": 384, "environment.wind.lattice.origin": 400, "environment.wind.lattice.x": 416, "environment.wind.lattice.y": 432, "environment.wind.lattice.z": 448, "environment.wind.sources[0].direction": 464, "environment.wind.sources[0].strength": 476, "environment.wind.sources[0].centre": 480, "environment.wind.sources[0].size": 492, "environment.wind.sources[0].speed": 496, "environment.wind.sources[0].rate": 500, "environment.wind.sources[0].turn": 504, "environment.wind.sources[0].alignment": 508, "environment.wind.sources[0].lift": 512, "environment.wind.sources[0].kind": 516, "environment.wind.sources[0].side": 528, "environment.wind.sources[0].perSize": 540, "environment.wind.sources[1].direction": 544, "environment.wind.sources[1].strength": 556, "environment.wind.sources[1].centre": 560, "environment.wind.sources[1].size": 572, "environment.wind.sources[1].speed": 576, "environment.wind.sources[1].rate": 580, "environment.wind.sources[1].turn": 584, "environment.wind.sources[1].alignment": 588, "environment.wind.sources[1].lift": 592, "environment.wind.sources[1].kind": 596, "environment.wind.sources[1].side": 608, "environment.wind.sources[1].perSize": 620, "environment.wind.sources[2].direction": 624, "environment.wind.sources[2].strength": 636, "environment.wind.sources[2].centre": 640, "environment.wind.sources[2].size": 652, "environment.wind.sources[2].speed": 656, "environment.wind.sources[2].rate": 660, "environment.wind.sources[2].turn": 664, "environment.wind.sources[2].alignment": 668, "environment.wind.sources[2].lift": 672, "environment.wind.sources[2].kind": 676, "environment.wind.sources[2].side": 688, "environment.wind.sources[2].perSize": 700, "environment.wind.sources[3].direction": 704, "environment.wind.sources[3].strength": 716, "environment.wind.sources[3].centre": 720, "environment.wind.sources[3].size": 732, "environment.wind.sources[3].speed": 736, "environment.wind.sources[3].rate": 740, "environment.wind.sources[3].turn": 744, "environment.wind.sources[3].alignment": 748, "environment.wind.sources[3].lift": 752, "environment.wind.sources[3].kind": 756, "environment.wind.sources[3].side": 768, "environment.wind.sources[3].perSize": 780, "environment.wind.sources[4].direction": 784, "environment.wind.sources[4].strength": 796, "environment.wind.sources[4].centre": 800, "environment.wind.sources[4].size": 812, "environment.wind.sources[4].speed": 816, "environment.wind.sources[4].rate": 820, "environment.wind.sources[4].turn": 824, "environment.wind.sources[4].alignment": 828, "environment.wind.sources[4].lift": 832, "environment.wind.sources[4].kind": 836, "environment.wind.sources[4].side": 848, "environment.wind.sources[4].perSize": 860, "environment.wind.sources[5].direction": 864, "environment.wind.sources[5].strength": 876, "environment.wind.sources[5].centre": 880, "environment.wind.sources[5].size": 892, "environment.wind.sources[5].speed": 896, "environment.wind.sources[5].rate": 900, "environment.wind.sources[5].turn": 904, "environment.wind.sources[5].alignment": 908, "environment.wind.sources[5].lift": 912, "environment.wind.sources[5].kind": 916, "environment.wind.sources[5].side": 928, "environment.wind.sources[5].perSize": 940, "environment.wind.sources[6].direction": 944, "environment.wind.sources[6].strength": 956, "environment.wind.sources[6].centre": 960, "environment.wind.sources[6].size": 972, "environment.wind.sources[6].speed": 976, "environment.wind.sources[6].rate": 980, "environment.wind.sources[6].turn": 984, "environment.wind.sources[6].alignment": 988, "environment.wind.sources[6].lift": 992, "environment.wind.sources[6].kind": 996, "environment.wind.sources[6].side": 1008, "environment.wind.sources[6].perSize": 1020, "environment.wind.sources[7].direction": 1024, "environment.wind.sources[7].strength": 1036, "environment.wind.sources[7].centre": 1040, "environment.wind.sources[7].size": 1052, "environment.wind.sources[7].speed": 1056, "environment.wind.sources[7].rate": 1060, "environment.wind.sources[7].turn": 1064, "environment.wind.sources[7].alignment": 1068, "environment.wind.sources[7].lift": 1072, "environment.wind.sources[7].kind": 1076, "environment.wind.sources[7].side": 1088, "environment.wind.sources[7].perSize": 1100, "environment.wind.phases[0].shift": 1104, "environment.wind.phases[0].cell": 1116, "environment.wind.phases[0].fineShift": 1120, "environment.wind.phases[0].fineCell": 1132, "environment.wind.phases[0].angle": 1136, "environment.wind.phases[0].turned": 1140, "environment.wind.phases[1].shift": 1152, "environment.wind.phases[1].cell": 1164, "environment.wind.phases[1].fineShift": 1168, "environment.wind.phases[1].fineCell": 1180, "environment.wind.phases[1].angle": 1184, "environment.wind.phases[1].turned": 1188, "environment.wind.phases[2].shift": 1200, "environment.wind.phases[2].cell": 1212, "environment.wind.phases[2].fineShift": 1216, "environment.wind.phases[2].fineCell": 1228, "environment.wind.phases[2].angle": 1232, "environment.wind.phases[2].turned": 1236, "environment.wind.phases[3].shift": 1248, "environment.wind.phases[3].cell": 1260, "environment.wind.phases[3].fineShift": 1264, "environment.wind.phases[3].fineCell": 1276, "environment.wind.phases[3].angle": 1280, "environment.wind.phases[3].turned": 1284, "environment.wind.phases[4].shift": 1296, "environment.wind.phases[4].cell": 1308, "environment.wind.phases[4].fineShift": 1312, "environment.wind.phases[4].fineCell": 1324, "environment.wind.phases[4].angle": 1328, "environment.wind.phases[4].turned": 1332, "environment.wind.phases[5].shift": 1344, "environment.wind.phases[5].cell": 1356, "environment.wind.phases[5].fineShift": 1360, "environment.wind.phases[5].fineCell": 1372, "environment.wind.phases[5].angle": 1376, "environment.wind.phases[5].turned": 1380, "environment.wind.phases[6].shift": 1392, "environment.wind.phases[6].cell": 1404, "environment.wind.phases[6].fineShift": 1408, "environment.wind.phases[6].fineCell": 1420, "environment.wind.phases[6].angle": 1424, "environment.wind.phases[6].turned": 1428, "environment.wind.phases[7].shift": 1440, "environment.wind.phases[7].cell": 1452, "environment.wind.phases[7].fineShift": 1456, "environment.wind.phases[7].fineCell": 1468, "environment.wind.phases[7].angle": 1472, "environment.wind.phases[7].turned": 1476, patchCount: 1488, bladeCount: 1492, visibleCapacity: 1496, maxTessellation: 1500, sunDirection: 1504, exposure: 1516, sunColor: 1520, debugMode: 1532, skyColor: 1536, fogDensity: 1548, groundColor: 1552, skyUp: 1568, fixedTessellation: 1580, clouds: 1584, "levelSteps.distance": 1600, "levelSteps.segments": 1616, "levelSteps.count": 1632, "updateRate.everyFrame": 1648, "updateRate.everyThird": 1652, "updateRate.longest": 1656, "updateRate.frame": 1660, "cover.low": 1664, "cover.cellsPerMetre": 1676, "cover.countX": 1680, "cover.countY": 1684, "cover.countZ": 1688, "cover.farthest": 1692, "cover.undergrowth": 1696, "cover.thatch": 1708, "cover.sward": 1712, "cover.thinned": 1724, "cover.structure": 1728, "cover.stepsPerMetre": 1732, "cover.leaves[0]": 1744, "cover.leaves[1]": 1760, "cover.leaves[2]": 1776, "cover.leaves[3]": 1792, "cover.leaves[4]": 1808, "cover.leaves[5]": 1824, "cover.leaves[6]": 1840, "cover.leaves[7]": 1856, "shadow.across": 1872, "shadow.down": 1888, "shadow.depth": 1904, "shadow.size": 1920, "shadow.texel": 1924, "shadow.epsilon": 1928, "shadow.reserved": 1932, "bladeShadow.across": 1936, "bladeShadow.down": 1952, "bladeShadow.depth": 1968, "bladeShadow.size": 1984, "bladeShadow.nearer": 1988, fogFalloff: 2e3, lowSun: 2004, tick: 2008, "floorPlane.middle": 2016, "floorPlane.reach": 2028, "floorPlane.along": 2032, "floorPlane.height": 2044, "floorPlane.halfSides": 2048, "floorPlane.cornerRadius": 2056, "reserved[0]": 2064, "reserved[1]": 2080, "reserved[2]": 2096, "reserved[3]": 2112, "reserved[4]": 2128, "reserved[5]": 2144, "reserved[6]": 2160, "reserved[7]": 2176, "reserved[8]": 2192, "reserved[9]": 2208, "reserved[10]": 2224, "reserved[11]": 2240, "reserved[12]": 2256, "reserved[13]": 2272, "reserved[14]": 2288, "reserved[15]": 2304, "reserved[16]": 2320, "reserved[17]": 2336, "reserved[18]": 2352, "reserved[19]": 2368, "reserved[20]": 2384, "reserved[21]": 2400, "reserved[22]": 2416, "reserved[23]": 2432, "reserved[24]": 2448, "reserved[25]": 2464, "reserved[26]": 2480, "reserved[27]": 2496, "reserved[28]": 2512, "reserved[29]": 2528, "reserved[30]": 2544, "reserved[31]": 2560, "reserved[32]": 2576, "reserved[33]": 2592, "reserved[34]": 2608, "reserved[35]": 2624 }, looksBytes = 4608, looksLayout = { "species[0].rootColor": 0, "species[0].tipThreshold": 12, "species[0].tipColor": 16, "species[0].groundTint": 28, "species[0].colorVariation": 32, "species[0].translucency": 36, "species[0].gloss": 40, "species[0].dryness": 44, "species[0].shape": 48, "species[0].fold": 52, "species[0].firstOrgan": 56, "species[0].organKinds": 60, "species[1].rootColor": 64, "species[1].tipThreshold": 76, "species[1].tipColor": 80, "species[1].groundTint": 92, "species[1].colorVariation": 96, "species[1].translucency": 100, "species[1].gloss": 104, "species[1].dryness": 108, "species[1].shape": 112, "species[1].fold": 116, "species[1].firstOrgan": 120, "species[1].organKinds": 124, "species[2].rootColor": 128, "species[2].tipThreshold": 140, "species[2].tipColor": 144, "species[2].groundTint": 156, "species[2].colorVariation": 160, "species[2].translucency": 164, "species[2].gloss": 168, "species[2].dryness": 172, "species[2].shape": 176, "species[2].fold": 180, "species[2].firstOrgan": 184, "species[2].organKinds": 188, "species[3].rootColor": 192, "species[3].tipThreshold": 204, "species[3].tipColor": 208, "species[3].groundTint": 220, "species[3].colorVariation": 224, "species[3].translucency": 228, "species[3].gloss": 232, "species[3].dryness": 236, "species[3].shape": 240, "species[3].fold": 244, "species[3].firstOrgan": 248, "species[3].organKinds": 252, "species[4].rootColor": 256, "species[4].tipThreshold": 268, "species[4].tipColor": 272, "species[4].groundTint": 284, "species[4].colorVariation": 288, "species[4].translucency": 292, "species[4].gloss": 296, "species[4].dryness": 300, "species[4].shape": 304, "species[4].fold": 308, "species[4].firstOrgan": 312, "species[4].organKinds": 316, "species[5].rootColor": 320, "species[5].tipThreshold": 332, "species[5].tipColor": 336, "species[5].groundTint": 348, "species[5].colorVariation": 352, "species[5].translucency": 356, "species[5].gloss": 360, "species[5].dryness": 364, "species[5].shape": 368, "species[5].fold": 372, "species[5].firstOrgan": 376, "species[5].organKinds": 380, "species[6].rootColor": 384, "species[6].tipThreshold": 396, "species[6].tipColor": 400, "species[6].groundTint": 412, "species[6].colorVariation": 416, "species[6].translucency": 420, "species[6].gloss": 424, "species[6].dryness": 428, "species[6].shape": 432, "species[6].fold": 436, "species[6].firstOrgan": 440, "species[6].organKinds": 444, "species[7].rootColor": 448, "species[7].tipThreshold": 460, "species[7].tipColor": 464, "species[7].groundTint": 476, "species[7].colorVariation": 480, "species[7].translucency": 484, "species[7].gloss": 488, "species[7].dryness": 492, "species[7].shape": 496, "species[7].fold": 500, "species[7].firstOrgan": 504, "species[7].organKinds": 508, "organs[0].look.rootColor": 512, "organs[0].look.tipThreshold": 524, "organs[0].look.tipColor": 528, "organs[0].look.groundTint": 540, "organs[0].look.colorVariation": 544, "organs[0].look.translucency": 548, "organs[0].look.gloss": 552, "organs[0].look.dryness": 556, "organs[0].look.shape": 560, "organs[0].look.fold": 564, "organs[0].look.firstOrgan": 568, "organs[0].look.organKinds": 572, "organs[0].count": 576, "organs[0].place": 584, "organs[0].pitch": 592, "organs[0].size": 600, "organs[0].width": 608, "organs[0].azimuth": 612, "organs[0].turn": 616, "organs[0].bend": 620, "organs[0].leg": 624, "organs[0].variation": 628, "organs[1].look.rootColor": 640, "organs[1].look.tipThreshold": 652, "organs[1].look.tipColor": 656, "organs[1].look.groundTint": 668, "organs[1].look.colorVariation": 672, "organs[1].look.translucency": 676, "organs[1].look.gloss": 680, "organs[1].look.dryness": 684, "organs[1].look.shape": 688, "organs[1].look.fold": 692, "organs[1].look.firstOrgan": 696, "organs[1].look.organKinds": 700, "organs[1].count": 704, "organs[1].place": 712, "organs[1].pitch": 720, "organs[1].size": 728, "organs[1].width": 736, "organs[1].azimuth": 740, "organs[1].turn": 744, "organs[1].bend": 748, "organs[1].leg": 752, "organs[1].variation": 756, "organs[2].look.rootColor": 768, "organs[2].look.tipThreshold": 780, "organs[2].look.tipColor": 784, "organs[2].look.groundTint": 796, "organs[2].look.colorVariation": 800, "organs[2].look.translucency": 804, "organs[2].look.gloss": 808, "organs[2].look.dryness": 812, "organs[2].look.shape": 816, "organs[2].look.fold": 820, "organs[2].look.firstOrgan": 824, "organs[2].look.organKinds": 828, "organs[2].count": 832, "organs[2].place": 840, "organs[2].pitch": 848, "organs[2].size": 856, "organs[2].width": 864, "organs[2].azimuth": 868, "organs[2].turn": 872, "organs[2].bend": 876, "organs[2].leg": 880, "organs[2].variation": 884, "organs[3].look.rootColor": 896, "organs[3].look.tipThreshold": 908, "organs[3].look.tipColor": 912, "organs[3].look.groundTint": 924, "organs[3].look.colorVariation": 928, "organs[3].look.translucency": 932, "organs[3].look.gloss": 936, "organs[3].look.dryness": 940, "organs[3].look.shape": 944, "organs[3].look.fold": 948, "organs[3].look.firstOrgan": 952, "organs[3].look.organKinds": 956, "organs[3].count": 960, "organs[3].place": 968, "organs[3].pitch": 976, "organs[3].size": 984, "organs[3].width": 992, "organs[3].azimuth": 996, "organs[3].turn": 1e3, "organs[3].bend": 1004, "organs[3].leg": 1008, "organs[3].variation": 1012, "organs[4].look.rootColor": 1024, "organs[4].look.tipThreshold": 1036, "organs[4].look.tipColor": 1040, "organs[4].look.groundTint": 1052, "organs[4].look.colorVariation": 1056, "organs[4].look.translucency": 1060, "organs[4].look.gloss": 1064, "organs[4].look.dryness": 1068, "organs[4].look.shape": 1072, "organs[4].look.fold": 1076, "organs[4].look.firstOrgan": 1080, "organs[4].look.organKinds": 1084, "organs[4].count": 1088, "organs[4].place": 1096, "organs[4].pitch": 1104, "organs[4].size": 1112, "organs[4].width": 1120, "organs[4].azimuth": 1124, "organs[4].turn": 1128, "organs[4].bend": 1132, "organs[4].leg": 1136, "organs[4].variation": 1140, "organs[5].look.rootColor": 1152, "organs[5].look.tipThreshold": 1164, "organs[5].look.tipColor": 1168, "organs[5].look.groundTint": 1180, "organs[5].look.colorVariation": 1184, "organs[5].look.translucency": 1188, "organs[5].look.gloss": 1192, "organs[5].look.dryness": 1196, "organs[5].look.shape": 1200, "organs[5].look.fold": 1204, "organs[5].look.firstOrgan": 1208, "organs[5].look.organKinds": 1212, "organs[5].count": 1216, "organs[5].place": 1224, "organs[5].pitch": 1232, "organs[5].size": 1240, "organs[5].width": 1248, "organs[5].azimuth": 1252, "organs[5].turn": 1256, "organs[5].bend": 1260, "organs[5].leg": 1264, "organs[5].variation": 1268, "organs[6].look.rootColor": 1280, "organs[6].look.tipThreshold": 1292, "organs[6].look.tipColor": 1296, "organs[6].look.groundTint": 1308, "organs[6].look.colorVariation": 1312, "organs[6].look.translucency": 1316, "organs[6].look.gloss": 1320, "organs[6].look.dryness": 1324, "organs[6].look.shape": 1328, "organs[6].look.fold": 1332, "organs[6].look.firstOrgan": 1336, "organs[6].look.organKinds": 1340, "organs[6].count": 1344, "organs[6].place": 1352, "organs[6].pitch": 1360, "organs[6].size": 1368, "organs[6].width": 1376, "organs[6].azimuth": 1380, "organs[6].turn": 1384, "organs[6].bend": 1388, "organs[6].leg": 1392, "organs[6].variation": 1396, "organs[7].look.rootColor": 1408, "organs[7].look.tipThreshold": 1420, "organs[7].look.tipColor": 1424, "organs[7].look.groundTint": 1436, "organs[7].look.colorVariation": 1440, "organs[7].look.translucency": 1444, "organs[7].look.gloss": 1448, "organs[7].look.dryness": 1452, "organs[7].look.shape": 1456, "organs[7].look.fold": 1460, "organs[7].look.firstOrgan": 1464, "organs[7].look.organKinds": 1468, "organs[7].count": 1472, "organs[7].place": 1480, "organs[7].pitch": 1488, "organs[7].size": 1496, "organs[7].width": 1504, "organs[7].azimuth": 1508, "organs[7].turn": 1512, "organs[7].bend": 1516, "organs[7].leg": 1520, "organs[7].variation": 1524, "organs[8].look.rootColor": 1536, "organs[8].look.tipThreshold": 1548, "organs[8].look.tipColor": 1552, "organs[8].look.groundTint": 1564, "organs[8].look.colorVariation": 1568, "organs[8].look.translucency": 1572, "organs[8].look.gloss": 1576, "organs[8].look.dryness": 1580, "organs[8].look.shape": 1584, "organs[8].look.fold": 1588, "organs[8].look.firstOrgan": 1592, "organs[8].look.organKinds": 1596, "organs[8].count": 1600, "organs[8].place": 1608, "organs[8].pitch": 1616, "organs[8].size": 1624, "organs[8].width": 1632, "organs[8].azimuth": 1636, "organs[8].turn": 1640, "organs[8].bend": 1644, "organs[8].leg": 1648, "organs[8].variation": 1652, "organs[9].look.rootColor": 1664, "organs[9].look.tipThreshold": 1676, "organs[9].look.tipColor": 1680, "organs[9].look.groundTint": 1692, "organs[9].look.colorVariation": 1696, "organs[9].look.translucency": 1700, "organs[9].look.gloss": 1704, "organs[9].look.dryness": 1708, "organs[9].look.shape": 1712, "organs[9].look.fold": 1716, "organs[9].look.firstOrgan": 1720, "organs[9].look.organKinds": 1724, "organs[9].count": 1728, "organs[9].place": 1736, "organs[9].pitch": 1744, "organs[9].size": 1752, "organs[9].width": 1760, "organs[9].azimuth": 1764, "organs[9].turn": 1768, "organs[9].bend": 1772, "organs[9].leg": 1776, "organs[9].variation": 1780, "organs[10].look.rootColor": 1792, "organs[10].look.tipThreshold": 1804, "organs[10].look.tipColor": 1808, "organs[10].look.groundTint": 1820, "organs[10].look.colorVariation": 1824, "organs[10].look.translucency": 1828, "organs[10].look.gloss": 1832, "organs[10].look.dryness": 1836, "organs[10].look.shape": 1840, "organs[10].look.fold": 1844, "organs[10].look.firstOrgan": 1848, "organs[10].look.organKinds": 1852, "organs[10].count": 1856, "organs[10].place": 1864, "organs[10].pitch": 1872, "organs[10].size": 1880, "organs[10].width": 1888, "organs[10].azimuth": 1892, "organs[10].turn": 1896, "organs[10].bend": 1900, "organs[10].leg": 1904, "organs[10].variation": 1908, "organs[11].look.rootColor": 1920, "organs[11].look.tipThreshold": 1932, "organs[11].look.tipColor": 1936, "organs[11].look.groundTint": 1948, "organs[11].look.colorVariation": 1952, "organs[11].look.translucency": 1956, "organs[11].look.gloss": 1960, "organs[11].look.dryness": 1964, "organs[11].look.shape": 1968, "organs[11].look.fold": 1972, "organs[11].look.firstOrgan": 1976, "organs[11].look.organKinds": 1980, "organs[11].count": 1984, "organs[11].place": 1992, "organs[11].pitch": 2e3, "organs[11].size": 2008, "organs[11].width": 2016, "organs[11].azimuth": 2020, "organs[11].turn": 2024, "organs[11].bend": 2028, "organs[11].leg": 2032, "organs[11].variation": 2036, "organs[12].look.rootColor": 2048, "organs[12].look.tipThreshold": 2060, "organs[12].look.tipColor": 2064, "organs[12].look.groundTint": 2076, "organs[12].look.colorVariation": 2080, "organs[12].look.translucency": 2084, "organs[12].look.gloss": 2088, "organs[12].look.dryness": 2092, "organs[12].look.shape": 2096, "organs[12].look.fold": 2100, "organs[12].look.firstOrgan": 2104, "organs[12].look.organKinds": 2108, "organs[12].count": 2112, "organs[12].place": 2120, "organs[12].pitch": 2128, "organs[12].size": 2136, "organs[12].width": 2144, "organs[12].azimuth": 2148, "organs[12].turn": 2152, "organs[12].bend": 2156, "organs[12].leg": 2160, "organs[12].variation": 2164, "organs[13].look.rootColor": 2176, "organs[13].look.tipThreshold": 2188, "organs[13].look.tipColor": 2192, "organs[13].look.groundTint": 2204, "organs[13].look.colorVariation": 2208, "organs[13].look.translucency": 2212, "organs[13].look.gloss": 2216, "organs[13].look.dryness": 2220, "organs[13].look.shape": 2224, "organs[13].look.fold": 2228, "organs[13].look.firstOrgan": 2232, "organs[13].look.organKinds": 2236, "organs[13].count": 2240, "organs[13].place": 2248, "organs[13].pitch": 2256, "organs[13].size": 2264, "organs[13].width": 2272, "organs[13].azimuth": 2276, "organs[13].turn": 2280, "organs[13].bend": 2284, "organs[13].leg": 2288, "organs[13].variation": 2292, "organs[14].look.rootColor": 2304, "organs[14].look.tipThreshold": 2316, "organs[14].look.tipColor": 2320, "organs[14].look.groundTint": 2332, "organs[14].look.colorVariation": 2336, "organs[14].look.translucency": 2340, "organs[14].look.gloss": 2344, "organs[14].look.dryness": 2348, "organs[14].look.shape": 2352, "organs[14].look.fold": 2356, "organs[14].look.firstOrgan": 2360, "organs[14].look.organKinds": 2364, "organs[14].count": 2368, "organs[14].place": 2376, "organs[14].pitch": 2384, "organs[14].size": 2392, "organs[14].width": 2400, "organs[14].azimuth": 2404, "organs[14].turn": 2408, "organs[14].bend": 2412, "organs[14].leg": 2416, "organs[14].variation": 2420, "organs[15].look.rootColor": 2432, "organs[15].look.tipThreshold": 2444, "organs[15].look.tipColor": 2448, "organs[15].look.groundTint": 2460, "organs[15].look.colorVariation": 2464, "organs[15].look.translucency": 2468, "organs[15].look.gloss": 2472, "organs[15].look.dryness": 2476, "organs[15].look.shape": 2480, "organs[15].look.fold": 2484, "organs[15].look.firstOrgan": 2488, "organs[15].look.organKinds": 2492, "organs[15].count": 2496, "organs[15].place": 2504, "organs[15].pitch": 2512, "organs[15].size": 2520, "organs[15].width": 2528, "organs[15].azimuth": 2532, "organs[15].turn": 2536, "organs[15].bend": 2540, "organs[15].leg": 2544, "organs[15].variation": 2548, "organs[16].look.rootColor": 2560, "organs[16].look.tipThreshold": 2572, "organs[16].look.tipColor": 2576, "organs[16].look.groundTint": 2588, "organs[16].look.colorVariation": 2592, "organs[16].look.translucency": 2596, "organs[16].look.gloss": 2600, "organs[16].look.dryness": 2604, "organs[16].look.shape": 2608, "organs[16].look.fold": 2612, "organs[16].look.firstOrgan": 2616, "organs[16].look.organKinds": 2620, "organs[16].count": 2624, "organs[16].place": 2632, "organs[16].pitch": 2640, "organs[16].size": 2648, "organs[16].width": 2656, "organs[16].azimuth": 2660, "organs[16].turn": 2664, "organs[16].bend": 2668, "organs[16].leg": 2672, "organs[16].variation": 2676, "organs[17].look.rootColor": 2688, "organs[17].look.tipThreshold": 2700, "organs[17].look.tipColor": 2704, "organs[17].look.groundTint": 2716, "organs[17].look.colorVariation": 2720, "organs[17].look.translucency": 2724, "organs[17].look.gloss": 2728, "organs[17].look.dryness": 2732, "organs[17].look.shape": 2736, "organs[17].look.fold": 2740, "organs[17].look.firstOrgan": 2744, "organs[17].look.organKinds": 2748, "organs[17].count": 2752, "organs[17].place": 2760, "organs[17].pitch": 2768, "organs[17].size": 2776, "organs[17].width": 2784, "organs[17].azimuth": 2788, "organs[17].turn": 2792, "organs[17].bend": 2796, "organs[17].leg": 2800, "organs[17].variation": 2804, "organs[18].look.rootColor": 2816, "organs[18].look.tipThreshold": 2828, "organs[18].look.tipColor": 2832, "organs[18].look.groundTint": 2844, "organs[18].look.colorVariation": 2848, "organs[18].look.translucency": 2852, "organs[18].look.gloss": 2856, "organs[18].look.dryness": 2860, "organs[18].look.shape": 2864, "organs[18].look.fold": 2868, "organs[18].look.firstOrgan": 2872, "organs[18].look.organKinds": 2876, "organs[18].count": 2880, "organs[18].place": 2888, "organs[18].pitch": 2896, "organs[18].size": 2904, "organs[18].width": 2912, "organs[18].azimuth": 2916, "organs[18].turn": 2920, "organs[18].bend": 2924, "organs[18].leg": 2928, "organs[18].variation": 2932, "organs[19].look.rootColor": 2944, "organs[19].look.tipThreshold": 2956, "organs[19].look.tipColor": 2960, "organs[19].look.groundTint": 2972, "organs[19].look.colorVariation": 2976, "organs[19].look.translucency": 2980, "organs[19].look.gloss": 2984, "organs[19].look.dryness": 2988, "organs[19].look.shape": 2992, "organs[19].look.fold": 2996, "organs[19].look.firstOrgan": 3e3, "organs[19].look.organKinds": 3004, "organs[19].count": 3008, "organs[19].place": 3016, "organs[19].pitch": 3024, "organs[19].size": 3032, "organs[19].width": 3040, "organs[19].azimuth": 3044, "organs[19].turn": 3048, "organs[19].bend": 3052, "organs[19].leg": 3056, "organs[19].variation": 3060, "organs[20].look.rootColor": 3072, "organs[20].look.tipThreshold": 3084, "organs[20].look.tipColor": 3088, "organs[20].look.groundTint": 3100, "organs[20].look.colorVariation": 3104, "organs[20].look.translucency": 3108, "organs[20].look.gloss": 3112, "organs[20].look.dryness": 3116, "organs[20].look.shape": 3120, "organs[20].look.fold": 3124, "organs[20].look.firstOrgan": 3128, "organs[20].look.organKinds": 3132, "organs[20].count": 3136, "organs[20].place": 3144, "organs[20].pitch": 3152, "organs[20].size": 3160, "organs[20].width": 3168, "organs[20].azimuth": 3172, "organs[20].turn": 3176, "organs[20].bend": 3180, "organs[20].leg": 3184, "organs[20].variation": 3188, "organs[21].look.rootColor": 3200, "organs[21].look.tipThreshold": 3212, "organs[21].look.tipColor": 3216, "organs[21].look.groundTint": 3228, "organs[21].look.colorVariation": 3232, "organs[21].look.translucency": 3236, "organs[21].look.gloss": 3240, "organs[21].look.dryness": 3244, "organs[21].look.shape": 3248, "organs[21].look.fold": 3252, "organs[21].look.firstOrgan": 3256, "organs[21].look.organKinds": 3260, "organs[21].count": 3264, "organs[21].place": 3272, "organs[21].pitch": 3280, "organs[21].size": 3288, "organs[21].width": 3296, "organs[21].azimuth": 3300, "organs[21].turn": 3304, "organs[21].bend": 3308, "organs[21].leg": 3312, "organs[21].variation": 3316, "organs[22].look.rootColor": 3328, "organs[22].look.tipThreshold": 3340, "organs[22].look.tipColor": 3344, "organs[22].look.groundTint": 3356, "organs[22].look.colorVariation": 3360, "organs[22].look.translucency": 3364, "organs[22].look.gloss": 3368, "organs[22].look.dryness": 3372, "organs[22].look.shape": 3376, "organs[22].look.fold": 3380, "organs[22].look.firstOrgan": 3384, "organs[22].look.organKinds": 3388, "organs[22].count": 3392, "organs[22].place": 3400, "organs[22].pitch": 3408, "organs[22].size": 3416, "organs[22].width": 3424, "organs[22].azimuth": 3428, "organs[22].turn": 3432, "organs[22].bend": 3436, "organs[22].leg": 3440, "organs[22].variation": 3444, "organs[23].look.rootColor": 3456, "organs[23].look.tipThreshold": 3468, "organs[23].look.tipColor": 3472, "organs[23].look.groundTint": 3484, "organs[23].look.colorVariation": 3488, "organs[23].look.translucency": 3492, "organs[23].look.gloss": 3496, "organs[23].look.dryness": 3500, "organs[23].look.shape": 3504, "organs[23].look.fold": 3508, "organs[23].look.firstOrgan": 3512, "organs[23].look.organKinds": 3516, "organs[23].count": 3520, "organs[23].place": 3528, "organs[23].pitch": 3536, "organs[23].size": 3544, "organs[23].width": 3552, "organs[23].azimuth": 3556, "organs[23].turn": 3560, "organs[23].bend": 3564, "organs[23].leg": 3568, "organs[23].variation": 3572, "organs[24].look.rootColor": 3584, "organs[24].look.tipThreshold": 3596, "organs[24].look.tipColor": 3600, "organs[24].look.groundTint": 3612, "organs[24].look.colorVariation": 3616, "organs[24].look.translucency": 3620, "organs[24].look.gloss": 3624, "organs[24].look.dryness": 3628, "organs[24].look.shape": 3632, "organs[24].look.fold": 3636, "organs[24].look.firstOrgan": 3640, "organs[24].look.organKinds": 3644, "organs[24].count": 3648, "organs[24].place": 3656, "organs[24].pitch": 3664, "organs[24].size": 3672, "organs[24].width": 3680, "organs[24].azimuth": 3684, "organs[24].turn": 3688, "organs[24].bend": 3692, "organs[24].leg": 3696, "organs[24].variation": 3700, "organs[25].look.rootColor": 3712, "organs[25].look.tipThreshold": 3724, "organs[25].look.tipColor": 3728, "organs[25].look.groundTint": 3740, "organs[25].look.colorVariation": 3744, "organs[25].look.translucency": 3748, "organs[25].look.gloss": 3752, "organs[25].look.dryness": 3756, "organs[25].look.shape": 3760, "organs[25].look.fold": 3764, "organs[25].look.firstOrgan": 3768, "organs[25].look.organKinds": 3772, "organs[25].count": 3776, "organs[25].place": 3784, "organs[25].pitch": 3792, "organs[25].size": 3800, "organs[25].width": 3808, "organs[25].azimuth": 3812, "organs[25].turn": 3816, "organs[25].bend": 3820, "organs[25].leg": 3824, "organs[25].variation": 3828, "organs[26].look.rootColor": 3840, "organs[26].look.tipThreshold": 3852, "organs[26].look.tipColor": 3856, "organs[26].look.groundTint": 3868, "organs[26].look.colorVariation": 3872, "organs[26].look.translucency": 3876, "organs[26].look.gloss": 3880, "organs[26].look.dryness": 3884, "organs[26].look.shape": 3888, "organs[26].look.fold": 3892, "organs[26].look.firstOrgan": 3896, "organs[26].look.organKinds": 3900, "organs[26].count": 3904, "organs[26].place": 3912, "organs[26].pitch": 3920, "organs[26].size": 3928, "organs[26].width": 3936, "organs[26].azimuth": 3940, "organs[26].turn": 3944, "organs[26].bend": 3948, "organs[26].leg": 3952, "organs[26].variation": 3956, "organs[27].look.rootColor": 3968, "organs[27].look.tipThreshold": 3980, "organs[27].look.tipColor": 3984, "organs[27].look.groundTint": 3996, "organs[27].look.colorVariation": 4e3, "organs[27].look.translucency": 4004, "organs[27].look.gloss": 4008, "organs[27].look.dryness": 4012, "organs[27].look.shape": 4016, "organs[27].look.fold": 4020, "organs[27].look.firstOrgan": 4024, "organs[27].look.organKinds": 4028, "organs[27].count": 4032, "organs[27].place": 4040, "organs[27].pitch": 4048, "organs[27].size": 4056, "organs[27].width": 4064, "organs[27].azimuth": 4068, "organs[27].turn": 4072, "organs[27].bend": 4076, "organs[27].leg": 4080, "organs[27].variation": 4084, "organs[28].look.rootColor": 4096, "organs[28].look.tipThreshold": 4108, "organs[28].look.tipColor": 4112, "organs[28].look.groundTint": 4124, "organs[28].look.colorVariation": 4128, "organs[28].look.translucency": 4132, "organs[28].look.gloss": 4136, "organs[28].look.dryness": 4140, "organs[28].look.shape": 4144, "organs[28].look.fold": 4148, "organs[28].look.firstOrgan": 4152, "organs[28].look.organKinds": 4156, "organs[28].count": 4160, "organs[28].place": 4168, "organs[28].pitch": 4176, "organs[28].size": 4184, "organs[28].width": 4192, "organs[28].azimuth": 4196, "organs[28].turn": 4200, "organs[28].bend": 4204, "organs[28].leg": 4208, "organs[28].variation": 4212, "organs[29].look.rootColor": 4224, "organs[29].look.tipThreshold": 4236, "organs[29].look.tipColor": 4240, "organs[29].look.groundTint": 4252, "organs[29].look.colorVariation": 4256, "organs[29].look.translucency": 4260, "organs[29].look.gloss": 4264, "organs[29].look.dryness": 4268, "organs[29].look.shape": 4272, "organs[29].look.fold": 4276, "organs[29].look.firstOrgan": 4280, "organs[29].look.organKinds": 4284, "organs[29].count": 4288, "organs[29].place": 4296, "organs[29].pitch": 4304, "organs[29].size": 4312, "organs[29].width": 4320, "organs[29].azimuth": 4324, "organs[29].turn": 4328, "organs[29].bend": 4332, "organs[29].leg": 4336, "organs[29].variation": 4340, "organs[30].look.rootColor": 4352, "organs[30].look.tipThreshold": 4364, "organs[30].look.tipColor": 4368, "organs[30].look.groundTint": 4380, "organs[30].look.colorVariation": 4384, "organs[30].look.translucency": 4388, "organs[30].look.gloss": 4392, "organs[30].look.dryness": 4396, "organs[30].look.shape": 4400, "organs[30].look.fold": 4404, "organs[30].look.firstOrgan": 4408, "organs[30].look.organKinds": 4412, "organs[30].count": 4416, "organs[30].place": 4424, "organs[30].pitch": 4432, "organs[30].size": 4440, "organs[30].width": 4448, "organs[30].azimuth": 4452, "organs[30].turn": 4456, "organs[30].bend": 4460, "organs[30].leg": 4464, "organs[30].variation": 4468, "organs[31].look.rootColor": 4480, "organs[31].look.tipThreshold": 4492, "organs[31].look.tipColor": 4496, "organs[31].look.groundTint": 4508, "organs[31].look.colorVariation": 4512, "organs[31].look.translucency": 4516, "organs[31].look.gloss": 4520, "organs[31].look.dryness": 4524, "organs[31].look.shape": 4528, "organs[31].look.fold": 4532, "organs[31].look.firstOrgan": 4536, "organs[31].look.organKinds": 4540, "organs[31].count": 4544, "organs[31].place": 4552, "organs[31].pitch": 4560, "organs[31].size": 4568, "organs[31].width": 4576, "organs[31].azimuth": 4580, "organs[31].turn": 4584, "organs[31].bend": 4588, "organs[31].leg": 4592, "organs[31].variation": 4596 };

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
  `#ifndef SWARD_WEB_BLADES_GLSL
#define SWARD_WEB_BLADES_GLSL
`,
  // web/shaders/frame.glsl
  `#ifndef SWARD_WEB_FRAME_GLSL
#define SWARD_WEB_FRAME_GLSL
`,
  // shaders/shared/frame.h
  `#ifndef SWARD_SHARED_FRAME_H
#define SWARD_SHARED_FRAME_H
`,
  // shaders/shared/blade.h
  `#ifndef SWARD_SHARED_BLADE_H
#define SWARD_SHARED_BLADE_H
`,
  // shaders/shared/noise.h
  `#ifndef SWARD_SHARED_NOISE_H
#define SWARD_SHARED_NOISE_H
`,
  // shaders/shared/noise.h
  `uint mixUint(uint x)
{
x^=x >> 16u;
x*=0x7feb352du;
x^=x >> 15u;
x*=0x846ca68bu;
x^=x >> 16u;
return x;
}
const uint latticeX=0x9e3779b1u;
const uint latticeY=0x85ebca77u;
const uint latticeZ=0xc2b2ae3du;
uint latticePoint(int x,int y,int z)
{
return uint(x)*latticeX+uint(y)*latticeY+uint(z)*latticeZ;
}
float latticeHeight(uint point)
{
point^=point >> 11u;
point*=0x31848babu;
return float(point);
}
const float latticeUnit=1.0f/4294967296.0f;
float latticeValue(int x,int y,int z)
{
return latticeUnit*latticeHeight(latticePoint(x,y,z));
}
float valueNoiseFrom(uint origin,vec3 p)
{
vec3 cell=floor(p);
vec3 f=p - cell;
vec3 s=f*f*(vec3(3.0f) - 2.0f*f);
uint near=origin+latticePoint(int(cell.x),int(cell.y),int(cell.z));
uint far=near+latticeZ;
float nearHeight=mix(
mix(latticeHeight(near),latticeHeight(near+latticeX),s.x),
mix(latticeHeight(near+latticeY),latticeHeight(near+latticeX+latticeY),s.x),s.y);
float farHeight =
mix(mix(latticeHeight(far),latticeHeight(far+latticeX),s.x),
mix(latticeHeight(far+latticeY),latticeHeight(far+latticeX+latticeY),s.x),s.y);
return latticeUnit*mix(nearHeight,farHeight,s.z);
}
float valueNoise(vec3 p)
{
return valueNoiseFrom(0u,p);
}
vec4 valueNoiseSlope(vec3 p)
{
vec3 cell=floor(p);
vec3 f=p - cell;
vec3 s=f*f*(vec3(3.0f) - 2.0f*f);
vec3 slope=6.0f*f*(vec3(1.0f) - f);
uint near=latticePoint(int(cell.x),int(cell.y),int(cell.z));
uint far=near+latticeZ;
float h000=latticeHeight(near);
float h010=latticeHeight(near+latticeY);
float h001=latticeHeight(far);
float h011=latticeHeight(far+latticeY);
float d00=latticeHeight(near+latticeX) - h000;
float d10=latticeHeight(near+latticeX+latticeY) - h010;
float d01=latticeHeight(far+latticeX) - h001;
float d11=latticeHeight(far+latticeX+latticeY) - h011;
float h00=h000+s.x*d00;
float h10=h010+s.x*d10;
float h01=h001+s.x*d01;
float h11=h011+s.x*d11;
float h0=mix(h00,h10,s.y);
float h1=mix(h01,h11,s.y);
return latticeUnit*vec4(slope.x*mix(mix(d00,d10,s.y),mix(d01,d11,s.y),s.z),
slope.y*mix(h10 - h00,h11 - h01,s.z),slope.z*(h1 - h0),
mix(h0,h1,s.z));
}
#endif
`,
  // shaders/shared/octahedral.h
  `#ifndef SWARD_SHARED_OCTAHEDRAL_H
#define SWARD_SHARED_OCTAHEDRAL_H
`,
  // shaders/shared/octahedral.h
  `const float octahedralMaxError=0.0112f;
float signNotZero(float x)
{
return x>=0.0f?1.0f:-1.0f;
}
vec2 unfolded(vec3 v)
{
float scale=1.0f/(abs(v.x)+abs(v.y)+abs(v.z));
float x=v.x*scale;
float y=v.y*scale;
return v.z<0.0f?vec2((1.0f - abs(y))*signNotZero(x),(1.0f - abs(x))*signNotZero(y))
: vec2(x,y);
}
vec3 folded(float x,float y)
{
float z=1.0f - abs(x) - abs(y);
vec3 v =
z>=0.0f?vec3(x,y,z)
: vec3((1.0f - abs(y))*signNotZero(x),(1.0f - abs(x))*signNotZero(y),z);
return normalize(v);
}
vec3 decodeOctahedral(uint bits)
{
return folded(float(int(bits & 255u) - 127)*(1.0f/127.0f),
float(int((bits >> 8u) & 255u) - 127)*(1.0f/127.0f));
}
uint encodeOctahedral(vec3 v)
{
vec2 place=unfolded(v);
float x0=floor(clamp(place.x,-1.0f,1.0f)*127.0f)+127.0f;
float y0=floor(clamp(place.y,-1.0f,1.0f)*127.0f)+127.0f;
uint best=0u;
float bestCosine=-2.0f;
for (uint corner=0u; corner<4u; ++corner) {
uint xi=uint(min(x0+float(corner & 1u),254.0f));
uint yi=uint(min(y0+float(corner >> 1u),254.0f));
uint candidate=xi | (yi << 8u);
float cosine=dot(decodeOctahedral(candidate),v);
if (cosine>bestCosine) {
bestCosine=cosine;
best=candidate;
}
}
return best;
}
uint packSnorm16(float x)
{
return uint(int(floor(clamp(x,-1.0f,1.0f)*32767.0f+0.5f))) & 65535u;
}
float unpackSnorm16(uint bits)
{
return float((int(bits & 65535u) ^ 32768) - 32768)*(1.0f/32767.0f);
}
const float wideOctahedralMaxError=7e-5f;
uint encodeWideOctahedral(vec3 v)
{
vec2 place=unfolded(v);
return packSnorm16(place.x) | (packSnorm16(place.y) << 16u);
}
vec3 decodeWideOctahedral(uint bits)
{
return folded(unpackSnorm16(bits),unpackSnorm16(bits >> 16u));
}
vec3 tangentOf(vec3 n)
{
float s=signNotZero(n.z);
float a=-1.0f/(s+n.z);
return vec3(1.0f+s*n.x*n.x*a,s*n.x*n.y*a,-s*n.x);
}
vec3 bitangentOf(vec3 n)
{
float s=signNotZero(n.z);
float a=-1.0f/(s+n.z);
return vec3(n.x*n.y*a,s+n.y*n.y*a,-n.y);
}
#endif
`,
  // shaders/shared/patch.h
  `#ifndef SWARD_SHARED_PATCH_H
#define SWARD_SHARED_PATCH_H
`,
  // shaders/shared/patch.h
  `const uint maxPatchBlades=512u;
const uint noPatch=0xffffffffu;
struct Patch {
vec3 boundsLow;
uint firstBlade;
vec3 boundsHigh;
uint bladeCount;
vec3 rootLow;
float rootStep;
vec3 coneAxis;
float coneCosine;
float heightLow;
float heightStep;
float widthLow;
float widthStep;
uint parent;
uint firstChild;
uint childCount;
uint level;
float rankLow;
float rankHigh;
};
struct PatchArray { uint none; };
Patch fetchPatchArray(uint i);
#endif
`,
  // shaders/shared/blade.h
  `const float twoPi=6.28318530717958647692f;
struct PackedBlade {
uint rootXY;
uint rootZUp;
uint shape;
uint look;
};
struct BladeArray { uint none; };
PackedBlade fetchBladeArray(uint i);
struct Blade {
vec3 root;
float facing;
vec3 up;
float stiffness;
float height;
float width;
float exposure;
uint species;
vec3 tint;
uint clump;
uint hash;
uint seed;
};
const uint driedClump=255u;
const float facingMaxError=0.01228f;
const float stiffnessMaxError=0.00794f;
const float exposureMaxError=0.01613f;
const float tintMaxError=0.01613f;
uint quantise(float x,float low,float step,uint largest)
{
if (step<=0.0f)
return 0u;
return uint(clamp(floor((x - low)/step+0.5f),0.0f,float(largest)));
}
uint seedOf(PackedBlade bits)
{
uint kept=(bits.shape & 0xffc000ffu) ^ ((bits.rootZUp >> 16u) << 8u);
return mixUint(kept+bits.look*0x9e3779b9u) >> 16u;
}
PackedBlade packBladeWith(Blade blade,Patch cell,uint up)
{
uint x=quantise(blade.root.x,cell.rootLow.x,cell.rootStep,65535u);
uint y=quantise(blade.root.y,cell.rootLow.y,cell.rootStep,65535u);
uint z=quantise(blade.root.z,cell.rootLow.z,cell.rootStep,65535u);
uint facing=uint(int(floor(blade.facing*(256.0f/twoPi)+0.5f))) & 255u;
uint height=quantise(blade.height,cell.heightLow,cell.heightStep,255u);
uint width=quantise(blade.width,cell.widthLow,cell.widthStep,63u);
uint stiffness=quantise(blade.stiffness,0.0f,1.0f/63.0f,63u);
uint exposure=quantise(blade.exposure,0.0f,1.0f/31.0f,31u);
uint red=quantise(blade.tint.x,0.0f,1.0f/31.0f,31u);
uint green=quantise(blade.tint.y,0.0f,1.0f/63.0f,63u);
uint blue=quantise(blade.tint.z,0.0f,1.0f/31.0f,31u);
PackedBlade bits;
bits.rootXY=x | (y << 16u);
bits.rootZUp=z | (up << 16u);
bits.shape =
facing | (height << 8u) | (width << 16u) | (stiffness << 22u) | ((blade.hash & 15u) << 28u);
bits.look=red | (green << 5u) | (blue << 11u) | (exposure << 16u) |
((blade.species & 7u) << 21u) | ((blade.clump & 255u) << 24u);
return bits;
}
PackedBlade packBlade(Blade blade,Patch cell)
{
return packBladeWith(blade,cell,encodeOctahedral(blade.up));
}
Blade unpackBlade(PackedBlade bits,Patch cell)
{
Blade blade;
blade.root =
cell.rootLow+cell.rootStep*vec3(float(bits.rootXY & 65535u),float(bits.rootXY >> 16u),
float(bits.rootZUp & 65535u));
blade.up=decodeOctahedral(bits.rootZUp >> 16u);
blade.facing=float(bits.shape & 255u)*(twoPi/256.0f);
blade.height=cell.heightLow+cell.heightStep*float((bits.shape >> 8u) & 255u);
blade.width=cell.widthLow+cell.widthStep*float((bits.shape >> 16u) & 63u);
blade.stiffness=float((bits.shape >> 22u) & 63u)*(1.0f/63.0f);
blade.hash=bits.shape >> 28u;
blade.tint=vec3(float(bits.look & 31u)*(1.0f/31.0f),
float((bits.look >> 5u) & 63u)*(1.0f/63.0f),
float((bits.look >> 11u) & 31u)*(1.0f/31.0f));
blade.exposure=float((bits.look >> 16u) & 31u)*(1.0f/31.0f);
blade.species=(bits.look >> 21u) & 7u;
blade.clump=bits.look >> 24u;
blade.seed=seedOf(bits);
return blade;
}
vec3 widthAxis(vec3 up,float facing)
{
return tangentOf(up)*cos(facing)+bitangentOf(up)*sin(facing);
}
vec3 frontOf(vec3 up,vec3 axis)
{
return cross(up,axis);
}
struct BladeAxes {
vec3 front;
vec3 side;
vec3 up;
};
BladeAxes axesAlong(vec3 up,vec3 axis)
{
BladeAxes axes;
axes.front=frontOf(up,axis);
axes.side=-axis;
axes.up=up;
return axes;
}
BladeAxes axesTowards(vec3 up,vec3 front)
{
BladeAxes axes;
axes.front=front;
axes.side=cross(up,front);
axes.up=up;
return axes;
}
vec3 alongAxes(BladeAxes axes,vec3 v)
{
return vec3(dot(v,axes.front),dot(v,axes.side),dot(v,axes.up));
}
vec3 inSpace(BladeAxes axes,vec3 v)
{
return v.x*axes.front+v.y*axes.side+v.z*axes.up;
}
#endif
`,
  // shaders/shared/look/blade_shadow.h
  `#ifndef SWARD_SHARED_LOOK_BLADE_SHADOW_H
#define SWARD_SHARED_LOOK_BLADE_SHADOW_H
`,
  // shaders/shared/look/blade_shadow.h
  `const uint bladeShadowTexels=1024u;
const float bladeShadowFade=0.75f;
struct BladeShadowTable { uint none; };
uvec2 fetchBladeShadowTable(uint i);
bool isShaded(uvec2 texel,float depth,uint seed)
{
return texel.x!=seed&&uintBitsToFloat(texel.y)>depth;
}
struct BladeShadow {
vec4 across;
vec4 down;
vec4 depth;
uint size;
float nearer;
};
const uint noBladeSeed=0xffffffffu;
vec2 sunAmongBlades(BladeShadow shadow,vec3 place,uint seed)
{
if (shadow.size==0u)
return vec2(1.0f,0.0f);
vec4 at4=vec4(place,1.0f);
vec2 at=vec2(dot(shadow.across,at4),dot(shadow.down,at4)) - 0.5f;
float depth=max(dot(shadow.depth,at4)+shadow.nearer,0.0f);
float edge=0.5f*float(shadow.size);
vec2 off=abs(at+0.5f - edge)/edge;
float weight=1.0f - smoothstep(bladeShadowFade,1.0f,max(off.x,off.y));
if (weight<=0.0f)
return vec2(1.0f,0.0f);
vec2 corner=floor(at);
vec2 f=at - corner;
uint last=shadow.size - 2u;
uint column=min(uint(max(corner.x,0.0f)),last);
uint row=min(uint(max(corner.y,0.0f)),last);
uint first=column*shadow.size+row;
float lit00=isShaded(fetchBladeShadowTable(uint(first)),depth,seed)?0.0f:1.0f;
float lit01=isShaded(fetchBladeShadowTable(uint(first+1u)),depth,seed)?0.0f:1.0f;
float lit10=isShaded(fetchBladeShadowTable(uint(first+shadow.size)),depth,seed)?0.0f:1.0f;
float lit11=isShaded(fetchBladeShadowTable(uint(first+shadow.size+1u)),depth,seed)?0.0f:1.0f;
return vec2(mix(mix(lit00,lit01,f.y),mix(lit10,lit11,f.y),f.x),weight);
}
#endif
`,
  // shaders/shared/cover.h
  `#ifndef SWARD_SHARED_COVER_H
#define SWARD_SHARED_COVER_H
`,
  // shaders/shared/cover.h
  `struct CoverTable { uint none; };
uint fetchCoverTable(uint i);
const uint heightSteps=16u;
struct Cover {
vec3 low;
float cellsPerMetre;
uint countX;
uint countY;
uint countZ;
float farthest;
vec3 undergrowth;
float thatch;
vec3 sward;
float thinned;
float structure;
float stepsPerMetre;
uint leaves[heightSteps/2u];
};
const uint toneBits=0x80038000u;
uint packGrass(float leafArea,float height,float tone)
{
uint halves=packHalf2x16(vec2(leafArea,leafArea*height))+0x20000u;
uint step=uint(clamp(tone,0.0f,1.0f)*15.0f+0.5f);
return (halves & ~toneBits) | ((step & 3u) << 16u) | ((step & 4u) << 13u) |
((step & 8u) << 28u);
}
vec3 unpackGrass(uint corner)
{
vec2 grass=unpackHalf2x16(corner & ~toneBits);
uint step=((corner >> 16u) & 3u) | ((corner >> 13u) & 4u) | ((corner >> 28u) & 8u);
return vec3(grass.x,grass.y,grass.x*float(step)*(1.0f/15.0f));
}
vec3 mixGrass(uint a,uint b,float share)
{
return mix(unpackGrass(a),unpackGrass(b),share);
}
vec3 grassAt(Cover cover,vec3 position)
{
if (cover.countX==0u)
return vec3(0.0f);
vec3 last=vec3(float(cover.countX),float(cover.countY),float(cover.countZ)) - 1.0f;
vec3 place=clamp((position - cover.low)*cover.cellsPerMetre,vec3(0.0f),last);
vec3 cell=min(floor(place),last - 1.0f);
vec3 f=place - cell;
uint stepY=cover.countX;
uint stepZ=cover.countX*cover.countY;
uint i=uint(cell.x)+stepY*uint(cell.y)+stepZ*uint(cell.z);
uint j=i+stepZ;
vec3 near =
mix(mixGrass(fetchCoverTable(uint(i)),fetchCoverTable(uint(i+1u)),f.x),
mixGrass(fetchCoverTable(uint(i+stepY)),fetchCoverTable(uint(i+stepY+1u)),f.x),f.y);
vec3 far =
mix(mixGrass(fetchCoverTable(uint(j)),fetchCoverTable(uint(j+1u)),f.x),
mixGrass(fetchCoverTable(uint(j+stepY)),fetchCoverTable(uint(j+stepY+1u)),f.x),f.y);
return mix(near,far,f.z);
}
float leafAreaAt(Cover cover,vec3 position)
{
return grassAt(cover,position).x;
}
float toneOf(vec3 grass)
{
return grass.x>0.0f?grass.z/grass.x:0.5f;
}
float heightStepsPerMetre(Cover cover,vec3 grass)
{
return cover.stepsPerMetre*(grass.y>0.0f?grass.x/grass.y:1.0f);
}
float leafShareAbove(Cover cover,float steps)
{
float at=clamp(steps,0.0f,float(heightSteps));
uint step=min(uint(at),heightSteps - 1u);
vec2 pair=unpackHalf2x16(cover.leaves[step/2u]);
float low=step==0u?1.0f:pair.x;
float next=pair.y;
if ((step & 1u)!=0u) {
low=pair.y;
next=step+1u<heightSteps?unpackHalf2x16(cover.leaves[step/2u+1u]).x:0.0f;
}
float root=mix(low,next,at - float(step));
return root*root;
}
float leafProjectionOf(Cover cover)
{
return unpackHalf2x16(cover.leaves[0]).x;
}
float undergrowthBelow(float leafArea)
{
return 1.0f - exp(-0.65f*leafArea);
}
vec3 groundUnder(Cover cover,vec3 bare,vec3 shade,float leafArea)
{
return mix(bare,shade*cover.undergrowth,cover.thatch*undergrowthBelow(leafArea));
}
float swardShare(Cover cover,float leafArea,float thinned)
{
return cover.thatch*(undergrowthBelow(leafArea) - undergrowthBelow(leafArea/thinned));
}
float swardBrightness(float cosine)
{
return 0.6f - 0.1f*cosine;
}
float leavesAround(float leafArea,float thinned)
{
return leafArea*max(pow(thinned,-0.22f),0.6f);
}
float heightWithLeafShare(float share)
{
return pow(clamp(share,0.0f,1.0f),2.0f/3.0f);
}
const float leafExtinction=0.46f;
const float lowestSun=0.1f;
float leafProjectionAlong(float upwards,float cosine)
{
float beside=0.637f*sqrt(max(1.0f - 1.9f*upwards*upwards,0.0f));
float sine=sqrt(max(1.0f - cosine*cosine,0.0f));
return length(vec2(upwards*cosine,beside*sine));
}
const float skyExtinction=1.2f;
float sunBelow(float upwards,float leafArea,float cosine)
{
float risen=max(cosine,lowestSun);
return exp(-leafProjectionAlong(upwards,risen)*(leafArea/risen));
}
float skyBelow(float leafArea)
{
return exp(-skyExtinction*leafArea);
}
#endif
`,
  // shaders/shared/culling.h
  `#ifndef SWARD_SHARED_CULLING_H
#define SWARD_SHARED_CULLING_H
`,
  // shaders/shared/culling.h
  `const uint cullResultDrawn=0u;
const uint cullResultPatch=1u;
const uint cullResultOrientation=2u;
const uint cullResultFrustum=3u;
const uint cullResultDistance=4u;
const uint cullResultOcclusion=5u;
const uint cullResultLod=6u;
const uint cullResultCount=7u;
const uint cullPatch=1u;
const uint cullOrientation=2u;
const uint cullFrustum=4u;
const uint cullDistance=8u;
const uint cullOcclusion=16u;
const uint leaveThinned=32u;
const float paperEdgeOnCosine=0.9f;
float planeDistance(vec4 plane,vec3 point)
{
return dot(vec3(plane.x,plane.y,plane.z),point)+plane.w;
}
bool curveOutside(vec4 plane,vec3 v0,vec3 v1,vec3 v2,float margin)
{
return max(max(planeDistance(plane,v0),planeDistance(plane,v1)),planeDistance(plane,v2)) <
-margin;
}
bool curveInside(vec4 plane,vec3 v0,vec3 v1,vec3 v2,float margin)
{
return min(min(planeDistance(plane,v0),planeDistance(plane,v1)),planeDistance(plane,v2)) >
margin;
}
bool boxOutside(vec4 plane,vec3 low,vec3 high)
{
vec3 farthest=vec3(plane.x>=0.0f?high.x:low.x,plane.y>=0.0f?high.y:low.y,
plane.z>=0.0f?high.z:low.z);
return planeDistance(plane,farthest)<0.0f;
}
float edgeOnCosine(vec3 eye,vec3 root,vec3 axis)
{
vec3 ray=root - eye;
return min(abs(dot(ray,axis))/max(length(ray),1e-6f),1.0f);
}
float boxDistance(vec3 eye,vec3 low,vec3 high)
{
return length(max(max(low - eye,eye - high),vec3(0.0f)));
}
bool bucketsKeep(float buckets,float last,float distance,float rank)
{
return buckets<=0.0f||rank*buckets<floor(buckets*(1.0f - distance/last));
}
const float lodFade=0.1f;
const float lodFullShare=1.0f/0.9f;
float lodShare(float pixels,float threshold)
{
return clamp(pixels/threshold,1.0f/256.0f,lodFullShare);
}
float lodWidthFactor(float rank,float share)
{
if (share>=lodFullShare)
return 1.0f;
float fade=lodFade*share;
float weight=clamp((share - rank)/fade,0.0f,1.0f);
float beyond=max(share - 1.0f,0.0f);
float mean=share - 0.5f*fade - 0.5f*beyond*beyond/fade;
return weight/mean;
}
const float flattestRay=1.0f/96.0f;
const float maxLeafArea=64.0f;
float leafAreaShare(float most,float leafArea,float cosine,float pixels)
{
float wide=max(pixels*pixels,1.0f);
return clamp(most*wide*wide*max(cosine,flattestRay) /
(leafExtinction*max(leafArea,1e-6f)),
1.0f/256.0f,lodFullShare);
}
float leafAreaWeight(float rank,float share)
{
if (share>=lodFullShare)
return 1.0f;
return clamp((share - rank)/(lodFade*share),0.0f,1.0f);
}
const float maxHeightCompensation=1.3f;
float heightCompensation(float share,float one,float spread)
{
if (share>=1.0f)
return 1.0f;
float full=min(one,1.0f);
float sunk=pow(full/share,1.0f/3.0f) - pow(full,1.0f/3.0f);
float rise=clamp(1.0f+(0.4f+0.2f*spread)*sunk,1.0f,maxHeightCompensation);
return floor(rise*1024.0f+0.5f)/1024.0f;
}
float leafAreaLight(float share,float spread)
{
return share>=1.0f?1.0f:pow(share,1.0f/(1.0f+0.8f*spread));
}
#endif
`,
  // shaders/shared/environment.h
  `#ifndef SWARD_SHARED_ENVIRONMENT_H
#define SWARD_SHARED_ENVIRONMENT_H
`,
  // shaders/shared/collision.h
  `#ifndef SWARD_SHARED_COLLISION_H
#define SWARD_SHARED_COLLISION_H
`,
  // shaders/shared/collision.h
  `struct Collider {
vec3 from;
float radius;
vec3 to;
uint reserved;
vec3 velocity;
uint reserved2;
};
struct ColliderTable { uint none; };
Collider fetchColliderTable(uint i);
const uint maxColliders=256u;
const uint colliderWords=8u;
struct ColliderMask {
uint words[colliderWords];
};
ColliderMask noColliders()
{
ColliderMask mask;
for (uint i=0u; i<colliderWords; ++i)
mask.words[i]=0u;
return mask;
}
bool colliderNear(Collider collider,vec3 low,vec3 high,float elapsed)
{
vec3 way=collider.velocity*elapsed;
vec3 first=min(min(collider.from,collider.to),min(collider.from,collider.to) - way);
vec3 last=max(max(collider.from,collider.to),max(collider.from,collider.to) - way);
return all(lessThanEqual(first - collider.radius,high)) &&
all(lessThanEqual(low,last+collider.radius));
}
Collider colliderSeenFrom(Collider collider,vec3 root,float height,float back)
{
vec3 shift=collider.velocity*back+root;
Collider seen=collider;
seen.from=(collider.from - shift)/height;
seen.to=(collider.to - shift)/height;
seen.radius=collider.radius/height;
return seen;
}
vec3 towardsSegment(Collider collider,vec3 point)
{
vec3 along=collider.to - collider.from;
vec3 to=collider.from - point;
float size=dot(along,along);
float t=size>0.0f?clamp(-dot(to,along)/size,0.0f,1.0f):0.0f;
return to+t*along;
}
vec3 pushOut(Collider collider,vec3 point,vec3 otherwise)
{
vec3 towards=towardsSegment(collider,point);
float distance=length(towards);
float depth=max(collider.radius - distance,0.0f);
return depth*(distance>1e-6f?-towards/distance:otherwise);
}
#endif
`,
  // shaders/shared/environment.h
  `const uint windNoise=0u;
const uint windTurning=1u;
const uint windWave=2u;
const uint windRadial=3u;
const uint windSwirl=4u;
const uint windGusts=5u;
const uint windKinds=6u;
const uint windsAlike=1u << 24u;
const uint maxWindSources=8u;
struct WindSource {
vec3 direction;
float strength;
vec3 centre;
float size;
float speed;
float rate;
float turn;
float alignment;
float lift;
uint kind;
vec3 side;
float perSize;
};
struct WindPhase {
vec3 shift;
uint cell;
vec3 fineShift;
uint fineCell;
float angle;
float turned;
};
struct WindLattice {
vec3 origin;
vec3 x;
vec3 y;
vec3 z;
};
struct Wind {
uint counts;
float eddySize;
float eddySpeed;
float sum;
vec3 eddyPhase;
WindLattice lattice;
WindSource sources[maxWindSources];
WindPhase phases[maxWindSources];
};
struct Gravity {
vec3 direction;
float strength;
vec3 attractor;
float blend;
float forward;
};
const float forwardShare=0.25f;
struct Environment {
Gravity gravity;
float recovery;
uint colliderCount;
Wind wind;
};
#endif
`,
  // shaders/shared/eyepoint.h
  `#ifndef SWARD_SHARED_EYEPOINT_H
#define SWARD_SHARED_EYEPOINT_H
`,
  // shaders/shared/eyepoint.h
  `struct Eyepoint {
vec4 planes[6];
vec3 eye;
float drawDistance;
float pixelsPerUnit;
float lodThreshold;
float lodWidth;
float minWidth;
float maxLeafArea;
float maxEdgeOn;
uint samples;
float buckets;
float bucketDistance;
uint cullMask;
float
areaFactor;
float sparseFrom;
float sparseLeast;
};
#endif
`,
  // shaders/shared/host_light.h
  `struct HostLightArray { uint none; };
uint fetchHostLightArray(uint i);
`,
  // shaders/shared/look/floor_plane.h
  `#ifndef SWARD_SHARED_LOOK_FLOOR_PLANE_H
#define SWARD_SHARED_LOOK_FLOOR_PLANE_H
`,
  // shaders/shared/look/floor_plane.h
  `struct FloorPlane {
vec3 middle;
float reach;
vec3 along;
float height;
vec2 halfSides;
float cornerRadius;
};
float distanceFromFootprint(FloorPlane plane,vec3 place,vec3 across)
{
vec3 way=place - plane.middle;
vec2 at=abs(vec2(dot(way,plane.along),dot(way,across)));
vec2 beyond=max(at - (plane.halfSides - plane.cornerRadius),vec2(0.0f));
return max(length(beyond) - plane.cornerRadius,0.0f);
}
float skyBesideWall(float height,float distance)
{
float slant=sqrt(height*height+distance*distance);
return slant>0.0f?0.5f+0.5f*distance/slant:1.0f;
}
#endif
`,
  // shaders/shared/occlusion.h
  `struct DepthPyramid { uint none; };
uint fetchDepthPyramid(uint i);
`,
  // shaders/shared/organ.h
  `#ifndef SWARD_SHARED_ORGAN_H
#define SWARD_SHARED_ORGAN_H
`,
  // shaders/shared/bezier.h
  `#ifndef SWARD_SHARED_BEZIER_H
#define SWARD_SHARED_BEZIER_H
`,
  // shaders/shared/bezier.h
  `vec3 bezierPoint(vec3 v0,vec3 v1,vec3 v2,float t)
{
vec3 a=v0+t*(v1 - v0);
vec3 b=v1+t*(v2 - v1);
return a+t*(b - a);
}
vec3 bezierTangent(vec3 v0,vec3 v1,vec3 v2,float t)
{
return 2.0f*((1.0f - t)*(v1 - v0)+t*(v2 - v1));
}
#endif
`,
  // shaders/shared/pose.h
  `#ifndef SWARD_SHARED_POSE_H
#define SWARD_SHARED_POSE_H
`,
  // shaders/shared/pose.h
  `struct BladeState {
uint turn;
float eta;
};
const uint unsettledTurn=0x80008000u;
struct Pose {
vec3 v1;
vec3 v2;
};
const float turnMaxError=1.54e-5f;
vec2 turnTowards(vec3 direction)
{
return (1.0f/(1.0f+max(direction.z,0.0f)))*vec2(direction.x,direction.y);
}
vec3 directionOfTurn(vec2 turn)
{
float square=min(dot(turn,turn),1.0f);
return (1.0f/(1.0f+square))*vec3(2.0f*turn.x,2.0f*turn.y,1.0f - square);
}
BladeState stateOfTurn(vec2 turn,float eta)
{
BladeState state;
state.turn=packSnorm16(turn.x) | (packSnorm16(turn.y) << 16u);
state.eta=eta;
return state;
}
BladeState stateOf(vec3 up,vec3 front,vec3 direction,float eta)
{
return stateOfTurn(turnTowards(alongAxes(axesTowards(up,front),direction)),eta);
}
vec2 storedTurn(BladeState state)
{
return vec2(unpackSnorm16(state.turn),unpackSnorm16(state.turn >> 16u));
}
vec3 storedDirection(BladeState state)
{
return directionOfTurn(storedTurn(state));
}
vec3 directionOf(vec3 up,vec3 front,BladeState state)
{
return inSpace(axesTowards(up,front),storedDirection(state));
}
float lengthCorrection(float side)
{
if (side>0.95f)
return (-0.48620368f*side+0.92399928f)*side+0.55642926f;
float high=(-1.3481541f*side+4.0007265f)*side - 4.6675167f;
float low=(high*side+2.7635532f)*side - 0.71043977f;
return (low*side - 0.037761414f)*side+1.0f;
}
float tipDistance(vec3 direction)
{
return lengthCorrection(length(vec2(direction.x,direction.y)));
}
Pose poseTowards(vec3 up,vec3 direction)
{
float side=length(direction - up*dot(direction,up));
vec3 v1=up*max(1.0f - side,0.05f);
float scale=lengthCorrection(side);
Pose pose;
pose.v1=v1*scale;
pose.v2=direction*scale;
return pose;
}
vec3 keptAbove(vec3 up,vec3 front,vec3 direction)
{
float rise=dot(up,direction);
if (rise>=0.0f)
return direction;
vec3 lifted=direction - up*rise;
float distance=length(lifted);
vec3 towards=distance>1e-4f?lifted/distance:front;
return towards - up*min(dot(up,towards),0.0f);
}
Pose poseBlade(vec3 up,vec3 front,vec3 tip)
{
vec3 lifted=tip - up*min(dot(up,tip),0.0f);
float distance=length(lifted);
return poseTowards(up,keptAbove(up,front,distance>1e-4f?lifted/distance:front));
}
Pose poseOfState(BladeAxes axes,BladeState state)
{
vec3 direction=storedDirection(state);
float side=length(vec2(direction.x,direction.y));
float scale=lengthCorrection(side);
Pose pose;
pose.v1=axes.up*(max(1.0f - side,0.05f)*scale);
pose.v2=inSpace(axes,direction*scale);
return pose;
}
#endif
`,
  // shaders/shared/species.h
  `#ifndef SWARD_SHARED_SPECIES_H
#define SWARD_SHARED_SPECIES_H
`,
  // shaders/shared/shape.h
  `#ifndef SWARD_SHARED_SHAPE_H
#define SWARD_SHARED_SHAPE_H
`,
  // shaders/shared/shape.h
  `const uint shapeTriangleTip=0u;
const uint shapeQuad=1u;
const uint shapeTriangle=2u;
const uint shapeQuadratic=3u;
const uint shapeDandelion=4u;
const uint shapeLeaf=5u;
const uint shapeStalkLeaf=6u;
const uint shapeCount=7u;
const uint namedShapes=6u;
const float baseWidth=0.25f;
const float baseLength=0.3f;
const float dandelionLobes=4.0f;
const float segmentsPerLobe=4.0f;
vec2 outlineAt(uint shape,float tipThreshold,float t)
{
float half_=0.5f;
if (shape==shapeTriangleTip)
half_=0.5f - 0.5f*max(t - tipThreshold,0.0f)/max(1.0f - tipThreshold,1e-3f);
else if (shape==shapeTriangle)
half_=0.5f - 0.5f*t;
else if (shape==shapeQuadratic)
return vec2(-0.5f,0.5f - t*t);
else if (shape==shapeDandelion) {
float rest=1.0f - t;
float wave=abs(sin(3.14159265f*dandelionLobes*rest));
half_=0.5f*sqrt(rest)*(2.0f - rest - sqrt(0.5f*wave));
} else if (shape==shapeLeaf) {
float away=t<tipThreshold?(tipThreshold - t)/max(tipThreshold,1e-3f)
: (t - tipThreshold)/max(1.0f - tipThreshold,1e-3f);
half_=0.5f - 0.5f*min(away*away,1.0f);
} else if (shape==shapeStalkLeaf) {
float before=max(1.0f - t/baseLength,0.0f);
half_=(0.5f - 0.5f*max(t - tipThreshold,0.0f)/max(1.0f - tipThreshold,1e-3f)) *
(1.0f - (1.0f - baseWidth)*before*before);
}
return vec2(-half_,half_);
}
bool isEven(uint shape)
{
return shape!=shapeQuadratic;
}
bool isTapering(uint shape)
{
return shape!=shapeDandelion&&shape!=shapeLeaf&&shape!=shapeStalkLeaf;
}
vec2 momentsOfStalkLeaf(float tipThreshold)
{
float tau=tipThreshold;
float lacks=1.0f - baseWidth;
float u=max(1.0f - tau/baseLength,0.0f);
float taper=u*u*u*u*baseLength*baseLength/max(1.0f - tau,1e-3f);
return vec2(0.5f+0.5f*tau - lacks*(baseLength/3.0f - taper/12.0f),
(1.0f+tau+tau*tau)/6.0f -
lacks*(baseLength*baseLength/12.0f -
taper*baseLength*(1.0f/12.0f - 0.05f*u)));
}
float outlineArea(uint shape,float tipThreshold)
{
if (shape==shapeTriangleTip)
return 0.5f+0.5f*tipThreshold;
if (shape==shapeTriangle)
return 0.5f;
if (shape==shapeQuadratic||shape==shapeLeaf)
return 2.0f/3.0f;
if (shape==shapeStalkLeaf)
return momentsOfStalkLeaf(tipThreshold).x;
return shape==shapeDandelion?0.57268f:1.0f;
}
struct Outline {
uint shape;
float tipThreshold;
float segments;
float scale;
};
const float exactSegments=20.0f;
const float outlineMost=1.35f;
float innerWidths(uint shape,float tipThreshold,float segments)
{
if (shape==shapeTriangleTip) {
float first=floor(tipThreshold*segments)+1.0f;
float count=max(segments - first,0.0f);
float beyond =
0.5f*count*(first+segments - 1.0f)/segments - tipThreshold*count;
return segments - 1.0f - beyond/max(1.0f - tipThreshold,1e-3f);
}
float sum=0.0f;
for (float i=1.0f; i<segments; i+=1.0f) {
vec2 edges=outlineAt(shape,tipThreshold,i/segments);
sum+=edges.y - edges.x;
}
return sum;
}
Outline outlineOf(uint shape,float tipThreshold,float segments)
{
Outline outline;
outline.shape=shape;
outline.tipThreshold=tipThreshold;
outline.segments=segments;
outline.scale=1.0f;
if (segments<1.5f||segments>exactSegments)
return outline;
if (shape==shapeStalkLeaf&&segments<3.5f)
outline.shape=shapeTriangleTip;
vec2 first=outlineAt(outline.shape,tipThreshold,0.0f);
vec2 last=outlineAt(outline.shape,tipThreshold,1.0f);
float sum=0.5f*(first.y - first.x+last.y - last.x) +
innerWidths(outline.shape,tipThreshold,segments);
outline.scale=outlineArea(shape,tipThreshold)*segments/sum;
return outline;
}
vec2 singleSegment(uint shape,float tipThreshold)
{
if (shape==shapeTriangleTip)
return vec2(1.0f+tipThreshold - tipThreshold*tipThreshold,tipThreshold*tipThreshold);
if (shape==shapeTriangle)
return vec2(1.0f,0.0f);
if (shape==shapeQuadratic)
return vec2(7.0f/6.0f,1.0f/6.0f);
if (shape==shapeLeaf) {
float moment=0.25f+tipThreshold*(1.0f/6.0f);
return vec2(8.0f/3.0f - 6.0f*moment,6.0f*moment - 4.0f/3.0f);
}
if (shape==shapeStalkLeaf) {
vec2 moments=momentsOfStalkLeaf(tipThreshold);
return vec2(4.0f*moments.x - 6.0f*moments.y,6.0f*moments.y - 2.0f*moments.x);
}
return shape==shapeDandelion?vec2(0.64894f,0.49642f):vec2(1.0f);
}
vec2 edgesAt(Outline outline,float t)
{
if (outline.segments<1.5f) {
vec2 ends=singleSegment(outline.shape,outline.tipThreshold);
float half_=0.5f*mix(ends.x,ends.y,t);
return vec2(-half_,half_);
}
return outline.scale*outlineAt(outline.shape,outline.tipThreshold,t);
}
float segmentsFor(vec3 v0,vec3 v1,vec3 v2,float size,uint shape,float heightPixels,
float widthPixels,float most)
{
float stray=length(v0 - 2.0f*v1+v2)*(heightPixels/max(size,1e-9f));
float curve=ceil(sqrt(stray));
if (shape==shapeDandelion&&widthPixels>2.0f)
return dandelionLobes*segmentsPerLobe;
float tip=widthPixels>3.0f?3.0f:(widthPixels>1.0f?2.0f:1.0f);
if ((shape==shapeLeaf||shape==shapeStalkLeaf)&&widthPixels>3.0f)
tip=widthPixels>12.0f?8.0f:4.0f;
return clamp(max(curve,tip),1.0f,max(most,1.0f));
}
struct LevelSteps {
vec4 distance;
vec4 segments;
uint count;
};
float segmentsAt(LevelSteps steps,float distance)
{
float segments=steps.segments[0];
for (int i=1; i<4;
++i) if (uint(i)<steps.count&&distance>=steps.distance[i - 1])
segments=steps.segments[i];
return segments;
}
#endif
`,
  // shaders/shared/species.h
  `const uint maxSpecies=8u;
struct Species {
vec3 rootColor;
float tipThreshold;
vec3 tipColor;
float groundTint;
float colorVariation;
float translucency;
float gloss;
float dryness;
uint shape;
float fold;
uint firstOrgan;
uint organKinds;
};
struct SpeciesArray { uint none; };
Species fetchSpeciesArray(uint i);
#endif
`,
  // shaders/shared/organ.h
  `const uint maxRibbons=63u;
const uint maxOrganKinds=32u;
struct Organ {
Species look;
uint count;
vec2 place;
vec2 pitch;
vec2 size;
float width;
float azimuth;
float turn;
float bend;
float leg;
float variation;
};
struct OrganTable { uint none; };
Organ fetchOrganTable(uint i);
uint ribbonNumber(Species species,Blade blade)
{
return species.organKinds>0u?blade.clump:0u;
}
uint organOf(OrganTable organs,Species species,uint number,inout uint within)
{
uint kind=species.firstOrgan;
within=number - 1u;
while (kind+1u<species.firstOrgan+species.organKinds&&within>=fetchOrganTable(uint(kind)).count) {
within-=fetchOrganTable(uint(kind)).count;
++kind;
}
return kind;
}
float legLength(float bend)
{
float sum=0.0f;
for (uint i=0u; i<=32u; ++i) {
float t=float(i)/32.0f;
float speed=sqrt(max(1.0f - 2.0f*t*(1.0f - t)*(1.0f - cos(bend)),0.0f));
sum+=(i==0u||i==32u?1.0f:(i & 1u)!=0u?4.0f:2.0f)*speed;
}
return 0.5f*96.0f/sum;
}
struct PosedBlade {
Blade blade;
vec3 v0;
vec3 v1;
vec3 v2;
vec3 axis;
};
PosedBlade posedBlade(Blade blade,BladeState state)
{
PosedBlade posed;
posed.blade=blade;
posed.axis=widthAxis(blade.up,blade.facing);
Pose pose=poseOfState(axesAlong(blade.up,posed.axis),state);
posed.v0=blade.root;
posed.v1=blade.root+blade.height*pose.v1;
posed.v2=blade.root+blade.height*pose.v2;
return posed;
}
uint plantKey(Blade blade)
{
return blade.hash | ((uint(blade.facing*(256.0f/twoPi)+0.5f) & 255u) << 4u);
}
float organDice(Blade blade,uint number,uint salt)
{
return float(mixUint(plantKey(blade) | (number << 12u) | (salt << 20u)) >> 8u) *
(1.0f/16777215.0f) -
0.5f;
}
vec3 aboveGround(vec3 root,vec3 up,vec3 v)
{
return v - up*min(dot(up,v - root),0.0f);
}
PosedBlade posedRibbon(PosedBlade stalk,Organ organ,uint number,uint within)
{
Blade plant=stalk.blade;
float share=organ.count>1u?float(within)/float(organ.count - 1u):0.0f;
float t=mix(organ.place.x,organ.place.y,share);
vec3 along=bezierTangent(stalk.v0,stalk.v1,stalk.v2,t);
along=normalize(
dot(along,along)>1e-10f*plant.height*plant.height?along:stalk.v1 - stalk.v0);
vec3 side=stalk.axis - along*dot(along,stalk.axis);
float level=dot(side,side);
side=level>1e-6f?side*inversesqrt(level):plant.up;
vec3 front=cross(along,side);
float azimuth=organ.azimuth+organ.turn*float(within) +
2.0f*organ.variation*organDice(plant,number,0u);
float pitch=mix(organ.pitch.x,organ.pitch.y,share) +
0.8f*organ.variation*organDice(plant,number,1u);
vec3 outwards=cos(azimuth)*side+sin(azimuth)*front;
PosedBlade ribbon;
ribbon.blade=plant;
ribbon.blade.height=plant.height*mix(organ.size.x,organ.size.y,share) *
(1.0f+0.6f*organ.variation*organDice(plant,number,2u));
ribbon.axis=cos(azimuth)*front - sin(azimuth)*side;
float leg=organ.leg*ribbon.blade.height;
ribbon.v0=bezierPoint(stalk.v0,stalk.v1,stalk.v2,t);
vec3 v1=ribbon.v0+leg*(cos(pitch)*along+sin(pitch)*outwards);
vec3 v2 =
v1+leg*(cos(pitch+organ.bend)*along+sin(pitch+organ.bend)*outwards);
ribbon.v1=aboveGround(plant.root,plant.up,v1);
ribbon.v2=aboveGround(plant.root,plant.up,v2);
return ribbon;
}
PosedBlade ribbonOf(OrganTable organs,Species species,PosedBlade stalk,uint number)
{
uint within=0u;
uint kind=organOf(organs,species,number,within);
return posedRibbon(stalk,fetchOrganTable(uint(kind)),number,within);
}
#endif
`,
  // shaders/shared/sun_shadow.h
  `#ifndef SWARD_SHARED_SUN_SHADOW_H
#define SWARD_SHARED_SUN_SHADOW_H
`,
  // shaders/shared/sun_shadow.h
  `struct SunDepthTable { uint none; };
float fetchSunDepthTable(uint i);
struct SunShadow {
vec4 across;
vec4 down;
vec4 depth;
uint size;
float texel;
float epsilon;
uint reserved;
};
const float shadowOffset=2.0f;
float sunSeen(SunShadow shadow,vec3 place,vec3 normal)
{
if (shadow.size==0u)
return 1.0f;
vec4 lifted=vec4(place+normal*(shadowOffset*shadow.texel),1.0f);
vec2 at=vec2(dot(shadow.across,lifted),dot(shadow.down,lifted)) - 0.5f;
float depth=dot(shadow.depth,lifted)+shadow.epsilon;
vec2 f=at - floor(at);
int last=int(shadow.size) - 2;
int column=clamp(int(floor(at.x)),0,last);
int row=clamp(int(floor(at.y)),0,last);
int first=row*int(shadow.size)+column;
int below=first+int(shadow.size);
float above0=fetchSunDepthTable(uint(first))>depth?1.0f:0.0f;
float above1=fetchSunDepthTable(uint(first+1))>depth?1.0f:0.0f;
float below0=fetchSunDepthTable(uint(below))>depth?1.0f:0.0f;
float below1=fetchSunDepthTable(uint(below+1))>depth?1.0f:0.0f;
return 1.0f - mix(mix(above0,above1,f.x),mix(below0,below1,f.x),f.y);
}
#endif
`,
  // shaders/shared/update_rate.h
  `#ifndef SWARD_SHARED_UPDATE_RATE_H
#define SWARD_SHARED_UPDATE_RATE_H
`,
  // shaders/shared/update_rate.h
  `struct UpdateRate {
float everyFrame;
float everyThird;
float longest;
uint frame;
};
const float ticksPerSecond=262144.0f;
float secondsBetween(uint then,uint now)
{
return float(now - then)/ticksPerSecond;
}
const float settlingTime=12.0f;
bool movesNow(UpdateRate updateRate,uint index,float distance,float elapsed)
{
if (distance<updateRate.everyFrame||elapsed>=updateRate.longest)
return true;
return distance<updateRate.everyThird&&(updateRate.frame+index) % 3u==0u;
}
#endif
`,
  // shaders/shared/frame.h
  `struct VisibleBlade {
uint blade;
uint patchIndex;
uint factors;
float pixels;
};
const uint heightFactorBits=0x03ff0000u;
uint packFactors(float width,float height)
{
return packHalf2x16(vec2(width,height)) & (heightFactorBits | 0xffffu);
}
float widthFactorOf(VisibleBlade visible)
{
return unpackHalf2x16(visible.factors).x;
}
float heightFactorOf(VisibleBlade visible)
{
return unpackHalf2x16((visible.factors & heightFactorBits) | 0x3c000000u).y;
}
const uint quarters=4u;
const uint allQuarters=15u;
const uint lateShift=28u;
uint beginOfQuarter(uint i,uint segments)
{
return i*segments/quarters;
}
uint quarterOf(float i,float segments)
{
return uint((4.0f*i+3.25f)/segments);
}
struct DrawArguments {
uint vertexCount;
uint instanceCount;
uint firstVertex;
uint firstInstance;
uint simulated;
uint cullResults[7];
};
struct VisibleArray { uint none; };
VisibleBlade fetchVisibleArray(uint i);
struct DrawArray { uint none; };
DrawArguments fetchDrawArray(uint i);
struct FloatArray { uint none; };
float fetchFloatArray(uint i);
struct UintArray { uint none; };
uint fetchUintArray(uint i);
struct FrameArray { uint none; };
#endif
`,
  // web/shaders/frame.glsl
  `layout(std140) uniform FrameConstants
{
mat4 viewProjection;
vec3 rays[3];
float depthOfEye;
Eyepoint view;
Environment environment;
uint patchCount;
uint bladeCount;
uint visibleCapacity;
uint maxTessellation;
vec3 sunDirection;
float exposure;
vec3 sunColor;
uint debugMode;
vec3 skyColor;
float fogDensity;
vec3 groundColor;
vec3 skyUp;
float fixedTessellation;
float clouds;
LevelSteps levelSteps;
UpdateRate updateRate;
Cover cover;
SunShadow shadow;
BladeShadow bladeShadow;
float
fogFalloff;
float lowSun;
uint tick;
FloorPlane floorPlane;
uint reserved[36];
}
frameConstants;
#define FRAME frameConstants
struct Looks {
Species species[maxSpecies];
Organ organs[maxOrganKinds];
};
layout(std140) uniform LookTables
{
Looks looks;
};
uniform usampler2D coverTexture;
uniform sampler2D sunTexture;
uniform usampler2D bladeShadowTexture;
const uint tableWidth=2048u;
ivec2 placeInTable(uint i)
{
return ivec2(int(i % tableWidth),int(i/tableWidth));
}
uint fetchCoverTable(uint i)
{
return texelFetch(coverTexture,placeInTable(i),0).x;
}
float fetchSunDepthTable(uint i)
{
uint size=FRAME.shadow.size;
return 1.0 - texelFetch(sunTexture,ivec2(int(i % size),int(size - 1u - i/size)),0).x;
}
uvec2 fetchBladeShadowTable(uint i)
{
uint size=FRAME.bladeShadow.size;
return texelFetch(bladeShadowTexture,ivec2(int(i/size),int(size - 1u - i % size)),0).xy;
}
Species fetchSpeciesArray(uint i)
{
return looks.species[i];
}
Organ fetchOrganTable(uint i)
{
return looks.organs[i];
}
Collider fetchColliderTable(uint i)
{
Collider none;
return none;
}
int findLSB(uint bits)
{
return -1;
}
vec4 unpackUnorm4x8(uint bits)
{
return vec4(uvec4(bits,bits >> 8u,bits >> 16u,bits >> 24u) & 255u)/255.0;
}
uint packUnorm4x8(vec4 v)
{
uvec4 bytes=uvec4(floor(clamp(v,0.0,1.0)*255.0+0.5));
return bytes.x | (bytes.y << 8u) | (bytes.z << 16u) | (bytes.w << 24u);
}
uniform vec2 jitter;
vec4 inClip(vec4 place)
{
place.xy-=jitter*place.w;
return vec4(place.x,-place.y,place.w - 2.0*place.z,place.w);
}
#endif
`,
  // web/shaders/blades.glsl
  `uniform usampler2D bladeTexture;
uniform usampler2D stateTexture;
uniform usampler2D patchTexture;
const uint groupBlades=32u;
layout(location=0) in uvec3 group;
const uint patchTexels=7u;
const uint patchesOfRow=256u;
uvec4 patchPart(uint i,uint part)
{
return texelFetch(patchTexture,ivec2(int((i % patchesOfRow)*patchTexels+part),int(i/patchesOfRow)),0);
}
Patch fetchPatchArray(uint i)
{
uvec4 a=patchPart(i,0u);
uvec4 b=patchPart(i,1u);
uvec4 c=patchPart(i,2u);
uvec4 d=patchPart(i,3u);
uvec4 e=patchPart(i,4u);
uvec4 f=patchPart(i,5u);
uvec4 g=patchPart(i,6u);
Patch cell;
cell.boundsLow=uintBitsToFloat(a.xyz);
cell.firstBlade=a.w;
cell.boundsHigh=uintBitsToFloat(b.xyz);
cell.bladeCount=b.w;
cell.rootLow=uintBitsToFloat(c.xyz);
cell.rootStep=uintBitsToFloat(c.w);
cell.coneAxis=uintBitsToFloat(d.xyz);
cell.coneCosine=uintBitsToFloat(d.w);
cell.heightLow=uintBitsToFloat(e.x);
cell.heightStep=uintBitsToFloat(e.y);
cell.widthLow=uintBitsToFloat(e.z);
cell.widthStep=uintBitsToFloat(e.w);
cell.parent=f.x;
cell.firstChild=f.y;
cell.childCount=f.z;
cell.level=f.w;
cell.rankLow=uintBitsToFloat(g.x);
cell.rankHigh=uintBitsToFloat(g.y);
return cell;
}
PackedBlade fetchBladeArray(uint i)
{
uvec4 bits=texelFetch(bladeTexture,placeInTable(i),0);
return PackedBlade(bits.x,bits.y,bits.z,bits.w);
}
uint fetchUintArray(uint i)
{
return texelFetch(stateTexture,placeInTable(i),0).x;
}
#endif
`,
  // shaders/shared/physics.h
  `#ifndef SWARD_SHARED_PHYSICS_H
#define SWARD_SHARED_PHYSICS_H
`,
  // shaders/shared/wind.h
  `#ifndef SWARD_SHARED_WIND_H
#define SWARD_SHARED_WIND_H
`,
  // shaders/shared/wind.h
  `#ifndef WIND_SOURCE
#define WIND_SOURCE(wind, i) wind.sources[i]
#define WIND_PHASE(wind, i) wind.phases[i]
#define WIND_LATTICE(wind) wind.lattice
#endif
uint windCount(uint counts,uint kind)
{
return (counts >> (4u*kind)) & 15u;
}
WindSource preparedSource(WindSource source)
{
WindSource prepared=source;
prepared.side=abs(source.direction.y)<0.99f
? normalize(cross(source.direction,vec3(0.0f,1.0f,0.0f)))
: vec3(1.0f,0.0f,0.0f);
prepared.perSize=1.0f/source.size;
return prepared;
}
bool blowsLike(WindSource a,WindSource b)
{
bool hasAmounts=(a.kind==windNoise||a.kind==windWave||a.kind==windGusts) &&
(b.kind==windNoise||b.kind==windWave||b.kind==windGusts);
return hasAmounts&&a.direction==b.direction&&a.alignment==b.alignment &&
a.lift==b.lift;
}
const float fineNoiseStart=17.3f;
const float fineNoiseScale=2.7f;
const uint gustRows=7u;
WindPhase windPhaseAtZero()
{
WindPhase phase;
phase.shift=vec3(0.0f);
phase.cell=0u;
phase.fineShift=vec3(fineNoiseStart);
phase.fineCell=0u;
phase.angle=0.0f;
phase.turned=0.0f;
return phase;
}
float windWaveAt(WindSource source,WindPhase phase,vec3 position,float time)
{
float k=6.2831853f*source.perSize;
float along=k*(dot(position,source.direction) - source.speed*time) - phase.angle;
float across=k*dot(position,source.side);
float sum=cos(0.9f*along+0.4f*across)+sin(0.55f*along - 0.25f*across) +
sin(0.3f*along+0.6f*across);
return 1.0f - max(sum/3.0f,0.0f);
}
vec3 inLattice(Wind wind,vec3 v,vec3 shift)
{
vec3 x=WIND_LATTICE(wind).x;
vec3 y=WIND_LATTICE(wind).y;
vec3 z=WIND_LATTICE(wind).z;
return vec3(((shift.x+x.x*v.x)+x.y*v.y)+x.z*v.z,
((shift.y+y.x*v.x)+y.y*v.y)+y.z*v.z,
((shift.z+z.x*v.x)+z.y*v.y)+z.z*v.z);
}
float windNoiseAt(Wind wind,WindSource source,WindPhase phase,vec3 position,
float time)
{
float along=dot(position,source.direction) - 2.0f*source.speed*time;
vec3 stretched=inLattice(
wind,(0.5f*source.perSize)*(position+source.direction*along),phase.shift);
float gust =
0.65f*valueNoiseFrom(phase.cell,stretched) +
0.35f*valueNoiseFrom(phase.fineCell,fineNoiseScale*stretched+phase.fineShift);
return 2.0f*gust*gust;
}
const float gustRise=0.12f;
float windGustAt(Wind wind,WindSource source,WindPhase phase,vec3 position,float time)
{
float along=dot(position,source.direction);
vec3 across =
inLattice(wind,source.perSize*(position - source.direction*along),vec3(0.0f));
float bend=0.8f*(valueNoise(0.7f*across+vec3(5.1f)) - 0.5f)+phase.shift.x;
float fronts=(source.speed*time - along)*source.perSize+bend;
float front=floor(fronts);
float s=fronts - front;
float rise=clamp(s/gustRise,0.0f,1.0f);
float fall=clamp((1.0f - s)/(1.0f - gustRise),0.0f,1.0f);
float profile=rise*rise*(3.0f - 2.0f*rise)*fall*fall;
float own =
valueNoiseFrom(phase.cell,across+vec3(0.0f,0.0f,float(gustRows)*front));
return profile*clamp(2.0f*own - 0.2f,0.0f,1.0f);
}
vec3 parabolicSine(vec3 x)
{
vec3 f=2.0f*fract(x) - vec3(1.0f);
return -4.0f*f*(vec3(1.0f) - abs(f));
}
const vec3 eddyDrift=vec3(0.48f,0.57f,0.67f);
vec3 windEddies(float size,float speed,vec3 phase,vec3 position,float time)
{
vec3 q=(position+eddyDrift*(speed*time))/size+phase;
vec3 s=parabolicSine(q);
vec3 c=parabolicSine(q+vec3(0.25f));
return 0.7f*(vec3(s.z,s.x,s.y)+vec3(c.y,c.z,c.x));
}
const float radialExtent=75.0f;
const float swirlExtent=30.0f;
vec3 windAround(WindSource source,WindPhase phase,vec3 arm,vec3 up,float time,
bool isSwirl)
{
float distance=length(arm);
vec3 away=arm/(distance+0.01f*source.size);
float unit=(isSwirl?swirlExtent:radialExtent)/source.size;
float r=unit*distance;
float fade=max(1.0f - 0.25f*log2((isSwirl?0.5f:0.2f)*r+1.0f),0.0f);
float along=r - unit*source.speed*time - phase.angle;
if (!isSwirl)
return away*(fade*(1.0f - max(sin(0.4f*along),0.0f)));
float ring=sin(0.1f*along);
return (away+1.5f*(1.0f - fade*fade)*cross(up,away))*(fade*ring*ring*ring);
}
vec3 windAlong(Wind wind,WindSource source,vec3 direction,float amount,vec3 position,
vec3 up,float time)
{
float head=(1.0f - source.lift)*abs(dot(source.direction,up));
vec3 flow=direction;
if (head>0.0f)
flow+=head*windEddies(wind.eddySize,wind.eddySpeed,wind.eddyPhase,position,time);
return amount*flow;
}
vec3 windFelt(WindSource source,vec3 flow,BladeAxes axes,vec3 direction)
{
vec3 wind=alongAxes(axes,flow);
wind.z*=source.lift;
float square=dot(wind,wind);
float along=square>1e-12f?abs(dot(wind,direction))*inversesqrt(square):0.0f;
return (1.0f - source.alignment*along)*wind;
}
float windAmount(Wind wind,vec3 position,float time)
{
float sum=0.0f;
uint next=0u;
for (uint i=windCount(wind.counts,windNoise); i>0u; --i) {
WindPhase phase=WIND_PHASE(wind,next);
WindSource source=WIND_SOURCE(wind,next++);
sum+=source.strength*windNoiseAt(wind,source,phase,position,time);
}
for (uint i=windCount(wind.counts,windWave); i>0u; --i) {
WindPhase phase=WIND_PHASE(wind,next);
WindSource source=WIND_SOURCE(wind,next++);
float wave=windWaveAt(source,phase,position,time);
sum+=source.strength*wave*wave;
}
for (uint i=windCount(wind.counts,windGusts); i>0u; --i) {
WindPhase phase=WIND_PHASE(wind,next);
WindSource source=WIND_SOURCE(wind,next++);
sum+=source.strength*windGustAt(wind,source,phase,position,time);
}
return sum;
}
vec3 windOfAmount(Wind wind,float amount,vec3 position,BladeAxes axes,vec3 direction,
float time)
{
WindSource source=WIND_SOURCE(wind,0);
return amount *
windFelt(source,
windAlong(wind,source,source.direction,1.0f,position,axes.up,time),axes,
direction);
}
vec3 windAlongAxes(Wind wind,vec3 root,BladeAxes axes,vec3 direction,float time)
{
vec3 position=root+WIND_LATTICE(wind).origin;
if ((wind.counts & windsAlike)!=0u)
return windOfAmount(wind,windAmount(wind,position,time),position,axes,direction,
time);
vec3 sum=vec3(0.0f);
uint next=0u;
for (uint i=windCount(wind.counts,windNoise); i>0u; --i) {
WindPhase phase=WIND_PHASE(wind,next);
WindSource source=WIND_SOURCE(wind,next++);
float amount=source.strength*windNoiseAt(wind,source,phase,position,time);
sum+=windFelt(source,
windAlong(wind,source,source.direction,amount,position,axes.up,time),
axes,direction);
}
for (uint i=windCount(wind.counts,windTurning); i>0u; --i) {
WindPhase phase=WIND_PHASE(wind,next);
WindSource source=WIND_SOURCE(wind,next++);
float angle=source.turn*time+phase.turned;
vec3 turned =
source.direction*cos(angle)+cross(axes.up,source.direction)*sin(angle);
float amount =
source.strength*sin(source.rate*time+phase.angle -
(6.2831853f*source.perSize)*dot(position,source.direction));
sum+=windFelt(source,windAlong(wind,source,turned,amount,position,axes.up,time),
axes,direction);
}
for (uint i=windCount(wind.counts,windWave); i>0u; --i) {
WindPhase phase=WIND_PHASE(wind,next);
WindSource source=WIND_SOURCE(wind,next++);
float wave=windWaveAt(source,phase,position,time);
float amount=source.strength*wave*wave;
sum+=windFelt(source,
windAlong(wind,source,source.direction,amount,position,axes.up,time),
axes,direction);
}
for (uint i=windCount(wind.counts,windRadial); i>0u; --i) {
WindPhase phase=WIND_PHASE(wind,next);
WindSource source=WIND_SOURCE(wind,next++);
sum+=windFelt(source,
source.strength *
windAround(source,phase,root - source.centre,axes.up,time,false),
axes,direction);
}
for (uint i=windCount(wind.counts,windSwirl); i>0u; --i) {
WindPhase phase=WIND_PHASE(wind,next);
WindSource source=WIND_SOURCE(wind,next++);
sum+=windFelt(source,
source.strength *
windAround(source,phase,root - source.centre,axes.up,time,true),
axes,direction);
}
for (uint i=windCount(wind.counts,windGusts); i>0u; --i) {
WindPhase phase=WIND_PHASE(wind,next);
WindSource source=WIND_SOURCE(wind,next++);
float amount=source.strength*windGustAt(wind,source,phase,position,time);
sum+=windFelt(source,
windAlong(wind,source,source.direction,amount,position,axes.up,time),
axes,direction);
}
return sum;
}
vec3 windAt(Wind wind,vec3 position,vec3 up,float time)
{
BladeAxes axes=axesTowards(up,tangentOf(up));
return inSpace(axes,windAlongAxes(wind,position,axes,vec3(0.0f),time));
}
vec3 windForce(Wind wind,vec3 root,vec3 up,vec3 tip,float time)
{
BladeAxes axes=axesTowards(up,tangentOf(up));
vec3 direction=alongAxes(axes,tip/max(length(tip),1e-6f));
return max(dot(tip,up),0.0f) *
inSpace(axes,windAlongAxes(wind,root,axes,direction,time));
}
#endif
`,
  // shaders/shared/physics.h
  `vec3 environmentAt(Gravity gravity,vec3 root)
{
vec3 towards=gravity.direction;
if (gravity.blend>0.0f) {
vec3 toAttractor=gravity.attractor - root;
float distance=length(toAttractor);
vec3 pull=distance>1e-6f?toAttractor/distance:vec3(0.0f);
towards=mix(gravity.direction,pull,gravity.blend);
}
return gravity.strength*towards;
}
vec3 gravityAt(Gravity gravity,vec3 root,vec3 front)
{
vec3 environment=environmentAt(gravity,root);
return environment+gravity.forward*length(environment)*front;
}
struct TurnQuotient {
vec2 over;
vec2 under;
};
vec2 timesConjugate(vec2 a,vec2 b)
{
return vec2(a.x*b.x+a.y*b.y,a.y*b.x - a.x*b.y);
}
vec2 turnAbove(TurnQuotient turn)
{
vec2 product=timesConjugate(turn.over,turn.under);
float under=dot(turn.under,turn.under);
if (dot(turn.over,turn.over)<=under)
return (1.0f/under)*product;
float square=dot(product,product);
return square>1e-30f?inversesqrt(square)*product:vec2(1.0f,0.0f);
}
vec3 directionOfQuotient(TurnQuotient turn)
{
float over=dot(turn.over,turn.over);
float under=dot(turn.under,turn.under);
vec2 product=timesConjugate(turn.over,turn.under);
return (1.0f/(under+over))*vec3(2.0f*product.x,2.0f*product.y,under - over);
}
const float lyingBelow=1e-3f;
TurnQuotient relaxTurn(float stiffness,vec3 force,float recovery,vec2 turn,bool lies,
float radius,float eta,float dt)
{
float b=1.0f - stiffness;
float k=max(recovery*(1.0f - 0.25f*b)*max(1.0f - eta,0.1f),1e-3f);
vec3 pull=b*force;
pull.z+=k;
if (lies)
pull.z=max(pull.z,0.0f);
float strength=length(pull);
TurnQuotient turned;
turned.over=turn;
turned.under=vec2(1.0f,0.0f);
if (strength<1e-6f*k)
return turned;
float fall=exp(-(strength/radius)*dt);
float above=strength+pull.z;
float below=strength - pull.z;
vec2 towards=(1.0f - fall)*vec2(pull.x,pull.y);
turned.over=(fall*above+below)*turn+towards;
turned.under=timesConjugate(turn,towards);
turned.under.x+=above+fall*below;
return turned;
}
vec3 relaxTip(Blade blade,vec3 front,Gravity gravity,vec3 wind,float recovery,
vec3 tip,float eta,float dt)
{
BladeAxes axes=axesTowards(blade.up,front);
float radius=max(length(tip),1e-6f);
vec3 force=gravityAt(gravity,blade.root,front)+wind;
vec3 direction=alongAxes(axes,tip/radius);
return inSpace(axes,directionOfQuotient(relaxTurn(blade.stiffness,alongAxes(axes,force),
recovery,turnTowards(direction),
direction.z<lyingBelow,radius,eta,dt)));
}
const uint contactRounds=3u;
const float middleLever=2.0f;
vec3 pushBlade(Blade blade,vec3 front,ColliderTable colliders,ColliderMask near,
vec3 tipBefore,vec3 tip,float back,inout float pushed,
inout bool resting)
{
Pose pose=poseBlade(blade.up,front,tip);
vec3 result=tip;
bool touched=true;
for (uint turn=0u; turn<contactRounds&&touched; ++turn) {
touched=false;
for (uint word=0u; word<colliderWords; ++word) {
for (uint bits=near.words[word]; bits!=0u; bits&=bits - 1u) {
Collider collider=colliderSeenFrom(
fetchColliderTable(uint(32u*word+uint(findLSB(bits)))),blade.root,blade.height,back);
if (length(towardsSegment(collider,vec3(0.0f)))>=collider.radius+1.0f)
continue;
for (uint point=0u; point<2u; ++point) {
vec3 middle=0.5f*pose.v1+0.25f*pose.v2;
vec3 push=point==0u?pushOut(collider,pose.v2,front)
: middleLever*pushOut(collider,middle,front);
if (dot(push,push)>0.0f) {
vec3 before=pose.v2;
pose=poseBlade(blade.up,front,before+push);
result=pose.v2;
pushed+=length(result - before);
resting=resting&&dot(collider.velocity,collider.velocity)==0.0f;
touched=true;
}
}
}
}
}
return touched&&resting?poseBlade(blade.up,front,tipBefore+result).v2:result;
}
const float longestStep=0.034f;
const uint maxSteps=16u;
const float stickingSpeed=0.06f;
BladeState advanceBlade(Blade blade,Environment environment,ColliderMask near,
BladeState state,float time,float elapsed)
{
BladeAxes axes=axesAlong(blade.up,widthAxis(blade.up,blade.facing));
float fade=0.5f*max(blade.stiffness,0.1f);
uint steps=uint(clamp(ceil(elapsed/longestStep),1.0f,float(maxSteps)));
float dt=elapsed/float(steps);
vec3 pull=environmentAt(environment.gravity,blade.root);
vec3 gravity=alongAxes(axes,pull);
gravity.x+=environment.gravity.forward*length(pull);
vec2 first=storedTurn(state);
vec2 turn=first;
float eta=state.eta;
float pushed=0.0f;
bool resting=true;
for (uint i=0u; i<steps; ++i) {
float back=elapsed - dt*float(i+1u);
eta=max(eta - fade*dt,0.0f);
vec3 direction=directionOfTurn(turn);
float radius=tipDistance(direction);
float before=pushed;
vec3 wind =
windAlongAxes(environment.wind,blade.root,axes,direction,time - back - 0.5f*dt);
turn=turnAbove(relaxTurn(blade.stiffness,gravity+(radius*direction.z)*wind,
environment.recovery,turn,direction.z<lyingBelow,radius,
eta,dt));
if (false) {
vec3 moved=directionOfTurn(turn);
vec3 tip=pushBlade(
blade,axes.front,ColliderTable(0u),near,inSpace(axes,radius*direction),
inSpace(axes,tipDistance(moved)*moved),back,pushed,resting);
if (pushed>before)
turn=turnTowards(alongAxes(axes,normalize(tip)));
eta=min(eta+(pushed - before),1.0f);
}
}
if (pushed>0.0f&&resting) {
vec3 from=directionOfTurn(first);
vec3 to=directionOfTurn(turn);
if (length(tipDistance(to)*to - tipDistance(from)*from)<stickingSpeed*elapsed)
return state;
}
return stateOfTurn(turn,eta);
}
#endif
`,
  // shaders/shared/visibility.h
  `#ifndef SWARD_SHARED_VISIBILITY_H
#define SWARD_SHARED_VISIBILITY_H
`,
  // shaders/shared/ribbon.h
  `#ifndef SWARD_SHARED_RIBBON_H
#define SWARD_SHARED_RIBBON_H
`,
  // shaders/shared/ribbon.h
  `struct Ribbon {
vec3 v0;
vec3 v1;
vec3 v2;
vec3 axis;
float width;
float fold;
Outline outline;
uint seed;
};
struct CrossSection {
vec3 left;
vec3 right;
vec3 ridge;
float wide;
float drawn;
};
float foldOf(float fold,float widthPixels)
{
return fold*smoothstep(2.0f,4.0f,widthPixels);
}
vec3 directionAt(Ribbon ribbon,float t)
{
vec3 tangent=bezierTangent(ribbon.v0,ribbon.v1,ribbon.v2,t);
return dot(tangent,tangent)>1e-18f?tangent:ribbon.v1 - ribbon.v0;
}
vec3 tangentAt(Ribbon ribbon,float t)
{
return normalize(directionAt(ribbon,t));
}
vec3 outwardsOf(vec3 across,vec3 level)
{
float square=dot(level,level);
vec3 unit=square>1e-18f?level*inversesqrt(square):across;
float upright=dot(unit,across);
return across+(upright/max(upright*upright,0.25f))*(unit - upright*across);
}
CrossSection crossSectionAt(Ribbon ribbon,float t,vec3 eye,float minWidth)
{
vec3 centre=bezierPoint(ribbon.v0,ribbon.v1,ribbon.v2,t);
vec3 direction=directionAt(ribbon,t);
vec2 edges=ribbon.width*edgesAt(ribbon.outline,t);
CrossSection section;
section.left=centre+edges.x*ribbon.axis;
section.right=centre+edges.y*ribbon.axis;
section.wide=edges.y - edges.x;
section.drawn=section.wide;
if (minWidth>0.0f) {
float half_=0.5f/max(ribbon.outline.segments,1.0f);
vec3 chord=directionAt(ribbon,clamp(t,half_,1.0f - half_));
vec3 ray=centre - eye;
float distance=length(ray);
vec3 side=cross(ray,chord);
float square=dot(side,side);
vec3 across=square>1e-12f*dot(ray,ray)*dot(chord,chord)
? side*inversesqrt(square)
: ribbon.axis;
float seen=dot(ribbon.axis,across);
section.wide*=abs(seen);
section.drawn=max(section.wide,minWidth*distance);
vec3 outwards=outwardsOf(across,cross(ray,ribbon.v1 - ribbon.v0));
vec3 grown =
(0.5f*(section.drawn - section.wide)*(seen<0.0f?-1.0f:1.0f))*outwards;
section.left-=grown;
section.right+=grown;
}
section.ridge=0.5f*(section.left+section.right);
if (ribbon.fold>0.0f)
section.ridge +=
(0.5f*ribbon.fold*(edges.y - edges.x))*normalize(cross(direction,ribbon.axis));
return section;
}
float sectionMargin(float distance,float minWidth)
{
return minWidth*distance;
}
float marginBeside(float width,float distance,float minWidth)
{
return 0.5f*outlineMost*width+sectionMargin(distance,minWidth);
}
struct SampleMask {
float threshold;
uint first;
uint samples;
};
SampleMask sampleMaskOf(uint seed,uint samples)
{
SampleMask mask;
mask.threshold=(float(seed & 0x1fffu)+0.5f)/8192.0f;
mask.first=(seed >> 13u) % samples;
mask.samples=samples;
return mask;
}
uint keptCount(SampleMask mask,float weight)
{
return weight<1.0f?uint(max(weight,0.0f)*float(mask.samples)+mask.threshold)
: mask.samples;
}
uint keptBits(SampleMask mask,float weight)
{
uint all=(1u << mask.samples) - 1u;
uint bits=(1u << min(keptCount(mask,weight),mask.samples)) - 1u;
return ((bits << mask.first) | (bits >> (mask.samples - mask.first))) & all;
}
uint keptSamples(float weight,uint seed,uint samples)
{
return keptBits(sampleMaskOf(seed,samples),weight);
}
#endif
`,
  // shaders/shared/visibility.h
  `struct Verdict {
uint cullResult;
float widthFactor;
float pixels;
float margin;
};
float sparseShare(Eyepoint view,float share,float distance)
{
if (view.sparseFrom<=0.0f||distance<=view.sparseFrom)
return 1.0f;
float nearness=view.sparseFrom/distance;
return max(nearness*nearness*nearness,min(view.sparseLeast/share,1.0f));
}
float leavesPerDrawn(Eyepoint view,float distance)
{
if (view.sparseFrom<=0.0f||distance<=view.sparseFrom||view.lodThreshold<=0.0f)
return 1.0f;
float share =
lodShare(view.lodWidth*view.pixelsPerUnit/max(distance,1e-6f),view.lodThreshold);
return 1.0f/sqrt(sparseShare(view,share,distance));
}
float shareAt(Eyepoint view,float distance)
{
if (view.lodThreshold<=0.0f)
return lodFullShare;
float share =
lodShare(view.lodWidth*view.pixelsPerUnit/max(distance,1e-6f),view.lodThreshold);
return share*sparseShare(view,share,distance);
}
float middleWidth(Patch cell)
{
return cell.widthLow+31.5f*cell.widthStep;
}
float leafAreaAround(Patch cell)
{
uint fewest=4u;
if (cell.bladeCount<fewest)
return 0.0f;
float count=float(cell.bladeCount);
float side=65535.0f*cell.rootStep*(count+1.0f)/(count - 1.0f);
float around=count/max(cell.rankHigh - cell.rankLow,1e-6f);
float height=cell.heightLow+127.5f*cell.heightStep;
return min(0.7f*around*middleWidth(cell)*height/max(side*side,1e-12f),maxLeafArea);
}
float steepestRay(vec3 eye,Patch cell)
{
vec3 low=cell.boundsLow - eye;
vec3 high=cell.boundsHigh - eye;
vec3 middle=0.5f*(low+high);
float above =
abs(dot(cell.coneAxis,middle))+dot(abs(cell.coneAxis),0.5f*(high - low));
float nearest=max(boxDistance(eye,cell.boundsLow,cell.boundsHigh),1e-6f);
float slope=sqrt(max(1.0f - cell.coneCosine*cell.coneCosine,0.0f));
return min(above/nearest+max(slope - octahedralMaxError,0.0f),1.0f);
}
struct LeafAreaLimit {
float share;
float height;
float light;
};
LeafAreaLimit noLeafAreaLimit()
{
LeafAreaLimit limit;
limit.share=lodFullShare;
limit.height=1.0f;
limit.light=1.0f;
return limit;
}
LeafAreaLimit leafAreaLimitOf(Eyepoint view,Patch cell)
{
LeafAreaLimit limit=noLeafAreaLimit();
if (view.maxLeafArea<=0.0f)
return limit;
float nearest=max(boxDistance(view.eye,cell.boundsLow,cell.boundsHigh),1e-6f);
float pixels=middleWidth(cell)*view.pixelsPerUnit/nearest;
if (leafAreaShare(view.maxLeafArea,maxLeafArea,0.0f,pixels)>=lodFullShare)
return limit;
float leafArea=min(view.areaFactor*leafAreaAround(cell),maxLeafArea);
float cosine=steepestRay(view.eye,cell);
limit.share=leafAreaShare(view.maxLeafArea,leafArea,cosine,pixels);
float range=255.0f*cell.heightStep;
float spread=min(2.0f*range/max(cell.heightLow+range,1e-6f),1.0f);
limit.height =
heightCompensation(limit.share,leafAreaShare(1.0f,leafArea,cosine,1.0f),spread);
limit.light=leafAreaLight(limit.share,spread);
return limit;
}
Blade raised(Blade blade,float heightFactor)
{
Blade drawn=blade;
drawn.height=blade.height*heightFactor;
return drawn;
}
struct DrawnSize {
float widthFactor;
float pixels;
};
DrawnSize drawnSize(Eyepoint view,LeafAreaLimit limit,Blade blade,float rank,
float distance)
{
float share=shareAt(view,distance);
DrawnSize size;
size.widthFactor=lodWidthFactor(rank,share)/leavesPerDrawn(view,distance) *
leafAreaWeight(rank/min(share,1.0f),limit.share);
size.pixels=blade.height*view.pixelsPerUnit/max(distance,1e-6f);
return size;
}
float pixelsCovered(Blade blade,float height,float widthFactor)
{
return height*height*widthFactor*blade.width/blade.height;
}
float bladeRank(Patch cell,uint i)
{
return mix(cell.rankLow,cell.rankHigh,(float(i)+0.5f)/float(cell.bladeCount));
}
float patchMargin(Eyepoint view,Patch cell,float widest)
{
vec3 farthest=max(abs(cell.boundsLow - view.eye),abs(cell.boundsHigh - view.eye));
float share=shareAt(view,length(farthest));
vec3 size=cell.boundsHigh - cell.boundsLow;
float highest=0.5f*min(size.x,min(size.y,size.z));
return 0.5f*outlineMost*widest/(0.95f*share*leavesPerDrawn(view,length(farthest))) +
sectionMargin(length(farthest),view.minWidth) +
(view.maxLeafArea>0.0f?(maxHeightCompensation - 1.0f)*highest:0.0f);
}
uint thickEnough(Eyepoint view,Patch cell)
{
if ((view.cullMask & leaveThinned)==0u||view.lodThreshold<=0.0f)
return cell.bladeCount;
float thinned=shareAt(view,boxDistance(view.eye,cell.boundsLow,cell.boundsHigh));
float share=min(thinned,min(thinned,1.0f)*leafAreaLimitOf(view,cell).share);
if (share<=cell.rankLow)
return 0u;
if (share>=cell.rankHigh)
return cell.bladeCount;
float count=float(cell.bladeCount);
float first=(share - cell.rankLow)/(cell.rankHigh - cell.rankLow)*count;
return min(uint(ceil(first))+1u,cell.bladeCount);
}
bool thinnedBelow(Eyepoint view,Patch cell,float rankBelow)
{
return (view.cullMask & leaveThinned)!=0u&&view.lodThreshold>0.0f &&
shareAt(view,boxDistance(view.eye,cell.boundsLow,cell.boundsHigh))<=rankBelow;
}
bool patchCulled(Eyepoint view,Patch cell,float widest)
{
if ((view.cullMask & cullPatch)==0u)
return false;
float margin=patchMargin(view,cell,widest);
vec3 low=cell.boundsLow - vec3(margin);
vec3 high=cell.boundsHigh+vec3(margin);
bool outside=false;
for (uint i=0u; i<6u; ++i) outside =
outside||boxOutside(view.planes[i],low,high);
if (outside)
return true;
return (view.cullMask & cullDistance)!=0u &&
boxDistance(view.eye,cell.boundsLow,cell.boundsHigh)>view.drawDistance;
}
bool seenTooNarrow(Eyepoint view,PosedBlade posed,float widthFactor)
{
Blade blade=posed.blade;
float distance=length(posed.v0 - view.eye);
float cosine=edgeOnCosine(view.eye,posed.v0,posed.axis);
if (cosine>view.maxEdgeOn)
return true;
float nearest=distance - blade.height;
if (nearest<=0.0f||view.minWidth<=0.0f)
return false;
float sine=min(sqrt(1.0f - cosine*cosine)+1.58f*blade.height/distance,1.0f);
float widest=outlineMost*blade.width*widthFactor*sine;
return keptSamples(widest/(view.minWidth*nearest),blade.seed,view.samples)==0u;
}
Verdict cullBlade(Eyepoint view,LeafAreaLimit limit,PosedBlade posed,float rank)
{
Blade blade=posed.blade;
float distance=length(blade.root - view.eye);
DrawnSize size=drawnSize(view,limit,blade,rank,distance);
float factor=size.widthFactor;
Verdict verdict;
verdict.cullResult=cullResultDrawn;
verdict.widthFactor=factor;
verdict.pixels=size.pixels;
verdict.margin=0.5f*outlineMost*blade.width*max(factor,1.0f) +
sectionMargin(distance+blade.height,view.minWidth);
bool outside=false;
if ((view.cullMask & cullFrustum)!=0u)
for (uint i=0u; i<6u; ++i) outside =
outside||curveOutside(view.planes[i],posed.v0,posed.v1,posed.v2,verdict.margin);
if ((view.cullMask & cullOrientation)!=0u &&
seenTooNarrow(view,posed,factor>0.0f?factor:1.0f))
verdict.cullResult=cullResultOrientation;
else if (outside)
verdict.cullResult=cullResultFrustum;
else if ((view.cullMask & cullDistance)!=0u &&
(distance>view.drawDistance ||
!bucketsKeep(view.buckets,view.bucketDistance,distance,rank)))
verdict.cullResult=cullResultDistance;
else if (factor<=0.0f)
verdict.cullResult=cullResultLod;
if (verdict.cullResult!=cullResultDrawn)
verdict.widthFactor=0.0f;
return verdict;
}
#endif
`,
  // web/shaders/move.vert
  `uniform float elapsed;
uniform float stateRows;
flat out uint outTurn;
void main()
{
outTurn=0u;
gl_PointSize=1.0;
gl_Position=vec4(2.0,2.0,2.0,1.0);
if (uint(gl_VertexID)>=group.z)
return;
Patch cell=fetchPatchArray(group.x);
uint index=cell.firstBlade+group.y+uint(gl_VertexID);
Blade blade=unpackBlade(fetchBladeArray(index),cell);
uint before=fetchUintArray(index);
bool isNew=before==unsettledTurn;
BladeState state=BladeState(isNew?0u:before,0.0);
ColliderMask none;
outTurn=before;
float since=isNew?settlingTime:elapsed;
if (since>0.0)
outTurn=advanceBlade(blade,FRAME.environment,none,state,0.0,since).turn;
ivec2 place=placeInTable(index);
gl_Position=vec4((vec2(place)+0.5)/vec2(float(tableWidth),stateRows)*2.0 - 1.0,0.0,1.0);
}
`,
  // web/shaders/move.frag
  `flat in uint outTurn;
layout(location=0) out uint turn;
void main()
{
turn=outTurn;
}
`,
  // shaders/blade/blade_colors.glsl
  `#ifndef SWARD_BLADE_BLADE_COLORS_GLSL
#define SWARD_BLADE_BLADE_COLORS_GLSL
`,
  // shaders/blade/blade_surface.glsl
  `#ifndef SWARD_BLADE_BLADE_SURFACE_GLSL
#define SWARD_BLADE_BLADE_SURFACE_GLSL
`,
  // shaders/common/lighting.glsl
  `#ifndef SWARD_COMMON_LIGHTING_GLSL
#define SWARD_COMMON_LIGHTING_GLSL
`,
  // shaders/common/output_mode.glsl
  `#ifndef SWARD_COMMON_OUTPUT_MODE_GLSL
#define SWARD_COMMON_OUTPUT_MODE_GLSL
`,
  // shaders/shared/constants.h
  `#ifndef SWARD_SHARED_CONSTANTS_H
#define SWARD_SHARED_CONSTANTS_H
`,
  // shaders/shared/constants.h
  `const uint idKnownDebugMode=0u;
const uint idSamplesPerPixel=1u;
const uint idHasForwardZ=2u;
const uint idOutputMode=3u;
const uint idWritesMotion=4u;
const uint idStoredAs=5u;
const uint idIsPaged=6u;
const uint idOnlyShape=7u;
const uint idMayFold=8u;
const uint idMayHaveOrgans=9u;
const uint idRole=10u;
const uint idTakes=11u;
const uint idFeatures=12u;
const uint idWindCounts=13u;
const uint idHasColliders=14u;
const uint idKeepsBefore=15u;
const uint idKeepsEtas=16u;
const uint idTestsSmall=17u;
const uint idPatchesOfGroup=18u;
const uint idThreadsOfGroup=19u;
const uint idLargeTo=20u;
const uint idFillsAll=21u;
const uint idIsOfColliders=22u;
const uint idDrawsSunMap=23u;
const uint idWritesDraws=24u;
const uint idTileList=25u;
const uint idShowsBlades=26u;
const uint idShowsSky=27u;
const uint idHasShadingCache=28u;
const uint idHasHostLight=29u;
const uint idLimitsLeafArea=30u;
const uint debugNothing=0u;
const uint debugWind=3u;
const uint debugAsTold=0xffffffffu;
const uint outputFilm=0u;
const uint outputHost=1u;
const uint outputRadiance=2u;
const uint outputNone=3u;
#endif
`,
  // shaders/common/output_mode.glsl
  `const uint outputMode=0u;
#endif
`,
  // shaders/shared/distance_band.h
  `#ifndef SWARD_SHARED_DISTANCE_BAND_H
#define SWARD_SHARED_DISTANCE_BAND_H
`,
  // shaders/shared/distance_band.h
  `const uint distanceBands=8u;
const uint debugNear=5u;
uint distanceBand(float distance,float farthest)
{
float nearest=min(2.0f,0.01f*farthest);
float share=log2(max(distance,nearest)/nearest)/log2(farthest/nearest);
return min(uint(float(distanceBands)*share),distanceBands - 1u);
}
#endif
`,
  // shaders/shared/look/blade_colors.h
  `#ifndef SWARD_SHARED_LOOK_BLADE_COLORS_H
#define SWARD_SHARED_LOOK_BLADE_COLORS_H
`,
  // shaders/shared/look/blade_colors.h
  `struct BladeColors {
vec3 root;
vec3 tip;
};
const vec3 throughTint=vec3(1.25f,1.15f,0.45f);
const float throughShare=0.8f;
float tipShareAt(float along)
{
return smoothstep(-0.15f,0.8f,along);
}
vec3 decodeSrgb(vec3 c)
{
return mix(c/12.92f,pow((c+0.055f)/1.055f,vec3(2.4f)),greaterThan(c,vec3(0.04045f)));
}
float chance(uint key)
{
return float(mixUint(key) >> 8u)*(1.0f/16777215.0f);
}
float meadowAt(vec3 position)
{
return 0.65f*valueNoise(position/2.3f)+0.35f*valueNoise(position/0.7f);
}
float regionAt(vec3 position)
{
return valueNoise(position/13.0f+71.0f);
}
vec3 shiftOf(float hue)
{
return vec3(1.0f+0.75f*hue,1.0f+0.10f*hue,1.0f - 0.45f*hue);
}
float clumpTone(uint clump)
{
return chance(clump*977u+11u);
}
vec3 meadowShade(vec3 position,float tone)
{
float meadow=meadowAt(position);
float region=regionAt(position);
float hue =
0.45f*(0.7f*(tone - 0.5f)+1.1f*(meadow - 0.5f)+1.2f*(region - 0.5f));
float light=1.0f+0.45f*(0.6f*(tone - 0.5f)+0.5f*(meadow - 0.5f) +
0.4f*(region - 0.5f));
return light*shiftOf(hue);
}
BladeColors bladeColors(Cover cover,Blade blade,Species species,float leafArea)
{
float clump=clumpTone(blade.clump);
uint kept=uint(blade.facing*(256.0f/twoPi)+0.5f) |
(uint(blade.stiffness*63.0f+0.5f) << 8u) |
(uint(blade.tint.y*63.0f+0.5f) << 14u) | (blade.clump << 20u);
float single=chance(kept*16u+blade.hash);
float other=chance(kept*16u+blade.hash+0x9e3779b9u);
float meadow=meadowAt(blade.root);
float region=regionAt(blade.root);
float amount=species.colorVariation;
float light=1.0f+amount*(0.9f*(single - 0.5f)+0.6f*(clump - 0.5f) +
0.5f*(meadow - 0.5f)+0.4f*(region - 0.5f));
float hue=amount*(0.7f*(clump - 0.5f)+0.5f*(other - 0.5f) +
1.1f*(meadow - 0.5f)+1.2f*(region - 0.5f));
vec3 shift=shiftOf(hue);
BladeColors colors;
vec3 ground=groundUnder(cover,decodeSrgb(blade.tint),shift,cover.thinned*leafArea);
colors.root=mix(species.rootColor*shift,ground,species.groundTint)*light;
colors.tip=species.tipColor*shift*light;
float dead=blade.clump==driedClump?1.0f:0.0f;
float dry =
max(smoothstep(0.0f,0.25f,species.dryness*(0.6f+0.8f*meadow) - other),dead);
vec3 straw=vec3(0.42f,0.32f,0.13f)*(0.7f+0.6f*single);
colors.tip=mix(colors.tip,straw,0.8f*dry);
colors.root=mix(colors.root,straw*0.6f,0.25f*dry+0.3f*dead);
return colors;
}
#endif
`,
  // shaders/shared/look/film_curve.h
  `#ifndef SWARD_SHARED_LOOK_FILM_CURVE_H
#define SWARD_SHARED_LOOK_FILM_CURVE_H
`,
  // shaders/shared/look/film_curve.h
  `vec3 filmOf(vec3 exposed)
{
vec3 x=exposed*0.80f;
vec3 film=(x*(2.51f*x+0.03f))/(x*(2.43f*x+0.59f)+0.14f);
return clamp(film,0.0f,1.0f);
}
#endif
`,
  // shaders/shared/passes.h
  `const uint bladeShadowSegments=8u;
`,
  // shaders/common/lighting.glsl
  `#ifndef FRAME
#define FRAME push.frame.at[0]
#endif
#ifndef WIND_SOURCE
#define WIND_SOURCE(wind, i) FRAME.environment.wind.sources[i]
#define WIND_PHASE(wind, i) FRAME.environment.wind.phases[i]
#define WIND_LATTICE(wind) FRAME.environment.wind.lattice
#endif
`,
  // shaders/common/lighting.glsl
  `const uint knownDebugMode=0u;
const bool paintsWind=knownDebugMode==debugWind;
uint debugMode()
{
return knownDebugMode==debugAsTold?FRAME.debugMode:knownDebugMode;
}
bool showsBands()
{
return debugMode()>=debugNear;
}
float luminance(vec3 color)
{
return dot(color,vec3(0.2126,0.7152,0.0722));
}
vec3 paleSky(float sunCosine)
{
float towards=0.5+0.5*sunCosine;
vec3 pale=mix(vec3(1.12,1.02,0.90),vec3(1.36,1.12,0.96),FRAME.lowSun);
return FRAME.skyColor*mix(pale,vec3(2.50,1.45,0.66),FRAME.lowSun*towards*towards);
}
vec3 glowAround(float sunCosine)
{
float toSun=max(sunCosine,0.0);
float glow=0.10*pow(toSun,4.0)+0.22*pow(toSun,32.0)+0.5*pow(toSun,400.0);
return glow*FRAME.sunColor*mix(vec3(0.36,0.34,0.31),vec3(0.45,0.33,0.22),FRAME.lowSun);
}
vec3 skyAbove(float height,float sunCosine)
{
vec3 zenith=FRAME.skyColor*vec3(0.15,0.30,0.56);
return mix(paleSky(sunCosine),zenith,1.0 - exp(-4.0*height))+glowAround(sunCosine);
}
vec3 skyRadiance(vec3 ray)
{
float height=dot(ray,FRAME.skyUp);
float sunCosine=dot(ray,FRAME.sunDirection);
if (height>=0.0)
return skyAbove(height,sunCosine);
vec3 pale=paleSky(sunCosine);
vec3 haze=mix(0.85*pale,FRAME.groundColor,0.2);
return mix(pale,haze,1.0 - exp(2.2*height))+glowAround(sunCosine);
}
vec3 hemisphere(vec3 n)
{
return mix(FRAME.groundColor,1.25*FRAME.skyColor,0.5+0.5*dot(n,FRAME.skyUp));
}
const float passedAgain=0.5;
vec3 lightAmongLeaves(float leafArea,float below,float cosine,vec3 sun,vec3 sky,vec3 leaf)
{
float risen=max(cosine,lowestSun);
float crossed=leafProjectionAlong(leafProjectionOf(FRAME.cover),risen)/risen;
float left=exp(-crossed*leafArea);
float open=skyBelow(leafArea);
float leftAbove=leafArea>1e-3?(1.0 - left)/(crossed*leafArea):1.0;
float openAbove=leafArea>1e-3?(1.0 - open)/(skyExtinction*leafArea):1.0;
float leaves=1.0 - open;
float sunOfLeaves=leaves*leftAbove+below*left/(1.0+crossed/skyExtinction);
float skyOfLeaves=leaves*openAbove+below*open*0.5;
vec3 once=0.25*leaf*(sun*(crossed*risen*sunOfLeaves)+sky*skyOfLeaves);
return once/(1.0 - passedAgain*leaf);
}
float clearBetween(float climb,float distance)
{
float rise=FRAME.fogFalloff*distance*climb;
float mean=abs(rise)>1e-3?(1.0 - exp(-rise))/rise:1.0 - 0.5*rise;
return exp(-FRAME.fogDensity*distance*mean);
}
vec3 throughAir(vec3 color,vec3 direction,float distance)
{
float climb=dot(direction,FRAME.skyUp);
float perLength=inversesqrt(max(1.0 - climb*climb,0.0)+0.02*0.02);
float sunCosine=dot(direction,FRAME.sunDirection) -
(climb - 0.02)*dot(FRAME.skyUp,FRAME.sunDirection);
return mix(skyAbove(0.02*perLength,sunCosine*perLength),color,clearBetween(climb,distance));
}
vec3 develop(vec3 radiance)
{
if (outputMode==outputRadiance)
return radiance*FRAME.exposure;
return filmOf(radiance*FRAME.exposure);
}
float softness(float distance,float share)
{
if (FRAME.view.minWidth<=0.0||debugMode()!=debugNothing)
return 0.0;
float widthPixels=FRAME.view.lodWidth*FRAME.view.pixelsPerUnit/max(distance,1e-6);
return share*(1.0 - smoothstep(0.6,1.5,widthPixels));
}
vec3 dithered(vec3 color,vec2 place)
{
if (outputMode==outputRadiance)
return color;
uint h=mixUint(uint(place.x)+65536u*uint(place.y));
float noise=float(h >> 8u)*(1.0/16777215.0) - 0.5;
return color+noise*(2.2/255.0)*pow(max(color,0.0),vec3(0.5454));
}
vec3 colorOf(uint number)
{
uint h=mixUint(number*2654435761u+12345u);
return 0.15+0.85*vec3(h & 255u,(h >> 8u) & 255u,(h >> 16u) & 255u)/255.0;
}
vec3 colorOfWind(vec3 position,vec3 up)
{
vec3 wind=windAt(FRAME.environment.wind,position,up,0.0);
float speed=clamp(length(wind)/max(FRAME.environment.wind.sum,1e-6),0.0,1.0);
return mix(mix(vec3(0.01,0.03,0.20),vec3(0.02,0.45,0.15),smoothstep(0.0,0.45,speed)),
vec3(1.0,0.95,0.8),smoothstep(0.35,1.0,speed));
}
#endif
`,
  // shaders/blade/blade_surface.glsl
  `struct BladeSurface {
vec4 root;
vec4 tip;
vec4 material;
};
float packedLook(vec3 look)
{
vec3 bytes=floor(clamp(look,0.0,1.0)*255.0+0.5);
return dot(bytes,vec3(65536.0,256.0,1.0));
}
vec3 unpackedLook(float packed)
{
uint bits=uint(packed);
return vec3(uvec3(bits >> 16u,bits >> 8u,bits) & 255u)/255.0;
}
float packedHeights(vec3 steps)
{
return packedLook(steps/float(heightSteps));
}
float leafAreaAbove(vec4 material,float along)
{
vec3 steps=float(heightSteps)*unpackedLook(material.z);
float height=mix(mix(steps.x,steps.y,along),mix(steps.y,steps.z,along),along);
return material.y*leafShareAbove(FRAME.cover,height);
}
float packedFinish(uint finish,float pixels)
{
return floor(clamp(pixels*4.0,0.0,255.0)+0.5)+256.0*float(finish);
}
uint finishIn(float packed)
{
return uint(packed) >> 8u;
}
float pixelsIn(float packed)
{
return 0.25*float(uint(packed) & 255u);
}
float fleckLength()
{
return 1.5/max(FRAME.cover.stepsPerMetre,1e-6);
}
float fleckCount(float length_)
{
return clamp(floor(length_/fleckLength()+0.5),1.0,255.0);
}
#endif
`,
  // shaders/blade/drawn_blade.glsl
  `#ifndef SWARD_BLADE_DRAWN_BLADE_GLSL
#define SWARD_BLADE_DRAWN_BLADE_GLSL
`,
  // shaders/blade/known_shape.glsl
  `#ifndef SWARD_BLADE_KNOWN_SHAPE_GLSL
#define SWARD_BLADE_KNOWN_SHAPE_GLSL
`,
  // shaders/blade/known_shape.glsl
  `const uint onlyShape=shapeCount;
uint knownShape(uint shape)
{
return onlyShape<shapeCount?onlyShape:shape;
}
#endif
`,
  // shaders/blade/pages.glsl
  `uint placeOf(uvec2 pages,uint blade) { return blade; }
`,
  // shaders/blade/drawn_blade.glsl
  `#ifndef FRAME
#define FRAME push.frame.at[0]
#endif
const bool mayHaveOrgans=true;
struct DrawnBlade {
Ribbon ribbon;
Blade blade;
Species species;
};
struct PosedLook {
PosedBlade posed;
Species look;
uint number;
};
PosedLook posedLook(Blade blade,BladeState state)
{
PosedLook part=PosedLook(posedBlade(blade,state),fetchSpeciesArray(uint(blade.species)),0u);
if (!mayHaveOrgans||part.look.organKinds==0u)
return part;
part.number=blade.clump;
if (part.number>0u) {
uint within;
OrganTable organs=OrganTable(0u);
Organ organ=fetchOrganTable(uint(organOf(organs,part.look,part.number,within)));
part.posed=posedRibbon(part.posed,organ,part.number,within);
part.look=organ.look;
}
part.posed.blade.clump=plantKey(blade) % driedClump;
return part;
}
float maxReach(Blade blade)
{
return (mayHaveOrgans?2.3:1.0)*blade.height;
}
float segmentsOf(Ribbon ribbon,float height,uint shape,float heightPixels,float widthPixels)
{
if (FRAME.fixedTessellation>0.0)
return clamp(FRAME.fixedTessellation,1.0,64.0);
if (FRAME.levelSteps.count>0u)
return segmentsAt(FRAME.levelSteps,length(ribbon.v0 - FRAME.view.eye));
return segmentsFor(ribbon.v0,ribbon.v1,ribbon.v2,height,shape,heightPixels,widthPixels,
float(FRAME.maxTessellation));
}
DrawnBlade drawnBlade(VisibleBlade visible,PosedLook part)
{
Species species=part.look;
PosedBlade posed=part.posed;
DrawnBlade drawn;
drawn.blade=posed.blade;
drawn.species=species;
float height=posed.blade.height;
Ribbon ribbon;
ribbon.v0=posed.v0;
ribbon.v1=posed.v1;
ribbon.v2=posed.v2;
ribbon.axis=posed.axis;
ribbon.width=posed.blade.width*widthFactorOf(visible);
float widthPixels=visible.pixels*ribbon.width/height;
ribbon.fold=foldOf(species.fold,widthPixels);
uint shape=knownShape(species.shape);
ribbon.outline=outlineOf(shape,species.tipThreshold,
segmentsOf(ribbon,height,shape,visible.pixels,widthPixels));
ribbon.seed=posed.blade.seed;
drawn.ribbon=ribbon;
return drawn;
}
DrawnBlade drawnBlade(VisibleBlade visible,Blade blade,BladeState state)
{
return drawnBlade(visible,posedLook(blade,state));
}
BladeState stateOf(VisibleBlade visible)
{
return BladeState(fetchUintArray(uint(placeOf(uvec2(0u),visible.blade))),0.0);
}
Blade visibleBlade(VisibleBlade visible)
{
Blade blade=unpackBlade(fetchBladeArray(uint(placeOf(uvec2(0u),visible.blade))),
fetchPatchArray(uint(visible.patchIndex)));
return raised(blade,heightFactorOf(visible));
}
DrawnBlade drawnBlade(VisibleBlade visible)
{
return drawnBlade(visible,visibleBlade(visible),stateOf(visible));
}
#endif
`,
  // shaders/shared/cull_result_color.h
  `#ifndef SWARD_SHARED_CULL_RESULT_COLOR_H
#define SWARD_SHARED_CULL_RESULT_COLOR_H
`,
  // shaders/shared/cull_result_color.h
  `const uint debugReason=4u;
vec3 cullResultColor(uint cullResult)
{
if (cullResult==cullResultDrawn)
return vec3(0.06f,0.34f,0.12f);
if (cullResult==cullResultPatch)
return vec3(0.30f,0.30f,0.33f);
if (cullResult==cullResultOrientation)
return vec3(0.86f,0.77f,0.05f);
if (cullResult==cullResultFrustum)
return vec3(0.66f,0.11f,0.01f);
if (cullResult==cullResultDistance)
return vec3(0.02f,0.17f,0.45f);
if (cullResult==cullResultOcclusion)
return vec3(0.60f,0.19f,0.38f);
return vec3(0.09f,0.46f,0.81f);
}
#endif
`,
  // shaders/shared/look/leaf_finish.h
  `#ifndef SWARD_SHARED_LOOK_LEAF_FINISH_H
#define SWARD_SHARED_LOOK_LEAF_FINISH_H
`,
  // shaders/shared/look/leaf_finish.h
  `const uint finishGrass=0u;
const uint finishBroad=1u;
const uint finishPetal=2u;
const uint finishStalk=3u;
const uint finishPlain=4u;
uint finishOf(Species look)
{
if (look.shape==shapeQuad)
return finishStalk;
if (look.shape!=shapeLeaf&&look.shape!=shapeDandelion)
return finishGrass;
return look.tipColor.y>max(look.tipColor.x,look.tipColor.z)?finishBroad:finishPetal;
}
float finishDice(uint seed)
{
return float(seed & 255u)*(1.0f/255.0f);
}
float endWave(float away,float falls)
{
float rest=max(1.0f - away,0.0f);
return rest*rest*(1.0f - falls*away);
}
vec3 toneAlong(uint finish,float along,uint seed)
{
if (finish==finishBroad||finish==finishPlain)
return vec3(1.0f);
if (finish==finishPetal)
return vec3(1.0f) -
endWave(min(along*(1.0f/0.6f),1.0f),2.5f)*vec3(0.12f,0.22f,0.42f);
vec3 tone =
vec3(1.0f)+endWave(min(along*2.5f,1.0f),4.0f)*vec3(0.75f,0.3f,0.55f);
if (finish==finishStalk)
return tone;
float dry=smoothstep(0.3f,1.0f,finishDice(seed));
return tone+(dry*endWave(min(2.2f - 2.2f*along,1.0f),2.5f))*vec3(0.12f,-0.2f,-0.35f);
}
struct Veins {
vec3 tone;
float slope;
};
float midribAt(float x,float reach)
{
float off=x/reach;
float rest=max(1.0f - off*off,0.0f);
return rest*rest - (8.0f/15.0f)*reach;
}
float shareSeen(float spacing)
{
return smoothstep(2.5f,5.0f,spacing);
}
const float halfWave=3.14159265f;
Veins veinsAt(uint finish,vec2 place,float pixels,uint seed)
{
float x=place.x;
float t=place.y;
Veins veins;
veins.tone=vec3(1.0f);
veins.slope=0.0f;
float wide =
finish==finishStalk
? pixels
: pixels*min(1.0f,finish==finishGrass?2.0f - 2.0f*t:4.0f*t*(1.0f - t));
float ridge=shareSeen(0.6f*wide);
float phase=40.0f*finishDice(seed);
if (finish==finishGrass) {
float few=shareSeen(wide/7.0f);
float many=shareSeen(wide/17.0f);
float a=7.0f*halfWave*x+phase;
float b=17.0f*halfWave*x+2.0f*phase;
veins.tone+=(ridge*midribAt(x,0.16f))*vec3(0.45f,0.36f,0.8f) +
0.09f*few*cos(a)+0.07f*many*cos(b);
veins.slope=0.16f*few*sin(a)+0.14f*many*sin(b);
} else if (finish==finishBroad) {
float a=2.0f*halfWave*(7.0f*t - abs(x))+phase;
float side=shareSeen(0.3f*wide);
veins.tone+=(ridge*midribAt(x,0.1f))*vec3(0.5f,0.42f,0.7f) +
side*(0.1f*cos(a)+0.06f*cos(2.0f*a)+0.03f*cos(3.0f*a));
veins.slope=0.12f*side*sin(a)*sign(x);
} else if (finish==finishPetal) {
float a=5.0f*halfWave*x+phase;
float b=13.0f*halfWave*x+2.0f*phase;
float few=shareSeen(wide/5.0f);
float many=shareSeen(wide/13.0f);
veins.tone+=0.07f*few*cos(a)+(0.08f*(1.0f - 0.5f*t))*many*cos(b);
veins.slope=0.3f*few*sin(a)+0.15f*many*sin(b);
} else if (finish==finishStalk) {
float a=4.0f*halfWave*x+phase;
float few=shareSeen(0.4f*wide);
veins.tone+=0.1f*few*cos(a);
veins.slope=0.12f*few*sin(a);
}
return veins;
}
const float roughnessAcross=0.46f;
const float roughnessAlong=0.18f;
const float mirroredHeadOn=0.019f;
float coatShine(vec3 normal,vec3 tangent,vec3 source,vec3 eye)
{
float facing=dot(normal,source);
vec3 sum=source+eye;
float along=dot(sum,tangent);
float up=dot(sum,normal);
if (facing<=0.0f||up<=0.0f)
return 0.0f;
float square=dot(sum,sum);
float across=max(square - up*up - along*along,0.0f);
float depth=max(up*up,0.0625f);
float slopes=(along*along*(1.0f/(roughnessAlong*roughnessAlong)) +
across*(1.0f/(roughnessAcross*roughnessAcross))) /
depth;
float grazing=max(1.0f - 0.5f*sqrt(square),0.0f);
float twice=grazing*grazing;
float fresnel=mirroredHeadOn+(1.0f - mirroredHeadOn)*twice*twice*grazing;
return facing*fresnel*exp(-slopes)*square /
(roughnessAcross*roughnessAlong*depth*depth);
}
float coatAlbedo(float cosine)
{
float grazing=1.0f - clamp(cosine,0.1f,1.0f);
float twice=grazing*grazing;
return 0.017f+0.3f*twice*twice;
}
#endif
`,
  // shaders/blade/blade_colors.glsl
  `BladeSurface liftedSurface(BladeSurface surface,float above)
{
float root=1.0 - heightWithLeafShare(above);
surface.root=vec4(mix(surface.root.rgb,surface.tip.rgb,tipShareAt(root)),mix(surface.root.w,surface.tip.w,root));
surface.material.y*=above;
return surface;
}
BladeSurface bladeSurface(DrawnBlade drawn,VisibleBlade visible,LeafAreaLimit limit)
{
Blade blade=drawn.blade;
Species species=drawn.species;
vec3 grass=grassAt(FRAME.cover,blade.root);
float leafArea=grass.x;
BladeColors colors=bladeColors(FRAME.cover,blade,species,leafArea);
if (debugMode()==1u)
colors.tip=mix(vec3(0.1,0.6,0.1),vec3(1.0,0.1,0.0),
clamp(log2(max(widthFactorOf(visible),1.0))/4.0,0.0,1.0));
else if (debugMode()==2u)
colors.tip=colorOf(visible.patchIndex);
else if (debugMode()==debugReason)
colors.tip=cullResultColor(fetchUintArray(uint(placeOf(uvec2(0u),visible.blade))));
if (paintsWind)
colors.tip=colorOfWind(blade.root,blade.up);
if (debugMode()!=debugNothing)
colors.root=0.4*colors.tip;
float risen=smoothstep(-0.15,0.25,dot(blade.up,FRAME.sunDirection));
BladeSurface surface;
surface.root=vec4(colors.root,risen*sunSeen(FRAME.shadow,drawn.ribbon.v0,blade.up));
surface.tip=vec4(colors.tip,risen*sunSeen(FRAME.shadow,drawn.ribbon.v2,blade.up));
vec3 heights=vec3(dot(drawn.ribbon.v0 - blade.root,blade.up),dot(drawn.ribbon.v1 - blade.root,blade.up),
dot(drawn.ribbon.v2 - blade.root,blade.up));
float missing=leavesPerDrawn(FRAME.view,distance(blade.root,FRAME.view.eye));
surface.material=vec4(packedLook(vec3(blade.exposure,species.translucency,species.gloss)),
leavesAround(leafArea/missing,FRAME.cover.thinned*missing),
packedHeights(heightStepsPerMetre(FRAME.cover,grass)/heightFactorOf(visible)*heights),
packedFinish(finishOf(species),visible.pixels*drawn.ribbon.width/blade.height));
if (limit.light<1.0) return liftedSurface(surface,limit.light); return surface;
}
#endif
`,
  // web/shaders/pose.vert
  `uniform float maxSegments;
flat out uvec4 recordV0;
flat out uvec4 recordV1;
flat out uvec4 recordV2;
flat out uvec4 recordSurface;
flat out uvec4 recordFrame;
flat out uvec4 recordBend;
void keep(DrawnBlade drawn,BladeSurface surface,uint index)
{
Ribbon ribbon=drawn.ribbon;
vec3 lower=normalize(ribbon.v1 - ribbon.v0);
float size=max(length(ribbon.v1 - ribbon.v0),1e-9);
vec3 upperWay=(ribbon.v2 - ribbon.v1)/size;
vec3 upper=dot(upperWay,upperWay)>1e-6?upperWay:1e-3*lower;
float bend=length(upper);
recordV0=uvec4(floatBitsToUint(ribbon.v0),floatBitsToUint(ribbon.width));
recordV1=uvec4(floatBitsToUint(ribbon.v1),packHalf2x16(vec2(ribbon.outline.tipThreshold,ribbon.outline.scale)));
recordV2=uvec4(floatBitsToUint(ribbon.v2),
ribbon.seed | (ribbon.outline.shape << 16u) | (uint(ribbon.outline.segments) << 24u));
recordSurface=uvec4(packHalf2x16(surface.root.rg),packHalf2x16(vec2(surface.root.b,surface.tip.r)),
packHalf2x16(surface.tip.gb),
packUnorm4x8(vec4(unpackedLook(surface.material.x),surface.root.w)));
recordFrame=uvec4(packHalf2x16(vec2(surface.material.y,surface.tip.w)),encodeWideOctahedral(ribbon.axis),
encodeWideOctahedral(lower),packHalf2x16(vec2(ribbon.fold,bend)));
recordBend=uvec4(encodeWideOctahedral(upper/bend),
uint(surface.material.z) | (uint(fleckCount(size*(1.0+bend))) << 24u),
uint(surface.material.w),index);
}
void main()
{
recordV0=uvec4(0u);
recordV1=uvec4(0u);
recordV2=uvec4(0u);
recordSurface=uvec4(0u);
recordFrame=uvec4(0u);
recordBend=uvec4(0u);
gl_PointSize=1.0;
gl_Position=vec4(2.0,2.0,2.0,1.0);
if (uint(gl_VertexID)>=group.z)
return;
Patch cell=fetchPatchArray(group.x);
uint i=group.y+uint(gl_VertexID);
uint index=cell.firstBlade+i;
LeafAreaLimit limit=leafAreaLimitOf(FRAME.view,cell);
Blade blade=raised(unpackBlade(fetchBladeArray(index),cell),limit.height);
uint turn=fetchUintArray(index);
PosedLook part=posedLook(blade,BladeState(turn==unsettledTurn?0u:turn,0.0));
uint number=part.number;
Verdict verdict=cullBlade(FRAME.view,limit,part.posed,bladeRank(cell,i - min(number,i)));
if (verdict.cullResult!=cullResultDrawn)
return;
VisibleBlade visible =
VisibleBlade(index,group.x,packFactors(verdict.widthFactor,limit.height),verdict.pixels);
DrawnBlade drawn=drawnBlade(visible,part);
float segments=drawn.ribbon.outline.segments;
if (segments>maxSegments)
drawn.ribbon.outline=outlineOf(drawn.ribbon.outline.shape,drawn.ribbon.outline.tipThreshold,maxSegments);
keep(drawn,bladeSurface(drawn,visible,limit),index);
}
`,
  // web/shaders/ribbon.glsl
  `#ifndef SWARD_WEB_RIBBON_GLSL
#define SWARD_WEB_RIBBON_GLSL
`,
  // shaders/blade/cross_section_point.glsl
  `#ifndef SWARD_BLADE_CROSS_SECTION_POINT_GLSL
#define SWARD_BLADE_CROSS_SECTION_POINT_GLSL
`,
  // shaders/blade/cross_section_point.glsl
  `vec3 onCrossSection(CrossSection section,float u)
{
return u<0.5?mix(section.left,section.ridge,2.0*u):mix(section.ridge,section.right,2.0*u - 1.0);
}
#endif
`,
  // web/shaders/ribbon.glsl
  `layout(location=0) in uvec4 recordV0;
layout(location=1) in uvec4 recordV1;
layout(location=2) in uvec4 recordV2;
layout(location=3) in uvec4 recordSurface;
layout(location=4) in uvec4 recordFrame;
layout(location=5) in uvec4 recordBend;
uniform uint columns;
Ribbon recordedRibbon()
{
vec2 outline=unpackHalf2x16(recordV1.w);
Ribbon ribbon;
ribbon.v0=uintBitsToFloat(recordV0.xyz);
ribbon.v1=uintBitsToFloat(recordV1.xyz);
ribbon.v2=uintBitsToFloat(recordV2.xyz);
ribbon.axis=decodeWideOctahedral(recordFrame.y);
ribbon.width=uintBitsToFloat(recordV0.w);
ribbon.fold=unpackHalf2x16(recordFrame.w).x;
ribbon.outline=Outline((recordV2.w >> 16u) & 255u,outline.x,float(recordV2.w >> 24u),outline.y);
ribbon.seed=recordV2.w & 0xffffu;
return ribbon;
}
vec2 placeOfVertex(Ribbon ribbon)
{
uint column=uint(gl_VertexID) % columns;
uint row=uint(gl_VertexID)/columns;
float u=float(column)/float(columns - 1u);
if (ribbon.fold<=0.0&&column>0u)
u=1.0;
return vec2(u,min(float(row)/ribbon.outline.segments,1.0));
}
#endif
`,
  // web/shaders/blade.vert
  `out vec3 outPosition;
out vec4 outPlace;
flat out uvec4 outSurface;
flat out uvec4 outFrame;
flat out uvec3 outBend;
void main()
{
Ribbon ribbon=recordedRibbon();
outPosition=vec3(0.0);
outPlace=vec4(0.0);
outSurface=recordSurface;
outFrame=recordFrame;
outBend=uvec3(recordBend.xy,ribbon.seed | (recordBend.z << 16u));
if (ribbon.width<=0.0) {
gl_Position=vec4(2.0,2.0,2.0,1.0);
return;
}
vec2 place=placeOfVertex(ribbon);
CrossSection section=crossSectionAt(ribbon,place.y,FRAME.view.eye,FRAME.view.minWidth);
outPosition=onCrossSection(section,place.x);
outPlace=vec4(2.0*place.x - 1.0,place.y,section.wide,section.drawn);
gl_Position=inClip(FRAME.viewProjection*vec4(outPosition,1.0));
}
`,
  // shaders/blade/blade_light.glsl
  `#ifndef SWARD_BLADE_BLADE_LIGHT_GLSL
#define SWARD_BLADE_BLADE_LIGHT_GLSL
`,
  // shaders/blade/blade_light.glsl
  `struct BladePoint {
vec3 position;
vec3 tangent;
vec3 axis;
vec3 up;
float fold;
vec2 place;
vec4 rootColor;
vec4 tipColor;
vec3 look;
float leafAbove;
float leafBelow;
uint seed;
float flecks;
float finish;
};
vec3 bladeNormal(BladePoint point,vec3 toEye,float distance)
{
vec3 flat_=cross(point.tangent,point.axis);
float size=length(flat_);
vec3 n=size>1e-3?flat_/size:point.up;
if (point.fold>0.0)
n+=(point.fold*sign(point.place.x))*point.axis;
n*=dot(n,toEye)<0.0?-1.0:1.0;
float smallness=smoothstep(4.0,60.0,distance*1000.0/FRAME.view.pixelsPerUnit);
float roundness=finishIn(point.finish)==finishStalk?1.4:0.55;
return normalize(n+(roundness*(1.0 - point.fold)*(1.0 - smallness)*point.place.x)*point.axis);
}
struct Scattering {
float facing;
float diffuse;
float through;
};
Scattering scatteringOf(vec3 source,vec3 n)
{
Scattering scattering;
scattering.facing=dot(n,source);
scattering.diffuse=max((scattering.facing+0.15)/1.3225,0.0);
scattering.through=max(-scattering.facing,0.0);
return scattering;
}
vec3 throughBlade(float translucency)
{
return throughShare*translucency*throughTint;
}
struct Incoming {
vec3 around;
vec3 behind;
vec3 above;
vec3 mirrored;
vec3 sun;
};
Incoming incomingFromSky(vec3 n,vec2 open)
{
vec3 sky=1.25*open.x*FRAME.skyColor;
vec3 ground=open.y*FRAME.groundColor;
float up=0.5+0.5*dot(n,FRAME.skyUp);
return Incoming(mix(ground,sky,up),mix(sky,ground,up),1.25*FRAME.skyColor,FRAME.skyColor,FRAME.sunColor);
}
#ifdef HOST_LIGHT
`,
  // shaders/blade/host_light.glsl
  `#ifndef SWARD_BLADE_HOST_LIGHT_GLSL
#define SWARD_BLADE_HOST_LIGHT_GLSL
const bool hasHostLight=false;
layout(set=HOST_LIGHT,binding=0) uniform sampler2DArray hostShadow;
#define HOST fetchHostLightArray(uint(0))
float shareInCascade(uint cascade,vec2 at,vec2 size,float depth)
{
vec2 first=floor(at);
vec2 f=at - first;
float share=0.0;
for (uint i=0u; i<4u; ++i) {
vec2 corner=first+2.0*vec2(i & 1u,i >> 1u);
vec4 depths=textureGather(hostShadow,vec3(corner/size,cascade));
vec4 seen=vec4(greaterThanEqual((depths - depth)*HOST.nearer,vec4(0.0)));
vec2 across=(i & 1u)==0u?vec2(1.0 - f.x,1.0):vec2(1.0,f.x);
vec2 down=(i >> 1u)==0u?vec2(1.0 - f.y,1.0):vec2(1.0,f.y);
share+=down.y*dot(across,seen.xy)+down.x*dot(across,seen.wz);
}
return share/9.0;
}
float sunShare(vec3 position,vec3 up)
{
vec2 size=vec2(textureSize(hostShadow,0).xy);
for (uint i=0u; i<HOST.cascadeCount; ++i) {
float texel=HOST.cascades[i].width/min(size.x,size.y);
vec4 place=vec4(position+up*(HOST.lift*texel),1.0);
vec2 at=vec2(dot(HOST.cascades[i].across,place),dot(HOST.cascades[i].down,place))*size - 0.5;
float depth=dot(HOST.cascades[i].depth,place);
if (all(greaterThanEqual(at,vec2(1.0)))&&all(lessThan(at,size - 2.0))&&depth>=0.0&&depth<=1.0)
return shareInCascade(i,at,size,depth);
}
return 1.0;
}
vec3 ambientTowards(vec3 n)
{
return vec3(ambientLight(HOST.ambient[0],n),ambientLight(HOST.ambient[1],n),ambientLight(HOST.ambient[2],n));
}
vec3 ambientAmong(vec3 n,vec2 open)
{
return open.x*ambientTowards(n) +
(open.y - open.x)*(0.5 - 0.5*dot(n,FRAME.skyUp))*ambientTowards(-FRAME.skyUp);
}
Incoming incomingAt(vec3 position,vec3 up,vec3 n,vec2 open)
{
if (!hasHostLight)
return incomingFromSky(n,open);
vec3 sun=FRAME.sunColor*sunShare(position,up);
if (HOST.hasAmbient==0u) {
Incoming incoming=incomingFromSky(n,open);
incoming.sun=sun;
return incoming;
}
return Incoming(ambientAmong(n,open),ambientAmong(-n,open),HOST.above,HOST.above/1.25,sun);
}
vec3 lampLight(BladePoint point,vec3 n,vec3 toEye,vec3 albedo,float leafArea)
{
float openSky=point.look.x;
vec3 through=throughBlade(point.look.y);
float leavesBelow=1.0 - skyBelow(point.leafBelow);
vec3 sum=vec3(0.0);
for (uint i=0u; i<HOST.lampCount; ++i) {
Lamp lamp=HOST.lamps[i];
vec3 toLamp=lamp.position - point.position;
vec3 color=lamp.color*lampShare(lamp,toLamp);
if (color==vec3(0.0))
continue;
vec3 source=toLamp*inversesqrt(max(dot(toLamp,toLamp),1e-12));
float upright=dot(point.up,source);
float seen=openSky*sunBelow(leafProjectionOf(FRAME.cover),leafArea,upright);
Scattering scattering=scatteringOf(source,n);
sum+=albedo*color*(seen*(scattering.diffuse+through*scattering.through));
sum+=albedo*(openSky*(1.0+through)) *
lightAmongLeaves(leafArea,leavesBelow,upright,color,vec3(0.0),albedo*(1.0+through));
if (point.look.z>0.0)
sum+=(point.look.z*point.place.y*seen*coatShine(n,point.tangent,source,toEye))*color;
}
return sum;
}
#endif
`,
  // shaders/blade/blade_light.glsl
  `#else
Incoming incomingAt(vec3 position,vec3 up,vec3 n,vec2 open)
{
return incomingFromSky(n,open);
}
#endif
const float fleckEdge=0.15;
float fleckAt(uint key,float mean)
{
float chance=float(mixUint(key) >> 8u)*(1.0/16777216.0);
return clamp((mean - chance)/(2.0*fleckEdge)+0.5,0.0,1.0);
}
float fleckOf(BladePoint point,float mean,float distance)
{
float pixels=FRAME.view.pixelsPerUnit*fleckLength()/distance;
float seen=smoothstep(1.0,4.0,pixels);
if (seen<=0.0)
return mean;
float at=point.place.y*point.flecks+float(point.seed & 255u)*(1.0/256.0);
uint key=point.seed+uint(at)*0x9e3779b9u;
float fleck=mix(fleckAt(key,mean),fleckAt(key+0x9e3779b9u,mean),smoothstep(0.25,0.75,fract(at)));
return mix(mean,fleck,seen);
}
struct LitPoint {
vec3 normal;
vec3 albedo;
float risen;
float sunlit;
};
LitPoint litPoint(BladePoint point,vec3 toEye,float distance)
{
float along=point.place.y;
vec3 n=bladeNormal(point,toEye,distance);
uint finish=finishIn(point.finish);
vec3 albedo=mix(point.rootColor.rgb,point.tipColor.rgb,tipShareAt(along));
bool isPlain=debugMode()!=debugNothing;
if (!isPlain)
albedo*=toneAlong(finish,along,point.seed);
float turned=dot(toEye,point.axis);
float wide=pixelsIn(point.finish)*sqrt(max(1.0 - turned*turned,0.0));
if (!isPlain&&wide>4.0) {
Veins veins=veinsAt(finish,point.place,wide,point.seed);
albedo*=veins.tone;
n=normalize(n+veins.slope*point.axis);
}
float risen=mix(point.rootColor.w,point.tipColor.w,along);
vec2 among=sunAmongBlades(FRAME.bladeShadow,point.position,point.seed);
float passed=among.x;
if (among.y<1.0)
passed=mix(fleckOf(point,sunBelow(leafProjectionOf(FRAME.cover),point.leafAbove,dot(point.up,FRAME.sunDirection)),
distance),
passed,among.y);
return LitPoint(n,albedo,risen,point.look.x*risen*passed);
}
BladePoint ontoBlade(BladePoint point)
{
point.place=clamp(point.place,vec2(-1.0,0.0),vec2(1.0));
return point;
}
vec3 bladePicture(BladePoint point)
{
point=ontoBlade(point);
float along=point.place.y;
float openSky=point.look.x;
float translucency=point.look.y;
float gloss=point.look.z;
vec3 sun=FRAME.sunDirection;
vec3 ray=FRAME.view.eye - point.position;
float distance=length(ray);
if (showsBands()) {
uint band=distanceBand(distance,FRAME.view.drawDistance);
uint channel=band - 3u*(debugMode() - debugNear);
return vec3(channel==0u,channel==1u,channel==2u);
}
vec3 toEye=ray/max(distance,1e-6);
LitPoint lit=litPoint(point,toEye,distance);
vec3 n=lit.normal;
vec3 albedo=lit.albedo;
float risen=lit.risen;
float sunlit=lit.sunlit;
float leafArea=point.leafAbove;
float upright=dot(point.up,sun);
float openBelow=skyBelow(point.leafBelow);
float openAbove=openSky*skyBelow(leafArea);
Incoming incoming=incomingAt(point.position,point.up,n,vec2(openAbove,openSky*openBelow));
vec3 through=throughBlade(translucency);
vec3 light=incoming.around+through*incoming.behind +
openSky*(1.0+through)*lightAmongLeaves(leafArea,1.0 - openBelow,upright,risen*incoming.sun,
incoming.above,albedo*(1.0+through));
Scattering scattering=scatteringOf(sun,n);
light+=incoming.sun*(sunlit*(scattering.diffuse+through*scattering.through));
vec3 color=albedo*light;
float coat=gloss*along;
if (coat>0.0) {
float towards=dot(n,toEye);
float mirrored=coat*coatAlbedo(towards);
float upwards=0.5+towards*dot(n,FRAME.skyUp) - 0.5*dot(toEye,FRAME.skyUp);
color+=mirrored*(openAbove*upwards*incoming.mirrored - color);
color+=(coat*sunlit*coatShine(n,point.tangent,sun,toEye))*incoming.sun;
}
#ifdef HOST_LIGHT
if (hasHostLight)
color+=lampLight(point,n,toEye,albedo,leafArea);
#endif
if (debugMode()!=debugNothing)
color=albedo*(0.25+0.75*along)*(0.6+0.4*max(scattering.facing,0.0));
else
color=throughAir(color,-toEye,distance);
return develop(color);
}
#endif
`,
  // web/shaders/middle.glsl
  `#ifndef SWARD_WEB_MIDDLE_GLSL
#define SWARD_WEB_MIDDLE_GLSL
uniform vec2 sampleOffset;
vec2 inMiddle(vec2 value)
{
return value - sampleOffset.x*dFdx(value)+sampleOffset.y*dFdy(value);
}
vec3 inMiddle(vec3 value)
{
return value - sampleOffset.x*dFdx(value)+sampleOffset.y*dFdy(value);
}
#endif
`,
  // web/shaders/blade.frag
  `in vec3 outPosition;
in vec4 outPlace;
flat in uvec4 outSurface;
flat in uvec4 outFrame;
flat in uvec3 outBend;
uniform uint samples;
uniform uint sampleOfPixel;
layout(location=0) out vec4 outColor;
void main()
{
vec3 position=inMiddle(outPosition);
vec2 place=inMiddle(outPlace.xy);
if (abs(place.x)>1.0||place.y<0.0||place.y>1.0) {
position=outPosition;
place=outPlace.xy;
}
uint seed=outBend.z & 0xffffu;
uint kept=keptSamples(outPlace.z/max(outPlace.w,1e-12),seed,samples);
if (((kept >> sampleOfPixel) & 1u)==0u)
discard;
vec2 middle=unpackHalf2x16(outSurface.y);
vec4 bytes=unpackUnorm4x8(outSurface.w);
vec2 shade=unpackHalf2x16(outFrame.x);
vec2 bent=unpackHalf2x16(outFrame.w);
float along=clamp(place.y,0.0,1.0);
BladePoint point;
point.position=position;
point.place=place;
point.axis=decodeWideOctahedral(outFrame.y);
point.up=decodeWideOctahedral(outFrame.z);
point.fold=bent.x;
point.tangent=normalize(mix(point.up,bent.y*decodeWideOctahedral(outBend.x),along));
point.rootColor=vec4(unpackHalf2x16(outSurface.x),middle.x,bytes.w);
point.tipColor=vec4(middle.y,unpackHalf2x16(outSurface.z),shade.y);
point.look=bytes.xyz;
point.leafAbove=leafAreaAbove(vec4(0.0,shade.x,float(outBend.y & 0xffffffu),0.0),along);
point.leafBelow=max(shade.x - point.leafAbove,0.0);
point.seed=seed;
point.finish=float(outBend.z >> 16u);
point.flecks=float(outBend.y >> 24u);
#ifdef IN_HOST
outColor=vec4(forHost(bladePicture(point)),1.0);
#else
outColor=vec4(bladePicture(point),1.0 - softness(length(FRAME.view.eye - position),1.0));
#endif
}
`,
  // shaders/shared/ground.h
  `#ifndef SWARD_SHARED_GROUND_H
#define SWARD_SHARED_GROUND_H
`,
  // shaders/shared/ground.h
  `const uint noImage=0xffffffffu;
const uint groundDoubleSided=1u;
struct GroundVertex {
vec3 position;
uint normal;
vec2 uv;
uint color;
};
struct GroundMaterial {
vec4 baseColor;
float roughness;
float metallic;
uint image;
uint flags;
};
const uint clusterTriangles=256u;
struct GroundCluster {
vec3 low;
uint material;
vec3 high;
uint indexCount;
};
struct IndexedDraw {
uint indexCount;
uint instanceCount;
uint firstIndex;
uint vertexOffset;
uint firstInstance;
};
struct GroundClusterArray { uint none; };
GroundCluster fetchGroundClusterArray(uint i);
struct IndexedDrawArray { uint none; };
IndexedDraw fetchIndexedDrawArray(uint i);
struct GroundVertexArray { uint none; };
GroundVertex fetchGroundVertexArray(uint i);
struct GroundMaterialArray { uint none; };
GroundMaterial fetchGroundMaterialArray(uint i);
vec3 decodeNormal32(uint bits)
{
float x=float((int(bits & 65535u) ^ 32768) - 32768)/32767.0f;
float y=float((int(bits >> 16u) ^ 32768) - 32768)/32767.0f;
float z=1.0f - abs(x) - abs(y);
float fold=max(-z,0.0f);
return normalize(vec3(x+(x>=0.0f?-fold:fold),y+(y>=0.0f?-fold:fold),z));
}
uint encodeNormal32(vec3 v)
{
float scale=1.0f/(abs(v.x)+abs(v.y)+abs(v.z));
float x=v.x*scale;
float y=v.y*scale;
if (v.z<0.0f) {
float folded=(1.0f - abs(y))*(x>=0.0f?1.0f:-1.0f);
y=(1.0f - abs(x))*(y>=0.0f?1.0f:-1.0f);
x=folded;
}
uint xi=uint(int(floor(clamp(x,-1.0f,1.0f)*32767.0f+0.5f))) & 65535u;
uint yi=uint(int(floor(clamp(y,-1.0f,1.0f)*32767.0f+0.5f))) & 65535u;
return xi | (yi << 16u);
}
#endif
`,
  // web/shaders/ground.vert
  `layout(location=0) in vec3 position;
layout(location=1) in uint normal;
layout(location=2) in vec2 uv;
layout(location=3) in vec4 color;
out vec3 outPosition;
out vec3 outNormal;
out vec2 outUv;
out vec4 outVertexColor;
void main()
{
outPosition=position;
outNormal=decodeNormal32(normal);
outUv=uv;
outVertexColor=color;
gl_Position=inClip(FRAME.viewProjection*vec4(position,1.0));
}
`,
  // web/shaders/ground.frag
  `#define AFTER_BLADES
`,
  // shaders/preview/ground_light.glsl
  `#ifndef SWARD_PREVIEW_GROUND_LIGHT_GLSL
#define SWARD_PREVIEW_GROUND_LIGHT_GLSL
`,
  // shaders/shared/look/ground_detail.h
  `#ifndef SWARD_SHARED_LOOK_GROUND_DETAIL_H
#define SWARD_SHARED_LOOK_GROUND_DETAIL_H
`,
  // shaders/shared/look/ground_detail.h
  `struct GroundDetail {
vec3 albedo;
float brightness;
vec3 slope;
};
float shownAt(float size,float pixel)
{
return clamp(0.35f*size/pixel - 1.0f,0.0f,1.0f);
}
const uint crumbSizes=5u;
const float nextCrumb=0.4f;
const float meanCrumb=0.3027f;
const float noiseDeviation=0.185f;
mat3 slantedLattice()
{
return mat3(0.36f,0.48f,-0.8f,-0.8f,0.6f,0.0f,0.48f,0.64f,0.6f);
}
void addCrumbs(inout GroundDetail detail,vec3 position,float size,float pixel,
float roughness)
{
mat3 turn=slantedLattice();
float amount=0.2f*roughness;
for (uint i=0u; i<crumbSizes; ++i) {
float shown=shownAt(size,pixel);
if (shown<=0.0f)
break;
bool other=(i & 1u)!=0u;
vec3 place=position/size+0.4f*detail.slope+17.0f*float(i);
vec4 noise=valueNoiseSlope(other?place*turn:turn*place);
vec3 rise=other?turn*vec3(noise):vec3(noise)*turn;
float height=2.0f*noise.w - 1.0f;
detail.brightness+=amount*shown*(abs(height) - meanCrumb);
detail.slope+=(amount*shown*(height<0.0f?-1.0f:1.0f))*rise;
size*=nextCrumb;
amount=min(1.4f*amount,0.38f*roughness);
}
}
float byteOf(uint hash,uint i)
{
return float((hash >> (8u*i)) & 255u)*(1.0f/256.0f);
}
const float stoneChance=0.4f;
const float smallestStone=0.08f;
const float largestStone=0.33f;
float stoneShare()
{
float low=smallestStone*smallestStone;
float high=largestStone*largestStone;
float meanCube=(high*high - low*low)/(4.0f*(largestStone - smallestStone));
return stoneChance*4.18879f*meanCube;
}
void layStones(inout GroundDetail detail,inout vec3 mean,vec3 rock,
vec3 position,float edge,float pixel,float amount)
{
float shown=amount*shownAt(0.4f*edge,pixel);
if (shown<=0.0f)
return;
mean=mix(mean,rock,shown*stoneShare());
mat3 turn=slantedLattice();
vec3 place=turn*(position/edge+0.1f*detail.slope);
vec3 cell=floor(place);
uint hash=mixUint(latticePoint(int(cell.x),int(cell.y),int(cell.z))+0x51ed270bu);
if (float(hash >> 8u)*(1.0f/16777216.0f)>=stoneChance)
return;
uint more=mixUint(hash+0x9e3779b9u);
float first=0.82f+0.4f*byteOf(hash,0u);
float second=0.82f+0.4f*byteOf(more,0u);
vec3 radii=mix(smallestStone,largestStone,byteOf(mixUint(more),0u)) *
vec3(first,1.0f/(first*second),second);
vec3 middle =
vec3(0.5f)+(vec3(1.0f) - 2.0f*radii) *
(vec3(byteOf(more,1u),byteOf(more,2u),byteOf(more,3u)) - vec3(0.5f));
vec3 out_=(place - cell - middle)/radii;
float soft=max(pixel/(edge*radii.x),0.08f);
float seen=shown*clamp((1.0f - length(out_))/soft+0.5f,0.0f,1.0f);
detail.albedo=mix(detail.albedo,(0.5f+byteOf(mixUint(more),1u))*rock,seen);
detail.slope=mix(detail.slope,0.4f*detail.slope - 0.8f*(out_*turn),seen);
detail.brightness=mix(detail.brightness,1.0f,seen);
}
const float strawChance=0.4f;
const float strawLength=0.27f;
const float strawWidth=0.013f;
const uint strawLayers=3u;
const vec3 strawColor=vec3(0.21f,0.165f,0.095f);
float lineSeen(float distance,float half_,float pixel)
{
return clamp((distance+half_)/pixel+0.5f,0.0f,1.0f) -
clamp((distance - half_)/pixel+0.5f,0.0f,1.0f);
}
void layStraws(inout GroundDetail detail,inout vec3 mean,vec3 straw,
vec2 place,float edge,float pixel,float amount)
{
float shown=amount*shownAt(edge,pixel);
if (shown<=0.0f)
return;
float width=max(pixel/edge,0.3f*strawWidth);
for (uint layer=0u; layer<strawLayers; ++layer) {
mean=mix(mean,straw,shown*strawChance*4.0f*strawLength*strawWidth);
place=vec2(0.8f*place.x - 0.6f*place.y,0.6f*place.x+0.8f*place.y) +
vec2(0.37f,0.71f);
vec2 cell=floor(place);
vec2 drift=floor(0.25f*place);
uint many=mixUint(latticePoint(int(drift.x),int(drift.y),int(layer)+7));
uint hash=mixUint(latticePoint(int(cell.x),int(cell.y),int(layer)));
if (float(hash >> 8u)*(1.0f/16777216.0f)>=2.0f*strawChance*byteOf(many,1u))
continue;
uint more=mixUint(hash+0x9e3779b9u);
float angle=6.2831853f*byteOf(more,0u);
vec2 along=vec2(cos(angle),sin(angle));
vec2 from=place - cell - vec2(0.5f);
float t=dot(from,along);
float beside=along.x*from.y - along.y*from.x +
(1.6f*byteOf(more,1u) - 0.8f)*(t*t - 0.04f);
float length_=strawLength*(0.4f+1.2f*byteOf(more,2u));
float seen =
shown*lineSeen(beside,strawWidth,width)*lineSeen(t,length_,width);
detail.albedo=mix(detail.albedo,(0.35f+1.3f*byteOf(more,3u))*straw,seen);
}
}
const float damp=7.0f;
float turfIn(vec3 albedo)
{
return smoothstep(1.15f,1.6f,albedo.y/max(max(albedo.x,albedo.z),1e-4f));
}
GroundDetail groundDetail(vec3 position,vec3 normal,vec3 up,vec3 albedo,float size,
float pixel)
{
GroundDetail detail;
detail.albedo=albedo;
detail.brightness=1.0f;
detail.slope=vec3(0.0f);
if (shownAt(damp*size,pixel)<=0.0f)
return detail;
float light=dot(albedo,vec3(0.2126f,0.7152f,0.0722f));
float soil=1.0f - 0.75f*smoothstep(0.15f,0.4f,light);
float wide=damp*size;
detail.brightness+=0.5f*soil*shownAt(wide,pixel)*(valueNoise(position/wide) - 0.5f);
addCrumbs(detail,position,size,pixel,soil);
float lies=soil*(1.0f - turfIn(albedo))*smoothstep(0.64f,0.85f,dot(normal,up));
vec3 mean=albedo;
float dark=min(16.0f*light,1.0f);
vec3 rock=mix(albedo,dark*vec3(0.14f,0.13f,0.115f),0.5f);
layStones(detail,mean,rock,position,0.16f*size,pixel,lies);
layStones(detail,mean,rock,position,0.55f*size,pixel,lies);
vec3 steep=abs(normal);
vec2 place=steep.y>=max(steep.x,steep.z)?vec2(position.x,position.z)
: steep.x>=steep.z            ?vec2(position.y,position.z)
: vec2(position.x,position.y);
layStraws(detail,mean,dark*strawColor,place/(0.5f*size),0.5f*size,pixel,lies);
detail.albedo=max(detail.albedo+albedo - mean,vec3(0.0f));
return detail;
}
float raggedShare(float mean,vec3 position,float cell,float size,float pixel)
{
float amount=0.75f*(1.0f - smoothstep(0.7f,0.9f,mean));
if (mean<=0.0f||amount<=0.0f)
return mean;
float step=max(0.5f*cell,size);
float whole=shownAt(step,pixel);
float weight=whole;
float sum=0.0f;
float squares=0.0f;
for (uint i=0u; i<4u&&weight>0.0f; ++i) {
sum+=weight*(valueNoise(position/step+31.0f*float(i)) - 0.5f);
squares+=weight*weight;
step=i==0u?0.6f*size:0.38f*step;
weight=shownAt(step,pixel);
}
if (squares<=0.0f)
return mean;
float order=1.0f/(1.0f+exp(-1.6f*sum/(noiseDeviation*sqrt(squares))));
float half_=min(0.06f,0.5f*min(mean,1.0f - mean));
float covered=clamp(0.5f*(mean - order)/max(half_,1e-6f)+0.5f,0.0f,1.0f);
return mix(mean,covered,amount*whole);
}
#endif
`,
  // shaders/preview/ground_light.glsl
  `struct GroundPoint {
vec3 position;
vec3 normal;
vec3 albedo;
bool isDoubleSided;
};
struct Relief {
float brightness;
vec3 slope;
};
void addNoise(inout Relief relief,vec3 position,vec3 stretch,float size,float amount)
{
vec4 noise=valueNoiseSlope(position*stretch/size);
relief.brightness+=amount*(noise.w - 0.5);
relief.slope+=(0.5*amount)*(noise.xyz*stretch);
}
Relief crumbs(vec3 position,float size,float pixel)
{
Relief relief=Relief(1.0,vec3(0.0));
for (uint octave=0u; octave<4u; ++octave) {
float shown=shownAt(size,pixel);
if (shown<=0.0)
break;
addNoise(relief,position+17.0*float(octave)*size,vec3(1.0),size,0.4*shown);
size*=0.37;
}
return relief;
}
Relief strands(vec3 position,float size,float pixel)
{
Relief relief=Relief(1.0,vec3(0.0));
float thin=0.12*size;
float shown=shownAt(thin,pixel);
if (shown>0.0) {
mat3 turned=mat3(0.36,0.48,-0.8,-0.8,0.6,0.0,0.48,0.64,0.6);
Relief turnedRelief=Relief(1.0,vec3(0.0));
addNoise(relief,position,vec3(0.15,1.0,1.0),thin,0.45*shown);
addNoise(relief,position,vec3(1.0,1.0,0.15),thin,0.45*shown);
addNoise(turnedRelief,turned*position,vec3(0.15,1.0,1.0),thin,0.45*shown);
relief.brightness+=turnedRelief.brightness - 1.0;
relief.slope+=turnedRelief.slope*turned;
}
return relief;
}
const float bareStructure=0.32;
const float hiddenBelow=0.93;
const float placeStep=2.5e-7;
const float darkestCrumb=0.85;
vec4 groundPicture(GroundPoint point)
{
vec3 ray=FRAME.view.eye - point.position;
float distance=length(ray);
vec3 toEye=ray/max(distance,1e-6);
vec3 n=normalize(point.normal);
if (point.isDoubleSided&&dot(n,toEye)<0.0)
n=-n;
float farthest=FRAME.cover.farthest;
float grown=1.0 - smoothstep(0.8*farthest,farthest,distance);
vec3 grass=grassAt(FRAME.cover,point.position);
float blades=grass.x*grown;
float leafArea=FRAME.cover.thinned*blades;
vec3 far=abs(point.position);
float pixel=max(distance/FRAME.view.pixelsPerUnit,placeStep*max(far.x,max(far.y,far.z)));
float size=FRAME.cover.structure>0.0?FRAME.cover.structure:bareStructure;
float closed=undergrowthBelow(leafArea);
float ragged=mix(raggedShare(closed,point.position,1.0/max(FRAME.cover.cellsPerMetre,1e-6),size,pixel),
closed,turfIn(point.albedo));
float under=FRAME.cover.thatch*ragged;
vec3 albedo=point.albedo;
vec3 shade=vec3(1.0);
float brightness=1.0 - under;
vec3 rough=vec3(0.0);
vec3 crumbled=vec3(0.0);
if (under<hiddenBelow) {
GroundDetail detail=groundDetail(point.position,n,FRAME.skyUp,albedo,size,pixel);
albedo=detail.albedo;
brightness*=detail.brightness;
crumbled=(1.0 - under)*(detail.slope - n*dot(n,detail.slope));
}
if (under>0.0) {
Relief relief=crumbs(point.position,size,pixel);
Relief litter=strands(point.position,size,pixel);
brightness+=under*max(relief.brightness*litter.brightness,0.2);
rough=under*(relief.slope+litter.slope);
shade=meadowShade(point.position,toneOf(grass));
albedo=mix(albedo,shade*FRAME.cover.undergrowth,under);
}
n=normalize(n - (rough - n*dot(n,rough)));
float even=max(dot(n,FRAME.sunDirection),0.0);
float turned=dot(crumbled,FRAME.sunDirection)/max(even,0.3);
float facing=even*(1.0 - clamp(turned,-darkestCrumb,darkestCrumb));
float seen=even>0.0?sunSeen(FRAME.shadow,point.position,n):0.0;
float below=sunBelow(leafProjectionOf(FRAME.cover),leafArea,even);
#ifdef AFTER_BLADES
vec2 among=sunAmongBlades(FRAME.bladeShadow,point.position,noBladeSeed);
below=mix(below,among.x,among.y);
#endif
vec3 light=hemisphere(normalize(n - crumbled))*skyBelow(leafArea) +
lightAmongLeaves(leafArea,0.0,even,seen*FRAME.sunColor,1.25*FRAME.skyColor,
1.5*FRAME.cover.sward) +
FRAME.sunColor*(facing*seen*below);
vec3 color=brightness*albedo*light;
float sward=closed>0.0?swardShare(FRAME.cover,leafArea,FRAME.cover.thinned*leavesPerDrawn(FRAME.view,distance))*(ragged/closed):0.0;
if (sward>0.0) {
vec3 open=hemisphere(n)+FRAME.sunColor*(even*seen);
color=mix(color,brightness*swardBrightness(max(dot(n,toEye),0.0))*shade*FRAME.cover.sward*open,sward);
}
if (debugMode()!=debugNothing)
color=showsBands()?vec3(0.0):vec3(0.35)*(0.5+0.5*even);
else
color=throughAir(color,-toEye,distance);
if (paintsWind)
color=colorOfWind(point.position,n);
return vec4(develop(color),1.0 - softness(distance,min(blades,1.0)));
}
#endif
`,
  // shaders/preview/image_probes.glsl
  `#ifndef SWARD_PREVIEW_IMAGE_PROBES_GLSL
#define SWARD_PREVIEW_IMAGE_PROBES_GLSL
const float maxProbes=8.0;
struct ImageProbes {
vec2 first;
vec2 step;
uint count;
float lod;
};
ImageProbes imageProbes(vec2 uv,vec2 right,vec2 down,vec2 size)
{
float across=length(right*size);
float along=length(down*size);
float longest=max(across,along);
float ratio=longest>1.0?longest/max(min(across,along),1e-6):1.0;
float count=clamp(ceil(ratio),1.0,maxProbes);
ImageProbes probes;
probes.step=(across>along?right:down)/(count+1.0);
probes.first=uv - 0.5*(count - 1.0)*probes.step;
probes.count=uint(count);
probes.lod=log2(max(longest/count,1e-6));
return probes;
}
#endif
`,
  // web/shaders/ground.frag
  `uniform sampler2D baseColor;
uniform vec3 materialColor;
uniform bool isDoubleSided;
in vec3 outPosition;
in vec3 outNormal;
in vec2 outUv;
in vec4 outVertexColor;
layout(location=0) out vec4 outColor;
void main()
{
ImageProbes probes=imageProbes(inMiddle(outUv),dFdx(outUv),dFdy(outUv),vec2(textureSize(baseColor,0)));
vec3 texel=vec3(0.0);
for (uint i=0u; i<probes.count; ++i)
texel+=textureLod(baseColor,probes.first+float(i)*probes.step,probes.lod).rgb;
GroundPoint point;
point.position=inMiddle(outPosition);
point.normal=inMiddle(outNormal);
point.albedo=materialColor*(texel/float(probes.count))*outVertexColor.rgb;
point.isDoubleSided=isDoubleSided;
#ifdef IN_HOST
outColor=vec4(forHost(groundPicture(point).rgb),1.0);
#else
outColor=groundPicture(point);
#endif
}
`,
  // shaders/common/view_ray.glsl
  `#ifndef SWARD_COMMON_VIEW_RAY_GLSL
#define SWARD_COMMON_VIEW_RAY_GLSL
`,
  // shaders/common/view_ray.glsl
  `#ifndef FRAME
#define FRAME push.frame.at[0]
#endif
vec3 rayThrough(vec2 place)
{
return place.x*FRAME.rays[0]+(place.y*FRAME.rays[1]+FRAME.rays[2]);
}
#endif
`,
  // web/shaders/sky.vert
  `out vec3 outRay;
void main()
{
vec2 place=vec2(gl_VertexID==1?3.0:-1.0,gl_VertexID==2?3.0:-1.0);
outRay=rayThrough(vec2(place.x,-place.y));
gl_Position=vec4(place,1.0,1.0);
}
`,
  // shaders/common/sky_light.glsl
  `#ifndef SWARD_COMMON_SKY_LIGHT_GLSL
#define SWARD_COMMON_SKY_LIGHT_GLSL
`,
  // shaders/common/sky_light.glsl
  `float cloudAt(vec3 place)
{
float least=mix(0.72,0.34,FRAME.clouds);
float finest=1.0/32.0;
float sum=0.0;
float weight=0.5;
for (uint octave=0u; octave<5u; ++octave) {
sum+=weight*valueNoise(place);
if (sum+weight - finest<=least)
return 0.0;
place=2.13*place.yzx+vec3(3.7,11.1,5.3);
weight*=0.5;
}
return smoothstep(0.0,0.26,sum - least);
}
vec3 withClouds(vec3 color,vec3 ray)
{
float height=dot(ray,FRAME.skyUp);
if (FRAME.clouds<=0.0||height<=0.0)
return color;
vec3 place=ray*(1.9/(height+0.16));
float thickness=cloudAt(place);
if (thickness<=0.0)
return color;
vec3 sunwards=FRAME.sunDirection - FRAME.skyUp*dot(FRAME.sunDirection,FRAME.skyUp);
float shade=cloudAt(place+0.35*sunwards);
float toSun=max(dot(ray,FRAME.sunDirection),0.0);
vec3 lit=FRAME.sunColor*(0.30*exp(-1.4*shade)*(1.0+0.9*pow(toSun,6.0))) +
0.55*FRAME.skyColor;
float shown=thickness*0.85*smoothstep(0.0,0.22,height);
return mix(color,lit,shown);
}
const vec3 floorAlbedo=vec3(0.160,0.152,0.130);
const float floorBounce=0.12;
float sunOnFloor(vec3 place)
{
if (FRAME.shadow.size==0u)
return 1.0;
float depth=dot(FRAME.shadow.depth,vec4(place,1.0));
float perMetre=dot(FRAME.shadow.depth.xyz,FRAME.sunDirection);
return sunSeen(FRAME.shadow,place+FRAME.sunDirection*(max(0.002 - depth,0.0)/perMetre),FRAME.skyUp);
}
vec3 belowHorizon(vec3 color,vec3 ray)
{
float climb=dot(ray,FRAME.skyUp);
if (climb>=0.0)
return color;
FloorPlane plane=FRAME.floorPlane;
if (plane.reach<=0.0)
return color*(1.0 - 0.35*smoothstep(0.0,1.0,-climb));
float distance=dot(plane.middle - FRAME.view.eye,FRAME.skyUp)/climb;
if (distance<=0.0)
return color;
vec3 place=FRAME.view.eye+distance*ray;
float away=distanceFromFootprint(plane,place,cross(FRAME.skyUp,plane.along));
float shown=exp(-away/plane.reach);
if (shown<0.002)
return color;
float facing=max(dot(FRAME.sunDirection,FRAME.skyUp),0.0);
float lit=facing>0.0?sunOnFloor(place):0.0;
float open=skyBesideWall(plane.height,away);
vec3 light=hemisphere(FRAME.skyUp)*open+FRAME.sunColor*(facing*mix(floorBounce*open,1.0,lit));
return mix(color,throughAir(floorAlbedo*light,ray,distance),shown);
}
vec3 skyPicture(vec3 ray,vec2 place)
{
if (debugMode()!=debugNothing)
return showsBands()?vec3(0.0):dithered(develop(vec3(0.6)),place);
vec3 color=belowHorizon(withClouds(skyRadiance(ray),ray),ray);
float toSun=dot(ray,FRAME.sunDirection);
color+=FRAME.sunColor*6.0*smoothstep(0.99985,0.99997,toSun);
return dithered(develop(color),place);
}
#endif
`,
  // web/shaders/sky.frag
  `in vec3 outRay;
layout(location=0) out vec4 outColor;
void main()
{
outColor=vec4(skyPicture(normalize(outRay),gl_FragCoord.xy),1.0);
}
`,
  // web/shaders/film.vert
  `void main()
{
gl_Position=vec4(gl_VertexID==1?3.0:-1.0,gl_VertexID==2?3.0:-1.0,0.0,1.0);
}
`,
  // web/shaders/film.frag
  `uniform sampler2D resolved;
uniform sampler2D resolved1;
uniform sampler2D resolved2;
uniform sampler2D resolved3;
uniform bool hasSamples;
layout(location=0) out vec4 outColor;
vec4 pixelAt(ivec2 pixel)
{
pixel=clamp(pixel,ivec2(0),textureSize(resolved,0) - 1);
vec4 first=texelFetch(resolved,pixel,0);
if (!hasSamples)
return first;
return 0.25*(first+texelFetch(resolved1,pixel,0)+texelFetch(resolved2,pixel,0) +
texelFetch(resolved3,pixel,0));
}
`,
  // shaders/resolve/reconstruction_filter.glsl
  `#ifndef SWARD_RESOLVE_RECONSTRUCTION_FILTER_GLSL
#define SWARD_RESOLVE_RECONSTRUCTION_FILTER_GLSL
const float softSide=1.0/6.0;
float splineAt(int offset)
{
return offset==0?1.0 - 2.0*softSide:softSide;
}
vec3 reconstructed(ivec2 pixel)
{
vec4 here=pixelAt(pixel);
float soft=1.0 - here.a;
vec3 sum=here.rgb;
if (soft<=0.0)
return sum;
for (int y=-1; y<=1; ++y)
for (int x=-1; x<=1; ++x) {
vec4 there=pixelAt(pixel+ivec2(x,y));
sum+=splineAt(x)*splineAt(y)*min(soft,1.0 - there.a)*(there.rgb - here.rgb);
}
return sum;
}
#endif
`,
  // web/shaders/film.frag
  `void main()
{
vec3 color=clamp(reconstructed(ivec2(gl_FragCoord.xy)),0.0,1.0);
color=mix(12.92*color,1.055*pow(color,vec3(1.0/2.4)) - 0.055,greaterThan(color,vec3(0.0031308)));
outColor=vec4(color,1.0);
}
`,
  // web/shaders/sun.vert
  `layout(location=0) in vec3 position;
void main()
{
vec4 place=vec4(position,1.0);
vec2 pixel=vec2(dot(FRAME.shadow.across,place),dot(FRAME.shadow.down,place));
gl_Position=inClip(vec4(pixel*(2.0/float(FRAME.shadow.size)) - 1.0,dot(FRAME.shadow.depth,place),1.0));
}
`,
  // web/shaders/blade_shadow.vert
  `flat out uint outSeed;
out float outDepth;
void main()
{
Ribbon ribbon=recordedRibbon();
ribbon.fold=0.0;
outSeed=ribbon.seed;
outDepth=0.0;
gl_Position=vec4(2.0,2.0,2.0,1.0);
if (ribbon.width<=0.0)
return;
vec2 place=placeOfVertex(ribbon);
CrossSection section=crossSectionAt(ribbon,place.y,FRAME.view.eye,0.0);
vec4 point=vec4(onCrossSection(section,place.x),1.0);
BladeShadow map=FRAME.bladeShadow;
vec2 texel=vec2(dot(map.across,point),dot(map.down,point));
outDepth=dot(map.depth,point);
gl_Position=inClip(vec4(texel*(2.0/float(map.size)) - 1.0,outDepth,1.0));
}
`,
  // web/shaders/blade_shadow.frag
  `flat in uint outSeed;
in float outDepth;
layout(location=0) out uvec2 texel;
void main()
{
texel=uvec2(outSeed,floatBitsToUint(outDepth));
}
`,
  // web/shaders/nothing.frag
  `void main()
{
}
`,
  // web/shaders/host_blade.frag
  `#define IN_HOST
`,
  // web/shaders/host.glsl
  `#ifndef SWARD_WEB_HOST_GLSL
#define SWARD_WEB_HOST_GLSL
uniform bool isLinear;
vec3 forHost(vec3 color)
{
color=clamp(color,0.0,1.0);
if (isLinear)
return color;
return mix(12.92*color,1.055*pow(color,vec3(1.0/2.4)) - 0.055,greaterThan(color,vec3(0.0031308)));
}
#endif
`,
  // web/shaders/host_ground.frag
  `#define IN_HOST
`
], head = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
`, stage = (...numbers) => head + numbers.map((i) => pieces[i]).join(""), moveVert = stage(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52), moveFrag = stage(53), poseVert = stage(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 48, 49, 50, 51, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81), bladeVert = stage(82, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 49, 50, 83, 84, 85, 86), bladeFrag = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 87, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 70, 78, 79, 88, 89, 90, 49, 50, 91, 92), groundVert = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 93, 94, 95), groundFrag = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 96, 97, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 93, 94, 98, 99, 48, 49, 50, 51, 100, 101, 91, 102), skyVert = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 103, 104, 105), skyFrag = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 106, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 107, 108), filmVert = stage(109), filmFrag = stage(110, 111, 112), sunVert = stage(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 113), bladeShadowVert = stage(82, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 49, 50, 83, 84, 85, 114), bladeShadowFrag = stage(115), nothingFrag = stage(116), hostBladeFrag = stage(117, 118, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 87, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 70, 78, 79, 88, 89, 90, 49, 50, 91, 92), hostGroundFrag = stage(119, 118, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 96, 97, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 45, 46, 69, 93, 94, 98, 99, 48, 49, 50, 51, 100, 101, 91, 102);

// src/sow/pages.ts
var sownPageBlades = 2048, sownPagePatches = 64, bladeWords2 = 4, noPatch2 = 4294967295;
function pagesOf(unit2) {
  let all = unit2.patches.length / patchWords, pages = [], current = { first: 0, end: 0, blades: 0 }, room = sownPagePatches - 1;
  for (let p = 0; p < all; ++p) {
    let count = unit2.patches[patchWords * p + patchWord.bladeCount];
    (room === 0 || current.blades + count > sownPageBlades) && (pages.push(current), current = { first: p, end: p, blades: 0 }, room = sownPagePatches), current.end = p + 1, current.blades += count, --room;
  }
  all > 0 && pages.push(current);
  let result = {
    count: pages.length,
    blades: new Uint32Array(pages.length * sownPageBlades * bladeWords2),
    patches: new Uint32Array(pages.length * sownPagePatches * patchWords),
    patchCounts: [],
    bladeCount: unit2.blades.length / bladeWords2
  };
  return pages.forEach(({ first, end }, i) => {
    let shift = i === 0 ? 1 : 0, at = patchWords * (sownPagePatches * i + shift);
    result.patches.set(unit2.patches.subarray(patchWords * first, patchWords * end), at);
    let from = unit2.patches[patchWords * first + patchWord.firstBlade];
    for (let p = 0; p < end - first; ++p) {
      let word = at + patchWords * p + patchWord.firstBlade;
      result.patches[word] -= from;
    }
    let last = patchWords * (end - 1), to = unit2.patches[last + patchWord.firstBlade] + unit2.patches[last + patchWord.bladeCount];
    result.blades.set(unit2.blades.subarray(bladeWords2 * from, bladeWords2 * to), bladeWords2 * sownPageBlades * i), result.patchCounts.push(end - first + shift);
  }), pages.length > 0 && (result.patches.set(unit2.whole), result.patches[patchWord.bladeCount] = 0, result.patches[patchWord.firstChild] = noPatch2, new Float32Array(result.patches.buffer)[patchWord.widthLow] = unit2.widest, new Float32Array(result.patches.buffer)[patchWord.widthStep] = 0), result;
}

// src/render/vector.ts
var add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]], sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]], scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s], dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2], size = (a) => Math.hypot(a[0], a[1], a[2]), cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0]
];
function unit(a, otherwise = [0, 1, 0]) {
  let length = size(a);
  return length > 0 ? scaled(a, 1 / length) : otherwise;
}
var clamp = (x, low, high) => Math.min(Math.max(x, low), high);
function turned(v, axis, angle) {
  let cosine = Math.cos(angle);
  return add(
    add(scaled(v, cosine), scaled(cross(axis, v), Math.sin(angle))),
    scaled(axis, dot(axis, v) * (1 - cosine))
  );
}

// src/render/camera.ts
function axesOf(camera2) {
  let forward = unit(sub(camera2.target, camera2.eye), [0, 0, -1]), right = cross(forward, camera2.up);
  if (size(right) < 1e-6 * size(camera2.up) || size(camera2.up) === 0) {
    let away = forward.map(Math.abs), axis = away[2] <= away[0] && away[2] <= away[1] ? [0, 0, -1] : away[0] <= away[1] ? [1, 0, 0] : [0, 1, 0];
    right = cross(forward, axis);
  }
  return right = unit(right), { right, up: cross(right, forward), forward };
}
function viewOf(camera2, origin, width, height, content) {
  let eye = sub(camera2.eye, origin), { right, up, forward } = axesOf(camera2), gap = [0, 1, 2].map((i) => Math.max(content.low[i] - eye[i], eye[i] - content.high[i], 0)), extent = size(sub(content.high, content.low)), near = Math.max(0.5 * size(gap), Math.min(0.05, 1e-3 * extent), 1e-6), reach = [0, 1, 2].map(
    (i) => Math.max(Math.abs(content.low[i] - eye[i]), Math.abs(content.high[i] - eye[i]))
  ), far = Math.max(1.01 * size(reach), 1.01 * near), focal = 1 / Math.tan(camera2.fovYDeg * Math.PI / 360), aspect = width / height, row = (axis, scale) => [...scaled(axis, scale), -scale * dot(axis, eye)], w = row(forward, 1), x = row(right, focal / aspect), y = row(up, -focal), slope = near / (far - near), z = w.map((value, i) => slope * ((i === 3 ? far : 0) - value)), viewProjection = [];
  for (let column = 0; column < 4; ++column) viewProjection.push(x[column], y[column], z[column], w[column]);
  let plane = (a, b, sign) => {
    let sum = a.map((value, i) => value + sign * b[i]), length = Math.hypot(sum[0], sum[1], sum[2]) || 1;
    return sum.map((value) => value / length);
  }, zero = [0, 0, 0, 0], rays = [scaled(right, aspect / focal), scaled(up, -1 / focal), forward];
  return {
    eye,
    viewProjection,
    planes: [plane(w, x, 1), plane(w, x, -1), plane(w, y, -1), plane(w, y, 1), plane(w, z, -1), plane(z, zero, 0)],
    rays,
    pixelsPerUnit: 0.5 * focal * height
  };
}
function fittingCamera(content, origin, up, sun, aspect) {
  let sunSide = unit(sub(sun, scaled(up, dot(sun, up))), [1, 0, 0]), beside = cross(up, sunSide), angle = 50 * Math.PI / 180, extent = sub(content.high, content.low), isLevel = Math.abs(dot(extent, up)) < 0.35 * size(extent), elevation = (isLevel ? 17 : 24) * Math.PI / 180, towards = add(scaled(sunSide, Math.cos(angle)), scaled(beside, Math.sin(angle))), forward = sub(scaled(towards, -Math.cos(elevation)), scaled(up, Math.sin(elevation))), right = unit(cross(forward, up)), above = cross(right, forward), tanY = 0.85 * Math.tan(40 * Math.PI / 360), tanX = tanY * aspect, east = -1 / 0, west = -1 / 0, north = -1 / 0, south = -1 / 0, nearest = 1 / 0, farthest2 = -1 / 0;
  for (let corner = 0; corner < 8; ++corner) {
    let p = [0, 1, 2].map((i) => corner & 1 << i ? content.high[i] : content.low[i]), x = dot(p, right), y = dot(p, above), z = dot(p, forward);
    east = Math.max(east, x - tanX * z), west = Math.max(west, -x - tanX * z), north = Math.max(north, y - tanY * z), south = Math.max(south, -y - tanY * z), nearest = Math.min(nearest, z), farthest2 = Math.max(farthest2, z);
  }
  let depth = Math.min(-(east + west) / (2 * tanX), -(north + south) / (2 * tanY), nearest - 1e-3), middle = 0.5 * (north - south), eye = add(
    add(scaled(right, 0.5 * (east - west)), scaled(above, isLevel ? -south - tanY * depth : middle)),
    scaled(forward, depth)
  );
  return {
    name: "fit",
    eye: add(origin, eye),
    target: add(origin, add(eye, scaled(forward, 0.5 * (nearest + farthest2) - depth))),
    up,
    fovYDeg: 40
  };
}

// src/render/half.ts
var buffer = new DataView(new ArrayBuffer(4));
function toHalf(value) {
  buffer.setFloat32(0, value);
  let bits = buffer.getUint32(0), sign = bits >>> 16 & 32768, exponent = (bits >>> 23 & 255) - 112, mantissa = bits & 8388607;
  return exponent >= 31 ? sign | 31744 : exponent <= 0 ? exponent < -10 ? sign : sign | Math.round((mantissa | 8388608) / 2 ** (14 - exponent)) : sign | (exponent << 10) + Math.round(mantissa / 8192);
}
function fromHalf(bits) {
  let sign = bits & 32768 ? -1 : 1, exponent = bits >>> 10 & 31, mantissa = bits & 1023;
  return sign * (exponent === 0 ? mantissa * 2 ** -24 : (1 + mantissa / 1024) * 2 ** (exponent - 15));
}

// src/render/cover.ts
var magic2 = "SWCOVER1", headBytes = 32, shapeBytes = headBytes + 112;
function parseCoverFile(bytes, name) {
  bytes instanceof ArrayBuffer || fail("usage", `${name}: the bytes of a cover are not an ArrayBuffer`);
  let all = new Uint8Array(bytes);
  String.fromCharCode(...all.subarray(0, magic2.length)) !== magic2 && fail("input", `${name}: not a cover of this version of Sward; "sward export" writes it beside the field`), (bytes.byteLength < shapeBytes || bytes.byteLength % 4 !== 0) && fail("input", `${name}: ${bytes.byteLength} bytes, not a cover of at least ${shapeBytes}: truncated`);
  let view = new DataView(bytes);
  xxh3(all.subarray(16)) !== view.getBigUint64(8, !0) && fail("input", `${name}: damaged (hash differs)`);
  let float = (at) => view.getFloat32(headBytes + at, !0), word = (at) => view.getUint32(headBytes + at, !0), vector = (at) => [float(at), float(at + 4), float(at + 8)], counts = [word(24), word(28), word(32)], corners = new Uint32Array(bytes, shapeBytes);
  return counts[0] * counts[1] * counts[2] !== corners.length && fail("input", `${name}: ${corners.length} corners instead of ${counts.join("·")}`), {
    name,
    bladesHash: view.getBigUint64(16, !0),
    areaFactor: view.getFloat32(24, !0),
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
  let corners = cover.corners.map((corner) => {
    let bits = corner & ~toneBits, area = fromHalf(bits & 65535);
    if (!(area > 0)) return corner;
    let leaves = Math.min(area * areaPerStored, largestLeafArea), heights = fromHalf(bits >>> 16) / area * leaves;
    return ((toHalf(leaves) | toHalf(heights) << 16) + 131072 & ~toneBits | corner & toneBits) >>> 0;
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
  let [nx, ny] = cover.counts;
  if (nx === 0) return 0;
  let cell = [0, 0, 0], f = [0, 0, 0];
  for (let i = 0; i < 3; ++i) {
    let last = cover.counts[i] - 1, at = Math.min(Math.max((place[i] - cover.low[i]) * cover.cellsPerMetre, 0), last);
    cell[i] = Math.min(Math.floor(at), last - 1), f[i] = at - cell[i];
  }
  let sum = 0;
  for (let corner = 0; corner < 8; ++corner) {
    let weight = 1, at = cell.map((c, i) => {
      let far = corner >> i & 1;
      return weight *= far ? f[i] : 1 - f[i], c + far;
    }), bits = cover.corners[at[0] + nx * (at[1] + ny * at[2])] & ~toneBits;
    sum += weight * fromHalf(bits & 65535);
  }
  return sum;
}
var leafProjectionOf = (cover) => fromHalf(cover.leaves[0] & 65535);
async function coverAt(address2) {
  let source = await openSource(address2, { ranges: !1 });
  return parseCoverFile((await source.read(0, source.size)).slice().buffer, address2);
}
function checkCover(field, cover) {
  cover.bladesHash !== void 0 && cover.bladesHash !== field.bladesHash && fail("input", `${cover.name}: the cover of another field than ${field.name}; "sward export" writes both`);
}

// src/render/block.ts
var Block = class {
  constructor(layout, size2) {
    this.layout = layout;
    this.bytes = new ArrayBuffer(size2), this.asFloats = new Float32Array(this.bytes), this.asWords = new Uint32Array(this.bytes);
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
    let offset = this.layout[path];
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
}, extinction = [0.08, 0.14, 0.26], afterglow = 0.0375, twilightFold = 6, darkest = 0.04, leafProjection = 0.5, maxAdaptation = 2, usualElevation = Math.asin(usualLight.sunDirection[1]) * 180 / Math.PI, each = (f) => [f(0), f(1), f(2)];
function airMass(elevation) {
  let above = Math.max(elevation, 0);
  return 1 / (Math.sin(above * Math.PI / 180) + 0.50572 * Math.pow(above + 6.07995, -1.6364));
}
function scattered(elevation) {
  let rise = Math.max(Math.sin(elevation * Math.PI / 180), 0), factor = Math.sqrt(rise * rise + afterglow * afterglow);
  return each((i) => factor * (1 - Math.exp(-extinction[i] * airMass(elevation))));
}
function skyShare(elevation) {
  if (elevation >= usualElevation) return [1, 1, 1];
  let own = scattered(elevation), usual = scattered(usualElevation);
  return each((i) => {
    let share = own[i] / usual[i];
    return elevation >= 0 ? share : Math.max(share * Math.exp(elevation / twilightFold), darkest);
  });
}
function sunColorAt(elevation) {
  let more = airMass(elevation) - airMass(usualElevation);
  return each((i) => usualLight.sunColor[i] * Math.exp(-extinction[i] * more));
}
function lightAt(azimuth, elevation, up) {
  let a = azimuth * Math.PI / 180, e = elevation * Math.PI / 180, share = skyShare(elevation), lowered = Math.min(elevation, usualElevation), low = elevation > 0 ? sunColorAt(lowered) : [0, 0, 0], loweredShare = skyShare(lowered), groundColor = each((i) => {
    let sky = 0.625 * usualLight.skyColor[i];
    return usualLight.groundColor[i] * (leafProjection * low[i] + sky * loweredShare[i]) / (leafProjection * usualLight.sunColor[i] + sky);
  }), luminance2 = (c) => dot(c, [0.2126, 0.7152, 0.0722]), left = luminance2(groundColor) / luminance2(usualLight.groundColor);
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
  let cosine = up[1];
  if (cosine < -0.9999) return [direction[0], -direction[1], -direction[2]];
  let axis = cross([0, 1, 0], up), once = cross(axis, direction);
  return add(add(direction, once), scaled(cross(axis, once), 1 / (1 + cosine)));
}
function lowSunOf(rise) {
  let t = clamp(rise / 0.59, 0, 1);
  return Math.pow(1 - t * t * (3 - 2 * t), 0.6);
}
function skyUpOf(direction, attractor, blend, eye) {
  let way = [attractor[0] - eye[0], attractor[1] - eye[1], attractor[2] - eye[2]], pull = size(way) > 0 ? unit(way) : direction;
  return unit(
    each((i) => -(direction[i] * (1 - blend) + pull[i] * blend)),
    scaled(direction, -1)
  );
}

// src/render/wind.ts
var eddyDrift = [0.48, 0.57, 0.67], windPeriod = 65536, lessWhole = (x, period) => x - period * Math.round(x / period), number32 = (x) => Number(BigInt.asUintN(32, BigInt(Math.round(x)))), point = (cell) => Math.imul(cell[0], latticeX) + Math.imul(cell[1], latticeY) + Math.imul(cell[2], latticeZ) >>> 0;
function writeWind(block, wind, origin, extent, strength, time) {
  let at = "environment.wind.", sources = [
    { kind: windNoise, strength: wind.strength * wind.gustiness * strength, size: wind.gustSize },
    { kind: windWave, strength: wind.strength * (1 - wind.gustiness) * strength, size: wind.waveLength }
  ].filter((source) => source.strength > 0), direction = unit(wind.direction, [1, 0, 0]), side = Math.abs(direction[1]) < 0.99 ? unit(cross(direction, [0, 1, 0])) : [1, 0, 0], counts = sources.length > 0 ? windsAlike : 0, eddySize = extent > 0 ? 0.25 * extent : 1e9, eddySpeed = 0, sum = 0;
  sources.forEach((source, i) => {
    let s = `${at}sources[${i}].`;
    block.floats(`${s}direction`, direction), block.floats(`${s}strength`, [source.strength]), block.floats(`${s}size`, [source.size]), block.floats(`${s}speed`, [wind.speed]), block.floats(`${s}alignment`, [1]), block.words(`${s}kind`, [source.kind]), block.floats(`${s}side`, side), block.floats(`${s}perSize`, [1 / source.size]), counts += 1 << 4 * source.kind, sum += source.strength, eddySize = Math.min(eddySize, 2 * source.size), eddySpeed = Math.max(eddySpeed, Math.abs(wind.speed)), writePhase(block, `${at}phases[${i}].`, source.kind, direction, wind.speed / source.size, time);
  }), block.words(`${at}counts`, [counts]), block.floats(`${at}eddySize`, [eddySize]), block.floats(`${at}eddySpeed`, [eddySpeed]), block.floats(`${at}sum`, [sum]), block.floats(`${at}eddyPhase`, eddyDrift.map((drift) => lessWhole(drift * eddySpeed * time / eddySize, 1))), block.floats(`${at}lattice.origin`, origin.map((x) => lessWhole(x, windPeriod))), block.floats(`${at}lattice.x`, [1, 0, 0]), block.floats(`${at}lattice.y`, [0, 1, 0]), block.floats(`${at}lattice.z`, [0, 0, 1]);
}
function writePhase(block, at, kind, direction, pace, time) {
  if (kind === windWave) {
    block.floats(`${at}angle`, [2 * Math.PI * lessWhole(pace * time, 20)]);
    return;
  }
  let cells2 = direction.map((along) => -along * pace * time), whole = cells2.map(Math.round), fine = whole.map((cell) => fineNoiseScale * cell + fineNoiseStart), wholeFine = fine.map(Math.round);
  block.floats(`${at}shift`, cells2.map((cell, i) => cell - whole[i])), block.words(`${at}cell`, [point(whole.map(number32))]), block.floats(`${at}fineShift`, fine.map((cell, i) => cell - wholeFine[i])), block.words(`${at}fineCell`, [point(wholeFine.map(number32))]);
}

// src/render/frame.ts
var frameSettings = { lodThreshold: 0.3, minPixels: 0.8, maxLeafArea: 10, clouds: 0.35, samples: 4 }, sunMapSize = 2048;
function chosenFog(content, eye) {
  let nearest = [0, 1, 2].map((i) => clamp(eye[i], content.low[i], content.high[i])), reach = Math.max(size(sub(content.high, content.low)), size(sub(eye, nearest)));
  return reach > 0 ? 0.105 / reach : 0;
}
var minWidthOf = (view) => frameSettings.minPixels / (view.pixelsPerUnit * Math.sqrt(frameSettings.samples));
function frameBlock(scene, input) {
  let { field, cover, content } = scene, { view, light } = input, block = new Block(frameLayout, frameBytes), origin = field.origin, gravity = field.defaults.gravity, attractor = sub(gravity.attractor, origin), skyUp = skyUpOf(gravity.direction, attractor, gravity.blend, view.eye);
  block.floats("viewProjection", view.viewProjection), view.rays.forEach((ray, i) => block.floats(`rays[${i}]`, ray)), view.planes.forEach((plane, i) => block.floats(`view.planes[${i}]`, plane)), block.floats("view.eye", view.eye), block.floats("view.drawDistance", [field.defaults.drawDistance]), block.floats("view.pixelsPerUnit", [view.pixelsPerUnit]), block.floats("view.lodThreshold", [input.lodThreshold]), block.floats("view.lodWidth", [scene.bladeWidth]), block.floats("view.minWidth", [minWidthOf(view)]), block.floats("view.maxLeafArea", [frameSettings.maxLeafArea]), block.floats("view.maxEdgeOn", [1]), block.words("view.samples", [frameSettings.samples]), block.words("view.cullMask", [cullPatch | cullOrientation | cullFrustum | cullDistance | leaveThinned]), block.floats("view.areaFactor", [cover.areaFactor]), block.floats("view.sparseFrom", [input.sparseFrom]), block.floats("view.sparseLeast", [input.sparseLeast]), block.words("maxTessellation", [16]);
  let environment = "environment.gravity.";
  block.floats(`${environment}direction`, unit(gravity.direction, [0, -1, 0])), block.floats(`${environment}strength`, [gravity.strength]), block.floats(`${environment}attractor`, attractor), block.floats(`${environment}blend`, [gravity.blend]), block.floats(`${environment}forward`, [0.25]), block.floats("environment.recovery", [field.defaults.recovery]);
  let extent = Math.max(...sub(content.high, content.low));
  writeWind(block, field.defaults.wind, origin, extent, input.wind, input.time), block.floats("sunDirection", light.sunDirection), block.floats("sunColor", light.sunColor), block.floats("skyColor", light.skyColor), block.floats("groundColor", light.groundColor), block.floats("skyUp", skyUp), block.floats("exposure", [scene.exposure * light.adaptation]), block.floats("lowSun", [lowSunOf(dot(light.sunDirection, skyUp))]), block.floats("fogDensity", [chosenFog(content, view.eye)]), block.floats("clouds", [frameSettings.clouds]), writeCover(block, cover, field.defaults.drawDistance), writeSun(block, scene.groundBox, light.sunDirection), input.shadowDistance > 0 && writeBladeShadow(block, view, input.camera, light.sunDirection, input.shadowDistance);
  let floor = scene.floor;
  return block.floats("floorPlane.middle", floor.middle), block.floats("floorPlane.reach", [floor.reach]), block.floats("floorPlane.along", floor.along), block.floats("floorPlane.height", [floor.height]), block.floats("floorPlane.halfSides", floor.halfSides), block.floats("floorPlane.cornerRadius", [floor.cornerRadius]), block;
}
function writeCover(block, cover, drawDistance) {
  block.floats("cover.low", cover.low), block.floats("cover.cellsPerMetre", [cover.cellsPerMetre]), block.words("cover.countX", [cover.counts[0]]), block.words("cover.countY", [cover.counts[1]]), block.words("cover.countZ", [cover.counts[2]]), block.floats("cover.farthest", [drawDistance]), block.floats("cover.undergrowth", cover.undergrowth), block.floats("cover.thatch", [1]), block.floats("cover.sward", cover.sward), block.floats("cover.thinned", [cover.thinned]), block.floats("cover.structure", [cover.structure]), block.floats("cover.stepsPerMetre", [cover.stepsPerMetre]), cover.leaves.forEach((word, i) => block.words(`cover.leaves[${i}]`, [word]));
}
function axesAbout(n) {
  let s = n[2] >= 0 ? 1 : -1, a = -1 / (s + n[2]);
  return [
    [1 + s * n[0] * n[0] * a, s * n[0] * n[1] * a, -s * n[0]],
    [n[0] * n[1] * a, s + n[1] * n[1] * a, -n[1]]
  ];
}
function writeSun(block, ground, sun) {
  if (!(ground.low[0] <= ground.high[0])) return;
  let rim = 2, axes = [...axesAbout(sun), sun], centre = [0, 1, 2].map((i) => 0.5 * (ground.low[i] + ground.high[i])), half = [0, 1, 2].map((i) => 0.5 * (ground.high[i] - ground.low[i])), reach = axes.map((axis) => Math.max(dot(axis.map(Math.abs), half), 1e-6)), scales = [(0.5 * sunMapSize - rim) / reach[0], (0.5 * sunMapSize - rim) / reach[1], 0.49 / reach[2]], row = (i, middle) => [...scaled(axes[i], scales[i]), middle - scales[i] * dot(axes[i], centre)];
  block.floats("shadow.across", row(0, 0.5 * sunMapSize)), block.floats("shadow.down", row(1, 0.5 * sunMapSize)), block.floats("shadow.depth", row(2, 0.5)), block.words("shadow.size", [sunMapSize]), block.floats("shadow.texel", [1 / Math.min(scales[0], scales[1])]), block.floats("shadow.epsilon", [4e-6]);
}
function shadowRows(view, camera2, sun, distance) {
  let half = 0.5 * distance, across = unit(cross(Math.abs(sun[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0], sun)), down = cross(sun, across), middle = axesOf(camera2).forward.map((x, i) => view.eye[i] + half * x), texel = 2 * half / bladeShadowTexels, stepped = (axis) => Math.round(dot(axis, middle) / texel) * texel, length = 3 * half;
  return [
    [...scaled(across, 1 / half), -stepped(across) / half],
    [...scaled(down, 1 / half), -stepped(down) / half],
    [...scaled(sun, 1 / length), (half - stepped(sun)) / length]
  ];
}
function writeBladeShadow(block, view, camera2, sun, distance) {
  let rows = shadowRows(view, camera2, sun, distance), half = 0.5 * bladeShadowTexels, inTexels = (row) => row.map((x, i) => half * x + (i === 3 ? half : 0));
  block.floats("bladeShadow.across", inTexels(rows[0])), block.floats("bladeShadow.down", inTexels(rows[1])), block.floats("bladeShadow.depth", rows[2]), block.words("bladeShadow.size", [bladeShadowTexels]), block.floats("bladeShadow.nearer", [1 / (bladeShadowTexels * 3)]);
}
function shadowPlanes(rows) {
  let one = [0, 0, 0, 1], plane = (a, b, sign) => {
    let sum = a.map((x, i) => x + sign * b[i]), length = Math.hypot(sum[0], sum[1], sum[2]) || 1;
    return sum.map((x) => x / length);
  }, zero = [0, 0, 0, 0];
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
  let block = new Block(looksLayout, looksBytes), radians = (degrees) => degrees * Math.PI / 180, write = (at, look, firstOrgan, organKinds) => {
    block.floats(`${at}rootColor`, look.rootColor), block.floats(`${at}tipThreshold`, [look.tipThreshold]), block.floats(`${at}tipColor`, look.tipColor), block.floats(`${at}groundTint`, [look.groundTint]), block.floats(`${at}colorVariation`, [look.colorVariation]), block.floats(`${at}translucency`, [look.translucency]), block.floats(`${at}gloss`, [look.gloss]), block.floats(`${at}dryness`, [look.dryness]), block.words(`${at}shape`, [look.shape]), block.floats(`${at}fold`, [look.fold]), block.words(`${at}firstOrgan`, [firstOrgan]), block.words(`${at}organKinds`, [organKinds]);
  }, next = 0;
  return field.species.forEach((species, i) => {
    write(`species[${i}].`, species, species.organs.length > 0 ? next : 0, species.organs.length);
    for (let organ of species.organs) {
      let at = `organs[${next++}].`;
      write(`${at}look.`, organ, 0, 0), block.words(`${at}count`, [organ.count]), block.floats(`${at}place`, organ.place), block.floats(`${at}pitch`, organ.pitch.map(radians)), block.floats(`${at}size`, organ.length), block.floats(`${at}width`, [organ.width]), block.floats(`${at}azimuth`, [radians(organ.azimuth)]), block.floats(`${at}turn`, [radians(organ.turn)]), block.floats(`${at}bend`, [radians(organ.bend)]), block.floats(`${at}leg`, [legLength(radians(organ.bend))]), block.floats(`${at}variation`, [organ.variation]);
    }
  }), block;
}
function legLength(bend) {
  let sum = 0;
  for (let i = 0; i <= 32; ++i) {
    let t = i / 32, speed = Math.sqrt(Math.max(1 - 2 * t * (1 - t) * (1 - Math.cos(bend)), 0));
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
], blocks = ["FrameConstants", "LookTables"], firstBlock = 22, Program = class {
  /** `captured`: outputs of the vertex stage that transform feedback keeps, in this order. */
  constructor(gl, name, vertex, fragment, captured2 = []) {
    this.gl = gl;
    this.name = name;
    this.program = gl.createProgram();
    let shaders = [
      [gl.VERTEX_SHADER, vertex],
      [gl.FRAGMENT_SHADER, fragment]
    ].map(([kind, text2]) => {
      let shader = gl.createShader(kind);
      return gl.shaderSource(shader, text2), gl.compileShader(shader), gl.attachShader(this.program, shader), shader;
    });
    captured2.length > 0 && gl.transformFeedbackVaryings(this.program, captured2, gl.INTERLEAVED_ATTRIBS), gl.linkProgram(this.program), this.check = () => {
      if (gl.getProgramParameter(this.program, gl.LINK_STATUS) || gl.isContextLost()) return;
      let log = [...shaders.map((shader) => gl.getShaderInfoLog(shader)), gl.getProgramInfoLog(this.program)];
      console.warn(log.join(`
`)), fail("runtime", `the program ${name} does not compile on this device`);
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
    let gl = this.gl;
    return gl.useProgram(this.program), units.forEach((sampler, unit2) => {
      let place = gl.getUniformLocation(this.program, sampler);
      place && gl.uniform1i(place, unit2);
    }), blocks.forEach((block, binding) => {
      let index = gl.getUniformBlockIndex(this.program, block);
      index !== gl.INVALID_INDEX && gl.uniformBlockBinding(this.program, index, firstBlock + binding);
    }), this;
  }
  use() {
    this.gl.useProgram(this.program);
  }
  place(name) {
    return this.places.has(name) || this.places.set(name, this.gl.getUniformLocation(this.program, name)), this.places.get(name);
  }
};
function bindTexture(gl, sampler, texture) {
  gl.activeTexture(gl.TEXTURE0 + units.indexOf(sampler)), gl.bindTexture(gl.TEXTURE_2D, texture);
}
function makeTexture(gl, format, width, height) {
  let texture = gl.createTexture();
  return gl.activeTexture(gl.TEXTURE0 + units.length), gl.bindTexture(gl.TEXTURE_2D, texture), gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height), gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST), gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST), texture;
}
var tableWidth = 2048;
function wordTable(gl, words) {
  let rows = Math.max(Math.ceil(words.length / tableWidth), 1), texture = makeTexture(gl, gl.R32UI, tableWidth, rows), whole = new Uint32Array(rows * tableWidth);
  return whole.set(words), gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, tableWidth, rows, gl.RED_INTEGER, gl.UNSIGNED_INT, whole), texture;
}
function imageTexture(gl, image) {
  let { width, height, pixels } = image ?? { width: 1, height: 1, pixels: new Uint8Array([255, 255, 255, 255]) }, most = gl.getParameter(gl.MAX_TEXTURE_SIZE);
  for (; width > most || height > most; ) {
    let [w, h] = [Math.max(width >> 1, 1), Math.max(height >> 1, 1)], from = new Uint32Array(pixels.slice().buffer), half = new Uint32Array(w * h);
    for (let y = 0; y < h; ++y)
      for (let x = 0; x < w; ++x)
        half[y * w + x] = from[Math.min(2 * y, height - 1) * width + Math.min(2 * x, width - 1)];
    [width, height, pixels] = [w, h, new Uint8Array(half.buffer)];
  }
  let texture = gl.createTexture();
  return gl.activeTexture(gl.TEXTURE0 + units.length), gl.bindTexture(gl.TEXTURE_2D, texture), gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, pixels), gl.generateMipmap(gl.TEXTURE_2D), gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR), texture;
}
function makeTarget(gl, color, depth = null) {
  let target = gl.createFramebuffer();
  return gl.bindFramebuffer(gl.FRAMEBUFFER, target), color ? gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0) : gl.drawBuffers([gl.NONE]), depth && gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0), target;
}
var samplePlaces = [
  [0.375, 0.125],
  [0.875, 0.375],
  [0.125, 0.625],
  [0.625, 0.875]
], Picture = class {
  constructor(gl, width, height, isFine) {
    this.gl = gl;
    this.width = width;
    this.height = height;
    this.isFine = isFine;
    let samples2 = isFine ? 0 : samplePlaces.length;
    this.drawn = gl.createFramebuffer(), gl.bindFramebuffer(gl.FRAMEBUFFER, this.drawn), this.buffers = [
      [gl.SRGB8_ALPHA8, gl.COLOR_ATTACHMENT0],
      [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]
    ].map(([format, place]) => {
      let buffer2 = gl.createRenderbuffer();
      return gl.bindRenderbuffer(gl.RENDERBUFFER, buffer2), gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples2, format, width, height), gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer2), buffer2;
    }), this.resolved = (isFine ? samplePlaces : [0]).map(() => makeTexture(gl, gl.SRGB8_ALPHA8, width, height)), this.targets = this.resolved.map((texture) => makeTarget(gl, texture));
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
    let gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.drawn), gl.viewport(0, 0, this.width, this.height), gl.clearDepth(1), gl.clear(gl.DEPTH_BUFFER_BIT | gl.COLOR_BUFFER_BIT);
  }
  /** Copies what is drawn into a texture of `resolved`. */
  end(sample) {
    let gl = this.gl;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.drawn), gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.targets[sample]);
    let { width, height } = this;
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  }
  delete() {
    let gl = this.gl;
    gl.deleteFramebuffer(this.drawn);
    for (let target of this.targets) gl.deleteFramebuffer(target);
    for (let texture of this.resolved) gl.deleteTexture(texture);
    for (let buffer2 of this.buffers) gl.deleteRenderbuffer(buffer2);
  }
};

// src/render/host.ts
var rowOf = (m, i) => [m[i], m[4 + i], m[8 + i], m[12 + i]];
function rowsOfProduct(a, b) {
  return a.map((row) => [0, 1, 2, 3].map((c) => row.reduce((sum, x, k) => sum + x * b[4 * c + k], 0)));
}
function hostView(input, height, usualLight2) {
  let own = [0, 1, 2, 3].map((i) => rowOf(input.view, i)), inEye = input.place ? rowsOfProduct(own, input.place) : own, axes = inEye.slice(0, 3).map((row) => row.slice(0, 3)), eye = axes.reduce((sum, axis, i) => add(sum, scaled(axis, -inEye[i][3])), [0, 0, 0]), projection = [0, 1, 2, 3].map((i) => rowOf(input.projection, i)), [x, y, z, w] = projection.map((row) => [0, 1, 2, 3].map((c) => row.reduce((sum, v, k) => sum + v * inEye[k][c], 0))), down = y.map((v) => -v), depth = w.map((v, i) => 0.5 * (v - z[i])), viewProjection = [];
  for (let c = 0; c < 4; ++c) viewProjection.push(x[c], down[c], depth[c], w[c]);
  let plane = (a, b, sign) => {
    let sum = a.map((v, i) => v + sign * b[i]), length = Math.hypot(sum[0], sum[1], sum[2]) || 1;
    return sum.map((v) => v / length);
  }, zero = [0, 0, 0, 0], focal = input.projection[5], forward = scaled(axes[2], -1), turn = (v) => input.place ? [0, 1, 2].map((c) => dot(v, [input.place[4 * c], input.place[4 * c + 1], input.place[4 * c + 2]])) : v;
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
  let state = {
    framebuffer: gl.getParameter(gl.FRAMEBUFFER_BINDING),
    viewport: gl.getParameter(gl.VIEWPORT)
  };
  for (let switchedOff of [
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
  gl.enable(gl.DEPTH_TEST), gl.depthFunc(gl.LEQUAL), gl.depthMask(!0), gl.depthRange(0, 1), gl.clearDepth(1), gl.clearColor(0, 0, 0, 0), gl.colorMask(!0, !0, !0, !0), gl.cullFace(gl.BACK), gl.frontFace(gl.CCW), gl.bindBuffer(gl.PIXEL_UNPACK_BUFFER, null), gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, 0), gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, 0), gl.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
  for (let skipped of [gl.UNPACK_ROW_LENGTH, gl.UNPACK_SKIP_ROWS, gl.UNPACK_SKIP_PIXELS]) gl.pixelStorei(skipped, 0);
  for (let unit2 = 0; unit2 < 12; ++unit2) gl.bindSampler(unit2, null);
  return state;
}
function leaveHost(gl, state) {
  gl.bindVertexArray(null), gl.bindBuffer(gl.ARRAY_BUFFER, null), gl.useProgram(null), gl.disable(gl.CULL_FACE), gl.activeTexture(gl.TEXTURE0), gl.bindFramebuffer(gl.FRAMEBUFFER, state.framebuffer), gl.viewport(state.viewport[0], state.viewport[1], state.viewport[2], state.viewport[3]);
}

// src/render/exposure.ts
var exposedGrey = 0.163, exposedBright = 1.6, meadowBrightness = 0.6, adaptation = 0.5, usualGround = 0.2, fewBlades = 0.05, groundSamples = 2e4, samplesOfTriangle = 256, mayClip = 0.01, skyExtinction = 1.2, lowestSun = 0.1, luminance = (c) => 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2], linear = (s) => s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4, undergrowthBelow = (leafArea) => 1 - Math.exp(-0.65 * leafArea);
function lightBelow(cover, leafArea, facing) {
  let upwards = leafProjectionOf(cover), risen = Math.max(facing, lowestSun), beside = 0.637 * Math.sqrt(Math.max(1 - 1.9 * upwards * upwards, 0)), along = Math.hypot(upwards * risen, beside * Math.sqrt(Math.max(1 - risen * risen, 0))), sun = facing * Math.exp(-along * leafArea / risen), sky = 1.25 * Math.exp(-skyExtinction * leafArea);
  return [0, 1, 2].map((i) => sun * usualLight.sunColor[i] + sky * usualLight.skyColor[i]);
}
function placesOf(ground, cover) {
  let view = new DataView(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length), float = (vertex, word) => view.getFloat32(groundVertexBytes * vertex + 4 * word, !0), position = (v) => [float(v, 0), float(v, 1), float(v, 2)], color = (v) => [0, 1, 2].map((i) => view.getUint8(groundVertexBytes * v + 24 + i) / 255), ranges = ground.ranges.filter((range) => range.level === 0), triangles = ranges.reduce((sum, range) => sum + range.indexCount / 3, 0), stride = Math.max(Math.floor(triangles / groundSamples), 1), each2 = clamp(Math.floor(groundSamples / Math.max(triangles, 1)), 1, samplesOfTriangle), places2 = [];
  for (let range of ranges) {
    let material = ground.materials[range.material];
    for (let i = 0; i < range.indexCount / 3; i += stride) {
      let corners = [0, 1, 2].map((k) => ground.indices[range.firstIndex + 3 * i + k]), [a, b, c] = corners.map(position), area = 0.5 * stride * size(cross(sub(b, a), sub(c, a))) / each2;
      for (let k = 0; k < each2; ++k) {
        let n = places2.length, p = (0.5 + n * 0.7548776662466927) % 1, q = (0.5 + n * 0.569840290998053) % 1;
        p + q > 1 && ([p, q] = [1 - p, 1 - q]);
        let w = [1 - p - q, p, q], mixed = (values) => values[0].map((_, j) => w[0] * values[0][j] + w[1] * values[1][j] + w[2] * values[2][j]), vertex = mixed(corners.map(color)), albedo = [0, 1, 2].map((j) => material.baseColor[j] * vertex[j]), image = ground.images[material.image];
        if (image) {
          let uv = mixed(corners.map((v) => [float(v, 4), float(v, 5)])), x = Math.min(Math.floor((uv[0] - Math.floor(uv[0])) * image.width), image.width - 1), y = Math.min(Math.floor((uv[1] - Math.floor(uv[1])) * image.height), image.height - 1);
          for (let j = 0; j < 3; ++j) albedo[j] *= linear(image.pixels[4 * (y * image.width + x) + j] / 255);
        }
        let place = mixed([a, b, c]);
        places2.push({ color: albedo, area, leafArea: cover.thinned * leafAreaAt(cover, place) });
      }
    }
  }
  return places2;
}
function chosenExposure(ground, cover, hasBlades) {
  let cosine = usualLight.sunDirection[1], times = (a, b) => [a[0] * b[0], a[1] * b[1], a[2] * b[2]], leaves = hasBlades ? luminance(times(cover.sward, lightBelow(cover, 0, cosine))) : 0, area = 0, open = 0, bare = 0, stops = 0, facing = [];
  for (let place of placesOf(ground, cover)) {
    let under = undergrowthBelow(place.leafArea), share = 1 - under, color = place.color.map((c, i) => c * share + cover.undergrowth[i] * under), level = luminance(times(color, lightBelow(cover, place.leafArea, cosine)));
    area += place.area, open += share * place.area, bare += place.area * luminance(times(place.color, lightBelow(cover, 0, cosine))), leaves > 0 && (stops += share * place.area * Math.log(Math.max(level / leaves, 1))), facing.push({
      radiance: Math.max(...times(color, lightBelow(cover, place.leafArea, 1))),
      area: share * place.area
    });
  }
  facing.sort((a, b) => b.radiance - a.radiance);
  let brightest = 0, above = 0;
  for (let one of facing)
    if (above += one.area, !(above < mayClip * area)) {
      brightest = one.radiance;
      break;
    }
  let seen = area > 0 ? { share: open / area, mean: bare / area, stops: stops / area } : { share: 0, mean: 0, stops: 0 }, mean = seen.mean > usualGround ? Math.sqrt(seen.mean * usualGround) : seen.mean, raised = 0;
  if (leaves > 0) {
    let meadow = Math.min((1 - seen.share) / fewBlades, 1);
    mean = (meadowBrightness * leaves) ** meadow * Math.max(mean, 1e-6) ** (1 - meadow), raised = meadow * adaptation * seen.stops;
  }
  let wanted = mean > 0 ? exposedGrey / mean * Math.exp(-raised) : 1, allowed = brightest > 0 ? exposedBright / brightest : 4;
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
}, Extent = class {
  low = 1 / 0;
  high = -1 / 0;
  add(value) {
    this.low = Math.min(this.low, value), this.high = Math.max(this.high, value);
  }
  get length() {
    return Math.max(this.high - this.low, 0);
  }
  get middle() {
    return 0.5 * (this.low + this.high);
  }
};
function isSheet(ground, floats, up) {
  let above = 0, below = 0, at = (v) => [floats[7 * v], floats[7 * v + 1], floats[7 * v + 2]];
  for (let range of ground.ranges)
    if (range.level === 0)
      for (let i = range.firstIndex; i + 2 < range.firstIndex + range.indexCount; i += 3) {
        let a = at(ground.indices[i]), area = dot(cross(sub(at(ground.indices[i + 1]), a), sub(at(ground.indices[i + 2]), a)), up);
        area > 0 ? above += area : below -= area;
      }
  return Math.max(above, below) >= 0.8 * (above + below);
}
function floorOf(ground, up) {
  let s = up.map(Math.abs), side = s[0] <= Math.min(s[1], s[2]) ? [1, 0, 0] : [0, 0, 1], alongAxis = unit(sub(side, scaled(up, dot(side, up)))), acrossAxis = cross(up, alongAxis), floats = new Float32Array(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length / 4), along = new Extent(), across = new Extent(), above = new Extent(), place = (v) => {
    let p = [floats[7 * v], floats[7 * v + 1], floats[7 * v + 2]];
    return [dot(p, alongAxis), dot(p, acrossAxis), dot(p, up)];
  };
  for (let v = 0; v < ground.vertexCount; ++v) {
    let [x, z, y] = place(v);
    along.add(x), across.add(z), above.add(y);
  }
  let half = 0.5 * Math.hypot(along.length, across.length);
  if (ground.vertexCount === 0 || !(half > 0)) return noFloor;
  let foot = new Extent(), footAcross = new Extent(), rim = new Extent(), farthest2 = 0, sides = [Math.max(0.5 * along.length, 1e-6), Math.max(0.5 * across.length, 1e-6)];
  for (let v = 0; v < ground.vertexCount; ++v) {
    let [x, z, y] = place(v), a = Math.abs((x - along.middle) / sides[0]), b = Math.abs((z - across.middle) / sides[1]);
    farthest2 = Math.max(farthest2, Math.hypot(a, b)), Math.max(a, b) >= 0.95 && rim.add(y), !(y > above.low + 0.02 * above.length) && (foot.add(x), footAcross.add(z));
  }
  let sheet = isSheet(ground, floats, up);
  if (!(foot.length >= 0.6 * along.length && footAcross.length >= 0.6 * across.length) && !sheet) return noFloor;
  let level = sheet ? rim.low : above.low, root = Math.SQRT2;
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
var groupBlades = 32, classes = [
  { segments: 16, above: 120, columns: 3 },
  { segments: 8, above: 26, columns: 3 },
  { segments: 4, above: 5, columns: 2 },
  { segments: 2, above: -1, columns: 2 },
  { segments: bladeShadowSegments, above: 1 / 0, columns: 2 }
], shadowClass = 4, lodShare = (pixels, threshold) => Math.min(Math.max(pixels / threshold, 1 / 256), lodFullShare);
function sparseShare(view, share, distance) {
  return view.sparseFrom <= 0 || distance <= view.sparseFrom ? 1 : Math.max((view.sparseFrom / distance) ** 3, Math.min(view.sparseLeast / share, 1));
}
var PatchTree = class {
  /** `sowing`: of a field that is sown; its patches stand for those of the field. */
  constructor(field, sowing2) {
    this.field = field;
    this.sowing = sowing2;
    let patches = this.patches = sowing2?.patches ?? field.patches, stored = field.patches.count;
    this.ribbons = Math.max(0, ...field.species.map((one) => ribbonsOf(one.organs))), this.widest = subtreeWidths(patches, stored), this.rankBelow = new Float32Array(stored).fill(1), this.queue = new Uint32Array(stored);
    let f = patches.floats;
    for (let p = stored - 1; p >= 0; --p) {
      let at = p * patchWords;
      if (p === 0) continue;
      let parent = patches.parent(p), rank = patches.bladeCount(p) > 0 ? f[at + patchWord.rankLow] : 1;
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
    let f = this.patches.floats, square = 0;
    for (let i = 0; i < 3; ++i) {
      let off = Math.max(
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
    let share = lodShare(view.lodWidth * view.pixelsPerUnit / Math.max(distance, 1e-6), view.lodThreshold);
    return share * sparseShare(view, share, distance);
  }
  leavesPerDrawn(view, distance) {
    if (view.sparseFrom <= 0 || distance <= view.sparseFrom || view.lodThreshold <= 0) return 1;
    let share = lodShare(view.lodWidth * view.pixelsPerUnit / Math.max(distance, 1e-6), view.lodThreshold);
    return 1 / Math.sqrt(sparseShare(view, share, distance));
  }
  /** Whether no blade of a subtree is in the view. */
  isOutside(view, p, nearest, widest) {
    if (nearest > view.drawDistance) return !0;
    let f = this.patches.floats, at = p * patchWords, square = 0, thinnest = 1 / 0;
    for (let i = 0; i < 3; ++i) {
      let low = f[at + patchWord.boundsLow + i], high = f[at + patchWord.boundsHigh + i], far = Math.max(Math.abs(low - view.eye[i]), Math.abs(high - view.eye[i]));
      square += far * far, thinnest = Math.min(thinnest, high - low);
    }
    let farthest2 = Math.sqrt(square), margin = 0.5 * outlineMost * widest / (0.95 * this.shareAt(view, farthest2) * this.leavesPerDrawn(view, farthest2)) + view.minWidth * farthest2 + (maxHeightCompensation - 1) * 0.5 * thinnest;
    for (let plane of view.planes) {
      let sum = plane[3];
      for (let i = 0; i < 3; ++i)
        sum += plane[i] * (plane[i] >= 0 ? f[at + patchWord.boundsHigh + i] + margin : f[at + patchWord.boundsLow + i] - margin);
      if (sum < 0) return !0;
    }
    return !1;
  }
  /** The groups of blades that a view may show. `most`: blades at most. */
  groupsOf(view, most, oneClass = -1) {
    let { patches, sowing: sowing2 } = this, f = patches.floats, seen = [], wanted = [], blades = 0, add2 = (p, share, nearest, isStored) => {
      let at = p * patchWords, own = patches.bladeCount(p), low = f[at + patchWord.rankLow], high = f[at + patchWord.rankHigh];
      if (own === 0 || share <= low) return;
      let thick = share >= high ? own : Math.ceil((share - low) / (high - low) * own) + 1, count = Math.min(thick + this.ribbons, own), begin = patches.firstBlade(p);
      if (isStored && !this.field.has(begin, count)) {
        for (let page of pagesOf2(begin, count))
          this.field.isMissing(page) && wanted.push({ page, distance: nearest * (1 + low) });
        return;
      }
      blades + count > most || (blades += count, seen.push({ patch: p, count, distance: nearest }));
    }, end = 0;
    this.field.patches.count > 0 && (this.queue[end++] = 0);
    for (let next = 0; next < end; ++next) {
      let p = this.queue[next], nearest = this.distance(view, p * patchWords);
      if (this.isOutside(view, p, nearest, this.widest[p])) continue;
      let share = this.shareAt(view, nearest);
      if (share > this.rankBelow[p]) {
        let first = patches.firstChild(p);
        for (let i = 0; i < patches.childCount(p); ++i) this.queue[end++] = first + i;
      }
      add2(p, share, nearest, !0);
    }
    let widestOf = (p) => f[p * patchWords + patchWord.widthLow] + 63 * f[p * patchWords + patchWord.widthStep];
    sowing2?.walk(
      (whole) => !this.isOutside(view, whole, this.distance(view, whole * patchWords), widestOf(whole)),
      (p) => {
        let nearest = this.distance(view, p * patchWords), share = this.shareAt(view, nearest);
        share <= f[p * patchWords + patchWord.rankLow] || this.isOutside(view, p, nearest, widestOf(p)) || add2(p, share, nearest, !1);
      }
    ), seen.sort((a, b) => a.distance - b.distance);
    let lists = classes.map(() => []);
    for (let { patch, count, distance } of seen) {
      let at = patch * patchWords, pixels = (f[at + patchWord.heightLow] + 255 * f[at + patchWord.heightStep]) * view.pixelsPerUnit / Math.max(distance, 1e-6), kind = oneClass >= 0 ? oneClass : classes.findIndex((one) => pixels > one.above);
      for (let i = 0; i < count; i += groupBlades) lists[kind].push(patch, i, Math.min(groupBlades, count - i));
    }
    let begins = [0];
    for (let list of lists) begins.push(begins[begins.length - 1] + list.length / 3);
    let words = new Uint32Array(3 * begins[classes.length]);
    return lists.forEach((list, i) => words.set(list, 3 * begins[i])), wanted.sort((a, b) => a.distance - b.distance), { words, begins, blades, missing: [...new Set(wanted.map((one) => one.page))] };
  }
};
function subtreeWidths(patches, count = patches.count) {
  let f = patches.floats, widest = new Float32Array(count);
  for (let p = count - 1; p >= 0; --p) {
    let at = p * patchWords, own = patches.bladeCount(p) > 0 ? f[at + patchWord.widthLow] + 63 * f[at + patchWord.widthStep] : 0;
    widest[p] = Math.max(widest[p], own), p > 0 && (widest[patches.parent(p)] = Math.max(widest[patches.parent(p)], widest[p]));
  }
  return widest;
}
var pageBlades2 = 1024;
function* pagesOf2(first, count) {
  for (let p = Math.floor(first / pageBlades2); p <= Math.floor((first + count - 1) / pageBlades2); ++p) yield p;
}
function meanBladeWidth(patches, patchCount = patches.count) {
  let f = patches.floats, width = 0, count = 0;
  for (let p = 0; p < patchCount; ++p) {
    let own = patches.bladeCount(p);
    width += own * (f[p * patchWords + patchWord.widthLow] + 31.5 * f[p * patchWords + patchWord.widthStep]), count += own;
  }
  return count > 0 ? width / count : 0.01;
}

// src/render/scene.ts
function boxOf(field) {
  let ground = { low: [1 / 0, 1 / 0, 1 / 0], high: [-1 / 0, -1 / 0, -1 / 0] }, vertices = field.ground.vertices, floats = new Float32Array(vertices.buffer, vertices.byteOffset, vertices.length / 4);
  for (let v = 0; v < field.ground.vertexCount; ++v)
    for (let i = 0; i < 3; ++i)
      ground.low[i] = Math.min(ground.low[i], floats[7 * v + i]), ground.high[i] = Math.max(ground.high[i], floats[7 * v + i]);
  let content = { low: [...ground.low], high: [...ground.high] };
  if (field.patches.count > 0)
    for (let i = 0; i < 3; ++i)
      content.low[i] = Math.min(content.low[i], field.patches.floats[i]), content.high[i] = Math.max(content.high[i], field.patches.floats[4 + i]);
  return { content, ground };
}
function sceneOf(field, cover, patches = field.patches) {
  checkCover(field, cover);
  let { content, ground } = boxOf(field), gravity = field.defaults.gravity, up = unit(scaled(gravity.direction, -1));
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
var patchTexels = 7, patchesOfRow = 256;
function patchTexelsOf(patches, first, end, room = end - first) {
  let texels = new Uint32Array(4 * patchTexels * room);
  for (let p = first; p < end; ++p)
    texels.set(patches.words.subarray(p * patchWords, (p + 1) * patchWords), 4 * patchTexels * (p - first));
  return texels;
}
function patchTable(gl, patches) {
  let rows = Math.max(Math.ceil(patches.count / patchesOfRow), 1), width = patchTexels * patchesOfRow, texels = patchTexelsOf(patches, 0, patches.count, rows * patchesOfRow), texture = makeTexture(gl, gl.RGBA32UI, width, rows);
  return gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, rows, gl.RGBA_INTEGER, gl.UNSIGNED_INT, texels), texture;
}
function ribbonIndices(gl, segments, columns) {
  let list = [];
  for (let row = 0; row < segments; ++row)
    for (let column = 0; column + 1 < columns; ++column) {
      let first = row * columns + column, above = first + columns;
      list.push(first, first + 1, above, above, first + 1, above + 1);
    }
  let buffer2 = gl.createBuffer();
  return gl.bindVertexArray(null), gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer2), gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint16Array(list), gl.STATIC_DRAW), buffer2;
}
function groundArrayOf(gl, field) {
  let array = gl.createVertexArray();
  gl.bindVertexArray(array), gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer()), gl.bufferData(gl.ARRAY_BUFFER, field.ground.vertices, gl.STATIC_DRAW);
  for (let i = 0; i < 4; ++i) gl.enableVertexAttribArray(i);
  return gl.vertexAttribPointer(0, 3, gl.FLOAT, !1, groundVertexBytes, 0), gl.vertexAttribIPointer(1, 1, gl.UNSIGNED_INT, groundVertexBytes, 12), gl.vertexAttribPointer(2, 2, gl.FLOAT, !1, groundVertexBytes, 16), gl.vertexAttribPointer(3, 4, gl.UNSIGNED_BYTE, !0, groundVertexBytes, 24), gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer()), gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, field.ground.indices, gl.STATIC_DRAW), gl.bindVertexArray(null), array;
}

// src/render/renderer.ts
var captured = ["recordV0", "recordV1", "recordV2", "recordSurface", "recordFrame", "recordBend"], recordBytes = 16 * captured.length, usualMax = 4e5, Renderer = class {
  /** `cover`: what `sward export` wrote into field.cover; without it blades do not shade one another. */
  constructor(canvas, field, cover = noCover, sowing2, host) {
    this.canvas = canvas;
    this.field = field;
    this.cover = cover;
    this.sowing = sowing2;
    let options = { antialias: !1, alpha: !1, depth: !1, powerPreference: "high-performance" }, gl = host ?? canvas.getContext("webgl2", options);
    gl || fail("unsupported", "this browser has no WebGL 2, or its graphics driver is blocked"), this.gl = gl, this.tree = new PatchTree(field, sowing2), this.scene = sceneOf(field, sowing2 ? sownCover(cover, sowing2.areaPerStored) : cover, sowing2?.patches), this.restore();
  }
  canvas;
  field;
  cover;
  sowing;
  kind = "webgl";
  scene;
  gl;
  tree;
  parts;
  lodThreshold = frameSettings.lodThreshold;
  /** Makes all that lies on the device, first or after the device was lost. */
  restore() {
    this.parts = new Parts(this.gl, this.field, this.scene, this.sowing), this.sowing?.forget();
  }
  /** The sun as the viewer has it by default. */
  get usualLight() {
    let up = unit(scaled(this.field.defaults.gravity.direction, -1));
    return { ...usualLight, sunDirection: turnedWith(up, usualLight.sunDirection) };
  }
  /** Draws a picture as large as the canvas. */
  draw(input) {
    let { canvas, field, scene } = this, view = viewOf(input.camera, field.origin, canvas.width, canvas.height, scene.content), { groups, stats } = this.prepare(input, view);
    return this.parts.draw(groups, canvas.width, canvas.height, input.isFine ?? !1), stats;
  }
  /** Waits until all is sown that a camera wants, of a field with seeds. */
  async sowFor(input) {
    let { canvas, field, scene, sowing: sowing2 } = this, view = viewOf(input.camera, field.origin, canvas.width, canvas.height, scene.content);
    for (; sowing2; ) {
      if (this.choose(input, view), sowing2.isSettled) return;
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
  }
  /** Draws into a framebuffer of a host, whose depth hides grass and is hidden by it. */
  drawInHost(input) {
    let { gl } = this, width = input.width ?? gl.drawingBufferWidth, height = input.height ?? gl.drawingBufferHeight, { view, camera: camera2, light } = hostView(input, height, this.usualLight), before = enterHost(gl), { groups, stats } = this.prepare({ ...input, camera: camera2, light }, view);
    return gl.bindFramebuffer(gl.FRAMEBUFFER, input.framebuffer ?? null), gl.viewport(0, 0, width, height), this.parts.drawInHost(groups, input.isLinear ?? !1, input.ground ?? !1), leaveHost(gl, before), stats;
  }
  /** Chooses the groups of blades of a view, and brings what has come onto the device. */
  choose(input, view) {
    let { field, scene, sowing: sowing2 } = this, frame = {
      view,
      camera: input.camera,
      light: input.light ?? this.usualLight,
      wind: input.wind ?? 1,
      time: input.time,
      shadowDistance,
      lodThreshold: this.lodThreshold,
      sparseFrom: 0,
      sparseLeast: field.seeds?.meadow.stored ?? 0
    }, treeView = {
      eye: view.eye,
      planes: view.planes,
      drawDistance: field.defaults.drawDistance,
      pixelsPerUnit: view.pixelsPerUnit,
      lodThreshold: this.lodThreshold,
      lodWidth: scene.bladeWidth,
      minWidth: minWidthOf(view),
      sparseFrom: 0,
      sparseLeast: frame.sparseLeast
    }, find = () => (frame.sparseFrom = treeView.sparseFrom = sowing2 ? this.sparseFrom(view) : 0, treeView.lodThreshold = frame.lodThreshold = this.lodThreshold * (sowing2?.thinning ?? 1), this.tree.groupsOf(treeView, 1 / 0));
    sowing2 && sowing2.update({ ...treeView, lodThreshold: this.lodThreshold, sparseFrom: this.sparseFrom(view) }), this.parts.uploadPages();
    let most = input.maxBlades ?? usualMax, groups = find(), usual = frameSettings.lodThreshold;
    for (let i = 0; i < 12; ++i) {
      let ratio = Math.sqrt(groups.blades / most);
      if (ratio > 1.15) this.lodThreshold *= Math.min(ratio, 2);
      else if (ratio < 0.7 && this.lodThreshold > usual)
        this.lodThreshold = Math.max(this.lodThreshold * Math.max(1.2 * ratio, 0.5), usual);
      else break;
      groups = find();
    }
    return groups.blades > most ? this.lodThreshold *= 1.02 : groups.blades < 0.8 * most && (this.lodThreshold = Math.max(this.lodThreshold / 1.02, usual)), { frame, treeView, groups };
  }
  /** Chooses, moves and poses blades, and draws the maps of shadows. */
  prepare(input, view) {
    let { frame, treeView, groups } = this.choose(input, view), rows = shadowRows(view, input.camera, frame.light.sunDirection, frame.shadowDistance), casters = frame.light.sunColor[0] > 0 ? this.tree.groupsOf({ ...treeView, planes: shadowPlanes(rows), minWidth: 0 }, input.maxBlades ?? usualMax, shadowClass) : void 0;
    return this.parts.prepare(frame, groups, casters, shadowPlanes(rows), input.elapsed), { groups, stats: { blades: groups.blades, missing: groups.missing } };
  }
  /** Distance beyond which a sown field is drawn sparsely: frameOf() of src/render/frame/frame.cpp. */
  sparseFrom(view) {
    let { low, high } = this.scene.content, gap = [0, 1, 2].map((i) => Math.max(low[i] - view.eye[i], view.eye[i] - high[i], 0)), full = this.scene.bladeWidth * view.pixelsPerUnit / this.lodThreshold;
    return this.sowing.sparseDistance(low, high, full, size(gap));
  }
  /** Records of the blades that the last draw() posed; 24 words each. For tests. */
  readRecords() {
    return this.parts.readRecords();
  }
  get isLost() {
    return this.gl.isContextLost();
  }
}, shadowDistance = 8, Parts = class {
  constructor(gl, field, scene, sowing2) {
    this.gl = gl;
    this.field = field;
    this.scene = scene;
    this.sowing = sowing2;
    let programs = {
      move: new Program(gl, "move", moveVert, moveFrag),
      pose: new Program(gl, "pose", poseVert, nothingFrag, captured),
      blade: new Program(gl, "blade", bladeVert, bladeFrag),
      ground: new Program(gl, "ground", groundVert, groundFrag),
      sky: new Program(gl, "sky", skyVert, skyFrag),
      film: new Program(gl, "film", filmVert, filmFrag),
      sun: new Program(gl, "sun", sunVert, nothingFrag),
      bladeShadow: new Program(gl, "blade shadow", bladeShadowVert, bladeShadowFrag)
    };
    this.move = programs.move.finish(), this.pose = programs.pose.finish(), this.blade = programs.blade.finish(), this.ground = programs.ground.finish(), this.sky = programs.sky.finish(), this.film = programs.film.finish(), this.sun = programs.sun.finish(), this.bladeShadow = programs.bladeShadow.finish(), this.uploaded = new Uint8Array(field.pageCount), this.sownRow = (sowing2?.firstBlade ?? 0) / tableWidth, this.stateRows = sowing2 ? this.sownRow + sowing2.pageCount : Math.max(Math.ceil(field.bladeCount / tableWidth), 1);
    let most = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    this.stateRows > most && fail("unsupported", `${field.name}: ${this.stateRows * tableWidth} blades, more than ${most * tableWidth} on this device`), this.blades = makeTexture(gl, gl.RGBA32UI, tableWidth, this.stateRows), this.states = [0, 1].map(() => makeTexture(gl, gl.R32UI, tableWidth, this.stateRows)), this.stateTargets = this.states.map((states) => {
      let target = makeTarget(gl, states);
      return gl.clearBufferuiv(gl.COLOR, 0, [unsettledTurn, 0, 0, 0]), target;
    }), this.patches = patchTable(gl, sowing2?.patches ?? field.patches), this.cover = wordTable(gl, scene.cover.corners), this.sunMap = makeTexture(gl, gl.DEPTH_COMPONENT24, sunMapSize, sunMapSize), this.sunTarget = makeTarget(gl, null, this.sunMap), this.shadowMap = makeTexture(gl, gl.RG32UI, bladeShadowTexels, bladeShadowTexels);
    let shadowDepth = makeTexture(gl, gl.DEPTH_COMPONENT24, bladeShadowTexels, bladeShadowTexels);
    this.shadowTarget = makeTarget(gl, this.shadowMap, shadowDepth), this.frame = gl.createBuffer(), this.looks = gl.createBuffer(), gl.bindBuffer(gl.UNIFORM_BUFFER, this.looks), gl.bufferData(gl.UNIFORM_BUFFER, looksBlock(field).bytes, gl.STATIC_DRAW), this.groupBuffer = gl.createBuffer(), this.groupArray = gl.createVertexArray(), this.records = gl.createBuffer(), this.feedback = gl.createTransformFeedback(), this.ribbonArray = gl.createVertexArray(), this.indices = classes.map(({ segments, columns }) => ribbonIndices(gl, segments, columns)), this.nothing = gl.createVertexArray(), this.groundArray = groundArrayOf(gl, field);
    let white = imageTexture(gl), images = field.ground.images.map((image) => imageTexture(gl, image));
    this.groundParts = field.ground.ranges.filter((range) => range.level === 0 && range.indexCount > 0).map((range) => {
      let material = field.ground.materials[range.material];
      return {
        first: range.firstIndex,
        count: range.indexCount,
        color: material.baseColor.slice(0, 3),
        isDoubleSided: material.isDoubleSided,
        image: images[material.image] ?? white
      };
    }), gl.bindVertexArray(null), gl.enable(gl.DEPTH_TEST), gl.depthFunc(gl.LEQUAL);
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
    let { gl, field } = this;
    if (this.sowing && this.uploadSown(this.sowing), field.presentPages === 0) return;
    let words = pageBlades * bladeWords;
    gl.activeTexture(gl.TEXTURE0), gl.bindTexture(gl.TEXTURE_2D, this.blades);
    for (let page = 0; page < field.pageCount; ++page) {
      if (this.uploaded[page] || !field.has(page * pageBlades, 1)) continue;
      let end = page + 1;
      if (page % 2 === 0)
        for (; end < field.pageCount && !this.uploaded[end] && field.has(end * pageBlades, 1); ) ++end;
      let data = field.packed.subarray(page * words, end * words), width = end - page > 1 ? tableWidth : pageBlades, rows = Math.ceil((end - page) / 2);
      if (data.length < width * rows * bladeWords) {
        let padded = new Uint32Array(width * rows * bladeWords);
        padded.set(data), data = padded;
      }
      let x = page % 2 * pageBlades;
      gl.texSubImage2D(gl.TEXTURE_2D, 0, x, page >> 1, width, rows, gl.RGBA_INTEGER, gl.UNSIGNED_INT, data), this.uploaded.fill(1, page, end);
    }
  }
  /** The same for what is sown: a row of blades, unsettled, and a quarter of a row of patches each. */
  uploadSown(sowing2) {
    let { gl } = this, unsettled = new Uint32Array(tableWidth).fill(unsettledTurn);
    gl.activeTexture(gl.TEXTURE0);
    for (let { page, blades } of sowing2.changed) {
      let row = this.sownRow + page;
      gl.bindTexture(gl.TEXTURE_2D, this.blades), gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, tableWidth, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, blades);
      for (let states of this.states)
        gl.bindTexture(gl.TEXTURE_2D, states), gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, tableWidth, 1, gl.RED_INTEGER, gl.UNSIGNED_INT, unsettled);
      let first = sowing2.firstPatch + sownPagePatches * page, texels = patchTexelsOf(sowing2.patches, first, first + sownPagePatches);
      gl.bindTexture(gl.TEXTURE_2D, this.patches);
      let [x, y] = [patchTexels * (first % patchesOfRow), Math.floor(first / patchesOfRow)];
      gl.texSubImage2D(gl.TEXTURE_2D, 0, x, y, patchTexels * sownPagePatches, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, texels);
    }
    sowing2.changed = [];
  }
  /** Moves and poses the blades, and draws the maps of shadows. */
  prepare(input, groups, casters, sunPlanes, elapsed) {
    let { gl } = this, block = frameBlock(this.scene, input);
    if (this.setFrame(block), bindTexture(gl, "bladeTexture", this.blades), bindTexture(gl, "patchTexture", this.patches), bindTexture(gl, "coverTexture", this.cover), bindTexture(gl, "sunTexture", this.sunMap), bindTexture(gl, "bladeShadowTexture", this.shadowMap), gl.disable(gl.BLEND), this.drawSunMap(input.light.sunDirection), this.setGroups(groups), this.moveBlades(groups, elapsed), gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget), gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]), casters) {
      let bySun = frameBlock(this.scene, input);
      sunPlanes.forEach((plane, i) => bySun.floats(`view.planes[${i}]`, plane)), bySun.floats("view.minWidth", [0]), bySun.floats("fixedTessellation", [bladeShadowSegments]), bySun.words("view.cullMask", [cullDistance | cullFrustum | leaveThinned]), this.setFrame(bySun), this.setGroups(casters), this.poseBlades(casters), gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget), gl.viewport(0, 0, bladeShadowTexels, bladeShadowTexels), gl.clearBufferfv(gl.DEPTH, 0, [1]), this.drawRibbons(this.bladeShadow, casters), this.setFrame(block), this.setGroups(groups);
    }
    this.poseBlades(groups);
  }
  /** Draws a picture of what is prepared onto the canvas. */
  draw(groups, width, height, isFine) {
    let { gl } = this, picture = this.picture;
    (!picture || picture.width !== width || picture.height !== height || picture.isFine !== isFine) && (picture?.delete(), picture = this.picture = new Picture(gl, width, height, isFine)), picture.resolved.forEach((_, sample) => {
      let place = isFine ? samplePlaces[sample] : [0.5, 0.5], jitter = [(2 * place[0] - 1) / width, (2 * place[1] - 1) / height], offset = [place[0] - 0.5, place[1] - 0.5];
      picture.begin(), this.blade.use(), gl.uniform2fv(this.blade.place("jitter"), jitter), gl.uniform2fv(this.blade.place("sampleOffset"), offset), gl.uniform1ui(this.blade.place("samples"), picture.resolved.length), gl.uniform1ui(this.blade.place("sampleOfPixel"), sample), this.drawRibbons(this.blade, groups), this.ground.use(), gl.uniform2fv(this.ground.place("jitter"), jitter), gl.uniform2fv(this.ground.place("sampleOffset"), offset), this.drawGround(this.ground), this.sky.use(), gl.bindVertexArray(this.nothing), gl.drawArrays(gl.TRIANGLES, 0, 3), picture.end(sample);
    }), gl.bindFramebuffer(gl.FRAMEBUFFER, null), gl.viewport(0, 0, width, height), gl.disable(gl.DEPTH_TEST);
    for (let [i, unit2] of ["resolved", "resolved1", "resolved2", "resolved3"].entries())
      bindTexture(gl, unit2, picture.resolved[i] ?? picture.resolved[0]);
    this.film.use(), gl.uniform1i(this.film.place("hasSamples"), isFine ? 1 : 0), gl.drawArrays(gl.TRIANGLES, 0, 3), gl.enable(gl.DEPTH_TEST), gl.bindVertexArray(null);
  }
  /** Draws what is prepared into the framebuffer that is bound, with its depth. */
  drawInHost(groups, isLinear, hasGround) {
    let { gl } = this, { blade, ground } = this.hostPrograms ??= {
      blade: new Program(gl, "blade of a host", bladeVert, hostBladeFrag).finish(),
      ground: new Program(gl, "ground of a host", groundVert, hostGroundFrag).finish()
    };
    blade.use(), gl.uniform2f(blade.place("jitter"), 0, 0), gl.uniform1ui(blade.place("samples"), 1), gl.uniform1ui(blade.place("sampleOfPixel"), 0), gl.uniform1i(blade.place("isLinear"), isLinear ? 1 : 0), this.drawRibbons(blade, groups), hasGround && (ground.use(), gl.uniform2f(ground.place("jitter"), 0, 0), gl.uniform1i(ground.place("isLinear"), isLinear ? 1 : 0), this.drawGround(ground));
  }
  readRecords() {
    let { gl } = this, words = new Uint32Array(recordBytes / 4 * this.recordCount);
    return gl.bindBuffer(gl.COPY_READ_BUFFER, this.records), gl.getBufferSubData(gl.COPY_READ_BUFFER, 0, words), gl.bindBuffer(gl.COPY_READ_BUFFER, null), words;
  }
  setFrame(block) {
    let { gl } = this;
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.frame), gl.bufferData(gl.UNIFORM_BUFFER, block.bytes, gl.DYNAMIC_DRAW), gl.bindBufferBase(gl.UNIFORM_BUFFER, firstBlock, this.frame), gl.bindBufferBase(gl.UNIFORM_BUFFER, firstBlock + 1, this.looks);
  }
  /** The ground as the sun sees it, when the sun has moved. */
  drawSunMap(sun) {
    let { gl } = this;
    if (this.sunOf !== sun.join()) {
      this.sunOf = sun.join(), gl.bindFramebuffer(gl.FRAMEBUFFER, this.sunTarget), gl.viewport(0, 0, sunMapSize, sunMapSize), gl.clear(gl.DEPTH_BUFFER_BIT), this.sun.use(), gl.bindVertexArray(this.groundArray);
      for (let part of this.groundParts) gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 4 * part.first);
    }
  }
  setGroups(groups) {
    let { gl } = this;
    gl.bindVertexArray(this.groupArray), gl.bindBuffer(gl.ARRAY_BUFFER, this.groupBuffer), gl.bufferData(gl.ARRAY_BUFFER, groups.words, gl.DYNAMIC_DRAW), gl.enableVertexAttribArray(0), gl.vertexAttribDivisor(0, 1);
  }
  /** Draws a point for each blade of the groups of some classes. */
  drawGroups(begin, end) {
    let { gl } = this;
    gl.vertexAttribIPointer(0, 3, gl.UNSIGNED_INT, 12, 12 * begin), gl.drawArraysInstanced(gl.POINTS, 0, groupBlades, end - begin);
  }
  moveBlades(groups, elapsed) {
    let { gl } = this, all = groups.begins[classes.length];
    all !== 0 && (bindTexture(gl, "stateTexture", this.states[this.newest]), this.newest = 1 - this.newest, gl.bindFramebuffer(gl.FRAMEBUFFER, this.stateTargets[this.newest]), gl.viewport(0, 0, tableWidth, this.stateRows), gl.disable(gl.DEPTH_TEST), this.move.use(), gl.uniform1f(this.move.place("elapsed"), elapsed), gl.uniform1f(this.move.place("stateRows"), this.stateRows), gl.bindVertexArray(this.groupArray), gl.bindBuffer(gl.ARRAY_BUFFER, this.groupBuffer), this.drawGroups(0, all), gl.enable(gl.DEPTH_TEST));
  }
  poseBlades(groups) {
    let { gl } = this, all = groups.begins[classes.length];
    this.recordCount = all * groupBlades, all !== 0 && (this.recordRoom < this.recordCount && (this.recordRoom = Math.ceil(1.25 * all) * groupBlades, gl.bindBuffer(gl.COPY_WRITE_BUFFER, this.records), gl.bufferData(gl.COPY_WRITE_BUFFER, this.recordRoom * recordBytes, gl.DYNAMIC_COPY), gl.bindBuffer(gl.COPY_WRITE_BUFFER, null)), bindTexture(gl, "stateTexture", this.states[this.newest]), this.pose.use(), gl.bindVertexArray(this.groupArray), gl.bindBuffer(gl.ARRAY_BUFFER, this.groupBuffer), gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, this.feedback), gl.enable(gl.RASTERIZER_DISCARD), classes.forEach(({ segments }, i) => {
      let [begin, end] = [groups.begins[i], groups.begins[i + 1]];
      if (begin === end) return;
      let step = recordBytes * groupBlades;
      gl.bindBufferRange(gl.TRANSFORM_FEEDBACK_BUFFER, 0, this.records, begin * step, (end - begin) * step), gl.uniform1f(this.pose.place("maxSegments"), segments), gl.beginTransformFeedback(gl.POINTS), this.drawGroups(begin, end), gl.endTransformFeedback();
    }), gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null), gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, null), gl.disable(gl.RASTERIZER_DISCARD));
  }
  drawRibbons(program, groups) {
    let { gl } = this;
    program.use(), gl.bindVertexArray(this.ribbonArray), gl.bindBuffer(gl.ARRAY_BUFFER, this.records), classes.forEach(({ segments, columns }, i) => {
      let [begin, end] = [groups.begins[i], groups.begins[i + 1]];
      if (begin === end) return;
      for (let attribute = 0; attribute < captured.length; ++attribute) {
        gl.enableVertexAttribArray(attribute), gl.vertexAttribDivisor(attribute, 1);
        let at = begin * groupBlades * recordBytes + 16 * attribute;
        gl.vertexAttribIPointer(attribute, 4, gl.UNSIGNED_INT, recordBytes, at);
      }
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indices[i]), gl.uniform1ui(program.place("columns"), columns);
      let count = 6 * segments * (columns - 1);
      gl.drawElementsInstanced(gl.TRIANGLES, count, gl.UNSIGNED_SHORT, 0, (end - begin) * groupBlades);
    });
  }
  drawGround(program) {
    let { gl } = this;
    gl.bindVertexArray(this.groundArray);
    for (let part of this.groundParts)
      bindTexture(gl, "baseColor", part.image), gl.uniform3fv(program.place("materialColor"), part.color), gl.uniform1i(program.place("isDoubleSided"), part.isDoubleSided ? 1 : 0), part.isDoubleSided ? gl.disable(gl.CULL_FACE) : gl.enable(gl.CULL_FACE), gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 4 * part.first);
    gl.disable(gl.CULL_FACE);
  }
};

// src/render/webgpu/device.ts
var atomic64 = "atomic-vec2u-min-max";
async function openDevice({
  gpu = globalThis.navigator?.gpu,
  acceptsSoftware = !1,
  only32 = !1
} = {}) {
  let adapter = await gpu?.requestAdapter({ powerPreference: "high-performance" }).catch(() => null);
  if (!adapter || adapter.info?.isFallbackAdapter && !acceptsSoftware) return;
  let { maxBufferSize, maxStorageBufferBindingSize } = adapter.limits, features = [...only32 ? [] : [atomic64], "timestamp-query"].filter((one) => adapter.features.has(one));
  return adapter.requestDevice({ requiredFeatures: features, requiredLimits: { maxBufferSize, maxStorageBufferBindingSize } }).catch(() => {
  });
}
var hasAtomic64 = (device) => device.features.has(atomic64);
function overridesOf(field) {
  let looks = field.species.flatMap((one) => [one, ...one.organs]), shapes = new Set(looks.map((one) => one.shape));
  return {
    mayFold: looks.some((one) => one.fold > 0) ? 1 : 0,
    mayHaveOrgans: field.species.some((one) => one.organs.length > 0) ? 1 : 0,
    onlyShape: shapes.size === 1 ? looks[0].shape : shapeCount
  };
}

// src/generated/wgsl.ts
var pieces2 = [
  "const octahedralMaxError:f32=0.0112;",
  `struct Patch {
 boundsLow:vec3f,
 firstBlade:u32,
 boundsHigh:vec3f,
 bladeCount:u32,
 rootLow:vec3f,
 rootStep:f32,
 coneAxis:vec3f,
 coneCosine:f32,
 heightLow:f32,
 heightStep:f32,
 widthLow:f32,
 widthStep:f32,
 parent:u32,
 firstChild:u32,
 childCount:u32,
 level:u32,
 rankLow:f32,
 rankHigh:f32,
}`,
  `struct BladeShadow {
 @align(16) across:vec4f,
 down:vec4f,
 depth:vec4f,
 size:u32,
 nearer:f32,
}`,
  `struct Cover {
 @align(16) low:vec3f,
 cellsPerMetre:f32,
 countX:u32,
 countY:u32,
 countZ:u32,
 farthest:f32,
 undergrowth:vec3f,
 thatch:f32,
 sward:vec3f,
 thinned:f32,
 structure:f32,
 stepsPerMetre:f32,
 leaves:array<vec4u,8>,
}`,
  "const leafExtinction:f32=0.46;",
  "const cullPatch:u32=1u;",
  "const cullDistance:u32=8u;",
  "const leaveThinned:u32=32u;",
  `fn planeDistance(plane:vec4f,point:vec3f) -> f32 {
 return dot(vec3f(plane.x,plane.y,plane.z),point)+plane.w;
}`,
  `fn boxOutside(plane:vec4f,low:vec3f,high:vec3f) -> bool {
 let farthest=vec3f(select(low.x,high.x,plane.x >= 0.0),select(low.y,high.y,plane.y >= 0.0),select(low.z,high.z,plane.z >= 0.0));
 return planeDistance(plane,farthest) < 0.0;
}`,
  `fn boxDistance(eye:vec3f,low:vec3f,high:vec3f) -> f32 {
 return length(max(max(low - eye,eye - high),vec3f(0.0)));
}`,
  "const lodFullShare:f32=1.0 / 0.9;",
  `fn lodShare(pixels:f32,threshold:f32) -> f32 {
 return clamp(pixels / threshold,1.0 / 256.0,lodFullShare);
}`,
  "const flattestRay:f32=1.0 / 96.0;",
  "const maxLeafArea:f32=64.0;",
  `fn leafAreaShare(most:f32,leafArea:f32,cosine:f32,pixels:f32) -> f32 {
 let wide=max(pixels*pixels,1.0);
 return clamp(most*wide*wide*max(cosine,flattestRay) / (leafExtinction*max(leafArea,1e-6)),1.0 / 256.0,lodFullShare);
}`,
  "const maxHeightCompensation:f32=1.3;",
  `fn heightCompensation(share:f32,one:f32,spread:f32) -> f32 {
 if (share >= 1.0) {
  return 1.0;
 }
 let full=min(one,1.0);
 let sunk=pow(full / share,1.0 / 3.0) - pow(full,1.0 / 3.0);
 let rise=clamp(1.0+(0.4+0.2*spread)*sunk,1.0,maxHeightCompensation);
 return floor(rise*1024.0+0.5) / 1024.0;
}`,
  `fn leafAreaLight(share:f32,spread:f32) -> f32 {
 return select(pow(share,1.0 / (1.0+0.8*spread)),1.0,share >= 1.0);
}`,
  `struct WindSource {
 @align(16) direction:vec3f,
 strength:f32,
 centre:vec3f,
 size:f32,
 speed:f32,
 rate:f32,
 turn:f32,
 alignment:f32,
 lift:f32,
 kind:u32,
 side:vec3f,
 perSize:f32,
}`,
  `struct WindPhase {
 @align(16) shift:vec3f,
 cell:u32,
 fineShift:vec3f,
 fineCell:u32,
 angle:f32,
 turned:f32,
}`,
  `struct WindLattice {
 @align(16) origin:vec3f,
 x:vec3f,
 y:vec3f,
 z:vec3f,
}`,
  `struct Wind {
 @align(16) counts:u32,
 eddySize:f32,
 eddySpeed:f32,
 sum:f32,
 eddyPhase:vec3f,
 lattice:WindLattice,
 sources:array<WindSource,8>,
 phases:array<WindPhase,8>,
}`,
  `struct Gravity {
 @align(16) direction:vec3f,
 strength:f32,
 attractor:vec3f,
 blend:f32,
 forward:f32,
}`,
  `struct Environment {
 @align(16) gravity:Gravity,
 recovery:f32,
 colliderCount:u32,
 wind:Wind,
}`,
  `struct Eyepoint {
 @align(16) planes:array<vec4f,6>,
 eye:vec3f,
 drawDistance:f32,
 pixelsPerUnit:f32,
 lodThreshold:f32,
 lodWidth:f32,
 minWidth:f32,
 maxLeafArea:f32,
 maxEdgeOn:f32,
 samples:u32,
 buckets:f32,
 bucketDistance:f32,
 cullMask:u32,
 areaFactor:f32,
 sparseFrom:f32,
 sparseLeast:f32,
}`,
  `struct FloorPlane {
 @align(16) middle:vec3f,
 reach:f32,
 along:vec3f,
 height:f32,
 halfSides:vec2f,
 cornerRadius:f32,
}`,
  "const pyramidFactorBits:u32=2u;",
  `fn pyramidCells(pixels:u32,level:u32) -> u32 {
 let bits=pyramidFactorBits*(level+1u);
 return max((pixels+(1u << bits) - 1u) >> bits,1u);
}`,
  `struct ScreenBox {
 low:vec2i,
 high:vec2i,
 nearest:f32,
 isKnown:bool,
}`,
  `fn screenBoxOf(viewProjection:mat4x4f,size:vec2u,low:vec3f,high:vec3f) -> ScreenBox {
 var box:ScreenBox;
 var lowest=vec2f(1e30);
 var highest=vec2f(-1e30);
 box.nearest=0.0;
 box.isKnown=true;
 for (var i=0u; i < 8u; i++) {
  let corner=vec4f(select(low.x,high.x,(i & 1u)!=0u),select(low.y,high.y,(i & 2u)!=0u),select(low.z,high.z,(i & 4u)!=0u),1.0);
  let clip=viewProjection*corner;
  if (!(clip.w > 0.0)||clip.z > clip.w) {
   box.isKnown=false;
   box.low=vec2i(0);
   box.high=vec2i(0);
   return box;
  }
  let place=vec2f(clip.x,clip.y) / clip.w;
  lowest=min(lowest,place);
  highest=max(highest,place);
  box.nearest=max(box.nearest,clip.z / clip.w);
 }
 let pixels=vec2f(f32(size.x),f32(size.y));
 let last=pixels - vec2f(1.0);
 lowest=clamp(floor((lowest*0.5+vec2f(0.5))*pixels) - vec2f(1.0),vec2f(0.0),last);
 highest=clamp(floor((highest*0.5+vec2f(0.5))*pixels)+vec2f(1.0),vec2f(0.0),last);
 box.low=vec2i(i32(lowest.x),i32(lowest.y));
 box.high=vec2i(i32(highest.x),i32(highest.y));
 return box;
}`,
  "const pyramidReach:i32=4;",
  `fn pyramidLevelFor(box:ScreenBox,levels:u32) -> u32 {
 let extent=max(box.high.x - box.low.x,box.high.y - box.low.y);
 let level=u32(max(i32(firstLeadingBit(extent)) - 2,0)) / pyramidFactorBits;
 let bits=pyramidFactorBits*(level+1u);
 let fits=(box.high.x >> bits) - (box.low.x >> bits) < pyramidReach&&(box.high.y >> bits) - (box.low.y >> bits) < pyramidReach;
 return min(select(level+1u,level,fits),levels - 1u);
}`,
  "const outlineMost:f32=1.35;",
  `struct LevelSteps {
 @align(16) distance_:vec4f,
 segments:vec4f,
 count:u32,
}`,
  `struct SunShadow {
 @align(16) across:vec4f,
 down:vec4f,
 depth:vec4f,
 size:u32,
 texel:f32,
 epsilon:f32,
 reserved:u32,
}`,
  `struct UpdateRate {
 @align(16) everyFrame:f32,
 everyThird:f32,
 longest:f32,
 frame:u32,
}`,
  `struct Frame {
 @align(16) viewProjection:mat4x4f,
 rays:array<vec3f,3>,
 depthOfEye:f32,
 view:Eyepoint,
 environment:Environment,
 patchCount:u32,
 bladeCount:u32,
 visibleCapacity:u32,
 maxTessellation:u32,
 sunDirection:vec3f,
 exposure:f32,
 sunColor:vec3f,
 debugMode:u32,
 skyColor:vec3f,
 fogDensity:f32,
 groundColor:vec3f,
 skyUp:vec3f,
 fixedTessellation:f32,
 clouds:f32,
 levelSteps:LevelSteps,
 updateRate:UpdateRate,
 cover:Cover,
 shadow:SunShadow,
 bladeShadow:BladeShadow,
 fogFalloff:f32,
 lowSun:f32,
 tick:u32,
 floorPlane:FloorPlane,
 reserved:array<vec4u,36>,
}`,
  "@group(0) @binding(0) var<uniform> frameConstants_:Frame;",
  `struct Pyramid {
 @align(16) size:vec2u,
 first:array<vec4u,7>,
 levels:u32,
}`,
  `struct Push {
 @align(16) pyramid:Pyramid,
 size:vec2u,
 patchCount:u32,
 tick:u32,
 isIdPass:u32,
 firstBlade:u32,
 capacity:u32,
}`,
  "@group(0) @binding(2) var<uniform> push_:Push;",
  "@group(0) @binding(5) var<storage,read> patches_:array<Patch>;",
  "@group(0) @binding(10) var<storage,read_write> visiblePatches_:array<VisiblePatch>;",
  "@group(0) @binding(12) var<storage,read_write> counters_:array<atomic<u32>>;",
  "const countPatches:u32=0u;",
  "const groupsOfRow:u32=4096u;",
  `struct VisiblePatch {
 patchIndex:u32,
 count:u32,
}`,
  "const pageBlades:u32=1024u;",
  `fn sectionMargin(distance_:f32,minWidth:f32) -> f32 {
 return minWidth*distance_;
}`,
  `fn sparseShare(view:Eyepoint,share:f32,distance_:f32) -> f32 {
 if (view.sparseFrom <= 0.0||distance_ <= view.sparseFrom) {
  return 1.0;
 }
 let nearness=view.sparseFrom / distance_;
 return max(nearness*nearness*nearness,min(view.sparseLeast / share,1.0));
}`,
  `fn leavesPerDrawn(view:Eyepoint,distance_:f32) -> f32 {
 if (view.sparseFrom <= 0.0||distance_ <= view.sparseFrom||view.lodThreshold <= 0.0) {
  return 1.0;
 }
 let share=lodShare(view.lodWidth*view.pixelsPerUnit / max(distance_,1e-6),view.lodThreshold);
 return 1.0 / sqrt(sparseShare(view,share,distance_));
}`,
  `fn shareAt(view:Eyepoint,distance_:f32) -> f32 {
 if (view.lodThreshold <= 0.0) {
  return lodFullShare;
 }
 let share=lodShare(view.lodWidth*view.pixelsPerUnit / max(distance_,1e-6),view.lodThreshold);
 return share*sparseShare(view,share,distance_);
}`,
  `fn middleWidth(cell:Patch) -> f32 {
 return cell.widthLow+31.5*cell.widthStep;
}`,
  `fn leafAreaAround(cell:Patch) -> f32 {
 let fewest=4u;
 if (cell.bladeCount < fewest) {
  return 0.0;
 }
 let count=f32(cell.bladeCount);
 let side=65535.0*cell.rootStep*(count+1.0) / (count - 1.0);
 let around=count / max(cell.rankHigh - cell.rankLow,1e-6);
 let height=cell.heightLow+127.5*cell.heightStep;
 return min(0.7*around*middleWidth(cell)*height / max(side*side,1e-12),maxLeafArea);
}`,
  `fn steepestRay(eye:vec3f,cell:Patch) -> f32 {
 let low=cell.boundsLow - eye;
 let high=cell.boundsHigh - eye;
 let middle=0.5*(low+high);
 let above=abs(dot(cell.coneAxis,middle))+dot(abs(cell.coneAxis),0.5*(high - low));
 let nearest=max(boxDistance(eye,cell.boundsLow,cell.boundsHigh),1e-6);
 let slope=sqrt(max(1.0 - cell.coneCosine*cell.coneCosine,0.0));
 return min(above / nearest+max(slope - octahedralMaxError,0.0),1.0);
}`,
  `struct LeafAreaLimit {
 share:f32,
 height:f32,
 light:f32,
}`,
  `fn noLeafAreaLimit() -> LeafAreaLimit {
 var limit:LeafAreaLimit;
 limit.share=lodFullShare;
 limit.height=1.0;
 limit.light=1.0;
 return limit;
}`,
  `fn leafAreaLimitOf(view:Eyepoint,cell:Patch) -> LeafAreaLimit {
 var limit=noLeafAreaLimit();
 if (view.maxLeafArea <= 0.0) {
  return limit;
 }
 let nearest=max(boxDistance(view.eye,cell.boundsLow,cell.boundsHigh),1e-6);
 let pixels=middleWidth(cell)*view.pixelsPerUnit / nearest;
 if (leafAreaShare(view.maxLeafArea,maxLeafArea,0.0,pixels) >= lodFullShare) {
  return limit;
 }
 let leafArea=min(view.areaFactor*leafAreaAround(cell),maxLeafArea);
 let cosine=steepestRay(view.eye,cell);
 limit.share=leafAreaShare(view.maxLeafArea,leafArea,cosine,pixels);
 let range=255.0*cell.heightStep;
 let spread=min(2.0*range / max(cell.heightLow+range,1e-6),1.0);
 limit.height=heightCompensation(limit.share,leafAreaShare(1.0,leafArea,cosine,1.0),spread);
 limit.light=leafAreaLight(limit.share,spread);
 return limit;
}`,
  `fn patchMargin(view:Eyepoint,cell:Patch,widest:f32) -> f32 {
 let farthest=max(abs(cell.boundsLow - view.eye),abs(cell.boundsHigh - view.eye));
 let share=shareAt(view,length(farthest));
 let size=cell.boundsHigh - cell.boundsLow;
 let highest=0.5*min(size.x,min(size.y,size.z));
 return 0.5*outlineMost*widest / (0.95*share*leavesPerDrawn(view,length(farthest)))+sectionMargin(length(farthest),view.minWidth)+select(0.0,(maxHeightCompensation - 1.0)*highest,view.maxLeafArea > 0.0);
}`,
  `fn thickEnough(view:Eyepoint,cell:Patch) -> u32 {
 if ((view.cullMask & leaveThinned)==0u||view.lodThreshold <= 0.0) {
  return cell.bladeCount;
 }
 let thinned=shareAt(view,boxDistance(view.eye,cell.boundsLow,cell.boundsHigh));
 let share=min(thinned,min(thinned,1.0)*leafAreaLimitOf(view,cell).share);
 if (share <= cell.rankLow) {
  return 0u;
 }
 if (share >= cell.rankHigh) {
  return cell.bladeCount;
 }
 let count=f32(cell.bladeCount);
 let first=(share - cell.rankLow) / (cell.rankHigh - cell.rankLow)*count;
 return min(u32(ceil(first))+1u,cell.bladeCount);
}`,
  `fn patchCulled(view:Eyepoint,cell:Patch,widest:f32) -> bool {
 if ((view.cullMask & cullPatch)==0u) {
  return false;
 }
 let margin=patchMargin(view,cell,widest);
 let low=cell.boundsLow - vec3f(margin);
 let high=cell.boundsHigh+vec3f(margin);
 var outside=false;
 for (var i=0u; i < 6u; i++) {
  outside=outside||boxOutside(view.planes[i],low,high);
 }
 if (outside) {
  return true;
 }
 return (view.cullMask & cullDistance)!=0u&&boxDistance(view.eye,cell.boundsLow,cell.boundsHigh) > view.drawDistance;
}`,
  "@group(0) @binding(19) var<storage,read> cellBits_:array<u32>;",
  `fn fetch_cells(i:u32) -> f32 {
 return bitcast<f32>(cellBits_[i]);
}`,
  `fn behindPyramid(box:ScreenBox) -> bool {
 let level=pyramidLevelFor(box,push_.pyramid.levels);
 let bits=pyramidFactorBits*(level+1u);
 if (any((box.high >> vec2u(bits)) - (box.low >> vec2u(bits)) >= vec2i(pyramidReach))) {
  return false;
 }
 let row=pyramidCells(push_.pyramid.size.x,level);
 let first=push_.pyramid.first[level].x;
 let nearest=box.nearest*1.00001;
 let low=box.low >> vec2u(bits);
 let high=box.high >> vec2u(bits);
 for (var y=low.y; y <= high.y; y++) {
  for (var x=low.x; x <= high.x; x++) {
   if (fetch_cells(first+u32(y)*row+u32(x)) <= nearest) {
    return false;
   }
  }
 }
 return true;
}`,
  `fn isHidden(low:vec3f,high:vec3f) -> bool {
 if (push_.pyramid.levels==0u) {
  return false;
 }
 let box=screenBoxOf(frameConstants_.viewProjection,push_.pyramid.size,low,high);
 return box.isKnown&&behindPyramid(box);
}`,
  "@group(0) @binding(14) var<storage,read> widest_:array<f32>;",
  "@group(0) @binding(15) var<storage,read> present_:array<u32>;",
  `fn isHere(page:u32) -> bool {
 return (present_[page / 32u] & (1u << (page % 32u)))!=0u;
}`,
  `@compute @workgroup_size(64,1,1)
fn main(@builtin(workgroup_id) WorkGroupID_:vec3u,@builtin(global_invocation_id) GlobalInvocationID_:vec3u) {
 let node=WorkGroupID_.y*groupsOfRow*64u+GlobalInvocationID_.x;
 if (node >= push_.patchCount) {
  return;
 }
 let cell=patches_[node];
 if (cell.bladeCount==0u||patchCulled(frameConstants_.view,cell,widest_[node])) {
  return;
 }
 let margin=vec3f(patchMargin(frameConstants_.view,cell,widest_[node]));
 if (isHidden(cell.boundsLow - margin,cell.boundsHigh+margin)) {
  return;
 }
 let count=thickEnough(frameConstants_.view,cell);
 if (count==0u||!isHere(cell.firstBlade / pageBlades)||!isHere((cell.firstBlade+count - 1u) / pageBlades)) {
  return;
 }
 visiblePatches_[atomicAdd(&counters_[countPatches],1u)]=VisiblePatch(node,count);
}`,
  "@group(0) @binding(12) var<storage,read> counters_:array<u32>;",
  "@group(0) @binding(13) var<storage,read_write> arguments_:array<u32>;",
  "const countBlades:u32=1u;",
  "const countRows:u32=3u;",
  "const argumentsPatches:u32=0u;",
  "const argumentsBlades:u32=4u;",
  "const argumentsRows:u32=8u;",
  "const maxRowBlocks:u32=1u << 20u;",
  "const rowBlocksOfGroup:u32=8u;",
  `fn argue(first:u32,groups:u32,count:u32) {
 arguments_[first]=min(groups,groupsOfRow);
 arguments_[first+1u]=(groups+groupsOfRow - 1u) / groupsOfRow;
 arguments_[first+2u]=1u;
 arguments_[first+3u]=count;
}`,
  `@compute @workgroup_size(1,1,1)
fn main() {
 let cells=min(counters_[countPatches],push_.patchCount);
 argue(argumentsPatches,cells,cells);
 let drawn=min(counters_[countBlades],push_.capacity);
 argue(argumentsBlades,(drawn+63u) / 64u,drawn);
 let rows=min(counters_[countRows],maxRowBlocks);
 argue(argumentsRows,(rows+rowBlocksOfGroup - 1u) / rowBlocksOfGroup,rows);
}`,
  `fn mixUint(x_in:u32) -> u32 {
 var x=x_in;
 x^=x >> 16u;
 x*=0x7feb352du;
 x^=x >> 15u;
 x*=0x846ca68bu;
 x^=x >> 16u;
 return x;
}`,
  "const latticeX:u32=0x9e3779b1u;",
  "const latticeY:u32=0x85ebca77u;",
  "const latticeZ:u32=0xc2b2ae3du;",
  `fn latticePoint(x:i32,y:i32,z:i32) -> u32 {
 return u32(x)*latticeX+u32(y)*latticeY+u32(z)*latticeZ;
}`,
  `fn latticeHeight(point_in:u32) -> f32 {
 var point=point_in;
 point^=point >> 11u;
 point*=0x31848babu;
 return f32(point);
}`,
  "const latticeUnit:f32=1.0 / 4294967296.0;",
  `fn valueNoiseFrom(origin:u32,p:vec3f) -> f32 {
 let cell=floor(p);
 let f=p - cell;
 let s=f*f*(vec3f(3.0) - 2.0*f);
 let near=origin+latticePoint(i32(cell.x),i32(cell.y),i32(cell.z));
 let far=near+latticeZ;
 let nearHeight=mix(mix(latticeHeight(near),latticeHeight(near+latticeX),s.x),mix(latticeHeight(near+latticeY),latticeHeight(near+latticeX+latticeY),s.x),s.y);
 let farHeight=mix(mix(latticeHeight(far),latticeHeight(far+latticeX),s.x),mix(latticeHeight(far+latticeY),latticeHeight(far+latticeX+latticeY),s.x),s.y);
 return latticeUnit*mix(nearHeight,farHeight,s.z);
}`,
  `fn valueNoise(p:vec3f) -> f32 {
 return valueNoiseFrom(0u,p);
}`,
  `fn signNotZero(x:f32) -> f32 {
 return select(-1.0,1.0,x >= 0.0);
}`,
  `fn folded(x:f32,y:f32) -> vec3f {
 let z=1.0 - abs(x) - abs(y);
 var t1_:vec3f;
 if (z >= 0.0) {
  t1_=vec3f(x,y,z);
 } else {
  t1_=vec3f((1.0 - abs(y))*signNotZero(x),(1.0 - abs(x))*signNotZero(y),z);
 }
 let v=t1_;
 return normalize(v);
}`,
  `fn decodeOctahedral(bits:u32) -> vec3f {
 return folded(f32(i32(bits & 255u) - 127)*(1.0 / 127.0),f32(i32((bits >> 8u) & 255u) - 127)*(1.0 / 127.0));
}`,
  `fn packSnorm16(x:f32) -> u32 {
 return u32(i32(floor(clamp(x,-1.0,1.0)*32767.0+0.5))) & 65535u;
}`,
  `fn unpackSnorm16(bits:u32) -> f32 {
 return f32((i32(bits & 65535u) ^ 32768) - 32768)*(1.0 / 32767.0);
}`,
  `fn tangentOf(n:vec3f) -> vec3f {
 let s=signNotZero(n.z);
 let a=-1.0 / (s+n.z);
 return vec3f(1.0+s*n.x*n.x*a,s*n.x*n.y*a,-s*n.x);
}`,
  `fn bitangentOf(n:vec3f) -> vec3f {
 let s=signNotZero(n.z);
 let a=-1.0 / (s+n.z);
 return vec3f(n.x*n.y*a,s+n.y*n.y*a,-n.y);
}`,
  "const twoPi:f32=6.28318530717958647692;",
  `struct PackedBlade {
 rootXY:u32,
 rootZUp:u32,
 shape:u32,
 look:u32,
}`,
  `struct Blade {
 root:vec3f,
 facing:f32,
 up:vec3f,
 stiffness:f32,
 height:f32,
 width:f32,
 exposure:f32,
 species:u32,
 tint:vec3f,
 clump:u32,
 hash:u32,
 seed:u32,
}`,
  `fn seedOf(bits:PackedBlade) -> u32 {
 let kept=(bits.shape & 0xffc000ffu) ^ ((bits.rootZUp >> 16u) << 8u);
 return mixUint(kept+bits.look*0x9e3779b9u) >> 16u;
}`,
  `fn unpackBlade(bits:PackedBlade,cell:Patch) -> Blade {
 var blade:Blade;
 blade.root=cell.rootLow+cell.rootStep*vec3f(f32(bits.rootXY & 65535u),f32(bits.rootXY >> 16u),f32(bits.rootZUp & 65535u));
 blade.up=decodeOctahedral(bits.rootZUp >> 16u);
 blade.facing=f32(bits.shape & 255u)*(twoPi / 256.0);
 blade.height=cell.heightLow+cell.heightStep*f32((bits.shape >> 8u) & 255u);
 blade.width=cell.widthLow+cell.widthStep*f32((bits.shape >> 16u) & 63u);
 blade.stiffness=f32((bits.shape >> 22u) & 63u)*(1.0 / 63.0);
 blade.hash=bits.shape >> 28u;
 blade.tint=vec3f(f32(bits.look & 31u)*(1.0 / 31.0),f32((bits.look >> 5u) & 63u)*(1.0 / 63.0),f32((bits.look >> 11u) & 31u)*(1.0 / 31.0));
 blade.exposure=f32((bits.look >> 16u) & 31u)*(1.0 / 31.0);
 blade.species=(bits.look >> 21u) & 7u;
 blade.clump=bits.look >> 24u;
 blade.seed=seedOf(bits);
 return blade;
}`,
  `fn widthAxis(up:vec3f,facing:f32) -> vec3f {
 return tangentOf(up)*cos(facing)+bitangentOf(up)*sin(facing);
}`,
  `fn frontOf(up:vec3f,axis:vec3f) -> vec3f {
 return cross(up,axis);
}`,
  `struct BladeAxes {
 front:vec3f,
 side:vec3f,
 up:vec3f,
}`,
  `fn axesAlong(up:vec3f,axis:vec3f) -> BladeAxes {
 var axes:BladeAxes;
 axes.front=frontOf(up,axis);
 axes.side=-axis;
 axes.up=up;
 return axes;
}`,
  `fn alongAxes(axes:BladeAxes,v:vec3f) -> vec3f {
 return vec3f(dot(v,axes.front),dot(v,axes.side),dot(v,axes.up));
}`,
  `fn inSpace(axes:BladeAxes,v:vec3f) -> vec3f {
 return v.x*axes.front+v.y*axes.side+v.z*axes.up;
}`,
  "const cullResultDrawn:u32=0u;",
  "const cullResultOrientation:u32=2u;",
  "const cullResultFrustum:u32=3u;",
  "const cullResultDistance:u32=4u;",
  "const cullResultLod:u32=6u;",
  "const cullOrientation:u32=2u;",
  "const cullFrustum:u32=4u;",
  `fn curveOutside(plane:vec4f,v0:vec3f,v1:vec3f,v2:vec3f,margin:f32) -> bool {
 return max(max(planeDistance(plane,v0),planeDistance(plane,v1)),planeDistance(plane,v2)) < -margin;
}`,
  `fn edgeOnCosine(eye:vec3f,root:vec3f,axis:vec3f) -> f32 {
 let ray=root - eye;
 return min(abs(dot(ray,axis)) / max(length(ray),1e-6),1.0);
}`,
  `fn bucketsKeep(buckets:f32,last:f32,distance_:f32,rank:f32) -> bool {
 return buckets <= 0.0||rank*buckets < floor(buckets*(1.0 - distance_ / last));
}`,
  "const lodFade:f32=0.1;",
  `fn lodWidthFactor(rank:f32,share:f32) -> f32 {
 if (share >= lodFullShare) {
  return 1.0;
 }
 let fade=lodFade*share;
 let weight=clamp((share - rank) / fade,0.0,1.0);
 let beyond=max(share - 1.0,0.0);
 let mean=share - 0.5*fade - 0.5*beyond*beyond / fade;
 return weight / mean;
}`,
  `fn leafAreaWeight(rank:f32,share:f32) -> f32 {
 if (share >= lodFullShare) {
  return 1.0;
 }
 return clamp((share - rank) / (lodFade*share),0.0,1.0);
}`,
  `struct ColliderMask {
 words:array<u32,8>,
}`,
  "const windNoise:u32=0u;",
  "const windTurning:u32=1u;",
  "const windWave:u32=2u;",
  "const windRadial:u32=3u;",
  "const windSwirl:u32=4u;",
  "const windGusts:u32=5u;",
  "const windsAlike:u32=1u << 24u;",
  `fn rowOf(m:mat4x4f,i:i32) -> vec3f {
 return vec3f(m[0][i],m[1][i],m[2][i]);
}`,
  `fn screenBoxOfCurve(viewProjection:mat4x4f,size:vec2u,v0:vec3f,v1:vec3f,v2:vec3f,margin:f32) -> ScreenBox {
 let a=viewProjection*vec4f(v0,1.0);
 let b=viewProjection*vec4f(v1,1.0);
 let c=viewProjection*vec4f(v2,1.0);
 let ofW=length(rowOf(viewProjection,3));
 let minW=min(min(a.w,b.w),c.w) - margin*ofW;
 let maxZ=max(max(a.z,b.z),c.z)+margin*length(rowOf(viewProjection,2));
 var box:ScreenBox;
 box.low=vec2i(0);
 box.high=vec2i(0);
 box.nearest=0.0;
 box.isKnown=minW > 0.0&&maxZ <= minW;
 if (!box.isKnown) {
  return box;
 }
 let placeA=vec2f(a.x,a.y)*(1.0 / a.w);
 let placeB=vec2f(b.x,b.y)*(1.0 / b.w);
 let placeC=vec2f(c.x,c.y)*(1.0 / c.w);
 var lowest=min(min(placeA,placeB),placeC);
 var highest=max(max(placeA,placeB),placeC);
 let ofPlace=vec2f(length(rowOf(viewProjection,0)),length(rowOf(viewProjection,1)));
 let perW=1.0 / minW;
 let reach=(ofPlace+max(abs(lowest),abs(highest))*ofW)*(margin*perW);
 let pixels=vec2f(f32(size.x),f32(size.y));
 let last=pixels - vec2f(1.0);
 lowest=floor(((lowest - reach)*0.5+vec2f(0.5))*pixels) - vec2f(1.0);
 highest=floor(((highest+reach)*0.5+vec2f(0.5))*pixels)+vec2f(1.0);
 box.low=vec2i(clamp(lowest,vec2f(0.0),last));
 box.high=vec2i(clamp(highest,vec2f(0.0),last));
 box.nearest=maxZ*perW;
 return box;
}`,
  `fn bezierPoint(v0:vec3f,v1:vec3f,v2:vec3f,t:f32) -> vec3f {
 let a=v0+t*(v1 - v0);
 let b=v1+t*(v2 - v1);
 return a+t*(b - a);
}`,
  `fn bezierTangent(v0:vec3f,v1:vec3f,v2:vec3f,t:f32) -> vec3f {
 return 2.0*((1.0 - t)*(v1 - v0)+t*(v2 - v1));
}`,
  `struct BladeState {
 turn:u32,
 eta:f32,
}`,
  "const unsettledTurn:u32=0x80008000u;",
  `struct Pose {
 v1:vec3f,
 v2:vec3f,
}`,
  `fn directionOfTurn(turn:vec2f) -> vec3f {
 let square=min(dot(turn,turn),1.0);
 return 1.0 / (1.0+square)*vec3f(2.0*turn.x,2.0*turn.y,1.0 - square);
}`,
  `fn stateOfTurn(turn:vec2f,eta:f32) -> BladeState {
 var state:BladeState;
 state.turn=packSnorm16(turn.x) | (packSnorm16(turn.y) << 16u);
 state.eta=eta;
 return state;
}`,
  `fn storedTurn(state:BladeState) -> vec2f {
 return vec2f(unpackSnorm16(state.turn),unpackSnorm16(state.turn >> 16u));
}`,
  `fn storedDirection(state:BladeState) -> vec3f {
 return directionOfTurn(storedTurn(state));
}`,
  `fn lengthCorrection(side:f32) -> f32 {
 if (side > 0.95) {
  return (-0.48620368*side+0.92399928)*side+0.55642926;
 }
 let high=(-1.3481541*side+4.0007265)*side - 4.6675167;
 let low=(high*side+2.7635532)*side - 0.71043977;
 return (low*side - 0.037761414)*side+1.0;
}`,
  `fn tipDistance(direction:vec3f) -> f32 {
 return lengthCorrection(length(vec2f(direction.x,direction.y)));
}`,
  `fn poseOfState(axes:BladeAxes,state:BladeState) -> Pose {
 let direction=storedDirection(state);
 let side=length(vec2f(direction.x,direction.y));
 let scale=lengthCorrection(side);
 var pose:Pose;
 pose.v1=axes.up*(max(1.0 - side,0.05)*scale);
 pose.v2=inSpace(axes,direction*scale);
 return pose;
}`,
  `struct Species {
 @align(16) rootColor:vec3f,
 tipThreshold:f32,
 tipColor:vec3f,
 groundTint:f32,
 colorVariation:f32,
 translucency:f32,
 gloss:f32,
 dryness:f32,
 shape:u32,
 fold:f32,
 firstOrgan:u32,
 organKinds:u32,
}`,
  `struct Organ {
 @align(16) look:Species,
 count:u32,
 place:vec2f,
 pitch:vec2f,
 size:vec2f,
 width:f32,
 azimuth:f32,
 turn:f32,
 bend:f32,
 leg:f32,
 variation:f32,
}`,
  `fn ribbonNumber(species:Species,blade:Blade) -> u32 {
 return select(0u,blade.clump,species.organKinds > 0u);
}`,
  `fn organOf(species:Species,number:u32,within:ptr<function,u32>) -> u32 {
 var kind=species.firstOrgan;
 (*within)=number - 1u;
 while (kind+1u < species.firstOrgan+species.organKinds&&(*within) >= fetch_organs(kind).count) {
  (*within)-=fetch_organs(kind).count;
  kind++;
 }
 return kind;
}`,
  `struct PosedBlade {
 blade:Blade,
 v0:vec3f,
 v1:vec3f,
 v2:vec3f,
 axis:vec3f,
}`,
  `fn posedBlade(blade:Blade,state:BladeState) -> PosedBlade {
 var posed:PosedBlade;
 posed.blade=blade;
 posed.axis=widthAxis(blade.up,blade.facing);
 let pose=poseOfState(axesAlong(blade.up,posed.axis),state);
 posed.v0=blade.root;
 posed.v1=blade.root+blade.height*pose.v1;
 posed.v2=blade.root+blade.height*pose.v2;
 return posed;
}`,
  `fn plantKey(blade:Blade) -> u32 {
 return blade.hash | ((u32(blade.facing*(256.0 / twoPi)+0.5) & 255u) << 4u);
}`,
  `fn organDice(blade:Blade,number:u32,salt:u32) -> f32 {
 return f32(mixUint(plantKey(blade) | (number << 12u) | (salt << 20u)) >> 8u)*(1.0 / 16777215.0) - 0.5;
}`,
  `fn aboveGround(root:vec3f,up:vec3f,v:vec3f) -> vec3f {
 return v - up*min(dot(up,v - root),0.0);
}`,
  `fn posedRibbon(stalk:PosedBlade,organ:Organ,number:u32,within:u32) -> PosedBlade {
 let plant=stalk.blade;
 let share=select(0.0,f32(within) / f32(organ.count - 1u),organ.count > 1u);
 let t=mix(organ.place.x,organ.place.y,share);
 var along=bezierTangent(stalk.v0,stalk.v1,stalk.v2,t);
 along=normalize(select(stalk.v1 - stalk.v0,along,dot(along,along) > 1e-10*plant.height*plant.height));
 var side=stalk.axis - along*dot(along,stalk.axis);
 let level=dot(side,side);
 side=select(plant.up,side*inverseSqrt(level),level > 1e-6);
 let front=cross(along,side);
 let azimuth=organ.azimuth+organ.turn*f32(within)+2.0*organ.variation*organDice(plant,number,0u);
 let pitch=mix(organ.pitch.x,organ.pitch.y,share)+0.8*organ.variation*organDice(plant,number,1u);
 let outwards=cos(azimuth)*side+sin(azimuth)*front;
 var ribbon:PosedBlade;
 ribbon.blade=plant;
 ribbon.blade.height=plant.height*mix(organ.size.x,organ.size.y,share)*(1.0+0.6*organ.variation*organDice(plant,number,2u));
 ribbon.axis=cos(azimuth)*front - sin(azimuth)*side;
 let leg=organ.leg*ribbon.blade.height;
 ribbon.v0=bezierPoint(stalk.v0,stalk.v1,stalk.v2,t);
 let v1=ribbon.v0+leg*(cos(pitch)*along+sin(pitch)*outwards);
 let v2=v1+leg*(cos(pitch+organ.bend)*along+sin(pitch+organ.bend)*outwards);
 ribbon.v1=aboveGround(plant.root,plant.up,v1);
 ribbon.v2=aboveGround(plant.root,plant.up,v2);
 return ribbon;
}`,
  `fn ribbonOf(species:Species,stalk:PosedBlade,number:u32) -> PosedBlade {
 var within=0u;
 let kind=organOf(species,number,&within);
 return posedRibbon(stalk,fetch_organs(kind),number,within);
}`,
  "const ticksPerSecond:f32=262144.0;",
  `fn secondsBetween(then:u32,now:u32) -> f32 {
 return f32(now - then) / ticksPerSecond;
}`,
  "const settlingTime:f32=12.0;",
  `struct VisibleBlade {
 blade:u32,
 patchIndex:u32,
 factors:u32,
 pixels:f32,
}`,
  "const heightFactorBits:u32=0x03ff0000u;",
  `fn packFactors(width:f32,height:f32) -> u32 {
 return pack2x16float(vec2f(width,height)) & (heightFactorBits | 0xffffu);
}`,
  `struct Looks {
 @align(16) species:array<Species,8>,
 organs:array<Organ,32>,
}`,
  "@group(0) @binding(1) var<uniform> looks_:Looks;",
  "@group(0) @binding(3) var<storage,read> blades_:array<PackedBlade>;",
  "@group(0) @binding(4) var<storage,read_write> states_:array<u32>;",
  "@group(0) @binding(10) var<storage,read> visiblePatches_:array<VisiblePatch>;",
  "@group(0) @binding(11) var<storage,read_write> visible_:array<VisibleBlade>;",
  "const countMoved:u32=4u;",
  `fn fetch_species(i:u32) -> Species {
 return looks_.species[i];
}`,
  `fn fetch_organs(i:u32) -> Organ {
 return looks_.organs[i];
}`,
  `struct SampleMask {
 threshold:f32,
 first:u32,
 samples:u32,
}`,
  `fn sampleMaskOf(seed:u32,samples:u32) -> SampleMask {
 var mask:SampleMask;
 mask.threshold=(f32(seed & 0x1fffu)+0.5) / 8192.0;
 mask.first=(seed >> 13u) % samples;
 mask.samples=samples;
 return mask;
}`,
  `fn keptCount(mask:SampleMask,weight:f32) -> u32 {
 return select(mask.samples,u32(max(weight,0.0)*f32(mask.samples)+mask.threshold),weight < 1.0);
}`,
  `fn keptBits(mask:SampleMask,weight:f32) -> u32 {
 let all_=(1u << mask.samples) - 1u;
 let bits=(1u << min(keptCount(mask,weight),mask.samples)) - 1u;
 return ((bits << mask.first) | (bits >> (mask.samples - mask.first))) & all_;
}`,
  `fn keptSamples(weight:f32,seed:u32,samples:u32) -> u32 {
 return keptBits(sampleMaskOf(seed,samples),weight);
}`,
  `struct Verdict {
 cullResult:u32,
 widthFactor:f32,
 pixels:f32,
 margin:f32,
}`,
  `fn raised(blade:Blade,heightFactor:f32) -> Blade {
 var drawn=blade;
 drawn.height=blade.height*heightFactor;
 return drawn;
}`,
  `struct DrawnSize {
 widthFactor:f32,
 pixels:f32,
}`,
  `fn drawnSize(view:Eyepoint,limit:LeafAreaLimit,blade:Blade,rank:f32,distance_:f32) -> DrawnSize {
 let share=shareAt(view,distance_);
 var size:DrawnSize;
 size.widthFactor=lodWidthFactor(rank,share) / leavesPerDrawn(view,distance_)*leafAreaWeight(rank / min(share,1.0),limit.share);
 size.pixels=blade.height*view.pixelsPerUnit / max(distance_,1e-6);
 return size;
}`,
  `fn bladeRank(cell:Patch,i:u32) -> f32 {
 return mix(cell.rankLow,cell.rankHigh,(f32(i)+0.5) / f32(cell.bladeCount));
}`,
  `fn seenTooNarrow(view:Eyepoint,posed:PosedBlade,widthFactor:f32) -> bool {
 let blade=posed.blade;
 let distance_=length(posed.v0 - view.eye);
 let cosine=edgeOnCosine(view.eye,posed.v0,posed.axis);
 if (cosine > view.maxEdgeOn) {
  return true;
 }
 let nearest=distance_ - blade.height;
 if (nearest <= 0.0||view.minWidth <= 0.0) {
  return false;
 }
 let sine=min(sqrt(1.0 - cosine*cosine)+1.58*blade.height / distance_,1.0);
 let widest=outlineMost*blade.width*widthFactor*sine;
 return keptSamples(widest / (view.minWidth*nearest),blade.seed,view.samples)==0u;
}`,
  `fn cullBlade(view:Eyepoint,limit:LeafAreaLimit,posed:PosedBlade,rank:f32) -> Verdict {
 let blade=posed.blade;
 let distance_=length(blade.root - view.eye);
 let size=drawnSize(view,limit,blade,rank,distance_);
 let factor=size.widthFactor;
 var verdict:Verdict;
 verdict.cullResult=cullResultDrawn;
 verdict.widthFactor=factor;
 verdict.pixels=size.pixels;
 verdict.margin=0.5*outlineMost*blade.width*max(factor,1.0)+sectionMargin(distance_+blade.height,view.minWidth);
 var outside=false;
 if ((view.cullMask & cullFrustum)!=0u) {
  for (var i=0u; i < 6u; i++) {
   outside=outside||curveOutside(view.planes[i],posed.v0,posed.v1,posed.v2,verdict.margin);
  }
 }
 if ((view.cullMask & cullOrientation)!=0u&&seenTooNarrow(view,posed,select(1.0,factor,factor > 0.0))) {
  verdict.cullResult=cullResultOrientation;
 } else {
  if (outside) {
   verdict.cullResult=cullResultFrustum;
  } else {
   if ((view.cullMask & cullDistance)!=0u&&(distance_ > view.drawDistance||!bucketsKeep(view.buckets,view.bucketDistance,distance_,rank))) {
    verdict.cullResult=cullResultDistance;
   } else {
    if (factor <= 0.0) {
     verdict.cullResult=cullResultLod;
    }
   }
  }
 }
 if (verdict.cullResult!=cullResultDrawn) {
  verdict.widthFactor=0.0;
 }
 return verdict;
}`,
  "override mayHaveOrgans:bool=true;",
  `fn windCount(counts:u32,kind:u32) -> u32 {
 return (counts >> (4u*kind)) & 15u;
}`,
  "const fineNoiseScale:f32=2.7;",
  "const gustRows:u32=7u;",
  `fn windWaveAt(source:WindSource,phase:WindPhase,position:vec3f,time:f32) -> f32 {
 let k=6.2831853*source.perSize;
 let along=k*(dot(position,source.direction) - source.speed*time) - phase.angle;
 let across=k*dot(position,source.side);
 let sum=cos(0.9*along+0.4*across)+sin(0.55*along - 0.25*across)+sin(0.3*along+0.6*across);
 return 1.0 - max(sum / 3.0,0.0);
}`,
  `fn inLattice(wind:Wind,v:vec3f,shift:vec3f) -> vec3f {
 let x=frameConstants_.environment.wind.lattice.x;
 let y=frameConstants_.environment.wind.lattice.y;
 let z=frameConstants_.environment.wind.lattice.z;
 return vec3f(shift.x+x.x*v.x+x.y*v.y+x.z*v.z,shift.y+y.x*v.x+y.y*v.y+y.z*v.z,shift.z+z.x*v.x+z.y*v.y+z.z*v.z);
}`,
  `fn windNoiseAt(wind:Wind,source:WindSource,phase:WindPhase,position:vec3f,time:f32) -> f32 {
 let along=dot(position,source.direction) - 2.0*source.speed*time;
 let stretched=inLattice(wind,0.5*source.perSize*(position+source.direction*along),phase.shift);
 let gust=0.65*valueNoiseFrom(phase.cell,stretched)+0.35*valueNoiseFrom(phase.fineCell,fineNoiseScale*stretched+phase.fineShift);
 return 2.0*gust*gust;
}`,
  "const gustRise:f32=0.12;",
  `fn windGustAt(wind:Wind,source:WindSource,phase:WindPhase,position:vec3f,time:f32) -> f32 {
 let along=dot(position,source.direction);
 let across=inLattice(wind,source.perSize*(position - source.direction*along),vec3f(0.0));
 let bend=0.8*(valueNoise(0.7*across+vec3f(5.1)) - 0.5)+phase.shift.x;
 let fronts=(source.speed*time - along)*source.perSize+bend;
 let front=floor(fronts);
 let s=fronts - front;
 let rise=clamp(s / gustRise,0.0,1.0);
 let fall=clamp((1.0 - s) / (1.0 - gustRise),0.0,1.0);
 let profile=rise*rise*(3.0 - 2.0*rise)*fall*fall;
 let own=valueNoiseFrom(phase.cell,across+vec3f(0.0,0.0,f32(gustRows)*front));
 return profile*clamp(2.0*own - 0.2,0.0,1.0);
}`,
  `fn parabolicSine(x:vec3f) -> vec3f {
 let f=2.0*fract(x) - vec3f(1.0);
 return -4.0*f*(vec3f(1.0) - abs(f));
}`,
  "const eddyDrift:vec3f=vec3f(0.48,0.57,0.67);",
  `fn windEddies(size:f32,speed:f32,phase:vec3f,position:vec3f,time:f32) -> vec3f {
 let q=(position+eddyDrift*(speed*time)) / size+phase;
 let s=parabolicSine(q);
 let c=parabolicSine(q+vec3f(0.25));
 return 0.7*(vec3f(s.z,s.x,s.y)+vec3f(c.y,c.z,c.x));
}`,
  "const radialExtent:f32=75.0;",
  "const swirlExtent:f32=30.0;",
  `fn windAround(source:WindSource,phase:WindPhase,arm:vec3f,up:vec3f,time:f32,isSwirl:bool) -> vec3f {
 let distance_=length(arm);
 let away=arm / (distance_+0.01*source.size);
 let unit=select(radialExtent,swirlExtent,isSwirl) / source.size;
 let r=unit*distance_;
 let fade=max(1.0 - 0.25*log2(select(0.2,0.5,isSwirl)*r+1.0),0.0);
 let along=r - unit*source.speed*time - phase.angle;
 if (!isSwirl) {
  return away*(fade*(1.0 - max(sin(0.4*along),0.0)));
 }
 let ring=sin(0.1*along);
 return (away+1.5*(1.0 - fade*fade)*cross(up,away))*(fade*ring*ring*ring);
}`,
  `fn windAlong(wind:Wind,source:WindSource,direction:vec3f,amount:f32,position:vec3f,up:vec3f,time:f32) -> vec3f {
 let head=(1.0 - source.lift)*abs(dot(source.direction,up));
 var flow=direction;
 if (head > 0.0) {
  flow+=head*windEddies(wind.eddySize,wind.eddySpeed,wind.eddyPhase,position,time);
 }
 return amount*flow;
}`,
  `fn windFelt(source:WindSource,flow:vec3f,axes:BladeAxes,direction:vec3f) -> vec3f {
 var wind=alongAxes(axes,flow);
 wind.z*=source.lift;
 let square=dot(wind,wind);
 let along=select(0.0,abs(dot(wind,direction))*inverseSqrt(square),square > 1e-12);
 return (1.0 - source.alignment*along)*wind;
}`,
  `fn windAmount(wind:Wind,position:vec3f,time:f32) -> f32 {
 var sum=0.0;
 var next=0u;
 for (var i=windCount(wind.counts,windNoise); i > 0u; i--) {
  let phase=frameConstants_.environment.wind.phases[next];
  let t1_=next;
  next++;
  let source=frameConstants_.environment.wind.sources[t1_];
  sum+=source.strength*windNoiseAt(wind,source,phase,position,time);
 }
 for (var i=windCount(wind.counts,windWave); i > 0u; i--) {
  let phase=frameConstants_.environment.wind.phases[next];
  let t2_=next;
  next++;
  let source=frameConstants_.environment.wind.sources[t2_];
  let wave=windWaveAt(source,phase,position,time);
  sum+=source.strength*wave*wave;
 }
 for (var i=windCount(wind.counts,windGusts); i > 0u; i--) {
  let phase=frameConstants_.environment.wind.phases[next];
  let t3_=next;
  next++;
  let source=frameConstants_.environment.wind.sources[t3_];
  sum+=source.strength*windGustAt(wind,source,phase,position,time);
 }
 return sum;
}`,
  `fn windOfAmount(wind:Wind,amount:f32,position:vec3f,axes:BladeAxes,direction:vec3f,time:f32) -> vec3f {
 let source=frameConstants_.environment.wind.sources[0];
 return amount*windFelt(source,windAlong(wind,source,source.direction,1.0,position,axes.up,time),axes,direction);
}`,
  `fn windAlongAxes(wind:Wind,root:vec3f,axes:BladeAxes,direction:vec3f,time:f32) -> vec3f {
 let position=root+frameConstants_.environment.wind.lattice.origin;
 if ((wind.counts & windsAlike)!=0u) {
  return windOfAmount(wind,windAmount(wind,position,time),position,axes,direction,time);
 }
 var sum=vec3f(0.0);
 var next=0u;
 for (var i=windCount(wind.counts,windNoise); i > 0u; i--) {
  let phase=frameConstants_.environment.wind.phases[next];
  let t1_=next;
  next++;
  let source=frameConstants_.environment.wind.sources[t1_];
  let amount=source.strength*windNoiseAt(wind,source,phase,position,time);
  sum+=windFelt(source,windAlong(wind,source,source.direction,amount,position,axes.up,time),axes,direction);
 }
 for (var i=windCount(wind.counts,windTurning); i > 0u; i--) {
  let phase=frameConstants_.environment.wind.phases[next];
  let t2_=next;
  next++;
  let source=frameConstants_.environment.wind.sources[t2_];
  let angle=source.turn*time+phase.turned;
  let turned=source.direction*cos(angle)+cross(axes.up,source.direction)*sin(angle);
  let amount=source.strength*sin(source.rate*time+phase.angle - 6.2831853*source.perSize*dot(position,source.direction));
  sum+=windFelt(source,windAlong(wind,source,turned,amount,position,axes.up,time),axes,direction);
 }
 for (var i=windCount(wind.counts,windWave); i > 0u; i--) {
  let phase=frameConstants_.environment.wind.phases[next];
  let t3_=next;
  next++;
  let source=frameConstants_.environment.wind.sources[t3_];
  let wave=windWaveAt(source,phase,position,time);
  let amount=source.strength*wave*wave;
  sum+=windFelt(source,windAlong(wind,source,source.direction,amount,position,axes.up,time),axes,direction);
 }
 for (var i=windCount(wind.counts,windRadial); i > 0u; i--) {
  let phase=frameConstants_.environment.wind.phases[next];
  let t4_=next;
  next++;
  let source=frameConstants_.environment.wind.sources[t4_];
  sum+=windFelt(source,source.strength*windAround(source,phase,root - source.centre,axes.up,time,false),axes,direction);
 }
 for (var i=windCount(wind.counts,windSwirl); i > 0u; i--) {
  let phase=frameConstants_.environment.wind.phases[next];
  let t5_=next;
  next++;
  let source=frameConstants_.environment.wind.sources[t5_];
  sum+=windFelt(source,source.strength*windAround(source,phase,root - source.centre,axes.up,time,true),axes,direction);
 }
 for (var i=windCount(wind.counts,windGusts); i > 0u; i--) {
  let phase=frameConstants_.environment.wind.phases[next];
  let t6_=next;
  next++;
  let source=frameConstants_.environment.wind.sources[t6_];
  let amount=source.strength*windGustAt(wind,source,phase,position,time);
  sum+=windFelt(source,windAlong(wind,source,source.direction,amount,position,axes.up,time),axes,direction);
 }
 return sum;
}`,
  `fn environmentAt(gravity:Gravity,root:vec3f) -> vec3f {
 var towards=gravity.direction;
 if (gravity.blend > 0.0) {
  let toAttractor=gravity.attractor - root;
  let distance_=length(toAttractor);
  let pull=select(vec3f(0.0),toAttractor / distance_,distance_ > 1e-6);
  towards=mix(gravity.direction,pull,gravity.blend);
 }
 return gravity.strength*towards;
}`,
  `struct TurnQuotient {
 over:vec2f,
 under:vec2f,
}`,
  `fn timesConjugate(a:vec2f,b:vec2f) -> vec2f {
 return vec2f(a.x*b.x+a.y*b.y,a.y*b.x - a.x*b.y);
}`,
  `fn turnAbove(turn:TurnQuotient) -> vec2f {
 let product=timesConjugate(turn.over,turn.under);
 let under=dot(turn.under,turn.under);
 if (dot(turn.over,turn.over) <= under) {
  return 1.0 / under*product;
 }
 let square=dot(product,product);
 return select(vec2f(1.0,0.0),inverseSqrt(square)*product,square > 1e-30);
}`,
  "const lyingBelow:f32=1e-3;",
  `fn relaxTurn(stiffness:f32,force:vec3f,recovery:f32,turn:vec2f,lies:bool,radius:f32,eta:f32,dt:f32) -> TurnQuotient {
 let b=1.0 - stiffness;
 let k=max(recovery*(1.0 - 0.25*b)*max(1.0 - eta,0.1),1e-3);
 var pull=b*force;
 pull.z+=k;
 if (lies) {
  pull.z=max(pull.z,0.0);
 }
 let strength=length(pull);
 var turned:TurnQuotient;
 turned.over=turn;
 turned.under=vec2f(1.0,0.0);
 if (strength < 1e-6*k) {
  return turned;
 }
 let fall=exp(-(strength / radius)*dt);
 let above=strength+pull.z;
 let below=strength - pull.z;
 let towards=(1.0 - fall)*vec2f(pull.x,pull.y);
 turned.over=(fall*above+below)*turn+towards;
 turned.under=timesConjugate(turn,towards);
 turned.under.x+=above+fall*below;
 return turned;
}`,
  "const longestStep:f32=0.034;",
  "const maxSteps:u32=16u;",
  "const stickingSpeed:f32=0.06;",
  `fn advanceBlade(blade:Blade,environment:Environment,near:ColliderMask,state:BladeState,time:f32,elapsed:f32) -> BladeState {
 let axes=axesAlong(blade.up,widthAxis(blade.up,blade.facing));
 let fade=0.5*max(blade.stiffness,0.1);
 let steps=u32(clamp(ceil(elapsed / longestStep),1.0,f32(maxSteps)));
 let dt=elapsed / f32(steps);
 let pull=environmentAt(environment.gravity,blade.root);
 var gravity=alongAxes(axes,pull);
 gravity.x+=environment.gravity.forward*length(pull);
 let first=storedTurn(state);
 var turn=first;
 var eta=state.eta;
 var pushed=0.0;
 var resting=true;
 for (var i=0u; i < steps; i++) {
  let back=elapsed - dt*f32(i+1u);
  eta=max(eta - fade*dt,0.0);
  let direction=directionOfTurn(turn);
  let radius=tipDistance(direction);
  let before=pushed;
  let wind=windAlongAxes(environment.wind,blade.root,axes,direction,time - back - 0.5*dt);
  turn=turnAbove(relaxTurn(blade.stiffness,gravity+radius*direction.z*wind,environment.recovery,turn,direction.z < lyingBelow,radius,eta,dt));
 }
 if (pushed > 0.0&&resting) {
  let from_=directionOfTurn(first);
  let to=directionOfTurn(turn);
  if (length(tipDistance(to)*to - tipDistance(from_)*from_) < stickingSpeed*elapsed) {
   return state;
  }
 }
 return stateOfTurn(turn,eta);
}`,
  `fn isHidden_2(v0:vec3f,v1:vec3f,v2:vec3f,margin:f32) -> bool {
 if (push_.pyramid.levels==0u) {
  return false;
 }
 let box=screenBoxOfCurve(frameConstants_.viewProjection,push_.pyramid.size,v0,v1,v2,margin);
 return box.isKnown&&behindPyramid(box);
}`,
  "@group(0) @binding(16) var<storage,read_write> patchTimes_:array<u32>;",
  "var<workgroup> kept:atomic<u32>;",
  "var<workgroup> listBase:u32;",
  "var<workgroup> survivors:array<vec4u,512>;",
  `@compute @workgroup_size(64,1,1)
fn main(@builtin(workgroup_id) WorkGroupID_:vec3u,@builtin(local_invocation_index) LocalInvocationIndex_:u32) {
 let thread=LocalInvocationIndex_;
 let place=WorkGroupID_.y*groupsOfRow+WorkGroupID_.x;
 let count=min(atomicLoad(&counters_[countPatches]),push_.patchCount);
 let item=visiblePatches_[min(place,max(count,1u) - 1u)];
 let wanted=select(0u,item.count,place < count);
 let patchIndex=item.patchIndex;
 let cell=patches_[patchIndex];
 let limit=leafAreaLimitOf(frameConstants_.view,cell);
 let elapsed=secondsBetween(patchTimes_[patchIndex],push_.tick);
 if (thread==0u) {
  atomicStore(&kept,0u);
 }
 workgroupBarrier();
 for (var i=thread; i < wanted; i+=64u) {
  let index=cell.firstBlade+i;
  let blade=unpackBlade(blades_[index],cell);
  var turn=states_[index];
  let isNew=turn==unsettledTurn;
  let since=select(elapsed,settlingTime,isNew);
  if (since > 0.0) {
   var none:ColliderMask;
   turn=advanceBlade(blade,frameConstants_.environment,none,BladeState(select(turn,0u,isNew),0.0),0.0,since).turn;
   states_[index]=turn;
  }
  var number=0u;
  var drawn=posedBlade(raised(blade,limit.height),BladeState(turn,0.0));
  if (mayHaveOrgans) {
   let species=fetch_species(blade.species);
   number=ribbonNumber(species,blade);
   if (number > 0u) {
    drawn=ribbonOf(species,drawn,number);
   }
  }
  let verdict=cullBlade(frameConstants_.view,limit,drawn,bladeRank(cell,i - min(number,i)));
  if (verdict.cullResult==cullResultDrawn&&!isHidden_2(drawn.v0,drawn.v1,drawn.v2,verdict.margin)) {
   survivors[atomicAdd(&kept,1u)]=vec4u(i,packFactors(verdict.widthFactor,limit.height),bitcast<u32>(verdict.pixels),0u);
  }
 }
 workgroupBarrier();
 if (thread==0u&&wanted > 0u) {
  listBase=atomicAdd(&counters_[countBlades],atomicLoad(&kept));
  atomicAdd(&counters_[countMoved],wanted);
  patchTimes_[patchIndex]=push_.tick;
 }
 workgroupBarrier();
 for (var i=thread; i < atomicLoad(&kept); i+=64u) {
  let survivor=survivors[i];
  if (listBase+i < push_.capacity) {
   visible_[listBase+i]=VisibleBlade(cell.firstBlade+survivor.x,patchIndex,survivor.y,bitcast<f32>(survivor.z));
  }
 }
}`,
  "const driedClump:u32=255u;",
  `fn curveInside(plane:vec4f,v0:vec3f,v1:vec3f,v2:vec3f,margin:f32) -> bool {
 return min(min(planeDistance(plane,v0),planeDistance(plane,v1)),planeDistance(plane,v2)) > margin;
}`,
  "const shapeTriangleTip:u32=0u;",
  "const shapeTriangle:u32=2u;",
  "const shapeQuadratic:u32=3u;",
  "const shapeDandelion:u32=4u;",
  "const shapeLeaf:u32=5u;",
  "const shapeStalkLeaf:u32=6u;",
  "const shapeCount:u32=7u;",
  "const baseWidth:f32=0.25;",
  "const baseLength:f32=0.3;",
  "const dandelionLobes:f32=4.0;",
  "const segmentsPerLobe:f32=4.0;",
  `fn outlineAt(shape:u32,tipThreshold:f32,t:f32) -> vec2f {
 var half_=0.5;
 if (shape==shapeTriangleTip) {
  half_=0.5 - 0.5*max(t - tipThreshold,0.0) / max(1.0 - tipThreshold,1e-3);
 } else {
  if (shape==shapeTriangle) {
   half_=0.5 - 0.5*t;
  } else {
   if (shape==shapeQuadratic) {
    return vec2f(-0.5,0.5 - t*t);
   } else {
    if (shape==shapeDandelion) {
     let rest=1.0 - t;
     let wave=abs(sin(3.14159265*dandelionLobes*rest));
     half_=0.5*sqrt(rest)*(2.0 - rest - sqrt(0.5*wave));
    } else {
     if (shape==shapeLeaf) {
      let away=select((t - tipThreshold) / max(1.0 - tipThreshold,1e-3),(tipThreshold - t) / max(tipThreshold,1e-3),t < tipThreshold);
      half_=0.5 - 0.5*min(away*away,1.0);
     } else {
      if (shape==shapeStalkLeaf) {
       let before=max(1.0 - t / baseLength,0.0);
       half_=(0.5 - 0.5*max(t - tipThreshold,0.0) / max(1.0 - tipThreshold,1e-3))*(1.0 - (1.0 - baseWidth)*before*before);
      }
     }
    }
   }
  }
 }
 return vec2f(-half_,half_);
}`,
  `fn momentsOfStalkLeaf(tipThreshold:f32) -> vec2f {
 let tau=tipThreshold;
 let lacks=1.0 - baseWidth;
 let u=max(1.0 - tau / baseLength,0.0);
 let taper=u*u*u*u*baseLength*baseLength / max(1.0 - tau,1e-3);
 return vec2f(0.5+0.5*tau - lacks*(baseLength / 3.0 - taper / 12.0),(1.0+tau+tau*tau) / 6.0 - lacks*(baseLength*baseLength / 12.0 - taper*baseLength*(1.0 / 12.0 - 0.05*u)));
}`,
  `fn outlineArea(shape:u32,tipThreshold:f32) -> f32 {
 if (shape==shapeTriangleTip) {
  return 0.5+0.5*tipThreshold;
 }
 if (shape==shapeTriangle) {
  return 0.5;
 }
 if (shape==shapeQuadratic||shape==shapeLeaf) {
  return 2.0 / 3.0;
 }
 if (shape==shapeStalkLeaf) {
  return momentsOfStalkLeaf(tipThreshold).x;
 }
 return select(1.0,0.57268,shape==shapeDandelion);
}`,
  `struct Outline {
 shape:u32,
 tipThreshold:f32,
 segments:f32,
 scale:f32,
}`,
  "const exactSegments:f32=20.0;",
  `fn innerWidths(shape:u32,tipThreshold:f32,segments:f32) -> f32 {
 if (shape==shapeTriangleTip) {
  let first=floor(tipThreshold*segments)+1.0;
  let count=max(segments - first,0.0);
  let beyond=0.5*count*(first+segments - 1.0) / segments - tipThreshold*count;
  return segments - 1.0 - beyond / max(1.0 - tipThreshold,1e-3);
 }
 var sum=0.0;
 for (var i=1.0; i < segments; i+=1.0) {
  let edges=outlineAt(shape,tipThreshold,i / segments);
  sum+=edges.y - edges.x;
 }
 return sum;
}`,
  `fn outlineOf(shape:u32,tipThreshold:f32,segments:f32) -> Outline {
 var outline:Outline;
 outline.shape=shape;
 outline.tipThreshold=tipThreshold;
 outline.segments=segments;
 outline.scale=1.0;
 if (segments < 1.5||segments > exactSegments) {
  return outline;
 }
 if (shape==shapeStalkLeaf&&segments < 3.5) {
  outline.shape=shapeTriangleTip;
 }
 let first=outlineAt(outline.shape,tipThreshold,0.0);
 let last=outlineAt(outline.shape,tipThreshold,1.0);
 let sum=0.5*(first.y - first.x+last.y - last.x)+innerWidths(outline.shape,tipThreshold,segments);
 outline.scale=outlineArea(shape,tipThreshold)*segments / sum;
 return outline;
}`,
  `fn singleSegment(shape:u32,tipThreshold:f32) -> vec2f {
 if (shape==shapeTriangleTip) {
  return vec2f(1.0+tipThreshold - tipThreshold*tipThreshold,tipThreshold*tipThreshold);
 }
 if (shape==shapeTriangle) {
  return vec2f(1.0,0.0);
 }
 if (shape==shapeQuadratic) {
  return vec2f(7.0 / 6.0,1.0 / 6.0);
 }
 if (shape==shapeLeaf) {
  let moment=0.25+tipThreshold*(1.0 / 6.0);
  return vec2f(8.0 / 3.0 - 6.0*moment,6.0*moment - 4.0 / 3.0);
 }
 if (shape==shapeStalkLeaf) {
  let moments=momentsOfStalkLeaf(tipThreshold);
  return vec2f(4.0*moments.x - 6.0*moments.y,6.0*moments.y - 2.0*moments.x);
 }
 return select(vec2f(1.0),vec2f(0.64894,0.49642),shape==shapeDandelion);
}`,
  `fn edgesAt(outline:Outline,t:f32) -> vec2f {
 if (outline.segments < 1.5) {
  let ends=singleSegment(outline.shape,outline.tipThreshold);
  let half_=0.5*mix(ends.x,ends.y,t);
  return vec2f(-half_,half_);
 }
 return outline.scale*outlineAt(outline.shape,outline.tipThreshold,t);
}`,
  `fn segmentsFor(v0:vec3f,v1:vec3f,v2:vec3f,size:f32,shape:u32,heightPixels:f32,widthPixels:f32,most:f32) -> f32 {
 let stray=length(v0 - 2.0*v1+v2)*(heightPixels / max(size,1e-9));
 let curve=ceil(sqrt(stray));
 if (shape==shapeDandelion&&widthPixels > 2.0) {
  return dandelionLobes*segmentsPerLobe;
 }
 var tip=select(select(1.0,2.0,widthPixels > 1.0),3.0,widthPixels > 3.0);
 if ((shape==shapeLeaf||shape==shapeStalkLeaf)&&widthPixels > 3.0) {
  tip=select(4.0,8.0,widthPixels > 12.0);
 }
 return clamp(max(curve,tip),1.0,max(most,1.0));
}`,
  `fn segmentsAt(steps:LevelSteps,distance_:f32) -> f32 {
 var segments=steps.segments[0];
 for (var i=1; i < 4; i++) {
  if (u32(i) < steps.count&&distance_ >= steps.distance_[i - 1]) {
   segments=steps.segments[i];
  }
 }
 return segments;
}`,
  `fn widthFactorOf(visible:VisibleBlade) -> f32 {
 return unpack2x16float(visible.factors).x;
}`,
  `fn heightFactorOf(visible:VisibleBlade) -> f32 {
 return unpack2x16float((visible.factors & heightFactorBits) | 0x3c000000u).y;
}`,
  "@group(0) @binding(4) var<storage,read> states_:array<u32>;",
  "@group(0) @binding(11) var<storage,read> visible_:array<VisibleBlade>;",
  "const countQuads:u32=2u;",
  "override onlyShape:u32=shapeCount;",
  `fn knownShape(shape:u32) -> u32 {
 return select(shape,onlyShape,onlyShape < shapeCount);
}`,
  `fn placeOf(pages:vec2u,blade:u32) -> u32 {
 return blade;
}`,
  `fn rowsOfColumn(height:u32) -> u32 {
 return (height+3u) & ~3u;
}`,
  `struct Ribbon {
 v0:vec3f,
 v1:vec3f,
 v2:vec3f,
 axis:vec3f,
 width:f32,
 fold:f32,
 outline:Outline,
 seed:u32,
}`,
  `struct CrossSection {
 left:vec3f,
 right:vec3f,
 ridge:vec3f,
 wide:f32,
 drawn:f32,
}`,
  `fn foldOf(fold:f32,widthPixels:f32) -> f32 {
 return fold*smoothstep(2.0,4.0,widthPixels);
}`,
  `fn directionAt(ribbon:Ribbon,t:f32) -> vec3f {
 let tangent=bezierTangent(ribbon.v0,ribbon.v1,ribbon.v2,t);
 return select(ribbon.v1 - ribbon.v0,tangent,dot(tangent,tangent) > 1e-18);
}`,
  `fn outwardsOf(across:vec3f,level:vec3f) -> vec3f {
 let square=dot(level,level);
 let unit=select(across,level*inverseSqrt(square),square > 1e-18);
 let upright=dot(unit,across);
 return across+upright / max(upright*upright,0.25)*(unit - upright*across);
}`,
  `fn crossSectionAt(ribbon:Ribbon,t:f32,eye:vec3f,minWidth:f32) -> CrossSection {
 let centre=bezierPoint(ribbon.v0,ribbon.v1,ribbon.v2,t);
 let direction=directionAt(ribbon,t);
 let edges=ribbon.width*edgesAt(ribbon.outline,t);
 var section:CrossSection;
 section.left=centre+edges.x*ribbon.axis;
 section.right=centre+edges.y*ribbon.axis;
 section.wide=edges.y - edges.x;
 section.drawn=section.wide;
 if (minWidth > 0.0) {
  let half_=0.5 / max(ribbon.outline.segments,1.0);
  let chord=directionAt(ribbon,clamp(t,half_,1.0 - half_));
  let ray=centre - eye;
  let distance_=length(ray);
  let side=cross(ray,chord);
  let square=dot(side,side);
  let across=select(ribbon.axis,side*inverseSqrt(square),square > 1e-12*dot(ray,ray)*dot(chord,chord));
  let seen=dot(ribbon.axis,across);
  section.wide*=abs(seen);
  section.drawn=max(section.wide,minWidth*distance_);
  let outwards=outwardsOf(across,cross(ray,ribbon.v1 - ribbon.v0));
  let grown=0.5*(section.drawn - section.wide)*select(1.0,-1.0,seen < 0.0)*outwards;
  section.left-=grown;
  section.right+=grown;
 }
 section.ridge=0.5*(section.left+section.right);
 if (ribbon.fold > 0.0) {
  section.ridge+=0.5*ribbon.fold*(edges.y - edges.x)*normalize(cross(direction,ribbon.axis));
 }
 return section;
}`,
  `fn marginBeside(width:f32,distance_:f32,minWidth:f32) -> f32 {
 return 0.5*outlineMost*width+sectionMargin(distance_,minWidth);
}`,
  `struct DrawnBlade {
 ribbon:Ribbon,
 blade:Blade,
 species:Species,
}`,
  `struct PosedLook {
 posed:PosedBlade,
 look:Species,
 number:u32,
}`,
  `fn posedLook(blade:Blade,state:BladeState) -> PosedLook {
 var part=PosedLook(posedBlade(blade,state),fetch_species(blade.species),0u);
 if (!mayHaveOrgans||part.look.organKinds==0u) {
  return part;
 }
 part.number=blade.clump;
 if (part.number > 0u) {
  var within:u32;
  let organ=fetch_organs(organOf(part.look,part.number,&within));
  part.posed=posedRibbon(part.posed,organ,part.number,within);
  part.look=organ.look;
 }
 part.posed.blade.clump=plantKey(blade) % driedClump;
 return part;
}`,
  `fn segmentsOf(ribbon:Ribbon,height:f32,shape:u32,heightPixels:f32,widthPixels:f32) -> f32 {
 if (frameConstants_.fixedTessellation > 0.0) {
  return clamp(frameConstants_.fixedTessellation,1.0,64.0);
 }
 if (frameConstants_.levelSteps.count > 0u) {
  return segmentsAt(frameConstants_.levelSteps,length(ribbon.v0 - frameConstants_.view.eye));
 }
 return segmentsFor(ribbon.v0,ribbon.v1,ribbon.v2,height,shape,heightPixels,widthPixels,f32(frameConstants_.maxTessellation));
}`,
  `fn drawnBlade(visible:VisibleBlade,part:PosedLook) -> DrawnBlade {
 let species=part.look;
 let posed=part.posed;
 var drawn:DrawnBlade;
 drawn.blade=posed.blade;
 drawn.species=species;
 let height=posed.blade.height;
 var ribbon:Ribbon;
 ribbon.v0=posed.v0;
 ribbon.v1=posed.v1;
 ribbon.v2=posed.v2;
 ribbon.axis=posed.axis;
 ribbon.width=posed.blade.width*widthFactorOf(visible);
 let widthPixels=visible.pixels*ribbon.width / height;
 ribbon.fold=foldOf(species.fold,widthPixels);
 let shape=knownShape(species.shape);
 ribbon.outline=outlineOf(shape,species.tipThreshold,segmentsOf(ribbon,height,shape,visible.pixels,widthPixels));
 ribbon.seed=posed.blade.seed;
 drawn.ribbon=ribbon;
 return drawn;
}`,
  `fn drawnBlade_2(visible:VisibleBlade,blade:Blade,state:BladeState) -> DrawnBlade {
 return drawnBlade(visible,posedLook(blade,state));
}`,
  `fn stateOf_2(visible:VisibleBlade) -> BladeState {
 return BladeState(states_[placeOf(vec2u(),visible.blade)],0.0);
}`,
  `fn visibleBlade(visible:VisibleBlade) -> Blade {
 let blade=unpackBlade(blades_[placeOf(vec2u(),visible.blade)],patches_[visible.patchIndex]);
 return raised(blade,heightFactorOf(visible));
}`,
  `fn drawnBlade_3(visible:VisibleBlade) -> DrawnBlade {
 return drawnBlade_2(visible,visibleBlade(visible),stateOf_2(visible));
}`,
  "const samplesPerPixel:u32=4u;",
  "const fourPlaces:array<vec2f,4> = array<vec2f,4>(vec2f(0.375,0.125),vec2f(0.875,0.375),vec2f(0.125,0.625),vec2f(0.625,0.875));",
  `fn samplePlace(s:u32) -> vec2f {
 return fourPlaces[s];
}`,
  `fn rowsBetween(low:f32,high:f32,edge:f32) -> vec2i {
 let uppermost=samplePlace(0u).y;
 let lowermost=samplePlace(samplesPerPixel - 1u).y;
 return vec2i(i32(max(ceil(low - lowermost),0.0)),i32(min(floor(high - uppermost),edge - 1.0)));
}`,
  `fn middleOf(covered:u32) -> vec2f {
 var sum=vec2f(0.0);
 for (var s=0u; s < samplesPerPixel; s++) {
  var t1_:vec2f;
  if ((covered & (1u << s))!=0u) {
   t1_=samplePlace(s);
  } else {
   t1_=vec2f(0.0);
  }
  sum+=t1_;
 }
 return sum / f32(i32(countOneBits(covered)));
}`,
  `fn upperHalf(i:f32,segments:f32) -> bool {
 return 2.0*i > segments;
}`,
  `struct Lens {
 viewProjection:mat4x4f,
 eye:vec3f,
 minWidth:f32,
 size:vec2f,
}`,
  `fn lensOf() -> Lens {
 return Lens(frameConstants_.viewProjection,frameConstants_.view.eye,frameConstants_.view.minWidth,vec2f(push_.size));
}`,
  `fn columnStride() -> u32 {
 return rowsOfColumn(push_.size.y)*samplesPerPixel;
}`,
  `fn sampleIndex(pixel:vec2u,s:u32) -> u32 {
 return pixel.x*columnStride()+pixel.y*samplesPerPixel+s;
}`,
  "@group(0) @binding(9) var<storage,read_write> seenSamples_:array<atomic<u32>>;",
  `fn putOne(index:u32,depth:f32,blade:u32) {
 let bits=bitcast<u32>(depth);
 if (push_.isIdPass==0u) {
  atomicMax(&seenSamples_[2u*index+1u],bits);
 } else {
  if (atomicLoad(&seenSamples_[2u*index+1u])==bits) {
   atomicMax(&seenSamples_[2u*index],push_.firstBlade+blade);
  }
 }
}`,
  `fn putSmall(pixel:vec2u,covered:u32,depths:array<f32,4>,blade:u32) {
 let first=sampleIndex(pixel,0u);
 for (var s=0u; s < samplesPerPixel; s++) {
  if ((covered & (1u << s))!=0u) {
   putOne(first+s,depths[s],blade);
  }
 }
}`,
  "override mayFold:bool=true;",
  `fn isFolded(ribbon:Ribbon) -> bool {
 return mayFold&&ribbon.fold > 0.0;
}`,
  `fn seenPoint(lens:Lens,position:vec3f) -> vec4f {
 let clip=lens.viewProjection*vec4f(position,1.0);
 return vec4f((0.5*clip.xy+0.5*clip.w)*lens.size,clip.z,clip.w);
}`,
  `struct SeenSection {
 section:CrossSection,
 left:vec4f,
 right:vec4f,
 ridge:vec4f,
}`,
  `fn seenSection(lens:Lens,ribbon:Ribbon,t:f32) -> SeenSection {
 var seen:SeenSection;
 seen.section=crossSectionAt(ribbon,t,lens.eye,lens.minWidth);
 seen.left=seenPoint(lens,seen.section.left);
 seen.right=seenPoint(lens,seen.section.right);
 seen.ridge=0.5*(seen.left+seen.right);
 if (isFolded(ribbon)) {
  seen.ridge=seenPoint(lens,seen.section.ridge);
 }
 return seen;
}`,
  `fn isBefore(seen:vec4f) -> bool {
 return seen.w <= 0.0||seen.z > seen.w;
}`,
  `fn trianglesOf(isFolded:bool) -> u32 {
 return select(2u,4u,isFolded);
}`,
  `struct TriangleOf {
 isRight:bool,
 endsAtRidge:bool,
 isSecond:bool,
 beginsRight:bool,
 endsLeft:bool,
}`,
  `fn triangleOf(i:u32,isFolded:bool,isUpper:bool) -> TriangleOf {
 var part:TriangleOf;
 part.isRight=i >= 2u;
 part.endsAtRidge=isFolded&&i < 2u;
 part.isSecond=(i & 1u)!=0u;
 part.beginsRight=part.isSecond&&isUpper;
 part.endsLeft=part.isSecond||isUpper;
 return part;
}`,
  `fn crossOf(a:vec2f,b:vec2f) -> f32 {
 return a.x*b.y - a.y*b.x;
}`,
  `struct ScreenSection {
 left:vec3f,
 right:vec3f,
 ridge:vec3f,
 weight:vec2f,
}`,
  "const subpixels:f32=256.0;",
  `fn screenPoint(seen:vec4f) -> vec3f {
 let inverse=1.0 / seen.w;
 return vec3f(round(seen.xy*(inverse*subpixels)) / subpixels,seen.z*inverse);
}`,
  `fn screenSection(seen:SeenSection,isFolded:bool) -> ScreenSection {
 var screen:ScreenSection;
 screen.left=screenPoint(seen.left);
 screen.right=screenPoint(seen.right);
 screen.ridge=screen.left;
 if (isFolded) {
  screen.ridge=screenPoint(seen.ridge);
 }
 screen.weight=vec2f(seen.section.wide,seen.section.drawn) / seen.ridge.w;
 return screen;
}`,
  `struct Quad {
 a0:vec3f,
 a1:vec3f,
 b0:vec3f,
 b1:vec3f,
 weightA0:vec2f,
 weightA1:vec2f,
 weightB:vec2f,
}`,
  `fn halvesOf(isFolded:bool) -> u32 {
 return select(1u,2u,isFolded);
}`,
  `fn halfOf(i:u32,before:ScreenSection,after:ScreenSection,isFolded:bool) -> Quad {
 let isRight=i > 0u;
 let endsAtRidge=isFolded&&!isRight;
 return Quad(select(before.left,before.ridge,isRight),select(before.right,before.ridge,endsAtRidge),select(after.left,after.ridge,isRight),select(after.right,after.ridge,endsAtRidge),before.weight,before.weight,after.weight);
}`,
  `fn triangleBetween(i:u32,before:ScreenSection,after:ScreenSection,isFolded:bool,isUpper:bool) -> Quad {
 let part=triangleOf(i,isFolded,isUpper);
 let whole=halfOf(i / 2u,before,after,isFolded);
 var quad:Quad;
 quad.a0=select(whole.a0,whole.b1,part.isSecond);
 quad.a1=select(whole.a1,whole.b0,part.isSecond);
 quad.b0=select(select(whole.b1,whole.b0,part.endsLeft),select(whole.a0,whole.a1,part.beginsRight),part.isSecond);
 quad.b1=quad.b0;
 quad.weightA0=select(before.weight,after.weight,part.isSecond);
 quad.weightA1=quad.weightA0;
 quad.weightB=select(after.weight,before.weight,part.isSecond);
 return quad;
}`,
  `fn isConvex(quad:Quad) -> bool {
 let a=quad.a1.xy - quad.a0.xy;
 let b=quad.b1.xy - quad.a1.xy;
 let c=quad.b0.xy - quad.b1.xy;
 let d=quad.a0.xy - quad.b0.xy;
 let turns=vec4f(crossOf(a,b),crossOf(b,c),crossOf(c,d),crossOf(d,a));
 return all(turns >= vec4f(0.0))||all(turns <= vec4f(0.0));
}`,
  `struct Corner {
 seen:vec4f,
 widths:vec2f,
}`,
  `fn cutBetween(a:Corner,b:Corner) -> Corner {
 let depthA=a.seen.w - a.seen.z;
 let depthB=b.seen.w - b.seen.z;
 let share=depthA / (depthA - depthB);
 return Corner(mix(a.seen,b.seen,share),mix(a.widths,b.widths,share));
}`,
  `fn behindNear(a:Corner,b:Corner,c:Corner,quad:ptr<function,Quad>) -> bool {
 let lost=u32(isBefore(a.seen))+u32(isBefore(b.seen))+u32(isBefore(c.seen));
 if (lost==3u) {
  return false;
 }
 let isLost=lost==1u;
 var first=a;
 var second=b;
 var third=c;
 if (isBefore(b.seen)==isLost&&lost > 0u) {
  first=b;
  second=c;
  third=a;
 } else {
  if (isBefore(c.seen)==isLost&&lost > 0u) {
   first=c;
   second=a;
   third=b;
  }
 }
 var fourth=third;
 if (lost==1u) {
  fourth=cutBetween(first,third);
  first=cutBetween(first,second);
 } else {
  if (lost==2u) {
   second=cutBetween(first,second);
   third=cutBetween(first,third);
   fourth=third;
  }
 }
 (*quad).a0=screenPoint(first.seen);
 (*quad).a1=screenPoint(second.seen);
 (*quad).b1=screenPoint(third.seen);
 (*quad).b0=screenPoint(fourth.seen);
 (*quad).weightA0=first.widths / first.seen.w;
 (*quad).weightA1=second.widths / second.seen.w;
 (*quad).weightB=0.5*(third.widths / third.seen.w+fourth.widths / fourth.seen.w);
 return true;
}`,
  `fn triangleBehindNear(i:u32,before:SeenSection,after:SeenSection,isFolded:bool,isUpper:bool,quad:ptr<function,Quad>) -> bool {
 let part=triangleOf(i,isFolded,isUpper);
 let first=vec2f(before.section.wide,before.section.drawn);
 let second=vec2f(after.section.wide,after.section.drawn);
 let a=Corner(select(before.left,before.ridge,part.isRight),first);
 let b=Corner(select(before.right,before.ridge,part.endsAtRidge),first);
 let c=Corner(select(after.left,after.ridge,part.isRight),second);
 let d=Corner(select(after.right,after.ridge,part.endsAtRidge),second);
 var t1_:Corner;
 if (part.beginsRight) {
  t1_=b;
 } else {
  t1_=a;
 }
 var t2_:Corner;
 if (part.isSecond) {
  t2_=d;
 } else {
  t2_=b;
 }
 var t3_:Corner;
 if (part.endsLeft) {
  t3_=c;
 } else {
  t3_=d;
 }
 return behindNear(t1_,t2_,t3_,quad);
}`,
  `struct Sides {
 leftPlaces:vec4f,
 leftSlopes:vec4f,
 rightPlaces:vec4f,
 rightSlopes:vec4f,
}`,
  `fn sidesOf(p0:vec2f,p1:vec2f,p2:vec2f,p3:vec2f,area:f32) -> Sides {
 let xs=vec4f(p0.x,p1.x,p2.x,p3.x);
 let ys=vec4f(p0.y,p1.y,p2.y,p3.y);
 let rises=ys.yzwx - ys;
 let slopes=(xs.yzwx - xs) / select(rises,vec4f(1.0),rises==vec4f(0.0));
 let places=xs+(p0.y - ys)*slopes;
 let turned=select(rises,-rises,area < 0.0);
 let lefts=turned < vec4f(0.0);
 let rights=turned > vec4f(0.0);
 return Sides(select(vec4f(-1e30),places,lefts),select(vec4f(0.0),slopes,lefts),select(vec4f(1e30),places,rights),select(vec4f(0.0),slopes,rights));
}`,
  `fn between(from_:vec4f,to:vec4f) -> vec2f {
 return vec2f(max(max(from_.x,from_.y),max(from_.z,from_.w)),min(min(to.x,to.y),min(to.z,to.w)));
}`,
  `fn intervalAt(sides:Sides,below:f32) -> vec2f {
 return between(sides.leftPlaces+below*sides.leftSlopes,sides.rightPlaces+below*sides.rightSlopes);
}`,
  `fn isThin(quad:Quad) -> bool {
 return quad.weightA0.x < quad.weightA0.y||quad.weightA1.x < quad.weightA1.y||quad.weightB.x < quad.weightB.y;
}`,
  `fn drawSmall(quad:Quad,mask:SampleMask,blade:u32) {
 let p0=quad.a0.xy;
 let p1=quad.a1.xy;
 let p2=quad.b1.xy;
 let p3=quad.b0.xy;
 let low=min(min(p0,p1),min(p2,p3));
 let high=max(max(p0,p1),max(p2,p3));
 let edge=vec2f(push_.size);
 let middle=0.5*(quad.b0+quad.b1);
 let across=p1 - p0;
 let along=middle.xy - p0;
 let area=crossOf(across,along);
 if (high.x < 0.0||high.y < 0.0||low.x > edge.x||low.y > edge.y||area==0.0) {
  return;
 }
 let sStep=vec2f(along.y,-along.x) / area;
 let tStep=vec2f(-across.y,across.x) / area;
 let depthStep=sStep*(quad.a1.z - quad.a0.z)+tStep*(middle.z - quad.a0.z);
 let shallowest=max(max(quad.a0.z,quad.a1.z),max(quad.b0.z,quad.b1.z));
 let deepest=min(min(quad.a0.z,quad.a1.z),min(quad.b0.z,quad.b1.z));
 let mayBeThin=isThin(quad);
 let keepsFirst=quad.weightA0.x - (1.0 - mask.threshold)*quad.weightA0.y;
 let keepsLast=quad.weightB.x - (1.0 - mask.threshold)*quad.weightB.y;
 let sides=sidesOf(p0,p1,p2,p3,area);
 let rows=rowsBetween(low.y,high.y,edge.y);
 for (var row=rows.x; row <= rows.y; row++) {
  var spans:array<vec2f,4>;
  var widest=vec2f(1e30,-1e30);
  for (var s=0u; s < samplesPerPixel; s++) {
   let place=samplePlace(s);
   let y=f32(row)+place.y;
   spans[s]=intervalAt(sides,y - p0.y) - place.x;
   if (y < low.y||y > high.y) {
    spans[s]=vec2f(1e30,-1e30);
   }
   widest=vec2f(min(widest.x,spans[s].x),max(widest.y,spans[s].y));
  }
  if (widest.x > widest.y) {
   continue;
  }
  let left=i32(max(ceil(widest.x),0.0));
  let right=i32(min(floor(widest.y),edge.x - 1.0));
  for (var column=left; column <= right; column++) {
   var covered=0u;
   for (var s=0u; s < samplesPerPixel; s++) {
    if (f32(column) >= spans[s].x&&f32(column) <= spans[s].y) {
     covered|=1u << s;
    }
   }
   if (covered==0u) {
    continue;
   }
   let corner=vec2f(f32(column),f32(row)) - p0;
   if (mayBeThin) {
    let t=dot(corner+middleOf(covered),tStep);
    let weight=mix(quad.weightA0,quad.weightB,clamp(t,0.0,1.0));
    covered&=keptBits(mask,weight.x / max(weight.y,1e-12));
   }
   var depths:array<f32,4>;
   for (var s=0u; s < samplesPerPixel; s++) {
    depths[s]=clamp(quad.a0.z+dot(corner+samplePlace(s),depthStep),deepest,shallowest);
   }
   putSmall(vec2u(u32(column),u32(row)),covered,depths,blade);
  }
 }
}`,
  "const quadBits:u32=18u;",
  "const maxQuads:u32=1u << quadBits;",
  "const noRowBlock:u32=0xffffffffu;",
  "const rowsOfBlock:u32=8u;",
  "@group(0) @binding(17) var<storage,read_write> quads_:array<vec4f>;",
  "@group(0) @binding(18) var<storage,read_write> rowBlocks_:array<u32>;",
  "const alonePixels:f32=64.0;",
  `fn lowOf(quad:Quad) -> vec2f {
 return min(min(quad.a0.xy,quad.a1.xy),min(quad.b0.xy,quad.b1.xy));
}`,
  `fn highOf(quad:Quad) -> vec2f {
 return max(max(quad.a0.xy,quad.a1.xy),max(quad.b0.xy,quad.b1.xy));
}`,
  `fn listQuad(quad:Quad,rows:vec2i,seed:u32,blade:u32) -> bool {
 let blocks=(u32(rows.y - rows.x)+rowsOfBlock) / rowsOfBlock;
 let slot=atomicAdd(&counters_[countQuads],1u);
 let first=atomicAdd(&counters_[countRows],blocks);
 let hasRoom=slot < maxQuads&&first+blocks <= maxRowBlocks;
 for (var i=0u; i < blocks&&first+i < maxRowBlocks; i++) {
  rowBlocks_[first+i]=select(noRowBlock,slot | (i << quadBits),hasRoom);
 }
 if (!hasRoom) {
  return false;
 }
 quads_[5u*slot]=vec4f(quad.a0,quad.weightA0.x);
 quads_[5u*slot+1u]=vec4f(quad.a1,quad.weightA0.y);
 quads_[5u*slot+2u]=vec4f(quad.b0,quad.weightA1.x);
 quads_[5u*slot+3u]=vec4f(quad.b1,quad.weightA1.y);
 quads_[5u*slot+4u]=vec4f(quad.weightB,bitcast<f32>(blade),bitcast<f32>(seed));
 return true;
}`,
  `fn drawQuad(quad:Quad,mask:SampleMask,seed:u32,blade:u32) {
 let edge=vec2f(push_.size);
 let low=lowOf(quad);
 let high=highOf(quad);
 let rows=rowsBetween(low.y,high.y,edge.y);
 let wide=min(high.x,edge.x) - max(low.x,0.0);
 if (wide < 0.0||rows.y < rows.x) {
  return;
 }
 if (wide*f32(rows.y - rows.x+1) > alonePixels) {
  let haveRoom=atomicLoad(&counters_[countQuads]) <= maxQuads&&atomicLoad(&counters_[countRows]) <= maxRowBlocks;
  var t1_:bool;
  if (push_.isIdPass==0u) {
   t1_=listQuad(quad,rows,seed,blade);
  } else {
   t1_=haveRoom;
  }
  if (t1_) {
   return;
  }
 }
 drawSmall(quad,mask,blade);
}`,
  `fn drawCut(lens:Lens,ribbon:Ribbon,blade:u32) {
 let segments=ribbon.outline.segments;
 let hasRidge=isFolded(ribbon);
 let mask=sampleMaskOf(ribbon.seed,samplesPerPixel);
 for (var segment=1.0; segment <= segments; segment+=1.0) {
  let before=seenSection(lens,ribbon,(segment - 1.0) / segments);
  let after=seenSection(lens,ribbon,segment / segments);
  for (var i=0u; i < trianglesOf(hasRidge); i++) {
   var quad:Quad;
   if (triangleBehindNear(i,before,after,hasRidge,upperHalf(segment,segments),&quad)) {
    drawQuad(quad,mask,ribbon.seed,blade);
   }
  }
 }
}`,
  `fn drawWhole(lens:Lens,ribbon:Ribbon,blade:u32) {
 let hasRidge=isFolded(ribbon);
 let segments=ribbon.outline.segments;
 let mask=sampleMaskOf(ribbon.seed,samplesPerPixel);
 var before=screenSection(seenSection(lens,ribbon,0.0),hasRidge);
 var segment=1.0;
 var part=0u;
 while (segment <= segments) {
  let after=screenSection(seenSection(lens,ribbon,segment / segments),hasRidge);
  var isTwisted=false;
  for (var i=0u; i < halvesOf(hasRidge); i++) {
   isTwisted=isTwisted||!isConvex(halfOf(i,before,after,hasRidge));
  }
  var t1_:Quad;
  if (isTwisted) {
   t1_=triangleBetween(part,before,after,hasRidge,upperHalf(segment,segments));
  } else {
   t1_=halfOf(part,before,after,hasRidge);
  }
  let quad=t1_;
  part++;
  var t2_:u32;
  if (isTwisted) {
   t2_=trianglesOf(hasRidge);
  } else {
   t2_=halvesOf(hasRidge);
  }
  if (part >= t2_) {
   before=after;
   segment+=1.0;
   part=0u;
  }
  drawQuad(quad,mask,ribbon.seed,blade);
 }
}`,
  `@compute @workgroup_size(64,1,1)
fn main(@builtin(workgroup_id) WorkGroupID_:vec3u,@builtin(local_invocation_index) LocalInvocationIndex_:u32) {
 let place=(WorkGroupID_.y*groupsOfRow+WorkGroupID_.x)*64u+LocalInvocationIndex_;
 if (place >= min(atomicLoad(&counters_[countBlades]),push_.capacity)) {
  return;
 }
 let lens=lensOf();
 let drawn=drawnBlade_3(visible_[place]);
 let ribbon=drawn.ribbon;
 let margin=marginBeside(ribbon.width,length(ribbon.v0 - lens.eye)+drawn.blade.height,lens.minWidth);
 if (curveInside(frameConstants_.view.planes[4],ribbon.v0,ribbon.v1,ribbon.v2,margin)) {
  drawWhole(lens,ribbon,place);
 } else {
  drawCut(lens,ribbon,place);
 }
}`,
  `fn depthAt(index:u32) -> u32 {
 return atomicLoad(&seenSamples_[2u*index+1u]);
}`,
  `fn depthsAt(index:u32) -> vec2u {
 return vec2u(depthAt(index),depthAt(index+1u));
}`,
  `struct Span {
 xs:vec4f,
 ys:vec4f,
 slopes:vec4f,
 depth:vec3f,
 deepest:f32,
 shallowest:f32,
 isThin:bool,
 wide:vec3f,
 drawn:vec3f,
}`,
  `fn linearIn(steps:mat2x2f,a0:f32,a1:f32,b:f32) -> vec3f {
 return vec3f(a0,steps*vec2f(a1 - a0,b - a0));
}`,
  `fn spanOfQuad(quad:Quad,mayBeThin:bool,span:ptr<function,Span>) -> bool {
 (*span).xs=vec4f(quad.a0.x,quad.a1.x,quad.b1.x,quad.b0.x);
 (*span).ys=vec4f(quad.a0.y,quad.a1.y,quad.b1.y,quad.b0.y);
 (*span).slopes=((*span).xs.yzwx - (*span).xs) / ((*span).ys.yzwx - (*span).ys);
 let middle=0.5*(quad.b0+quad.b1);
 let across=quad.a1.xy - quad.a0.xy;
 let along=middle.xy - quad.a0.xy;
 let area=crossOf(across,along);
 let steps=mat2x2f(along.y,-along.x,-across.y,across.x)*(1.0 / area);
 (*span).depth=linearIn(steps,quad.a0.z,quad.a1.z,middle.z);
 (*span).deepest=min(min(quad.a0.z,quad.a1.z),min(quad.b0.z,quad.b1.z));
 (*span).shallowest=max(max(quad.a0.z,quad.a1.z),max(quad.b0.z,quad.b1.z));
 (*span).isThin=mayBeThin;
 (*span).wide=linearIn(steps,quad.weightA0.x,quad.weightA1.x,quad.weightB.x);
 (*span).drawn=linearIn(steps,quad.weightA0.y,quad.weightA1.y,quad.weightB.y);
 return area!=0.0;
}`,
  `fn crossingsOf(span:Span,y:f32) -> vec2f {
 let places=span.xs+(y - span.ys)*span.slopes;
 let isAbove=span.ys <= vec4f(y);
 let isMet=isAbove!=isAbove.yzwx;
 let from_=select(vec4f(1e30),places,isMet);
 let to=select(vec4f(-1e30),places,isMet);
 return vec2f(min(min(from_.x,from_.y),min(from_.z,from_.w)),max(max(to.x,to.y),max(to.z,to.w)));
}`,
  `fn spanOf(span:Span,mask:SampleMask,s:u32,row:i32) -> vec2f {
 let place=samplePlace(s)+vec2f(0.0,f32(row));
 let crossings=crossingsOf(span,place.y) - place.x;
 var ends=vec2f(max(ceil(crossings.x),0.0),min(floor(crossings.y),f32(push_.size.x) - 1.0));
 if (span.isThin) {
  let turn=(s+samplesPerPixel - mask.first) % samplesPerPixel;
  let least=(f32(turn+1u) - mask.threshold) / f32(samplesPerPixel);
  let keeps=span.wide - least*span.drawn;
  let atLeft=keeps.x+dot(place - vec2f(span.xs.x,span.ys.x),keeps.yz);
  let zero=-atLeft / keeps.y;
  if (keeps.y > 0.0) {
   ends.x=max(ends.x,ceil(zero));
  } else {
   if (keeps.y < 0.0) {
    ends.y=min(ends.y,floor(zero));
   } else {
    if (atLeft < 0.0) {
     ends.y=-1.0;
    }
   }
  }
 }
 return ends;
}`,
  "const pixelsTogether:u32=4u;",
  `fn drawRow(span:Span,blade:u32,seed:u32,row:i32) {
 let mask=sampleMaskOf(seed,samplesPerPixel);
 var spans:array<vec2f,4>;
 var reach=vec2f(1e30,-1.0);
 for (var s=0u; s < samplesPerPixel; s++) {
  spans[s]=spanOf(span,mask,s,row);
  reach=vec2f(min(reach.x,spans[s].x),max(reach.y,spans[s].y));
 }
 if (reach.x > reach.y) {
  return;
 }
 var first=sampleIndex(vec2u(u32(reach.x),u32(row)),0u);
 let depth=span.depth.x+dot(vec2f(reach.x,f32(row)) - vec2f(span.xs.x,span.ys.x),span.depth.yz);
 {
  var begin=0.0;
  loop {
   if (!(begin <= reach.y - reach.x)) { break; }
   let here=depth+begin*span.depth.y;
   var before:array<u32,16>;
   for (var i=0u; i < pixelsTogether; i++) {
    let pixel=first+i*columnStride();
    let isTested=begin+f32(i) <= reach.y - reach.x;
    {
     if (isTested) {
      for (var s=0u; s < samplesPerPixel; s+=2u) {
       let two=depthsAt(pixel+s);
       before[i*samplesPerPixel+s]=two.x;
       before[i*samplesPerPixel+s+1u]=two.y;
      }
     }
    }
   }
   for (var i=0u; i < pixelsTogether; i++) {
    for (var s=0u; s < samplesPerPixel; s++) {
     let own=clamp(here+dot(samplePlace(s)+vec2f(f32(i),0.0),span.depth.yz),span.deepest,span.shallowest);
     let column=reach.x+begin+f32(i);
     if (column >= spans[s].x&&column <= spans[s].y&&bitcast<u32>(own) >= before[i*samplesPerPixel+s]) {
      putOne(first+i*columnStride()+s,own,blade);
     }
    }
   }
   continuing {
    begin+=f32(pixelsTogether);
    first+=pixelsTogether*columnStride();
   }
  }
 }
}`,
  "@group(0) @binding(17) var<storage,read> quads_:array<vec4f>;",
  "@group(0) @binding(18) var<storage,read> rowBlocks_:array<u32>;",
  `@compute @workgroup_size(64,1,1)
fn main(@builtin(workgroup_id) WorkGroupID_:vec3u,@builtin(local_invocation_index) LocalInvocationIndex_:u32) {
 let place=(WorkGroupID_.y*groupsOfRow+WorkGroupID_.x)*rowBlocksOfGroup+LocalInvocationIndex_ / rowsOfBlock;
 if (place >= min(counters_[countRows],maxRowBlocks)) {
  return;
 }
 let listed=rowBlocks_[place];
 if (listed==noRowBlock) {
  return;
 }
 let slot=listed & (maxQuads - 1u);
 let a=quads_[5u*slot];
 let b=quads_[5u*slot+1u];
 let c=quads_[5u*slot+2u];
 let d=quads_[5u*slot+3u];
 let e=quads_[5u*slot+4u];
 let quad=Quad(a.xyz,b.xyz,c.xyz,d.xyz,vec2f(a.w,b.w),vec2f(c.w,d.w),e.xy);
 let rows=rowsBetween(min(min(a.y,b.y),min(c.y,d.y)),max(max(a.y,b.y),max(c.y,d.y)),f32(push_.size.y));
 let row=rows.x+i32((listed >> quadBits)*rowsOfBlock+LocalInvocationIndex_ % rowsOfBlock);
 var span:Span;
 if (row <= rows.y&&spanOfQuad(quad,isThin(quad),&span)) {
  drawRow(span,bitcast<u32>(e.z),bitcast<u32>(e.w),row);
 }
}`,
  "@group(0) @binding(13) var<storage,read> arguments_:array<u32>;",
  "const bladeShadowSegments:u32=8u;",
  "const samplesPerPixel:u32=1u;",
  `fn samplePlace(s:u32) -> vec2f {
 return vec2f(0.5);
}`,
  `fn drawSmall(quad:Quad,mask:SampleMask,blade:u32) {
 let p0=quad.a0.xy;
 let p1=quad.a1.xy;
 let p2=quad.b1.xy;
 let p3=quad.b0.xy;
 let low=min(min(p0,p1),min(p2,p3));
 let high=max(max(p0,p1),max(p2,p3));
 let edge=vec2f(push_.size);
 let middle=0.5*(quad.b0+quad.b1);
 let across=p1 - p0;
 let along=middle.xy - p0;
 let area=crossOf(across,along);
 if (high.x < 0.0||high.y < 0.0||low.x > edge.x||low.y > edge.y||area==0.0) {
  return;
 }
 let sStep=vec2f(along.y,-along.x) / area;
 let tStep=vec2f(-across.y,across.x) / area;
 let depthStep=sStep*(quad.a1.z - quad.a0.z)+tStep*(middle.z - quad.a0.z);
 let shallowest=max(max(quad.a0.z,quad.a1.z),max(quad.b0.z,quad.b1.z));
 let deepest=min(min(quad.a0.z,quad.a1.z),min(quad.b0.z,quad.b1.z));
 let mayBeThin=isThin(quad);
 let keepsFirst=quad.weightA0.x - (1.0 - mask.threshold)*quad.weightA0.y;
 let keepsLast=quad.weightB.x - (1.0 - mask.threshold)*quad.weightB.y;
 let sides=sidesOf(p0,p1,p2,p3,area);
 let rows=rowsBetween(low.y,high.y,edge.y);
 for (var row=rows.x; row <= rows.y; row++) {
  var spans:array<vec2f,1>;
  var widest=vec2f(1e30,-1e30);
  for (var s=0u; s < samplesPerPixel; s++) {
   let place=samplePlace(s);
   let y=f32(row)+place.y;
   spans[s]=intervalAt(sides,y - p0.y) - place.x;
   widest=vec2f(min(widest.x,spans[s].x),max(widest.y,spans[s].y));
  }
  if (widest.x > widest.y) {
   continue;
  }
  let left=i32(max(ceil(widest.x),0.0));
  let right=i32(min(floor(widest.y),edge.x - 1.0));
  {
   let corner=vec2f(f32(left),f32(row))+samplePlace(0u) - p0;
   var depth=quad.a0.z+dot(corner,depthStep);
   var t=dot(corner,tStep);
   for (var column=left; column <= right; column++) {
    if (keepsFirst+clamp(t,0.0,1.0)*(keepsLast - keepsFirst) >= 0.0) {
     putOne(sampleIndex(vec2u(u32(column),u32(row)),0u),clamp(depth,deepest,shallowest),blade);
    }
    depth+=depthStep.x;
    t+=tStep.x;
   }
   continue;
  }
 }
}`,
  `fn drawBlade(lens:Lens,patchIndex:u32,cell:Patch,limit:LeafAreaLimit,i:u32) {
 let index=cell.firstBlade+i;
 var turn=states_[index];
 turn=select(turn,0u,turn==unsettledTurn);
 let part=posedLook(raised(unpackBlade(blades_[index],cell),limit.height),BladeState(turn,0.0));
 let size=drawnSize(frameConstants_.view,limit,part.posed.blade,bladeRank(cell,i - min(part.number,i)),length(part.posed.blade.root - frameConstants_.view.eye));
 if (size.widthFactor <= 0.0) {
  return;
 }
 let margin=0.5*outlineMost*part.posed.blade.width*size.widthFactor;
 var outside=false;
 for (var side=0u; side < 4u; side++) {
  outside=outside||curveOutside(frameConstants_.view.planes[side],part.posed.v0,part.posed.v1,part.posed.v2,margin);
 }
 if (outside) {
  return;
 }
 let blade=VisibleBlade(index,patchIndex,packFactors(size.widthFactor,limit.height),size.pixels);
 var ribbon=drawnBlade(blade,part).ribbon;
 ribbon.fold=0.0;
 ribbon.outline=outlineOf(ribbon.outline.shape,ribbon.outline.tipThreshold,f32(bladeShadowSegments));
 let each=1.0 / f32(bladeShadowSegments);
 let mask=sampleMaskOf(ribbon.seed,1u);
 var before=screenSection(seenSection(lens,ribbon,0.0),false);
 for (var segment=0u; segment < bladeShadowSegments; segment++) {
  let after=screenSection(seenSection(lens,ribbon,f32(segment+1u)*each),false);
  let whole=halfOf(0u,before,after,false);
  let isTwisted=!isConvex(whole);
  for (var half_=0u; half_ < select(1u,2u,isTwisted); half_++) {
   var quad=whole;
   if (isTwisted) {
    quad=triangleBetween(half_,before,after,false,2u*segment >= bladeShadowSegments);
   }
   drawSmall(quad,mask,ribbon.seed);
  }
  before=after;
 }
}`,
  `@compute @workgroup_size(64,1,1)
fn main(@builtin(workgroup_id) WorkGroupID_:vec3u,@builtin(local_invocation_index) LocalInvocationIndex_:u32) {
 let place=WorkGroupID_.y*groupsOfRow+WorkGroupID_.x;
 if (place >= arguments_[argumentsPatches+3u]) {
  return;
 }
 let item=visiblePatches_[place];
 let cell=patches_[item.patchIndex];
 let limit=leafAreaLimitOf(frameConstants_.view,cell);
 let lens=lensOf();
 for (var i=LocalInvocationIndex_; i < item.count; i+=64u) {
  drawBlade(lens,item.patchIndex,cell,limit,i);
 }
}`,
  "@group(0) @binding(9) var<storage,read_write> seenSamples_:array<atomic<vec2u>>;",
  `fn putOne(index:u32,depth:f32,blade:u32) {
 atomicStoreMax(&seenSamples_[index],vec2u(push_.firstBlade+blade,bitcast<u32>(depth)));
}`,
  `fn depthAt(index:u32) -> u32 {
 return 0u;
}`,
  "@group(0) @binding(9) var<storage,read_write> seenSamples_:array<vec2u>;",
  "@group(0) @binding(19) var<storage,read_write> cellBits_:array<atomic<u32>>;",
  "@group(0) @binding(20) var groundDepth_:texture_depth_multisampled_2d;",
  "const nearestBits:u32=0x3f800000u;",
  "var<workgroup> ofFirst:array<atomic<u32>,16>;",
  "var<workgroup> ofSecond:atomic<u32>;",
  `fn putCell(level:u32,cell:vec2u,bits:u32) {
 if (level < push_.pyramid.levels) {
  atomicMin(&cellBits_[push_.pyramid.first[level].x+cell.y*pyramidCells(push_.pyramid.size.x,level)+cell.x],bits);
 }
}`,
  `@compute @workgroup_size(16,16,1)
fn main(@builtin(workgroup_id) WorkGroupID_:vec3u,@builtin(local_invocation_id) LocalInvocationID_:vec3u,@builtin(local_invocation_index) LocalInvocationIndex_:u32,@builtin(global_invocation_id) GlobalInvocationID_:vec3u) {
 let pixel=GlobalInvocationID_.xy;
 let thread=LocalInvocationIndex_;
 if (thread < 16u) {
  atomicStore(&ofFirst[thread],nearestBits);
 }
 if (thread==0u) {
  atomicStore(&ofSecond,nearestBits);
 }
 workgroupBarrier();
 if (all(pixel < push_.size)) {
  let first=sampleIndex(pixel,0u);
  var farthest=nearestBits;
  for (var s=0u; s < samplesPerPixel; s++) {
   let bits=bitcast<u32>(textureLoad(groundDepth_,vec2i(pixel),i32(s)));
   seenSamples_[first+s]=vec2u(0u,bits);
   farthest=min(farthest,bits);
  }
  let cell=LocalInvocationID_.xy / 4u;
  atomicMin(&ofFirst[cell.y*4u+cell.x],farthest);
 }
 workgroupBarrier();
 if (thread < 16u) {
  let cell=WorkGroupID_.xy*4u+vec2u(thread % 4u,thread / 4u);
  if (all(cell < vec2u(pyramidCells(push_.size.x,0u),pyramidCells(push_.size.y,0u)))) {
   putCell(0u,cell,atomicLoad(&ofFirst[thread]));
  }
  atomicMin(&ofSecond,atomicLoad(&ofFirst[thread]));
 }
 workgroupBarrier();
 if (thread > 0u) {
  return;
 }
 let bits=atomicLoad(&ofSecond);
 for (var level=1u; level < push_.pyramid.levels; level++) {
  putCell(level,WorkGroupID_.xy >> vec2u(pyramidFactorBits*(level - 1u)),bits);
 }
}`,
  "const bladeShadowFade:f32=0.75;",
  `fn isShaded(texel:vec2u,depth:f32,seed:u32) -> bool {
 return texel.x!=seed&&bitcast<f32>(texel.y) > depth;
}`,
  `fn sunAmongBlades(shadow:BladeShadow,place:vec3f,seed:u32) -> vec2f {
 if (shadow.size==0u) {
  return vec2f(1.0,0.0);
 }
 let at4=vec4f(place,1.0);
 let at=vec2f(dot(shadow.across,at4),dot(shadow.down,at4)) - 0.5;
 let depth=max(dot(shadow.depth,at4)+shadow.nearer,0.0);
 let edge=0.5*f32(shadow.size);
 let off=abs(at+0.5 - edge) / edge;
 let weight=1.0 - smoothstep(bladeShadowFade,1.0,max(off.x,off.y));
 if (weight <= 0.0) {
  return vec2f(1.0,0.0);
 }
 let corner=floor(at);
 let f=at - corner;
 let last=shadow.size - 2u;
 let column=min(u32(max(corner.x,0.0)),last);
 let row=min(u32(max(corner.y,0.0)),last);
 let first=column*shadow.size+row;
 let lit00=select(1.0,0.0,isShaded(map_[first],depth,seed));
 let lit01=select(1.0,0.0,isShaded(map_[first+1u],depth,seed));
 let lit10=select(1.0,0.0,isShaded(map_[first+shadow.size],depth,seed));
 let lit11=select(1.0,0.0,isShaded(map_[first+shadow.size+1u],depth,seed));
 return vec2f(mix(mix(lit00,lit01,f.y),mix(lit10,lit11,f.y),f.x),weight);
}`,
  "const heightSteps:u32=16u;",
  "const toneBits:u32=0x80038000u;",
  `fn unpackGrass(corner:u32) -> vec3f {
 let grass=unpack2x16float(corner & ~toneBits);
 let step_=((corner >> 16u) & 3u) | ((corner >> 13u) & 4u) | ((corner >> 28u) & 8u);
 return vec3f(grass.x,grass.y,grass.x*f32(step_)*(1.0 / 15.0));
}`,
  `fn mixGrass(a:u32,b:u32,share:f32) -> vec3f {
 return mix(unpackGrass(a),unpackGrass(b),share);
}`,
  `fn grassAt(cover:Cover,position:vec3f) -> vec3f {
 if (cover.countX==0u) {
  return vec3f(0.0);
 }
 let last=vec3f(f32(cover.countX),f32(cover.countY),f32(cover.countZ)) - 1.0;
 let place=clamp((position - cover.low)*cover.cellsPerMetre,vec3f(0.0),last);
 let cell=min(floor(place),last - 1.0);
 let f=place - cell;
 let stepY=cover.countX;
 let stepZ=cover.countX*cover.countY;
 let i=u32(cell.x)+stepY*u32(cell.y)+stepZ*u32(cell.z);
 let j=i+stepZ;
 let near=mix(mixGrass(grass_[i],grass_[i+1u],f.x),mixGrass(grass_[i+stepY],grass_[i+stepY+1u],f.x),f.y);
 let far=mix(mixGrass(grass_[j],grass_[j+1u],f.x),mixGrass(grass_[j+stepY],grass_[j+stepY+1u],f.x),f.y);
 return mix(near,far,f.z);
}`,
  `fn heightStepsPerMetre(cover:Cover,grass:vec3f) -> f32 {
 return cover.stepsPerMetre*select(1.0,grass.x / grass.y,grass.y > 0.0);
}`,
  `fn leafShareAbove(cover:Cover,steps:f32) -> f32 {
 let at=clamp(steps,0.0,f32(heightSteps));
 let step_=min(u32(at),heightSteps - 1u);
 let pair=unpack2x16float(cover.leaves[step_ / 2u].x);
 var low=select(pair.x,1.0,step_==0u);
 var next=pair.y;
 if ((step_ & 1u)!=0u) {
  low=pair.y;
  next=select(0.0,unpack2x16float(cover.leaves[step_ / 2u+1u].x).x,step_+1u < heightSteps);
 }
 let root=mix(low,next,at - f32(step_));
 return root*root;
}`,
  `fn leafProjectionOf(cover:Cover) -> f32 {
 return unpack2x16float(cover.leaves[0].x).x;
}`,
  `fn undergrowthBelow(leafArea:f32) -> f32 {
 return 1.0 - exp(-0.65*leafArea);
}`,
  `fn groundUnder(cover:Cover,bare:vec3f,shade:vec3f,leafArea:f32) -> vec3f {
 return mix(bare,shade*cover.undergrowth,cover.thatch*undergrowthBelow(leafArea));
}`,
  `fn leavesAround(leafArea:f32,thinned:f32) -> f32 {
 return leafArea*max(pow(thinned,-0.22),0.6);
}`,
  `fn heightWithLeafShare(share:f32) -> f32 {
 return pow(clamp(share,0.0,1.0),2.0 / 3.0);
}`,
  "const lowestSun:f32=0.1;",
  `fn leafProjectionAlong(upwards:f32,cosine:f32) -> f32 {
 let beside=0.637*sqrt(max(1.0 - 1.9*upwards*upwards,0.0));
 let sine=sqrt(max(1.0 - cosine*cosine,0.0));
 return length(vec2f(upwards*cosine,beside*sine));
}`,
  "const skyExtinction:f32=1.2;",
  `fn sunBelow(upwards:f32,leafArea:f32,cosine:f32) -> f32 {
 let risen=max(cosine,lowestSun);
 return exp(-leafProjectionAlong(upwards,risen)*(leafArea / risen));
}`,
  `fn skyBelow(leafArea:f32) -> f32 {
 return exp(-skyExtinction*leafArea);
}`,
  "const cullResultPatch:u32=1u;",
  "const cullResultOcclusion:u32=5u;",
  `fn distanceFromFootprint(plane:FloorPlane,place:vec3f,across:vec3f) -> f32 {
 let way=place - plane.middle;
 let at=abs(vec2f(dot(way,plane.along),dot(way,across)));
 let beyond=max(at - (plane.halfSides - plane.cornerRadius),vec2f(0.0));
 return max(length(beyond) - plane.cornerRadius,0.0);
}`,
  `fn skyBesideWall(height:f32,distance_:f32) -> f32 {
 let slant=sqrt(height*height+distance_*distance_);
 return select(1.0,0.5+0.5*distance_ / slant,slant > 0.0);
}`,
  "const shapeQuad:u32=1u;",
  `fn isEven(shape:u32) -> bool {
 return shape!=shapeQuadratic;
}`,
  "const shadowOffset:f32=2.0;",
  `fn sunSeen(shadow:SunShadow,place:vec3f,normal:vec3f) -> f32 {
 if (shadow.size==0u) {
  return 1.0;
 }
 let lifted=vec4f(place+normal*(shadowOffset*shadow.texel),1.0);
 let at=vec2f(dot(shadow.across,lifted),dot(shadow.down,lifted)) - 0.5;
 let depth=dot(shadow.depth,lifted)+shadow.epsilon;
 let f=at - floor(at);
 let last=i32(shadow.size) - 2;
 let column=clamp(i32(floor(at.x)),0,last);
 let row=clamp(i32(floor(at.y)),0,last);
 let first=row*i32(shadow.size)+column;
 let below=first+i32(shadow.size);
 let above0=select(0.0,1.0,fetch_depths(u32(first)) > depth);
 let above1=select(0.0,1.0,fetch_depths(u32(first+1)) > depth);
 let below0=select(0.0,1.0,fetch_depths(u32(below)) > depth);
 let below1=select(0.0,1.0,fetch_depths(u32(below+1)) > depth);
 return 1.0 - mix(mix(above0,above1,f.x),mix(below0,below1,f.x),f.y);
}`,
  "@group(0) @binding(6) var<storage,read> grass_:array<u32>;",
  "@group(0) @binding(7) var<storage,read> map_:array<vec2u>;",
  "@group(0) @binding(8) var sunMap_:texture_depth_2d;",
  `fn fetch_cullResults(i:u32) -> u32 {
 return 0u;
}`,
  `fn fetch_depths(i:u32) -> f32 {
 let size=frameConstants_.shadow.size;
 return textureLoad(sunMap_,vec2i(i32(i % size),i32(i / size)),0);
}`,
  "const debugNothing:u32=0u;",
  "const distanceBands:u32=8u;",
  "const debugNear:u32=5u;",
  `fn distanceBand(distance_:f32,farthest:f32) -> u32 {
 let nearest=min(2.0,0.01*farthest);
 let share=log2(max(distance_,nearest) / nearest) / log2(farthest / nearest);
 return min(u32(f32(distanceBands)*share),distanceBands - 1u);
}`,
  `struct BladeColors {
 root:vec3f,
 tip:vec3f,
}`,
  "const throughTint:vec3f=vec3f(1.25,1.15,0.45);",
  "const throughShare:f32=0.8;",
  `fn tipShareAt(along:f32) -> f32 {
 return smoothstep(-0.15,0.8,along);
}`,
  `fn decodeSrgb(c:vec3f) -> vec3f {
 return select(c / 12.92,pow((c+0.055) / 1.055,vec3f(2.4)),c > vec3f(0.04045));
}`,
  `fn chance(key:u32) -> f32 {
 return f32(mixUint(key) >> 8u)*(1.0 / 16777215.0);
}`,
  `fn meadowAt(position:vec3f) -> f32 {
 return 0.65*valueNoise(position / 2.3)+0.35*valueNoise(position / 0.7);
}`,
  `fn regionAt(position:vec3f) -> f32 {
 return valueNoise(position / 13.0+71.0);
}`,
  `fn shiftOf(hue:f32) -> vec3f {
 return vec3f(1.0+0.75*hue,1.0+0.10*hue,1.0 - 0.45*hue);
}`,
  `fn clumpTone(clump:u32) -> f32 {
 return chance(clump*977u+11u);
}`,
  `fn bladeColors(cover:Cover,blade:Blade,species:Species,leafArea:f32) -> BladeColors {
 let clump=clumpTone(blade.clump);
 let kept=u32(blade.facing*(256.0 / twoPi)+0.5) | (u32(blade.stiffness*63.0+0.5) << 8u) | (u32(blade.tint.y*63.0+0.5) << 14u) | (blade.clump << 20u);
 let single=chance(kept*16u+blade.hash);
 let other=chance(kept*16u+blade.hash+0x9e3779b9u);
 let meadow=meadowAt(blade.root);
 let region=regionAt(blade.root);
 let amount=species.colorVariation;
 let light=1.0+amount*(0.9*(single - 0.5)+0.6*(clump - 0.5)+0.5*(meadow - 0.5)+0.4*(region - 0.5));
 let hue=amount*(0.7*(clump - 0.5)+0.5*(other - 0.5)+1.1*(meadow - 0.5)+1.2*(region - 0.5));
 let shift=shiftOf(hue);
 var colors:BladeColors;
 let ground=groundUnder(cover,decodeSrgb(blade.tint),shift,cover.thinned*leafArea);
 colors.root=mix(species.rootColor*shift,ground,species.groundTint)*light;
 colors.tip=species.tipColor*shift*light;
 let dead=select(0.0,1.0,blade.clump==driedClump);
 let dry=max(smoothstep(0.0,0.25,species.dryness*(0.6+0.8*meadow) - other),dead);
 let straw=vec3f(0.42,0.32,0.13)*(0.7+0.6*single);
 colors.tip=mix(colors.tip,straw,0.8*dry);
 colors.root=mix(colors.root,straw*0.6,0.25*dry+0.3*dead);
 return colors;
}`,
  `fn filmOf(exposed:vec3f) -> vec3f {
 let x=exposed*0.80;
 let film=x*(2.51*x+0.03) / (x*(2.43*x+0.59)+0.14);
 return clamp(film,vec3f(0.0),vec3f(1.0));
}`,
  "const knownDebugMode:u32=0u;",
  `fn debugMode() -> u32 {
 return knownDebugMode;
}`,
  `fn showsBands() -> bool {
 return debugMode() >= debugNear;
}`,
  `fn paleSky(sunCosine:f32) -> vec3f {
 let towards=0.5+0.5*sunCosine;
 let pale=mix(vec3f(1.12,1.02,0.90),vec3f(1.36,1.12,0.96),frameConstants_.lowSun);
 return frameConstants_.skyColor*mix(pale,vec3f(2.50,1.45,0.66),frameConstants_.lowSun*towards*towards);
}`,
  `fn glowAround(sunCosine:f32) -> vec3f {
 let toSun=max(sunCosine,0.0);
 let glow=0.10*pow(toSun,4.0)+0.22*pow(toSun,32.0)+0.5*pow(toSun,400.0);
 return glow*frameConstants_.sunColor*mix(vec3f(0.36,0.34,0.31),vec3f(0.45,0.33,0.22),frameConstants_.lowSun);
}`,
  `fn skyAbove(height:f32,sunCosine:f32) -> vec3f {
 let zenith=frameConstants_.skyColor*vec3f(0.15,0.30,0.56);
 return mix(paleSky(sunCosine),zenith,1.0 - exp(-4.0*height))+glowAround(sunCosine);
}`,
  `fn skyRadiance(ray:vec3f) -> vec3f {
 let height=dot(ray,frameConstants_.skyUp);
 let sunCosine=dot(ray,frameConstants_.sunDirection);
 if (height >= 0.0) {
  return skyAbove(height,sunCosine);
 }
 let pale=paleSky(sunCosine);
 let haze=mix(0.85*pale,frameConstants_.groundColor,0.2);
 return mix(pale,haze,1.0 - exp(2.2*height))+glowAround(sunCosine);
}`,
  `fn hemisphere(n:vec3f) -> vec3f {
 return mix(frameConstants_.groundColor,1.25*frameConstants_.skyColor,0.5+0.5*dot(n,frameConstants_.skyUp));
}`,
  "const passedAgain:f32=0.5;",
  `fn lightAmongLeaves(leafArea:f32,below:f32,cosine:f32,sun:vec3f,sky:vec3f,leaf:vec3f) -> vec3f {
 let risen=max(cosine,lowestSun);
 let crossed=leafProjectionAlong(leafProjectionOf(frameConstants_.cover),risen) / risen;
 let left=exp(-crossed*leafArea);
 let open=skyBelow(leafArea);
 let leftAbove=select(1.0,(1.0 - left) / (crossed*leafArea),leafArea > 1e-3);
 let openAbove=select(1.0,(1.0 - open) / (skyExtinction*leafArea),leafArea > 1e-3);
 let leaves=1.0 - open;
 let sunOfLeaves=leaves*leftAbove+below*left / (1.0+crossed / skyExtinction);
 let skyOfLeaves=leaves*openAbove+below*open*0.5;
 let once=0.25*leaf*(sun*(crossed*risen*sunOfLeaves)+sky*skyOfLeaves);
 return once / (1.0 - passedAgain*leaf);
}`,
  `fn clearBetween(climb:f32,distance_:f32) -> f32 {
 let rise=frameConstants_.fogFalloff*distance_*climb;
 let mean=select(1.0 - 0.5*rise,(1.0 - exp(-rise)) / rise,abs(rise) > 1e-3);
 return exp(-frameConstants_.fogDensity*distance_*mean);
}`,
  `fn throughAir(color:vec3f,direction:vec3f,distance_:f32) -> vec3f {
 let climb=dot(direction,frameConstants_.skyUp);
 let perLength=inverseSqrt(max(1.0 - climb*climb,0.0)+0.02*0.02);
 let sunCosine=dot(direction,frameConstants_.sunDirection) - (climb - 0.02)*dot(frameConstants_.skyUp,frameConstants_.sunDirection);
 return mix(skyAbove(0.02*perLength,sunCosine*perLength),color,clearBetween(climb,distance_));
}`,
  `fn develop(radiance:vec3f) -> vec3f {
 return filmOf(radiance*frameConstants_.exposure);
}`,
  `fn softness(distance_:f32,share:f32) -> f32 {
 if (frameConstants_.view.minWidth <= 0.0||debugMode()!=debugNothing) {
  return 0.0;
 }
 let widthPixels=frameConstants_.view.lodWidth*frameConstants_.view.pixelsPerUnit / max(distance_,1e-6);
 return share*(1.0 - smoothstep(0.6,1.5,widthPixels));
}`,
  `fn dithered(color:vec3f,place:vec2f) -> vec3f {
 let h=mixUint(u32(place.x)+65536u*u32(place.y));
 let noise=f32(h >> 8u)*(1.0 / 16777215.0) - 0.5;
 return color+noise*(2.2 / 255.0)*pow(max(color,vec3f(0.0)),vec3f(0.5454));
}`,
  `fn colorOf(number:u32) -> vec3f {
 let h=mixUint(number*2654435761u+12345u);
 return 0.15+0.85*vec3f(f32(h & 255u),f32((h >> 8u) & 255u),f32((h >> 16u) & 255u)) / 255.0;
}`,
  `struct BladeSurface {
 root:vec4f,
 tip:vec4f,
 material:vec4f,
}`,
  `fn packedLook(look:vec3f) -> f32 {
 let bytes=floor(clamp(look,vec3f(0.0),vec3f(1.0))*255.0+0.5);
 return dot(bytes,vec3f(65536.0,256.0,1.0));
}`,
  `fn unpackedLook(packed:f32) -> vec3f {
 let bits=u32(packed);
 return vec3f(vec3u(bits >> 16u,bits >> 8u,bits) & vec3u(255u)) / 255.0;
}`,
  `fn packedHeights(steps:vec3f) -> f32 {
 return packedLook(steps / f32(heightSteps));
}`,
  `fn leafAreaAbove(material:vec4f,along:f32) -> f32 {
 let steps=f32(heightSteps)*unpackedLook(material.z);
 let height=mix(mix(steps.x,steps.y,along),mix(steps.y,steps.z,along),along);
 return material.y*leafShareAbove(frameConstants_.cover,height);
}`,
  `fn packedFinish(finish:u32,pixels:f32) -> f32 {
 return floor(clamp(pixels*4.0,0.0,255.0)+0.5)+256.0*f32(finish);
}`,
  `fn finishIn(packed:f32) -> u32 {
 return u32(packed) >> 8u;
}`,
  `fn pixelsIn(packed:f32) -> f32 {
 return 0.25*f32(u32(packed) & 255u);
}`,
  `fn fleckLength() -> f32 {
 return 1.5 / max(frameConstants_.cover.stepsPerMetre,1e-6);
}`,
  `fn fleckCount(length_:f32) -> f32 {
 return clamp(floor(length_ / fleckLength()+0.5),1.0,255.0);
}`,
  "const finishGrass:u32=0u;",
  "const finishBroad:u32=1u;",
  "const finishPetal:u32=2u;",
  "const finishStalk:u32=3u;",
  "const finishPlain:u32=4u;",
  `fn finishOf(look:Species) -> u32 {
 if (look.shape==shapeQuad) {
  return finishStalk;
 }
 if (look.shape!=shapeLeaf&&look.shape!=shapeDandelion) {
  return finishGrass;
 }
 return select(finishPetal,finishBroad,look.tipColor.y > max(look.tipColor.x,look.tipColor.z));
}`,
  `fn finishDice(seed:u32) -> f32 {
 return f32(seed & 255u)*(1.0 / 255.0);
}`,
  `fn endWave(away:f32,falls:f32) -> f32 {
 let rest=max(1.0 - away,0.0);
 return rest*rest*(1.0 - falls*away);
}`,
  `fn toneAlong(finish:u32,along:f32,seed:u32) -> vec3f {
 if (finish==finishBroad||finish==finishPlain) {
  return vec3f(1.0);
 }
 if (finish==finishPetal) {
  return vec3f(1.0) - endWave(min(along*(1.0 / 0.6),1.0),2.5)*vec3f(0.12,0.22,0.42);
 }
 let tone=vec3f(1.0)+endWave(min(along*2.5,1.0),4.0)*vec3f(0.75,0.3,0.55);
 if (finish==finishStalk) {
  return tone;
 }
 let dry=smoothstep(0.3,1.0,finishDice(seed));
 return tone+dry*endWave(min(2.2 - 2.2*along,1.0),2.5)*vec3f(0.12,-0.2,-0.35);
}`,
  `struct Veins {
 tone:vec3f,
 slope:f32,
}`,
  `fn midribAt(x:f32,reach:f32) -> f32 {
 let off=x / reach;
 let rest=max(1.0 - off*off,0.0);
 return rest*rest - 8.0 / 15.0*reach;
}`,
  `fn shareSeen(spacing:f32) -> f32 {
 return smoothstep(2.5,5.0,spacing);
}`,
  "const halfWave:f32=3.14159265;",
  `fn veinsAt(finish:u32,place:vec2f,pixels:f32,seed:u32) -> Veins {
 let x=place.x;
 let t=place.y;
 var veins:Veins;
 veins.tone=vec3f(1.0);
 veins.slope=0.0;
 let wide=select(pixels*min(1.0,select(4.0*t*(1.0 - t),2.0 - 2.0*t,finish==finishGrass)),pixels,finish==finishStalk);
 let ridge=shareSeen(0.6*wide);
 let phase=40.0*finishDice(seed);
 if (finish==finishGrass) {
  let few=shareSeen(wide / 7.0);
  let many=shareSeen(wide / 17.0);
  let a=7.0*halfWave*x+phase;
  let b=17.0*halfWave*x+2.0*phase;
  veins.tone+=ridge*midribAt(x,0.16)*vec3f(0.45,0.36,0.8)+0.09*few*cos(a)+0.07*many*cos(b);
  veins.slope=0.16*few*sin(a)+0.14*many*sin(b);
 } else {
  if (finish==finishBroad) {
   let a=2.0*halfWave*(7.0*t - abs(x))+phase;
   let side=shareSeen(0.3*wide);
   veins.tone+=ridge*midribAt(x,0.1)*vec3f(0.5,0.42,0.7)+side*(0.1*cos(a)+0.06*cos(2.0*a)+0.03*cos(3.0*a));
   veins.slope=0.12*side*sin(a)*sign(x);
  } else {
   if (finish==finishPetal) {
    let a=5.0*halfWave*x+phase;
    let b=13.0*halfWave*x+2.0*phase;
    let few=shareSeen(wide / 5.0);
    let many=shareSeen(wide / 13.0);
    veins.tone+=0.07*few*cos(a)+0.08*(1.0 - 0.5*t)*many*cos(b);
    veins.slope=0.3*few*sin(a)+0.15*many*sin(b);
   } else {
    if (finish==finishStalk) {
     let a=4.0*halfWave*x+phase;
     let few=shareSeen(0.4*wide);
     veins.tone+=0.1*few*cos(a);
     veins.slope=0.12*few*sin(a);
    }
   }
  }
 }
 return veins;
}`,
  "const roughnessAcross:f32=0.46;",
  "const roughnessAlong:f32=0.18;",
  "const mirroredHeadOn:f32=0.019;",
  `fn coatShine(normal:vec3f,tangent:vec3f,source:vec3f,eye:vec3f) -> f32 {
 let facing=dot(normal,source);
 let sum=source+eye;
 let along=dot(sum,tangent);
 let up=dot(sum,normal);
 if (facing <= 0.0||up <= 0.0) {
  return 0.0;
 }
 let square=dot(sum,sum);
 let across=max(square - up*up - along*along,0.0);
 let depth=max(up*up,0.0625);
 let slopes=(along*along*(1.0 / (roughnessAlong*roughnessAlong))+across*(1.0 / (roughnessAcross*roughnessAcross))) / depth;
 let grazing=max(1.0 - 0.5*sqrt(square),0.0);
 let twice=grazing*grazing;
 let fresnel=mirroredHeadOn+(1.0 - mirroredHeadOn)*twice*twice*grazing;
 return facing*fresnel*exp(-slopes)*square / (roughnessAcross*roughnessAlong*depth*depth);
}`,
  `fn coatAlbedo(cosine:f32) -> f32 {
 let grazing=1.0 - clamp(cosine,0.1,1.0);
 let twice=grazing*grazing;
 return 0.017+0.3*twice*twice;
}`,
  `struct BladePoint {
 position:vec3f,
 tangent:vec3f,
 axis:vec3f,
 up:vec3f,
 fold:f32,
 place:vec2f,
 rootColor:vec4f,
 tipColor:vec4f,
 look:vec3f,
 leafAbove:f32,
 leafBelow:f32,
 seed:u32,
 flecks:f32,
 finish:f32,
}`,
  `fn bladeNormal(point:BladePoint,toEye:vec3f,distance_:f32) -> vec3f {
 let flat_=cross(point.tangent,point.axis);
 let size=length(flat_);
 var n=select(point.up,flat_ / size,size > 1e-3);
 if (point.fold > 0.0) {
  n+=point.fold*sign(point.place.x)*point.axis;
 }
 n*=select(1.0,-1.0,dot(n,toEye) < 0.0);
 let smallness=smoothstep(4.0,60.0,distance_*1000.0 / frameConstants_.view.pixelsPerUnit);
 let roundness=select(0.55,1.4,finishIn(point.finish)==finishStalk);
 return normalize(n+roundness*(1.0 - point.fold)*(1.0 - smallness)*point.place.x*point.axis);
}`,
  `struct Scattering {
 facing:f32,
 diffuse:f32,
 through:f32,
}`,
  `fn scatteringOf(source:vec3f,n:vec3f) -> Scattering {
 var scattering:Scattering;
 scattering.facing=dot(n,source);
 scattering.diffuse=max((scattering.facing+0.15) / 1.3225,0.0);
 scattering.through=max(-scattering.facing,0.0);
 return scattering;
}`,
  `fn throughBlade(translucency:f32) -> vec3f {
 return throughShare*translucency*throughTint;
}`,
  `struct Incoming {
 around:vec3f,
 behind:vec3f,
 above:vec3f,
 mirrored:vec3f,
 sun:vec3f,
}`,
  `fn incomingFromSky(n:vec3f,open:vec2f) -> Incoming {
 let sky=1.25*open.x*frameConstants_.skyColor;
 let ground=open.y*frameConstants_.groundColor;
 let up=0.5+0.5*dot(n,frameConstants_.skyUp);
 return Incoming(mix(ground,sky,up),mix(sky,ground,up),1.25*frameConstants_.skyColor,frameConstants_.skyColor,frameConstants_.sunColor);
}`,
  `fn incomingAt(position:vec3f,up:vec3f,n:vec3f,open:vec2f) -> Incoming {
 return incomingFromSky(n,open);
}`,
  "const fleckEdge:f32=0.15;",
  `fn fleckAt(key:u32,mean:f32) -> f32 {
 let chance=f32(mixUint(key) >> 8u)*(1.0 / 16777216.0);
 return clamp((mean - chance) / (2.0*fleckEdge)+0.5,0.0,1.0);
}`,
  `fn fleckOf(point:BladePoint,mean:f32,distance_:f32) -> f32 {
 let pixels=frameConstants_.view.pixelsPerUnit*fleckLength() / distance_;
 let seen=smoothstep(1.0,4.0,pixels);
 if (seen <= 0.0) {
  return mean;
 }
 let at=point.place.y*point.flecks+f32(point.seed & 255u)*(1.0 / 256.0);
 let key=point.seed+u32(at)*0x9e3779b9u;
 let fleck=mix(fleckAt(key,mean),fleckAt(key+0x9e3779b9u,mean),smoothstep(0.25,0.75,fract(at)));
 return mix(mean,fleck,seen);
}`,
  `struct LitPoint {
 normal:vec3f,
 albedo:vec3f,
 risen:f32,
 sunlit:f32,
}`,
  `fn litPoint(point:BladePoint,toEye:vec3f,distance_:f32) -> LitPoint {
 let along=point.place.y;
 var n=bladeNormal(point,toEye,distance_);
 let finish=finishIn(point.finish);
 var albedo=mix(point.rootColor.rgb,point.tipColor.rgb,tipShareAt(along));
 let isPlain=debugMode()!=debugNothing;
 if (!isPlain) {
  albedo*=toneAlong(finish,along,point.seed);
 }
 let turned=dot(toEye,point.axis);
 let wide=pixelsIn(point.finish)*sqrt(max(1.0 - turned*turned,0.0));
 if (!isPlain&&wide > 4.0) {
  let veins=veinsAt(finish,point.place,wide,point.seed);
  albedo*=veins.tone;
  n=normalize(n+veins.slope*point.axis);
 }
 let risen=mix(point.rootColor.w,point.tipColor.w,along);
 let among=sunAmongBlades(frameConstants_.bladeShadow,point.position,point.seed);
 var passed=among.x;
 if (among.y < 1.0) {
  passed=mix(fleckOf(point,sunBelow(leafProjectionOf(frameConstants_.cover),point.leafAbove,dot(point.up,frameConstants_.sunDirection)),distance_),passed,among.y);
 }
 return LitPoint(n,albedo,risen,point.look.x*risen*passed);
}`,
  `fn ontoBlade(point_in:BladePoint) -> BladePoint {
 var point=point_in;
 point.place=clamp(point.place,vec2f(-1.0,0.0),vec2f(1.0));
 return point;
}`,
  `fn bladePicture(point_in:BladePoint) -> vec3f {
 var point=point_in;
 point=ontoBlade(point);
 let along=point.place.y;
 let openSky=point.look.x;
 let translucency=point.look.y;
 let gloss=point.look.z;
 let sun=frameConstants_.sunDirection;
 let ray=frameConstants_.view.eye - point.position;
 let distance_=length(ray);
 if (showsBands()) {
  let band=distanceBand(distance_,frameConstants_.view.drawDistance);
  let channel=band - 3u*(debugMode() - debugNear);
  return vec3f(f32(channel==0u),f32(channel==1u),f32(channel==2u));
 }
 let toEye=ray / max(distance_,1e-6);
 let lit=litPoint(point,toEye,distance_);
 let n=lit.normal;
 let albedo=lit.albedo;
 let risen=lit.risen;
 let sunlit=lit.sunlit;
 let leafArea=point.leafAbove;
 let upright=dot(point.up,sun);
 let openBelow=skyBelow(point.leafBelow);
 let openAbove=openSky*skyBelow(leafArea);
 let incoming=incomingAt(point.position,point.up,n,vec2f(openAbove,openSky*openBelow));
 let through=throughBlade(translucency);
 var light=incoming.around+through*incoming.behind+openSky*(1.0+through)*lightAmongLeaves(leafArea,1.0 - openBelow,upright,risen*incoming.sun,incoming.above,albedo*(1.0+through));
 let scattering=scatteringOf(sun,n);
 light+=incoming.sun*(sunlit*(scattering.diffuse+through*scattering.through));
 var color=albedo*light;
 let coat=gloss*along;
 if (coat > 0.0) {
  let towards=dot(n,toEye);
  let mirrored=coat*coatAlbedo(towards);
  let upwards=0.5+towards*dot(n,frameConstants_.skyUp) - 0.5*dot(toEye,frameConstants_.skyUp);
  color+=mirrored*(openAbove*upwards*incoming.mirrored - color);
  color+=coat*sunlit*coatShine(n,point.tangent,sun,toEye)*incoming.sun;
 }
 if (debugMode()!=debugNothing) {
  color=albedo*(0.25+0.75*along)*(0.6+0.4*max(scattering.facing,0.0));
 } else {
  color=throughAir(color,-toEye,distance_);
 }
 return develop(color);
}`,
  "const debugReason:u32=4u;",
  `fn cullResultColor(cullResult:u32) -> vec3f {
 if (cullResult==cullResultDrawn) {
  return vec3f(0.06,0.34,0.12);
 }
 if (cullResult==cullResultPatch) {
  return vec3f(0.30,0.30,0.33);
 }
 if (cullResult==cullResultOrientation) {
  return vec3f(0.86,0.77,0.05);
 }
 if (cullResult==cullResultFrustum) {
  return vec3f(0.66,0.11,0.01);
 }
 if (cullResult==cullResultDistance) {
  return vec3f(0.02,0.17,0.45);
 }
 if (cullResult==cullResultOcclusion) {
  return vec3f(0.60,0.19,0.38);
 }
 return vec3f(0.09,0.46,0.81);
}`,
  `fn liftedSurface(surface_in:BladeSurface,above:f32) -> BladeSurface {
 var surface=surface_in;
 let root=1.0 - heightWithLeafShare(above);
 surface.root=vec4f(mix(surface.root.rgb,surface.tip.rgb,tipShareAt(root)),mix(surface.root.w,surface.tip.w,root));
 surface.material.y*=above;
 return surface;
}`,
  `fn bladeSurface(drawn:DrawnBlade,visible:VisibleBlade,limit:LeafAreaLimit) -> BladeSurface {
 let blade=drawn.blade;
 let species=drawn.species;
 let grass=grassAt(frameConstants_.cover,blade.root);
 let leafArea=grass.x;
 var colors=bladeColors(frameConstants_.cover,blade,species,leafArea);
 if (debugMode()==1u) {
  colors.tip=mix(vec3f(0.1,0.6,0.1),vec3f(1.0,0.1,0.0),clamp(log2(max(widthFactorOf(visible),1.0)) / 4.0,0.0,1.0));
 } else {
  if (debugMode()==2u) {
   colors.tip=colorOf(visible.patchIndex);
  } else {
   if (debugMode()==debugReason) {
    colors.tip=cullResultColor(fetch_cullResults(placeOf(vec2u(),visible.blade)));
   }
  }
 }
 if (debugMode()!=debugNothing) {
  colors.root=0.4*colors.tip;
 }
 let risen=smoothstep(-0.15,0.25,dot(blade.up,frameConstants_.sunDirection));
 var surface:BladeSurface;
 surface.root=vec4f(colors.root,risen*sunSeen(frameConstants_.shadow,drawn.ribbon.v0,blade.up));
 surface.tip=vec4f(colors.tip,risen*sunSeen(frameConstants_.shadow,drawn.ribbon.v2,blade.up));
 let heights=vec3f(dot(drawn.ribbon.v0 - blade.root,blade.up),dot(drawn.ribbon.v1 - blade.root,blade.up),dot(drawn.ribbon.v2 - blade.root,blade.up));
 let missing=leavesPerDrawn(frameConstants_.view,distance(blade.root,frameConstants_.view.eye));
 surface.material=vec4f(packedLook(vec3f(blade.exposure,species.translucency,species.gloss)),leavesAround(leafArea / missing,frameConstants_.cover.thinned*missing),packedHeights(heightStepsPerMetre(frameConstants_.cover,grass) / heightFactorOf(visible)*heights),packedFinish(finishOf(species),visible.pixels*drawn.ribbon.width / blade.height));
 var t1_:BladeSurface;
 if (limit.light < 1.0) {
  t1_=liftedSurface(surface,limit.light);
 } else {
  t1_=surface;
 }
 return t1_;
}`,
  `struct SeenBlade {
 ribbon:Ribbon,
 surface:BladeSurface,
 blade:u32,
 patchIndex:u32,
 hasHistory:bool,
}`,
  `struct SeenPoint {
 shares:vec3f,
 depth:f32,
 least:f32,
}`,
  `fn seenAt(a:vec4f,b:vec4f,c:vec4f,place:vec2f) -> SeenPoint {
 let p=a.xy - place*a.w;
 let q=b.xy - place*b.w;
 let r=c.xy - place*c.w;
 let areas=vec3f(q.x*r.y - q.y*r.x,r.x*p.y - r.y*p.x,p.x*q.y - p.y*q.x);
 let sum=areas.x+areas.y+areas.z;
 var seen:SeenPoint;
 seen.shares=select(vec3f(0.0),areas / sum,sum!=0.0);
 let w=dot(seen.shares,vec3f(a.w,b.w,c.w));
 seen.depth=select(0.0,dot(seen.shares,vec3f(a.z,b.z,c.z)) / w,w > 0.0);
 seen.least=select(-1e9,min(min(seen.shares.x,seen.shares.y),seen.shares.z),w > 0.0&&sum!=0.0);
 return seen;
}`,
  `fn rayThrough(place:vec2f) -> vec3f {
 return place.x*frameConstants_.rays[0]+(place.y*frameConstants_.rays[1]+frameConstants_.rays[2]);
}`,
  `struct Corner {
 seen:vec4f,
 place:vec2f,
}`,
  `struct Found {
 point:vec3f,
 place:vec2f,
}`,
  `struct Guess {
 error:f32,
 depth:f32,
 place:vec2f,
}`,
  `struct Sighting {
 pixel:vec2f,
 depth:f32,
 middle:vec2f,
}`,
  "const foundError:f32=0.02;",
  `fn errorOf(seen:SeenPoint,sighting:Sighting) -> f32 {
 return max(-seen.least,0.0)+abs(seen.depth / sighting.depth - 1.0);
}`,
  `fn sharesInMiddle(first:vec4f,second:vec4f,third:vec4f,seen:SeenPoint,sighting:Sighting) -> vec3f {
 let inside=max(seenAt(first,second,third,sighting.middle).shares,vec3f(0.0));
 return inside / max(inside.x+inside.y+inside.z,1e-6);
}`,
  `fn depthOf(first:vec4f,second:vec4f,third:vec4f,shares:vec3f) -> f32 {
 return dot(shares,vec3f(first.z,second.z,third.z)) / dot(shares,vec3f(first.w,second.w,third.w));
}`,
  `fn lookAtHalves(lens:Lens,ribbon:Ribbon,low:f32,high:f32,isUpper:bool,sighting:Sighting,guess:ptr<function,Guess>) {
 let before=seenSection(lens,ribbon,low);
 let after=seenSection(lens,ribbon,high);
 let left=Corner(before.left,vec2f(-1.0,low));
 let right=Corner(before.right,vec2f(1.0,low));
 let ridge=Corner(before.ridge,vec2f(0.0,low));
 let leftAfter=Corner(after.left,vec2f(-1.0,high));
 let rightAfter=Corner(after.right,vec2f(1.0,high));
 let ridgeAfter=Corner(after.ridge,vec2f(0.0,high));
 for (var i=0u; i < trianglesOf(true); i++) {
  let part=triangleOf(i,true,isUpper);
  var t1_:Corner;
  if (part.isRight) {
   t1_=ridge;
  } else {
   t1_=left;
  }
  let a=t1_;
  var t2_:Corner;
  if (part.endsAtRidge) {
   t2_=ridge;
  } else {
   t2_=right;
  }
  let b=t2_;
  var t3_:Corner;
  if (part.isRight) {
   t3_=ridgeAfter;
  } else {
   t3_=leftAfter;
  }
  let c=t3_;
  var t4_:Corner;
  if (part.endsAtRidge) {
   t4_=ridgeAfter;
  } else {
   t4_=rightAfter;
  }
  let d=t4_;
  var t5_:Corner;
  if (part.beginsRight) {
   t5_=b;
  } else {
   t5_=a;
  }
  let first=t5_;
  var t6_:Corner;
  if (part.isSecond) {
   t6_=d;
  } else {
   t6_=b;
  }
  let second=t6_;
  var t7_:Corner;
  if (part.endsLeft) {
   t7_=c;
  } else {
   t7_=d;
  }
  let third=t7_;
  let seen=seenAt(first.seen,second.seen,third.seen,sighting.pixel);
  let error=errorOf(seen,sighting);
  if (error >= (*guess).error) {
   continue;
  }
  let shares=sharesInMiddle(first.seen,second.seen,third.seen,seen,sighting);
  (*guess).error=error;
  (*guess).depth=depthOf(first.seen,second.seen,third.seen,shares);
  (*guess).place=shares.x*first.place+shares.y*second.place+shares.z*third.place;
 }
}`,
  `struct Curve {
 toMiddle:vec3f,
 bend:vec3f,
}`,
  `fn curveOf(ribbon:Ribbon) -> Curve {
 let toMiddle=2.0*(ribbon.v1 - ribbon.v0);
 let bend=ribbon.v2 - ribbon.v0 - toMiddle;
 return Curve(toMiddle,bend);
}`,
  `fn tangentOf_2(curve:Curve,t:f32) -> vec3f {
 let along=curve.toMiddle+2.0*t*curve.bend;
 return normalize(select(curve.toMiddle,along,dot(along,along) > 1e-18));
}`,
  `fn placeAlong(ribbon:Ribbon,curve:Curve,point:vec3f) -> f32 {
 let upwards=curve.toMiddle;
 let forwards=cross(upwards,ribbon.axis);
 let toPoint=point - ribbon.v0;
 let rise=dot(upwards,upwards);
 let bend=vec2f(dot(curve.bend,upwards),dot(curve.bend,forwards));
 let tip=bend+vec2f(rise,0.0);
 let p=vec2f(dot(toPoint,upwards),dot(toPoint,forwards));
 var t=clamp(dot(p,tip) / max(dot(tip,tip),1e-30),0.0,1.0);
 for (var i=0u; i < 2u; i++) {
  let half_=vec2f(rise,0.0)+t*bend;
  let off=t*half_ - p;
  let speed=half_+t*bend;
  t=clamp(t - dot(off,speed) / max(dot(speed,speed),1e-30),0.0,1.0);
 }
 return t;
}`,
  `fn rayTo(lens:Lens,pixel:vec2f) -> vec3f {
 return rayThrough(2.0*pixel / lens.size - 1.0);
}`,
  `fn pointSeen(lens:Lens,ray:vec3f,depth:f32) -> vec3f {
 let depthRow=vec3f(lens.viewProjection[0].z,lens.viewProjection[1].z,lens.viewProjection[2].z);
 return lens.eye+frameConstants_.depthOfEye / (depth - dot(depthRow,ray))*ray;
}`,
  `fn findOnFold(lens:Lens,ribbon:Ribbon,sighting:Sighting) -> Found {
 var guess:Guess;
 guess.error=1e30;
 let segments=ribbon.outline.segments;
 let point=pointSeen(lens,rayTo(lens,sighting.pixel),sighting.depth);
 var t1_:f32;
 if (segments > 1.5) {
  t1_=placeAlong(ribbon,curveOf(ribbon),point);
 } else {
  t1_=0.0;
 }
 let place=t1_;
 var segment=clamp(floor(place*segments)+1.0,1.0,segments);
 var step_=select(1.0,-1.0,fract(place*segments) < 0.5);
 for (var turn=0.0; turn < 2.0*segments; turn+=1.0) {
  if (segment >= 1.0&&segment <= segments) {
   lookAtHalves(lens,ribbon,(segment - 1.0) / segments,segment / segments,upperHalf(segment,segments),sighting,&guess);
  }
  if (guess.error < foundError||segments < 1.5) {
   break;
  }
  segment+=step_;
  step_=-step_ - sign(step_);
 }
 return Found(pointSeen(lens,rayTo(lens,sighting.middle),guess.depth),guess.place);
}`,
  `fn placeAcross(toLeft:f32,toRight:f32,widths:vec2f,share:f32,isUpper:bool) -> f32 {
 let isFirst=select(toRight,toLeft,isUpper) <= widths.x*(1.0 - share);
 let width=max(select(widths.y,widths.x,isFirst),1e-6);
 return select(1.0 - 2.0*toRight / width,2.0*toLeft / width - 1.0,isFirst==isUpper);
}`,
  `fn findOnPlane(lens:Lens,ribbon:Ribbon,sighting:Sighting) -> Found {
 let segments=ribbon.outline.segments;
 let point=pointSeen(lens,rayTo(lens,sighting.pixel),sighting.depth);
 let curve=curveOf(ribbon);
 let guess=placeAlong(ribbon,curve,point)*segments;
 let segment=min(floor(guess),segments - 1.0);
 let each=1.0 / segments;
 let low=segment*each;
 let high=low+each;
 let begin=ribbon.v0+low*(curve.toMiddle+low*curve.bend);
 let chord=each*(curve.toMiddle+(low+high)*curve.bend);
 let ray=rayTo(lens,sighting.middle);
 let side=cross(ray,chord);
 let square=dot(side,side);
 let isAtEye=square <= 1e-12*dot(ray,ray)*dot(chord,chord);
 var across=select(side*inverseSqrt(square),ribbon.axis,isAtEye);
 let seen=dot(ribbon.axis,across);
 across=select(across,-across,seen < 0.0);
 let first=ribbon.width*edgesAt(ribbon.outline,low);
 let second=ribbon.width*edgesAt(ribbon.outline,high);
 let ends=vec2f(first.y - first.x,second.y - second.x);
 let wide=abs(seen)*ends;
 let drawn=max(wide,vec2f(lens.minWidth*length(begin - lens.eye)));
 let grown=drawn - wide;
 var axis=ribbon.axis;
 if (grown.x+grown.y > 0.0) {
  axis=(ends.x+ends.y)*axis+(grown.x+grown.y)*outwardsOf(across,cross(ray,ribbon.v1 - ribbon.v0));
 }
 var toEye=lens.eye - begin;
 var upwards=chord;
 if (!isEven(ribbon.outline.shape)) {
  toEye-=0.5*(first.x+first.y)*ribbon.axis;
  upwards+=0.5*(second.x+second.y - first.x - first.y)*ribbon.axis;
 }
 let turned=cross(ray,axis);
 let steepness=dot(upwards,turned);
 let isLine=isAtEye||steepness==0.0;
 let share=clamp(select(dot(toEye,turned) / steepness,guess - segment,isLine),0.0,1.0);
 let reach=0.5*mix(drawn.x,drawn.y,share);
 let off=dot(toEye - share*upwards,across);
 let placeX=placeAcross(reach+off,reach - off,drawn,share,upperHalf(segment+1.0,segments));
 return Found(pointSeen(lens,ray,sighting.depth),vec2f(placeX,(segment+share)*each));
}`,
  `fn find(lens:Lens,ribbon:Ribbon,sighting:Sighting) -> Found {
 if (isFolded(ribbon)) {
  return findOnFold(lens,ribbon,sighting);
 }
 return findOnPlane(lens,ribbon,sighting);
}`,
  `fn pointOf(seen:SeenBlade,found:Found) -> BladePoint {
 let ribbon=seen.ribbon;
 var point:BladePoint;
 point.position=found.point;
 point.place=found.place;
 point.tangent=tangentOf_2(curveOf(ribbon),point.place.y);
 point.axis=ribbon.axis;
 point.up=normalize(ribbon.v1 - ribbon.v0);
 point.fold=select(0.0,ribbon.fold,isFolded(ribbon));
 point.rootColor=seen.surface.root;
 point.tipColor=seen.surface.tip;
 point.look=unpackedLook(seen.surface.material.x);
 point.leafAbove=leafAreaAbove(seen.surface.material,clamp(found.place.y,0.0,1.0));
 point.leafBelow=max(seen.surface.material.y - point.leafAbove,0.0);
 point.seed=ribbon.seed;
 point.finish=seen.surface.material.w;
 point.flecks=fleckCount(length(ribbon.v1 - ribbon.v0)+length(ribbon.v2 - ribbon.v1));
 return point;
}`,
  `fn shadeFound(seen:SeenBlade,found:Found) -> vec4f {
 let point=pointOf(seen,found);
 return vec4f(bladePicture(point),1.0 - softness(length(frameConstants_.view.eye - point.position),1.0));
}`,
  `fn cloudAt(place_in:vec3f) -> f32 {
 var place=place_in;
 let least=mix(0.72,0.34,frameConstants_.clouds);
 let finest=1.0 / 32.0;
 var sum=0.0;
 var weight=0.5;
 for (var octave=0u; octave < 5u; octave++) {
  sum+=weight*valueNoise(place);
  if (sum+weight - finest <= least) {
   return 0.0;
  }
  place=2.13*place.yzx+vec3f(3.7,11.1,5.3);
  weight*=0.5;
 }
 return smoothstep(0.0,0.26,sum - least);
}`,
  `fn withClouds(color:vec3f,ray:vec3f) -> vec3f {
 let height=dot(ray,frameConstants_.skyUp);
 if (frameConstants_.clouds <= 0.0||height <= 0.0) {
  return color;
 }
 let place=ray*(1.9 / (height+0.16));
 let thickness=cloudAt(place);
 if (thickness <= 0.0) {
  return color;
 }
 let sunwards=frameConstants_.sunDirection - frameConstants_.skyUp*dot(frameConstants_.sunDirection,frameConstants_.skyUp);
 let shade=cloudAt(place+0.35*sunwards);
 let toSun=max(dot(ray,frameConstants_.sunDirection),0.0);
 let lit=frameConstants_.sunColor*(0.30*exp(-1.4*shade)*(1.0+0.9*pow(toSun,6.0)))+0.55*frameConstants_.skyColor;
 let shown=thickness*0.85*smoothstep(0.0,0.22,height);
 return mix(color,lit,shown);
}`,
  "const floorAlbedo:vec3f=vec3f(0.160,0.152,0.130);",
  "const floorBounce:f32=0.12;",
  `fn sunOnFloor(place:vec3f) -> f32 {
 if (frameConstants_.shadow.size==0u) {
  return 1.0;
 }
 let depth=dot(frameConstants_.shadow.depth,vec4f(place,1.0));
 let perMetre=dot(frameConstants_.shadow.depth.xyz,frameConstants_.sunDirection);
 return sunSeen(frameConstants_.shadow,place+frameConstants_.sunDirection*(max(0.002 - depth,0.0) / perMetre),frameConstants_.skyUp);
}`,
  `fn belowHorizon(color:vec3f,ray:vec3f) -> vec3f {
 let climb=dot(ray,frameConstants_.skyUp);
 if (climb >= 0.0) {
  return color;
 }
 let plane=frameConstants_.floorPlane;
 if (plane.reach <= 0.0) {
  return color*(1.0 - 0.35*smoothstep(0.0,1.0,-climb));
 }
 let distance_=dot(plane.middle - frameConstants_.view.eye,frameConstants_.skyUp) / climb;
 if (distance_ <= 0.0) {
  return color;
 }
 let place=frameConstants_.view.eye+distance_*ray;
 let away=distanceFromFootprint(plane,place,cross(frameConstants_.skyUp,plane.along));
 let shown=exp(-away / plane.reach);
 if (shown < 0.002) {
  return color;
 }
 let facing=max(dot(frameConstants_.sunDirection,frameConstants_.skyUp),0.0);
 var t1_:f32;
 if (facing > 0.0) {
  t1_=sunOnFloor(place);
 } else {
  t1_=0.0;
 }
 let lit=t1_;
 let open=skyBesideWall(plane.height,away);
 let light=hemisphere(frameConstants_.skyUp)*open+frameConstants_.sunColor*(facing*mix(floorBounce*open,1.0,lit));
 return mix(color,throughAir(floorAlbedo*light,ray,distance_),shown);
}`,
  `fn skyPicture(ray:vec3f,place:vec2f) -> vec3f {
 if (debugMode()!=debugNothing) {
  var t1_:vec3f;
  if (showsBands()) {
   t1_=vec3f(0.0);
  } else {
   t1_=dithered(develop(vec3f(0.6)),place);
  }
  return t1_;
 }
 var color=belowHorizon(withClouds(skyRadiance(ray),ray),ray);
 let toSun=dot(ray,frameConstants_.sunDirection);
 color+=frameConstants_.sunColor*6.0*smoothstep(0.99985,0.99997,toSun);
 return dithered(develop(color),place);
}`,
  `fn halfRounded(value:vec4f) -> vec4f {
 let droppedBits=13u;
 let bits=bitcast<vec4u>(value)+(1u << (droppedBits - 1u));
 return bitcast<vec4f>(bits & vec4u(~((1u << droppedBits) - 1u)));
}`,
  "@group(0) @binding(9) var<storage,read> seenSamples_:array<vec2u>;",
  "@group(0) @binding(21) var groundLight_:texture_multisampled_2d<f32>;",
  "@group(0) @binding(22) var resolved_:texture_storage_2d<rgba16float,write>;",
  "const gatherTile:u32=8u;",
  "const gatherThreads:u32=gatherTile*gatherTile;",
  "var<workgroup> gathered:array<u32,256>;",
  "var<workgroup> gatheredCount:atomic<u32>;",
  "var<workgroup> lights:array<vec4f,256>;",
  `fn pixelOf(tile:vec2u,thread:u32) -> vec2u {
 return tile*gatherTile+vec2u(thread % gatherTile,thread / gatherTile);
}`,
  `struct ShadingTask {
 thread:u32,
 s:u32,
 samples:u32,
}`,
  `fn taskAt(i:u32) -> ShadingTask {
 return ShadingTask(gathered[i] & 0xffu,(gathered[i] >> 8u) & 0xffu,gathered[i] >> 16u);
}`,
  `fn gatherTasks(thread:u32,seen:array<u32,4>,first:u32,end:u32) -> u32 {
 var leaders=0u;
 for (var s=0u; s < samplesPerPixel; s++) {
  var samples=0u;
  for (var other=0u; other < samplesPerPixel; other++) {
   samples|=select(0u,1u << other,seen[other]==seen[s]);
  }
  if (seen[s] < first||seen[s] >= end||i32(countOneBits(samples & ((1u << s) - 1u)))!=i32(countOneBits(samples)) / 2) {
   continue;
  }
  leaders|=1u << s;
  gathered[atomicAdd(&gatheredCount,1u)]=thread | (s << 8u) | (samples << 16u);
 }
 return leaders;
}`,
  `fn putLight(task:ShadingTask,light:vec4f) {
 lights[samplesPerPixel*task.thread+task.s]=f32(i32(countOneBits(task.samples)))*light;
}`,
  `fn sumOfLight(thread:u32,leaders:u32) -> vec4f {
 var sum=vec4f(0.0);
 for (var s=0u; s < samplesPerPixel; s++) {
  if ((leaders & (1u << s))!=0u) {
   sum+=lights[samplesPerPixel*thread+s];
  }
 }
 return sum;
}`,
  `fn listedBlade(place:u32) -> SeenBlade {
 let item=visible_[place];
 let drawn=drawnBlade_3(item);
 var seen:SeenBlade;
 seen.ribbon=drawn.ribbon;
 seen.surface=bladeSurface(drawn,item,leafAreaLimitOf(frameConstants_.view,patches_[item.patchIndex]));
 return seen;
}`,
  `@compute @workgroup_size(8,8,1)
fn main(@builtin(workgroup_id) WorkGroupID_:vec3u,@builtin(local_invocation_index) LocalInvocationIndex_:u32) {
 let lens=lensOf();
 let thread=LocalInvocationIndex_;
 let tile=WorkGroupID_.xy;
 let pixel=pixelOf(tile,thread);
 let isInside=all(pixel < push_.size);
 if (thread==0u) {
  atomicStore(&gatheredCount,0u);
 }
 workgroupBarrier();
 var seen:array<u32,4>;
 var leaders=0u;
 if (isInside) {
  for (var s=0u; s < samplesPerPixel; s++) {
   seen[s]=seenSamples_[sampleIndex(pixel,s)].x;
  }
  leaders=gatherTasks(thread,seen,push_.firstBlade,~0u);
 }
 workgroupBarrier();
 for (var i=thread; i < atomicLoad(&gatheredCount); i+=gatherThreads) {
  let task=taskAt(i);
  let place=pixelOf(tile,task.thread);
  let sample_=seenSamples_[sampleIndex(place,task.s)];
  let blade=listedBlade(sample_.x - push_.firstBlade);
  let sighting=Sighting(vec2f(place)+samplePlace(task.s),bitcast<f32>(sample_.y),vec2f(place)+middleOf(task.samples));
  putLight(task,shadeFound(blade,find(lens,blade.ribbon,sighting)));
 }
 workgroupBarrier();
 if (!isInside) {
  return;
 }
 var sum=sumOfLight(thread,leaders);
 var sky=0.0;
 for (var s=0u; s < samplesPerPixel; s++) {
  if (seen[s] >= push_.firstBlade) {
   continue;
  }
  if (seenSamples_[sampleIndex(pixel,s)].y==0u) {
   sky+=1.0;
  } else {
   sum+=textureLoad(groundLight_,vec2i(pixel),i32(s));
  }
 }
 if (sky > 0.0) {
  let middle=vec2f(pixel)+0.5;
  sum+=sky*vec4f(skyPicture(normalize(rayTo(lens,middle)),middle),1.0);
 }
 textureStore(resolved_,vec2i(pixel),halfRounded(sum / f32(samplesPerPixel)));
}`,
  "@group(0) @binding(23) var<storage,read_write> records_:array<vec4f>;",
  `@compute @workgroup_size(64,1,1)
fn main(@builtin(workgroup_id) WorkGroupID_:vec3u,@builtin(local_invocation_index) LocalInvocationIndex_:u32) {
 let place=(WorkGroupID_.y*groupsOfRow+WorkGroupID_.x)*64u+LocalInvocationIndex_;
 if (place >= min(counters_[countBlades],push_.capacity)) {
  return;
 }
 let item=visible_[place];
 let ribbon=drawnBlade_3(item).ribbon;
 records_[3u*place]=vec4f(ribbon.v0,bitcast<f32>(item.blade));
 records_[3u*place+1u]=vec4f(ribbon.v1,ribbon.width);
 records_[3u*place+2u]=vec4f(ribbon.v2,0.0);
}`,
  `fn decodeNormal32(bits:u32) -> vec3f {
 let x=f32((i32(bits & 65535u) ^ 32768) - 32768) / 32767.0;
 let y=f32((i32(bits >> 16u) ^ 32768) - 32768) / 32767.0;
 let z=1.0 - abs(x) - abs(y);
 let fold=max(-z,0.0);
 return normalize(vec3f(x+select(fold,-fold,x >= 0.0),y+select(fold,-fold,y >= 0.0),z));
}`,
  "var<private> position:vec3f;",
  "var<private> normal:u32;",
  "var<private> uv:vec2f;",
  "var<private> color:vec4f;",
  "var<private> outPosition:vec3f;",
  "var<private> outNormal:vec3f;",
  "var<private> outUv:vec2f;",
  "var<private> outVertexColor:vec4f;",
  `var<private> ownPosition:vec4f;
struct Drawn {
 @builtin(position) @invariant at:vec4f,
 @location(0) outPosition:vec3f,
 @location(1) outNormal:vec3f,
 @location(2) outUv:vec2f,
 @location(3) outVertexColor:vec4f,
}
fn run() {
 outPosition=position;
 outNormal=decodeNormal32(normal);
 outUv=uv;
 outVertexColor=color;
 ownPosition=frameConstants_.viewProjection*vec4f(position,1.0)*vec4f(1.0,-1.0,1.0,1.0);
}
@vertex
fn main(@location(0) position_in:vec3f,@location(1) normal_in:u32,@location(2) uv_in:vec2f,@location(3) color_in:vec4f) -> Drawn {
 position=position_in;
 normal=normal_in;
 uv=uv_in;
 color=color_in;
 run();
 return Drawn(ownPosition,outPosition,outNormal,outUv,outVertexColor);
}`,
  `fn valueNoiseSlope(p:vec3f) -> vec4f {
 let cell=floor(p);
 let f=p - cell;
 let s=f*f*(vec3f(3.0) - 2.0*f);
 let slope=6.0*f*(vec3f(1.0) - f);
 let near=latticePoint(i32(cell.x),i32(cell.y),i32(cell.z));
 let far=near+latticeZ;
 let h000=latticeHeight(near);
 let h010=latticeHeight(near+latticeY);
 let h001=latticeHeight(far);
 let h011=latticeHeight(far+latticeY);
 let d00=latticeHeight(near+latticeX) - h000;
 let d10=latticeHeight(near+latticeX+latticeY) - h010;
 let d01=latticeHeight(far+latticeX) - h001;
 let d11=latticeHeight(far+latticeX+latticeY) - h011;
 let h00=h000+s.x*d00;
 let h10=h010+s.x*d10;
 let h01=h001+s.x*d01;
 let h11=h011+s.x*d11;
 let h0=mix(h00,h10,s.y);
 let h1=mix(h01,h11,s.y);
 return latticeUnit*vec4f(slope.x*mix(mix(d00,d10,s.y),mix(d01,d11,s.y),s.z),slope.y*mix(h10 - h00,h11 - h01,s.z),slope.z*(h1 - h0),mix(h0,h1,s.z));
}`,
  "const noBladeSeed:u32=0xffffffffu;",
  `fn toneOf(grass:vec3f) -> f32 {
 return select(0.5,grass.z / grass.x,grass.x > 0.0);
}`,
  `fn swardShare(cover:Cover,leafArea:f32,thinned:f32) -> f32 {
 return cover.thatch*(undergrowthBelow(leafArea) - undergrowthBelow(leafArea / thinned));
}`,
  `fn swardBrightness(cosine:f32) -> f32 {
 return 0.6 - 0.1*cosine;
}`,
  `fn meadowShade(position:vec3f,tone:f32) -> vec3f {
 let meadow=meadowAt(position);
 let region=regionAt(position);
 let hue=0.45*(0.7*(tone - 0.5)+1.1*(meadow - 0.5)+1.2*(region - 0.5));
 let light=1.0+0.45*(0.6*(tone - 0.5)+0.5*(meadow - 0.5)+0.4*(region - 0.5));
 return light*shiftOf(hue);
}`,
  `struct GroundDetail {
 albedo:vec3f,
 brightness:f32,
 slope:vec3f,
}`,
  `fn shownAt(size:f32,pixel:f32) -> f32 {
 return clamp(0.35*size / pixel - 1.0,0.0,1.0);
}`,
  "const crumbSizes:u32=5u;",
  "const nextCrumb:f32=0.4;",
  "const meanCrumb:f32=0.3027;",
  "const noiseDeviation:f32=0.185;",
  `fn slantedLattice() -> mat3x3f {
 return mat3x3f(0.36,0.48,-0.8,-0.8,0.6,0.0,0.48,0.64,0.6);
}`,
  `fn addCrumbs(detail:ptr<function,GroundDetail>,position:vec3f,size_in:f32,pixel:f32,roughness:f32) {
 var size=size_in;
 let turn=slantedLattice();
 var amount=0.2*roughness;
 for (var i=0u; i < crumbSizes; i++) {
  let shown=shownAt(size,pixel);
  if (shown <= 0.0) {
   break;
  }
  let other=(i & 1u)!=0u;
  let place=position / size+0.4*(*detail).slope+17.0*f32(i);
  let noise=valueNoiseSlope(select(turn*place,place*turn,other));
  let rise=select(vec3f(noise.xyz)*turn,turn*vec3f(noise.xyz),other);
  let height=2.0*noise.w - 1.0;
  (*detail).brightness+=amount*shown*(abs(height) - meanCrumb);
  (*detail).slope+=amount*shown*select(1.0,-1.0,height < 0.0)*rise;
  size*=nextCrumb;
  amount=min(1.4*amount,0.38*roughness);
 }
}`,
  `fn byteOf(hash:u32,i:u32) -> f32 {
 return f32((hash >> (8u*i)) & 255u)*(1.0 / 256.0);
}`,
  "const stoneChance:f32=0.4;",
  "const smallestStone:f32=0.08;",
  "const largestStone:f32=0.33;",
  `fn stoneShare() -> f32 {
 let low=smallestStone*smallestStone;
 let high=largestStone*largestStone;
 let meanCube=(high*high - low*low) / (4.0*(largestStone - smallestStone));
 return stoneChance*4.18879*meanCube;
}`,
  `fn layStones(detail:ptr<function,GroundDetail>,mean:ptr<function,vec3f>,rock:vec3f,position:vec3f,edge:f32,pixel:f32,amount:f32) {
 let shown=amount*shownAt(0.4*edge,pixel);
 if (shown <= 0.0) {
  return;
 }
 (*mean)=mix((*mean),rock,shown*stoneShare());
 let turn=slantedLattice();
 let place=turn*(position / edge+0.1*(*detail).slope);
 let cell=floor(place);
 let hash=mixUint(latticePoint(i32(cell.x),i32(cell.y),i32(cell.z))+0x51ed270bu);
 if (f32(hash >> 8u)*(1.0 / 16777216.0) >= stoneChance) {
  return;
 }
 let more=mixUint(hash+0x9e3779b9u);
 let first=0.82+0.4*byteOf(hash,0u);
 let second=0.82+0.4*byteOf(more,0u);
 let radii=mix(smallestStone,largestStone,byteOf(mixUint(more),0u))*vec3f(first,1.0 / (first*second),second);
 let middle=vec3f(0.5)+(vec3f(1.0) - 2.0*radii)*(vec3f(byteOf(more,1u),byteOf(more,2u),byteOf(more,3u)) - vec3f(0.5));
 let out_=(place - cell - middle) / radii;
 let soft=max(pixel / (edge*radii.x),0.08);
 let seen=shown*clamp((1.0 - length(out_)) / soft+0.5,0.0,1.0);
 (*detail).albedo=mix((*detail).albedo,(0.5+byteOf(mixUint(more),1u))*rock,seen);
 (*detail).slope=mix((*detail).slope,0.4*(*detail).slope - 0.8*(out_*turn),seen);
 (*detail).brightness=mix((*detail).brightness,1.0,seen);
}`,
  "const strawChance:f32=0.4;",
  "const strawLength:f32=0.27;",
  "const strawWidth:f32=0.013;",
  "const strawLayers:u32=3u;",
  "const strawColor:vec3f=vec3f(0.21,0.165,0.095);",
  `fn lineSeen(distance_:f32,half_:f32,pixel:f32) -> f32 {
 return clamp((distance_+half_) / pixel+0.5,0.0,1.0) - clamp((distance_ - half_) / pixel+0.5,0.0,1.0);
}`,
  `fn layStraws(detail:ptr<function,GroundDetail>,mean:ptr<function,vec3f>,straw:vec3f,place_in:vec2f,edge:f32,pixel:f32,amount:f32) {
 var place=place_in;
 let shown=amount*shownAt(edge,pixel);
 if (shown <= 0.0) {
  return;
 }
 let width=max(pixel / edge,0.3*strawWidth);
 for (var layer=0u; layer < strawLayers; layer++) {
  (*mean)=mix((*mean),straw,shown*strawChance*4.0*strawLength*strawWidth);
  place=vec2f(0.8*place.x - 0.6*place.y,0.6*place.x+0.8*place.y)+vec2f(0.37,0.71);
  let cell=floor(place);
  let drift=floor(0.25*place);
  let many=mixUint(latticePoint(i32(drift.x),i32(drift.y),i32(layer)+7));
  let hash=mixUint(latticePoint(i32(cell.x),i32(cell.y),i32(layer)));
  if (f32(hash >> 8u)*(1.0 / 16777216.0) >= 2.0*strawChance*byteOf(many,1u)) {
   continue;
  }
  let more=mixUint(hash+0x9e3779b9u);
  let angle=6.2831853*byteOf(more,0u);
  let along=vec2f(cos(angle),sin(angle));
  let from_=place - cell - vec2f(0.5);
  let t=dot(from_,along);
  let beside=along.x*from_.y - along.y*from_.x+(1.6*byteOf(more,1u) - 0.8)*(t*t - 0.04);
  let length_=strawLength*(0.4+1.2*byteOf(more,2u));
  let seen=shown*lineSeen(beside,strawWidth,width)*lineSeen(t,length_,width);
  (*detail).albedo=mix((*detail).albedo,(0.35+1.3*byteOf(more,3u))*straw,seen);
 }
}`,
  "const damp:f32=7.0;",
  `fn turfIn(albedo:vec3f) -> f32 {
 return smoothstep(1.15,1.6,albedo.y / max(max(albedo.x,albedo.z),1e-4));
}`,
  `fn groundDetail(position:vec3f,normal:vec3f,up:vec3f,albedo:vec3f,size:f32,pixel:f32) -> GroundDetail {
 var detail:GroundDetail;
 detail.albedo=albedo;
 detail.brightness=1.0;
 detail.slope=vec3f(0.0);
 if (shownAt(damp*size,pixel) <= 0.0) {
  return detail;
 }
 let light=dot(albedo,vec3f(0.2126,0.7152,0.0722));
 let soil=1.0 - 0.75*smoothstep(0.15,0.4,light);
 let wide=damp*size;
 detail.brightness+=0.5*soil*shownAt(wide,pixel)*(valueNoise(position / wide) - 0.5);
 addCrumbs(&detail,position,size,pixel,soil);
 let lies=soil*(1.0 - turfIn(albedo))*smoothstep(0.64,0.85,dot(normal,up));
 var mean=albedo;
 let dark=min(16.0*light,1.0);
 let rock=mix(albedo,dark*vec3f(0.14,0.13,0.115),0.5);
 layStones(&detail,&mean,rock,position,0.16*size,pixel,lies);
 layStones(&detail,&mean,rock,position,0.55*size,pixel,lies);
 let steep=abs(normal);
 let place=select(select(vec2f(position.x,position.y),vec2f(position.y,position.z),steep.x >= steep.z),vec2f(position.x,position.z),steep.y >= max(steep.x,steep.z));
 layStraws(&detail,&mean,dark*strawColor,place / (0.5*size),0.5*size,pixel,lies);
 detail.albedo=max(detail.albedo+albedo - mean,vec3f(0.0));
 return detail;
}`,
  `fn raggedShare(mean:f32,position:vec3f,cell:f32,size:f32,pixel:f32) -> f32 {
 let amount=0.75*(1.0 - smoothstep(0.7,0.9,mean));
 if (mean <= 0.0||amount <= 0.0) {
  return mean;
 }
 var step_=max(0.5*cell,size);
 let whole=shownAt(step_,pixel);
 var weight=whole;
 var sum=0.0;
 var squares=0.0;
 for (var i=0u; i < 4u&&weight > 0.0; i++) {
  sum+=weight*(valueNoise(position / step_+31.0*f32(i)) - 0.5);
  squares+=weight*weight;
  step_=select(0.38*step_,0.6*size,i==0u);
  weight=shownAt(step_,pixel);
 }
 if (squares <= 0.0) {
  return mean;
 }
 let order=1.0 / (1.0+exp(-1.6*sum / (noiseDeviation*sqrt(squares))));
 let half_=min(0.06,0.5*min(mean,1.0 - mean));
 let covered=clamp(0.5*(mean - order) / max(half_,1e-6)+0.5,0.0,1.0);
 return mix(mean,covered,amount*whole);
}`,
  `struct GroundPoint {
 position:vec3f,
 normal:vec3f,
 albedo:vec3f,
 isDoubleSided:bool,
}`,
  `struct Relief {
 brightness:f32,
 slope:vec3f,
}`,
  `fn addNoise(relief:ptr<function,Relief>,position:vec3f,stretch:vec3f,size:f32,amount:f32) {
 let noise=valueNoiseSlope(position*stretch / size);
 (*relief).brightness+=amount*(noise.w - 0.5);
 (*relief).slope+=0.5*amount*(noise.xyz*stretch);
}`,
  `fn crumbs(position:vec3f,size_in:f32,pixel:f32) -> Relief {
 var size=size_in;
 var relief=Relief(1.0,vec3f(0.0));
 for (var octave=0u; octave < 4u; octave++) {
  let shown=shownAt(size,pixel);
  if (shown <= 0.0) {
   break;
  }
  addNoise(&relief,position+17.0*f32(octave)*size,vec3f(1.0),size,0.4*shown);
  size*=0.37;
 }
 return relief;
}`,
  `fn strands(position:vec3f,size:f32,pixel:f32) -> Relief {
 var relief=Relief(1.0,vec3f(0.0));
 let thin=0.12*size;
 let shown=shownAt(thin,pixel);
 if (shown > 0.0) {
  let turned=mat3x3f(0.36,0.48,-0.8,-0.8,0.6,0.0,0.48,0.64,0.6);
  var turnedRelief=Relief(1.0,vec3f(0.0));
  addNoise(&relief,position,vec3f(0.15,1.0,1.0),thin,0.45*shown);
  addNoise(&relief,position,vec3f(1.0,1.0,0.15),thin,0.45*shown);
  addNoise(&turnedRelief,turned*position,vec3f(0.15,1.0,1.0),thin,0.45*shown);
  relief.brightness+=turnedRelief.brightness - 1.0;
  relief.slope+=turnedRelief.slope*turned;
 }
 return relief;
}`,
  "const bareStructure:f32=0.32;",
  "const hiddenBelow:f32=0.93;",
  "const placeStep:f32=2.5e-7;",
  "const darkestCrumb:f32=0.85;",
  `fn groundPicture(point:GroundPoint) -> vec4f {
 let ray=frameConstants_.view.eye - point.position;
 let distance_=length(ray);
 let toEye=ray / max(distance_,1e-6);
 var n=normalize(point.normal);
 if (point.isDoubleSided&&dot(n,toEye) < 0.0) {
  n=-n;
 }
 let farthest=frameConstants_.cover.farthest;
 let grown=1.0 - smoothstep(0.8*farthest,farthest,distance_);
 let grass=grassAt(frameConstants_.cover,point.position);
 let blades=grass.x*grown;
 let leafArea=frameConstants_.cover.thinned*blades;
 let far=abs(point.position);
 let pixel=max(distance_ / frameConstants_.view.pixelsPerUnit,placeStep*max(far.x,max(far.y,far.z)));
 let size=select(bareStructure,frameConstants_.cover.structure,frameConstants_.cover.structure > 0.0);
 let closed=undergrowthBelow(leafArea);
 let ragged=mix(raggedShare(closed,point.position,1.0 / max(frameConstants_.cover.cellsPerMetre,1e-6),size,pixel),closed,turfIn(point.albedo));
 let under=frameConstants_.cover.thatch*ragged;
 var albedo=point.albedo;
 var shade=vec3f(1.0);
 var brightness=1.0 - under;
 var rough=vec3f(0.0);
 var crumbled=vec3f(0.0);
 if (under < hiddenBelow) {
  let detail=groundDetail(point.position,n,frameConstants_.skyUp,albedo,size,pixel);
  albedo=detail.albedo;
  brightness*=detail.brightness;
  crumbled=(1.0 - under)*(detail.slope - n*dot(n,detail.slope));
 }
 if (under > 0.0) {
  var relief=crumbs(point.position,size,pixel);
  let litter=strands(point.position,size,pixel);
  brightness+=under*max(relief.brightness*litter.brightness,0.2);
  rough=under*(relief.slope+litter.slope);
  shade=meadowShade(point.position,toneOf(grass));
  albedo=mix(albedo,shade*frameConstants_.cover.undergrowth,under);
 }
 n=normalize(n - (rough - n*dot(n,rough)));
 let even=max(dot(n,frameConstants_.sunDirection),0.0);
 let turned=dot(crumbled,frameConstants_.sunDirection) / max(even,0.3);
 let facing=even*(1.0 - clamp(turned,-darkestCrumb,darkestCrumb));
 var t1_:f32;
 if (even > 0.0) {
  t1_=sunSeen(frameConstants_.shadow,point.position,n);
 } else {
  t1_=0.0;
 }
 let seen=t1_;
 var below=sunBelow(leafProjectionOf(frameConstants_.cover),leafArea,even);
 let among=sunAmongBlades(frameConstants_.bladeShadow,point.position,noBladeSeed);
 below=mix(below,among.x,among.y);
 let light=hemisphere(normalize(n - crumbled))*skyBelow(leafArea)+lightAmongLeaves(leafArea,0.0,even,seen*frameConstants_.sunColor,1.25*frameConstants_.skyColor,1.5*frameConstants_.cover.sward)+frameConstants_.sunColor*(facing*seen*below);
 var color=brightness*albedo*light;
 var t2_:f32;
 if (closed > 0.0) {
  t2_=swardShare(frameConstants_.cover,leafArea,frameConstants_.cover.thinned*leavesPerDrawn(frameConstants_.view,distance_))*(ragged / closed);
 } else {
  t2_=0.0;
 }
 let sward=t2_;
 if (sward > 0.0) {
  let open=hemisphere(n)+frameConstants_.sunColor*(even*seen);
  color=mix(color,brightness*swardBrightness(max(dot(n,toEye),0.0))*shade*frameConstants_.cover.sward*open,sward);
 }
 if (debugMode()!=debugNothing) {
  color=select(vec3f(0.35)*(0.5+0.5*even),vec3f(0.0),showsBands());
 } else {
  color=throughAir(color,-toEye,distance_);
 }
 return vec4f(develop(color),1.0 - softness(distance_,min(blades,1.0)));
}`,
  "const maxProbes:f32=8.0;",
  `struct ImageProbes {
 first:vec2f,
 step_:vec2f,
 count:u32,
 lod:f32,
}`,
  `fn imageProbes(uv:vec2f,right:vec2f,down:vec2f,size:vec2f) -> ImageProbes {
 let across=length(right*size);
 let along=length(down*size);
 let longest=max(across,along);
 let ratio=select(1.0,longest / max(min(across,along),1e-6),longest > 1.0);
 let count=clamp(ceil(ratio),1.0,maxProbes);
 var probes:ImageProbes;
 probes.step_=select(down,right,across > along) / (count+1.0);
 probes.first=uv - 0.5*(count - 1.0)*probes.step_;
 probes.count=u32(count);
 probes.lod=log2(max(longest / count,1e-6));
 return probes;
}`,
  `struct Material {
 @align(16) color:vec3f,
 isDoubleSided:u32,
}`,
  "@group(1) @binding(0) var<uniform> material_:Material;",
  `@group(1) @binding(1) var baseColor_:texture_2d<f32>;
@group(1) @binding(2) var baseColor_sampler:sampler;`,
  "var<private> outColor:vec4f;",
  `var<private> ownFragCoord:vec4f;
struct Drawn {
 @location(0) outColor:vec4f,
}
fn run() {
 let right=dpdx(outUv);
 let down=dpdy(outUv);
 let first=sampleIndex(vec2u(ownFragCoord.xy),0u);
 var isSeen=false;
 for (var s=0u; s < samplesPerPixel; s++) {
  isSeen=isSeen||seenSamples_[first+s].x < push_.firstBlade;
 }
 outColor=vec4f(0.0);
 if (!isSeen) {
  return;
 }
 let probes=imageProbes(outUv,right,down,vec2f(vec2i(textureDimensions(baseColor_))));
 var texel=vec3f(0.0);
 for (var i=0u; i < probes.count; i++) {
  texel+=textureSampleLevel(baseColor_,baseColor_sampler,probes.first+f32(i)*probes.step_,probes.lod).rgb;
 }
 var point:GroundPoint;
 point.position=outPosition;
 point.normal=outNormal;
 point.albedo=material_.color*(texel / f32(probes.count))*outVertexColor.rgb;
 point.isDoubleSided=material_.isDoubleSided!=0u;
 outColor=groundPicture(point);
}
@fragment
fn main(@builtin(position) FragCoord_:vec4f,@location(0) outPosition_in:vec3f,@location(1) outNormal_in:vec3f,@location(2) outUv_in:vec2f,@location(3) outVertexColor_in:vec4f) -> Drawn {
 ownFragCoord=FragCoord_;
 outPosition=outPosition_in;
 outNormal=outNormal_in;
 outUv=outUv_in;
 outVertexColor=outVertexColor_in;
 run();
 return Drawn(outColor);
}`,
  `var<private> ownPosition:vec4f;
struct Drawn {
 @builtin(position) @invariant at:vec4f,
}
fn run() {
 let place=vec4f(position,1.0);
 let pixel=vec2f(dot(frameConstants_.shadow.across,place),dot(frameConstants_.shadow.down,place));
 let clip=pixel*(2.0 / f32(frameConstants_.shadow.size)) - 1.0;
 ownPosition=vec4f(clip.x,-clip.y,dot(frameConstants_.shadow.depth,place),1.0);
}
@vertex
fn main(@location(0) position_in:vec3f) -> Drawn {
 position=position_in;
 run();
 return Drawn(ownPosition);
}`,
  `var<private> ownPosition:vec4f;
var<private> ownVertexIndex:u32;
struct Drawn {
 @builtin(position) @invariant at:vec4f,
}
fn run() {
 ownPosition=vec4f(select(-1.0,3.0,ownVertexIndex==1u),select(-1.0,3.0,ownVertexIndex==2u),0.0,1.0);
}
@vertex
fn main(@builtin(vertex_index) VertexIndex_:u32) -> Drawn {
 ownVertexIndex=VertexIndex_;
 run();
 return Drawn(ownPosition);
}`,
  "@group(0) @binding(0) var resolvedPicture_:texture_2d<f32>;",
  `fn pixelAt(pixel:vec2i) -> vec4f {
 return textureLoad(resolvedPicture_,clamp(pixel,vec2i(0),vec2i(textureDimensions(resolvedPicture_)) - 1),0);
}`,
  "const softSide:f32=1.0 / 6.0;",
  `fn splineAt(offset:i32) -> f32 {
 return select(softSide,1.0 - 2.0*softSide,offset==0);
}`,
  `fn reconstructed(pixel:vec2i) -> vec3f {
 let here=pixelAt(pixel);
 let soft=1.0 - here.a;
 var sum=here.rgb;
 if (soft <= 0.0) {
  return sum;
 }
 for (var y=-1; y <= 1; y++) {
  for (var x=-1; x <= 1; x++) {
   let there=pixelAt(pixel+vec2i(x,y));
   sum+=splineAt(x)*splineAt(y)*min(soft,1.0 - there.a)*(there.rgb - here.rgb);
  }
 }
 return sum;
}`,
  `var<private> ownFragCoord:vec4f;
struct Drawn {
 @location(0) outColor:vec4f,
}
fn run() {
 var color=clamp(reconstructed(vec2i(ownFragCoord.xy)),vec3f(0.0),vec3f(1.0));
 color=select(12.92*color,1.055*pow(color,vec3f(1.0 / 2.4)) - 0.055,color > vec3f(0.0031308));
 outColor=vec4f(color,1.0);
}
@fragment
fn main(@builtin(position) FragCoord_:vec4f) -> Drawn {
 ownFragCoord=FragCoord_;
 run();
 return Drawn(outColor);
}`
], stages = {
  walk: { head: "", pieces: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 69], resources: { frameConstants: 0, push: 2, patches: 5, visiblePatches: 10, counters: 12, widest: 14, present: 15, cellBits: 19 } },
  arguments: { head: "", pieces: [39, 40, 41, 70, 71, 45, 72, 73, 74, 75, 76, 46, 77, 78, 79, 80], resources: { push: 2, counters: 12, arguments: 13 } },
  update: { head: "", pieces: [81, 82, 83, 84, 85, 86, 87, 88, 89, 0, 90, 91, 92, 93, 94, 95, 96, 1, 97, 98, 99, 100, 101, 102, 103, 104, 105, 106, 107, 2, 3, 4, 108, 109, 110, 111, 112, 113, 114, 6, 8, 115, 116, 10, 117, 118, 11, 12, 119, 13, 14, 15, 120, 16, 17, 18, 121, 122, 123, 124, 125, 126, 127, 128, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 129, 130, 31, 32, 131, 132, 133, 134, 135, 136, 137, 138, 139, 140, 141, 142, 33, 34, 143, 144, 145, 146, 147, 148, 149, 150, 151, 152, 153, 35, 36, 154, 155, 156, 157, 158, 159, 37, 38, 160, 161, 39, 40, 41, 162, 163, 42, 164, 165, 44, 45, 72, 166, 46, 167, 168, 47, 49, 169, 170, 171, 172, 173, 174, 50, 51, 52, 53, 54, 55, 56, 57, 58, 175, 176, 177, 178, 179, 180, 181, 182, 183, 184, 185, 186, 187, 188, 189, 190, 191, 192, 193, 194, 195, 196, 197, 198, 199, 200, 201, 202, 203, 204, 205, 206, 207, 208, 209, 210, 62, 63, 64, 211, 212, 213, 214, 215, 216], resources: { frameConstants: 0, looks: 1, push: 2, blades: 3, states: 4, patches: 5, visiblePatches: 10, visible: 11, counters: 12, patchTimes: 16, cellBits: 19 } },
  raster: { head: "", pieces: [81, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 2, 3, 8, 218, 19, 20, 21, 22, 23, 24, 25, 26, 131, 132, 133, 135, 136, 138, 139, 140, 142, 219, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 231, 232, 233, 234, 33, 235, 236, 237, 238, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 36, 157, 158, 241, 242, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 244, 44, 72, 245, 73, 46, 167, 168, 246, 247, 248, 249, 250, 251, 252, 253, 254, 255, 49, 256, 169, 170, 171, 172, 175, 181, 257, 258, 259, 260, 261, 262, 263, 264, 265, 266, 267, 268, 269, 270, 271, 272, 273, 274, 275, 276, 277, 278, 279, 280, 281, 282, 283, 284, 285, 286, 287, 288, 289, 290, 291, 292, 293, 294, 295, 296, 297, 298, 299, 300, 301, 302, 303, 304, 305, 306, 307, 308, 309, 77, 310, 311, 312, 313, 314, 315, 316, 317, 318, 319, 320, 321], resources: { frameConstants: 0, looks: 1, push: 2, blades: 3, states: 4, patches: 5, seenSamples: 9, visible: 11, counters: 12, quads: 17, rowBlocks: 18 } },
  rasterQuads: { head: "", pieces: [39, 40, 41, 70, 73, 46, 249, 266, 267, 268, 269, 274, 275, 169, 170, 276, 277, 322, 323, 288, 293, 324, 325, 306, 326, 327, 328, 329, 330, 308, 309, 77, 310, 311, 78, 331, 332, 333], resources: { push: 2, seenSamples: 9, counters: 12, quads: 17, rowBlocks: 18 } },
  shadow: { head: "", pieces: [81, 0, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 2, 3, 4, 8, 115, 10, 118, 11, 12, 119, 13, 14, 15, 120, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 131, 132, 133, 134, 135, 136, 138, 139, 140, 142, 219, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 231, 232, 233, 234, 33, 235, 236, 237, 238, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 36, 157, 158, 159, 241, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 164, 334, 74, 46, 167, 168, 47, 246, 247, 249, 335, 250, 251, 252, 253, 254, 255, 169, 170, 50, 51, 52, 53, 54, 55, 56, 57, 58, 175, 176, 177, 178, 181, 257, 258, 259, 260, 261, 336, 337, 269, 272, 273, 274, 275, 276, 277, 279, 280, 281, 282, 283, 286, 287, 288, 289, 290, 291, 292, 293, 295, 296, 297, 302, 303, 304, 305, 306, 338, 339, 340], resources: { frameConstants: 0, looks: 1, push: 2, blades: 3, states: 4, patches: 5, seenSamples: 9, visiblePatches: 10, arguments: 13 } },
  raster64: { head: `enable atomic_vec2u_min_max;
`, pieces: [81, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 2, 3, 8, 218, 19, 20, 21, 22, 23, 24, 25, 26, 131, 132, 133, 135, 136, 138, 139, 140, 142, 219, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 231, 232, 233, 234, 33, 235, 236, 237, 238, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 36, 157, 158, 241, 242, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 244, 44, 72, 245, 73, 46, 167, 168, 246, 247, 248, 249, 250, 251, 252, 253, 254, 255, 49, 256, 169, 170, 171, 172, 175, 181, 257, 258, 259, 260, 261, 262, 263, 264, 265, 266, 267, 268, 269, 270, 271, 272, 273, 274, 275, 341, 342, 278, 279, 280, 281, 282, 283, 284, 285, 286, 287, 288, 289, 290, 291, 292, 293, 294, 295, 296, 297, 298, 299, 300, 301, 302, 303, 304, 305, 306, 307, 308, 309, 77, 310, 311, 312, 313, 314, 315, 316, 317, 318, 319, 320, 321], resources: { frameConstants: 0, looks: 1, push: 2, blades: 3, states: 4, patches: 5, seenSamples: 9, visible: 11, counters: 12, quads: 17, rowBlocks: 18 } },
  rasterQuads64: { head: `enable atomic_vec2u_min_max;
`, pieces: [39, 40, 41, 70, 73, 46, 249, 266, 267, 268, 269, 274, 275, 169, 170, 341, 342, 343, 323, 288, 293, 324, 325, 306, 326, 327, 328, 329, 330, 308, 309, 77, 310, 311, 78, 331, 332, 333], resources: { push: 2, seenSamples: 9, counters: 12, quads: 17, rowBlocks: 18 } },
  shadow64: { head: `enable atomic_vec2u_min_max;
`, pieces: [81, 0, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 2, 3, 4, 8, 115, 10, 118, 11, 12, 119, 13, 14, 15, 120, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 131, 132, 133, 134, 135, 136, 138, 139, 140, 142, 219, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 231, 232, 233, 234, 33, 235, 236, 237, 238, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 36, 157, 158, 159, 241, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 164, 334, 74, 46, 167, 168, 47, 246, 247, 249, 335, 250, 251, 252, 253, 254, 255, 169, 170, 50, 51, 52, 53, 54, 55, 56, 57, 58, 175, 176, 177, 178, 181, 257, 258, 259, 260, 261, 336, 337, 269, 272, 273, 274, 275, 341, 342, 279, 280, 281, 282, 283, 286, 287, 288, 289, 290, 291, 292, 293, 295, 296, 297, 302, 303, 304, 305, 306, 338, 339, 340], resources: { frameConstants: 0, looks: 1, push: 2, blades: 3, states: 4, patches: 5, seenSamples: 9, visiblePatches: 10, arguments: 13 } },
  seed: { head: "", pieces: [27, 28, 39, 40, 41, 249, 266, 274, 275, 344, 345, 346, 347, 348, 349, 350, 351], resources: { push: 2, seenSamples: 9, cellBits: 19, groundDepth: 20 } },
  resolve: { head: "", pieces: [81, 82, 83, 84, 85, 86, 87, 88, 89, 0, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 352, 353, 2, 354, 355, 3, 356, 357, 358, 359, 360, 361, 362, 363, 364, 365, 366, 4, 367, 368, 369, 370, 371, 108, 372, 109, 110, 111, 373, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 374, 375, 131, 132, 133, 135, 136, 138, 139, 140, 142, 219, 376, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 377, 231, 232, 233, 234, 235, 236, 237, 238, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 378, 379, 36, 157, 158, 241, 242, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 380, 381, 382, 244, 167, 168, 383, 384, 385, 249, 266, 267, 268, 270, 271, 272, 273, 274, 275, 386, 387, 388, 389, 390, 391, 392, 393, 394, 395, 396, 397, 398, 399, 400, 401, 402, 403, 404, 405, 406, 407, 408, 409, 410, 411, 412, 413, 414, 415, 416, 417, 418, 419, 420, 421, 422, 423, 424, 425, 426, 427, 428, 429, 430, 431, 432, 433, 434, 435, 436, 437, 438, 439, 440, 441, 442, 443, 444, 445, 446, 447, 448, 449, 450, 451, 452, 453, 454, 455, 456, 457, 458, 459, 460, 246, 247, 248, 250, 251, 252, 253, 254, 255, 50, 51, 53, 54, 55, 56, 57, 58, 175, 181, 257, 258, 259, 260, 261, 262, 263, 264, 265, 461, 462, 463, 464, 465, 279, 280, 281, 282, 283, 285, 286, 287, 466, 467, 468, 469, 470, 471, 472, 473, 474, 475, 476, 477, 478, 479, 480, 481, 482, 483, 484, 485, 486, 487, 488, 489, 490, 491, 492, 493, 494, 495, 496, 497, 498, 499, 500, 501, 502, 503, 504, 505, 506, 507, 508, 509, 510, 511, 512, 513], resources: { frameConstants: 0, looks: 1, push: 2, blades: 3, states: 4, patches: 5, grass: 6, map: 7, sunMap: 8, seenSamples: 9, visible: 11, groundLight: 21, resolved: 22 } },
  records: { head: "", pieces: [81, 90, 91, 92, 94, 95, 96, 1, 97, 98, 99, 217, 100, 101, 102, 103, 104, 105, 107, 2, 3, 19, 20, 21, 22, 23, 24, 25, 26, 131, 132, 133, 135, 136, 138, 139, 140, 142, 219, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 231, 232, 233, 234, 235, 236, 239, 34, 240, 143, 144, 146, 147, 148, 149, 150, 151, 152, 35, 36, 157, 158, 241, 242, 37, 38, 160, 161, 39, 40, 41, 162, 243, 42, 244, 70, 72, 46, 167, 168, 246, 247, 248, 250, 252, 175, 181, 257, 258, 259, 260, 261, 262, 263, 264, 265, 514, 515], resources: { frameConstants: 0, looks: 1, push: 2, blades: 3, states: 4, patches: 5, visible: 11, counters: 12, records: 23 } },
  groundVertex: { head: "", pieces: [2, 3, 19, 20, 21, 22, 23, 24, 25, 26, 34, 35, 36, 37, 38, 516, 517, 518, 519, 520, 521, 522, 523, 524, 525], resources: { frameConstants: 0 } },
  groundFragment: { head: "", pieces: [81, 82, 83, 84, 85, 86, 87, 88, 89, 526, 352, 353, 2, 527, 354, 3, 356, 357, 358, 359, 528, 362, 363, 529, 530, 367, 368, 369, 370, 371, 11, 12, 19, 20, 21, 22, 23, 24, 25, 26, 34, 35, 378, 379, 36, 37, 38, 39, 40, 41, 380, 381, 382, 384, 385, 249, 266, 274, 275, 387, 395, 396, 397, 531, 400, 401, 402, 403, 404, 405, 406, 408, 409, 410, 411, 412, 413, 414, 532, 533, 534, 535, 536, 537, 538, 539, 540, 541, 542, 543, 544, 545, 546, 547, 548, 549, 550, 551, 552, 553, 554, 555, 556, 50, 51, 557, 558, 559, 560, 561, 562, 563, 564, 565, 566, 567, 568, 569, 498, 570, 571, 572, 521, 522, 523, 524, 573, 574], resources: { frameConstants: 0, push: 2, grass: 6, map: 7, sunMap: 8, seenSamples: 9 } },
  sunVertex: { head: "", pieces: [2, 3, 19, 20, 21, 22, 23, 24, 25, 26, 34, 35, 36, 37, 38, 517, 575], resources: { frameConstants: 0 } },
  filmVertex: { head: "", pieces: [576], resources: {} },
  filmFragment: { head: "", pieces: [577, 573, 578, 579, 580, 581, 582], resources: { resolvedPicture: 0 } }
}, places = {
  Push: { size: 176, members: { "pyramid.size": 0, "pyramid.first[0]": 16, "pyramid.first[1]": 32, "pyramid.first[2]": 48, "pyramid.first[3]": 64, "pyramid.first[4]": 80, "pyramid.first[5]": 96, "pyramid.first[6]": 112, "pyramid.levels": 128, size: 144, patchCount: 152, tick: 156, isIdPass: 160, firstBlade: 164, capacity: 168 } },
  Material: { size: 16, members: { color: 0, isDoubleSided: 12 } },
  Patch: { size: 112, members: { boundsLow: 0, firstBlade: 12, boundsHigh: 16, bladeCount: 28, rootLow: 32, rootStep: 44, coneAxis: 48, coneCosine: 60, heightLow: 64, heightStep: 68, widthLow: 72, widthStep: 76, parent: 80, firstChild: 84, childCount: 88, level: 92, rankLow: 96, rankHigh: 100 } }
};

// src/render/webgpu/memory.ts
var maxVisible = 1 << 22, maxQuads = 1 << 18, maxRowBlocks = 1 << 20, counterWords = 8, argumentWords = 12;
function makeBuffer(device, label, size2, usage) {
  let most = Math.min(device.limits.maxBufferSize, device.limits.maxStorageBufferBindingSize);
  return size2 > most && fail("unsupported", `this device has room for ${most} bytes of ${label}, not for ${size2}`), device.createBuffer({ label, size: Math.max(Math.ceil(size2 / 16) * 16, 16), usage });
}
function filledBuffer(device, label, data, usage) {
  let buffer2 = makeBuffer(device, label, data.byteLength, usage | GPUBufferUsage.COPY_DST), whole = data.byteLength - data.byteLength % 4;
  return device.queue.writeBuffer(buffer2, 0, data.buffer, data.byteOffset, whole), buffer2;
}
var FieldMemory = class {
  constructor(device, field, scene) {
    this.device = device;
    this.field = field;
    let { STORAGE, COPY_DST, COPY_SRC, UNIFORM, INDIRECT, VERTEX, INDEX } = GPUBufferUsage, blades = Math.max(field.bladeCount, 1), make2 = (label, size2, usage = 0) => makeBuffer(device, label, size2, STORAGE | COPY_DST | usage);
    this.capacity = Math.min(blades, maxVisible), this.uploaded = new Uint8Array(field.pageCount), this.present = new Uint32Array(Math.ceil(Math.max(field.pageCount, 1) / 32));
    let corners = scene.cover.corners;
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
    }, this.sunMap = device.createTexture({
      label: "sun map",
      size: [sunMapSize, sunMapSize],
      format: "depth32float",
      usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.TEXTURE_BINDING
    }), this.vertices = filledBuffer(device, "ground", field.ground.vertices, VERTEX), this.indices = filledBuffer(device, "triangles", field.ground.indices, INDEX), this.parts = this.groundParts();
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
    let { device, field } = this, white = imageTexture2(device, { width: 1, height: 1, pixels: new Uint8Array([255, 255, 255, 255]) }), images = field.ground.images.map((image) => imageTexture2(device, image));
    return field.ground.ranges.filter((range) => range.level === 0 && range.indexCount > 0).map((range) => {
      let material = field.ground.materials[range.material], bytes = new ArrayBuffer(places.Material.size);
      return new Float32Array(bytes).set(material.baseColor.slice(0, 3), places.Material.members.color / 4), new Uint32Array(bytes)[places.Material.members.isDoubleSided / 4] = material.isDoubleSided ? 1 : 0, {
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
    let { device, field } = this;
    if (field.presentPages === 0) return;
    let bytes = 4 * pageBlades * bladeWords, hasChanged = !1;
    for (let page = 0; page < field.pageCount; ++page) {
      if (this.uploaded[page] || !field.has(page * pageBlades, 1)) continue;
      let end = page + 1;
      for (; end < field.pageCount && !this.uploaded[end] && field.has(end * pageBlades, 1); ) ++end;
      let words = field.packed.subarray(page * bytes / 4, end * bytes / 4);
      device.queue.writeBuffer(this.buffers.blades, page * bytes, words.buffer, words.byteOffset, words.byteLength), this.uploaded.fill(1, page, end);
      for (let p = page; p < end; ++p) this.present[p >> 5] |= 1 << (p & 31);
      hasChanged = !0;
    }
    hasChanged && device.queue.writeBuffer(this.buffers.present, 0, this.present);
  }
  destroy() {
    for (let one of Object.values(this.buffers)) one.destroy();
    for (let one of [this.sunMap, this.vertices, this.indices]) one.destroy();
    for (let part of this.parts)
      part.material.destroy(), part.image.destroy();
  }
};
function statesOf(device, blades) {
  let { STORAGE, COPY_DST } = GPUBufferUsage, buffer2 = makeBuffer(device, "states", 4 * blades, STORAGE | COPY_DST), step = 1 << 20, words = new Uint32Array(Math.min(step, blades)).fill(unsettledTurn);
  for (let first = 0; first < blades; first += step)
    device.queue.writeBuffer(buffer2, 4 * first, words, 0, Math.min(step, blades - first));
  return buffer2;
}
function patchTable2(field) {
  let stride = places.Patch.size / 4, table = new Uint32Array(Math.max(field.patches.count, 1) * stride);
  for (let p = 0; p < field.patches.count; ++p)
    table.set(field.patches.words.subarray(p * patchWords, (p + 1) * patchWords), p * stride);
  return table;
}
var toLinear = Float32Array.from(
  { length: 256 },
  (_, i) => i / 255 <= 0.04045 ? i / 255 / 12.92 : ((i / 255 + 0.055) / 1.055) ** 2.4
), steps = 4095, toBytes = Uint8Array.from({ length: steps + 1 }, (_, i) => {
  let x = i / steps;
  return Math.round(255 * (x <= 31308e-7 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
});
function halved({ width, height, pixels }) {
  let [w, h] = [Math.max(width >> 1, 1), Math.max(height >> 1, 1)], half = new Uint8Array(4 * w * h);
  for (let y = 0; y < h; ++y) {
    let [above, below] = [2 * y, Math.min(2 * y + 1, height - 1)].map((row) => row * width);
    for (let x = 0; x < w; ++x) {
      let [left, right] = [2 * x, Math.min(2 * x + 1, width - 1)], four = [above + left, above + right, below + left, below + right];
      for (let c = 0; c < 4; ++c) {
        let sum = 0;
        for (let texel of four) sum += c < 3 ? toLinear[pixels[4 * texel + c]] : pixels[4 * texel + c];
        half[4 * (y * w + x) + c] = c < 3 ? toBytes[Math.round(0.25 * sum * steps)] : Math.round(0.25 * sum);
      }
    }
  }
  return { width: w, height: h, pixels: half };
}
function imageTexture2(device, image) {
  let most = device.limits.maxTextureDimension2D, level = image;
  for (; level.width > most || level.height > most; ) level = halved(level);
  let count = Math.floor(Math.log2(Math.max(level.width, level.height))) + 1, texture = device.createTexture({
    label: "image of the ground",
    size: [level.width, level.height],
    mipLevelCount: count,
    format: "rgba8unorm-srgb",
    usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST
  });
  for (let i = 0; i < count; ++i) {
    let pixels = new Uint8Array(level.pixels), size2 = [level.width, level.height];
    device.queue.writeTexture({ texture, mipLevel: i }, pixels, { bytesPerRow: 4 * level.width }, size2), level = halved(level);
  }
  return texture;
}

// src/render/webgpu/stages.ts
var textOf = (name) => stages[name].head + stages[name].pieces.map((i) => pieces2[i]).join(`
`), bindingsOf = (name) => stages[name].resources;
function ownOverrides(text2, overrides) {
  return Object.fromEntries(Object.entries(overrides).filter(([name]) => text2.includes(`override ${name} `)));
}
async function computeStage(device, name, overrides) {
  let code = textOf(name), module = device.createShaderModule({ label: name, code });
  return { pipeline: await device.createComputePipelineAsync({
    label: name,
    layout: "auto",
    compute: { module, entryPoint: "main", constants: ownOverrides(code, overrides) }
  }), bindings: bindingsOf(name) };
}
async function drawingStage(device, vertex, fragment, state) {
  let { vertex: buffers, targets, ...rest2 } = state, module = (name) => device.createShaderModule({ label: name, code: textOf(name) });
  return { pipeline: await device.createRenderPipelineAsync({
    label: fragment ?? vertex,
    layout: "auto",
    vertex: { module: module(vertex), entryPoint: "main", buffers: buffers ?? [] },
    ...fragment ? { fragment: { module: module(fragment), entryPoint: "main", targets: targets ?? [] } } : {},
    ...rest2
  }), bindings: { ...bindingsOf(vertex), ...fragment ? bindingsOf(fragment) : {} } };
}

// src/render/webgpu/passes.ts
var ticksPerSecond = 262144, samples = 4, pushBytes = places.Push.size, argumentsPatches = 0, argumentsBlades = 16, argumentsRows = 32, firstBlade = 1;
function pyramidLevels(width, height) {
  let levels = [], first = 0;
  for (let bits = 2; levels.length < 7; bits += 2) {
    let [x, y] = [width, height].map((pixels) => Math.max(Math.ceil(pixels / 2 ** bits), 1));
    if (levels.push({ first, cells: x * y }), first += x * y, x === 1 && y === 1) break;
  }
  return levels;
}
var nearestBits = 1065353216, Picture2 = class {
  constructor(device, width, height) {
    this.device = device;
    this.width = width;
    this.height = height;
    let { RENDER_ATTACHMENT, TEXTURE_BINDING, STORAGE_BINDING } = GPUTextureUsage, make2 = (label, format, sampleCount, usage) => device.createTexture({ label, size: [width, height], format, sampleCount, usage });
    this.visibility = makeBuffer(device, "visibility", 8 * samples * width * (4 * Math.ceil(height / 4)), GPUBufferUsage.STORAGE), this.levels = pyramidLevels(width, height);
    let last = this.levels[this.levels.length - 1];
    this.nearest = new Uint32Array(last.first + last.cells).fill(nearestBits), this.cells = makeBuffer(device, "pyramid", this.nearest.byteLength, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST), this.depth = make2("depth", "depth32float", samples, RENDER_ATTACHMENT | TEXTURE_BINDING), this.light = make2("light of the ground", "rgba16float", samples, RENDER_ATTACHMENT | TEXTURE_BINDING), this.resolved = make2("picture", "rgba16float", 1, STORAGE_BINDING | TEXTURE_BINDING);
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
    for (let one of [this.cells, this.depth, this.light, this.resolved, this.visibility]) one.destroy();
  }
}, computeNames = ["walk", "arguments", "update", "seed", "resolve", "records"], rasterNames = ["raster", "rasterQuads", "shadow"], Pipelines = class _Pipelines {
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
    let overrides = overridesOf(field), stage2 = (name) => computeStage(device, name, overrides), position = { shaderLocation: 0, offset: 0, format: "float32x3" }, layout = (attributes) => [{ arrayStride: groundVertexBytes, attributes }], all = layout([
      position,
      { shaderLocation: 1, offset: 12, format: "uint32" },
      { shaderLocation: 2, offset: 16, format: "float32x2" },
      { shaderLocation: 3, offset: 24, format: "unorm8x4" }
    ]), depthOf = (depthCompare, depthWriteEnabled) => ({
      format: "depth32float",
      depthCompare,
      depthWriteEnabled
    }), sides = ["back", "none"], [plain, raster, groundDepth, ground, sun, film] = await Promise.all([
      Promise.all(computeNames.map(stage2)),
      rasterStages(device, stage2),
      Promise.all(
        sides.map(
          (cullMode) => drawingStage(device, "groundVertex", null, {
            vertex: all,
            primitive: { cullMode },
            multisample: { count: samples },
            depthStencil: depthOf("greater", !0)
          })
        )
      ),
      Promise.all(
        sides.map(
          (cullMode) => drawingStage(device, "groundVertex", "groundFragment", {
            vertex: all,
            primitive: { cullMode },
            multisample: { count: samples },
            depthStencil: depthOf("equal", !1),
            targets: [{ format: "rgba16float" }]
          })
        )
      ),
      drawingStage(device, "sunVertex", null, { vertex: layout([position]), depthStencil: depthOf("greater", !0) }),
      drawingStage(device, "filmVertex", "filmFragment", { targets: [{ format }] })
    ]), compute = Object.fromEntries([
      ...computeNames.map((name, i) => [name, plain[i]]),
      ...rasterNames.map((name, i) => [name, raster.stages[i]])
    ]);
    return new _Pipelines(compute, raster.has64, groundDepth, ground, sun, film);
  }
};
async function rasterStages(device, stage2) {
  if (hasAtomic64(device))
    try {
      return { stages: await Promise.all(rasterNames.map((name) => stage2(`${name}64`))), has64: !0 };
    } catch {
    }
  return { stages: await Promise.all(rasterNames.map(stage2)), has64: !1 };
}
var Passes = class {
  constructor(device, field, scene, pipelines) {
    this.device = device;
    this.field = field;
    this.scene = scene;
    this.pipelines = pipelines;
    this.memory = new FieldMemory(device, field, scene);
    let uniform = (label, size2) => makeBuffer(device, label, size2, GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST);
    this.frames = { eye: uniform("frame", frameBytes), sun: uniform("frame of the sun", frameBytes) }, this.pushes = {
      eye: uniform("push", pushBytes),
      eyeIds: uniform("push", pushBytes),
      sun: uniform("push", pushBytes),
      sunIds: uniform("push", pushBytes)
    }, this.sampler = device.createSampler({
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
    this.picture?.destroy(), this.memory.destroy();
  }
  /** The bind group of a stage. `view`: whose frame and push it has; `ids`: that of the pass of ids. */
  group(stage2, view, ids = !1, target) {
    let key = `${stage2.pipeline.label} ${view} ${ids} ${target ?? ""}`, known = this.groups.get(key);
    if (known) return known;
    let picture = this.picture, { buffers, sunMap } = this.memory, textures = {
      sunMap,
      groundDepth: picture.depth,
      groundLight: picture.light,
      resolved: picture.resolved,
      resolvedPicture: picture.resolved
    }, resource = (name) => name === "frameConstants" ? { buffer: this.frames[view] } : name === "push" ? { buffer: this.pushes[ids ? `${view}Ids` : view] } : name === "seenSamples" ? { buffer: target === "map" ? buffers.map : picture.visibility } : name === "cellBits" ? { buffer: picture.cells } : textures[name]?.createView() ?? { buffer: buffers[name] }, made = this.device.createBindGroup({
      label: key,
      layout: stage2.pipeline.getBindGroupLayout(0),
      entries: Object.entries(stage2.bindings).map(([name, binding]) => ({ binding, resource: resource(name) }))
    });
    return this.groups.set(key, made), made;
  }
  /** Draws a frame into `target`. `time`: of the wind [s]. */
  draw(input, target, width, height, timing) {
    let { device, memory, pipelines } = this;
    (this.picture?.width !== width || this.picture.height !== height) && (this.picture?.destroy(), this.picture = new Picture2(device, width, height), this.groups.clear()), memory.uploadPages(), this.picture.beginPyramid(), this.writeFrames(input, width, height);
    let encoder = device.createCommandEncoder();
    this.drawSunMap(encoder, input);
    let { buffers } = memory, timed = timerOf(timing), compute = (name, act) => {
      let pass = encoder.beginComputePass({ label: name, timestampWrites: timed(name) });
      act(pass), pass.end();
    }, run = (pass, name, view, ids = !1, map) => {
      let stage2 = pipelines.compute[name];
      pass.setPipeline(stage2.pipeline), pass.setBindGroup(0, this.group(stage2, view, ids, map));
    }, walk = (pass, view) => {
      let groups = Math.ceil(this.field.patches.count / 64);
      groups !== 0 && (run(pass, "walk", view), pass.dispatchWorkgroups(Math.min(groups, 4096), Math.ceil(groups / 4096)), run(pass, "arguments", view), pass.dispatchWorkgroups(1));
    }, passesOfSamples = pipelines.has64 ? [!1] : [!1, !0];
    this.drawGround(encoder, "ground depth", !0, timed), encoder.clearBuffer(buffers.counters), compute("seed", (pass) => {
      run(pass, "seed", "eye"), pass.dispatchWorkgroups(Math.ceil(width / 16), Math.ceil(height / 16));
    }), compute("walk", (pass) => walk(pass, "eye")), compute("update", (pass) => {
      run(pass, "update", "eye"), pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsPatches), run(pass, "arguments", "eye"), pass.dispatchWorkgroups(1);
    });
    for (let ids of passesOfSamples)
      compute(ids ? "blades, ids" : "blades", (pass) => {
        run(pass, "raster", "eye", ids), pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsBlades), !ids && (run(pass, "arguments", "eye"), pass.dispatchWorkgroups(1));
      }), compute(ids ? "large, ids" : "large", (pass) => {
        run(pass, "rasterQuads", "eye", ids), pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsRows);
      });
    input.shadowDistance > 0 && input.light.sunColor[0] > 0 ? (encoder.clearBuffer(buffers.counters, 0, 4), encoder.clearBuffer(buffers.map), compute("shadow", (pass) => {
      walk(pass, "sun");
      for (let ids of passesOfSamples)
        run(pass, "shadow", "sun", ids, "map"), pass.dispatchWorkgroupsIndirect(buffers.arguments, argumentsPatches);
    })) : encoder.clearBuffer(buffers.map), this.drawGround(encoder, "ground light", !1, timed), compute("resolve", (pass) => {
      run(pass, "resolve", "eye"), pass.dispatchWorkgroups(Math.ceil(width / 8), Math.ceil(height / 8));
    });
    let film = encoder.beginRenderPass({
      label: "film",
      colorAttachments: [{ view: target, loadOp: "clear", storeOp: "store" }],
      timestampWrites: timed("film")
    });
    film.setPipeline(pipelines.film.pipeline), film.setBindGroup(0, this.group(pipelines.film, "eye")), film.draw(3), film.end();
    let read = this.staging.pop() ?? device.createBuffer({ label: "counts", size: 4 * counterWords, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    encoder.copyBufferToBuffer(buffers.counters, 0, read, 0, 4 * counterWords), device.queue.submit([encoder.finish()]), this.readCounts(read);
  }
  async readCounts(read) {
    try {
      await read.mapAsync(GPUMapMode.READ);
    } catch {
      return;
    }
    let [, blades, quads, rows, moved] = new Uint32Array(read.getMappedRange());
    this.counts = { blades, quads, rows, moved }, read.unmap(), this.staging.push(read);
  }
  writeFrames(input, width, height) {
    let { device, scene } = this, eye = frameBlock(scene, input), depthOfEye = [2, 6, 10, 14].reduce(
      (sum, at, i) => sum + input.view.viewProjection[at] * (i < 3 ? input.view.eye[i] : 1),
      0
    );
    eye.floats("depthOfEye", [depthOfEye]), device.queue.writeBuffer(this.frames.eye, 0, eye.bytes);
    let push = (buffer2, size2, isIdPass) => {
      let block = new Block(places.Push.members, pushBytes);
      if (block.words("size", size2), block.words("patchCount", [this.field.patches.count]), block.words("tick", [Math.round(input.time % 16384 * ticksPerSecond)]), block.words("isIdPass", [isIdPass ? 1 : 0]), block.words("firstBlade", [firstBlade]), block.words("capacity", [this.memory.capacity]), buffer2 === this.pushes.eye) {
        let { levels } = this.picture;
        block.words("pyramid.size", size2), block.words("pyramid.levels", [levels.length]), levels.forEach((level, i) => block.words(`pyramid.first[${i}]`, [level.first]));
      }
      device.queue.writeBuffer(buffer2, 0, block.bytes);
    };
    if (push(this.pushes.eye, [width, height], !1), push(this.pushes.eyeIds, [width, height], !0), !(input.shadowDistance > 0)) return;
    let rows = shadowRows(input.view, input.camera, input.light.sunDirection, input.shadowDistance), sun = frameBlock(scene, input);
    shadowPlanes(rows).forEach((plane, i) => sun.floats(`view.planes[${i}]`, plane)), sun.floats("view.minWidth", [0]), sun.words("view.cullMask", [cullDistance | cullFrustum | leaveThinned | 1]), sun.floats("viewProjection", [0, 1, 2, 3].flatMap((k) => [rows[0][k], rows[1][k], rows[2][k], k === 3 ? 1 : 0])), device.queue.writeBuffer(this.frames.sun, 0, sun.bytes), push(this.pushes.sun, [bladeShadowTexels, bladeShadowTexels], !1), push(this.pushes.sunIds, [bladeShadowTexels, bladeShadowTexels], !0);
  }
  /** The ground as the sun sees it, when the sun has moved. */
  drawSunMap(encoder, input) {
    let key = input.light.sunDirection.join();
    if (this.sunOf === key) return;
    this.sunOf = key;
    let { memory, pipelines } = this, pass = encoder.beginRenderPass({
      label: "sun map",
      colorAttachments: [],
      depthStencilAttachment: {
        view: memory.sunMap.createView(),
        depthClearValue: 0,
        depthLoadOp: "clear",
        depthStoreOp: "store"
      }
    });
    pass.setPipeline(pipelines.sun.pipeline), pass.setBindGroup(0, this.group(pipelines.sun, "eye")), pass.setVertexBuffer(0, memory.vertices), pass.setIndexBuffer(memory.indices, "uint32");
    for (let part of memory.parts) pass.drawIndexed(part.count, 1, part.first);
    pass.end();
  }
  /** Depths of the ground, or its light where samples show it. */
  drawGround(encoder, label, isDepth, timed) {
    let { memory, pipelines } = this, picture = this.picture, pass = encoder.beginRenderPass({
      label,
      colorAttachments: isDepth ? [] : [{ view: picture.light.createView(), clearValue: [0, 0, 0, 0], loadOp: "clear", storeOp: "store" }],
      depthStencilAttachment: isDepth ? { view: picture.depth.createView(), depthClearValue: 0, depthLoadOp: "clear", depthStoreOp: "store" } : { view: picture.depth.createView(), depthReadOnly: !0 },
      timestampWrites: timed(label)
    });
    pass.setVertexBuffer(0, memory.vertices), pass.setIndexBuffer(memory.indices, "uint32"), memory.parts.forEach((part, i) => {
      let stage2 = (isDepth ? pipelines.groundDepth : pipelines.ground)[part.isDoubleSided ? 1 : 0];
      pass.setPipeline(stage2.pipeline), pass.setBindGroup(0, this.group(stage2, "eye", !1, `${label} ${part.isDoubleSided}`)), isDepth || pass.setBindGroup(1, this.materialGroup(stage2, i)), pass.drawIndexed(part.count, 1, part.first);
    }), pass.end();
  }
  materialGroup(stage2, i) {
    let key = `material ${i}`, known = this.groups.get(key);
    if (known) return known;
    let part = this.memory.parts[i], made = this.device.createBindGroup({
      label: key,
      layout: stage2.pipeline.getBindGroupLayout(1),
      entries: [
        { binding: 0, resource: { buffer: part.material } },
        { binding: 1, resource: part.image.createView() },
        { binding: 2, resource: this.sampler }
      ]
    });
    return this.groups.set(key, made), made;
  }
  /** Curves of the blades that the last frame drew, for tests: 12 words each (web/shaders/webgpu/records.comp). */
  async readRecords() {
    let { device, memory, pipelines } = this, size2 = 48 * memory.capacity, { STORAGE, COPY_SRC, COPY_DST, MAP_READ } = GPUBufferUsage, records = makeBuffer(device, "records", size2, STORAGE | COPY_SRC);
    memory.buffers.records = records;
    let read = device.createBuffer({ size: records.size + 4 * counterWords, usage: MAP_READ | COPY_DST }), encoder = device.createCommandEncoder(), pass = encoder.beginComputePass();
    pass.setPipeline(pipelines.compute.records.pipeline), pass.setBindGroup(0, this.group(pipelines.compute.records, "eye")), pass.dispatchWorkgroups(Math.min(Math.ceil(memory.capacity / 64), 4096), Math.ceil(memory.capacity / 64 / 4096)), pass.end(), encoder.copyBufferToBuffer(records, 0, read, 0, records.size), encoder.copyBufferToBuffer(memory.buffers.counters, 0, read, records.size, 4 * counterWords), device.queue.submit([encoder.finish()]), await read.mapAsync(GPUMapMode.READ);
    let words = new Uint32Array(read.getMappedRange()).slice();
    return read.destroy(), records.destroy(), delete memory.buffers.records, this.groups.clear(), words.subarray(0, 12 * Math.min(words[records.size / 4 + 1], memory.capacity));
  }
};
function timerOf(timing) {
  return timing ? (timing.names.length = 0, (name) => {
    let at = 2 * timing.names.length;
    return timing.names.push(name), { querySet: timing.set, beginningOfPassWriteIndex: at, endOfPassWriteIndex: at + 1 };
  }) : () => {
  };
}

// src/render/webgpu/renderer.ts
var usualMax2 = 4e6, WebGpuRenderer = class _WebGpuRenderer {
  constructor(canvas, context, device, field, scene, passes) {
    this.canvas = canvas;
    this.context = context;
    this.device = device;
    this.field = field;
    this.passes = passes;
    this.scene = scene, this.tree = new PatchTree(field), device.lost.then(() => {
      this.wasLost = !0;
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
  wasLost = !1;
  isStopped = !1;
  /**
   * A renderer; undefined where there is no WebGPU. The canvas may have no other context. Without a canvas it draws
   * pictures for readPicture(). `acceptsSoftware`: also a device that is the processor.
   */
  static async make(canvas, field, cover = noCover, { device, acceptsSoftware = !1 } = {}) {
    let own = device ?? await openDevice({ acceptsSoftware });
    if (!own) return;
    let format = canvas ? navigator.gpu.getPreferredCanvasFormat() : "rgba8unorm", scene = sceneOf(field, cover);
    try {
      let pipelines = await Pipelines.make(own, field, format), passes = new Passes(own, field, scene, pipelines), context = canvas?.getContext("webgpu") ?? void 0;
      return canvas && !context ? void 0 : (context?.configure({ device: own, format, alphaMode: "opaque" }), new _WebGpuRenderer(canvas, context, own, field, scene, passes));
    } catch (error) {
      error instanceof SwardError || console.warn(error), device || own.destroy();
      return;
    }
  }
  /** The sun as the viewer has it by default. */
  get usualLight() {
    let up = unit(scaled(this.field.defaults.gravity.direction, -1));
    return { ...usualLight, sunDirection: turnedWith(up, usualLight.sunDirection) };
  }
  get isLost() {
    return this.wasLost;
  }
  /** Calls back when the device is lost, unless stop() ended it. */
  onLost(act) {
    this.device.lost.then(() => {
      this.isStopped || act();
    });
  }
  /** Frees all that lies on the device. */
  stop() {
    this.isStopped = !0, this.passes.destroy(), this.context?.unconfigure(), this.device.destroy();
  }
  /** Draws a picture as large as the canvas. `isFine` changes nothing: all pictures have four samples a pixel. */
  draw(input) {
    let { width, height } = this.canvas;
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
    let { field, scene, passes } = this, view = viewOf(input.camera, field.origin, width, height, scene.content);
    this.adapt(input.maxBlades ?? usualMax2);
    let frame = {
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
    return field.isComplete || (missing = this.tree.groupsOf(
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
      1 / 0
    ).missing), { blades: passes.counts.moved, missing };
  }
  /** Level of detail follows the number of blades that the frames before had. */
  adapt(most) {
    let { moved } = this.passes.counts, usual = frameSettings.lodThreshold, ratio = Math.sqrt(moved / most);
    ratio > 1.15 ? this.lodThreshold *= Math.min(ratio, 2) : ratio > 1 ? this.lodThreshold *= 1.02 : ratio < 0.9 && (this.lodThreshold = Math.max(this.lodThreshold / 1.05, usual));
  }
  /** Draws a picture and returns it: rows from the top, four bytes a pixel, sRGB. */
  async readPicture(input, width, height, timing) {
    let { device } = this, format = this.canvas ? navigator.gpu.getPreferredCanvasFormat() : "rgba8unorm", { RENDER_ATTACHMENT, COPY_SRC } = GPUTextureUsage, texture = device.createTexture({ size: [width, height], format, usage: RENDER_ATTACHMENT | COPY_SRC });
    this.drawInto(input, texture.createView(), width, height, timing);
    let bytesPerRow = 256 * Math.ceil(4 * width / 256), read = device.createBuffer({ size: bytesPerRow * height, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST }), encoder = device.createCommandEncoder();
    encoder.copyTextureToBuffer({ texture }, { buffer: read, bytesPerRow }, [width, height]), device.queue.submit([encoder.finish()]), await read.mapAsync(GPUMapMode.READ);
    let rows = new Uint8Array(read.getMappedRange()), pixels = new Uint8ClampedArray(4 * width * height);
    for (let y = 0; y < height; ++y) pixels.set(rows.subarray(y * bytesPerRow, y * bytesPerRow + 4 * width), 4 * width * y);
    if (format === "bgra8unorm")
      for (let i = 0; i < pixels.length; i += 4) [pixels[i], pixels[i + 2]] = [pixels[i + 2], pixels[i]];
    return read.destroy(), texture.destroy(), pixels;
  }
  /** Curves of the blades that the last picture drew, 12 words each; for tests. */
  readRecords() {
    return this.passes.readRecords();
  }
};

// src/render/choice.ts
var rendererKinds = '"webgpu" or "webgl"', isRendererKind = (kind) => kind === "webgpu" || kind === "webgl";
async function makeRenderer(canvas, field, cover, kind, sowing2) {
  if (expectOption("makeRenderer: kind", kind, rendererKinds, kind === void 0 || isRendererKind(kind)), sowing2 && kind === "webgpu" && fail("usage", `${field.name}: a field that is sown is drawn by WebGL; sow: false shows its stored blades by WebGPU`), kind !== "webgl" && !sowing2) {
    let own = await WebGpuRenderer.make(canvas, field, cover, { acceptsSoftware: kind === "webgpu" });
    if (own) return own;
    kind === "webgpu" && fail("unsupported", "this browser has no WebGPU for this field, or its graphics driver is blocked");
  }
  return new Renderer(canvas, field, cover, sowing2);
}

// src/sow/module.ts
var kinds = { 1: "usage", 2: "io", 3: "input", 4: "runtime", 5: "unsupported" }, unitWords = 8, eyeNumbers = 9;
function numbersOf(meadow, species, origin) {
  let flag2 = (value) => value ? 1 : 0, m = meadow, list = [
    ...m.seed,
    m.density,
    m.scale,
    m.clumpSpacing,
    m.stored,
    m.unitBits,
    m.levels,
    flag2(m.isMixed),
    m.heightWaves,
    m.drifts,
    m.sparseHeight,
    m.wideVariation,
    m.creaseReach,
    m.creaseBlend,
    m.vertical,
    flag2(m.isRadial),
    ...m.up,
    m.highest,
    m.widest,
    ...origin,
    m.species.length
  ];
  return m.species.forEach((one, i) => {
    list.push(one.share, ...one.height, ...one.width, ...one.stiffness, one.clumping, one.facing, one.ribbons);
    let organs = species[i].organs;
    list.push(organs.length);
    for (let organ of organs) list.push(organ.count, ...organ.length, organ.width, organ.variation);
  }), Float64Array.from(list);
}
var SowModule = class {
  exports;
  unit;
  eyes = 0;
  eyeCount = 0;
  /** `place` is for messages. */
  constructor(module, place) {
    let refuse = (kind, message, bytes) => {
      let text2 = new TextDecoder().decode(new Uint8Array(this.exports.memory.buffer, message, bytes));
      throw new SwardError(kinds[kind] ?? "runtime", `${place}: ${text2}`);
    };
    this.exports = new WebAssembly.Instance(module, { sward: { refuse } }).exports, this.exports._initialize(), this.unit = this.exports.take(4 * unitWords);
  }
  begin(numbers, entries) {
    let at = this.put(numbers), table = this.put(entries);
    this.exports.begin(at, table, entries.length / 48), this.exports.give(table), this.exports.give(at);
  }
  /** Opens a cell: `plain` is its frame without zstd. */
  openCell(index, plain) {
    let at = this.put(plain);
    this.exports.openCell(index, at, plain.length), this.exports.give(at);
  }
  closeCell(index) {
    this.exports.closeCell(index);
  }
  /** Grows a unit of an open cell. */
  grow(unit2) {
    this.writeUnit(unit2);
    let at = this.exports.grow(this.unit), { buffer: buffer2 } = this.exports.memory, [patches, patchCount, blades, bladeCount, keys, whole] = new Uint32Array(buffer2, at, 6), words = (from, count) => new Uint32Array(buffer2, from, count).slice();
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
    let numbers = eyes.flatMap((one) => [
      ...one.eye,
      one.drawDistance,
      one.pixelsPerUnit,
      one.lodThreshold,
      one.lodWidth,
      one.sparseFrom,
      one.sparseLeast
    ]);
    this.eyes !== 0 && this.exports.give(this.eyes), this.eyes = this.put(Float64Array.from(numbers)), this.eyeCount = numbers.length / eyeNumbers;
  }
  /** All that the eyes want, in falling order of scores. */
  find() {
    let count = this.exports.find(this.eyes, this.eyeCount), at = this.exports.found(), words = new Uint32Array(this.exports.memory.buffer, at, unitWords * count), floats = new Float32Array(this.exports.memory.buffer, at, unitWords * count);
    return Array.from({ length: count }, (_, i) => {
      let w = words.subarray(unitWords * i, unitWords * (i + 1));
      return { score: floats[unitWords * i], isCell: w[1] !== 0, cell: w[2], level: w[3], half: w[4], place: [w[5], w[6], w[7]] };
    });
  }
  /** Score of any unit. */
  score(unit2) {
    return this.writeUnit(unit2), this.exports.score(this.unit, this.eyes, this.eyeCount);
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
    let at = this.exports.take(Math.max(array.byteLength, 1));
    return new Uint8Array(this.exports.memory.buffer).set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), at), at;
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
var replacing = 1.19, unitsAtOnce = 16, cellsAtOnce = 4, maxOpenCells = 96, unitName = (unit2) => [unit2.cell, unit2.level, unit2.half, ...unit2.place].join(), Sower = class {
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
  isFull = !1;
  isBusy = !1;
  hasFailed = !1;
  lookNumber = 0;
  hear(message) {
    try {
      this.take(message), this.wake();
    } catch (error) {
      this.failWith(error);
    }
  }
  take(message) {
    switch (message.kind) {
      case "begin":
        this.place = message.place, this.room = message.pages, this.module = new SowModule(message.module, message.place), this.module.begin(message.numbers, message.entries);
        break;
      case "cell":
        if (this.asked.delete(message.cell), this.module.openCell(message.cell, unpackFrame(message.frame, void 0, `${this.place}: seeds of cell ${message.cell}`)), this.open.add(message.cell), this.open.size > maxOpenCells) {
          let oldest = this.open.values().next().value;
          this.open.delete(oldest), this.module.closeCell(oldest);
        }
        this.choose();
        break;
      case "look":
        this.lookNumber = message.number, this.module.look(message.eyes);
        for (let one of this.present.values()) one.score = this.module.score(one.unit);
        this.choose();
        break;
      case "taken":
        --this.flying;
        break;
      case "forget":
        this.present.clear(), this.used = this.blades = 0, this.choose();
    }
  }
  choose() {
    this.wanted = this.module.find(), this.next = 0, this.isFull = !1;
  }
  wake() {
    this.isBusy || this.hasFailed || !this.module || (this.isBusy = !0, this.later(() => {
      this.isBusy = !1;
      try {
        this.step() && this.wake();
      } catch (error) {
        this.failWith(error);
      }
    }));
  }
  failWith(error) {
    if (this.hasFailed = !0, !(error instanceof SwardError)) throw error;
    this.tell({ kind: "failed", error: error.kind, message: error.message }, []);
  }
  /** Grows one unit, or asks for cells. Whether there is more to do now. */
  step() {
    let ready = !1;
    for (; this.next < this.wanted.length && !this.isFull; ++this.next) {
      let one = this.wanted[this.next];
      if (!(!one.isCell && this.present.has(unitName(one)))) {
        if (one.isCell || !this.open.has(one.cell)) {
          if (!this.ask(one.cell)) break;
          continue;
        }
        if (this.flying >= unitsAtOnce) break;
        this.bring(one), ready = !0;
        break;
      }
    }
    return this.report(), ready;
  }
  /** Asks for a cell. Whether more may be asked for. */
  ask(cell) {
    return this.asked.has(cell) ? !0 : this.asked.size >= cellsAtOnce ? !1 : (this.asked.add(cell), this.tell({ kind: "wants", cell }, []), !0);
  }
  bring(one) {
    let unit2 = { cell: one.cell, level: one.level, half: one.half, place: one.place };
    this.open.delete(one.cell), this.open.add(one.cell);
    let pages = pagesOf(this.module.grow(unit2));
    if (!this.makeRoom(pages.count, one.score)) {
      this.isFull = !0;
      return;
    }
    let name = unitName(unit2);
    if (this.present.set(name, { unit: unit2, score: one.score, pages: pages.count, blades: pages.bladeCount }), pages.count === 0) return;
    this.used += pages.count, this.blades += pages.bladeCount, ++this.flying;
    let moved = [pages.blades.buffer, pages.patches.buffer];
    this.tell({ kind: "unit", name, unit: unit2, pages }, moved);
  }
  /** Removes units that are wanted less than `score` until so many pages are free. Whether they are. */
  makeRoom(pages, score) {
    let names = [];
    if (this.room - this.used < pages) {
      let least = [...this.present].filter(([, one]) => one.pages > 0 && one.score * replacing < score).sort(([, a], [, b]) => a.score - b.score), free = this.room - this.used;
      for (let [name, one] of least) {
        if (free >= pages) break;
        free += one.pages, names.push(name);
      }
      if (free < pages) return !1;
    }
    for (let name of names) {
      let one = this.present.get(name);
      this.used -= one.pages, this.blades -= one.blades, this.present.delete(name);
    }
    return names.length > 0 && this.tell({ kind: "gone", names }, []), !0;
  }
  report() {
    let missing = 0, missingScore = 0;
    for (let one of this.wanted)
      (one.isCell || !this.present.has(unitName(one))) && (++missing, missingScore = Math.max(missingScore, one.score));
    this.tell({ kind: "state", state: { look: this.lookNumber, missing, missingScore, isFull: this.isFull, blades: this.blades } }, []);
  }
};

// src/sow/worker.ts
var sowerName = "sward-sower", scope = globalThis;
if (scope.WorkerGlobalScope !== void 0 && scope.name === sowerName) {
  let sower = new Sower(
    (message, moved) => scope.postMessage(message, moved),
    // Messages that have come are heard first.
    (step) => setTimeout(step)
  );
  scope.onmessage = (event) => sower.hear(event.data);
}

// src/sow/sowing.ts
var sowRules = {
  blades: ["a number of at least 1", (value) => typeof value == "number" && value >= 1 && value < 1 / 0],
  worker: flag,
  wasm: ["the bytes of sow.wasm", (value) => value instanceof ArrayBuffer || ArrayBuffer.isView(value)],
  onChange: callback,
  onError: callback
}, usualBlades = 4e6, pagesOfFrame = 192, ignoredStep = 0.2, ignoredPart = 0.01, maxThinning = 8, thinningStep = 1.1, Sowing = class _Sowing {
  constructor(field, options, module) {
    this.field = field;
    this.options = options;
    let seeds = field.seeds, { meadow } = seeds;
    this.bladesPerStored = 1 / Math.min(meadow.stored, 1), this.areaPerStored = this.bladesPerStored / meadow.storedWidening, this.pageCount = Math.max(Math.ceil((options.blades ?? usualBlades) / sownPageBlades), 16), this.storedPatches = field.patches.count, this.firstPatch = Math.ceil(this.storedPatches / 256) * 256, this.firstBlade = Math.ceil(field.bladeCount / sownPageBlades) * sownPageBlades;
    let words = new Uint32Array(patchWords * (this.firstPatch + this.pageCount * sownPagePatches));
    words.set(field.patches.words), this.patches = new Patches(new Uint8Array(words.buffer));
    for (let p = 0; p < this.storedPatches; ++p)
      this.patches.floats[patchWords * p + patchWord.widthStep] /= meadow.storedWidening;
    for (let page = this.pageCount; page-- > 0; ) this.free.push(page);
    let numbers = numbersOf(meadow, field.species, field.origin);
    this.local = new SowModule(module, field.name), this.local.begin(numbers, new Uint8Array(0)), this.start(), this.tell({ kind: "begin", module, numbers, entries: seeds.entries, pages: this.pageCount, place: field.name });
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
  state = { look: 0, missing: 1, missingScore: maxThinning, isFull: !1, blades: 0 };
  looks = 0;
  thinned = 0;
  tell = () => {
  };
  worker;
  isStopped = !1;
  /** Begins to sow a field, which must have seeds. */
  static async open(field, options = {}) {
    checkOptions("sow", options, sowRules), field.isSown || fail("usage", `${field.name}: has no seeds of which some blades are stored`);
    let bytes = options.wasm ?? await wasmBeside();
    return new _Sowing(field, options, await compileSower(bytes, field.name));
  }
  /** Ends its work. */
  stop() {
    this.isStopped = !0, this.worker?.terminate(), this.tell = () => {
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
    let { meadow } = this.field.seeds, shares = 0, blades = 0;
    for (let kind of meadow.species)
      shares += kind.share, blades += kind.share * (1 + kind.ribbons);
    let perArea = meadow.density * (shares > 0 ? blades / shares : 1), all = this.field.bladeCount * this.bladesPerStored;
    return this.local.sparseDistance(this.pageCount * sownPageBlades, perArea, all, low, high, full, nearest);
  }
  /** Takes over what has come, at most 6 MB, and tells the sower where the eye is. Call once a frame. */
  update(eye) {
    (!this.looked || hasMoved(this.looked, eye)) && (this.looked = eye, this.tell({ kind: "look", number: ++this.looks, eyes: [eye] }));
    let room = pagesOfFrame;
    for (; this.arrived.length > 0 && room > 0; ) {
      let { name, pages } = this.arrived.shift();
      this.add(name, pages), room -= pages.count, this.tell({ kind: "taken" });
    }
    let wanted = this.wantedThinning;
    this.thinned = this.thinned === 0 ? wanted : Math.min(Math.max(wanted, this.thinned / thinningStep), this.thinned * thinningStep);
  }
  /** All is sown anew: the device was lost. */
  forget() {
    for (let name of [...this.units.keys()]) this.remove(name);
    for (let i = 0; i < this.arrived.length; ++i) this.tell({ kind: "taken" });
    this.arrived = [], this.changed = [], this.looked = void 0, this.tell({ kind: "forget" });
  }
  /** Numbers of the patches of units: `visit` is told the one that bounds a unit, and returns whether it is seen. */
  walk(seesUnit, visit) {
    for (let unit2 of this.units.values())
      seesUnit(this.firstPatch + sownPagePatches * unit2.pages[0]) && unit2.pages.forEach((page, i) => {
        let first = this.firstPatch + sownPagePatches * page;
        for (let p = i === 0 ? 1 : 0; p < unit2.patchCounts[i]; ++p) visit(first + p);
      });
  }
  get wantedThinning() {
    return Math.min(Math.max(this.state.missingScore, 1), maxThinning);
  }
  start() {
    let hear = (message) => {
      this.isStopped || this.hear(message);
    }, inPage = () => {
      let sower = new Sower(hear, (step) => setTimeout(step));
      this.tell = (message) => sower.hear(message);
    };
    if (this.options.worker === !1 || typeof Worker > "u") return inPage();
    try {
      this.worker = new Worker(new URL("./sward.js", import.meta.url), { type: "module", name: sowerName });
    } catch {
      return inPage();
    }
    let sent = [], hasAnswered = !1;
    this.tell = (message) => {
      hasAnswered || sent.push(message), this.worker.postMessage(message);
    }, this.worker.onmessage = (event) => {
      hasAnswered = !0, sent.length = 0, hear(event.data);
    }, this.worker.onerror = (event) => {
      if (event.preventDefault(), hasAnswered) return this.end(new SwardError("runtime", `${this.field.name}: sowing has stopped`));
      this.worker?.terminate(), inPage();
      for (let message of sent) this.tell(message);
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
        this.arrived.push(message), this.options.onChange?.();
        break;
      case "gone":
        for (let name of message.names) {
          let at = this.arrived.findIndex((one) => one.name === name);
          at >= 0 ? (this.arrived.splice(at, 1), this.tell({ kind: "taken" })) : this.remove(name);
        }
        break;
      case "state": {
        let before = this.wantedThinning;
        this.state = message.state, this.wantedThinning !== before && this.options.onChange?.();
        break;
      }
      case "failed":
        this.end(new SwardError(message.error, message.message));
    }
  }
  end(error) {
    this.isStopped || (this.stop(), this.state = { ...this.state, look: this.looks, missing: 0, missingScore: 0 }, this.options.onError?.(error instanceof SwardError ? error : new SwardError("runtime", String(error))));
  }
  add(name, unit2) {
    let pages = Array.from({ length: unit2.count }, () => this.free.pop()), words = sownPageBlades * 4;
    pages.forEach((page, i) => {
      let first = this.firstPatch + sownPagePatches * page, own = unit2.patches.subarray(i * sownPagePatches * patchWords, (i + 1) * sownPagePatches * patchWords);
      this.patches.words.set(own, patchWords * first);
      for (let p = 0; p < unit2.patchCounts[i]; ++p)
        this.patches.words[patchWords * (first + p) + patchWord.firstBlade] += this.firstBlade + sownPageBlades * page;
      this.changed.push({ page, blades: unit2.blades.subarray(i * words, (i + 1) * words) });
    }), this.units.set(name, { pages, patchCounts: unit2.patchCounts });
  }
  remove(name) {
    let unit2 = this.units.get(name);
    if (!unit2) return;
    this.units.delete(name), this.free.push(...unit2.pages);
    let gone = new Set(unit2.pages);
    this.changed = this.changed.filter((row) => !gone.has(row.page));
  }
};
function hasMoved(a, b) {
  let step = Math.hypot(a.eye[0] - b.eye[0], a.eye[1] - b.eye[1], a.eye[2] - b.eye[2]), changed = (x, y) => Math.abs(x - y) > ignoredPart * Math.abs(y);
  return step >= ignoredStep || changed(a.pixelsPerUnit, b.pixelsPerUnit) || changed(a.lodThreshold, b.lodThreshold) || a.lodWidth !== b.lodWidth || a.drawDistance !== b.drawDistance || changed(a.sparseFrom, b.sparseFrom);
}
async function wasmBeside() {
  let address2 = new URL("./sow.wasm", import.meta.url), response;
  try {
    response = await fetch(address2);
  } catch {
    fail("io", `${address2}: no answer from the server`);
  }
  return response.ok || fail("io", `${address2}: the server answers ${response.status}`), response.arrayBuffer();
}

// src/page/options.ts
var isVector = (value) => Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);
function isCamera(value) {
  return !value || ![value.eye, value.target, value.up].every(isVector) ? !1 : size(sub(value.eye, value.target)) > 0 && size(value.up) > 0 && value.fovYDeg > 0 && value.fovYDeg < 180;
}
var camera = [
  "a camera { eye, target, up, fovYDeg }: three numbers each, eye apart from target, an angle between 0 and 180",
  isCamera
];
function checkCamera(place, value) {
  expectOption(place, value, camera[0], isCamera(value));
}
var sowing = [
  "false or an object",
  (value) => (typeof value == "object" && value !== null && checkOptions("sow", value, sowRules), value === !1 || typeof value == "object" && value !== null)
], showRules = {
  field: address,
  cover: address,
  camera,
  panel: flag,
  sow: sowing,
  renderer: [rendererKinds, isRendererKind]
};

// src/page/grass.ts
var rules = { field: address, cover: address, sow: sowing, onChange: callback, onError: callback }, firstPages = 384, pagesAtOnce = 256, Grass = class _Grass {
  constructor(field, renderer) {
    this.field = field;
    this.renderer = renderer;
  }
  field;
  renderer;
  /** Opens a field. `gl`: the host's context, whose state the host forgets afterwards as after draw(). */
  static async open(gl, options) {
    checkOptions("Grass.open", options, rules, "field"), expectOption("Grass.open: gl", gl, "a context of WebGL 2", typeof gl?.createTransformFeedback == "function");
    let { onChange, onError } = options, field = await openField(options.field), [cover, sowing2] = await Promise.all([
      options.cover ? coverAt(options.cover) : noCover,
      field.isSown && options.sow !== !1 ? Sowing.open(field, { onChange, onError, ...options.sow }) : void 0,
      field.loadPages(0, Math.min(firstPages, field.pageCount))
    ]), before = enterHost(gl), grass = new _Grass(field, new Renderer(gl.canvas, field, cover, sowing2, gl));
    return leaveHost(gl, before), grass.loadRest(onChange).catch((error) => {
      if (!(error instanceof SwardError)) throw error;
      onError?.(error);
    }), grass;
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
    let { field } = this;
    for (let page = 0; page < field.pageCount; page += pagesAtOnce)
      await field.loadPages(page, Math.min(page + pagesAtOnce, field.pageCount)), onChange?.();
  }
};
function groundMesh(field) {
  let { ground } = field, floats = new Float32Array(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length / 4), count = ground.vertexCount, mesh = {
    positions: new Float32Array(3 * count),
    uvs: new Float32Array(2 * count),
    colors: new Uint8Array(4 * count),
    // Level 0 alone: the others are the same ground, coarser.
    indices: Uint32Array.from(
      ground.ranges.filter((range) => range.level === 0).flatMap((range) => [...ground.indices.subarray(range.firstIndex, range.firstIndex + range.indexCount)])
    )
  };
  for (let v = 0; v < count; ++v)
    mesh.positions.set(floats.subarray(7 * v, 7 * v + 3), 3 * v), mesh.uvs.set(floats.subarray(7 * v + 4, 7 * v + 6), 2 * v), mesh.colors.set(ground.vertices.subarray(28 * v + 24, 28 * v + 28), 4 * v);
  return mesh;
}

// src/page/contexts.ts
var Contexts = class {
  holders = /* @__PURE__ */ new Set();
  released = /* @__PURE__ */ new Set();
  waiting = /* @__PURE__ */ new Set();
  /** A view has a context. */
  add(view) {
    for (let views of [this.holders, this.released, this.waiting]) views.delete(view);
    this.holders.add(view), this.spare();
  }
  /** A view has ended. */
  remove(view) {
    for (let views of [this.holders, this.released, this.waiting]) views.delete(view);
    this.spare();
  }
  /** Takes the contexts of far views away while there are many, and gives room to those that wait. */
  spare() {
    for (let view of this.holders) {
      if (this.holders.size <= 8) break;
      view.release() && (this.holders.delete(view), this.released.add(view));
    }
    for (let view of this.waiting) {
      if (this.holders.size >= 14) return;
      view.comeBack() && (this.waiting.delete(view), this.holders.add(view));
    }
  }
  /** Whether the context of a view was given away, and not lost. */
  isReleased(view) {
    return this.released.has(view);
  }
  /** A view is without its context. Returns what it says; undefined: that it has lost the device. */
  lost(view) {
    if (this.isReleased(view)) return "";
    if (!(this.holders.size <= 14))
      return this.holders.delete(view), this.waiting.add(view), "This page shows more fields than the browser draws at once, often 16. This one comes back when others go.";
  }
};

// src/page/controls.ts
var eyeHeight = 1.7, moves = {
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
}, Controls = class {
  /**
   * `reach` [m]: size of what is shown. `heightAt`: of the ground along `up`, at a place relative to the field's
   * origin. `onChange` is called when something has moved.
   */
  constructor(element, camera2, up, reach, origin, heightAt, onChange) {
    this.element = element;
    this.camera = camera2;
    this.up = up;
    this.reach = reach;
    this.origin = origin;
    this.heightAt = heightAt;
    this.onChange = onChange;
    element.addEventListener("pointerdown", (event) => {
      event.isTrusted && element.setPointerCapture(event.pointerId), this.pointers.set(event.pointerId, [event.clientX, event.clientY]), this.pinch = this.spread();
    }), element.addEventListener("pointermove", (event) => this.drag(event));
    for (let name of ["pointerup", "pointercancel"])
      element.addEventListener(name, (event) => {
        this.pointers.delete(event.pointerId), this.pinch = this.spread();
      });
    element.addEventListener("contextmenu", (event) => event.preventDefault()), element.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault(), this.dolly(Math.exp(clamp(event.deltaY, -200, 200) * 2e-3));
      },
      { passive: !1 }
    ), element.addEventListener("keydown", (event) => {
      if (this.isFast = event.shiftKey, !(event.ctrlKey || event.metaKey || event.altKey)) {
        if (event.code === "Equal" || event.code === "NumpadAdd") this.dolly(0.9);
        else if (event.code === "Minus" || event.code === "NumpadSubtract") this.dolly(1 / 0.9);
        else if (moves[event.code]) this.held.add(event.code);
        else return;
        event.preventDefault(), this.onChange();
      }
    }), element.addEventListener("keyup", (event) => {
      this.isFast = event.shiftKey, this.held.delete(event.code);
    }), element.addEventListener("blur", () => this.held.clear());
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
  isFast = !1;
  /** Whether keys are held, so that the camera moves with time. */
  get isMoving() {
    return this.held.size > 0;
  }
  setMode(mode) {
    this.mode = mode, mode === "walk" && this.land(), this.onChange();
  }
  /** Moves the camera by the keys that are held for `seconds`. */
  step(seconds) {
    if (this.held.size === 0) return;
    let way = [0, 0, 0];
    for (let code of this.held) way[moves[code][0]] += moves[code][1];
    let { right, forward } = axesOf(this.camera);
    if (this.mode === "orbit") {
      this.turnAround(-0.9 * way[0] * seconds, 0.7 * way[2] * seconds), way[1] !== 0 && this.dolly(Math.exp(-way[1] * seconds));
      return;
    }
    let level = unit(sub(forward, scaled(this.up, dot(forward, this.up))), forward), ahead = this.mode === "walk" ? level : forward, speed = (this.mode === "walk" ? 2.5 : 0.15 * this.reach) * (this.isFast ? 3 : 1) * seconds;
    this.shift(add(add(scaled(right, way[0] * speed), scaled(this.up, way[1] * speed)), scaled(ahead, way[2] * speed))), this.mode === "walk" && this.stand(), this.onChange();
  }
  spread() {
    let [a, b] = [...this.pointers.values()];
    return a && b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  }
  drag(event) {
    let before = this.pointers.get(event.pointerId);
    if (!before) return;
    let [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    let perPixel = Math.PI / Math.max(this.element.clientHeight, 1);
    if (this.pointers.size === 2) {
      let spread = this.spread();
      this.pinch > 0 && spread > 0 && this.dolly(this.pinch / spread), this.pinch = spread, this.pan(0.5 * dx, 0.5 * dy);
    } else this.mode === "orbit" && (event.buttons !== 1 || event.shiftKey) ? this.pan(dx, dy) : this.mode === "orbit" ? this.turnAround(-dx * perPixel, -dy * perPixel) : this.look(-dx * 0.5 * perPixel, -dy * 0.5 * perPixel);
  }
  /** Turns the eye around the target. */
  turnAround(side, rise) {
    let { camera: camera2, up } = this, arm = turned(sub(camera2.eye, camera2.target), up, side), axis = unit(cross(arm, up), [1, 0, 0]), angle = Math.acos(clamp(dot(unit(arm), up), -1, 1));
    arm = turned(arm, axis, angle - clamp(angle + rise, 0.05, 3.09)), this.camera = { ...camera2, up, eye: this.above(add(camera2.target, arm)) }, this.onChange();
  }
  /** Turns the view around the eye. */
  look(side, rise) {
    let { camera: camera2, up } = this, way = turned(sub(camera2.target, camera2.eye), up, side), axis = unit(cross(way, up), [1, 0, 0]), angle = Math.acos(clamp(dot(unit(way), up), -1, 1));
    way = turned(way, axis, angle - clamp(angle - rise, 0.05, 3.09)), this.camera = { ...camera2, up, target: add(camera2.eye, way) }, this.onChange();
  }
  /** Brings the eye nearer to the target, or moves it ahead. */
  dolly(factor) {
    let { camera: camera2 } = this, arm = sub(camera2.eye, camera2.target);
    this.mode !== "orbit" ? this.shift(scaled(unit(arm), 0.1 * this.reach * Math.log(factor))) : size(arm) * factor > 0.02 && size(arm) * factor < 20 * this.reach && (this.camera = { ...camera2, eye: this.above(add(camera2.target, scaled(arm, factor))) }), this.mode === "walk" && this.stand(), this.onChange();
  }
  pan(dx, dy) {
    let { camera: camera2 } = this, { right, up } = axesOf(camera2), metres = 2 * size(sub(camera2.eye, camera2.target)) * Math.tan(camera2.fovYDeg * Math.PI / 360) / Math.max(this.element.clientHeight, 1);
    this.shift(add(scaled(right, -dx * metres), scaled(up, dy * metres))), this.onChange();
  }
  shift(way) {
    this.camera = { ...this.camera, eye: add(this.camera.eye, way), target: add(this.camera.target, way) };
  }
  /** The place, lifted above the ground if it lies in it. */
  above(eye) {
    let place = sub(eye, this.origin), ground = this.heightAt(place), lift = ground === void 0 ? 0 : ground + 0.02 - dot(place, this.up);
    return lift > 0 && lift < 0.05 * this.reach ? add(eye, scaled(this.up, lift)) : eye;
  }
  /** Brings the eye above the ground: where it is, else at the target, else in the middle of the field. */
  land() {
    let { camera: camera2, up } = this, isOver = (place) => this.heightAt(sub(place, this.origin)) !== void 0;
    if (isOver(camera2.eye)) {
      let way = sub(camera2.target, camera2.eye), level = unit(sub(way, scaled(up, dot(way, up))), [1, 0, 0]);
      this.camera = { ...camera2, target: add(camera2.eye, level) };
    } else {
      let to = isOver(camera2.target) ? camera2.target : this.origin, level = sub(sub(camera2.target, camera2.eye), scaled(up, dot(sub(camera2.target, camera2.eye), up)));
      this.camera = { ...camera2, eye: to, target: add(to, unit(level, [1, 0, 0])) };
    }
    this.stand();
  }
  /** Puts the eye as high above the ground as a person's. */
  stand() {
    let place = sub(this.camera.eye, this.origin), ground = this.heightAt(place);
    ground !== void 0 && this.shift(scaled(this.up, ground + eyeHeight - dot(place, this.up)));
  }
};

// src/page/ground_height.ts
var cells = 512, GroundHeight = class {
  along;
  across;
  heights = new Float32Array(cells * cells).fill(NaN);
  low = [1 / 0, 1 / 0];
  step = [1, 1];
  constructor(ground, up) {
    let side = Math.abs(up[0]) < 0.7 ? [1, 0, 0] : [0, 0, 1];
    this.along = unit(sub(side, scaled(up, dot(side, up)))), this.across = cross(up, this.along);
    let floats = new Float32Array(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length / 4), places2 = new Float32Array(3 * ground.vertexCount), high = [-1 / 0, -1 / 0];
    for (let v = 0; v < ground.vertexCount; ++v) {
      let p = [floats[7 * v], floats[7 * v + 1], floats[7 * v + 2]], place = [dot(p, this.along), dot(p, this.across), dot(p, up)];
      places2.set(place, 3 * v);
      for (let i of [0, 1])
        this.low[i] = Math.min(this.low[i], place[i]), high[i] = Math.max(high[i], place[i]);
    }
    this.step = [0, 1].map((i) => Math.max((high[i] - this.low[i]) / (cells - 1), 1e-6));
    for (let range of ground.ranges)
      if (range.level === 0)
        for (let i = range.firstIndex; i < range.firstIndex + range.indexCount; i += 3)
          this.fill([0, 1, 2].map((k) => places2.subarray(3 * ground.indices[i + k], 3 * ground.indices[i + k] + 3)));
  }
  /** Height along `up` at a place, both relative to the field's origin; undefined beside the ground. */
  at(place) {
    let x = (dot(place, this.along) - this.low[0]) / this.step[0], y = (dot(place, this.across) - this.low[1]) / this.step[1], [i, j] = [Math.floor(x), Math.floor(y)];
    if (i < 0 || j < 0 || i + 1 >= cells || j + 1 >= cells) return;
    let [u, v] = [x - i, y - j], corner = (k, l) => this.heights[(j + l) * cells + i + k], height = (corner(0, 0) * (1 - u) + corner(1, 0) * u) * (1 - v) + (corner(0, 1) * (1 - u) + corner(1, 1) * u) * v;
    return Number.isNaN(height) ? void 0 : height;
  }
  /** The grid's points below a triangle. */
  fill(corners) {
    let [a, b, c] = corners.map((p) => [(p[0] - this.low[0]) / this.step[0], (p[1] - this.low[1]) / this.step[1], p[2]]), area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if (Math.abs(area) < 1e-12) return;
    let first = (i) => Math.max(Math.ceil(Math.min(a[i], b[i], c[i]) - 1e-6), 0), last = (i) => Math.min(Math.floor(Math.max(a[i], b[i], c[i]) + 1e-6), cells - 1);
    for (let y = first(1); y <= last(1); ++y)
      for (let x = first(0); x <= last(0); ++x) {
        let v = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area, w = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
        if (v < -1e-4 || w < -1e-4 || v + w > 1.0001) continue;
        let height = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]), at = y * cells + x;
        this.heights[at] >= height || (this.heights[at] = height);
      }
  }
};

// src/page/styles.ts
var text = `
:where(.sward) { position: relative; overflow: hidden; isolation: isolate; }
:where(.sward)::before { content: ""; display: block; padding-top: 56.25%; }
.sward > canvas { position: absolute; left: 0; top: 0; width: 100%; height: 100%; margin: 0; display: block; touch-action: none;
  outline-offset: -3px; }
.sward-poster { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: cover; pointer-events: none;
  transition: opacity .4s; }
.sward-gone { opacity: 0; }
@media (prefers-reduced-motion: reduce) { .sward-poster { transition: none; } }
.sward-message, .sward-tools, .sward-note { box-sizing: border-box; color: #fff; font: 15px/1.4 system-ui, sans-serif; text-align: left; }
.sward-message { position: absolute; left: 50%; top: 45%; transform: translate(-50%, -50%); margin: 0; padding: .6em 1em;
  width: max-content; max-width: min(44em, 88%); border-radius: .5em; background: #0009; overflow-wrap: anywhere; }
.sward-message:not(.sward-error):has(~ .sward-tools) { left: auto; right: .8em; top: .8em; transform: none; font-size: 13px; }
.sward-message[hidden], .sward-progress[hidden] { display: none; }
.sward-progress { position: absolute; left: 0; top: 0; width: 100%; height: 4px; border: 0; appearance: none;
  background: #0003; accent-color: #8bc34a; }
.sward-tools { position: absolute; left: .8em; bottom: .8em; max-width: calc(100% - 1.6em); max-height: calc(100% - 1.6em);
  overflow: auto; padding: .3em .7em; border-radius: .6em; background: #0a140a99; }
.sward-tools summary { cursor: pointer; }
.sward-tools > div { display: flex; flex-wrap: wrap; gap: .5em; align-items: center; padding: .3em 0; }
.sward-tools button, .sward-tools select { font: inherit; color: inherit; background: #fff2; border: 1px solid #fff4;
  border-radius: .4em; padding: .2em .7em; min-height: 2em; max-width: 100%; cursor: pointer; }
.sward-tools option { color: #000; background: #fff; }
.sward-tools button[aria-pressed=true] { background: #6a9a3c; }
.sward-tools :focus-visible { outline: 2px solid #fff; outline-offset: 1px; }
.sward-tools label { display: flex; gap: .4em; align-items: center; }
.sward-tools input { width: 7em; accent-color: #8bc34a; }
.sward-tools output { min-width: 3.2em; font-variant-numeric: tabular-nums; }
.sward-note:empty { display: none; }
.sward-note { position: absolute; left: .8em; top: .6em; max-width: 60%; font-size: 13px; opacity: .85; text-shadow: 0 0 3px #000;
  pointer-events: none; }
`, styled = /* @__PURE__ */ new WeakSet();
function addStyles(element) {
  let own = element.getRootNode(), root = own instanceof ShadowRoot ? own : element.ownerDocument;
  if (!styled.has(root)) {
    styled.add(root);
    try {
      let sheet = new CSSStyleSheet();
      sheet.replaceSync(text), root.adoptedStyleSheets = [...root.adoptedStyleSheets, sheet];
    } catch {
      let style = element.ownerDocument.createElement("style");
      style.textContent = text, (root instanceof ShadowRoot ? root : root.head).append(style);
    }
  }
}

// src/page/panel.ts
var megabytes = (bytes) => `${(bytes / 1e6).toFixed(1)} MB`, leastArea = 2e5;
function make(name, attributes, ...children) {
  let element = document.createElement(name);
  for (let [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element.append(...children), element;
}
var Panel = class {
  constructor(element, canvas) {
    this.element = element;
    element.classList.add("sward"), addStyles(element), getComputedStyle(element).display === "inline" && (element.style.display = "block"), canvas.tabIndex = 0, canvas.setAttribute("role", "application"), canvas.setAttribute(
      "aria-label",
      "A field of grass in three dimensions. Arrow keys turn the view, plus and minus come nearer and go away."
    ), this.poster = element.querySelector(".sward-poster"), element.replaceChildren(canvas, ...this.poster ? [this.poster] : [], this.message, this.bar, this.note), this.say("The field is coming.");
  }
  element;
  message = make("p", { class: "sward-message", role: "status", "aria-live": "polite" });
  bar = make("progress", { class: "sward-progress", "aria-label": "Blades that have come", max: "1" });
  note = make("small", { class: "sward-note", role: "note" });
  poster;
  tools;
  wasFolded = !1;
  followers = [];
  hasFailed = !1;
  /** Shows a text; none if it is empty. */
  say(text2) {
    this.hasFailed || (this.message.textContent = text2, this.message.hidden = text2 === "");
  }
  /** Shows an error instead of anything else. */
  fail(error) {
    let text2 = error instanceof SwardError ? error.message : "The field cannot be shown: something unexpected happened.";
    error instanceof SwardError || console.error(error), this.say(text2), this.hasFailed = !0, this.message.setAttribute("role", "alert"), this.message.classList.add("sward-error"), this.bar.hidden = !0;
  }
  /** The first picture is there: that of the page fades, or goes at once where less motion is asked for. */
  begin() {
    let { poster } = this;
    poster && (poster.classList.add("sward-gone"), parseFloat(getComputedStyle(poster).transitionDuration) > 0 ? poster.addEventListener("transitionend", () => poster.remove()) : poster.remove());
  }
  /** Says that the blades between the stored ones of a field with seeds are missing. */
  lacksBlades(error) {
    let why = error instanceof SwardError ? error.message : String(error);
    this.note.append(`These are the stored blades of a field with seeds; the others are not sown: ${why} `);
  }
  /** Bytes of a file that comes as a whole. */
  receive(received, total) {
    this.bar.value = received / Math.max(total, 1), this.say(`${megabytes(received)} of ${megabytes(total)}`);
  }
  /** How much of a field is here. */
  progress(field) {
    let share = field.pageCount > 0 ? field.presentPages / field.pageCount : 1;
    this.bar.value = share, this.bar.hidden = share >= 1, !this.hasFailed && this.say(share >= 1 ? "" : `${Math.floor(100 * share)} % of ${field.bladeCount.toLocaleString("en")} blades`);
  }
  /** Shows what the view has, also where a script has set it. */
  follow() {
    for (let one of this.followers) one();
  }
  /** Folds the controls where they would hide much of a picture, unless someone has folded or unfolded them. */
  fit(width, height) {
    this.tools && !this.wasFolded && (this.tools.open = width * height >= leastArea);
  }
  /** Adds the controls of a view. */
  control(view) {
    let buttons = [
      ["orbit", "Orbit", "Drag turns around the field, right drag moves it, the wheel comes nearer"],
      ["fly", "Fly", "Drag looks around; W A S D or arrows fly, E and Q rise and sink, Shift is faster"],
      ["walk", "Walk", "Drag looks around; W A S D or arrows walk on the ground"]
    ].filter(([mode]) => view.modes.includes(mode)).map(([mode, text2, title]) => {
      let button = make("button", { type: "button", title }, text2);
      return button.addEventListener("click", () => {
        view.setMode(mode), view.canvas.focus();
      }), this.followers.push(() => button.setAttribute("aria-pressed", String(view.controls.mode === mode))), button;
    }), home = make("button", { type: "button", title: "Show all of the field" }, "Home");
    home.addEventListener("click", () => view.showWhole());
    let slider = (text2, low, high, step, shown3, get, set) => {
      let input = make("input", {
        type: "range",
        min: String(low),
        max: String(high),
        step: String(step),
        "aria-label": text2
      }), output = make("output", {}), last;
      return this.followers.push(() => {
        let value = get();
        value !== last && (last = value, input.value = String(value), output.textContent = shown3(value), input.setAttribute("aria-valuetext", output.textContent));
      }), input.addEventListener("input", () => set(input.valueAsNumber)), make("label", {}, make("span", {}, text2), input, output);
    }, clock = (hour) => {
      let minutes = Math.round(60 * hour);
      return `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}`;
    }, tools = make(
      "div",
      { role: "toolbar", "aria-label": "View of the field" },
      ...buttons,
      home,
      slider("Wind", 0, 3, 0.1, (x) => `${Math.round(100 * x)} %`, () => view.wind, (x) => view.wind = x),
      slider("Time", 5.25, 18.75, 0.25, clock, () => view.hour, (x) => view.hour = x),
      slider("Detail", -2, 2, 0.5, (x) => `×${(2 ** x).toFixed(x < 0 ? 2 : 1)}`, () => Math.log2(view.detail), (x) => view.detail = 2 ** x)
    ), cameras = view.field.defaults.cameras;
    if (cameras.length > 0) {
      let select = make(
        "select",
        { "aria-label": "Saved view" },
        make("option", { hidden: "" }, "Saved views"),
        ...cameras.map((camera2, i) => make("option", { value: String(i) }, camera2.name))
      );
      select.addEventListener("change", () => view.setCamera(cameras[select.selectedIndex - 1])), this.followers.push(() => select.selectedIndex = 1 + cameras.indexOf(view.controls.camera)), tools.append(select);
    }
    this.note.append(view.field.defaults.copyright);
    let summary = make("summary", { title: "Shows or hides the controls" }, "Controls");
    summary.addEventListener("click", () => this.wasFolded = !0), this.tools = make("details", { class: "sward-tools" }, summary, tools), this.fit(this.element.clientWidth, this.element.clientHeight), this.element.append(this.tools), this.follow();
  }
};

// src/page/page.ts
var firstPages2 = 384, pagesAtOnce2 = 128, requestsAtOnce = 4, minBlades = 6e4, firstBlades = { webgl: 15e4, webgpu: 1e6 }, maxBlades = { webgl: 2e6, webgpu: 4e6 }, messageTime = 6e3, longestFrame = 0.1, mostPixels = 8192, rest = 250, FieldView = class {
  constructor(element, field, renderer, panel, camera2) {
    this.element = element;
    this.field = field;
    this.renderer = renderer;
    this.panel = panel, this.budget = firstBlades[renderer.kind];
    let isPlanet = field.defaults.gravity.blend > 0;
    this.heights = isPlanet ? void 0 : new GroundHeight(field.ground, this.up), this.observer = new ResizeObserver(() => this.resize()), this.observer.observe(element), this.nearness = new IntersectionObserver((found) => this.approach(found[found.length - 1].isIntersecting), { rootMargin: "50%" }), this.adopt(renderer, camera2 ?? field.defaults.cameras[0]), this.nearness.observe(element), document.addEventListener("visibilitychange", this.wake), requestAnimationFrame(this.tick);
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
  windFactor = 1;
  hourOfDay = 9;
  detailFactor = 1;
  /** The view of all of the field, while nobody has moved it. */
  whole;
  ratio = 1;
  /** Whether the element has a size, and whether it is in the window or near it. */
  hasSize = !1;
  isNear = !0;
  context = null;
  time = 0;
  last = 0;
  isDirty = !0;
  changedAt = 0;
  isRefined = !1;
  requests = 0;
  budget;
  isLost = !1;
  isStopped = !1;
  hasFailed = !1;
  observer;
  nearness;
  heights;
  stillness = matchMedia("(prefers-reduced-motion: reduce)");
  /** Takes a renderer with its canvas. */
  adopt(renderer, camera2) {
    this.renderer = renderer, this.canvas = renderer.canvas;
    let { content } = renderer.scene;
    this.resize(), this.controls = new Controls(
      this.canvas,
      camera2 ?? (this.whole = this.wholeView()),
      this.up,
      size(sub(content.high, content.low)),
      this.field.origin,
      (place) => this.heights?.at(place),
      () => this.change()
    );
    let wasLost = (text2 = "The graphics device was lost. The picture comes back when it does.") => {
      this.isLost = !0, this.panel.say(text2);
    }, { canvas } = this;
    if (renderer.kind === "webgpu") {
      renderer.onLost(() => {
        wasLost(), this.replaceRenderer();
      });
      return;
    }
    this.context = canvas.getContext("webgl2").getExtension("WEBGL_lose_context"), contexts.add(this), canvas.addEventListener("webglcontextlost", (event) => {
      this.isStopped || (event.preventDefault(), wasLost(contexts.lost(this)), this.approach(this.isNear));
    }), canvas.addEventListener("webglcontextrestored", () => {
      this.isStopped || this.canvas !== canvas || (contexts.add(this), renderer.restore(), this.isLost = !1, this.panel.say(""), this.change());
    });
  }
  /** Goes on with another device, or by WebGL 2, on a new canvas. */
  async replaceRenderer() {
    let { mode, camera: camera2 } = this.controls, { renderer: before } = this, canvas = this.canvas.cloneNode();
    this.canvas.replaceWith(canvas);
    try {
      let renderer = before.kind === "webgl" ? new Renderer(canvas, this.field, before.cover, before.sowing) : await makeRenderer(canvas, this.field, before.scene.cover);
      if (this.adopt(renderer, camera2), this.isStopped) return this.free();
    } catch (error) {
      this.panel.fail(error);
      return;
    }
    this.controls.setMode(mode), this.budget = firstBlades[this.renderer.kind], this.isLost = !1;
    let isOther = this.renderer.kind !== before.kind;
    this.panel.say(isOther ? "The graphics device was lost. Now WebGL draws." : ""), isOther && setTimeout(() => this.panel.say(""), messageTime), this.change();
  }
  /** Up direction of the field, against gravity. */
  get up() {
    return unit(scaled(this.field.defaults.gravity.direction, -1));
  }
  /** A camera that shows all of the field. */
  wholeView() {
    let { renderer, field, canvas } = this, aspect = canvas.width / canvas.height;
    return fittingCamera(renderer.scene.content, field.origin, this.up, renderer.usualLight.sunDirection, aspect);
  }
  /** Factor of the field's wind, 0 to 10. */
  get wind() {
    return this.windFactor;
  }
  set wind(factor) {
    this.windFactor = numberIn("wind", factor, 0, 10), this.change();
  }
  /** Hour of the day, 5 to 19; at 9 the sun stands as in the viewer. */
  get hour() {
    return this.hourOfDay;
  }
  set hour(hour) {
    this.hourOfDay = numberIn("hour", hour, 5, 19), this.change();
  }
  /** Factor of the number of blades that are drawn at most, 0.01 to 100. */
  get detail() {
    return this.detailFactor;
  }
  set detail(factor) {
    this.detailFactor = numberIn("detail", factor, 0.01, 100), this.change();
  }
  /** Ways of moving that the field has: nobody walks on planets. */
  get modes() {
    return this.heights ? ["orbit", "fly", "walk"] : ["orbit", "fly"];
  }
  setMode(mode) {
    expectOption("setMode", mode, `one of ${this.modes.join(", ")}`, this.modes.includes(mode)), this.controls.setMode(mode);
  }
  setCamera(camera2) {
    checkCamera("setCamera", camera2), this.controls.camera = camera2, this.change();
  }
  /** Shows all of the field, also after the element changes its size. */
  showWhole() {
    this.setCamera(this.whole = this.wholeView());
  }
  /** Asks for a new picture: something has changed. */
  change() {
    this.isDirty = !0, this.isRefined = !1, this.changedAt = performance.now(), this.panel.follow();
  }
  /** Ends the work in the element, and frees the device: the picture goes. */
  stop() {
    this.isStopped || (this.isStopped = !0, this.observer.disconnect(), this.nearness.disconnect(), document.removeEventListener("visibilitychange", this.wake), this.renderer.sowing?.stop(), this.free());
  }
  free() {
    contexts.remove(this), this.renderer.kind === "webgpu" ? this.renderer.stop() : this.isLost || this.context?.loseContext();
  }
  /** Gives the context of WebGL away until the element is near the window again; false if it is near. */
  release() {
    return this.isNear || this.isLost ? !1 : (this.context?.loseContext(), !0);
  }
  /** Takes a new context, after the browser has taken the first one for another view; false if nobody sees it. */
  comeBack() {
    return this.isNear && this.replaceRenderer(), this.isNear;
  }
  /** The element has come near the window, or gone far away. */
  approach(isNear) {
    this.isNear = isNear, contexts.spare(), isNear && (this.isLost && contexts.isReleased(this) && setTimeout(() => this.isStopped || this.context?.restoreContext()), this.wake());
  }
  wake = () => {
    this.last = 0, this.change();
  };
  resize() {
    let { clientWidth, clientHeight } = this.element;
    this.ratio = devicePixelRatio, this.hasSize = clientWidth > 0 && clientHeight > 0, this.hasSize && this.panel.fit(clientWidth, clientHeight);
    let ratio = Math.min(devicePixelRatio || 1, 2, mostPixels / Math.max(clientWidth, clientHeight, 1)), width = Math.max(Math.round(clientWidth * ratio), 1), height = Math.max(Math.round(clientHeight * ratio), 1);
    this.canvas.width === width && this.canvas.height === height || (this.canvas.width = width, this.canvas.height = height, this.whole && this.controls?.camera === this.whole && (this.controls.camera = this.whole = this.wholeView()), this.change());
  }
  tick = (now) => {
    if (this.isStopped || (requestAnimationFrame(this.tick), devicePixelRatio !== this.ratio && this.resize(), this.isLost || document.hidden || !this.hasSize || !this.isNear)) return;
    let since = this.last > 0 ? now - this.last : 0;
    this.last = now, this.controls.step(Math.min(since / 1e3, longestFrame));
    let blows = this.wind > 0 && !this.stillness.matches, isResting = !blows && !this.controls.isMoving && performance.now() - this.changedAt > rest;
    if (!blows && !this.isDirty && (!isResting || this.isRefined)) return;
    let elapsed = blows ? Math.min(since / 1e3, longestFrame) : 0;
    this.isDirty = this.renderer.sowing?.hasNews ?? !1, this.isRefined = isResting && !this.isDirty, this.draw(elapsed, isResting), blows && since > 0 && this.adapt(since);
  };
  draw(elapsed, isFine) {
    this.time += elapsed;
    let { azimuth, elevation } = sunAt(this.hour), stats = this.renderer.draw({
      camera: this.controls.camera,
      time: this.time,
      elapsed,
      light: this.hour === 9 ? void 0 : lightAt(azimuth, elevation, this.up),
      wind: this.wind,
      // A picture at rest may take longer.
      maxBlades: this.budget * this.detail * (isFine ? 2 : 1),
      isFine
    });
    ++this.frames === 1 && this.panel.begin(), this.load(stats.missing);
  }
  /** Fewer blades where frames take long, more where they do not. */
  adapt(since) {
    this.frameTime = this.frameTime === 0 ? since : 0.9 * this.frameTime + 0.1 * since;
    let slow = clamp(40 / this.frameTime, 0.3, 0.97);
    this.frameTime > 45 ? this.budget = Math.max(slow * this.budget, minBlades) : this.frameTime < 20 && (this.budget = Math.min(1.02 * this.budget, maxBlades[this.renderer.kind]));
  }
  /** Fetches what is visible and not here, then the rest. */
  load(missing) {
    let { field, panel } = this;
    if (panel.progress(field), field.isComplete || this.hasFailed || this.requests >= requestsAtOnce) return;
    let wanted = missing.slice(0, pagesAtOnce2);
    for (let page = 0; wanted.length < pagesAtOnce2 && page < field.pageCount; ++page)
      field.isMissing(page) && !wanted.includes(page) && wanted.push(page);
    wanted = wanted.sort((a, b) => a - b), wanted.length !== 0 && (++this.requests, loadRuns(field, wanted).then(() => this.change()).catch((error) => {
      this.hasFailed = !0, panel.fail(error);
    }).finally(() => {
      --this.requests, panel.progress(field);
    }));
  }
};
async function loadRuns(field, pages) {
  let runs = [];
  for (let page of pages) {
    let last = runs[runs.length - 1];
    last && page - last[1] < 4 ? last[1] = page + 1 : runs.push([page, page + 1]);
  }
  for (let [from, to] of runs) await field.loadPages(from, to);
}
function sunAt(hour) {
  let rise = (h) => Math.sin(Math.PI * (h - 5) / 14);
  return {
    azimuth: usualSun.azimuth + 15 * (hour - 9),
    elevation: usualSun.elevation * rise(hour) / rise(9)
  };
}
var contexts = new Contexts(), shownIn = /* @__PURE__ */ new WeakMap();
async function showField(element, options) {
  expectOption("showField: element", element, "an element of a page", element?.nodeType === 1), shownIn.get(element)?.view?.stop();
  let place = {};
  shownIn.set(element, place);
  let canvas = document.createElement("canvas"), panel = new Panel(element, canvas);
  try {
    checkOptions("showField", options, showRules, "field");
    let field = await openField(options.field, {
      onProgress: (received, total) => panel.receive(received, total)
    });
    panel.progress(field);
    let [cover] = await Promise.all([
      options.cover ? coverAt(options.cover) : noCover,
      field.loadPages(0, Math.min(firstPages2, field.pageCount))
    ]), sowing2 = await sowingOf(field, options, panel, () => view.change()), renderer = await makeRenderer(canvas, field, cover, options.renderer, sowing2);
    shownIn.get(element) !== place && (sowing2?.stop(), fail("usage", `${field.name}: the element shows another field now`));
    let view = new FieldView(element, field, renderer, panel, options.camera);
    return place.view = view, (options.panel ?? !0) && panel.control(view), view;
  } catch (error) {
    throw panel.fail(error), error;
  }
}
async function sowingOf(field, options, panel, onChange) {
  if (!field.isSown || options.sow === !1) return;
  let onError = (error) => panel.lacksBlades(error);
  try {
    return await Sowing.open(field, { onChange, onError, ...options.sow });
  } catch (error) {
    onError(error);
    return;
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
  checkCover,
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
