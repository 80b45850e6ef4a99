// Saves of a form: its readings, distances and tape. Each waits for the one before.
import { lineOf, type Schemas, send } from "../api/client";
import { useProject } from "../shell/project";
import { Succession } from "../shell/succession";

export type Form = Schemas["ReadingsAnswer"];
const forms = new Map<string, Succession<Form>>(); // of this tab, by file

/** The saves of the form in a file. */
export function savesOf(file: string): Succession<Form> {
  const saves = forms.get(file) ?? new Succession<Form>();
  forms.set(file, saves);
  return saves;
}

/** Saves a part of a form, which may go by the form that the saves before it left. */
export function useSave(
  form: Form,
  take: (form: Form) => void,
): (path: string, part: (now: Form) => object) => Promise<void> {
  const { setTrouble, reload } = useProject();
  const { file } = form;
  return async (path, part) => {
    try {
      const put = (now: Form) =>
        send<Form>("PUT", path, { file, digest: now.digest, ...part(now) });
      take(await savesOf(file).save(form, put));
      setTrouble("");
      await reload();
    } catch (error) {
      await reload(); // to show what was saved elsewhere
      setTrouble(lineOf(error));
    }
  };
}
