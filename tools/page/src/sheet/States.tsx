// The states to compare, each with its error and a small sheet of its arrows; a press shows it.
import { namedLength, shownLength, useUnits } from "../controls/lengths";
import { Segments } from "../controls/Segments";
import type { Mark, State } from "./marks";
import type { Pair } from "./view";

const WIDE = 76; // [px] of a small sheet

interface StatesParts {
  states: readonly State[];
  shown: number;
  show: (index: number) => void;
  size: Pair;
  marks: readonly Mark[];
  /** How many times longer than life the arrows of each state are. */
  factors: readonly number[];
}

export function States({ states, shown, show, size, marks, factors }: StatesParts) {
  const units = useUnits();
  return (
    <Segments
      class="states"
      legend="What is drawn"
      chosen={shown}
      choose={show}
      options={states.map((state, i) => [
        i,
        <>
          <span class="words">
            <small>{state.title} </small>
            {state.fit_rms !== undefined && <b>{namedLength(state.fit_rms, units, 2)}</b>}
            {state.noise_rms != null && <i> noise {shownLength(state.noise_rms, units, 2)}</i>}
          </span>
          <Small {...{ size, marks, state }} factor={factors[i] ?? 1} />
        </>,
      ])}
    />
  );
}

/** The sheet of a state, small: its arrows alone. */
function Small(parts: { size: Pair; marks: readonly Mark[]; state: State; factor: number }) {
  const { size, marks, state, factor } = parts;
  const px = WIDE / size[0];
  const at = ([x, y]: Pair) =>
    `${(WIDE / 2 + x * px).toFixed(1)} ${((size[1] / 2 - y) * px).toFixed(1)}`;
  const arrows = marks.map(({ target: [x, y], isDoubted }, i) => {
    const [dx, dy] = (!isDoubted && state.errors[i]) || [0, 0];
    return `M${at([x, y])}L${at([x + factor * dx, y + factor * dy])}`;
  });
  return (
    <svg class="small" viewBox={`0 0 ${WIDE} ${(size[1] * px).toFixed(1)}`} aria-hidden="true">
      <rect class="wood" width={WIDE} height={size[1] * px} />
      <path d={arrows.join("")} />
    </svg>
  );
}
