// Runs with `node --test`.
import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { inTime } from "./patience.ts";

test("an answer in time is taken, and nothing is given up after it", async () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  let given;
  const answer = await inTime(1000, async (signal) => {
    given = signal;
    return 7;
  });
  assert.equal(answer, 7);
  mock.timers.tick(5000);
  assert.ok(!given.aborted);
  mock.timers.reset();
});

test("what never answers is given up when the patience is over, not before", async () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  let given;
  const asked = inTime(1000, (signal) => {
    given = signal;
    return new Promise(() => undefined);
  });
  mock.timers.tick(999);
  assert.ok(!given.aborted);
  mock.timers.tick(1);
  await assert.rejects(asked, /no answer in 1000 ms/);
  assert.ok(given.aborted);
  mock.timers.reset();
});
