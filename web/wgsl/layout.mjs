// Places of the members of structs in WGSL's text, by the rules of its specification (14.4.1, alignment and size).

const up = (at, to) => Math.ceil(at / to) * to;

function plainSpace(type) {
  if (/^(f32|u32|i32|atomic<u32>)$/.test(type)) return { align: 4, size: 4 };
  const vector = /^vec([234])[fui]$/.exec(type);
  if (vector) return { align: vector[1] === "2" ? 8 : 16, size: 4 * Number(vector[1]) };
  const matrix = /^mat([234])x([234])f$/.exec(type);
  if (!matrix) return undefined;
  const column = matrix[2] === "2" ? 8 : 16;
  return { align: column, size: column * Number(matrix[1]) };
}

/** Size of a struct, and the place of each of its leaves by its path: { size, align, members }. `pieces`: of emit(). */
export function placesIn(pieces, name) {
  const structs = new Map();
  for (const piece of pieces) {
    const found = /^struct (\w+) \{\n([^]*)\n\}$/.exec(piece);
    if (!found) continue;
    structs.set(
      found[1],
      found[2].split("\n").map((line) => {
        const [, align, member, type] = /^\s*(?:@align\((\d+)\) )?(\w+) : (.*),$/.exec(line);
        return { member: member.replace(/_$/, ""), type, least: Number(align ?? 1) };
      }),
    );
  }
  function spaceOf(type) {
    const plain = plainSpace(type);
    if (plain) return { ...plain, leaves: { "": 0 } };
    const array = /^array<(.*), (\d+)>$/.exec(type);
    if (array) {
      const one = spaceOf(array[1]);
      const stride = up(one.size, one.align);
      const leaves = {};
      for (let i = 0; i < Number(array[2]); ++i)
        for (const [path, at] of Object.entries(one.leaves)) leaves[`[${i}]${path}`] = i * stride + at;
      return { align: one.align, size: stride * Number(array[2]), leaves };
    }
    const members = structs.get(type);
    if (!members) throw new Error(`no struct ${type}`);
    let at = 0;
    let align = 1;
    const leaves = {};
    for (const { member, type: own, least } of members) {
      const one = spaceOf(own);
      const needed = Math.max(one.align, least);
      align = Math.max(align, needed);
      at = up(at, needed);
      for (const [path, place] of Object.entries(one.leaves)) leaves[`.${member}${path}`] = at + place;
      at += one.size;
    }
    return { align, size: up(at, align), leaves };
  }
  const { align, size, leaves } = spaceOf(name);
  const members = Object.fromEntries(Object.entries(leaves).map(([path, at]) => [path.slice(1), at]));
  return { size, align, members };
}
