// Half a reading, or a text that is no length yet: kept in this browser until it is whole.
const PREFIX = "plumb-half:";
type Texts = readonly [string, string];

export function halfOf(place: string): Texts | undefined {
  try {
    return JSON.parse(localStorage.getItem(PREFIX + place) ?? "null") ?? undefined;
  } catch {
    return undefined; // a browser that forbids the storage
  }
}

export function keepHalf(place: string, texts: Texts): void {
  try {
    localStorage.setItem(PREFIX + place, JSON.stringify(texts));
  } catch {
    // A browser without room keeps it as long as the tab is open.
  }
}

export function forgetHalf(place: string): void {
  try {
    localStorage.removeItem(PREFIX + place);
  } catch {
    // Nothing was kept there.
  }
}
