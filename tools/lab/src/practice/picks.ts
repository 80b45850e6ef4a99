// What is picked on the screen of practice, and the commands that do the same.
import type { Game } from "./state";

/** Empty: nothing was picked, and the first of the list counts. */
export interface Picks {
  level: number;
  seed: string;
  grid: string; // of marks, like 5x5; empty: places on the sheet
  mark: string; // to be read again
  check: string; // what to measure directly
  machine: string; // whose numbers are sent
}

export interface Picking {
  picks: Picks;
  pick: (change: Partial<Picks>) => void;
}

/** The picks as they count in a game: a name that is gone gives way to the first. */
export function standing(picks: Picks, game: Game): Picks {
  const first = (name: string, names: string[]) => (names.includes(name) ? name : (names[0] ?? ""));
  return {
    ...picks,
    mark: first(picks.mark, game.names),
    check: first(
      picks.check,
      game.checks.map((check) => check.name),
    ),
    machine: first(picks.machine, game.machines),
  };
}

export const seedOf = ({ seed }: Picks) => (/^\d+$/.test(seed) ? Number(seed) : null);

/** The commands for what can be done now, a line each. */
export function commands(picks: Picks, game: Game | null | undefined, placing: boolean): string {
  if (!game || game.score) {
    const seed = seedOf(picks);
    const drawn = seed === null ? "" : ` --seed ${seed}`;
    return `plumb practice start . --level ${picks.level}${drawn}`;
  }
  const now = standing(picks, game);
  const lines = [
    placing ? "" : `measure . ${now.grid}`,
    now.mark && `read . ${now.mark}`,
    now.check && `check . ${now.check}`,
    game.more_hints ? "hint ." : "",
    now.machine && game.names.length > 0 ? `solve . ${now.machine}` : "",
  ];
  return lines
    .filter(Boolean)
    .map((line) => `plumb practice ${line}`)
    .join("\n");
}
