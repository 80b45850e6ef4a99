// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { asked, believable, withAll } from "./asked.ts";

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

test("an impossible number is not among all that is accepted", () => {
  const numbers = [
    { name: "motor_gap", possible: true },
    { name: "frame_lean.tangent_squared", possible: false },
    { name: "motor_height", possible: true },
  ];
  assert.deepEqual(believable(numbers), ["motor_gap", "motor_height"]);
});

test("what was accepted by hand stays, and nothing is accepted twice", () => {
  assert.deepEqual(withAll(["lean", "motor_gap"], ["motor_gap", "motor_height"]), [
    "lean",
    "motor_gap",
    "motor_height",
  ]);
});
