// A reading and the number it stands for: factor * curve(reading - zero), each with its uncertainty.

export type Curve = "straight" | "square" | "tangent squared";

/** How a number is read. */
export interface Way {
  zero: number;
  factor: number;
  curve: Curve;
}

/** A number, or a reading, and how far it may be off. */
export interface Value {
  value: number;
  sigma: number;
}

const DEGREE = Math.PI / 180;
const straight = (number: number) => number;
const CURVES: Record<Curve, [(read: number) => number, (value: number) => number]> = {
  straight: [straight, straight],
  square: [(read) => read * read, (value) => Math.sqrt(Math.max(value, 0))],
  "tangent squared": [
    (read) => Math.tan(read * DEGREE) ** 2,
    (value) => Math.atan(Math.sqrt(Math.max(value, 0))) / DEGREE,
  ],
};

/** The number for a reading. */
export function numberOf({ zero, factor, curve }: Way, read: Value): Value {
  const [bend] = CURVES[curve];
  const from = read.value - zero;
  return { value: factor * bend(from), sigma: Math.abs(factor) * rise(bend, from, read.sigma) };
}

/** The reading for a number. */
export function readingOf({ zero, factor, curve }: Way, known: Value): Value {
  const [bend, straighten] = CURVES[curve];
  const from = straighten(known.value / factor);
  const sigma = known.sigma / Math.abs(factor);
  return { value: zero + from, sigma: rise(straighten, bend(from), sigma) };
}

/** How much more a function is so far beyond a number; of a straight line without the noise of a difference. */
function rise(bend: (number: number) => number, from: number, sigma: number): number {
  if (bend === straight) return sigma;
  return bend(Math.abs(from) + sigma) - bend(Math.abs(from));
}

interface Named {
  name: string;
  by: string;
}

/** What is known when a number becomes another: what was divided by the square of the old is by that of the new. */
export function withKnown(
  known: Readonly<Record<string, Value>>,
  numbers: readonly Named[],
  { name, value, usual }: { name: string; value: Value | undefined; usual: number },
): Record<string, Value> {
  const before = known[name];
  const others: Record<string, Value> = { ...known };
  delete others[name];
  const share = ((before?.value ?? usual) / (value?.value ?? usual)) ** 2;
  for (const number of numbers) {
    const old = others[number.name];
    if (number.by === name && old && Number.isFinite(share))
      others[number.name] = { value: old.value * share, sigma: old.sigma * share };
  }
  return value ? { ...others, [name]: value } : others;
}
