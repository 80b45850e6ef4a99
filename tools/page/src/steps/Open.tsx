// Step 1: choose the machine: a file of settings, a port, or a virtual machine.
import { type Project, sendFile } from "../api/client";
import { isPhone } from "../api/here";
import { Connection } from "../machine/Connection";
import { BeginStep, FirstDay, useGuide } from "../machine/Guide";
import { MachinePicture } from "../machine/MachinePicture";
import { Phones } from "../machine/Phones";
import { useMachine } from "../shell/machine";
import { PickFile } from "../shell/PickFile";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";

export function Open() {
  const { project } = useProject();
  const { machine } = project;
  const guide = useGuide();
  const connected = useMachine().kind !== "none";
  // An unfinished first day comes first.
  const begun = guide.state?.steps.some((step) => step.done) && guide.state.open !== "";
  const first = connected && (begun || guide.state?.here !== "" || !machine);
  const read = machine ? `plumb settings ${machine.file}` : "plumb read -o machine.toml";
  return (
    <Screen
      {...project.heading}
      why={
        <p>
          Everything below is worked out from these numbers. They are those with which the machine
          cuts, right or wrong: your marks show how wrong.
        </p>
      }
      command={read}
      stage={machine && <Opened machine={machine} />}
      fieldsFirst={!!guide.state?.here}
      act={first && <BeginStep {...guide} />}
    >
      {first && <FirstDay {...guide} isNext />}
      <SettingsFile />
      <Connection />
      {connected && !first && <FirstDay {...guide} isNext={false} />}
      {!isPhone && <Phones />}
    </Screen>
  );
}

function Opened({ machine }: { machine: NonNullable<Project["machine"]> }) {
  return (
    <figure>
      <MachinePicture machine={machine} />
      <figcaption>
        <strong>{machine.file}</strong>: {machine.said}
      </figcaption>
    </figure>
  );
}

function SettingsFile() {
  const { project, take } = useProject();
  return (
    <PickFile
      title={project.machine ? `${project.machine.file} is open; open another` : "Settings' file"}
      hint="groundcontrol.ini, webcontrol.json or machine.toml"
      accept=".ini,.json,.toml"
      take={async (file) => take(await sendFile<Project>("settings", file))}
    />
  );
}
