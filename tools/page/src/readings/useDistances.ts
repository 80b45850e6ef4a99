// Saves the distances of a form; returns whether the server accepted them.
import type { Schemas } from "../api/client";
import { type Form, useSave } from "./saves";

export type Distance = Schemas["AskedDistance"];
/** The change, applied to the distances as they are by then. */
export type Change = (distances: Distance[]) => Distance[];

export function useDistances(
  form: Form,
  take: (form: Form) => void,
): (change: Change) => Promise<boolean> {
  const save = useSave(form, take);
  return (change) =>
    save("distances", (now): Omit<Schemas["TypedDistances"], "file" | "digest"> => {
      return { distances: change(now.distances) };
    });
}
