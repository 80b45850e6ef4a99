// The readings on the sheet: an arrow from where each mark was sent to where it is.

import { Arrow } from "../sheet/Arrow";
import { SheetMap, usePixel } from "../sheet/SheetMap";
import { isAgain } from "./layout";
import type { Form } from "./useReadings";

const LONGEST = 0.09; // of the sheet's width, for an arrow of usual length
const ROUND = [1, 2, 5, 10, 20, 50, 100, 200];

interface MapParts {
  form: Form;
  doubted: ReadonlySet<number>;
}

export function ReadingsMap({ form, doubted }: MapParts) {
  const corner = form.edges.split("-");
  const read = form.marks.filter((mark) => mark.place);
  const exaggeration = exaggerationFor(read, form.sheet[0]);
  const [width, height] = form.sheet;
  const fromEdges = form.spans.length === 0 || read.length > 0;
  const x = corner[1] === "left" ? -width / 2 : width / 2;
  const y = corner[0] === "top" ? -height / 2 : height / 2;
  return (
    <figure class="readings-map">
      <SheetMap sheet={form.sheet} label={`${read.length} readings on the sheet`}>
        {fromEdges && (
          <g stroke="var(--act)" class="edges">
            <line x1={-width / 2} x2={width / 2} y1={y} y2={y} />
            <line y1={-height / 2} y2={height / 2} x1={x} x2={x} />
          </g>
        )}
        <Taped form={form} />
        {form.marks.map((mark, index) => (
          <Spot
            key={mark.index}
            at={mark.target}
            name={isAgain(form.marks, index) ? "" : mark.name}
            read={!!mark.place}
            doubted={doubted.has(mark.index)}
          />
        ))}
        {read.map((mark) => (
          <Arrow
            key={mark.index}
            from={mark.target}
            to={mark.place as [number, number]}
            exaggeration={exaggeration}
            colour={doubted.has(mark.index) ? "var(--warn)" : "var(--before)"}
            label={`Mark ${mark.name}`}
          />
        ))}
      </SheetMap>
      <figcaption>
        {read.length > 0 && `Arrows are ${exaggeration} times longer than life. `}
        {fromEdges ? "Blue: the edges you measure from." : "Dashed: the distances to measure."}
      </figcaption>
    </figure>
  );
}

/** The distances that are asked for. */
function Taped({ form }: { form: Form }) {
  const pixel = usePixel();
  const places = new Map(form.marks.map((mark) => [mark.name, mark.target]));
  return (
    <g stroke="var(--soft)" stroke-width={pixel} stroke-dasharray={`${5 * pixel}`}>
      {form.spans.map(([from, to]) => {
        const [start, end] = [places.get(from), places.get(to)];
        if (!start || !end) return null;
        const [x1, y1, x2, y2] = [start[0], -start[1], end[0], -end[1]];
        return <line key={`${from} to ${to}`} x1={x1} y1={y1} x2={x2} y2={y2} />;
      })}
    </g>
  );
}

interface SpotParts {
  at: readonly [number, number];
  name: string;
  read: boolean;
  doubted: boolean;
}

function Spot({ at, name, read, doubted }: SpotParts) {
  const pixel = usePixel();
  const [x, y] = [at[0], -at[1]];
  return (
    <g>
      {!read && (
        <circle cx={x} cy={y} r={4 * pixel} fill="none" stroke="var(--soft)" stroke-width={pixel} />
      )}
      {doubted && (
        <circle
          cx={x}
          cy={y}
          r={14 * pixel}
          fill="none"
          stroke="var(--warn)"
          stroke-width={3 * pixel}
        />
      )}
      <text x={x + 7 * pixel} y={y + 17 * pixel} font-size={14 * pixel} fill="var(--soft)">
        {name}
      </text>
    </g>
  );
}

/** A round number that makes the middle arrow easy to see. */
function exaggerationFor(read: Form["marks"], width: number): number {
  const lengths = read
    .map((mark) =>
      Math.hypot(mark.target[0] - (mark.place?.[0] ?? 0), mark.target[1] - (mark.place?.[1] ?? 0)),
    )
    .sort((a, b) => a - b);
  const middle = lengths[Math.floor(lengths.length / 2)] ?? 1;
  const most = (LONGEST * width) / Math.max(middle, 0.1);
  return ROUND.filter((round) => round <= most).at(-1) ?? 1;
}
