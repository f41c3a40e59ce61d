// Colours of the report. Static is blue and dynamic is orange everywhere: they differ for colour-blind eyes too.

export const stateColour = { static: "#2f6396", dynamic: "#d2601a" };
export const measuredColour = "#1d2329";

// The stress scale: lightness rises evenly from dark blue to pale yellow while the hue turns through green,
// so that equal steps of stress look equal, in print without colour too. Anchors are lightness, chroma and
// hue in OKLCh; they are interpolated there and turned into sRGB.
const anchors: [number, number, number][] = [
  [0.38, 0.145, 275], [0.47, 0.125, 255], [0.56, 0.105, 225], [0.65, 0.115, 180],
  [0.74, 0.155, 148], [0.83, 0.175, 122], [0.92, 0.175, 104],
];

function oklchToSrgb(lightness: number, chroma: number, hue: number): [number, number, number] {
  const a = chroma * Math.cos((hue * Math.PI) / 180);
  const b = chroma * Math.sin((hue * Math.PI) / 180);
  const long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const medium = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const short = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [
    4.0767416621 * long - 3.3077115913 * medium + 0.2309699292 * short,
    -1.2684380046 * long + 2.6097574011 * medium - 0.3413193965 * short,
    -0.0041960863 * long - 0.7034186147 * medium + 1.707614701 * short,
  ];
  return linear.map((value) => {
    const inside = Math.min(Math.max(value, 0), 1);
    return inside <= 0.0031308 ? 12.92 * inside : 1.055 * inside ** (1 / 2.4) - 0.055;
  }) as [number, number, number];
}

// The scale of differences: from blue over nearly white to red, as far from white at both ends, so that the eye
// finds what is less and what is more. Colour-blind eyes tell blue from red, and paper without colour white from both.
const less: [number, number, number][] = [[0.40, 0.15, 262], [0.58, 0.13, 255], [0.77, 0.08, 245], [0.96, 0, 245]];
const more: [number, number, number][] = [[0.96, 0, 50], [0.77, 0.10, 50], [0.58, 0.17, 38], [0.40, 0.15, 28]];

export type Rgb = [number, number, number];
export type ColourScale = (share: number) => Rgb;

function mixed(among: [number, number, number][], share: number): Rgb {
  const place = Math.min(Math.max(share, 0), 1) * (among.length - 1);
  const low = Math.min(Math.floor(place), among.length - 2);
  const part = place - low;
  return oklchToSrgb(...among[low].map((value, i) => value + part * (among[low + 1][i] - value)) as Rgb);
}

/** sRGB (0 to 1) of a share (0 to 1) of the scale of stress. */
export const scaleColour: ColourScale = (share) => mixed(anchors, share);

/** sRGB of a share of the scale of differences; a half is no difference. */
export const differenceColour: ColourScale = (share) => share < 0.5 ? mixed(less, 2 * share) : mixed(more, 2 * share - 1);

export function scaleCss(share: number, colour: ColourScale = scaleColour): string {
  return `rgb(${colour(share).map((value) => Math.round(value * 255)).join(",")})`;
}
