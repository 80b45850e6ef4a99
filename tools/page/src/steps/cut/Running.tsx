// How far a cut is that runs: marks, minutes, and what the machine last said; where it waits for you.
import { capital } from "../../controls/words";
import type { Machine } from "../../shell/machine";
import { marksBefore, minutesAt, type Round } from "./round";

export function Running({ round, machine }: { round: Round; machine: Machine }) {
  const { program, kind } = machine;
  const [lines, total] = [program?.done ?? 0, program?.total ?? 1];
  const left = Math.ceil(minutesAt(round, total) - minutesAt(round, lines));
  const pause = round.pauses.find((each) => each.lines > lines);
  return (
    <>
      <p class="soft">
        <output class="large">{marksBefore(round, lines)}</output> of {round.marks.length} marks
        {/* A virtual machine is as fast as it was asked to be. */}
        {kind === "board" && left > 0 && `, ${left} min left`}
      </p>
      {pause && (
        <p>
          The next pause comes after mark {marksBefore(round, pause.lines)}: {pause.do}.
        </p>
      )}
    </>
  );
}

export function Pauses({ round }: { round: Round }) {
  if (round.pauses.length === 0) return null;
  return (
    <div class="pauses">
      <p>The program waits until you press Go on:</p>
      <ol>
        {round.pauses.map((pause) => (
          <li key={pause.lines}>{capital(pause.do)}.</li>
        ))}
      </ol>
    </div>
  );
}
