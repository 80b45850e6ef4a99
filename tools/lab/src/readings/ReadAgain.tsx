// Marks that are only to be read again: nothing is cut, and the tape of a virtual machine reads them at once.
import { useState } from "preact/hooks";
import { type Project, send } from "../api/client";
import { useMachine } from "../shell/machine";
import { useProject } from "../shell/project";
import type { Form } from "./saves";

export function ReadAgain({ form }: { form: Form }) {
  const { take, setTrouble } = useProject();
  const machine = useMachine();
  const [busy, setBusy] = useState(false);
  if (form.again === 0) return null;
  const read = () => {
    setBusy(true);
    send<Project>("POST", "machine/readings", { form: form.file })
      .then(
        (project) => {
          take(project);
          setTrouble("");
        },
        (error: Error) => setTrouble(error.message),
      )
      .finally(() => setBusy(false));
  };
  return (
    <div class="read-again">
      <p>These marks are on the sheet already. Lay the tape anew for each reading.</p>
      {machine.kind === "virtual" && (
        <button type="button" class="primary" disabled={busy} onClick={read}>
          Let a tape read the {form.again} marks again
        </button>
      )}
    </div>
  );
}
