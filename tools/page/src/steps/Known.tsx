// Step 2: what you can measure without marks: a drawing with the distance, a number, and its uncertainty.
import { useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { MachinePicture } from "../machine/MachinePicture";
import { useNewest } from "../shell/newest";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import { KnownNumber } from "./known/KnownNumber";
import "./known/known.css";

type Answer = Schemas["KnownAnswer"];
type Number = Schemas["KnownNumber"];

const FIRST = "motor_gap";

/** The number that the address asks for, after the screen. */
function numberInAddress(): string {
  return location.hash.split("/")[2] ?? "";
}

export function Known() {
  const { project } = useProject();
  const [here, setHere] = useState(() => numberInAddress() || FIRST);
  const answer = useNewest<Answer>("known", project.choices_digest);
  const numbers = answer?.numbers ?? [];
  const shown = numbers.find((number) => number.name === here) ?? numbers[0];
  if (!project.machine || !shown)
    return <Screen title="What do you know already?" say="One moment …" busy />;
  const list = (some: Number[]) => (
    <ul class="known tiles plain">
      {some.map((number) => (
        <KnownNumber
          key={number.name}
          number={number}
          here={shown.name === number.name}
          wanted={numberInAddress() === number.name}
          look={() => setHere(number.name)}
        />
      ))}
    </ul>
  );
  const more = numbers.filter((number) => !number.is_first);
  const stated = more.filter((number) => number.stated).length;
  return (
    <Screen
      title="What do you know already?"
      say="Each number that you measured by hand makes the verdict surer. Leave out what you have not measured: nothing here has to be filled in."
      why={
        <p>
          A number that you state is weighed by its ±: a gap known to 1 mm counts nine times as much
          as a gap known to 3 mm. The settings stay as they are until you correct them.
        </p>
      }
      command={answer?.command ?? ""}
      stage={<MachinePicture machine={project.machine} marked={shown.marked} words={shown.title} />}
    >
      {list(numbers.filter((number) => number.is_first))}
      <details open={stated > 0 || !shown.is_first}>
        <summary>
          More that can be measured ({stated} of {more.length} known)
        </summary>
        {list(more)}
      </details>
    </Screen>
  );
}
