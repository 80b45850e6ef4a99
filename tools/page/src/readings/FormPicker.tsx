// Chooses the form to type into, or imports a file of readings.
import { sendFile } from "../api/client";
import { Select } from "../controls/Field";
import { Do } from "../shell/doing";
import { useMachine } from "../shell/machine";
import { PickFile } from "../shell/PickFile";
import { useProject, useTell } from "../shell/project";
import type { Form } from "./useReadings";

interface FormPickerParts {
  form: Form;
  choose: (name: string) => void;
}

/** The forms of the folder, where there are several. */
export function FormPicker({ form, choose }: FormPickerParts) {
  if (form.files.length === 0)
    return (
      <p>
        There are no marks yet. <a href="#/measure">Choose marks</a> and cut them first, or open a
        file that has readings.
      </p>
    );
  if (form.files.length === 1) return null;
  return (
    <Select
      label="Form"
      options={form.files.map((file) => [
        file.name,
        `${file.name}: ${file.read} of ${file.asked} read`,
      ])}
      chosen={form.file}
      choose={choose}
    />
  );
}

/** Imports a file of readings; folded away when a form is open. */
export function FileOfReadings({ form, choose }: FormPickerParts) {
  const { reload } = useProject();
  const picker = (
    <PickFile
      title="Open a file of readings"
      hint="a form, or a table of a spreadsheet"
      accept=".toml,.csv,.ini"
      take={async (file) => {
        choose((await sendFile<Form>("marks", file)).file);
        await reload();
      }}
    />
  );
  if (form.files.length === 0) return picker;
  return (
    <details>
      <summary>Readings from a file</summary>
      {picker}
    </details>
  );
}

/** Marks to read again without cutting; on a virtual machine they are read at once. */
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
