// Step 8: each number before and after, accepted one by one; written, sent, read back, and undone.
import { useRef } from "preact/hooks";
import type { Choices, Schemas } from "../api/client";
import { namedLength, shownLength, useUnits } from "../controls/lengths";
import { Progress } from "../controls/Progress";
import { capital } from "../controls/words";
import { Residuals } from "../residuals/Residuals";
import { useAnswer } from "../shell/answer";
import { useChoosing } from "../shell/kept";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import { useHeld } from "../shell/useHeld";
import { GoBack } from "./correct/GoBack";
import { Numbers } from "./correct/Numbers";
import { Refused } from "./correct/Refused";
import { ToMachine, ToSend } from "./correct/ToMachine";
import { type CorrectionAnswer, useKnown, useWriting, type Writing } from "./correct/useWriting";
import "./correct/correct.css";

type Made = Schemas["CorrectionParts"];

export function Correct() {
  const { project } = useProject();
  const { answer, refused } = useAnswer<CorrectionAnswer>("correction");
  const writing = useWriting();
  const isHeld = useHeld()?.said.length === 0;
  // The numbers stay in view while they are fitted again.
  const latest = useRef(answer?.correction);
  latest.current = answer?.correction ?? latest.current;
  const made = latest.current;
  if (refused) return <Refused title="No correction yet" refused={refused} writing={writing} />;
  if (!answer || !made) {
    return (
      <Screen title="What would change?" say="The numbers are fitted to your readings.">
        <Progress share={answer?.share ?? 0} label="The correction" />
      </Screen>
    );
  }
  if (made.nothing) {
    return (
      <Screen title={made.nothing} say={made.said} why={<p>{made.reasons.join(" ")}</p>}>
        {made.instead && <a href={`#/${made.instead.screen}`}>{made.instead.text}</a>}
        <GoBack writing={writing} />
      </Screen>
    );
  }
  const parts = { answer, made, writing, isHeld };
  return isWritten(made, project.choices, writing) ? (
    <Written {...parts} />
  ) : (
    <Question {...parts} />
  );
}

/** Whether the open file holds a fit to these marks, and nothing more is accepted: it goes to the machine next. */
function isWritten(made: Made, choices: Choices, writing: Writing): boolean {
  if (choices.accepted?.length) return false;
  if (made.settings === choices.settings) return made.is_written;
  return writing.written?.file === choices.settings; // and its fit is on its way
}

interface Parts {
  answer: CorrectionAnswer;
  made: Made;
  writing: Writing;
  /** Whether the machine holds the numbers of the open file. */
  isHeld: boolean;
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

/** Which numbers are accepted and written. */
function Question(parts: Parts) {
  const { answer, made, writing, isHeld } = parts;
  const { accepted = [] } = useProject().project.choices;
  const current = useCurrent(parts);
  const known = useKnown();
  const count = made.numbers.filter((number) => accepted.includes(number.name)).length;
  const isAsked = made.asked.length > 0;
  return (
    <Screen
      title={isAsked ? "What would change?" : "Nothing would change"}
      say={isAsked ? made.said : `${made.settings} fits these marks as it is.`}
      why={<Why made={made} />}
      command={answer.command}
      stage={
        <Compared
          made={made}
          states={[made.as_set, made.accepted, made.whole].filter((each) => each !== null)}
        />
      }
      fieldsFirst
      act={
        isAsked && (
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
        )
      }
    >
      <Fall from={made.as_set} to={made.accepted ?? made.whole} busy={!current} />
      {isAsked && (
        <p>
          Accept each number that you believe; the rest is fitted again. Writing moves nothing, and
          your old file stays.
        </p>
      )}
      <Numbers made={made} busy={!current} />
      <Notes made={made} weight="stop" />
      <Notes made={made} weight="by_hand" />
      <p class="row">
        <GoBack writing={writing} />
        {writing.notWritten}
      </p>
      <ToMachine {...{ writing, isHeld }} isNext={false} last={answer.last_sent} />
    </Screen>
  );
}

/** Sends what is written to the machine; numbers that would still change are folded away. */
function Written(parts: Parts) {
  const { answer, made, writing, isHeld } = parts;
  const { settings } = useProject().project.choices;
  const current = useCurrent(parts);
  return (
    <Screen
      title={isHeld ? "The machine holds the numbers" : "The numbers are written"}
      say={
        isHeld
          ? `They are those of ${settings}. Two marks on the same sheet show whether it came true.`
          : `${settings} holds them; your old file stays. The machine takes them next: nothing moves, and each number is read back.`
      }
      why={<Why made={made} />}
      command={answer.command}
      stage={<Compared made={made} states={current && made.as_set ? [made.as_set] : []} />}
      fieldsFirst
      act={
        <>
          <ToSend {...{ writing, isHeld }} isNext last={answer.last_sent} />
          {writing.notSent}
        </>
      }
    >
      {writing.written && !isHeld && (
        <p role="status">
          Written: {writing.written.files.join(", ")}. {writing.written.failure}
        </p>
      )}
      <Fall from={null} to={current ? made.as_set : null} busy={!current} />
      <ToMachine {...{ writing, isHeld }} isNext last={answer.last_sent} />
      {current && <Notes made={made} weight="by_hand" />}
      {current && made.asked.length > 0 && (
        <details>
          <summary>What would still change</summary>
          <Numbers made={made} busy={false} />
        </details>
      )}
      <p class="row">
        <GoBack writing={writing} />
        {writing.notWritten}
      </p>
    </Screen>
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

const TITLES = { stop: "Do not write these numbers", by_hand: "By hand" };

/** Why the numbers must not be used, or work on the machine without which their promise is void. */
export function Notes({ made, weight }: { made: Made; weight: keyof typeof TITLES }) {
  const said = made.notes.filter((note) => note.weight === weight);
  if (said.length === 0) return null;
  return (
    <section class="box edge warned" aria-label={TITLES[weight]}>
      <h2>{TITLES[weight]}</h2>
      <ul>
        {said.map(({ text }) => (
          <li key={text}>{capital(text)}.</li>
        ))}
      </ul>
    </section>
  );
}

export function Why({ made }: { made: Made }) {
  const { reasons, notes, intervals } = made;
  const doubts = notes.filter(({ weight }) => weight === "doubt" || weight === "hint");
  return (
    <>
      <p>{reasons.join(" ")}</p>
      {doubts.length > 0 && (
        <ul>
          {doubts.map(({ text }) => (
            <li key={text}>{capital(text)}.</li>
          ))}
        </ul>
      )}
      <p>The number behind ± is half of the 95 % interval. {intervals}</p>
    </>
  );
}
