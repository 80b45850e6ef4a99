// What another tab or program changed while somebody typed something else in the same place: both, and a choice.
import type { Kept } from "./kept";
import "./clashes.css";

interface ClashesParts<Value> {
  kept: Kept<Value>;
  /** What stands at a place, in words; its names by default. */
  name?: (path: string[]) => string;
  /** A value as people read it. */
  show?: (value: unknown) => string;
}

export function Clashes<Value>({
  kept,
  name = (path) => path.join(" "),
  show = (value) => (typeof value === "string" ? value : JSON.stringify(value)) || "nothing",
}: ClashesParts<Value>) {
  if (kept.clashes.length === 0) return null;
  return (
    <ul class="clashes" role="alert">
      {kept.clashes.map((clash) => (
        <li key={clash.path.join("/")}>
          <span>
            {name(clash.path)}: another tab saved {show(clash.theirs)}, and you chose{" "}
            {show(clash.mine)}.
          </span>
          <button type="button" onClick={() => kept.settle(clash, true)}>
            Use {show(clash.mine)}
          </button>
          <button type="button" onClick={() => kept.settle(clash, false)}>
            Keep {show(clash.theirs)}
          </button>
        </li>
      ))}
    </ul>
  );
}
