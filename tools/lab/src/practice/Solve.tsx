// The end of a game: new numbers are sent, a second sheet is cut, and the secret is out.
import { type Picking, standing } from "./picks";
import type { Game, Play } from "./state";

export function Solve({ play, game, picks, pick }: { play: Play; game: Game } & Picking) {
  const { machine } = standing(picks, game);
  return (
    <section aria-labelledby="solve-title">
      <h2 id="solve-title">Solve it</h2>
      <p class="links">
        Think: <a href="#/verdict">Verdict</a> <a href="#/bench">Effects bench</a>
      </p>
      {machine ? (
        <p class="asked">
          {game.machines.length > 1 && (
            <>
              <label for="solve-with">Numbers</label>{" "}
              <select
                id="solve-with"
                value={machine}
                onChange={({ currentTarget }) => pick({ machine: currentTarget.value })}
              >
                {game.machines.map((name) => (
                  <option key={name}>{name}</option>
                ))}
              </select>{" "}
            </>
          )}
          <button
            type="button"
            class="primary"
            disabled={play.busy}
            onClick={() => void play.step("solve", { machine })}
          >
            Send {machine} and cut a second sheet: this ends the game
          </button>
        </p>
      ) : (
        <p class="missing">Write new numbers on the effects bench first; then send them here.</p>
      )}
    </section>
  );
}
