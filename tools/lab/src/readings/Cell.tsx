// Where a mark is, from the two edges. What is typed stays as it was typed; half a reading waits in this browser.
import { useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { lengthText, typedLength, type Unit } from "../controls/lengths";
import { forgetHalf, halfOf, keepHalf } from "./halves";
import type { Place } from "./useReadings";

interface CellParts {
  mark: Schemas["AskedMark"];
  value: Place | undefined;
  units: Unit;
  /** Names of the two edges, like "left". */
  from: readonly [string, string];
  /** Its name among the halves that wait. */
  place: string;
  doubted: boolean;
  /** Another mark of this name comes before it. */
  again: boolean;
  /** Goes on to the mark after it. */
  next: () => void;
  change: (value: Place | undefined) => void;
  paste: (text: string) => boolean;
}

export function Cell({
  mark,
  value,
  units,
  from,
  place,
  doubted,
  again,
  next,
  change,
  paste,
}: CellParts) {
  const [texts, setTexts] = useState<readonly [string, string] | undefined>(() => halfOf(place));
  const said = texts && (means(texts, value, units) || !complete(texts, units)) ? texts : undefined;
  const shown = said ?? (value ? value.map((mm) => lengthText(mm, units)) : ["", ""]);
  const name = again ? `${mark.name} again` : mark.name;
  const type = (axis: 0 | 1, text: string) => {
    const next = [shown[0] ?? "", shown[1] ?? ""] as [string, string];
    next[axis] = text;
    setTexts(next);
    const read = complete(next, units);
    if (read) change(read);
    else if (!next[0].trim() && !next[1].trim()) change(undefined);
    if (read || (!next[0].trim() && !next[1].trim())) forgetHalf(place);
    else keepHalf(place, next);
  };
  return (
    <fieldset class={doubted ? "cell doubted" : "cell"} id={`mark-${mark.index}`}>
      <legend>{name}</legend>
      {([0, 1] as const).map((axis) => {
        const text = shown[axis] ?? "";
        const wrong = text.trim() !== "" && typedLength(text, units) === undefined;
        return (
          <input
            key={axis}
            inputMode={units === "mm" ? "decimal" : "text"}
            autoComplete="off"
            enterKeyHint="next"
            aria-label={`Mark ${name} from the ${from[axis]}, ${units}`}
            aria-invalid={wrong}
            placeholder={lengthText(mark.meant[axis], units)}
            value={text}
            onInput={(event) => type(axis, event.currentTarget.value)}
            onKeyDown={(event) => {
              if (event.key !== "Enter") return;
              const after = event.currentTarget.nextElementSibling;
              if (after instanceof HTMLInputElement) after.focus();
              else next();
            }}
            onPaste={(event) => {
              if (paste(event.clipboardData?.getData("text") ?? "")) event.preventDefault();
            }}
          />
        );
      })}
    </fieldset>
  );
}

/** Both numbers [mm], if both are lengths. */
function complete(texts: readonly [string, string], units: Unit): Place | undefined {
  const [x, y] = texts.map((text) => typedLength(text, units));
  return x === undefined || y === undefined ? undefined : [x, y];
}

/** Whether the texts say this reading. */
function means(texts: readonly [string, string], value: Place | undefined, units: Unit): boolean {
  const read = complete(texts, units);
  return !!read && !!value && read.every((mm, axis) => Math.abs(mm - (value[axis] ?? 0)) < 1e-3);
}
