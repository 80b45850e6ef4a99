// Errors of the marks before and after, side by side at one scale, with a circle of noise at each tip.
import { useState } from "preact/hooks";
import { Exaggeration } from "../../controls/Exaggeration";
import { namedLength, type Unit } from "../../controls/lengths";
import { Arrow } from "../../sheet/Arrow";
import { SheetMap, usePixel } from "../../sheet/SheetMap";
import type { Size, VerdictParts } from "./words";

interface MapsParts {
  verdict: VerdictParts;
  sheet: Size;
  units: Unit;
}

export function ErrorMaps({ verdict, sheet, units }: MapsParts) {
  const [exaggeration, setExaggeration] = useState(() => usual(verdict, sheet));
  if (verdict.before.length === 0) return null;
  const one = { sheet, sigma: verdict.sigma, exaggeration };
  const { rms_added, noise_added } = verdict;
  const added = verdict.added ? `the frame and ${verdict.added}` : "the frame";
  return (
    <section class="maps" aria-label="Errors of the marks">
      <div class="pair">
        <OneMap
          {...one}
          title={`As set: ${namedLength(verdict.rms_set, units, 2)}`}
          arrows={verdict.before}
          colour="var(--before)"
        />
        {rms_added !== null && noise_added !== null && (
          <OneMap
            {...one}
            title={`With ${added} fitted: ${namedLength(rms_added, units, 2)}. Noise alone leaves ${namedLength(noise_added, units, 2)}`}
            arrows={verdict.after}
            colour="var(--after)"
          />
        )}
      </div>
      <Exaggeration value={exaggeration} change={setExaggeration} />
      <p class="legend">
        Both maps have the same scale. A circle is one sigma of a reading: grey arrows are shorter
        than two, and mean nothing.
      </p>
    </section>
  );
}

interface OneMapParts {
  title: string;
  sheet: Size;
  sigma: number;
  exaggeration: number;
  arrows: VerdictParts["before"];
  colour: string;
}

function OneMap({ title, sheet, sigma, exaggeration, arrows, colour }: OneMapParts) {
  return (
    <figure>
      <figcaption>{title}</figcaption>
      <SheetMap sheet={sheet} label={title}>
        {arrows.map((arrow, index) => {
          const [x, y] = arrow.place;
          const [dx, dy] = arrow.error;
          const small = Math.hypot(dx, dy) < 2 * sigma;
          return (
            <g key={`${arrow.name}/${index}`}>
              <Noise
                at={[x + dx * exaggeration, y + dy * exaggeration]}
                radius={sigma * exaggeration}
              />
              <Arrow
                from={[x, y]}
                to={[x + dx, y + dy]}
                exaggeration={exaggeration}
                colour={small ? "var(--ghost)" : colour}
                label={`Mark ${arrow.name}: ${dx.toFixed(1)} right, ${dy.toFixed(1)} up, mm`}
              />
            </g>
          );
        })}
      </SheetMap>
    </figure>
  );
}

function Noise({ at, radius }: { at: Size; radius: number }) {
  const pixel = usePixel();
  return (
    <circle
      cx={at[0]}
      cy={-at[1]}
      r={radius}
      fill="var(--ghost)"
      fill-opacity={0.15}
      stroke="var(--ghost)"
      stroke-width={pixel}
    />
  );
}

/** An exaggeration at which the larger arrows are a tenth of the sheet. */
function usual(verdict: VerdictParts, sheet: Size): number {
  const most = Math.max(...verdict.before.map(({ error }) => Math.hypot(...error)), 0.1);
  const wanted = (0.12 * sheet[0]) / most;
  return [1, 2, 5, 10, 20, 50, 100, 200].filter((round) => round <= wanted).at(-1) ?? 1;
}
