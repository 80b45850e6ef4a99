// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { asked } from "./asked.ts";

const gap = { name: "motor_gap", before: "2978.7", after: "2978.7" };
const height = { name: "motor_height", before: "1072.6", after: "1067.6" };

test("a number that stays as it is shown is not asked about", () => {
  assert.deepEqual(asked({ numbers: [gap, height], with_accepted: [] }, []), [height]);
});

test("an accepted number stays in view, as it becomes with what is accepted", () => {
  const again = { ...height, after: "1072.6" };
  const made = { numbers: [gap, height], with_accepted: [again] };
  assert.deepEqual(asked(made, ["motor_gap", "motor_height"]), [gap, again]);
  assert.deepEqual(asked(made, []), []);
});
