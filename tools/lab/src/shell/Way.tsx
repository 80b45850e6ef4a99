// The steps as links; those that cannot open yet say what they wait for. On a narrow page they fold.
import { useEffect, useState } from "preact/hooks";
import type { Project } from "../api/client";
import { ROOMS, STEPS, type Step } from "./steps";
import "./way.css";

interface WayParts {
  project: Project;
  here: string; // id of the screen that is shown
}

export function Way({ project, here }: WayParts) {
  const [open, setOpen] = useState(false);
  // Each new screen folds the list.
  useEffect(() => setOpen(false), [here]);
  const number = STEPS.findIndex((step) => step.id === here) + 1;
  const title = [...STEPS, ...ROOMS].find((step) => step.id === here)?.title;
  return (
    <nav aria-label="Steps" class={open ? "open" : ""}>
      <button type="button" class="fold" aria-expanded={open} onClick={() => setOpen(!open)}>
        {number > 0 ? `${number} of ${STEPS.length}: ${title}` : title}
      </button>
      <div class="links">
        <ol>
          {STEPS.map((step, index) => (
            <Place key={step.id} step={step} project={project} here={here} number={index + 1} />
          ))}
        </ol>
        <ul>
          {ROOMS.map((step) => (
            <Place key={step.id} step={step} project={project} here={here} />
          ))}
        </ul>
      </div>
    </nav>
  );
}

function Place({ step, project, here, number }: WayParts & { step: Step; number?: number }) {
  const missing = step.needs(project);
  const words = (
    <>
      {number && <b>{number}</b>} {step.title}
    </>
  );
  return (
    <li>
      {missing ? (
        <span class="locked" title={missing}>
          {words} <small>{missing}</small>
        </span>
      ) : (
        <a href={`#/${step.id}`} aria-current={step.id === here ? "step" : undefined}>
          {words}
        </a>
      )}
    </li>
  );
}

/** The steps before and after this screen, below it. */
export function WayOn({ project, here }: WayParts) {
  const index = STEPS.findIndex((step) => step.id === here);
  if (index < 0) return null;
  const [before, after] = [STEPS[index - 1], STEPS[index + 1]];
  return (
    <footer class="way-on">
      {before && <a href={`#/${before.id}`}>← {before.title}</a>}
      {after && !after.needs(project) && (
        <a class="after" href={`#/${after.id}`}>
          {after.title} →
        </a>
      )}
    </footer>
  );
}
