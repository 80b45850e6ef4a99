// A number that can be measured by hand: what is read, and how far that may be off.
import { useEffect, useState } from "preact/hooks";
import type { Schemas } from "../../api/client";
import { shownLength, typedLength, type Unit } from "../../controls/lengths";
import { useProject } from "../../shell/project";
import { numberOf, readingOf, type Value } from "./values";

type Known = Schemas["KnownNumber"];

interface NumberParts {
  number: Known;
  known: Value | undefined;
  here: boolean;
  look: () => void;
  keep: (value: Value | undefined) => void;
}

export function KnownNumber({ number, known, here, look, keep }: NumberParts) {
  const { project } = useProject();
  const unit: Unit = number.unit === "mm" ? (project.choices.units ?? "mm") : "mm";
  const name = number.unit === "mm" ? unit : number.unit;
  const show = (read: number) => shownLength(read, unit, number.digits);
  const stated = known && readingOf(number, known);
  const saved = stated ? show(stated.value) : "";
  const sure = shownLength(stated?.sigma ?? number.usual, unit, Math.max(number.digits, 1));
  const [read, setRead] = useState(saved);
  const [sigma, setSigma] = useState(sure);
  useEffect(() => setRead(saved), [saved]);
  useEffect(() => setSigma(sure), [sure]);
  const [typed, error] = [typedLength(read, unit), typedLength(sigma, unit)];
  const wrong = (read !== "" && typed === undefined) || error === undefined || error <= 0;
  const done = () => {
    if (read === "") {
      if (known) keep(undefined);
    } else if (!wrong && typed !== undefined && error !== undefined) {
      if (read !== saved || sigma !== sure) keep(numberOf(number, { value: typed, sigma: error }));
    }
  };
  return (
    <li class={here ? "here" : ""} onFocusCapture={look}>
      <b>{number.title}</b>
      <small>
        {number.believed === null
          ? "the settings leave it out"
          : `the settings say ${show(number.believed)} ${name}`}
      </small>
      {here && <small class="steps">{number.steps}</small>}
      <span class="typed">
        <input
          inputMode="decimal"
          aria-label={`${number.title}, ${name}`}
          aria-invalid={wrong}
          placeholder="not measured"
          value={read}
          onInput={(event) => setRead(event.currentTarget.value)}
          onBlur={done}
        />
        <span aria-hidden="true">±</span>
        <input
          class="sigma"
          inputMode="decimal"
          aria-label={`${number.title}: how far it may be off, ${name}`}
          value={sigma}
          onInput={(event) => setSigma(event.currentTarget.value)}
          onBlur={done}
        />{" "}
        {name}
      </span>
      {wrong && (
        <small class="wrong">Type a number, like {show(number.believed ?? number.usual)}.</small>
      )}
    </li>
  );
}
