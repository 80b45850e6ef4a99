// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { beyond, withInstead } from "./distances.ts";

const [near, far, again] = [
  { between: ["1", "2"], length: 500 },
  { between: ["1", "9"], length: 2500 },
  { between: ["1", "2"], length: 501 },
];

test("a distance is taken out wherever it is by now, and no other between the same marks", () => {
  assert.deepEqual(withInstead([far, again, near], near), [far, again]);
  assert.deepEqual(withInstead([near, near], near), [near]);
});

test("another distance takes its place", () => {
  const right = { ...far, length: 2505 };
  assert.deepEqual(withInstead([near, far, again], far, right), [near, right, again]);
});

test("what is gone by now takes nothing with it", () => {
  assert.deepEqual(withInstead([near], far), [near]);
  assert.deepEqual(withInstead([near], far, again), [near, again]);
});

test("what was not asked, or measured once more, is beyond", () => {
  const spans = [
    ["2", "1"],
    ["3", "4"],
  ];
  assert.deepEqual(beyond([near, far, again], spans), [far, again]);
  assert.deepEqual(beyond([near], []), [near]);
});
