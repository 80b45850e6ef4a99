// Which numbers of a correction to show: those that would change, and those that are accepted.

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
