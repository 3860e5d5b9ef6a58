// Reads the GLSL of this repository: macros, tokens, and a tree of declarations, statements and expressions. Knows what
// shaders/ and web/shaders use of the language, no more; what it does not know is an error with the place.

/** Tokens of a text without comments; each is { text, kind, at } with kind "name", "number" or "mark". */
function tokensOf(text, file) {
  const pattern = /[ \t\r]+|\n|(\d+\.\d*(?:[eE][-+]?\d+)?f?|\.\d+(?:[eE][-+]?\d+)?f?|\d+[eE][-+]?\d+f?|0x[0-9a-fA-F]+u?|\d+u?)|([A-Za-z_]\w*)|(<<=|>>=|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||\^\^|[-+*/%&|^]=|[-+*/%&|^~!<>=?:;,.(){}\[\]#])/gy;
  const tokens = [];
  let line = 1;
  for (let end = 0; end < text.length; end = pattern.lastIndex) {
    const found = pattern.exec(text);
    if (!found) throw new Error(`${file}:${line}: ${text.slice(end, end + 20)}`);
    if (found[0] === "\n") ++line;
    if (found[1]) tokens.push({ text: found[1], kind: "number", at: `${file}:${line}` });
    else if (found[2]) tokens.push({ text: found[2], kind: "name", at: `${file}:${line}` });
    else if (found[3]) tokens.push({ text: found[3], kind: "mark", at: `${file}:${line}` });
  }
  return tokens;
}

const withoutComments = (text) =>
  text.replace(/\/\*[^]*?\*\/|\/\/[^\n]*/g, (comment) => comment.replace(/[^\n]/g, ""));

/**
 * Reads a file with all that it includes. `read(path)` returns a text. `macros`: defined from the start, as
 * { name: [parameters or null, text] }.
 */
export function preprocess(path, read, macros = {}) {
  const defined = new Map();
  const define = (name, parameters, text, file) =>
    defined.set(name, { parameters, tokens: tokensOf(withoutComments(text), file) });
  for (const [name, [parameters, text]] of Object.entries(macros)) define(name, parameters, text, "macros");
  const out = [];

  /** Puts tokens with their macros unfolded. */
  function unfold(tokens, put, hidden = new Set()) {
    for (let i = 0; i < tokens.length; ++i) {
      const token = tokens[i];
      const macro = token.kind === "name" && !hidden.has(token.text) ? defined.get(token.text) : undefined;
      if (!macro || (macro.parameters && tokens[i + 1]?.text !== "(")) {
        put.push(token);
        continue;
      }
      let body = macro.tokens.map((one) => ({ ...one, at: token.at }));
      if (macro.parameters) {
        const values = [[]];
        let depth = 0;
        for (i += 1; ; ++i) {
          const text = tokens[i].text;
          if (text === "(" && depth++ === 0) continue;
          if (text === ")" && --depth === 0) break;
          if (text === "," && depth === 1) values.push([]);
          else values[values.length - 1].push(tokens[i]);
        }
        body = body.flatMap((one) => {
          const k = macro.parameters.indexOf(one.text);
          return k < 0 ? [one] : values[k] ?? [];
        });
      }
      unfold(body, put, new Set([...hidden, token.text]));
    }
  }

  function readFile(file) {
    const lines = withoutComments(read(file)).replace(/\\\n/g, " ").split("\n");
    const active = [true];
    let waiting = [];
    let line = 0;
    // A macro's arguments may stand on several lines.
    const flush = () => {
      if (waiting.length > 0) unfold(waiting, out);
      waiting = [];
    };
    for (const text of lines) {
      ++line;
      const directive = /^\s*#\s*(\w+)\s*(.*)$/.exec(text);
      const isActive = active.every((one) => one);
      if (!directive) {
        if (isActive) waiting.push(...tokensOf(text, file).map((one) => ({ ...one, at: `${file}:${line}` })));
        continue;
      }
      flush();
      const [, what, rest] = directive;
      if (what === "ifdef") active.push(defined.has(rest.trim()));
      else if (what === "ifndef") active.push(!defined.has(rest.trim()));
      else if (what === "else") active.push(!active.pop());
      else if (what === "endif") active.pop();
      else if (!isActive || what === "extension" || what === "version") continue;
      else if (what === "include") readFile(/"([^"]+)"/.exec(rest)[1]);
      else if (what === "undef") defined.delete(rest.trim());
      else if (what === "define") {
        const [, name, parameters, body] = /^(\w+)(?:\(([^)]*)\))?\s*(.*)$/.exec(rest);
        define(name, parameters?.split(",").map((one) => one.trim()), body, file);
      } else throw new Error(`${file}:${line}: #${what}`);
    }
    flush();
  }
  readFile(path);
  return out;
}

const levels = [["||"], ["^^"], ["&&"], ["|"], ["^"], ["&"], ["==", "!="], ["<", ">", "<=", ">="], ["<<", ">>"], ["+", "-"], ["*", "/", "%"]];
const assigns = ["=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="];
const qualifiers = new Set(["const", "in", "out", "inout", "uniform", "readonly", "writeonly", "buffer", "shared", "flat", "precise", "highp", "restrict", "coherent"]);
const basic = /^(void|bool|u?int|float|[iub]?vec[234]|mat[234](x[234])?|uint64_t|[iu]?sampler\w+|[iu]?image\w+|texture\w*)$/;

/** Declarations of a program, in order. */
export function parse(tokens) {
  let at = 0;
  const types = new Set();
  const look = (ahead = 0) => tokens[at + ahead]?.text;
  const fail = (what) => {
    throw new Error(`${tokens[Math.min(at, tokens.length - 1)].at}: ${what} at "${tokens.slice(at, at + 6).map((one) => one.text).join(" ")}"`);
  };
  const take = (text) => {
    if (text !== undefined && look() !== text) fail(`no "${text}"`);
    return tokens[at++].text;
  };
  const takes = (text) => look() === text && (++at, true);
  const isType = (text) => text !== undefined && (basic.test(text) || types.has(text));

  function list(close, one) {
    const found = [];
    while (!takes(close)) {
      found.push(one());
      if (look() !== close) take(",");
    }
    return found;
  }

  /** [n] after a type or a name; "" for an open array. */
  function sizes() {
    const found = [];
    while (takes("[")) {
      found.push(look() === "]" ? "" : expression());
      take("]");
    }
    return found;
  }

  function primary() {
    const token = tokens[at];
    if (token === undefined) fail("the end");
    if (takes("(")) {
      const inner = expression();
      take(")");
      return { is: "group", inner };
    }
    if (token.kind === "number") return { is: "number", text: take() };
    if (token.kind !== "name") fail("no expression");
    const name = take();
    if (name === "true" || name === "false") return { is: "bool", value: name === "true" };
    const size = isType(name) && look() === "[" ? sizes() : [];
    if (takes("(")) return { is: "call", name, size, values: list(")", assignment), at: token.at };
    return { is: "name", name, at: token.at };
  }

  function postfix() {
    let one = primary();
    for (;;) {
      if (takes(".")) one = { is: "member", of: one, name: take(), at: tokens[at - 1].at };
      else if (takes("[")) {
        one = { is: "index", of: one, index: expression() };
        take("]");
      } else if (look() === "++" || look() === "--") one = { is: "step", of: one, mark: take(), isAfter: true };
      else return one;
    }
  }

  function unary() {
    if (["-", "!", "~", "+"].includes(look())) return { is: "unary", mark: take(), of: unary() };
    if (look() === "++" || look() === "--") return { is: "step", mark: take(), of: unary() };
    return postfix();
  }

  function binary(level = 0) {
    if (level === levels.length) return unary();
    let left = binary(level + 1);
    while (levels[level].includes(look())) left = { is: "binary", mark: take(), left, right: binary(level + 1) };
    return left;
  }

  function assignment() {
    const left = binary();
    if (takes("?")) {
      const yes = assignment();
      take(":");
      return { is: "choice", condition: left, yes, no: assignment() };
    }
    if (assigns.includes(look())) return { is: "assign", mark: take(), to: left, value: assignment() };
    return left;
  }

  function expression() {
    const one = assignment();
    if (look() !== ",") return one;
    const all = [one];
    while (takes(",")) all.push(assignment());
    return { is: "all", all };
  }

  function attributes() {
    while (look() === "[" && look(1) === "[") while (take() !== "]" || look(-1) !== "]" || look(-2) !== "]");
  }

  /** Qualifiers of a declaration; `layout` holds the names within layout(...). */
  function qualified() {
    const found = { set: new Set(), layout: {} };
    for (;;) {
      if (takes("layout")) {
        take("(");
        list(")", () => {
          const name = take();
          found.layout[name] = takes("=") ? assignment() : true;
        });
      } else if (qualifiers.has(look())) found.set.add(take());
      else return found;
    }
  }

  function declaration(how) {
    const type = take();
    const size = sizes();
    const names = [];
    do {
      const token = tokens[at];
      const name = take();
      const own = [...sizes(), ...size];
      names.push({ name, type, size: own, value: takes("=") ? assignment() : null, isConst: how.set.has("const"), at: token.at });
    } while (takes(","));
    return { is: "declare", names };
  }

  const isDeclaration = () =>
    qualifiers.has(look()) || (isType(look()) && (tokens[at + 1].kind === "name" || (look(1) === "[" && tokens[at + 3]?.text === "]" && tokens[at + 4]?.kind === "name")));

  function statement() {
    attributes();
    const place = tokens[at].at;
    if (look() === "{") return block();
    if (takes(";")) return { is: "block", body: [] };
    if (takes("if")) {
      take("(");
      const condition = expression();
      take(")");
      const yes = statement();
      return { is: "if", condition, yes, no: takes("else") ? statement() : null, at: place };
    }
    if (takes("for")) {
      take("(");
      const first = look() === ";" ? null : isDeclaration() ? declaration(qualified()) : { is: "do", value: expression() };
      take(";");
      const condition = look() === ";" ? null : expression();
      take(";");
      const next = look() === ")" ? null : expression();
      take(")");
      return { is: "for", first, condition, next, body: statement(), at: place };
    }
    if (takes("while")) {
      take("(");
      const condition = expression();
      take(")");
      return { is: "for", first: null, condition, next: null, body: statement(), at: place };
    }
    if (["break", "continue", "discard"].includes(look())) {
      const what = take();
      take(";");
      return { is: what };
    }
    if (takes("return")) {
      const value = look() === ";" ? null : expression();
      take(";");
      return { is: "return", value, at: place };
    }
    const one = isDeclaration() ? declaration(qualified()) : { is: "do", value: expression(), at: place };
    take(";");
    return one;
  }

  function block() {
    take("{");
    const body = [];
    while (!takes("}")) body.push(statement());
    return { is: "block", body };
  }

  function members() {
    take("{");
    const found = [];
    while (!takes("}")) {
      qualified();
      const one = declaration({ set: new Set() });
      take(";");
      found.push(...one.names);
    }
    return found;
  }

  const found = [];
  while (at < tokens.length) {
    if (takes(";")) continue;
    if (takes("precision")) {
      while (take() !== ";");
      continue;
    }
    // SHARED_TABLE and SHARED_BUFFER.
    if (takes("table")) {
      const name = take();
      types.add(name);
      found.push({ is: "table", name, of: take() });
      continue;
    }
    if (takes("struct")) {
      const name = take();
      types.add(name);
      found.push({ is: "struct", name, members: members() });
      take(";");
      continue;
    }
    const how = qualified();
    if (look() === ";") {
      found.push({ is: "layout", ...how });
      continue;
    }
    if (how.set.has("buffer") || (how.set.has("uniform") && look(1) === "{")) {
      const name = take();
      if (how.layout.buffer_reference) types.add(name);
      const own = members();
      const instance = look() === ";" ? null : take();
      take(";");
      found.push(how.layout.buffer_reference ? { is: "table", name, of: own[0].type } : { is: "storage", name, members: own, instance, ...how });
      continue;
    }
    if (look(2) === "(" || (look(1) === "[" && look(5) === "(")) {
      const type = take();
      const size = sizes();
      const name = take();
      take("(");
      const parameters = list(")", () => {
        const own = qualified();
        const kind = take();
        const before = sizes();
        const called = [",", ")"].includes(look()) ? "" : take();
        return { type: kind, name: called, size: [...sizes(), ...before], isOut: own.set.has("out") || own.set.has("inout") };
      });
      if (parameters.length === 1 && parameters[0].type === "void") parameters.length = 0;
      if (takes(";")) continue;
      found.push({ is: "function", type, size, name, parameters, body: block() });
      continue;
    }
    for (const one of declaration(how).names) found.push({ is: "global", ...one, ...how });
    take(";");
  }
  return found;
}
