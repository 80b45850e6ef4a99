// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { believable, withAll } from "./believable.ts";

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
