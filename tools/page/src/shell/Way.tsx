// The steps as links; those that cannot open yet say what is missing. On a narrow page they fold.
import { useEffect, useState } from "preact/hooks";
import { get, type Project } from "../api/client";
import { useAsked } from "./asked";
import { type Form, ROOMS, STEPS, type Step } from "./steps";
import "./way.css";

interface WayParts {
  project: Project;
  here: string; // id of the screen that is shown
}

interface PlaceParts extends WayParts {
  step: Step;
  number?: number;
  isDone?: boolean;
  form: Form | undefined;
  chosen: () => void;
}

export function Way({ project, here }: WayParts) {
  const [open, setOpen] = useState(false);
  const fold = () => setOpen(false);
  // Opening a screen folds the list, even if it is the current one.
  useEffect(fold, [here]);
  const number = STEPS.findIndex((step) => step.id === here) + 1;
  const title = [...STEPS, ...ROOMS].find((step) => step.id === here)?.title;
  // The newest form, to show how much of it has been read.
  const { answer: form } = useAsked(
    project.machine ? () => get<Form>("readings?file=") : undefined,
    JSON.stringify(project.files),
  );
  // Whatever comes before a step that is done is done too.
  const done = STEPS.findLastIndex((step) => step.isDone?.(project, form));
  const shared = { project, here, form, chosen: fold };
  return (
    <nav aria-label="Steps" class={open ? "open" : ""}>
      <button type="button" class="fold" aria-expanded={open} onClick={() => setOpen(!open)}>
        {number > 0 ? `${number} ${title}` : title}
        <span aria-hidden="true">{open ? "▴" : "▾"}</span>
      </button>
      <div class="links">
        <ol class="plain">
          {STEPS.map((step, index) => (
            <Place
              key={step.id}
              {...shared}
              step={step}
              number={index + 1}
              isDone={index <= done}
            />
          ))}
        </ol>
        <ul class="plain">
          {ROOMS.map((step) => (
            <Place key={step.id} {...shared} step={step} />
          ))}
        </ul>
      </div>
    </nav>
  );
}

function Place({ step, project, here, number, isDone, form, chosen }: PlaceParts) {
  const missing = step.needs(project);
  const result = step.result?.(project, form);
  const words = (
    <>
      {isDone ? (
        <b class="done" aria-hidden="true">
          ✓
        </b>
      ) : (
        number && <b>{number}</b>
      )}{" "}
      {step.title}
      {isDone && <span class="spoken">, done</span>}
    </>
  );
  return (
    <li>
      {missing ? (
        <span class="locked" title={missing}>
          {words} <small>{missing}</small>
        </span>
      ) : (
        <a
          href={`#/${step.id}`}
          aria-current={step.id === here ? "step" : undefined}
          onClick={chosen}
        >
          {words} {result && <span class="result">{result}</span>}
        </a>
      )}
    </li>
  );
}

/** The steps before and after this screen, below it. */
export function WayOn({ project, here }: WayParts) {
  const index = STEPS.findIndex((step) => step.id === here);
  if (index < 0) return null;
  const before = STEPS[index - 1];
  const next = STEPS[index + 1];
  const after = next && !next.needs(project) ? next : undefined;
  if (!before && !after) return null;
  return (
    <footer class="way-on">
      {before && (
        <a class="go" href={`#/${before.id}`}>
          ← {before.title}
        </a>
      )}
      {after && (
        <a class="button after" href={`#/${after.id}`}>
          {after.title} →
        </a>
      )}
    </footer>
  );
}
