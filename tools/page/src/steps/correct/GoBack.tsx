// Reopens the settings from before the latest correction; no file is lost.
import { useChoosing } from "../../shell/kept";
import { useProject } from "../../shell/project";
import { useKnown, type Writing } from "./useWriting";

interface GoBackParts {
  writing: Writing;
  /** What follows, if this is the next thing to do. */
  then?: string;
}

export function GoBack({ writing, then }: GoBackParts) {
  const before = useProject().project.choices.settings_before ?? [];
  const known = useKnown();
  const choosing = useChoosing();
  if (before.length === 0) return null;
  return (
    <button
      type="button"
      class={then ? "primary" : ""}
      disabled={choosing || writing.busy}
      onClick={() => void writing.undo(known)}
    >
      Go back to {before.at(-1)}
      {then}
    </button>
  );
}
