// A question of the guide. A button that moves something says what and how far.
import { useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { namedLength, shownLength, typedLength, useUnits } from "../controls/lengths";

interface QuestionParts {
  question: Schemas["Question"];
  busy: boolean;
  answer: (reply: string) => void;
}

export function GuideQuestion(parts: QuestionParts) {
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
      <label>
        {question.text}, {name}{" "}
        <input
          inputMode={isTurn ? "text" : "decimal"}
          value={text}
          aria-invalid={text !== "" && !fits}
          onInput={(event) => setText(event.currentTarget.value)}
        />
      </label>
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
