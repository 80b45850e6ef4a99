// A machine's first day, step by step; each step can be left and resumed.
import { useEffect, useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { Field } from "../controls/Field";
import { namedLength, shownLength, typedLength, useUnits } from "../controls/lengths";
import { Trouble } from "../controls/Trouble";
import { isReady, useMachine } from "../shell/machine";
import { useProject } from "../shell/project";
import { useWatched, type Watched } from "../shell/watched";
import "./guide.css";

const LOOK_MS = 300; // while a step is under way

type Guide = Watched<Schemas["GuideAnswer"]>;

export function useGuide(): Guide {
  const { reload } = useProject();
  const guide: Guide = useWatched("guide", ({ here }) => here !== "", LOOK_MS);
  const here = guide.state?.here;
  useEffect(() => {
    if (here) return () => void reload(); // what the step wrote
  }, [here, reload]);
  return guide;
}

/** The button that begins the open step. */
export function BeginStep({ state: guide, press, busy }: Guide) {
  const ready = isReady(useMachine());
  const step = guide?.steps.find(({ name }) => name === guide.open);
  if (!guide || guide.here || !step) return null;
  return (
    <button
      type="button"
      class="primary"
      disabled={busy || !ready}
      onClick={() => press("begin", { step: step.name })}
    >
      Begin: {step.title}
    </button>
  );
}

/** `isNext`: the screen's button begins the open step. */
export function FirstDay({ isNext, ...all }: Guide & { isNext: boolean }) {
  const { state: guide, press, busy, silent, refused } = all;
  const ready = isReady(useMachine());
  if (!guide) return null;
  const place = guide.steps.findIndex((step) => step.name === guide.open);
  const reached = place < 0 ? guide.steps.length : place;
  const last = guide.said.at(-1) ?? "";
  return (
    <section class="guide" aria-labelledby="guide-title">
      <h2 id="guide-title">Its first day, step by step</h2>
      <p>Nothing moves before you press a button that says what moves and how far.</p>
      <Trouble>
        {silent && "The lab does not answer, so this may be old. It is asked again and again."}
      </Trouble>
      <Trouble>{refused}</Trouble>
      <ol class="plain">
        {guide.steps.map((step, index) => (
          <li
            key={step.name}
            class={step.done ? "row done" : "row"}
            data-here={step.name === guide.here}
          >
            <span>
              {step.done ? "✓" : index + 1} {step.title}
            </span>
            {step.name !== guide.here && index <= reached && !(isNext && index === reached) && (
              <button
                type="button"
                disabled={busy || !ready || guide.here !== ""}
                aria-label={`${step.done ? "Again" : "Begin"}: ${step.title}`}
                onClick={() => press("begin", { step: step.name })}
              >
                {step.done ? "Again" : "Begin"}
              </button>
            )}
            {step.name === guide.here && (
              <div class="box edge here">
                {last && <Said text={last} />}
                {guide.question ? (
                  <>
                    <GuideQuestion
                      key={guide.question.number}
                      question={guide.question}
                      busy={busy}
                      answer={(reply) => press("answer", { number: guide.question?.number, reply })}
                    />
                    <button type="button" disabled={busy} onClick={() => press("leave")}>
                      Leave this step
                    </button>
                  </>
                ) : (
                  <p role="status">The machine works …</p>
                )}
              </div>
            )}
          </li>
        ))}
      </ol>
      {!guide.here && guide.said.length > 0 && <Said text={guide.said.join("\n")} />}
      <Trouble>{!guide.here && guide.trouble}</Trouble>
      {place < 0 && (
        <p>
          <strong>All steps are done.</strong> <a href="#/measure">Choose marks</a>
        </p>
      )}
    </section>
  );
}

function Said({ text }: { text: string }) {
  return (
    <div role="status">
      {text.split("\n").map((line) => (
        <p key={line}>{line}</p>
      ))}
    </div>
  );
}

interface QuestionParts {
  question: Schemas["Question"];
  busy: boolean;
  answer: (reply: string) => void;
}

/** A question of the guide. A button that moves something says what and how far. */
function GuideQuestion(parts: QuestionParts) {
  const { question, busy, answer } = parts;
  if (question.answers.length === 0) return <Size {...parts} />;
  return (
    <fieldset class="question row">
      <legend>{question.text}</legend>
      {question.answers.map(([letter, words], i) => (
        <button
          key={letter}
          type="button"
          class={question.kind === "go" && i === 0 ? "primary" : ""}
          disabled={busy}
          onClick={() => answer(letter)}
        >
          {words}
        </button>
      ))}
    </fieldset>
  );
}

/** A length in the chosen unit, or a mass; or how far a sprocket turns, again and again until it is right. */
function Size({ question, busy, answer }: QuestionParts) {
  const { kind, usual, low, high } = question;
  const chosen = useUnits();
  const [unit, name] = kind === "mass" ? (["mm", "kg"] as const) : [chosen, chosen];
  const isTurn = kind === "turn";
  const offered = usual == null ? "" : shownLength(usual, unit);
  const [text, setText] = useState(offered);
  const size = usual != null && text === offered ? usual : typedLength(text, unit);
  const fits = size !== undefined && size >= low && size <= high && !(isTurn && size === 0);
  return (
    <form
      class="question row"
      onSubmit={(event) => {
        event.preventDefault();
        if (fits) answer(String(size));
      }}
    >
      <Field
        label={`${question.text}, ${name}`}
        inputMode={isTurn ? "text" : "decimal"}
        value={text}
        aria-invalid={text !== "" && !fits}
        hear={setText}
      />
      <button type="submit" class={isTurn ? "" : "primary"} disabled={busy || !fits}>
        {!isTurn ? "Keep it" : fits ? `Turn it by ${namedLength(size, unit)} of chain` : "Turn it"}
      </button>
      {isTurn && (
        <button type="button" class="primary" disabled={busy} onClick={() => answer("0")}>
          A tooth points straight up; nothing moves
        </button>
      )}
      {!fits && text !== "" && (
        <small class="wrong">
          Type a number from {shownLength(low, unit)} to {shownLength(high, unit)}.
        </small>
      )}
    </form>
  );
}
