// A number that can be measured by hand: the reading, and its uncertainty.
import { useEffect, useRef } from "preact/hooks";
import type { Schemas } from "../../api/client";
import { shownLength, typedLength, type Unit, useUnits } from "../../controls/lengths";
import { useTyped } from "../../controls/useTyped";
import { Do, useDo } from "../../shell/doing";
import { useMachine } from "../../shell/machine";
import { useTell } from "../../shell/project";

type Known = Schemas["KnownNumber"];

interface NumberParts {
  number: Known;
  here: boolean;
  /** The address asked for it. */
  wanted: boolean;
  look: () => void;
}

export function KnownNumber({ number, here, wanted, look }: NumberParts) {
  const units = useUnits();
  const isVirtual = useMachine().kind === "virtual";
  const place = useRef<HTMLLIElement>(null);
  useEffect(() => {
    if (wanted) place.current?.scrollIntoView({ block: "center" });
  }, [wanted]);
  const tell = useTell();
  const [, run, notKept] = useDo();
  const keep = (read: number | null, within = number.usual) =>
    void run(() => tell("known", { name: number.name, read, within }));
  const unit: Unit = number.unit === "mm" ? units : "mm";
  const name = number.unit === "mm" ? unit : number.unit;
  const show = (read: number) => shownLength(read, unit, number.digits);
  const [before, within] = number.stated ?? [undefined, number.usual];
  const saved = before === undefined ? "" : show(before);
  const sure = shownLength(within, unit, Math.max(number.digits, 1));
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
      if (number.stated) keep(null);
    } else if (!wrong && typed !== undefined && error !== undefined) {
      if (read !== saved || sigma !== sure) keep(typed, error);
    }
  };
  return (
    <li ref={place} class={here ? "box here" : "box"} onFocusCapture={look}>
      <b>{number.title}</b>
      <small>{number.believed_said}</small>
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
      {notKept}
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
        <Do meanwhile="Measuring …" work={() => tell("known/measured", { name: number.name })}>
          Measure it on the virtual machine
        </Do>
      )}
    </li>
  );
}
