// Why there is no verdict on the marks, and how to go back if readings changed after a fit.
import type { ComponentChildren } from "preact";
import { useProject } from "../../shell/project";
import { Screen } from "../../shell/Screen";
import { GoBack } from "./GoBack";
import type { Writing } from "./useWriting";

interface RefusedParts {
  title: string;
  refused: string;
  writing: Writing;
  children?: ComponentChildren;
}

export function Refused({ title, refused, writing, children }: RefusedParts) {
  const { changed_since_fit, choices } = useProject().project;
  if (!changed_since_fit)
    return (
      <Screen title={title} say={refused}>
        {children}
      </Screen>
    );
  const before = choices.settings_before?.at(-1);
  return (
    <Screen
      title="Your readings have changed"
      say={`The numbers in ${choices.settings} are stale: they were fitted to ${changed_since_fit} as it was before. ${
        before
          ? `Go back to ${before}, and they are fitted again to what you read now. ${choices.settings} stays in the folder.`
          : "Open the settings that were in force when the marks were cut."
      }`}
      why={<p>{refused}</p>}
    >
      <p class="row">
        {before ? (
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
      {children}
    </Screen>
  );
}
