// Marks that are only to be read again: nothing is cut, and the tape of a virtual machine reads them at once.
import { type Project, send } from "../api/client";
import { useDo } from "../shell/doing";
import { useMachine } from "../shell/machine";
import { useProject } from "../shell/project";
import type { Form } from "./saves";

export function ReadAgain({ form }: { form: Form }) {
  const { take } = useProject();
  const machine = useMachine();
  const [busy, run, refusal] = useDo();
  if (form.again === 0) return null;
  const read = async () =>
    take(await send<Project>("POST", "machine/readings", { form: form.file }));
  return (
    <div class="read-again">
      <p>These marks are on the sheet already. Lay the tape anew for each reading.</p>
      {machine.kind === "virtual" && (
        <button type="button" class="primary" disabled={busy} onClick={() => void run(read)}>
          Let a tape read the {form.again} marks again
        </button>
      )}
      {refusal}
    </div>
  );
}
