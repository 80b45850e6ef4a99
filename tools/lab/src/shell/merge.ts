// Three states of the same thing brought together: what it was, what somebody made of it here, and what it is on
// disk by now. Records are merged name by name; what both sides changed to different values is a clash.

/** A place at which both sides changed something, as the names that lead there. */
export interface Clash {
  path: string[];
  mine: unknown;
  theirs: unknown;
}

export interface Merged<Value> {
  value: Value; // at a clash it holds mine, so that nothing disappears under the typing hand
  clashes: Clash[];
}

export function merge<Value>(was: Value, mine: Value, theirs: Value): Merged<Value> {
  const clashes: Clash[] = [];
  const value = merged(was, mine, theirs, [], clashes) as Value;
  return { value, clashes };
}

/** Whether both hold the same. A missing name and an undefined value are the same. */
export function same(first: unknown, second: unknown): boolean {
  if (Object.is(first, second)) return true;
  if (Array.isArray(first) && Array.isArray(second)) {
    return first.length === second.length && first.every((part, n) => same(part, second[n]));
  }
  if (!isRecord(first) || !isRecord(second)) return false;
  return names(first, second).every((name) => same(first[name], second[name]));
}

/** A copy of a value with something else at a place. */
export function withPlace<Value>(value: Value, path: readonly string[], part: unknown): Value {
  const [name, ...rest] = path;
  if (name === undefined) return part as Value;
  const record: Record<string, unknown> = isRecord(value) ? { ...value } : {};
  const changed = withPlace(record[name], rest, part);
  if (changed === undefined) delete record[name];
  else record[name] = changed;
  return record as Value;
}

function merged(
  was: unknown,
  mine: unknown,
  theirs: unknown,
  path: string[],
  clashes: Clash[],
): unknown {
  if (same(mine, theirs) || same(mine, was)) return theirs;
  if (same(theirs, was)) return mine;
  if (!isRecord(mine) || !isRecord(theirs)) {
    clashes.push({ path, mine, theirs });
    return mine;
  }
  const before = isRecord(was) ? was : {};
  const together: Record<string, unknown> = {};
  for (const name of names(mine, theirs)) {
    const part = merged(before[name], mine[name], theirs[name], [...path, name], clashes);
    if (part !== undefined) together[name] = part;
  }
  return together;
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function names(first: object, second: object): string[] {
  return [...new Set([...Object.keys(first), ...Object.keys(second)])];
}
