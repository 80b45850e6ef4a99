// Details of the mark that is pointed at.
import { Fragment } from "preact";
import { namedLength, shownLength, type Unit } from "../controls/lengths";
import type { Ends, Mark } from "./marks";
import type { Pair } from "./view";

interface CardParts {
  mark: Mark;
  error: Pair | null | undefined;
  chains: Ends | undefined;
  units: Unit;
}

export function MarkCard({ mark, error, chains, units }: CardParts) {
  const pair = ([x, y]: Pair) => `${minus(x, units)}, ${minus(y, units)}`;
  const [left = null, right = null] = chains ?? [];
  const facts = [
    ["target", pair(mark.target)],
    ["read", mark.measured && pair(mark.measured)],
    ["error", error && way(error, units)],
    [
      "chains",
      (left !== null || right !== null) &&
        `left ${chain(left, units)}, right ${chain(right, units)}`,
    ],
    ["tape", mark.also],
  ];
  return (
    <>
      <b>Mark {mark.name}</b>
      {error && <b> {namedLength(Math.hypot(...error), units, 2)} off</b>}
      <dl>
        {facts.map(
          ([name, said]) =>
            said && (
              <Fragment key={name}>
                <dt>{name}</dt>
                <dd>{said}</dd>
              </Fragment>
            ),
        )}
      </dl>
    </>
  );
}

function minus(mm: number, units: Unit, digits = 1): string {
  return shownLength(mm, units, digits).replace("-", "\u2212");
}

function way([x, y]: Pair, units: Unit): string {
  const [across, up] = [shownLength(Math.abs(x), units, 2), shownLength(Math.abs(y), units, 2)];
  return `${across} ${x < 0 ? "left" : "right"}, ${up} ${y < 0 ? "down" : "up"}`;
}

function chain(mm: number | null, units: Unit): string {
  if (mm === null) return "not known";
  return `${mm > 0 ? "+" : ""}${minus(mm, units, 2)}`;
}
