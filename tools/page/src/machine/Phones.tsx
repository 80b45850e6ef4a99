// The phones of this lab, shown on the computer: how to pair another, and what each may do.
import type { Schemas } from "../api/client";
import { Trouble } from "../controls/Trouble";
import { useWatched } from "../shell/watched";

type Answer = Schemas["PhonesAnswer"];

export function Phones() {
  const { state: answer, press, busy, refused } = useWatched<Answer>("phones");
  if (!answer) return null;
  const { invitation } = answer;
  return (
    <details open={answer.phones.length > 0}>
      <summary>Your phone at the machine</summary>
      {!invitation && (
        <p>
          Start the lab with <code>plumb lab --share</code>, and a phone in your network types
          readings, holds and stops.
        </p>
      )}
      {invitation?.address === "" && <p>This computer is in no network.</p>}
      {invitation?.picture && (
        <p class="row">
          <img src={invitation.picture} width="176" alt="The address and the PIN as a QR code" />
          <span>
            Scan it, or open {invitation.address} and type <b>{invitation.pin}</b>. Whoever is in
            your network can read what is sent.
          </span>
        </p>
      )}
      <ul class="plain">
        {answer.phones.map(({ number, name, may, may_move }) => (
          <li key={number} class="row">
            <b>{name}</b> {may}.
            <button
              type="button"
              disabled={busy}
              onClick={() => void press(`${number}/let`, { may_move: !may_move })}
            >
              {may_move ? `Stop ${name} from moving the machine` : `Let ${name} move the machine`}
            </button>
            <button type="button" disabled={busy} onClick={() => void press(`${number}/send-away`)}>
              Send {name} away
            </button>
          </li>
        ))}
      </ul>
      <Trouble>{refused}</Trouble>
    </details>
  );
}
