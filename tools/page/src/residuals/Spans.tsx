// Measured distances: a line for each, thicker for a larger error, and a table.
import type { Schemas } from "../api/client";
import { shownLength, signedLength, useUnits } from "../controls/lengths";
import { Table } from "../controls/Table";
import type { Mark } from "../sheet/marks";
import { useScale } from "../sheet/scale";
import type { Pair } from "../sheet/view";

export type Span = Schemas["Span"];
type State = Schemas["State"];

export const BEYOND_NOISE = 1.96; // sigmas: noise alone makes a larger error in 5 %
const [THIN, THICK] = [2, 12]; // [px]

interface SpanParts {
  spans: readonly Span[];
  state: State;
  doubted: readonly number[];
  sigma: number; // [mm] of a reading
}

/** How a distance is drawn, by its error. */
function kindOf(error: number | null | undefined, isDoubted: boolean, sigma: number): string {
  if (isDoubted || error == null) return "doubted";
  if (Math.abs(error) <= BEYOND_NOISE * sigma) return "within";
  return error > 0 ? "longer" : "shorter";
}

interface LineParts extends SpanParts {
  /** The state whose largest error is the thickest. */
  scale: State;
}

export function SpanLines({ spans, state, doubted, sigma, scale }: LineParts) {
  const { at } = useScale();
  const sure = [scale, state].flatMap((each) =>
    each.spans.filter((_, i) => !doubted.includes(i)).map((error) => Math.abs(error ?? 0)),
  );
  const most = Math.max(...sure, BEYOND_NOISE * sigma);
  return (
    <g class="span-errors">
      {spans.map(({ ends: [from, to] }, i) => {
        const [error, isDoubted] = [state.spans[i], doubted.includes(i)];
        const [[x1, y1], [x2, y2]] = [at(from), at(to)];
        const share = isDoubted ? 0 : Math.min(1, Math.abs(error ?? 0) / most);
        return (
          <g key={i} class={kindOf(error, isDoubted, sigma)}>
            <line
              {...{ x1, y1, x2, y2 }}
              stroke="currentColor"
              stroke-linecap="round"
              stroke-dasharray={isDoubted ? "10 8" : undefined}
              stroke-width={THIN + (THICK - THIN) * share}
            />
            {isDoubted && <circle class="doubt" cx={(x1 + x2) / 2} cy={(y1 + y2) / 2} r={14} />}
          </g>
        );
      })}
    </g>
  );
}

/** Ends of distances that have no error of their own. */
export function endsOf(spans: readonly Span[], known: ReadonlySet<string>): Mark[] {
  const places = new Map<string, Pair>();
  for (const { between, ends } of spans) {
    for (const i of [0, 1] as const) if (!known.has(between[i])) places.set(between[i], ends[i]);
  }
  return [...places].map(([name, target]) => ({ name, target, look: "faint" }));
}

/** The errors in figures, the largest first. */
export function SpanTable({ spans, state, doubted, sigma }: SpanParts) {
  const units = useUnits();
  if (spans.length === 0) return null;
  const rows = spans.map((span, i) => ({
    span,
    error: state.spans[i],
    kind: kindOf(state.spans[i], doubted.includes(i), sigma),
  }));
  rows.sort((a, b) => Math.abs(b.error ?? 0) - Math.abs(a.error ?? 0));
  return (
    <section class="taped-errors" aria-labelledby="taped-title">
      <h2 id="taped-title">
        Distances: {state.title} [{units}]
      </h2>
      <p class="keys row">
        <span class="key longer">longer than it should be</span>
        <span class="key shorter">shorter</span>
        <span class="key within">within noise</span>
        {doubted.length > 0 && <span class="key doubted">to be read again</span>}
      </p>
      <Table
        names={["between", "measured", "off by"]}
        tone={(row) => rows[row]?.kind}
        rows={rows.map(({ span, error }) => [
          span.between.join(" and "),
          shownLength(span.measured, units),
          error == null ? "read it again" : signedLength(error, units),
        ])}
      />
    </section>
  );
}
