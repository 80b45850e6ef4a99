// The header: the folder, unsaved changes, and the unit of lengths.
import { useOutbox } from "./kept";
import { waitingPlaces } from "./outbox";
import { SILENT, useProject } from "./project";
import "./header.css";

export function Header() {
  const { project, trouble, choose } = useProject();
  useOutbox();
  const waits = waitingPlaces().length > 0 && trouble.startsWith(SILENT);
  const units = project.choices.units ?? "mm";
  return (
    <header class="row">
      <button type="button" class="skip primary" onClick={toScreen}>
        To the screen
      </button>
      <a class="go mark" href="#/open">
        Plumb
      </a>
      <span class="folder soft" title={project.folder}>
        {project.folder}
      </span>
      <span class="waits" role="status">
        {waits && "What you typed is kept in this browser until the lab answers."}
      </span>
      <fieldset class="segments units">
        <legend>Lengths in</legend>
        {(["mm", "inch"] as const).map((unit) => (
          <label key={unit}>
            <input
              type="radio"
              name="units"
              checked={units === unit}
              onChange={() => void choose({ units: unit })}
            />
            <span>{unit}</span>
          </label>
        ))}
      </fieldset>
    </header>
  );
}

/** Skips the list of steps. */
function toScreen() {
  document.getElementById("screen")?.focus();
}
