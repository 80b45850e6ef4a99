// Practice: reveals the errors of a virtual machine once you have calibrated it.
import { useState } from "preact/hooks";
import { type Schemas, send } from "../api/client";
import { namedLength, shownLength, useUnits } from "../controls/lengths";
import { Do } from "../shell/doing";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";

const SECRET = "practice.json";

export function Practice() {
  const { project } = useProject();
  const [revealed, setRevealed] = useState<Schemas["Score"]>();
  const hides = SECRET in project.files;
  const reveal = async () => setRevealed(await send("POST", "practice/reveal"));
  return (
    <Screen
      title="Practice"
      say="A virtual machine hides what is wrong with it. Calibrate it like a real machine, then look at what was hidden. Nothing real moves."
      command={
        hides
          ? `plumb practice reveal . ${project.choices.settings ?? ""}`.trim()
          : "plumb practice start ."
      }
      why={
        <p>
          The score is the error that the opened settings leave all over the sheet, without the
          noise of a tape, and what you added that is not there.
        </p>
      }
    >
      {hides ? (
        <Do disabled={!project.machine} work={reveal}>
          Reveal what was hidden
        </Do>
      ) : (
        <>
          <p class="soft">No virtual machine was started in this folder.</p>
          <a class="button primary" href="#/open">
            To the machines: start a virtual machine there
          </a>
        </>
      )}
      {revealed && <Score {...revealed} />}
    </Screen>
  );
}

function Score({ hidden, sentence, before_mm, after_mm }: Schemas["Score"]) {
  const units = useUnits();
  return (
    <section aria-label="Score">
      <p>
        Hidden was <strong>{hidden}</strong>. {sentence}
      </p>
      <p>
        <output class="large was">{shownLength(before_mm, units, 2)}</output>
        <span aria-hidden="true"> → </span>
        <output class="large">
          {after_mm == null ? "out of reach" : namedLength(after_mm, units, 2)}
        </output>{" "}
        error all over the sheet, as the settings were and with yours.
      </p>
      <a class="button" href="#/open">
        Start another virtual machine
      </a>
    </section>
  );
}
