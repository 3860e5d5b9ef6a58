// Writes WGSL of a program that parse.mjs has read: of `main`, and of all that it reaches.
//
// What differs between the languages: WGSL has no conversions that are not written, no functions of one name with other
// arguments, no "?:" and no assignment to several components. Arguments that a function changes are pointers. Buffers by
// address (SHARED_TABLE, SHARED_BUFFER) are bindings of the name of the member that holds the address: `FRAME.blades.at[i]`
// reads `blades[i]`, or fetch_blades(i) where the program has that function.
import { Expressions } from "./expressions.mjs";
import { builtins, elementOf, isScalar, matrixOf, safe, scalarOf, sizeOf, vectorOf, wgslType } from "./types.mjs";


/** Names of functions by their arguments, the same in all programs. */
export class Names {
  all = new Map();

  of(name, key) {
    if (!this.all.has(name)) this.all.set(name, new Map());
    const own = this.all.get(name);
    if (!own.has(key)) own.set(key, own.size === 0 ? safe(name) : `${name}_${own.size + 1}`);
    return own.get(key);
  }
}

/**
 * `declarations`: of parse(); `stage`: "compute", "vertex" or "fragment"; `constants`: values of specialisation constants
 * by their names, as text; `overrides`: names of those that a pipeline gives. Returns { pieces, resources }.
 */
export function emit(declarations, { stage, constants = {}, overrides = [], names = new Names() }) {
  const program = new Program(declarations, stage, constants, overrides, names);
  return program.run();
}

class Program extends Expressions {
  structs = new Map();
  tables = new Map();
  functions = new Map();
  globals = new Map();
  workgroup = [1, 1, 1];
  /** Texts of what is used, by the number of its declaration. */
  pieces = new Map();
  used = new Set();
  resources = new Map();
  written = new Set();
  atomics = new Set();
  private_ = new Set();
  structsUsed = new Set();
  uniformStructs = new Set();

  constructor(declarations, stage, constants, overrides, names) {
    super();
    this.stage = stage;
    this.overrides = new Set(overrides);
    this.names = names;
    declarations.forEach((one, order) => {
      one.order = order;
      if (one.is === "struct") this.structs.set(one.name, one);
      else if (one.is === "table") this.tables.set(one.name, one.of);
      else if (one.is === "layout") {
        for (const [name, value] of Object.entries(one.layout)) {
          const axis = ["local_size_x", "local_size_y", "local_size_z"].indexOf(name);
          if (axis >= 0) this.workgroup[axis] = value;
        }
      } else if (one.is === "storage") {
        const member = one.members[0];
        const kind = one.set.has("uniform") ? "uniform" : "storage";
        this.globals.set(member.name, { ...one, ...member, is: "resource", kind, order });
      } else if (one.is === "global") {
        if (one.layout.constant_id && constants[one.name] !== undefined) one.value = { is: "given", text: constants[one.name], type: one.type };
        const kind = one.set.has("uniform") ? "resource" : "global";
        this.globals.set(one.name, { ...one, is: kind, kind: "texture", order });
      } else if (one.is === "function") {
        if (!this.functions.has(one.name)) this.functions.set(one.name, []);
        const own = this.functions.get(one.name);
        one.parameters = one.parameters.map((p) => ({ ...p, t: p.type + p.size.map((n) => `[${this.number(n)}]`).join("") }));
        one.t = one.type + one.size.map((n) => `[${this.number(n)}]`).join("");
        one.kept = one.parameters.filter((p) => !this.tables.has(p.type));
        one.wgsl = names.of(one.name, one.kept.map((p) => p.t).join());
        own.push(one);
        this.findAtomics(one.body);
      }
    });
  }

  fail(what, at = this.place) {
    throw new Error(`${at ?? "?"}: ${what}`);
  }

  /** The names of globals that atomic functions change. */
  findAtomics(tree) {
    if (Array.isArray(tree)) return tree.forEach((one) => this.findAtomics(one));
    if (!tree || typeof tree !== "object") return;
    if (tree.is === "call" && /^atomic/.test(tree.name)) this.atomics.add(this.rootOf(tree.values[0]));
    for (const value of Object.values(tree)) if (typeof value === "object") this.findAtomics(value);
  }

  /** The variable that an expression is of; of a table the member that holds it. */
  rootOf(tree) {
    if (tree.is === "name") return tree.name;
    if (tree.is === "member" && tree.name === "at") return tree.of.name;
    return this.rootOf(tree.of ?? tree.inner);
  }

  /** Value of a constant expression; undefined if it has none that is known. */
  constant(tree) {
    if (!tree) return undefined;
    switch (tree.is) {
      case "number":
        return Number(tree.text.replace(/u$|(?<=[.\d])f$/, ""));
      case "bool":
        return tree.value;
      case "given":
        return tree.text === "true" ? true : tree.text === "false" ? false : Number(tree.text.replace(/u$/, ""));
      case "group":
        return this.constant(tree.inner);
      case "name": {
        const one = this.globals.get(tree.name);
        if (this.overrides.has(tree.name) || this.scopes?.some((scope) => scope.has(tree.name))) return undefined;
        return one?.isConst ? this.constant(one.value) : undefined;
      }
      case "unary": {
        const value = this.constant(tree.of);
        if (value === undefined) return undefined;
        return { "-": () => -value, "!": () => !value, "~": () => ~value >>> 0, "+": () => value }[tree.mark]();
      }
      case "choice": {
        const which = this.constant(tree.condition);
        return which === undefined ? undefined : this.constant(which ? tree.yes : tree.no);
      }
      case "binary": {
        const a = this.constant(tree.left);
        const b = this.constant(tree.right);
        if (tree.mark === "&&" && (a === false || b === false)) return false;
        if (tree.mark === "||" && (a === true || b === true)) return true;
        if (a === undefined || b === undefined) return undefined;
        const isWhole = Number.isInteger(a) && Number.isInteger(b);
        const find = {
          "+": () => a + b, "-": () => a - b, "*": () => a * b, "/": () => (isWhole ? Math.trunc(a / b) : a / b), "%": () => a % b,
          "<": () => a < b, ">": () => a > b, "<=": () => a <= b, ">=": () => a >= b, "==": () => a === b, "!=": () => a !== b,
          "&": () => (a & b) >>> 0, "|": () => (a | b) >>> 0, "^": () => (a ^ b) >>> 0, "<<": () => (a << b) >>> 0, ">>": () => a >>> b,
          "&&": () => a && b, "||": () => a || b,
        }[tree.mark];
        return find?.();
      }
      default:
        return undefined;
    }
  }

  number(tree) {
    if (tree === "") return "";
    const value = this.constant(tree);
    if (value === undefined) this.fail("the size of an array is not known");
    return value;
  }

  typeWith(one) {
    return one.type + one.size.map((n) => `[${this.number(n)}]`).join("");
  }

  // ---- Statements. ----

  put(text) {
    this.lines.push(text);
  }

  /** The statements of one that is a body, without braces. Returns whether nothing after them is reached. */
  inner(tree) {
    this.scopes.push(new Map());
    const ends = (tree.is === "block" ? tree.body : [tree]).some((one) => this.statement(one));
    this.scopes.pop();
    return ends;
  }

  /** Writes a statement; returns whether nothing after it is reached. */
  statement(tree) {
    this.place = tree.at ?? this.place;
    switch (tree.is) {
      case "block": {
        if (tree.body.length === 0) return false;
        this.put("{");
        const ends = this.inner(tree);
        this.put("}");
        return ends;
      }
      case "declare":
        for (const one of tree.names) this.declare(one);
        return false;
      case "do":
        for (const one of tree.value.is === "all" ? tree.value.all : [tree.value]) this.act(one);
        return false;
      case "if": {
        const known = this.constant(tree.condition);
        if (known !== undefined) {
          const taken = known ? tree.yes : tree.no;
          return taken !== null && this.statement(taken.is === "block" ? taken : { is: "block", body: [taken] });
        }
        this.put(`if (${this.value(tree.condition).c}) {`);
        this.inner(tree.yes);
        let no = tree.no;
        if (no) {
          this.put("} else {");
          this.inner(no);
        }
        this.put("}");
        return false;
      }
      case "for":
        this.loop(tree);
        return false;
      case "return":
        if (!tree.value) this.put("return;");
        else this.put(`return ${this.as(this.value(tree.value), this.result).c};`);
        return true;
      case "break":
      case "continue":
      case "discard":
        this.put(`${tree.is};`);
        return true;
      default:
        return this.fail(`no statement: ${tree.is}`);
    }
  }

  declare(one) {
    this.place = one.at;
    if (this.tables.has(one.type)) {
      this.scopes[this.scopes.length - 1].set(one.name, { t: one.type, table: one.value ? this.tableOf(one.value) : one.name });
      return;
    }
    const t = this.typeWith(one);
    this.useType(t);
    const value = one.value && this.as(this.value(one.value), t);
    const c = safe(one.name);
    this.scopes[this.scopes.length - 1].set(one.name, { t, c });
    if (!value) this.put(`var ${c} : ${wgslType(t)};`);
    else this.put(`${one.isConst ? "let" : "var"} ${c} = ${value.c};`);
  }

  loop(tree) {
    if (this.constant(tree.condition) === false) return;
    this.scopes.push(new Map());
    const steps = tree.next ? (tree.next.is === "all" ? tree.next.all : [tree.next]) : [];
    // Texts of the head; a head that needs statements of its own becomes a loop with a break.
    const collect = (act) => {
      const lines = this.lines;
      this.lines = [];
      const value = act();
      const own = this.lines;
      this.lines = lines;
      return [own, value];
    };
    const [first] = collect(() => tree.first && this.statement(tree.first));
    const [before, condition] = collect(() => (tree.condition ? this.value(tree.condition).c : "true"));
    const [next] = collect(() => steps.forEach((one) => this.act(one)));
    if (first.length <= 1 && before.length === 0 && next.length <= 1) {
      const strip = (list) => (list[0] ?? "").replace(/;$/, "");
      this.put(first.length + next.length === 0 ? `while (${condition}) {` : `for (${strip(first)}; ${condition}; ${strip(next)}) {`);
      this.inner(tree.body);
      this.put("}");
    } else {
      this.put("{");
      this.lines.push(...first);
      this.put("loop {");
      this.lines.push(...before);
      this.put(`if (!(${condition})) { break; }`);
      this.inner(tree.body);
      if (next.length > 0) {
        this.put("continuing {");
        this.lines.push(...next);
        this.put("}");
      }
      this.put("}");
      this.put("}");
    }
    this.scopes.pop();
  }

  /** An expression that is a statement. */
  act(tree) {
    if (tree.is === "group") return this.act(tree.inner);
    if (tree.is === "step") {
      const e = this.expression(tree.of);
      this.note(e);
      this.put(scalarOf(e.t) === "float" ? `${e.c} ${tree.mark[0]}= 1.0;` : `${e.c}${tree.mark};`);
      return;
    }
    if (tree.is === "assign") return this.assign(tree);
    const e = this.expression(tree);
    if (tree.is === "call" && e.c) this.put(`${e.c};`);
  }

  note(e) {
    if (e.global) this.written.add(e.global.name);
  }

  assign(tree) {
    if (this.tableOf(tree.to) !== undefined) return;
    const mark = tree.mark.slice(0, -1);
    const e = this.expression(tree.to);
    this.note(e);
    if (e.swizzle && sizeOf(e.t) > 1) {
      const value = mark ? this.binary({ mark, left: tree.to, right: tree.value }) : this.value(tree.value);
      const name = this.fresh();
      this.put(`let ${name} = ${this.wide(value, e.t).c};`);
      [...e.swizzle[1]].forEach((part, i) => this.put(`${e.swizzle[0]}.${part} = ${name}.${"xyzw"[i]};`));
      return;
    }
    const isAtomic = e.place !== undefined || (e.global && this.atomics.has(e.global.name) && isScalar(e.t));
    if (isAtomic) {
      if (mark) this.fail("an atomic is assigned to");
      this.put(`atomicStore(&${e.place ?? e.c}, ${this.as(this.value(tree.value), e.t).c});`);
      return;
    }
    const value = this.value(tree.value);
    if (!mark) this.put(`${e.c} = ${this.as(value, e.t).c};`);
    else if (mark === "<<" || mark === ">>") this.put(`${e.c} ${mark}= ${this.as(value, "uint").c};`);
    else if (matrixOf(e.t) || matrixOf(value.t)) this.put(`${e.c} = ${e.c} ${mark} ${this.wrap(value, 8)};`);
    else this.put(`${e.c} ${mark}= ${"&|^".includes(mark) ? this.wide(value, e.t).c : this.as(value, vectorOf(scalarOf(e.t), sizeOf(value.t))).c};`);
  }

  /** Names that a body assigns to. */
  changed(tree, found = new Set()) {
    if (Array.isArray(tree)) tree.forEach((one) => this.changed(one, found));
    else if (tree && typeof tree === "object") {
      if (tree.is === "assign") found.add(this.rootOf(tree.to));
      if (tree.is === "step") found.add(this.rootOf(tree.of));
      if (tree.is === "call")
        for (const one of this.functions.get(tree.name) ?? [])
          one.parameters.forEach((p, i) => p.isOut && tree.values[i] && found.add(this.rootOf(tree.values[i])));
      for (const value of Object.values(tree)) if (typeof value === "object") this.changed(value, found);
    }
    return found;
  }

  /** Writes a function, once. */
  write(one) {
    if (one.isWritten) return;
    one.isWritten = true;
    const before = { scopes: this.scopes, lines: this.lines, count: this.count, result: this.result, isEntry: this.isEntry, place: this.place };
    Object.assign(this, { scopes: [new Map()], lines: [], count: 0, result: one.t, isEntry: one.name === "main" && this.stage === "compute" });
    const changed = this.changed(one.body);
    const heads = [];
    for (const p of one.parameters) {
      if (this.tables.has(p.type)) {
        this.scopes[0].set(p.name, { t: p.type, table: p.name });
        continue;
      }
      this.useType(p.t);
      const c = safe(p.name || "unused");
      const isCopied = !p.isOut && changed.has(p.name);
      heads.push(p.isOut ? `${c} : ptr<function, ${wgslType(p.t)}>` : `${isCopied ? `${c}_in` : c} : ${wgslType(p.t)}`);
      if (isCopied) this.put(`var ${c} = ${c}_in;`);
      this.scopes[0].set(p.name, { t: p.t, c, isPointer: p.isOut });
    }
    this.useType(one.t);
    one.body.body.some((statement) => this.statement(statement));
    const lines = this.lines;
    Object.assign(this, before);
    if (one.name === "main") this.main = lines;
    else {
      const result = one.t === "void" ? "" : ` -> ${wgslType(one.t)}`;
      this.pieces.set(one.order, `fn ${one.wgsl}(${heads.join(", ")})${result} {\n${indented(lines)}\n}`);
    }
  }

  workgroupSize() {
    return this.workgroup.map((one) => (typeof one === "number" ? one : this.constant(one)));
  }

  // ---- The whole. ----

  run() {
    this.scopes = [];
    this.lines = [];
    this.write(this.functions.get("main")[0]);
    const entry = this.stage === "compute" ? this.computeEntry() : this.drawnEntry();
    const pieces = [];
    for (const one of this.structs.values()) if (this.structsUsed.has(one.name)) this.pieces.set(one.order, this.structText(one));
    for (const [name, { global, t }] of this.resources) this.pieces.set(global.order, this.resourceText(name, global, t));
    for (const order of [...this.pieces.keys()].sort((a, b) => a - b)) pieces.push(this.pieces.get(order));
    return { pieces: [...pieces, entry], resources: this.bindings() };
  }

  /** Numbers of the bindings of set 0 by their names. */
  bindings() {
    const own = [...this.resources].filter(([, { global }]) => !this.constant(global.layout.set));
    const numbers = own.map(([name, { global }]) => [name, this.constant(global.layout.binding)]);
    return Object.fromEntries(numbers.sort((a, b) => a[1] - b[1]));
  }

  structText(struct) {
    const isUniform = this.isInUniform(struct.name);
    const members = struct.members.filter((one) => !this.tables.has(one.type));
    const lines = members.map((one, i) => {
      const t = this.typeWith(one);
      const inner = elementOf(t);
      let text = wgslType(t);
      // std140: elements of 16 bytes.
      if (isUniform && inner && sizeOf(inner) === 1) text = wgslType(t.replace(inner, vectorOf(inner, 4)));
      return `${isUniform && i === 0 ? "@align(16) " : ""}${safe(one.name)} : ${text}`;
    });
    return `struct ${struct.name} {\n${indented((lines.length > 0 ? lines : ["none : u32"]).map((line) => `${line},`))}\n}`;
  }

  resourceText(name, global, t) {
    const binding = this.constant(global.layout.binding);
    const set = this.constant(global.layout.set) ?? 0;
    const head = `@group(${set}) @binding(${binding}) var`;
    if (global.kind === "uniform") return `${head}<uniform> ${name}_ : ${wgslType(t)};`;
    if (global.kind === "storage") {
      const access = this.written.has(name) || this.atomics.has(name) ? "read_write" : "read";
      return `${head}<storage, ${access}> ${name}_ : ${this.storedType(t, this.atomics.has(name))};`;
    }
    const plain = {
      sampler2D: "texture_2d<f32>", texture2D: "texture_2d<f32>", utexture2D: "texture_2d<u32>", textureDepth2D: "texture_depth_2d",
      texture2DMS: "texture_multisampled_2d<f32>", textureDepth2DMS: "texture_depth_multisampled_2d",
    }[t];
    if (t === "image2D") {
      const format = Object.keys(global.layout).find((one) => /^r(gba)?\d+/.test(one));
      const wgsl = { rgba16f: "rgba16float", rgba8: "rgba8unorm", r32f: "r32float" }[format];
      return `${head} ${name}_ : texture_storage_2d<${wgsl}, write>;`;
    }
    if (!plain) this.fail(`no texture ${t}`);
    const sampler = t.startsWith("sampler") ? `\n@group(${set}) @binding(${binding + 1}) var ${name}_sampler : sampler;` : "";
    return `${head} ${name}_ : ${plain};${sampler}`;
  }

  computeEntry() {
    const given = Object.keys(builtins).filter((name) => this.used.has(name));
    const parameters = given.map((name) => `@builtin(${builtins[name][0]}) ${name.slice(3)}_ : ${wgslType(builtins[name][1])}`);
    const own = [...this.private_];
    const privates = own.map((name) => `var<private> own${name.slice(3)} : ${wgslType(builtins[name][1])};\n`).join("");
    const first = own.map((name) => `own${name.slice(3)} = ${name.slice(3)}_;`);
    return `${privates}@compute @workgroup_size(${this.workgroupSize().join(", ")})\nfn main(${parameters.join(", ")}) {\n${indented([...first, ...this.main])}\n}`;
  }

  drawnEntry() {
    const given = Object.keys(builtins).filter((name) => this.used.has(name));
    const own = [...this.globals.values()].filter((one) => one.is === "global" && this.used.has(one.name) && !one.isConst && !one.set.has("shared"));
    const place = (one) => {
      const whole = ["uint", "int"].includes(scalarOf(one.type)) && !(this.stage === "vertex" && one.set.has("in"));
      return `@location(${this.constant(one.layout.location)}) ${whole && !(this.stage === "fragment" && one.set.has("out")) ? "@interpolate(flat) " : ""}`;
    };
    const ins = own.filter((one) => one.set.has("in"));
    const outs = own.filter((one) => one.set.has("out"));
    const parameters = [
      ...given.map((name) => `@builtin(${builtins[name][0]}) ${name.slice(3)}_ : ${wgslType(builtins[name][1])}`),
      ...ins.map((one) => `${place(one)}${one.name}_in : ${wgslType(one.type)}`),
    ];
    const privates = given.map((name) => `var<private> own${name.slice(3)} : ${wgslType(builtins[name][1])};\n`).join("");
    const position = this.stage === "vertex";
    const members = [
      ...(position ? ["@builtin(position) @invariant at : vec4f,"] : []),
      ...outs.map((one) => `${place(one)}${safe(one.name)} : ${wgslType(one.type)},`),
    ];
    const values = [...(position ? ["ownPosition"] : []), ...outs.map((one) => safe(one.name))];
    const lines = [
      ...given.map((name) => `own${name.slice(3)} = ${name.slice(3)}_;`),
      ...ins.map((one) => `${safe(one.name)} = ${one.name}_in;`),
      "run();",
      ...(members.length > 0 ? [`return Drawn(${values.join(", ")});`] : []),
    ];
    return (
      (position ? "var<private> ownPosition : vec4f;\n" : "") +
      privates +
      (members.length > 0 ? `struct Drawn {\n${indented(members)}\n}\n` : "") +
      `fn run() {\n${indented(this.main)}\n}\n` +
      `@${this.stage}\nfn main(${parameters.join(", ")})${members.length > 0 ? " -> Drawn" : ""} {\n${indented(lines)}\n}`
    );
  }
}

/** Lines moved in by their braces. */
function indented(lines) {
  let depth = 1;
  return lines
    .map((line) => {
      if (line.startsWith("}")) --depth;
      const text = `${" ".repeat(depth)}${line}`;
      if (line.endsWith("{")) ++depth;
      return text;
    })
    .join("\n");
}
