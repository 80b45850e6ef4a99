// Practice: a virtual machine with something hidden, a budget, and a score.
import { useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { Screen } from "../shell/Screen";
import { Silence } from "../shell/Silence";
import { Bars } from "./Bars";
import { CutMarks } from "./CutMarks";
import { MoreToDo } from "./MoreToDo";
import { PracticeSheet } from "./PracticeSheet";
import { commands, type Picking, type Picks } from "./picks";
import { Score } from "./Score";
import { Solve } from "./Solve";
import { Start } from "./Start";
import { type Play, usePractice } from "./state";
import "./practice.css";

export function Practice() {
  const play = usePractice();
  const { practice } = play;
  const picking = usePicks(practice?.game);
  if (!practice) {
    return (
      <Screen title="Practice" say="The game is being looked for." busy={!play.silent}>
        <Silence silent={play.silent} />
      </Screen>
    );
  }
  if (!practice.game) {
    return (
      <Screen
        title="Practice"
        say="A virtual machine hides what is wrong with it. You cut marks, read them, and find out what it is. Nothing real moves."
        command={commands(picking.picks, null, false)}
        why={<Rules />}
      >
        <Silence silent={play.silent} />
        {practice.taken ? (
          <p class="missing">{practice.taken}</p>
        ) : (
          <Start play={play} {...picking} />
        )}
      </Screen>
    );
  }
  return <Playing play={play} game={practice.game} picking={picking} />;
}

/** What is picked; the level and the grid begin as the game suggests. */
function usePicks(game: Schemas["Game"] | null | undefined): Picking {
  const [picked, setPicked] = useState<Partial<Picks>>({});
  const usual: Picks = {
    level: game?.level ?? 1,
    seed: "",
    grid: game && game.names.length > 0 ? "3x3" : "5x5",
    mark: "",
    check: "",
    machine: "",
  };
  const pick = (change: Partial<Picks>) => setPicked((before) => ({ ...before, ...change }));
  return { picks: { ...usual, ...picked }, pick };
}

interface PlayingParts {
  play: Play;
  game: Schemas["Game"];
  picking: Picking;
}

function Playing({ play, game, picking }: PlayingParts) {
  const [places, setPlaces] = useState<[number, number][]>([]);
  const [placing, setPlacing] = useState(false);
  const doing = play.practice?.doing;
  return (
    <Screen
      title={game.score ? "Practice: solved" : `Practice, level ${game.level}`}
      say={
        game.score
          ? game.score.sentence
          : `Hidden is ${game.words}. Cut marks, think on the screens Verdict and Effects bench, then send new numbers. Nothing real moves.`
      }
      command={commands(picking.picks, game, placing)}
      why={<Rules />}
    >
      <Silence silent={play.silent} />
      {game.score ? <Score score={game.score} /> : <Bars game={game} />}
      {play.practice?.trouble && (
        <p class="trouble" role="alert">
          {play.practice.trouble}
        </p>
      )}
      {doing && (
        <p class="doing" role="status">
          <label for="doing">{doing.words}</label>
          <progress id="doing" max={doing.of} value={doing.done} />
          {doing.done} of {doing.of}
        </p>
      )}
      <PracticeSheet
        places={places}
        place={placing && !game.score ? (at) => setPlaces([...places, at]) : undefined}
      />
      {game.score ? (
        <Start play={play} {...picking} />
      ) : (
        <>
          <CutMarks
            play={play}
            game={game}
            placing={placing}
            setPlacing={setPlacing}
            places={places}
            setPlaces={setPlaces}
            {...picking}
          />
          {game.names.length > 0 && <Solve play={play} game={game} {...picking} />}
          <MoreToDo play={play} game={game} {...picking} />
        </>
      )}
    </Screen>
  );
}

function Rules() {
  return (
    <p>
      Each visit to the machine and each mark takes minutes; holes in the sheet are few. The score
      is the error that your numbers leave all over the sheet, next to that of somebody who knows
      the truth and has the same marks; and what you claimed that is not there. All files lie in
      this folder, and plumb practice plays the same game.
    </p>
  );
}
