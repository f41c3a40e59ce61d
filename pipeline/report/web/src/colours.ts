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

/** sRGB (0 to 1) of a share (0 to 1) of the scale. */
export function scaleColour(share: number): [number, number, number] {
  const place = Math.min(Math.max(share, 0), 1) * (anchors.length - 1);
  const low = Math.min(Math.floor(place), anchors.length - 2);
  const part = place - low;
  const mixed = anchors[low].map((value, i) => value + part * (anchors[low + 1][i] - value));
  return oklchToSrgb(mixed[0], mixed[1], mixed[2]);
}

export function scaleCss(share: number): string {
  return `rgb(${scaleColour(share).map((value) => Math.round(value * 255)).join(",")})`;
}
