// Says that a file changed on disk while you were typing, and asks which version to keep.
import { Trouble } from "../controls/Trouble";
import type { Kept } from "./kept";

export function Changed<Value>({ kept }: { kept: Kept<Value> }) {
  if (!kept.changed) return null;
  return (
    <Trouble>
      The file has changed on disk, and what you typed is not saved.{" "}
      <button type="button" onClick={() => kept.settle(true)}>
        Keep mine
      </button>{" "}
      <button type="button" onClick={() => kept.settle(false)}>
        Take the file's
      </button>
    </Trouble>
  );
}
