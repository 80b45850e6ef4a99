// The live connection to the lab: it reports the machine at least once a second, and takes Stop and Hold.
import { Refusal, type Schemas, send } from "../api/client";
import { begin } from "../api/rest";
import { token } from "../api/token";
import type { Way } from "./presses";

type Answer = Schemas["MachineAnswer"];
const TRY_AGAIN_MS = 1000;
const SILENT_MS = 3500; // the lab reports each second; a busy computer may be late
const PRESS_MS = 2000; // for the answer to a press

export class Live {
  private socket: WebSocket | undefined;
  private timer = 0;
  private over = false;
  private greeted = () => {};
  private heardAt = Date.now();
  private count = 0;
  private readonly waiting = new Map<number, (error: string) => void>();
  private readonly hear: (machine: Answer) => void;

  constructor(hear: (machine: Answer) => void) {
    this.hear = hear;
  }

  open(): void {
    const address = new URL("api/live", location.href.replace(/^http/, "ws"));
    this.over = false;
    const socket = new WebSocket(address, ["plumb", ...(token() ? [token()] : [])]); // a phone has a cookie instead
    this.socket = socket;
    this.greeted = begin();
    socket.onmessage = (message) => this.take(JSON.parse(message.data));
    socket.onclose = () => {
      this.greeted();
      if (!this.over) this.timer = window.setTimeout(() => this.open(), TRY_AGAIN_MS);
    };
  }

  close(): void {
    this.over = true;
    clearTimeout(this.timer);
    this.socket?.close();
  }

  /** How long it has been silent [s]; 0 while it is alive. */
  silence(): number {
    const passed = Date.now() - this.heardAt;
    return passed < SILENT_MS ? 0 : Math.round(passed / 1000);
  }

  /** Sends a press over the live connection and as a request; the first answer counts. Fails without one. */
  async press(way: Way): Promise<void> {
    const request = send("POST", `machine/${way}`, undefined, PRESS_MS);
    const answers = [request.then(() => undefined)];
    if (this.socket?.readyState === WebSocket.OPEN) answers.push(this.overLine(this.socket, way));
    try {
      await Promise.any(answers);
    } catch (error) {
      const errors = (error as AggregateError).errors as Refusal[];
      throw errors.find(({ status }) => status !== 0) ?? errors[0];
    }
  }

  private overLine(socket: WebSocket, way: Way): Promise<undefined> {
    this.count += 1;
    const { count } = this;
    return new Promise((done, fail) => {
      const late = () => fail(new Refusal("The lab does not answer.", 0));
      const timer = setTimeout(late, PRESS_MS);
      this.waiting.set(count, (error) => {
        clearTimeout(timer);
        if (error) fail(new Refusal(error, 422));
        else done(undefined);
      });
      socket.send(`${way} ${count}`);
    });
  }

  private take(said: Answer | { press: number; error: string }): void {
    this.heardAt = Date.now();
    this.greeted();
    if ("press" in said) {
      this.waiting.get(said.press)?.(said.error);
      this.waiting.delete(said.press);
    } else this.hear(said);
  }
}
