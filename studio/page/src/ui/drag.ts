// Dragging the selected part in the plane through the grabbed point that faces the camera. While the part cannot follow, a
// line leads from it to the pointer, and a line of text tells the reason. Esc ends the drag without a change.

import type { Shape } from "../messages";
import * as store from "../store";
import { type Stage, Vector3 } from "../view";

/** Pixels that a pointer moves before a press becomes a drag. */
const SLACK = 4;

export class Drag {
  private grip: { part: string; grab: Vector3; from: [number, number]; isMoving: boolean } | null = null;
  private goal = new Vector3();
  /** The distance to the pointer, as a share of the scene's size. */
  left = 0;

  constructor(private readonly stage: Stage) {}

  /** Whether a part moves with the pointer. */
  get isMoving(): boolean {
    return this.grip?.isMoving ?? false;
  }

  /** Grabs the selected part if the pointer goes down on it; returns whether it does. */
  press(x: number, y: number): boolean {
    const hit = store.tool.value === "look" && !store.isSearching.value && store.picked.value !== null ? this.stage.hitAt(x, y) : null;
    if (hit === null || hit.address !== store.part.value) return false;
    store.offers.value = [];
    this.grip = { part: hit.address, grab: hit.point, from: [x, y], isMoving: false };
    this.stage.setOrbiting(false);
    return true;
  }

  /** Moves the grabbed part; returns whether a part moves with the pointer. */
  move(x: number, y: number): boolean {
    const grip = this.grip;
    if (grip === null) return false;
    grip.isMoving ||= Math.hypot(x - grip.from[0], y - grip.from[1]) >= SLACK;
    if (grip.isMoving) {
      this.goal = this.stage.across(x, y, grip.grab);
      void this.tell("move");
    }
    return grip.isMoving;
  }

  /** Releases the part; returns whether it was moved. */
  release(isFollowed: boolean): boolean {
    const wasMoving = this.isMoving;
    if (wasMoving) void this.end(isFollowed);
    this.forget();
    return wasMoving;
  }

  /** Cancels the drag (Esc); the part returns to its place. */
  cancel(): void {
    if (!this.isMoving) return;
    void this.tell("cancel").then(showActive);
    this.forget();
  }

  /** Follows a shape of the moving part that has arrived. */
  shown(shape: Shape): void {
    if (!this.isMoving || shape.held === null) return;
    store.dragNote.value = shape.note;
    this.left = shape.left;
    this.stage.tether(shape.note === "" ? null : new Vector3(...shape.held), this.goal);
  }

  private async end(isFollowed: boolean): Promise<void> {
    const answer = await this.tell("end", isFollowed);
    const outcome = answer?.kind === "dragged" ? answer : null;
    store.offers.value = outcome?.offers ?? [];
    store.hasDragged.value = (outcome?.changes.length ?? 0) > 0;
    if (outcome === null || outcome.reason !== "") {
      if (outcome !== null) {
        const sentence = outcome.changes.length === 0 ? "This part cannot be moved there." : "The part has come as near as it can.";
        store.note(`${sentence}\n${outcome.reason}`);
      }
      if (outcome === null || outcome.changes.length === 0) showActive();
    }
  }

  private tell(phase: "move" | "end" | "cancel", follow = false): ReturnType<typeof store.tell> {
    const { part, grab } = this.grip!;
    const along = this.stage.sight(this.goal).toArray();
    return store.tell({ kind: "drag", part, to: this.goal.toArray(), grab: grab.toArray(), along, phase, follow });
  }

  private forget(): void {
    this.grip = null;
    store.dragNote.value = "";
    this.stage.tether(null, null);
    this.stage.setOrbiting(store.tool.value === "look");
  }
}

/** Shows the active result again. */
function showActive(): void {
  const key = store.picked.value;
  if (key !== null) void store.tell({ kind: "show", key, detail: "fine" });
}
