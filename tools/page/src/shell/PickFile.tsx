// Takes a file that is picked or dropped; why it was refused stands here.
import { useState } from "preact/hooks";
import { useDo } from "./doing";
import "./pick-file.css";

interface PickFileParts {
  title: string;
  hint: string;
  /** Ends of names, like ".toml,.csv". */
  accept: string;
  take: (file: File) => Promise<unknown>;
}

export function PickFile({ title, hint, accept, take }: PickFileParts) {
  const [over, setOver] = useState(false);
  const [, run, refusal] = useDo();
  const open = async (file: File | undefined) => {
    if (file) await run(() => take(file));
  };
  return (
    <label
      class={over ? "box pick over" : "box pick"}
      onDragOver={(event) => {
        event.preventDefault();
        setOver(true);
      }}
      onDragLeave={() => setOver(false)}
      onDrop={(event) => {
        event.preventDefault();
        setOver(false);
        void open(event.dataTransfer?.files[0]);
      }}
    >
      <b>{title}</b>
      <small>{hint}: pick it, or drop it here</small>
      <input
        type="file"
        accept={accept}
        onChange={(event) => {
          const input = event.currentTarget;
          void open(input.files?.[0]).then(() => {
            input.value = "";
          });
        }}
      />
      {refusal}
    </label>
  );
}
