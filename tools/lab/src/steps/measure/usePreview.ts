// Asks what a plan could tell a moment after it was changed; an answer to an older plan is ignored.
import { useEffect, useRef, useState } from "preact/hooks";
import { send } from "../../api/client";
import { later } from "../../api/rest";
import type { Layout, Place } from "./plan";

const MOMENT_MS = 250;

export function usePreview(layout: Layout.Id, places: Place[], settings: string) {
  const [plan, setPlan] = useState<Layout.Plan>();
  const [trouble, setTrouble] = useState("");
  const [looking, setLooking] = useState(false);
  const newest = useRef(0);
  const asked = JSON.stringify({ layout, places: layout === "own" ? places : [] });
  useEffect(() => {
    newest.current += 1;
    const mine = newest.current;
    setLooking(true);
    return later(() => {
      send<Layout.Plan>("POST", "preview", JSON.parse(asked))
        .then(
          (answer) => {
            if (mine !== newest.current) return;
            setPlan(answer);
            setTrouble("");
          },
          (error: Error) => mine === newest.current && setTrouble(error.message),
        )
        .finally(() => mine === newest.current && setLooking(false));
    }, MOMENT_MS);
  }, [asked, settings]);
  return { plan, trouble, looking };
}
