// The reading of a mark, from two edges. Text stays as it was typed; half a reading is kept in this browser.
import { useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { store, stored } from "../api/stored";
import {
  lengthText,
  namedLength,
  noLength,
  typedLength,
  type Unit,
  useUnits,
} from "../controls/lengths";
import { useProject } from "../shell/project";
import { pasted } from "./paste";
import type { Form, Place, TypedForm } from "./useReadings";

export interface CellParts {
  mark: Schemas["AskedMark"];
  form: Form;
  readings: TypedForm;
  doubted: boolean;
  /** An earlier mark has the same name. */
  again: boolean;
  /** Goes on to the mark after it. */
  next: () => void;
}

export function Cell({ mark, form, readings, doubted, again, next }: CellParts) {
  const { kept, open } = readings;
  const { edges, file, marks } = form;
  const { index } = mark;
  const from = edges.split("-").reverse() as [string, string]; // across, upright
  const place = { key: useProject().project.key, file, index };
  const value = kept.value[index];
  const units = useUnits();
  const [texts, setTexts] = useState<Texts | undefined>(() => halfOf(place, edges));
  const saysValue = texts && (value ? means(texts, value, units) : !complete(texts, units));
  const said = saysValue ? texts : undefined;
  const shown = said ?? (value ? value.map((mm) => lengthText(mm, units)) : ["", ""]);
  const name = again ? `${mark.name} again` : mark.name;
  const type = (axis: 0 | 1, text: string) => {
    const typed = [shown[0] ?? "", shown[1] ?? ""] as [string, string];
    typed[axis] = text;
    setTexts(typed);
    const read = complete(typed, units);
    const isHalf = !read && typed.some((each) => each.trim() !== "");
    // Half a reading does not count, and the number before it no longer does either.
    if (read || value)
      kept.put(({ [index]: _, ...others }) => (read ? { ...others, [index]: read } : others));
    keepHalf(place, isHalf ? { edges, texts: typed } : undefined);
  };
  /** Takes columns of a spreadsheet; returns whether the text was some. */
  const paste = (text: string) => {
    const more = pasted(text, marks, index, units);
    if (more) kept.put((typed) => ({ ...typed, ...more }));
    return more !== undefined;
  };
  // A phone shows the cell that is open, where there are many.
  return (
    <fieldset
      class={`cell ${doubted ? "doubted" : ""} ${index === open ? "open" : ""}`}
      id={`mark-${index}`}
    >
      <legend class="name">{name}</legend>
      {([0, 1] as const).map((axis) => {
        const text = shown[axis] ?? "";
        const reason = lacks([shown[0] ?? "", shown[1] ?? ""], axis, from, units);
        const reasonId = `mark-${index}-${axis}`;
        return (
          <span key={axis} class="half">
            <input
              inputMode={units === "mm" ? "decimal" : "text"}
              autoComplete="off"
              enterKeyHint="next"
              aria-label={`Mark ${name} from the ${from[axis]}, ${units}`}
              aria-invalid={reason !== ""}
              aria-describedby={reason ? reasonId : undefined}
              value={text}
              onInput={(event) => type(axis, event.currentTarget.value)}
              onKeyDown={(event) => {
                if (event.key !== "Enter") return;
                const after = event.currentTarget.parentElement?.nextElementSibling;
                const field = after?.querySelector("input");
                if (field) field.focus();
                else next();
              }}
              onPaste={(event) => {
                if (paste(event.clipboardData?.getData("text") ?? "")) event.preventDefault();
              }}
            />
            {reason && (
              <small id={reasonId} class={text ? "wrong" : "wrong awaited"}>
                {reason}
              </small>
            )}
          </span>
        );
      })}
      <span class="off soft">{doubted ? "look again" : offBy(mark, units)}</span>
    </fieldset>
  );
}

/** How far a mark is from where it was sent. */
function offBy({ place, target: [x, y] }: CellParts["mark"], units: Unit): string {
  return place ? namedLength(Math.hypot(place[0] - x, place[1] - y), units) : "";
}

/** Why a field is not accepted; empty if it is. */
function lacks(texts: Texts, axis: 0 | 1, from: readonly [string, string], units: Unit): string {
  const isMissing = texts[axis].trim() === "" && texts[1 - axis]?.trim() !== "";
  return isMissing ? `not read: from the ${from[axis]}?` : noLength(texts[axis], units);
}

/** Both numbers [mm], if both are lengths. */
function complete(texts: Texts, units: Unit): Place | undefined {
  const [x, y] = texts.map((text) => typedLength(text, units));
  return x === undefined || y === undefined ? undefined : [x, y];
}

/** Whether the texts show this reading. */
function means(texts: Texts, value: Place | undefined, units: Unit): boolean {
  const read = complete(texts, units);
  return !!read && !!value && read.every((mm, axis) => Math.abs(mm - (value[axis] ?? 0)) < 1e-3);
}

// Half readings, and texts that are not yet lengths: kept in this browser until complete. They do not count.

const PREFIX = "plumb-half:";
type Texts = readonly [string, string];

/** A mark of a form, in the folder with this key. */
interface HalfPlace {
  key: string;
  file: string;
  index: number;
}

interface Half {
  edges: string; // from which it was typed
  texts: Texts;
}

/** What was typed for a mark, from these edges. */
function halfOf({ key, file, index }: HalfPlace, edges: string): Texts | undefined {
  const half = halvesOf(key)[`${file}:${index}`];
  return half?.edges === edges ? half.texts : undefined;
}

/** Stores half a reading, or removes it if there is none. */
function keepHalf({ key, file, index }: HalfPlace, half: Half | undefined): void {
  const { [`${file}:${index}`]: _, ...others } = halvesOf(key);
  const all = half ? { ...others, [`${file}:${index}`]: half } : others;
  store(PREFIX + key, all);
}

function halvesOf(key: string): Record<string, Half> {
  return stored(PREFIX + key) ?? {};
}
