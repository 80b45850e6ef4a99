// Step 8: each number before and after, accepted one by one; written, sent, read back, and taken back.
import { useRef } from "preact/hooks";
import type { Schemas } from "../api/client";
import { namedLength } from "../controls/lengths";
import { Progress } from "../controls/Progress";
import { useAnswer } from "../shell/answer";
import { useChoosing } from "../shell/kept";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import { Numbers } from "./correct/Numbers";
import { ToMachine } from "./correct/ToMachine";
import { type CorrectionAnswer, type Known, useWriting } from "./correct/useWriting";
import "./correct/correct.css";

export function Correct() {
  const { project, choose } = useProject();
  const accepted = project.choices.accepted ?? [];
  const { answer, refused } = useAnswer<CorrectionAnswer>("correction");
  const writing = useWriting();
  const units = project.choices.units ?? "mm";
  const choosing = useChoosing();
  // The numbers stay in view while they are fitted again.
  const latest = useRef(answer?.correction);
  latest.current = answer?.correction ?? latest.current;
  const made = latest.current;
  if (refused) return <Screen title="No correction yet" say={refused} />;
  if (!answer || !made) {
    return (
      <Screen title="What would change?" say="The numbers are fitted to your readings.">
        <Progress share={answer?.share ?? 0} label="The correction" />
      </Screen>
    );
  }
  if (made.is_slip) {
    return (
      <Screen title="First look at a reading again" say={made.reasons.join(" ")}>
        <a href="#/readings">Look at the readings</a>
      </Screen>
    );
  }
  const known: Known = {
    settings: project.files[project.choices.settings ?? ""] ?? "",
    choices: project.choices_digest,
  };
  // Whether the fit on the screen is that of what is accepted, and the server knows what that is.
  const current =
    !choosing &&
    answer.share === 1 &&
    made.settings === project.choices.settings &&
    made.numbers.every((number) => number.is_accepted === accepted.includes(number.name));
  const before = project.choices.settings_before ?? [];
  // Nothing is accepted since the last correction was written: it goes to the machine next.
  const isWritten = before.length > 0 && accepted.length === 0;
  const count = made.numbers.filter((number) => accepted.includes(number.name)).length;
  return (
    <Screen
      title="What would change?"
      say="Accept each number that you believe. The others stay as they are, and the rest is fitted again. Writing moves nothing; your old file stays."
      why={<Why made={made} />}
      command={answer.command}
    >
      <dl class="errors">
        <ErrorFigure name={`as ${made.settings} says`} mm={made.rms_set} units={units} />
        <ErrorFigure name="with what you accepted" mm={made.rms_accepted} units={units} />
        <ErrorFigure name="with all of it" mm={made.rms_all} units={units} />
      </dl>
      <Numbers
        made={made}
        accepted={accepted}
        accept={(names) => void choose({ accepted: names })}
        busy={!current}
      />
      {made.cures.length > 0 && <ByHand cures={made.cures} />}
      <p class="buttons">
        <button
          type="button"
          class={isWritten ? "" : "primary"}
          disabled={count === 0 || !current || writing.busy}
          onClick={() => void writing.write(known)}
        >
          {count === 0
            ? "Accept a number, and it can be written"
            : `Write ${count} ${count === 1 ? "number" : "numbers"} into ${answer.file}`}
        </button>
        {before.length > 0 && (
          <button
            type="button"
            disabled={choosing || writing.busy}
            onClick={() => void writing.undo(known)}
          >
            Go back to {before.at(-1)}
          </button>
        )}
      </p>
      <ToMachine writing={writing} isNext={isWritten} />
    </Screen>
  );
}

interface ErrorParts {
  name: string;
  mm: number | null;
  units: "mm" | "inch";
}

function ErrorFigure({ name, mm, units }: ErrorParts) {
  return (
    <div>
      <dt>{name}</dt>
      <dd>{mm === null ? "–" : namedLength(mm, units, 2)}</dd>
    </div>
  );
}

/** What has to be done at the machine: the promise counts on it. */
function ByHand({ cures }: { cures: string[] }) {
  return (
    <section class="by-hand" aria-label="By hand">
      <h2>By hand</h2>
      <ul>
        {cures.map((said) => (
          <li key={said}>{capital(said)}.</li>
        ))}
      </ul>
    </section>
  );
}

function Why({ made }: { made: Schemas["CorrectionParts"] }) {
  const { reasons, warnings, intervals } = made;
  return (
    <>
      <p>{reasons.join(" ")}</p>
      {warnings.length > 0 && (
        <ul>
          {warnings.map((said) => (
            <li key={said}>{capital(said)}.</li>
          ))}
        </ul>
      )}
      <p>The number behind ± is half of the 95 % interval. {intervals}</p>
    </>
  );
}

function capital(said: string): string {
  return said.charAt(0).toUpperCase() + said.slice(1);
}
