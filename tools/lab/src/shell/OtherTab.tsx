// Says that another tab edits the folder, and takes over.
import { useDo } from "./doing";
import { takeOver, useReadOnly } from "./editor";
import { useOutbox } from "./kept";
import { waitingPlaces } from "./outbox";

export function OtherTab() {
  const [busy, run, refusal] = useDo();
  useOutbox();
  if (!useReadOnly()) return null;
  return (
    <p class="trouble" role="alert">
      This folder is open in another tab. Here nothing can be changed.{" "}
      {waitingPlaces().length > 0 && "What you typed here last is not saved. "}
      <button type="button" disabled={busy} onClick={() => void run(takeOver)}>
        Take over
      </button>
      {refusal}
    </p>
  );
}
