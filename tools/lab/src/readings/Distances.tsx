// Distances between marks: they need no edge of the sheet.
import { useRef, useState } from "preact/hooks";
import { lengthText, namedLength, typedLength } from "../controls/lengths";
import { useProject } from "../shell/project";
import { beyond, withInstead } from "./distances";
import { type Distance, useDistances } from "./useDistances";
import type { Doubt } from "./useDoubts";
import type { Form } from "./useReadings";

interface DistancesParts {
  form: Form;
  take: (form: Form) => void;
  doubts: Doubt[];
}

export function Distances({ form, take, doubts }: DistancesParts) {
  const { project } = useProject();
  const units = project.choices.units ?? "mm";
  const names = namesOfOnePlace(form.marks);
  const [ends, setEnds] = useState(["", ""]);
  const [text, setText] = useState("");
  const length = typedLength(text, units);
  const [from = "", to = ""] = ends;
  const ready = from !== "" && to !== "" && from !== to && !!length && length > 0;
  const save = useDistances(form, take);
  const underWay = useRef("");
  const doubted = new Set(doubts.filter((doubt) => !doubt.is_mark).map((doubt) => doubt.index));
  const add = (event: Event) => {
    event.preventDefault();
    const typed = JSON.stringify([from, to, text]);
    // Who presses twice adds it once.
    if (!ready || !length || underWay.current === typed) return;
    underWay.current = typed;
    void save((all) => [...all, { between: [from, to], length }]).then((taken) => {
      // What was typed stays in its field until it is saved, and what is typed meanwhile stays too.
      if (taken) setText((now) => (now === text ? "" : now));
      if (underWay.current === typed) underWay.current = "";
    });
  };
  const change = (distance: Distance) => {
    setEnds(distance.between);
    setText(lengthText(distance.length, units));
    void save((all) => withInstead(all, distance));
  };
  const others = new Set(beyond(form.distances, form.spans));
  const list = form.distances.map((distance, index) => [distance, index] as const);
  return (
    <details class="distances" open={others.size > 0}>
      <summary>
        {form.spans.length > 0 ? "More distances" : "Distances between marks"} ({others.size})
      </summary>
      <ul class="plain">
        {list
          .filter(([distance]) => others.has(distance))
          .map(([distance, index]) => (
            <li
              key={`${distance.between.join("-")}-${distance.length}`}
              id={`distance-${index}`}
              class={doubted.has(index) ? "row doubted" : "row"}
            >
              <span>
                {distance.between.join(" to ")}: {namedLength(distance.length, units)}
              </span>
              <button type="button" onClick={() => change(distance)}>
                Change
              </button>
            </li>
          ))}
      </ul>
      <form class="row" onSubmit={add}>
        {([0, 1] as const).map((side) => (
          <label key={side}>
            {side === 0 ? "from mark" : "to mark"}
            <select
              value={ends[side]}
              onChange={(event) =>
                setEnds(ends.map((end, i) => (i === side ? event.currentTarget.value : end)))
              }
            >
              <option value="">?</option>
              {names.map((name) => (
                <option key={name}>{name}</option>
              ))}
            </select>
          </label>
        ))}
        <label>
          {units}
          <input
            inputMode={units === "mm" ? "decimal" : "text"}
            value={text}
            onInput={(event) => setText(event.currentTarget.value)}
          />
        </label>
        <button type="submit" disabled={!ready}>
          Add the distance
        </button>
      </form>
    </details>
  );
}

/** Names of marks from which a tape can be laid: a name with two places says nothing. */
function namesOfOnePlace(marks: Form["marks"]): string[] {
  const places = new Map<string, Set<string>>();
  for (const { name, target } of marks)
    places.set(name, (places.get(name) ?? new Set()).add(target.join()));
  return [...places].filter(([, each]) => each.size === 1).map(([name]) => name);
}
