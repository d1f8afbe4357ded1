// Written by `make studio-page` from python/niwaki/studio/messages, and python/niwaki/draw/palette.py: change these files instead.

export const PROTOCOL = 1;

/** The colour of obstacles in each theme. */
export const OBSTACLE = { light: 0xb4564a, dark: 0xd9837a };

/** Begin a connection; the answer is the whole state. */
export interface Hello {
  kind: "hello";
  protocol: number;
  id?: number;
}

/** Choose a model: a name of the gallery, or a reference to a file that was named at the start. */
export interface ChooseModel {
  kind: "model";
  reference: string;
  id?: number;
}

/** A solid to fill or to avoid: its source and its placement. */
export interface TargetAsk {
  source: string;
  move?: [number, number, number];
  scale?: [number, number, number];
  turn?: number;
  up?: "y" | "z";
}

/** A pen stroke: points and width as shares of the picture's height, from its upper left corner. */
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

/** A drawing by hand over the view of a camera: a silhouette or a shadow. */
export interface Sketch {
  strokes: Stroke[];
  aspect: number;
  camera?: Eye | null;
  kind?: "shadow" | "silhouette";
  inside?: boolean;
}

/** A rule about regions of a drawing, as in `niwaki.color.Rules`. */
export interface RuleAsk {
  kind: "lighter" | "lightness" | "muted" | "same-chroma" | "same-hue";
  regions: string[];
  most?: number;
}

/** The rules of a drawing. */
export interface RulesAsk {
  rules?: RuleAsk[];
  background?: string | null;
  weight?: number;
}

/** New values of some fields of `Ask`; a target replaces a sketch, and a sketch replaces a target. */
export interface AskChange {
  target?: TargetAsk | null;
  sketch?: Sketch | null;
  floor?: number | null;
  obstacles?: TargetAsk[];
  light?: [number, number, number];
  rules?: RulesAsk | null;
}

/** Change the goals of the search; other goals stay. */
export interface SetAsk {
  kind: "ask";
  ask: AskChange;
  id?: number;
}

/** New values of some fields of `Settings`. */
export interface SettingsChange {
  count?: number;
  seed?: number | null;
  effort?: number;
  strength?: number;
  by?: "kind" | "look";
}

/** Set arguments by name, or settings; other values stay. */
export interface Set {
  kind: "set";
  arguments?: Record<string, any> | null;
  settings?: SettingsChange | null;
  id?: number;
}

/** Request fields of the state by name, such as `models`, `targets` or `results`. */
export interface Look {
  kind: "look";
  fields?: string[];
  id?: number;
}

/** Read a text file below the folder that was named at the start. */
export interface Read {
  kind: "read";
  path: string;
  id?: number;
}

/** Write a file below the folder that was named at the start: a model (`.py`, `.scad`) or a note (`.md`). */
export interface Write {
  kind: "write";
  path: string;
  text: string;
  id?: number;
}

/** The key of a result: the number of its run, and its place in the run. */
export interface Key {
  run: number;
  number?: number;
}

/** Compile a model; report its functions and choices, advice, and the requirements that its results must keep. */
export interface Check {
  kind: "check";
  reference?: string;
  key?: Key | null;
  id?: number;
}

/** Run the present model without a target, `count` times; the answer has a picture of these runs side by side. */
export interface Preview {
  kind: "preview";
  count?: number;
  seed?: number | null;
  id?: number;
}

/** Change one choice of a run of the present model, and count the calls that each strategy runs again. */
export interface Explain {
  kind: "explain";
  choice: string;
  seed?: number | null;
  id?: number;
}

/** Fit the parameters of somebody else's model, `file.py:function` or an OpenSCAD file, to a target. */
export interface Fit {
  kind: "fit";
  reference: string;
  target: TargetAsk;
  evaluations?: number;
  seed?: number;
  align?: boolean;
  id?: number;
}

/** Start a search; held parts stay. A running search is stopped first and its results are dropped. */
export interface Run {
  kind: "run";
  id?: number;
}

/** Stop the search and keep its results so far. */
export interface Stop {
  kind: "stop";
  id?: number;
}

/** Hold parts of the active result in further searches. */
export interface HoldParts {
  kind: "hold";
  parts: string[];
  color?: string | null;
  id?: number;
}

/** Free held parts; all parts if none is named. */
export interface FreeParts {
  kind: "free";
  parts?: string[];
  id?: number;
}

/** Grow a part of the active result again, in place; `count` times, with consecutive seeds. */
export interface Reroll {
  kind: "reroll";
  part: string;
  count?: number;
  strength?: number | null;
  id?: number;
}

/** Set a choice of the active result. During the move only the shape is shown; the end adds a result. */
export interface Choose {
  kind: "choose";
  address: string;
  value: number | boolean | string;
  phase?: "end" | "move";
  id?: number;
}

/** Drag a part of the active result to a point. During the move only the shape is shown; the end adds a result. */
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

/** Request a change of the model's file that makes the present arguments its defaults. */
export interface Propose {
  kind: "propose";
  id?: number;
}

/** Write one of the last offered changes of the model's file, named by its difference. */
export interface Rewrite {
  kind: "rewrite";
  difference: string;
  id?: number;
}

/** Request the choices of a result, with their places in the source. */
export interface Describe {
  kind: "describe";
  key: Key;
  id?: number;
}

/** Request the shape of a result, as a mesh (`light`, `fine`) or as a small picture (`picture`). */
export interface Show {
  kind: "show";
  key: Key;
  detail?: "fine" | "light" | "picture";
  id?: number;
}

/** Request the difference between a result and its target. */
export interface ShowDifference {
  kind: "difference";
  key: Key;
  id?: number;
}

/** Make a result the active result. */
export interface Pick {
  kind: "pick";
  key: Key;
  id?: number;
}

/** Star a result, or remove its star. */
export interface Star {
  kind: "star";
  key: Key;
  on?: boolean;
  id?: number;
}

/** Request a check of whether a structure of blocks stands: its forces and, on request, a simulated fall. */
export interface Judge {
  kind: "judge";
  key: Key;
  simulate?: boolean;
  id?: number;
}

/** Undo the last step. */
export interface Undo {
  kind: "undo";
  id?: number;
}

/** Redo the last undone step. */
export interface Redo {
  kind: "redo";
  id?: number;
}

/** Write a result as a file, or as a recipe (`json`), which `niwaki replay` repeats. */
export interface Export {
  kind: "export";
  key: Key;
  format: "3mf" | "assembly" | "dxf" | "glb" | "json" | "obj" | "ply" | "png" | "stl" | "svg" | "toml";
  scale?: number | null;
  board?: [number, number];
  kerf?: number;
  id?: number;
}

/** A parameter of a model; `default` is present only for numbers, texts and truth values. */
export interface Parameter {
  name: string;
  default: any;
  is_required: boolean;
  is_whole: boolean;
}

/** A region of a drawing: its share of the picture, and its colour in the file. */
export interface RegionInfo {
  name: string;
  share: number;
  color: string;
}

/** An entry of the list of models: a model, or a drawing to colour. */
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

/** The goals of a search. Without a target and a sketch, a model of the gallery has its usual goals. */
export interface Ask {
  target?: TargetAsk | null;
  sketch?: Sketch | null;
  floor?: number | null;
  obstacles?: TargetAsk[];
  light?: [number, number, number];
  rules?: RulesAsk | null;
}

/** The settings of a search. */
export interface Settings {
  count?: number;
  seed?: number | null;
  effort?: number;
  strength?: number;
  by?: "kind" | "look";
}

/** A result in the gallery: its key and its numbers; scores in nats. */
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
  kind: string;
  fit: string;
  unmet: string[];
}

/** A held part: its pattern, and the values of its held choices. */
export interface HeldPart {
  part: string;
  choices: Record<string, any>;
}

/** A place in a model's file; lines and columns count from 1, and the end is excluded. */
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

/** The progress of the running search. */
export interface Searching {
  run: number;
  done: number;
  best: number | null;
  seconds: number;
  fit: string;
}

/** An offered placement of the target: why, in a sentence, and the target at its new place. */
export interface Placing {
  text: string;
  label: string;
  target: TargetAsk;
}

/** The size of a run of the model without a target, the size of the target, and offered placements. */
export interface Sizes {
  model: [number, number, number] | null;
  target: [number, number, number] | null;
  offers: Placing[];
}

/** The state that every window shows; a patch has some of its fields. */
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
  sizes: Sizes;
}

/** The whole state; `rev` counts the patches. */
export interface State {
  kind: "state";
  id: number;
  session: string;
  rev: number;
  view: View | null;
}

/** The changes since the revision before. */
export interface Patch {
  kind: "patch";
  id: number;
  rev: number;
  changes: Record<string, any>;
}

/** A choice of a result: its value; its options if they are words, else the range of its slider if it has one. */
export interface ChoiceInfo {
  address: string;
  family: string;
  value: any;
  options: string[];
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

/** The choices and parts of a result, in the order of its run. */
export interface Described {
  kind: "described";
  id: number;
  key: Key | null;
  choices: ChoiceInfo[];
  parts: PartInfo[];
  labels: [number, string, string, boolean][];
}

/** The header of a frame with a mesh: see `niwaki.studio.worker.shapes`. */
export interface Shape {
  kind: "shape";
  id: number;
  role: "best" | "ghost" | "glimpse" | "moving" | "obstacle" | "prior" | "result";
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

/** The answer to `look`: fields of the state. */
export interface Looked {
  kind: "looked";
  id: number;
  values: Record<string, any>;
}

/** The text of a file that was read or written. */
export interface FileText {
  kind: "text";
  id: number;
  path: string;
  text: string;
}

/** A function of a model; a function without sites is pure. */
export interface FunctionRow {
  name: string;
  sites: number;
}

/** A choice in the text of a model: its function, its component of addresses, its line. */
export interface ChoiceRow {
  function: string;
  choice: string;
  line: number;
}

/** Advice about a line of a model. */
export interface AdviceRow {
  code: string;
  line: number;
  text: string;
}

/** A requirement beside a model. */
export interface RequirementRow {
  name: string;
  text: string;
  holds: boolean | null;
  value: string;
}

/** A report on a model: its functions and choices, advice, and requirements. */
export interface CheckReport {
  model: string;
  arguments: string;
  constants: number;
  functions: FunctionRow[];
  choices: ChoiceRow[];
  advice: AdviceRow[];
  requirements: RequirementRow[];
}

/** The answer to `check`: what `niwaki check --json` prints. */
export interface Checked {
  kind: "checked";
  id: number;
  report: CheckReport | null;
}

/** A run of a model without a target; the value that it returned, if it emitted nothing. */
export interface RunRow {
  seed: number;
  primitives: number;
  value: string;
}

/** A report on runs of a model without a target. */
export interface ShowReport {
  runs: RunRow[];
}

/** The answer to `preview`: what `niwaki show --json` prints. */
export interface Previewed {
  kind: "previewed";
  id: number;
  report: ShowReport | null;
}

/** The answer to `explain`: a changed choice, and the calls that each strategy runs again for it. */
export interface Explained {
  kind: "explained";
  id: number;
  choice: string;
  before: string;
  after: string;
  calls: number;
  strategies: Record<string, Record<string, number>>;
}

/** The answer to `fit`: what `niwaki fit --json` prints. */
export interface Fitted {
  kind: "fitted";
  id: number;
  report: Record<string, any>;
}

/** A choice before and after a drag; None if the run has no such choice. */
export interface Shifted {
  address: string;
  before: any;
  after: any;
}

/** An offered change of the model's file: numbers that explain a drag, or arguments as defaults. */
export interface Offer {
  label: string;
  difference: string;
  is_instead: boolean;
}

/** The end of a drag: the changes of the first answer, or the reason why the part is not at the pointer. */
export interface Dragged {
  kind: "dragged";
  id: number;
  part: string;
  share: number;
  reason: string;
  changes: Shifted[];
  offers: Offer[];
}

/** The answer to `propose`: offered changes of the model's file. */
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

/** The header of a frame with a byte for each pixel of a sketch, as it is scored: 1 is inside. No size: no sketch. */
export interface Mask {
  kind: "mask";
  id: number;
  width: number;
  height: number;
}

/** A command is done. */
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
  path: string;
}

/** A command was refused or failed. */
export interface Failed {
  kind: "error";
  id: number;
  problem: Problem | null;
}

/** How well a colouring keeps a rule, in words and in units. */
export interface RuleResult {
  kind: string;
  first: string;
  second: string;
  text: string;
  holds: boolean;
  residual: number;
}

/** The colours of a result by region, and how well it keeps the rules. */
export interface Palette {
  kind: "palette";
  id: number;
  key: Key | null;
  colors: Record<string, string>;
  rules: RuleResult[];
}

/** The header of a frame with a PNG: a drawing in the colours of a result. */
export interface Picture {
  kind: "picture";
  id: number;
  role: "moving" | "result";
  key: Key | null;
  detail: "fine" | "light";
}

/** The header of a frame with the number of each pixel's region in the model's list, (height, width) uint16. */
export interface Regions {
  kind: "regions";
  id: number;
  role: "ghost";
  width: number;
  height: number;
}

/** A force in the scene: its point, and its size and direction in mean weights of a block. */
export interface Arrow {
  at: [number, number, number];
  force: [number, number, number];
}

/** The check of a structure: whether it stands. */
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
  | Look
  | Read
  | Write
  | Check
  | Preview
  | Explain
  | Fit
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
  | Looked
  | FileText
  | Checked
  | Previewed
  | Explained
  | Fitted
  | Dragged
  | Offered
  | Difference
  | Mask
  | Done
  | File
  | Failed
  | Palette
  | Picture
  | Regions
  | Judged;
