// What would help most in addition to these marks; it is worked out when somebody asks.
import { useEffect, useState } from "preact/hooks";
import { send } from "../../api/client";
import { useDo } from "../../shell/doing";
import type { Layout, Place } from "./plan";

interface AdditionsParts {
  plan: Layout.Plan;
  layout: Layout.Id;
  places: Place[];
}

export function Additions({ plan, layout, places }: AdditionsParts) {
  const [additions, setAdditions] = useState<Layout.Addition[]>();
  const [busy, run, refusal] = useDo();
  const asked = JSON.stringify({ layout, places: layout === "own" ? places : [] });
  useEffect(() => setAdditions(undefined), [asked]);
  const ask = async () =>
    setAdditions(await send<Layout.Addition[]>("POST", "preview/additions", JSON.parse(asked)));
  if (!additions)
    return (
      <>
        <button type="button" disabled={busy} onClick={() => void run(ask)}>
          {busy ? "Working; this takes some seconds …" : "What would help most?"}
        </button>
        {refusal}
      </>
    );
  return (
    <section class="additions">
      <h2>What would help most, per minute</h2>
      <ol>
        {additions.map((addition) => (
          <li key={addition.title}>
            <b>{addition.title}</b>: about {Math.round(addition.minutes)} min, {plan.named} →{" "}
            {addition.named} causes could be named. {addition.do.join(" ")}
          </li>
        ))}
      </ol>
    </section>
  );
}
