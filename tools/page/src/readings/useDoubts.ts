// Asks which readings disagree, a moment after each change.
import { get, type Schemas } from "../api/client";
import { type Asked, useAsked } from "../shell/asked";
import type { Form } from "./useReadings";

export type Doubt = Schemas["Doubted"];
type Answer = Schemas["DoubtsAnswer"];
const PAUSE_MS = 500;

/** The previous answer stays visible, so that rings do not flicker. */
export function useDoubts(
  form: Form | undefined,
): Omit<Asked<unknown>, "answer"> & Pick<Answer, "doubts" | "compared"> {
  const { file = "", digest = "" } = form ?? {};
  const isEmpty = !form?.distances.length && !form?.marks.some((mark) => mark.read);
  const ask = () => get<Answer>(`doubts?file=${encodeURIComponent(file)}`);
  const { answer, ...asked } = useAsked(isEmpty ? undefined : ask, `${file} ${digest}`, PAUSE_MS);
  const isOfForm = !isEmpty && !asked.refused && answer?.file === file;
  return { ...asked, ...(isOfForm ? answer : { doubts: [], compared: "" }) };
}
