// Marks to read again without cutting; on a virtual machine they are read at once.
import { Do } from "../shell/doing";
import { useMachine } from "../shell/machine";
import { useTell } from "../shell/project";
import type { Form } from "./saves";

export function ReadAgain({ form }: { form: Form }) {
  const tell = useTell();
  const machine = useMachine();
  if (form.again === 0) return null;
  return (
    <div class="read-again">
      <p>These marks are on the sheet already. Lay the tape anew for each reading.</p>
      {machine.kind === "virtual" && (
        <Do isNext work={() => tell("machine/readings", { form: form.file })}>
          Let a tape read the {form.again} marks again
        </Do>
      )}
    </div>
  );
}
