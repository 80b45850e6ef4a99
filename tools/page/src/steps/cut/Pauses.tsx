// Where the program waits for you, and what to do there.
import { capital } from "../../controls/words";
import type { Grid } from "../Cut";

export function Pauses({ grid }: { grid: Grid }) {
  if (grid.pauses.length === 0) return null;
  return (
    <div class="pauses">
      <p>The program waits until you press Go on:</p>
      <ol>
        {grid.pauses.map((pause) => (
          <li key={pause.lines}>{capital(pause.do)}.</li>
        ))}
      </ol>
    </div>
  );
}
