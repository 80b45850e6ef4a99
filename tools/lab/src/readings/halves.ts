// Half a reading, or a text that is no length yet: kept in this browser until it is whole. It does not count.
const PREFIX = "plumb-half:";
type Texts = readonly [string, string];

/** A mark of a form, in the folder with this key. */
export interface HalfPlace {
  key: string;
  file: string;
  index: number;
}

interface Half {
  edges: string; // from which it was typed
  texts: Texts;
}

/** What is typed of a mark from these edges. */
export function halfOf(place: HalfPlace, edges: string): Texts | undefined {
  const half = halfIn(nameOf(place));
  return half?.edges === edges ? half.texts : undefined;
}

export function keepHalf(place: HalfPlace, edges: string, texts: Texts): void {
  try {
    localStorage.setItem(nameOf(place), JSON.stringify({ edges, texts } satisfies Half));
  } catch {
    // A browser without room keeps it as long as the tab is open.
  }
}

export function forgetHalf(place: HalfPlace): void {
  try {
    localStorage.removeItem(nameOf(place));
  } catch {
    // Nothing was kept there.
  }
}

/** The marks of a folder of which half a reading waits here. */
export function allHalves(key: string): HalfPlace[] {
  const start = `${PREFIX}${key}:`;
  return stored()
    .filter((name) => name.startsWith(start))
    .map((name) => {
      const [file = "", index = ""] = name.slice(start.length).split(":");
      return { key, file, index: Number(index) };
    });
}

function nameOf({ key, file, index }: HalfPlace): string {
  return `${PREFIX}${key}:${file}:${index}`;
}

function halfIn(name: string): Half | undefined {
  try {
    return JSON.parse(localStorage.getItem(name) ?? "null") ?? undefined;
  } catch {
    return undefined; // a browser that forbids the storage
  }
}

function stored(): string[] {
  try {
    return Object.keys(localStorage);
  } catch {
    return [];
  }
}
