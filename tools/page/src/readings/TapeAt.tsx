// The tape at a mark as it was read, and what the other marks say. Nothing is expected before both edges are read.
import { useRef } from "preact/hooks";
import { lengthText, MM, shownLength, useUnits } from "../controls/lengths";
import { ticks, tickText } from "../sheet/view";
import type { OthersSay } from "./useDoubts";
import type { Form } from "./useReadings";

const [WIDE, HIGH] = [220, 34]; // [px]
const WINDOWS = { mm: 25, inch: 25.4 }; // [mm] of tape in view
const FINE = { mm: 1, inch: 1 / 16 };

interface TapeAtParts {
  form: Form;
  open: number;
  others: readonly OthersSay[];
}

export function TapeAt({ form, open, others }: TapeAtParts) {
  const units = useUnits();
  // While the next mark waits, the one before it is compared.
  const last = useRef(open);
  if (form.marks[open]?.read) last.current = open;
  const mark = form.marks[last.current];
  const said = others.find(({ index }) => index === last.current);
  const [upright, across] = form.edges.split("-");
  if (!mark || form.spans.length > 0) return null;
  return (
    <section class="tape-at box only-wide" aria-label={`Tape at mark ${mark.name}`}>
      <p>
        <b>Tape at mark {mark.name}</b>
        <small>against what the other marks say</small>
      </p>
      {[across, upright].map((edge, axis) => {
        const read = mark.read?.[axis];
        const by = said?.place[axis];
        return (
          <figure key={edge}>
            <figcaption>
              from {edge} {read !== undefined && <b>{lengthText(read, units)}</b>}
            </figcaption>
            {read === undefined ? (
              <p class="awaits soft">type it first, then compare</p>
            ) : (
              <Strip read={read} by={by} within={said?.within[axis] ?? 0} />
            )}
            <small>
              {read !== undefined && by !== undefined && `the others say ${shownLength(by, units)}`}
            </small>
          </figure>
        );
      })}
    </section>
  );
}

/** A piece of tape around a reading, pale where the others expect it. */
function Strip({ read, by, within }: { read: number; by: number | undefined; within: number }) {
  const units = useUnits();
  const [unit, wide] = [MM[units], WINDOWS[units]];
  const [low, high] = [read - wide / 2, read + wide / 2];
  const x = (mm: number) => (WIDE * (mm - low)) / wide;
  const fine = FINE[units];
  const first = Math.ceil(low / unit / fine);
  const lines = Array.from({ length: Math.floor(high / unit / fine) - first + 1 }, (_, i) => {
    const long = (first + i) % (units === "mm" ? 5 : 8) === 0 ? 13 : 7;
    return `M${x((first + i) * fine * unit).toFixed(1)} 0v${long}`;
  });
  return (
    <svg viewBox={`0 0 ${WIDE} ${HIGH}`} aria-hidden="true">
      <rect width={WIDE} height={HIGH} fill="#f3d25a" />
      {by !== undefined && (
        <rect
          fill="#fdf3cc"
          x={x(by - within)}
          width={x(by + within) - x(by - within)}
          height={HIGH}
        />
      )}
      <path d={lines.join("")} stroke="#3a3000" />
      {ticks(low / unit, high / unit, 4).map((tick) => (
        <text key={tick} x={x(tick * unit)} y={HIGH - 5} text-anchor="middle" style="fill: #201a00">
          {tickText(tick)}
        </text>
      ))}
      <path d={`M${WIDE / 2} 0V${HIGH}`} stroke="#005a8c" stroke-width={3} />
    </svg>
  );
}
