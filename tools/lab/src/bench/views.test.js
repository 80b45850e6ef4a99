// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { largest, longest, viewOf } from "./views.ts";

const bench = { marks: [{ error: [9, 9], left_chain_residual: 8, right_chain_residual: 7 }] };
const frame = { errors: [[3, -1]], chains: [[2, null]] };
const now = { fit: { errors: [[1, 1]], chains: [[0.5, 1]] } };
const live = { frame, now };
const drawn = { moved: [[4, 5]], chains: [[6, 7]] };

test("the difference is what the effects take away from the frame's errors", () => {
  assert.deepEqual(viewOf("difference", bench, live, undefined), {
    errors: [[2, -2]],
    chains: [[1.5, null]],
  });
});

test("each view shows its state, and nothing while that is on its way", () => {
  assert.equal(viewOf("before", bench, live, undefined), frame);
  assert.equal(viewOf("now", bench, live, undefined), now.fit);
  assert.deepEqual(viewOf("as_set", bench, {}, undefined).errors, [[9, 9]]);
  assert.deepEqual(viewOf("drawn", bench, live, drawn), { errors: [[4, 5]], chains: [[6, 7]] });
  assert.equal(viewOf("drawn", bench, live, undefined), undefined);
  assert.equal(viewOf("difference", bench, { frame }, undefined), undefined);
});

test("the scale is that of the longest error and of the largest in chain, whatever its sign", () => {
  const errors = [
    [3, -4],
    [0, 1],
  ];
  assert.equal(longest(errors), 5);
  assert.equal(largest([[-2, null]]), 2);
});
