// A button that has the browser save a file which the lab makes: a report, a sheet to print, a table, the folder.
import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { takeAlong } from "../api/client";

interface TakeAlongParts {
  name: "report.html" | "marks.pdf" | "readings.csv" | "folder.zip";
  children: ComponentChildren;
}

export function TakeAlong({ name, children }: TakeAlongParts) {
  const [busy, setBusy] = useState(false);
  const [refused, setRefused] = useState("");
  const take = async () => {
    setBusy(true);
    setRefused("");
    try {
      await takeAlong(name);
    } catch (error) {
      setRefused(error instanceof Error ? error.message : String(error));
    }
    setBusy(false);
  };
  return (
    <p class="take-along">
      <button type="button" disabled={busy} onClick={() => void take()}>
        {busy ? `Making ${name} …` : children}
      </button>
      {refused && (
        <span class="trouble" role="alert">
          {refused}
        </span>
      )}
    </p>
  );
}
