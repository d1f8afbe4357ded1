// The socket: commands out, events and frames in. The page has no other way to the studio, but for uploads and files.

import type { Command, Difference, Event, Picture, Regions, Shape } from "./messages";
import { PROTOCOL } from "./messages";

type Sent = Command extends infer C ? (C extends { id?: number } ? Omit<C, "id"> : never) : never;
export type Answer = Event | undefined;
/** The headers of frames: what comes with bytes. */
export type Frame = Shape | Difference | Picture | Regions;

export interface Link {
  /** Sends a command; the promise ends with its last answer, or fails with its problem. */
  send(command: Sent): Promise<Answer>;
}

interface Waiting {
  resolve(answer: Answer): void;
  reject(problem: Error): void;
  last?: Event;
}

/** A problem that the studio has told. */
export class Refused extends Error {
  constructor(
    readonly code: string,
    text: string,
  ) {
    super(text);
  }
}

export function connect(
  onEvent: (event: Event) => void,
  onFrame: (header: Frame, payload: ArrayBuffer) => void,
  onState: (isOpen: boolean) => void,
): Link {
  const waiting = new Map<number, Waiting>();
  let socket: WebSocket;
  let ids = 0;

  const send = (command: Sent): Promise<Answer> => {
    const id = ++ids;
    return new Promise((resolve, reject) => {
      if (socket.readyState !== WebSocket.OPEN) {
        reject(new Refused("closed", "the studio does not answer; is it still running?"));
        return;
      }
      waiting.set(id, { resolve, reject });
      socket.send(JSON.stringify({ ...command, id }));
    });
  };

  const answered = (event: Event) => {
    const one = waiting.get(event.id);
    if (one === undefined) return;
    if (event.kind === "error") {
      waiting.delete(event.id);
      one.reject(new Refused(event.problem?.code ?? "", event.problem?.text ?? ""));
    } else if (event.kind === "done" || event.kind === "state") {
      waiting.delete(event.id);
      one.resolve(one.last ?? event);
    } else {
      one.last = event;
    }
  };

  const open = () => {
    socket = new WebSocket(`ws://${location.host}/socket`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      onState(true);
      void send({ kind: "hello", protocol: PROTOCOL });
    };
    socket.onmessage = ({ data }) => {
      if (typeof data === "string") {
        const event = JSON.parse(data) as Event;
        onEvent(event);
        answered(event);
      } else {
        const length = new DataView(data).getUint32(0, true);
        const header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length))) as Frame;
        onFrame(header, data.slice(4 + length));
      }
    };
    socket.onclose = () => {
      onState(false);
      for (const one of waiting.values()) one.reject(new Refused("closed", "the connection was lost"));
      waiting.clear();
      setTimeout(open, 700);
    };
  };
  open();
  return { send };
}
