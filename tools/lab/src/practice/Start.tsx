// Chooses a level and begins a game.
import { type Picking, seedOf } from "./picks";
import type { Play } from "./state";

export function Start({ play, picks, pick }: { play: Play } & Picking) {
  const { level, seed } = picks;
  const again = play.practice?.game != null;
  const begin = () => void play.step("start", { level, seed: seedOf(picks) });
  return (
    <form
      class="start"
      onSubmit={(event) => {
        event.preventDefault();
        begin();
      }}
    >
      <fieldset>
        <legend>What is hidden</legend>
        {play.practice?.levels.map(({ number, words }) => (
          <label key={number} class="level">
            <input
              type="radio"
              name="level"
              checked={level === number}
              onChange={() => pick({ level: number })}
            />
            <b>{number}</b> {words}
          </label>
        ))}
      </fieldset>
      <details>
        <summary>Play a certain machine</summary>
        <label>
          Its number{" "}
          <input
            inputMode="numeric"
            value={seed}
            placeholder="drawn"
            onInput={({ currentTarget }) => pick({ seed: currentTarget.value })}
          />
        </label>
      </details>
      <button type="submit" class="primary" disabled={play.busy}>
        {again ? "Begin another game: this one is cleared away" : "Begin a game"}
      </button>
    </form>
  );
}
