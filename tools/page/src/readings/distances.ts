// Changes of a list of distances, each said so that it holds however the list has grown.

interface Distance {
  between: [string, string];
  length: number;
}

/** The list with something else at the place of a distance; without anything it is taken out. */
export function withInstead<Each extends Distance>(
  distances: readonly Each[],
  old: Each,
  ...instead: Each[]
): Each[] {
  const place = distances.findIndex((each) => isSame(each, old));
  return place < 0 ? [...distances, ...instead] : distances.toSpliced(place, 1, ...instead);
}

/** The first distance between two marks, whichever end is named first. */
export function lengthBetween<Each extends Distance>(
  distances: readonly Each[],
  span: readonly string[],
): Each | undefined {
  return distances.find((each) => isBetween(each, span));
}

/** Distances that nobody asked for, or that were measured once more. */
export function beyond<Each extends Distance>(
  distances: readonly Each[],
  spans: readonly (readonly string[])[],
): Each[] {
  const asked = new Set(spans.map((span) => lengthBetween(distances, span)));
  return distances.filter((each) => !asked.has(each));
}

/** The list with this length between two marks instead of what it says of them; without any it is taken out. */
export function withLength(
  distances: readonly Distance[],
  span: [string, string],
  length: number | undefined,
): Distance[] {
  const old = lengthBetween(distances, span);
  const instead = length === undefined ? [] : [{ between: span, length }];
  return old ? withInstead(distances, old, ...instead) : [...distances, ...instead];
}

function isBetween(distance: Distance, span: readonly string[]): boolean {
  return [...distance.between].sort().join("\n") === [...span].sort().join("\n");
}

function isSame(first: Distance, second: Distance): boolean {
  return first.length === second.length && first.between.join("\n") === second.between.join("\n");
}
