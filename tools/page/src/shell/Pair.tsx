// The first screen on a phone: pairs it by the computer's PIN, automatically after a scan of the code.
import { useEffect, useState } from "preact/hooks";
import { type Schemas, send } from "../api/client";
import { kindOfPhone } from "../api/here";
import { Field } from "../controls/Field";
import { useDo } from "./doing";
import { Screen } from "./Screen";

const SCANNED = /^#\/pair\/(\d{6})$/;

export function Pair({ paired }: { paired: () => Promise<void> }) {
  const [pin, setPin] = useState("");
  const [busy, run, refusal] = useDo();
  const pair = (typed: string) =>
    run(async () => {
      const body = { pin: typed, kind: kindOfPhone() };
      await send<Schemas["Phone"]>("POST", "phones/pair", body);
      await paired();
    });
  useEffect(() => {
    const scanned = SCANNED.exec(location.hash)?.[1];
    location.hash = "#/readings"; // the PIN does not stay in the address line
    if (scanned) void pair(scanned);
  }, []);
  return (
    <main id="screen">
      <Screen
        title="Pair this phone"
        say="Scan the code that the lab shows on the computer, or type the PIN that stands beside it."
      >
        <form
          class="row"
          onSubmit={(event) => {
            event.preventDefault();
            void pair(pin);
          }}
        >
          <Field
            label="PIN"
            inputMode="numeric"
            autocomplete="one-time-code"
            maxLength={6}
            size={6}
            value={pin}
            hear={setPin}
          />
          <button type="submit" class="primary" disabled={busy || pin.length < 6}>
            Pair
          </button>
        </form>
        {refusal}
      </Screen>
    </main>
  );
}
