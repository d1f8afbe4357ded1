// Written from python/niwaki/studio/messages by `make studio-page`; change it there.

export const PROTOCOL = 1;

/** The first message: the whole state is the answer. */
export interface Hello {
  kind: "hello";
  protocol: number;
  id?: number;
}

/** Take a model: a name of the gallery, or a reference of a file that was named at the start. */
export interface ChooseModel {
  kind: "model";
  reference: string;
  id?: number;
}

/** A solid in the scene, to fill or to avoid: where it comes from, and how it is placed. */
export interface TargetAsk {
  source: string;
  move?: [number, number, number];
  scale?: [number, number, number];
  turn?: number;
}

/** A line of a pen: points as shares of the picture's height from its upper left corner, and the pen's width. */
export interface Stroke {
  points: [number, number][];
  width?: number;
}

/** A perspective camera; `fov` is vertical, degrees. */
export interface Eye {
  position: [number, number, number];
  look_at: [number, number, number];
  up: [number, number, number];
  fov: number;
}

/** A silhouette or a shadow drawn by hand, over the view of a camera. */
export interface Sketch {
  strokes: Stroke[];
  aspect: number;
  camera?: Eye | null;
  kind?: "shadow" | "silhouette";
}

/** A rule about regions of a drawing: those of `niwaki.color.Rules`. */
export interface RuleAsk {
  kind: "lighter" | "lightness" | "muted" | "same-chroma" | "same-hue";
  regions: string[];
  most?: number;
}

/** Rules of a drawing. */
export interface RulesAsk {
  rules?: RuleAsk[];
  background?: string | null;
  weight?: number;
}

/** Other values of some fields of `Ask`; a target takes the place of a sketch, and a sketch that of a target. */
export interface AskChange {
  target?: TargetAsk | null;
  sketch?: Sketch | null;
  floor?: number | null;
  obstacles?: TargetAsk[];
  light?: [number, number, number];
  rules?: RulesAsk | null;
}

/** Say what the scene should be like; what is left out stays. */
export interface SetAsk {
  kind: "ask";
  ask: AskChange;
  id?: number;
}

/** Other values of some fields of `Settings`. */
export interface SettingsChange {
  count?: number;
  seed?: number | null;
  effort?: number;
  strength?: number;
}

/** Set arguments by name, or settings; what is left out stays. */
export interface Set {
  kind: "set";
  arguments?: Record<string, any> | null;
  settings?: SettingsChange | null;
  id?: number;
}

/** Search; what is held stays. A search that runs is stopped first, and nothing of it is kept. */
export interface Run {
  kind: "run";
  id?: number;
}

/** Stop the search; what it has found becomes results. */
export interface Stop {
  kind: "stop";
  id?: number;
}

/** Hold parts of the picked result in what follows. */
export interface HoldParts {
  kind: "hold";
  parts: string[];
  color?: string | null;
  id?: number;
}

/** Hold them no more; all, where none is named. */
export interface FreeParts {
  kind: "free";
  parts?: string[];
  id?: number;
}

/** Grow a part of the picked result again, in place; `count` times, by seeds that follow one another. */
export interface Reroll {
  kind: "reroll";
  part: string;
  count?: number;
  strength?: number | null;
  id?: number;
}

/** Give a choice of the picked result a value; while it moves only its shape is shown, at the end it is a result. */
export interface Choose {
  kind: "choose";
  address: string;
  value: number | boolean | string;
  phase?: "end" | "move";
  id?: number;
}

/** Drag a part of the picked result to a point: while it moves only its shape is shown, at the end it is a result. */
export interface Drag {
  kind: "drag";
  part: string;
  to: [number, number, number];
  grab?: [number, number, number] | null;
  along?: [number, number, number] | null;
  phase?: "cancel" | "end" | "move";
  follow?: boolean;
  id?: number;
}

/** Ask for the change of the model's file that makes the arguments, as they are set, its defaults. */
export interface Propose {
  kind: "propose";
  id?: number;
}

/** Write a change of the model's file that was offered last; the difference is the one that was shown. */
export interface Rewrite {
  kind: "rewrite";
  difference: string;
  id?: number;
}

/** One result: the number of its run, and its place there. */
export interface Key {
  run: number;
  number?: number;
}

/** Ask for the choices of a result, with places in the source. */
export interface Describe {
  kind: "describe";
  key: Key;
  id?: number;
}

/** Ask for the shape of a result. */
export interface Show {
  kind: "show";
  key: Key;
  detail?: "fine" | "light";
  id?: number;
}

/** Ask where a result differs from what is wanted. */
export interface ShowDifference {
  kind: "difference";
  key: Key;
  id?: number;
}

/** Go on with this result. */
export interface Pick {
  kind: "pick";
  key: Key;
  id?: number;
}

/** Mark a result, or take the mark away. */
export interface Star {
  kind: "star";
  key: Key;
  on?: boolean;
  id?: number;
}

/** Ask whether a structure of blocks stands: what holds it, and where let go in a simulation, what falls. */
export interface Judge {
  kind: "judge";
  key: Key;
  simulate?: boolean;
  id?: number;
}

/** Take the last step back. */
export interface Undo {
  kind: "undo";
  id?: number;
}

/** Take the step again that was taken back. */
export interface Redo {
  kind: "redo";
  id?: number;
}

/** Write a result as a file, or its recipe (`json`), which `niwaki replay` repeats. */
export interface Export {
  kind: "export";
  key: Key;
  format: "3mf" | "assembly" | "dxf" | "glb" | "json" | "obj" | "ply" | "png" | "stl" | "svg" | "toml";
  scale?: number | null;
  board?: [number, number];
  kerf?: number;
  id?: number;
}

/** A parameter of a model; `default` only where it is a number, a text or a truth value. */
export interface Parameter {
  name: string;
  default: any;
  is_required: boolean;
}

/** A region of a drawing: its share of the picture, and the colour that it has there. */
export interface RegionInfo {
  name: string;
  share: number;
  color: string;
}

/** What can be chosen: a model, or a drawing to colour. */
export interface ModelInfo {
  reference: string;
  title: string;
  parameters: Parameter[];
  target: string | null;
  draws: string | null;
  is_file: boolean;
  kind: "coloring" | "scene" | "structure";
  regions: RegionInfo[];
  rules: RulesAsk | null;
}

/** What a scene should be like; with no target and no sketch, what the model of the gallery is usually asked. */
export interface Ask {
  target?: TargetAsk | null;
  sketch?: Sketch | null;
  floor?: number | null;
  obstacles?: TargetAsk[];
  light?: [number, number, number];
  rules?: RulesAsk | null;
}

/** How to search. */
export interface Settings {
  count?: number;
  seed?: number | null;
  effort?: number;
  strength?: number;
}

/** The numbers of a result, as the gallery shows them; scores in nats. */
export interface Outcome {
  key: Key;
  log_score: number | null;
  similarity: number | null;
  primitives: number;
  seed: number | null;
  origin: string;
  model: string;
  covered: number | null;
  outside: number | null;
  note: string;
}

/** A held part: its pattern, and the values of the choices that hold it. */
export interface HeldPart {
  part: string;
  choices: Record<string, any>;
}

/** A place in a model's file, counted from 1; the end is excluded. */
export interface Place {
  path: string;
  line: number;
  column: number;
  end_line: number;
  end_column: number;
}

/** An error as the shell prints it. */
export interface Problem {
  code: string;
  text: string;
  place: Place | null;
}

/** The search that is running. */
export interface Searching {
  run: number;
  done: number;
  best: number | null;
  seconds: number;
}

/** All that every window shows; a patch has some of its fields. */
export interface View {
  model: ModelInfo | null;
  arguments: Record<string, any>;
  ask: Ask;
  settings: Settings;
  results: Outcome[];
  picked: Key | null;
  held: HeldPart[];
  stars: Key[];
  models: ModelInfo[];
  targets: string[];
  problem: Problem | null;
  searching: Searching | null;
  interrupted: boolean;
  undo: number;
  redo: number;
  note: string;
  losses: string;
}

/** The whole state; `rev` counts the patches. */
export interface State {
  kind: "state";
  id: number;
  session: string;
  rev: number;
  view: View | null;
}

/** What has changed since the revision before. */
export interface Patch {
  kind: "patch";
  id: number;
  rev: number;
  changes: Record<string, any>;
}

/** A choice of a result: its value, and the range of a slider where it has one. */
export interface ChoiceInfo {
  address: string;
  family: string;
  value: any;
  low: number | null;
  high: number | null;
  is_whole: boolean;
  place: Place | null;
}

/** A primitive of a result, and the line that emits it. */
export interface PartInfo {
  address: string;
  place: Place | null;
}

/** The choices and parts of a result, in the order in which its run makes them. */
export interface Described {
  kind: "described";
  id: number;
  key: Key | null;
  choices: ChoiceInfo[];
  parts: PartInfo[];
}

/** The header of a frame with a mesh: see `niwaki.studio.worker.shapes`. */
export interface Shape {
  kind: "shape";
  id: number;
  what: "best" | "ghost" | "moving" | "obstacle" | "result";
  number: number;
  key: Key | null;
  detail: "fine" | "light";
  vertices: number;
  triangles: number;
  parts: string[];
  low: [number, number, number];
  high: [number, number, number];
  source: string | null;
  pivot: [number, number, number];
  is_flat: boolean;
  note: string;
  held: [number, number, number] | null;
  left: number;
}

/** A choice before and after a drag; None where the run has no such choice. */
export interface Shifted {
  address: string;
  before: any;
  after: any;
}

/** A change of the model's file: one that explains a drag, or arguments as defaults. */
export interface Offer {
  says: string;
  difference: string;
  is_instead: boolean;
}

/** The end of a drag: what has changed in the first answer; or why the part is not there. */
export interface Dragged {
  kind: "dragged";
  id: number;
  part: string;
  share: number;
  reason: string;
  changes: Shifted[];
  offers: Offer[];
}

/** A change of the model's file that was asked for. */
export interface Offered {
  kind: "offered";
  id: number;
  offers: Offer[];
}

/** The header of a frame with a byte for each cell of a target, or each pixel of a picture. */
export interface Difference {
  kind: "difference";
  id: number;
  key: Key | null;
  size: [number, number, number];
  low: [number, number, number];
  high: [number, number, number];
  is_picture: boolean;
}

/** A command has done its work. */
export interface Done {
  kind: "done";
  id: number;
  interrupted: boolean;
}

/** A file to fetch from `/file/HASH`. */
export interface File {
  kind: "file";
  id: number;
  hash: string;
  name: string;
}

/** A command was refused, or its work failed. */
export interface Failed {
  kind: "error";
  id: number;
  problem: Problem | null;
}

/** How well a colouring keeps a rule, in words and in units. */
export interface KeptRule {
  kind: string;
  first: string;
  second: string;
  text: string;
  holds: boolean;
  residual: number;
}

/** The colours of a result by region, and its rules. */
export interface Palette {
  kind: "palette";
  id: number;
  key: Key | null;
  colors: Record<string, string>;
  kept: KeptRule[];
}

/** The header of a frame with a PNG: a drawing in the colours of a result. */
export interface Picture {
  kind: "picture";
  id: number;
  what: "moving" | "result";
  key: Key | null;
  detail: "fine" | "light";
}

/** The header of a frame with the number of each pixel's region in the model's list, (height, width) uint16. */
export interface Regions {
  kind: "regions";
  id: number;
  what: "ghost";
  width: number;
  height: number;
}

/** A force in the scene: where it acts, and its size and direction in mean weights of a block. */
export interface Arrow {
  at: [number, number, number];
  force: [number, number, number];
}

/** Whether a structure stands. */
export interface Judged {
  kind: "judged";
  id: number;
  key: Key | null;
  holds: boolean;
  tilt: number;
  loose: string[];
  arrows: Arrow[];
  stands: boolean | null;
  moved: number | null;
  fallen: string[];
  board: number | null;
  text: string;
}

export type Command =
  | Hello
  | ChooseModel
  | SetAsk
  | Set
  | Run
  | Stop
  | HoldParts
  | FreeParts
  | Reroll
  | Choose
  | Drag
  | Propose
  | Rewrite
  | Describe
  | Show
  | ShowDifference
  | Pick
  | Star
  | Judge
  | Undo
  | Redo
  | Export;

export type Event =
  | State
  | Patch
  | Described
  | Shape
  | Dragged
  | Offered
  | Difference
  | Done
  | File
  | Failed
  | Palette
  | Picture
  | Regions
  | Judged;
