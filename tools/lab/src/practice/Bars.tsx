// What is left of the budget.
import type { Game } from "./state";

export function Bars({ game }: { game: Game }) {
  return (
    <dl class="budget">
      <Bar words="marks left" left={game.marks_left} of={game.marks} />
      <Bar words="minutes left" left={game.minutes_left} of={game.minutes} />
    </dl>
  );
}

function Bar({ words, left, of }: { words: string; left: number; of: number }) {
  const id = words.replace(" ", "-");
  return (
    <div>
      <dt>
        <label for={id}>{words}</label>
      </dt>
      <dd>
        <meter id={id} min={0} max={of} low={of * 0.2} value={left} />
        <b>{Math.floor(left)}</b> of {of}
      </dd>
    </div>
  );
}
