// Practice: reveals the errors of a virtual machine once you have calibrated it.
import { useState } from "preact/hooks";
import { type Schemas, send } from "../api/client";
import { Do } from "../shell/doing";
import { useNewest } from "../shell/newest";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";

export function Practice() {
  const { project } = useProject();
  const [revealed, setRevealed] = useState<Schemas["Revealed"]>();
  const { files, choices_digest } = project;
  const answer = useNewest<Schemas["PracticeAnswer"]>(
    "practice",
    JSON.stringify([files, choices_digest]),
  );
  const reveal = async () => setRevealed(await send("POST", "practice/reveal"));
  return (
    <Screen
      title="Practice"
      say="A virtual machine hides what is wrong with it. Calibrate it like a real machine, then look at what was hidden. Nothing real moves."
      command={answer?.command ?? ""}
      busy={!answer}
      why={
        <p>
          The score is the error that the opened settings leave all over the sheet, without the
          noise of a tape, and what you added that is not there.
        </p>
      }
    >
      {answer?.nothing === "" && (
        <Do disabled={!project.machine} work={reveal}>
          Reveal what was hidden
        </Do>
      )}
      {answer?.nothing && (
        <>
          <p class="soft">{answer.nothing}</p>
          <a class="button primary" href="#/open">
            To the machines: start a virtual machine there
          </a>
        </>
      )}
      {revealed && <Score {...revealed} />}
    </Screen>
  );
}

function Score({ hidden, sentence, fell: [before, after] }: Schemas["Revealed"]) {
  return (
    <section aria-label="Score">
      <p>
        Hidden was <strong>{hidden}</strong>. {sentence}
      </p>
      <p>
        <output class="large was">{before}</output>
        <span aria-hidden="true"> → </span>
        <output class="large">{after}</output> error all over the sheet, as the settings were and
        with yours.
      </p>
      <a class="button" href="#/open">
        Start another virtual machine
      </a>
    </section>
  );
}
