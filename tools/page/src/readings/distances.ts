// Changes to a list of distances that still apply after the list has grown.

interface Distance {
  between: [string, string];
  length: number;
}

/** The list with a distance replaced; or removed, without a replacement. */
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

/** Distances that were not asked for, or were measured once more. */
export function beyond<Each extends Distance>(
  distances: readonly Each[],
  spans: readonly (readonly string[])[],
): Each[] {
  const asked = new Set(spans.map((span) => lengthBetween(distances, span)));
  return distances.filter((each) => !asked.has(each));
}

/** The list with this length between two marks in place of the old; or without them, if there is no length. */
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
