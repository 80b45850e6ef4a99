// The header: the folder, unsaved changes, and the unit of lengths.

import { useUnits } from "../controls/lengths";
import { Segments } from "../controls/Segments";
import { useOutbox } from "./kept";
import { waitingPlaces } from "./outbox";
import { SILENT, useProject } from "./project";
import "./header.css";

const UNITS = [
  ["mm", "mm"],
  ["inch", "inch"],
] as const;

export function Header() {
  const { project, trouble, choose } = useProject();
  useOutbox();
  const waits = waitingPlaces().length > 0 && trouble.startsWith(SILENT);
  const units = useUnits();
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
      <Segments
        legend="Lengths in"
        options={UNITS}
        chosen={units}
        choose={(units) => choose({ units })}
      />
    </header>
  );
}

/** Skips the list of steps. */
function toScreen() {
  document.getElementById("screen")?.focus();
}
