// The socket: commands out, events and frames in. Only uploads and exported files take another way.

import type { Command, Difference, Event, Mask, Picture, Regions, Shape } from "./messages";
import { PROTOCOL } from "./messages";

type Sent = Command extends infer C ? (C extends { id?: number } ? Omit<C, "id"> : never) : never;
export type Answer = Event | undefined;
/** Headers of frames, that is of messages with bytes. */
export type Frame = Shape | Difference | Picture | Regions | Mask;

export interface Link {
  /** Sends a command; the promise gives its last answer, or fails with its problem. */
  send(command: Sent): Promise<Answer>;
}

interface Request {
  resolve(answer: Answer): void;
  reject(problem: Error): void;
  last?: Event;
}

/** A command that the studio refused or that failed. */
export class CommandError extends Error {
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
  const waiting = new Map<number, Request>();
  let socket: WebSocket;
  let ids = 0;

  const send = (command: Sent): Promise<Answer> => {
    const id = ++ids;
    return new Promise((resolve, reject) => {
      if (socket.readyState !== WebSocket.OPEN) {
        reject(new CommandError("closed", ""));
        return;
      }
      waiting.set(id, { resolve, reject });
      socket.send(JSON.stringify({ ...command, id }));
    });
  };

  const answer = (event: Event) => {
    const request = waiting.get(event.id);
    if (request === undefined) return;
    if (event.kind === "error") {
      waiting.delete(event.id);
      request.reject(new CommandError(event.problem?.code ?? "", event.problem?.text ?? ""));
    } else if (event.kind === "done" || event.kind === "state") {
      waiting.delete(event.id);
      request.resolve(request.last ?? event);
    } else {
      request.last = event;
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
        answer(event);
      } else {
        const length = new DataView(data).getUint32(0, true);
        const header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length))) as Frame;
        onFrame(header, data.slice(4 + length));
      }
    };
    socket.onclose = () => {
      onState(false);
      for (const request of waiting.values()) request.reject(new CommandError("closed", ""));
      waiting.clear();
      setTimeout(open, 700);
    };
  };
  open();
  return { send };
}
