// The marks of a state: their noise circles, an effect's pattern, arrows, and names.
import { arrowPath } from "./Axes";
import type { Mark, State } from "./marks";
import { useScale } from "./scale";
import type { Pair } from "./view";

export const BEYOND_NOISE = 2.45; // sigmas: noise alone makes a longer error in 5 % of the marks
const FEW = 30; // marks that all have their names, if there is room
const ROOMY = 500; // [px] of a sheet that has room for them

interface MarksParts {
  marks: readonly Mark[];
  state: State | undefined;
  ghosts: readonly (Pair | null)[] | undefined;
  /** An effect's pattern, below the errors. */
  print: readonly (Pair | null)[] | undefined;
  factor: number;
  sigma: number | undefined;
  selected: number | undefined;
}

export function Marks(parts: MarksParts) {
  const { marks, state, ghosts, print, factor, sigma = 0, selected } = parts;
  const { at, px } = useScale();
  const tip = ({ target: [x, y] }: Mark, [dx, dy]: Pair) => at([x + dx * factor, y + dy * factor]);
  return (
    <>
      {print && (
        <g class="print">
          {marks.map((mark, i) => {
            const [from, to] = [at(mark.target), tip(mark, print[i] ?? [0, 0])];
            return <path key={i} d={`M${from.join(" ")}L${to.join(" ")}`} />;
          })}
        </g>
      )}
      {marks.map((mark, i) => {
        const [x, y] = at(mark.target);
        const error = state?.errors[i];
        const ghost = ghosts?.[i];
        const usual = state?.promised?.[i] ?? BEYOND_NOISE * sigma;
        const isBeyond = error && Math.hypot(...error) > usual;
        return (
          <g key={i}>
            {error && usual > 0 && (
              <circle class="noise" cx={x} cy={y} r={Math.max(2, usual * factor * px)} />
            )}
            {ghost && <path class="arrow ghost" d={arrowPath([x, y], tip(mark, ghost))} />}
            {error ? (
              <path
                class={`arrow ${mark.isDoubted ? "doubted" : isBeyond ? "beyond" : "within"}`}
                d={arrowPath([x, y], tip(mark, error))}
              />
            ) : (
              <Spot look={mark.look ?? "waits"} at={[x, y]} />
            )}
            {error && <circle class="place" cx={x} cy={y} r={2.5} fill="var(--ink)" />}
            {mark.isDoubted && <circle class="doubt" cx={x} cy={y} r={14} />}
            {i === selected && <circle class="lit" cx={x} cy={y} r={13} />}
          </g>
        );
      })}
      <Names marks={marks} selected={selected} />
    </>
  );
}

/** A mark without an arrow. */
export function Spot({ look, at: [x, y] }: { look: NonNullable<Mark["look"]>; at: Pair }) {
  return <circle class={`spot ${look}`} cx={x} cy={y} r={look === "faint" ? 3 : 6} />;
}

/** All marks are named if there is room; otherwise the chosen, the doubted and those in the corners. */
function Names({ marks, selected }: { marks: readonly Mark[]; selected: number | undefined }) {
  const { plot, at } = useScale();
  const isRoomy = plot.right - plot.left > ROOMY && marks.length <= FEW;
  const corners = cornersOf(marks);
  const seen = new Set<string>();
  return (
    <g class="names">
      {marks.map(({ name, target, look, isDoubted }, i) => {
        const isFirst = i === selected || isDoubted || corners.has(i);
        if (!isFirst && !(isRoomy && look !== "faint")) return null;
        if (seen.has(name)) return null;
        seen.add(name);
        const [x, y] = at(target);
        const isRight = x > (plot.left + plot.right) / 2;
        return (
          <text
            key={i}
            x={isRight ? x - 7 : x + 7}
            y={y - 7}
            text-anchor={isRight ? "end" : "start"}
          >
            {name}
          </text>
        );
      })}
    </g>
  );
}

/** The marks nearest to the four corners. */
function cornersOf(marks: readonly Mark[]): Set<number> {
  const corners = new Set<number>();
  for (const [right, up] of [
    [1, 1],
    [1, -1],
    [-1, 1],
    [-1, -1],
  ] as const) {
    const far = marks.map(({ target: [x, y] }) => right * x + up * y);
    corners.add(far.indexOf(Math.max(...far)));
  }
  return corners;
}
