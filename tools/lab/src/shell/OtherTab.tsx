// Says that another tab edits the folder, and takes over.
import { Trouble } from "../controls/Trouble";
import { Do } from "./doing";
import { takeOver, useReadOnly } from "./editor";
import { useOutbox } from "./kept";
import { waitingPlaces } from "./outbox";

export function OtherTab() {
  useOutbox();
  if (!useReadOnly()) return null;
  return (
    <Trouble>
      This folder is open in another tab. Here nothing can be changed.{" "}
      {waitingPlaces().length > 0 && "What you typed here last is not saved. "}
      <Do work={takeOver}>Take over</Do>
    </Trouble>
  );
}
