// Step 8: each number before and after, accepted one by one; written, sent, read back, and undone.
import { useRef } from "preact/hooks";
import type { Schemas } from "../api/client";
import { namedLength, shownLength, useUnits } from "../controls/lengths";
import { List } from "../controls/Parts";
import { Progress } from "../controls/Progress";
import { Residuals } from "../residuals/Residuals";
import { useAnswer } from "../shell/answer";
import { useHeld } from "../shell/Held";
import { useChoosing } from "../shell/kept";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import { Numbers } from "./correct/NumberTable";
import { GoBack, Refused } from "./correct/Refused";
import { ToMachine, ToSend } from "./correct/ToMachine";
import { type CorrectionAnswer, useKnown, useWriting, type Writing } from "./correct/useWriting";
import "./correct/correct.css";

type Made = Schemas["CorrectionParts"];

export function Correct() {
  const { answer, refused } = useAnswer<CorrectionAnswer>("correction");
  const writing = useWriting();
  const held = useHeld()?.alike;
  // The numbers stay in view while they are fitted again.
  const latest = useRef(answer?.correction);
  latest.current = answer?.correction ?? latest.current;
  const made = latest.current;
  if (refused) return <Refused title="No correction yet" refused={refused} writing={writing} />;
  if (!answer || !made) {
    return (
      <Screen {...(answer?.heading ?? { title: "What would change?", say: "One moment …" })}>
        <Progress share={answer?.share ?? 0} label="The correction" />
      </Screen>
    );
  }
  if (made.instead) {
    return (
      <Screen {...made.heading} why={<p>{made.reasons.join(" ")}</p>}>
        <a href={`#/${made.instead.screen}`}>{made.instead.text}</a>
        <GoBack writing={writing} />
      </Screen>
    );
  }
  return <Opened {...{ answer, made, writing, held }} />;
}

interface Parts {
  answer: CorrectionAnswer;
  made: Made;
  writing: Writing;
  /** What the screen says if the machine holds the numbers of the open file. */
  held: Schemas["Heading"] | null | undefined;
}

/** Whether the fit on the screen is that of what is accepted, and the server knows what that is. */
function useCurrent({ answer, made }: Parts): boolean {
  const { settings, accepted = [] } = useProject().project.choices;
  return (
    !useChoosing() &&
    answer.share === 1 &&
    made.settings === settings &&
    made.numbers.every((number) => number.is_accepted === accepted.includes(number.name))
  );
}

/** Numbers to accept and write; once they are written, they are sent, and what would still change is folded away. */
function Opened(parts: Parts) {
  const { answer, made, writing, held } = parts;
  const { accepted = [] } = useProject().project.choices;
  const current = useCurrent(parts);
  const isWritten = answer.is_written && accepted.length === 0;
  const fitted = isWritten ? (current ? made.as_set : null) : (made.accepted ?? made.whole);
  const states = isWritten ? [fitted] : [made.as_set, made.accepted, made.whole];
  const toMachine = { writing, isHeld: !!held, isNext: isWritten, last: answer.last_sent };
  const numbers = <Numbers made={made} busy={!current} />;
  return (
    <Screen
      {...(isWritten ? (held ?? answer.heading) : made.heading)}
      why={<Why made={made} />}
      command={answer.command}
      stage={<Compared made={made} states={states.filter((each) => each !== null)} />}
      fieldsFirst
      act={
        isWritten ? (
          <>
            <ToSend {...toMachine} />
            {writing.notSent}
          </>
        ) : (
          <Write {...parts} current={current} />
        )
      }
    >
      {isWritten && writing.written && !held && (
        <p role="status">
          Written: {writing.written.files.join(", ")}. {writing.written.failure}
        </p>
      )}
      <Fall from={isWritten ? null : made.as_set} to={fitted} busy={!current} />
      {!isWritten && (
        <>
          {made.asked.length > 0 && (
            <p>
              Accept each number that you believe; the rest is fitted again. Writing moves nothing,
              and your old file stays.
            </p>
          )}
          {numbers}
          <Notes title="Do not write these numbers" said={made.stops} />
        </>
      )}
      {(current || !isWritten) && <Notes title="By hand" said={made.by_hand} />}
      {isWritten && current && made.asked.length > 0 && (
        <details>
          <summary>What would still change</summary>
          {numbers}
        </details>
      )}
      <p class="row">
        <GoBack writing={writing} />
        {writing.notWritten}
      </p>
      <ToMachine {...toMachine} />
    </Screen>
  );
}

/** The button that writes what is accepted. */
function Write({ answer, made, writing, current }: Parts & { current: boolean }) {
  const { accepted = [] } = useProject().project.choices;
  const known = useKnown();
  const count = made.numbers.filter((number) => accepted.includes(number.name)).length;
  if (made.asked.length === 0) return null;
  return (
    <button
      type="button"
      class="primary"
      disabled={count === 0 || !current || writing.busy}
      onClick={() => void writing.write(known)}
    >
      {count === 0
        ? "Accept a number first"
        : `Write ${count} ${count === 1 ? "number" : "numbers"} into ${answer.file}`}
    </button>
  );
}

type State = Schemas["State"] | null;

/** What the numbers would do to the marks; no state while they are fitted to another file. */
function Compared({ made, states }: { made: Made; states: Schemas["State"][] }) {
  if (made.marks.length + made.spans.length === 0) return null;
  return <Residuals readings={made} states={states} opensOn="second" slides />;
}

/** The error of the marks, before and after; as a single figure where there is no before. */
function Fall({ from, to, busy }: { from: State; to: State; busy: boolean }) {
  const units = useUnits();
  return (
    <p class="errors soft" aria-busy={busy}>
      {from && (
        <>
          <span class="spoken">The error falls from </span>
          <output class="large was">{shownLength(from.fit_rms, units, 2)}</output>
          <span aria-hidden="true"> → </span>
          <span class="spoken"> to </span>
        </>
      )}
      <output class="large">{to ? namedLength(to.fit_rms, units, 2) : "–"}</output>
      {to?.noise_rms != null && ` noise alone leaves ${shownLength(to.noise_rms, units, 2)}`}
    </p>
  );
}

/** Why the numbers must not be used, or work on the machine without which their promise is void. */
export function Notes({ title, said }: { title: string; said: readonly string[] }) {
  if (said.length === 0) return null;
  return (
    <section class="box edge warned" aria-label={title}>
      <h2>{title}</h2>
      <List said={said} />
    </section>
  );
}

export function Why({ made: { reasons, doubts, intervals } }: { made: Made }) {
  return (
    <>
      <p>{reasons.join(" ")}</p>
      <List said={doubts} />
      <p>The number behind ± is half of the 95 % interval. {intervals}</p>
    </>
  );
}
