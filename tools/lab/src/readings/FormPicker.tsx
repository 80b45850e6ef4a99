// Which form is typed into, and a file of marks from elsewhere.
import { sendFile } from "../api/client";
import { useProject } from "../shell/project";
import type { Form } from "./useReadings";

interface FormPickerParts {
  form: Form;
  choose: (name: string) => void;
}

export function FormPicker({ form, choose }: FormPickerParts) {
  const { setTrouble, reload } = useProject();
  const pick = async (input: HTMLInputElement) => {
    const file = input.files?.[0];
    if (!file) return;
    try {
      const answer = await sendFile<Form>("marks", file);
      choose(answer.file);
      setTrouble("");
      await reload();
    } catch (error) {
      setTrouble(error instanceof Error ? error.message : String(error));
    }
    input.value = "";
  };
  const picker = (
    <label class="pick">
      Open a file of readings
      <input
        type="file"
        accept=".toml,.csv,.ini"
        onChange={(event) => void pick(event.currentTarget)}
      />
    </label>
  );
  if (form.files.length === 0) {
    return (
      <div class="form-picker">
        <p>
          There are no marks yet. <a href="#/measure">Choose marks</a> and cut them first, or open a
          file that has readings.
        </p>
        {picker}
      </div>
    );
  }
  return (
    <div class="form-picker">
      {form.files.length > 1 && (
        <label>
          Form
          <select value={form.file} onChange={(event) => choose(event.currentTarget.value)}>
            {form.files.map((file) => (
              <option key={file.name} value={file.name}>
                {file.name}: {file.read} of {file.asked} read
              </option>
            ))}
          </select>
        </label>
      )}
      <details class="more">
        <summary>Readings from a file</summary>
        {picker}
      </details>
    </div>
  );
}
