// Runs with `node --test`.
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Succession } from "./succession.ts";

const FIRST = { digest: "", list: [] };
let disk, asked, succession;

/** A server that answers when the test says so, and refuses what was made of an older state. */
function put(digest, list) {
  return new Promise((answer, refuse) =>
    asked.push(() => {
      if (digest !== disk.digest) return refuse(new Error("changed"));
      disk = { digest: list.join(), list };
      answer(disk);
    }),
  );
}
const added = (number) => (now) => put(now.digest, [...now.list, number]);
const without = (number) => (now) =>
  put(
    now.digest,
    now.list.filter((each) => each !== number),
  );
const breath = () => new Promise((done) => setImmediate(done));

/** Answers whatever is asked, in its turn. */
async function answerAll() {
  for (await breath(); asked.length > 0; await breath()) asked.shift()();
}

beforeEach(() => {
  disk = FIRST;
  asked = [];
  succession = new Succession();
});

test("who still knows what was there long ago saves onto what is there now", async () => {
  for (const number of [1, 2, 3]) {
    const saved = succession.save(FIRST, added(number));
    await answerAll();
    await saved;
  }
  assert.deepEqual(disk.list, [1, 2, 3]);
});

test("a state that comes back is not taken for what replaced it", async () => {
  const mine = succession.save(FIRST, added(1));
  await answerAll();
  await mine;
  disk = FIRST; // by somebody else
  succession.learn(disk);
  const again = succession.save(FIRST, added(2));
  await answerAll();
  assert.deepEqual((await again).list, [2]);
});

test("what is taken back leads to the state before, not round and round", async () => {
  for (const save of [added(1), without(1), added(1)]) {
    const saved = succession.save(FIRST, save);
    await answerAll();
    await saved;
  }
  assert.deepEqual(disk.list, [1]);
  const more = succession.save(FIRST, added(2));
  await answerAll();
  assert.deepEqual((await more).list, [1, 2]);
});

test("a save that is refused does not stop those behind it", async () => {
  const refused = assert.rejects(
    succession.save(FIRST, async () => {
      throw new Error("no length");
    }),
  );
  const saved = succession.save(FIRST, added(1));
  await answerAll();
  await refused;
  assert.deepEqual((await saved).list, [1]);
});
