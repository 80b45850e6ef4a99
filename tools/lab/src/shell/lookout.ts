// Looks at a state again and again: never twice at once, and on after a look that nobody answered.

/** Who hears what a look brings. */
export interface Hears<State> {
  state: (state: State) => void;
  /** Whether the last look was answered by nobody. */
  silence: (is: boolean) => void;
  refusal: (error: unknown) => void;
}

export class Lookout<State> {
  private looks = false;
  private presses = 0; // under way
  private pressed = 0; // so far

  private readonly ask: () => Promise<State>;
  private readonly isSilence: (error: unknown) => boolean;
  private readonly hears: Hears<State>;

  constructor(
    ask: () => Promise<State>,
    isSilence: (error: unknown) => boolean,
    hears: Hears<State>,
  ) {
    this.ask = ask;
    this.isSilence = isSilence;
    this.hears = hears;
  }

  /** Looks, unless a look or a press is under way. */
  async look(): Promise<void> {
    if (this.looks || this.presses > 0) return;
    this.looks = true;
    const { pressed } = this;
    try {
      const state = await this.ask();
      // An answer that a press has overtaken is old.
      if (pressed === this.pressed) this.hears.state(state);
      this.hears.silence(false);
    } catch (error) {
      if (this.isSilence(error)) this.hears.silence(true);
      else this.hears.refusal(error);
    } finally {
      this.looks = false;
    }
  }

  /** Changes the state, by a question that answers with the new state. */
  async press(send: () => Promise<State>): Promise<void> {
    this.presses += 1;
    this.pressed += 1;
    try {
      this.hears.state(await send());
      this.hears.silence(false);
    } catch (error) {
      this.hears.refusal(error);
    }
    this.presses -= 1;
  }
}
