// When each mark and each pause of a cut comes, and how far it is.
import type { Grid } from "../Cut";
import { marksBefore, minutesAt } from "./times";

const NAMED = 5; // every so many marks

export function TimeLine({ grid, taken }: { grid: Grid; taken: number }) {
  const whole = minutesAt(grid, Number.POSITIVE_INFINITY);
  if (!whole) return null;
  const left = (lines: number) => `left: ${((100 * minutesAt(grid, lines)) / whole).toFixed(1)}%`;
  const minutes = (lines: number) => `${Math.round(minutesAt(grid, lines))} min`;
  return (
    <figure class="time-line box">
      <figcaption class="spoken">
        Mark by mark, {Math.round(whole)} minutes without the pauses
      </figcaption>
      <div class="line" style={`--now: ${(100 * minutesAt(grid, taken)) / whole}%`}>
        {grid.marks.map(({ name, lines }, i) => (
          <span key={name} class={lines <= taken ? "mark cut" : "mark"} style={left(lines)}>
            {(i === 0 || (i + 1) % NAMED === 0) && <small>{i === 0 ? `mark ${name}` : name}</small>}
          </span>
        ))}
        {grid.pauses.map((pause) => (
          <span key={pause.lines} class="pause" style={left(pause.lines)} title={pause.do}>
            <small>
              pause after mark {marksBefore(grid, pause.lines)}, {minutes(pause.lines)}
            </small>
          </span>
        ))}
        {taken > 0 && (
          <span class="now" style={left(taken)}>
            <b>now, {minutes(taken)}</b>
          </span>
        )}
        <span class="end">{Math.round(whole)} min</span>
      </div>
    </figure>
  );
}
