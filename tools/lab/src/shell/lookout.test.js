// Runs with `node --test`.
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Lookout } from "./lookout.ts";

const SILENCE = new Error("nobody answers");
let asked, heard, lookout;

/** Questions that are answered when the test says so. */
function question() {
  return new Promise((answer, fail) => asked.push({ answer, fail }));
}

/** Lets everything go on that need not wait. */
const breath = () => new Promise((done) => setImmediate(done));

beforeEach(() => {
  asked = [];
  heard = [];
  lookout = new Lookout(question, (error) => error === SILENCE, {
    state: (state) => heard.push(state),
    silence: (is) => heard.push(is ? "silence" : "answered"),
    refusal: (error) => heard.push(error.message),
  });
});

test("a look waits for the answer to the look before it", async () => {
  void lookout.look();
  void lookout.look();
  assert.equal(asked.length, 1);
  asked[0].answer({ marks: 1 });
  await breath();
  assert.deepEqual(heard, [{ marks: 1 }, "answered"]);
  void lookout.look();
  assert.equal(asked.length, 2);
});

test("a look that nobody answered is said, and the next look is asked", async () => {
  void lookout.look();
  asked[0].fail(SILENCE);
  await breath();
  assert.deepEqual(heard, ["silence"]);
  void lookout.look();
  asked[1].answer("new");
  await breath();
  assert.deepEqual(heard, ["silence", "new", "answered"]);
});

test("a refusal is no silence", async () => {
  void lookout.look();
  asked[0].fail(new Error("no game"));
  await breath();
  assert.deepEqual(heard, ["no game"]);
});

test("an answer that a press has overtaken is dropped, and nobody looks while it is under way", async () => {
  void lookout.look();
  const pressed = lookout.press(() => question());
  asked[0].answer("old");
  await breath();
  void lookout.look();
  assert.equal(asked.length, 2);
  asked[1].answer("pressed");
  await pressed;
  assert.deepEqual(heard, ["answered", "pressed", "answered"]);
  void lookout.look();
  assert.equal(asked.length, 3);
});

test("a press that is refused says why, and looks go on", async () => {
  const pressed = lookout.press(() => question());
  asked[0].fail(new Error("no minutes are left"));
  await pressed;
  assert.deepEqual(heard, ["no minutes are left"]);
  void lookout.look();
  assert.equal(asked.length, 2);
});
