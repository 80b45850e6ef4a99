// A busy server's answers come in any order: this says which of them still count.

/** The order in which something was asked. */
export class Turns {
  private asked = 0;
  private newest = 0; // of the answers that counted

  /** Begins to ask; the number of this question. */
  begin(): number {
    this.asked += 1;
    return this.asked;
  }

  /** Whether the answer to a question still counts; from then on no answer to an earlier question does. */
  counts(question: number): boolean {
    if (question <= this.newest) return false;
    this.newest = question;
    return true;
  }

  /** Something newer than any answer is known. */
  overtake(): void {
    this.newest = this.asked;
  }
}
