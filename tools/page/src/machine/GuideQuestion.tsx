// A question of the guide. A button that moves something says what and how far.
import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { namedLength, shownLength, typedLength } from "../controls/lengths";
import { useProject } from "../shell/project";

type Question = Schemas["Question"];

interface QuestionParts {
  question: Question;
  busy: boolean;
  answer: (reply: string) => void;
}

export function GuideQuestion(parts: QuestionParts) {
  const { question, busy, answer } = parts;
  if (question.kind === "turn") return <Turn {...parts} />;
  if (question.kind === "length" || question.kind === "mass") return <Size {...parts} />;
  const replies: [string, string][] =
    question.kind === "choice"
      ? question.answers
      : question.kind === "go"
        ? [
            ["y", question.act],
            ["n", "Not now"],
          ]
        : [
            ["y", "Yes"],
            ["n", "No"],
          ];
  return (
    <fieldset class="question row">
      <legend>{question.text}</legend>
      {replies.map(([letter, words]) => (
        <button
          key={letter}
          type="button"
          class={question.kind === "go" && letter === "y" ? "primary" : ""}
          disabled={busy}
          onClick={() => answer(letter)}
        >
          {words}
        </button>
      ))}
    </fieldset>
  );
}

/** A length in the chosen unit, or a mass. */
function Size({ question, busy, answer }: QuestionParts) {
  const chosen = useProject().project.choices.units ?? "mm";
  const unit = question.kind === "mass" ? "mm" : chosen; // a mass is a plain number
  const name = question.kind === "mass" ? "kg" : chosen;
  const usual = question.usual;
  const [text, setText] = useState(usual == null ? "" : shownLength(usual, unit));
  const touched = usual == null || text !== shownLength(usual, unit);
  const size = touched ? typedLength(text, unit) : usual;
  const fits = size !== undefined && size >= question.low && size <= question.high;
  return (
    <Typed
      label={`${question.text}, ${name}`}
      text={text}
      type={setText}
      fits={fits}
      keep={() => answer(String(size))}
    >
      <button type="submit" class="primary" disabled={busy || !fits}>
        Keep it
      </button>
      {!fits && text !== "" && (
        <small class="wrong">
          Type a number from {shownLength(question.low, unit)} to {shownLength(question.high, unit)}
          .
        </small>
      )}
    </Typed>
  );
}

/** Turns a sprocket a little, again and again, until a tooth points straight up. */
function Turn({ question, busy, answer }: QuestionParts) {
  const unit = useProject().project.choices.units ?? "mm";
  const [text, setText] = useState("");
  const size = typedLength(text, unit);
  const fits = size !== undefined && size !== 0 && Math.abs(size) <= question.high;
  return (
    <Typed
      say={`Turn the ${question.text} sprocket until a tooth points straight up. Minus turns back.`}
      label={`How far, ${unit} of chain`}
      text={text}
      type={setText}
      fits={fits}
      keep={() => answer(String(size))}
    >
      <button type="submit" disabled={busy || !fits}>
        {fits
          ? `Turn the ${question.text} sprocket by ${namedLength(size, unit)} of chain`
          : `At most ${namedLength(question.high, unit)} at once`}
      </button>
      <button type="button" class="primary" disabled={busy} onClick={() => answer("0")}>
        A tooth points straight up; nothing moves
      </button>
    </Typed>
  );
}

interface TypedParts {
  say?: string;
  label: string;
  text: string;
  type: (text: string) => void;
  fits: boolean;
  keep: () => void;
  children: ComponentChildren;
}

/** A question answered with a number; Enter accepts it if it is valid. */
function Typed({ say, label, text, type, fits, keep, children }: TypedParts) {
  return (
    <form
      class="question row"
      onSubmit={(event) => {
        event.preventDefault();
        if (fits) keep();
      }}
    >
      {say && <p>{say}</p>}
      <label>
        {label}{" "}
        <input
          inputMode={say ? "text" : "decimal"}
          value={text}
          aria-invalid={text !== "" && !fits}
          onInput={(event) => type(event.currentTarget.value)}
        />
      </label>
      {children}
    </form>
  );
}
