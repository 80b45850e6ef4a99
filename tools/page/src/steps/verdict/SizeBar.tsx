// A fitted size with its interval, drawn on the range that real machines have.
import type { Schemas } from "../../api/client";

const ROOM = 8; // percent left and right of what is drawn

export function SizeBar({ size }: { size: Schemas["Size"] }) {
  const known = [...size.limits, size.low, size.high, size.value, 0];
  const ends = known.filter((end): end is number => end !== null);
  const [least, most] = [Math.min(...ends), Math.max(...ends)];
  const at = (value: number) => ROOM + ((100 - 2 * ROOM) * (value - least)) / (most - least || 1);
  const [from, to] = [at(size.limits[0] ?? least), at(size.limits[1] ?? most)];
  const sure = size.low !== null && size.high !== null ? `M${at(size.low)} 5H${at(size.high)}` : "";
  return (
    <figure class="size">
      <figcaption>{size.said}</figcaption>
      <svg viewBox="0 0 100 10" preserveAspectRatio="none" aria-hidden="true">
        <rect x={from} y={2} width={to - from} height={6} fill="var(--line)" />
        <line
          x1={at(0)}
          x2={at(0)}
          y1={0}
          y2={10}
          stroke="var(--soft)"
          vector-effect="non-scaling-stroke"
        />
        <path
          vector-effect="non-scaling-stroke"
          stroke-width={4}
          d={`${sure}M${at(size.value)} 1V9`}
          stroke="var(--act)"
        />
      </svg>
      {size.range_said && (
        <small class={size.possible ? "" : "wrong"}>
          {size.possible ? "Real machines have" : "Impossible: real machines have"}{" "}
          {size.range_said}
        </small>
      )}
    </figure>
  );
}
