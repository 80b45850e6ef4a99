// The effects' patterns in the errors that the frame leaves.
import { get, type Schemas } from "../api/client";
import { useAsked } from "../shell/asked";

export type Drawn = Schemas["BenchDrawn"];

/** Asked again for another board; undefined without effects. */
export function useDrawn(effects: readonly string[], board: string): Drawn | undefined {
  const names = effects.map((effect) => `effects=${encodeURIComponent(effect)}`).join("&");
  const ask = names ? () => get<Drawn>(`bench/drawn?${names}`) : undefined;
  const { answer, looking } = useAsked(ask, `${names} ${board}`);
  return names && !looking ? answer : undefined;
}
