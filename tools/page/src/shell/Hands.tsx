// On a phone: what it may do, if not everything.
import type { Schemas } from "../api/client";
import { useWatched } from "./watched";

export function Hands() {
  const { state: me } = useWatched<Schemas["PhoneAnswer"]>("phones/me");
  if (!me || me.may_move) return null;
  return (
    <p class="hands soft" role="status">
      {me.name} can look, type readings, hold and stop. On the computer you can let it move the
      machine too.
    </p>
  );
}
