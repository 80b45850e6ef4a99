// The serial ports of this computer, looked at again and again: a board that is plugged in appears.
import { useEffect, useState } from "preact/hooks";
import { get, isSilence, type Schemas } from "../api/client";
import { LOOK_MS } from "../api/patience";
import { Lookout } from "./lookout";

export type Port = Schemas["Port"];
const EVERY_MS = 3000;

export function usePorts(wanted = true): Port[] {
  const [ports, setPorts] = useState<Port[]>([]);
  useEffect(() => {
    if (!wanted) return;
    const lookout = new Lookout(() => get<Port[]>("machine/ports", LOOK_MS), isSilence, {
      state: setPorts,
      silence: (is) => is && setPorts([]),
      refusal: () => setPorts([]),
    });
    void lookout.look();
    const timer = setInterval(() => void lookout.look(), EVERY_MS);
    return () => clearInterval(timer);
  }, [wanted]);
  return ports;
}
