// What effects draw into what the frame leaves.
import { useEffect, useState } from "preact/hooks";
import { get, type Schemas } from "../api/client";

export type Drawn = Schemas["BenchDrawn"];

/** Asked again for another board; nothing for no effect. */
export function useDrawn(effects: readonly string[], board: string): Drawn | undefined {
  const [drawn, setDrawn] = useState<Drawn>();
  const asked = effects.map((effect) => `effects=${encodeURIComponent(effect)}`).join("&");
  useEffect(() => {
    setDrawn(undefined);
    if (!asked) return;
    let stale = false;
    get<Drawn>(`bench/drawn?${asked}`).then(
      (answer) => stale || setDrawn(answer),
      () => undefined,
    );
    return () => {
      stale = true;
    };
  }, [asked, board]);
  return drawn;
}
