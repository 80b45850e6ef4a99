// Details of the mark that is pointed at.
import { Fragment } from "preact";
import { namedLength, shownLength, signedLength, useUnits, withMinus } from "../controls/lengths";
import type { Ends, Mark } from "./marks";
import type { Pair } from "./view";

interface CardParts {
  mark: Mark;
  error: Pair | null | undefined;
  chains: Ends | undefined;
}

export function MarkCard({ mark, error, chains }: CardParts) {
  const units = useUnits();
  const pair = (both: Pair) => withMinus(both.map((mm) => shownLength(mm, units)).join(", "));
  const chain = (mm: number | null) => (mm === null ? "not known" : signedLength(mm, units));
  const way = ([x, y]: Pair) => {
    const [across, up] = [shownLength(Math.abs(x), units, 2), shownLength(Math.abs(y), units, 2)];
    return `${across} ${x < 0 ? "left" : "right"}, ${up} ${y < 0 ? "down" : "up"}`;
  };
  const [left = null, right = null] = chains ?? [];
  const facts = [
    ["target", pair(mark.target)],
    ["read", mark.measured && pair(mark.measured)],
    ["error", error && way(error)],
    ["chains", (left !== null || right !== null) && `left ${chain(left)}, right ${chain(right)}`],
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
