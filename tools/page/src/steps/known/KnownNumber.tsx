// A number that can be measured by hand: the reading, and its uncertainty.
import { useEffect, useRef } from "preact/hooks";
import { type Schemas, send } from "../../api/client";
import { shownLength, typedLength, type Unit } from "../../controls/lengths";
import { useUnits } from "../../controls/units";
import { useTyped } from "../../controls/useTyped";
import { Do } from "../../shell/doing";
import { useMachine } from "../../shell/machine";
import { numberOf, readingOf, type Value } from "./values";

type Known = Schemas["KnownNumber"];

interface NumberParts {
  number: Known;
  known: Value | undefined;
  here: boolean;
  /** The address asked for it. */
  wanted: boolean;
  look: () => void;
  keep: (value: Value | undefined) => void;
}

export function KnownNumber({ number, known, here, wanted, look, keep }: NumberParts) {
  const units = useUnits();
  const isVirtual = useMachine().kind === "virtual";
  const place = useRef<HTMLLIElement>(null);
  useEffect(() => {
    if (wanted) place.current?.scrollIntoView({ block: "center" });
  }, [wanted]);
  const measure = async () =>
    keep(await send<Value>("POST", "known/measured", { name: number.name }));
  const unit: Unit = number.unit === "mm" ? units : "mm";
  const name = number.unit === "mm" ? unit : number.unit;
  const show = (read: number) => shownLength(read, unit, number.digits);
  const stated = known && readingOf(number, known);
  const saved = stated ? show(stated.value) : "";
  const sure = shownLength(stated?.sigma ?? number.usual, unit, Math.max(number.digits, 1));
  const isWrong = (text: string) => text !== "" && typedLength(text, unit) === undefined;
  const [read, setRead] = useTyped(saved, isWrong);
  const [sigma, setSigma] = useTyped(sure, () => false);
  const [typed, error] = [typedLength(read, unit), typedLength(sigma, unit)];
  const wrong = isWrong(read) || error === undefined || error <= 0;
  // Why the saved value is impossible; hidden while it is being retyped.
  const refused = read === saved ? number.refused : "";
  const done = () => {
    if (read === "" || isWrong(read)) {
      // The number before it does not count any more.
      if (known) keep(undefined);
    } else if (!wrong && typed !== undefined && error !== undefined) {
      if (read !== saved || sigma !== sure) keep(numberOf(number, { value: typed, sigma: error }));
    }
  };
  return (
    <li ref={place} class={here ? "box here" : "box"} onFocusCapture={look}>
      <b>{number.title}</b>
      <small>
        {number.believed === null
          ? "the settings leave it out"
          : `the settings say ${show(number.believed)} ${name}`}
      </small>
      {here && <small>{number.steps}</small>}
      <span class="row">
        <input
          inputMode="decimal"
          aria-label={`${number.title}, ${name}`}
          aria-invalid={wrong || refused !== ""}
          aria-describedby={wrong ? `no-number-${number.name}` : undefined}
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
      {refused && (
        <small class="wrong" role="alert">
          {refused}
        </small>
      )}
      {wrong && (
        <small class="wrong" id={`no-number-${number.name}`}>
          Type a number, like {show(number.believed ?? number.usual)}.
        </small>
      )}
      {here && isVirtual && (
        <Do meanwhile="Measuring …" work={measure}>
          Measure it on the virtual machine
        </Do>
      )}
    </li>
  );
}
