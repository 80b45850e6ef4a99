// One thing at a time, asked for by a button.
import { useState } from "preact/hooks";
import { useProject } from "./project";

/** Whether something is being done, and what does it; what is refused is shown. */
export function useDo(): [boolean, (work: () => Promise<unknown>) => void] {
  const { setTrouble } = useProject();
  const [busy, setBusy] = useState(false);
  const run = (work: () => Promise<unknown>) => {
    setBusy(true);
    work()
      .then(
        () => setTrouble(""),
        (error: Error) => setTrouble(error.message),
      )
      .finally(() => setBusy(false));
  };
  return [busy, run];
}
