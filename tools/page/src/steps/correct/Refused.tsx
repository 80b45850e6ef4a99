// Why there is no verdict on the marks, and how to go back if readings changed after a fit.
import { useChoosing } from "../../shell/kept";
import { useProject } from "../../shell/project";
import { Screen } from "../../shell/Screen";
import { useKnown, type Writing } from "./useWriting";

interface RefusedParts {
  title: string;
  refused: string;
  writing: Writing;
}

export function Refused({ title, refused, writing }: RefusedParts) {
  const { stale, choices } = useProject().project;
  if (!stale) return <Screen title={title} say={refused} />;
  return (
    <Screen {...stale} why={<p>{refused}</p>}>
      <p class="row">
        {choices.settings_before?.length ? (
          <GoBack writing={writing} then=" and fit again" />
        ) : (
          <a class="button primary" href="#/open">
            To the machine
          </a>
        )}
        <a class="button" href="#/readings">
          Look at the readings
        </a>
        {writing.notWritten}
      </p>
    </Screen>
  );
}

/** Reopens the settings from before the latest correction; no file is lost. */
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
