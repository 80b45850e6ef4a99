// Step 2: what the owner knows without a mark: a drawing with the distance, a number, and how sure it is.
import { useState } from "preact/hooks";
import type { Choices, Schemas } from "../api/client";
import { type Distance, MachinePicture } from "../machine/MachinePicture";
import { useNewest } from "../shell/newest";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import { KnownNumber } from "./known/KnownNumber";
import "./known/known.css";

type Answer = Schemas["KnownAnswer"];

export function Known() {
  const { project, choose } = useProject();
  const [here, setHere] = useState("motor_gap");
  const answer = useNewest<Answer>("known", project.choices_digest);
  const known: NonNullable<Choices["known"]> = project.choices.known ?? {};
  const numbers = answer?.numbers ?? [];
  const shown = numbers.find((number) => number.name === here);
  if (!project.machine || !shown)
    return <Screen title="What do you know already?" say="One moment …" busy />;
  const keep = (name: string, value: { value: number; sigma: number } | undefined) => {
    const { [name]: _, ...others } = known;
    void choose({ known: value ? { ...others, [name]: value } : others });
  };
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
    >
      <MachinePicture
        machine={project.machine}
        marked={shown.marked as Distance}
        words={shown.title}
      />
      <p class="steps">{shown.steps}</p>
      <ul class="known">
        {numbers.map((number) => (
          <KnownNumber
            key={number.name}
            number={number}
            known={known[number.name]}
            here={here === number.name}
            look={() => setHere(number.name)}
            keep={(value) => keep(number.name, value)}
          />
        ))}
      </ul>
    </Screen>
  );
}
