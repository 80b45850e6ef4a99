// Runs with `node --test`.
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Presses } from "./presses.ts";

const SILENCE = new Error("nobody answers");
let asked, heard, rests, presses;

/** Lets everything go on that need not wait. */
const breath = () => new Promise((done) => setImmediate(done));

beforeEach(() => {
  asked = [];
  heard = [];
  rests = [];
  presses = new Presses(
    {
      press: (way) => new Promise((answer, fail) => asked.push({ way, answer, fail })),
      isSilence: (error) => error === SILENCE,
      rest: () => new Promise((done) => rests.push(done)),
    },
    ({ way, state, line }) => heard.push([way, state, line]),
  );
});

test("what is refused is said and not sent again", async () => {
  void presses.press("hold");
  asked[0].fail(new Error("no machine is connected"));
  await breath();
  assert.deepEqual(heard, [
    ["hold", "sent", ""],
    ["hold", "refused", "no machine is connected"],
  ]);
  assert.equal(asked.length, 1);
});

test("a newer press takes the place of one that nobody answers", async () => {
  void presses.press("hold");
  asked[0].fail(SILENCE);
  await breath();
  void presses.press("stop");
  rests[0]();
  await breath();
  assert.deepEqual(
    asked.map(({ way }) => way),
    ["hold", "stop"],
  );
  asked[1].answer();
  await breath();
  assert.deepEqual(heard.at(-1), ["stop", "done", ""]);
});

test("a hold that nobody answered is not sent after somebody went on", async () => {
  void presses.press("hold");
  asked[0].fail(SILENCE);
  await breath();
  presses.giveUp();
  rests[0]();
  await breath();
  assert.equal(asked.length, 1);
});
