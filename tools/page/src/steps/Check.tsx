// Step 9: two marks that were not part of the fit: is the machine as accurate as its settings promise?

import { useEffect } from "preact/hooks";
import { type Project, type Schemas, send } from "../api/client";
import { shownLength } from "../controls/lengths";
import { useUnits } from "../controls/units";
import { Do } from "../shell/doing";
import { isConnected, isReady, type Machine, useMachine } from "../shell/machine";
import { useNewest } from "../shell/newest";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import { CheckMap } from "./check/CheckMap";
import { CheckReadings } from "./check/CheckReadings";
import { OffTarget } from "./check/OffTarget";
import { Promised } from "./check/Promised";
import { Refused } from "./correct/Refused";
import { useWriting } from "./correct/useWriting";
import { useGoOn } from "./cut/GoOn";

export type CheckAnswer = Schemas["CheckAnswer"];

export function Check() {
  const { project } = useProject();
  const machine = useMachine();
  // The check marks as they are now; asked again when a file changes.
  const outcome = machine.program?.outcome ?? "";
  const answer = useNewest<CheckAnswer>("check", JSON.stringify([project.files, outcome]));
  const writing = useWriting();
  useNoted(answer);
  if (!answer && project.changed_since_fit)
    return <Refused title="Is it true?" refused="" writing={writing} />;
  if (!answer) return <Screen title="Is it true?" say="One moment …" busy />;
  return answer.trouble ? <NoPromise /> : <OpenCheck answer={answer} />;
}

function OpenCheck({ answer }: { answer: CheckAnswer }) {
  const { take, reload } = useProject();
  const machine = useMachine();
  const units = useUnits();
  const doing = (path: string, body?: unknown) => async () => {
    const answered = await send<Project | Schemas["MachineAnswer"]>("POST", path, body);
    if ("choices" in answered) take(answered);
    else await reload();
  };
  const ready = isReady(machine);
  const next = nextOf(answer, machine);
  const names = answer.meant.map((_, i) => String(i + 1));
  const [whichIsLast, goOn] = useGoOn({
    surely: answer.broke_off ?? 0,
    perhaps: answer.perhaps,
    names,
    path: "check/go-on",
    blocked: false,
  });
  const cut = (
    <Do isNext={next === "cut"} disabled={!ready} work={doing("check/cut")}>
      {answer.broke_off == null ? "Cut both marks" : "Cut both marks again"}: the sled moves
    </Do>
  );
  const acts = {
    read: (
      <Do isNext disabled={!ready} work={doing("machine/readings", { form: answer.form })}>
        Let the tape read them
      </Do>
    ),
    "go on": goOn,
    cut,
    write: (
      <Do isNext work={doing("check")}>
        Write {answer.program} and its form
      </Do>
    ),
    nothing: null,
  };
  const places = answer.meant.map((place) =>
    place.map((mm) => shownLength(mm, units, 0)).join(", "),
  );
  return (
    <Screen
      title="Is it true?"
      say="Cut two marks that took no part, on the same sheet, with the new settings. Then read them. They show how the machine does away from the marks of the fit."
      why={<Why />}
      command={answer.command}
      stage={<CheckMap answer={answer} />}
      fieldsFirst
      act={acts[next]}
    >
      {answer.sentence && (
        <p class={answer.holds ? "judged box edge" : "judged trouble edge"} role="status">
          {answer.sentence}
        </p>
      )}
      {answer.sentence && <OffTarget rounds={answer.rounds} units={units} />}
      {!answer.sentence && (
        <p>
          Where ({units} from your edges): {places.join(" and ")}.
        </p>
      )}
      {answer.broke_off != null && <p role="status">{answer.broke_said}</p>}
      {next === "go on" && whichIsLast}
      <p class="row">
        {next === "go on" && cut}
        {answer.sentence && machine.kind === "none" && (
          <Do work={doing("check")}>Write two other marks</Do>
        )}
        {answer.sentence && machine.kind !== "none" && (
          <Do work={doing("check/cut")}>Cut two other marks: the sled moves</Do>
        )}
        {answer.sentence && !answer.is_used && (
          <Do work={doing("check/use")}>Let the verdict go by these marks too</Do>
        )}
      </p>
      {answer.is_saved && <CheckReadings file={answer.form} />}
      {answer.marks.length > 0 && <Promised marks={answer.marks} units={units} />}
    </Screen>
  );
}

type Next = "read" | "go on" | "cut" | "write" | "nothing";

/** What to do next: the screen's button does it. Fields for readings are always there. */
function nextOf(answer: CheckAnswer, machine: Machine): Next {
  const { sentence, is_saved, broke_off, goes_on, meant } = answer;
  if (sentence) return "nothing";
  if (machine.kind === "none") return is_saved ? "nothing" : "write";
  const isCut = machine.program?.title === answer.program && machine.program.outcome === "done";
  if (isCut) return machine.kind === "virtual" ? "read" : "nothing";
  if (!isConnected(machine) || broke_off === meant.length) return "nothing";
  return broke_off != null && goes_on ? "go on" : "cut";
}

/** Writes a result into the diary, once there is one. */
function useNoted(answer: CheckAnswer | undefined): void {
  const { take } = useProject();
  const isNew = !!answer?.sentence && !answer.is_noted;
  useEffect(() => {
    if (!isNew) return;
    // If it fails, the next look at the result writes it.
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

/** Nothing can be checked before there is a correction. */
function NoPromise() {
  return (
    <Screen
      title="Is it true?"
      say="Two marks that took no part show whether the settings hold. First write a correction: it makes the promise."
    >
      <a class="button primary" href="#/correct">
        To the correction
      </a>
    </Screen>
  );
}
