import { fineNoiseScale, fineNoiseStart, latticeX, latticeY, latticeZ, windNoise, windsAlike, windWave } from "../generated/layout";
import { Defaults, Vec3 } from "../format/texts";
import { Block } from "./block";
import { cross, unit } from "./vector";

const eddyDrift: Vec3 = [0.48, 0.57, 0.67];
const windPeriod = 65536;

/** `x` less the nearest whole number of periods. */
const lessWhole = (x: number, period: number) => x - period * Math.round(x / period);
const number32 = (x: number) => Number(BigInt.asUintN(32, BigInt(Math.round(x))));
const point = (cell: number[]) =>
  (Math.imul(cell[0], latticeX) + Math.imul(cell[1], latticeY) + Math.imul(cell[2], latticeZ)) >>> 0;

/**
 * Writes the wind of a field's defaults at `time` [s]: a wave and gusts of noise, as sourcesOf(), together() and
 * phaseAt() in src/render/frame do. `extent` [m]: longest side of what is shown. `strength`: factor of the defaults'.
 */
export function writeWind(
  block: Block,
  wind: Defaults["wind"],
  origin: Vec3,
  extent: number,
  strength: number,
  time: number,
): void {
  const at = "environment.wind.";
  const sources = [
    { kind: windNoise, strength: wind.strength * wind.gustiness * strength, size: wind.gustSize },
    { kind: windWave, strength: wind.strength * (1 - wind.gustiness) * strength, size: wind.waveLength },
  ].filter((source) => source.strength > 0);
  const direction = unit(wind.direction, [1, 0, 0]);
  const side: Vec3 = Math.abs(direction[1]) < 0.99 ? unit(cross(direction, [0, 1, 0])) : [1, 0, 0];
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
    counts += 1 << (4 * source.kind);
    sum += source.strength;
    eddySize = Math.min(eddySize, 2 * source.size);
    eddySpeed = Math.max(eddySpeed, Math.abs(wind.speed));
    writePhase(block, `${at}phases[${i}].`, source.kind, direction, wind.speed / source.size, time);
  });
  block.words(`${at}counts`, [counts]);
  block.floats(`${at}eddySize`, [eddySize]);
  block.floats(`${at}eddySpeed`, [eddySpeed]);
  block.floats(`${at}sum`, [sum]);
  block.floats(`${at}eddyPhase`, eddyDrift.map((drift) => lessWhole((drift * eddySpeed * time) / eddySize, 1)));
  block.floats(`${at}lattice.origin`, origin.map((x) => lessWhole(x, windPeriod)));
  block.floats(`${at}lattice.x`, [1, 0, 0]);
  block.floats(`${at}lattice.y`, [0, 1, 0]);
  block.floats(`${at}lattice.z`, [0, 0, 1]);
}

function writePhase(block: Block, at: string, kind: number, direction: Vec3, pace: number, time: number): void {
  if (kind === windWave) {
    block.floats(`${at}angle`, [2 * Math.PI * lessWhole(pace * time, 20)]);
    return;
  }
  const cells = direction.map((along) => -along * pace * time);
  const whole = cells.map(Math.round);
  const fine = whole.map((cell) => fineNoiseScale * cell + fineNoiseStart);
  const wholeFine = fine.map(Math.round);
  block.floats(`${at}shift`, cells.map((cell, i) => cell - whole[i]));
  block.words(`${at}cell`, [point(whole.map(number32))]);
  block.floats(`${at}fineShift`, fine.map((cell, i) => cell - wholeFine[i]));
  block.words(`${at}fineCell`, [point(wholeFine.map(number32))]);
}
