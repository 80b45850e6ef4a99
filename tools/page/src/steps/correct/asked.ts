// Which numbers of a correction are asked about: those that would change, and those that are accepted; and which of them
// are accepted all at once.

interface Asked {
  name: string;
  before: string;
  after: string;
}

interface Made<Number> {
  numbers: readonly Number[];
  with_accepted: readonly Number[];
}

/** Each as it would become with what is accepted. A number that would be shown as it was is left out. */
export function asked<Number extends Asked>(
  { numbers, with_accepted }: Made<Number>,
  accepted: readonly string[],
): Number[] {
  const again = new Map(with_accepted.map((number) => [number.name, number]));
  return numbers
    .map((number) => again.get(number.name) ?? number)
    .filter(({ name, before, after }) => before !== after || accepted.includes(name));
}

interface Believable {
  name: string;
  possible: boolean;
}

/** Those that "Accept all" takes: a real machine can have them. */
export function believable(numbers: readonly Believable[]): string[] {
  return numbers.filter(({ possible }) => possible).map(({ name }) => name);
}

/** What is accepted once all of these are; what was accepted by hand stays. */
export function withAll(accepted: readonly string[], names: readonly string[]): string[] {
  return [...new Set([...accepted, ...names])];
}
