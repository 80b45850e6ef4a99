// Cuts marks: a grid, or places that somebody chose on the sheet.
import type { Picking } from "./picks";
import type { Game, Play } from "./state";

interface CutMarksParts extends Picking {
  play: Play;
  game: Game;
  placing: boolean;
  setPlacing: (placing: boolean) => void;
  places: [number, number][];
  setPlaces: (places: [number, number][]) => void;
}

const PLACES = "places";

export function CutMarks(parts: CutMarksParts) {
  const { play, game, placing, setPlacing, places, setPlaces, picks, pick } = parts;
  const wanted = picks.grid;
  const grid = game.cuts.find((cut) => cut.name === wanted);
  const count = placing ? places.length : (grid?.marks ?? 0);
  const minutes = placing
    ? game.place_cost.minutes + game.place_minutes * Math.max(0, places.length - 1)
    : (grid?.minutes ?? 0);
  const cut = async () => {
    await play.step("cut", placing ? { places } : { grid: wanted });
    setPlaces([]);
    setPlacing(false);
  };
  const choose = (name: string) => {
    setPlacing(name === PLACES);
    if (name !== PLACES) pick({ grid: name });
  };
  const enough = count <= game.marks_left && minutes <= game.minutes_left;
  return (
    <section class="cut-marks" aria-labelledby="cut-title">
      <h2 id="cut-title">Cut marks and read them</h2>
      <p class="asked">
        <label for="cut-what">Which</label>{" "}
        <select
          id="cut-what"
          value={placing ? PLACES : wanted}
          onChange={({ currentTarget }) => choose(currentTarget.value)}
        >
          {game.cuts.map((cost) => (
            <option key={cost.name} value={cost.name} disabled={!cost.allowed}>
              {cost.words}, {cost.minutes} minutes
            </option>
          ))}
          <option value={PLACES}>places that I choose on the sheet</option>
        </select>{" "}
        <button
          type="button"
          class={game.names.length === 0 ? "primary" : ""}
          disabled={play.busy || count === 0 || !enough}
          onClick={() => void cut()}
        >
          Move the virtual machine and cut {count} marks
        </button>{" "}
        {placing && places.length > 0 && (
          <button type="button" onClick={() => setPlaces([])}>
            Clear the places
          </button>
        )}
      </p>
      {placing && <p>Touch the sheet where a mark shall be. {minutes} minutes so far.</p>}
      {!enough && <p class="missing">That is more than is left.</p>}
    </section>
  );
}
