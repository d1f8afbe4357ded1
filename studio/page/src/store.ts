// The state of the page: the session's view, which the studio sends, and the selection of this window.

import { computed, effect, signal, untracked } from "@preact/signals";
import { CommandError, connect } from "./link";
import type { Frame } from "./link";
import type { AskChange, Described, Difference, Event, Export, Eye, Judged, Key, Mask, Offer, Outcome, Palette, Picture, Regions, SettingsChange, Shape, TargetAsk, View } from "./messages";
import type { Mode, Order } from "./view";

export const view = signal<View | null>(null);
export const isOpen = signal(false);
export const described = signal<Described | null>(null);
/** The colours and rules of the active result of a drawing; the check of an active structure. */
export const palette = signal<Palette | null>(null);
export const judged = signal<Judged | null>(null);
/** Whether the forces that hold a structure are shown. */
export const showForces = signal(true);
/** The board for cutting: width, height, and the width of the saw cut, millimetres. */
export const board = signal<[number, number, number]>([600, 400, 0.2]);
/** The selected call or iteration; "" for the whole model, null without a selection. */
export const level = signal<string | null>(null);
/** The clicked primitive. */
export const part = signal<string | null>(null);
export const hovered = signal<string | null>(null);
/** A message: a plain sentence, its details, and perhaps an action that is offered. */
export interface Notice {
  id: number;
  text: string;
  details: string;
  isError: boolean;
  offer?: { label: string; act: () => void };
}
export const notices = signal<Notice[]>([]);
/** A line of text at the foot of the scene: the reason why a dragged part is not at the pointer. */
export const dragNote = signal("");
/** The last offered changes of the model's file. */
export const offers = signal<Offer[]>([]);
/** Whether the last drag has changed choices. */
export const hasDragged = signal(false);
export const tool = signal<"look" | "place" | "draw">("look");
export const showGhost = signal(true);
/** The object of the scene with handles, and the mode of its handles. */
export const activeObject = signal<{ name: string; mode: Mode } | null>(null);
/** The results side by side; empty for a single stage. */
export const compared = signal<Key[]>([]);
export function compare(): void {
  const stars = (view.value?.results ?? []).map(({ key }) => key).filter(isStarred);
  if (compared.value.length > 0) compared.value = [];
  else if (stars.length < 2) note("Star two to four results to compare them.");
  else compared.value = stars.slice(0, 4);
}
/** The number of parts of the active result to show, and their order; null for all parts. */
export const growth = signal<{ count: number | null; order: Order }>({ count: null, order: "emitted" });
/** Whether the difference from the target is shown, and the difference of the active result. */
export const showDifference = signal(false);
export const difference = signal<{ header: Difference; marks: Uint8Array } | null>(null);
/** Cells or pixels of target and scene, of the target only, of the scene only. */
export const counts = computed(() => {
  const numbers = [0, 0, 0, 0];
  for (const mark of difference.value?.marks ?? []) numbers[mark]++;
  return { covered: numbers[1], missing: numbers[2], outside: numbers[3] };
});
/** The sketch as it is scored; null without a sketch. */
export const mask = signal<{ header: Mask; marks: Uint8Array } | null>(null);
/** Whether closed outlines of the next sketch mean their inside. */
export const isInside = signal(true);
/** Runs of the first models of the list, by reference. */
export const glimpses = signal<ReadonlyMap<string, [Shape, ArrayBuffer]>>(new Map());
/** The present camera. */
export const eye = signal<Eye | null>(null);
/** Width of the pen, as a share of the view's height. */
export const penWidth = signal(0.06);
/** Difference of the variants of a part: 0 for similar, 1 for the least similar. */
export const strength = signal(0.5);
export const sketchKind = signal<"silhouette" | "shadow">("silhouette");
export const theme = signal<"light" | "dark">(
  matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light",
);

/** The kind of the model: scenes, structures, or a drawing to colour. */
export const kind = computed(() => view.value?.model?.kind ?? "scene");
/** Whether the connection was there and is lost. */
export const isLost = computed(() => view.value !== null && !isOpen.value);
export const isSearching = computed(() => view.value?.searching != null);
export const picked = computed(() => view.value?.picked ?? null);
/** Parts whose hold or release waits for an answer. */
const pending = signal<ReadonlyMap<string, { isHeld: boolean }>>(new Map());
let held: ReadonlySet<string> = new Set();
/** The held parts: those of the studio, with pending changes applied. Equal sets are the same object. */
export const heldParts = computed(() => {
  const parts = new Set((view.value?.held ?? []).map(({ part }) => part));
  for (const [part, { isHeld }] of pending.value) {
    if (isHeld) parts.add(part);
    else parts.delete(part);
  }
  if (parts.size !== held.size || [...parts].some((part) => !held.has(part))) held = parts;
  return held;
});

export const sameKey = (a: Key | null | undefined, b: Key | null | undefined): boolean =>
  a != null && b != null && a.run === b.run && (a.number ?? 0) === (b.number ?? 0);
export const nameOf = (key: Key): string => `${key.run}.${key.number ?? 0}`;
export const isStarred = (key: Key): boolean => (view.value?.stars ?? []).some((star) => sameKey(star, key));

// ---- listeners to frames

type Listener<F> = (header: F, payload: ArrayBuffer) => void;
const shapeListeners: Listener<Shape>[] = [];
export const onShape = (listener: Listener<Shape>): void => void shapeListeners.push(listener);
const pictureListeners: Listener<Picture | Regions>[] = [];
export const onPicture = (listener: Listener<Picture | Regions>): void => void pictureListeners.push(listener);
function onFrame(header: Frame, payload: ArrayBuffer): void {
  if (header.kind === "difference") {
    // The answer for a result that is not the active one any more comes too late.
    if (sameKey(header.key, picked.value)) difference.value = { header, marks: new Uint8Array(payload) };
  } else if (header.kind === "mask") mask.value = header.width === 0 ? null : { header, marks: new Uint8Array(payload) };
  else if (header.kind === "shape" && header.role === "glimpse") glimpses.value = new Map(glimpses.value).set(header.source ?? "", [header, payload]);
  else if (header.kind === "shape") shapeListeners.forEach((listener) => listener(header, payload));
  else pictureListeners.forEach((listener) => listener(header, payload));
}

// ---- notices

/** Seconds after which a message goes away. */
const STAY = { note: 5, error: 20, offer: 20 };
let notes = 0;
/** Shows a message. Its first clause is the sentence that is read; the rest is folded. */
export function note(text: string, isError = false, offer?: Notice["offer"]): void {
  const id = ++notes;
  const [sentence, details] = folded(text);
  const others = notices.value.filter((notice) => notice.text !== sentence);
  notices.value = [...others.slice(-2), { id, text: sentence, details, isError, offer }];
  setTimeout(() => dismiss(id), 1000 * (isError ? STAY.error : offer ? STAY.offer : STAY.note));
}
/** Splits a text of the shell into a plain sentence and its details; without details, these are empty. */
export function folded(text: string): [string, string] {
  const bare = text.replace(/^error\[[^\]]*\]: /, "").trim();
  const [first] = bare.split("\n");
  const clause = first.split(/: |; |\. (?=[A-Z])/)[0];
  const plain = clause.replace(/`([^`]*)`/g, (_, name: string) => name.split("/").pop()!.replace(/#\d+$/, ""));
  const sentence = plain.charAt(0).toUpperCase() + plain.slice(1).replace(/\.$/, "") + ".";
  return [sentence, bare.replace(/\.$/, "").toLowerCase() === sentence.replace(/\.$/, "").toLowerCase() ? "" : bare];
}
/** Removes the messages of failures: a step that succeeds, an undo, or a new search has solved or replaced them. */
const settle = (): void => {
  if (notices.value.some(({ isError, offer }) => isError || offer)) notices.value = notices.value.filter(({ isError, offer }) => !isError && !offer);
};
export const dismiss = (id: number): void => {
  notices.value = notices.value.filter((notice) => notice.id !== id);
};

// ---- the link

function onEvent(event: Event): void {
  if (event.kind === "state") {
    view.value = event.view as View;
    settle();
    if (view.value.interrupted) note("Press Grow to start the interrupted search again.");
  } else if (event.kind === "patch" && view.value !== null) {
    const before = view.value;
    view.value = { ...view.value, ...event.changes };
    if (before.undo !== view.value.undo || before.redo !== view.value.redo || (event.changes.searching && !before.searching)) settle();
    onModel(before, view.value);
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

/** The time of this window's last command that can change the model. */
let chosen = -Infinity;
const CHOOSING = new Set(["model", "undo", "redo"]);
export const forgetChoice = (): void => void (chosen = -Infinity);
/** Tells that another window has chosen another model. */
function onModel({ model: before }: View, { model: now }: View): void {
  if (before === null || now === null || before.reference === now.reference || performance.now() - chosen < 10_000) return;
  const [from, to] = [before, now].map(({ reference }) => reference.replace(/^.*[/:]/, "").replace(/\.py$/, ""));
  note(`Another window chose ${to}. The results of ${from} are kept: choose it again to see them.`);
}

const link = connect(onEvent, onFrame, (open) => {
  isOpen.value = open;
  if (!open) notices.value = [];
});

/** Commands that do not depend on held parts; all others wait for pending holds. */
const INDEPENDENT = new Set<string>(["show", "describe", "judge", "difference", "export", "stop"]);
let holding: Promise<unknown> = Promise.resolve();

/** Sends a command, and shows the message of a failure. */
export async function tell(command: Parameters<typeof link.send>[0]): Promise<Event | undefined> {
  if (CHOOSING.has(command.kind)) chosen = performance.now();
  if (!INDEPENDENT.has(command.kind) && pending.peek().size > 0) await holding;
  try {
    return await link.send(command);
  } catch (problem) {
    // The page itself shows that the studio does not answer.
    if (problem instanceof CommandError && problem.code !== "closed") note(problem.message, true);
    return undefined;
  }
}

/** Whether a run of the model is shown, since there is no result yet. */
export const hasPrior = signal(false);
export const isPrior = computed(() => hasPrior.value && picked.value === null && !isSearching.value);
/** What a search still needs, in words; empty if it can start. */
export const missing = computed(() => {
  const now = view.value;
  if (now === null || now.model === null) return "Choose a model first.";
  if (kind.value !== "scene" || now.model.draws !== null || target.value !== null || now.ask.sketch != null) return "";
  return "Choose what to grow into: a shape, your own mesh, or a drawing with the pen.";
});

// ---- actions of buttons and keys

export const active = computed<Outcome | null>(
  () => view.value?.results.find(({ key }) => sameKey(key, view.value?.picked)) ?? null,
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
/** The user's target, or the model's usual target. */
export const target = computed<TargetAsk | null>(() => {
  const now = view.value;
  if (now === null || now.ask.sketch != null) return null;
  return now.ask.target ?? (now.model?.target ? { source: now.model.target } : null);
});
/** The source of the target on the stage; null without a target, undefined until the first target arrives. */
export const shownTarget = signal<string | null | undefined>(undefined);
/** Calls `place` when the present target is on the stage, so that a new object is placed beside the visible scene. */
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
  activeObject.value = { name: `obstacle ${obstacles.length}`, mode: "translate" };
}
/** The numbers of the described result's labels, by the number around and the component of addresses. */
const labelled = computed(
  () => new Map((described.value?.labels ?? []).map(([around, component], k) => [`${around} ${component}`, k])),
);
/** The steps of a label, outermost first; the components of an address that the described result does not have. */
function stepsOf(address: string): string[] {
  const steps: string[] = [];
  const components = address.split("/");
  let around = -1;
  for (const component of components) {
    const number = labelled.value.get(`${around} ${component}`);
    if (number === undefined) return components;
    const [, , text, isJoined] = described.value!.labels[number];
    if (isJoined) steps.pop();
    steps.push(text);
    around = number;
  }
  return steps;
}
/** A text with a capital at its start. */
export const capital = (text: string): string => text.slice(0, 1).toUpperCase() + text.slice(1);
/** The label of an address. */
export const labelOf = (address: string): string => capital(stepsOf(address).join(" › "));
/** The label of an address as it is read below the label of a call around it: without the steps that both have. */
export function labelBelow(address: string, call: string): string {
  const [steps, around] = [stepsOf(address), call === "" ? [] : stepsOf(call)];
  let same = 0;
  while (same < steps.length - 1 && steps[same] === around[same]) same++;
  return steps.slice(same).join(" › ");
}
export function select(address: string | null): void {
  part.value = address;
  level.value = address === null ? null : address.split("/").slice(0, -1).join("/");
}
/** Holds a part or frees it. The page shows it at once, and reverts it if the command fails. */
export function holdOrFree(name: string): void {
  const change = { isHeld: !heldParts.value.has(name) };
  const answer = tell({ kind: change.isHeld ? "hold" : "free", parts: [name] });
  pending.value = new Map(pending.value).set(name, change);
  holding = answer.then(() => {
    if (pending.value.get(name) === change) pending.value = new Map([...pending.value].filter(([part]) => part !== name));
  });
}
/** Requests a change of the model's file that makes the arguments its defaults. */
export async function propose(): Promise<void> {
  const answer = await tell({ kind: "propose" });
  if (answer?.kind !== "offered") return;
  offers.value = answer.offers;
  if (answer.offers.length === 0) note("The model's file does not write these defaults as numbers or texts.");
}
export function reroll(name: string, count: number): void {
  const holder = [...heldParts.value].find((part) => name === part || name.startsWith(`${part}/`));
  if (holder !== undefined) {
    const free = async () => {
      await tell({ kind: "free", parts: [holder] });
      reroll(name, count);
    };
    note(`${holder.split("/").pop()} is held, so it keeps its form.`, false, { label: "Free it and re-roll", act: () => void free() });
    return;
  }
  void tell({ kind: "reroll", part: name, count, strength: count > 1 ? strength.value : null });
}
export async function download(format: Export["format"]): Promise<void> {
  if (picked.value === null) return;
  const [width, height, kerf] = board.value;
  const file = await tell({ kind: "export", key: picked.value, format, board: [width, height], kerf });
  if (file?.kind !== "file") return;
  const anchor = document.createElement("a");
  anchor.href = `/file/${file.hash}`;
  anchor.download = file.name;
  anchor.click();
  note(`Saved ${file.name} in your downloads.\nThe session keeps it: ${file.path}`);
}
/** The largest upload that the studio accepts, bytes. */
const UPLOAD = 64 * 2 ** 20;
/** Uploads a mesh as a target or an obstacle, or a drawing to colour. */
export async function upload(file: File, isObstacle = false): Promise<void> {
  if (file.size > UPLOAD) {
    note(`${file.name} has ${Math.round(file.size / 2 ** 20)} MB. An upload may have at most ${UPLOAD / 2 ** 20} MB.`, true);
    return;
  }
  note(`Reading ${file.name}`);
  const answer = await fetch(`/upload?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file });
  const report = await answer.json();
  if (!answer.ok) {
    note(`${file.name} cannot be used.\n${report.text}`, true);
    return;
  }
  for (const text of report.notes as string[]) note(`${text}\n${file.name}`);
  if (report.reference) void tell({ kind: "model", reference: report.reference });
  else if (isObstacle) avoid({ source: report.source });
  else ask({ target: { source: report.source } });
}
