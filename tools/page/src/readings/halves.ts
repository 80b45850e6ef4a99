// Half readings, and texts that are not yet lengths: kept in this browser until complete. They do not count.
import { store, stored } from "../api/stored";

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

/** What was typed for a mark, from these edges. */
export function halfOf({ key, file, index }: HalfPlace, edges: string): Texts | undefined {
  const half = halvesOf(key)[`${file}:${index}`];
  return half?.edges === edges ? half.texts : undefined;
}

/** Stores half a reading, or removes it if there is none. */
export function keepHalf({ key, file, index }: HalfPlace, half: Half | undefined): void {
  const { [`${file}:${index}`]: _, ...others } = halvesOf(key);
  const all = half ? { ...others, [`${file}:${index}`]: half } : others;
  store(PREFIX + key, all);
}

/** The marks of a folder with half a reading here. */
export function allHalves(key: string): { file: string; index: number }[] {
  return Object.keys(halvesOf(key)).map((name) => {
    const [file = "", index = ""] = name.split(":");
    return { file, index: Number(index) };
  });
}

function halvesOf(key: string): Record<string, Half> {
  return stored(PREFIX + key) ?? {};
}
