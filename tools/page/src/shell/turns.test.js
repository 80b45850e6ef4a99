// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Turns } from "./turns.ts";

test("an answer that a later one has overtaken does not count", () => {
  const turns = new Turns();
  const [first, second] = [turns.begin(), turns.begin()];
  assert.ok(turns.counts(second));
  assert.ok(!turns.counts(first));
});

test("what was asked before something newer is known does not count, what is asked after it does", () => {
  const turns = new Turns();
  const before = turns.begin();
  turns.overtake();
  assert.ok(!turns.counts(before));
  assert.ok(turns.counts(turns.begin()));
});
