// What else an owner can do: read a mark again, measure a number directly, take a hint.
import { type Picking, standing } from "./picks";
import type { Game, Play } from "./state";

interface MoreToDoParts extends Picking {
  play: Play;
  game: Game;
}

export function MoreToDo(parts: MoreToDoParts) {
  const { play, game } = parts;
  return (
    <section class="more-to-do" aria-labelledby="more-title">
      <h2 id="more-title">Look closer</h2>
      {game.names.length > 0 && <ReadAgain {...parts} />}
      <Check {...parts} />
      {game.hints.length > 0 && (
        <ul class="hints">
          {game.hints.map((hint) => (
            <li key={hint}>{hint}</li>
          ))}
        </ul>
      )}
      <p>
        <button
          type="button"
          disabled={play.busy || !game.more_hints}
          onClick={() => void play.step("hint")}
        >
          Take a hint: {game.hint_minutes} minutes
        </button>
      </p>
    </section>
  );
}

function ReadAgain({ play, game, picks, pick }: MoreToDoParts) {
  const name = standing(picks, game).mark;
  return (
    <p class="asked">
      <label for="read-again">Mark</label>{" "}
      <select
        id="read-again"
        value={name}
        onChange={({ currentTarget }) => pick({ mark: currentTarget.value })}
      >
        {game.names.map((each) => (
          <option key={each}>{each}</option>
        ))}
      </select>{" "}
      <button
        type="button"
        disabled={play.busy || game.minutes_left < game.read_minutes}
        onClick={() => void play.step("read", { names: [name] })}
      >
        Read it again: {game.read_minutes} minutes
      </button>
    </p>
  );
}

function Check({ play, game, picks, pick }: MoreToDoParts) {
  const chosen = standing(picks, game).check;
  const check = game.checks.find((each) => each.name === chosen);
  return (
    <p class="asked">
      <label for="check-what">Directly</label>{" "}
      <select
        id="check-what"
        value={chosen}
        onChange={({ currentTarget }) => pick({ check: currentTarget.value })}
      >
        {game.checks.map((each) => (
          <option key={each.name} value={each.name} disabled={!each.allowed}>
            {each.words}, {each.minutes} minutes
          </option>
        ))}
      </select>{" "}
      <button
        type="button"
        disabled={play.busy || !check?.allowed}
        onClick={() => void play.step("check", { name: chosen })}
      >
        Measure it
      </button>
    </p>
  );
}
