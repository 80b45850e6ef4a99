// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { merge, same, withPlace } from "./merge.ts";

const was = { gap: { value: 3000, sigma: 5 }, marks: ["a"], units: "mm" };

test("what only one side changed is taken", () => {
  const mine = { ...was, units: "inch" };
  const theirs = { ...was, marks: ["a", "b"] };
  const { value, clashes } = merge(was, mine, theirs);
  assert.deepEqual(value, { ...was, units: "inch", marks: ["a", "b"] });
  assert.deepEqual(clashes, []);
});

test("records are merged name by name, at any depth", () => {
  const mine = { ...was, gap: { value: 3001, sigma: 5 } };
  const theirs = { ...was, gap: { value: 3000, sigma: 2 } };
  assert.deepEqual(merge(was, mine, theirs).value.gap, { value: 3001, sigma: 2 });
});

test("what both changed to the same is no clash; to different values it is, and mine is shown", () => {
  const mine = { ...was, gap: { value: 3001, sigma: 5 } };
  assert.deepEqual(merge(was, mine, structuredClone(mine)).clashes, []);
  const theirs = { ...was, gap: { value: 3002, sigma: 5 } };
  const { value, clashes } = merge(was, mine, theirs);
  assert.deepEqual(clashes, [{ path: ["gap", "value"], mine: 3001, theirs: 3002 }]);
  assert.equal(value.gap.value, 3001);
});

test("what somebody deleted stays deleted, and what the other added is kept", () => {
  const { units, ...mine } = was;
  const theirs = { ...was, fineness: 0.5 };
  const { value } = merge(was, mine, theirs);
  assert.deepEqual(value, { gap: was.gap, marks: was.marks, fineness: 0.5 });
});

test("a list is a single value", () => {
  const { clashes } = merge([1, 2], [1, 3], [1, 4]);
  assert.equal(clashes.length, 1);
});

test("a place is changed without touching the original", () => {
  const changed = withPlace(was, ["gap", "value"], 1);
  assert.equal(changed.gap.value, 1);
  assert.equal(was.gap.value, 3000);
  assert.equal("units" in withPlace(was, ["units"], undefined), false);
});

test("a missing name and an undefined value are the same", () => {
  assert.ok(same({ a: undefined }, {}));
  assert.ok(!same({ a: 0 }, {}));
  assert.ok(!same([1], [1, 2]));
  assert.ok(!same(null, {}));
});
