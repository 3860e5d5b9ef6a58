import { Vec3 } from "../format/texts";
import { clamp, cross, dot, scaled, size, unit, add } from "./vector";

/** Sun and sky, as the settings of a frame have them (src/render/frame/frame_settings.h). */
export interface Light {
  /** Unit, towards the sun. */
  sunDirection: Vec3;
  sunColor: Vec3;
  skyColor: Vec3;
  groundColor: Vec3;
  /** Factor of the exposure. */
  adaptation: number;
}

/** Usual values of FrameSettings. */
export const usualLight: Light = {
  sunDirection: unit([0.72, 0.62, -0.42]),
  sunColor: [3.4, 2.85, 2.1],
  skyColor: [0.42, 0.6, 0.92],
  groundColor: [0.2, 0.23, 0.11],
  adaptation: 1,
};

const extinction: Vec3 = [0.08, 0.14, 0.26];
const afterglow = 0.0375;
const twilightFold = 6;
const darkest = 0.04;
const leafProjection = 0.5;
const maxAdaptation = 2;
const usualElevation = (Math.asin(usualLight.sunDirection[1]) * 180) / Math.PI;

const each = (f: (i: number) => number): Vec3 => [f(0), f(1), f(2)];

function airMass(elevation: number): number {
  const above = Math.max(elevation, 0);
  return 1 / (Math.sin((above * Math.PI) / 180) + 0.50572 * Math.pow(above + 6.07995, -1.6364));
}

function scattered(elevation: number): Vec3 {
  const rise = Math.max(Math.sin((elevation * Math.PI) / 180), 0);
  const factor = Math.sqrt(rise * rise + afterglow * afterglow);
  return each((i) => factor * (1 - Math.exp(-extinction[i] * airMass(elevation))));
}

function skyShare(elevation: number): Vec3 {
  if (elevation >= usualElevation) return [1, 1, 1];
  const own = scattered(elevation);
  const usual = scattered(usualElevation);
  return each((i) => {
    const share = own[i] / usual[i];
    return elevation >= 0 ? share : Math.max(share * Math.exp(elevation / twilightFold), darkest);
  });
}

function sunColorAt(elevation: number): Vec3 {
  const more = airMass(elevation) - airMass(usualElevation);
  return each((i) => usualLight.sunColor[i] * Math.exp(-extinction[i] * more));
}

/** The light of a sun at azimuth and elevation [degrees], as setLightByElevation() does; `up` is the ground's. */
export function lightAt(azimuth: number, elevation: number, up: Vec3): Light {
  const a = (azimuth * Math.PI) / 180;
  const e = (elevation * Math.PI) / 180;
  const share = skyShare(elevation);
  const lowered = Math.min(elevation, usualElevation);
  const low = elevation > 0 ? sunColorAt(lowered) : ([0, 0, 0] as Vec3);
  const loweredShare = skyShare(lowered);
  const groundColor = each((i) => {
    const sky = 0.5 * 1.25 * usualLight.skyColor[i];
    return (
      (usualLight.groundColor[i] * (leafProjection * low[i] + sky * loweredShare[i])) /
      (leafProjection * usualLight.sunColor[i] + sky)
    );
  });
  const luminance = (c: Vec3) => dot(c, [0.2126, 0.7152, 0.0722]);
  const left = luminance(groundColor) / luminance(usualLight.groundColor);
  return {
    sunDirection: turnedWith(up, [Math.sin(a) * Math.cos(e), Math.sin(e), -Math.cos(a) * Math.cos(e)]),
    sunColor: elevation > 0 ? sunColorAt(elevation) : [0, 0, 0],
    skyColor: each((i) => usualLight.skyColor[i] * share[i]),
    groundColor,
    adaptation: Math.min(1 / Math.sqrt(left), maxAdaptation),
  };
}

/** Azimuth and elevation of the usual sun [degrees]. */
export const usualSun = {
  azimuth: (Math.atan2(usualLight.sunDirection[0], -usualLight.sunDirection[2]) * 180) / Math.PI,
  elevation: usualElevation,
};

/** `direction` turned as +y is to `up` (unit), by the shortest way. */
export function turnedWith(up: Vec3, direction: Vec3): Vec3 {
  const cosine = up[1];
  if (cosine < -0.9999) return [direction[0], -direction[1], -direction[2]];
  const axis = cross([0, 1, 0], up);
  const once = cross(axis, direction);
  return add(add(direction, once), scaled(cross(axis, once), 1 / (1 + cosine)));
}

/** How warm the sky is, by the sine of the sun's elevation. */
export function lowSunOf(rise: number): number {
  const t = clamp(rise / 0.59, 0, 1);
  return Math.pow(1 - t * t * (3 - 2 * t), 0.6);
}

/** Up direction of the sky at `eye`: against gravity. */
export function skyUpOf(direction: Vec3, attractor: Vec3, blend: number, eye: Vec3): Vec3 {
  const way: Vec3 = [attractor[0] - eye[0], attractor[1] - eye[1], attractor[2] - eye[2]];
  const pull = size(way) > 0 ? unit(way) : direction;
  return unit(
    each((i) => -(direction[i] * (1 - blend) + pull[i] * blend)),
    scaled(direction, -1),
  );
}
