// Stop and Hold: sent until answered, both over the live connection and as a request.

export type Way = "stop" | "hold";
/** The state of the last press. */
export interface Press {
  way: Way;
  state: "sent" | "unanswered" | "done" | "refused";
  /** Why it was refused. */
  line: string;
  at: number; // [ms] when it was pressed
  tries: number;
}

export interface Channel {
  /** Sends a press and waits for its answer for a moment. */
  press: (way: Way) => Promise<void>;
  /** Whether there was no answer, so that the press has to be sent again. */
  isSilence: (error: unknown) => boolean;
  /** Waits before the next try. */
  rest: () => Promise<void>;
}

export class Presses {
  private newest = 0;
  private readonly channel: Channel;
  private readonly hear: (press: Press) => void;

  constructor(channel: Channel, hear: (press: Press) => void) {
    this.channel = channel;
    this.hear = hear;
  }

  /** Sends a press until it is answered, or another is pressed. */
  async press(way: Way): Promise<void> {
    this.newest += 1;
    const turn = this.newest;
    const at = Date.now();
    let tries = 0;
    const hear = (state: Press["state"], line = "") => {
      if (turn === this.newest) this.hear({ way, state, line, at, tries });
    };
    hear("sent");
    while (turn === this.newest) {
      tries += 1;
      try {
        await this.channel.press(way);
        return hear("done");
      } catch (error) {
        if (!this.channel.isSilence(error))
          return hear("refused", error instanceof Error ? error.message : String(error));
      }
      hear("unanswered");
      await this.channel.rest();
    }
  }

  /** Stops sending: something else was pressed. */
  giveUp(): void {
    this.newest += 1;
  }
}
