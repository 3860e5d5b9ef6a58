// Expressions of GLSL in WGSL: part of emit.mjs, whose class Program has the declarations and the statements. An expression is
// { c: text, t: type, p: strength of its weakest operator }; `variable` and `global` say what it is a part of.
import {
  alike, builtins, comparisons, elementOf, isScalar, matrixOf, renamed, results,
  safe, scalarOf, sizeOf, vectorOf, wgslType,
} from "./types.mjs";

const strength = { "*": 7, "/": 7, "%": 7, "+": 6, "-": 6, "<<": 5, ">>": 5, "<": 4, ">": 4, "<=": 4, ">=": 4, "==": 4, "!=": 4, "&": 3, "|": 3, "^": 3, "&&": 2, "||": 2 };
const rank = { bool: 0, int: 1, uint: 2, float: 3 };

export class Expressions {
  wrap(e, least) {
    return e.p < least ? `(${e.c})` : e.c;
  }

  /** `e` as `type`, which it may be converted to unasked. */
  as(e, type) {
    if (e.t === type || !e.t) return e;
    if (e.literal !== undefined && isScalar(type)) {
      const text = type === "float" ? e.literal.replace(/u$/, "") + ".0" : type === "uint" ? `${e.literal.replace(/u$/, "")}u` : e.literal;
      return { c: text, t: type, p: 9 };
    }
    if (sizeOf(e.t) > 0 && sizeOf(e.t) === sizeOf(type)) return { c: `${wgslType(type)}(${e.c})`, t: type, p: 9 };
    return this.fail(`${e.t} is no ${type}: ${e.c}`);
  }

  /** `e` as `type`; a scalar becomes a vector. */
  wide(e, type) {
    if (sizeOf(e.t) === 1 && sizeOf(type) > 1) return { c: `${wgslType(type)}(${this.as(e, scalarOf(type)).c})`, t: type, p: 9 };
    return this.as(e, type);
  }

  /** The common type of scalars and vectors. */
  common(...types) {
    const size = Math.max(...types.map(sizeOf));
    const scalar = types.map(scalarOf).reduce((a, b) => (rank[a] > rank[b] ? a : b));
    return vectorOf(scalar, size);
  }

  expression(tree) {
    switch (tree.is) {
      case "number": {
        const text = tree.text;
        if (/^0x|^\d+u?$/.test(text)) return { c: text, t: text.endsWith("u") ? "uint" : "int", p: 9, literal: /^0x/.test(text) ? undefined : text };
        let c = text.replace(/f$/, "").replace(/^\./, "0.").replace(/\.(?!\d)/, ".0");
        if (/^\d+$/.test(c)) c += ".0";
        return { c, t: "float", p: 9 };
      }
      case "bool":
        return { c: String(tree.value), t: "bool", p: 9 };
      case "given":
        return { c: tree.text, t: tree.type, p: 9 };
      case "group": {
        const inner = this.expression(tree.inner);
        return inner;
      }
      case "name":
        return this.name(tree);
      case "member":
        return this.member(tree);
      case "index":
        return this.index(tree);
      case "unary": {
        const e = this.expression(tree.of);
        if (tree.mark === "+") return e;
        const c = `${tree.mark}${e.p < 9 || e.c.startsWith("-") ? `(${e.c})` : e.c}`;
        return { c, t: e.t, p: 8, literal: tree.mark === "-" && e.literal && e.t === "int" ? c : undefined };
      }
      case "binary":
        return this.binary(tree);
      case "choice":
        return this.choice(tree);
      case "call":
        return this.call(tree);
      case "step": {
        // A statement before the one that this is in.
        const e = this.expression(tree.of);
        const name = this.fresh();
        if (tree.isAfter) this.put(`let ${name} = ${e.c};`);
        this.act(tree);
        return tree.isAfter ? { c: name, t: e.t, p: 9 } : e;
      }
      default:
        return this.fail(`no value: ${tree.is}`);
    }
  }

  local(name) {
    for (let i = this.scopes.length - 1; i >= 0; --i) if (this.scopes[i].has(name)) return this.scopes[i].get(name);
    return undefined;
  }

  name(tree) {
    const own = this.local(tree.name);
    if (own) return { c: own.isPointer ? `(*${own.c})` : own.c, t: own.t, p: 9, variable: own };
    if (builtins[tree.name]) {
      const [, type] = builtins[tree.name];
      this.used.add(tree.name);
      if (this.isEntry) return { c: `${tree.name.slice(3)}_`, t: type, p: 9 };
      this.private_.add(tree.name);
      return { c: `own${tree.name.slice(3)}`, t: type, p: 9 };
    }
    if (tree.name === "gl_WorkGroupSize") return { c: `vec3u(${this.workgroupSize().join(", ")})`, t: "uvec3", p: 9 };
    if (tree.name === "gl_Position") {
      this.used.add("gl_Position");
      return { c: "ownPosition", t: "vec4", p: 9 };
    }
    const global = this.globals.get(tree.name) ?? this.fail(`no ${tree.name}`, tree.at);
    this.useGlobal(global);
    const t = this.typeWith(global);
    return { c: this.globalName(global), t, p: 9, global };
  }

  globalName(global) {
    return global.is === "resource" ? `${global.name}_` : safe(global.name);
  }

  /** Marks a global and writes its declaration. */
  useGlobal(global) {
    if (this.used.has(global.name)) return;
    this.used.add(global.name);
    const t = this.typeWith(global);
    if (global.is === "resource") {
      this.resources.set(global.name, { global, t });
      if (global.kind !== "texture") this.useType(t, global.kind === "uniform");
      return;
    }
    this.useType(t);
    if (global.isConst) {
      const before = [this.scopes, this.lines];
      this.scopes = [];
      this.lines = [];
      const value = this.as(this.expression(global.value), t);
      if (this.lines.length > 0) this.fail("no constant", global.at);
      [this.scopes, this.lines] = before;
      const word = this.overrides.has(global.name) ? "override" : "const";
      this.pieces.set(global.order, `${word} ${safe(global.name)} : ${wgslType(t)} = ${value.c};`);
    } else if (global.set.has("shared")) {
      const atomic = this.atomics.has(global.name);
      this.pieces.set(global.order, `var<workgroup> ${safe(global.name)} : ${this.storedType(t, atomic)};`);
    } else this.pieces.set(global.order, `var<private> ${safe(global.name)} : ${wgslType(t)};`);
  }

  storedType(t, isAtomic) {
    return isAtomic ? wgslType(t).replace(/u32|i32|vec2u/, (word) => `atomic<${word}>`) : wgslType(t);
  }

  /** Marks the structs of a type. */
  useType(t, isUniform = false) {
    const base = elementOf(t) ?? t;
    const struct = this.structs.get(base);
    if (!struct) return;
    const known = isUniform ? this.uniformStructs : this.structsUsed;
    if (known.has(base)) return;
    known.add(base);
    this.structsUsed.add(base);
    for (const one of struct.members) if (!this.tables.has(one.type)) this.useType(this.typeWith(one), isUniform);
  }

  /** The table that an expression is: the name of its binding. Undefined if it is none. */
  tableOf(tree) {
    if (tree.is === "group") return this.tableOf(tree.inner);
    if (tree.is === "name") {
      const own = this.local(tree.name);
      return own?.table;
    }
    if (tree.is === "call" && this.tables.has(tree.name)) return this.tableOf(tree.values[0]);
    if (tree.is !== "member") return undefined;
    const struct = this.structs.get(this.quietType(tree.of));
    const member = struct?.members.find((one) => one.name === tree.name);
    return member && this.tables.has(member.type) ? tree.name : undefined;
  }

  /** The type of an expression, without its side effects. */
  quietType(tree) {
    if (tree.is === "name") {
      const own = this.local(tree.name);
      if (own) return own.t;
      const global = this.globals.get(tree.name);
      return global && this.typeWith(global);
    }
    if (tree.is === "group") return this.quietType(tree.inner);
    if (tree.is === "index") {
      const of = this.quietType(tree.of);
      return of && elementOf(of);
    }
    if (tree.is === "call") return this.structs.has(tree.name) ? tree.name : this.functions.get(tree.name)?.[0].t;
    if (tree.is !== "member") return undefined;
    const struct = this.structs.get(this.quietType(tree.of));
    const member = struct?.members.find((one) => one.name === tree.name);
    return member && this.typeWith(member);
  }

  member(tree) {
    const e = this.expression(tree.of);
    const struct = this.structs.get(e.t);
    if (struct) {
      const one = struct.members.find((own) => own.name === tree.name) ?? this.fail(`${e.t} has no ${tree.name}`, tree.at);
      const t = this.typeWith(one);
      const inner = elementOf(t);
      return { c: `${this.wrap(e, 9)}.${safe(tree.name)}`, t, p: 9, variable: e.variable, global: e.global, isPacked: inner !== undefined && sizeOf(inner) === 1 && this.isInUniform(e.t) };
    }
    const size = sizeOf(e.t);
    if (size < 2 || !/^([xyzw]+|[rgba]+)$/.test(tree.name)) this.fail(`${e.t} has no ${tree.name}`, tree.at);
    return { c: `${this.wrap(e, 9)}.${tree.name}`, t: vectorOf(scalarOf(e.t), tree.name.length), p: 9, variable: e.variable, global: e.global, swizzle: [this.wrap(e, 9), tree.name] };
  }

  /** Whether a struct is a part of a uniform: its arrays of scalars have 16 bytes an element. */
  isInUniform(name) {
    if (!this.inUniform) {
      this.inUniform = new Set();
      const add = (type) => {
        const struct = this.structs.get(elementOf(type) ?? type);
        if (!struct || this.inUniform.has(struct.name)) return;
        this.inUniform.add(struct.name);
        for (const one of struct.members) add(one.type);
      };
      for (const one of this.globals.values()) if (one.kind === "uniform") add(one.type);
    }
    return this.inUniform.has(name);
  }

  index(tree) {
    const isTable = tree.of.is === "member" && tree.of.name === "at";
    const table = isTable ? this.tableOf(tree.of.of) : undefined;
    if (isTable && table === undefined) this.fail("a table that is not known", tree.of.at);
    if (table !== undefined) {
      const index = this.expression(tree.index);
      const fetch = this.functions.get(`fetch_${table}`);
      if (fetch) return this.called(fetch[0], [this.as(index, "uint")]);
      const global = this.globals.get(table);
      if (global?.is !== "resource") this.fail(`no binding ${table}`, tree.of.at);
      this.useGlobal(global);
      return this.loaded({ c: `${this.globalName(global)}[${index.c}]`, t: elementOf(this.typeWith(global)), p: 9, global });
    }
    const e = this.expression(tree.of);
    const index = this.expression(tree.index);
    const matrix = matrixOf(e.t);
    const t = matrix ? vectorOf("float", matrix[1]) : elementOf(e.t) ?? (sizeOf(e.t) > 1 ? scalarOf(e.t) : undefined);
    if (!t) this.fail(`${e.t} has no elements`);
    const c = `${this.wrap(e, 9)}[${index.c}]${e.isPacked ? ".x" : ""}`;
    return this.loaded({ c, t, p: 9, variable: e.variable, global: e.global });
  }

  /** An element of a global that atomic functions change is loaded by one, too. */
  loaded(e) {
    if (e.global && this.atomics.has(e.global.name) && isScalar(e.t)) return { ...e, place: e.c, c: `atomicLoad(&${e.c})` };
    return e;
  }

  binary(tree) {
    const { mark } = tree;
    const known = mark === "&&" || mark === "||" ? this.constant(tree) : undefined;
    if (known !== undefined) return { c: String(known), t: "bool", p: 9 };
    if (mark === "&&" || mark === "||") {
      // A side that is known falls away.
      for (const [one, other] of [["left", "right"], ["right", "left"]])
        if (this.constant(tree[one]) !== undefined) return this.expression(tree[other]);
    }
    let a = this.atom(this.expression(tree.left));
    let b = this.atom(this.expression(tree.right));
    const p = strength[mark];
    if (mark === "&&" || mark === "||") {
      const side = (e) => (e.p === p && e.mark === mark ? e.c : this.wrap(e, 4));
      return { c: `${side(a)} ${mark} ${side(b)}`, t: "bool", p, mark };
    }
    if (mark === "^^") return { c: `${this.wrap(a, 5)} != ${this.wrap(b, 5)}`, t: "bool", p: 4 };
    if (mark === "<<" || mark === ">>") {
      b = this.wide(b, vectorOf("uint", sizeOf(a.t)));
      return { c: `${this.wrap(a, 8)} ${mark} ${this.wrap(b, 8)}`, t: a.t, p };
    }
    if (matrixOf(a.t) || matrixOf(b.t)) {
      const [ma, mb] = [matrixOf(a.t), matrixOf(b.t)];
      const t = ma && mb ? `mat${mb[0]}x${ma[1]}`.replace(/(\d)x\1$/, "$1") : ma ? (sizeOf(b.t) > 1 ? vectorOf("float", ma[1]) : a.t) : sizeOf(a.t) > 1 ? vectorOf("float", mb[0]) : b.t;
      return { c: `${this.wrap(a, p)} ${mark} ${this.wrap(b, p + 1)}`, t, p };
    }
    const t = this.common(a.t, b.t);
    const scalar = scalarOf(t);
    if (p === 3 || p === 4) {
      a = this.wide(a, t);
      b = this.wide(b, t);
      if (p === 3) return { c: `${a.p === 3 && a.mark === mark ? a.c : this.wrap(a, 8)} ${mark} ${this.wrap(b, 8)}`, t, p, mark };
      const c = `${this.wrap(a, 6)} ${mark} ${this.wrap(b, 6)}`;
      if (sizeOf(t) === 1) return { c, t: "bool", p };
      return { c: `${mark === "==" ? "all" : "any"}(${c})`, t: "bool", p: 9 };
    }
    a = this.as(a, vectorOf(scalar, sizeOf(a.t)));
    b = this.as(b, vectorOf(scalar, sizeOf(b.t)));
    return { c: `${this.wrap(a, p)} ${mark} ${this.wrap(b, p + 1)}`, t, p };
  }

  /** An expression that is loaded: a global scalar that is atomic. */
  atom(e) {
    if (e.place || !e.global || !this.atomics.has(e.global.name) || !isScalar(e.t)) return e;
    return { ...e, place: e.c, c: `atomicLoad(&${e.c})` };
  }

  value(tree) {
    return this.atom(this.expression(tree));
  }

  hasCalls(tree) {
    if (Array.isArray(tree)) return tree.some((one) => this.hasCalls(one));
    if (!tree || typeof tree !== "object") return false;
    if (tree.is === "call" && this.functions.has(tree.name)) return true;
    return Object.values(tree).some((one) => typeof one === "object" && this.hasCalls(one));
  }

  choice(tree) {
    const known = this.constant(tree.condition);
    if (known !== undefined) return this.expression(known ? tree.yes : tree.no);
    const condition = this.value(tree.condition);
    const isHeavy = this.hasCalls(tree.yes) || this.hasCalls(tree.no);
    const from = this.lines.length;
    let yes = this.value(tree.yes);
    const middle = this.lines.length;
    let no = this.value(tree.no);
    const isVector = sizeOf(yes.t) > 0 && sizeOf(no.t) > 0;
    const t = isVector ? this.common(yes.t, no.t) : yes.t;
    yes = isVector ? this.as(yes, t) : yes;
    no = isVector ? this.as(no, t) : no;
    if (isVector && (!isHeavy || this.mayNotHoist) && this.lines.length === from)
      return { c: `select(${no.c}, ${yes.c}, ${condition.c})`, t, p: 9 };
    const ofNo = this.lines.splice(middle);
    const ofYes = this.lines.splice(from);
    const name = this.fresh();
    this.useType(t);
    this.put(`var ${name} : ${wgslType(t)};`);
    this.put(`if (${condition.c}) {`);
    this.lines.push(...ofYes);
    this.put(`${name} = ${yes.c};`);
    this.put("} else {");
    this.lines.push(...ofNo);
    this.put(`${name} = ${no.c};`);
    this.put("}");
    return { c: name, t, p: 9 };
  }

  fresh() {
    return `t${++this.count}_`;
  }

  call(tree) {
    const { name } = tree;
    this.place = tree.at ?? this.place;
    if (tree.size.length > 0) {
      const t = `${name}[${tree.values.length}]`;
      return { c: `${wgslType(t)}(${tree.values.map((one) => this.as(this.value(one), name).c).join(", ")})`, t, p: 9 };
    }
    if (this.structs.has(name)) {
      const members = this.structs.get(name).members.filter((one) => !this.tables.has(one.type));
      this.useType(name);
      const values = tree.values.map((one, i) => this.as(this.value(one), this.typeWith(members[i])).c);
      return { c: `${name}(${values.join(", ")})`, t: name, p: 9 };
    }
    if (sizeOf(name) > 0 || matrixOf(name)) return this.construct(tree);
    if (/^atomic/.test(name)) {
      const place = this.expression(tree.values[0]);
      if (place.global) this.written.add(place.global.name);
      const rest = tree.values.slice(1).map((one) => this.as(this.value(one), place.t).c);
      return { c: `${name}(&${place.place ?? place.c}, ${rest.join(", ")})`, t: place.t, p: 9 };
    }
    const own = this.functions.get(name);
    if (own) return this.userCall(tree, own);
    return this.builtin(tree);
  }

  construct(tree) {
    const type = tree.name;
    // The address of a table is 0.
    if (tree.values.length === 1 && this.tableOf(tree.values[0]) !== undefined) return { c: `${wgslType(type)}()`, t: type, p: 9 };
    const values = tree.values.map((one) => this.value(one));
    const scalar = scalarOf(type) ?? "float";
    if (values.length === 1) {
      const [e] = values;
      if (e.t === type) return e;
      if (e.literal !== undefined && isScalar(type) && type !== "bool") return this.as(e, type);
      const size = sizeOf(type);
      if (sizeOf(e.t) > size && size > 0) return { c: `${wgslType(type)}(${this.wrap(e, 9)}.${"xyzw".slice(0, size)})`, t: type, p: 9 };
      const inner = sizeOf(e.t) === 1 && size > 1 ? (scalarOf(e.t) === scalar ? e.c : e.literal !== undefined ? this.as(e, scalar).c : `${wgslType(scalar)}(${e.c})`) : e.c;
      return { c: `${wgslType(type)}(${inner})`, t: type, p: 9 };
    }
    const parts = values.map((e) => {
      if (matrixOf(type) && sizeOf(e.t) > 1) return e.c;
      if (scalarOf(e.t) === scalar) return e.c;
      if (e.literal !== undefined && scalar !== "bool") return this.as(e, scalar).c;
      return `${wgslType(vectorOf(scalar, sizeOf(e.t)))}(${e.c})`;
    });
    return { c: `${wgslType(type)}(${parts.join(", ")})`, t: type, p: 9 };
  }

  userCall(tree, own) {
    const tables = (one) => one.parameters.map((p) => this.tables.has(p.type));
    const fitting = own.filter((one) => one.parameters.length === tree.values.length);
    let chosen = fitting[0];
    if (fitting.length > 1) {
      const lines = this.lines;
      this.lines = [];
      const types = tree.values.map((one) => (this.tableOf(one) !== undefined ? "table" : this.expression(one).t));
      this.lines = lines;
      const fits = (one, test) => one.parameters.every((p, i) => (tables(one)[i] ? types[i] === "table" : test(types[i], p.t)));
      chosen = fitting.find((one) => fits(one, (a, b) => a === b)) ?? fitting.find((one) => fits(one, (a, b) => sizeOf(a) > 0 && sizeOf(a) === sizeOf(b)));
    }
    if (!chosen) this.fail(`no function ${tree.name} with these arguments`, tree.at);
    const after = [];
    const values = [];
    chosen.parameters.forEach((p, i) => {
      if (this.tables.has(p.type)) return;
      if (!p.isOut) {
        values.push(this.as(this.value(tree.values[i]), p.t));
        return;
      }
      const e = this.expression(tree.values[i]);
      const isWhole = tree.values[i].is === "name" && e.variable && e.t === p.t;
      if (isWhole) {
        values.push({ c: e.variable.isPointer ? e.variable.c : `&${e.variable.c}` });
        return;
      }
      const name = this.fresh();
      this.put(`var ${name} = ${this.as(e, p.t).c};`);
      after.push(`${e.c} = ${name};`);
      values.push({ c: `&${name}` });
    });
    const done = this.called(chosen, values);
    if (after.length === 0) return done;
    const name = this.fresh();
    if (chosen.t === "void") this.put(`${done.c};`);
    else this.put(`let ${name} = ${done.c};`);
    for (const line of after) this.put(line);
    return { c: chosen.t === "void" ? "" : name, t: chosen.t, p: 9 };
  }

  called(chosen, values) {
    this.write(chosen);
    return { c: `${chosen.wgsl}(${values.map((one) => one.c).join(", ")})`, t: chosen.t, p: 9 };
  }

  builtin(tree) {
    const { name } = tree;
    if (name === "barrier" || name === "memoryBarrierShared") return { c: "workgroupBarrier()", t: "void", p: 9 };
    if (name === "workgroupUniformLoad") {
      const e = this.expression(tree.values[0]);
      return { c: `workgroupUniformLoad(&${e.place ?? e.c})`, t: e.t, p: 9 };
    }
    if (/^(texelFetch|textureSize|textureLod|imageStore|imageLoad)$/.test(name)) return this.textureCall(tree);
    const values = tree.values.map((one) => this.value(one));
    const types = values.map((e) => e.t);
    const plain = (c, t, p = 9) => ({ c, t, p });
    if (comparisons[name]) {
      const t = this.common(...types);
      const [a, b] = values.map((e) => this.wrap(this.as(e, t), 6));
      return plain(`${a} ${comparisons[name]} ${b}`, vectorOf("bool", sizeOf(t)), 4);
    }
    if (name === "not") return plain(`!${this.wrap(values[0], 9)}`, types[0], 8);
    if (name === "mix") {
      const t = this.common(types[0], types[1]);
      const [a, b] = values.slice(0, 2).map((e) => this.wide(e, t).c);
      if (scalarOf(types[2]) === "bool") return plain(`select(${a}, ${b}, ${values[2].c})`, t);
      return plain(`mix(${a}, ${b}, ${this.as(values[2], vectorOf("float", sizeOf(types[2]))).c})`, t);
    }
    if (name === "mod") {
      const t = this.common(...types);
      const [a, b] = values.map((e) => this.wide(e, t));
      return plain(`${this.wrap(a, 7)} - ${this.wrap(b, 8)} * floor(${this.wrap(a, 7)} / ${this.wrap(b, 8)})`, t, 6);
    }
    if (name === "atan") {
      const t = this.common(...types);
      return plain(`${values.length > 1 ? "atan2" : "atan"}(${values.map((e) => this.wide(e, t).c).join(", ")})`, t);
    }
    if (name === "floatBitsToUint" || name === "uintBitsToFloat" || name === "floatBitsToInt" || name === "intBitsToFloat") {
      const t = vectorOf(name.endsWith("Float") ? "float" : name.endsWith("Uint") ? "uint" : "int", sizeOf(types[0]));
      return plain(`bitcast<${wgslType(t)}>(${values[0].c})`, t);
    }
    const counted = { bitCount: "countOneBits", findLSB: "firstTrailingBit", findMSB: "firstLeadingBit" }[name];
    if (counted) {
      const t = vectorOf("int", sizeOf(types[0]));
      return plain(`${wgslType(t)}(${counted}(${values[0].c}))`, t);
    }
    if (alike.has(name)) {
      let t = this.common(...types);
      if (!["abs", "sign", "min", "max", "clamp"].includes(name)) t = vectorOf("float", sizeOf(t));
      return plain(`${renamed[name] ?? name}(${values.map((e) => this.wide(e, t).c).join(", ")})`, t);
    }
    if (name === "transpose") return plain(`transpose(${values[0].c})`, types[0]);
    if (results[name]) return plain(`${renamed[name] ?? name}(${values.map((e) => e.c).join(", ")})`, results[name]);
    return this.fail(`no function ${name}`, tree.at);
  }

  textureCall(tree) {
    const e = this.expression(tree.values[0]);
    const kind = e.t;
    const rest = tree.values.slice(1).map((one) => this.value(one));
    const scalar = /^u/.test(kind) ? "uint" : "float";
    const texel = /Depth/.test(kind) ? "float" : vectorOf(scalar, 4);
    if (tree.name === "textureSize") return { c: `vec2i(textureDimensions(${e.c}))`, t: "ivec2", p: 9 };
    if (tree.name === "textureLod")
      return { c: `textureSampleLevel(${e.c}, ${e.c}sampler, ${rest.map((one) => one.c).join(", ")})`, t: texel, p: 9 };
    if (tree.name === "imageStore") return { c: `textureStore(${e.c}, ${rest[0].c}, ${rest[1].c})`, t: "void", p: 9 };
    return { c: `textureLoad(${e.c}, ${rest.map((one) => one.c).join(", ")})`, t: texel, p: 9 };
  }
}
