// Step 9: two marks that took no part: is the machine where its settings promise?

import { useEffect } from "preact/hooks";
import { type Project, type Schemas, send } from "../api/client";
import { shownLength } from "../controls/lengths";
import { useDo } from "../shell/doing";
import { useReadOnly } from "../shell/editor";
import { isReady, useMachine } from "../shell/machine";
import { useNewest } from "../shell/newest";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import { CheckMap } from "./check/CheckMap";
import { CheckReadings } from "./check/CheckReadings";
import { OffTarget } from "./check/OffTarget";
import { Promised } from "./check/Promised";
import { Refused } from "./correct/Refused";
import { useWriting } from "./correct/useWriting";
import { brokenWords, GoOn } from "./cut/GoOn";
import "./check/check.css";

export type CheckAnswer = Schemas["CheckAnswer"];

export function Check() {
  const { project, take, reload } = useProject();
  const machine = useMachine();
  // The check marks as they are now; asked again when a file changes.
  const outcome = machine.program?.outcome ?? "";
  const answer = useNewest<CheckAnswer>("check", JSON.stringify([project.files, outcome]));
  const [busy, run, refusal] = useDo();
  const units = project.choices.units ?? "mm";
  const writing = useWriting();
  useNoted(answer);
  if (!answer && project.changed_since_fit)
    return <Refused title="Is it true?" refused="" writing={writing} />;
  if (!answer) return <Screen title="Is it true?" say="One moment …" busy />;
  const doing = (path: string, body?: unknown) =>
    run(async () => {
      const answered = await send<Project | Schemas["MachineAnswer"]>("POST", path, body);
      if ("choices" in answered) take(answered);
      else await reload();
    });
  if (answer.trouble) return <NoPromise />;
  const ready = isReady(machine);
  const isCut = machine.program?.title === answer.program && machine.program.outcome === "done";
  const places = answer.meant.map((place) =>
    place.map((mm) => shownLength(mm, units, 0)).join(", "),
  );
  return (
    <Screen
      title="Is it true?"
      say="Cut two marks that took no part, on the same sheet, with the new settings. Then read them. They show what the machine does where nobody fitted it."
      why={<Why />}
      command={answer.command}
      stage={<CheckMap answer={answer} />}
      fieldsFirst
    >
      {answer.sentence && (
        <p class={answer.holds ? "judged holds" : "judged misses"} role="status">
          {answer.sentence}
        </p>
      )}
      {answer.sentence && <OffTarget rounds={answer.rounds} units={units} />}
      {!answer.sentence && (
        <p>
          Where ({units} from your edges): {places.join(" and ")}.
        </p>
      )}
      {answer.broke_off != null && <BrokeOff answer={answer} surely={answer.broke_off} />}
      <p class="buttons">
        {machine.kind !== "none" && !answer.sentence && !isCut && (
          <button
            type="button"
            class={answer.broke_off == null ? "primary" : ""}
            disabled={busy || !ready}
            onClick={() => void doing("check/cut")}
          >
            {answer.broke_off == null ? "Cut both marks" : "Cut both marks again"}: the sled moves
          </button>
        )}
        {machine.kind === "none" && !answer.is_saved && (
          <button type="button" class="primary" disabled={busy} onClick={() => void doing("check")}>
            Write {answer.program} and its form
          </button>
        )}
        {machine.kind === "virtual" && answer.is_saved && !answer.sentence && (
          <button
            type="button"
            class={isCut ? "primary" : ""}
            disabled={busy || !ready || !isCut}
            onClick={() => void doing("machine/readings", { form: answer.form })}
          >
            Let the tape read them
          </button>
        )}
        {answer.sentence && (
          <button
            type="button"
            disabled={busy}
            onClick={() => void doing(machine.kind === "none" ? "check" : "check/cut")}
          >
            {machine.kind === "none"
              ? "Write two other marks"
              : "Cut two other marks: the sled moves"}
          </button>
        )}
        {answer.sentence && !answer.is_used && (
          <button type="button" disabled={busy} onClick={() => void doing("check/use")}>
            Let the verdict go by these marks too
          </button>
        )}
        {refusal}
      </p>
      {answer.is_saved && <CheckReadings file={answer.form} />}
      {answer.marks.length > 0 && <Promised marks={answer.marks} units={units} />}
    </Screen>
  );
}

/** Whoever begins again has a mark twice that is cut already. */
function BrokeOff({ answer, surely }: { answer: CheckAnswer; surely: number }) {
  const machine = useMachine();
  const { perhaps, goes_on, meant } = answer;
  const names = meant.map((_, i) => String(i + 1));
  const isConnected = machine.kind !== "none" && machine.phase !== "lost";
  return (
    <>
      <p role="status">{brokenWords(surely, perhaps, names)}</p>
      {goes_on && isConnected && surely < names.length && (
        <GoOn surely={surely} perhaps={perhaps} names={names} path="check/go-on" blocked={false} />
      )}
    </>
  );
}

/** Has the diary note a result, once it is there. */
function useNoted(answer: CheckAnswer | undefined): void {
  const { take } = useProject();
  const readOnly = useReadOnly();
  const isNew = !readOnly && !!answer?.sentence && !answer.is_noted;
  useEffect(() => {
    if (!isNew) return;
    // Who looks at the result next time has it noted then.
    send<Project>("POST", "check/note").then(take, () => undefined);
  }, [isNew, answer?.sentence, take]);
}

function Why() {
  return (
    <p>
      A fit can look good and be wrong: it has seen the marks that it is judged by. What is promised
      counts how well your marks settle the numbers, and how well a tape is read. 99 of 100 such
      marks lie within it if nothing is missing.
    </p>
  );
}

/** Nothing can be checked before a correction promises something. */
function NoPromise() {
  return (
    <Screen
      title="Is it true?"
      say="Two marks that took no part show whether the settings hold. First write a correction: it makes the promise."
    >
      <a class="go" href="#/correct">
        To the correction
      </a>
    </Screen>
  );
}
