// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { factorFor, rounded, ticks } from "./view.ts";

test("arrows are the longest that a sixth of the sheet allows, by a round factor", () => {
  assert.equal(factorFor([[3, 4], null], 2440, 0), 50);
  assert.equal(factorFor([[0, -8]], 2440, 0), 20);
  assert.equal(factorFor([[900, 0]], 2440, 0), 1);
  assert.equal(factorFor([], 2440, 0), 500);
});

test("a circle of noise has a sixteenth of the sheet at most, however short the arrows are", () => {
  assert.equal(factorFor([[1, 0]], 2440, 1.2), 100);
  assert.equal(factorFor([[1, 0]], 2440, 1.5), 50);
  assert.equal(factorFor([[8, 0]], 2440, 1.2), 20);
});

test("ticks are round, few, and from end to end whichever end comes first", () => {
  assert.deepEqual(ticks(-1342, 1342, 9), [-1000, -500, 0, 500, 1000]);
  assert.deepEqual(ticks(0.3, -0.3, 4), [-0.2, 0, 0.2]);
  assert.deepEqual(ticks(2, 2, 4), []);
  assert.deepEqual([1, 4.9, 5, 0.03, 700].map(rounded), [1, 2, 5, 0.02, 500]);
});
