// Which numbers "Accept all" takes: those that a real machine can have.

interface Believable {
  name: string;
  possible: boolean;
}

export function believable(numbers: readonly Believable[]): string[] {
  return numbers.filter(({ possible }) => possible).map(({ name }) => name);
}

/** What is accepted once all of these are; what was accepted by hand stays. */
export function withAll(accepted: readonly string[], names: readonly string[]): string[] {
  return [...new Set([...accepted, ...names])];
}
