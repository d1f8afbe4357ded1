// What the page knows: the session's view as the studio tells it, and this window's own selection.

import { computed, effect, signal, untracked } from "@preact/signals";
import { connect, Refused } from "./link";
import type { Frame } from "./link";
import type { AskChange, Described, Difference, Event, Export, Eye, Judged, Key, Offer, Outcome, Palette, Picture, Regions, SettingsChange, Shape, TargetAsk, View } from "./messages";
import type { Mode, Order } from "./view";

export const view = signal<View | null>(null);
export const isOpen = signal(false);
export const described = signal<Described | null>(null);
/** Of the picked result: the colours of a drawing with its rules, and whether a structure stands. */
export const palette = signal<Palette | null>(null);
export const judged = signal<Judged | null>(null);
/** Whether the forces that hold a structure are shown. */
export const showForces = signal(true);
/** The board that pieces are cut of: width, height, and what the saw takes, millimetres. */
export const board = signal<[number, number, number]>([600, 400, 0.2]);
/** The call or iteration that is selected; "" for the whole model, null for nothing. */
export const level = signal<string | null>(null);
/** The primitive that was clicked. */
export const part = signal<string | null>(null);
export const hovered = signal<string | null>(null);
export const notices = signal<{ id: number; text: string; isError: boolean }[]>([]);
/** A line of text at the foot of the scene: why a part that is dragged is not at the pointer. */
export const quiet = signal("");
/** Changes of the model's file that were offered last. */
export const offers = signal<Offer[]>([]);
/** Whether the last drag has changed choices. */
export const hasDragged = signal(false);
export const tool = signal<"look" | "place" | "draw">("look");
export const showGhost = signal(true);
/** The object of the scene that has handles, and what they do. */
export const thing = signal<{ name: string; mode: Mode } | null>(null);
/** The results that stand side by side; one stage where there are none. */
export const compared = signal<Key[]>([]);
export function compare(): void {
  const stars = (view.value?.results ?? []).filter((one) => isStarred(one.key)).map((one) => one.key);
  if (compared.value.length > 0) compared.value = [];
  else if (stars.length < 2) note("Star two to four results to compare them.");
  else compared.value = stars.slice(0, 4);
}
/** How many parts of the picked result are shown, and in which order; all of them, where there is no count. */
export const growth = signal<{ count: number | null; order: Order }>({ count: null, order: "emitted" });
/** Whether the difference to what is wanted is shown; where the picked result differs. */
export const showDifference = signal(false);
export const difference = signal<{ header: Difference; marks: Uint8Array } | null>(null);
/** How many cells or pixels are wanted and filled, wanted only, filled only. */
export const counts = computed(() => {
  const found = [0, 0, 0, 0];
  for (const mark of difference.value?.marks ?? []) found[mark]++;
  return { covered: found[1], missing: found[2], outside: found[3] };
});
/** The camera, for what depends on it. */
export const eye = signal<Eye | null>(null);
/** Of the pen, in heights of the view. */
export const penWidth = signal(0.06);
/** How different variants of a part are: 0 like it, 1 least like it. */
export const strength = signal(0.5);
export const sketchKind = signal<"silhouette" | "shadow">("silhouette");
export const theme = signal<"light" | "dark">(
  matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light",
);

/** Whether the model makes scenes or structures, or a drawing is coloured. */
export const kind = computed(() => view.value?.model?.kind ?? "scene");
export const isSearching = computed(() => view.value?.searching != null);
export const picked = computed(() => view.value?.picked ?? null);
/** Whether parts are held, of those that wait for an answer. */
const asked = signal<ReadonlyMap<string, { isHeld: boolean }>>(new Map());
let held: ReadonlySet<string> = new Set();
/** The parts that are held: as the studio tells, and at once as they are asked for. Equal sets are the same one. */
export const heldParts = computed(() => {
  const found = new Set((view.value?.held ?? []).map((one) => one.part));
  for (const [part, { isHeld }] of asked.value) {
    if (isHeld) found.add(part);
    else found.delete(part);
  }
  if (found.size !== held.size || [...found].some((part) => !held.has(part))) held = found;
  return held;
});

export const sameKey = (a: Key | null | undefined, b: Key | null | undefined): boolean =>
  a != null && b != null && a.run === b.run && (a.number ?? 0) === (b.number ?? 0);
export const nameOf = (key: Key): string => `${key.run}.${key.number ?? 0}`;
export const isStarred = (key: Key): boolean => (view.value?.stars ?? []).some((one) => sameKey(one, key));

// ---- shapes: who wants to know

type Listener<F> = (header: F, payload: ArrayBuffer) => void;
const listeners: Listener<Shape>[] = [];
export const onShape = (listener: Listener<Shape>): void => void listeners.push(listener);
const drawers: Listener<Picture | Regions>[] = [];
export const onPicture = (listener: Listener<Picture | Regions>): void => void drawers.push(listener);
function framed(header: Frame, payload: ArrayBuffer): void {
  if (header.kind === "difference") difference.value = { header, marks: new Uint8Array(payload) };
  else if (header.kind === "shape") listeners.forEach((one) => one(header, payload));
  else drawers.forEach((one) => one(header, payload));
}

// ---- notices

let notes = 0;
export function note(text: string, isError = false): void {
  const id = ++notes;
  notices.value = [...notices.value.slice(-3), { id, text, isError }];
  if (!isError) setTimeout(() => dismiss(id), 4000);
}
export const dismiss = (id: number): void => {
  notices.value = notices.value.filter((one) => one.id !== id);
};

// ---- the link

function heard(event: Event): void {
  if (event.kind === "state") {
    view.value = event.view as View;
    if (view.value.interrupted) note("The last search was cut off when the studio ended. Grow starts it again.");
  } else if (event.kind === "patch" && view.value !== null) {
    view.value = { ...view.value, ...event.changes };
  } else if (event.kind === "described") {
    described.value = event;
  } else if (event.kind === "palette") {
    palette.value = event;
  } else if (event.kind === "judged") {
    judged.value = event;
  } else if (event.kind === "error" && event.id === 0 && event.problem) {
    note(event.problem.text, true);
  }
}

const link = connect(heard, framed, (open) => (isOpen.value = open));

/** Commands that held parts do not change: the others wait until what is shown as held is. */
const UNHELD = new Set<string>(["show", "describe", "judge", "difference", "export", "stop"]);
let holding: Promise<unknown> = Promise.resolve();

/** Sends a command, and shows why it was refused. */
export async function tell(command: Parameters<typeof link.send>[0]): Promise<Event | undefined> {
  if (!UNHELD.has(command.kind) && asked.peek().size > 0) await holding;
  try {
    return await link.send(command);
  } catch (problem) {
    if (problem instanceof Refused) note(problem.message, true);
    return undefined;
  }
}

// ---- what buttons and keys do

export const best = computed<Outcome | null>(
  () => view.value?.results.find((one) => sameKey(one.key, view.value?.picked)) ?? null,
);

export function run(): void {
  void tell({ kind: "run" });
}
export function stop(): void {
  void tell({ kind: "stop" });
}
export function ask(change: AskChange): void {
  void tell({ kind: "ask", ask: change });
}
export function set(settings: SettingsChange): void {
  void tell({ kind: "set", settings });
}
/** The target as it is asked, or the model's usual one. */
export const target = computed<TargetAsk | null>(() => {
  const now = view.value;
  if (now === null || now.ask.sketch != null) return null;
  return now.ask.target ?? (now.model?.target ? { source: now.model.target } : null);
});
/** The source of the target that is on the stage, or null where there is none; undefined until the first has come. */
export const shownTarget = signal<string | null | undefined>(undefined);
/** Calls `place` when the target that is asked for is on the stage, so that an object is placed beside the scene that is seen. */
export function whenTargetIsShown(place: () => void): void {
  let isPlaced = false;
  effect(() => {
    if (isPlaced || shownTarget.value !== (target.value?.source ?? null)) return;
    isPlaced = true;
    untracked(place);
  });
}
export function avoid(solid: TargetAsk): void {
  const obstacles = view.value?.ask.obstacles ?? [];
  ask({ obstacles: [...obstacles, solid] });
  thing.value = { name: `obstacle ${obstacles.length}`, mode: "translate" };
}
export function select(address: string | null): void {
  part.value = address;
  level.value = address === null ? null : address.split("/").slice(0, -1).join("/");
}
/** Holds a part or frees it: shown at once, and taken back if the studio refuses it. */
export function holdOrFree(name: string): void {
  const one = { isHeld: !heldParts.value.has(name) };
  const answer = tell({ kind: one.isHeld ? "hold" : "free", parts: [name] });
  asked.value = new Map(asked.value).set(name, one);
  holding = answer.then(() => {
    if (asked.value.get(name) === one) asked.value = new Map([...asked.value].filter(([part]) => part !== name));
  });
}
/** Asks for the change of the model's file that makes the arguments its defaults. */
export async function propose(): Promise<void> {
  const found = await tell({ kind: "propose" });
  if (found?.kind !== "offered") return;
  offers.value = found.offers;
  if (found.offers.length === 0) note("Its file does not write these defaults as numbers or texts.");
}
export function reroll(name: string, count: number): void {
  void tell({ kind: "reroll", part: name, count, strength: count > 1 ? strength.value : null });
}
export async function exported(format: Export["format"]): Promise<void> {
  if (picked.value === null) return;
  const [width, height, kerf] = board.value;
  const found = await tell({ kind: "export", key: picked.value, format, board: [width, height], kerf });
  if (found?.kind !== "file") return;
  const anchor = document.createElement("a");
  anchor.href = `/file/${found.hash}`;
  anchor.download = found.name;
  anchor.click();
  note(`${found.name} is written`);
}
/** Bytes of a mesh, as the studio takes them. */
const UPLOAD = 64 * 2 ** 20;
/** Sends a mesh, to grow into it or to keep away from it; or a drawing, to colour it. */
export async function uploaded(file: File, isObstacle = false): Promise<void> {
  if (file.size > UPLOAD) {
    note(`${file.name} has ${Math.round(file.size / 2 ** 20)} MB; a file that is sent has at most ${UPLOAD / 2 ** 20} MB.`, true);
    return;
  }
  note(`Reading ${file.name}`);
  const answer = await fetch(`/upload?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file });
  const found = await answer.json();
  if (!answer.ok) {
    note(`${file.name}: ${found.text}`, true);
    return;
  }
  for (const one of found.notes as string[]) note(`${file.name}: ${one}`);
  if (found.reference) void tell({ kind: "model", reference: found.reference });
  else if (isObstacle) avoid({ source: found.source });
  else ask({ target: { source: found.source } });
}
