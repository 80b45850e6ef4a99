// Half a reading, or a text that is not yet a length: kept in this browser until it is whole. It does not count.
const PREFIX = "plumb-half:";
export type Texts = readonly [string, string];

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
export function halfOf({ key, file, index }: HalfPlace, edges: string): Texts | undefined {
  const half = stored(key)[`${file}:${index}`];
  return half?.edges === edges ? half.texts : undefined;
}

/** Keeps half a reading; without one it is forgotten. */
export function keepHalf({ key, file, index }: HalfPlace, half: Half | undefined): void {
  const { [`${file}:${index}`]: _, ...others } = stored(key);
  const all = half ? { ...others, [`${file}:${index}`]: half } : others;
  try {
    localStorage.setItem(PREFIX + key, JSON.stringify(all));
  } catch {
    // A browser without room keeps it as long as the tab is open.
  }
}

/** The marks of a folder of which half a reading waits here. */
export function allHalves(key: string): { file: string; index: number }[] {
  return Object.keys(stored(key)).map((name) => {
    const [file = "", index = ""] = name.split(":");
    return { file, index: Number(index) };
  });
}

function stored(key: string): Record<string, Half> {
  try {
    return JSON.parse(localStorage.getItem(PREFIX + key) ?? "{}");
  } catch {
    return {}; // a browser that forbids the storage
  }
}
