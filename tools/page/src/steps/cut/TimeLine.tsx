// When each mark and each pause of a cut comes, and how far it is.
import { marksBefore, minutesAt, type Round } from "./round";

const NAMED = 5; // every so many marks
const NEAR_END = 0.85; // of the whole time: from there on "now" stands where the end is named
const [FIRST, LAST] = [6, 92]; // [%] of the width, from the start to the end

export function TimeLine({ round, taken }: { round: Round; taken: number }) {
  const whole = minutesAt(round, Number.POSITIVE_INFINITY);
  if (!whole) return null;
  const at = (lines: number) =>
    `${(FIRST + ((LAST - FIRST) * minutesAt(round, lines)) / whole).toFixed(2)}%`;
  const minutes = (lines: number) => `${Math.round(minutesAt(round, lines))} min`;
  const [end, now] = [`${LAST}%`, at(taken)];
  return (
    <svg
      class="time-line box only-wide"
      role="img"
      aria-label={`Mark by mark, ${Math.round(whole)} minutes without pauses`}
    >
      <g stroke-width={4} stroke-linecap="round">
        <line x1={at(0)} x2={end} y1={26} y2={26} stroke="var(--line)" />
        {taken > 0 && <line x1={at(0)} x2={now} y1={26} y2={26} stroke="var(--act)" />}
      </g>
      <g text-anchor="middle">
        {round.marks.map(({ name, lines }, i) => {
          const isCut = lines <= taken;
          return (
            <g key={name}>
              <circle
                cx={at(lines)}
                cy={26}
                r={5}
                fill={isCut ? "var(--act)" : "var(--paper)"}
                stroke={isCut ? "var(--act)" : "var(--soft)"}
              />
              {(i === 0 || (i + 1) % NAMED === 0) && (
                <text x={at(lines)} y={48}>
                  {i === 0 ? `mark ${name}` : name}
                </text>
              )}
            </g>
          );
        })}
        {round.pauses.map(({ lines }) => (
          <g key={lines}>
            <circle cx={at(lines)} cy={26} r={7} fill="var(--warn)" />
            <text x={at(lines)} y={13}>
              pause after mark {marksBefore(round, lines)}, {minutes(lines)}
            </text>
          </g>
        ))}
        {taken > 0 && (
          <text x={now} y={13} font-weight={600}>
            now, {minutes(taken)}
          </text>
        )}
        {minutesAt(round, taken) < NEAR_END * whole && (
          <text x={end} y={13}>
            {Math.round(whole)} min
          </text>
        )}
      </g>
    </svg>
  );
}
