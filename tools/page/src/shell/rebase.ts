// Merges an edit into what is on disk by now.

/** An edited record, and the record before the edit. */
export interface Edited<Value> {
  value: Value;
  was: Value;
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

/** The saved record with the fields that were changed here. */
export function rebased<Value>({ value, was }: Edited<Value>, saved: Value): Value {
  if (!isRecord(value) || !isRecord(was) || !isRecord(saved) || same(was, saved)) return value;
  const together: Record<string, unknown> = { ...saved };
  for (const name of names(was, value)) {
    if (same(was[name], value[name])) continue;
    if (value[name] === undefined) delete together[name];
    else together[name] = value[name];
  }
  return together as Value;
}

/** Whether a field on disk differs by now both from its value before the edit and from what was typed. */
export function collides<Value>({ value, was }: Edited<Value>, saved: Value): boolean {
  if (!isRecord(value) || !isRecord(was) || !isRecord(saved)) return !same(was, saved);
  return names(was, value).some(
    (name) =>
      !same(was[name], value[name]) &&
      !same(was[name], saved[name]) &&
      !same(value[name], saved[name]),
  );
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function names(first: object, second: object): string[] {
  return [...new Set([...Object.keys(first), ...Object.keys(second)])];
}
