// Changes of a list of distances, each said so that it holds however the list has grown.

interface Distance {
  between: readonly string[];
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

function isSame(first: Distance, second: Distance): boolean {
  return first.length === second.length && first.between.join("\n") === second.between.join("\n");
}
