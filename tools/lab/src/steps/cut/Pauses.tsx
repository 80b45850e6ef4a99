// Where the program waits for a person, and what is to be done there.
import type { Grid } from "../Cut";

export function Pauses({ grid }: { grid: Grid }) {
  if (grid.pauses.length === 0) return null;
  return (
    <div class="pauses">
      <p>The program waits {times(grid.pauses.length)} until you press Go on:</p>
      <ol>
        {grid.pauses.map((pause) => (
          <li key={pause.lines}>{sentence(pause.do)}</li>
        ))}
      </ol>
    </div>
  );
}

/** What is to be done, as a sentence. */
export function sentence(words: string): string {
  return `${words.charAt(0).toUpperCase()}${words.slice(1)}.`;
}

function times(count: number): string {
  return count === 1 ? "once" : count === 2 ? "twice" : `${count} times`;
}
