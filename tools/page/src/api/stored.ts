// What this browser keeps of a page that is closed. A browser may forbid it; then nothing is kept.

/** What is kept under a name; undefined if nothing is, or it is damaged. */
export function stored<Value>(name: string): Value | undefined {
  try {
    return JSON.parse(localStorage.getItem(name) ?? "") as Value;
  } catch {
    return undefined;
  }
}

/** Keeps a value; undefined removes it. */
export function store(name: string, value: unknown): void {
  try {
    if (value === undefined) localStorage.removeItem(name);
    else localStorage.setItem(name, JSON.stringify(value));
  } catch {
    // It lasts as long as the tab is open.
  }
}

/** The names that begin with this, of all that is kept. */
export function storedNames(begin: string): string[] {
  try {
    return Object.keys(localStorage).filter((name) => name.startsWith(begin));
  } catch {
    return [];
  }
}
