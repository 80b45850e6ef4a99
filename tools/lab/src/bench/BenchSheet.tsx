// The marks of the bench on the sheet: an arrow for each error, a ghost for the state before, a circle for the noise.
import { Arrow } from "../sheet/Arrow";
import { SheetMap, usePixel } from "../sheet/SheetMap";
import type { Bench } from "./live";
import { nearest } from "./nearest";
import type { Pair } from "./views";

const BEYOND_NOISE = 2.45; // sigmas: noise alone makes a longer error in 5 % of the marks

interface BenchSheetParts {
  bench: Bench;
  title: string;
  errors: readonly Pair[];
  ghosts: readonly Pair[] | undefined;
  exaggeration: number;
  selected: number | undefined;
  select: (mark: number | undefined) => void;
}

export function BenchSheet(parts: BenchSheetParts) {
  const { bench, title, errors, selected, select } = parts;
  const pick = (event: MouseEvent) => {
    const places = bench.marks.map(({ measured: [x, y] }) => [x, -y] as const);
    select(nearest(event, (event.currentTarget as Element).querySelector("svg"), places));
  };
  const name = selected === undefined ? "" : `. Mark ${bench.marks[selected]?.name} is selected`;
  return (
    // biome-ignore lint/a11y/useKeyWithClickEvents: the list of marks below does it by keyboard
    // biome-ignore lint/a11y/noStaticElementInteractions: the same
    <div class="bench-sheet" onClick={pick}>
      <SheetMap sheet={bench.sheet} label={`${title}: ${errors.length} marks${name}`}>
        <Marks {...parts} />
      </SheetMap>
    </div>
  );
}

function Marks({ bench, errors, ghosts, exaggeration, selected }: BenchSheetParts) {
  const pixel = usePixel();
  const noise = bench.sigma ?? 0;
  const tip = (i: number, [dx, dy]: Pair): Pair => {
    const [x, y] = bench.marks[i]?.measured ?? [0, 0];
    return [x + dx, y + dy];
  };
  return (
    <>
      {ghosts?.map((error, i) => (
        <Arrow
          key={i}
          from={tip(i, [0, 0])}
          to={tip(i, error)}
          exaggeration={exaggeration}
          colour="var(--ghost)"
        />
      ))}
      {errors.map((error, i) => {
        const [x, y] = tip(i, [error[0] * exaggeration, error[1] * exaggeration]);
        const beyond = Math.hypot(...error) > BEYOND_NOISE * noise;
        const colour = beyond ? "var(--before)" : "var(--after)";
        return (
          <g key={i}>
            {noise > 0 && (
              <circle
                cx={x}
                cy={-y}
                r={noise * exaggeration}
                fill="none"
                stroke="var(--ghost)"
                stroke-width={pixel}
                stroke-dasharray={`${3 * pixel} ${3 * pixel}`}
              />
            )}
            <Arrow
              from={tip(i, [0, 0])}
              to={tip(i, error)}
              exaggeration={exaggeration}
              colour={colour}
              label={bench.marks[i]?.name ?? ""}
            />
          </g>
        );
      })}
      {selected !== undefined && bench.marks[selected] && (
        <circle
          class="lit"
          cx={bench.marks[selected].measured[0]}
          cy={-bench.marks[selected].measured[1]}
          r={11 * pixel}
          stroke-width={4 * pixel}
        />
      )}
    </>
  );
}
