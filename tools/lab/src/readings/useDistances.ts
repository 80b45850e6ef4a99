// Saves the distances of a form; says whether the server took them.
import { type Schemas, send } from "../api/client";
import { useProject } from "../shell/project";
import type { Form } from "./useReadings";

export type Distance = Schemas["AskedDistance"];

export function useDistances(
  form: Form,
  take: (form: Form) => void,
): (distances: Distance[]) => Promise<boolean> {
  const { setTrouble, reload } = useProject();
  return async (distances) => {
    try {
      const body: Schemas["TypedDistances"] = { file: form.file, digest: form.digest, distances };
      take(await send<Form>("PUT", "distances", body));
      setTrouble("");
      await reload();
      return true;
    } catch (error) {
      setTrouble(error instanceof Error ? error.message : String(error));
      return false;
    }
  };
}
